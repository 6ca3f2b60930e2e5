"""Float64 reference of the stream engine's axes, written from docs/METHOD.md alone.

Two ways to say that two gyroscopes on a hinge see one rate across the joint axis, each
solved over a whole recording at once:

- `solve_lengths`: section 2. Both see the same length, |z1|^2 - |z2|^2 = 0.
- `solve_vectors`: section 4. Both see the same vector, p exp(-i theta) z1 - z2 = 0. Each
  block of `block_s` seconds has a phase p of its own.

Both have the accelerometer part (18) with its constant, and gyroscope biases across the
axes. z = w . u + i w . v - beta is the rate across the axis, l = w . j the rate along it;
(j, u, v) is an orthonormal frame that moves with the axis, beta the bias in that frame.
A bias along the axis changes nothing but the integral of l2 - l1, by bias times block:
it is left out.

The phase has a closed form: with y = exp(-i theta) z1 and S = sum of weight conj(y) z2,
p = S / |S| makes sum weight |p y - z2|^2 smallest. It is put into the residual, and the
Jacobian is that of what comes out (variable projection):

    dr = p dy + i p y dphi - dz2,    dphi = Im(conj(S) dS) / |S|^2

Where the method's page is silent, or the engine does otherwise, this reference decides
as follows:

- Nothing is linearised for good: Gauss-Newton goes through all samples until it stands
  still. There are no sums to move along, no anchor, no pull, no forgetting.
- The prior of the biases counts with the power of the residuals at the minimum. That is
  found by solving a few times.
- Samples at rest count like any other, and a pose counts however long it lasts.
- All blocks have the same length; a last one that is shorter than half of it belongs to
  the one before. A gap begins a new block.
- The result is the minimum that is reached from the start, with its pairing. There is no
  search for others.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

UNIT_S = 0.05  # duration that counts as one independent reading
GYR_NOISE_RAD_S = 0.03  # usual disagreement of the rates across the axis
ACC_NOISE_M_S2 = 1.5  # usual disagreement of the specific forces along the axis
LEVER_ARM_M = 1.0  # its growth with the product of both rates
PRODUCT_TIME_S = 0.2  # time constant of that product
GYR_BIAS_RAD_S = 0.007  # prior of each component
ACC_BIAS_M_S2 = 0.5
RATE_EPS = 0.05  # rad^2/s^2, of the weight of section 2
BLOCK_S = 0.5
GAP_PERIODS = 3.0  # a longer step in time than so many periods begins a new block

POWER_MIN = 1e-2  # of the residuals, in units of the assumed noise power
POWER_ROUNDS = 4
STEP_MAX_RAD = 0.2
STEP_DONE = 1e-9  # largest tilt of a step, rad, that ends the iterations
MAX_ITERATIONS = 100
MAX_HALVINGS = 40

TILTS = slice(0, 4)  # unknowns: two tilts of each axis, rad;
BIASES = slice(4, 8)  # two biases across each axis, standard deviations;
CONSTANT = 8  # c = j1 . b_a1 - j2 . b_a2 of (18), standard deviations
UNKNOWNS = 9


class Frame(NamedTuple):
    """A unit axis j with two directions across it, u x v = j."""

    j: np.ndarray  # (3,)
    u: np.ndarray
    v: np.ndarray


class Point(NamedTuple):
    """Where an iteration stands."""

    frame1: Frame
    frame2: Frame
    bias: np.ndarray  # (4,) along u1, v1, u2, v2, standard deviations
    constant: float  # standard deviations


@dataclass(frozen=True)
class Samples:
    """The data of one estimation."""

    t_s: np.ndarray  # (N,)
    gyr1: np.ndarray  # (N, 3)
    acc1: np.ndarray
    gyr2: np.ndarray
    acc2: np.ndarray

    @property
    def period_s(self) -> float:
        return float(np.median(np.diff(self.t_s)))


class Solution(NamedTuple):
    j1: np.ndarray
    j2: np.ndarray
    bias1: np.ndarray  # (3,) rad/s, across the axis
    bias2: np.ndarray
    cost: float  # of the residuals of the rates alone
    power: float  # mean square of these, in units of the assumed noise power


# Rows of residuals and their Jacobian (M,), (M, 9) at a point.
Rows = Callable[[Point], tuple[np.ndarray, np.ndarray]]


# Points and what is seen from them.

def make_frame(j: np.ndarray) -> Frame:
    j = np.asarray(j, float) / np.linalg.norm(j)
    u = np.cross(j, np.eye(3)[np.argmin(np.abs(j))])
    u /= np.linalg.norm(u)
    return Frame(j, u, np.cross(j, u))


def tilt(frame: Frame, d: np.ndarray) -> Frame:
    """j <- normalise(j + u d0 + v d1), with u and v carried along."""
    j = frame.j + frame.u * d[0] + frame.v * d[1]
    j = j / np.linalg.norm(j)
    u = frame.u - j * (j @ frame.u)
    u /= np.linalg.norm(u)
    return Frame(j, u, np.cross(j, u))


def make_point(j1: np.ndarray, j2: np.ndarray) -> Point:
    return Point(make_frame(j1), make_frame(j2), np.zeros(4), 0.0)


def move(point: Point, d: np.ndarray) -> Point:
    """The point after a step (9,)."""
    return Point(tilt(point.frame1, d[0:2]), tilt(point.frame2, d[2:4]), point.bias + d[BIASES],
                 point.constant + float(d[CONSTANT]))


@dataclass(frozen=True)
class View:
    """One sensor's rates seen from its frame, with derivatives by its tilts and biases."""

    across: np.ndarray  # (N,) complex, z
    along: np.ndarray  # (N,) l
    d_across: np.ndarray  # (N, 9) complex
    d_along: np.ndarray  # (N, 9)


def look(gyr: np.ndarray, frame: Frame, bias: np.ndarray, first: int) -> View:
    """`first` is 0 for sensor 1, 2 for sensor 2: the place of its unknowns in their pairs."""
    seen, along = gyr @ frame.u + 1j * (gyr @ frame.v), gyr @ frame.j
    d_across, d_along = np.zeros((len(gyr), UNKNOWNS), complex), np.zeros((len(gyr), UNKNOWNS))
    for k, unit in enumerate((1.0, 1.0j)):
        d_across[:, TILTS.start + first + k] = -along * unit  # du = -j d0, dv = -j d1
        d_across[:, BIASES.start + first + k] = -GYR_BIAS_RAD_S * unit
        d_along[:, TILTS.start + first + k] = (seen * np.conj(unit)).real  # dj = u d0 + v d1
    return View(seen - GYR_BIAS_RAD_S * (bias[first] + 1j * bias[first + 1]), along, d_across, d_along)


def look_both(samples: Samples, point: Point) -> tuple[View, View]:
    return look(samples.gyr1, point.frame1, point.bias, 0), look(samples.gyr2, point.frame2, point.bias, 2)


# Section 2: lengths.

def length_rows(samples: Samples) -> Rows:
    """|z1|^2 - |z2|^2, weighted as a stand-in for (24)."""
    power = (samples.gyr1**2).sum(axis=1) + (samples.gyr2**2).sum(axis=1)
    weight = np.sqrt(samples.period_s / UNIT_S / (power + RATE_EPS)) / GYR_NOISE_RAD_S

    def rows(point: Point) -> tuple[np.ndarray, np.ndarray]:
        view1, view2 = look_both(samples, point)
        residual = np.abs(view1.across) ** 2 - np.abs(view2.across) ** 2
        jacobian = 2.0 * (view1.across.conj()[:, None] * view1.d_across
                          - view2.across.conj()[:, None] * view2.d_across).real
        return weight * residual, weight[:, None] * jacobian

    return rows


# Section 4: vectors.

def block_starts(t_s: np.ndarray, block_s: float) -> np.ndarray:
    """Index of the first sample of each block."""
    period_s = float(np.median(np.diff(t_s)))
    pieces = np.flatnonzero(np.diff(t_s) > GAP_PERIODS * period_s) + 1
    starts = []
    for begin, end in zip(np.r_[0, pieces], np.r_[pieces, len(t_s)], strict=True):
        span = max(round(block_s / period_s), 2)
        count = max(int(round((end - begin) / span)), 1)
        starts += [begin + k * span for k in range(count)]
    return np.array(starts)


def integral(values: np.ndarray, t_s: np.ndarray, starts: np.ndarray) -> np.ndarray:
    """Of (N, ...) from the first sample of its block on, by the trapezoidal rule."""
    step = np.diff(t_s).reshape(-1, *[1] * (values.ndim - 1))
    total = np.concatenate([np.zeros((1, *values.shape[1:])),
                            np.cumsum(0.5 * (values[1:] + values[:-1]) * step, axis=0)])
    return total - np.repeat(total[starts], np.diff(np.r_[starts, len(t_s)]), axis=0)


def vector_rows(samples: Samples, block_s: float = BLOCK_S) -> Rows:
    """p exp(-i theta) z1 - z2 as real and imaginary parts, p eliminated in each block."""
    starts = block_starts(samples.t_s, block_s)
    lengths = np.diff(np.r_[starts, len(samples.t_s)])
    weight = np.sqrt(samples.period_s / UNIT_S) / GYR_NOISE_RAD_S

    def rows(point: Point) -> tuple[np.ndarray, np.ndarray]:
        view1, view2 = look_both(samples, point)
        theta = integral(view2.along - view1.along, samples.t_s, starts)
        d_theta = integral(view2.d_along - view1.d_along, samples.t_s, starts)
        back = np.exp(-1j * theta)
        turned = back * view1.across
        d_turned = back[:, None] * view1.d_across - 1j * turned[:, None] * d_theta
        match = np.add.reduceat(turned.conj() * view2.across, starts)
        d_match = np.add.reduceat(d_turned.conj() * view2.across[:, None]
                                  + turned.conj()[:, None] * view2.d_across, starts)
        size = np.maximum(np.abs(match), np.finfo(float).tiny)
        phase = np.repeat(np.where(match == 0.0, 1.0, match / size), lengths)
        d_phase = np.repeat((match.conj()[:, None] * d_match).imag / (size**2 + np.finfo(float).tiny)[:, None],
                            lengths, axis=0)
        residual = phase * turned - view2.across
        jacobian = phase[:, None] * (d_turned + 1j * turned[:, None] * d_phase) - view2.d_across
        return (weight * np.concatenate([residual.real, residual.imag]),
                weight * np.concatenate([jacobian.real, jacobian.imag]))

    return rows


# What both share: (18), the priors, the minimum.

def smoothed(values: np.ndarray, period_s: float, time_s: float) -> np.ndarray:
    """First-order low-pass of (N,) from zero."""
    out, state, share = np.empty(len(values)), 0.0, period_s / (period_s + time_s)
    for k, value in enumerate(values):
        state += share * (value - state)
        out[k] = state
    return out


def acc_rows(samples: Samples) -> Rows:
    """(18) with its constant; the weight falls with the product of both rates."""
    product = smoothed(np.linalg.norm(samples.gyr1, axis=1) * np.linalg.norm(samples.gyr2, axis=1),
                       samples.period_s, PRODUCT_TIME_S)
    weight = np.sqrt(samples.period_s / UNIT_S / (ACC_NOISE_M_S2**2 + (LEVER_ARM_M * product) ** 2))
    unit = np.sqrt(2.0) * ACC_BIAS_M_S2

    def rows(point: Point) -> tuple[np.ndarray, np.ndarray]:
        a, b = point.frame1, point.frame2
        residual = samples.acc1 @ a.j - samples.acc2 @ b.j - unit * point.constant
        jacobian = np.zeros((len(residual), UNKNOWNS))
        jacobian[:, TILTS] = np.stack([samples.acc1 @ a.u, samples.acc1 @ a.v,
                                       -(samples.acc2 @ b.u), -(samples.acc2 @ b.v)], axis=1)
        jacobian[:, CONSTANT] = -unit
        return weight * residual, weight[:, None] * jacobian

    return rows


def prior_rows(power: float) -> Rows:
    """Biases and constant are zero but for one standard deviation; the biases' prior counts `power` times."""
    weight = np.r_[np.full(4, np.sqrt(power)), 1.0]
    jacobian = np.zeros((5, UNKNOWNS))
    jacobian[:, BIASES.start:] = np.diag(weight)
    return lambda point: (weight * np.r_[point.bias, point.constant], jacobian)


def joined(*parts: Rows) -> Rows:
    def rows(point: Point) -> tuple[np.ndarray, np.ndarray]:
        residuals, jacobians = zip(*(part(point) for part in parts), strict=True)
        return np.concatenate(residuals), np.concatenate(jacobians)

    return rows


def gauss_newton_step(residual: np.ndarray, jacobian: np.ndarray) -> np.ndarray:
    """(9,) towards the minimum; nothing along what the data leave open, and no axis further than STEP_MAX_RAD."""
    scale = np.maximum(np.linalg.norm(jacobian, axis=0), np.finfo(float).tiny)
    scaled = jacobian / scale
    step = -np.linalg.pinv(scaled.T @ scaled, rcond=1e-12, hermitian=True) @ (scaled.T @ residual) / scale
    return step * min(1.0, STEP_MAX_RAD / max(np.abs(step[TILTS]).max(), np.finfo(float).tiny))


def minimise(rows: Rows, point: Point) -> Point:
    """The minimum of the sum of squares that is reached from `point`, by Gauss-Newton with halved steps."""
    residual, jacobian = rows(point)
    for _ in range(MAX_ITERATIONS):
        step = gauss_newton_step(residual, jacobian)
        before = residual @ residual
        for _ in range(MAX_HALVINGS):
            moved = move(point, step)
            residual, jacobian = rows(moved)
            if residual @ residual <= before:
                break
            step = 0.5 * step
        else:
            break  # no step lowers the cost
        point = moved
        if np.abs(step[TILTS]).max() < STEP_DONE:
            break
    return point


def solve(samples: Samples, rates: Rows, per_sample: int, start: tuple[np.ndarray, np.ndarray]) -> Solution:
    """The minimum near `start`; `per_sample` is the number of rows that `rates` has of a sample."""
    acc = acc_rows(samples)
    readings = per_sample * len(samples.t_s) * samples.period_s / UNIT_S
    point, power = make_point(*start), 1.0
    for _ in range(POWER_ROUNDS):
        point = minimise(joined(rates, acc, prior_rows(power)), point)
        cost = float(np.sum(rates(point)[0] ** 2))
        power = max(cost / readings, POWER_MIN)
    bias = GYR_BIAS_RAD_S * point.bias
    return Solution(point.frame1.j, point.frame2.j, bias[0] * point.frame1.u + bias[1] * point.frame1.v,
                    bias[2] * point.frame2.u + bias[3] * point.frame2.v, cost, power)


def solve_lengths(t_s: np.ndarray, gyr1: np.ndarray, acc1: np.ndarray, gyr2: np.ndarray, acc2: np.ndarray,
                  start: tuple[np.ndarray, np.ndarray]) -> Solution:
    """The axes by the squared lengths of the rates across them (section 2)."""
    samples = Samples(t_s, gyr1, acc1, gyr2, acc2)
    return solve(samples, length_rows(samples), 1, start)


def solve_vectors(t_s: np.ndarray, gyr1: np.ndarray, acc1: np.ndarray, gyr2: np.ndarray, acc2: np.ndarray,
                  start: tuple[np.ndarray, np.ndarray], block_s: float = BLOCK_S) -> Solution:
    """The axes by the vectors of the rates across them (section 4)."""
    samples = Samples(t_s, gyr1, acc1, gyr2, acc2)
    return solve(samples, vector_rows(samples, block_s), 2, start)
