"""Simulator of a 2-DoF joint (elbow, ankle, finger) that carries one IMU on each segment.

Kinematics. With elementary rotations, segment to earth, earth z up:

    R_1(t) = Rz(yaw) Rx(tilt) Ry(psi),    R_2(t) = R_1 Ry(alpha) Rx(pi/2 - beta) Ry(gamma).

j1 is the y axis of segment 1, j2 that of segment 2, and [j1]_E . [j2]_E = sin(beta): beta is the carrying angle of
LAI22 (12), constant unless the joint is given a third degree of freedom. alpha and gamma are the angles of LAI22
(22), (24), up to a constant each. Motions, blending, soft tissue, sensors and noise are those of simulate.py.

Orientations. q1, q2 (sensor to E1, E2) are the true orientations, soft tissue included, as a 6D filter would give
them: each in an earth frame of its own, whose heading drifts and which is slightly inclined. delta is the heading
offset of LAI22 (6): E2 to E1 turns by delta about z.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass

import numpy as np

from . import quaternions as quat
from .recordings import AXES, Recording
from .simulate import (A0_BAND_HZ, GRAVITY_M_S2, Angles, blend_window, burst_window, elementary_quat, modulate,
                       quat_mul, random_unit, simulate_sensor, smooth_noise, turn_frame)

YAW, TILT, PSI, ALPHA, BETA, GAMMA = range(6)  # channels of the angles
INCLINATION_BAND_HZ = (0.01, 0.2)
MAX_DRIFT_DEG_MIN = 5.0
ELBOW_DEG = (130.0, 140.0)  # scripted motion: range of flexion and of pronation
REPETITION_S = 2.0  # scripted motion: one flexion and extension at the speed 1.5 rad/s
THIRD_DOF_BAND_HZ = (0.1, 0.8)


@dataclass(frozen=True)
class TwoDofMotion:
    """One kind of motion. Shares are fractions of the speed (rms rad/s)."""

    id: int
    base: float = 0.0  # share of yaw and of tilt each
    segment1: float = 0.0  # share of psi: segment 1 about j1
    flexion: float = 0.0  # share of alpha
    pronation: float = 0.0  # share of gamma
    third: float = 0.0  # share of beta: no 2-DoF joint
    scripted: str = ""  # 'alternating' or 'overlapping' repetitions of flexion and pronation
    carried: bool = False  # the joint centre is accelerated
    paused: bool = False  # bursts and pauses as in daily life


TWO_DOF_MOTIONS = {
    "free": TwoDofMotion(1, 0.5, 0.5, 0.7, 0.7, carried=True),
    "daily": TwoDofMotion(2, 0.5, 0.5, 0.7, 0.7, carried=True, paused=True),
    "simple": TwoDofMotion(3, 0.1, 0.2, 0.15, 0.15, scripted="alternating", carried=True),  # LAI22 5.1
    "complex": TwoDofMotion(4, 0.5, 0.5, scripted="overlapping", carried=True),
    "base_rest": TwoDofMotion(5, 0.0, 0.7, 0.7, 0.7),
    # Motions that leave something open, and joints that are none of this kind.
    "segment1_rest": TwoDofMotion(6, 0.0, 0.0, 0.7, 0.7),
    "hinge": TwoDofMotion(7, 0.5, 0.5, 0.9, carried=True),
    "pronation": TwoDofMotion(8, 0.5, 0.5, 0.0, 0.9, carried=True),
    "stiff": TwoDofMotion(9, 0.5, 0.5, carried=True),
    "rest": TwoDofMotion(10),
    # Exactly one angle at a time, the other always at the same rest: both orders of the axes explain it equally.
    "alternating": TwoDofMotion(12, 0.5, 0.5, scripted="alternating", carried=True),
    "three_dof": TwoDofMotion(11, 0.5, 0.5, 0.7, 0.7, 0.7, carried=True),
}


@dataclass(frozen=True)
class Slip:
    """From `at_s` on sensor 1 or 2 sits turned by `angle_deg` about a random axis of its own."""

    at_s: float
    sensor: int
    angle_deg: float


@dataclass(frozen=True)
class TwoDofSpec:
    """What to simulate. The same spec gives the same recording."""

    motions: tuple[tuple[str, float], ...] = (("free", 30.0),)  # (name in TWO_DOF_MOTIONS, seconds)
    rate_hz: float = 100.0
    seed: int = 0
    carrying_deg: float = 10.0
    noise_scale: float = 1.0  # times the standard deviations of simulate.py
    acc_bias: float = 0.0  # m/s^2, magnitude; the direction is random per sensor
    gyr_bias_deg_s: float = 0.0
    soft_tissue_deg: float = 0.0  # rms of the random part while moving, as in simulate.py
    inertia_ratio: float = 1.0
    heading_deg: float | None = None  # delta at the beginning; None: random
    drift_deg_min: float = 0.0  # of delta, constant rate, half of it in either frame
    inclination_deg: float = 0.0  # rms tilt of each orientation's earth frame, wandering slowly
    speed: float = 1.5  # rms rad/s
    a0_rms: float = 1.0  # m/s^2, all three components together
    lever_m: tuple[float, float] = (0.05, 0.3)
    r1: tuple[float, float, float] | None = None  # joint to sensor, overrides the random one
    r2: tuple[float, float, float] | None = None
    blend_s: float = 1.0
    slips: tuple[Slip, ...] = ()

    def __post_init__(self) -> None:
        if not 25.0 <= self.rate_hz <= 200.0:
            raise ValueError("rate_hz must be within 25 and 200")
        if abs(self.carrying_deg) > 80.0:
            raise ValueError("carrying_deg must be within -80 and 80: parallel axes are a hinge")
        if abs(self.drift_deg_min) > MAX_DRIFT_DEG_MIN:
            raise ValueError(f"drift_deg_min must be within {-MAX_DRIFT_DEG_MIN} and {MAX_DRIFT_DEG_MIN}")
        for name, duration_s in self.motions:
            if name not in TWO_DOF_MOTIONS:
                raise ValueError(f"unknown motion '{name}'")
            if duration_s < 1.0:
                raise ValueError("a motion lasts at least 1 s")
        for each in self.slips:
            if each.sensor not in (1, 2):
                raise ValueError("a slip is one of sensor 1 or 2")


@dataclass
class TwoDofRecording(Recording):
    """A simulated recording with its truth. Axes and lever arms are those before any slip."""

    axis1: np.ndarray  # (3,) unit, sensor frame
    axis2: np.ndarray
    r1: np.ndarray  # (3,) joint to sensor, sensor frame, m
    r2: np.ndarray
    alpha: np.ndarray  # (N,) flexion, rad
    beta: np.ndarray  # (N,) carrying angle
    gamma: np.ndarray  # (N,) pronation
    delta: np.ndarray  # (N,) heading offset, not wrapped
    q1: np.ndarray  # (N, 4) sensor to E1
    q2: np.ndarray  # (N, 4) sensor to E2
    earth1: np.ndarray  # (N, 4) E1 to the common earth frame
    earth2: np.ndarray
    motion_id: np.ndarray  # (N,) see TWO_DOF_MOTIONS, 0 in transitions
    turns: list[np.ndarray]  # (4,) of each slip: sensor after it to sensor before it
    spec: TwoDofSpec

    def axes_at(self, t_s: float) -> tuple[np.ndarray, np.ndarray]:
        """True axes at a time, slips included."""
        axes = [self.axis1, self.axis2]
        for each, turn in zip(self.spec.slips, self.turns, strict=True):
            if t_s >= each.at_s:
                axes[each.sensor - 1] = quat.matrices(turn[None])[0].T @ axes[each.sensor - 1]
        return axes[0], axes[1]

    def extra_columns(self) -> dict[str, np.ndarray]:
        """Columns of the file besides the IMUs': orientations, then truth that a reader may ignore."""
        columns = {f"q{i}_{name}": part for i, q in ((1, self.q1), (2, self.q2))
                   for name, part in zip(("w", *AXES), q.T, strict=True)}
        truth = {"flexion": self.alpha, "carrying": self.beta, "pronation": self.gamma, "heading_offset": self.delta}
        return {**columns, **{f"true_{name}_rad": part for name, part in truth.items()}}

    def truth(self) -> dict:
        """What a test wants to know besides the signals, ready for JSON."""
        edges = np.flatnonzero(np.diff(self.motion_id)) + 1
        parts = zip(np.r_[0, edges], np.r_[edges, len(self)], strict=True)
        slips = [{**asdict(each), "axis1_after": after[0].tolist(), "axis2_after": after[1].tolist()}
                 for each in self.spec.slips for after in [self.axes_at(each.at_s)]]
        return {
            "source": "simulated (tools/simulate_two_dof.py)",
            "rate_hz": self.spec.rate_hz,
            "axis1": self.axis1.tolist(), "axis2": self.axis2.tolist(),
            "joint_to_sensor1_m": self.r1.tolist(), "joint_to_sensor2_m": self.r2.tolist(),
            "carrying_angle_deg": self.spec.carrying_deg,
            "heading_offset_deg": {"begin": float(np.degrees(self.delta[0])), "end": float(np.degrees(self.delta[-1]))},
            "motions": [{"id": int(self.motion_id[a]), "from_s": float(self.t_s[a]), "to_s": float(self.t_s[b - 1])}
                        for a, b in parts],
            "slips": slips,
            "spec": asdict(self.spec),
        }


# Motion: the six angles.

def repetitions(n: int, rate_hz: float, period_s: float, duty: tuple[float, float]) -> list[np.ndarray]:
    """One smooth rise and fall 0 -> 1 -> 0 per period, within the shares `duty` of it, and two derivatives.

    sin(u)^4 with u from 0 to pi: three derivatives vanish at both ends.
    """
    width_s = (duty[1] - duty[0]) * period_s
    u = np.pi * ((np.arange(n) / rate_hz) % period_s - duty[0] * period_s) / width_s
    inside = (u > 0.0) & (u < np.pi)
    s, c, pace = np.where(inside, np.sin(u), 0.0), np.where(inside, np.cos(u), 0.0), np.pi / width_s
    return [s**4, 4 * s**3 * c * pace, (12 * s**2 * c**2 - 4 * s**4) * pace**2]


def scripted_angles(motion: TwoDofMotion, spec: TwoDofSpec, n: int) -> list[np.ndarray]:
    """Flexion and pronation over their range, in turn or overlapping: [value, rate, accel], each (6, n)."""
    period_s = 2.0 * REPETITION_S * 1.5 / spec.speed
    duties = ((0.0, 0.5), (0.5, 1.0)) if motion.scripted == "alternating" else ((0.0, 0.6), (0.3, 0.95))
    angles = [np.zeros((6, n)) for _ in range(3)]
    for channel, range_deg, duty in zip((ALPHA, GAMMA), ELBOW_DEG, duties, strict=True):
        for part, values in zip(angles, repetitions(n, spec.rate_hz, period_s, duty), strict=True):
            part[channel] = np.radians(range_deg) * values
    return angles


def two_dof_motion_angles(motion: TwoDofMotion, spec: TwoDofSpec, rng: np.random.Generator,
                          n: int) -> list[np.ndarray]:
    """Angles of one motion about the mean pose: [value, rate, accel], each (6, n)."""
    pace = np.clip(spec.speed / 1.5, 0.5, 3.0)  # as in simulate.py
    turning = smooth_noise(rng, n, spec.rate_hz, (0.1 * pace, 0.8 * pace), 6, unit=1, orders=2)
    share = np.array([motion.base, motion.base, motion.segment1, motion.flexion, 0.0, motion.pronation])
    angles = [spec.speed * share[:, None] * part for part in turning]
    if motion.scripted:
        angles = [part + more for part, more in zip(angles, scripted_angles(motion, spec, n), strict=True)]
    third = smooth_noise(rng, n, spec.rate_hz, THIRD_DOF_BAND_HZ, 1, unit=1, orders=2)
    for part, more in zip(angles, third, strict=True):
        part[BETA] += spec.speed * motion.third * more[0]
    if motion.paused:
        angles = modulate(angles, *burst_window(rng, n, spec.rate_hz))
    return angles


def two_dof_angles(spec: TwoDofSpec) -> Angles:
    """The six angles over all motions, blended in the transitions; the mean pose is the same throughout."""
    blend = round(spec.blend_s * spec.rate_hz)
    counts = [round(duration_s * spec.rate_hz) for _, duration_s in spec.motions]
    total = sum(counts) + blend * (len(counts) - 1)
    run = Angles(*(np.zeros((6, total)) for _ in range(3)), np.zeros((3, total)), np.zeros(total, int))
    begin = 0
    for index, ((name, _), count) in enumerate(zip(spec.motions, counts, strict=True)):
        motion, rng = TWO_DOF_MOTIONS[name], np.random.default_rng([spec.seed, 2, index])
        rise = blend if index > 0 else 0
        fall = blend if index < len(counts) - 1 else 0
        span, n = slice(begin - rise, begin + count + fall), rise + count + fall
        window = blend_window(n, rise, fall, spec.rate_hz)
        parts = modulate(two_dof_motion_angles(motion, spec, rng, n), *window)
        for target, part in zip((run.value, run.rate, run.accel), parts, strict=True):
            target[:, span] += part
        if motion.carried:
            a0 = smooth_noise(rng, n, spec.rate_hz, A0_BAND_HZ, 3)[0]
            run.a0[:, span] += spec.a0_rms / np.sqrt(3.0) * a0 * window[0]
        run.motion_id[begin: begin + count] = motion.id
        begin += count + blend
    rng = np.random.default_rng([spec.seed, 1])
    pose = rng.uniform(-1.0, 1.0, 6) * [np.pi, np.pi / 3, np.pi, np.pi / 2, 0.0, np.pi / 2]
    pose[BETA] = np.radians(spec.carrying_deg)
    run.value += pose[:, None]
    return run


# Sensors and orientations.

def earth_frames(spec: TwoDofSpec, n: int) -> tuple[list[np.ndarray], np.ndarray]:
    """E_i to the common earth (N, 4) of both sensors, and delta (N,). The incline comes after the heading."""
    rng = np.random.default_rng([spec.seed, 6])
    first, offset = rng.uniform(-np.pi, np.pi, 2)
    if spec.heading_deg is not None:
        offset = np.radians(spec.heading_deg)
    drift = np.radians(spec.drift_deg_min) / 60.0 * np.arange(n) / spec.rate_hz
    frames = []
    for index, heading in enumerate((first - drift / 2.0, first + offset + drift / 2.0)):
        incline = np.zeros((n, 3))
        if spec.inclination_deg > 0.0:
            wander = smooth_noise(np.random.default_rng([spec.seed, 7, index]), n, spec.rate_hz,
                                  INCLINATION_BAND_HZ, 2)[0]
            incline[:, :2] = (np.radians(spec.inclination_deg) / np.sqrt(2.0) * wander).T
        frames.append(quat.multiply(quat.rotation(heading, np.array([0.0, 0.0, 1.0])),
                                    quat.from_rotation_vectors(incline)))
    return frames, offset + drift


def turn_from(rec: TwoDofRecording, slip: Slip, index: int) -> np.ndarray:
    """Turn one sensor's signals from `slip.at_s` on; returns the turn, sensor after it to sensor before it."""
    axis = random_unit(np.random.default_rng([rec.spec.seed, 8, index]))
    turn = quat.rotation(np.radians(slip.angle_deg), axis)
    later = rec.t_s >= slip.at_s
    for name in ("gyr", "acc"):
        signal = getattr(rec, f"{name}{slip.sensor}")
        signal[later] = signal[later] @ quat.matrices(turn[None])[0]
    q = rec.q1 if slip.sensor == 1 else rec.q2
    q[later] = quat.multiply(q[later], turn)
    return turn


def simulate_two_dof(spec: TwoDofSpec) -> TwoDofRecording:
    """Simulate the recording that `spec` describes."""
    angles = two_dof_angles(spec)
    n = len(angles.motion_id)
    zero = np.zeros((3, n))
    body = (zero, zero, angles.a0 + [[0.0], [0.0], [GRAVITY_M_S2]])
    bend = Angles(np.pi / 2 - angles.value, -angles.rate, -angles.accel, angles.a0, angles.motion_id)
    q = np.array([[1.0], [0.0], [0.0], [0.0]])
    sensors = []
    frames, delta = earth_frames(spec, n)
    for source, axis, channel in ((angles, 2, YAW), (angles, 0, TILT), (angles, 1, PSI), (angles, 1, ALPHA),
                                  (bend, 0, BETA), (angles, 1, GAMMA)):
        body = turn_frame(axis, source, channel, *body)
        q = quat_mul(q, elementary_quat(axis, source.value[channel]))
        if channel in (PSI, GAMMA):
            gyr, acc, q_s, mount, r = simulate_sensor(spec, len(sensors), *body, q)
            sensors.append((gyr, acc, quat.multiply(quat.conjugate(frames[len(sensors)]), q_s), mount.T @ [0.0, 1.0, 0.0], r))
    (gyr1, acc1, q1, axis1, r1), (gyr2, acc2, q2, axis2, r2) = sensors
    rec = TwoDofRecording(np.arange(n) / spec.rate_hz, gyr1, acc1, gyr2, acc2, axis1, axis2, r1, r2,
                          *angles.value[[ALPHA, BETA, GAMMA]], delta, q1, q2, *frames, angles.motion_id, [], spec)
    rec.turns = [turn_from(rec, slip, index) for index, slip in enumerate(spec.slips)]
    return rec


def orientation_columns(columns: Mapping[str, np.ndarray], index: int) -> np.ndarray:
    """Quaternions (N, 4) of sensor `index` from a file's columns."""
    return np.column_stack([columns[f"q{index}_{name}"] for name in ("w", *AXES)])
