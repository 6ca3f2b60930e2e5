"""A recording split into two files of one sensor each, with clocks and rates of their own.

    rng = np.random.default_rng(1)
    one, two = split(recording, (Clock(), Clock(rate_hz=60.0, lag_s=0.12, drift_ppm=200.0)), rng)
    write(path, one)
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .recordings import Recording

COLUMNS = ("t_s", "gyr_x", "gyr_y", "gyr_z", "acc_x", "acc_y", "acc_z")
SIDE = 12  # readings on either side from which one between them is made


@dataclass(frozen=True)
class Clock:
    """How a sensor reads, and what times it writes beside its readings."""

    rate_hz: float | None = None  # None: the recording's own rows
    begin_s: float = 0.0  # first reading, after the recording's first row
    offset_s: float = 0.0  # of its clock at the recording's first row
    lag_s: float = 0.0  # the same, on top
    drift_ppm: float = 0.0
    jitter_s: float = 0.0  # standard deviation of its times
    loss: float = 0.0  # share of its readings that are lost

    def stamps_s(self, since_s: np.ndarray) -> np.ndarray:
        """Times that it writes for moments since the recording's first row, without jitter."""
        return self.offset_s + self.lag_s + since_s * (1.0 + 1e-6 * self.drift_ppm)


def lag_s(clocks: tuple[Clock, Clock], since_s: float) -> float:
    """Sensor 2's time less sensor 1's at a moment."""
    one, two = (clock.stamps_s(np.array(since_s)) for clock in clocks)
    return float(two - one)


def is_new(values: np.ndarray) -> np.ndarray:
    """(N,) False where a reading repeats the one before, or holds a number that is missing: a lost packet."""
    repeated = np.r_[False, (np.diff(values, axis=0) == 0.0).all(axis=1)]
    return ~repeated & np.isfinite(values).all(axis=1)


def between(since_s: np.ndarray, values: np.ndarray, at_s: np.ndarray) -> np.ndarray:
    """Values at other times than those of equidistant rows: a sine cardinal under a Hann window."""
    step_s = float(np.median(np.diff(since_s)))
    place = (at_s - since_s[0]) / step_s
    first = np.floor(place).astype(int)
    taps = first[:, None] + np.arange(1 - SIDE, 1 + SIDE)
    apart = place[:, None] - taps
    weights = np.sinc(apart) * np.cos(0.5 * np.pi * np.clip(apart / SIDE, -1.0, 1.0)) ** 2
    weights /= weights.sum(axis=1, keepdims=True)
    return np.einsum("nk,nkc->nc", weights, values[np.clip(taps, 0, len(values) - 1)])


def read(rec: Recording, sensor: int, clock: Clock, rng: np.random.Generator) -> np.ndarray:
    """(M, 7) the rows of its file."""
    values = np.hstack([rec.gyr1, rec.acc1] if sensor == 1 else [rec.gyr2, rec.acc2])
    since_s, new = rec.t_s - rec.t_s[0], is_new(values)
    if clock.rate_hz is None:
        kept = new & (since_s >= clock.begin_s)
        at_s, values = since_s[kept], values[kept]
    else:
        grid_s = np.arange(0.0, since_s[-1], np.median(np.diff(since_s)))
        filled = np.column_stack([np.interp(grid_s, since_s[new], column) for column in values[new].T])
        at_s = np.arange(clock.begin_s, since_s[-1], 1.0 / clock.rate_hz)
        values = between(grid_s, filled, at_s)
        nearest = np.abs(since_s[new][np.clip(np.searchsorted(since_s[new], at_s) - np.array([[0], [1]]), 0, new.sum() - 1)] - at_s)
        known = nearest.max(axis=0) <= 1.5 * np.median(np.diff(since_s))
        at_s, values = at_s[known], values[known]
    kept = rng.random(len(at_s)) >= clock.loss
    stamps_s = clock.stamps_s(at_s) + clock.jitter_s * rng.standard_normal(len(at_s))
    return np.column_stack([np.maximum.accumulate(stamps_s), values])[kept]


def split(rec: Recording, clocks: tuple[Clock, Clock], rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    return read(rec, 1, clocks[0], rng), read(rec, 2, clocks[1], rng)


def write(path: Path, rows: np.ndarray, digits: int = 9) -> None:
    np.savetxt(path, rows, fmt=["%.6f", *[f"%.{digits}g"] * 6], delimiter=",", newline="\n", header=",".join(COLUMNS), comments="")
