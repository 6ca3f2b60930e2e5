"""Whole rig recordings: both engines against the nominal axes, each other, and numpy on the same samples."""

from __future__ import annotations

import numpy as np

from .. import native, ols20
from .harness import Report, Settings, number, percent, run_jobs
from .judge import Verdict, judge, line_angle_deg, need_rig, nominal_axes, recording

TITLE = "Rig recordings, whole"
NOMINAL_DEG = 1.2  # about how well the sockets hold the sensors
ENGINES_DEG = 0.4
NUMPY_DEG = 0.05
WINDOWS = ((500, 21), (500, 10), (1000, 21), (1000, 10))  # n_max, half_window; the first is the default


def solve_numpy(name: str, gyr_ids: np.ndarray, acc_ids: np.ndarray) -> ols20.Solution:
    return ols20.solve_on_indices(recording(name), gyr_ids, acc_ids)


def apart_deg(one: tuple[np.ndarray, np.ndarray], other: tuple[np.ndarray, np.ndarray]) -> float:
    """The larger of the two angles between axes."""
    return max(float(line_angle_deg(a, b)) for a, b in zip(one, other, strict=True))


def selection_row(name: str, n_max: int, half_window: int, track: native.Track) -> dict:
    """The window engine's samples and axes beside those of the batch algorithms in numpy."""
    rec = recording(name)
    acc_min = native.make_options().acc_min
    gyr = ols20.algorithm2(rec.gyr1, rec.gyr2, n_max, half_window)
    acc = ols20.algorithm3(rec, n_max, half_window, min_acc=acc_min)
    same = solve_numpy(name, track.gyr_ids, track.acc_ids)
    batch = solve_numpy(name, gyr, acc)
    return {
        "gyr_overlap": len(np.intersect1d(gyr, track.gyr_ids)) / len(gyr),
        "acc_overlap": len(np.intersect1d(acc, track.acc_ids)) / len(acc),
        "numpy_deg": apart_deg((track.axis1[-1], track.axis2[-1]), (same.j1, same.j2)),
        "batch_deg": apart_deg((same.j1, same.j2), (batch.j1, batch.j2)),
    }


def measure_recording(name: str) -> dict:
    rec, axes = recording(name), nominal_axes(name)
    stream = native.run(rec)
    found = {"name": name, "stream": judge(stream, *axes), "windows": {}}
    for n_max, half_window in WINDOWS:
        track = native.run(rec, engine="window", n_max=n_max, half_window=half_window)
        apart = [float(line_angle_deg(a, b)) for a, b in ((stream.axis1[-1], track.axis1[-1]),
                                                          (stream.axis2[-1], track.axis2[-1]))]
        found["windows"][n_max, half_window] = {"verdict": judge(track, *axes), "apart_deg": apart,
                                                **selection_row(name, n_max, half_window, track)}
    return found


def accuracy_row(name: str, engine: str, verdict: Verdict) -> list[str]:
    worst = verdict.errors_deg[verdict.ready].max() if verdict.ready.any() else np.nan
    return [name, engine, *(number(x) for x in verdict.errors_deg[-1]), *(number(x) for x in verdict.bounds_deg[-1]),
            "wrong" if verdict.wrong_sign[-1] else "right", "yes" if verdict.ready[-1] else "no",
            number(verdict.first_ready_s()), number(worst),
            number(float(verdict.t_s[verdict.accepted.argmax()])) if verdict.accepted.any() else "-"]


def measure(settings: Settings, report: Report) -> None:
    found = run_jobs(measure_recording, need_rig(), "rig", settings)
    report.text("Errors against the nominal axes (+y, +y), in degrees, at the end. `n` is the window engine's n_max, "
                "`w` its window in samples: 43 is the paper's text, 21 its 0.42 s. `accepted` is when Algorithm 4 "
                "accepts for the first time.")
    rows = []
    for result in found:
        rows.append(accuracy_row(result["name"], "stream", result["stream"]))
        rows += [accuracy_row(result["name"], f"window, n {n_max}, w {2 * half + 1}", window["verdict"])
                 for (n_max, half), window in result["windows"].items()]
    report.table(["recording", "engine", "error 1", "error 2", "bound 1", "bound 2", "pairing", "ready at end",
                  "first ready, s", "worst error while ready", "accepted, s"], rows)
    report.text("The window engine's selected samples beside those of Algorithms 2 and 3 on the whole recording at once "
                "(numpy), and axes in degrees: the engine's against numpy's on the same samples, numpy's on either "
                "selection against each other, stream against window engine.")
    report.table(["recording", "n_max", "window", "gyr overlap", "acc overlap", "engine - numpy", "incremental - batch",
                  "stream - window 1", "stream - window 2"],
                 [[result["name"], n_max, 2 * half + 1, percent(window["gyr_overlap"], 1),
                   percent(window["acc_overlap"], 1), number(window["numpy_deg"], 4), number(window["batch_deg"], 3),
                   *(number(x) for x in window["apart_deg"])]
                  for result in found for (n_max, half), window in result["windows"].items()])
    check(found, report)


def check(found: list[dict], report: Report) -> None:
    """The requirements are about the default configuration; numpy must agree with all of them."""
    for engine in ("stream", "window"):
        verdicts = [result["stream"] if engine == "stream" else result["windows"][WINDOWS[0]]["verdict"]
                    for result in found]
        report.require_most(f"{engine}: largest error", max(v.errors_deg[-1].max() for v in verdicts), NOMINAL_DEG,
                            " deg")
        report.require_none(f"{engine}: wrong pairings", sum(bool(v.wrong_sign[-1]) for v in verdicts), len(verdicts))
    report.require_most("stream and window engine apart",
                        max(max(result["windows"][WINDOWS[0]]["apart_deg"]) for result in found), ENGINES_DEG, " deg")
    report.require_most("window engine and numpy on the same samples apart",
                        max(window["numpy_deg"] for result in found for window in result["windows"].values()),
                        NUMPY_DEG, " deg")
