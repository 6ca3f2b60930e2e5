"""`moved`: sensors that slip, on the rig and simulated, for both joints; and false alarms."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import native
from .. import native_two_dof as two_dof
from .. import quaternions as quat
from ..recordings import Recording
from ..simulate import HingeSpec, random_unit, simulate_hinge
from ..simulate_two_dof import TwoDofSpec, simulate_two_dof
from .harness import Report, Settings, median, number, percent, quantile, run_jobs
from .judge import RIG_HINGES, available, cut, line_angle_deg, nominal_axes, recording
from .two_dof import RIG as RIG_TWO_DOF

TITLE = "Slips: how soon a sensor that has moved is noticed"
VQF = "the joint with two axes"  # what of it needs VQF
SIMULATED, ON_RIG = 200, 50  # slips, of each joint
ANGLES_DEG = (10.0, 90.0)
CALM = 150  # runs without a slip, of each joint
PART_S = 60.0  # of a rig recording, the slip half-way
SOON_S = 5.0  # of motion
SHARE = 0.95
MOTION_RAD_S = 0.5  # root of the sum of both squared rates above which time counts as motion
ALARMS_PER_HOUR = 1.0


@dataclass
class Outcome:
    joint: str
    source: str
    angle_deg: float
    change_deg: float  # by how much the slip turns its own axis; a turn about the axis changes nothing
    was_ready: bool
    after_s: float  # motion until `moved`; infinite if never
    early: int  # alarms before the slip
    hours: float  # before the slip
    wrong_s: float  # time `ready` with an axis more than 5 deg off, later than SOON_S after the slip
    ready_again: bool


def turned(rec: Recording, sensor: int, at: int, turn: np.ndarray) -> Recording:
    """From sample `at` on the readings of one sensor are turned by the matrix."""
    signals = {name: getattr(rec, name).copy() for name in ("gyr1", "acc1", "gyr2", "acc2")}
    for kind in ("gyr", "acc"):
        signals[f"{kind}{sensor}"][at:] = signals[f"{kind}{sensor}"][at:] @ turn.T
    return Recording(rec.t_s - rec.t_s[0], **signals)


def run(joint: str, rec: Recording) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Status and both axes after each sample."""
    if joint == "hinge":
        track = native.run(rec)
    else:
        track = two_dof.run(rec.t_s, *two_dof.orientations(rec))
    return track.status, track.axis1, track.axis2


def part_of_rig(joint: str, rng: np.random.Generator) -> tuple[Recording, tuple[np.ndarray, np.ndarray], str]:
    names = RIG_HINGES if joint == "hinge" else RIG_TWO_DOF
    name = names[rng.integers(len(names))]
    rec = recording(name)
    count = min(int(PART_S * rec.rate_hz), len(rec))
    begin = int(rng.integers(0, len(rec) - count + 1))
    return cut(rec, begin, begin + count), nominal_axes(name), "rig"


def simulated(joint: str, rng: np.random.Generator) -> tuple[Recording, tuple[np.ndarray, np.ndarray], str]:
    seed, speed, soft = int(rng.integers(2**31)), float(rng.uniform(0.7, 2.5)), float(rng.uniform(0.0, 0.5))
    if joint == "hinge":
        rec = simulate_hinge(HingeSpec(motions=(("daily", PART_S),), rate_hz=50.0, seed=seed, speed=speed,
                                       soft_tissue_deg=soft))
    else:
        motion = ("free", "daily", "complex")[rng.integers(3)]
        rec = simulate_two_dof(TwoDofSpec(motions=((motion, PART_S),), rate_hz=50.0, seed=seed, speed=speed,
                                          soft_tissue_deg=soft, carrying_deg=float(rng.uniform(0.0, 20.0))))
    return rec, (rec.axis1, rec.axis2), "simulated"


def measure_slip(job: tuple[str, str, int]) -> Outcome:
    joint, source, index = job
    rng = np.random.default_rng([("hinge", "two_dof").index(joint), ("rig", "simulated").index(source), index, 4444])
    rec, axes, source = (part_of_rig if source == "rig" else simulated)(joint, rng)
    at, sensor, angle = len(rec) // 2, int(rng.integers(1, 3)), float(rng.uniform(*ANGLES_DEG))
    turn = quat.matrices(quat.rotation(np.radians(angle), random_unit(rng))[None])[0]
    after = list(axes)
    after[sensor - 1] = turn @ axes[sensor - 1]
    slipped = turned(rec, sensor, at, turn)
    status, axis1, axis2 = run(joint, slipped)
    rates = np.sqrt((slipped.gyr1**2).sum(axis=1) + (slipped.gyr2**2).sum(axis=1))
    motion_s = np.cumsum(rates[at:] > MOTION_RAD_S) / rec.rate_hz
    alarms = np.flatnonzero(status[at:] == native.MOVED)
    early = int(((status[1:at] == native.MOVED) & (status[: at - 1] != native.MOVED)).sum())
    errors = np.maximum(line_angle_deg(axis1, after[0]), line_angle_deg(axis2, after[1]))
    late = np.arange(len(rec)) >= at + np.searchsorted(motion_s, SOON_S)
    wrong = (status == native.READY) & late & (errors > 5.0)
    return Outcome(joint, source, angle, float(line_angle_deg(after[sensor - 1], axes[sensor - 1])),
                   bool(status[at - 1] == native.READY), float(motion_s[alarms[0]]) if len(alarms) else np.inf, early,
                   at / rec.rate_hz / 3600.0, float(wrong.sum() / rec.rate_hz), bool(status[-1] == native.READY))


@dataclass
class Calm:
    """A run without any slip."""

    joint: str
    hours: float
    alarms: int
    was_ready: bool


def measure_calm(job: tuple[str, int]) -> Calm:
    """Calm, lively and resting parts after each other, with biases and soft tissue; no sensor slips."""
    joint, index = job
    rng = np.random.default_rng([("hinge", "two_dof").index(joint), 2, index, 4445])
    common = {"rate_hz": 50.0, "seed": int(rng.integers(2**31)), "speed": float(rng.uniform(0.5, 3.0)),
              "soft_tissue_deg": float(rng.uniform(0.0, 1.5)), "gyr_bias_deg_s": float(rng.uniform(0.0, 1.0))}
    if joint == "hinge":
        lively = ("5", "6", "7", "12", "13", "14")[index % 6], ("6", "14", "12")[index % 3]
        rec = simulate_hinge(HingeSpec(motions=(("daily", 30.0), (lively[0], 30.0), ("daily", 30.0), ("rest", 10.0), (lively[1], 30.0)),
                                       acc_bias=float(rng.uniform(0.0, 1.0)), **common))
    else:
        rec = simulate_two_dof(TwoDofSpec(motions=(("daily", 30.0), ("free", 30.0), ("daily", 30.0), ("rest", 10.0), ("complex", 30.0)),
                                          acc_bias=float(rng.uniform(0.0, 0.3)), carrying_deg=float(rng.uniform(0.0, 20.0)), **common))
    status = run(joint, rec)[0]
    alarms = int(((status[1:] == native.MOVED) & (status[:-1] != native.MOVED)).sum())
    return Calm(joint, len(rec) / rec.rate_hz / 3600.0, alarms, bool((status == native.READY).any()))


def describe_calm(joints: list[str], count: int, settings: Settings, report: Report) -> None:
    found = run_jobs(measure_calm, [(joint, index) for joint in joints for index in range(count)], "moved, calm and lively", settings)
    report.text("No slip at all: two minutes of calm, lively and resting parts after each other, soft tissue of up to 1.5 deg, biases of up to "
                "1 deg/s and 1 (hinge) or 0.3 m/s^2.")
    rows = []
    for joint in joints:
        mine = [o for o in found if o.joint == joint]
        alarms, hours = sum(o.alarms for o in mine), sum(o.hours for o in mine)
        rows.append([joint, len(mine), sum(o.was_ready for o in mine), alarms, number(hours, 1)])
        report.require_most(f"{joint}, calm and lively: false alarms per hour", alarms / hours, ALARMS_PER_HOUR)
    report.table(["joint", "runs", "ever ready", "false alarms", "in hours"], rows)


def row_of(joint: str, source: str, mine: list[Outcome]) -> list:
    ready = [o for o in mine if o.was_ready]
    missed = [o.change_deg for o in ready if o.after_s > SOON_S]
    return [joint, source, len(mine), len(ready), percent(sum(o.after_s <= SOON_S for o in ready), len(ready)),
            number(median([o.after_s for o in ready])), number(quantile([o.after_s for o in ready], 0.95)),
            ", ".join(number(x, 0) for x in sorted(missed)) or "-", sum(o.early for o in mine),
            number(sum(o.hours for o in mine), 1), sum(o.wrong_s > 0.0 for o in ready),
            percent(sum(o.ready_again for o in ready), len(ready))]


def measure(settings: Settings, report: Report) -> None:
    joints = ["hinge", *(["two_dof"] if two_dof.has_vqf() else [])]
    sources = {"simulated": settings.count(SIMULATED, 20)}
    if len(available(*RIG_HINGES, *RIG_TWO_DOF)) == len(RIG_HINGES) + len(RIG_TWO_DOF):
        sources["rig"] = min(settings.count(ON_RIG, 10), sources["simulated"])
    jobs = [(joint, source, index) for joint in joints for source, count in sources.items() for index in range(count)]
    outcomes = run_jobs(measure_slip, jobs, "moved", settings)
    report.text(f"60 s of motion; half-way one sensor is turned by {ANGLES_DEG[0]:g} to {ANGLES_DEG[1]:g} deg about a random "
                "axis. Noticed: `moved` within 5 s of motion (both rates together above 0.5 rad/s), of the runs that were "
                "ready at the slip. Missed: by how many degrees the slip turned the axis where it was not noticed in time. "
                "Wrong: runs that were `ready` with an axis more than 5 deg off after that.")
    groups = {(joint, source): [o for o in outcomes if (o.joint, o.source) == (joint, source)]
              for joint in joints for source in sources}
    report.table(["joint", "data", "slips", "were ready", "noticed", "median, s", "95 %, s", "missed, deg", "false alarms",
                  "in hours", "wrong", "ready again"], [row_of(*key, mine) for key, mine in groups.items()])
    for (joint, source), mine in groups.items():
        ready = [o for o in mine if o.was_ready]
        report.require_share(f"{joint}, {source}: slips noticed within 5 s of motion",
                             sum(o.after_s <= SOON_S for o in ready), len(ready), SHARE)
        report.require_most(f"{joint}, {source}: false alarms per hour",
                            sum(o.early for o in mine) / sum(o.hours for o in mine), ALARMS_PER_HOUR)
    describe_calm(joints, settings.count(CALM, 6), settings, report)
