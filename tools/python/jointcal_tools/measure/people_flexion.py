"""The angle of a joint from orientations, a heading and axes, and how far two angles are apart."""

from __future__ import annotations

import numpy as np

from .. import native_functional
from .. import quaternions as quat

LEAST_SAMPLES = 20  # below which an rms says nothing


def wrapped_deg(angle: np.ndarray) -> np.ndarray:
    return np.mod(np.asarray(angle) + 180.0, 360.0) - 180.0


def tangents(axis: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Two unit vectors across a unit axis, right-handed with it."""
    u = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    u /= np.linalg.norm(u)
    return u, np.cross(axis, u)


def twist_deg(orientations: tuple[np.ndarray, np.ndarray], heading_deg: np.ndarray, axis1: np.ndarray, axis2: np.ndarray) -> np.ndarray:
    """(N,) twist about the axes of R1' Rz(heading) R2, from a zero that the axes make.

    Orientations (N, 4) of both sensors to their level frames; heading (N,) of level frame 2 to 1; axes of unit length.
    """
    (u1, v1), (u2, v2) = tangents(axis1), tangents(axis2)
    r1, r2 = (quat.matrices(q) for q in orientations)
    c, s = np.cos(np.radians(heading_deg)), np.sin(np.radians(heading_deg))

    def in_level1(v: np.ndarray) -> np.ndarray:
        level = r2 @ v
        return np.column_stack([c * level[:, 0] - s * level[:, 1], s * level[:, 0] + c * level[:, 1], level[:, 2]])

    a, b = in_level1(u2), in_level1(v2)
    x, y = r1 @ u1, r1 @ v1
    return np.degrees(np.arctan2((y * a).sum(axis=1) - (x * b).sum(axis=1), (x * a).sum(axis=1) + (y * b).sum(axis=1)))


def apart_deg(found_deg: np.ndarray, reference_deg: np.ndarray) -> np.ndarray:
    """(N,) difference without a constant, with the sense of `found` that leaves less; NaN where either is not known."""
    best = np.full(len(found_deg), np.nan)
    for sense in (1.0, -1.0):
        off = wrapped_deg(sense * found_deg - reference_deg)
        good = np.isfinite(off)
        if not good.any():
            return best
        middle = np.degrees(np.angle(np.exp(1j * np.radians(off[good])).mean()))
        off = wrapped_deg(off - middle)
        off = off - off[good].mean()
        if not np.isfinite(best).any() or np.nanmean(off**2) < np.nanmean(best**2):
            best = off
    return best


def apart_rms_deg(found_deg: np.ndarray, reference_deg: np.ndarray) -> float:
    """rms of `apart_deg`; NaN where too little is known."""
    off = apart_deg(found_deg, reference_deg)
    known = off[np.isfinite(off)]
    return float(np.sqrt(np.mean(known**2))) if len(known) >= LEAST_SAMPLES else float("nan")


def heading_at_samples(track: native_functional.Track, count: int) -> np.ndarray:
    """(N,) heading that was known last; NaN before the first tick."""
    heading = np.full(count, np.nan)
    for begin, end, value in zip(track.sample, [*track.sample[1:], count], track.heading_deg, strict=True):
        heading[begin:end] = value
    return heading
