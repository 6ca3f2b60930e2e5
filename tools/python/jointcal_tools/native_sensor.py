"""The sensor stage of the C library over whole arrays, through ctypes.

    found = run(t_s, gyr, acc)
    found.q, found.ticks.turn, found.ticks.velocity
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass

import numpy as np

from .native import library, microseconds

COLUMNS = 37


class Output(ctypes.Structure):
    """jcal_batch_sensor_out_t of tools/native/batch_sensor.h."""

    _fields_ = [("orientations", ctypes.c_void_p), ("biases", ctypes.c_void_p), ("tick_us", ctypes.c_void_p),
                ("ticks", ctypes.c_void_p), ("tick_count", ctypes.c_uint64)]


@dataclass
class Ticks:
    """Features at M ticks; include/jointcal/tick.h says what they are."""

    t_s: np.ndarray  # (M,) from the first sample
    turn: np.ndarray  # (M, 3, 3)
    rate: np.ndarray  # (M, 3, 3) 1/s
    lever: np.ndarray  # (M, 3, 3) 1/s
    velocity: np.ndarray  # (M, 3) m/s
    gyr: np.ndarray  # (M, 3) rad/s
    acc_level: np.ndarray  # (M,) m/s^2
    dt_s: np.ndarray
    since_s: np.ndarray
    epoch: np.ndarray


@dataclass
class Found:
    q: np.ndarray  # (N, 4) sensor to earth, as the features have it
    bias: np.ndarray  # (N, 3) rad/s
    ticks: Ticks


def run(t_s: np.ndarray, gyr: np.ndarray, acc: np.ndarray) -> Found:
    """A fresh sensor over N samples: rates rad/s, specific forces m/s^2."""
    data, t_us = np.ascontiguousarray(np.hstack([gyr, acc]), np.float32), microseconds(t_s)
    n = len(data)
    q, bias = np.zeros((n, 4), np.float32), np.zeros((n, 3), np.float32)
    tick_us, rows = np.zeros(n, np.uint64), np.zeros((n, COLUMNS), np.float32)
    out = Output(*(array.ctypes.data for array in (q, bias, tick_us, rows)), 0)
    done = library().jcal_batch_sensor(ctypes.c_void_p(t_us.ctypes.data), ctypes.c_void_p(data.ctypes.data),
                                       ctypes.c_size_t(n), ctypes.byref(out))
    if done != 0:
        raise RuntimeError(f"jcal_batch_sensor returned {done}")
    rows = rows[: out.tick_count].astype(float)
    turn, rate, lever = (rows[:, k : k + 9].reshape(-1, 3, 3) for k in (0, 9, 18))
    t = (tick_us[: out.tick_count].astype(float) - 1e6) / 1e6
    return Found(q.astype(float), bias.astype(float),
                 Ticks(t, turn, rate, lever, rows[:, 27:30], rows[:, 30:33], *rows[:, 33:36].T, rows[:, 36].astype(int)))
