"""`remember`: yesterday's hinge, restored: on the same sensors, and on sensors that sit otherwise."""

from __future__ import annotations

import functools
from dataclasses import dataclass, replace

import numpy as np

from .. import native_functional as functional
from .. import native_remember, native_sensor
from .. import quaternions as quat
from ..native_sensor import Ticks
from ..recordings import Recording
from ..remember_reference import Kept, basis
from ..simulate import HingeSpec, random_unit, simulate_hinge
from ..simulate_people import PersonSpec, simulate_person
from . import people_joints as people
from .harness import Report, Settings, Skipped, binomial_quantile, median, number, percent, run_jobs
from .judge import RIG_HINGES, available, cut, recording

TITLE = "Remembered calibrations: confirmed, dropped, or neither"

CHOSEN_ON = ("rig_1D_01", "human_knee_left", "people_knee_long_R1")  # with even numbers of simulated joints: limits were chosen on these
RIG = ("rig_1D_02", "rig_1D_04")
PEOPLE = ("knee_drop", "people_knee_long_L1", "people_walk_L:knee")
RUNS = {"rig": 60, "simulated rigid": 100, "people": 60, "simulated people": 150}
KINDS = ("same sensors", "one turned by 15 deg", "both by 15 deg", "one by 30 deg", "one by 90 deg", "one upside down", "exchanged",
         "another mounting", "joint held stiff", "at rest")
PERSON_ACTIVITIES = ("walk", "squat", "sit_to_stand", "random", "run", "swing")
RIGID_MOTIONS = ("daily", "6", "7", "13", "5", "12")
FIRST_SEED = 2001  # nothing was chosen on these
TICKS_MOST = 800  # of one run, 40 s
FAR_DEG, TURNED_DEG = 10.0, 15.0
SOON_S, LATE_S = 3.0, 10.0  # of motion
SHARE = 0.95
SOON, KEPT = f"same sensors: confirmed within {SOON_S:g} s of motion", "same sensors: not dropped"
GONE = f"exchanged or an axis {FAR_DEG:g} deg or more off: dropped within {LATE_S:g} s of motion"
SKIN = "skin leaves the axes of three seconds open by more than what must be told"
KNOWN = {  # what is reached, and why not more
    ("rig", SOON): (0.8, "2.5 s are the least; where the centre hardly moves it takes longer"),
    ("simulated rigid", SOON): (0.45, "2.5 s are the least; a centre that hardly moves and skin of up to 1.5 deg take longer"),
    ("simulated rigid", KEPT): (0.9, "levers that are off by more than what is allowed for, where the centre hardly moves"),
    ("people", SOON): (0.25, SKIN), ("simulated people", SOON): (0.1, SKIN),
    ("people", KEPT): (0.9, "axes of other parts of a recording are as far off as those of a turned sensor"),
    ("simulated people", KEPT): (0.85, "what is remembered is off by up to 6 deg already"),
    ("simulated people", GONE): (0.86, "slow motion: neither confirmed nor dropped"),
}
JUDGED_FROM_S = 4.0  # a run with less motion shows nothing


@dataclass
class Outcome:
    group: str
    kind: str
    state: int
    reason: int
    motion_s: float  # when it was decided, else of the whole run
    errors_deg: np.ndarray  # (2,) of the remembered axes
    bounds_deg: np.ndarray


def ticks_of(rec: Recording) -> tuple[Ticks, Ticks]:
    return tuple(native_sensor.run(rec.t_s, gyr, acc).ticks for gyr, acc in ((rec.gyr1, rec.acc1), (rec.gyr2, rec.acc2)))


def stretch(ticks: Ticks, begin: int) -> Ticks:
    return replace(ticks, **{name: getattr(ticks, name)[begin : begin + TICKS_MOST] for name in ticks.__dataclass_fields__})


def turned(ticks: Ticks, turn: np.ndarray) -> Ticks:
    """The sensor's frame is another one: v there is turn v."""
    return replace(ticks, turn=ticks.turn @ turn.T, rate=ticks.rate @ turn.T, lever=ticks.lever @ turn.T, gyr=ticks.gyr @ turn.T)


def matrix(angle_deg: float, axis: np.ndarray) -> np.ndarray:
    return quat.matrices(quat.rotation(np.radians(angle_deg), axis)[None])[0]


@functools.cache
def halves(name: str) -> list[tuple[Kept, tuple[Ticks, Ticks]]]:
    """What each half of a recording that became ready kept, and the ticks of the other half."""
    rec = recording(name) if name in RIG_HINGES else people.people_joint(name)
    middle, found = len(rec) // 2, []
    parts = [cut(rec, 0, middle), cut(rec, middle, len(rec))]
    for part, other in zip(parts, parts[::-1], strict=True):
        track = functional.run(part, either=True)
        ready = np.flatnonzero(track.ready)
        if len(ready):
            at = ready[-1]
            kept = Kept(track.axis1[at], track.axis2[at], tuple(track.bounds_deg[at]), track.r1[at], track.r2[at], not track.is_functional[at])
            found.append((kept, ticks_of(other)))
    return found


def near(axis: np.ndarray, most_deg: float, rng: np.random.Generator) -> np.ndarray:
    across = np.cross(axis, random_unit(rng))
    angle = np.radians(most_deg) * rng.uniform()
    return np.cos(angle) * axis + np.sin(angle) * across / np.linalg.norm(across)


def simulated_rigid(seed: int, motion: str, rng: np.random.Generator) -> tuple[Kept, Recording]:
    rec = simulate_hinge(HingeSpec(motions=((motion, 45.0),), rate_hz=50.0, seed=seed, speed=float(rng.uniform(0.7, 2.5)),
                                   soft_tissue_deg=float(rng.uniform(0.0, 1.5)), gyr_bias_deg_s=float(rng.uniform(0.0, 0.5)),
                                   acc_bias=float(rng.uniform(0.0, 0.3))))
    return Kept(near(rec.axis1, 1.0, rng), near(rec.axis2, 1.0, rng), (1.0, 1.0), rec.r1 + rng.normal(0.0, 0.01, 3),
                rec.r2 + rng.normal(0.0, 0.01, 3), True), rec


def simulated_person(seed: int, activity: str, stiff: bool, rng: np.random.Generator) -> tuple[Kept, Recording]:
    rec = simulate_person(PersonSpec(activities=((activity, 45.0),), stiff=stiff, seed=seed))
    return Kept(near(rec.axis1, 6.0, rng), near(rec.axis2, 6.0, rng), (6.0, 6.0), rec.r1 + rng.normal(0.0, 0.02, 3),
                rec.r2 + rng.normal(0.0, 0.02, 3), False), rec


def source(group: str, kind: str, index: int, rng: np.random.Generator) -> tuple[Kept, tuple[Ticks, Ticks], tuple[np.ndarray, np.ndarray]] | None:
    """What is remembered, the ticks of the same sensors, and the true axes; None where a recording has no such stretch."""
    if group in ("rig", "people"):
        names = available(*(name.split(":")[0] for name in (RIG if group == "rig" else PEOPLE)))
        if not names or kind in ("joint held stiff", "at rest"):
            return None
        found = [pair for name in (RIG if group == "rig" else PEOPLE) if name.split(":")[0] in names for pair in halves(name)]
        kept, ticks = found[index % len(found)]
        return kept, ticks, (kept.axis1, kept.axis2)
    seed = FIRST_SEED + 2 * index
    if group == "simulated rigid":
        motion = {"joint held stiff": "stiff", "at rest": "rest"}.get(kind, RIGID_MOTIONS[index % len(RIGID_MOTIONS)])
        kept, rec = simulated_rigid(seed, motion, rng)
    else:
        activity = "stand" if kind == "at rest" else PERSON_ACTIVITIES[index % len(PERSON_ACTIVITIES)]
        kept, rec = simulated_person(seed, activity, kind == "joint held stiff", rng)
    return kept, ticks_of(rec), (rec.axis1, rec.axis2)


def disturbed(kind: str, kept: Kept, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    """How each sensor sits on its segment otherwise than before."""
    turns, which = [np.eye(3), np.eye(3)], int(rng.integers(2))
    if kind == "one upside down":
        turns[which] = matrix(180.0, basis((kept.axis1, kept.axis2)[which])[:, 0])
    elif "turned" in kind or "by" in kind:
        angle_deg = float(kind.split(" by ")[1].split()[0])
        for sensor in ((0, 1) if kind.startswith("both") else (which,)):
            turns[sensor] = matrix(angle_deg, random_unit(rng))
    return turns[0], turns[1]


def angle_deg(a: np.ndarray, b: np.ndarray) -> float:
    return float(np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b)))


def errors_of(kept: Kept, true1: np.ndarray, true2: np.ndarray) -> np.ndarray:
    """Angles of both axes; both signs turned together are the same joint."""
    return min((np.array([angle_deg(kept.axis1, s * true1), angle_deg(kept.axis2, s * true2)]) for s in (1.0, -1.0)), key=np.max)


def measure_one(job: tuple[str, str, int]) -> Outcome | None:
    group, kind, index = job
    rng = np.random.default_rng([list(RUNS).index(group), KINDS.index(kind), index, 2020])
    found = source(group, kind, index, rng)
    if found is None:
        return None
    kept, (ticks1, ticks2), (true1, true2) = found
    begin = int(rng.integers(0, max(1, len(ticks1.t_s) - TICKS_MOST + 1)))
    one, two = stretch(ticks1, begin), stretch(ticks2, begin)
    if kind == "exchanged":
        one, two, true1, true2 = two, one, true2, true1
    elif kind == "another mounting":  # what is remembered is another person's
        kept = replace(kept, axis1=random_unit(rng), axis2=random_unit(rng), r1=0.2 * random_unit(rng), r2=0.2 * random_unit(rng))
    turn1, turn2 = disturbed(kind, kept, rng)
    track = native_remember.run(turned(one, turn1), turned(two, turn2), kept)
    errors = errors_of(kept, turn1 @ true1, turn2 @ true2)
    return Outcome(group, kind, int(track.state[-1]), int(track.reason[-1]), float(track.motion_s[-1]), errors, track.bounds_deg[-1])


def row_of(group: str, kind: str, mine: list[Outcome]) -> list:
    confirmed = [o for o in mine if o.state == native_remember.CONFIRMED]
    dropped = [o for o in mine if o.state == native_remember.DROPPED]
    reasons = sorted({native_remember.REASONS[o.reason] for o in dropped})
    return [kind, group, len(mine), percent(len(confirmed), len(mine)), percent(sum(o.motion_s <= SOON_S for o in confirmed), len(mine)),
            number(median([o.motion_s for o in confirmed]), 1) if confirmed else "-", number(median([o.bounds_deg.max() for o in confirmed]), 1)
            if confirmed else "-", percent(sum(o.motion_s <= LATE_S for o in dropped), len(mine)),
            number(median([o.motion_s for o in dropped]), 1) if dropped else "-", ", ".join(reasons) or "-",
            len(mine) - len(confirmed) - len(dropped), sum(not is_covered(o) for o in confirmed), sum(is_wrong(o) for o in confirmed)]


def is_wrong(o: Outcome) -> bool:
    """Confirmed, and an axis is TURNED_DEG or more off, or the sensors are exchanged, or nothing was shown."""
    return bool(o.errors_deg.max() >= TURNED_DEG) or o.kind in ("exchanged", "joint held stiff", "at rest")


def is_covered(o: Outcome) -> bool:
    return bool((o.errors_deg <= o.bounds_deg).all())


def judged(o: Outcome) -> bool:
    """Undecided runs with hardly any motion show nothing; those at rest and stiff are to show just that."""
    return o.motion_s >= JUDGED_FROM_S or o.state != native_remember.REMEMBERED or o.kind in ("joint held stiff", "at rest")


def require_known(report: Report, group: str, text: str, hits: int, total: int) -> None:
    """A share that is not reached everywhere: fails below what is reached, KNOWN. A quick run allows for chance."""
    reached, why = KNOWN.get((group, text), (SHARE, ""))
    if report.quick and total == 0:
        return
    least = binomial_quantile(total, reached, 0.001) if report.quick else reached * total
    report.require(f"{group}, {text}, at least {100.0 * SHARE:g} %", f"{percent(hits, total)} of {total}", total > 0 and hits >= SHARE * total,
                   (why or "chance of a quick run") if hits >= least and total > 0 else "")


def require(report: Report, groups: list[str], outcomes: list[Outcome]) -> None:
    for group in groups:
        same = [o for o in outcomes if o.group == group and o.kind == "same sensors"]
        far = [o for o in outcomes if o.group == group and (o.kind == "exchanged" or o.errors_deg.max() >= FAR_DEG)]
        require_known(report, group, SOON, sum(o.state == native_remember.CONFIRMED and o.motion_s <= SOON_S for o in same), len(same))
        require_known(report, group, KEPT, sum(o.state != native_remember.DROPPED for o in same), len(same))
        require_known(report, group, GONE, sum(o.state == native_remember.DROPPED and o.motion_s <= LATE_S for o in far), len(far))
        mine = [o for o in outcomes if o.group == group]
        confirmed = [o for o in mine if o.state == native_remember.CONFIRMED]
        report.require_none(f"{group}: confirmed with an axis {TURNED_DEG:g} deg or more off, exchanged, stiff or at rest",
                            sum(is_wrong(o) for o in confirmed), len(mine))
        report.require_share(f"{group}: confirmed, both axes within their bounds", sum(is_covered(o) for o in confirmed), len(confirmed), SHARE)


def measure(settings: Settings, report: Report) -> None:
    if len(available(*RIG)) < len(RIG) and not settings.quick:
        raise Skipped("the rig recordings are not there; JOINTCAL_DATA names their folder")
    jobs = [(group, kind, index) for group, full in RUNS.items() for kind in KINDS for index in range(settings.count(full, 6))]
    outcomes = [o for o in run_jobs(measure_one, jobs, "remember", settings) if o is not None and judged(o)]
    groups = [group for group in RUNS if any(o.group == group for o in outcomes)]
    report.text("Hinges. Recordings: what one half found when it was last ready is restored on the other half, from a random moment on, for 40 s; "
                "some of them (`" + "`, `".join((*RIG, *PEOPLE)) + "`) are reported, the limits were chosen on the others. Simulated joints: axes off by up to "
                "1 deg (rigid) or 6 deg (people), levers by 10 or 20 mm rms; seeds that nothing was chosen on. Turned: about a random line, "
                "which may be the axis itself; another mounting: axes and levers of somebody else. Errors count from the truth, or from what was restored "
                "where there is none.")
    report.text("Seconds are of motion, as estimators count it. Beyond bound: confirmed with an axis beyond the bound that is said. Wrong: confirmed with "
                "an axis 15 deg or more off, with sensors exchanged, or of a joint that was held stiff or at rest. Runs with less than 4 s of motion and no decision are left out.")
    report.table(["what", "joint", "runs", "confirmed", "within 3 s", "median, s", "bound, deg", "dropped within 10 s", "median, s", "why", "neither", "beyond bound", "wrong"],
                 [row_of(group, kind, mine) for kind in KINDS for group in groups
                  if (mine := [o for o in outcomes if (o.group, o.kind) == (group, kind)])])
    require(report, groups, outcomes)
