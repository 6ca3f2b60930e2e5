"""The orientation-based constraint exactly as LAI22 writes it: (8)-(12), appendix B.4, quaternion by quaternion.

lai22.orientation_rows does the same with a scalar product. `printed=True` keeps the misprints, so that a test
can show that they are some:

- (A37) prints j_y dj_y - j_x dj_x; |v|^2 = j_x^2 + j_y^2 asks for a plus.
- (A38) prints arccos(j2,x); v = y x j2 belongs to arccos(j2,y), as in (9).
"""

from __future__ import annotations

import numpy as np

from . import quaternions as quat
from .lai22 import Point, chart_jacobian

Z, Y = np.array([0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0])


def alignment(j: np.ndarray, target: np.ndarray) -> np.ndarray:
    """Shortest rotation (4,) that takes `target` to j: (8), (9), (19), (20). Segment B to sensor S.

    Where j = -target every perpendicular axis serves; the paper's is then the zero vector.
    """
    axis = np.cross(target, j)
    if np.linalg.norm(axis) < 1e-12:
        axis = np.array([1.0, 0.0, 0.0])
    return quat.rotation(np.arctan2(np.linalg.norm(np.cross(target, j)), target @ j), axis)


def relative(q1: np.ndarray, q2: np.ndarray, j1: np.ndarray, j2: np.ndarray, delta: float) -> np.ndarray:
    """Orientation (N, 4) of B2 in B1, (11), (21), from orientations (N, 4) in E1 and E2."""
    left = quat.multiply(quat.conjugate(alignment(j1, Z)), quat.conjugate(q1))
    right = quat.multiply(q2, alignment(j2, Y))
    return quat.multiply(quat.multiply(left, quat.rotation(delta, Z)), right)


def carrying_angle(q: np.ndarray) -> np.ndarray:
    """(12), (23)."""
    w, x, y, z = q.T
    return np.arcsin(np.clip(2.0 * (w * x + y * z), -1.0, 1.0))


def alignment_derivative(v: np.ndarray, dv: np.ndarray, cosine: float, dcosine: float,
                         dlength: float | None = None) -> np.ndarray:
    """Derivative (4,) of [cos(psi/2), sin(psi/2) v/|v|] with psi = arccos(cosine): (A33)-(A37)."""
    psi, length = np.arccos(cosine), np.linalg.norm(v)
    dpsi = -dcosine / np.sqrt(1.0 - cosine**2)  # (A34)
    if dlength is None:
        dlength = v @ dv / length  # (A37) for any v
    half = psi / 2.0
    dsin = 0.5 * np.cos(half) * dpsi  # (A36)
    vector = (v * length * dsin + np.sin(half) * length * dv - np.sin(half) * v * dlength) / length**2  # (A35)
    return np.concatenate([[-0.5 * np.sin(half) * dpsi], vector])  # (A33)


def alignment_derivatives(point: Point, printed: bool) -> tuple[np.ndarray, np.ndarray]:
    """d(S1 to B1)/d(theta_1, phi_1) and d(B2 to S2)/d(theta_2, phi_2), each (2, 4)."""
    pose, x = point.pose(), point.x
    first, second = [], []
    for dj in chart_jacobian(x[0], x[1], point.charts[0]).T:
        v, dv = np.cross(pose.j1, Z), np.cross(dj, Z)  # (A32)
        dlength = (pose.j1[1] * dj[1] - pose.j1[0] * dj[0]) / np.linalg.norm(v) if printed else None
        first.append(alignment_derivative(v, dv, pose.j1[2], dj[2], dlength))
    component = 0 if printed else 1
    for dj in chart_jacobian(x[2], x[3], point.charts[1]).T:
        v, dv = np.cross(Y, pose.j2), np.cross(Y, dj)  # (A38)
        second.append(alignment_derivative(v, dv, pose.j2[component], dj[component]))
    return np.array(first), np.array(second)


def residuals_and_jacobian(q1: np.ndarray, q2: np.ndarray, point: Point,
                           printed: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """(18) and its Jacobian (N, 6), (A24)-(A40). Not where an axis is z (j1) or y (j2): (A34) is singular there."""
    pose = point.pose()
    b1, b2 = quat.conjugate(alignment(pose.j1, Z)), alignment(pose.j2, Y)
    heading = quat.rotation(pose.delta, Z)
    dheading = np.array([-0.5 * np.sin(pose.delta / 2), 0.0, 0.0, 0.5 * np.cos(pose.delta / 2)])  # (A40)
    d1, d2 = alignment_derivatives(point, printed)
    one, two = quat.conjugate(q1), q2

    def chain(left: np.ndarray, middle: np.ndarray, right: np.ndarray) -> np.ndarray:
        """The product (A28)."""
        return quat.multiply(quat.multiply(quat.multiply(left, one), middle), quat.multiply(two, right))

    q = chain(b1, heading, b2)
    derivatives = [chain(d, heading, b2) for d in d1] + [chain(b1, heading, d) for d in d2] + [chain(b1, dheading, b2)]
    w, x, y, z = q.T
    sine = 2.0 * (w * x + y * z)
    columns = []
    for dw, dx, dy, dz in (each.T for each in derivatives):
        dsine = 2.0 * (dx * w + x * dw + dy * z + y * dz)  # (A27)
        columns.append(dsine / np.sqrt(1.0 - sine**2))  # (A26)
    return np.arcsin(sine) - pose.beta0, np.column_stack([*columns, -np.ones(len(q))])  # (A25)
