"""Time to ready on informative motion, beside Algorithm 4."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import native
from ..recordings import Recording
from ..simulate import HingeSpec, simulate_hinge
from .bounds import worst_while_ready
from .harness import Report, Settings, number, percent, quantile, run_jobs
from .judge import (INFORMATIVE_RAD_S, RIG_HINGES, Verdict, available, cut, joint_rate_rms, judge, nominal_axes,
                    recording)

TITLE = "Time to ready on informative motion"
MOTIONS = ("5", "6", "7", "12", "13", "14", "daily")
RATES_HZ = (25.0, 50.0, 100.0, 200.0)
LOOK_S = 5.0  # the motion counts as informative if the first seconds are
STREAM_S = 30.0  # how long to wait
PAPER_S = 60.0
ALGORITHM4 = {"engine": "window", "n_max": 1000, "acc_min": 0}  # as printed; n_min 10
MEDIAN_S, P90_S = 4.0, 8.0
LISTED = 40


@dataclass
class Outcome:
    group: str
    start: str
    stream_s: float
    stream_false: bool
    worst_deg: float  # largest error while ready
    paper_s: float  # Algorithm 4, NaN if it was not run
    paper_wrong: bool


def accepted(verdict: Verdict) -> tuple[float, bool]:
    """When Algorithm 4 first accepts, and whether it is wrong then."""
    if not verdict.accepted.any():
        return float("inf"), False
    index = int(verdict.accepted.argmax())
    return float(verdict.t_s[index]), bool(verdict.bad[index])


def run_both(group: str, start: str, rec: Recording, axes: tuple[np.ndarray, np.ndarray], with_paper: bool) -> Outcome:
    short = cut(rec, 0, round(STREAM_S * rec.rate_hz))
    stream = judge(native.run(short), *axes)
    paper = accepted(judge(native.run(rec, **ALGORITHM4), *axes)) if with_paper else (float("nan"), False)
    return Outcome(group, start, stream.first_ready_s(), stream.false_ready, worst_while_ready(stream), *paper)


def informative_starts(rec: Recording, axes: tuple[np.ndarray, np.ndarray], every_s: float) -> list[int]:
    """Samples after which the joint moves for LOOK_S, on a grid, and enough of the recording is left."""
    look, step = round(LOOK_S * rec.rate_hz), round(every_s * rec.rate_hz)
    last = len(rec) - round(STREAM_S * rec.rate_hz)
    return [k for k in range(0, last + 1, step) if joint_rate_rms(cut(rec, k, k + look), *axes) > INFORMATIVE_RAD_S]


def measure_rig(job: tuple[str, int, bool]) -> list[Outcome]:
    name, start, with_paper = job
    rec = recording(name)
    part = cut(rec, start, start + round(PAPER_S * rec.rate_hz))
    return [run_both(name, f"{name} from sample {start}", part, nominal_axes(name), with_paper)]


def measure_simulated(job: tuple[str, int, bool]) -> list[Outcome]:
    motion, index, with_paper = job
    rng = np.random.default_rng([MOTIONS.index(motion), index, 3537])
    spec = HingeSpec(motions=((motion, 100.0),), rate_hz=RATES_HZ[rng.integers(len(RATES_HZ))],
                     seed=int(rng.integers(2**31)), speed=float(rng.uniform(1.0, 2.0)))
    rec = simulate_hinge(spec)
    axes = rec.axis1, rec.axis2
    starts = informative_starts(rec, axes, 1.0)
    if not starts:
        return []
    start = starts[rng.integers(len(starts))]
    part = cut(rec, start, start + round(PAPER_S * rec.rate_hz))
    return [run_both(f"motion {motion}", f"{motion}:{index}", part, axes, with_paper)]


def rows_of(outcomes: list[Outcome], groups: dict[str, list[Outcome]]) -> list[list[str]]:
    rows = []
    for name, mine in {**groups, "all": outcomes}.items():
        stream = [o.stream_s for o in mine]
        paper = [o.paper_s for o in mine if not np.isnan(o.paper_s)]
        accepted_count = int(np.sum(np.isfinite(paper)))
        rows.append([name, len(mine), number(quantile(stream, 0.5)), number(quantile(stream, 0.9)),
                     percent(np.sum(np.isinf(stream)), len(stream)), sum(o.stream_false for o in mine), len(paper),
                     number(quantile(paper, 0.5)), number(quantile(paper, 0.9)),
                     percent(sum(o.paper_wrong for o in mine), accepted_count)])
    return rows


def report_source(report: Report, source: str, outcomes: list[Outcome]) -> None:
    groups = {name: [o for o in outcomes if o.group == name] for name in dict.fromkeys(o.group for o in outcomes)}
    report.table([source, "starts", "median, s", "90 %, s", f"not in {STREAM_S:g} s", "false ready",
                  "starts, Algorithm 4", "median, s", "90 %, s", "wrong when accepted"], rows_of(outcomes, groups))
    false = [f"{o.start} ({number(o.worst_deg)} deg)" for o in outcomes if o.stream_false]
    if false:
        report.text("False ready (largest error while ready): " + ", ".join(false[:LISTED]))
    times = [o.stream_s for o in outcomes]
    report.require_most(f"{source}: median", quantile(times, 0.5), MEDIAN_S, " s")
    report.require_most(f"{source}: 90 %", quantile(times, 0.9), P90_S, " s", (P90_S + 0.6, "a short run has 35 starts, too few for this"))
    report.require_none(f"{source}: false ready", sum(o.stream_false for o in outcomes), len(outcomes))


def measure(settings: Settings, report: Report) -> None:
    report.text("Stream engine, and Algorithm 4 (n_max 1000, n_min 10, no minimum of accelerometer samples, as printed) "
                f"from the same starts. A start counts if the joint rate of the next {LOOK_S:g} s is above "
                f"{INFORMATIVE_RAD_S} rad/s rms. What is not ready within {STREAM_S:g} s (accepted within {PAPER_S:g} s) "
                "counts as never in median and 90 %.")
    names = available(*RIG_HINGES)
    if names:
        every_s, paper_every = (10.0, 4) if settings.quick else (1.0, 8)
        jobs = [(name, start, k % paper_every == 0) for name in names
                for k, start in enumerate(informative_starts(recording(name), nominal_axes(name), every_s))]
        found = run_jobs(measure_rig, jobs, "time, rig", settings)
        report_source(report, "rig recordings", [outcome for some in found for outcome in some])
    else:
        report.text("The rig recordings are not there; JOINTCAL_DATA names their folder.")
    count = -(-settings.count(420, 28) // len(MOTIONS))
    jobs = [(motion, k, k % 5 == 0) for motion in MOTIONS for k in range(count)]
    found = run_jobs(measure_simulated, jobs, "time, simulated", settings)
    report_source(report, "simulated, the paper's noise", [outcome for some in found for outcome in some])
