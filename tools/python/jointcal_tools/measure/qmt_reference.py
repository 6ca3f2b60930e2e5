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


def qmt_version() -> str | None:
    """None if qmt is not there."""
    try:
        import qmt  # noqa: F401, PLC0415
        return importlib.metadata.version("qmt")
    except ImportError:
        return None


def estimate(rec: Recording, settings: dict | None = None) -> tuple[np.ndarray, np.ndarray]:
    """The two axes; zero vectors if qmt fails. What it prints is suppressed."""
    import qmt  # noqa: PLC0415
    with contextlib.redirect_stdout(io.StringIO()), np.errstate(all="ignore"):
        try:
            j1, j2 = qmt.jointAxisEstHingeOlsson(rec.acc1, rec.acc2, rec.gyr1, rec.gyr2,
                                                 dict(settings) if settings else None)
        except (ValueError, IndexError, np.linalg.LinAlgError):
            return np.zeros(3), np.zeros(3)
    return np.ravel(j1).astype(float), np.ravel(j2).astype(float)


def errors(rec: Recording, axis1: np.ndarray, axis2: np.ndarray, settings: dict | None) -> tuple[float, float, bool]:
    """Both errors in deg and whether the pairing is wrong."""
    j1, j2 = estimate(rec, settings)
    return (float(line_angle_deg(j1, axis1)), float(line_angle_deg(j2, axis2)),
            bool((j1 @ axis1) * (j2 @ axis2) < 0.0))
