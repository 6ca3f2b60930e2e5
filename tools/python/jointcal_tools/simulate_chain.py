"""Simulator of pelvis, thigh and shank that carry one IMU each: a ball joint (hip) and a knee.

Kinematics. With elementary rotations, segment to earth, earth z up:

    R_P = Rz Ry Rx (pelvis),    R_T = R_P Ry Rx Rz (hip),    R_S = R_T Ry Rx Rz (knee; type 1: Ry alone).

The hip's centre is the origin of pelvis and thigh, the knee's centre lies at (0, 0, -thigh_m) of the thigh. Motion of type 1 and 2
as in section 5 of SAL15: type 1 has little variation between the degrees of freedom and a hinge for a knee, type 2 has much of it
everywhere. Rates are those that give about the differences of its table 1. Sensors, noise and soft tissue are those of simulate.py.
"""

from __future__ import annotations

from dataclasses import asdict, dataclass

import numpy as np

from . import quaternions as quat
from .recordings import AXES, Recording
from .simulate import (A0_BAND_HZ, GRAVITY_M_S2, Angles, cross, elementary_quat, quat_mul, simulate_sensor, smooth_noise,
                       turn_frame)

AXES_OF = (2, 1, 0, 1, 0, 2, 1, 0, 2)  # pelvis, hip, knee: three turns each
RATES = {1: (0.35, 0.45, 0.3, 1.3, 0.25, 0.25, 1.7, 0.0, 0.0), 2: (1.4, 1.6, 1.1, 1.6, 1.3, 1.2, 2.0, 1.6, 1.6)}  # rms rad/s
ERROR_BAND_HZ = (0.01, 0.2)


@dataclass(frozen=True)
class ChainSpec:
    """What to simulate. The same spec gives the same recording."""

    type: int = 1
    seconds: float = 40.0
    rate_hz: float = 100.0
    seed: int = 0
    noise_scale: float = 1.0
    acc_bias: float = 0.0
    gyr_bias_deg_s: float = 0.0
    soft_tissue_deg: float = 0.0
    inertia_ratio: float = 1.0
    orientation_deg: float = 0.0  # rms error of each orientation, wandering slowly
    same_heading: bool = False  # one earth frame for all; else each sensor has a heading of its own
    thigh_m: float = 0.42
    lever_m: tuple[float, float] = (0.05, 0.25)
    a0_rms: float = 0.5
    speed: float = 1.0  # times the rates of the type
    r1: None = None  # levers are random
    r2: None = None


@dataclass
class ChainRecording:
    """A simulated recording with its truth."""

    t_s: np.ndarray
    gyr: list[np.ndarray]  # three of (N, 3)
    acc: list[np.ndarray]
    q: list[np.ndarray]  # (N, 4) sensor to its earth frame
    hip_to_pelvis: np.ndarray  # (3,) m, sensor frames
    hip_to_thigh: np.ndarray
    knee_to_thigh: np.ndarray
    knee_to_shank: np.ndarray
    hip_axis: np.ndarray  # (3,) flexion axis of the hip in the thigh's sensor frame
    knee_axis: np.ndarray  # (3,) flexion axis of the knee in the thigh's sensor frame
    knee_axis_shank: np.ndarray
    spec: ChainSpec

    def places(self) -> np.ndarray:
        """(4, 3)"""
        return np.array([self.hip_to_pelvis, self.hip_to_thigh, self.knee_to_thigh, self.knee_to_shank])

    def first_two(self) -> Recording:
        """Pelvis and thigh, the two sensors of the hip."""
        return Recording(self.t_s, self.gyr[0], self.acc[0], self.gyr[1], self.acc[1])

    def third_columns(self) -> dict[str, np.ndarray]:
        """Columns of the file for the shank."""
        return {f"{kind}3_{axis}": part for kind, of in (("gyr", self.gyr), ("acc", self.acc))
                for axis, part in zip(AXES, of[2].T, strict=True)}

    def orientation_columns(self) -> dict[str, np.ndarray]:
        return {f"q{k + 1}_{name}": part for k, q in enumerate(self.q)
                for name, part in zip(("w", *AXES), q.T, strict=True)}

    def truth(self) -> dict:
        """What a test wants to know besides the signals, ready for JSON. Of the hip under the names of `jointcal center` too."""
        names = ("hip_to_pelvis_m", "hip_to_thigh_m", "knee_to_thigh_m", "knee_to_shank_m")
        return {"source": "simulated (tools/simulate_chain.py)", "rate_hz": self.spec.rate_hz,
                **{name: place.tolist() for name, place in zip(names, self.places(), strict=True)},
                "joint_to_sensor1_m": self.hip_to_pelvis.tolist(), "joint_to_sensor2_m": self.hip_to_thigh.tolist(),
                "segment_length_m": self.spec.thigh_m,
                "knee_axis_thigh": self.knee_axis.tolist(), "knee_axis_shank": self.knee_axis_shank.tolist(),
                "spec": {key: value for key, value in asdict(self.spec).items() if value is not None}}


def chain_angles(spec: ChainSpec, n: int) -> Angles:
    rng = np.random.default_rng([spec.seed, 2, 0])
    pace = spec.speed
    parts = smooth_noise(rng, n, spec.rate_hz, (0.15 * pace, 0.9 * pace), 9, unit=1, orders=2)
    share = spec.speed * np.array(RATES[spec.type])
    value, rate, accel = (share[:, None] * part for part in parts)
    pose = np.random.default_rng([spec.seed, 1]).uniform(-0.3, 0.3, 9)
    if spec.type == 1:
        pose[7:] = 0.0
    a0 = smooth_noise(rng, n, spec.rate_hz, A0_BAND_HZ, 3)[0]
    return Angles(value + pose[:, None], rate, accel, spec.a0_rms / np.sqrt(3.0) * a0, np.zeros(n, int))


def earth_error(spec: ChainSpec, index: int, n: int) -> np.ndarray:
    """(N, 4) common earth to the earth frame that the sensor's filter believes in."""
    rng = np.random.default_rng([spec.seed, 6, index])
    heading = 0.0 if spec.same_heading else rng.uniform(-np.pi, np.pi)
    wander = smooth_noise(rng, n, spec.rate_hz, ERROR_BAND_HZ, 3)[0]
    error = quat.from_rotation_vectors(np.radians(spec.orientation_deg) / np.sqrt(3.0) * wander.T)
    return quat.multiply(quat.rotation(np.full(n, heading), np.array([0.0, 0.0, 1.0])), error)


def simulate_chain(spec: ChainSpec) -> ChainRecording:
    """Simulate the recording that `spec` describes."""
    n = round(spec.seconds * spec.rate_hz)
    angles = chain_angles(spec, n)
    zero = np.zeros((3, n))
    body = (zero, zero, angles.a0 + [[0.0], [0.0], [GRAVITY_M_S2]])
    q = np.array([[1.0], [0.0], [0.0], [0.0]])
    gyr, acc, found, places, mounts = [], [], [], [], []
    for segment in range(3):
        if segment == 2:  # on to the knee
            w, dw, force = body
            thigh = np.array([[0.0], [0.0], [-spec.thigh_m]])
            body = (w, dw, force + cross(dw, thigh) + cross(w, cross(w, thigh)))
        for turn in range(3):
            channel = 3 * segment + turn
            body = turn_frame(AXES_OF[channel], angles, channel, *body)
            q = quat_mul(q, elementary_quat(AXES_OF[channel], angles.value[channel]))
        sensor_gyr, sensor_acc, sensor_q, mount, r = simulate_sensor(spec, segment, *body, q)
        mounts.append(mount)
        gyr.append(sensor_gyr)
        acc.append(sensor_acc)
        found.append(quat.multiply(earth_error(spec, segment, n), sensor_q))
        places.append(r)
    knee = mounts[1].T @ [0.0, 0.0, -spec.thigh_m]  # from the hip, in the thigh's sensor frame
    hip_axis, knee_axis = mounts[1].T @ [0.0, 1.0, 0.0], mounts[1].T @ [0.0, 1.0, 0.0]
    return ChainRecording(np.arange(n) / spec.rate_hz, gyr, acc, found, places[0], places[1], places[1] - knee, places[2],
                          hip_axis, knee_axis, mounts[2].T @ [0.0, 1.0, 0.0], spec)
