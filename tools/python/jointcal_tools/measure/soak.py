"""An hour of two wireless sensors over a bad wire: what the hub counts beside what was injected, its times and its hinge beside the truth.

What a sender does is written down here as it happens, and what must be counted follows from the order of arrivals alone; nothing is
asked of the library.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .. import native_hub
from ..native_hub import READY, Found, Packets, Sender
from ..simulate_people import PersonRecording, PersonSpec, simulate_person
from .harness import Report, Settings, number, percent, run_jobs
from .judge import MAX_ERROR_DEG, line_angle_deg

TITLE = "Hub over a bad wire"
RATE_HZ = 100.0
HOUR_S, QUICK_S = 3600.0, 300.0
ACTIVITIES = (("walk", 50.0), ("random", 40.0), ("squat", 30.0), ("stand", 15.0), ("sit_to_stand", 25.0), ("swing", 20.0))
REST = (("stand", 10.0),)
CYCLES = 3
GYR_BIAS_RAD_S = 0.005  # magnitude of each sensor's
SEED = 11

LOST = 0.05  # share of packets
LATE, LATE_S = 0.01, (0.02, 0.2)  # share of packets that are sent again, and so much later
DOUBLED, DOUBLED_S = 0.01, (0.005, 0.25)
JITTER_S = 0.006  # standard deviation, and mean, of exponential delays
BURST_EVERY_S, BURST_S = 40.0, (0.1, 1.5)
SILENCE_S = 20.0  # once, of sensor 1
RESTART_SILENCE_S, RESTART_CLEAN = 3.0, 6  # a sender that is switched on again; packets after it that all arrive
SEEN = 64  # readings that are remembered: what comes once more after so many others counts as late
SETTLED_S = 60.0  # times are judged from here on
ORIGIN_US = 5_000_000
GYR_LSB, ACC_LSB = np.radians(0.070), 0.488e-3 * 9.80665  # ST DS13476, table 2: 2000 deg/s, 16 g
GAP_US, PERIOD_US = 100_000, 10_000  # of the pairing

SKIN = "a person's knee whose skin makes it look 5 ms late in the last seconds; the bound is one of 95 %, and holds for all but 0.2 % of that hour"

TIME_MOST_MS, HOLE_MOST_S, PAIRED_MIN, READY_MIN, LAG_KNOWN_MIN, OVER_MAX = 1.0, 1.0, 0.99, 0.95, 0.9, 0.05


@dataclass(frozen=True)
class Wire:
    """One sensor and its radio."""

    period_s: float
    drift_ppm: float
    bits: int
    most: int  # readings of a packet are 1 to this
    base_s: float  # what the fastest packet needs
    max_delay_s: float = 0.5
    raw: bool = False
    restarts: bool = False
    least: int = 1  # readings of a packet


@dataclass(frozen=True)
class Case:
    name: str
    skin: float
    wires: tuple[Wire, Wire]
    bad: bool = True  # False: nothing is lost, late or doubled

    @property
    def lag_s(self) -> float:
        return self.wires[1].base_s - self.wires[0].base_s


CASES = (
    Case("rigid knee, 100 ppm, 16 bits, packets of 1 to 4", 0.0,
         (Wire(0.01, 100.0, 16, 4, 0.004), Wire(0.01, -100.0, 16, 4, 0.044))),
    Case("rigid knee, 500 ppm, 8 bits, packets of 1 to 10, sensor 2 begins anew", 0.0,
         (Wire(0.01, 500.0, 8, 10, 0.130), Wire(0.01, -500.0, 8, 10, 0.010, restarts=True))),
    Case("rigid knee, 50 and 200 Hz, raw, packets of 1 to 10", 0.0,
         (Wire(0.02, -100.0, 16, 2, 0.003, raw=True), Wire(0.005, 100.0, 16, 10, 0.003, raw=True))),
    Case("person's knee, 100 ppm, 16 bits, packets of 1 to 4", 1.0,
         (Wire(0.01, -100.0, 16, 4, 0.008), Wire(0.01, 100.0, 16, 4, 0.003))),
    Case("the same, nothing lost, late or doubled", 1.0,
         (Wire(0.01, -100.0, 16, 4, 0.008), Wire(0.01, 100.0, 16, 4, 0.003)), bad=False),
)


@dataclass
class Sent:
    """What one sender did. Numbers of readings go on over a restart, their rows in `values`, too."""

    times_s: np.ndarray  # (N,) of readings, by the hub's clock
    epochs: np.ndarray  # (N,)
    values: np.ndarray  # (N, 6)
    first: list[int] = field(default_factory=list)  # of packets that arrive, in the order of arrival
    count: list[int] = field(default_factory=list)
    counter: list[int] = field(default_factory=list)
    arrival_s: list[float] = field(default_factory=list)


def read_at(signals: np.ndarray, times_s: np.ndarray) -> np.ndarray:
    """Cubic polynomials through four samples, `signals` (N, 6) at RATE_HZ."""
    at = np.clip(times_s * RATE_HZ, 1.0, len(signals) - 3.001)
    k, u = np.floor(at).astype(int), (at - np.floor(at))[:, None]
    weights = (-u * (u - 1) * (u - 2) / 6, (u + 1) * (u - 1) * (u - 2) / 2, -(u + 1) * u * (u - 2) / 2, (u + 1) * u * (u - 1) / 6)
    return sum(w * signals[k + offset] for w, offset in zip(weights, (-1, 0, 1, 2), strict=True))


def holes_of(end_s: float, index: int, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """Begins and ends of the bursts in which every packet is lost."""
    holes = [(t, t + rng.uniform(*BURST_S)) for t in np.cumsum(rng.exponential(BURST_EVERY_S, int(2 * end_s / BURST_EVERY_S) + 5)) + 5.0]
    if index == 0:
        holes.append((0.7 * end_s, 0.7 * end_s + SILENCE_S))
    return np.array([begin for begin, _ in sorted(holes)]), np.maximum.accumulate([stop for _, stop in sorted(holes)])


def send(wire: Wire, signals: np.ndarray, index: int, rng: np.random.Generator, bad: bool) -> Sent:
    """All packets of a sender that arrive, sorted by arrival."""
    end_s = len(signals) / RATE_HZ - 1.0
    step_s = wire.period_s * (1.0 + 1e-6 * wire.drift_ppm)
    off_s = end_s * 0.4
    pieces = [(rng.uniform(0.5, 0.6), off_s), (off_s + RESTART_SILENCE_S, end_s)] if wire.restarts else [(rng.uniform(0.5, 0.6), end_s)]
    times = [np.arange(begin, stop, step_s) for begin, stop in pieces]
    sent = Sent(np.concatenate(times), np.repeat(range(len(times)), [len(t) for t in times]), np.zeros(0))
    sent.values = read_at(signals, sent.times_s)
    begins, ends = holes_of(end_s, index, rng)
    arrivals, base = [], 0
    for epoch, t_s in enumerate(times):
        origin, at, number_of, before_s = int(rng.integers(1 << 31)), 0, 0, 0.0
        if epoch > 0:  # half a round from where an 8-bit counter would be
            origin = last_counter + round((RESTART_SILENCE_S / step_s) + (1 << wire.bits) / 2)
        while at < len(t_s):
            count = min(int(rng.integers(wire.least, wire.most + 1)), len(t_s) - at)
            ready_s = t_s[at + count - 1]
            arrival = max(ready_s + wire.base_s + rng.exponential(JITTER_S), before_s)
            clean = number_of < RESTART_CLEAN or not bad
            in_hole = (hole := np.searchsorted(begins, ready_s) - 1) >= 0 and ready_s < ends[hole]
            record = (base + at, count, (origin + at) % (1 << wire.bits))
            chance = rng.uniform()
            if clean or (not in_hole and chance > LOST + LATE + DOUBLED):
                arrivals.append((arrival, record))
                before_s = arrival + 1e-6
            elif not in_hole and chance < LATE:
                arrivals.append((arrival + rng.uniform(*LATE_S), record))
            elif not in_hole and chance < LATE + DOUBLED:
                arrivals += [(arrival, record), (arrival + rng.uniform(*DOUBLED_S), record)]
                before_s = arrival + 1e-6
            last_counter = origin + at + count
            at += count
            number_of += 1
        base += len(t_s)
    for arrival, (first, count, counter) in sorted(arrivals):
        for column, value in zip((sent.arrival_s, sent.first, sent.count, sent.counter), (arrival, first, count, counter), strict=True):
            column.append(value)
    return sent


def expected(sent: Sent) -> tuple[dict, list[int]]:
    """What must be counted, and the readings that must come out, by the order of arrival and packet.h."""
    counts = dict.fromkeys(("readings", "lost", "late", "duplicate", "odd", "restarts"), 0)
    out: list[int] = []
    following, epoch, strangers, seen = -1, 0, 0, set()
    for first, count in zip(sent.first, sent.count, strict=True):
        if sent.epochs[first] != epoch:
            strangers += 1
            if strangers < 3:
                counts["odd"] += count
                continue
            epoch, following, seen = sent.epochs[first], -1, set()
            counts["restarts"] += 1
        for at in range(first, first + count):
            if following < 0 or at >= following:
                counts["lost"] += at - following if following >= 0 else 0
                counts["readings"] += 1
                out.append(at)
                following = at + 1
            elif at in seen and following - 1 - at < SEEN:
                counts["duplicate"] += 1
            else:
                counts["late"] += 1
            seen.add(at)
    return counts, out


def keys_of(values: np.ndarray, raw: bool) -> list[bytes]:
    """Readings as what was sent of them."""
    if raw:
        values = np.rint(values / np.r_[[GYR_LSB] * 3, [ACC_LSB] * 3])
        return [row.tobytes() for row in values.astype(np.int16)]
    return [row.tobytes() for row in np.ascontiguousarray(values, np.float32)]


def sender_of(wire: Wire, sent: Sent) -> Sender:
    values = sent.values / np.r_[[GYR_LSB] * 3, [ACC_LSB] * 3] if wire.raw else sent.values
    return Sender(round(1e9 * wire.period_s), wire.bits, wire.most, wire.max_delay_s,
                  np.rint(values).astype(np.int16) if wire.raw else values.astype(np.float32))


def told_of(times_us: np.ndarray) -> np.ndarray:
    """Numbers of the common times that readings at these times enclose."""
    first, last = times_us[:-1] // PERIOD_US + 1, times_us[1:] // PERIOD_US
    filled = (np.diff(times_us) <= GAP_US) & (last >= first)
    return np.concatenate([np.arange(a, b + 1) for a, b in zip(first[filled], last[filled], strict=True)])


@dataclass
class Outcome:
    """All numbers of a case."""

    case: Case
    duration_s: float
    wrong_counts: int
    counts: tuple[dict, dict]
    expected: tuple[dict, dict]
    wrong_readings: int
    time_rms_ms: tuple[float, float]
    drift_off_ppm: tuple[float, float]
    paired: int
    to_pair: int
    hole_s: float
    lag_first_s: float
    lag_known: float  # share of the pairs after it was first known
    lag_off_ms: float
    lag_bound_ms: float
    lag_over: float  # share of those pairs at which it is known, and beyond the bound
    taken: int
    ready_first_s: float
    ready: float  # share of the pairs after that
    ready_at_end: bool
    false_ready: int  # pairs
    error_deg: float
    bound_deg: float
    model: int


def time_errors(wire: Wire, sent: Sent, order: list[int], times_us: np.ndarray) -> float:
    """Of hub times, beside those at which readings were made and what the fastest packet needs, ms rms; not in the first minute of an epoch."""
    true_s = sent.times_s[order] + wire.base_s
    begin_s = np.array([sent.times_s[sent.epochs == e][0] for e in range(sent.epochs[-1] + 1)])[sent.epochs[order]]
    settled = sent.times_s[order] - begin_s > SETTLED_S
    off_s = 1e-6 * (times_us.astype(float) - ORIGIN_US) - true_s
    return float(1e3 * np.sqrt(np.mean(off_s[settled] ** 2)))


def judge_pairs(found: Found, duration_s: float) -> tuple[int, int, float]:
    """Pairs since the last lag was taken off, how many there should be, and the longest hole that no sensor made."""
    taken = found.rows[:, 15]
    since = int(np.flatnonzero(np.diff(taken))[-1]) + 1 if np.any(np.diff(taken)) else 0
    shift_us = round(1e6 * found.pairing["shift_s"])
    times_us = [found.times_us[0].astype(np.int64), found.times_us[1].astype(np.int64) - shift_us]
    common = np.intersect1d(told_of(times_us[0]), told_of(times_us[1]))
    numbers = found.pair_us.astype(np.int64) // PERIOD_US
    mine = numbers[since:]
    expected_numbers = common[(common >= mine[0]) & (common <= mine[-1])]
    missing = np.setdiff1d(expected_numbers, mine)
    runs = np.split(missing, np.flatnonzero(np.diff(missing) > 1) + 1)
    return len(mine), len(expected_numbers), 1e-6 * PERIOD_US * max(map(len, runs))


def motion(skin: float, duration_s: float) -> tuple[PersonRecording, tuple[np.ndarray, np.ndarray]]:
    """A recording, and readings (N, 6) of both sensors that go through it forward, backward, forward ...

    It begins and ends at rest. Backward in time rates have the other sign, and accelerations are the same: so it is a motion without any jump.
    """
    cycles = CYCLES if duration_s > QUICK_S else 1
    rec = simulate_person(PersonSpec(REST + ACTIVITIES * cycles + REST, "knee", RATE_HZ, seed=SEED, skin=skin, out_of_plane=skin, gyr_bias_deg_s=0.0))
    rng, pieces = np.random.default_rng([SEED, 1]), int(np.ceil(duration_s * RATE_HZ / len(rec)))
    signals = []
    for gyr, acc in ((rec.gyr1, rec.acc1), (rec.gyr2, rec.acc2)):
        bias = rng.normal(size=3)
        rates = np.vstack([gyr if k % 2 == 0 else -gyr[::-1] for k in range(pieces)]) + GYR_BIAS_RAD_S * bias / np.linalg.norm(bias)
        forces = np.vstack([acc if k % 2 == 0 else acc[::-1] for k in range(pieces)])
        signals.append(np.hstack([rates, forces])[:round(duration_s * RATE_HZ)])
    return rec, tuple(signals)


def play(case: Case, duration_s: float) -> tuple[PersonRecording, tuple[Sent, Sent], Found]:
    rng = np.random.default_rng([SEED, CASES.index(case)])
    rec, signals = motion(case.skin, duration_s)
    sent = tuple(send(wire, signals[k], k, rng, case.bad) for k, wire in enumerate(case.wires))
    arrival = np.concatenate([s.arrival_s for s in sent])
    order = np.argsort(arrival, kind="stable")
    packets = Packets(np.repeat([0, 1], [len(s.first) for s in sent])[order], np.rint(1e6 * arrival[order]) + ORIGIN_US,
                      *(np.concatenate([getattr(s, name) for s in sent])[order] for name in ("counter", "count", "first")))
    room = round(duration_s * RATE_HZ) + 1000
    return rec, sent, native_hub.run(tuple(sender_of(wire, s) for wire, s in zip(case.wires, sent, strict=True)), packets, room)


def measure_case(job: tuple[int, float]) -> Outcome:
    case, duration_s = CASES[job[0]], job[1]
    rec, sent, found = play(case, duration_s)
    wanted = [expected(s) for s in sent]
    wrong_counts = sum(found.counts[k][name] != value for k in range(2) for name, value in wanted[k][0].items())
    wrong_counts += sum(found.counts[k][name] != 0 for k in range(2) for name in ("overruns", "waiting", "steps"))
    wrong_readings, rms = 0, []
    for k, wire in enumerate(case.wires):
        sender, order = sender_of(wire, sent[k]), wanted[k][1]
        true = [row.tobytes() for row in sender.values[order]]
        came = keys_of(found.values[k], wire.raw)
        wrong_readings += abs(len(true) - len(came)) + sum(a != b for a, b in zip(true, came, strict=False))
        rms.append(time_errors(wire, sent[k], order, found.times_us[k]) if len(true) == len(came) else np.inf)
    rows = found.rows
    t_s = 1e-6 * (found.pair_us.astype(float) - ORIGIN_US)
    known, ready = rows[:, 12] > 0.0, rows[:, 0] == READY
    since_known = int(np.argmax(known)) if known.any() else len(known)
    since_ready = int(np.argmax(ready)) if ready.any() else len(ready)
    errors = np.column_stack([line_angle_deg(rows[:, 3:6], rec.axis1), line_angle_deg(rows[:, 6:9], rec.axis2)])
    bounds = np.degrees(rows[:, 9:11])
    for_axes = ready & ((rows[:, 1] == 1) if case.skin == 0.0 else False)
    off_s = np.abs(rows[:, 13] - case.lag_s)
    over = known & (off_s > rows[:, 14])
    return Outcome(
        case, float(t_s[-1]), wrong_counts, found.counts, tuple(w[0] for w in wanted), wrong_readings, tuple(rms),
        tuple(found.counts[k]["drift_ppm"] - case.wires[k].drift_ppm for k in range(2)), *judge_pairs(found, duration_s),
        float(t_s[since_known]) if known.any() else np.inf, float(known[since_known:].mean()) if known.any() else 0.0,
        float(1e3 * off_s[-1]) if known[-1] else np.inf, float(1e3 * rows[-1, 14]), float(over.sum() / max(known.sum(), 1)), found.taken,
        float(t_s[since_ready]) if ready.any() else np.inf, float(ready[since_ready:].mean()) if ready.any() else 0.0, bool(ready[-1]),
        int(np.sum(for_axes & (errors.max(1) > MAX_ERROR_DEG))), float(errors[-1].max()), float(bounds[-1].max()), int(rows[-1, 2]))


def measure(settings: Settings, report: Report) -> None:
    duration_s = QUICK_S if settings.quick else HOUR_S
    outcomes = run_jobs(measure_case, [(k, duration_s) for k in range(len(CASES))], "hours", settings)
    report.text(f"A simulated knee for {duration_s:g} s: walking, squats, other motion and rests in turns, ten minutes forward and backward. Two senders with clocks of their own; {100 * LOST:g} % of the "
                f"packets lost, and all of them in bursts of {BURST_S[0]:g} to {BURST_S[1]:g} s about every {BURST_EVERY_S:g} s and once for {SILENCE_S:g} s (sensor 1); "
                f"{100 * LATE:g} % come after later ones, {100 * DOUBLED:g} % twice; delays above the fastest {1e3 * JITTER_S:g} ms rms. Packets, pairing, lag and a hinge of either "
                "kind run as on a hub; the hinge gets pairs once the lag is known, and begins anew when more than 20 ms are taken off. What must be counted follows from the order of arrivals.")
    names = ("readings", "lost", "late", "duplicate", "odd", "restarts")
    report.table(["case", "sensor", *names, "as injected", "times, ms rms", "drift off, ppm"],
                 [[o.case.name, k + 1, *(o.counts[k][name] for name in names), "yes" if all(o.counts[k][n] == o.expected[k][n] for n in names) else "NO",
                   number(o.time_rms_ms[k]), number(o.drift_off_ppm[k], 1)] for o in outcomes for k in range(2)])
    report.table(["case", "lag, ms", "first known, s", "known since", "taken off", "off at the end, ms", "bound, ms", "over", "pairs", "of common times", "longest hole, s"],
                 [[o.case.name, number(1e3 * o.case.lag_s, 0), number(o.lag_first_s, 0), percent(o.lag_known, 1), o.taken, number(o.lag_off_ms, 1), number(o.lag_bound_ms, 1),
                   percent(o.lag_over, 1), o.paired, percent(o.paired, o.to_pair), number(o.hole_s)] for o in outcomes])
    report.table(["case", "model", "first ready, s", "ready since", "false ready, pairs", "axis error at the end, deg", "its bound, deg"],
                 [[o.case.name, ("rigid", "functional")[o.model], number(o.ready_first_s, 0), percent(o.ready, 1), o.false_ready, number(o.error_deg), number(o.bound_deg)]
                  for o in outcomes])
    count = len(outcomes)
    report.require_none("counters that differ from what was injected", sum(o.wrong_counts for o in outcomes), 18 * count)
    report.require_none("readings that are wrong, missing or too many", sum(o.wrong_readings for o in outcomes),
                        sum(o.expected[k]["readings"] for o in outcomes for k in range(2)))
    report.require_most("times of readings, rms, after a minute", max(max(o.time_rms_ms) for o in outcomes), TIME_MOST_MS, " ms")
    report.require_share("common times that became pairs", sum(o.paired for o in outcomes), sum(o.to_pair for o in outcomes), PAIRED_MIN)
    report.require_most("longest time without the pairs that there should be", max(o.hole_s for o in outcomes), HOLE_MOST_S, " s")
    report.require_none("rigid knees that were ever false ready", sum(o.false_ready > 0 for o in outcomes), count)
    if settings.quick:
        return  # the rest is of an hour
    report.require_none("lags not known at the end", sum(not np.isfinite(o.lag_off_ms) for o in outcomes), count)
    beyond = sum(not o.lag_off_ms <= o.lag_bound_ms for o in outcomes)
    report.require("lags beyond their bound at the end", f"{beyond} of {count}", beyond == 0, SKIN if beyond == 1 else "")
    report.require("lag known since it was first, at least 90 %", percent(min(o.lag_known for o in outcomes), 1), min(o.lag_known for o in outcomes) >= LAG_KNOWN_MIN)
    report.require_none("hinges not ready at the end", sum(not o.ready_at_end for o in outcomes), count)
    report.require_none("axes beyond their bound at the end", sum(not o.error_deg <= o.bound_deg for o in outcomes), count)
    report.require_most("known lags beyond their bound, share of the time", max(o.lag_over for o in outcomes), OVER_MAX)
    rigid = [o.ready for o in outcomes if o.case.skin == 0.0]
    report.require("rigid knees: ready since it was first, at least 95 %", percent(min(rigid), 1), min(rigid) >= READY_MIN)
