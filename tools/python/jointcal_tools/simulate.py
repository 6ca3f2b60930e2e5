"""Simulator of a hinge joint that carries one IMU on each segment.

Kinematics. The orientation of segment i (segment to earth, earth z up) is

    R_i(t) = Rz(yaw) Rx(tilt) Ry(psi_i),    theta = psi_2 - psi_1,

so both segments share the hinge axis (their own y axis), `tilt` is its elevation
above the horizontal, and any motion of a hinge can be written like this. The four
angles are smooth functions with exact first and second derivatives (band-limited
noise, differentiated in its spectrum, times polynomial windows). Rates and
accelerations follow from the chain of rotations without numerical differences.

Concatenation. The motions of OLS20 section 7.1 are blended: between two motions the
angles pass smoothly from one to the other within `blend_s` (motion_id 0). With
`keep_transitions=False` those samples are removed as in the paper and time is
counted anew; then the signals jump where one motion meets the next. Motions 1, 2, 8
and 9 keep the joint angle that went before, so no transition between them turns the
joint.

Soft tissue. Sensor i is turned against its bone by a rotation vector rho_i(t) about
its own origin: the gyroscope feels the rate of rho, gyroscope and accelerometer are
turned, and the origin moves with the bone. The true axes belong to rho = 0.

Sensor model: OLS20 eq. (1), (3), (4); default noise: OLS17 section IV B.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass

import numpy as np
from numpy.polynomial import Polynomial

from .recordings import Recording

GRAVITY_M_S2 = 9.81
ACC_STD_M_S2 = 1e-2 ** 0.5  # OLS17: variance 1e-2 m^2/s^4
GYR_STD_RAD_S = 1e-5 ** 0.5  # OLS17: variance 1e-5 rad^2/s^2
SOFT_TISSUE_BAND_HZ = (0.5, 4.0)
WOBBLE_BAND_HZ = (0.05, 0.5)
A0_BAND_HZ = (0.2, 3.0)
INERTIA_CUTOFF_HZ = 3.0  # skin follows the bone's angular acceleration up to here
ACTIVITY_RAD_S = 0.3  # bone rate at which the random soft-tissue motion has half its variance scale
ACTIVITY_CUTOFF_HZ = 0.5
REST_SOFT_TISSUE = 0.1  # share of the random soft-tissue motion that is left at rest
QUIET_RAD_S2 = 5.0  # below this rms angular acceleration the inertial wobble is not scaled up further
SMOOTH_STEP = Polynomial([0, 0, 0, 0, 35, -84, 70, -20])  # 0 to 1 on [0, 1] with three vanishing derivatives


@dataclass(frozen=True)
class Motion:
    """One kind of motion. Shares are fractions of the speed (rms rad/s)."""

    id: int
    turn1: float = 0.0  # share of psi_1
    turn2: float = 0.0  # share of psi_2 (of the common angle when stiff)
    axis: float = 0.0  # share of yaw and of tilt: a free joint axis
    tilt_deg: float | None = None  # mean elevation of the axis; None: keep what went before
    stiff: bool = False
    fast: bool = False
    held: bool = True  # by hand: the nominally fixed axis wanders
    carried: bool = False  # the joint centre is accelerated
    paused: bool = False  # bursts and pauses as in daily life


def build_motions() -> dict[str, Motion]:
    """The motions by name; '3a' and '3b' are the two halves of the sequential '3'."""
    motions: dict[str, Motion] = {}
    for first, fast in ((1, False), (8, True)):
        for offset, tilt_deg in ((2, 0.0), (3, 45.0)):
            number = first + offset
            motions[f"{number}a"] = Motion(number, turn1=1.0, tilt_deg=tilt_deg, fast=fast)
            motions[f"{number}b"] = Motion(number, turn2=1.0, tilt_deg=tilt_deg, fast=fast)
            number += 2
            motions[str(number)] = Motion(number, 1.0, 1.0, tilt_deg=tilt_deg, fast=fast, carried=True)
        motions[str(first)] = Motion(first, fast=fast, held=False)
        motions[str(first + 1)] = Motion(first + 1, turn2=0.7, axis=0.5, tilt_deg=0.0, stiff=True, fast=fast,
                                         held=False, carried=True)
        motions[str(first + 6)] = Motion(first + 6, 0.7, 0.7, 0.5, tilt_deg=0.0, fast=fast, held=False, carried=True)
    motions["daily"] = Motion(15, 0.7, 0.7, 0.5, tilt_deg=0.0, held=False, carried=True, paused=True)
    # Motions that never determine both axes.
    motions["rest"] = motions["1"]
    motions["stiff"] = motions["2"]
    motions["rest1"] = Motion(16, turn2=1.0, held=False)
    motions["rest2"] = Motion(17, turn1=1.0, held=False)
    return motions


MOTIONS = build_motions()
SEQUENTIAL = ("3", "4", "10", "11")


def scenario(number: int, motion_s: float = 20.0) -> tuple[tuple[str, float], ...]:
    """Scenario 1 to 4 of OLS20 7.1; a whole motion lasts `motion_s` (about 50 s in the paper)."""
    half = motion_s / 2
    if number == 1:
        return tuple((str(k), motion_s) for k in range(1, 15))
    if number == 2:  # 500 samples at 50 Hz of the motions 3 and 10, segment 1 only
        later = ("8", "2", "9", "3", "10", "4", "11", "5", "12", "6", "13", "7", "14")
        return (("1", motion_s), ("3a", 10.0), ("10a", 10.0)) + tuple((name, motion_s) for name in later)
    if number == 3:  # 1000 samples at 50 Hz of motion 6
        return (("6", 20.0),) + tuple((name, motion_s) for name in ("1", "8", "2", "9"))
    if number == 4:
        return (("1", motion_s), ("8", motion_s), ("2", half), ("9", half), ("6", 20.0), ("2", half), ("9", half))
    raise ValueError("scenario must be 1, 2, 3 or 4")


@dataclass(frozen=True)
class HingeSpec:
    """What to simulate. The same spec gives the same recording."""

    motions: tuple[tuple[str, float], ...] = (("7", 30.0),)  # (name in MOTIONS or SEQUENTIAL, seconds)
    rate_hz: float = 100.0
    seed: int = 0
    noise_scale: float = 1.0  # times the standard deviations above
    acc_bias: float = 0.0  # m/s^2, magnitude; the direction is random per sensor
    gyr_bias_deg_s: float = 0.0
    soft_tissue_deg: float = 0.0  # rms of the random part of rho while moving, all three components together
    inertia_ratio: float = 1.0  # rms of the inertial part of rho over that of the random part
    wobble_deg: float = 2.0  # rms wander of the nominally fixed axis; 0: exactly planar
    speed: float = 1.5  # rms rad/s of a normal motion
    fast_factor: float = 2.5  # motions 8 to 14 over 1 to 7
    a0_rms: float = 1.0  # m/s^2, all three components together
    lever_m: tuple[float, float] = (0.05, 0.3)  # range of |r1|, |r2|
    r1: tuple[float, float, float] | None = None  # joint to sensor, overrides the random one
    r2: tuple[float, float, float] | None = None
    blend_s: float = 1.0
    keep_transitions: bool = True

    def __post_init__(self) -> None:
        if not 25.0 <= self.rate_hz <= 200.0:
            raise ValueError("rate_hz must be within 25 and 200")
        for name, duration_s in self.motions:
            if name not in MOTIONS and name not in SEQUENTIAL:
                raise ValueError(f"unknown motion '{name}'")
            if duration_s < 1.0:
                raise ValueError("a motion lasts at least 1 s")


@dataclass
class HingeRecording(Recording):
    """A simulated recording with its truth; vectors (N, 3) in sensor frames, quaternions sensor to earth."""

    axis1: np.ndarray  # (3,) unit, same joint direction as axis2
    axis2: np.ndarray
    r1: np.ndarray  # (3,) joint to sensor, sensor frame, m
    r2: np.ndarray
    theta: np.ndarray  # (N,) joint angle psi_2 - psi_1, rad
    q1: np.ndarray  # (N, 4) w, x, y, z, soft tissue included
    q2: np.ndarray
    motion_id: np.ndarray  # (N,) 1..14 as in OLS20, 15 and more see MOTIONS, 0 in transitions
    spec: HingeSpec

    def truth(self) -> dict:
        """What a test wants to know besides the signals, ready for JSON."""
        edges = np.flatnonzero(np.diff(self.motion_id)) + 1
        parts = zip(np.r_[0, edges], np.r_[edges, len(self)], strict=True)
        return {
            "source": "simulated (tools/simulate.py)",
            "rate_hz": self.spec.rate_hz,
            "axis1": self.axis1.tolist(), "axis2": self.axis2.tolist(),
            "joint_to_sensor1_m": self.r1.tolist(), "joint_to_sensor2_m": self.r2.tolist(),
            "motions": [{"id": int(self.motion_id[a]), "from_s": float(self.t_s[a]), "to_s": float(self.t_s[b - 1])}
                        for a, b in parts],
            "spec": asdict(self.spec),
        }


# Signals. Inside, vectors are (3, N) and quaternions (4, N): contiguous components are fast.

def smooth_noise(rng: np.random.Generator, n: int, rate_hz: float, band_hz: tuple[float, float], rows: int,
                 unit: int = 0, orders: int = 1) -> list[np.ndarray]:
    """Band-limited noise (rows, n) and its derivatives up to `orders`, exact; derivative `unit` has rms 1."""
    period_s = np.ceil(n / rate_hz + 1.0)  # whole seconds: the same seed is the same motion at every whole rate
    length = round(period_s * rate_hz)
    low = max(1, int(np.ceil(band_hz[0] * period_s)))
    high = max(low + 1, int(band_hz[1] * period_s))
    bins = np.arange(low, min(high, length // 2 - 1) + 1)
    draws = rng.standard_normal((high - low + 1, 2, rows))[: len(bins)]
    i_omega = 2j * np.pi * bins * rate_hz / length
    spectrum = np.zeros((orders + 1, rows, length // 2 + 1), complex)
    for order in range(orders + 1):
        # Derivative `unit` has a flat spectrum.
        spectrum[order][:, bins] = (draws[:, 0] + 1j * draws[:, 1]).T * i_omega ** (order - unit)
    signals = np.fft.irfft(spectrum, length)[:, :, :n]
    scale = 1.0 / np.sqrt(np.mean(signals[unit] ** 2, axis=1))
    return [signal * scale[:, None] for signal in signals]


def gauss_smooth(signal: np.ndarray, rate_hz: float, cutoff_hz: float) -> tuple[np.ndarray, np.ndarray]:
    """Gaussian low-pass (-3 dB at `cutoff_hz`) of (rows, N) and its exact time derivative.

    The result is sum_k signal_k g(t - t_k), a smooth function of t, so its
    derivative is the sum with g'.
    """
    sigma_s = np.sqrt(np.log(2.0)) / (2.0 * np.pi * cutoff_hz)
    half = int(np.ceil(5.0 * sigma_s * rate_hz))
    t_s = np.arange(-half, half + 1) / rate_hz
    kernel = np.exp(-0.5 * (t_s / sigma_s) ** 2)
    kernel /= kernel.sum()
    padded = np.pad(signal, ((0, 0), (half, half)), mode="edge")
    smooth = np.array([np.convolve(row, kernel, "valid") for row in padded])
    slope = np.array([np.convolve(row, -t_s / sigma_s**2 * kernel, "valid") for row in padded])
    return smooth, slope


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Cross product of (3, N) with (3, N) or (3, 1)."""
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


def quat_mul(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Hamilton product of (4, N) or (4, 1) quaternions w, x, y, z."""
    vector = p[0] * q[1:] + q[0] * p[1:] + cross(p[1:], q[1:])
    return np.concatenate([(p[0] * q[0] - (p[1:] * q[1:]).sum(axis=0))[None], vector])


def elementary_quat(axis: int, angle: np.ndarray) -> np.ndarray:
    """Rotation by `angle` (N,) about coordinate axis 0, 1 or 2, as (4, N)."""
    q = np.zeros((4, len(angle)))
    q[0], q[1 + axis] = np.cos(angle / 2), np.sin(angle / 2)
    return q


def rotation_matrix(q: np.ndarray) -> np.ndarray:
    """Matrix of a unit quaternion (4,): frame to earth."""
    w, x, y, z = q
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


# Motion: the four angles yaw, tilt, psi_1, psi_2.

@dataclass
class Angles:
    """yaw, tilt, psi_1, psi_2 (4, N) with derivatives, and the joint centre's acceleration (3, N) in earth."""

    value: np.ndarray
    rate: np.ndarray
    accel: np.ndarray
    a0: np.ndarray
    motion_id: np.ndarray


def motion_angles(motion: Motion, spec: HingeSpec, pose: np.ndarray, rng: np.random.Generator,
                  n: int) -> list[np.ndarray]:
    """Angles of one motion about the mean pose (4,): [value, rate, accel], each (4, n)."""
    speed = spec.speed * (spec.fast_factor if motion.fast else 1.0)
    # Faster motions have higher frequencies; the range of the angles stays about the same.
    pace = np.clip(speed / 1.5, 0.5, 3.0)
    turning = smooth_noise(rng, n, spec.rate_hz, (0.1 * pace, 0.8 * pace), 4, unit=1, orders=2)
    wander = smooth_noise(rng, n, spec.rate_hz, WOBBLE_BAND_HZ, 2, orders=2)
    share = speed * np.array([motion.axis, motion.axis, motion.turn1, motion.turn2])
    angles = [share[:, None] * part for part in turning]
    if motion.stiff:
        for part in angles:
            part[2] = part[3]
    if motion.paused:
        angles = modulate(angles, *burst_window(rng, n, spec.rate_hz))
    if motion.held:
        for part, extra in zip(angles, wander, strict=True):
            part[:2] += np.radians(spec.wobble_deg) / np.sqrt(2.0) * extra
    angles[0] = angles[0] + pose[:, None]
    return angles


def modulate(f: list[np.ndarray], m: np.ndarray, dm: np.ndarray, ddm: np.ndarray) -> list[np.ndarray]:
    """Product of f = [value, rate, accel] with the window m, by the product rule."""
    return [m * f[0], m * f[1] + dm * f[0], m * f[2] + 2.0 * dm * f[1] + ddm * f[0]]


def burst_window(rng: np.random.Generator, n: int, rate_hz: float) -> list[np.ndarray]:
    """Window between 0 (pause) and about 1.2 (burst) with derivatives: a logistic function of slow noise."""
    x, dx, ddx = (part[0] for part in smooth_noise(rng, n, rate_hz, (0.03, 0.25), 1, orders=2))
    y = 1.0 / (1.0 + np.exp(-3.0 * x))
    slope = 3.0 * y * (1.0 - y)
    bend = 3.0 * slope * (1.0 - 2.0 * y)
    return [1.2 * y, 1.2 * slope * dx, 1.2 * (slope * ddx + bend * dx**2)]


def blend_window(n: int, rise: int, fall: int, rate_hz: float) -> list[np.ndarray]:
    """Window of n samples with smooth ramps of `rise` and `fall` samples, and its two derivatives."""
    window = [np.ones(n), np.zeros(n), np.zeros(n)]
    for order, part in enumerate(window):
        step = SMOOTH_STEP.deriv(order)
        if rise:
            part[:rise] = step(np.arange(rise) / rise) * (rate_hz / rise) ** order
        if fall:  # one minus the rise of the next motion: the windows sum to one
            part[n - fall:] = (order == 0) - step(np.arange(fall) / fall) * (rate_hz / fall) ** order
    return window


def split_sequential(motions: tuple[tuple[str, float], ...]) -> list[tuple[Motion, float]]:
    """Replace each sequential motion by its two halves: segment 1 first, then segment 2 (OLS20 7.1)."""
    pieces = []
    for name, duration_s in motions:
        halves = (f"{name}a", f"{name}b") if name in SEQUENTIAL else (name,)
        pieces += [(MOTIONS[half], duration_s / len(halves)) for half in halves]
    return pieces


def joint_angles(spec: HingeSpec) -> Angles:
    """The angles over all motions, blended in the transitions."""
    pieces = split_sequential(spec.motions)
    blend = round(spec.blend_s * spec.rate_hz)
    counts = [round(duration_s * spec.rate_hz) for _, duration_s in pieces]
    total = sum(counts) + blend * (len(pieces) - 1)
    run = Angles(*(np.zeros((4, total)) for _ in range(3)), np.zeros((3, total)), np.zeros(total, int))
    rng = np.random.default_rng([spec.seed, 1])
    pose = rng.uniform(-1.0, 1.0, 4) * [np.pi, np.pi / 3, np.pi, np.pi]
    begin = 0
    for index, ((motion, _), count) in enumerate(zip(pieces, counts, strict=True)):
        rng = np.random.default_rng([spec.seed, 2, index])
        if motion.tilt_deg is not None:
            pose = np.r_[pose[0], np.radians(motion.tilt_deg), pose[2:]]
        rise = blend if index > 0 else 0
        fall = blend if index < len(pieces) - 1 else 0
        span = slice(begin - rise, begin + count + fall)
        n = rise + count + fall
        window = blend_window(n, rise, fall, spec.rate_hz)
        parts = modulate(motion_angles(motion, spec, pose, rng, n), *window)
        for target, part in zip((run.value, run.rate, run.accel), parts, strict=True):
            target[:, span] += part
        if motion.carried:
            a0 = smooth_noise(rng, n, spec.rate_hz, A0_BAND_HZ, 3)[0]
            run.a0[:, span] += spec.a0_rms / np.sqrt(3.0) * a0 * window[0]
        run.motion_id[begin: begin + count] = motion.id
        begin += count + blend
        if fall and pieces[index + 1][0].id == motion.id:  # between the halves of a sequential motion
            run.motion_id[begin - blend: begin] = motion.id
    return run


# Rigid bodies and sensors.

def turn_frame(axis: int, angles: Angles, channel: int, w: np.ndarray, dw: np.ndarray,
               force: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rate, its derivative and a vector, seen from a frame turned about its coordinate axis u by q(t).

    w' = R^T w + u dq;  dw' = R^T dw - u dq x R^T w + u ddq;  R = R_u(q).
    """
    i, j = (axis + 1) % 3, (axis + 2) % 3
    q, dq, ddq = angles.value[channel], angles.rate[channel], angles.accel[channel]
    c, s = np.cos(q), np.sin(q)
    turned = []
    for vector in (w, dw, force):
        out = vector.copy()
        out[i], out[j] = c * vector[i] + s * vector[j], c * vector[j] - s * vector[i]
        turned.append(out)
    w, dw, force = turned
    dw[i] += dq * w[j]
    dw[j] -= dq * w[i]
    dw[axis] += ddq
    w[axis] += dq
    return w, dw, force


def soft_tissue(rng: np.random.Generator, spec: HingeSpec, w: np.ndarray,
                dw: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Rotation vector rho (3, N) of the sensor against its bone, and its rate."""
    rms = np.radians(spec.soft_tissue_deg) / np.sqrt(3.0)
    noise, dnoise = smooth_noise(rng, w.shape[1], spec.rate_hz, SOFT_TISSUE_BAND_HZ, 3)
    # Skin moves when the bone does: the random part follows the bone's activity.
    energy, denergy = gauss_smooth((w**2).sum(axis=0)[None], spec.rate_hz, ACTIVITY_CUTOFF_HZ)
    moving = energy / (energy + ACTIVITY_RAD_S**2)
    dmoving = denergy * ACTIVITY_RAD_S**2 / (energy + ACTIVITY_RAD_S**2) ** 2
    level = REST_SOFT_TISSUE + (1.0 - REST_SOFT_TISSUE) * moving
    dlevel = (1.0 - REST_SOFT_TISSUE) * dmoving
    # The sensor's mass lags behind the bone: minus the angular acceleration.
    inertia, dinertia = gauss_smooth(-dw, spec.rate_hz, INERTIA_CUTOFF_HZ)
    gain = spec.inertia_ratio / max(np.sqrt(np.mean(inertia**2)), QUIET_RAD_S2 / np.sqrt(3.0))
    rho = rms * (level * noise + gain * inertia)
    drho = rms * (level * dnoise + dlevel * noise + gain * dinertia)
    return rho, drho


def turn_sensor(rho: np.ndarray, drho: np.ndarray, w: np.ndarray,
                force: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rate and specific force in a frame turned by exp(rho), and the quaternion of exp(rho).

    Rate: exp(rho)^T w + (I - (1 - cos a)/a^2 [rho] + (a - sin a)/a^3 [rho]^2) drho, a = |rho|.
    """
    a = np.sqrt((rho**2).sum(axis=0))
    s1 = np.sinc(a / np.pi)  # sin a / a
    s2 = 0.5 * np.sinc(a / (2 * np.pi)) ** 2  # (1 - cos a) / a^2
    s3 = np.where(a < 1e-2, 1 / 6 - a**2 / 120, (1 - s1) / np.maximum(a, 1e-2) ** 2)  # (a - sin a) / a^3

    def turned(v: np.ndarray) -> np.ndarray:
        step = cross(rho, v)
        return v - s1 * step + s2 * cross(rho, step)

    twist = cross(rho, drho)
    gyr = turned(w) + drho - s2 * twist + s3 * cross(rho, twist)
    quat = np.concatenate([np.cos(a / 2)[None], 0.5 * np.sinc(a / (2 * np.pi)) * rho])
    return gyr, turned(force), quat


def random_unit(rng: np.random.Generator, size: int = 3) -> np.ndarray:
    """Uniform unit vector."""
    v = rng.standard_normal(size)
    return v / np.linalg.norm(v)


def simulate_sensor(spec: HingeSpec, index: int, w: np.ndarray, dw: np.ndarray, force: np.ndarray,
                    q: np.ndarray) -> tuple[np.ndarray, ...]:
    """One IMU from its segment's rate, angular acceleration, a0 + g (3, N, segment frame) and orientation (4, N).

    Returns gyr, acc (N, 3), q (N, 4), mount (3, 3), sensor to segment without soft tissue, and r (3,).
    """
    rng = np.random.default_rng([spec.seed, 3, index])
    q_mount = random_unit(rng, 4)  # sensor to segment
    mount = rotation_matrix(q_mount)
    given = (spec.r1, spec.r2)[index] if index < 2 else None
    lever = random_unit(rng) * rng.uniform(*spec.lever_m)
    r = lever if given is None else np.array(given, float)
    bias_gyr = np.radians(spec.gyr_bias_deg_s) * random_unit(rng)
    bias_acc = spec.acc_bias * random_unit(rng)
    w, dw, force = mount.T @ w, mount.T @ dw, mount.T @ force
    # OLS20 eq. (4), with r from the joint to the sensor.
    force = force + cross(dw, r[:, None]) + cross(w, cross(w, r[:, None]))
    q = quat_mul(q, q_mount[:, None])
    if spec.soft_tissue_deg > 0.0:
        rho, drho = soft_tissue(np.random.default_rng([spec.seed, 4, index]), spec, w, dw)
        w, force, q_rho = turn_sensor(rho, drho, w, force)
        q = quat_mul(q, q_rho)
    noise = spec.noise_scale * np.random.default_rng([spec.seed, 5, index]).standard_normal((2, w.shape[1], 3))
    gyr = w.T + bias_gyr + GYR_STD_RAD_S * noise[0]
    acc = force.T + bias_acc + ACC_STD_M_S2 * noise[1]
    return gyr, acc, q.T.copy(), mount, r


def simulate_hinge(spec: HingeSpec) -> HingeRecording:
    """Simulate the recording that `spec` describes."""
    angles = joint_angles(spec)
    n = len(angles.motion_id)
    zero = np.zeros((3, n))
    w, dw, force = zero, zero, angles.a0 + [[0.0], [0.0], [GRAVITY_M_S2]]
    w, dw, force = turn_frame(2, angles, 0, w, dw, force)
    w, dw, force = turn_frame(0, angles, 1, w, dw, force)
    q_axis = quat_mul(elementary_quat(2, angles.value[0]), elementary_quat(0, angles.value[1]))
    sensors = []
    for index, channel in enumerate((2, 3)):
        segment = turn_frame(1, angles, channel, w, dw, force)
        q = quat_mul(q_axis, elementary_quat(1, angles.value[channel]))
        sensors.append(simulate_sensor(spec, index, *segment, q))
    (gyr1, acc1, q1, mount1, r1), (gyr2, acc2, q2, mount2, r2) = sensors
    axis1, axis2 = (mount.T @ [0.0, 1.0, 0.0] for mount in (mount1, mount2))
    keep = slice(None) if spec.keep_transitions else angles.motion_id != 0
    theta = (angles.value[3] - angles.value[2])[keep]
    return HingeRecording(np.arange(len(theta)) / spec.rate_hz, gyr1[keep], acc1[keep], gyr2[keep], acc2[keep],
                          axis1, axis2, r1, r2, theta, q1[keep], q2[keep], angles.motion_id[keep], spec)
