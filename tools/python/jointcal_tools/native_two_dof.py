"""The 2-DoF stream engine and VQF of the C library over whole arrays, through ctypes.

    q1, q2 = orientations(recording)
    track = run(recording.t_s, q1, q2, constraint="rotation")
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


def run(t_s: np.ndarray, q1: np.ndarray, q2: np.ndarray, **settings: float | str) -> Track:
    """A fresh stream engine over all orientations; settings are the fields of Options."""
    options = Options()
    library().jcal_batch_two_dof_defaults(ctypes.byref(options))
    for name, value in settings.items():
        if name not in dict(Options._fields_):
            raise TypeError(f"'{name}' is not an option")
        setattr(options, name, CONSTRAINTS[value] if name == "constraint" else value)
    data, t_us = np.ascontiguousarray(np.hstack([q1, q2]), np.float32), microseconds(t_s)
    rows = np.zeros((len(data), COLUMNS), np.float32)
    rejected = np.zeros(len(REJECTIONS), np.uint32)
    source = Input(t_us.ctypes.data, data.ctypes.data, len(data))
    done = library().jcal_batch_two_dof_run(ctypes.byref(options), ctypes.byref(source),
                                            ctypes.c_void_p(rows.ctypes.data), ctypes.c_void_p(rejected.ctypes.data))
    if done != 0:
        raise RuntimeError(f"jcal_batch_two_dof_run returned {done}")
    status, reason, weak = rows[:, :3].astype(int).T
    return Track(np.asarray(t_s, float) - t_s[0], status, reason, weak, rows[:, 4:7].astype(float),
                 rows[:, 7:10].astype(float), np.degrees(rows[:, 10].astype(float)), np.degrees(rows[:, 11].astype(float)),
                 np.degrees(rows[:, 12:15].astype(float)), dict(zip(REJECTIONS, rejected.tolist(), strict=True)))
