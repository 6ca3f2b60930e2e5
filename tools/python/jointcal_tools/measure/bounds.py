"""Honest bounds: coverage and sharpness over simulated informative runs, per kind of disturbance."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from .. import native
from ..simulate import HingeSpec, simulate_hinge
from .harness import Report, Settings, median, number, numbered, percent, quantile, run_jobs
from .judge import MAX_ERROR_DEG, Verdict, judge

TITLE = "Honest bounds: coverage and sharpness"
MOTIONS = ("3", "4", "5", "6", "7", "10", "11", "12", "13", "14", "daily")
RATES_HZ = (25.0, 40.0, 50.0, 100.0, 128.0, 200.0)
RUNS = 2200  # as many of each motion in each class
COVERAGE = 0.95
SHARPNESS = 3.0
REALISTIC = "all"  # the class about which DESIGN 3 says how sharp bounds must be
QUICK_ENOUGH = 30  # runs below which a quick measurement does not judge medians
LISTED = 40

# What disturbs: noise over the paper's, |b_a| in m/s^2, |b_w| in deg/s, soft tissue in deg rms; each up to this, from that.
Range = tuple[float, float]


@dataclass(frozen=True)
class Disturbance:
    noise: Range = (1.0, 1.0)
    acc_bias: Range = (0.0, 0.0)
    gyr_bias_deg_s: Range = (0.0, 0.0)
    soft_tissue_deg: Range = (0.0, 0.0)

    def draw(self, rng: np.random.Generator) -> dict[str, float]:
        return {"noise_scale": rng.uniform(*self.noise), "acc_bias": rng.uniform(*self.acc_bias),
                "gyr_bias_deg_s": rng.uniform(*self.gyr_bias_deg_s),
                "soft_tissue_deg": rng.uniform(*self.soft_tissue_deg)}


CLASSES = {
    "clean": Disturbance(),
    "noise": Disturbance(noise=(2.0, 5.0)),
    "bias": Disturbance(acc_bias=(0.0, 1.0), gyr_bias_deg_s=(0.0, 1.0)),
    "soft": Disturbance(soft_tissue_deg=(0.0, 1.5)),
    "all": Disturbance((1.0, 5.0), (0.0, 1.0), (0.0, 1.0), (0.0, 1.5)),
}


@dataclass
class Moment:
    """Errors and bounds of both axes at one time, deg."""

    errors: np.ndarray  # (2,)
    bounds: np.ndarray
    covered: np.ndarray  # (2,) bool


@dataclass
class Outcome:
    run: str  # class:index
    kind: str
    engine: str
    motion: str
    rate_hz: float
    first_s: float
    first: Moment | None  # when `ready` was first entered
    end: Moment
    ready_at_end: bool
    false_ready: bool
    worst_deg: float  # largest error while ready
    reason: str


def make_spec(kind: str, index: int) -> HingeSpec:
    rng = np.random.default_rng([list(CLASSES).index(kind), index, 3535])
    return HingeSpec(motions=((MOTIONS[index % len(MOTIONS)], float(rng.uniform(15.0, 40.0))),),
                     rate_hz=RATES_HZ[rng.integers(len(RATES_HZ))], seed=int(rng.integers(2**31)),
                     speed=float(rng.uniform(0.7, 2.5)), **CLASSES[kind].draw(rng))


def moment(verdict: Verdict, index: int) -> Moment:
    return Moment(verdict.errors_deg[index], verdict.bounds_deg[index], verdict.covered(index))


def worst_while_ready(verdict: Verdict) -> float:
    if not verdict.ready.any():
        return 0.0
    errors = verdict.errors_deg.max(axis=1)
    return float(np.where(verdict.wrong_sign, 180.0 - errors, errors)[verdict.ready].max())


def measure_run(job: tuple[str, int, tuple[str, ...]]) -> list[Outcome]:
    kind, index, engines = job
    spec = make_spec(kind, index)
    rec = simulate_hinge(spec)
    outcomes = []
    for engine in engines:
        verdict = judge(native.run(rec, engine=engine), rec.axis1, rec.axis2)
        first = verdict.first_ready()
        outcomes.append(Outcome(f"{kind}:{index}", kind, engine, spec.motions[0][0], spec.rate_hz,
                                verdict.first_ready_s(), None if first is None else moment(verdict, first),
                                moment(verdict, -1), bool(verdict.ready[-1]), verdict.false_ready,
                                worst_while_ready(verdict), native.reason_name(verdict.reason)))
    return outcomes


@dataclass
class Summary:
    """Of the moments of many runs."""

    count: int
    covered: np.ndarray  # (2,) how many
    error: float  # median over runs and axes
    bound: float

    @property
    def sharpness(self) -> float:
        return self.bound / self.error if self.error > 0.0 else float("nan")

    def cells(self) -> list[str]:
        return [*(percent(hits, self.count) for hits in self.covered), number(self.error), number(self.bound),
                number(self.sharpness, 1)]


def summarise(moments: list[Moment]) -> Summary:
    if not moments:
        return Summary(0, np.zeros(2, int), float("nan"), float("nan"))
    return Summary(len(moments), np.sum([m.covered for m in moments], axis=0),
                   median(np.concatenate([m.errors for m in moments])),
                   median(np.concatenate([m.bounds for m in moments])))


def first_and_end(mine: list[Outcome]) -> tuple[Summary, Summary]:
    """At first ready, and at the end of the runs that ever were."""
    ever = [o for o in mine if o.first is not None]
    return summarise([o.first for o in ever]), summarise([o.end for o in ever])


MOMENT_HEADER = ["cover 1", "cover 2", "error", "bound", "ratio"]


def class_row(kind: str, engine: str, mine: list[Outcome]) -> list[str]:
    first, end = first_and_end(mine)
    times = [o.first_s for o in mine if o.first is not None]
    never = summarise([o.end for o in mine if o.first is None])
    return [kind, engine, len(mine), percent(first.count, len(mine)), percent(sum(o.ready_at_end for o in mine), len(mine)),
            number(median(times), 1), number(quantile(times, 0.9), 1), *first.cells(), *end.cells(),
            percent(never.covered.sum(), 2 * never.count), sum(o.false_ready for o in mine)]


def group_table(report: Report, title: str, key: Callable[[Outcome], str], outcomes: list[Outcome]) -> None:
    rows = []
    for value, engine in dict.fromkeys((key(o), o.engine) for o in outcomes):
        mine = [o for o in outcomes if key(o) == value and o.engine == engine]
        first, end = first_and_end(mine)
        times = [o.first_s for o in mine if o.first is not None]
        reasons = Counter(o.reason for o in mine if not o.ready_at_end)
        rows.append([value, engine, len(mine), percent(first.count, len(mine)), number(median(times), 1),
                     number(quantile(times, 0.9), 1), percent(first.covered.sum(), 2 * first.count),
                     number(first.sharpness, 1), percent(end.covered.sum(), 2 * end.count), number(end.sharpness, 1),
                     sum(o.false_ready for o in mine), ", ".join(f"{n} {c}" for n, c in reasons.most_common(3)) or "-"])
    report.table([title, "engine", "runs", "ever ready", "time, s", "90 %, s", "first: cover", "ratio", "end: cover",
                  "ratio", "false ready", "reasons if not ready at the end"], rows)


def measure(settings: Settings, report: Report) -> None:
    per_class = -(-settings.count(RUNS, 110) // len(CLASSES))
    jobs = [(kind, k, settings.engines) for kind, k in numbered(dict.fromkeys(CLASSES, per_class), settings.only)]
    outcomes = [outcome for found in run_jobs(measure_run, jobs, "bounds", settings) for outcome in found]
    report.text(f"{len(jobs)} simulated runs of 15 to 40 s: motions {', '.join(MOTIONS)} of OLS20 in turn, random "
                "mounting, lever arms, rate (" + ", ".join(f"{rate:g}" for rate in RATES_HZ) + " Hz) and speed (0.7 to 2.5 "
                "rad/s rms). Classes: clean (the paper's noise), noise (2 to 5 times it), bias (up to 1 m/s^2 and 1 deg/s), "
                "soft (soft tissue up to 1.5 deg rms), all (all of these, noise from 1). Seeds: class and number.")
    report.text("Cover: share of runs whose true axis lies inside the stated bound. Error, bound: medians over both axes, "
                "deg; ratio: bound over error. First: when `ready` was first entered; end: of the runs that were ready at "
                "any time; cover otherwise: at the end of the others. False ready: at any time `ready` with an error above "
                f"{MAX_ERROR_DEG:g} deg or the wrong pairing.")
    groups = {(kind, engine): [o for o in outcomes if o.kind == kind and o.engine == engine]
              for engine in settings.engines for kind in dict.fromkeys(o.kind for o in outcomes)}
    report.table(["class", "engine", "runs", "ever ready", "at end", "time, s", "90 %, s",
                  *(f"first: {name}" if name == "cover 1" else name for name in MOMENT_HEADER),
                  *(f"end: {name}" if name == "cover 1" else name for name in MOMENT_HEADER), "cover otherwise",
                  "false ready"], [class_row(*key, mine) for key, mine in groups.items()])
    outcomes.sort(key=lambda o: (settings.engines.index(o.engine), MOTIONS.index(o.motion)))
    group_table(report, "motion", lambda o: o.motion, outcomes)
    outcomes.sort(key=lambda o: (settings.engines.index(o.engine), o.rate_hz))
    group_table(report, "rate", lambda o: f"{o.rate_hz:g} Hz", outcomes)
    list_false(report, [o for o in outcomes if o.false_ready])
    check(report, groups)


def list_false(report: Report, false: list[Outcome]) -> None:
    if false:
        report.text("False ready (`measure.py bounds --only CLASS:NUMBER` makes a run again):")
        report.table(["run", "engine", "motion", "rate", "largest error while ready, deg"],
                     [[o.run, o.engine, o.motion, f"{o.rate_hz:g} Hz", number(o.worst_deg)] for o in false[:LISTED]])


def check(report: Report, groups: dict[tuple[str, str], list[Outcome]]) -> None:
    for (kind, engine), mine in groups.items():
        report.require_none(f"{engine}, {kind}: false ready", sum(o.false_ready for o in mine), len(mine))
        for when, summary in zip(("first ready", "end"), first_and_end(mine), strict=True):
            report.require_share(f"{engine}, {kind}, {when}: axes inside their bounds", summary.covered, summary.count,
                                 COVERAGE)
            if kind == REALISTIC and (summary.count >= QUICK_ENOUGH or not report.quick):
                report.require_most(f"{engine}, {kind}, {when}: median bound over median error", summary.sharpness,
                                    SHARPNESS)
