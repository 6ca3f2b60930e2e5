"""Float64 reference of one sensor's work: orientation and low-frequency features.

Written from include/jointcal/tick.h and [VQF]. With R from the sensor to its level frame:

    rate      Q = L3(R [w]x)      L3: three one-poles of 5 Hz in series, every sample
    gyr       L3(w)
    velocity  U = L H H u         u: integral of v = L3(R a - g) through a high-pass of 0.4 Hz
    lever     B = L H H H Q       H: one-pole high-passes of 0.4 Hz, L: low-pass of 3 Hz, every tick

`orientation` is VQF's basic form without its estimation of biases: take the bias off before.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from . import quaternions as quat

GRAVITY_M_S2 = 9.81
SAMPLE_LOW_HZ, TICK_HIGH_HZ, TICK_LOW_HZ = 5.0, 0.4, 3.0
TICK_S = 0.05
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


def share(hz: float, dt_s: float) -> float:
    """Of the new value in a one-pole low-pass."""
    return 1.0 - float(np.exp(-2.0 * np.pi * hz * dt_s))


def skews(w: np.ndarray) -> np.ndarray:
    """(N, 3, 3): [w]x r = w x r."""
    out = np.zeros((len(w), 3, 3))
    out[:, 2, 1], out[:, 0, 2], out[:, 1, 0] = w.T
    return out - out.swapaxes(1, 2)


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


# Features.


class Chain:
    """Three one-poles in series."""

    def __init__(self, start: np.ndarray) -> None:
        self.y = [start, start, start]

    def put(self, x: np.ndarray, a: float) -> np.ndarray:
        for i in range(3):
            x = self.y[i] = self.y[i] + a * (x - self.y[i])
        return x


class HighPass:
    """h <- (1 - b)(h + x - x before), from h = 0."""

    def __init__(self, before: np.ndarray) -> None:
        self.h, self.before = np.zeros_like(before), before

    def put(self, x: np.ndarray, b: float) -> np.ndarray:
        self.h = (1.0 - b) * (self.h + x - self.before)
        self.before = x
        return self.h


class Stage:
    """Filters of one epoch."""

    def __init__(self, q: np.ndarray, v: np.ndarray, w: np.ndarray) -> None:
        self.rate, self.force, self.gyr = Chain(q), Chain(np.zeros(3)), Chain(w)
        self.first = 0.5 * v  # half: the integral is a trapezoidal rule, and its first value counts half
        self.v, self.way = np.zeros(3), np.zeros(3)
        self.lever = [HighPass(q)] + [HighPass(np.zeros((3, 3))) for _ in range(2)]
        self.integral, self.velocity = np.zeros(3), [HighPass(np.zeros(3)) for _ in range(2)]
        self.b, self.u = np.zeros((3, 3)), np.zeros(3)
        self.level, self.since_s = GRAVITY_M_S2, 0.0

    def take_way(self, v: np.ndarray, dt_s: float) -> None:
        now = self.force.put(v, share(SAMPLE_LOW_HZ, dt_s))
        self.way = self.way + 0.5 * dt_s * (self.v + now)
        self.v = now

    def sample(self, q: np.ndarray, v: np.ndarray, w: np.ndarray, dt_s: float) -> None:
        a = share(SAMPLE_LOW_HZ, dt_s)
        if self.first is not None:
            self.take_way(self.first, dt_s)
            self.first = None
        self.rate.put(q, a)
        self.take_way(v, dt_s)
        self.gyr.put(w, a)

    def tick(self, dt_s: float) -> None:
        b, c = share(TICK_HIGH_HZ, dt_s), share(TICK_LOW_HZ, dt_s)
        self.level += dt_s / (min(self.since_s, LEVEL_TAU_S) + dt_s) * (GRAVITY_M_S2 + self.way[2] / dt_s - self.level)
        self.since_s += dt_s
        u = self.integral = (1.0 - b) * (self.integral + self.way)
        self.way = np.zeros(3)
        for high in self.velocity:
            u = high.put(u, b)
        self.u = self.u + c * (u - self.u)
        lever = self.rate.y[2]
        for high in self.lever:
            lever = high.put(lever, b)
        self.b = self.b + c * (lever - self.b)


def features(t_s: np.ndarray, q: np.ndarray, gyr: np.ndarray, acc: np.ndarray) -> list[Tick]:
    """Ticks of one sensor with orientations q (N, 4)."""
    r = quat.matrices(q)
    spin, force = r @ skews(gyr), np.einsum("nij,nj->ni", r, acc) - [0.0, 0.0, GRAVITY_M_S2]
    ticks = []
    for number, part in enumerate(epochs(t_s), 1):
        stage = Stage(spin[part.start], force[part.start], gyr[part.start])
        last_s = t_s[part.start]
        for k in range(part.start + 1, part.stop):
            dt = t_s[k] - t_s[k - 1]
            stage.sample(spin[k], force[k], gyr[k], dt)
            since = t_s[k] - last_s
            if since + 0.5 * dt >= TICK_S - 1e-9:
                stage.tick(since)
                last_s = t_s[k]
                ticks.append(Tick(t_s[k], since, number, r[k], stage.rate.y[2], stage.b, stage.u, stage.gyr.y[2], stage.level))
    return ticks
