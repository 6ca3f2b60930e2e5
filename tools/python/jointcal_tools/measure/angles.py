"""Joint angles of the rig beside optical ones: `jointcal angles` with the axes of the first 20 s, and on its own."""

from __future__ import annotations

import csv
import json
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from .. import native, native_two_dof
from ..recordings import write_csv
from . import optical
from .harness import Report, Settings, Skipped, median, number, quantile, run_jobs
from .judge import available, cut, line_angle_deg, nominal_axes, recording
from .people_flexion import wrapped_deg

TITLE = "Joint angles"
TWO_DOF = ("rig_2D_01", "rig_2D_02", "rig_2D_05")
HINGES = ("rig_1D_01", "rig_1D_02", "rig_1D_04")
CALIBRATE_S = 20.0
WINDOW_S = 10.0
MEDIAN_DEG, MOST_DEG, MOST_SHARE = 1.5, 2.5, 0.9
ORIENTATION_COLUMNS = tuple(f"q{sensor}_{part}" for sensor in (1, 2) for part in "wxyz")


def orientations(name: str) -> np.ndarray:
    """(N, 8) by VQF, each sensor with a heading of its own."""
    import qmt  # noqa: PLC0415
    rec = recording(name)
    sensors = ((rec.gyr1, rec.acc1), (rec.gyr2, rec.acc2))
    return np.hstack([qmt.oriEstVQF(np.ascontiguousarray(gyr), np.ascontiguousarray(acc),
                                    params={"Ts": 1.0 / rec.rate_hz}) for gyr, acc in sensors])


def calibration(name: str, q: np.ndarray) -> dict:
    """A line as `--json` writes it, of the first 20 s; `status` is that of their end."""
    rec = recording(name)
    count = int(CALIBRATE_S * rec.rate_hz)
    if name in HINGES:
        track = native.run(cut(rec, 0, count))
        return {"status": "ready" if track.ready[-1] else "collecting", "axis1": track.axis1[-1].tolist(),
                "axis2": track.axis2[-1].tolist(), "sign_margin": None}
    track = native_two_dof.run(rec.t_s[:count], q[:count, :4], q[:count, 4:])
    return {"status": "ready" if track.ready[-1] else "collecting", "axis1": track.axis1[-1].tolist(),
            "axis2": track.axis2[-1].tolist(), "carrying_angle_deg": float(track.carrying_deg[-1])}


def program() -> Path:
    path = native.REPOSITORY / "build" / "host" / "jointcal"
    if not path.is_file():
        raise Skipped(f"the program is not there; {native.BUILD_HINT}")
    return path


def run_program(recording_file: Path, joint: str, *arguments: str | Path) -> np.ndarray:
    """Angles (N, columns - 1) of `jointcal angles` in degrees; NaN where the row is empty."""
    out = recording_file.with_suffix(".angles.csv")
    result = subprocess.run([program(), "angles", recording_file, "--joint", joint, "--out", out, *arguments], capture_output=True, text=True)
    if result.returncode not in (0, 3):
        raise RuntimeError(f"jointcal angles {recording_file.stem}: {result.stderr}")
    with out.open(newline="") as file:
        rows = list(csv.reader(file))[1:]
    return np.array([[float(cell) if cell else np.nan for cell in row[1:]] for row in rows])


def errors_deg(found: np.ndarray, truth: np.ndarray, good: np.ndarray) -> np.ndarray:
    """Difference without the constant that the mounting leaves open; NaN where either is not known."""
    apart = np.where(good, wrapped_deg(found - truth), np.nan)
    known = apart[np.isfinite(apart)]
    if not len(known):
        return apart
    offset = np.degrees(np.angle(np.exp(1j * np.radians(known)).mean()))
    return wrapped_deg(apart - offset)


def window_rms(errors: np.ndarray, rate_hz: float) -> np.ndarray:
    """RMSE of every whole window at least half of which is known; infinite where it is not."""
    size = int(WINDOW_S * rate_hz)
    parts = [errors[begin:begin + size] for begin in range(0, len(errors) - size + 1, size)]
    return np.array([np.sqrt(np.nanmean(part ** 2)) if np.isfinite(part).mean() >= 0.5 else np.inf for part in parts])


def optical_angles(name: str) -> tuple[np.ndarray, np.ndarray, dict]:
    """Angles (N, 1 or 2) in degrees, where they hold, and facts for the table."""
    one, two = optical.references(recording(name))
    good = one.good & two.good
    hinge = name in HINGES
    j1, j2 = optical.fit_axes(one.q[good], two.q[good], *nominal_axes(name), hinge)
    if hinge:
        angles = optical.hinge_angle(one.q, two.q, j1, j2)[:, None]
    else:
        angles = optical.two_dof_angles(one.q, two.q, j1, j2)[:, [0, 2]]
    facts = {"turns": (one.turn_deg, two.turn_deg), "lags": (one.lag, two.lag), "masked": int((~good).sum()),
             "axes": (j1, j2)}
    return np.degrees(angles), good, facts


def measure_recording(name: str) -> dict:
    rec, q = recording(name), orientations(name)
    truth, good, facts = optical_angles(name)
    line = calibration(name, q)
    begin = int(CALIBRATE_S * rec.rate_hz)
    found = {"name": name, "line": line, "facts": facts, "rms": {}}
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        path, joint = folder / f"{name}.csv", "hinge" if name in HINGES else "two-dof"
        write_csv(path, rec, extra=dict(zip(ORIENTATION_COLUMNS, q.T, strict=True)))
        (folder / "line.json").write_text(json.dumps(line) + "\n")
        alone = run_program(path, joint)
        given = np.full_like(alone, np.nan)
        if line["status"] == "ready":  # the program refuses others
            given = run_program(path, joint, "--calibration", folder / "line.json")
        runs = {"first 20 s": given, "on its own": alone}
    for way, angles in runs.items():
        found["rms"][way] = [window_rms(errors_deg(angles[begin:, k], truth[begin:, k], good[begin:]), rec.rate_hz)
                             for k in range(truth.shape[1])]
    return found


def measure(settings: Settings, report: Report) -> None:
    names = available(*TWO_DOF, *HINGES)
    if len(names) < len(TWO_DOF) + len(HINGES):
        raise Skipped("the rig recordings are not there; JOINTCAL_DATA names their folder")
    try:
        import qmt  # noqa: F401, PLC0415
    except ImportError:
        raise Skipped("orientations need qmt: pip install qmt") from None
    found = run_jobs(measure_recording, names, "angles", settings)
    report.text("Angles after 20 s, against those of the optical references (aligned to the IMUs by the rates, jumps "
                "left out, axes fitted to them, one constant offset per recording and angle). RMSE in degrees over "
                "windows of 10 s; a window without angles counts as infinite. `first 20 s`: `jointcal angles "
                "--calibration` with the axes of the first 20 s and the heading followed; `on its own`: axes (and for "
                "two axes heading) as the engine has them at each moment. Orientations by VQF.")
    rows = []
    for result in found:
        for way, parts in result["rms"].items():
            cells = [number(f(part)) for part in parts for f in (median, lambda x: quantile(x, MOST_SHARE), np.max)]
            rows.append([result["name"], way, len(parts[0]), *cells, *["-"] * (6 - len(cells))])
    report.table(["recording", "axes", "windows", "FE median", "FE 90 %", "FE worst", "PS median", "PS 90 %",
                  "PS worst"], rows)
    facts_table(found, report)
    check(found, report)


def facts_table(found: list[dict], report: Report) -> None:
    report.text("The calibration of the first 20 s: angles of its axes to the optical ones; and what aligning found: "
                "the turns between the frames of marker clusters and IMUs, lags of the optical data in samples.")
    rows = []
    for result in found:
        facts, line = result["facts"], result["line"]
        apart = [float(line_angle_deg(np.array(line[key]), axis))
                 for key, axis in zip(("axis1", "axis2"), facts["axes"], strict=True)]
        rows.append([result["name"], line["status"], *(number(x) for x in apart), *(number(x) for x in facts["turns"]),
                     *(number(x, 1) for x in facts["lags"]), facts["masked"]])
    report.table(["recording", "status", "axis 1, deg", "axis 2, deg", "turn 1, deg", "turn 2, deg", "lag 1", "lag 2",
                  "samples left out"], rows)


def check(found: list[dict], report: Report) -> None:
    for names, label, angles in ((TWO_DOF, "two axes", ("FE", "PS")), (HINGES, "hinge", ("FE",))):
        for k, angle in enumerate(angles):
            windows = np.concatenate([r["rms"]["first 20 s"][k] for r in found if r["name"] in names])
            report.require_most(f"{label}, {angle}: median RMSE", median(windows), MEDIAN_DEG, " deg")
            report.require_most(f"{label}, {angle}: RMSE of 90 % of windows", quantile(windows, MOST_SHARE), MOST_DEG,
                                " deg")
