"""Float64 reference of a person's joint that has no axis, or two: headings, levers, and axes from windows that one motion dominates.

    joint = Ball()
    for tick1, tick2 in ticks:
        joint.add(tick1, tick2)
    joint.point, joint.verdict, joint.windows.kept

Ticks come from jointcal_tools.functional_sensor. With x_i = [1; -r_i], F_i = [U_i B_i] and a
heading h for each block of 5 s (level frame 2 to level frame 1) one residual is left,

    F_1 x_1 - Rz(h) F_2 x_2      m/s,

and what a heading may change by from block to block: sigma = 2 deg. Half the sum of squares,
divided by what it is summed over and by the size of the residual, and what ties the headings
is `cost`, which everything below makes smallest.

No arithmetic is shared with the C code: systems are solved and inverted whole, eigenvalues are
LAPACK's, bends come from singular values. Constants are the same.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .functional_reference import (BLOCK_MOTION_S, BLOCK_S, BLOCKS, DEG, FLOORS, HEADINGS, JUDGE_EVERY_S, LASTING, MEMORY_S,  # noqa: F401
                                   MOTION_FIRST_S, MOTION_MAX_BEFORE_S, MOTION_MAX_S, RATE_SMOOTHING_S, ROWS, about_z,
                                   complex_rows, lever_rows, nearest_rotation, weights_of)
from .functional_sensor import Tick, Warmth

SIZE_FLOOR = 5e-5  # (m/s)^2
RIDGE = 3e-4  # share of the mean diagonal
MEMORY = 1.0  # s of motion that take one independent reading
DRIFT = 2.0 * DEG  # of a heading, from block to block
PULL = 1.0 / DRIFT**2
TRIAL_ROUNDS, ROUNDS = 4, 2
AHEAD = 0.5

UNKNOWN_M, UNKNOWN = 10.0, np.pi / 2.0
LEVER_FLOOR_M, LEVER_SHARE = 0.003, 0.5
SKIN = (0.17, 0.10)  # share of a lever that no IMU can see: skin that goes along with its own segment, proximal, distal
HEADING_SHARE = 2.0
OPEN_SHARE, OPEN_VARIANCE = 1e-5, 0.5  # of the largest diagonal element, to every direction of the levers; what it alone leaves is no knowledge

AGREED_MIN = 3
REFUSED_MAX_S = 10.0  # of motion that is no joint, before the first one
GRAVITY_OFF_MAX, MOTION_MIN_S, LACK_MAX, STIFFNESS_MIN, SPEED_NOISE2 = 0.6, 3.0, 0.05, 0.07, 2e-4
LACK_MOTION_S = 8.0  # of motion from which on so much may be left

# Windows.
PART_S = 2.5
RATE_KNEE2 = 4.0  # (rad/s)^2 of the relative rate, beyond which it counts less
WINDOW_MOTION_S, SIDEWAYS_MAX, TURNED_MAX, BEND_MIN = 1.0, 0.12, 15.0 * DEG, 0.2
SKIN_COSINE, ACROSS_COSINE, ALONG_COSINE = 0.85, 0.5, 0.9
ARM_MIN_M, LEVER_BOUND_SHARE = 0.1, 0.5  # the distal lever decides only where it is so long, and along itself known
AXIS_FLOOR, AXIS_SHARE, AXIS_HEADING_SHARE = 2.0 * DEG, 0.5, 0.5
LONE = (6.0 * DEG, 12.0 * DEG)  # what one window may show that is no axis
AGAINST_MAX, REMEMBERED = 2, 12


@dataclass
class Block:
    lever: np.ndarray = field(default_factory=lambda: np.zeros((4, 4), complex))
    motion_s: float = 0.0
    time_s: float = 0.0


class Sums:
    """Everything that headings and levers are solved from."""

    def __init__(self) -> None:
        self.motion_s = self.energy1 = self.energy2 = 0.0
        self.lever1, self.lever2, self.up, self.old = (np.zeros((4, 4)) for _ in range(4))
        self.along = np.zeros((3, 3))
        self.blocks = [Block() for _ in range(BLOCKS)]  # 0 is open

    def add(self, tick1: Tick, tick2: Tick, motion_s: float, spin: float) -> None:
        f1, f2 = lever_rows(tick1), lever_rows(tick2)
        self.motion_s += motion_s
        self.lever1 += motion_s * f1.T @ f1
        self.lever2 += motion_s * f2.T @ f2
        self.up += motion_s * np.outer(f1[2], f2[2])
        self.along += spin * np.outer(tick1.gyr, tick2.gyr)
        self.energy1 += spin * float(tick1.gyr @ tick1.gyr)
        self.energy2 += spin * float(tick2.gyr @ tick2.gyr)
        block = self.blocks[0]
        block.lever = block.lever + motion_s * np.outer(complex_rows(f1, -1.0), complex_rows(f2, 1.0))
        block.motion_s += motion_s
        block.time_s += tick1.dt_s

    @property
    def is_full(self) -> bool:
        return self.blocks[0].time_s >= BLOCK_S and self.blocks[0].motion_s >= BLOCK_MOTION_S

    def fade(self, share: float) -> None:
        for name, value in vars(self).items():
            if name != "blocks":
                setattr(self, name, share * value)
        for block in self.blocks:
            block.lever, block.motion_s = share * block.lever, share * block.motion_s

    def cross(self, heading: list[complex]) -> np.ndarray:
        """X (4, 4)."""
        return self.up + self.old + sum((h * b.lever).real for h, b in zip(heading, self.blocks, strict=True))

    def normal(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        h = np.block([[self.lever1[1:, 1:], -x[1:, 1:]], [-x[1:, 1:].T, self.lever2[1:, 1:]]])
        return h, np.r_[self.lever1[1:, 0] - x[1:, 0], self.lever2[1:, 0] - x[0, 1:]]


@dataclass
class Point:
    r: np.ndarray = field(default_factory=lambda: np.zeros(6))  # joint to sensor 1, joint to sensor 2, each in its sensor frame, m
    heading: list[complex] = field(default_factory=lambda: [1.0 + 0.0j] * BLOCKS)
    size: float = SIZE_FLOOR
    lack: float = 0.0
    speed2: float = 0.0

    @property
    def x1(self) -> np.ndarray:
        return np.r_[1.0, -self.r[:3]]

    @property
    def x2(self) -> np.ndarray:
        return np.r_[1.0, -self.r[3:]]


@dataclass
class Past:
    """The heading of the blocks that were merged, and its information, 1/rad^2."""

    heading: complex = 1.0 + 0.0j
    known: float = 0.0

    @property
    def pull(self) -> float:
        """What it is worth one block later."""
        return 1.0 / (1.0 / self.known + 1.0 / PULL) if self.known > 0.0 else 0.0


def weight_of(sums: Sums, size: float) -> float:
    """Of a unit of the sum of squares."""
    return 1.0 / (size * (LASTING * sums.motion_s + MEMORY))


def put_levers(sums: Sums, point: Point) -> None:
    x = sums.cross(point.heading)
    h, g = sums.normal(x)
    point.r = np.linalg.solve(h + RIDGE / 6.0 * np.trace(h) * np.eye(6), g)
    own = point.x1 @ sums.lever1 @ point.x1 + point.x2 @ sums.lever2 @ point.x2
    point.lack = max(float(own - 2.0 * point.x1 @ x @ point.x2), 0.0)
    point.speed2 = float(own) / sums.motion_s
    point.size = max(point.lack / (3.0 * sums.motion_s), SIZE_FLOOR)


def pulls(sums: Sums, point: Point) -> list[complex]:
    """Of each block on its heading: its share of the cost is -Re(heading pull)."""
    return [weight_of(sums, point.size) * complex(point.x1 @ b.lever @ point.x2) for b in sums.blocks]


def put_headings(sums: Sums, past: Past, point: Point) -> None:
    """The closed block's, then the open one's: each pulled by its data and by its neighbours."""
    open_pull, closed_pull = pulls(sums, point)
    if sums.blocks[1].motion_s > 0.0:
        z = np.conj(closed_pull) + past.pull * past.heading + PULL * point.heading[0] * (sums.blocks[0].motion_s > 0.0)
        point.heading[1] = z / abs(z) if abs(z) > 0.0 else point.heading[1]
    z = np.conj(open_pull) + PULL * point.heading[1] * (sums.blocks[1].motion_s > 0.0)
    point.heading[0] = z / abs(z) if abs(z) > 0.0 else point.heading[0]


def cost(sums: Sums, past: Past, point: Point) -> float:
    """What is made smallest for a given size of the residual."""
    x = sums.cross(point.heading)
    left = point.x1 @ sums.lever1 @ point.x1 + point.x2 @ sums.lever2 @ point.x2 - 2.0 * point.x1 @ x @ point.x2
    tied = PULL * (np.conj(point.heading[0]) * point.heading[1]).real + past.pull * (np.conj(past.heading) * point.heading[1]).real
    return float(0.5 * weight_of(sums, point.size) * left - (tied if sums.blocks[1].motion_s > 0.0 else 0.0))


def information(sums: Sums, past: Past, point: Point) -> np.ndarray:
    """(8, 8): second derivative of the cost by both levers and the headings of the open and of the closed block."""
    l = weight_of(sums, point.size)
    h, _ = sums.normal(sums.cross(point.heading))
    q, k = np.zeros((6, 2)), np.zeros((2, 2))
    for b, block in enumerate(sums.blocks):
        turned = point.heading[b] * block.lever
        q[:3, b] = -l * (turned @ point.x2).imag[1:]
        q[3:, b] = -l * (point.x1 @ turned).imag[1:]
        k[b, b] = max(l * float((point.x1 @ turned @ point.x2).real), 0.0)
    if sums.blocks[1].motion_s > 0.0:
        k += PULL * np.array([[1.0, -1.0], [-1.0, 1.0]])
        k[1, 1] += past.pull
    return np.block([[l * h, q], [q.T, k]])


def open_information(h: np.ndarray) -> float:
    """What every direction of an information about both levers (6, 6) is given."""
    return OPEN_SHARE * float(np.max(np.diag(h)))


def longer_levers(h: np.ndarray, g: np.ndarray, noise: float) -> list[np.ndarray | None]:
    """Each lever (3,), were `noise` of the information that of errors of the regressors: of both, else of one and none of the other."""

    def solved(own: np.ndarray) -> np.ndarray | None:
        less = h + np.diag(own)
        return np.linalg.solve(less, g) if np.linalg.eigvalsh(less)[0] > 0.0 else None

    both = solved(np.full(6, -noise))
    if both is not None:
        return [both[:3], both[3:]]
    rest = open_information(h)
    first, second = solved(np.repeat([-noise, rest], 3)), solved(np.repeat([rest, -noise], 3))
    return [None if first is None else first[:3], None if second is None else second[3:]]


def bounds(sums: Sums, past: Past, point: Point) -> tuple[np.ndarray, float]:
    """(2,) 95 % bounds of the levers, m, and of the heading of the open block, rad."""
    full = information(sums, past, point)
    rest = open_information(full[:6, :6])
    full = full + rest * np.diag([1.0] * 6 + [0.0] * 2)
    has_closed = sums.blocks[1].motion_s > 0.0
    full = full if has_closed else np.delete(np.delete(full, 7, 0), 7, 1)
    if np.linalg.eigvalsh(full)[0] <= 0.0:
        return np.full(2, UNKNOWN_M), UNKNOWN
    p = np.linalg.inv(full)
    heading = min(HEADING_SHARE * float(np.sqrt(p[6, 6])), UNKNOWN)
    h, g = sums.normal(sums.cross(point.heading))
    noise = point.lack / max(float(point.r @ point.r), 1e-6)
    found = []
    for part, longer, skin in zip((slice(0, 3), slice(3, 6)), longer_levers(h, g, noise), SKIN, strict=True):
        widest = float(np.linalg.eigvalsh(p[part, part])[-1])
        r = point.r[part]
        known = longer is not None and widest * rest < OPEN_VARIANCE
        found.append(LEVER_FLOOR_M + LEVER_SHARE * np.sqrt(widest) + np.linalg.norm(longer - r) + skin * np.linalg.norm(r) if known else UNKNOWN_M)
    return np.minimum(found, UNKNOWN_M), heading


def block_information(sums: Sums, past: Past, point: Point) -> float:
    """What the closed block alone knows of its heading once the levers have taken their share, 1/rad^2."""
    full = information(sums, past, point)
    h = full[:6, :6] + open_information(full[:6, :6]) * np.eye(6)
    left = full[6:, 6:] - full[6:, :6] @ np.linalg.solve(h, full[:6, 6:])
    return max(left[1, 1] - PULL - past.pull, 0.0) if np.linalg.eigvalsh(left)[0] > 0.0 else 0.0


def stiffness(sums: Sums) -> float:
    """What one fixed rotation leaves of both rates, beside the smaller of them."""
    best = np.trace(nearest_rotation(sums.along).T @ sums.along)
    return float((sums.energy1 + sums.energy2 - 2.0 * best) / max(min(sums.energy1, sums.energy2), 1e-12))


# Axes.


@dataclass
class Part:
    """Half a window: relative rates in both sensor frames, and how far the joint bent."""

    seen1: np.ndarray = field(default_factory=lambda: np.zeros((3, 3)))
    seen2: np.ndarray = field(default_factory=lambda: np.zeros((3, 3)))
    mean: np.ndarray = field(default_factory=lambda: np.zeros((3, 3)))  # of R1' Rz R2, times seconds
    heading: complex = 1.0 + 0.0j  # at its first tick
    carried2: float = 0.0  # squared rate of the proximal segment, weighted as the relative one
    motion_s: float = 0.0
    time_s: float = 0.0


@dataclass
class Axis:
    """One that was found: in frame 1 for flexion, in frame 2 for pronation."""

    seen: np.ndarray = field(default_factory=lambda: np.zeros((3, 3)))
    bound: float = UNKNOWN
    heading_bound: float = UNKNOWN
    windows: int = 0
    against: int = 0

    @property
    def direction(self) -> np.ndarray:
        return np.linalg.eigh(self.seen)[1][:, -1]


def sideways(seen: np.ndarray) -> float:
    """Second eigenvalue over the first."""
    values = np.linalg.eigvalsh(seen)
    return float(values[1] / max(values[2], 1e-12))


def line_angle(a: np.ndarray, b: np.ndarray) -> float:
    return float(np.arctan2(np.linalg.norm(np.cross(a, b)), abs(a @ b)))


def axis_bound(seen: np.ndarray, heading: float, kind: int, windows: int) -> float:
    """Of so many windows, which overlap by half."""
    shown = AXIS_FLOOR + AXIS_SHARE * np.sqrt(max(sideways(seen), 0.0)) + AXIS_HEADING_SHARE * heading
    return float(np.hypot(shown, 2.0 * LONE[kind] / (windows + 1)))


class Windows:
    """Windows of 5 s, each of two parts; what one motion dominates says which axis it is by where it lies beside the levers."""

    def __init__(self) -> None:
        self.parts = [Part(), Part()]  # 0 is open
        self.kept = [Axis(), Axis()]

    def add(self, tick1: Tick, tick2: Tick, heading: complex) -> bool:
        """True if a window is complete."""
        rz = about_z(heading)
        relative = rz @ tick2.turn @ tick2.gyr - tick1.turn @ tick1.gyr
        in1, in2 = tick1.turn.T @ relative, tick2.turn.T @ rz.T @ relative
        rate2 = float(relative @ relative)
        part, share = self.parts[0], tick1.dt_s / (1.0 + rate2 / RATE_KNEE2)
        if part.time_s == 0.0:
            part.heading = heading
        part.seen1 += share * np.outer(in1, in1)
        part.seen2 += share * np.outer(in2, in2)
        part.mean += tick1.dt_s * tick1.turn.T @ rz @ tick2.turn
        part.carried2 += share * float(tick1.gyr @ tick1.gyr)
        part.motion_s += tick1.dt_s * rate2 / (rate2 + 0.3)
        part.time_s += tick1.dt_s
        return part.time_s >= PART_S

    def close(self, point: Point, heading: complex, heading_bound: float, bound2: float, is_joint: bool) -> None:
        """The window is judged, if there is a joint, with the heading of this moment and bounds of it and of the distal lever; its
        older half is given up."""
        new, old = self.parts
        if is_joint and old.time_s > 0.0:
            moved = max(abs(float(np.angle(heading * np.conj(part.heading)))) for part in (old, new))
            self.take(old, new, point, float(np.hypot(heading_bound, moved)), bound2)
        self.parts = [Part(), new]

    def take(self, old: Part, new: Part, point: Point, heading_bound: float, bound2: float) -> None:
        kind = kind_of(old, new, point, bound2)
        if kind is None:
            return
        seen = (old.seen1 + new.seen1, old.seen2 + new.seen2)[kind]
        if kind == 1:  # in the frame of the sensor that turns, a heading is wrong about what both share only
            heading_bound *= min(1.0, float(np.sqrt((old.carried2 + new.carried2) / max(np.trace(seen), 1e-12))))
        bound, axis = axis_bound(seen, heading_bound, kind, 1), self.kept[kind]
        if axis.windows == 0:
            self.kept[kind] = Axis(seen, bound, heading_bound, 1)
            return
        if line_angle(axis.direction, np.linalg.eigh(seen)[1][:, -1]) <= np.hypot(axis.bound, bound):
            n = min(axis.windows, REMEMBERED - 1)
            axis.seen = axis.seen * (n / axis.windows) + seen
            axis.heading_bound += (heading_bound - axis.heading_bound) / (n + 1)
            axis.windows, axis.against = n + 1, 0
            axis.bound = axis_bound(axis.seen, axis.heading_bound, kind, axis.windows)
            return
        axis.against += 1
        if (axis.windows == 1 and bound < axis.bound) or axis.against >= AGAINST_MAX:
            self.kept[kind] = Axis(seen, bound, heading_bound, 1)


def kind_of(old: Part, new: Part, point: Point, bound2: float) -> int | None:
    """0: flexion, 1: pronation, None: no axis is to be seen in this window."""
    time_s = old.time_s + new.time_s
    if old.motion_s + new.motion_s < WINDOW_MOTION_S:
        return None
    seen1, seen2 = old.seen1 + new.seen1, old.seen2 + new.seen2
    if max(sideways(seen1), sideways(seen2)) > SIDEWAYS_MAX:
        return None
    main = [np.linalg.eigh(m)[1][:, -1] for m in (seen1, seen2, old.seen1, new.seen1, old.seen2, new.seen2)]
    if max(line_angle(main[2], main[3]), line_angle(main[4], main[5])) > TURNED_MAX:
        return None
    mean = (old.mean + new.mean) / time_s
    if 0.5 * (3.0 - float(np.sum(mean**2))) < BEND_MIN**2:
        return None
    r1, r2 = point.r[:3], point.r[3:]
    if abs(main[0] @ r1) > SKIN_COSINE * np.linalg.norm(r1):
        return None
    length, along = float(np.linalg.norm(r2)), abs(float(main[1] @ r2))
    if along <= ACROSS_COSINE * length and np.linalg.norm(np.cross(main[1], r2)) >= ARM_MIN_M:
        return 0
    return 1 if along >= ALONG_COSINE * length and along >= ARM_MIN_M and bound2 <= LEVER_BOUND_SHARE * length else None


# Judgement.


@dataclass
class Verdict:
    levers: np.ndarray = field(default_factory=lambda: np.full(2, UNKNOWN_M))
    heading: float = UNKNOWN
    stiffness: float = 0.0
    reason: str = "no-data"  # what speaks against one joint; "" if nothing
    agreed: int = 0

    @property
    def is_joint(self) -> bool:
        return self.agreed >= AGREED_MIN


class Ball:
    """The joint as ticks come, judged every quarter of a second of time. No slips, no hysteresis."""

    def __init__(self) -> None:
        self.sums, self.past, self.point, self.verdict, self.windows = Sums(), Past(), Point(), Verdict(), Windows()
        self.rate2 = self.motion_s = self.since_s = self.refused_s = self.gravity_off = 0.0
        self.has_estimate = self.merged = self.was_joint = False
        self.turn = 0
        self.epochs: tuple[int, int] | None = None
        self.warmth = Warmth()

    def add(self, tick1: Tick, tick2: Tick) -> bool:
        """True if there was a judgement."""
        epochs = (tick1.epoch, tick2.epoch)
        is_cold = self.warmth.is_cold(tick1, tick2)
        if self.epochs not in (None, epochs):
            self.epochs = epochs
            self.cut()
            return False
        self.epochs = epochs
        if is_cold:
            return False
        self.gravity_off = max(abs(tick.acc_level - 9.81) for tick in (tick1, tick2))
        rate2 = float(tick1.gyr @ tick1.gyr + tick2.gyr @ tick2.gyr)
        self.rate2 += tick1.dt_s / (tick1.dt_s + RATE_SMOOTHING_S) * (rate2 - self.rate2)
        weights = weights_of(tick1.dt_s, self.rate2)
        self.motion_s += weights.motion_s
        self.refused_s += weights.motion_s
        self.sums.add(tick1, tick2, weights.motion_s, weights.spin)
        if self.has_estimate and self.windows.add(tick1, tick2, self.point.heading[0]):
            self.windows.close(self.point, self.point.heading[0], self.verdict.heading, self.verdict.levers[1], self.verdict.is_joint)
        if self.sums.is_full:
            self.close()
            if self.sums.motion_s > (MOTION_MAX_S if self.was_joint else MOTION_MAX_BEFORE_S):
                self.sums.fade(0.5)
        self.since_s += tick1.dt_s
        if self.motion_s < MOTION_FIRST_S or self.since_s < JUDGE_EVERY_S - 1e-9:
            return False
        self.since_s = 0.0
        self.judge()
        return True

    def close(self) -> None:
        """The closed block is merged with its heading, the open one closed; another begins with its heading."""
        old, heading = self.sums.blocks[1], self.point.heading[1]
        if old.motion_s > 0.0:
            self.past = Past(heading, self.past.pull + block_information(self.sums, self.past, self.point))
            self.sums.old = self.sums.old + (heading * old.lever).real
            self.merged = True
        self.sums.blocks = [Block(), self.sums.blocks[0]]
        self.point.heading = [self.point.heading[0], self.point.heading[0]]

    def cut(self) -> None:
        """The features began anew. Before there is a joint no block has a heading that it could be merged with."""
        self.windows.parts = [Part(), Part()]
        if not self.verdict.is_joint:
            self.begin_anew()
        else:
            self.close()
            self.close()  # both blocks: nothing ties their headings to what comes
            self.past.known = 0.0

    def begin_anew(self) -> None:
        epochs, warmth = self.epochs, self.warmth
        self.__init__()
        self.epochs, self.warmth = epochs, warmth

    def round(self, point: Point) -> None:
        put_levers(self.sums, point)
        put_headings(self.sums, self.past, point)

    def trial(self, number: int, rounds: int) -> Point:
        by = complex(np.exp(0.25j * np.pi * number))
        point = Point(self.point.r, [by * h for h in self.point.heading])
        for _ in range(rounds):
            self.round(point)
        return point

    def judge(self) -> None:
        if self.has_estimate:
            for _ in range(ROUNDS):
                self.round(self.point)
        if not self.has_estimate or not self.merged:
            numbers = [self.turn] if self.has_estimate else range(HEADINGS)
            best = min((self.trial(n, TRIAL_ROUNDS) for n in numbers), key=lambda p: p.size)
            self.turn = (self.turn + 1) % HEADINGS
            ahead = ROWS[2] / MEMORY * self.sums.motion_s * np.log(self.point.size / best.size)
            if not self.has_estimate or ahead > AHEAD:
                self.point, self.has_estimate, self.verdict.agreed = best, True, 0
        v = self.verdict
        v.levers, v.heading = bounds(self.sums, self.past, self.point)
        v.stiffness = stiffness(self.sums)
        left = self.point.lack / self.sums.motion_s
        gates = [("gravity-off", self.gravity_off <= GRAVITY_OFF_MAX), ("no-motion", self.sums.motion_s >= MOTION_MIN_S),
                 ("not-one-joint", left - SPEED_NOISE2 <= LACK_MAX * min(self.sums.motion_s / LACK_MOTION_S, 1.0) * self.point.speed2), ("no-bend", v.stiffness >= STIFFNESS_MIN)]
        v.reason = next((name for name, passed in gates if not passed), "")
        v.agreed = min(v.agreed + 1, AGREED_MIN) if v.reason == "" else 0
        self.was_joint = self.was_joint or v.is_joint
        if v.reason != "not-one-joint":
            self.refused_s = 0.0
        if not self.was_joint and self.refused_s > REFUSED_MAX_S:
            self.begin_anew()
