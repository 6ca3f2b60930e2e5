"""Simulator of a person's hinge joint (knee, ankle, elbow as one axis) that carries one IMU on each segment.

Bones. The body's frame has x forward, y to the left, z up. The proximal segment turns by

    R_1 = Rz(yaw) Rx(roll) Ry(pitch),    R_2 = R_1 Ry(flexion) Rx(abduction) Rz(rotation),

so the joint's axis is y of both segments. Abduction and rotation are true motion out of the
plane: noise whose size goes with the cycle, without what follows the rate of flexion. So they
are no function of flexion, and they tilt the axis in the mean by nothing. With `loop` a share of
their power is the same in every cycle, in quadrature to flexion: an axis that is found then
depends on how one looks for it, by 10 deg and more, as in people, and the true one is a
convention. The joint centre hangs on the hip (shoulder), which moves as the activity wants, with
a jolt of the bones after each heel strike. Flexion is positive; for elbows read x as backward.

Skin. Sensor i is turned against its bone by rho_i(t): noise of OCTAVES_DEG from 0.3 Hz on, rms of
the whole vector, times what the activity and the joint make of it; ringing after each heel
strike; and on the proximal segment a share of that segment's own rotation, backward, which no
IMU can see. The sensor moves against the bone by rho x a lever of some centimetres. The true
axes and positions belong to rho = 0.

Everything is made of jets (jets.py): rates and accelerations are exact derivatives.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass, replace

import numpy as np

from . import jets
from . import quaternions as quat
from .jets import Clock, Jet
from .recordings import Recording
from .simulate import ACC_STD_M_S2, GRAVITY_M_S2, GYR_STD_RAD_S, SMOOTH_STEP, random_unit, rotation_matrix

RATE_RANGE_HZ = (40.0, 200.0)
OCTAVES_DEG = (1.0, 1.2, 1.0, 0.6, 0.4, 0.25)  # of sensor against bone, rms, octaves from FIRST_OCTAVE_HZ on
FIRST_OCTAVE_HZ = 0.3
SKIN_SHAPE = (1.1, 0.74, 1.1)  # times that about x, y, z of the bone: least about y, the joint's axis; their mean square is 1
RINGING_HZ = (3.5, 12.0)  # of skin after a heel strike
JOLT_HZ = (5.0, 18.0)  # of bones
STRIKE_LAG_RAD = 0.25  # of gait phase, from a heel strike to its middle
STRIKE_SHARPNESS = 12.0  # exp(s (cos phase - 1)): about 0.1 of a cycle
IN_PHASE = (0.08, 0.15)  # share of the proximal segment's rotation that its sensor stays behind
SKIN_LEVER_M = (0.02, 0.05)
OUT_OF_PLANE_HZ = (0.15, 2.0)
CYCLE_DEPTH = 0.8  # by how much their size goes with the cycle
TURNING_HZ = (0.02, 0.15)
SEGMENT_M = {"knee": 0.42, "ankle": 0.42, "elbow": 0.30}  # from the joint that carries it to this joint
HARMONICS = 7
PATTERN_POINTS = 256
BLEND_S = 1.5

# Joint angles over the gait cycle from heel strike: (share of the cycle, deg). Flexion, dorsiflexion positive.
WALK = {
    "hip": ((0.0, 30), (0.1, 25), (0.3, 5), (0.5, -10), (0.6, -4), (0.72, 14), (0.85, 32), (0.95, 32)),
    "knee": ((0.0, 5), (0.14, 18), (0.26, 12), (0.4, 5), (0.5, 12), (0.62, 40), (0.72, 61), (0.82, 42), (0.95, 5)),
    "ankle": ((0.0, 0), (0.07, -6), (0.3, 7), (0.46, 12), (0.62, -17), (0.74, -2), (0.9, 2)),
}
RUN = {
    "hip": ((0.0, 38), (0.15, 22), (0.35, -8), (0.45, -6), (0.7, 38), (0.82, 45), (0.93, 41)),
    "knee": ((0.0, 14), (0.15, 44), (0.34, 18), (0.5, 55), (0.66, 88), (0.8, 56), (0.94, 14)),
    "ankle": ((0.0, 6), (0.18, 26), (0.38, -22), (0.55, -5), (0.8, 4)),
}
ARM_WALK = {"hip": ((0.0, -18), (0.25, 0), (0.5, 20), (0.75, 2)), "knee": ((0.0, 18), (0.25, 22), (0.55, 38), (0.8, 26))}
ARM_RUN = {"hip": ((0.0, -42), (0.25, -5), (0.5, 24), (0.75, -5)), "knee": ((0.0, 98), (0.25, 85), (0.5, 72), (0.75, 90))}


@dataclass(frozen=True)
class Activity:
    """How a person moves. Amplitudes are rms, or half of a range where that is said."""

    skin: float  # times OCTAVES_DEG
    out_of_plane_deg: float  # abduction and rotation together
    cycle_hz: float = 0.0  # strides or repetitions
    gait: bool = False
    seated: bool = False  # the proximal segment lies still, the distal one swings by bend_deg
    bend_deg: tuple[float, float] = (0.0, 0.0)  # pitch and flexion between standing and the deepest pose
    free_deg: tuple[float, float, float] = (0.0, 0.0, 0.0)  # noise of roll, pitch, flexion
    free_hz: tuple[float, float] = (0.1, 1.2)
    turning_deg: float = 0.0  # noise of the heading
    base_m: tuple[float, float, float] = (0.0, 0.0, 0.0)  # amplitudes of the hip's path in gait
    drift_m_s2: float = 0.0  # noise of the hip's acceleration
    ringing_deg: float = 0.0  # skin after heel strikes
    jolt_m_s2: float = 0.0  # bones after heel strikes
    turn_deg: float = 0.0  # noise of the distal segment's turning about its own line, as a forearm does


ACTIVITIES = {
    "walk": Activity(1.0, 4.0, 0.92, gait=True, turning_deg=50.0, base_m=(0.011, 0.02, 0.02), drift_m_s2=0.4,
                     ringing_deg=0.4, jolt_m_s2=1.5),
    "run": Activity(2.0, 8.0, 1.38, gait=True, turning_deg=50.0, base_m=(0.010, 0.02, 0.034), drift_m_s2=0.8,
                    ringing_deg=2.2, jolt_m_s2=3.5),
    "sit_to_stand": Activity(0.5, 3.0, 0.25, bend_deg=(-80.0, 98.0), free_deg=(1.0, 1.0, 1.0), turning_deg=2.0, drift_m_s2=0.1),
    "squat": Activity(0.7, 3.5, 0.4, bend_deg=(-85.0, 110.0), free_deg=(2.0, 1.5, 1.5), turning_deg=4.0, drift_m_s2=0.2),
    "slow_squat": Activity(0.4, 2.5, 0.12, bend_deg=(-60.0, 80.0), free_deg=(1.0, 1.0, 1.0), free_hz=(0.05, 0.3), turning_deg=2.0, drift_m_s2=0.03),
    "swing": Activity(0.2, 1.5, 0.7, seated=True, bend_deg=(-85.0, 40.0), free_deg=(0.2, 0.3, 3.0), turning_deg=0.3, drift_m_s2=0.03),
    "random": Activity(1.0, 4.0, free_deg=(10.0, 18.0, 22.0), turning_deg=35.0, drift_m_s2=1.5),
    "bend": Activity(0.5, 2.0, free_deg=(6.0, 10.0, 40.0), free_hz=(0.2, 0.8), turning_deg=15.0, drift_m_s2=1.0),
    "turn": Activity(0.5, 2.0, free_deg=(5.0, 8.0, 3.0), free_hz=(0.2, 0.8), turning_deg=15.0, drift_m_s2=1.0, turn_deg=40.0),
    "bend_and_turn": Activity(0.5, 2.0, free_deg=(6.0, 10.0, 20.0), free_hz=(0.05, 0.4), turning_deg=15.0, drift_m_s2=1.0, turn_deg=25.0),
    "carried_turn": Activity(0.5, 0.3, free_deg=(0.1, 0.1, 0.1), free_hz=(0.2, 0.8), turning_deg=0.3, drift_m_s2=1.5, turn_deg=40.0),
    "stand": Activity(0.1, 0.3, free_deg=(0.3, 0.4, 0.5), free_hz=(0.1, 1.0), turning_deg=0.5, drift_m_s2=0.05),
}
JOINT_OUT_OF_PLANE = {"knee": 1.0, "ankle": 0.7, "elbow": 0.5}
JOINT_SKIN = {"knee": 1.0, "ankle": 1.0, "elbow": 0.5}
RANDOM_MEAN_DEG = {"knee": 45.0, "ankle": 0.0, "elbow": 70.0}  # flexion in random motion
# Joint to sensor in segment frames, m: the middle, and how far off it may be.
PLACES = {
    "knee": (((0.02, 0.06, 0.20), (0.04, 0.02, 0.06)), ((0.02, 0.04, -0.20), (0.02, 0.02, 0.06))),
    "ankle": (((0.02, 0.03, 0.20), (0.02, 0.02, 0.06)), ((0.10, 0.0, -0.03), (0.03, 0.02, 0.015))),
    "elbow": (((0.02, 0.05, 0.14), (0.02, 0.02, 0.03)), ((0.01, 0.04, -0.22), (0.02, 0.02, 0.04))),
}


@dataclass(frozen=True)
class PersonSpec:
    """What to simulate. The same spec gives the same recording."""

    activities: tuple[tuple[str, float], ...] = (("walk", 30.0),)  # (name in ACTIVITIES, seconds)
    joint: str = "knee"
    rate_hz: float = 100.0
    seed: int = 0
    skin: float = 1.0  # times what belongs to the activity and the joint; 0: rigid mount
    out_of_plane: float = 1.0  # times what belongs to the activity; 0: an exact hinge
    loop: float = 0.0  # share of its power that is the same in every cycle
    in_phase: float | None = None  # share of the proximal segment's rotation; None: random within IN_PHASE, times skin
    bending_deg: float | None = None  # range of flexion from the least to the largest; None: the activity's
    stiff: bool = False  # a splint: no relative motion of the bones
    lag_s: float = 0.0  # sensor 2 tells what was so long ago
    noise_scale: float = 1.0  # times the standard deviations of simulate.py
    gyr_bias_deg_s: float = 0.3  # magnitude; the direction is random per sensor
    acc_bias: float = 0.1  # m/s^2

    def __post_init__(self) -> None:
        if self.joint not in PLACES:
            raise ValueError(f"joint must be one of {', '.join(PLACES)}")
        for name, duration_s in self.activities:
            if name not in ACTIVITIES:
                raise ValueError(f"unknown activity '{name}'")
            if duration_s < 2.0 * BLEND_S:
                raise ValueError(f"an activity lasts at least {2.0 * BLEND_S:g} s")
        if not 0.0 <= self.loop <= 1.0:
            raise ValueError("loop must be within 0 and 1")
        if not RATE_RANGE_HZ[0] <= self.rate_hz <= RATE_RANGE_HZ[1]:
            raise ValueError("rate_hz must be within {:g} and {:g}".format(*RATE_RANGE_HZ))

    @property
    def duration_s(self) -> float:
        return sum(duration_s for _, duration_s in self.activities)


@dataclass
class PersonRecording(Recording):
    """A simulated recording with its truth; vectors in sensor frames, quaternions sensor to earth (z up)."""

    axis1: np.ndarray  # (3,) unit, y of the bone as mounted; both point the same way in space
    axis2: np.ndarray
    r1: np.ndarray  # (3,) joint to sensor, m, mean over skin
    r2: np.ndarray
    flexion_rad: np.ndarray  # (N,) of the bones
    abduction_rad: np.ndarray
    rotation_rad: np.ndarray
    heading_rad: np.ndarray  # (N,) yaw of the proximal segment
    center_m: np.ndarray  # (N, 3) joint centre, earth
    q1: np.ndarray  # (N, 4) w, x, y, z, with skin
    q2: np.ndarray  # late by lag_s, as sensor 2 is
    p1: np.ndarray  # (N, 3) sensor in earth, m, with skin
    p2: np.ndarray
    bone1: np.ndarray  # (N, 4) orientation of the bone as mounted: without skin
    bone2: np.ndarray
    turn_axis2: np.ndarray  # (3,) unit, about which the distal segment turns in activity "turn"
    turn_rad: np.ndarray  # (N,) how far
    spec: PersonSpec

    def extra_columns(self) -> dict[str, np.ndarray]:
        """Reference flexion in deg and true orientations, for a file."""
        columns = {"ref_flexion_deg": np.degrees(self.flexion_rad)}
        for index, q in ((1, self.q1), (2, self.q2)):
            columns |= {f"q{index}_{name}": column for name, column in zip("wxyz", q.T, strict=True)}
        return columns

    def truth(self) -> dict:
        """What a test wants to know besides the signals, ready for JSON."""
        return {"source": "simulated (simulate_people.py)", "rate_hz": self.spec.rate_hz,
                "axis1": self.axis1.tolist(), "axis2": self.axis2.tolist(), "turn_axis2": self.turn_axis2.tolist(),
                "joint_to_sensor1_m": self.r1.tolist(), "joint_to_sensor2_m": self.r2.tolist(), "spec": asdict(self.spec)}


# Motion of the bones.

@dataclass
class Motion:
    """Jets (N,) of the bones, deg turned into rad; what drives the skin beside them."""

    angles: dict[str, Jet]  # yaw, sway (of gait, without the heading), roll, pitch, flexion, lower, abduction, rotation, turn
    base: Jet  # (3, N) hip or shoulder in the frame that turns with the heading, m
    jolt: Jet  # (3, N) of the joint centre, m
    skin: Jet  # (N,) level
    ringing: Jet  # (N,) level, in bursts, rad


def pattern(points: tuple[tuple[float, float], ...]) -> np.ndarray:
    """Fourier coefficients (HARMONICS + 1,) of a periodic curve through points, rad; higher harmonics fade out."""
    share = np.arange(PATTERN_POINTS) / PATTERN_POINTS
    x, y = np.array(points).T
    curve = np.radians(np.interp(share, x, y, period=1.0))
    spectrum = np.fft.rfft(curve)[: HARMONICS + 1] / PATTERN_POINTS
    return spectrum * np.r_[1.0, 2.0 * np.exp(-0.5 * (np.arange(1, HARMONICS + 1) / 5.0) ** 2)]


def bursts(phase: Jet) -> Jet:
    """1 after each heel strike of the leg, a third after the other leg's, else near 0; scaled to an rms of 1."""
    own = jets.exp((jets.cos(phase - STRIKE_LAG_RAD) - 1.0) * STRIKE_SHARPNESS)
    other = jets.exp((jets.cos(phase - STRIKE_LAG_RAD - np.pi) - 1.0) * STRIKE_SHARPNESS)
    grid = np.linspace(0.0, 2.0 * np.pi, PATTERN_POINTS, endpoint=False)
    rms = np.sqrt(np.mean(np.exp(2.0 * STRIKE_SHARPNESS * (np.cos(grid) - 1.0))) * (1.0 + 1.0 / 9.0))
    return (own + other * (1.0 / 3.0)) * (1.0 / rms)


@dataclass(frozen=True)
class Cycle:
    """Of gait or of repetitions; where there is none the phase stands still."""

    phase: Jet
    loop: Jet  # in quadrature to flexion
    loop_share: float  # of the power of abduction and rotation


def rms_to(jet: Jet, rms: float) -> Jet:
    """The jet without its mean over time, scaled to an rms; zero if it does not move."""
    size = float(np.std(jet.value))
    return (jet - float(np.mean(jet.value))) * (rms / size if size > 0.0 else 0.0)


def gait_angles(rng: np.random.Generator, joint: str, name: str, phase: Jet) -> tuple[dict[str, Jet], Jet]:
    """Pitch, flexion and lower angle of one gait, and the flexion's quadrature."""
    if joint == "elbow":
        curves = ARM_RUN if name == "run" else ARM_WALK
    else:
        curves = RUN if name == "run" else WALK
    scale = {key: rng.uniform(0.85, 1.15) for key in ("hip", "knee", "ankle")}
    series = {key: pattern(points) * scale[key] for key, points in curves.items()}
    hip, knee = jets.harmonics(series["hip"], phase), jets.harmonics(series["knee"], phase)
    if joint == "ankle":
        foot = jets.harmonics(series["ankle"], phase)
        angles = {"pitch": knee - hip, "thigh": -hip, "flexion": -foot}
        main = -series["ankle"]
    else:
        angles = {"pitch": -hip, "flexion": knee}
        main = series["knee"]
    return angles, jets.harmonics(np.r_[0.0, 1j * main[1:]], phase)


def pose_angles(joint: str, activity: Activity, phase: Jet) -> tuple[dict[str, Jet], Jet]:
    """The same of repetitions between standing and a deep pose, feet on the ground (arms follow a little), or seated."""
    pitch, bend = np.radians(activity.bend_deg)
    if activity.seated:
        still = jets.constant(pitch, phase.value.shape[-1])
        return {"pitch": still, "thigh": still, "flexion": jets.sin(phase) * bend + 0.8}, jets.cos(phase)
    depth = jets.logistic(jets.sin(phase) * 4.0 - 0.5)
    # In quadrature: the loop runs ahead on the way down and behind on the way up.
    loop = jets.cos(phase)
    if joint == "elbow":
        return {"pitch": depth * -0.5, "flexion": depth * 0.6 + 0.4}, loop
    if joint == "ankle":
        return {"pitch": depth * (pitch + bend), "thigh": depth * pitch, "flexion": depth * -(pitch + bend)}, loop
    return {"pitch": depth * pitch, "flexion": depth * bend}, loop


def hip_over_foot(joint: str, angles: dict[str, Jet], count: int) -> Jet:
    """Path (3, N) of the hip over a foot that stands still, less its height in standing."""
    zero = jets.constant(0.0, count)
    if joint == "elbow":
        return jets.stack([zero, zero, angles["pitch"] * 0.3])
    thigh, shank = ((angles["thigh"], angles["pitch"]) if joint == "ankle"
                    else (angles["pitch"], angles["pitch"] + angles["flexion"]))
    length = SEGMENT_M["knee"]
    x, z = ((f(thigh) + f(shank)) * length for f in (jets.sin, jets.cos))
    return jets.stack([x, zero, z - 2.0 * length])


def one_activity(spec: PersonSpec, name: str, index: int, clock: Clock) -> Motion:
    """An activity as if it lasted for the whole recording."""
    activity = ACTIVITIES[name]
    rng = np.random.default_rng([spec.seed, 2, index])

    def wander(band_hz: tuple[float, float], deg: float, rows: int = 1) -> Jet:
        return jets.noise(rng, clock, band_hz, rows) * np.radians(deg)

    pace_hz = activity.cycle_hz * rng.uniform(0.9, 1.1)
    phase = jets.line(clock, 2.0 * np.pi * pace_hz, rng.uniform(0.0, 2.0 * np.pi)) + wander((0.03, 0.3), 12.0)[0]
    zero = jets.constant(0.0, clock.size)
    sway, roll, base, strikes = zero, zero, jets.stack([zero] * 3), zero
    if activity.gait:
        angles, loop = gait_angles(rng, spec.joint, name, phase)
        effort = jets.noise(rng, clock, (0.05, 0.4), 1)[0] * 0.05 + 1.0
        angles = {key: angle * effort for key, angle in angles.items()}
        tilts = rng.uniform(0.0, 2.0 * np.pi, 5)
        sway = jets.sin(phase + tilts[0]) * np.radians(5.0)
        roll = jets.sin(phase + tilts[1]) * np.radians(3.0)
        x, y, z = activity.base_m
        base = jets.stack([jets.sin(phase * 2.0 + tilts[2]) * x, jets.sin(phase + tilts[3]) * y,
                           jets.cos(phase * 2.0 - 0.9 + 0.3 * tilts[4] / np.pi) * -z])
        strikes = bursts(phase)
    elif activity.cycle_hz > 0.0:
        angles, loop = pose_angles(spec.joint, activity, phase)
        base = base if activity.seated else hip_over_foot(spec.joint, angles, clock.size)
    else:
        mean = np.radians(RANDOM_MEAN_DEG[spec.joint] if name in ("random", "bend", "turn") else 5.0)
        angles, loop = {"pitch": zero, "thigh": zero, "flexion": zero + mean}, zero
    low_hz, high_hz = activity.free_hz
    free = wander((low_hz, high_hz), 1.7, 3) + wander((high_hz, 3.0 * high_hz), 0.2, 3)  # 1 deg each
    free_roll, free_pitch, free_flexion = (free[k] * activity.free_deg[k] for k in range(3))
    flexion = angles["flexion"] + free_flexion * (0.4 if spec.joint == "ankle" else 1.0)
    sideways = out_of_plane(rng, clock, activity.out_of_plane_deg, Cycle(phase, loop, spec.loop), flexion)
    turning = wander(TURNING_HZ, activity.turning_deg)[0]
    drift = jets.noise(rng, clock, (0.3, 3.0), 3, order=2) * activity.drift_m_s2
    jolt = jets.noise(rng, clock, JOLT_HZ, 3, order=2) * strikes * activity.jolt_m_s2
    level = jets.constant(activity.skin, clock.size)
    turn = wander((low_hz, high_hz), activity.turn_deg)[0] if activity.turn_deg > 0.0 else zero
    return Motion({"yaw": turning, "sway": sway, "roll": roll + free_roll, "pitch": angles["pitch"] + free_pitch,
                   "thigh": angles.get("thigh", zero), "flexion": flexion, "abduction": sideways[0], "rotation": sideways[1],
                   "turn": turn},
                  base + drift, jolt, level, strikes * np.radians(activity.ringing_deg))


def out_of_plane(rng: np.random.Generator, clock: Clock, size_deg: float, cycle: Cycle, flexion: Jet) -> list[Jet]:
    """Abduction and rotation, `size_deg` rms together: a share of the power a loop over the cycle, the rest noise."""
    share = np.sqrt(cycle.loop_share) if np.std(cycle.loop.value) > 0.0 else 0.0
    split, signs = rng.uniform(0.35, 0.65), rng.choice([-1.0, 1.0], 2)
    found = []
    for k, part in enumerate((split, 1.0 - split)):
        rms = np.radians(size_deg) * np.sqrt(part)
        own = jets.noise(rng, clock, OUT_OF_PLANE_HZ, 1)[0] * (jets.cos(cycle.phase + rng.uniform(0.0, 2.0 * np.pi)) * CYCLE_DEPTH + 1.0)
        # What goes with the rate of flexion would tilt the axis.
        along = float(np.mean(own.rate * flexion.rate) / max(np.mean(flexion.rate**2), 1e-12))
        own = rms_to(own - (flexion - float(np.mean(flexion.value))) * along, rms * np.sqrt(1.0 - share**2))
        found.append(rms_to(cycle.loop, signs[k] * rms * share) + own)
    return found


def windows(spec: PersonSpec, clock: Clock) -> list[Jet]:
    """One window per activity, with smooth ramps of BLEND_S; their sum is one."""
    edges = np.cumsum([duration_s for _, duration_s in spec.activities])[:-1]
    rises = []
    for edge in edges:
        x = jets.line(clock, 1.0 / BLEND_S, 0.5 - edge / BLEND_S)
        inside = (x.value > 0.0) & (x.value < 1.0)
        steps = [np.where(inside, SMOOTH_STEP.deriv(k)(np.clip(x.value, 0.0, 1.0)), 0.0) for k in range(3)]
        rises.append(x.then(steps[0] + (x.value >= 1.0), steps[1], steps[2]))
    one = jets.constant(1.0, clock.size)
    return [first - later for first, later in zip([one, *rises], [*rises, one * 0.0], strict=True)]


def blend(parts: list[Motion], shares: list[Jet]) -> Motion:
    def mixed(select) -> Jet:
        return sum((select(part) * share for part, share in zip(parts[1:], shares[1:], strict=True)),
                   select(parts[0]) * shares[0])

    angles = {key: mixed(lambda part, key=key: part.angles[key]) for key in parts[0].angles}
    return Motion(angles, mixed(lambda p: p.base), mixed(lambda p: p.jolt), mixed(lambda p: p.skin), mixed(lambda p: p.ringing))


def move(spec: PersonSpec, clock: Clock) -> Motion:
    """The bones' motion over all activities, with what the spec asks for."""
    parts = [one_activity(spec, name, k, clock) for k, (name, _) in enumerate(spec.activities)]
    motion = blend(parts, windows(spec, clock))
    angles = motion.angles
    angles["yaw"] = angles["yaw"] + np.random.default_rng([spec.seed, 1]).uniform(-np.pi, np.pi)
    for key in ("abduction", "rotation"):
        angles[key] = angles[key] * (0.0 if spec.stiff else spec.out_of_plane * JOINT_OUT_OF_PLANE[spec.joint])
    flexion = angles["flexion"]
    mean, reach = float(np.mean(flexion.value)), float(np.ptp(flexion.value))
    if spec.stiff:
        angles["flexion"] = jets.constant(mean, clock.size)
    elif spec.bending_deg is not None:
        angles["flexion"] = (flexion - mean) * (np.radians(spec.bending_deg) / max(reach, 1e-9)) + mean
    return motion


@dataclass
class Bones:
    rotation1: Jet  # (3, 3, N) segment to earth
    rotation2: Jet
    center: Jet  # (3, N) joint centre in earth


def bones(spec: PersonSpec, motion: Motion) -> Bones:
    a = motion.angles
    heading = jets.turn(2, a["yaw"])
    upright = jets.times(jets.times(heading, jets.turn(2, a["sway"])), jets.turn(0, a["roll"]))
    rotation1 = jets.times(upright, jets.turn(1, a["pitch"]))
    rotation2 = jets.times(rotation1, jets.turn(1, a["flexion"]))
    rotation2 = jets.times(jets.times(rotation2, jets.turn(0, a["abduction"])), jets.turn(2, a["rotation"] + a["turn"]))
    down = -rotation1[:, 2] * SEGMENT_M[spec.joint]
    if spec.joint == "ankle":
        down = down - jets.times(upright, jets.turn(1, a["thigh"]))[:, 2] * SEGMENT_M["knee"]
    return Bones(rotation1, rotation2, jets.times(heading, motion.base) + motion.jolt + down)


# Skin and sensors.

def skin_turn(spec: PersonSpec, index: int, clock: Clock, motion: Motion) -> Jet:
    """rho (3, N), rad: small angles about x, y, z of the bone."""
    amount = spec.skin * JOINT_SKIN[spec.joint]
    if amount == 0.0 and not spec.in_phase:
        return jets.stack([jets.constant(0.0, clock.size)] * 3)
    rng = np.random.default_rng([spec.seed, 4, index])
    rho = jets.noise(rng, clock, RINGING_HZ, 3) * motion.ringing
    for k, deg in enumerate(OCTAVES_DEG):
        low_hz = FIRST_OCTAVE_HZ * 2.0**k
        rho = rho + jets.noise(rng, clock, (low_hz, 2.0 * low_hz), 3) * motion.skin * np.radians(deg)
    rho = jets.stack([rho[i] * (amount * share) for i, share in enumerate(SKIN_SHAPE)])
    if index == 0:
        share = rng.uniform(*IN_PHASE) * min(spec.skin, 1.0) if spec.in_phase is None else spec.in_phase
        own = [motion.angles[key] for key in ("roll", "pitch", "sway")]
        rho = rho - jets.stack([angle - float(np.mean(angle.value)) for angle in own]) * share
    return rho


@dataclass
class Sensed:
    gyr: np.ndarray  # (N, 3)
    acc: np.ndarray
    q: np.ndarray  # (N, 4)
    bone: np.ndarray  # (N, 4), as mounted
    p: np.ndarray  # (N, 3)
    axis: np.ndarray  # (3,)
    line: np.ndarray  # (3,) along the bone, up
    r: np.ndarray  # (3,)


def quaternions(rotation: np.ndarray) -> np.ndarray:
    """(N, 4) of matrices (3, 3, N): the largest of four equivalent forms."""
    (a, b, c), (d, e, f), (g, h, i) = rotation
    forms = np.array([[1 + a + e + i, h - f, c - g, d - b], [h - f, 1 + a - e - i, b + d, c + g],
                      [c - g, b + d, 1 - a + e - i, f + h], [d - b, c + g, f + h, 1 - a - e + i]])
    best = np.argmax(np.array([forms[k, k] for k in range(4)]), axis=0)
    q = forms[best, :, np.arange(rotation.shape[2])]
    return q / np.linalg.norm(q, axis=1, keepdims=True)


def sense(spec: PersonSpec, index: int, clock: Clock, motion: Motion) -> Sensed:
    """Sensor `index` (0, 1) without bias and noise, at all instants of `clock`."""
    body = bones(spec, motion)
    rotation = (body.rotation1, body.rotation2)[index]
    rng = np.random.default_rng([spec.seed, 3, index])
    mount = rotation_matrix(random_unit(rng, 4))  # sensor to bone
    middle, spread = (np.array(part) for part in PLACES[spec.joint][index])
    r = middle + spread * rng.uniform(-1.0, 1.0, 3)
    skin_lever = random_unit(rng) * rng.uniform(*SKIN_LEVER_M)
    rho = skin_turn(spec, index, clock, motion)
    turned = jets.times(jets.times(jets.turn(0, rho[0]), jets.turn(1, rho[1])), jets.turn(2, rho[2]))
    sensor = jets.times(rotation, turned)
    slide = Jet(*(np.cross(part.T, skin_lever).T for part in rho.parts))
    place = body.center + jets.times(rotation, slide + r[:, None])
    force = jets.into_body(sensor, place.accel + np.array([[0.0], [0.0], [GRAVITY_M_S2]]))
    q, bone = (quaternions(np.einsum("ijn,jk->ikn", jet.value, mount)) for jet in (sensor, rotation))
    return Sensed((mount.T @ jets.body_rate(sensor)).T, (mount.T @ force).T, q, bone, place.value.T,
                  mount.T @ [0.0, 1.0, 0.0], mount.T @ [0.0, 0.0, 1.0], mount.T @ r)


def read_out(spec: PersonSpec, index: int, sensed: Sensed, rows: slice) -> Sensed:
    """The rows of a sensor's own instants, with bias and noise."""
    rng = np.random.default_rng([spec.seed, 5, index])
    bias_gyr, bias_acc = np.radians(spec.gyr_bias_deg_s) * random_unit(rng), spec.acc_bias * random_unit(rng)
    gyr, acc = sensed.gyr[rows], sensed.acc[rows]
    noise = spec.noise_scale * rng.standard_normal((2, *gyr.shape))
    return replace(sensed, gyr=gyr + bias_gyr + GYR_STD_RAD_S * noise[0], acc=acc + bias_acc + ACC_STD_M_S2 * noise[1],
                   q=sensed.q[rows], bone=sensed.bone[rows], p=sensed.p[rows])


def simulate_person(spec: PersonSpec) -> PersonRecording:
    """Simulate the recording that `spec` describes."""
    count = round(spec.duration_s * spec.rate_hz)
    clock = Clock(count, spec.rate_hz, (0.0, spec.lag_s) if spec.lag_s else (0.0,))
    motion = move(spec, clock)
    now, late = slice(0, count), slice(clock.size - count, clock.size)
    one, two = (read_out(spec, index, sense(spec, index, clock, motion), rows) for index, rows in enumerate((now, late)))
    a = motion.angles
    return PersonRecording(clock.t_s[now], one.gyr, one.acc, two.gyr, two.acc, one.axis, two.axis, one.r, two.r,
                           a["flexion"].value[now], a["abduction"].value[now], a["rotation"].value[now],
                           (a["yaw"] + a["sway"]).value[now], bones(spec, motion).center.value.T[now],
                           one.q, two.q, one.p, two.p, one.bone, two.bone, two.line,
                           a["turn"].value[now], spec)


def main_axes(rec: PersonRecording) -> tuple[np.ndarray, np.ndarray]:
    """Main axes (3,), (3,) in sensor frames of the bones' relative rate: what the motion itself made of the axis.

    They differ from axis1 and axis2 by what little of abduction and rotation goes with flexion.
    """
    r1, r2 = (quat.matrices(q) for q in (rec.bone1, rec.bone2))
    relative = np.einsum("nji,njk->nik", r1, r2)
    step = quat.rotation_vectors(quat.multiply(quat.conjugate(rec.bone2[:-1]), rec.bone2[1:]))
    step1 = quat.rotation_vectors(quat.multiply(quat.conjugate(rec.bone1[:-1]), rec.bone1[1:]))
    own = step - np.einsum("nji,nj->ni", relative[:-1], step1)
    seen = np.einsum("nij,nj->ni", relative[:-1], own)
    found = []
    for rates, axis in ((seen, rec.axis1), (own, rec.axis2)):
        main = np.linalg.eigh(rates.T @ rates)[1][:, -1]
        found.append(main * np.sign(main @ axis))
    return found[0], found[1]
