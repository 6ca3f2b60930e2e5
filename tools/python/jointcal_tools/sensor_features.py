"""Low-frequency features of one sensor from given orientations, float64 numpy; include/jointcal/tick.h says what they are.

    ticks = features(t_us, turn, gyr, acc)
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

SAMPLE_LOW_HZ, TICK_HIGH_HZ, TICK_LOW_HZ = 5.0, 0.4, 3.0
TICK_US = 50_000
GRAVITY = np.array([0.0, 0.0, 9.81])


@dataclass
class Features:
    at: np.ndarray  # (M,) sample of each tick
    rate: np.ndarray  # (M, 3, 3) 1/s
    lever: np.ndarray  # (M, 3, 3) 1/s
    velocity: np.ndarray  # (M, 3) m/s
    gyr: np.ndarray  # (M, 3) rad/s


def skew(w: np.ndarray) -> np.ndarray:
    """(N, 3, 3) of (N, 3): skew(w) r = w x r."""
    zero = np.zeros(len(w))
    x, y, z = w.T
    return np.stack([zero, -z, y, z, zero, -x, -y, x, zero], axis=1).reshape(-1, 3, 3)


def share(hz: float, dt_s: float) -> float:
    """What a one-pole takes over of a new value."""
    return 1.0 - np.exp(-2.0 * np.pi * hz * dt_s)


class Poles:
    """Three one-poles in series."""

    def __init__(self, begin: np.ndarray) -> None:
        self.y = [np.array(begin, float) for _ in range(3)]

    def put(self, x: np.ndarray, a: float) -> np.ndarray:
        for k in range(3):
            self.y[k] = self.y[k] + a * (x - self.y[k])
            x = self.y[k]
        return x


class High:
    """A one-pole high-pass."""

    def __init__(self, x: np.ndarray) -> None:
        self.x, self.h = np.array(x, float), np.zeros(np.shape(x))

    def put(self, x: np.ndarray, keep: float) -> np.ndarray:
        self.h, self.x = keep * (self.h + x - self.x), np.array(x, float)
        return self.h


def features(t_us: np.ndarray, turn: np.ndarray, gyr: np.ndarray, acc: np.ndarray) -> Features:
    """Of one epoch: no gaps. Turn (N, 3, 3) sensor to earth, rates (N, 3) rad/s, specific forces (N, 3) m/s^2."""
    t_us = np.asarray(t_us).astype(np.int64)
    rates, force = turn @ skew(gyr), np.einsum("nij,nj->ni", turn, acc) - GRAVITY
    low_rate, low_force, low_gyr = Poles(rates[0]), Poles(np.zeros(3)), Poles(gyr[0])
    lever_high = [High(rates[0]), High(np.zeros((3, 3))), High(np.zeros((3, 3)))]
    velocity_high = [High(np.zeros(3)), High(np.zeros(3))]
    u, lever, velocity, way, before, last = np.zeros(3), np.zeros((3, 3)), np.zeros(3), np.zeros(3), np.zeros(3), t_us[0]
    found: list[tuple] = []
    for k in range(1, len(t_us)):
        dt_us = t_us[k] - t_us[k - 1]
        dt_s, a = dt_us * 1e-6, share(SAMPLE_LOW_HZ, dt_us * 1e-6)
        for v in ([0.5 * force[0], force[1]] if k == 1 else [force[k]]):
            now = low_force.put(v, a)
            way, before = way + 0.5 * dt_s * (now + before), now
        rate, slow = low_rate.put(rates[k], a), low_gyr.put(gyr[k], a)
        if 2 * (t_us[k] - last) + dt_us < 2 * TICK_US:
            continue
        tick_s, last = (t_us[k] - last) * 1e-6, t_us[k]
        keep, c = 1.0 - share(TICK_HIGH_HZ, tick_s), share(TICK_LOW_HZ, tick_s)
        x, u, way = rate, keep * (u + way), np.zeros(3)
        for high in lever_high:
            x = high.put(x, keep)
        lever = lever + c * (x - lever)
        x = u
        for high in velocity_high:
            x = high.put(x, keep)
        velocity = velocity + c * (x - velocity)
        found.append((k, rate, lever, velocity, slow))
    return Features(*(np.array(column) for column in zip(*found, strict=True)))
