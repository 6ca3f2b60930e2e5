"""A person's joint with two axes of the C library over whole arrays, through ctypes; of a ball joint everything but the axes.

    track = run(recording)
    track.for_heading, track.r1, track.axis1, track.relative
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass

import numpy as np

from .native import READY, Input, library, microseconds, reason_name, values
from .recordings import Recording

COLUMNS = 35


class Options(ctypes.Structure):
    """jcal_batch_two_axes_options_t of tools/native/batch_two_axes.h."""

    _fields_ = [("max_heading_rad", ctypes.c_float), ("max_lever_m", ctypes.c_float), ("max_bound_rad", ctypes.c_float),
                ("slices_per_s", ctypes.c_float), ("begin", ctypes.c_int32)]


class Output(ctypes.Structure):
    _fields_ = [("rows", ctypes.c_void_p), ("relative", ctypes.c_void_p), ("turns", ctypes.c_void_p), ("row_count", ctypes.c_uint64)]


@dataclass
class Track:
    """What the joint said at each of M ticks, and orientations at each of N samples."""

    t_s: np.ndarray  # (M,) from the first sample
    sample: np.ndarray  # (M,) number of the sample
    status: np.ndarray
    reason: np.ndarray
    weak: np.ndarray
    hint: np.ndarray
    for_heading: np.ndarray
    for_center: np.ndarray  # (M, 2)
    for_axis: np.ndarray  # (M, 2)
    heading_deg: np.ndarray
    heading_bound_deg: np.ndarray
    r1: np.ndarray  # (M, 3), m
    r2: np.ndarray
    lever_bounds_m: np.ndarray  # (M, 2)
    axis1: np.ndarray  # (M, 3)
    axis2: np.ndarray
    axis_bounds_deg: np.ndarray  # (M, 2)
    windows: np.ndarray  # (M, 2)
    left: np.ndarray  # (m/s)^2
    speed2: np.ndarray
    stiffness: np.ndarray
    motion_s: np.ndarray
    is_joint: np.ndarray
    relative: np.ndarray  # (N, 4) sensor 2 in sensor 1
    q1: np.ndarray  # (N, 4) sensors to their level frames
    q2: np.ndarray

    @property
    def ready(self) -> np.ndarray:
        return self.status == READY


def run(rec: Recording, max_heading_deg: float | None = None, max_lever_m: float | None = None, max_bound_deg: float | None = None,
        slices_per_s: float | None = None, begin: int = 0) -> Track:
    """A fresh instance over the whole recording. Samples before `begin` go to the sensors' filters only."""
    lib, options = library(), Options()
    lib.jcal_batch_two_axes_defaults(ctypes.byref(options))
    for name, value in (("max_heading_rad", None if max_heading_deg is None else np.radians(max_heading_deg)), ("max_lever_m", max_lever_m),
                        ("max_bound_rad", None if max_bound_deg is None else np.radians(max_bound_deg)), ("slices_per_s", slices_per_s)):
        if value is not None:
            setattr(options, name, value)
    options.begin = begin
    data, t_us = values(rec), microseconds(rec.t_s)
    rows = np.zeros((len(data), COLUMNS), np.float32)
    relative, turns = np.zeros((len(data), 4), np.float32), np.zeros((len(data), 8), np.float32)
    source = Input(t_us.ctypes.data, data.ctypes.data, len(data))
    out = Output(rows.ctypes.data, relative.ctypes.data, turns.ctypes.data, 0)
    done = lib.jcal_batch_two_axes(ctypes.byref(options), ctypes.byref(source), ctypes.byref(out))
    if done != 0:
        raise RuntimeError(f"jcal_batch_two_axes returned {done}")
    rows = rows[: out.row_count].astype(float)
    sample = rows[:, 34].astype(int)
    status, reason, weak, hint = rows[:, :4].astype(int).T
    flags = rows[:, 4:9] > 0
    return Track((np.asarray(rec.t_s, float) - rec.t_s[0])[sample], sample, status, reason, weak, hint, flags[:, 0], flags[:, 1:3],
                 flags[:, 3:5], np.degrees(rows[:, 9]), np.degrees(rows[:, 10]), rows[:, 11:14], rows[:, 14:17], rows[:, 17:19],
                 rows[:, 19:22], rows[:, 22:25], np.degrees(rows[:, 25:27]), rows[:, 27:29].astype(int), *rows[:, 29:33].T,
                 rows[:, 33] > 0, relative.astype(float), turns[:, :4].astype(float), turns[:, 4:].astype(float))


__all__ = ["Track", "reason_name", "run"]
