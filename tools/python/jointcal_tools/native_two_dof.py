"""The 2-DoF engines and VQF of the C library over whole arrays, through ctypes.

    q1, q2 = orientations(recording)
    track = run(recording.t_s, q1, q2, constraint="rotation")
    track, kept_us = run_window(recording.t_s, q1, q2, constraint="orientation", n_max=200)
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass

import numpy as np

from .native import MOVED, READY, REJECTIONS, library, microseconds
from .recordings import Recording

COLUMNS = 15
CONSTRAINTS = {"combined": 0, "rotation": 1, "orientation": 2}


class Options(ctypes.Structure):
    """jcal_batch_two_dof_options_t of tools/native/batch_two_dof.h."""

    _fields_ = [("constraint", ctypes.c_int32), ("max_bound_rad", ctypes.c_float), ("mismatch_rad", ctypes.c_float),
                ("memory_s", ctypes.c_float)]


class Input(ctypes.Structure):
    _fields_ = [("t_us", ctypes.c_void_p), ("values", ctypes.c_void_p), ("count", ctypes.c_size_t)]


class WindowOut(ctypes.Structure):
    """jcal_batch_two_dof_window_out_t."""

    _fields_ = [("rows", ctypes.c_void_p), ("rejected_by", ctypes.c_void_p), ("kept_us", ctypes.c_void_p),
                ("kept_count", ctypes.c_uint64)]


@dataclass
class Track:
    """What the engine said after each of N samples."""

    t_s: np.ndarray  # (N,) from the first sample
    status: np.ndarray  # (N,) as in native.py
    reason: np.ndarray
    weak: np.ndarray
    axis1: np.ndarray  # (N, 3), zero before there is an estimate
    axis2: np.ndarray
    heading_deg: np.ndarray  # (N,)
    carrying_deg: np.ndarray
    bounds_deg: np.ndarray  # (N, 3) axis1, axis2, heading
    rejected_by: dict[str, int]

    @property
    def ready(self) -> np.ndarray:
        return self.status == READY

    @property
    def moved(self) -> np.ndarray:
        """Samples at which `moved` was entered."""
        return np.flatnonzero((self.status[1:] == MOVED) & (self.status[:-1] != MOVED)) + 1

    def first_ready(self) -> int | None:
        return int(self.ready.argmax()) if self.ready.any() else None


def has_vqf() -> bool:
    return vqf(np.zeros((1, 6)), 0.01) is not None


def vqf(values: np.ndarray, period_s: float) -> np.ndarray | None:
    """Orientations (N, 4), sensor to earth, from rates and specific forces (N, 6); None if built without VQF."""
    data = np.ascontiguousarray(values, np.float32)
    out = np.zeros((len(data), 4), np.float32)
    done = library().jcal_batch_vqf(ctypes.c_void_p(data.ctypes.data), ctypes.c_size_t(len(data)),
                                    ctypes.c_float(period_s), ctypes.c_void_p(out.ctypes.data))
    return out if done == 0 else None


def orientations(rec: Recording) -> tuple[np.ndarray, np.ndarray]:
    """Of both sensors by VQF. RuntimeError if the library was built without it."""
    found = [vqf(np.hstack([gyr, acc]), 1.0 / rec.rate_hz) for gyr, acc in ((rec.gyr1, rec.acc1), (rec.gyr2, rec.acc2))]
    if found[0] is None or found[1] is None:
        raise RuntimeError("the library was built without VQF: run tools/vqf.sh and build again")
    return found[0], found[1]


def options_of(settings: dict[str, float | str]) -> Options:
    options = Options()
    library().jcal_batch_two_dof_defaults(ctypes.byref(options))
    for name, value in settings.items():
        if name not in dict(Options._fields_):
            raise TypeError(f"'{name}' is not an option")
        setattr(options, name, CONSTRAINTS[value] if name == "constraint" else value)
    return options


def track_of(t_s: np.ndarray, rows: np.ndarray, rejected: np.ndarray) -> Track:
    status, reason, weak = rows[:, :3].astype(int).T
    return Track(np.asarray(t_s, float) - t_s[0], status, reason, weak, rows[:, 4:7].astype(float),
                 rows[:, 7:10].astype(float), np.degrees(rows[:, 10].astype(float)), np.degrees(rows[:, 11].astype(float)),
                 np.degrees(rows[:, 12:15].astype(float)), dict(zip(REJECTIONS, rejected.tolist(), strict=True)))


def run(t_s: np.ndarray, q1: np.ndarray, q2: np.ndarray, **settings: float | str) -> Track:
    """A fresh stream engine over all orientations; settings are the fields of Options."""
    options = options_of(settings)
    data, t_us = np.ascontiguousarray(np.hstack([q1, q2]), np.float32), microseconds(t_s)
    rows = np.zeros((len(data), COLUMNS), np.float32)
    rejected = np.zeros(len(REJECTIONS), np.uint32)
    source = Input(t_us.ctypes.data, data.ctypes.data, len(data))
    done = library().jcal_batch_two_dof_run(ctypes.byref(options), ctypes.byref(source),
                                            ctypes.c_void_p(rows.ctypes.data), ctypes.c_void_p(rejected.ctypes.data))
    if done != 0:
        raise RuntimeError(f"jcal_batch_two_dof_run returned {done}")
    return track_of(t_s, rows, rejected)


def run_window(t_s: np.ndarray, q1: np.ndarray, q2: np.ndarray, constraint: str = "rotation", n_max: int = 200,
               **settings: float) -> tuple[Track, np.ndarray]:
    """A fresh window engine over all orientations, and the times (us) of its buffer at the end, oldest first."""
    options = options_of({"constraint": constraint, **settings})
    data, t_us = np.ascontiguousarray(np.hstack([q1, q2]), np.float32), microseconds(t_s)
    rows = np.zeros((len(data), COLUMNS), np.float32)
    rejected, kept_us = np.zeros(len(REJECTIONS), np.uint32), np.zeros(n_max, np.uint64)
    source = Input(t_us.ctypes.data, data.ctypes.data, len(data))
    out = WindowOut(rows.ctypes.data, rejected.ctypes.data, kept_us.ctypes.data, 0)
    done = library().jcal_batch_two_dof_window_run(ctypes.byref(options), ctypes.c_uint32(n_max), ctypes.byref(source),
                                                   ctypes.byref(out))
    if done != 0:
        raise RuntimeError(f"jcal_batch_two_dof_window_run returned {done}")
    return track_of(t_s, rows, rejected), kept_us[: out.kept_count]
