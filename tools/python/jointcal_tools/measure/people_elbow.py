"""People's elbows: heading, both axes and both levers beside optical references, when each becomes known, and the joint's angles."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import native_two_axes as two_axes
from . import optical
from . import people_joints as people
from .harness import Report, Settings, Skipped, median, number, percent, quantile, run_jobs
from .judge import available, cut
from .people_ball import (AXES, BEYOND, HEADING, ITEMS, SCALES, UNKNOWN_BOUNDS, UNITS, Known, Truth, at_ticks, axis_truth, bounds, errors, first,
                          known, lab_quaternions, require_share, truth_of)
from .people_flexion import apart_rms_deg
from .people_hinge import SAME_SENSORS, TEMPERATURES, settled

TITLE = "People's elbows: two axes"
OPTICAL = ("people_elbow_B_JA_Fast", "people_elbow_D_ROM", "people_elbow_E_ROM")
WITHOUT = ("human_elbow_right",)
ISOLATED = "people_elbow_B_JA_Fast"
WITHIN_S = (10.0, 20.0, 30.0)  # of motion
HEADING_S = 20.0  # of motion, within which the heading of a joint that moves is to be known
EVERY_S, QUICK_EVERY_S = 10.0, 30.0
COVERED = 0.95
RELATIVE_HZ = 3.0  # of optical relative rates
MOSTLY_S, MOSTLY_SHARE, MOSTLY_RAD_S = 2.5, 0.85, 0.3  # a motion is mostly about an axis: this share of the square of the relative rate
MOTIONS = ("bends", "turns")
# What is not met, and why.
NOT_COMPLETE = {"people_elbow_E_ROM": "The heading is known to 15 deg only when the elbow has ceased to bend and to turn; the bound of lever 1 is just above its limit"}
LEVER_LATE = ("Which axis a motion is about is told by the forearm's lever along itself. While the forearm alone turns, the elbow moves at 2 to 3 cm/s: heading "
              "and lever become known when it has ceased to")
NO_HEADING = {"people_ankle_orthosis": "It bends by 7 deg, and its accelerometers clip and read 10.9 m/s^2 at rest"}
KNOWN_STARTS: dict[int, Known] = {}


# What the references say of the motion.

def optical_rates(name: str) -> tuple[np.ndarray, np.ndarray]:
    """Relative rates (N, 3), (N, 3) in the frames of sensors 1 and 2, rad/s, low-passed; zero where the references are lost."""
    rec, (q1, q2) = people.people_joint(name), lab_quaternions(name)
    relative = optical.multiply(optical.conjugate(q1), q2)
    rates = np.vstack([np.zeros(3), optical.steps(relative) * rec.rate_hz])
    seen1 = optical.rotate(relative, rates)
    return tuple(people.low_pass(np.nan_to_num(seen), rec.rate_hz, RELATIVE_HZ) for seen in (seen1, rates))


def change_at(before2: np.ndarray, after2: np.ndarray) -> int:
    """The sample at which one motion gives way to another: most of the one's square before it and most of the other's after it."""
    return int(np.argmax(np.concatenate([[0.0], np.cumsum(before2 - after2)])))


def mostly(along: np.ndarray, total2: np.ndarray, count: int) -> np.ndarray:
    """(N,) bool: over the last `count` samples the relative rate is fast, and mostly along an axis. total2: its square."""
    summed = [np.concatenate([np.zeros(count), np.cumsum(part)]) for part in (along**2, total2)]
    square, total = (part[count:] - part[:-count] for part in summed)
    return (square >= MOSTLY_SHARE * total) & (total >= count * MOSTLY_RAD_S**2)


def motions(name: str) -> list[np.ndarray]:
    """[(N,), (N,)] bool: the elbow mostly bends, the forearm mostly turns."""
    rate_hz = people.people_joint(name).rate_hz
    return [mostly(rates @ axis, (rates**2).sum(axis=1), round(MOSTLY_S * rate_hz))
            for rates, axis in zip(optical_rates(name), axis_truth(name), strict=True)]


# Whole recordings.

@dataclass
class Whole:
    name: str
    seconds: float
    motion_s: float
    track: two_axes.Track
    moved: np.ndarray  # (M,) motion at the ticks
    known: np.ndarray  # (M, 5)
    bounds: np.ndarray
    errors: np.ndarray


def measure_whole(name: str) -> Whole:
    rec = people.people_joint(name)
    track, moved = two_axes.run(rec), people.motion_s(rec)
    truth = truth_of(name, track) if name in OPTICAL else Truth()
    return Whole(name, float(rec.t_s[-1] - rec.t_s[0]), float(moved[-1]), track, moved[track.sample], known(track), bounds(track),
                 errors(track, truth))


def item_row(w: Whole, item: int) -> list:
    flags, scale = w.known[:, item], SCALES[item]
    k, digits = first(flags), 1 if UNITS[item] == "deg" else 0
    at = [] if k is None else [number(w.track.t_s[k], 1), number(w.moved[k], 1),
                                                           number(scale * w.errors[k, item], digits), number(scale * w.bounds[k, item], digits)]
    end = [number(scale * w.errors[-1, item], digits),
           number(scale * w.bounds[-1, item], digits) if w.bounds[-1, item] < UNKNOWN_BOUNDS[item] else "-"]
    off = w.errors[flags, item]
    off = off[np.isfinite(off)]
    return [w.name, ITEMS[item], UNITS[item], *(at or ["never", "never", "-", "-"]), *end, "yes" if flags[-1] else "no",
            *(number(scale * value, digits) for value in (median(off), quantile(off, 0.9), quantile(off, 1.0)))]


def report_whole(report: Report, wholes: list[Whole]) -> None:
    report.text("## Whole recordings\n\nA fresh instance with its defaults from the first sample to the last. Motion: seconds weighted by "
                "m/(m + 1), m the sum of both squared rates. Error and bound when it first becomes known, and at the end, known or not; while known: "
                "median, 90 % and largest error. The true heading: yaws by which optical orientations and those of the sensor stage "
                "differ, mean over 1 s. True axes: main axes of optical relative rates in another trial of the same person; true levers: from the middle "
                "of the epicondyles.")
    report.table(["recording", "what", "unit", "known after, s", "after motion, s", "error", "bound", "error at the end", "bound", "known at the end",
                  "while known, median", "90 %", "largest"], [item_row(w, item) for w in wholes for item in range(5)])
    report.table(["recording", "seconds", "of motion", "windows of axis 1", "of axis 2", "left of the centre's motion, %", "at the end"],
                 [[w.name, number(w.seconds, 0), number(w.motion_s, 0), *w.track.windows[-1],
                   number(100.0 * w.track.left[-1] / max(w.track.speed2[-1], 1e-9), 1), two_axes.reason_name(w.track.reason[-1])] for w in wholes])
    mine = [w for w in wholes if w.name in OPTICAL]
    wrong = [f"{w.name}: {ITEMS[item]}" for w in mine for item in range(5) if (w.known & (w.errors > BEYOND * w.bounds))[:, item].any()]
    report.require("known and beyond twice its bound at any time", ", ".join(wrong) or f"none of {5 * len(mine)}", not wrong)
    at_end = [(w.errors[-1, item], w.bounds[-1, item]) for w in mine for item in range(5) if w.known[-1, item]]
    report.require_share("known at the end and within its bound", sum(e <= b for e, b in at_end), len(at_end), COVERED)
    for w in mine:
        report.require(f"{w.name}: heading, both levers and both axes become known",
                       ", ".join(ITEMS[item] for item in range(5) if not w.known[:, item].any()) + " never" if not w.known.any(axis=0).all() else "all",
                       bool(w.known.any(axis=0).all()), NOT_COMPLETE.get(w.name, ""))


# One motion, then the other.

@dataclass
class Part:
    motion: int  # of MOTIONS
    warm: bool
    begin_s: float
    end_s: float
    known: np.ndarray  # (5,) at any time
    after_s: np.ndarray  # (5,)
    own_s: np.ndarray  # (2,) of the motions, in the part
    errors: np.ndarray  # (5,) at the end
    bounds: np.ndarray


def measure_part(job: tuple[int, bool]) -> Part:
    """The part of ISOLATED that bends (0) or turns (1) only, by itself."""
    motion, warm = job
    rec = people.people_joint(ISOLATED)
    (in1, in2), (axis1, axis2) = optical_rates(ISOLATED), axis_truth(ISOLATED)
    change = change_at((in1 @ axis1) ** 2, (in2 @ axis2) ** 2)
    begin, end = ((0, change), (change, len(rec)))[motion]
    before = (settled(rec, begin) or 0) if warm else begin
    track = two_axes.run(cut(rec, before, end), begin=begin - before)
    flags = known(track)
    late = track.sample >= begin - before
    flags &= late[:, None]
    firsts = [first(flags[:, item]) for item in range(5)]
    after = np.array([np.inf if k is None else track.t_s[k] - (rec.t_s[begin] - rec.t_s[before]) for k in firsts])
    own = np.array([rows[begin:end].sum() / rec.rate_hz for rows in motions(ISOLATED)])
    return Part(motion, warm, float(rec.t_s[begin]), float(rec.t_s[end - 1]), flags.any(axis=0), after, own,
                errors(track, truth_of(ISOLATED, track, before))[-1], bounds(track)[-1])


def report_parts(report: Report, parts: list[Part]) -> None:
    report.text(f"## One motion, then the other\n\n{ISOLATED} cut where the elbow has ceased to bend and the forearm begins to turn (most of the "
                "square of the optical relative rate along axis 1 before it, along axis 2 after it), each part to a fresh instance. "
                "Warm: the sensors' filters have run before. After: seconds since the part began.")
    rows = []
    for p in parts:
        cells = [f"{number(p.after_s[item], 1)}" for item in range(5)]
        ends = [f"{number(p.errors[item], 1)} / {number(p.bounds[item], 1) if p.bounds[item] < UNKNOWN_BOUNDS[item] else '-'}" for item in AXES]
        rows.append([f"{MOTIONS[p.motion]} only", "warm" if p.warm else "cold", f"{p.begin_s:.1f} to {p.end_s:.1f}",
                     *(number(value, 1) for value in p.own_s), *cells, *ends])
    report.table(["part", "filters", "s", "mostly bends, s", "mostly turns, s", *(f"{item} after" for item in ITEMS),
                  "axis 1, error / bound at the end, deg", "axis 2"], rows)
    for p in parts:
        own, other = AXES[p.motion], AXES[1 - p.motion]
        word = f"{MOTIONS[p.motion]} only, {'warm' if p.warm else 'cold'}"
        report.require(f"{word}: {ITEMS[own]} becomes known, {ITEMS[other]} does not",
                       f"{ITEMS[own]} {'known' if p.known[own] else 'never'}, {ITEMS[other]} {'known' if p.known[other] else 'never'}",
                       bool(p.known[own] and not p.known[other]), "" if p.known[other] else LEVER_LATE)


def report_availability(report: Report, wholes: list[Whole]) -> None:
    report.text(f"## How much of its own motion an axis takes\n\nSeconds in which the last {MOSTLY_S:g} s of the optical relative rate are above "
                f"{MOSTLY_RAD_S:g} rad/s rms and at least {100 * MOSTLY_SHARE:g} % of their square along the true axis: in the whole recording, after the "
                "heading had become known, and of all, until the axis is known. An axis is found only where the heading is known well.")
    rows = []
    for w in (w for w in wholes if w.name in OPTICAL):
        rate_hz, heading = people.people_joint(w.name).rate_hz, first(w.known[:, HEADING])
        for item, mine in zip(AXES, motions(w.name), strict=True):
            k = first(w.known[:, item])
            since = w.track.sample[heading] if heading is not None else len(mine)
            rows.append([w.name, ITEMS[item], number(mine.sum() / rate_hz, 1), number(mine[since:].sum() / rate_hz, 1),
                         "never" if k is None else number(mine[: w.track.sample[k] + 1].sum() / rate_hz, 1)])
    report.table(["recording", "axis", "of its motion, s", "once the heading is known, s", "until the axis is known, s"], rows)


# Starts: when the heading is known.

@dataclass
class Start:
    name: str
    warm: bool
    there_s: float  # motion there is, 30 s at most
    after_s: np.ndarray  # (5,) motion until it is known
    beyond: np.ndarray  # (5,) at any time while known
    inside: np.ndarray  # (5,) at the end, 1, 0, or NaN if it is not known or there is no truth
    heading_deg: float  # error at the end, if known


def measure_start(job: tuple[str, int, bool]) -> Start | None:
    name, begin, warm = job
    rec = people.people_joint(name)
    before = settled(rec, begin) if warm else begin
    if before is None:
        return None
    moved = people.motion_before(rec)
    end = min(int(np.searchsorted(moved, moved[begin] + max(WITHIN_S))), len(rec))
    track = two_axes.run(cut(rec, before, end), begin=begin - before)
    if not len(track.t_s):
        return None
    truth = truth_of(name, track, before) if name in OPTICAL else Truth()
    off, stated, flags = errors(track, truth), bounds(track), known(track) & (track.sample >= begin - before)[:, None]
    since = moved[before + track.sample] - moved[begin]
    judged = flags[-1] & np.isfinite(off[-1])
    return Start(name, warm, float(moved[end] - moved[begin]),
                 np.array([np.inf if (k := first(flags[:, item])) is None else since[k] for item in range(5)]),
                 (flags & (off > BEYOND * stated)).any(axis=0), np.where(judged, off[-1] <= stated[-1], np.nan),
                 float(off[-1, HEADING]) if flags[-1, HEADING] else np.nan)


def start_row(label: str, word: str, starts: list[Start]) -> list:
    cells = []
    for motion_s in WITHIN_S:
        able = [s for s in starts if s.there_s >= motion_s - 0.1]
        cells += [percent(sum(s.after_s[HEADING] <= motion_s for s in able), len(able))]
    off = [s.heading_deg for s in starts if np.isfinite(s.heading_deg)]
    return [label, word, len(starts), *cells, *(sum(np.isfinite(s.after_s[item]) for s in starts) for item in range(5)),
            number(median(off), 1), number(quantile(off, 0.9), 1)]


def report_starts(report: Report, starts: list[Start]) -> None:
    report.text("## Starts of all joints\n\nA fresh instance every 10 s where the next 30 s hold at least 5 s of motion, until 30 s of motion; joints "
                "with one axis or none as well, for their heading. Heading within so much motion, of the starts after which the recording holds so much; how many "
                "of all ever know heading, levers, axes; error of the heading at the end where it is known and there is a reference, deg.")
    rows = []
    for name in dict.fromkeys(s.name for s in starts):
        rows += [start_row(name, word, mine) for word, warm in TEMPERATURES if (mine := [s for s in starts if s.name == name and s.warm == warm])]
    rows += [start_row("all", word, [s for s in starts if s.warm == warm]) for word, warm in TEMPERATURES]
    report.table(["joint", "filters", "starts", *(f"heading within {m:g} s" for m in WITHIN_S), *(f"{item} known" for item in ITEMS),
                  "heading error, median", "90 %"], rows)
    for item in range(5):
        judged = [s for s in starts if np.isfinite(s.inside[item])]
        report.require_none(f"starts of elbows: {ITEMS[item]} known and beyond twice its bound at any time",
                            sum(bool(s.beyond[item]) for s in starts), sum(s.name in OPTICAL for s in starts))
        if judged:
            require_share(report, f"starts of elbows: {ITEMS[item]} within its bound at the end", int(sum(s.inside[item] for s in judged)),
                          len(judged), COVERED, KNOWN_STARTS.get(item))


def report_heading(report: Report, wholes: list[Whole]) -> None:
    """Of each joint that moves, from the first sample of its recording."""
    late, why = [], ""
    for w in (w for w in wholes if w.motion_s >= HEADING_S):
        k = first(w.known[:, HEADING])
        after = np.inf if k is None else float(w.moved[k])
        if after > HEADING_S:
            late.append(f"{w.name} {number(after, 1)}")
            why = NO_HEADING.get(w.name, "") if len(late) == 1 else ""
    moving = sum(w.motion_s >= HEADING_S for w in wholes)
    report.text(f"## Heading of each joint\n\nWhole recordings, cold, with at least {HEADING_S:g} s of motion.")
    report.table(["joint", "of motion, s", "heading known after, s", "after motion, s", "lever 1 after motion, s", "lever 2", "at the end"],
                 [[w.name, number(w.motion_s, 0),
                   *(number(np.inf if (k := first(w.known[:, HEADING])) is None else values[k], 1) for values in (w.track.t_s, w.moved)),
                   *(number(np.inf if (k := first(w.known[:, item])) is None else w.moved[k], 1) for item in (1, 2)),
                   "known" if w.known[-1, HEADING] else two_axes.reason_name(w.track.reason[-1])] for w in wholes])
    report.require(f"joints whose heading is known within {HEADING_S:g} s of motion", f"{moving - len(late)} of {moving}"
                   + (f", not {', '.join(late)}" if late else ""), not late, why)


# Angles.

@dataclass
class Angles:
    name: str
    seconds: float  # while the heading is known
    spread_deg: np.ndarray  # (2,) of the optical angle
    rms_deg: np.ndarray  # (4, 2), rows as WAYS
    stated: str  # bounds of the axes at the end


WAYS = ("axes of the moment", "axes at the end", "reference axes", "optical orientations, axes at the end")


def angles_deg(relative: np.ndarray, axis1: np.ndarray, axis2: np.ndarray) -> np.ndarray:
    """(N, 2) flexion and pronation, deg, of orientations (N, 4) of sensor 2 in 1; axes (3,), or (N, 3) that change now and then."""
    still = np.tile([1.0, 0.0, 0.0, 0.0], (len(relative), 1))
    if axis1.ndim == 1:
        return np.degrees(optical.two_dof_angles(still, relative, axis1, axis2))[:, [0, 2]]
    found = np.full((len(relative), 2), np.nan)
    both = np.column_stack([axis1, axis2])
    edges = np.flatnonzero(np.concatenate([[True], (both[1:] != both[:-1]).any(axis=1), [True]]))
    for begin, end in zip(edges[:-1], edges[1:], strict=True):
        if np.isfinite(both[begin]).all():
            found[begin:end] = angles_deg(relative[begin:end], axis1[begin], axis2[begin])
    return found


def spread_deg(angle_deg: np.ndarray) -> float:
    """rms about the mean of angles on the circle."""
    turned = np.exp(1j * np.radians(angle_deg[np.isfinite(angle_deg)]))
    return float(np.degrees(np.sqrt(np.mean(np.angle(turned * np.conj(turned.mean())) ** 2))))


def toward(axis: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """The axis (..., 3) with the sense of the reference, which a user would give as a hint."""
    return axis * np.where(axis @ reference < 0.0, -1.0, 1.0)[..., None]


def measure_angles(name: str) -> Angles:
    rec = people.people_joint(name)
    track, references = two_axes.run(rec), axis_truth(name)
    count = len(rec)
    has_axes = track.for_axis.all(axis=1) & track.for_heading
    heading = at_ticks(track.for_heading.astype(float), track.sample, count) > 0.5
    lab = lab_quaternions(name)
    relative = optical.multiply(optical.conjugate(lab[0]), lab[1])
    right = np.where(heading[:, None], angles_deg(relative, *references), np.nan)
    at_end = [toward(axis[-1], reference) for axis, reference in zip((track.axis1, track.axis2), references, strict=True)]
    now = [at_ticks(np.where(has_axes[:, None], toward(axis, reference), np.nan), track.sample, count)
           for axis, reference in zip((track.axis1, track.axis2), references, strict=True)]
    found = [angles_deg(track.relative, *now), angles_deg(track.relative, *at_end), angles_deg(track.relative, *references),
             angles_deg(relative, *at_end)]
    rms = np.array([[apart_rms_deg(one[:, k], right[:, k]) for k in range(2)] for one in found])
    return Angles(name, float(heading.sum() / rec.rate_hz), np.array([spread_deg(angle) for angle in right.T]), rms,
                  f"{number(track.axis_bounds_deg[-1, 0], 1)}, {number(track.axis_bounds_deg[-1, 1], 1)}")


def report_angles(report: Report, angles: list[Angles]) -> None:
    report.text("## Angles\n\nFlexion and pronation of the relative orientation that the joint tells and of its axes, beside those of the optical "
                "orientations with the reference axes: rms, one constant removed, deg, while the heading is known. Axes of the moment: from when both axes are "
                "known; the constant jumps with an axis. Axes at the end: held for the whole time, known or not. Reference axes: what heading and "
                "orientations cost alone. Optical orientations, axes at the end: what the axes cost alone.")
    report.table(["recording", "seconds", "axis bounds at the end", "angle", "its spread", *WAYS],
                 [[a.name, number(a.seconds, 0), a.stated, word, number(a.spread_deg[k], 0), *(number(value, 1) for value in a.rms_deg[:, k])]
                  for a in angles for k, word in enumerate(("flexion", "pronation"))])


def measure(settings: Settings, report: Report) -> None:
    there = available(*OPTICAL)
    if len(there) < len(OPTICAL):
        raise Skipped("the recordings of people are not there; JOINTCAL_DATA names their folder")
    elbows = [*there, *available(*WITHOUT)]
    joints = [name for name in people.people_joints() if name not in SAME_SENSORS]
    wholes = {w.name: w for w in run_jobs(measure_whole, joints, "people_elbow, whole recordings", settings)}
    report_whole(report, [wholes[name] for name in elbows])
    report_parts(report, run_jobs(measure_part, [(0, False), (1, False), (1, True)], "people_elbow, parts", settings))
    report_availability(report, [wholes[name] for name in elbows])
    report_heading(report, list(wholes.values()))
    every_s = QUICK_EVERY_S if settings.quick else EVERY_S
    jobs = [(part.name, part.begin, warm) for part in people.parts(joints, every_s) for _, warm in TEMPERATURES]
    report_starts(report, [s for s in run_jobs(measure_start, jobs, "people_elbow, starts", settings) if s])
    report_angles(report, run_jobs(measure_angles, there, "people_elbow, angles", settings))
