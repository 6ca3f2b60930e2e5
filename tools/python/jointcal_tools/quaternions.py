"""Unit quaternions (w, x, y, z) as rows (N, 4); q_s_e rotates a vector from frame s to frame e."""

from __future__ import annotations

import numpy as np


def multiply(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Hamilton product of (..., 4) with (..., 4)."""
    p, q = np.broadcast_arrays(p, q)
    vector = p[..., :1] * q[..., 1:] + q[..., :1] * p[..., 1:] + np.cross(p[..., 1:], q[..., 1:])
    scalar = p[..., 0] * q[..., 0] - (p[..., 1:] * q[..., 1:]).sum(axis=-1)
    return np.concatenate([scalar[..., None], vector], axis=-1)


def conjugate(q: np.ndarray) -> np.ndarray:
    return q * np.array([1.0, -1.0, -1.0, -1.0])


def rotation(angle: np.ndarray | float, axis: np.ndarray) -> np.ndarray:
    """(angle @ axis) of LAI22 section 3: rotation by `angle` (...) about one axis (3,) of any length but zero."""
    half = np.asarray(angle, float)[..., None] / 2.0
    return np.concatenate([np.cos(half), np.sin(half) * (np.asarray(axis, float) / np.linalg.norm(axis))], axis=-1)


def matrices(q: np.ndarray) -> np.ndarray:
    """Rotation matrices (N, 3, 3) of unit quaternions (N, 4)."""
    w, x, y, z = q.T
    return np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
                     2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                     2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)], axis=1).reshape(-1, 3, 3)


def rotation_vectors(q: np.ndarray) -> np.ndarray:
    """Rotation vectors (N, 3), rad, at most pi long, of unit quaternions (N, 4).

    2 atan2(|v|, w) instead of 2 arccos(w): the arccosine loses half of the digits near no rotation.
    """
    q = np.where(q[:, :1] < 0.0, -q, q)
    length = np.linalg.norm(q[:, 1:], axis=1)
    safe = np.where(length > 0.0, length, 1.0)
    factor = np.where(length > 0.0, 2.0 * np.arctan2(length, q[:, 0]) / safe, 2.0)
    return factor[:, None] * q[:, 1:]


def from_rotation_vectors(v: np.ndarray) -> np.ndarray:
    """Inverse of `rotation_vectors`."""
    angle = np.linalg.norm(v, axis=1)
    return np.column_stack([np.cos(angle / 2), (0.5 * np.sinc(angle / (2.0 * np.pi)))[:, None] * v])


def interpolate(p: np.ndarray, q: np.ndarray, share: np.ndarray | float) -> np.ndarray:
    """Great-circle interpolation (N, 4) from p (share 0) to q (share 1)."""
    step = rotation_vectors(multiply(q, conjugate(p)))
    return multiply(from_rotation_vectors(np.asarray(share, float).reshape(-1, 1) * step), p)
