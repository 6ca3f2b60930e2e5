"""Float64 reference of the functional joint: sums, solve, bounds and judgement.

    joint = Joint()
    for tick1, tick2 in ticks:
        joint.add(tick1, tick2)
    joint.point, joint.verdict

Ticks come from jointcal_tools.functional_sensor. Three residuals, with x_i = [1; -r_i],
F_i = [U_i B_i], and for each block of 5 s a heading h and a relative turn D (both take
level frame 2 to level frame 1):

    turn   R_1 j_1 - Rz(h) R_2 j_2      rad
    rate   Q_1 j_1 - D Q_2 j_2          a rate; its weight 1 / rate^2 makes it an angle
    lever  F_1 x_1 - Rz(h) F_2 x_2      m/s

Each sum of squares is x_1' S_11 x_1 + x_2' S_22 x_2 - 2 x_1' X x_2 and only X depends on
h and D. Half of it, each kind with its weight l and divided by what it was summed over,
is `cost`, which everything below makes smallest:

    l_t / W sum turn^2 / 2 + l_r / Wr sum rate^2 / 2 + l_l / W sum lever^2 / 2
        - kappa sum_k tr(D_k' Rz(h_k)),    kappa = 1 / (2 sigma^2), sigma = 4 deg

No arithmetic is shared with the C code: relative turns are nearest rotations by SVD, not
Newton steps; the axes to begin with are eigenvectors of the 6 x 6, not an inverse
iteration; linear systems are solved and not factored by Cholesky; bending and stiffness
come from singular values; tangent bases are of another kind. Constants are the same.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from .functional_sensor import Tick, Warmth

DEG = np.pi / 180.0
TURN, RATE, LEVER = range(3)

# Sums.
REST_RATE2 = 0.3  # (rad/s)^2 of both sensors: a moment counts half
RATE_SMOOTHING_S = 0.1
BLOCK_S, BLOCK_MOTION_S = 5.0, 0.4  # a block is closed when it is that long and holds that much motion
BLOCKS = 2  # that are kept apart: the open one and one that is closed
MOTION_MAX_S, MOTION_MAX_BEFORE_S = 60.0, 20.0  # of motion in all sums, once ready and before

# Sizes of residuals: floors; motion that takes one independent reading, s; rows across an axis, or of a velocity, halved.
FLOORS = np.array([(4.0 * DEG) ** 2, 0.01**2, 2e-4])
MEMORY_S = np.array([4.0, 0.3, 1.0])
ROWS = np.array([1.0, 1.0, 1.5])
LASTING = 0.16  # share of a mean square that never averages out
KAPPA = 1.0 / (2.0 * (4.0 * DEG) ** 2)
RIDGE = 0.005
STEP_MAX = 0.4
BLOCK_MIN_S = 1e-3  # a block with less motion keeps its heading

# Search.
MOTION_FIRST_S, JUDGE_EVERY_S = 0.7, 0.25
HEADINGS, FIRST_ROUNDS, TRIAL_ROUNDS, ROUNDS = 8, 8, 4, 2
GUESS = np.array([0.02, 0.01, 0.01])  # sizes before anything is known
AHEAD, EVIDENCE_TURN = 0.5, -1.0

# Bounds: rigid mount, person.
BOUND_FLOOR = (1.0 * DEG, 2.0 * DEG)
BOUND_LASTING = (0.25, 1.0)
PERSON_RATE, READING_S = 0.01, 2.5
UNKNOWN = np.pi / 2.0
HOME_MAX = 0.1  # longest last step of an axis, rad

# Gates.
AGREED_MIN = 3
GRAVITY_OFF_MAX, MOTION_MIN_S, LEANING_MAX, LACK_MAX = 0.6, 3.0, 20.0 * DEG, 0.025
BEND_MIN, CLEAR_BEND_MIN, CLEAR_BEND_LACK = 15.0 * DEG, 40.0 * DEG, 0.03
STIFFNESS_MIN, SHARE_MIN = 0.05, 0.8
EVIDENCE_MIN, LEVER_EVIDENCE_MIN, OPPOSITE_MIN = 7.0, 3.0, 4.0
SPEED_NOISE2, SPEED_MIN2, OPPOSITE_LEAST2 = 6e-4, 0.03, 3e-4
BOUND_FOR_FLEXION = 10.0 * DEG


def about_z(heading: complex) -> np.ndarray:
    """Rz of a heading given as a unit complex number."""
    return np.array([[heading.real, -heading.imag, 0.0], [heading.imag, heading.real, 0.0], [0.0, 0.0, 1.0]])


def nearest_rotation(m: np.ndarray) -> np.ndarray:
    """The rotation D that makes tr(D' M) largest."""
    u, _, vt = np.linalg.svd(m)
    return u @ np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ vt))]) @ vt


def turn_of(v: np.ndarray) -> np.ndarray:
    """The rotation by a rotation vector, rad."""
    angle = float(np.linalg.norm(v))
    k = skew(v)
    a, b = (np.sin(angle) / angle, (1.0 - np.cos(angle)) / angle**2) if angle > 1e-8 else (1.0, 0.5)
    return np.eye(3) + a * k + b * k @ k


def skew(v: np.ndarray) -> np.ndarray:
    """[v]x: [v]x r = v x r."""
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def slope_vector(n: np.ndarray) -> np.ndarray:
    """Derivative of -tr(D' M) by a turn D exp([t]x) at t = 0, N = D' M."""
    return np.array([n[1, 2] - n[2, 1], n[2, 0] - n[0, 2], n[0, 1] - n[1, 0]])


def tangents(j: np.ndarray) -> np.ndarray:
    """(3, 2): two unit vectors across j."""
    u = np.cross(j, np.eye(3)[np.argmin(np.abs(j))])
    u /= np.linalg.norm(u)
    return np.column_stack([u, np.cross(j, u)])


def moved(j: np.ndarray, step: np.ndarray) -> np.ndarray:
    return (j + step) / np.linalg.norm(j + step)


# Sums.


@dataclass
class Block:
    """What depends on the heading of one block."""

    turn: np.ndarray = field(default_factory=lambda: np.zeros((3, 3), complex))  # C: (x1 - i y1)(x2 + i y2)' of rows of R
    lever: np.ndarray = field(default_factory=lambda: np.zeros((4, 4), complex))  # the same of F
    rate: np.ndarray = field(default_factory=lambda: np.zeros((3, 3, 3, 3)))  # [a][i][b][j]: Q1[a][i] Q2[b][j]
    motion_s: float = 0.0
    time_s: float = 0.0

    @property
    def level_rate(self) -> np.ndarray:
        """(3, 3) complex: what `rate` is where D is about z only, but for the vertical rows."""
        x = self.rate
        return x[0, :, 0] + x[1, :, 1] + 1j * (x[0, :, 1] - x[1, :, 0])


@dataclass
class Point:
    """One solution, with what its residuals are like."""

    j1: np.ndarray = field(default_factory=lambda: np.array([0.0, 0.0, 1.0]))
    j2: np.ndarray = field(default_factory=lambda: np.array([0.0, 0.0, 1.0]))
    r1: np.ndarray = field(default_factory=lambda: np.zeros(3))
    r2: np.ndarray = field(default_factory=lambda: np.zeros(3))
    heading: list[complex] = field(default_factory=lambda: [1.0 + 0.0j] * BLOCKS)
    turn: list[np.ndarray] = field(default_factory=lambda: [np.eye(3)] * BLOCKS)
    size: np.ndarray = field(default_factory=lambda: GUESS.copy())
    weight: np.ndarray = field(default_factory=lambda: 1.0 / GUESS)
    lack: float = 0.0  # sum of squares that the levers leave
    speed2: float = 0.0  # mean square of both sides
    energy: float = np.inf  # per second of motion

    @property
    def j(self) -> np.ndarray:
        return np.r_[self.j1, self.j2]

    @property
    def x1(self) -> np.ndarray:
        return np.r_[1.0, -self.r1]

    @property
    def x2(self) -> np.ndarray:
        return np.r_[1.0, -self.r2]

    def copy(self) -> Point:
        return Point(self.j1, self.j2, self.r1, self.r2, list(self.heading), list(self.turn), self.size.copy(),
                     self.weight.copy(), self.lack, self.speed2, self.energy)


class Weights(NamedTuple):
    motion_s: float
    spin: float  # motion_s / rate2 of moments that count
    rate2: float


def weights_of(dt_s: float, rate2: float) -> Weights:
    return Weights(dt_s * rate2 / (rate2 + REST_RATE2), dt_s * rate2 / (rate2 + REST_RATE2) ** 2, rate2)


def lever_rows(tick: Tick) -> np.ndarray:
    """F (3, 4)."""
    return np.column_stack([tick.velocity, tick.lever])


def complex_rows(m: np.ndarray, sign: float) -> np.ndarray:
    """Horizontal rows x + sign i y."""
    return m[0] + sign * 1j * m[1]


class Sums:
    """Everything the joint is solved from."""

    def __init__(self) -> None:
        self.motion_s = self.rate2 = 0.0  # W, Wr
        self.turn_up, self.rate_up, self.lever_up = np.zeros((3, 3)), np.zeros((3, 3)), np.zeros((4, 4))
        self.rate1, self.rate2nd = np.zeros((3, 3)), np.zeros((3, 3))  # A
        self.lever1, self.lever2 = np.zeros((4, 4)), np.zeros((4, 4))  # S
        self.along = np.zeros((3, 3))  # G
        self.old_turn, self.old_lever, self.old_rate = np.zeros((3, 3)), np.zeros((4, 4)), np.zeros((3, 3))
        self.rate_free = np.zeros((3, 3))
        self.blocks = [Block() for _ in range(BLOCKS)]  # 0 is open

    def add(self, tick1: Tick, tick2: Tick, w: Weights) -> None:
        f1, f2 = lever_rows(tick1), lever_rows(tick2)
        self.motion_s += w.motion_s
        self.rate2 += w.spin * w.rate2
        self.turn_up += w.motion_s * np.outer(tick1.turn[2], tick2.turn[2])
        self.rate1 += w.spin * tick1.rate.T @ tick1.rate
        self.rate2nd += w.spin * tick2.rate.T @ tick2.rate
        self.lever1 += w.motion_s * f1.T @ f1
        self.lever2 += w.motion_s * f2.T @ f2
        self.lever_up += w.motion_s * np.outer(f1[2], f2[2])
        self.along += w.spin * np.outer(tick1.gyr, tick2.gyr)
        self.rate_up += w.spin * np.outer(tick1.rate[2], tick2.rate[2])
        block = self.blocks[0]
        block.turn = block.turn + w.motion_s * np.outer(complex_rows(tick1.turn, -1.0), complex_rows(tick2.turn, 1.0))
        block.lever = block.lever + w.motion_s * np.outer(complex_rows(f1, -1.0), complex_rows(f2, 1.0))
        block.rate = block.rate + w.spin * np.multiply.outer(tick1.rate, tick2.rate)
        block.motion_s += w.motion_s
        block.time_s += tick1.dt_s

    @property
    def is_full(self) -> bool:
        return self.blocks[0].time_s >= BLOCK_S and self.blocks[0].motion_s >= BLOCK_MOTION_S

    def close(self, point: Point) -> None:
        """The oldest block is merged with its heading and its turn; another one begins with the heading of the last."""
        old, heading, turn = self.blocks.pop(), point.heading.pop(), point.turn.pop()
        self.old_turn = self.old_turn + (heading * old.turn).real
        self.old_lever = self.old_lever + (heading * old.lever).real
        self.old_rate = self.old_rate + (heading * old.level_rate).real
        self.rate_free = self.rate_free + np.einsum("ab,aibj->ij", turn, old.rate)
        self.blocks.insert(0, Block())
        point.heading.insert(0, point.heading[0])
        point.turn.insert(0, point.turn[0])

    def fade(self, share: float) -> None:
        for name, value in vars(self).items():
            if name != "blocks":
                setattr(self, name, share * value)
        for block in self.blocks:
            block.turn, block.lever, block.rate = share * block.turn, share * block.lever, share * block.rate
            block.motion_s *= share

    def reverse(self) -> None:
        """All merged headings turn by half a turn; merged relative turns are lost."""
        old_up = self.rate_up - sum(block.rate[2, :, 2] for block in self.blocks)
        self.old_turn, self.old_lever, self.old_rate = -self.old_turn, -self.old_lever, -self.old_rate
        self.rate_free = old_up + self.old_rate


# What the sums are with headings and relative turns put in.


class Cross(NamedTuple):
    """X of the residuals; `level` is that of the rates with D = Rz(h)."""

    turn: np.ndarray
    rate: np.ndarray
    lever: np.ndarray
    level: np.ndarray


def cross_of(sums: Sums, point: Point) -> Cross:
    turn, rate = sums.turn_up + sums.old_turn, sums.rate_free.copy()
    lever, level = sums.lever_up + sums.old_lever, sums.rate_up + sums.old_rate
    for block, heading, d in zip(sums.blocks, point.heading, point.turn, strict=True):
        turn = turn + (heading * block.turn).real
        lever = lever + (heading * block.lever).real
        level = level + (heading * block.level_rate).real
        rate = rate + np.einsum("ab,aibj->ij", d, block.rate)
    return Cross(turn, rate, lever, level)


def quadrics(sums: Sums, cross: Cross) -> tuple[np.ndarray, np.ndarray]:
    """(6, 6) each: sum of squares of turns and of rates, of j = [j1; j2]."""
    own = sums.motion_s * np.eye(3)
    return (np.block([[own, -cross.turn], [-cross.turn.T, own]]),
            np.block([[sums.rate1, -cross.rate], [-cross.rate.T, sums.rate2nd]]))


def lever_squares(sums: Sums, lever_cross: np.ndarray, x1: np.ndarray, x2: np.ndarray) -> tuple[float, float]:
    """Sum of squares that is left, and of both sides."""
    own = x1 @ sums.lever1 @ x1 + x2 @ sums.lever2 @ x2
    return float(own - 2.0 * x1 @ lever_cross @ x2), float(own)


def put_levers(sums: Sums, lever_cross: np.ndarray, point: Point) -> None:
    """r1, r2, lack and speed2 of `point`."""
    h = np.block([[sums.lever1[1:, 1:], -lever_cross[1:, 1:]], [-lever_cross[1:, 1:].T, sums.lever2[1:, 1:]]])
    g = np.r_[sums.lever1[1:, 0] - lever_cross[1:, 0], sums.lever2[1:, 0] - lever_cross[0, 1:]]
    r = np.linalg.lstsq(h + RIDGE / 6.0 * np.trace(h) * np.eye(6), g, rcond=None)[0]
    point.r1, point.r2 = r[:3], r[3:]
    lack, own = lever_squares(sums, lever_cross, point.x1, point.x2)
    point.lack, point.speed2 = max(lack, 0.0), own / sums.motion_s


def measure(sums: Sums, cross: Cross, point: Point) -> None:
    """size, weight and energy of `point` at its axes and lack."""
    turns, rates = quadrics(sums, cross)
    sizes = np.array([point.j @ turns @ point.j / (2.0 * sums.motion_s), point.j @ rates @ point.j / (2.0 * sums.rate2),
                      point.lack / (3.0 * sums.motion_s)])
    point.size = np.maximum(sizes, FLOORS)
    point.weight = 1.0 / (point.size * (LASTING + MEMORY_S / sums.motion_s))
    point.energy = float(np.sum(ROWS / MEMORY_S * np.log(point.size)))


def weighted_quadric(sums: Sums, cross: Cross, point: Point) -> np.ndarray:
    turns, rates = quadrics(sums, cross)
    return point.weight[TURN] / sums.motion_s * turns + point.weight[RATE] / sums.rate2 * rates


def cost(sums: Sums, point: Point) -> float:
    """What is made smallest for given weights."""
    cross = cross_of(sums, point)
    left, _ = lever_squares(sums, cross.lever, point.x1, point.x2)
    tied = sum(np.trace(d.T @ about_z(h)) for h, d in zip(point.heading, point.turn, strict=True))
    return float(0.5 * point.j @ weighted_quadric(sums, cross, point) @ point.j
                 + 0.5 * point.weight[LEVER] / sums.motion_s * left - KAPPA * tied)


# Axes.


def tangent_hessian(h: np.ndarray, point: Point, bend: bool = True) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(4, 4) second and (4,) first derivative of j' H j / 2 along the tangents (6, 4) of both axes."""
    t = np.zeros((6, 4))
    t[:3, :2], t[3:, 2:] = tangents(point.j1), tangents(point.j2)
    slope = h @ point.j
    off = [slope[:3] @ point.j1] * 2 + [slope[3:] @ point.j2] * 2
    return t.T @ h @ t - np.diag(off) * bend, t.T @ slope, t


def step_axes(h: np.ndarray, point: Point) -> None:
    """One Newton step on both spheres; where the second derivative is not positive, without what the spheres' bend takes off."""
    hessian, slope, t = tangent_hessian(h, point)
    if np.linalg.eigvalsh(hessian)[0] <= 0.0:
        hessian, slope, t = tangent_hessian(h, point, bend=False)
    step = -np.linalg.solve(hessian, slope)
    step *= min(1.0, STEP_MAX / max(float(np.linalg.norm(step)), 1e-300))
    point.j1, point.j2 = moved(point.j1, t[:3] @ step), moved(point.j2, t[3:] @ step)


def open_axes(h: np.ndarray) -> list[tuple[np.ndarray, np.ndarray]]:
    """The axes that H knows least, and those it knows second least."""
    _, vectors = np.linalg.eigh(h)
    pairs = [(v[:3], v[3:]) for v in vectors.T[:2]]
    return [(a / np.linalg.norm(a), b / np.linalg.norm(b)) for a, b in pairs
            if min(np.linalg.norm(a), np.linalg.norm(b)) > 1e-3]


# Headings and relative turns.


def rate_pull(sums: Sums, point: Point, b: int) -> np.ndarray:
    """M (3, 3): the share of block b in the cost is -tr(D' M)."""
    scale = point.weight[RATE] / sums.rate2
    return scale * np.einsum("aibj,i,j->ab", sums.blocks[b].rate, point.j1, point.j2)


def turn_pull(sums: Sums, point: Point, b: int) -> complex:
    """The share of block b in the cost is -Re(h pull)."""
    return complex(point.weight[TURN] / sums.motion_s * (point.j1 @ sums.blocks[b].turn @ point.j2))


def lever_pull(sums: Sums, point: Point, b: int) -> complex:
    return complex(point.weight[LEVER] / sums.motion_s * (point.x1 @ sums.blocks[b].lever @ point.x2))


def best_heading(sums: Sums, point: Point, b: int) -> complex:
    """The heading for a relative turn that goes with it, D = Rz(h) E with the E it has."""
    n = rate_pull(sums, point, b) @ point.turn[b].T @ about_z(point.heading[b])
    z = n[0, 0] + n[1, 1] + 1j * (n[1, 0] - n[0, 1])
    z += np.conj(turn_pull(sums, point, b) + lever_pull(sums, point, b))
    return complex(z / abs(z)) if abs(z) > 1e-30 else point.heading[b]


def find_heading(sums: Sums, point: Point, b: int) -> None:
    if sums.blocks[b].motion_s <= BLOCK_MIN_S:
        return
    point.heading[b] = best_heading(sums, point, b)
    point.turn[b] = nearest_rotation(rate_pull(sums, point, b) + KAPPA * about_z(point.heading[b]))


def turn_all(point: Point, by: complex) -> None:
    point.heading = [h * by for h in point.heading]
    point.turn = [about_z(h) for h in point.heading]


# Bounds.


def nuisance(sums: Sums, point: Point, b: int) -> np.ndarray:
    """(3, 3): second derivative of the cost by the turn of block b about the axes of L2, the heading going along about z."""
    d = point.turn[b]
    n = d.T @ (rate_pull(sums, point, b) + KAPPA * about_z(point.heading[b]))
    n = 0.5 * (n + n.T)
    out = np.trace(n) * np.eye(3) - n
    out[2, 2] += sum(max((point.heading[b] * pull(sums, point, b)).real, 0.0) for pull in (turn_pull, lever_pull)) - 2.0 * KAPPA
    return out


def nuisance_slope(sums: Sums, point: Point, b: int) -> np.ndarray:
    """(3,): first derivative of the cost by that turn. What ties heading and turn does not count about z: both go along."""
    n = point.turn[b].T @ rate_pull(sums, point, b)
    out = slope_vector(n + KAPPA * point.turn[b].T @ about_z(point.heading[b]))
    out[2] = slope_vector(n)[2] + (point.heading[b] * (turn_pull(sums, point, b) + lever_pull(sums, point, b))).imag
    return out


def coupling(sums: Sums, point: Point, b: int) -> np.ndarray:
    """(6, 3): derivative of the slope by that turn, by the components of j1 and j2."""
    block, d = sums.blocks[b], point.turn[b]
    scale = point.weight[RATE] / sums.rate2
    rows = [scale * slope_vector(d.T @ (block.rate[:, i] @ point.j2)) for i in range(3)]
    rows += [scale * slope_vector(d.T @ np.einsum("aib,i->ab", block.rate[:, :, :, k], point.j1)) for k in range(3)]
    out = np.array(rows)
    c = point.weight[TURN] / sums.motion_s * point.heading[b] * block.turn
    out[:, 2] += np.r_[c @ point.j2, point.j1 @ c].imag
    return out


def information(sums: Sums, point: Point) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(4, 4) what is known of both axes when headings and relative turns are free, the slope (4,) then, and the tangents (6, 4)."""
    hessian, slope, t = tangent_hessian(weighted_quadric(sums, cross_of(sums, point), point), point)
    for b, block in enumerate(sums.blocks):
        if block.motion_s > BLOCK_MIN_S:
            q = t.T @ coupling(sums, point, b)
            he = nuisance(sums, point, b)
            if np.linalg.eigvalsh(he)[0] <= 0.0:
                return np.zeros((4, 4)), slope, t
            hessian = hessian - q @ np.linalg.solve(he, q.T)
            slope = slope - q @ np.linalg.solve(he, nuisance_slope(sums, point, b))
    return hessian, slope, t


def bounds_of(sums: Sums, point: Point) -> np.ndarray:
    """(2,) 95 % bounds of the axes, rad. `point` makes its last step to the minimum; each bound has the length of its axis' step."""
    hessian, slope, t = information(sums, point)
    if np.linalg.eigvalsh(hessian)[0] <= 0.0:
        return np.full(2, UNKNOWN)
    p = np.linalg.inv(hessian)
    widest = np.sqrt([np.linalg.eigvalsh(p[:2, :2])[-1], np.linalg.eigvalsh(p[2:, 2:])[-1]])
    person = min(point.size[RATE] / PERSON_RATE, 1.0)
    floor, lasting = (a + (b - a) * person for a, b in (BOUND_FLOOR, BOUND_LASTING))
    step = -np.linalg.solve(hessian, slope)
    way = np.linalg.norm(step.reshape(2, 2), axis=1)
    step *= min(1.0, HOME_MAX / max(float(way.max()), 1e-300))
    point.j1, point.j2 = moved(point.j1, t[:3] @ step), moved(point.j2, t[3:] @ step)
    return np.minimum(floor + widest * np.sqrt(lasting + READING_S / sums.motion_s) + way, UNKNOWN)


def flexion_bound(bound: float, size: np.ndarray, bend: float) -> float:
    """Error of the angle, rms: what leans across, and what the axis' own error makes of the bending."""
    return bound * float(np.hypot(np.sqrt(2.0 * size[TURN]), 0.5 * bend * bound))


# Judgement.


@dataclass
class Verdict:
    bounds: np.ndarray = field(default_factory=lambda: np.full(2, UNKNOWN))
    flexion: float = UNKNOWN
    evidence: np.ndarray = field(default_factory=lambda: np.zeros(3))
    opposite: float = 0.0
    share: float = 0.0
    bend: float = 0.0
    stiffness: float = 0.0
    reason: str = "no-data"
    agreed: int = 0

    @property
    def ready(self) -> bool:
        return self.agreed >= AGREED_MIN


def rival_of(sums: Sums, point: Point, steps: int = 2) -> tuple[Point, np.ndarray]:
    """The other pairing, and the logarithms of the odds for this one, of each kind of residual."""
    cross = cross_of(sums, point)
    other = point.copy()
    other.j2 = -other.j2
    turned = Cross(2.0 * sums.turn_up - cross.turn, 2.0 * sums.rate_up - cross.level, 2.0 * sums.lever_up - cross.lever,
                   cross.level)
    put_levers(sums, turned.lever, other)
    for _ in range(steps):
        measure(sums, turned, other)
        step_axes(weighted_quadric(sums, turned, other), other)
    measure(sums, turned, other)
    level = point.copy()
    measure(sums, cross._replace(rate=cross.level), level)
    return other, ROWS / MEMORY_S * sums.motion_s * np.log(other.size / level.size)


def describe(sums: Sums, point: Point) -> tuple[float, float, float]:
    """Share of the relative rate along the axis, bending, rad, stiffness: what one fixed rotation leaves of the rates."""
    cross = cross_of(sums, point)
    _, rates = quadrics(sums, cross)
    squares = [0.5 * np.trace(a) * np.eye(3) - a for a in (sums.rate1, sums.rate2nd)]  # sum of w w'
    across = max(point.j @ rates @ point.j, 0.0)
    along = point.j1 @ squares[0] @ point.j1 + point.j2 @ squares[1] @ point.j2 - 2.0 * point.j1 @ sums.along @ point.j2
    singular = np.linalg.svd(cross.turn, compute_uv=False)
    bend = np.sqrt(max(2.0 - (singular[1] + singular[2]) / sums.motion_s, 0.0))
    best = np.trace(nearest_rotation(sums.along).T @ sums.along)
    rate1, rate2 = np.trace(squares[0]), np.trace(squares[1])
    return float(along / (along + across)), float(bend), float((rate1 + rate2 - 2.0 * best) / min(rate1, rate2))


def reason_of(joint: Joint) -> str:
    """The first thing that keeps the estimate from being ready, the worst first; "" if there is none. Without hysteresis."""
    sums, point, v = joint.sums, joint.point, joint.verdict
    left = point.lack / sums.motion_s
    clear = v.bend * np.sqrt(max(v.share, 0.0) / max(1.0 - v.share, 1e-7))
    clear /= 1.0 + max(left - SPEED_NOISE2, 0.0) / point.speed2 / CLEAR_BEND_LACK
    flexion = v.flexion <= joint.max_flexion and v.bounds.max() <= BOUND_FOR_FLEXION
    gates = [("gravity-off", joint.gravity_off <= GRAVITY_OFF_MAX), ("no-motion", sums.motion_s >= MOTION_MIN_S),
             ("does-not-fit", 2.0 * point.size[TURN] <= LEANING_MAX**2),
             ("not-one-joint", left - SPEED_NOISE2 <= LACK_MAX * point.speed2),
             ("no-bend", v.bend >= BEND_MIN and v.stiffness >= STIFFNESS_MIN), ("more-axes", v.share >= SHARE_MIN and clear >= CLEAR_BEND_MIN),
             ("sign-open", v.evidence.sum() >= EVIDENCE_MIN and v.evidence[LEVER] >= LEVER_EVIDENCE_MIN
              and point.speed2 >= SPEED_MIN2 and v.opposite - SPEED_NOISE2 >= OPPOSITE_MIN * max(left, OPPOSITE_LEAST2)),
             ("uncertain", flexion or v.bounds.max() <= joint.max_bound)]
    return next((name for name, passed in gates if not passed), "")


class Joint:
    """The joint as ticks come, judged every quarter of a second of time. No hints, no slips, no hysteresis."""

    def __init__(self, max_bound: float = 3.0 * DEG, max_flexion: float = 3.0 * DEG) -> None:
        self.max_bound, self.max_flexion = max_bound, max_flexion
        self.sums, self.point, self.verdict = Sums(), Point(), Verdict()
        self.rate2 = self.motion_s = self.since_s = self.gravity_off = 0.0
        self.epochs: tuple[int, int] | None = None
        self.warmth = Warmth()
        self.merged = self.has_estimate = self.was_ready = False
        self.turn = 0

    def add(self, tick1: Tick, tick2: Tick) -> bool:
        """True if there was a judgement."""
        epochs = (tick1.epoch, tick2.epoch)
        if self.epochs not in (None, epochs):
            self.cut()
        self.epochs = epochs
        if self.warmth.is_cold(tick1, tick2):
            return False
        self.gravity_off = max(abs(tick.acc_level - 9.81) for tick in (tick1, tick2))
        rate2 = float(tick1.gyr @ tick1.gyr + tick2.gyr @ tick2.gyr)
        self.rate2 += tick1.dt_s / (tick1.dt_s + RATE_SMOOTHING_S) * (rate2 - self.rate2)
        weights = weights_of(tick1.dt_s, self.rate2)
        self.motion_s += weights.motion_s
        self.sums.add(tick1, tick2, weights)
        if self.sums.is_full:
            self.close()
            if self.sums.motion_s > (MOTION_MAX_S if self.was_ready else MOTION_MAX_BEFORE_S):
                self.sums.fade(0.5)
        self.since_s += tick1.dt_s
        if self.motion_s < MOTION_FIRST_S or self.since_s < JUDGE_EVERY_S - 1e-9:
            return False
        self.since_s = 0.0
        self.judge()
        return True

    def close(self) -> None:
        self.merged = self.merged or self.sums.blocks[-1].motion_s > 0.0
        self.sums.close(self.point)

    def cut(self) -> None:
        """The features began anew. Before there is an estimate no block has a heading that it could be merged with."""
        if not self.has_estimate and self.sums.blocks[-1].motion_s > 0.0:
            self.sums, self.point, self.motion_s = Sums(), Point(), 0.0
        elif self.sums.blocks[0].motion_s > 0.0:
            self.close()

    def round(self, point: Point) -> None:
        """Levers, axes and headings once better."""
        cross = cross_of(self.sums, point)
        put_levers(self.sums, cross.lever, point)
        measure(self.sums, cross, point)
        step_axes(weighted_quadric(self.sums, cross, point), point)
        measure(self.sums, cross, point)
        for b in range(BLOCKS):
            find_heading(self.sums, point, b)

    def trials(self, number: int, rounds: int) -> Iterator[Point]:
        """Solutions with the headings turned by `number` times 45 deg."""
        begin = self.point.copy()
        turn_all(begin, complex(np.exp(0.25j * np.pi * number)))
        begin.weight = 1.0 / GUESS
        for j1, j2 in open_axes(weighted_quadric(self.sums, cross_of(self.sums, begin), begin)):
            trial = begin.copy()
            trial.j1, trial.j2 = j1, j2
            for _ in range(rounds):
                self.round(trial)
            yield trial

    def search(self) -> None:
        numbers = [self.turn] if self.has_estimate else list(range(HEADINGS))
        trials = [t for n in numbers for t in self.trials(n, TRIAL_ROUNDS if self.has_estimate else FIRST_ROUNDS)]
        self.turn = (self.turn + 1) % HEADINGS
        best = min(trials, key=lambda trial: trial.energy, default=self.point)
        if not self.has_estimate or self.sums.motion_s * (self.point.energy - best.energy) > AHEAD:
            sign = np.sign(best.j1 @ self.point.j1 + best.j2 @ self.point.j2) if self.has_estimate else 1.0
            best.j1, best.j2 = sign * best.j1, sign * best.j2
            self.point, self.has_estimate, self.verdict.agreed = best, True, 0

    def judge(self) -> None:
        v = self.verdict
        if self.has_estimate:
            for _ in range(ROUNDS):
                self.round(self.point)
        if not self.has_estimate or not self.merged:
            self.search()
        other, v.evidence = rival_of(self.sums, self.point)
        v.opposite = other.lack / self.sums.motion_s
        if v.evidence.sum() < EVIDENCE_TURN:
            self.point.j1, self.point.j2 = other.j1, other.j2
            turn_all(self.point, -1.0 + 0.0j)
            self.sums.reverse()
            v.agreed = 0
        v.bounds = bounds_of(self.sums, self.point)
        v.share, v.bend, v.stiffness = describe(self.sums, self.point)
        v.flexion = flexion_bound(float(v.bounds.max()), self.point.size, v.bend)
        v.reason = reason_of(self)
        v.agreed = min(v.agreed + 1, AGREED_MIN) if v.reason == "" else 0
        self.was_ready = self.was_ready or v.ready


# The angle.


def flexion(point: Point, heading: complex, turn1: np.ndarray, turn2: np.ndarray) -> float:
    """Twist of R1' Rz R2 about the axes, rad, from an arbitrary zero."""
    relative = turn1.T @ about_z(heading) @ turn2
    m = tangents(point.j1).T @ relative @ tangents(point.j2)
    return float(np.arctan2(m[1, 0] - m[0, 1], m[0, 0] + m[1, 1]))
