"""Data that determine nothing must never lead to `ready`."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np

from .. import native
from .faults import CLASSES, REPORTED, Case
from .harness import Report, Settings, numbered, run_jobs

TITLE = "Never ready"
ALL = {**CLASSES, **REPORTED}
QUICK_RUNS = 180
LISTED = 60


@dataclass
class Outcome:
    kind: str
    index: int
    engine: str
    ready_s: float  # when it wrongly became ready; infinite if it did not
    reason: str
    source: str


def seed(kind: str, index: int) -> list[int]:
    return [list(ALL).index(kind), index, 3534]


def make_case(kind: str, index: int) -> Case:
    return ALL[kind][0](np.random.default_rng(seed(kind, index)))


def wrongly_ready_s(track: native.Track, after_s: float) -> float:
    """When it entered ready, after `after_s` if that is above 0."""
    entered = np.flatnonzero(np.diff(np.concatenate([[False], track.ready]).astype(int)) == 1)
    late = [float(track.t_s[k]) for k in entered if track.t_s[k] >= after_s]
    return min(late, default=float("inf"))


def measure_case(job: tuple[str, int, tuple[str, ...]]) -> list[Outcome]:
    kind, index, engines = job
    case = make_case(kind, index)
    outcomes = []
    for engine in engines:
        track = native.run(case.rec, engine=engine)
        outcomes.append(Outcome(kind, index, engine, wrongly_ready_s(track, case.after_s),
                                native.reason_name(track.reason[-1]), case.source))
    return outcomes


def make_jobs(settings: Settings) -> list[tuple]:
    total = sum(count for _, count in CLASSES.values())
    runs = settings.count(total, QUICK_RUNS)
    counts = {kind: max(round(count * runs / total), 1) for kind, (_, count) in ALL.items()}
    return [(kind, k, settings.engines) for kind, k in numbered(counts, settings.only)]


def measure(settings: Settings, report: Report) -> None:
    jobs = make_jobs(settings)
    outcomes = [outcome for found in run_jobs(measure_case, jobs, "never", settings) for outcome in found]
    report.text("10 to 60 s each. `ready` must not be entered at any time; where a sensor freezes late, after motion that "
                "may have made it ready, not later than 1 s after that. The classes are described in "
                "tools/python/jointcal_tools/measure/faults.py; the seed of a run is its class and number, and "
                "`measure.py never --only CLASS:NUMBER` makes it again. The class mix_held is reported, not required: both "
                "sensors come from joints whose axes were held still, so that each turns about one axis only, as on one "
                "hinge.")
    rows = []
    for kind in dict.fromkeys(o.kind for o in outcomes):
        mine = {engine: [o for o in outcomes if o.kind == kind and o.engine == engine] for engine in settings.engines}
        reasons = Counter(o.reason for o in mine[settings.engines[0]])
        rows.append([kind, len(mine[settings.engines[0]]),
                     *(sum(np.isfinite(o.ready_s) for o in mine[engine]) for engine in settings.engines),
                     ", ".join(f"{name} {count}" for name, count in reasons.most_common(4))])
    report.table(["class", "runs", *(f"ready, {engine}" for engine in settings.engines),
                  f"reasons at the end, {settings.engines[0]}"], rows)
    offenders = [o for o in outcomes if np.isfinite(o.ready_s)]
    if offenders:
        report.text(f"Wrongly ready{f', the first {LISTED}' if len(offenders) > LISTED else ''}:")
        report.table(["run", "engine", "at, s", "made from"],
                     [[f"{o.kind}:{o.index}", o.engine, f"{o.ready_s:.2f}", o.source] for o in offenders[:LISTED]])
    for engine in settings.engines:
        mine = [o for o in outcomes if o.engine == engine and o.kind in CLASSES]
        report.require_none(f"{engine}: ready", sum(np.isfinite(o.ready_s) for o in mine), len(mine))
