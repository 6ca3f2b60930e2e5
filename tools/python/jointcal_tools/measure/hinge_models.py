"""Rigid and functional model of a hinge on the rig, each alone and as `jointcal hinge` has them: windows, biases, noise, lag."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from .. import native
from .. import native_functional as functional
from ..recordings import Recording
from .bias import biased
from .harness import Report, Settings, median, number, percent, run_jobs
from .judge import INFORMATIVE_RAD_S, MAX_ERROR_DEG, axis_errors, cut, joint_rate_rms, need_rig, nominal_axes, recording

TITLE = "Two models of a hinge on the rig"
LENGTHS_S = (3, 5, 10)
NOISE = (0.1, 0.5)  # rad/s, m/s^2
LATE_S = 0.02
MODELS = ("rigid", "functional", "either")
QUICK_STEP = 6


def noisy(rec: Recording, rng: np.random.Generator) -> Recording:
    gyr, acc = (size * rng.standard_normal((2, len(rec), 3)) for size in NOISE)
    return replace(rec, gyr1=rec.gyr1 + gyr[0], acc1=rec.acc1 + acc[0], gyr2=rec.gyr2 + gyr[1], acc2=rec.acc2 + acc[1])


def late(rec: Recording, _: np.random.Generator) -> Recording:
    def then(signal: np.ndarray) -> np.ndarray:
        return np.column_stack([np.interp(rec.t_s - LATE_S, rec.t_s, column) for column in signal.T])

    return replace(rec, gyr2=then(rec.gyr2), acc2=then(rec.acc2))


# What is done to a window, and the lengths that it is asked of.
CHANGES: dict[str, tuple[Callable | None, tuple[int, ...]]] = {
    "as they are": (None, LENGTHS_S), "biases of 1 deg/s and 1 m/s^2": (biased, (5, 10)),
    "noise of 0.1 rad/s and 0.5 m/s^2": (noisy, (5,)), "sensor 2 late by 20 ms": (late, (5,)),
}


@dataclass
class Outcome:
    change: str
    length_s: int
    model: str
    ready: bool  # at the end
    wrong: bool  # ready at any time and beyond the limit, or the wrong pairing
    covered: bool | None  # both axes within their bounds whenever ready
    first_s: float
    bound_deg: float  # at the end, if ready
    error_deg: float


def run_model(model: str, rec: Recording) -> native.Track | functional.Track:
    return native.run(rec) if model == "rigid" else functional.run(rec, either=model == "either")


def for_axes(track: native.Track | functional.Track) -> np.ndarray:
    return track.ready & track.for_axes if isinstance(track, functional.Track) else track.ready


def measure_window(job: tuple[str, str, int, int]) -> list[Outcome]:
    change, name, length_s, index = job
    rec, axes = recording(name), nominal_axes(name)
    count = round(length_s * rec.rate_hz)
    part = cut(rec, index * count, (index + 1) * count)
    if joint_rate_rms(part, *axes) <= INFORMATIVE_RAD_S:
        return []
    how = CHANGES[change][0]
    part = how(part, np.random.default_rng([index, length_s, 3536])) if how else part
    found = []
    for model in MODELS:
        track = run_model(model, part)
        errors, other = axis_errors(track, *axes)
        ready, off = for_axes(track), errors.max(axis=1)
        inside = ((errors <= track.bounds_deg).all(axis=1) & ~other)[ready]
        found.append(Outcome(change, length_s, model, bool(ready[-1]), bool((ready & (other | (off > MAX_ERROR_DEG))).any()),
                             bool(inside.all()) if ready.any() else None, float(track.t_s[ready.argmax()]) if ready.any() else np.inf,
                             float(track.bounds_deg[-1].max()), float(off[-1])))
    return found


def measure(settings: Settings, report: Report) -> None:
    jobs = [(change, name, length_s, index) for change, (_, lengths) in CHANGES.items() for length_s in lengths for name in need_rig()
            for index in range(int(len(recording(name)) // round(length_s * recording(name).rate_hz)))]
    jobs = jobs[:: QUICK_STEP if settings.quick else 1]
    outcomes = [o for found in run_jobs(measure_window, jobs, "hinge_models", settings) for o in found]
    report.text(f"Consecutive informative windows (rms joint rate above {INFORMATIVE_RAD_S} rad/s) of rig_1D_01, 02 and 04, a fresh instance each, ready for "
                f"axes to {MAX_ERROR_DEG:g} deg. Rigid: jcal_hinge_t alone; functional: the model of people alone; either: what `jointcal hinge` says. Ready: at "
                f"the end. Wrong: ready at any time with an axis more than {MAX_ERROR_DEG:g} deg off or the other pairing. Covered: both axes inside their bounds "
                "whenever ready, of the windows that were ever ready; the sockets hold the sensors to about 1 deg, which no bound can know. Bound and error: median at the end of those that are ready, the worse axis, deg.")
    rows = []
    for change, (_, lengths) in CHANGES.items():
        for length_s in lengths:
            for model in MODELS:
                mine = [o for o in outcomes if (o.change, o.length_s, o.model) == (change, length_s, model)]
                ever = [o for o in mine if o.covered is not None]
                ended = [o for o in mine if o.ready]
                rows.append([change, f"{length_s} s", model, len(mine), percent(len(ended), len(mine)), sum(o.wrong for o in mine),
                             percent(sum(bool(o.covered) for o in ever), len(ever)), number(median([o.first_s for o in ever])),
                             number(median([o.bound_deg for o in ended])), number(median([o.error_deg for o in ended]))])
    report.table(["windows", "length", "model", "number", "ready", "wrong", "covered", "first ready, s", "bound", "error"], rows)
    for model in ("rigid", "either"):
        mine = [o for o in outcomes if o.model == model]
        report.require_none(f"{model}: wrong", sum(o.wrong for o in mine), len(mine))
