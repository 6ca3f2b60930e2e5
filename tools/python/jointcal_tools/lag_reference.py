"""Float64 reference of the lag between two sensors of one joint.

    lag = Lag()
    for tick1, tick2 in ticks:
        lag.add(tick1, tick2)
        if now and then:
            lag.judge()
            shift_s = lag.shift()  # s by which sensor 2's times are to be put back from now on

Ticks come from jointcal_tools.functional_sensor, of both sensors at the same times as each tells
them. What both share is the velocity of the joint's centre, 0.4 to 3 Hz. With x_i = [1; -r_i],
F_i = [U_i B_i] and a heading h (level frame 2 to level frame 1),

    J(lag) = min over r_1, r_2, h of  sum |F_1(t) x_1 - Rz(h) F_2(t + lag) x_2|^2.

The lag is where J is least: sensor 2 says too late by it. What depends on the lag is the
products of F_1 and F_2 and those of F_2; they are summed at NODES lags, one tick apart, and
between them they are the polynomial through the nearest NEAR of them. Every second tick is summed. No axis is asked for, and neither the lengths of the
rates, which differ by what the joint does, nor anything faster than 3 Hz, where skin moves by
itself.

No arithmetic is shared with the C code. Constants are the same.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field

import numpy as np

from .functional_reference import RATE_SMOOTHING_S, complex_rows, lever_rows, weights_of
from .functional_sensor import Tick

SIDE = 6  # nodes on each side of zero
NODES = 2 * SIDE + 1
NEAR = 7  # nodes that a polynomial goes through
EVERY = 2  # ticks of which one is summed
RANGE_S = 0.25
WARM_FIRST_S, WARM_S = 2.0, 3.0  # that filters must have run, from the first reading on and after a gap
MOTION_MAX_S = 30.0  # of motion in the sums, which are halved then
RIDGE = 1e-3  # share of the mean diagonal
HEADINGS, TRIAL_ROUNDS, ROUNDS = 4, 2, 2  # one more round of the best heading
PASSES = 3  # parabolas
STEP_NODES = 0.25  # distance of a parabola's points, nodes
STEP_MAX_NODES = 0.5
NEIGHBOUR_NODES = 1.5

FLOOR_S, SHARE, READING_S, SHARE_FLOOR = 0.002, 1.1, 1.0, 0.002
SHARE_MAX, RIVAL_MIN, RIVAL_FLOOR, SPEED2_MIN = 0.05, 2.5, 0.01, 0.0016
MOTION_MIN_S, BOUND_MAX_S, AGREED_MIN = 3.0, 0.010, 3
SHARE_DENIES, MOTION_DENIES_S = 0.1, 6.0  # what speaks against a lag that is known, and after how much motion
UNKNOWN_S = 1.0


@dataclass
class Point:
    """What is left at one lag."""

    lag: float = 0.0  # nodes
    heading: complex = 1.0 + 0.0j
    lack: float = 0.0  # (m/s)^2
    own: float = 1.0

    @property
    def share(self) -> float:
        return self.lack / self.own


@dataclass
class Sums:
    own1: np.ndarray = field(default_factory=lambda: np.zeros((4, 4)))
    own2: np.ndarray = field(default_factory=lambda: np.zeros((NODES, 4, 4)))
    up: np.ndarray = field(default_factory=lambda: np.zeros((NODES, 4, 4)))
    across: np.ndarray = field(default_factory=lambda: np.zeros((NODES, 4, 4), complex))
    count: float = 0.0
    motion_s: float = 0.0

    def fade(self, share: float) -> None:
        for name, value in vars(self).items():
            setattr(self, name, share * value)


def between(lag: float) -> np.ndarray:
    """Weights (NODES,) of the polynomial through the nearest nodes."""
    at = np.arange(-SIDE, SIDE + 1.0)
    first = int(np.clip(np.floor(lag + 0.5) + SIDE - NEAR // 2, 0, NODES - NEAR))
    near = at[first : first + NEAR]
    weights = np.zeros(NODES)
    weights[first : first + NEAR] = [np.prod([(lag - b) / (a - b) for b in near if b != a]) for a in near]
    return weights


class Lag:
    def __init__(self) -> None:
        self.epochs, self.ticks, self.node_s, self.rate2, self.since_s = (0, 0), 0, 0.05, 0.0, 0.0
        self.past1: deque[np.ndarray] = deque(maxlen=SIDE + 1)
        self.past2: deque[np.ndarray] = deque(maxlen=NODES)
        self.applied_s, self.left_s, self.known, self.known_bound_s = 0.0, 0.0, False, UNKNOWN_S
        self.begin()

    def begin(self) -> None:
        """Everything that was learnt with other times is forgotten."""
        self.sums = Sums()
        self.past1.clear()
        self.past2.clear()
        self.ticks, self.agreed = 0, 0
        self.lag_s, self.bound_s, self.share, self.rival, self.speed2 = 0.0, UNKNOWN_S, 1.0, 1.0, 0.0

    # Sums.

    def add(self, tick1: Tick, tick2: Tick) -> None:
        if (tick1.epoch, tick2.epoch) != self.epochs:
            self.epochs, self.since_s = (tick1.epoch, tick2.epoch), 0.0
        self.since_s += tick1.dt_s
        if self.since_s < (WARM_S if max(self.epochs) > 1 else WARM_FIRST_S) - 1e-4:
            self.ticks = 0
            self.past1.clear()
            self.past2.clear()
            return
        rate2 = float(tick1.gyr @ tick1.gyr + tick2.gyr @ tick2.gyr)
        self.rate2 += tick1.dt_s / (tick1.dt_s + RATE_SMOOTHING_S) * (rate2 - self.rate2)
        self.sums.motion_s += weights_of(tick1.dt_s, self.rate2).motion_s
        self.ticks += 1
        self.node_s = tick1.dt_s
        self.past1.append(lever_rows(tick1))
        self.past2.append(lever_rows(tick2))
        if len(self.past2) == NODES and self.ticks % EVERY == 1:
            self.put()

    def put(self) -> None:
        s, f1 = self.sums, self.past1[0]
        s.own1 += f1.T @ f1
        s.count += 1.0
        for node, f2 in enumerate(self.past2):
            s.own2[node] += f2.T @ f2
            s.up[node] += np.outer(f1[2], f2[2])
            s.across[node] += np.outer(complex_rows(f1, -1.0), complex_rows(f2, 1.0))
        if s.motion_s > MOTION_MAX_S:
            s.fade(0.5)

    # Solving.

    def round(self, point: Point) -> None:
        """Levers for the heading, heading for the levers."""
        s, by = self.sums, between(point.lag)
        own2, up, across = (np.tensordot(by, m, 1) for m in (s.own2, s.up, s.across))
        x = up + (point.heading * across).real
        h = np.block([[s.own1[1:, 1:], -x[1:, 1:]], [-x[1:, 1:].T, own2[1:, 1:]]])
        g = np.r_[s.own1[1:, 0] - x[1:, 0], own2[1:, 0] - x[0, 1:]]
        r = np.linalg.solve(h + (RIDGE * np.trace(h) / 6.0 + 1e-30) * np.eye(6), g)
        x1, x2 = np.r_[1.0, -r[:3]], np.r_[1.0, -r[3:]]
        point.own = float(x1 @ s.own1 @ x1 + x2 @ own2 @ x2) + 1e-30
        point.lack = max(point.own - 2.0 * float(x1 @ x @ x2), 0.0)
        pull = complex(x1 @ across @ x2)
        if abs(pull) > 0.0:
            point.heading = pull.conjugate() / abs(pull)

    def solved(self, lag: float, heading: complex, rounds: int) -> Point:
        point = Point(lag, heading)
        for _ in range(rounds):
            self.round(point)
        return point

    def search(self) -> list[Point]:
        """The best point at each node."""
        best = [min((self.solved(float(k), 1j**q, TRIAL_ROUNDS) for q in range(HEADINGS)), key=lambda p: p.share)
                for k in range(-SIDE, SIDE + 1)]
        return [self.solved(p.lag, p.heading, 1) for p in best]

    def refine(self, point: Point) -> tuple[Point, float]:
        """The least J by parabolas, and its second derivative, as a share of both sides, per node^2."""
        bend = 0.0
        for _ in range(PASSES):
            a, b, c = (self.solved(point.lag + d * STEP_NODES, point.heading, ROUNDS) for d in (-1.0, 0.0, 1.0))
            bend = (a.share - 2.0 * b.share + c.share) / STEP_NODES**2
            step = 0.5 * (a.share - c.share) / STEP_NODES / bend if bend > 0.0 else 0.0
            lag = np.clip(b.lag + np.clip(step, -STEP_MAX_NODES, STEP_MAX_NODES), -SIDE, SIDE)
            point = Point(float(lag), b.heading, b.lack, b.own)
        return point, bend

    def judge(self) -> None:
        s = self.sums
        if s.count < NODES:
            return
        nodes = self.search()
        point, bend = self.refine(min(nodes, key=lambda p: p.share))
        rival = min([p.share for p in nodes if abs(p.lag - point.lag) > NEIGHBOUR_NODES], default=1.0)
        before = self.lag_s
        self.share, self.rival = point.share, rival / max(point.share, RIVAL_FLOOR)
        self.speed2 = 0.5 * point.own / s.count
        self.lag_s, self.bound_s = point.lag * self.node_s, UNKNOWN_S
        readings = 3.0 * s.motion_s / READING_S
        if bend > 0.0 and readings > 0.0:
            spread = self.node_s * np.sqrt(2.0 * (point.share + SHARE_FLOOR) / (bend * readings))
            self.bound_s = min(FLOOR_S + SHARE * spread, UNKNOWN_S)
        fits = (s.motion_s >= MOTION_MIN_S and self.speed2 >= SPEED2_MIN and self.share <= SHARE_MAX and self.rival >= RIVAL_MIN
                and self.bound_s <= BOUND_MAX_S and abs(self.applied_s + self.lag_s) <= RANGE_S + self.bound_s)
        self.agreed = (self.agreed + 1 if abs(self.lag_s - before) <= self.bound_s else 1) if fits else 0
        self.decide()

    def decide(self) -> None:
        """What is known stays so until something speaks against it."""
        denied = self.known and self.sums.motion_s >= MOTION_DENIES_S and (
            self.share > SHARE_DENIES or self.rival < RIVAL_MIN or abs(self.lag_s - self.left_s) > self.bound_s + self.known_bound_s)
        if self.agreed >= AGREED_MIN:
            self.known, self.left_s, self.known_bound_s = True, self.lag_s, self.bound_s
        elif denied:
            self.known, self.left_s, self.known_bound_s = False, 0.0, UNKNOWN_S
            self.begin()

    def shift(self) -> float:
        """What is taken off from now on, s; 0: nothing."""
        if self.agreed < AGREED_MIN or abs(self.lag_s) <= self.bound_s:
            return 0.0
        off = self.lag_s
        self.applied_s += off
        self.left_s = 0.0
        self.begin()
        return off
