"""Data that determine nothing, or that no sensor pair on a hinge would send: the classes of `never`.

Every class is a function of a generator of random numbers that returns a Case. Real
recordings are used where they are; simulated ones stand in where they are not.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ..recordings import Recording
from ..simulate import ACC_STD_M_S2, GRAVITY_M_S2, GYR_STD_RAD_S, HingeSpec, random_unit, rotation_matrix, simulate_hinge
from .judge import available, cut, recording

HINGES = ("rig_1D_01", "rig_1D_02", "rig_1D_04")
RIGS = (*HINGES, "rig_2D_01", "rig_2D_02", "rig_2D_05", "rig_3D_01", "rig_3D_02", "rig_3D_04")
HUMANS = ("human_elbow_right", "human_knee_left", "human_leg_left")
FREE_AXIS = ("7", "14", "daily")  # the joint axis itself turns
HELD_AXIS = ("3", "4", "5", "6", "10", "11", "12", "13")  # it is held still but for its wobble
INFORMATIVE = (*HELD_AXIS, *FREE_AXIS)
RATES_HZ = (25.0, 40.0, 50.0, 60.0, 100.0, 128.0, 200.0)
REST_RAD_S = 0.05  # both sensors below: the recording rests
DEAD_S = 3.0  # the same for a component that dies: it takes motion to notice
SETTLE_S = 1.0  # a verdict that was already on its way when a sensor froze may still arrive


@dataclass
class Case:
    rec: Recording
    source: str  # what it was made from, for the report
    after_s: float = 0.0  # `ready` must not be entered after this time


def choose(rng: np.random.Generator, items: tuple | list):
    return items[rng.integers(len(items))]


def quat_matrix(rng: np.random.Generator) -> np.ndarray:
    """A random rotation (3, 3)."""
    return rotation_matrix(random_unit(rng, 4))


# Sources.

def disturbed(rng: np.random.Generator, motion: str, duration_s: float) -> HingeSpec:
    """A simulation with random noise, biases, soft tissue, rate, speed and mounting."""
    return HingeSpec(motions=((motion, duration_s),), rate_hz=choose(rng, RATES_HZ), seed=int(rng.integers(2**31)),
                     noise_scale=rng.uniform(1.0, 5.0), acc_bias=rng.uniform(0.0, 1.0),
                     gyr_bias_deg_s=rng.uniform(0.0, 1.0), soft_tissue_deg=rng.uniform(0.0, 1.5),
                     speed=rng.uniform(0.5, 2.5))


def simulated(rng: np.random.Generator, motions: tuple[str, ...], duration_s: float) -> Case:
    motion = choose(rng, motions)
    spec = disturbed(rng, motion, duration_s)
    return Case(simulate_hinge(spec), f"simulated {motion}, {spec.rate_hz:g} Hz")


def passage(rng: np.random.Generator, names: tuple[str, ...], duration_s: float,
            otherwise: tuple[str, ...] = INFORMATIVE) -> Case:
    """A random passage of one of the recordings, or a simulated one."""
    there = available(*names)
    if not there:
        return simulated(rng, otherwise, duration_s)
    name = choose(rng, there)
    rec = recording(name)
    count = min(round(duration_s * rec.rate_hz), len(rec))
    begin = int(rng.integers(len(rec) - count + 1))
    return Case(cut(rec, begin, begin + count), f"{name} from sample {begin}")


def real_or_simulated(rng: np.random.Generator, names: tuple[str, ...] = HINGES) -> Case:
    """Informative motion of 10 to 60 s, half of it real."""
    duration_s = rng.uniform(10.0, 60.0)
    if rng.random() < 0.5:
        return passage(rng, names, duration_s)
    return simulated(rng, INFORMATIVE, min(duration_s, 30.0))


def resting_signals(rng: np.random.Generator, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Rates and specific forces (count, 3) of a sensor that lies still."""
    scale = rng.uniform(0.5, 5.0)
    gyr = np.radians(rng.uniform(0.0, 1.0)) * random_unit(rng) + scale * GYR_STD_RAD_S * rng.standard_normal((count, 3))
    acc = (GRAVITY_M_S2 * random_unit(rng) + rng.uniform(0.0, 1.0) * random_unit(rng)
           + scale * ACC_STD_M_S2 * rng.standard_normal((count, 3)))
    return gyr, acc


def with_sensor(case: Case, index: int, gyr: np.ndarray, acc: np.ndarray, note: str) -> Case:
    """The case with other signals of sensor `index` (0, 1)."""
    fields = {f"gyr{index + 1}": gyr, f"acc{index + 1}": acc}
    return replace(case, rec=replace(case.rec, **fields), source=f"{case.source}, {note}")


def signals(rec: Recording, index: int) -> tuple[np.ndarray, np.ndarray]:
    return (rec.gyr1, rec.acc1) if index == 0 else (rec.gyr2, rec.acc2)


# The classes.

def stiff(rng: np.random.Generator) -> Case:
    return simulated(rng, ("2", "9"), rng.uniform(10.0, 60.0))


def turned_copy(rng: np.random.Generator) -> Case:
    case = passage(rng, (*RIGS, *HUMANS), rng.uniform(10.0, 60.0))
    index = int(rng.integers(2))
    gyr, acc = signals(case.rec, index)
    turn, scale = quat_matrix(rng), 10.0 ** rng.uniform(-1.0, 1.0)
    noise = rng.standard_normal((2, len(gyr), 3))
    return with_sensor(case, 1 - index, gyr @ turn.T + scale * GYR_STD_RAD_S * noise[0],
                       acc @ turn.T + scale * ACC_STD_M_S2 * noise[1],
                       f"sensor {2 - index} a copy of the other, noise x {scale:.2g}")


def one_rests_simulated(rng: np.random.Generator) -> Case:
    return simulated(rng, ("rest1", "rest2"), rng.uniform(10.0, 60.0))


def one_rests_real(rng: np.random.Generator) -> Case:
    case = passage(rng, (*RIGS, *HUMANS), rng.uniform(10.0, 60.0))
    index = int(rng.integers(2))
    return with_sensor(case, index, *resting_signals(rng, len(case.rec)), f"sensor {index + 1} rests")


def both_rest_simulated(rng: np.random.Generator) -> Case:
    return simulated(rng, ("rest",), rng.uniform(10.0, 60.0))


@functools.cache
def quiet_passages(name: str, length_s: float = 1.0) -> list[tuple[int, int]]:
    """Where both sensors of a recording rest for at least `length_s`."""
    rec = recording(name)
    count = round(length_s * rec.rate_hz)
    still = np.maximum(*(np.linalg.norm(gyr, axis=1) for gyr in (rec.gyr1, rec.gyr2))) < REST_RAD_S
    edges = np.flatnonzero(np.diff(np.concatenate([[0], still, [0]])))
    return [(begin, end) for begin, end in edges.reshape(-1, 2) if end - begin >= count]


def both_rest_real(rng: np.random.Generator) -> Case:
    """Real rest, continued by going back and forth over it with noise of its own size."""
    names = [name for name in available(*RIGS, *HUMANS) if quiet_passages(name)]
    if not names:
        return both_rest_simulated(rng)
    name = choose(rng, names)
    begin, end = choose(rng, quiet_passages(name))
    rec = recording(name)
    count = round(rng.uniform(10.0, 40.0) * rec.rate_hz)
    there_and_back = np.concatenate([np.arange(begin, end), np.arange(end - 1, begin - 1, -1)])
    rows = np.resize(there_and_back, count)
    noisy = [(signal[rows] + signal[begin:end].std(axis=0) * rng.standard_normal((count, 3)))
             for signal in (rec.gyr1, rec.acc1, rec.gyr2, rec.acc2)]
    return Case(Recording(np.arange(count) / rec.rate_hz, *noisy), f"{name}, rest at sample {begin}")


def zeros(rng: np.random.Generator) -> Case:
    case = real_or_simulated(rng, (*RIGS, *HUMANS))
    none = np.zeros((len(case.rec), 3))
    kind = int(rng.integers(4))
    if kind < 2:
        return with_sensor(case, kind, none, none, f"sensor {kind + 1} sends zeros")
    if kind == 2:
        return with_sensor(with_sensor(case, 0, none, none, "sensor 1"), 1, none, none, "sensor 2 send zeros")
    index = int(rng.integers(2))
    return with_sensor(case, index, none, signals(case.rec, index)[1], f"gyroscope {index + 1} sends zeros")


def hold(signal: np.ndarray, begin: int) -> np.ndarray:
    held = signal.copy()
    held[begin:] = signal[begin]
    return held


def frozen(rng: np.random.Generator) -> Case:
    """One or both sensors repeat a reading: from the start, early, late, or late after stiff motion."""
    kind = choose(rng, ("from the start", "early", "late", "after stiff motion"))
    if kind == "after stiff motion":
        case = simulated(rng, ("2", "9"), rng.uniform(15.0, 60.0))
    else:
        case = real_or_simulated(rng)
    duration_s = len(case.rec) / case.rec.rate_hz
    begin_s = {"from the start": 0.0, "early": rng.uniform(0.0, 0.5)}.get(kind, rng.uniform(0.1, 0.7) * duration_s)
    begin = min(round(begin_s * case.rec.rate_hz), len(case.rec) - 1)
    for index in choose(rng, ((0,), (1,), (0, 1))):
        gyr, acc = signals(case.rec, index)
        case = with_sensor(case, index, hold(gyr, begin), hold(acc, begin), f"sensor {index + 1} frozen")
    case.source += f" at {begin_s:.2f} s, {kind}"
    if kind == "late":  # what came before the fault may have made it ready
        case.after_s = begin / case.rec.rate_hz + SETTLE_S
    return case


def clip(signal: np.ndarray) -> np.ndarray:
    limit = np.abs(signal).max() / 4.0
    return np.clip(signal, -limit, limit)


def clipped(rng: np.random.Generator) -> Case:
    """Gyroscopes and accelerometers of both sensors at a quarter of their motion's range."""
    case = real_or_simulated(rng)
    for index in (0, 1):
        gyr, acc = signals(case.rec, index)
        case = with_sensor(case, index, clip(gyr), clip(acc), "clipped")
    return case


def clipped_gyr(rng: np.random.Generator) -> Case:
    """The same of the gyroscopes alone."""
    case = real_or_simulated(rng)
    for index in (0, 1):
        gyr, acc = signals(case.rec, index)
        case = with_sensor(case, index, clip(gyr), acc, "rates clipped")
    return case


def scaled(case: Case, gyr_factor: float, acc_factor: float, sensors: tuple[int, ...]) -> Case:
    for index in sensors:
        gyr, acc = signals(case.rec, index)
        case = with_sensor(case, index, gyr * gyr_factor, acc * acc_factor, f"sensor {index + 1} scaled")
    return case


def which_sensors(rng: np.random.Generator) -> tuple[int, ...]:
    """Mostly both, sometimes one."""
    return choose(rng, ((0, 1), (0, 1), (0, 1), (0,), (1,)))


def degrees(rng: np.random.Generator) -> Case:
    return scaled(real_or_simulated(rng, (*HINGES, *HUMANS)), 180.0 / np.pi, 1.0, which_sensors(rng))


def g_units(rng: np.random.Generator) -> Case:
    return scaled(real_or_simulated(rng, (*HINGES, *HUMANS)), 1.0, 1.0 / GRAVITY_M_S2, which_sensors(rng))


def both_units(rng: np.random.Generator) -> Case:
    return scaled(real_or_simulated(rng, (*HINGES, *HUMANS)), 180.0 / np.pi, 1.0 / GRAVITY_M_S2, which_sensors(rng))


def white_noise(rng: np.random.Generator) -> Case:
    rate_hz = choose(rng, RATES_HZ)
    count = round(rng.uniform(10.0, 60.0) * rate_hz)
    gyr = 10.0 ** rng.uniform(-2.0, 0.5) * rng.standard_normal((2, count, 3))
    acc = 10.0 ** rng.uniform(-1.0, 1.0) * rng.standard_normal((2, count, 3))
    if rng.random() < 0.7:
        acc = acc + GRAVITY_M_S2 * np.array([random_unit(rng), random_unit(rng)])[:, None]
    return Case(Recording(np.arange(count) / rate_hz, gyr[0], acc[0], gyr[1], acc[1]), f"white noise, {rate_hz:g} Hz")


def at_50_hz(case: Case) -> Case:
    step = round(case.rec.rate_hz / 50.0)
    rec = case.rec
    return replace(case, rec=Recording(*(signal[::step] for signal in (rec.t_s, rec.gyr1, rec.acc1, rec.gyr2, rec.acc2))))


def mixed(rng: np.random.Generator) -> Case:
    """Sensor 1 of one recording with sensor 2 of another, both at 50 Hz."""
    there = available(*RIGS, *HUMANS)
    duration_s = rng.uniform(10.0, 60.0)
    if len(there) < 2:
        return mixed_simulated(rng)
    first, second = rng.choice(len(there), 2, replace=False)
    return paired(*(at_50_hz(passage(rng, (there[k],), duration_s)) for k in (first, second)))


def paired(one: Case, other: Case) -> Case:
    count = min(len(one.rec), len(other.rec))
    a, b = cut(one.rec, 0, count), cut(other.rec, 0, count)
    return Case(Recording(a.t_s - a.t_s[0], a.gyr1, a.acc1, b.gyr2, b.acc2), f"{one.source} + {other.source}")


def mixed_motions(rng: np.random.Generator, motions: tuple[str, ...]) -> Case:
    duration_s = rng.uniform(10.0, 60.0)
    cases = []
    for _ in range(2):
        motion = choose(rng, motions)
        spec = replace(disturbed(rng, motion, duration_s), rate_hz=50.0)
        cases.append(Case(simulate_hinge(spec), f"simulated {motion}"))
    return paired(*cases)


def mixed_simulated(rng: np.random.Generator) -> Case:
    return mixed_motions(rng, FREE_AXIS)


def mixed_held(rng: np.random.Generator) -> Case:
    """The same where both joint axes are held still: each sensor turns about one axis only, as on one hinge."""
    return mixed_motions(rng, HELD_AXIS)


def shifted(rng: np.random.Generator) -> Case:
    """Sensor 1 of a recording with sensor 2 of another time of the same recording."""
    case = passage(rng, (*RIGS, *HUMANS), rng.uniform(20.0, 60.0), FREE_AXIS)
    count = len(case.rec)
    by = int(rng.integers(count // 4, 3 * count // 4))
    return with_sensor(case, 1, np.roll(case.rec.gyr2, by, axis=0), np.roll(case.rec.acc2, by, axis=0),
                       f"sensor 2 shifted by {by} samples")


def three_axes(rng: np.random.Generator) -> Case:
    """A joint with three degrees of freedom; where there are no recordings, two unrelated bodies."""
    names = ("rig_3D_01", "rig_3D_02", "rig_3D_04")
    return passage(rng, names, rng.uniform(10.0, 60.0)) if available(*names) else mixed_simulated(rng)


def dead_component(rng: np.random.Generator) -> Case:
    """One component of a gyroscope or an accelerometer is zero, stands at some value, or repeats another one; from the start, or late."""
    case = real_or_simulated(rng)
    index, is_gyr, part = int(rng.integers(2)), rng.random() < 0.5, int(rng.integers(3))
    gyr, acc = (signal.copy() for signal in signals(case.rec, index))
    signal = gyr if is_gyr else acc
    kind = choose(rng, ("zero", "stuck", "repeats"))
    begin = 0 if rng.random() < 0.7 else int(rng.integers(len(signal)))
    stuck = {"zero": 0.0, "stuck": rng.uniform(-1.0, 1.0) * (1.0 if is_gyr else 9.0), "repeats": signal[begin:, (part + 1) % 3]}
    signal[begin:, part] = stuck[kind]
    if begin > 0:
        case.after_s = begin / case.rec.rate_hz + DEAD_S
    return with_sensor(case, index, gyr, acc, f"{'gyr' if is_gyr else 'acc'}{index + 1} component {part} {kind} from sample {begin}")


def slow_degrees(rng: np.random.Generator) -> Case:
    """Slow motion, rates in deg/s: in rad/s they would be those of usual motion."""
    spec = replace(disturbed(rng, choose(rng, INFORMATIVE), rng.uniform(20.0, 60.0)), speed=10.0 ** rng.uniform(-2.0, -0.5))
    return scaled(Case(simulate_hinge(spec), f"simulated, speed {spec.speed:.3f}"), 180.0 / np.pi, 1.0, which_sensors(rng))


def glitch_then_clipped(rng: np.random.Generator) -> Case:
    """Clipped rates, and early on one to three samples far beyond the limit."""
    case = clipped_gyr(rng)
    at_limit = [(np.abs(gyr) >= np.abs(gyr).max()).any(axis=1) for gyr in (case.rec.gyr1, case.rec.gyr2)]
    case.after_s = float(case.rec.t_s[np.flatnonzero(at_limit[0] | at_limit[1])[0]] - case.rec.t_s[0])  # what came before is right
    index, part = int(rng.integers(2)), int(rng.integers(3))
    gyr, acc = (signal.copy() for signal in signals(case.rec, index))
    begin = int(rng.integers(1, len(gyr) // 4))
    factor = rng.uniform(1.2, 8.0)
    count = 1 if rng.random() < 0.7 else int(rng.integers(2, 4))
    gyr[begin:begin + count, part] = factor * np.abs(gyr).max() * rng.uniform(0.9, 1.0, count)
    return with_sensor(case, index, gyr, acc, f"{count} wild from sample {begin}")


# Class: function and number of runs of a full measurement.
Classes = dict[str, tuple[Callable[[np.random.Generator], Case], int]]
CLASSES: Classes = {
    "stiff": (stiff, 1200),
    "copy": (turned_copy, 1200),
    "one_rests_sim": (one_rests_simulated, 700),
    "one_rests_real": (one_rests_real, 700),
    "both_rest_sim": (both_rest_simulated, 400),
    "both_rest_real": (both_rest_real, 300),
    "zeros": (zeros, 600),
    "frozen": (frozen, 800),
    "clip": (clipped, 500),
    "clip_gyr": (clipped_gyr, 300),
    "deg_s": (degrees, 400),
    "g": (g_units, 400),
    "deg_s_and_g": (both_units, 200),
    "white_noise": (white_noise, 600),
    "mix": (mixed, 900),
    "mix_sim": (mixed_simulated, 300),
    "shift": (shifted, 300),
    "three_axes": (three_axes, 200),
    "dead": (dead_component, 600),
    "deg_s_slow": (slow_degrees, 300),
    "glitch_clip": (glitch_then_clipped, 300),
}
# Reported, not required: as far as the data go, this could be a hinge.
REPORTED: Classes = {"mix_held": (mixed_held, 200)}
