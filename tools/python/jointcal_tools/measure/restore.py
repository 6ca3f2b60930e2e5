"""Yesterday's calibrations in a body: how soon joints give angles, how good they are, and what becomes of those that do not hold any more."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import native_body
from .. import quaternions as quat
from ..native_body import EVENTS, FLASH_BYTES, Found
from ..native_hub import READY, Packets
from ..simulate import random_unit
from ..simulate_body import RATE_HZ, BodyRecording, simulate_body
from . import people_joints as people
from .body import MOST, UNITS, packets_of
from .harness import Report, Settings, binomial_quantile, median, number, percent, quantile, run_jobs
from .judge import RIG_HINGES, available, line_angle_deg, recording
from .soak import ORIGIN_US, Wire, send

TITLE = "Restored: yesterday's calibrations in a body"
PERSONS, FIRST_SEED = 40, 3001  # nothing was chosen on these
PARENTS = (-1, 0, 1)
FIRST_DAY_S, SECOND_DAY_S = 200.0, 90.0
EVERY = 5  # hundredths of a second from row to row
BITS, DRIFT_PPM, BASE_S, ANEW_S = 16, 100.0, (0.003, 0.063), 0.005
SERIALS = (101, 102, 103)
RECORDINGS = ("rig_1D_02", "rig_1D_04", "knee_drop", "human_knee_left", "people_knee_long_L1", "people_knee_long_R1", "people_walk_L:knee")
SETTLED_S = 3.0  # what sensors say before is left out: motion counts from there
SOON_S, LATE_S, WINDOW_S = 3.0, 10.0, 10.0
SHARE, FAR_DEG = 0.95, 10.0
NONE, SAME, EXCHANGED, SERIAL, OTHER = "no record", "same sensors", "exchanged", "serial numbers exchanged", "another person"
TURNS = {"one turned by 15 deg": 15.0, "one turned by 30 deg": 30.0, "one turned by 90 deg": 90.0}
CASES = (NONE, SAME, EXCHANGED, *TURNS, OTHER, SERIAL)
REMEMBERED, CONFIRMED, DROPPED = range(3)
WRONG_DEG, ANGLE_MOST_DEG = 15.0, 3.0
REACHED = {"simulated people": (0.0, 0.85), "rig": (0.0, 0.85), "people": (0.0, 0.85)}  # known: within 3 s; dropped
WHY_SOON = "2 s of motion and three looks are the least, 3.1 s by the clock; a bound that is too wide for angles waits for the joint's own estimator"
WHY_GONE = "bursts and slow motion: neither confirmed nor dropped by then"


@dataclass
class Outcome:
    group: str
    case: str
    has_kept: bool
    angle_s: float  # from when motion counts to the first angle
    ready_s: float
    confirmed_s: float
    dropped_s: float
    off_deg: float  # of the remembered axes from those of today; nan where unknown
    at_first: tuple[float, float, float, float]  # errors and bounds of both axes when first ready, deg
    over_share: float  # of ready time with an axis beyond its bound
    angle_deg: float  # rms over the first WINDOW_S of angles
    is_kept_axes: bool  # when first ready, the axes were those that were kept


def wires_of(rng: np.random.Generator, bases: np.ndarray) -> list[Wire]:
    return [Wire(0.01, rng.uniform(-DRIFT_PPM, DRIFT_PPM), BITS, MOST, float(base)) for base in bases]


def play(values: list[np.ndarray], joints: list[tuple[int, int]], wires: list[Wire], seed: list[int], serials: tuple[int, ...], flash: np.ndarray | None, keeps: bool) -> Found:
    sent = [send(wire, v, s + 1, np.random.default_rng([*seed, s]), True) for s, (wire, v) in enumerate(zip(wires, values, strict=True))]
    return native_body.run(joints, [s.values for s in sent], packets_of(sent), BITS, UNITS, EVERY, list(serials), flash, keeps)


def play_clean(values: list[np.ndarray], serials: tuple[int, ...], flash: np.ndarray | None, keeps: bool) -> Found:
    """Two sensors of a recording, which share a clock; a packet for each reading."""
    n = len(values[0])
    packets = Packets(np.tile([0, 1], n), np.repeat(np.arange(n) * 10000 + ORIGIN_US, 2), np.repeat(np.arange(n) % (1 << BITS), 2), np.ones(2 * n, int), np.repeat(np.arange(n), 2))
    return native_body.run([(0, 1)], values, packets, BITS, UNITS, EVERY, list(serials), flash, keeps)


def first(t_s: np.ndarray, mask: np.ndarray) -> float:
    return float(t_s[mask.argmax()]) if mask.any() else np.inf


def told(found: Found, event: str, joint: int, origin_us: float) -> float:
    return min((1e-6 * (float(t) - origin_us) for t, e in zip(found.event_us, found.events, strict=True) if EVENTS[int(e[0])] == event and int(e[1]) == joint), default=np.inf)


def judge(group: str, case: str, found: Found, j: int, axes: tuple[np.ndarray, np.ndarray] | None, remembered: np.ndarray | None, flexion: np.ndarray | None, late_s: float,
          motion_s: np.ndarray | None = None) -> Outcome:
    """`motion_s`: seconds of motion at 100 Hz, where not all of the time is motion."""
    rows = found.rows[:, j]
    t_s = 1e-6 * (found.row_us.astype(float) - ORIGIN_US)
    ready, has_angle = rows[:, 0] == READY, np.isfinite(rows[:, 14])
    begin = SETTLED_S + 0.6  # the first readings come after up to 0.6 s
    errors, bounds, over, at_first, angle_deg, off_deg = None, np.degrees(rows[:, 12:14]), 0.0, (np.nan,) * 4, np.nan, np.nan
    if axes is not None:
        errors = np.column_stack([line_angle_deg(rows[:, 6:9], axes[0]), line_angle_deg(rows[:, 9:12], axes[1])])
        off_deg = np.nan if remembered is None else float(max(line_angle_deg(remembered[None, 0:3], axes[0])[0], line_angle_deg(remembered[None, 3:6], axes[1])[0]))
        if ready.any():
            k = int(ready.argmax())
            at_first, over = (*errors[k], *bounds[k]), float(np.mean((errors > bounds).any(1)[ready]))
    if flexion is not None and has_angle.any():
        k = int(has_angle.argmax())
        some = slice(k, k + round(WINDOW_S * RATE_HZ / EVERY))
        when = 1e-6 * (found.time_us.astype(float) - ORIGIN_US) - late_s
        sign = np.sign(rows[:, 6:9] @ axes[0])
        off = np.exp(1j * (sign * rows[:, 14] - np.interp(when, np.arange(len(flexion)) / RATE_HZ, flexion)))[some]
        off = off[np.isfinite(off) & (np.diff(found.time_us[some].astype(float), prepend=0.0) > 0.0)]  # not while the first sensor, of which times are told, is missing
        angle_deg = float(np.degrees(np.sqrt(np.mean(np.angle(off / np.mean(off)) ** 2))))
    is_kept_axes = bool(remembered is not None and case != NONE and ready.any() and np.abs(rows[int(ready.argmax()), 6:12] - remembered).max() < 1e-5)

    def since(at_s: float) -> float:
        if motion_s is None or not np.isfinite(at_s):
            return at_s - begin
        return float(np.diff(np.interp([SETTLED_S, at_s], np.arange(len(motion_s)) / RATE_HZ, motion_s))[0])

    times = (first(t_s, has_angle), first(t_s, ready), told(found, "confirmed", j, ORIGIN_US), told(found, "dropped", j, ORIGIN_US))
    return Outcome(group, case, bool((rows[:, 16] > 0).any()), *map(since, times), off_deg, at_first, over, angle_deg, is_kept_axes)


def turned(values: np.ndarray, angle_deg: float, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    turn = quat.matrices(quat.rotation(np.radians(angle_deg), random_unit(rng))[None])[0]
    return np.hstack([values[:, :3] @ turn.T, values[:, 3:] @ turn.T]), turn


def cut(rec: BodyRecording, begin_s: float, end_s: float) -> tuple[list[np.ndarray], list[np.ndarray]]:
    a, b = round(begin_s * RATE_HZ), round(end_s * RATE_HZ)
    return [v[a:b] for v in rec.values], [f[a:b] for f in rec.flexion_rad]


def person(seed: int) -> list[Outcome]:
    rng = np.random.default_rng([seed, 5])
    rec, other = (simulate_body(FIRST_DAY_S + SECOND_DAY_S, s, PARENTS) for s in (seed, seed + 500))
    bases = rng.uniform(*BASE_S, len(PARENTS))
    flash = np.full(FLASH_BYTES, 0xFF, np.uint8)
    yesterday = play(cut(rec, 0.0, FIRST_DAY_S)[0], rec.joints, wires_of(rng, bases), [seed, 1], SERIALS, flash, True)
    remembered = yesterday.rows[-1, :, 6:12]
    bases = bases + rng.uniform(-ANEW_S, ANEW_S, len(PARENTS))
    wires, out = wires_of(rng, np.clip(bases, 0.001, None)), []
    kept = [bool(yesterday.rows[-1, j, 0] == READY) for j in range(len(rec.joints))]
    for case in CASES:
        today = other if case == OTHER else rec
        values, flexion = cut(today, FIRST_DAY_S, FIRST_DAY_S + SECOND_DAY_S)
        axes, serials = list(today.axes), SERIALS
        if case == EXCHANGED:
            values[1], values[2] = values[2], values[1]
        elif case == SERIAL:
            serials = (SERIALS[0], SERIALS[2], SERIALS[1])
        elif case in TURNS:  # the middle one, which both joints have
            values[1], turn = turned(values[1], TURNS[case], rng)
            axes = [(axes[0][0], turn @ axes[0][1]), (turn @ axes[1][0], axes[1][1])]
        found = play(values, rec.joints, wires, [seed, 2], serials, None if case == NONE else flash, False)
        for j, (proximal, _) in enumerate(rec.joints):
            if kept[j]:
                late_s = wires[proximal].base_s - found.sensors[proximal]["shift_s"]
                out.append(judge("simulated people", case, found, j, None if case == EXCHANGED else axes[j], remembered[j], None if case == EXCHANGED else flexion[j], late_s))
    return out


def weight(sensors: list[np.ndarray]) -> np.ndarray:
    """How much of a second of motion a second counts, as people_joints.motion_weight, of readings at 100 Hz."""
    energy = sum((v[:, :3] ** 2).sum(1) for v in sensors)
    alpha, state, out = 1.0 / (1.0 + people.MOTION_TIME_S * RATE_HZ), float(energy[0]), np.empty(len(energy))
    for k, value in enumerate(energy):
        state += alpha * (value - state)
        out[k] = state
    return out / (out + people.MOTION_RAD2_S2)


def recorded(name: str) -> list[Outcome]:
    """What one half of a recording found is restored in the other one."""
    rec = recording(name) if name in RIG_HINGES else people.people_joint(name)
    t_s, out = np.arange(rec.t_s[0], rec.t_s[-1], 0.01), []
    sensors = [np.column_stack([np.interp(t_s, rec.t_s, side[:, k]) for side in (gyr, acc) for k in range(3)]) for gyr, acc in ((rec.gyr1, rec.acc1), (rec.gyr2, rec.acc2))]
    middle = len(t_s) // 2
    for half in (0, 1):
        mine, others = ([v[:middle] if (half == k) else v[middle:] for v in sensors] for k in (0, 1))
        flash, rng = np.full(FLASH_BYTES, 0xFF, np.uint8), np.random.default_rng([half, len(t_s)])
        yesterday = play_clean(mine, SERIALS[:2], flash, True)
        if yesterday.rows[-1, 0, 0] != READY:
            continue
        axes = (yesterday.rows[-1, 0, 6:9], yesterday.rows[-1, 0, 9:12])
        for case in CASES:
            values, serials, true = list(others), SERIALS[:2], axes
            if case == OTHER:
                continue
            if case == EXCHANGED:
                values = values[::-1]
            elif case == SERIAL:
                serials = SERIALS[1::-1]
            elif case in TURNS:
                values[1], turn = turned(values[1], TURNS[case], rng)
                true = (axes[0], turn @ axes[1])
            motion_s = np.cumsum(weight(others)) / RATE_HZ
            found = play_clean(values, serials, None if case == NONE else flash, False)
            out.append(judge("rig" if name in RIG_HINGES else "people", case, found, 0, None if case == EXCHANGED else true, np.concatenate(axes), None, 0.0, motion_s))
    return out


def measure_one(job: tuple[str, int]) -> list[Outcome]:
    return recorded(job[0]) if job[0] else person(job[1])


def seconds(values: list[float]) -> str:
    finite = [v for v in values if np.isfinite(v)]
    return f"{number(median(finite), 1)}, {number(quantile(finite, 0.9), 1)}" if finite else "-"


def is_far(o: Outcome) -> bool:
    return o.case in (EXCHANGED, SERIAL) or o.off_deg >= FAR_DEG


def is_adopted(o: Outcome) -> bool:
    """Ready with the very axes that were kept, not with what it found itself: that, too, confirms what it agrees with."""
    return o.is_kept_axes


def row_of(group: str, case: str, mine: list[Outcome]) -> list:
    ready = [o for o in mine if np.isfinite(o.ready_s)]
    sides = [o.at_first[k] <= o.at_first[k + 2] for o in ready for k in (0, 1) if np.isfinite(o.at_first[k])]
    return [group, case, len(mine), percent(sum(np.isfinite(o.angle_s) for o in mine), len(mine)), percent(sum(o.angle_s <= SOON_S for o in mine), len(mine)), seconds([o.angle_s for o in mine]),
            percent(sum(np.isfinite(o.confirmed_s) for o in mine), len(mine)), percent(sum(o.dropped_s <= LATE_S for o in mine), len(mine)), seconds([o.dropped_s for o in mine]),
            percent(sum(sides), len(sides)) if sides else "-", percent(float(np.mean([o.over_share for o in ready])) if ready else 0.0, 1.0) if sides else "-",
            ", ".join(number(f([o.angle_deg for o in mine if np.isfinite(o.angle_deg)] or [np.nan]), 1) for f in (np.median, np.max))]


def require_share(report: Report, what: str, hits: int, total: int, reached: float, why: str) -> None:
    """As report.require_share; a share that is known not to be reached fails below `reached`."""
    if total == 0:
        return
    least = binomial_quantile(total, reached, 0.001) if report.quick else reached * total
    report.require(f"{what}, at least {100.0 * SHARE:g} %", f"{percent(hits, total)} of {total}", hits >= SHARE * total, why if hits >= least else "")


def require(report: Report, group: str, mine: list[Outcome]) -> None:
    same, none = ([o for o in mine if o.case == case] for case in (SAME, NONE))
    far = [o for o in mine if o.case != NONE and is_far(o)]
    soon, reached_soon, reached_gone = f"{group}, same sensors: angles within {SOON_S:g} s", *REACHED[group]
    require_share(report, soon, sum(o.angle_s <= SOON_S for o in same), len(same), reached_soon, WHY_SOON)
    require_share(report, f"{group}, exchanged, or an axis {FAR_DEG:g} deg or more off: dropped within {LATE_S:g} s", sum(o.dropped_s <= LATE_S for o in far), len(far), reached_gone, WHY_GONE)
    report.require_none(f"{group}: ready by what was kept with an axis {WRONG_DEG:g} deg or more off, or exchanged", sum(is_adopted(o) and (o.case in (EXCHANGED, SERIAL) or o.off_deg >= WRONG_DEG) for o in mine), len(mine))
    adopted = [o for o in mine if is_adopted(o) and np.isfinite(o.at_first[0])]
    sides = [o.at_first[k] <= o.at_first[k + 2] for o in adopted for k in (0, 1)]
    if sides and not report.quick:
        report.require_share(f"{group}: axes within their bound when ready by what was kept", sum(sides), len(sides), SHARE)
    angles = [o.angle_deg for o in same if is_adopted(o) and np.isfinite(o.angle_deg)]
    if angles and not report.quick:
        report.require_share(f"{group}, same sensors: angle by what was kept, rms of its first {WINDOW_S:g} s, at most {ANGLE_MOST_DEG:g} deg", sum(a <= ANGLE_MOST_DEG for a in angles), len(angles), SHARE)
    if same and none:
        earlier = sum(a.angle_s <= b.angle_s for a, b in zip(same, none, strict=True))
        require_share(report, f"{group}: angles not later than without a record", earlier, len(same), 0.9, "the lag is looked for later, after what was kept")


def measure(settings: Settings, report: Report) -> None:
    names = [name for name in RECORDINGS if available(name.split(":")[0])]
    jobs = [("", FIRST_SEED + k) for k in range(settings.count(PERSONS, 2))] + [(name, 0) for name in ([] if settings.quick else names)]
    outcomes = [o for of in run_jobs(measure_one, jobs, "restore", settings) for o in of]
    report.text(f"Simulated persons of three sensors and two hinges (simulate_body.py): {FIRST_DAY_S:g} s on the first day, at the end of which all that is ready is written; "
                f"then {SECOND_DAY_S:g} s of the same person on the second. Clocks, losses and bursts as in body.md; lags of {1e3 * BASE_S[0]:g} to {1e3 * BASE_S[1]:g} ms, on the second day "
                f"up to {1e3 * ANEW_S:g} ms otherwise. Nothing was chosen on these persons (seeds {FIRST_SEED} and on); seeds 1 to 16 were looked at. Recordings: what one half found is restored in the other, two sensors, "
                "one clock; errors count from what was restored.")
    report.text(f"Seconds begin {SETTLED_S:g} s after the first readings, when filters have settled: simulated persons move at once, and theirs are of the clock; those of recordings are of motion, as estimators count it. Median and 90 % of those that got there. Exchanged: the two "
                "distal sensors sit on each other's places; their joint is one still, and may become ready by itself. Turned: about a random line, which may be the axis itself. Serial numbers exchanged: refused "
                "when the record is read. The angle's error is rms over its first 10 s, its mean left out.")
    groups = [group for group in REACHED if any(o.group == group for o in outcomes)]
    report.table(["joints", "what", "runs", "angles", "within 3 s", "median, 90 %, s", "confirmed", "dropped within 10 s", "median, 90 %, s", "axes within bound when first ready", "ready time beyond bound", "angle, deg: median, worst"],
                 [row_of(group, case, mine) for group in groups for case in CASES if (mine := [o for o in outcomes if (o.group, o.case) == (group, case)])])
    for group in groups:
        require(report, group, [o for o in outcomes if o.group == group])
