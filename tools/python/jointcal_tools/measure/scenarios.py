"""The four scenarios of OLS20 7.1: both engines' `ready` beside the acceptance of Algorithm 4."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import native
from ..recordings import Recording
from ..simulate import HingeSpec, scenario, simulate_hinge
from .bounds import CLASSES, COVERAGE, Moment, moment, summarise
from .harness import Report, Settings, median, number, percent, run_jobs
from .judge import MAX_ERROR_DEG, judge

TITLE = "The four scenarios of OLS20"
DISTURBANCES = ("clean", "all")
RUNS = 400  # 50 of each scenario and disturbance
# As printed: no accelerometer sample is kept that the threshold rejects.
ALGORITHM4 = {f"Algorithm 4, n_min {count}": {"engine": "window", "n_max": 1000, "acc_min": 0, "accept_count": count}
              for count in (3, 10)}


@dataclass
class Outcome:
    scenario: int
    disturbance: str
    method: str
    run: str
    first_s: float  # ready or accepted
    wrong: bool  # engines: false ready at any time; Algorithm 4: wrong when first accepted
    first: Moment | None
    end: Moment | None


def make_spec(number_: int, disturbance: str, index: int) -> HingeSpec:
    rng = np.random.default_rng([number_, list(CLASSES).index(disturbance), index, 3536])
    return HingeSpec(motions=scenario(number_), rate_hz=50.0, seed=int(rng.integers(2**31)),
                     **CLASSES[disturbance].draw(rng))


def run_method(rec: Recording, job: tuple[int, str, int], method: str) -> Outcome:
    settings = ALGORITHM4.get(method)
    verdict = judge(native.run(rec, **(settings or {"engine": method})), rec.axis1, rec.axis2)
    run = ":".join(str(part) for part in job)
    if settings:  # the paper stops at the first acceptance
        first = int(verdict.accepted.argmax()) if verdict.accepted.any() else None
        return Outcome(job[0], job[1], method, run, np.inf if first is None else float(verdict.t_s[first]),
                       first is not None and bool(verdict.bad[first]), None, None)
    first = verdict.first_ready()
    return Outcome(job[0], job[1], method, run, verdict.first_ready_s(), verdict.false_ready,
                   None if first is None else moment(verdict, first), moment(verdict, -1))


def measure_run(job: tuple[int, str, int, tuple[str, ...]]) -> list[Outcome]:
    rec = simulate_hinge(make_spec(*job[:3]))
    return [run_method(rec, job[:3], method) for method in (*job[3], *ALGORITHM4)]


def row(key: tuple[int, str, str], mine: list[Outcome]) -> list[str]:
    ever = [o for o in mine if np.isfinite(o.first_s)]
    first = summarise([o.first for o in ever if o.first])
    end = summarise([o.end for o in ever if o.end])
    return [*key, len(mine), percent(len(ever), len(mine)), number(median([o.first_s for o in ever]), 1),
            percent(sum(o.wrong for o in mine), len(ever)), *first.cells(), *end.cells()]


def measure(settings: Settings, report: Report) -> None:
    count = max(settings.count(RUNS, 8) // 8, 1)
    jobs = [(number_, disturbance, k, settings.engines)
            for number_ in (1, 2, 3, 4) for disturbance in DISTURBANCES for k in range(count)]
    outcomes = [outcome for found in run_jobs(measure_run, jobs, "scenarios", settings) for outcome in found]
    report.text(f"{count} runs of each scenario (20 s per motion, 50 Hz, transitions kept) with the paper's noise (clean) "
                "and with noise, biases and soft tissue as in the class `all` of `bounds`. Ready: at any time; for Algorithm "
                "4 accepted at any time, n_max 1000 and no minimum of accelerometer samples, as printed. Wrong: of those, "
                f"more than {MAX_ERROR_DEG:g} deg or the wrong pairing at any time while ready, or when first accepted. Cover, "
                "error, bound, ratio as in `bounds`: at first ready, then at the end of the runs that were ever ready.")
    methods = (*settings.engines, *ALGORITHM4)
    groups = {(number_, disturbance, method): [o for o in outcomes if (o.scenario, o.disturbance, o.method)
                                               == (number_, disturbance, method)]
              for number_ in (1, 2, 3, 4) for disturbance in DISTURBANCES for method in methods}
    report.table(["scenario", "disturbance", "method", "runs", "ready", "median time, s", "wrong", "first: cover 1",
                  "cover 2", "error", "bound", "ratio", "end: cover 1", "cover 2", "error", "bound", "ratio"],
                 [row(*item) for item in groups.items()])
    wrong = [o for o in outcomes if o.wrong and o.method in settings.engines]
    if wrong:
        report.text("False ready (scenario:disturbance:number): " + ", ".join(f"{o.method} {o.run}" for o in wrong[:40]))
    check(settings, report, outcomes)


def check(settings: Settings, report: Report, outcomes: list[Outcome]) -> None:
    for engine in settings.engines:
        mine = [o for o in outcomes if o.method == engine]
        ever = [o for o in mine if o.first]
        report.require_none(f"{engine}: false ready", sum(o.wrong for o in mine), len(mine))
        for when, moments in (("first ready", [o.first for o in ever]), ("end", [o.end for o in ever])):
            summary = summarise(moments)
            report.require_share(f"{engine}, {when}: axes inside their bounds", summary.covered, summary.count, COVERAGE)
