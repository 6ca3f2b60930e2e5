"""Float64 reference of one sensor's work for a functional joint: orientation, and ticks of its features.

`orientation` is the basic form of [VQF] without its estimation of biases: take the bias off
before. Features are those of jointcal_tools.sensor_features, begun anew after each gap.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from . import quaternions as quat
from . import sensor_features

GRAVITY_M_S2 = 9.81
GAP_S = 0.105  # a longer distance of samples begins anew
TAU_ACC_S = 3.0  # of VQF's low-pass of the specific force; so long the running mean is taken
LEVEL_TAU_S = 20.0


class Tick(NamedTuple):
    """jcal_tick_t of one sensor."""

    t_s: float
    dt_s: float
    epoch: int
    turn: np.ndarray  # (3, 3) R
    rate: np.ndarray  # (3, 3) Q, 1/s
    lever: np.ndarray  # (3, 3) B, 1/s
    velocity: np.ndarray  # (3,) U, m/s
    gyr: np.ndarray  # (3,) rad/s
    acc_level: float  # mean vertical specific force, m/s^2


COLD_S = 2.0  # after a gap: inclinations are still wrong by degrees, and joints leave such ticks out


class Warmth:
    """Whether the filters of two sensors have run for long enough since a gap."""

    def __init__(self) -> None:
        self.epochs: tuple[int, int] | None = None
        self.since_s = 0.0

    def is_cold(self, tick1: Tick, tick2: Tick) -> bool:
        epochs = (tick1.epoch, tick2.epoch)
        self.since_s = (self.since_s if epochs == self.epochs else 0.0) + tick1.dt_s
        self.epochs = epochs
        return max(epochs) > 1 and self.since_s < COLD_S - 1e-4


def epochs(t_s: np.ndarray) -> list[slice]:
    """Stretches without a gap."""
    dt = np.diff(t_s)
    begins = np.r_[0, np.flatnonzero((dt > GAP_S) | (dt <= 0.0)) + 1, len(t_s)]
    return [slice(a, b) for a, b in zip(begins[:-1], begins[1:], strict=True)]


# Orientation.


def butterworth(dt_s: float) -> tuple[np.ndarray, np.ndarray]:
    """Numerator and denominator of the second-order low-pass; its cut-off is that of VQF's time constant."""
    c = np.tan(np.sqrt(2.0) / (2.0 * np.pi * TAU_ACC_S) * np.pi * dt_s)
    d = c * c + np.sqrt(2.0) * c + 1.0
    return np.array([1.0, 2.0, 1.0]) * c * c / d, np.array([1.0, 2.0 * (c * c - 1.0) / d, (1.0 - np.sqrt(2.0) * c + c * c) / d])


def levelled(q: np.ndarray, force: np.ndarray) -> np.ndarray:
    """q corrected by the shortest turn that makes `force` (3,), as q shows it, vertical."""
    x, y, z = quat.matrices(q[None])[0] @ force / np.linalg.norm(force)
    w = np.sqrt(0.5 * (1.0 + z))
    turn = np.array([w, 0.5 * y / w, -0.5 * x / w, 0.0]) if w > 1e-6 else np.array([0.0, 1.0, 0.0, 0.0])
    out = quat.multiply(turn, q)
    return out / np.linalg.norm(out)


def orientation(t_s: np.ndarray, gyr: np.ndarray, acc: np.ndarray) -> np.ndarray:
    """(N, 4) sensor to level frame, after each sample: turned by the mean of both rates between two samples."""
    means = 0.5 * (gyr + np.vstack([gyr[:1], gyr[:-1]]))
    steps = quat.from_rotation_vectors(means * np.r_[0.0, np.clip(np.diff(t_s), 0.0, GAP_S)][:, None])
    out = np.empty((len(t_s), 4))
    strap, inclination = np.array([1.0, 0.0, 0.0, 0.0]), np.array([1.0, 0.0, 0.0, 0.0])
    for part in epochs(t_s):
        x, y = np.zeros((3, 3)), np.zeros((3, 3))  # the last three values that came and went
        since = 0.0
        for k in range(part.start, part.stop):
            dt = t_s[k] - t_s[k - 1] if k > part.start else (t_s[k + 1] - t_s[k] if k + 1 < part.stop else 0.01)
            strap = quat.multiply(strap, steps[k])
            force = quat.matrices(strap[None])[0] @ acc[k]
            since += dt
            if since < TAU_ACC_S:
                y[:] = y[0] + dt / since * (force - y[0])
                x[:] = y
            else:
                b, a = butterworth(dt)
                x = np.vstack([force, x[:2]])
                y = np.vstack([b @ x - a[1:] @ y[:2], y[:2]])
            inclination = levelled(inclination, y[0])
            out[k] = quat.multiply(inclination, strap)
        strap /= np.linalg.norm(strap)
    return out


# Ticks.


def levels(since_s: np.ndarray, dt_s: np.ndarray, vertical: np.ndarray) -> np.ndarray:
    """Mean of the vertical specific force over the epoch, then over LEVEL_TAU_S."""
    level, out = GRAVITY_M_S2, []
    for since, dt, force in zip(since_s, dt_s, vertical, strict=True):
        level += dt / (min(since, LEVEL_TAU_S) + dt) * (force - level)
        out.append(level)
    return np.array(out)


def features(t_s: np.ndarray, q: np.ndarray, gyr: np.ndarray, acc: np.ndarray) -> list[Tick]:
    """Ticks of one sensor with orientations q (N, 4)."""
    turn, ticks = quat.matrices(q), []
    for number, part in enumerate(epochs(t_s), 1):
        t, r = t_s[part] - t_s[part.start], turn[part]
        if len(t) < 20:  # no tick may be due yet
            continue
        found = sensor_features.features(np.rint(1e6 * t), r, gyr[part], acc[part])
        starts = np.r_[0, found.at]
        dt = np.diff(t[starts])
        vertical = [float(np.mean(np.einsum("nj,nj->n", r[a + 1 : b + 1, 2], acc[part][a + 1 : b + 1])))
                    for a, b in zip(starts[:-1], starts[1:], strict=True)]
        level = levels(t[starts[:-1]], dt, np.array(vertical))
        ticks += [Tick(t_s[part][at], dt[k], number, r[at], found.rate[k], found.lever[k], found.velocity[k], found.gyr[k], level[k])
                  for k, at in enumerate(found.at)]
    return ticks
