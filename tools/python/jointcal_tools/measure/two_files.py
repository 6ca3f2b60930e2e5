"""Two files of one sensor each, with clocks and rates of their own, beside the recording that they are split from."""

from __future__ import annotations

import json
import subprocess
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..recordings import Recording, write_csv
from ..simulate import HingeSpec, simulate_hinge
from ..simulate_people import PersonSpec, simulate_person
from ..two_files import Clock, lag_s, split, write
from .angles import program
from .harness import Report, Settings, median, number, percent, quantile, run_jobs
from .judge import RIG_HINGES, available, cut, line_angle_deg, nominal_axes, recording

TITLE = "Two files with clocks of their own"
PEOPLE = ("people_knee_long_L1", "people_knee_long_R1", "human_knee_left", "human_elbow_right", "knee_drop")
PART_S = 60.0
STARTS, SIMULATIONS, UNRELATED, GAIT = 8, 40, 400, 20
GAIT_KINDS = (("knee", "walk"), ("ankle", "walk"), ("knee", "run"))
FAR_S = (0.35, 3.0)  # the search reaches to 2.2 s
LAG_MAX_S, APART_MAX_S, DRIFT_MAX_PPM, JITTER_S, LOSS = 0.22, 2.0, 500.0, 0.002, 0.05
LAG_LIMIT_MS, OVER_MAX, FALSE_DEG, COVERAGE, WRONG_S = 3.0, 0.05, 3.0, 0.95, 0.02
ONE_FILE, IN_STEP = "one file, as it is", "two files, in step"
ALL = {"drift": True, "jitter": True}
# What happens to sensor 2, and its readings a second where they are not its own.
CASES: dict[str, dict] = {
    ONE_FILE: {"lag": False}, IN_STEP: {"lag": False}, "lag": {}, "begun apart": {"apart": True}, "lag, drift": {"drift": True}, "lag, drift, jitter, losses": ALL,
    **{f"the same, sensor 2 at {rate:g} Hz": ALL | {"rate_hz": rate} for rate in (25.0, 60.0, 200.0, 400.0)},
}


@dataclass
class Outcome:
    kind: str
    case: str
    status: str = ""
    first_s: float = np.inf  # ready, after the first row
    lag_error_s: float = np.nan
    lag_bound_s: float = np.nan
    axes: list = field(default_factory=lambda: [None, None])
    bounds_deg: tuple[float, float] = (90.0, 90.0)
    errors_deg: tuple[float, float] = (np.nan, np.nan)  # where the truth is known
    is_false: bool = False  # any line that says ready for axes more than FALSE_DEG off

    @property
    def is_ready(self) -> bool:
        return self.status == "ready"

    @property
    def has_lag(self) -> bool:
        return not np.isnan(self.lag_error_s)

    @property
    def is_over(self) -> bool:
        return self.lag_error_s > self.lag_bound_s


def said(*arguments: str | Path) -> list[dict]:
    """Lines of --json."""
    run = subprocess.run([program(), "hinge", *map(str, arguments), "--json", "--every", "2"], capture_output=True, text=True)
    if run.returncode not in (0, 3):
        raise RuntimeError(run.stderr)
    return [json.loads(line) for line in run.stdout.splitlines()]


def errors_of(line: dict, truth: tuple[np.ndarray, np.ndarray]) -> tuple[float, float]:
    """Of both axes as lines, deg; the wrong pairing is 180."""
    if line["axis1"] is None or line["axis2"] is None:
        return np.nan, np.nan
    axes = [np.array(line[name]) for name in ("axis1", "axis2")]
    if (axes[0] @ truth[0]) * (axes[1] @ truth[1]) < 0.0:
        return 180.0, 180.0
    return tuple(float(line_angle_deg(axis, true)) for axis, true in zip(axes, truth, strict=True))


def clocks_of(case: str, rng: np.random.Generator) -> tuple[Clock, Clock]:
    what = CASES[case]
    jitter_s, loss = (JITTER_S, LOSS) if what.get("jitter") else (0.0, 0.0)
    most_s = APART_MAX_S if what.get("apart") else LAG_MAX_S
    late_s = float(rng.uniform(-most_s, most_s)) if what.get("lag", True) else 0.0
    drift_ppm = float(rng.uniform(-DRIFT_MAX_PPM, DRIFT_MAX_PPM)) if what.get("drift") else 0.0
    # Readings of different sensors are not of the same moments.
    begin_s = float(rng.uniform(0.0, 0.01)) if "rate_hz" in what else 0.0
    return (Clock(jitter_s=jitter_s, loss=loss),
            Clock(what.get("rate_hz"), begin_s, 0.0, late_s, drift_ppm, jitter_s, loss))


def outcome(kind: str, case: str, rec: Recording, truth: tuple | None, seed: list[int]) -> Outcome:
    rng = np.random.default_rng(seed)
    clocks = clocks_of(case, rng)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        if case == ONE_FILE:
            write_csv(folder / "both.csv", rec)
            lines, begin_s = said(folder / "both.csv"), float(rec.t_s[0])
        else:
            for rows, file in zip(split(rec, clocks, rng), ("one.csv", "two.csv"), strict=True):
                write(folder / file, rows)
            lines, begin_s = said(folder / "one.csv", folder / "two.csv"), 0.0
    end = lines[-1]
    true_s = lag_s(clocks, end["t_s"] - begin_s)
    errors = [(line, errors_of(line, truth)) for line in lines] if truth else []
    ready = [line["t_s"] - begin_s for line in lines if line["event"] == "ready"]
    return Outcome(kind, case, end["status"], ready[0] if ready else np.inf,
                   np.nan if end["lag_s"] is None else abs(end["lag_s"] - true_s), end.get("lag_uncertainty_s") or np.nan,
                   [end["axis1"], end["axis2"]], tuple(end["uncertainty_deg"] or (90.0, 90.0)), errors[-1][1] if truth else (np.nan, np.nan),
                   any(line["ready_for"] == "axes" and line["status"] == "ready" and max(e) > FALSE_DEG for line, e in errors))


def measure_part(job: tuple[str, int, int]) -> list[Outcome]:
    """A part of a recording, in all cases."""
    name, index, count = job
    rec = recording(name)
    span_s = float(rec.t_s[-1] - rec.t_s[0])
    begin_s = max(span_s - PART_S, 0.0) * index / max(count - 1, 1)
    rows = np.flatnonzero((rec.t_s - rec.t_s[0] >= begin_s) & (rec.t_s - rec.t_s[0] < begin_s + PART_S))
    part = cut(rec, rows[0], rows[-1] + 1)
    is_rig = name in RIG_HINGES
    truth = nominal_axes(name) if is_rig else None
    return [outcome("rig" if is_rig else "people", case, part, truth, [1, index, number_of]) for number_of, case in enumerate(CASES)]


def measure_simulated(seed: int) -> list[Outcome]:
    rec = simulate_hinge(HingeSpec((("7", 40.0),), rate_hz=100.0, seed=seed, gyr_bias_deg_s=0.3, acc_bias=0.1, soft_tissue_deg=0.5))
    return [outcome("simulated", case, rec, (rec.axis1, rec.axis2), [2, seed, number_of]) for number_of, case in enumerate(CASES)]


def measure_unrelated(job: tuple[tuple[str, ...], int]) -> tuple[bool, bool]:
    """A sensor of one recording beside one of another: whether a lag was told, and whether it was ever ready."""
    names, index = job
    rng = np.random.default_rng([3, index])
    parts = []
    for name in rng.choice(names, 2, replace=False):
        rec = recording(name)
        begin = int(rng.integers(0, max(int(np.searchsorted(rec.t_s, rec.t_s[-1] - PART_S)), 1)))
        parts.append(cut(rec, begin, int(np.searchsorted(rec.t_s, rec.t_s[begin] + PART_S))))
    with tempfile.TemporaryDirectory() as folder:
        for k, part in enumerate(parts):
            write(Path(folder) / f"{k}.csv", split(part, (Clock(), Clock()), rng)[k])
        lines = said(Path(folder) / "0.csv", Path(folder) / "1.csv")
    return any(line["lag_s"] is not None for line in lines), any(line["status"] == "ready" for line in lines)


def measure_gait(job: tuple[str, str, int]) -> tuple[bool, bool]:
    """A person whose motion repeats itself, files that begin further apart than a lag: whether a lag was told, and whether it is wrong."""
    joint, activity, seed = job
    rng = np.random.default_rng([4, seed])
    clocks = (Clock(), Clock(lag_s=float(rng.choice([-1.0, 1.0]) * rng.uniform(*FAR_S))))
    rec = simulate_person(PersonSpec(((activity, PART_S),), joint, seed=seed))
    with tempfile.TemporaryDirectory() as folder:
        files = [Path(folder) / name for name in ("one.csv", "two.csv")]
        for rows, file in zip(split(rec, clocks, rng), files, strict=True):
            write(file, rows)
        told_s = said(*files)[-1]["lag_s"]
    return told_s is not None, told_s is not None and abs(told_s - lag_s(clocks, 0.0)) > WRONG_S


def apart_deg(one: Outcome, other: Outcome) -> float:
    """The larger angle between the axes of both."""
    if None in (*one.axes, *other.axes):
        return np.nan
    return max(float(line_angle_deg(np.array(a), np.array(b))) for a, b in zip(one.axes, other.axes, strict=True))


def row_of(kind: str, case: str, runs: list[list[Outcome]]) -> list:
    at = list(CASES).index(case)
    mine = [run[at] for run in runs if run[at].kind == kind]
    known = [o for o in mine if o.has_lag]
    ready = [o for o in mine if o.is_ready]
    beside = [apart_deg(run[0], run[at]) for run in runs if run[at].kind == kind and run[0].is_ready and run[at].is_ready]
    errors = [e for o in ready for e in o.errors_deg if not np.isnan(e)]
    covered = [e <= b for o in ready for e, b in zip(o.errors_deg, o.bounds_deg, strict=True) if not np.isnan(e)]
    return [kind, case, len(mine), percent(len(known), len(mine)), number(1e3 * median([o.lag_error_s for o in known]), 1),
            number(1e3 * quantile([o.lag_error_s for o in known], 0.95), 1), number(1e3 * median([o.lag_bound_s for o in known]), 1),
            percent(sum(o.is_over for o in known), len(known)), percent(len(ready), len(mine)),
            number(quantile([o.first_s for o in mine], 0.5), 1), number(median(errors), 2), percent(sum(covered), len(covered)),
            sum(o.is_false for o in mine) if kind != "people" else "-", number(median(beside), 2), number(max(beside, default=np.nan), 1)]


def measure(settings: Settings, report: Report) -> None:
    starts = settings.count(STARTS, 1)
    names = available(*RIG_HINGES[: 1 if settings.quick else None], *PEOPLE[: 1 if settings.quick else None])
    jobs = [(name, k, starts) for name in names for k in range(starts)]
    runs = run_jobs(measure_part, jobs, "recordings", settings)
    runs += run_jobs(measure_simulated, list(range(settings.count(SIMULATIONS, 1))), "simulated", settings)
    report.text(f"Parts of {PART_S:g} s of recordings of hinges, and simulated hinges of 40 s, written as one file and split into two. Lag: the times "
                f"of sensor 2 are wrong by up to {1e3 * LAG_MAX_S:g} ms, both ways; begun apart: by up to {APART_MAX_S:g} s; drift: by up to {DRIFT_MAX_PPM:g} ppm more; jitter: {1e3 * JITTER_S:g} ms "
                f"rms in the times of both sensors; losses: {100 * LOSS:g} % of the readings of both. Other rates by interpolation. Everything else is "
                "the recording. Lag error: at the end; what the recording's own sensors are out of step by is in it, and a bound of one file is not "
                "told. Error and coverage: both axes, at the end, of those that are ready. Beside: the larger angle between the axes of both files "
                "and those of the one, where both are ready.")
    kinds = [kind for kind in ("rig", "people", "simulated") if any(run[0].kind == kind for run in runs)]
    report.table(["data", "files", "runs", "lag known", "lag error, median, ms", "95 %", "bound, median, ms", "over", "ready", "first ready, median, s",
                  "error, median, deg", "covered", "false ready", "beside one file, median, deg", "largest"],
                 [row_of(kind, case, runs) for kind in kinds for case in CASES])
    if len(names) > 1:
        apart = run_jobs(measure_unrelated, [(tuple(names), k) for k in range(settings.count(UNRELATED, 4))], "unrelated", settings)
        report.text(f"Unrelated: a sensor of one of these recordings beside one of another, {PART_S:g} s.")
        report.require_none("unrelated files whose lag was told", sum(told for told, _ in apart), len(apart))
        report.require_none("unrelated files that were ever ready", sum(ready for _, ready in apart), len(apart))
    gait = run_jobs(measure_gait, [(*kind, seed) for kind in GAIT_KINDS for seed in range(settings.count(GAIT, 1))], "gait", settings)
    report.text(f"Gait: simulated people who walk or run, {PART_S:g} s, files {FAR_S[0]:g} to {FAR_S[1]:g} s apart, which is more than the search "
                f"reaches in part. A lag is told in {percent(sum(told for told, _ in gait), len(gait))} of {len(gait)}.")
    report.require_none(f"lags of gait that are wrong by more than {1e3 * WRONG_S:g} ms", sum(wrong for _, wrong in gait), len(gait))
    split_runs = [o for run in runs for o in run[1:]]
    known = [o for o in split_runs if o.has_lag]
    true = [o for o in split_runs if o.kind != "people"]
    report.require_none("false ready of two files", sum(o.is_false for o in true), len(true))
    report.require_none("ready although the lag is not known", sum(o.is_ready and not o.has_lag for o in split_runs), len(split_runs))
    report.require_most("median error of the lag", 1e3 * median([o.lag_error_s for o in known]), LAG_LIMIT_MS, " ms")
    report.require_most("share of lags beyond their bound", sum(o.is_over for o in known) / max(len(known), 1), OVER_MAX)
    ready = [o for o in split_runs if o.is_ready and o.kind == "simulated"]
    for k in (0, 1):
        report.require_share(f"axis {k + 1} of simulated hinges within its bound", sum(o.errors_deg[k] <= o.bounds_deg[k] for o in ready), len(ready),
                             COVERAGE)
