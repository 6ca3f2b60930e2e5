"""Joint angles of 2-DoF joints and hinges: LAI22 (19)-(26), section 4.5, and the choice of signs, appendix C.3.

alpha is flexion about j1, gamma pronation about j2, beta the carrying angle: intrinsic z-x'-y'' Euler angles of
segment 2 relative to segment 1, rad. (23) prints q3 for q_z. Before the zero is fixed alpha and gamma are only
known up to a constant each, and beta is absolute.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from . import quaternions as quat
from .lai22 import Pose
from .lai22_appendix import Y, Z, alignment, carrying_angle, relative


class JointAngles(NamedTuple):
    """Flexion, carrying and pronation angle, (N,) each, rad; flexion and pronation without jumps."""

    alpha: np.ndarray
    beta: np.ndarray
    gamma: np.ndarray


def euler_zxy(q: np.ndarray) -> JointAngles:
    """(22)-(24) of quaternions (N, 4), each within half a turn of zero."""
    w, x, y, z = q.T
    alpha = np.arctan2(2 * (w * z - x * y), w * w - x * x + y * y - z * z)
    gamma = np.arctan2(2 * (w * y - x * z), w * w - x * x - y * y + z * z)
    return JointAngles(alpha, carrying_angle(q), gamma)


def from_euler_zxy(angles: JointAngles) -> np.ndarray:
    """Inverse of `euler_zxy`, (A8)."""
    x = np.array([1.0, 0.0, 0.0])
    return quat.multiply(quat.multiply(quat.rotation(angles.alpha, Z), quat.rotation(angles.beta, x)),
                         quat.rotation(angles.gamma, Y))


def joint_angles(q1: np.ndarray, q2: np.ndarray, pose: Pose) -> JointAngles:
    """alpha', beta', gamma' of (21)-(24): the first and the last up to a constant."""
    raw = euler_zxy(relative(q1, q2, pose.j1, pose.j2, pose.delta))
    return JointAngles(np.unwrap(raw.alpha), raw.beta, np.unwrap(raw.gamma))


def with_reference(q1: np.ndarray, q2: np.ndarray, pose: Pose, at: int, reference: tuple[float, float]) -> JointAngles:
    """Angles whose flexion and pronation at sample `at` are `reference`, by turning the segments: (25), (26)."""
    raw = euler_zxy(relative(q1, q2, pose.j1, pose.j2, pose.delta))
    b1 = quat.multiply(alignment(pose.j1, Z), quat.rotation(raw.alpha[at] - reference[0], Z))  # (25)
    b2 = quat.multiply(alignment(pose.j2, Y), quat.rotation(reference[1] - raw.gamma[at], Y))  # (26)
    left = quat.conjugate(quat.multiply(q1, b1))
    right = quat.multiply(quat.multiply(quat.rotation(pose.delta, Z), q2), b2)
    turned = euler_zxy(quat.multiply(left, right))
    return JointAngles(unwrap_from(turned.alpha, at), turned.beta, unwrap_from(turned.gamma, at))


def unwrap_from(angle: np.ndarray, at: int) -> np.ndarray:
    """`angle` without jumps, unchanged at sample `at`."""
    smooth = np.unwrap(angle)
    return smooth + (angle[at] - smooth[at])


def zero_by_pose(angle: np.ndarray, rows: np.ndarray, reference: float = 0.0) -> np.ndarray:
    """Shift so that the mean over the samples `rows`, taken in a known pose, is `reference`."""
    return angle - (angle[rows].mean() - reference)


def zero_by_range(angle: np.ndarray, end: float = 0.0, upper: bool = False, share: float = 0.0) -> np.ndarray:
    """Shift so that one end of the range of motion is `end`: the lower one, or the upper one.

    `share` of the samples may lie beyond it.
    """
    level = np.quantile(angle, 1.0 - share if upper else share)
    return angle - (level - end)


def in_half_space(j: np.ndarray, hint: np.ndarray) -> np.ndarray:
    """j or -j, whichever points into the half-space of `hint` (C.3, known sensor placement)."""
    return j if j @ hint >= 0.0 else -j


def by_range(q1: np.ndarray, q2: np.ndarray, pose: Pose, at: int) -> tuple[Pose, JointAngles]:
    """Signs with which the mean flexion and the mean pronation are positive (C.3, range of motion).

    At sample `at` the joint is extended and supinated, where both angles are 0.
    """
    angles = with_reference(q1, q2, pose, at, (0.0, 0.0))
    s1, s2 = (1.0 if part.mean() >= 0.0 else -1.0 for part in (angles.alpha, angles.gamma))
    chosen = Pose(s1 * pose.j1, s2 * pose.j2, pose.delta, s1 * s2 * pose.beta0)
    return chosen, with_reference(q1, q2, chosen, at, (0.0, 0.0))


# Hinge: j1 and j2 are the same direction with the same sign.

def hinge_heading_offset(q1: np.ndarray, q2: np.ndarray, j1: np.ndarray, j2: np.ndarray) -> float:
    """delta, rad, that brings both axes' horizontal parts together: maximum of sum a . D b in closed form."""
    a, b = quat.matrices(q1) @ j1, quat.matrices(q2) @ j2
    return float(np.arctan2(np.sum(a[:, 1] * b[:, 0] - a[:, 0] * b[:, 1]),
                            np.sum(a[:, 0] * b[:, 0] + a[:, 1] * b[:, 1])))


def hinge_flexion(q1: np.ndarray, q2: np.ndarray, j1: np.ndarray, j2: np.ndarray, delta: float) -> np.ndarray:
    """Flexion (N,), rad, up to a constant: twist about the common axis of segment 2 relative to segment 1.

    Both segments are aligned by (19) with their own axis.
    """
    left = quat.conjugate(quat.multiply(q1, alignment(j1, Z)))
    right = quat.multiply(quat.multiply(quat.rotation(delta, Z), q2), alignment(j2, Z))
    q = quat.multiply(left, right)
    return np.unwrap(2.0 * np.arctan2(q[:, 3], q[:, 0]))
