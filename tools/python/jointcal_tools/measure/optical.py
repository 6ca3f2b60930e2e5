"""Joint angles from the rig's optical references, and quaternions (w, x, y, z) as arrays (N, 4)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..recordings import Recording

LAGS = np.linspace(-1.5, 1.5, 31)  # samples that the optical data may come late
JUMP_RAD_S = 0.5  # rates of marker cluster and gyroscope further apart: the cluster's orientation has jumped


def multiply(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    w = p[..., :1] * q[..., :1] - (p[..., 1:] * q[..., 1:]).sum(-1, keepdims=True)
    v = p[..., :1] * q[..., 1:] + q[..., :1] * p[..., 1:] + np.cross(p[..., 1:], q[..., 1:])
    return np.concatenate([w, v], -1)


def conjugate(q: np.ndarray) -> np.ndarray:
    return q * np.array([1.0, -1.0, -1.0, -1.0])


def rotate(q: np.ndarray, v: np.ndarray) -> np.ndarray:
    pure = np.concatenate([np.zeros((*np.shape(v)[:-1], 1)), v], -1)
    return multiply(multiply(q, pure), conjugate(q))[..., 1:]


def from_matrix(r: np.ndarray) -> np.ndarray:
    """The quaternion of one rotation matrix: the eigenvector of the largest eigenvalue of a symmetric 4 x 4 matrix."""
    (a, b, c), (d, e, f), (g, h, i) = r
    k = np.array([[a + e + i, h - f, c - g, d - b], [h - f, a - e - i, b + d, c + g], [c - g, b + d, e - a - i, f + h],
                  [d - b, c + g, f + h, i - a - e]])
    return np.linalg.eigh(k)[1][:, -1]


def steps(q: np.ndarray) -> np.ndarray:
    """Rotation vectors (N - 1, 3) from each orientation to the next, in the body's frame."""
    d = multiply(conjugate(q[:-1]), q[1:])
    d *= np.where(d[:, :1] < 0.0, -1.0, 1.0)
    length = np.linalg.norm(d[:, 1:], axis=1)
    angle = 2.0 * np.arctan2(length, d[:, 0])
    return d[:, 1:] * np.where(length > 0.0, angle / np.maximum(length, 1e-300), 2.0)[:, None]


def turn_between(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Rotation matrix that takes vectors a (N, 3) nearest to b (N, 3) (Kabsch)."""
    u, _, vt = np.linalg.svd(a.T @ b)
    return vt.T @ np.diag([1.0, 1.0, np.linalg.det(vt.T @ u.T)]) @ u.T


@dataclass
class Aligned:
    """Orientation of one IMU in the laboratory at the instants of its samples."""

    q: np.ndarray  # (N, 4)
    good: np.ndarray  # (N,) bool: no jump here
    turn_deg: float  # between the frames of marker cluster and IMU
    lag: float  # of the optical data, samples


def align(gyr: np.ndarray, ref: np.ndarray, dt_s: float) -> Aligned:
    """Frame and lag by comparing rates; sample k of the gyroscope is taken as the mean rate since sample k - 1."""
    rates = steps(ref) / dt_s
    index = np.arange(len(gyr), dtype=float)
    shifted = [np.column_stack([np.interp(index[1:] - lag, index, column) for column in gyr.T]) for lag in LAGS]
    good = np.ones(len(rates), bool)
    for _ in range(3):
        turns = [turn_between(rates[good], rate[good]) for rate in shifted]
        apart = [np.linalg.norm(rates @ turn.T - rate, axis=1) for turn, rate in zip(turns, shifted, strict=True)]
        best = int(np.argmin([np.mean(a[good] ** 2) for a in apart]))
        good = apart[best] < JUMP_RAD_S
    cluster_to_imu = from_matrix(turns[best])
    mask = np.ones(len(gyr), bool)
    mask[:-1] &= good
    mask[1:] &= good
    angle = 2.0 * np.arctan2(np.linalg.norm(cluster_to_imu[1:]), abs(cluster_to_imu[0]))
    q = interpolate(multiply(ref, conjugate(cluster_to_imu)[None, :]), index + LAGS[best])
    return Aligned(q, mask, float(np.degrees(angle)), float(LAGS[best]))


def interpolate(q: np.ndarray, at: np.ndarray) -> np.ndarray:
    """Orientations at fractions of a sample; neighbours are near each other, so the chord will do."""
    low = np.clip(np.floor(at).astype(int), 0, len(q) - 2)
    share = np.clip(at - low, 0.0, 1.0)[:, None]
    a, b = q[low], q[low + 1]
    b = b * np.where((a * b).sum(1, keepdims=True) < 0.0, -1.0, 1.0)
    mixed = (1.0 - share) * a + share * b
    return mixed / np.linalg.norm(mixed, axis=1, keepdims=True)


def frame_of(axis: np.ndarray, place: np.ndarray) -> np.ndarray:
    """A rotation that takes unit vector `place` to `axis`; the two are not opposite."""
    q = np.concatenate([[1.0 + place @ axis], np.cross(place, axis)])
    return q / np.linalg.norm(q)


def two_dof_angles(q1: np.ndarray, q2: np.ndarray, j1: np.ndarray, j2: np.ndarray) -> np.ndarray:
    """Flexion, carrying angle and pronation (N, 3), rad: from the rotation matrix of segment 2 in segment 1."""
    x, y, z = np.eye(3)
    b1, b2 = multiply(q1, frame_of(j1, z)[None, :]), multiply(q2, frame_of(j2, y)[None, :])
    relative = multiply(conjugate(b1), b2)
    rx, ry, rz = (rotate(relative, np.tile(e, (len(relative), 1))) for e in (x, y, z))
    return np.column_stack([np.arctan2(-ry[:, 0], ry[:, 1]), np.arcsin(np.clip(ry[:, 2], -1.0, 1.0)),
                            np.arctan2(-rx[:, 2], rz[:, 2])])


def hinge_angle(q1: np.ndarray, q2: np.ndarray, j1: np.ndarray, j2: np.ndarray) -> np.ndarray:
    """Flexion (N,), rad: the twist about the common axis."""
    z = np.array([0.0, 0.0, 1.0])
    relative = multiply(conjugate(multiply(q1, frame_of(j1, z)[None, :])), multiply(q2, frame_of(j2, z)[None, :]))
    return 2.0 * np.arctan2(relative[:, 3], relative[:, 0])


def fit_axes(q1: np.ndarray, q2: np.ndarray, j1: np.ndarray, j2: np.ndarray,
             hinge: bool) -> tuple[np.ndarray, np.ndarray]:
    """Axes near (j1, j2) that fit the optical orientations best: equal (hinge), or at a constant angle to each other."""
    relative = multiply(conjugate(q1), q2)
    for _ in range(10):
        t1, t2 = np.linalg.svd(j1[None, :])[2][1:].T, np.linalg.svd(j2[None, :])[2][1:].T
        moved = rotate(relative, np.tile(j2, (len(relative), 1)))
        slopes = [rotate(relative, np.tile(t, (len(relative), 1))) for t in t2.T]
        if hinge:
            residual = (moved - j1).ravel()
            columns = [*(np.tile(-t, len(relative)) for t in t1.T), *(s.ravel() for s in slopes)]
        else:
            residual = moved @ j1
            columns = [*(moved @ t for t in t1.T), *(s @ j1 for s in slopes), np.ones(len(relative))]
        step = np.linalg.lstsq(np.column_stack(columns), -residual, rcond=None)[0]
        j1, j2 = j1 + t1 @ step[:2], j2 + t2 @ step[2:4]
        j1, j2 = j1 / np.linalg.norm(j1), j2 / np.linalg.norm(j2)
    return j1, j2


def references(rec: Recording) -> tuple[Aligned, Aligned]:
    """Both IMUs of a rig recording."""
    dt_s = 1.0 / rec.rate_hz
    return tuple(align(gyr, np.column_stack([rec.columns[f"ref_q{sensor}_{part}"] for part in "wxyz"]), dt_s)
                 for sensor, gyr in ((1, rec.gyr1), (2, rec.gyr2)))
