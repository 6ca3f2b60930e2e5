"""Simulator of a whole person: a tree of segments, each with an IMU, and a hinge between any two that meet.

The pelvis turns and is moved about; from segment to segment R_2 = R_1 C Ry(flexion) Rx(abduction) Rz(rotation): the joint's axis is y of the
segment below it, and C y of the one above, with a constant tilt C. Every angle is noise of a few tenths to one hertz, under a slow
swell of its own, so that a joint now and then hardly moves; abduction and rotation are small. Skin turns every sensor against its bone. Everything is made of jets
(jets.py): rates and accelerations are exact derivatives.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from . import jets
from .jets import Clock, Jet
from .simulate import ACC_STD_M_S2, GRAVITY_M_S2, GYR_STD_RAD_S, random_unit, rotation_matrix

RATE_HZ = 100.0
# Segments in the order of their sensors, and the one that each hangs on: pelvis, chest, head; arms; legs; toes.
NAMES = ("pelvis", "waist", "chest", "head", "upper arm L", "forearm L", "hand L", "upper arm R", "forearm R", "hand R",
         "thigh L", "shank L", "foot L", "thigh R", "shank R", "foot R")
PARENTS = (-1, 0, 1, 2, 2, 4, 5, 2, 7, 8, 0, 10, 11, 0, 13, 14)
FLEXION_DEG = (14.0, 28.0)  # rms, random for each joint
OFF_PLANE_DEG = 1.5
TILT_DEG = (15.0, 45.0)  # from a segment's y axis to the axis of the joint below it: joints of a person are not parallel
SKIN_DEG = 1.2
BAND_HZ, SWELL_HZ, SKIN_HZ = (0.15, 1.0), (0.02, 0.06), (0.3, 6.0)
ROOT_DEG, ROOT_HZ = (40.0, 8.0, 8.0), (0.05, 0.5)  # yaw, roll, pitch
ROOT_M, ROOT_M_HZ = 0.04, (0.4, 1.6)
BONE_M, LEVER_M, ASIDE_M = (0.2, 0.4), (0.08, 0.2), 0.05  # a bone; along it from a joint to its sensor; aside
GYR_BIAS_DEG_S, ACC_BIAS = 0.3, 0.08


@dataclass
class BodyRecording:
    """Readings of every sensor at RATE_HZ, and the axes of every joint (one for each segment but the first) in the frames of its two sensors."""

    values: list[np.ndarray]  # (N, 6) rad/s, m/s^2
    joints: list[tuple[int, int]]  # proximal and distal sensor
    axes: list[tuple[np.ndarray, np.ndarray]]
    flexion_rad: list[np.ndarray]


def swelling(rng: np.random.Generator, clock: Clock, band_hz: tuple[float, float], size: float) -> Jet:
    """Noise of rms `size`, under a swell between a fifth and nearly twice of it."""
    swell = jets.logistic(2.0 * jets.noise(rng, clock, SWELL_HZ, 1)[0])
    return size * (jets.noise(rng, clock, band_hz, 1)[0] * (0.2 + 1.6 * swell))


def small_turn(rng: np.random.Generator, clock: Clock, band_hz: tuple[float, float], rms_rad: float) -> Jet:
    rho = (rms_rad / np.sqrt(3.0)) * jets.noise(rng, clock, band_hz, 3) * np.sqrt(3.0)
    return jets.times(jets.times(jets.turn(0, rho[0]), jets.turn(1, rho[1])), jets.turn(2, rho[2]))


def sense(rng: np.random.Generator, clock: Clock, rotation: Jet, place: Jet, lever_m: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Readings (N, 6) of a sensor on a segment, and its rotation (3, 3) to the segment."""
    mount = rotation_matrix(random_unit(rng, 4))
    turned = jets.times(rotation, small_turn(rng, clock, SKIN_HZ, np.radians(SKIN_DEG)))
    force = place.accel + jets.times(rotation, Jet(np.repeat(lever_m[:, None], clock.size, 1), *np.zeros((2, 3, clock.size)))).accel
    force[2] += GRAVITY_M_S2
    gyr = (mount.T @ jets.body_rate(turned)).T + np.radians(GYR_BIAS_DEG_S) * random_unit(rng)
    acc = (mount.T @ jets.into_body(turned, force)).T + ACC_BIAS * random_unit(rng)
    noise = rng.standard_normal((2, *gyr.shape))
    return np.hstack([gyr + GYR_STD_RAD_S * noise[0], acc + ACC_STD_M_S2 * noise[1]]), mount


def tilted(rng: np.random.Generator) -> np.ndarray:
    """Rotation (3, 3) of a joint's frame in the segment above it: its y axis leans by TILT_DEG, anywhere to."""
    angle, to = np.radians(rng.uniform(*TILT_DEG)), rng.uniform(0.0, 2.0 * np.pi)
    return jets.turn(0, jets.constant(angle * np.cos(to), 1)).value[:, :, 0] @ jets.turn(2, jets.constant(angle * np.sin(to), 1)).value[:, :, 0]


def simulate_body(seconds: float, seed: int, parents: tuple[int, ...] = PARENTS) -> BodyRecording:
    """A person with a sensor on each segment of `parents`."""
    clock = Clock(round(seconds * RATE_HZ), RATE_HZ)
    out, rotations, ends, mounts, tilts = BodyRecording([], [], [], []), [], [], [], []
    for segment, parent in enumerate(parents):
        rng = np.random.default_rng([seed, segment])
        bone_m, aside = rng.uniform(*BONE_M), rng.normal(size=2) * ASIDE_M
        if parent < 0:
            yaw, roll, pitch = (np.radians(size) * jets.noise(rng, clock, ROOT_HZ, 1)[0] for size in ROOT_DEG)
            rotation = jets.times(jets.times(jets.turn(2, yaw), jets.turn(0, roll)), jets.turn(1, pitch))
            joint = ROOT_M * jets.noise(rng, clock, ROOT_M_HZ, 3)
        else:
            flexion = swelling(rng, clock, BAND_HZ, np.radians(rng.uniform(*FLEXION_DEG)))
            side, twist = (np.radians(OFF_PLANE_DEG) * jets.noise(rng, clock, BAND_HZ, 1)[0] for _ in range(2))
            bent = jets.times(jets.times(jets.turn(1, flexion), jets.turn(0, side)), jets.turn(2, twist))
            tilt = tilted(rng)
            above = jets.times(rotations[parent], Jet(np.repeat(tilt[:, :, None], clock.size, 2), *np.zeros((2, 3, 3, clock.size))))
            rotation, joint = jets.times(above, bent), ends[parent]
            tilts.append(tilt)
            out.flexion_rad.append(flexion.value)
        lever_m = np.array([aside[0], aside[1], -rng.uniform(*LEVER_M)])
        values, mount = sense(rng, clock, rotation, joint, lever_m)
        down = Jet(np.repeat([[0.0], [0.0], [-bone_m]], clock.size, 1), *np.zeros((2, 3, clock.size)))
        rotations.append(rotation)
        ends.append(joint + jets.times(rotation, down))
        mounts.append(mount)
        out.values.append(values)
        if parent >= 0:
            out.joints.append((parent, segment))
    y = np.array([0.0, 1.0, 0.0])
    out.axes = [(mounts[parent].T @ tilt @ y, mounts[segment].T @ y) for (parent, segment), tilt in zip(out.joints, tilts, strict=True)]
    return out
