"""The engines of the joint centre of the C library over whole arrays, through ctypes.

    track = run(recording)
    track = run(recording, method="sa", n_max=2000)
    track = run(recording, orientations=(q1, q2), method="ls")
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass

import numpy as np

from .native import MOVED, READY, REJECTIONS, library, microseconds
from .recordings import Recording

COLUMNS = 28
WORDS = {"method": ("ss", "sa", "ls"), "derivative": ("five-point", "symmetric")}
UNKNOWN_M = 10.0


class Options(ctypes.Structure):
    """jcal_batch_center_options_t of tools/native/batch_center.h."""

    _fields_ = [("method", ctypes.c_int32), ("derivative", ctypes.c_int32), ("smoothing_s", ctypes.c_float), ("max_bound_m", ctypes.c_float),
                ("mismatch_m", ctypes.c_float), ("rate_mismatch", ctypes.c_float), ("acc_noise_m_s2", ctypes.c_float), ("turn_error", ctypes.c_float),
                ("acc_bias_m_s2", ctypes.c_float), ("min_rate_rad_s", ctypes.c_float), ("memory_s", ctypes.c_float),
                ("hinge_axis1", ctypes.c_float * 3), ("hinge_axis2", ctypes.c_float * 3), ("n_max", ctypes.c_int32)]


class Input(ctypes.Structure):
    """jcal_batch_center_input_t."""

    _fields_ = [("t_us", ctypes.c_void_p), ("values", ctypes.c_void_p), ("orientations", ctypes.c_void_p),
                ("count", ctypes.c_size_t)]


@dataclass
class Track:
    """What the engine said after each of N samples."""

    t_s: np.ndarray  # (N,) from the first sample
    status: np.ndarray  # (N,) as in native.py
    reason: np.ndarray
    weak: np.ndarray
    r1: np.ndarray  # (N, 3) m, zero before there is an estimate
    r2: np.ndarray
    bounds_m: np.ndarray  # (N, 2), UNKNOWN_M if unknown
    weakest1: np.ndarray  # (N, 3)
    weakest2: np.ndarray
    weakest_bounds_m: np.ndarray  # (N, 2)
    bias1: np.ndarray  # (N, 3) m/s^2
    bias2: np.ndarray
    heading_deg: np.ndarray
    misfit: np.ndarray
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


def options_of(settings: dict[str, float | str | np.ndarray]) -> Options:
    options = Options()
    library().jcal_batch_center_defaults(ctypes.byref(options))
    for name, value in settings.items():
        if name not in dict(Options._fields_):
            raise TypeError(f"'{name}' is not an option")
        if name in WORDS:
            setattr(options, name, WORDS[name].index(value))
        elif name.startswith("hinge"):
            setattr(options, name, (ctypes.c_float * 3)(*value))
        else:
            setattr(options, name, value)
    return options


def run(rec: Recording, orientations: tuple[np.ndarray, np.ndarray] | None = None, **settings: float | str) -> Track:
    """A fresh engine over all samples; settings are the fields of Options, n_max chooses the window engine."""
    options, t_us = options_of(settings), microseconds(rec.t_s)
    data = np.ascontiguousarray(np.hstack([rec.gyr1, rec.acc1, rec.gyr2, rec.acc2]), np.float32)
    turned = None if orientations is None else np.ascontiguousarray(np.hstack(orientations), np.float32)
    rows, rejected = np.zeros((len(data), COLUMNS), np.float32), np.zeros(len(REJECTIONS), np.uint32)
    source = Input(t_us.ctypes.data, data.ctypes.data, None if turned is None else turned.ctypes.data, len(data))
    done = library().jcal_batch_center_run(ctypes.byref(options), ctypes.byref(source),
                                           ctypes.c_void_p(rows.ctypes.data), ctypes.c_void_p(rejected.ctypes.data))
    if done != 0:
        raise RuntimeError(f"jcal_batch_center_run returned {done}")
    out = rows.astype(float)
    status, reason, weak = rows[:, :3].astype(int).T
    return Track(np.asarray(rec.t_s, float) - rec.t_s[0], status, reason, weak, out[:, 4:7], out[:, 7:10], out[:, 10:12],
                 out[:, 12:15], out[:, 15:18], out[:, 18:20], out[:, 20:23], out[:, 23:26], np.degrees(out[:, 26]),
                 out[:, 27], dict(zip(REJECTIONS, rejected.tolist(), strict=True)))
