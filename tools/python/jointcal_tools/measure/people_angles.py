"""`jointcal angles --joint hinge` on people, row by row: error beside a reference, and the bound of the row."""

from __future__ import annotations

import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..recordings import write_csv
from ..simulate_people import PersonSpec, simulate_person
from .angles import program, run_program
from .harness import Report, Settings, median, number, percent, quantile, run_jobs
from .judge import available
from .people_flexion import LEAST_SAMPLES, apart_deg
from .people_joints import people_joint

TITLE = "Angles of people, row by row"
REQUIRED = ("knee_drop", "people_knee_long_L1")
REPORTED = ("people_ankle_orthosis",)  # with the best estimate, from BEST_FROM_S on
BEST_FROM_S = 10.0
WINDOW_S = 10.0
COVERED, SHARPEST = 0.95, 3.0
SIMULATED = {f"simulated {joint}, {' and '.join(name for name, _ in activities)}, {rate_hz:g} Hz": PersonSpec(
    activities, joint, rate_hz, seed) for seed, (joint, activities, rate_hz) in enumerate((
        ("knee", (("walk", 60.0),), 100.0), ("knee", (("walk", 30.0), ("run", 30.0)), 50.0), ("knee", (("random", 60.0),), 40.0),
        ("knee", (("walk", 30.0), ("squat", 30.0)), 100.0), ("ankle", (("run", 60.0),), 100.0), ("elbow", (("random", 60.0),), 60.0)))}


@dataclass
class Windows:
    name: str
    ready_s: float  # first row with an angle
    rms_deg: float  # over all rows with an angle and a reference
    errors_deg: np.ndarray  # (W,) rms
    bounds_deg: np.ndarray  # (W,) median
    row_covered: float  # share of single rows within their own bounds

    @property
    def covered(self) -> int:
        return int((self.errors_deg <= self.bounds_deg).sum())


def windows(t_s: np.ndarray, error_deg: np.ndarray, bound_deg: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """rms of the error and median of the bound of every 10 s, from the first row with an error on, half of which have one."""
    good = np.isfinite(error_deg) & np.isfinite(bound_deg)
    found = []
    for begin_s in np.arange(t_s[good][0], t_s[-1], WINDOW_S) if good.any() else ():
        inside = (t_s >= begin_s) & (t_s < begin_s + WINDOW_S)
        mine = inside & good
        if mine.sum() >= max(0.5 * inside.sum(), LEAST_SAMPLES):
            found.append((np.sqrt(np.mean(error_deg[mine] ** 2)), np.median(bound_deg[mine])))
    errors, bounds = np.array(found).reshape(-1, 2).T
    return errors, bounds


def measure_one(name: str) -> Windows:
    if name in SIMULATED:
        rec = simulate_person(SIMULATED[name])
        reference = np.degrees(rec.flexion_rad)
    else:
        rec = people_joint(name)
        reference = rec.flexion_deg
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "recording.csv"
        write_csv(path, rec)
        best = run_program(path, "hinge", "--accept", "best")
        angle = best[:, 0] if name in REPORTED else run_program(path, "hinge")[:, 0]
    t_s, bound = rec.t_s - rec.t_s[0], best[:, 1]
    if name in REPORTED:
        angle = np.where(t_s >= BEST_FROM_S, angle, np.nan)
    error = apart_deg(angle, reference)
    known = np.isfinite(error)
    errors, bounds = windows(t_s, error, bound)
    first = np.isfinite(angle)
    return Windows(name, float(t_s[first.argmax()]) if first.any() else np.inf,
                   float(np.sqrt(np.mean(error[known] ** 2))) if known.any() else np.nan, errors, bounds,
                   float((np.abs(error[known]) <= bound[known]).mean()) if known.any() else np.nan)


def row_of(label: str, windows_of: list[Windows]) -> list:
    errors, bounds = (np.concatenate([getattr(w, what) for w in windows_of]) for what in ("errors_deg", "bounds_deg"))
    one = windows_of[0] if len(windows_of) == 1 else None
    return [label, number(one.ready_s, 1) if one else "-", number(one.rms_deg) if one else "-", len(errors), number(median(errors)),
            number(quantile(errors, 0.95)), number(max(errors, default=np.nan)), number(median(bounds)),
            percent((errors <= bounds).sum(), len(errors)),
            number(median(bounds) / median(errors) if len(errors) else np.nan, 1), percent(one.row_covered, 1) if one and len(errors) else "-"]


def measure(settings: Settings, report: Report) -> None:
    program()
    names = [*available(*REQUIRED, *REPORTED), *SIMULATED]
    if settings.quick:
        names = [name for name in names if name in (REQUIRED[0], list(SIMULATED)[0])]
    found = {w.name: w for w in run_jobs(measure_one, names, "people_angles", settings)}
    report.text("Flexion as the program writes it from the IMU columns alone, while ready (people_ankle_orthosis: of the best estimate, "
                f"whatever its status, from {BEST_FROM_S:g} s on), beside the reference, one constant for the whole recording removed. Windows of "
                f"{WINDOW_S:g} s, half of whose rows have both: rms error and the median of `bound_deg` of its rows. Covered: windows whose rms is "
                "within it; sharpness: median bound over median error; rows: single rows within their own bound, for information. Simulated: the "
                "bones' true flexion is the reference, which in-phase skin shortens by 8 to 15 % of the thigh's rotation. deg.")
    rows = [row_of(name, [w]) for name, w in found.items()]
    for label, mine in (("people", [found[n] for n in REQUIRED if n in found]), ("simulated", [found[n] for n in SIMULATED if n in found])):
        if len(mine) > 1:
            rows.append(row_of(f"all {label}", mine))
    report.table(["recording", "from, s", "rms", "windows", "rms of windows, median", "95 %", "largest", "median bound", "covered", "sharpness",
                  "rows covered"], rows)
    mine = [found[name] for name in REQUIRED if name in found]
    for w in mine:
        report.require_share(f"{w.name}: windows whose rms error is within their bound", w.covered, len(w.errors_deg), COVERED)
    if len(mine) == len(REQUIRED):
        errors, bounds = (np.concatenate([getattr(w, what) for w in mine]) for what in ("errors_deg", "bounds_deg"))
        report.require_most("all windows of people: median bound over median error", median(bounds) / median(errors), SHARPEST)
