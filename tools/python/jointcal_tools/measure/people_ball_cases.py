"""What must never be said of heading, levers and axes of a person's joint: the classes of people_faults, and some of its own.

CLASSES has each class with its number of runs and its rule, which says of each of the five items when it is wrong:

- "never": whenever it is known, for there is nothing to know, or what is measured is faulty;
- "beyond": known and beyond twice its bound, as far as there is a truth.
"""

from __future__ import annotations

import zlib
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from .. import native_two_axes as two_axes
from ..recordings import Recording
from ..simulate_people import main_axes
from . import optical
from . import people_faults as faults
from .faults import choose
from .judge import available, cut, recording
from .people_ball import HEADING_S, NONE, Truth, at_ticks, axis_truth, lab_quaternions, lever_truth, true_heading_deg
from .people_faults import HINGE_RIGS, KNOWN_AXES, PeopleCase, known_axes
from .people_flexion import wrapped_deg
from .people_joints import JOINTS, people_joint, sensor_signals

NEVER, BEYOND_BOUND = "never", "beyond"
RULES: dict[str, tuple[str, ...]] = {  # of ITEMS
    "unrelated": (NEVER,) * 5,  # nothing in common, or faulty
    "no joint": (BEYOND_BOUND, *(NEVER,) * 4),  # sensors of one body or one person: there is a heading
    "hinge": (*(BEYOND_BOUND,) * 4, NEVER),  # nothing turns about axis 2
    "ball": (*(BEYOND_BOUND,) * 3, NEVER, NEVER),
    "turns": (*(BEYOND_BOUND,) * 3, NEVER, BEYOND_BOUND),  # nothing bends
    "two axes": (BEYOND_BOUND,) * 5,
}
STIFF = ("same_segment", "stiff_copy", "stiff_vibration", "stiff_straps")
NO_JOINT = ("other_shank", "other_shank_simulated", "both_thighs", "splint", *STIFF)
TURNS = ("turn", "bend_and_turn", "carried_turn")  # activities in which a forearm turns
STIFF_SLACK_DEG = 5.0  # skin and straps rock by as much
HINGES = ("seated_swing", *(name for name in faults.FAULTS if name.startswith("late_")))


@dataclass(frozen=True)
class BallFault:
    make: Callable[[np.random.Generator], PeopleCase]
    runs: int
    rule: str
    needs: tuple[str, ...] = ()


def rule_of(name: str) -> str:
    """Of a class of people_faults."""
    return {"rig_2D": "two axes", "elbow": "two axes", "rig_3D": "ball"}.get(
        name, "no joint" if name in NO_JOINT else "hinge" if name in HINGES else "unrelated")


# Sensors that have another segment between them.

def pelvis_shank(rng: np.random.Generator) -> PeopleCase:
    file = choose(rng, available(*PELVIS_SHANK))
    begin, end = faults.span(rng, f"{file}:hip")
    rec, rows = recording(file), slice(begin, end)
    (gyr1, acc1), (gyr3, acc3) = (sensor_signals(rec, sensor) for sensor in (1, 3))
    part = faults.fresh(Recording(rec.t_s[rows], gyr1[rows], acc1[rows], gyr3[rows], acc3[rows]))
    return PeopleCase(part, f"{file} sensors 1 and 3 from sample {begin}", name=file, begin=begin)


def other_thigh(rng: np.random.Generator) -> PeopleCase:
    left = choose(rng, faults.LEFT_THIGHS)
    return faults.same_time(rng, *((left, faults.RIGHT_THIGH) if rng.random() < 0.5 else (faults.RIGHT_THIGH, left)))


# Segments of unrelated people: joint and sensor (0, 1) of it.
FOREARMS = tuple((name, 1) for name in ("human_elbow_right", "people_elbow_B_JA_Fast", "people_elbow_D_ROM", "people_elbow_E_ROM"))
THIGHS = (("human_knee_left", 0), ("knee_drop", 0), ("walk_leg_L:knee", 0), ("people_knee_long_L1", 0), ("people_knee_long_R1", 0),
          ("people_walk_L:knee", 0))


def unrelated(rng: np.random.Generator, others: tuple[tuple[str, int], ...]) -> PeopleCase:
    """A forearm beside a segment of somebody else, either of them as sensor 1."""
    first, sensor1 = choose(rng, FOREARMS)
    second, sensor2 = choose(rng, [one for one in others if JOINTS[one[0]].person != JOINTS[first].person])
    pair = [(faults.passage(rng, first), sensor1), (faults.passage(rng, second), sensor2)]
    (one, index1), (two, index2) = pair if rng.random() < 0.5 else pair[::-1]
    return faults.joined(one, two, (index1, index2))


def forearms(rng: np.random.Generator) -> PeopleCase:
    return unrelated(rng, FOREARMS)


def forearm_thigh(rng: np.random.Generator) -> PeopleCase:
    return unrelated(rng, THIGHS)


# Joints that do not turn about one of the axes.

def bends_only(rng: np.random.Generator, joint: str) -> PeopleCase:
    return faults.person(faults.random_spec(rng, joint=joint))


def elbow_bends(rng: np.random.Generator) -> PeopleCase:
    return bends_only(rng, "elbow")


def knee_bends(rng: np.random.Generator) -> PeopleCase:
    return bends_only(rng, "knee")


def rig_hinge(rng: np.random.Generator) -> PeopleCase:
    return faults.passage(rng, choose(rng, available(*HINGE_RIGS)))


# Elbows that do something else than one motion after the other.

def elbow_that(rng: np.random.Generator, *parts: tuple[str, float]) -> PeopleCase:
    spec = faults.random_spec(rng, joint="elbow")
    return faults.person(replace(spec, activities=parts, rate_hz=100.0))


def bends_and_turns(rng: np.random.Generator) -> PeopleCase:
    """Both at once and slowly, so that half a cycle of both is one line."""
    return elbow_that(rng, ("bend_and_turn", 90.0))


def turns_carried(rng: np.random.Generator) -> PeopleCase:
    """The forearm turns on an arm that is carried and does nothing: its lever along itself is open."""
    return elbow_that(rng, ("carried_turn", rng.uniform(20.0, 60.0)))


def after_rest(rng: np.random.Generator) -> PeopleCase:
    return elbow_that(rng, ("bend", 20.0), ("turn", 20.0), ("stand", 300.0), ("bend", 10.0))


def with_gaps(rng: np.random.Generator) -> PeopleCase:
    """Samples are missing for 0.2 to 3 s, three times."""
    case = elbow_that(rng, ("bend", 25.0), ("turn", 25.0))
    keep = np.ones(len(case.rec), bool)
    for begin, length_s in zip(rng.uniform(0.5, 45.0, 3), rng.uniform(0.2, 3.0, 3), strict=True):
        keep &= (case.rec.t_s < begin) | (case.rec.t_s >= begin + length_s)
    rows = {name: getattr(case.person, name)[keep] for name in ("t_s", "gyr1", "acc1", "gyr2", "acc2", "q1", "q2")}
    plain = Recording(*(rows[name] for name in ("t_s", "gyr1", "acc1", "gyr2", "acc2")))
    return replace(case, rec=plain, person=replace(case.person, **rows), source=f"{case.source}, with gaps")


PELVIS_SHANK = ("human_leg_left", "walk_leg_L")
ARMS = ("human_elbow_right", *faults.ELBOWS)
THIGH_FILES = tuple(dict.fromkeys(JOINTS[name].file for name, _ in THIGHS))
CLASSES: dict[str, BallFault] = {
    **{name: BallFault(fault.make, fault.runs, rule_of(name), fault.needs) for name, fault in faults.FAULTS.items()},
    "pelvis_shank": BallFault(pelvis_shank, 200, "no joint", PELVIS_SHANK),
    "other_thigh": BallFault(other_thigh, 150, "no joint", faults.BOTH_LEGS),
    "forearms": BallFault(forearms, 200, "unrelated", ARMS),
    "forearm_thigh": BallFault(forearm_thigh, 250, "unrelated", (*ARMS, *THIGH_FILES)),
    "elbow_bends": BallFault(elbow_bends, 150, "hinge"),
    "knee_bends": BallFault(knee_bends, 100, "hinge"),
    "rig_1D": BallFault(rig_hinge, 150, "hinge", HINGE_RIGS),
    "bends_and_turns": BallFault(bends_and_turns, 200, "two axes"),
    "turns_carried": BallFault(turns_carried, 100, "turns"),
    "after_rest": BallFault(after_rest, 30, "two axes"),
    "with_gaps": BallFault(with_gaps, 100, "two axes"),
}


def here() -> list[str]:
    return [name for name, fault in CLASSES.items() if len(available(*fault.needs)) == len(fault.needs)]


def counts(runs: int | None = None) -> dict[str, int]:
    """As of people_faults."""
    full = {name: CLASSES[name].runs for name in here()}
    share = 1.0 if runs is None else runs / sum(full.values())
    return {name: max(round(count * share), 1) for name, count in full.items()}


def ball_case(name: str, index: int) -> PeopleCase:
    """Run `index` of class `name`: the same every time; of a class of people_faults the same as there."""
    if name in faults.FAULTS:
        return faults.people_case(name, index)
    return CLASSES[name].make(np.random.default_rng([zlib.crc32(name.encode()), index, 2626]))


# The truth.

@dataclass(frozen=True)
class Judged:
    truth: Truth
    slack_deg: np.ndarray | None = None  # (N,) how far off the true heading itself may be


def simulated_truth(case: PeopleCase, track: two_axes.Track) -> Truth:
    """Of a simulated person. Axis 1: the main axis of what the bones did."""
    rec, count = case.person, len(track.q1)
    heading = true_heading_deg((track.q1, track.q2), (rec.q1[:count], rec.q2[:count]), rec.spec.rate_hz)
    for gap in np.flatnonzero(np.diff(rec.t_s[:count]) > 1.5 / rec.spec.rate_hz):  # a mean of headings of before and after is none
        heading[max(gap - round(HEADING_S * rec.spec.rate_hz), 0): gap + round(HEADING_S * rec.spec.rate_hz)] = np.nan
    if any(name in TURNS for name, _ in rec.spec.activities):
        return Truth(heading, (rec.r1, rec.r2), (rec.axis1, rec.turn_axis2))
    return Truth(heading, (rec.r1, rec.r2), (None, None) if rec.spec.stiff else (main_axes(rec)[0], None))


def passage_truth(case: PeopleCase, track: two_axes.Track) -> Truth:
    """Of a passage of a recording, of which one sensor may be late."""
    count, lab = len(track.q1), lab_quaternions(case.name)
    heading = None
    if lab is not None:
        index, late_s = case.late or (0, 0.0)
        shift = round(late_s * faults.whole(case.name).rate_hz)
        begins = [case.begin + (0 if k == index else shift) for k in range(2)]
        heading = true_heading_deg((track.q1, track.q2), tuple(q[b: b + count] for q, b in zip(lab, begins, strict=True)),
                                   faults.whole(case.name).rate_hz)
    axes = (known_axes(case.name)[0], None) if case.name in KNOWN_AXES else axis_truth(case.name)
    return Truth(heading, lever_truth(case.name), axes)


def chained_heading(case: PeopleCase, count: int) -> Judged:
    """Of pelvis and shank: hip's and knee's added, where both are known; the level frames are the same."""
    total, slack = np.zeros(count), np.zeros(count)
    for kind in ("hip", "knee"):
        name = f"{case.name}:{kind}"
        track = two_axes.run(cut(people_joint(name), case.begin, case.begin + count))
        total = total + at_ticks(np.where(track.for_heading, track.heading_deg, np.nan), track.sample, count)
        slack = slack + at_ticks(track.heading_bound_deg, track.sample, count)
    return Judged(Truth(wrapped_deg(total)), slack)


def stiff_heading(case: PeopleCase, track: two_axes.Track) -> Judged:
    """Of two sensors of one body: R_2 = R_1 T with one rotation T, from their rates."""
    turn = optical.from_matrix(optical.turn_between(case.rec.gyr2, case.rec.gyr1))
    lab = track.q1, optical.multiply(track.q1, turn[None, :])
    return Judged(Truth(true_heading_deg((track.q1, track.q2), lab, case.rec.rate_hz)), np.full(len(track.q1), STIFF_SLACK_DEG))


def judged(name: str, case: PeopleCase, track: two_axes.Track) -> Judged:
    """What is known of a case, as far as its rule wants it."""
    rule = CLASSES[name].rule
    if rule == "unrelated":
        return Judged(Truth())
    if name == "pelvis_shank":
        return chained_heading(case, len(track.q1))
    if name in STIFF:
        return stiff_heading(case, track)
    truth = Truth()  # none of two legs
    if case.person is not None:
        truth = simulated_truth(case, track)
    elif case.name:
        truth = passage_truth(case, track)
    # A joint that is not there has no levers and no axes.
    return Judged(replace(truth, levers=NONE, axes=NONE) if rule == "no joint" else truth)
