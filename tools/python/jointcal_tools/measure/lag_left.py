"""What a lag that is within its bound does to a hinge: simulated hinges whose sensor 2 is late by some milliseconds."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np

from .. import native
from . import sensor_faults as faults
from .harness import Report, Settings, median, number, percent, run_jobs

TITLE = "Lag that is left"
LATE_MS = (0, 2, 4, 6, 8, 10)
RUNS, QUICK_RUNS = 200, 2  # of a lag, half of them late and half early


@dataclass
class Outcome:
    late_ms: int
    ready: bool  # ever
    ready_s: float
    first: bool  # both axes within their bounds when it was first ready ...
    at_end: bool  # ready at the end
    last: bool  # ... and then
    end_deg: float  # the larger error at the end
    bound_deg: float  # and the larger bound
    worst_deg: float  # largest error while ready
    reason: str


def measure_run(job: tuple[int, int]) -> Outcome:
    late_ms, index = job
    sign = 1.0 if index % 2 == 0 else -1.0
    row = faults.Row(faults.HINGE, times2=lambda t, rng: t - 1e-3 * sign * late_ms)
    rec, truth = faults.make_of(row, "lag that is left", index)
    track = native.run(rec)
    off = np.column_stack([faults.errors_deg(axis, true) for axis, true in ((track.axis1, truth.axis1), (track.axis2, truth.axis2))])
    covered = (off <= track.bounds_deg).all(axis=1)
    ready = track.ready
    k = int(ready.argmax())
    return Outcome(late_ms, bool(ready.any()), float(track.t_s[k]) if ready.any() else np.inf, bool(covered[k]), bool(ready[-1]), bool(covered[-1]),
                   float(off[-1].max()), float(track.bounds_deg[-1].max()), float(off[ready].max()) if ready.any() else np.nan,
                   native.reason_name(track.reason[-1]))


def row_of(late_ms: int, mine: list[Outcome]) -> list:
    ready, ended = [o for o in mine if o.ready], [o for o in mine if o.at_end]
    reasons = ", ".join(f"{word} {count}" for word, count in Counter(o.reason for o in mine).most_common(3))
    return [late_ms, len(mine), len(ready), sum(o.worst_deg > faults.WRONG_DEG for o in ready), percent(sum(o.first for o in ready), len(ready)),
            len(ended), percent(sum(o.last for o in ended), len(ended)), number(median([o.end_deg for o in ended]), 2),
            number(median([o.bound_deg for o in ended]), 2), number(median([o.ready_s for o in ready]), 1), reasons]


def measure(settings: Settings, report: Report) -> None:
    runs = settings.count(RUNS, QUICK_RUNS)
    outcomes = run_jobs(measure_run, [(late_ms, k) for late_ms in LATE_MS for k in range(runs)], "lag_left", settings)
    report.text(f"Simulated hinges as in sensor_faults.md, {faults.LENGTH_S:g} s each, the rigid model; the same hinges in every row. Sensor 2 is late in one half of the runs and "
                f"early in the other. False: ready with an axis more than {faults.WRONG_DEG:g} deg off at any time. Covered: both axes within their bounds, of those "
                "ready then. Error and bound: the larger axis, at the end.")
    report.table(["late or early by, ms", "runs", "ready", "false", "covered when first ready", "ready at the end", "covered then", "error, deg, median", "bound",
                  "ready after, s, median", "at the end"], [row_of(late_ms, [o for o in outcomes if o.late_ms == late_ms]) for late_ms in LATE_MS])
