"""A remembered hinge of the C library over ticks, through ctypes.

    track = run(ticks1, ticks2, kept)
    track.state[-1], track.motion_s[-1]
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass

import numpy as np

from .native import library
from .native_sensor import COLUMNS, Ticks
from .remember_reference import Kept

ROW = 13
REMEMBERED, CONFIRMED, DROPPED = range(3)
REASONS = ("none", "no_record", "other_sensors", "axes", "places", "sense", "no_motion", "estimate")


class Input(ctypes.Structure):
    """jcal_batch_remember_in_t of tools/native/batch_remember.h."""

    _fields_ = [("t_us", ctypes.c_void_p), ("ticks1", ctypes.c_void_p), ("ticks2", ctypes.c_void_p), ("kept", ctypes.c_void_p),
                ("count", ctypes.c_size_t), ("goes_on", ctypes.c_int32)]


@dataclass
class Track:
    """What was said after each of M pairs of ticks."""

    t_s: np.ndarray
    state: np.ndarray
    reason: np.ndarray
    bounds_deg: np.ndarray  # (M, 2)
    motion_s: np.ndarray
    off_deg: np.ndarray  # (M, 2)
    sigma_deg: np.ndarray
    lack: np.ndarray
    speed_m_s: np.ndarray
    evidence: np.ndarray
    bend_rad: np.ndarray


def rows_of(ticks: Ticks, count: int) -> np.ndarray:
    parts = (ticks.turn.reshape(-1, 9), ticks.rate.reshape(-1, 9), ticks.lever.reshape(-1, 9), ticks.velocity, ticks.gyr,
             ticks.acc_level[:, None], ticks.dt_s[:, None], ticks.since_s[:, None], ticks.epoch[:, None])
    rows = np.ascontiguousarray(np.hstack(parts)[:count], np.float32)
    assert rows.shape[1] == COLUMNS
    return rows


def run(ticks1: Ticks, ticks2: Ticks, kept: Kept, goes_on: bool = False) -> Track:
    """A fresh one; `goes_on`: what was decided is not held to. Both sensors' ticks are of the same times."""
    n = min(len(ticks1.t_s), len(ticks2.t_s))
    has_levers = kept.r1 is not None
    levers = (kept.r1, kept.r2) if has_levers else (np.zeros(3), np.zeros(3))
    facts = np.concatenate([kept.axis1, kept.axis2, np.radians(kept.bounds_deg), *levers, [float(has_levers), float(kept.rigid)]])
    facts = np.ascontiguousarray(facts, np.float32)
    t_us = (np.rint(np.asarray(ticks1.t_s[:n]) * 1e6) + 1e6).astype(np.uint64)
    one, two, rows = rows_of(ticks1, n), rows_of(ticks2, n), np.zeros((n, ROW), np.float32)
    source = Input(t_us.ctypes.data, one.ctypes.data, two.ctypes.data, facts.ctypes.data, n, int(goes_on))
    lib = library()
    lib.jcal_batch_remember.restype = ctypes.c_int32
    done = lib.jcal_batch_remember(ctypes.byref(source), ctypes.c_void_p(rows.ctypes.data))
    if done != 0:
        raise RuntimeError(f"jcal_batch_remember returned {done}")
    rows = rows.astype(float)
    return Track(ticks1.t_s[:n], rows[:, 0].astype(int), rows[:, 1].astype(int), np.degrees(rows[:, 2:4]), rows[:, 4], np.degrees(rows[:, 5:7]),
                 np.degrees(rows[:, 7:9]), rows[:, 9], rows[:, 10], rows[:, 11], rows[:, 12])
