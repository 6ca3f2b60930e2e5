"""A whole person's sensors over a bad wire: which joints become ready, what is wrong, what is counted, what is said of faults."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np

from .. import native_body
from ..native_body import EVENTS, Found
from ..native_hub import READY, Packets
from ..simulate_body import NAMES, RATE_HZ, BodyRecording, simulate_body
from .harness import Report, Settings, median, number, percent, quantile, run_jobs
from .judge import MAX_ERROR_DEG, line_angle_deg
from .soak import ORIGIN_US, Sent, Wire, expected, send

TITLE = "Body: sixteen sensors and fifteen joints"
LONG_S, QUICK_S = 600.0, 150.0
PERSONS = tuple(range(21, 29))  # persons 1 to 3 and 11 to 13 were looked at while this was made
STRANGERS = tuple(range(41, 53))  # whose sensors are exchanged; 21 to 28 and 31 to 34 were looked at while naming was made
UNITS, EVERY = 80, 25  # units of a step of 10 ms; steps from row to row
BITS, MOST = 16, 4
DRIFT_PPM, BASE_S = 100.0, (0.003, 0.103)
WINDOW_S = 10.0
ANGLE_MOST_DEG, COVERED_MIN, LAG_MIN, READY_MIN, NAMED_MIN = 3.0, 0.95, 0.95, 0.9, 0.5
ARMS_ALIKE = "The axes of both arms are parallel here and the trunk moves both: a forearm then explains the other upper arm's motion for minutes, until another joint of its sensor is told to be none"
ARMS_ALIKE_SHARE = 0.15  # more than this is not known
EXCHANGED = (5, 8)  # left and right forearm
FAULTY, FAULT = 11, 1.10  # left shank: its accelerometer reads so many times too much


@dataclass(frozen=True)
class Case:
    name: str
    exchanged: bool = False
    faulty: bool = False

    def spared(self, joints: list[tuple[int, int]]) -> list[int]:
        """Joints of sensors that are where they should be, and read what they should."""
        wrong = (set(EXCHANGED) if self.exchanged else set()) | ({FAULTY} if self.faulty else set())
        return [j for j, pair in enumerate(joints) if not wrong & set(pair)]


CASES = (Case("as they should be"), Case("left and right forearm exchanged", exchanged=True), Case("left shank's forces 10 % too large", faulty=True))


@dataclass
class Joint:
    """What was said of one joint, and what is true."""

    lag_s: float  # first known
    ready_s: float  # first ready
    ready: float  # share of rows since
    at_first: tuple[float, float, float, float]  # errors and bounds of both axes, deg
    at_end: tuple[float, float, float, float] | None
    false_rows: int  # ready for axes, and further off than MAX_ERROR_DEG
    over_rows: int  # ready, and further off than the bound
    ready_rows: int
    lag_off_ms: float
    lag_bound_ms: float
    angle_deg: float  # median over windows


@dataclass
class Outcome:
    case: Case
    person: int
    joints: list[Joint]
    spared: list[int]
    wrong_counts: int
    unaccounted: int
    events: Counter
    told: list[tuple[float, str, int, int, int]]  # s, event, joint, sensor, what
    most_units: int
    mean_units: float
    missed: float  # share of common times, mean of sensors
    overruns: int


def packets_of(sent: list[Sent]) -> Packets:
    arrival = np.concatenate([s.arrival_s for s in sent])
    order = np.argsort(arrival, kind="stable")
    return Packets(np.repeat(range(len(sent)), [len(s.first) for s in sent])[order], np.rint(1e6 * arrival[order]) + ORIGIN_US,
                   *(np.concatenate([getattr(s, name) for s in sent])[order] for name in ("counter", "count", "first")))


def angle_errors_deg(flexion: np.ndarray, true: np.ndarray) -> list[float]:
    """rms of each window of which at least half is known, its mean left out: the angle's zero is arbitrary."""
    off = np.exp(1j * (flexion - true))
    rows = round(WINDOW_S * RATE_HZ / EVERY)
    parts = [off[k:k + rows][np.isfinite(flexion[k:k + rows])] for k in range(0, len(off) - rows, rows)]
    return [float(np.degrees(np.std(np.angle(part / np.mean(part))))) for part in parts if 2 * len(part) >= rows]


def angles_deg(rec: BodyRecording, j: int, found: Found, wires: list[Wire]) -> list[float]:
    """Errors of the angle, from the last time on that a lag was taken off: until then a sensor's times are off against those of the truth."""
    rows, first = found.rows[:, j], rec.joints[j][0]
    late_s = wires[first].base_s - found.sensors[first]["shift_s"]
    t_s = 1e-6 * (found.time_us.astype(float) - ORIGIN_US) - late_s
    settled = t_s > max((1e-6 * (float(t) - ORIGIN_US) for t, e in zip(found.event_us, found.events, strict=True) if EVENTS[int(e[0])] == "lag_found"), default=np.inf)
    true = np.interp(t_s, np.arange(len(rec.flexion_rad[j])) / RATE_HZ, rec.flexion_rad[j])
    sign = np.sign(rows[:, 6:9] @ rec.axes[j][0])
    return angle_errors_deg(np.where((rows[:, 0] == READY) & settled, sign * rows[:, 14], np.nan), true)


def judge_joint(rec: BodyRecording, j: int, found: Found, wires: list[Wire]) -> Joint:
    lag_s = wires[rec.joints[j][1]].base_s - wires[rec.joints[j][0]].base_s
    rows = found.rows[:, j]
    t_s = 1e-6 * (found.row_us.astype(float) - ORIGIN_US)
    known, ready = rows[:, 3] > 0.0, rows[:, 0] == READY
    errors = np.column_stack([line_angle_deg(rows[:, 6:9], rec.axes[j][0]), line_angle_deg(rows[:, 9:12], rec.axes[j][1])])
    bounds = np.degrees(rows[:, 12:14])
    first = int(ready.argmax()) if ready.any() else 0
    angles = angles_deg(rec, j, found, wires)
    return Joint(
        float(t_s[known.argmax()]) if known.any() else np.inf, float(t_s[first]) if ready.any() else np.inf,
        float(ready[first:].mean()) if ready.any() else 0.0, (*errors[first], *bounds[first]), (*errors[-1], *bounds[-1]) if ready[-1] else None,
        int(np.sum(ready & (rows[:, 2] > 0.0) & (errors.max(1) > MAX_ERROR_DEG))), int(np.sum(ready & (errors > bounds).any(1))), int(ready.sum()),
        float(1e3 * abs(rows[-1, 4] - lag_s)) if known[-1] else np.inf, float(1e3 * rows[-1, 5]), median(angles) if angles else np.nan)


def measure_case(job: tuple[int, int, float]) -> Outcome:
    case, person, duration_s = CASES[job[0]], job[1], job[2]
    rec = simulate_body(duration_s, person)
    values = [v.copy() for v in rec.values]
    if case.exchanged:
        values[EXCHANGED[0]], values[EXCHANGED[1]] = values[EXCHANGED[1]], values[EXCHANGED[0]]
    if case.faulty:
        values[FAULTY][:, 3:] *= FAULT
    rng = np.random.default_rng([person, 7])
    wires = [Wire(0.01, rng.uniform(-DRIFT_PPM, DRIFT_PPM), BITS, MOST, rng.uniform(*BASE_S)) for _ in values]
    sent = [send(wire, v, s, np.random.default_rng([person, 9, s]), True) for s, (wire, v) in enumerate(zip(wires, values, strict=True))]
    found = native_body.run(rec.joints, [s.values for s in sent], packets_of(sent), BITS, UNITS, EVERY)
    wanted = [expected(s)[0] for s in sent]
    counters = found.sensors
    wrong = sum(counters[s][name] != value for s, of in enumerate(wanted) for name, value in of.items())
    wrong += sum(c[name] != 0 for c in counters for name in ("overruns", "waiting", "steps", "rejected"))
    rounds = found.status["rounds"]
    return Outcome(
        case, person, [judge_joint(rec, j, found, wires) for j in range(len(rec.joints))], case.spared(rec.joints),
        wrong, sum(c["samples"] + c["missed"] != rounds for c in counters) + found.status["events_dropped"],
        Counter(EVENTS[int(e[0])] for e in found.events),
        [(1e-6 * (float(t) - ORIGIN_US), EVENTS[int(e[0])], int(e[1]), int(e[2]), int(e[3])) for t, e in zip(found.event_us, found.events, strict=True)],
        found.most_units, found.status["units"] / found.steps, float(np.mean([c["missed"] / rounds for c in counters])), sum(c["overruns"] for c in counters))


def told_after(o: Outcome, event: str, of: int) -> float:
    """s; `of`: joint or sensor."""
    return min((t for t, name, joint, sensor, _ in o.told if name == event and of in (joint, sensor)), default=np.inf)


def seconds(value: float) -> str:
    return number(value, 0) if np.isfinite(value) else "never"


def covered(joints: list[Joint], at_end: bool) -> tuple[int, int]:
    sides = [of[k] <= of[k + 2] for j in joints if np.isfinite(j.ready_s) for of in [j.at_end if at_end else j.at_first] if of for k in (0, 1)]
    return sum(sides), len(sides)


def measure(settings: Settings, report: Report) -> None:
    if settings.only in (None, "persons"):
        measure_persons(settings, report)
    if settings.only in (None, "sections"):
        from . import body_recorded, body_slips  # which ask this module

        body_recorded.describe(report)
        body_slips.describe(settings, report)


def measure_persons(settings: Settings, report: Report) -> None:
    duration_s = QUICK_S if settings.quick else LONG_S
    persons = PERSONS[:1] if settings.quick else PERSONS
    strangers = STRANGERS[:1] if settings.quick else STRANGERS
    chosen = {0: persons, 1: strangers, 2: persons[: max(1, len(persons) // 2)]}
    jobs = [(k, person, duration_s) for k in range(len(CASES)) for person in chosen[k]]
    outcomes = run_jobs(measure_case, jobs, "persons", settings)
    report.text(f"{len(persons)} simulated persons for {duration_s:g} s, {len(NAMES)} sensors and {len(NAMES) - 1} hinges each (simulate_body.py): every joint bends and swells in a time of its own, "
                f"under skin of 1.2 deg rms. Sensors send packets of 1 to {MOST} readings at {RATE_HZ:g} Hz, with clocks of up to {DRIFT_PPM:g} ppm, late by {1e3 * BASE_S[0]:g} to "
                f"{1e3 * BASE_S[1]:g} ms; packets are lost, late and doubled as in soak.md, in bursts about every 40 s of each sensor, and sensor 0 is silent for 20 s. A step of {UNITS} units every "
                "10 ms. Settings of jointcal are the defaults.")
    fine = [o for o in outcomes if o.case.name == CASES[0].name]
    report.table(["person", "lags known, s: first, median, last", "ready, s: first, median, last", "ready since, least", "ready at the end", "left ready", "moved", "not one joint", "sensor bad",
                  "common times missed", "units a step", "most"],
                 [[o.person, *("{}, {}, {}".format(*(seconds(quantile([getattr(j, name) for j in o.joints], q)) for q in (0.0, 0.5, 1.0))) for name in ("lag_s", "ready_s")),
                   percent(min(j.ready for j in o.joints), 1), sum(j.at_end is not None for j in o.joints), *(o.events[name] for name in ("left_ready", "moved", "not_one", "sensor_bad")),
                   percent(o.missed, 1), number(o.mean_units, 1), o.most_units] for o in fine])
    joints = [j for o in fine for j in o.joints]
    ready = [j for j in joints if np.isfinite(j.ready_s)]
    rows = sum(j.ready_rows for j in joints)
    first, end = covered(joints, False), covered(joints, True)
    report.table(["joints", "ever ready", "ready at the end", "axes within bound when first ready", "at the end", "rows beyond the bound", "error at the end, deg: median, worst", "bound, median", "lag off, ms: median, worst",
                  "its bound, median", "angle, deg rms: median, worst"],
                 [[len(joints), len(ready), sum(j.at_end is not None for j in joints), percent(*first), percent(*end), percent(sum(j.over_rows for j in joints), max(rows, 1)),
                   "{}, {}".format(*(number(f([e for j in joints if j.at_end for e in j.at_end[:2]] or [np.nan])) for f in (np.median, np.max))),
                   number(median([b for j in joints if j.at_end for b in j.at_end[2:]] or [np.nan])),
                   "{}, {}".format(*(number(f([j.lag_off_ms for j in joints if np.isfinite(j.lag_off_ms)] or [np.nan]), 1) for f in (np.median, np.max))),
                   number(median([j.lag_bound_ms for j in joints if np.isfinite(j.lag_off_ms)] or [np.nan]), 1),
                   "{}, {}".format(*(number(f([j.angle_deg for j in joints if np.isfinite(j.angle_deg)] or [np.nan])) for f in (np.median, np.max)))]])
    bad = [o for o in outcomes if o.case.name != CASES[0].name]
    report.table(["case", "person", "joints of the sensors", "ever ready", "told: not one joint, s", "told: exchanged, s", "told: sensor bad, s", "other joints ready at the end", "others told of"],
                 [[o.case.name, o.person, len(o.joints) - len(o.spared), sum(np.isfinite(j.ready_s) for k, j in enumerate(o.joints) if k not in o.spared),
                   ", ".join(seconds(told_after(o, "not_one", k)) for k in range(len(o.joints)) if k not in o.spared),
                   ", ".join(f"{t:.0f}" for t, pair in exchanges(o) if pair == set(EXCHANGED)) or "never", seconds(told_after(o, "sensor_bad", FAULTY)), f"{sum(o.joints[k].at_end is not None for k in o.spared)} of {len(o.spared)}", wrongly_told(o)] for o in bad])
    report.require_none("counters that differ from what was injected", sum(o.wrong_counts for o in outcomes), 10 * len(NAMES) * len(outcomes))
    report.require_none("sensors whose common times are not all counted, events dropped", sum(o.unaccounted for o in outcomes), len(NAMES) * len(outcomes))
    report.require_most("units of a step", max(o.most_units for o in outcomes), UNITS)
    report.require_none("joints ever ready for axes beyond 3 deg", sum(j.false_rows > 0 for o in outcomes for k, j in enumerate(o.joints) if k in o.spared), len(joints))
    report.require_none("exchanges told of sensors that are not", sum(pair != (set(EXCHANGED) if o.case.exchanged else set()) for o in outcomes for _, pair in exchanges(o)), len(outcomes))
    strange_joints = [j for o in bad if o.case.exchanged for k, j in enumerate(o.joints) if k not in o.spared]
    ever = sum(np.isfinite(j.ready_s) for j in strange_joints)
    report.require_none("joints of exchanged sensors ever ready", ever, len(strange_joints))
    if ever <= ARMS_ALIKE_SHARE * len(strange_joints):
        report.requirements[-1].known = ARMS_ALIKE
    report.require_none("good joints told to be none, good sensors told to be bad", sum(wrongly_told(o) for o in outcomes), len(outcomes) * (2 * len(NAMES) - 1))
    if settings.quick:
        return  # the rest is of ten minutes
    report.require_share("axes within their bound when first ready", first[0], first[1], COVERED_MIN)
    report.require_share("axes within their bound at the end", end[0], end[1], COVERED_MIN)
    strange = [o for o in bad if o.case.exchanged]
    report.require_share("exchanged sensors named within ten minutes", sum(bool(exchanges(o)) for o in strange), len(strange), NAMED_MIN)
    report.require_none("joints never ready", len(joints) - len(ready), len(joints))
    report.require_share("joints ready at the end", sum(j.at_end is not None for j in joints), len(joints), READY_MIN)
    report.require_share("lags within their bound at the end", sum(j.lag_off_ms <= j.lag_bound_ms for j in joints), len(joints), LAG_MIN)
    report.require_most("angle, median over windows, worst joint", max(j.angle_deg for j in joints), ANGLE_MOST_DEG, " deg")
    report.require_none("faulty sensors not named", sum(not np.isfinite(told_after(o, "sensor_bad", FAULTY)) for o in bad if o.case.faulty), sum(o.case.faulty for o in bad))


def exchanges(o: Outcome) -> list[tuple[float, set[int]]]:
    """When, s, and which two sensors were told to be exchanged."""
    return [(t, {sensor, what}) for t, name, _, sensor, what in o.told if name == "exchanged"]


def wrongly_told(o: Outcome) -> int:
    """Joints that are one and told to be none, sensors that are fine and told to be bad."""
    joints = {joint for _, name, joint, _, _ in o.told if name == "not_one"} & set(o.spared)
    sensors = {sensor for _, name, _, sensor, _ in o.told if name == "sensor_bad"} - ({FAULTY} if o.case.faulty else set())
    return len(joints) + len(sensors)
