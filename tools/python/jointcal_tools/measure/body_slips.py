"""A body's joints after they became ready: slips of some sensors, awake and asleep, false alarms of all others, units of work."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import native_body
from ..native_body import EVENTS
from ..native_hub import READY
from ..simulate_body import RATE_HZ, simulate_body
from .body import packets_of
from .harness import Report, Settings, median, number, percent, run_jobs
from .judge import line_angle_deg
from .restore import turned
from .soak import ORIGIN_US, Wire, send

PERSONS = (31, 32)
SLIP_DEG = (15.0, 30.0)
LONG_S, SLIP_S, MARK_S = 420.0, 300.0, 250.0
SLIPPED = (3, 6, 9, 14)  # head, both hands, right shank: five joints, and ten that stay
UNITS, EVERY, BITS, MOST = 80, 25, 16, 4
MOTION_RAD_S, SOON_S = 0.5, 30.0
TOLD_MIN, FALSE_AN_HOUR = 0.8, 1.0


@dataclass
class Slip:
    axis_deg: float  # by how much the slip turned the joint's axis in the sensor
    moved_s: float  # motion until `moved`
    not_ready_s: float  # motion until it was first not ready
    wrong_s: float  # time ready, and the axis further off than its bound, since the slip


@dataclass
class Outcome:
    slip_deg: float
    asleep: bool
    slips: list[Slip]  # of joints that were ready then
    joints: int  # that slipped
    false_moved: int
    hours: float  # of joints that were ready and did not slip
    units: float  # mean of a step after MARK_S
    units_before: float


def measure_one(job: tuple[int, float, bool]) -> Outcome:
    person, slip_deg, asleep = job
    rec = simulate_body(LONG_S, person)
    rng = np.random.default_rng([person, 17])
    at = round(SLIP_S * RATE_HZ)
    axes = [list(pair) for pair in rec.axes]
    for s in SLIPPED:
        rec.values[s][at:], turn = turned(rec.values[s][at:], slip_deg, rng)
        for j, pair in enumerate(rec.joints):
            if s in pair:
                axes[j][pair.index(s)] = turn @ axes[j][pair.index(s)]
    wires = [Wire(0.01, rng.uniform(-100.0, 100.0), BITS, MOST, rng.uniform(0.003, 0.103)) for _ in rec.values]
    sent = [send(wire, v, s, np.random.default_rng([person, 9, s]), True) for s, (wire, v) in enumerate(zip(wires, rec.values, strict=True))]
    mark = round(100 * MARK_S)
    found = native_body.run(rec.joints, [s.values for s in sent], packets_of(sent), BITS, UNITS, EVERY, mark=mark, sleeps=asleep)
    row_s = 1e-6 * (found.row_us.astype(float) - ORIGIN_US)
    event_s = 1e-6 * (found.event_us.astype(float) - ORIGIN_US)
    out = Outcome(slip_deg, asleep, [], 0, 0, 0.0, (found.status["units"] - found.mark_units) / (found.steps - mark), found.mark_units / mark)
    for j, pair in enumerate(rec.joints):
        ready = found.rows[:, j, 0] == READY
        moved = [float(t) for t, e in zip(event_s, found.events, strict=True) if EVENTS[int(e[0])] == "moved" and int(e[1]) == j]
        if not set(pair) & set(SLIPPED):
            out.false_moved += len(moved)
            out.hours += float(ready.sum()) * EVERY / 100.0 / 3600.0
            continue
        out.joints += 1
        early = row_s < SLIP_S
        out.false_moved += sum(t < SLIP_S for t in moved)
        out.hours += float(ready[early].sum()) * EVERY / 100.0 / 3600.0
        if not ready[early][-1]:
            continue
        rates = np.sqrt(sum((rec.values[s][at:, :3] ** 2).sum(1) for s in pair))
        motion_s = np.concatenate([[0.0], np.cumsum(rates > MOTION_RAD_S)]) / RATE_HZ

        def motion(t_s: float, clock: np.ndarray = motion_s) -> float:
            return float(np.interp(t_s - SLIP_S, np.arange(len(clock)) / RATE_HZ, clock)) if np.isfinite(t_s) else np.inf

        errors = np.column_stack([line_angle_deg(found.rows[:, j, 6 + 3 * k:9 + 3 * k], axes[j][k]) for k in (0, 1)])
        over = (errors > np.degrees(found.rows[:, j, 12:14])).any(1)
        k = next(k for k, s in enumerate(pair) if s in SLIPPED)
        out.slips.append(Slip(float(line_angle_deg(axes[j][k][None], rec.axes[j][k])[0]), motion(min((t for t in moved if t >= SLIP_S), default=np.inf)),
                              motion(float(row_s[~early][(~ready[~early]).argmax()]) if (~ready[~early]).any() else np.inf),
                              float(np.sum(ready & over & ~early)) * EVERY / 100.0))
    return out


def describe(settings: Settings, report: Report) -> None:
    persons = PERSONS[:1] if settings.quick else PERSONS
    jobs = [(person, deg, asleep) for asleep in (False, True) for deg in SLIP_DEG for person in persons]
    if settings.quick:
        jobs = jobs[1:2]
    outcomes = run_jobs(measure_one, jobs, "slips", settings)
    report.text(f"**Slips.** {len(persons)} more persons over the same wire for {LONG_S:g} s. From {SLIP_S:g} s on the sensors of head, both hands and right shank are turned by an angle about random lines: "
                f"five joints of each person slip, ten do not. Asleep: whatever is ready is put to sleep from {MARK_S:g} s on. Motion is time in which both rates together are above {MOTION_RAD_S:g} rad/s. "
                "Counted are joints that were ready when they slipped; false are `moved` of joints that did not, by hours of joints that were ready; all rows play the same persons.")
    rows = []
    for asleep in (False, True):
        for deg in SLIP_DEG:
            mine = [o for o in outcomes if o.slip_deg == deg and o.asleep == asleep]
            slips = [s for o in mine for s in o.slips]
            if mine:
                rows.append(["asleep" if asleep else "awake", f"{deg:g}", f"{len(slips)} of {sum(o.joints for o in mine)}", number(median([s.axis_deg for s in slips]), 1),
                             percent(sum(s.moved_s <= SOON_S for s in slips), len(slips)), number(median([s.moved_s for s in slips]), 1), number(max((s.moved_s for s in slips), default=np.nan), 1),
                             percent(sum(min(s.moved_s, s.not_ready_s) <= SOON_S for s in slips), len(slips)), number(median([s.wrong_s for s in slips]), 1),
                             f"{sum(o.false_moved for o in mine)} in {sum(o.hours for o in mine):.1f} h",
                             number(float(np.mean([o.units_before for o in mine])), 1), number(float(np.mean([o.units for o in mine])), 1)])
    report.table(["joints", "slip, deg", "ready then", "axis turned by, deg, median", f"`moved` within {SOON_S:g} s of motion", "motion until `moved`, s: median", "most", f"not ready or `moved` within {SOON_S:g} s",
                  "ready beyond the bound since, s, median", "false `moved`", f"units a step until {MARK_S:g} s", "after"], rows)
    for asleep in (False, True):
        mine = [o for o in outcomes if o.asleep == asleep]
        large = [s for o in mine if o.slip_deg == max(SLIP_DEG) for s in o.slips]
        word = "asleep" if asleep else "awake"
        if mine:
            report.require_share(f"slips of {max(SLIP_DEG):g} deg told within {SOON_S:g} s of motion, {word}", sum(s.moved_s <= SOON_S for s in large), len(large), TOLD_MIN)
            report.require_most(f"false `moved` an hour and joint, {word}", sum(o.false_moved for o in mine) / max(sum(o.hours for o in mine), 1e-9), FALSE_AN_HOUR)
