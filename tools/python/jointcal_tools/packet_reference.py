"""Float64 reference of packets of a wireless sensor: numbers of readings, the sensor's clock, times of the hub.

    follower = Follower(Config(period_s=0.01))
    for packet in simulate(Radio(drift_ppm=300.0), 60.0, np.random.default_rng(1)):
        times = follower.take(packet)              us, of the readings that are new; empty if it is dropped
    follower.clock.drift_ppm, follower.counts

Constants and rules are those of lib/packet; no arithmetic is shared with it: times are float64 or
whole numbers without bounds, and the line below all arrivals is found by trying all pairs of points.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

BLOCKS, POINTS_MIN = 16, 8
BLOCK_FIRST_S, BLOCK_LAST_S, OLDEST_S = 0.25, 8.0, 600.0
BOUND_SHARE, BOUND_FLOOR_PPM = 2.0, 0.5
JITTER_PACKETS = 64
HIGH_US, HIGH_JITTERS, HIGH_LASTS_US = 5000.0, 6.0, 5e6
LOW_US, LOW_JITTERS = 20000.0, 8.0
TAU_US, PACE, FAR_US, LEAST = 2e6, 0.01, 50000.0, 0.9
ODD_RUN, SEEN = 3, 64


class Packet(NamedTuple):
    arrival_us: int
    counter: int
    count: int


@dataclass
class Config:
    period_s: float = 0.01
    bits: int = 16
    max_delay_s: float = 2.0
    max_drift_ppm: float = 500.0

    @property
    def period_us(self) -> float:
        return 1e6 * self.period_s


@dataclass
class Radio:
    """A sensor, and how its packets come: as unit/packet/radio.h, without bursts."""

    period_s: float = 0.01
    drift_ppm: float = 0.0
    delay_s: float = 0.005
    jitter_s: float = 0.025
    count: int = 1
    bits: int = 16
    counter0: int = 0
    hub0_us: int = 1000000


def simulate(radio: Radio, seconds: float, rng: np.random.Generator) -> list[Packet]:
    """Packets in the order in which they were sent."""
    step_s = radio.period_s * (1.0 + 1e-6 * radio.drift_ppm)
    packets, last_s = [], 0.0
    for first in range(0, int(seconds / radio.period_s), radio.count):
        sent_s = step_s * (first + radio.count - 1)
        last_s = max(sent_s + radio.delay_s + radio.jitter_s * rng.random(), last_s)
        packets.append(Packet(radio.hub0_us + int(1e6 * last_s), (radio.counter0 + first) % 2**radio.bits, radio.count))
    return packets


def support(points: np.ndarray) -> float:
    """Slope of the line through two points (x, y), on or below all others, that is highest in the middle of x."""
    middle = 0.5 * (points[0, 0] + points[-1, 0])
    best, found = -np.inf, 0.0
    for i in range(len(points)):
        for j in range(i + 1, len(points)):
            slope = (points[j, 1] - points[i, 1]) / (points[j, 0] - points[i, 0])
            over = points[:, 1] - points[i, 1] - slope * (points[:, 0] - points[i, 0])
            value = points[i, 1] + slope * (middle - points[i, 0])
            if over.min() > -1e-9 and value > best:
                best, found = value, slope
    return found


@dataclass
class Clock:
    """The line below all arrivals: arrival = base_us + (number - anchor) period (1 + drift)."""

    config: Config
    drift_ppm: float = 0.0
    bound_ppm: float = 0.0
    jitter_us: float = 0.0
    jitter_count: int = 0
    points: list[tuple[int, int]] = field(default_factory=list)  # number, arrival; the last one of the open block
    high_us: int | None = None

    def begin(self, at: int, us: int) -> None:
        self.points, self.high_us = [(at, us)], None
        self.anchor, self.base_us, self.open_at = at, float(us), at
        self.width = max(int(BLOCK_FIRST_S / self.config.period_s), 1)
        self.bound_ppm = self.config.max_drift_ppm

    def line(self, at: int) -> float:
        return self.base_us + (at - self.anchor) * self.config.period_us * (1.0 + 1e-6 * self.drift_ppm)

    def is_past(self, above_us: float, us: int) -> bool:
        known = self.jitter_count == JITTER_PACKETS
        if known and above_us > HIGH_US + HIGH_JITTERS * self.jitter_us:
            self.high_us = us if self.high_us is None else self.high_us
            return us - self.high_us > HIGH_LASTS_US
        self.high_us = None
        if self.bound_ppm < self.config.max_drift_ppm and above_us < -LOW_US - LOW_JITTERS * self.jitter_us:
            return True
        self.jitter_count = min(self.jitter_count + 1, JITTER_PACKETS)
        self.jitter_us += (max(above_us, 0.0) - self.jitter_us) / self.jitter_count
        return False

    def put(self, at: int, us: int) -> bool:
        above = us - self.line(at)
        if self.is_past(above, us):
            self.begin(at, us)
            return True
        if at - self.open_at >= self.width:
            self.close(us)
            self.points.append((at, us))
            self.open_at = at
            self.draw(at)
            return False
        if above < 0.0:
            self.base_us += above
        lowest_at, lowest_us = self.points[-1]
        if us - self.line(at) < lowest_us - self.line(lowest_at):
            self.points[-1] = (at, us)
        return False

    def close(self, us: int) -> None:
        self.points = [p for p in self.points if us - p[1] <= 1e6 * OLDEST_S]
        if len(self.points) < BLOCKS:
            return
        if 2 * self.width <= int(BLOCK_LAST_S / self.config.period_s):
            pairs = zip(self.points[::2], self.points[1::2])
            self.points = [min(pair[::-1], key=lambda p: p[1] - self.line(p[0])) for pair in pairs]
            self.width *= 2
        else:
            self.points.pop(0)

    def draw(self, at: int) -> None:
        """x in s from the last point, y in us above a line of the nominal period through it."""
        numbers = np.array([p[0] - at for p in self.points], float)
        arrivals = np.array([p[1] - self.points[-1][1] for p in self.points], float)
        x = numbers * self.config.period_s
        y = arrivals - 1e6 * x
        if len(x) >= POINTS_MIN:
            slope = support(np.column_stack([x, y]))
            over = y - slope * x
            mean = np.sum((over - over.min())[:-1]) / (len(x) - 3)
            most = self.config.max_drift_ppm
            self.bound_ppm = min(BOUND_FLOOR_PPM + BOUND_SHARE * mean / -x[0], most)
            share = 1.0 - (self.bound_ppm / most) ** 2
            self.drift_ppm = float(np.clip(self.drift_ppm + share * (slope - self.drift_ppm), -most, most))
        self.anchor = at
        self.base_us = self.points[-1][1] + float(np.min(y - self.drift_ppm * x))


@dataclass
class Follower:
    config: Config
    counts: dict[str, int] = field(
        default_factory=lambda: dict.fromkeys(("readings", "lost", "late", "duplicate", "odd", "restarts", "steps"), 0))
    next: int | None = None
    seen: set[int] = field(default_factory=set)
    odd: list[Packet] = field(default_factory=list)
    fit_us: int | None = None  # arrival of the last packet that fitted
    last: tuple[int, float] | None = None  # number and time, us, of the last reading

    def __post_init__(self) -> None:
        self.clock = Clock(self.config)

    def number(self, packet: Packet) -> int | None:
        """Of the last reading; None if the packet fits no time."""
        if self.next is None:
            return None
        period = self.config.period_us * (1.0 + 1e-6 * self.clock.drift_ppm)
        guess = self.clock.anchor + (packet.arrival_us - self.clock.base_us) / period
        turn = 2**self.config.bits
        low = packet.counter + packet.count - 1
        at = low + turn * round((guess - low) / turn)
        return at if abs(packet.arrival_us - self.clock.line(at)) <= 1e6 * self.config.max_delay_s else None

    def goes_on(self, packet: Packet) -> bool:
        before = self.odd[-1]
        turn = 2**self.config.bits
        readings = (packet.counter - before.counter) % turn
        since = packet.arrival_us - before.arrival_us
        return (0 < readings < turn // 2 and since >= 0
                and abs(since - readings * self.config.period_us) <= 1e6 * self.config.max_delay_s)

    def begin(self, packet: Packet) -> int:
        """A sensor that is new, or began anew; the number of its first reading."""
        turn = 2**32
        self.counts["restarts"] += self.next is not None
        first = packet.counter % 2**self.config.bits + turn * ((self.next or 0) // turn + 2)
        self.next, self.seen, self.odd = first, set(), []
        self.clock.begin(first + packet.count - 1, packet.arrival_us)
        start = packet.arrival_us - (packet.count - 1) * self.config.period_us
        back = self.fit_us is not None and self.fit_us - packet.arrival_us > 1e6 * self.config.max_delay_s
        if self.last is not None and start <= self.last[1] and not back:
            start = self.last[1] + self.config.period_us
        self.last = (first, start)
        return first

    def pace(self, at: int) -> float:
        before, us = self.last
        if at == before:
            return us
        way = (at - before) * self.config.period_us
        drift = 1e-6 * self.clock.drift_ppm * way
        off = us + way + drift - self.clock.line(at)
        if off < -FAR_US:
            step = -off
        elif off > FAR_US:
            step = -min(off, way - LEAST * self.config.period_us)
        else:
            most = way * PACE
            step = -float(np.clip(off * min(way / TAU_US, 1.0), -most, most))
        self.last = (at, us + way + drift + step)
        return self.last[1]

    def drop_old(self, numbers: range) -> list[int]:
        """Numbers that are new; the others are counted."""
        for at in numbers:
            if at < self.next:
                self.counts["duplicate" if at in self.seen else "late"] += 1
                self.seen.add(at)
        return [at for at in numbers if at >= self.next]

    def take(self, packet: Packet) -> list[float]:
        """Times of the readings of a packet that are new, us."""
        last = self.number(packet)
        anew = False
        if last is None:
            self.odd = self.odd + [packet] if self.odd and self.goes_on(packet) else [packet]
            if self.next is not None and len(self.odd) < ODD_RUN:
                self.counts["odd"] += packet.count
                return []
            last = self.begin(packet) + packet.count - 1
            anew = True
        self.odd, self.fit_us = [], packet.arrival_us
        new = self.drop_old(range(last - packet.count + 1, last + 1))
        if new and not anew:
            self.counts["steps"] += self.clock.put(last, packet.arrival_us)
        times = []
        for at in new:
            self.counts["lost"] += at - self.next
            self.counts["readings"] += 1
            self.next = at + 1
            self.seen = {k for k in self.seen | {at} if k > at - SEEN}
            times.append(self.pace(at))
        return times
