"""Functions of time with their first and second derivatives, carried along exactly.

A Jet holds value, rate and accel (..., N). Sums, products and functions of jets follow the
product and the chain rule, so whatever is built of them needs no numerical difference.
Sources are closed functions of time and band-limited noise, differentiated in its spectrum.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Clock:
    """Instants at which jets are evaluated: k / rate_hz - delay, k below `count`, one delay after the other."""

    count: int
    rate_hz: float
    delays_s: tuple[float, ...] = (0.0,)

    @property
    def size(self) -> int:
        return self.count * len(self.delays_s)

    @property
    def t_s(self) -> np.ndarray:
        return np.concatenate([np.arange(self.count) / self.rate_hz - delay_s for delay_s in self.delays_s])


@dataclass(frozen=True)
class Jet:
    value: np.ndarray  # (..., N)
    rate: np.ndarray
    accel: np.ndarray

    __array_ufunc__ = None  # an array on the left leaves the operation to the jet

    @property
    def parts(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        return self.value, self.rate, self.accel

    def __getitem__(self, index) -> Jet:
        return Jet(*(part[index] for part in self.parts))

    def __add__(self, other) -> Jet:
        if isinstance(other, Jet):
            return Jet(*(a + b for a, b in zip(self.parts, other.parts, strict=True)))
        return Jet(self.value + other, self.rate, self.accel)

    __radd__ = __add__

    def __neg__(self) -> Jet:
        return Jet(*(-part for part in self.parts))

    def __sub__(self, other) -> Jet:
        return self + (-other)

    def __rsub__(self, other) -> Jet:
        return -self + other

    def __mul__(self, other) -> Jet:
        if isinstance(other, Jet):
            return product(np.multiply, self, other)
        return Jet(*(part * other for part in self.parts))

    __rmul__ = __mul__

    def then(self, f: np.ndarray, df: np.ndarray, ddf: np.ndarray) -> Jet:
        """f(self), from f, f' and f'' at its value."""
        return Jet(f, df * self.rate, ddf * self.rate**2 + df * self.accel)


def product(op: Callable, a: Jet, b: Jet) -> Jet:
    """Of any bilinear operation."""
    return Jet(op(a.value, b.value), op(a.rate, b.value) + op(a.value, b.rate),
               op(a.accel, b.value) + 2.0 * op(a.rate, b.rate) + op(a.value, b.accel))


def constant(value: float, count: int) -> Jet:
    zero = np.zeros(count)
    return Jet(np.full(count, float(value)), zero, zero)


def line(clock: Clock, slope: float, offset: float = 0.0) -> Jet:
    t_s = clock.t_s
    return Jet(offset + slope * t_s, np.full(len(t_s), slope), np.zeros(len(t_s)))


def stack(jets: Sequence[Jet]) -> Jet:
    return Jet(*(np.stack(parts) for parts in zip(*(jet.parts for jet in jets), strict=True)))


def sin(x: Jet) -> Jet:
    s, c = np.sin(x.value), np.cos(x.value)
    return x.then(s, c, -s)


def cos(x: Jet) -> Jet:
    s, c = np.sin(x.value), np.cos(x.value)
    return x.then(c, -s, -c)


def exp(x: Jet) -> Jet:
    e = np.exp(x.value)
    return x.then(e, e, e)


def logistic(x: Jet) -> Jet:
    y = 1.0 / (1.0 + np.exp(-x.value))
    slope = y * (1.0 - y)
    return x.then(y, slope, slope * (1.0 - 2.0 * y))


def harmonics(coefficients: np.ndarray, phase: Jet) -> Jet:
    """Real part of sum over k of coefficients[k] exp(i k phase)."""
    order = np.arange(len(coefficients))
    waves = np.exp(1j * order[:, None] * phase.value)
    f, df, ddf = (((coefficients * (1j * order) ** power) @ waves).real for power in range(3))
    return phase.then(f, df, ddf)


def noise(rng: np.random.Generator, clock: Clock, band_hz: tuple[float, float], rows: int, order: int = 0) -> Jet:
    """Noise (rows, N) of a flat spectrum within a band; derivative `order` has rms 1 over all rows together.

    It is periodic in some whole seconds, with the same draws at every sampling rate. What lies above
    half of that rate is left out and its power is missing, as behind a sharp low-pass.
    """
    period_s = int(np.ceil(clock.count / clock.rate_hz)) + 4
    length = round(period_s * clock.rate_hz)
    low = max(1, int(np.ceil(band_hz[0] * period_s)))
    bins = np.arange(low, max(low + 1, int(band_hz[1] * period_s)) + 1)
    draws = rng.standard_normal((2, rows, len(bins)))
    i_omega = 2j * np.pi * bins / period_s
    lines = (draws[0] + 1j * draws[1]) * i_omega ** float(-order)
    flat = lines * i_omega**order
    lines *= np.sqrt(2.0 / np.sum(np.abs(flat) ** 2))
    seen = 2 * bins < length
    spectrum = np.zeros((len(clock.delays_s), 3, rows, length // 2 + 1), complex)
    for of_delay, delay_s in zip(spectrum, clock.delays_s, strict=True):
        for k in range(3):
            of_delay[k][:, bins[seen]] = (lines * np.exp(-i_omega * delay_s) * i_omega**k)[:, seen] * length / 2.0
    return Jet(*np.concatenate(np.fft.irfft(spectrum, length)[..., : clock.count], axis=-1))


# Rotations and vectors.

def times(a: Jet, b: Jet) -> Jet:
    """Matrices (3, 3, N) with matrices or vectors (3, N)."""
    return product(lambda x, y: np.einsum("ijn,j...n->i...n", x, y), a, b)


def turn(axis: int, angle: Jet) -> Jet:
    """Rotation matrix (3, 3, N) about coordinate axis 0, 1 or 2."""
    c, s = cos(angle), sin(angle)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    matrix = Jet(*np.zeros((3, 3, 3, angle.value.shape[-1])))
    for target, cosine, sine in zip(matrix.parts, c.parts, s.parts, strict=True):
        target[i, i], target[i, j], target[j, i], target[j, j] = cosine, -sine, sine, cosine
    matrix.value[axis, axis] = 1.0
    return matrix


def body_rate(rotation: Jet) -> np.ndarray:
    """Angular rate (3, N) in the body's frame: [w]x = R^T dR."""
    skew = np.einsum("jin,jkn->ikn", rotation.value, rotation.rate)
    return 0.5 * np.array([skew[2, 1] - skew[1, 2], skew[0, 2] - skew[2, 0], skew[1, 0] - skew[0, 1]])


def into_body(rotation: Jet, vector: np.ndarray) -> np.ndarray:
    """R^T v (3, N)."""
    return np.einsum("jin,jn->in", rotation.value, vector)
