"""What must never make a joint of a person ready: wrong pairs, stiff pairs, faulty sensors, joints that are no hinge.

FAULTS has every class with its number of runs; `people_case(name, index)` makes one of them,
the same every time: 26 s (less where a recording is shorter) from a random start with
motion, real where recordings are, else simulated. Each class says what `ready` would be:

- "never": wrong, whatever it states.
- "beyond": wrong if an axis is farther off than the limit that was asked for, if the pairing is wrong, or
  if the axis in the distal frame moves farther than that afterwards. The true axes are in the case.
- "one axis": a joint with two axes. Wrong, unless one of them alone moved until then: that one is the truth
  of "beyond" then.
"""

from __future__ import annotations

import functools
import zlib
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from .. import jets
from .. import quaternions as quat
from ..jets import Clock
from ..recordings import Recording
from ..simulate import ACC_STD_M_S2, GRAVITY_M_S2, GYR_STD_RAD_S, gauss_smooth, random_unit
from ..simulate_people import ACTIVITIES, BLEND_S, PersonRecording, PersonSpec, simulate_person
from . import optical, people_joints
from .faults import Case, choose, quat_matrix, resting_signals, scaled, signals, which_sensors, with_sensor
from .judge import available, cut, line_angle_deg, nominal_axes, recording
from .people_joints import JOINTS, motion_before, people_joint

LENGTH_S = 26.0
MOVING_S = 5.0  # seconds of motion that a start should have, if the recording has such a start
TRIES = 20
RATES_HZ = (40.0, 50.0, 60.0, 100.0, 128.0, 200.0)
HINGE_RIGS = ("rig_1D_01", "rig_1D_02", "rig_1D_04")
TWO_AXIS_RIGS = ("rig_2D_01", "rig_2D_02", "rig_2D_05")
THREE_AXIS_RIGS = ("rig_3D_01", "rig_3D_02", "rig_3D_04")
RIGS = (*HINGE_RIGS, *TWO_AXIS_RIGS, *THREE_AXIS_RIGS)
MOVING = ("walk", "run", "squat", "sit_to_stand", "random")
LATE_S = (0.05, 0.1, 0.2, 0.5, 1.0, 2.0)
ONE_AXIS_SHARE = 0.97  # of the joint's rate about one axis: as far as this motion goes the joint is a hinge
DERIVATIVE_HZ = 8.0  # of angular acceleration taken from a gyroscope
VIBRATION_HZ, VIBRATION_DEG = (32.0, 34.0), (0.06, 0.3)
STRAP_HZ, STRAP_DEG = (0.5, 6.0), (0.5, 5.0)


@dataclass
class PeopleCase(Case):
    wrong: str = "never"
    axis1: np.ndarray | None = None  # truth of "beyond", both the same way in space
    axis2: np.ndarray | None = None
    moves_deg: float = 0.0  # how far the axis moves in the distal frame in what follows
    name: str = ""  # recording and first sample of a passage
    begin: int = 0
    person: PersonRecording | None = None  # what a simulated case was made from, before anything was done to it
    late: tuple[int, float] | None = None  # of a passage: the sensor (0, 1) that tells what was so many seconds ago


@dataclass(frozen=True)
class Ready:
    """What an engine stated when it became ready."""

    t_s: float  # in the time of the case
    limit_deg: float  # of the axes
    axis1: np.ndarray
    axis2: np.ndarray


def wrongly_ready(case: PeopleCase, ready: Ready) -> bool:
    """Whether that was wrong."""
    if case.wrong == "one axis":
        axis1, axis2, share = moving_axes(case.name, case.begin, case.begin + int(np.searchsorted(case.rec.t_s, ready.t_s)) + 1)
        case = replace(case, wrong="beyond" if share >= ONE_AXIS_SHARE else "never", axis1=axis1, axis2=axis2)
    if case.wrong == "never":
        return True
    axis1, axis2 = ready.axis1, ready.axis2
    apart = [float(line_angle_deg(found, truth)) for found, truth in ((axis1, case.axis1), (axis2, case.axis2))]
    wrong_pairing = (axis1 @ case.axis1) * (axis2 @ case.axis2) < 0.0
    return bool(wrong_pairing or max(*apart, case.moves_deg) > ready.limit_deg)


# Sources.

def whole(name: str) -> Recording:
    """A joint of people or a rig."""
    return people_joint(name) if name in JOINTS else recording(name)


@functools.cache
def moved_s(name: str) -> np.ndarray:
    return motion_before(whole(name))


def span(rng: np.random.Generator, name: str, extra_s: float = 0.0) -> tuple[int, int]:
    """Random first sample and end of a passage with motion; of several tries the first with enough, or the best."""
    rec = whole(name)
    count = min(round((LENGTH_S + extra_s) * rec.rate_hz), len(rec))
    moved = moved_s(name)
    starts = rng.integers(len(rec) - count + 1, size=TRIES)
    amounts = moved[starts + count] - moved[starts]
    good = np.flatnonzero(amounts >= MOVING_S)
    begin = int(starts[good[0] if len(good) else np.argmax(amounts)])
    return begin, begin + count


def fresh(rec: Recording) -> Recording:
    """The same with time from 0 on."""
    return replace(rec, t_s=rec.t_s - rec.t_s[0])


def passage(rng: np.random.Generator, name: str) -> PeopleCase:
    begin, end = span(rng, name)
    return PeopleCase(fresh(cut(whole(name), begin, end)), f"{name} from sample {begin}", name=name, begin=begin)


def random_spec(rng: np.random.Generator, activities: tuple[str, ...] = MOVING, joint: str | None = None) -> PersonSpec:
    """A person with random activity, skin, bias and rate."""
    first, second = choose(rng, activities), choose(rng, activities)
    half_s = rng.uniform(2.0 * BLEND_S, LENGTH_S - 2.0 * BLEND_S)
    parts = ((first, half_s), (second, LENGTH_S - half_s)) if rng.random() < 0.5 else ((first, LENGTH_S),)
    return PersonSpec(parts, joint or choose(rng, ("knee", "knee", "ankle", "elbow")), choose(rng, RATES_HZ),
                      int(rng.integers(2**31)), skin=rng.uniform(0.3, 1.5), out_of_plane=rng.uniform(0.5, 1.3),
                      noise_scale=rng.uniform(0.5, 2.0), gyr_bias_deg_s=rng.uniform(0.0, 0.5), acc_bias=rng.uniform(0.0, 0.3))


def person(spec: PersonSpec) -> PeopleCase:
    rec = simulate_person(spec)
    names = " and ".join(name for name, _ in spec.activities)
    plain = Recording(rec.t_s, rec.gyr1, rec.acc1, rec.gyr2, rec.acc2)
    return PeopleCase(plain, f"simulated {spec.joint}, {names}, {spec.rate_hz:g} Hz, seed {spec.seed}",
                      axis1=rec.axis1, axis2=rec.axis2, person=rec)


def good_joint(rng: np.random.Generator) -> PeopleCase:
    """A joint that could become ready: of people, of a rig, or simulated."""
    people, rigs = people_joints.people_joints("knee", "ankle", "elbow"), available(*HINGE_RIGS)
    kind = rng.random()
    if kind < 0.45 and people:
        return passage(rng, choose(rng, people))
    if kind < 0.7 and rigs:
        return passage(rng, choose(rng, rigs))
    return replace(person(random_spec(rng)), axis1=None, axis2=None)


def any_source(rng: np.random.Generator) -> PeopleCase:
    """Any two sensors in motion."""
    names = [*people_joints.people_joints(), *available(*RIGS)]
    return passage(rng, choose(rng, names)) if names and rng.random() < 0.7 else replace(person(random_spec(rng)), axis1=None, axis2=None)


def resampled(rec: Recording, t_s: np.ndarray) -> Recording:
    """Linear interpolation at other instants."""
    return Recording(t_s, *(np.column_stack([np.interp(t_s, rec.t_s, column) for column in signal.T])
                            for signal in (rec.gyr1, rec.acc1, rec.gyr2, rec.acc2)))


def joined(one: PeopleCase, other: PeopleCase, sensors: tuple[int, int] = (0, 1)) -> PeopleCase:
    """A sensor (0, 1) of one case beside a sensor of another, at the lower of their rates."""
    rate_hz = min(one.rec.rate_hz, other.rec.rate_hz)
    t_s = np.arange(int(min(one.rec.t_s[-1], other.rec.t_s[-1]) * rate_hz) + 1) / rate_hz
    a, b = (signals(resampled(case.rec, t_s), index) for case, index in zip((one, other), sensors, strict=True))
    return PeopleCase(Recording(t_s, *a, *b), f"{one.source} + {other.source}")


# Wrong pairs.

def unrelated_people(rng: np.random.Generator) -> PeopleCase:
    """Proximal sensor of one person's joint, distal one of another's."""
    names = people_joints.people_joints()
    first = choose(rng, names)
    second = choose(rng, [name for name in names if JOINTS[name].person != JOINTS[first].person])
    return joined(passage(rng, first), passage(rng, second))


def unrelated_simulated(rng: np.random.Generator) -> PeopleCase:
    """The same of two simulated people; half of the pairs do the same thing."""
    spec = random_spec(rng)
    other = replace(spec, seed=spec.seed + 1) if rng.random() < 0.5 else random_spec(rng)
    return joined(person(spec), person(other))


def unrelated_rigs(rng: np.random.Generator) -> PeopleCase:
    first, second = rng.choice(available(*RIGS), 2, replace=False)
    return joined(passage(rng, str(first)), passage(rng, str(second)))


def unrelated_mixed(rng: np.random.Generator) -> PeopleCase:
    """A person's sensor and a rig's."""
    pair = [passage(rng, choose(rng, people_joints.people_joints())), passage(rng, choose(rng, available(*RIGS)))]
    return joined(*(pair if rng.random() < 0.5 else pair[::-1]))


def other_time(rng: np.random.Generator) -> PeopleCase:
    """Both sensors of one joint, one of them at another time."""
    names = [name for name in people_joints.people_joints() if len(whole(name)) > 3.0 * LENGTH_S * whole(name).rate_hz]
    name = choose(rng, names)
    first = passage(rng, name)
    for _ in range(TRIES):
        second = passage(rng, name)
        if abs(second.begin - first.begin) > LENGTH_S * whole(name).rate_hz:
            break
    return joined(first, second)


# The left and the right leg of one person at one time; the recordings share their clock.
LEFT_THIGHS = (("people_knee_long_L1", 0), ("people_same_segment_L", 1))
LEFT_SHANK, RIGHT_THIGH, RIGHT_SHANK = ("people_knee_long_L1", 1), ("people_knee_long_R1", 0), ("people_knee_long_R1", 1)


def same_time(rng: np.random.Generator, first: tuple[str, int], second: tuple[str, int]) -> PeopleCase:
    begin, end = span(rng, RIGHT_THIGH[0])
    one, other = (PeopleCase(fresh(cut(whole(name), begin, end)), f"{name} sensor {index + 1} from sample {begin}")
                  for name, index in (first, second))
    return joined(one, other, (first[1], second[1]))


def other_shank(rng: np.random.Generator) -> PeopleCase:
    pairs = [(thigh, RIGHT_SHANK) for thigh in LEFT_THIGHS] + [(RIGHT_THIGH, LEFT_SHANK)]
    return same_time(rng, *choose(rng, pairs))


def other_shank_simulated(rng: np.random.Generator) -> PeopleCase:
    """Walking and running: the shank half a cycle late is that of the other leg."""
    spec = random_spec(rng, ("walk", "run"), "knee")
    cycle_hz = ACTIVITIES[spec.activities[0][0]].cycle_hz
    return replace(person(replace(spec, lag_s=0.5 / cycle_hz)), axis1=None, axis2=None)


def both_thighs(rng: np.random.Generator) -> PeopleCase:
    """Thigh and thigh, sometimes shank and shank."""
    pairs = [(thigh, RIGHT_THIGH) for thigh in LEFT_THIGHS] + [(RIGHT_THIGH, LEFT_THIGHS[0]), (LEFT_SHANK, RIGHT_SHANK)]
    return same_time(rng, *choose(rng, pairs))


# Stiff pairs.

def same_segment(rng: np.random.Generator) -> PeopleCase:
    case = passage(rng, "people_same_segment_L")
    rec = case.rec
    if rng.random() < 0.5:
        return case
    return replace(case, rec=Recording(rec.t_s, rec.gyr2, rec.acc2, rec.gyr1, rec.acc1), source=f"{case.source}, exchanged")


def splint(rng: np.random.Generator) -> PeopleCase:
    """A simulated joint that does not bend, with and without skin."""
    spec = replace(random_spec(rng), stiff=True, skin=choose(rng, (0.0, 0.3, 1.0, 1.5)))
    return replace(person(spec), axis1=None, axis2=None)


def rocking_angle(rng: np.random.Generator, clock: Clock, freq_hz: float, amplitude_rad: float) -> jets.Jet:
    """A sine whose frequency wanders a little and whose amplitude breathes."""
    wander = jets.noise(rng, clock, (0.05, 0.3), 1)[0] * 0.5
    phase = jets.line(clock, 2.0 * np.pi * freq_hz, rng.uniform(0.0, 2.0 * np.pi)) + wander
    breath = jets.noise(rng, clock, (0.05, 0.5), 1)[0] * 0.15 + 1.0
    return jets.sin(phase) * breath * amplitude_rad


def rocked(gyr: np.ndarray, acc: np.ndarray, rate_hz: float, angle: jets.Jet, line: np.ndarray,
           lever_m: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """A sensor that rocks by `angle` about a line through the point `lever_m` (pivot to sensor) before it.

    Q = exp(angle [line]): w = Q' w0 + angle' line, and the same pivot p seen from both:
    a = Q' (a0 - K0 lever) + K lever, K = [dw]x + [w]x[w]x.
    """
    back = quat.matrices(quat.rotation(-angle.value, line))
    turned = np.einsum("nij,nj->ni", back, gyr)
    w = turned + angle.rate[:, None] * line
    dw0 = gauss_smooth(gyr.T, rate_hz, min(DERIVATIVE_HZ, 0.2 * rate_hz))[1].T
    # d/dt (Q' w0) = Q' dw0 - angle' line x Q' w0
    dw = np.einsum("nij,nj->ni", back, dw0) - angle.rate[:, None] * np.cross(line, turned) + angle.accel[:, None] * line

    def swing(rate: np.ndarray, drate: np.ndarray) -> np.ndarray:
        return np.cross(drate, lever_m) + np.cross(rate, np.cross(rate, lever_m))

    return w, np.einsum("nij,nj->ni", back, acc - swing(gyr, dw0)) + swing(w, dw)


def copied(rng: np.random.Generator, freq_hz: tuple[float, float] | None = None, deg: tuple[float, float] = (0.0, 0.0),
           lever_m: float = 0.0) -> PeopleCase:
    """A sensor and a turned copy of it with noise, which rocks about one line if a frequency is given."""
    case = any_source(rng)
    index = int(rng.integers(2))
    gyr, acc = signals(case.rec, index)
    turn, scale = quat_matrix(rng), 10.0 ** rng.uniform(-1.0, 0.7)
    gyr2, acc2 = gyr @ turn.T, acc @ turn.T
    note = f"sensor {2 - index} a copy"
    if freq_hz is not None:
        freq, amplitude = rng.uniform(*freq_hz), np.exp(rng.uniform(*np.log(deg)))
        angle = rocking_angle(rng, Clock(len(gyr), case.rec.rate_hz), freq, np.radians(amplitude))
        lever = rng.uniform(0.0, lever_m) * random_unit(rng)
        gyr2, acc2 = rocked(gyr2, acc2, case.rec.rate_hz, angle, random_unit(rng), lever)
        note += f", rocks by {amplitude:.2f} deg at {freq:.1f} Hz"
    noise = scale * rng.standard_normal((2, len(gyr), 3))
    return with_sensor(case, 1 - index, gyr2 + GYR_STD_RAD_S * noise[0], acc2 + ACC_STD_M_S2 * noise[1], note)


def stiff_copy(rng: np.random.Generator) -> PeopleCase:
    return copied(rng)


def stiff_vibration(rng: np.random.Generator) -> PeopleCase:
    return copied(rng, VIBRATION_HZ, VIBRATION_DEG, 0.03)


def stiff_straps(rng: np.random.Generator) -> PeopleCase:
    return copied(rng, STRAP_HZ, STRAP_DEG, 0.05)


# Rest.

def one_rests(rng: np.random.Generator) -> PeopleCase:
    case, index = good_joint(rng), int(rng.integers(2))
    return with_sensor(case, index, *resting_signals(rng, len(case.rec)), f"sensor {index + 1} rests")


def almost_rests(rng: np.random.Generator) -> PeopleCase:
    """A sensor that turns by 0.2 to 3 deg and is shaken a little, beside one that moves."""
    case, index = good_joint(rng), int(rng.integers(2))
    clock = Clock(len(case.rec), case.rec.rate_hz)
    deg = np.exp(rng.uniform(*np.log((0.2, 3.0))))
    rho = jets.noise(rng, clock, (0.05, 1.0), 3) * np.radians(deg)
    rotation = jets.times(jets.times(jets.turn(0, rho[0]), jets.turn(1, rho[1])), jets.turn(2, rho[2]))
    shaken = jets.noise(rng, clock, (0.2, 4.0), 3, order=2).accel * rng.uniform(0.0, 0.2)
    gyr, acc = resting_signals(rng, clock.size)
    down = acc.mean(axis=0) / np.linalg.norm(acc.mean(axis=0)) * GRAVITY_M_S2
    moved = jets.into_body(rotation, shaken + down[:, None]).T - down
    return with_sensor(case, index, gyr + jets.body_rate(rotation).T, acc + moved, f"sensor {index + 1} turns by {deg:.2f} deg")


def seated_swing(rng: np.random.Generator) -> PeopleCase:
    """A simulated knee: the thigh lies on a seat, the shank swings."""
    return replace(person(random_spec(rng, ("swing",), "knee")), wrong="beyond")


# Faulty sensors.

def degrees_both(rng: np.random.Generator) -> PeopleCase:
    return scaled(good_joint(rng), 180.0 / np.pi, 1.0, (0, 1))


def degrees_one(rng: np.random.Generator) -> PeopleCase:
    return scaled(good_joint(rng), 180.0 / np.pi, 1.0, (int(rng.integers(2)),))


def g_units(rng: np.random.Generator) -> PeopleCase:
    return scaled(good_joint(rng), 1.0, 1.0 / GRAVITY_M_S2, which_sensors(rng))


def remade(case: PeopleCase, sensors: tuple[int, ...], gyr_by: np.ndarray, acc_by: np.ndarray, note: str) -> PeopleCase:
    """The case with gyroscopes and accelerometers of some sensors multiplied by matrices (3, 3)."""
    for index in sensors:
        gyr, acc = signals(case.rec, index)
        case = with_sensor(case, index, gyr @ gyr_by.T, acc @ acc_by.T, f"sensor {index + 1} {note}")
    return case


def any_sensors(rng: np.random.Generator) -> tuple[int, ...]:
    return choose(rng, ((0,), (1,), (0, 1)))


def mirrored(rng: np.random.Generator) -> PeopleCase:
    """Left-handed frames: an axis of both gyroscope and accelerometer negated, or two exchanged."""
    matrix = np.diag(choose(rng, ([-1.0, 1.0, 1.0], [1.0, -1.0, 1.0], [1.0, 1.0, -1.0])))
    if rng.random() < 0.3:
        matrix = np.eye(3)[choose(rng, ([1, 0, 2], [2, 1, 0], [0, 2, 1]))]
    return remade(good_joint(rng), any_sensors(rng), matrix, matrix, "left-handed")


def one_kind(rng: np.random.Generator, matrix: np.ndarray, note: str) -> PeopleCase:
    """A matrix on the gyroscopes or on the accelerometers alone."""
    is_gyr = rng.random() < 0.5
    pair = (matrix, np.eye(3)) if is_gyr else (np.eye(3), matrix)
    return remade(good_joint(rng), any_sensors(rng), *pair, f"{'gyr' if is_gyr else 'acc'} {note}")


def axis_negated(rng: np.random.Generator) -> PeopleCase:
    part = int(rng.integers(3))
    signs = np.ones(3)
    signs[part] = -1.0
    return one_kind(rng, np.diag(signs), f"component {part} negated")


def all_negated(rng: np.random.Generator) -> PeopleCase:
    return one_kind(rng, -np.eye(3), "negated")


def axes_swapped(rng: np.random.Generator) -> PeopleCase:
    """Two components exchanged, or all three moved on."""
    order = choose(rng, ([1, 0, 2], [2, 1, 0], [0, 2, 1], [1, 2, 0], [2, 0, 1]))
    return one_kind(rng, np.eye(3)[order], f"components {order}")


def dead(rng: np.random.Generator) -> PeopleCase:
    """One component is zero, stands at some value, or repeats another one, from the start."""
    case, index, is_gyr, part = good_joint(rng), int(rng.integers(2)), rng.random() < 0.5, int(rng.integers(3))
    gyr, acc = (signal.copy() for signal in signals(case.rec, index))
    signal = gyr if is_gyr else acc
    kind = choose(rng, ("zero", "stuck", "repeats"))
    signal[:, part] = {"zero": 0.0, "stuck": rng.uniform(-1.0, 1.0) * (1.0 if is_gyr else 9.0), "repeats": signal[:, (part + 1) % 3]}[kind]
    return with_sensor(case, index, gyr, acc, f"{'gyr' if is_gyr else 'acc'}{index + 1} component {part} {kind}")


# Recordings whose axes are known: facts of the .json that name them.
KNOWN_AXES = {**{name: ("axis1", "axis2") for name in HINGE_RIGS}, "people_knee_long_L1": ("axis1_ref", "axis2_ref"),
              "people_ankle_orthosis": ("axis1_rate", "axis2_rate")}


def known_axes(name: str) -> tuple[np.ndarray, np.ndarray]:
    if name in HINGE_RIGS:
        return nominal_axes(name)
    axes = (np.array(people_joint(name).facts[key]) for key in KNOWN_AXES[name])
    return tuple(axis / np.linalg.norm(axis) for axis in axes)


def late(rng: np.random.Generator, late_s: float) -> PeopleCase:
    """One sensor tells what was `late_s` ago."""
    names, index = available(*(JOINTS[name].file if name in JOINTS else name for name in KNOWN_AXES)), int(rng.integers(2))
    if not names or rng.random() < 0.4:
        spec = random_spec(rng)
        case = person(replace(spec, lag_s=late_s if index else -late_s))
        return replace(case, wrong="beyond", source=f"{case.source}, sensor {index + 1} late by {late_s:g} s")
    name = choose(rng, names)
    begin, end = span(rng, name, late_s)
    rec = fresh(cut(whole(name), begin, end))
    # From late_s on: one sensor as it is, the other as it was.
    keep = rec.t_s >= late_s - 1e-9
    then = resampled(rec, rec.t_s[keep] - late_s)
    now = Recording(rec.t_s[keep] - late_s, *(signal[keep] for signal in (rec.gyr1, rec.acc1, rec.gyr2, rec.acc2)))
    case = PeopleCase(fresh(now), f"{name} from sample {begin}", wrong="beyond", name=name, begin=begin, late=(index, late_s))
    case.axis1, case.axis2 = known_axes(name)
    return with_sensor(case, index, *signals(then, index), f"sensor {index + 1} late by {late_s:g} s")


def noise(rng: np.random.Generator, cutoff_hz: float | None) -> PeopleCase:
    rate_hz = choose(rng, RATES_HZ)
    clock = Clock(round(LENGTH_S * rate_hz), rate_hz)
    sizes = 10.0 ** rng.uniform(-1.0, 0.7), 10.0 ** rng.uniform(-0.7, 0.8)

    def draw(size: float) -> np.ndarray:
        if cutoff_hz is None:
            return size * rng.standard_normal((clock.count, 3))
        return size * jets.noise(rng, clock, (0.05, cutoff_hz), 3).value.T * np.sqrt(3.0)

    down = [GRAVITY_M_S2 * random_unit(rng) * (rng.random() < 0.8) for _ in range(2)]
    parts = [part for k in range(2) for part in (draw(sizes[0]), draw(sizes[1]) + down[k])]
    name = "white" if cutoff_hz is None else f"below {cutoff_hz:.1f} Hz"
    return PeopleCase(Recording(clock.t_s, *parts), f"noise, {name}, {sizes[0]:.2f} rad/s, {sizes[1]:.2f} m/s^2, {rate_hz:g} Hz")


def white_noise(rng: np.random.Generator) -> PeopleCase:
    return noise(rng, None)


def slow_noise(rng: np.random.Generator) -> PeopleCase:
    return noise(rng, rng.uniform(0.5, 6.0))


def frames_disagree(rng: np.random.Generator) -> PeopleCase:
    """Recordings whose gyroscopes and accelerometers have different frames, as delivered."""
    return passage(rng, choose(rng, [name for name, joint in JOINTS.items() if not joint.frames_agree and available(joint.file)]))


# Joints that are no hinge.

@functools.cache
def lab_orientations(name: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Matrices (N, 3, 3), (N, 3, 3), sensor to laboratory, from optical references, and (N,) where they are right."""
    rec = whole(name)
    if name in RIGS:
        one, two = optical.references(rec)
        return quat.matrices(one.q), quat.matrices(two.q), one.good & two.good
    q1, q2 = (np.column_stack([rec.columns[f"ref_q{sensor}_{part}"] for part in "wxyz"]) for sensor in (1, 2))
    good = np.isfinite(q1).all(axis=1) & np.isfinite(q2).all(axis=1)
    return quat.matrices(q1), quat.matrices(q2), good


def moving_axes(name: str, begin: int, end: int) -> tuple[np.ndarray, np.ndarray, float]:
    """Main axis of the relative rate in the frames of both sensors, and the smaller share of the rate along it."""
    rec, (r1, r2, good) = whole(name), lab_orientations(name)
    rows = begin + np.flatnonzero(good[begin:end])
    in_lab = np.einsum("nij,nj->ni", r2[rows], rec.gyr2[rows]) - np.einsum("nij,nj->ni", r1[rows], rec.gyr1[rows])
    found, shares = [], []
    for r in (r1, r2):
        rates = np.einsum("nji,nj->ni", r[rows], in_lab)
        values, vectors = np.linalg.eigh(rates.T @ rates)
        found.append(vectors[:, -1])
        shares.append(float(values[-1] / values.sum()))
    same = np.sum((r1[rows] @ found[0]) * (r2[rows] @ found[1])) >= 0.0
    return found[0], found[1] if same else -found[1], min(shares)


def two_axes(rng: np.random.Generator) -> PeopleCase:
    """A joint with two axes, whatever moved."""
    return replace(passage(rng, choose(rng, available(*TWO_AXIS_RIGS))), wrong="one axis")


def three_axes(rng: np.random.Generator) -> PeopleCase:
    return passage(rng, choose(rng, available(*THREE_AXIS_RIGS)))


ELBOWS = ("people_elbow_B_JA_Fast", "people_elbow_D_ROM", "people_elbow_E_ROM")


def elbow(rng: np.random.Generator) -> PeopleCase:
    """An elbow, a hinge as long as the forearm does not turn: how far axis 2 moves from this passage on is in the case."""
    name = choose(rng, available(*ELBOWS))
    begin, end = span(rng, name)
    facts = people_joint(name).facts
    axis1 = np.array(facts["axis1_ref"]) / np.linalg.norm(facts["axis1_ref"])
    r1, r2, good = lab_orientations(name)
    axis2 = np.einsum("nji,nj->ni", r2, r1 @ axis1)  # (N, 3) the flexion axis in the forearm's frame
    now = axis2[begin:end][good[begin:end]].mean(axis=0)
    now /= np.linalg.norm(now)
    away = line_angle_deg(axis2[begin:][good[begin:]], now)
    case = PeopleCase(fresh(cut(whole(name), begin, end)), f"{name} from sample {begin}", wrong="beyond", axis1=axis1, axis2=now)
    return replace(case, moves_deg=float(np.quantile(away, 0.95)))


# Class: function, number of runs of a full measurement, what `ready` would be, and the recordings without which there is none.
@dataclass(frozen=True)
class Fault:
    make: Callable[[np.random.Generator], PeopleCase]
    runs: int
    wrong: str = "never"  # see above
    needs: tuple[str, ...] = ()  # all of them


BOTH_LEGS = ("people_knee_long_L1", "people_knee_long_R1", "people_same_segment_L")
FAULTS: dict[str, Fault] = {
    "unrelated_people": Fault(unrelated_people, 500, needs=("knee_drop", "walk_leg_L")),
    "unrelated_simulated": Fault(unrelated_simulated, 200),
    "unrelated_rigs": Fault(unrelated_rigs, 250, needs=RIGS),
    "unrelated_mixed": Fault(unrelated_mixed, 100, needs=("knee_drop", *RIGS)),
    "other_time": Fault(other_time, 70, needs=("people_knee_long_L1",)),
    "other_shank": Fault(other_shank, 200, needs=BOTH_LEGS),
    "other_shank_simulated": Fault(other_shank_simulated, 60),
    "both_thighs": Fault(both_thighs, 100, needs=BOTH_LEGS),
    "same_segment": Fault(same_segment, 150, needs=BOTH_LEGS),
    "splint": Fault(splint, 150),
    "stiff_copy": Fault(stiff_copy, 250),
    "stiff_vibration": Fault(stiff_vibration, 250),
    "stiff_straps": Fault(stiff_straps, 350),
    "one_rests": Fault(one_rests, 180),
    "almost_rests": Fault(almost_rests, 180),
    "seated_swing": Fault(seated_swing, 60, "beyond"),
    "degrees_both": Fault(degrees_both, 120),
    "degrees_one": Fault(degrees_one, 100),
    "g": Fault(g_units, 120),
    "mirrored": Fault(mirrored, 150),
    "axis_negated": Fault(axis_negated, 200),
    "all_negated": Fault(all_negated, 80),
    "axes_swapped": Fault(axes_swapped, 150),
    "dead": Fault(dead, 160),
    **{f"late_{1000.0 * late_s:.0f}": Fault(functools.partial(late, late_s=late_s), 60, "beyond") for late_s in LATE_S},
    "white_noise": Fault(white_noise, 60),
    "slow_noise": Fault(slow_noise, 120),
    "frames_disagree": Fault(frames_disagree, 60, needs=("people_sts_O_5sts",)),
    "rig_2D": Fault(two_axes, 130, "one axis", TWO_AXIS_RIGS),
    "rig_3D": Fault(three_axes, 100, needs=THREE_AXIS_RIGS),
    "elbow": Fault(elbow, 40, "beyond", ELBOWS),
}


def here() -> list[str]:
    """The classes that can be made with the recordings that are there."""
    return [name for name, fault in FAULTS.items() if len(available(*fault.needs)) == len(fault.needs)]


def counts(runs: int | None = None) -> dict[str, int]:
    """Runs of each class that can be made, of all or of about `runs` in all, at least one each."""
    full = {name: FAULTS[name].runs for name in here()}
    share = 1.0 if runs is None else runs / sum(full.values())
    return {name: max(round(count * share), 1) for name, count in full.items()}


def people_case(name: str, index: int) -> PeopleCase:
    """Run `index` of class `name`: the same every time, whatever other classes there are."""
    return FAULTS[name].make(np.random.default_rng([zlib.crc32(name.encode()), index, 1515]))
