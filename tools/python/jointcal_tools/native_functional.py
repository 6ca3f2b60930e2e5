"""The functional joint of the C library over whole arrays, through ctypes.

    track = run(recording)
    track.ready, track.axis1, track.flexion_deg
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass

import numpy as np

from .native import READY, SIGN_HINTS, Input, library, microseconds, reason_name, values
from .recordings import Recording

COLUMNS = 40
NAMES = ("evidence_turn", "evidence_rate", "evidence_lever", "opposite", "share", "bend_rad", "stiffness", "lack", "speed2",
         "sums_s", "turn2", "rate2", "lever2", "gravity_off", "motion_s", "energy")


class Options(ctypes.Structure):
    """jcal_batch_functional_options_t of tools/native/batch_functional.h."""

    _fields_ = [("max_bound_rad", ctypes.c_float), ("max_flexion_rad", ctypes.c_float), ("slices_per_s", ctypes.c_float),
                ("sign_hint", ctypes.c_int32), ("either", ctypes.c_int32), ("begin", ctypes.c_int32),
                ("hold", ctypes.c_int32)]


class Output(ctypes.Structure):
    _fields_ = [("rows", ctypes.c_void_p), ("flexion", ctypes.c_void_p), ("turns", ctypes.c_void_p), ("row_count", ctypes.c_uint64)]


@dataclass
class Track:
    """What the joint said at each of M ticks, and the angle at each of N samples."""

    t_s: np.ndarray  # (M,) from the first sample
    sample: np.ndarray  # (M,) number of the sample
    status: np.ndarray
    reason: np.ndarray
    weak: np.ndarray
    hint: np.ndarray
    axis1: np.ndarray  # (M, 3)
    axis2: np.ndarray
    bounds_deg: np.ndarray  # (M, 2)
    flexion_bound_deg: np.ndarray  # (M,)
    for_axes: np.ndarray
    for_flexion: np.ndarray
    is_functional: np.ndarray
    heading_deg: np.ndarray
    r1: np.ndarray  # (M, 3), m
    r2: np.ndarray
    inside: dict[str, np.ndarray]  # what it is judged by, NAMES
    flexion_deg: np.ndarray  # (N,)
    q1: np.ndarray  # (N, 4) sensors to their level frames
    q2: np.ndarray

    @property
    def ready(self) -> np.ndarray:
        return self.status == READY

    def first_ready_s(self) -> float:
        return float(self.t_s[self.ready.argmax()]) if self.ready.any() else float("inf")


def run(rec: Recording, max_bound_deg: float | None = None, max_flexion_deg: float | None = None,
        slices_per_s: float | None = None, sign_hint: str = "unknown", either: bool = False, begin: int = 0, hold: int = 0) -> Track:
    """A fresh instance over the whole recording; `either`: what both models say together. Samples before `begin` go to the
    sensors' filters only. From sample `hold` on, if it is not 0, axes stay as they are and only the heading is followed."""
    lib = library()
    options = Options()
    lib.jcal_batch_functional_defaults(ctypes.byref(options))
    if max_bound_deg is not None:
        options.max_bound_rad = np.radians(max_bound_deg)
    if max_flexion_deg is not None:
        options.max_flexion_rad = np.radians(max_flexion_deg)
    if slices_per_s is not None:
        options.slices_per_s = slices_per_s
    options.sign_hint, options.either, options.begin, options.hold = SIGN_HINTS[sign_hint], int(either), begin, hold
    data, t_us = values(rec), microseconds(rec.t_s)
    rows = np.zeros((len(data), COLUMNS), np.float32)
    flexion, turns = np.zeros(len(data), np.float32), np.zeros((len(data), 8), np.float32)
    source = Input(t_us.ctypes.data, data.ctypes.data, len(data))
    out = Output(rows.ctypes.data, flexion.ctypes.data, turns.ctypes.data, 0)
    done = lib.jcal_batch_functional(ctypes.byref(options), ctypes.byref(source), ctypes.byref(out))
    if done != 0:
        raise RuntimeError(f"jcal_batch_functional returned {done}")
    rows = rows[: out.row_count].astype(float)
    sample = rows[:, 39].astype(int)
    status, reason, weak, hint = rows[:, :4].astype(int).T
    return Track((np.asarray(rec.t_s, float) - rec.t_s[0])[sample], sample, status, reason, weak, hint, rows[:, 4:7], rows[:, 7:10],
                 np.degrees(rows[:, 10:12]), np.degrees(rows[:, 12]), rows[:, 13] > 0, rows[:, 14] > 0, rows[:, 15] > 0,
                 np.degrees(rows[:, 16]), rows[:, 17:20], rows[:, 20:23], dict(zip(NAMES, rows[:, 23:39].T, strict=True)),
                 np.degrees(flexion.astype(float)), turns[:, :4].astype(float), turns[:, 4:].astype(float))


__all__ = ["Track", "run", "reason_name"]
