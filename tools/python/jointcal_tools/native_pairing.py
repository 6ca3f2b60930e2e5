"""The pairing and the estimate of the lag of the C library over whole arrays, through ctypes.

    found = run(Stream(t1_s, values1), Stream(t2_s, values2))
    found.t_s, found.pairs, found.known, found.lag_s
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass

import numpy as np

from .native import library

ORIGIN_US = 1_000_000  # so that times less a lag are no negative ones


class Input(ctypes.Structure):
    """jcal_batch_pairing_in_t of tools/native/batch_pairing.h."""

    _fields_ = [("which", ctypes.c_void_p), ("t_us", ctypes.c_void_p), ("values", ctypes.c_void_p), ("count", ctypes.c_size_t),
                ("with_lag", ctypes.c_int32), ("period_s", ctypes.c_float), ("gap_s", ctypes.c_float)]


class Output(ctypes.Structure):
    """jcal_batch_pairing_out_t."""

    _fields_ = [("t_us", ctypes.c_void_p), ("pairs", ctypes.c_void_p), ("lags", ctypes.c_void_p), ("room", ctypes.c_size_t),
                ("count", ctypes.c_size_t)]


@dataclass
class Stream:
    """Readings of one sensor; they arrive `late_s` after their times."""

    t_s: np.ndarray  # (N,)
    values: np.ndarray  # (N, 6) rates, specific forces
    late_s: float = 0.0


@dataclass
class Found:
    t_s: np.ndarray  # (M,) of pairs
    pairs: np.ndarray  # (M, 12)
    known: np.ndarray  # (M,) what is known of the lag after each
    lag_s: np.ndarray
    bound_s: np.ndarray
    taken_s: np.ndarray
    left: np.ndarray
    motion_s: np.ndarray


def run(one: Stream, two: Stream, with_lag: bool = True, period_s: float = 0.01, gap_s: float = 0.1) -> Found:
    arrival = np.r_[one.t_s + one.late_s, two.t_s + two.late_s]
    order = np.argsort(arrival, kind="stable")
    which = np.repeat(np.array([1, 2], np.uint8), (len(one.t_s), len(two.t_s)))[order]
    t_us = (np.rint(1e6 * np.r_[one.t_s, two.t_s]) + ORIGIN_US).astype(np.uint64)[order]
    values = np.ascontiguousarray(np.vstack([one.values, two.values])[order], np.float32)
    room = int(np.ptp(arrival) / period_s) + 10
    out_us, pairs, lags = np.zeros(room, np.uint64), np.zeros((room, 12), np.float32), np.zeros((room, 6), np.float32)
    given = Input(which.ctypes.data, t_us.ctypes.data, values.ctypes.data, len(which), with_lag, period_s, gap_s)
    out = Output(out_us.ctypes.data, pairs.ctypes.data, lags.ctypes.data, room, 0)
    done = library().jcal_batch_pairing(ctypes.byref(given), ctypes.byref(out))
    if done != 0:
        raise RuntimeError(f"jcal_batch_pairing returned {done}")
    n = out.count
    known, *rest = lags[:n].astype(float).T
    return Found((out_us[:n].astype(float) - ORIGIN_US) * 1e-6, pairs[:n].astype(float), known > 0.0, *rest)
