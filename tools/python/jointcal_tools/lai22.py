"""Float64 reference of LAI22 (two axes and heading offset of a 2-DoF joint), written from the paper alone.

Equation, section and appendix numbers are LAI22's. E2 to E1 is D = Rz(delta), eq. (6). Misprints:

- (A11) needs a minus sign: Phi - p with J^T J p = J^T e. As printed it climbs.
- (A37) needs a plus sign; (A38) means arccos(j2,y); see lai22_appendix.
- (23) q3 is q_z. (A3) alpha in the second rotation is gamma. Appendix A begins with z-y'-x'' for z-x'-y''.
- (1) turns the carrying angle about j1 x j2, which is -x for j1 = z and j2 = y; (12), (23) and (A4) turn it
  about +x. Here sin(beta0) = [j1]_E . [j2]_E, the sign of (12).
- (A10) has six columns for the orientation-based constraint.
- (C.3) the orientation-based cost of (j1, -j2) is the same only with -beta0.

(12) is the arcsine of the scalar product of the two axes in a common frame. So the orientation-based Jacobian
needs none of (A24)-(A40); lai22_appendix has them for comparison.

Where the paper is silent this reference decides as follows:

- (A11) has no globalisation. `online` takes the printed steps of length one; the batch solutions damp them
  (Levenberg-Marquardt), which has the same minima.
- J^T J may be singular: `gauss_newton_step` uses its pseudo-inverse.
- The start of the optimisation is not said. `solve` follows many starts; `online` begins with one of them or with
  `solve` on the half-full buffer.
- (7) is 0/0 where both axes are parallel: the residual and its gradient are taken as 0 there.

Constraints: "rotation" (7), 5 parameters; "orientation" (13), 6; and forms in which the whole sum of squares is a
rational function of 27 x 27 moments, 5 parameters each: "rotation-ratio", N sum f^2 / sum (1 - g^2) with
f = (w1 - D w2) . n; "orientation-variance", sum (g - mean g)^2; "combined", both, divided by squared scales.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from .lai22_signals import Prepared, Samples
from .ols20 import angular_deviation, cross

CAPACITY = 200  # M, B.2
SIN_SWITCH = 0.5  # 4.3: a chart is left where |sin theta| is smaller
G_LIMIT = 1.0 - 1e-9  # the arcsine's slope is infinite at 1
SCALE_RATE_RAD_S = 0.1  # combined: what a rate residual of a good model is worth
SCALE_SINE = 0.03  # combined: likewise for the sine of the carrying angle
TINY = np.finfo(float).tiny
CONSTRAINTS = ("rotation", "orientation", "rotation-ratio", "orientation-variance", "combined")


class Pose(NamedTuple):
    """The unknowns: unit axes in the sensor frames, heading offset and carrying angle, rad."""

    j1: np.ndarray
    j2: np.ndarray
    delta: float
    beta0: float = 0.0  # of "orientation"; the others leave it alone


class Rows(NamedTuple):
    """Residuals (n,) and their gradients with respect to Cartesian axes (n, 3), delta and beta0 (n,)."""

    e: np.ndarray
    j1: np.ndarray
    j2: np.ndarray
    delta: np.ndarray
    beta0: np.ndarray | None = None


class Solution(NamedTuple):
    pose: Pose
    cost: float


# Residuals (sections 4.1, 4.2, appendix B.3).

def heading_matrix(delta: float) -> np.ndarray:
    """D of (6), (A19)."""
    c, s = np.cos(delta), np.sin(delta)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def about_z(v: np.ndarray) -> np.ndarray:
    """z x v (n, 3): derivative of D u with respect to delta where v = D u; (A21), (A23)."""
    return np.column_stack([-v[:, 1], v[:, 0], np.zeros(len(v))])


def back(r: np.ndarray, v: np.ndarray) -> np.ndarray:
    """R^T v for (n, 3, 3) and (n, 3)."""
    return np.einsum("nij,ni->nj", r, v)


def dot(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    return np.einsum("ni,ni->n", a, b)


class Geometry(NamedTuple):
    """Both axes and the relative rate in E1 (n, 3), and R_i^T of the chain rule as functions of vectors in E1."""

    a: np.ndarray  # [j1]_E1
    b: np.ndarray  # [j2]_E1
    w2: np.ndarray  # [w2]_E1
    w_rel: np.ndarray  # (7)
    r2: np.ndarray  # S2 to E1


def geometry(s: Samples, pose: Pose) -> Geometry:
    d = heading_matrix(pose.delta)
    r2 = d @ s.r2
    w2 = s.w2 @ d.T
    return Geometry(s.r1 @ pose.j1, r2 @ pose.j2, w2, s.w1 - w2, r2)


def rotation_rows(s: Samples, pose: Pose) -> Rows:
    """(17) and B.3; the gradients come by e = w_rel . n / |n| with n = a x b, (A12), (A13)."""
    g = geometry(s, pose)
    n = cross(g.a, g.b)
    length = np.sqrt(dot(n, n))
    safe = np.where(length > 1e-12, length, np.inf)[:, None]
    unit = n / safe
    e = dot(g.w_rel, unit)
    by_n = (g.w_rel - e[:, None] * unit) / safe  # (A13) applied to w_rel
    by_b = cross(by_n, g.a)
    by_delta = dot(by_b, about_z(g.b)) - dot(unit, about_z(g.w2))
    return Rows(e, back(s.r1, cross(g.b, by_n)), back(g.r2, by_b), by_delta)


def orientation_rows(s: Samples, pose: Pose) -> Rows:
    """(18) by arcsin(a . b) - beta0."""
    g = sine_rows(s, pose)
    sine = np.clip(g.e, -G_LIMIT, G_LIMIT)
    slope = 1.0 / np.sqrt(1.0 - sine**2)  # (A26)
    return Rows(np.arcsin(sine) - pose.beta0, slope[:, None] * g.j1, slope[:, None] * g.j2, slope * g.delta,
                -np.ones(len(sine)))  # (A25)


# Forms that a moments implementation can sum (the combination is the paper's own outlook, section 6).

def sine_rows(s: Samples, pose: Pose) -> Rows:
    """g = a . b = sin(beta)."""
    g = geometry(s, pose)
    return Rows(dot(g.a, g.b), back(s.r1, g.b), back(g.r2, g.a), dot(g.a, about_z(g.b)))


def triple_rows(s: Samples, pose: Pose) -> Rows:
    """f = w_rel . (a x b), the numerator of (7)."""
    g = geometry(s, pose)
    by_b = cross(g.w_rel, g.a)
    n = cross(g.a, g.b)
    return Rows(dot(g.w_rel, n), back(s.r1, cross(g.b, g.w_rel)), back(g.r2, by_b),
                dot(by_b, about_z(g.b)) - dot(n, about_z(g.w2)))


def variance_rows(s: Samples, pose: Pose) -> Rows:
    """g - mean(g): the carrying angle is eliminated."""
    return Rows(*(part - part.mean(axis=0) for part in sine_rows(s, pose)[:4]))


def ratio_rows(s: Samples, pose: Pose) -> Rows:
    """f / sqrt(mean(1 - g^2)): (7) with one common |n|."""
    f, g = triple_rows(s, pose), sine_rows(s, pose)
    mean = max(float(np.mean(1.0 - g.e**2)), 1e-12)
    parts = []
    for df, dg in zip(f[1:4], g[1:4], strict=True):
        dmean = -2.0 * (g.e @ dg) / len(g.e)
        parts.append(df / np.sqrt(mean) - np.multiply.outer(f.e, dmean) / (2.0 * mean**1.5))
    return Rows(f.e / np.sqrt(mean), *parts)


def combined_rows(s: Samples, pose: Pose, scale_rate: float = SCALE_RATE_RAD_S,
                  scale_sine: float = SCALE_SINE) -> Rows:
    """Both of the above, each divided by its scale (rad/s, sine)."""
    rate, sine = ratio_rows(s, pose), variance_rows(s, pose)
    return Rows(*(np.concatenate([p / scale_rate, q / scale_sine])
                  for p, q in zip(rate[:4], sine[:4], strict=True)))


ROWS = dict(zip(CONSTRAINTS, (rotation_rows, orientation_rows, ratio_rows, variance_rows, combined_rows),
                strict=True))


def cost(s: Samples, pose: Pose, constraint: str) -> float:
    """Sum of squares, (A9)."""
    return float(np.sum(ROWS[constraint](s, pose).e ** 2))


# Charts (section 4.3). Chart 0 is (14), its poles lie on z; chart 1 of figure 4 has them on x.

def to_axis(theta: float, phi: float, chart: int) -> np.ndarray:
    j = np.array([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)])
    return j[::-1] if chart else j


def to_angles(j: np.ndarray, chart: int) -> tuple[float, float]:
    """theta in [0, pi] and phi."""
    x, y, z = j[::-1] if chart else j
    return float(np.arctan2(np.hypot(x, y), z)), float(np.arctan2(y, x))


def chart_jacobian(theta: float, phi: float, chart: int) -> np.ndarray:
    """(3, 2) derivative of an axis with respect to theta, phi: (A16), (A17)."""
    d = np.array([[np.cos(theta) * np.cos(phi), -np.sin(theta) * np.sin(phi)],
                  [np.cos(theta) * np.sin(phi), np.sin(theta) * np.cos(phi)],
                  [-np.sin(theta), 0.0]])
    return d[::-1] if chart else d


class Point(NamedTuple):
    """Phi = (theta_1, phi_1, theta_2, phi_2, delta, beta_0) and the chart of each axis."""

    x: np.ndarray
    charts: tuple[int, int]

    def pose(self) -> Pose:
        x = self.x
        return Pose(to_axis(x[0], x[1], self.charts[0]), to_axis(x[2], x[3], self.charts[1]), float(x[4]), float(x[5]))

    def switched(self) -> Point:
        """The same pose; each axis with |sin theta| < 1/2 in its other chart."""
        x, charts = self.x.copy(), list(self.charts)
        for i in (0, 1):
            if abs(np.sin(x[2 * i])) < SIN_SWITCH:
                j = to_axis(x[2 * i], x[2 * i + 1], charts[i])
                charts[i] = 1 - charts[i]
                x[2 * i: 2 * i + 2] = to_angles(j, charts[i])
        return Point(x, (charts[0], charts[1]))


def to_point(pose: Pose, charts: tuple[int, int] = (0, 0)) -> Point:
    angles = (*to_angles(pose.j1, charts[0]), *to_angles(pose.j2, charts[1]))
    return Point(np.array([*angles, pose.delta, pose.beta0]), charts)


def residuals_and_jacobian(s: Samples, point: Point, constraint: str) -> tuple[np.ndarray, np.ndarray]:
    """e (n,) and J (n, 6) for "orientation", else (n, 5): (A10), (A14)-(A17)."""
    rows = ROWS[constraint](s, point.pose())
    x = point.x
    columns = [rows.j1 @ chart_jacobian(x[0], x[1], point.charts[0]),
               rows.j2 @ chart_jacobian(x[2], x[3], point.charts[1]), rows.delta]
    return rows.e, np.column_stack(columns if rows.beta0 is None else [*columns, rows.beta0])


# Optimisation (section 4.4, appendix B.1).

def gauss_newton_step(s: Samples, point: Point, constraint: str) -> Point:
    """One full step (A11), with the minus sign it needs, then the switch of charts."""
    e, jacobian = residuals_and_jacobian(s, point, constraint)
    p = np.linalg.pinv(jacobian.T @ jacobian, rcond=1e-12, hermitian=True) @ (jacobian.T @ e)
    x = point.x.copy()
    x[: len(p)] -= p
    return Point(x, point.charts).switched()


def minimise(s: Samples, pose: Pose, constraint: str, max_steps: int = 200, tolerance: float = 1e-11) -> Solution:
    """Local minimum from `pose` by damped Gauss-Newton steps, until a step is shorter than `tolerance` rad."""
    point = to_point(pose).switched()
    e, jacobian = residuals_and_jacobian(s, point, constraint)
    v, damping = float(e @ e), 1e-4
    for _ in range(max_steps):
        normal, gradient = jacobian.T @ jacobian, jacobian.T @ e
        size = np.trace(normal) / len(normal)
        p = np.linalg.solve(normal + damping * (size + TINY) * np.eye(len(normal)), gradient)
        x = point.x.copy()
        x[: len(p)] -= p
        trial = Point(x, point.charts).switched()
        e_new, jacobian_new = residuals_and_jacobian(s, trial, constraint)
        v_new = float(e_new @ e_new)
        if v_new <= v:
            point, e, jacobian, v, damping = trial, e_new, jacobian_new, v_new, max(damping / 10.0, 1e-15)
        else:
            damping *= 10.0
        if np.abs(p).max() < tolerance or damping > 1e8:
            break
    return Solution(tidy(point.pose()), v)


def tidy(pose: Pose) -> Pose:
    """The same joint with the largest component of each axis positive and delta in (-pi, pi].

    The signs of the axes are free (C.3); beta0 changes sign with each of them.
    """
    signs = [float(np.sign(j[np.argmax(np.abs(j))])) for j in (pose.j1, pose.j2)]
    delta = np.pi - np.mod(np.pi - pose.delta, 2.0 * np.pi)
    return Pose(signs[0] * pose.j1, signs[1] * pose.j2, float(delta), signs[0] * signs[1] * pose.beta0)


def sensor_directions(r: np.ndarray, w: np.ndarray) -> np.ndarray:
    """Three orthonormal directions (rows) of the rates in the sensor frame, largest rate first."""
    rates = back(r, w)
    return np.linalg.eigh(rates.T @ rates)[1].T[::-1]


def starts(s: Samples, headings: int = 4) -> list[Pose]:
    """All pairs of the rates' eigenvectors of both sensors, with `headings` headings each."""
    return [Pose(j1, j2, 2.0 * np.pi * k / headings) for j1 in sensor_directions(s.r1, s.w1)
            for j2 in sensor_directions(s.r2, s.w2) for k in range(headings)]


def distance(a: Pose, b: Pose) -> float:
    """Largest angle between the axes (signs free) and between the headings of two poses, rad."""
    turns = [min(angular_deviation(p, q), angular_deviation(p, -q)) for p, q in ((a.j1, b.j1), (a.j2, b.j2))]
    return max(*turns, abs(float(np.angle(np.exp(1j * (a.delta - b.delta))))))


def minima(s: Samples, constraint: str, begin: list[Pose] | None = None, apart: float = 0.1) -> list[Solution]:
    """Distinct minima, best first. Every start is followed coarsely; minima `apart` rad or more are then finished."""
    coarse = [minimise(s, pose, constraint, max_steps=30, tolerance=1e-3) for pose in begin or starts(s)]
    found: list[Solution] = []
    for each in sorted(coarse, key=lambda solution: solution.cost):
        if all(distance(each.pose, other.pose) > apart for other in found):
            end = minimise(s, each.pose, constraint)
            if all(distance(end.pose, other.pose) > apart for other in found):
                found.append(end)
        if len(found) == 4:
            break
    return sorted(found, key=lambda solution: solution.cost)


def solve(s: Samples, constraint: str, begin: list[Pose] | None = None) -> Solution:
    """Global minimum as far as the starts find it."""
    return minima(s, constraint, begin)[0]


def solve_on_indices(prepared: Prepared, indices: np.ndarray, constraint: str,
                     begin: list[Pose] | None = None) -> Solution:
    """Batch solution on given samples of a recording, for comparison with another implementation's buffer."""
    return solve(prepared.samples.take(indices), constraint, begin)


# Real-time procedure (appendix B.2).

class Estimate(NamedTuple):
    t_s: float  # of the sample that was added
    pose: Pose
    cost: float  # at `pose`, over the buffer
    kept: np.ndarray  # indices into the prepared samples, oldest first


def online(prepared: Prepared, constraint: str, start: Pose | None = None, capacity: int = CAPACITY) -> Iterator[Estimate]:
    """One estimate per kept sample from the half-full buffer on: one step (A11) on the last `capacity` of them.

    Without `start` the first estimate is the batch solution of the half-full buffer.
    """
    selected = prepared.select()
    point = None if start is None else to_point(start).switched()
    for end in range(capacity // 2, len(selected) + 1):
        kept = selected[max(0, end - capacity): end]
        buffer = prepared.samples.take(kept)
        point = (to_point(solve(buffer, constraint).pose).switched() if point is None
                 else gauss_newton_step(buffer, point, constraint))
        pose = tidy(point.pose())
        yield Estimate(float(prepared.t_s[kept[-1]]), pose, cost(buffer, pose, constraint), kept)
