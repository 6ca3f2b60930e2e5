"""Hip and knee of the C library over whole arrays, through ctypes.

    track = run(t_s, [gyr1, gyr2, gyr3], [acc1, acc2, acc3], segment_length_m=0.42)
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass

import numpy as np

from . import native_center as center
from .native import READY, library, microseconds

COLUMNS = 24


class Options(ctypes.Structure):
    """jcal_batch_chain_options_t of tools/native/batch_chain.h."""

    _fields_ = [("center", center.Options), ("segment_length_m", ctypes.c_float), ("segment_tolerance_m", ctypes.c_float),
                ("plane_normal", ctypes.c_float * 3), ("plane_tolerance_m", ctypes.c_float)]


class Input(ctypes.Structure):
    """jcal_batch_chain_input_t."""

    _fields_ = [("t_us", ctypes.c_void_p), ("values", ctypes.c_void_p), ("orientations", ctypes.c_void_p),
                ("count", ctypes.c_size_t)]


@dataclass
class Track:
    """Results after every so many samples, N of them."""

    t_s: np.ndarray  # (N,)
    status: np.ndarray
    reason: np.ndarray
    weak: np.ndarray
    places: np.ndarray  # (N, 4, 3) m: hip to pelvis, hip to thigh, knee to thigh, knee to shank
    bounds_m: np.ndarray  # (N, 4)
    segment_m: np.ndarray  # (N,)
    segment_bound_m: np.ndarray
    joint_status: np.ndarray  # (N, 2)

    @property
    def ready(self) -> np.ndarray:
        return self.status == READY


def run(t_s: np.ndarray, gyr: list[np.ndarray], acc: list[np.ndarray], q: list[np.ndarray] | None = None,
        every: int = 10, **settings: float | str | np.ndarray) -> Track:
    """A fresh instance over all samples; settings are the fields of Options or of native_center.Options."""
    options = Options()
    library().jcal_batch_chain_defaults(ctypes.byref(options))
    own = {name for name, _ in Options._fields_}
    options.center = center.options_of({k: v for k, v in settings.items() if k not in own})
    for name, value in settings.items():
        if name in own:
            setattr(options, name, (ctypes.c_float * 3)(*value) if name == "plane_normal" else value)
    values = np.ascontiguousarray(np.hstack([part for pair in zip(gyr, acc, strict=True) for part in pair]), np.float32)
    turned = None if q is None else np.ascontiguousarray(np.hstack(q), np.float32)
    times = microseconds(t_s)
    rows = np.zeros((len(values) // every, COLUMNS), np.float32)
    source = Input(times.ctypes.data, values.ctypes.data, None if turned is None else turned.ctypes.data, len(values))
    done = library().jcal_batch_chain_run(ctypes.byref(options), ctypes.byref(source), ctypes.c_uint32(every),
                                          ctypes.c_void_p(rows.ctypes.data))
    if done != 0:
        raise RuntimeError(f"jcal_batch_chain_run returned {done}")
    out = rows.astype(float)
    status, reason, weak = rows[:, :3].astype(int).T
    at = np.asarray(t_s, float)[every - 1:: every][: len(rows)] - t_s[0]
    return Track(at, status, reason, weak, out[:, 4:16].reshape(-1, 4, 3), out[:, 16:20], out[:, 20], out[:, 21],
                 rows[:, 22:24].astype(int))
