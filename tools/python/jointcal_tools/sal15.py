"""Hip and knee in one problem, float64, written from [SAL15] and independent of the C code.

Unknowns, in this order: hip to pelvis, hip to thigh, knee to thigh, knee to shank (12, m), then biases of the accelerometers of
pelvis, thigh as the hip sees it, thigh as the knee sees it, shank (12, m/s^2), then the heading offsets of both joints (2, rad).

Signs. With r from the joint to the sensor, a_S = a_0 + K_S r_S (their (4b), Gamma = K r), so that a_A - K_A r_A and a_B - K_B r_B are the
same vector, the force at the joint, in two frames. (13) is that with a sign of the second one turned, as above their (8); in (13b) the
B of the knee has another r than the B of the hip, which is printed with the same letter. Here both are
e = R_1 (a_1 - K_1 r_1) - Rz(delta) R_2 (a_2 - K_2 r_2) in an earth frame.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from . import ols17

PLACES, BIASES, HEADINGS = slice(0, 12), slice(12, 24), slice(24, 26)
UNKNOWNS = 26
READING_S = 0.1


@dataclass(frozen=True)
class Ingredients:
    """What is used of what there is."""

    orientations: bool = False  # (13) instead of lengths, (4)
    biases: bool = False  # of the accelerometers as unknowns; 0.3 m/s^2 each
    shared_bias: bool = False  # the thigh has one accelerometer
    thigh_m: float | None = None  # known distance of hip and knee ...
    thigh_sd_m: float = 0.005
    normal: np.ndarray | None = None  # n_P1 of (14a) in the thigh's sensor frame: (15b) ...
    normal_sd_m: float = 0.02  # ... and how far the thigh may leave that plane


@dataclass
class ChainFit:
    places: np.ndarray  # (4, 3) m
    biases: np.ndarray  # (4, 3) m/s^2
    sd_m: np.ndarray  # (4, 3) standard deviations of the places, by the matrix and the residuals' size
    segment_m: float
    residual: float  # root of the weighted mean square, in units of what is taken for usual
    matrix: np.ndarray = field(repr=False)


@dataclass
class Joint:
    """Samples of one joint: for lengths, and in both sensors' earth frames for vectors."""

    samples: ols17.Samples
    oriented: ols17.Samples | None = None


def heading_matrix(delta: float) -> np.ndarray:
    c, s = np.cos(delta), np.sin(delta)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def vector_rows(joint: Joint, r1: np.ndarray, r2: np.ndarray, delta: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Residuals (3 N), slopes by r1, r2, delta (3 N, 7), and |K r|^2 of both (3 N)."""
    s = joint.oriented
    swing1, swing2 = s.k1 @ r1, s.k2 @ r2
    z = heading_matrix(delta)
    at1, at2 = s.a1 - swing1, (s.a2 - swing2) @ z.T
    around = np.column_stack([at2[:, 1], -at2[:, 0], np.zeros(len(s))])
    slopes = np.concatenate([-s.k1, z @ s.k2, around[:, :, None]], axis=2)
    return (at1 - at2).ravel(), slopes.reshape(-1, 7), np.repeat((swing1**2).sum(1) + (swing2**2).sum(1), 3)


def joint_system(joint: Joint, x: np.ndarray, first: int, use: Ingredients, noise: tuple[float, float]) -> tuple:
    """Matrix and gradient of one joint in all unknowns, weighted sum of squares, readings."""
    r1, r2 = x[3 * first: 3 * first + 3], x[3 * first + 3: 3 * first + 6]
    columns = np.arange(3 * first, 3 * first + 6)
    if use.orientations:
        e, slopes, turn2 = vector_rows(joint, r1, r2, x[24 + first // 2])
        columns = np.append(columns, 24 + first // 2)
    else:
        own = np.concatenate([r1, r2, x[12 + 3 * first: 18 + 3 * first]])
        e, slopes, turn2 = ols17.lengths(joint.samples, own)
        columns = np.concatenate([columns, columns + 12])
    dt = float(np.median(np.diff(joint.samples.t_s)))
    weight = dt / READING_S / (noise[0] ** 2 + noise[1] ** 2 * turn2)
    matrix, gradient = np.zeros((UNKNOWNS, UNKNOWNS)), np.zeros(UNKNOWNS)
    matrix[np.ix_(columns, columns)] = (slopes * weight[:, None]).T @ slopes
    gradient[columns] = (slopes * weight[:, None]).T @ e
    return matrix, gradient, weight @ e**2, len(e) * dt / READING_S


def soft_rows(x: np.ndarray, use: Ingredients) -> list[tuple[np.ndarray, float, float]]:
    """(slope, residual, standard deviation) of what is known beforehand."""
    rows = []

    def row(at: slice | int, value: np.ndarray | float) -> np.ndarray:
        out = np.zeros(UNKNOWNS)
        out[at] = value
        return out

    for k in range(12):
        rows.append((row(k, 1.0), x[k], 0.3))
        rows.append((row(12 + k, 1.0), x[12 + k], 0.3 if use.biases else 1e-4))
    rows += [(row(24 + k, 1.0), 0.0, 3.0 if use.orientations else 1e-4) for k in (0, 1)]
    if use.shared_bias:
        for k in range(3):
            rows.append((row(15 + k, 1.0) - row(18 + k, 1.0), x[15 + k] - x[18 + k], 1e-3))
    segment = x[3:6] - x[6:9]  # from the hip to the knee, in the thigh's sensor frame
    if use.thigh_m is not None:
        length = np.linalg.norm(segment)
        slope = row(slice(3, 6), segment / length) - row(slice(6, 9), segment / length)
        rows.append((slope, length - use.thigh_m, use.thigh_sd_m))
    if use.normal is not None:  # (15b); (15a) follows from it
        rows.append((row(slice(3, 6), use.normal) - row(slice(6, 9), use.normal), use.normal @ segment, use.normal_sd_m))
    return rows


def best_heading(joint: Joint, x: np.ndarray, first: int) -> float:
    """The heading offset by which the horizontal forces at the joint agree best."""
    s = joint.oriented
    f1, f2 = s.a1 - s.k1 @ x[3 * first: 3 * first + 3], s.a2 - s.k2 @ x[3 * first + 3: 3 * first + 6]
    return float(np.arctan2((f2[:, 0] * f1[:, 1] - f2[:, 1] * f1[:, 0]).sum(), (f2[:, :2] * f1[:, :2]).sum()))


def solve(hip: Joint, knee: Joint, use: Ingredients, noise: tuple[float, float] = (0.05, 0.01)) -> ChainFit:
    """Gauss-Newton over both joints. With orientations or the thigh's length it starts where (4) alone leads.

    A length does not tell the knee's side of the hip: from nowhere, Gauss-Newton may end on the wrong one.
    """
    x = np.zeros(UNKNOWNS)
    if use.orientations or use.thigh_m is not None:
        x[PLACES] = solve(hip, knee, Ingredients(biases=True), noise).places.ravel()
    if use.orientations:
        x[HEADINGS] = best_heading(hip, x, 0), best_heading(knee, x, 2)
    for _ in range(ols17.MAX_ITERATIONS):
        parts = [joint_system(joint, x, first, use, noise) for joint, first in ((hip, 0), (knee, 2))]
        matrix, gradient = (sum(part[k] for part in parts) for k in (0, 1))
        for slope, residual, sd in soft_rows(x, use):
            matrix += np.outer(slope, slope) / sd**2
            gradient += slope * residual / sd**2
        step = -np.linalg.solve(matrix, gradient)
        x += step
        if np.linalg.norm(step) < 1e-10:
            break
    excess = max(sum(part[2] for part in parts) / sum(part[3] for part in parts), 1e-9)
    sd = np.sqrt(np.maximum(excess, 1.0) * np.diag(np.linalg.inv(matrix))[PLACES])
    return ChainFit(x[PLACES].reshape(4, 3), x[BIASES].reshape(4, 3), sd.reshape(4, 3),
                    float(np.linalg.norm(x[3:6] - x[6:9])), float(np.sqrt(excess)), matrix)
