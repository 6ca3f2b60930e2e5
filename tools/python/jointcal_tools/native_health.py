"""The health of one sensor by the C library over whole arrays, through ctypes.

    said = run(t_s, gyr, acc)
    said.named, said.fact["scale"], said.way
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass

import numpy as np

from .native import library

FINDINGS = ("gaps", "uneven", "frozen", "held", "dead", "clipped", "no_gravity", "gravity_off", "rate_unit", "frames", "scale", "vibrates")
NUMBERS = ("rate_hz", "gaps", "rest_s", "rms_rad_s", "motion_s", "scale_bound", "fast_share", "dead", "clipped", "way_known", "way_of_gyr")
WAYS = 50
ORIGIN_US = 1_000_000
STATES = ("unknown", "fine", "named")


class Output(ctypes.Structure):
    """jcal_batch_health_out_t of tools/native/batch_health.h."""

    _fields_ = [("state", ctypes.c_int32 * len(FINDINGS)), ("fact", ctypes.c_float * len(FINDINGS)), ("numbers", ctypes.c_float * (len(NUMBERS) + 6)),
                ("score", ctypes.c_float * WAYS), ("trials", ctypes.c_float), ("fits", ctypes.c_float), ("scale", ctypes.c_float),
                ("deviation", ctypes.c_float)]


@dataclass
class Said:
    state: dict[str, str]
    fact: dict[str, float]
    number: dict[str, float]
    way: tuple[tuple[int, ...], tuple[int, ...]]  # columns, signs
    score: np.ndarray  # (50,)
    trials: int
    fits: int
    scale: float
    deviation: float

    @property
    def named(self) -> frozenset[str]:
        return frozenset(finding for finding, state in self.state.items() if state == "named")


def run(t_s: np.ndarray, gyr: np.ndarray, acc: np.ndarray) -> Said:
    """What is said after the last reading; readings that are not finite are left to the library."""
    t_us = (np.rint(1e6 * (t_s - t_s[0])) + ORIGIN_US).astype(np.uint64)
    values = np.ascontiguousarray(np.hstack([gyr, acc]), np.float32)
    out = Output()
    call = library().jcal_batch_health
    call.argtypes = [ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t, ctypes.c_void_p]
    done = call(t_us.ctypes.data, values.ctypes.data, len(t_us), ctypes.byref(out))
    if done != 0:
        raise RuntimeError(f"jcal_batch_health returned {done}")
    numbers = list(out.numbers)
    way = tuple(tuple(int(x) for x in numbers[k: k + 3]) for k in (len(NUMBERS), len(NUMBERS) + 3))
    return Said({f: STATES[s] for f, s in zip(FINDINGS, out.state, strict=True)}, dict(zip(FINDINGS, out.fact, strict=True)),
                dict(zip(NUMBERS, numbers, strict=False)), way, np.array(out.score), int(out.trials), int(out.fits), out.scale, out.deviation)
