"""People's joints as hinges: whole recordings, starts, separate parts; what is said beside references and whole recordings."""

from __future__ import annotations

import functools
from dataclasses import dataclass

import numpy as np

from .. import native_functional as functional
from ..recordings import Recording
from . import people_joints as people
from .harness import Report, Settings, Skipped, median, number, percent, run_jobs
from .judge import available, axis_errors, cut
from .people_flexion import apart_rms_deg, heading_at_samples, twist_deg

TITLE = "People's joints as hinges"
SAME_SENSORS = ("human_leg_left:knee",)  # those of human_knee_left
KNEES = ("human_knee_left", "knee_drop", "walk_leg_L:knee", "people_knee_long_L1", "people_knee_long_R1")
KINDS = ("knee", "ankle", "hip", "elbow")

# Flexion against the reference, deg rms: from first ready on, and with the axes of the first 20 s of motion.
FLEXION_DEG = {"knee_drop": (0.8, 1.2), "people_knee_long_L1": (1.5, 2.0)}
BEST_ESTIMATE_DEG = {"people_ankle_orthosis": 2.0}  # whatever its status, from BEST_FROM_S on
BEST_FROM_S = 10.0
HELD_MOTION_S = 20.0
LONG_S = 60.0
CHANGES_MOST = 3

WITHIN_S = {10.0: (0.40, 60), 20.0: (0.70, 90), 30.0: (0.75, 95)}  # of motion: required share, aim in %
EVERY_S, QUICK_EVERY_S = 10.0, 60.0
SETTLED_S = (10.0, 30.0)  # least and most that filters run before a warm start
FLEXION_WRONG_DEG = 3.0
JUDGED_EVERY_S, JUDGED_MOTION_S, JUDGED_LEAST_S = 5.0, 20.0, 3.0  # calibrations of a start; motion each is judged over

PARTS_MOTION_S = (5.0, 10.0, 20.0)
COVERED = 0.95
NO_BOUND_DEG = 89.0
NOTHING_WRONG = ("none", "uncertain")  # reasons


def names_of(*kinds: str) -> list[str]:
    return [name for name in people.people_joints(*kinds) if name not in SAME_SENSORS]


@functools.cache
def motion_before(name: str) -> np.ndarray:
    return people.motion_before(people.people_joint(name))


# Whole recordings.

@dataclass
class Whole:
    name: str
    seconds: float
    motion_s: float
    track: functional.Track
    first_motion_s: float  # motion before the first ready; infinite if never
    flexion_rms_deg: float
    held_rms_deg: float
    best_rms_deg: float

    @property
    def changes(self) -> int:
        return status_changes(self.track.status)


def status_changes(status: np.ndarray) -> int:
    return int((np.diff(status) != 0).sum())


def measure_whole(name: str) -> Whole:
    rec = people.people_joint(name)
    track, moved = functional.run(rec, either=True), motion_before(name)[1:]
    t_s = rec.t_s - rec.t_s[0]
    first = int(track.sample[track.ready.argmax()]) if track.ready.any() else None
    rms = held = best = float("nan")
    if rec.flexion_deg is not None:
        if first is not None:
            rms = apart_rms_deg(track.flexion_deg[first:], rec.flexion_deg[first:])
        hold = int(np.searchsorted(moved, HELD_MOTION_S))
        if hold < len(rec):
            held = apart_rms_deg(functional.run(rec, hold=hold).flexion_deg[hold:], rec.flexion_deg[hold:])
        late = t_s >= BEST_FROM_S
        best = apart_rms_deg(track.flexion_deg[late], rec.flexion_deg[late])
    return Whole(name, float(t_s[-1]), float(moved[-1]), track, float(moved[first]) if first is not None else np.inf, rms, held, best)


def report_whole(report: Report, wholes: list[Whole]) -> None:
    report.text("## Whole recordings\n\nWhat `jointcal hinge` says, with its defaults, from the first sample to the last. Motion: seconds "
                "weighted by m/(m + 1), m the sum of both squared rates. Changes: of the status, the first `ready` among them. Flexion: rms "
                "against the recording's reference, causal, with one constant removed: from first ready on; with the axes of the first "
                f"{HELD_MOTION_S:g} s of motion held from then on; of the best estimate whatever its status, from {BEST_FROM_S:g} s on. deg.")
    rows = []
    for w in wholes:
        t, joint = w.track, people.JOINTS[w.name]
        purpose = "-" if not t.ready[-1] else ("axes" if t.for_axes[-1] else "flexion")
        rows.append([w.name, joint.kind, f"{people.people_joint(w.name).rate_hz:.0f} Hz", number(w.seconds, 0), number(w.motion_s, 0),
                     number(t.first_ready_s(), 1), number(w.first_motion_s, 1), purpose,
                     "functional" if t.is_functional[-1] else "rigid",
                     f"{STATUS[t.status[-1]]}, {functional.reason_name(t.reason[-1])}" if not t.ready[-1] else "ready", w.changes,
                     *(number(bound, 1) for bound in t.bounds_deg[-1]), number(t.flexion_bound_deg[-1], 1),
                     *(number(value) for value in (w.flexion_rms_deg, w.held_rms_deg, w.best_rms_deg))])
    report.table(["joint", "kind", "rate", "seconds", "of motion", "ready after, s", "after motion, s", "for", "model", "at the end",
                  "changes", "bound 1", "bound 2", "flexion uncertainty", "flexion rms", "axes held", "best estimate"], rows)
    for w in wholes:
        if w.name in FLEXION_DEG:
            after, held = FLEXION_DEG[w.name]
            report.require_most(f"{w.name}: flexion after ready, rms", w.flexion_rms_deg, after, " deg")
            report.require_most(f"{w.name}: the same with the axes of the first {HELD_MOTION_S:g} s of motion", w.held_rms_deg, held, " deg")
        if w.name in BEST_ESTIMATE_DEG:
            report.require_most(f"{w.name}: flexion of the best estimate, rms", w.best_rms_deg, BEST_ESTIMATE_DEG[w.name], " deg")
    knees = [w for w in wholes if people.JOINTS[w.name].kind == "knee" and w.seconds > LONG_S]
    if knees:
        report.require_none(f"knees over {LONG_S:g} s that are not ready at the end", sum(not w.track.ready[-1] for w in knees), len(knees))
    report.require_most("changes of status in one recording", max(w.changes for w in wholes), CHANGES_MOST)


STATUS = ("collecting", "ambiguous", "ready", "moved")


# Starts.

@dataclass
class Start:
    name: str
    warm: bool
    ready_motion_s: float  # since the start when first ready for flexion; infinite if never
    motion_s: float  # there is, 30 s at most
    ready: bool
    wrong_pairing: bool  # at any tick while ready
    beyond: bool  # an axis beyond twice its bound at any tick while ready
    error_deg: float  # largest of either axis while ready
    flexion_deg: list[float]  # errors of the calibrations while ready for flexion


@functools.cache
def whole_axes(name: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Axes and bounds at the end of the recording: what parts of it are held against."""
    track = functional.run(people.people_joint(name), either=True)
    return track.axis1[-1], track.axis2[-1], track.bounds_deg[-1]


def settled(rec: Recording, begin: int) -> int | None:
    """The sample from which filters run before a warm start at `begin`; None if there is too little before it."""
    before_s = rec.t_s[begin] - rec.t_s[0]
    return int(np.searchsorted(rec.t_s, rec.t_s[begin] - SETTLED_S[1] - 1e-6)) if before_s >= SETTLED_S[0] - 1e-6 else None


def judged_ticks(moved_s: np.ndarray, among: np.ndarray) -> list[int]:
    """The first of the ticks `among` (M,), and then one every few seconds of motion."""
    found: list[int] = []
    for k in np.flatnonzero(among):
        if not found or moved_s[k] - moved_s[found[-1]] >= JUDGED_EVERY_S:
            found.append(int(k))
    return found


def flexion_error_deg(name: str, first: int, skipped: int, axes: tuple[np.ndarray, np.ndarray], hold: int) -> float:
    """rms of the angle that axes give beside the reference, or beside what the axes of the whole recording give.

    The filters run from sample `first` on, the joint `skipped` samples later; from `hold` on its axes stay. Judged over the next
    JUDGED_MOTION_S of motion, NaN if there are too few.
    """
    rec = people.people_joint(name)
    moved = motion_before(name)[1:]
    end = min(int(np.searchsorted(moved, moved[hold] + JUDGED_MOTION_S)), len(rec))
    if moved[end - 1] - moved[hold] < JUDGED_LEAST_S:
        return float("nan")
    part = cut(rec, first, end)
    track = functional.run(part, begin=skipped, hold=hold - first)
    rows = slice(hold - first, None)
    turns = track.q1[rows], track.q2[rows]
    heading = heading_at_samples(track, len(part))[rows]
    found = twist_deg(turns, heading, *axes)
    reference = rec.flexion_deg[hold:end] if rec.flexion_deg is not None else twist_deg(turns, heading, *whole_axes(name)[:2])
    return apart_rms_deg(found, reference)


def measure_start(job: tuple[str, int, bool]) -> Start | None:
    name, begin, warm = job
    rec = people.people_joint(name)
    first = settled(rec, begin) if warm else begin
    if first is None:
        return None
    moved = motion_before(name)
    end = min(int(np.searchsorted(moved, moved[begin] + max(WITHIN_S))), len(rec))
    track = functional.run(cut(rec, first, end), either=True, begin=begin - first)
    errors, other = axis_errors(track, *whole_axes(name)[:2])
    since = moved[first + track.sample] - moved[begin]
    ready, flexion = track.ready, track.ready & track.for_flexion
    off = [flexion_error_deg(name, first, begin - first, (track.axis1[k], track.axis2[k]), first + int(track.sample[k]) + 1)
           for k in judged_ticks(since, flexion)]
    return Start(name, warm, float(since[flexion.argmax()]) if flexion.any() else np.inf,
                 float(moved[end] - moved[begin]), bool(ready.any()), bool((ready & other).any()),
                 bool((ready[:, None] & (errors > 2.0 * track.bounds_deg)).any()),
                 float(errors[ready].max()) if ready.any() else np.nan, [value for value in off if np.isfinite(value)])


def within(starts: list[Start], motion_s: float) -> int:
    return sum(start.ready_motion_s <= motion_s for start in starts)


def start_row(label: str, filters: str, starts: list[Start]) -> list:
    off = [value for start in starts for value in start.flexion_deg]
    possible = {m: [s for s in starts if s.motion_s >= m - 0.1] for m in WITHIN_S}
    return [label, filters, len(starts), *(percent(within(starts, m), len(starts)) for m in WITHIN_S),
            *(percent(within(possible[m], m), len(possible[m])) for m in WITHIN_S), sum(s.ready for s in starts),
            sum(s.wrong_pairing for s in starts), sum(s.beyond for s in starts),
            number(max((s.error_deg for s in starts if s.ready), default=np.nan), 1), len(off), number(median(off)),
            number(max(off, default=np.nan)), sum(value > FLEXION_WRONG_DEG for value in off)]


def report_starts(report: Report, starts: list[Start], wholes: list[Whole]) -> None:
    report.text("## Starts\n\nA fresh instance every 10 s where the next 30 s hold at least 5 s of motion, until 30 s of motion. Cold: the "
                f"sensors' filters start with it; warm: they have run for {SETTLED_S[0]:g} to {SETTLED_S[1]:g} s. Within: ready for flexion "
                "(uncertainty at most 3 deg) within so much motion, of all starts; if so long: of those after which the recording holds that "
                "much motion. Wrong pairing and beyond (an axis more than twice its bound from that of the whole recording): starts in which "
                "it is so at any time while ready. Flexion error: the axes of a moment at which it is ready for flexion (the first, then one "
                f"every {JUDGED_EVERY_S:g} s of motion) held for the next {JUDGED_MOTION_S:g} s of motion: rms against the reference, or where there "
                "is none against what the axes of the whole recording give. deg.")
    rows = []
    for kind in KINDS:
        mine = [s for s in starts if people.JOINTS[s.name].kind == kind]
        for name in dict.fromkeys(s.name for s in mine):
            rows += [start_row(name, word, [s for s in mine if s.name == name and s.warm == warm]) for word, warm in TEMPERATURES]
        if mine:
            rows += [start_row(f"{kind}s", word, [s for s in mine if s.warm == warm]) for word, warm in TEMPERATURES]
    knees = [s for s in starts if s.name in KNEES]
    for word, warm in TEMPERATURES:
        rows.append(start_row("knees of the requirement", word, [s for s in knees if s.warm == warm]))
    report.table(["joint", "filters", "starts", *(f"within {m:g} s" for m in WITHIN_S), *(f"if so long, {m:g} s" for m in WITHIN_S),
                  "ever ready", "wrong pairing", "beyond", "largest axis error", "calibrations", "flexion error median", "largest",
                  f"above {FLEXION_WRONG_DEG:g}"], rows)
    for word, warm in TEMPERATURES:
        mine = [s for s in knees if s.warm == warm]
        for m, (share, aim) in WITHIN_S.items():
            report.require_share(f"knees, {word}: ready for flexion within {m:g} s of motion (aim {aim} %)", within(mine, m), len(mine), share)
    ready = [s for s in starts if s.ready]
    report.require_none("starts that are ready with the wrong pairing", sum(s.wrong_pairing for s in ready), len(ready))
    report.require_none("starts that are ready with an axis beyond twice its bound", sum(s.beyond for s in ready), len(ready))
    # Something to hold an angle against: a reference, or a recording that is ready as a whole.
    has_truth = {w.name: people.people_joint(w.name).flexion_deg is not None or bool(w.track.ready[-1]) for w in wholes}
    for label, is_mine, why in (("with a reference, or ready as a whole", True, ""), (
            "of recordings that are not ready as a whole and have no reference", False,
            "What it is held against are axes of a recording that says itself that they are uncertain")):
        off = [value for s in starts for value in s.flexion_deg if has_truth[s.name] == is_mine]
        wrong = sum(value > FLEXION_WRONG_DEG for value in off)
        if off:
            report.require(f"calibrations, ready for flexion, {label}, with a flexion error above {FLEXION_WRONG_DEG:g} deg",
                           f"{wrong} of {len(off)}", wrong == 0, why)


TEMPERATURES = (("cold", False), ("warm", True))


# Separate parts.

@dataclass
class PartVerdict:
    name: str
    length_s: float  # of motion
    warm: bool
    known: bool  # there is an estimate with bounds
    ready: bool
    reason: str
    other: bool  # the other pairing
    covered: tuple[bool, bool]
    errors_deg: np.ndarray
    bounds_deg: np.ndarray


def separate(moved: np.ndarray, length_s: float) -> list[tuple[int, int]]:
    """First sample and end of consecutive parts with `length_s` of motion each. moved: (N + 1,) motion before each sample."""
    edges = [int(np.searchsorted(moved, amount)) for amount in np.arange(0.0, moved[-1] + 1e-9, length_s)]
    return [(begin, end) for begin, end in zip(edges[:-1], edges[1:], strict=True) if end > begin]


def covered(errors_deg: np.ndarray, other: bool, bounds_deg: np.ndarray, whole_bounds_deg: np.ndarray) -> tuple[bool, bool]:
    """Whether each axis is within what both bounds allow together; the wrong pairing is not."""
    inside = (errors_deg <= np.hypot(bounds_deg, whole_bounds_deg)) & (not other)
    return bool(inside[0]), bool(inside[1])


def measure_part(job: tuple[str, int, int, float, bool]) -> PartVerdict | None:
    name, begin, end, length_s, warm = job
    rec = people.people_joint(name)
    first = settled(rec, begin) if warm else begin
    if first is None:
        return None
    axis1, axis2, whole = whole_axes(name)
    track = functional.run(cut(rec, first, end), either=True, begin=begin - first)
    if not len(track.t_s):
        return None
    errors, other = axis_errors(track, axis1, axis2)
    bounds = track.bounds_deg[-1]
    return PartVerdict(name, length_s, warm, bool((bounds < NO_BOUND_DEG).all()), bool(track.ready[-1]),
                       functional.reason_name(track.reason[-1]), bool(other[-1]), covered(errors[-1], bool(other[-1]), bounds, whole), errors[-1], bounds)


def report_parts(report: Report, parts: list[PartVerdict], wholes: list[Whole]) -> None:
    report.text("## Coverage\n\nEach recording cut into consecutive parts of 5, 10 and 20 s of motion, a fresh instance for each, its "
                "estimate at the end of the part, ready or not, if it states bounds. The truth is not known, so parts are held "
                "against the whole recording, whose axes are uncertain themselves: an axis is covered if the difference is within "
                "sqrt(bound of the part^2 + bound of the whole^2), and the pairing is the same; an estimate with the other pairing, whose "
                "status is not `ready`, counts as not covered. Ready or only uncertain: parts in which nothing is said against the joint. Errors and bounds: of both axes, median, deg. "
                "A bound of the whole recording of tens of degrees covers anything: elbows are no hinges, and say so.")
    whole = {w.name: float(w.track.bounds_deg[-1].max()) for w in wholes}
    rows = []
    for kind in KINDS:
        for word, warm in TEMPERATURES:
            for length in PARTS_MOTION_S:
                mine = [p for p in parts if people.JOINTS[p.name].kind == kind and p.warm == warm and p.length_s == length]
                known, ready = ([p for p in mine if getattr(p, what)] for what in ("known", "ready"))
                hits = [sum(p.covered[k] for p in known) for k in range(2)]
                only = [p for p in known if p.reason in NOTHING_WRONG]
                both = [sum(p.covered[0] and p.covered[1] for p in some) for some in (only, ready)]
                rows.append([f"{kind}s", word, f"{length:g} s", len(mine), len(known), sum(p.other for p in known),
                             *(percent(hit, len(known)) for hit in hits),
                             len(only), percent(both[0], len(only)), len(ready), percent(both[1], len(ready)),
                             number(median([error for p in known for error in p.errors_deg]), 1),
                             number(median([bound for p in known for bound in p.bounds_deg]), 1),
                             number(median([whole[p.name] for p in known]), 1)])
    report.table(["joints", "filters", "parts of", "parts", "with bounds", "other pairing", "covered, axis 1", "axis 2",
                  "ready or only uncertain", "both covered", "ready", "both covered",
                  "error", "bound", "bound of the whole"], rows)
    for kind in KINDS:
        for word, warm in TEMPERATURES:
            known = [p for p in parts if people.JOINTS[p.name].kind == kind and p.warm == warm and p.known]
            if known:
                report.require_share(f"{kind}s, {word}: axes of parts within both bounds",
                                     [sum(p.covered[k] for p in known) for k in range(2)], len(known), COVERED)
            else:
                report.text(f"{kind}s, {word}: no part states a bound.")


def measure(settings: Settings, report: Report) -> None:
    if not available("knee_drop"):
        raise Skipped("the recordings of people are not there; JOINTCAL_DATA names their folder")
    names = names_of(*KINDS)
    if settings.quick:
        names = [name for name in names if name in ("knee_drop", "walk_leg_L:knee", "people_ankle_orthosis")]
    wholes = run_jobs(measure_whole, names, "people_hinge, whole recordings", settings)
    report_whole(report, wholes)
    every_s = QUICK_EVERY_S if settings.quick else EVERY_S
    begins = [(part.name, part.begin, warm) for part in people.parts(names, every_s) for _, warm in TEMPERATURES]
    report_starts(report, [s for s in run_jobs(measure_start, begins, "people_hinge, starts", settings) if s], wholes)
    lengths = PARTS_MOTION_S[1:] if settings.quick else PARTS_MOTION_S
    jobs = [(name, begin, end, length, warm) for name in names for length in lengths
            for begin, end in separate(motion_before(name), length) for _, warm in TEMPERATURES]
    report_parts(report, [p for p in run_jobs(measure_part, jobs, "people_hinge, parts", settings) if p], wholes)
