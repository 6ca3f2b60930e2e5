"""qmt.jointAxisEstHingeOlsson (PyPI qmt), the public implementation of OLS20, for comparison only."""

from __future__ import annotations

import contextlib
import importlib.metadata
import io

import numpy as np

from ..recordings import Recording
from .judge import line_angle_deg

INSTALL_HINT = "qmt is not installed; for the comparison: pip install qmt"
SELECTED = {"useSampleSelection": True, "dataSize": 500}
STARTS, MANY, START_SEED = 8, 64, 2020


def qmt_version() -> str | None:
    """None if qmt is not there."""
    try:
        import qmt  # noqa: F401, PLC0415
        return importlib.metadata.version("qmt")
    except ImportError:
        return None


def starts() -> np.ndarray:
    """(MANY, 4): qmt's own start, zero, and axes drawn from the sphere as the paper does; inclination and azimuth of both, rad."""
    drawn = np.random.default_rng(START_SEED).standard_normal((MANY - 1, 2, 3))
    angles = np.stack([np.arctan2(drawn[..., 2], np.linalg.norm(drawn[..., :2], axis=-1)),
                       np.arctan2(drawn[..., 1], drawn[..., 0])], axis=-1)
    return np.vstack([np.zeros(4), angles.reshape(-1, 4)])


def run_from(rec: Recording, settings: dict) -> tuple[np.ndarray, np.ndarray, float]:
    """The two axes and their cost; zero vectors and infinity if qmt fails. What it prints is suppressed."""
    import qmt  # noqa: PLC0415
    with contextlib.redirect_stdout(io.StringIO()), np.errstate(all="ignore"):
        try:
            j1, j2, found = qmt.jointAxisEstHingeOlsson(rec.acc1, rec.acc2, rec.gyr1, rec.gyr2, settings, debug=True)
        except (ValueError, IndexError, np.linalg.LinAlgError):
            return np.zeros(3), np.zeros(3), np.inf
    cost = float(np.squeeze(found["optimVarsAxis"]["f"]))
    return np.ravel(j1).astype(float), np.ravel(j2).astype(float), cost if np.isfinite(cost) else np.inf


def estimate(rec: Recording, settings: dict | None = None) -> tuple[np.ndarray, np.ndarray]:
    """The two axes, from qmt's own start."""
    return run_from(rec, dict(settings or {}))[:2]


def errors(found: tuple, axis1: np.ndarray, axis2: np.ndarray) -> tuple[float, float, bool]:
    """Both errors of what was found, in deg, and whether the pairing is wrong."""
    j1, j2 = found[:2]
    return (float(line_angle_deg(j1, axis1)), float(line_angle_deg(j2, axis2)),
            bool((j1 @ axis1) * (j2 @ axis2) < 0.0))


def run_starts(rec: Recording, settings: dict | None, count: int) -> list[tuple[np.ndarray, np.ndarray, float]]:
    """What the first `count` of starts() lead to; each tries both pairings."""
    return [run_from(rec, {**(settings or {}), "x0": start.reshape(4, 1)}) for start in starts()[:count]]


def cheapest(found: list[tuple]) -> tuple:
    return min(found, key=lambda one: one[2])


def draws(count: int = 20) -> np.ndarray:
    """(count, STARTS): which of starts() to take, qmt's own among them."""
    rng = np.random.default_rng(START_SEED)
    return np.array([[0, *(1 + rng.choice(MANY - 1, STARTS - 1, replace=False))] for _ in range(count)])
