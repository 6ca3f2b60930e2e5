"""How a run is compared with the truth, and where recordings come from."""

from __future__ import annotations

import functools
import json
import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..native import REPOSITORY, Track
from ..recordings import Recording, load_csv
from .harness import Skipped

MAX_ERROR_DEG = 3.0  # the default max_bound: a `ready` with more is false
INFORMATIVE_RAD_S = 0.3  # rms joint rate above which a window should be enough
RIG_HINGES = ("rig_1D_01", "rig_1D_02", "rig_1D_04")


def data_folder() -> Path:
    return Path(os.environ.get("JOINTCAL_DATA") or REPOSITORY / "data")


def available(*names: str) -> list[str]:
    """Those of the named recordings that are there."""
    return [name for name in names if (data_folder() / f"{name}.csv").is_file()]


def need_rig() -> list[str]:
    """The rig's hinge recordings, or Skipped."""
    names = available(*RIG_HINGES)
    if len(names) < len(RIG_HINGES):
        raise Skipped("the rig recordings are not there; JOINTCAL_DATA names their folder")
    return names


@functools.cache
def recording(name: str) -> Recording:
    return load_csv(data_folder() / f"{name}.csv")


@functools.cache
def nominal_axes(name: str) -> tuple[np.ndarray, np.ndarray]:
    facts = json.loads((data_folder() / f"{name}.json").read_text())
    return np.array(facts["axis1"], float), np.array(facts["axis2"], float)


def cut(rec: Recording, begin: int, end: int) -> Recording:
    part = slice(begin, end)
    return Recording(rec.t_s[part], rec.gyr1[part], rec.acc1[part], rec.gyr2[part], rec.acc2[part])


def joint_rate_rms(rec: Recording, axis1: np.ndarray, axis2: np.ndarray) -> float:
    """Of the rate about the joint axis, rad/s."""
    return float(np.sqrt(np.mean((rec.gyr2 @ axis2 - rec.gyr1 @ axis1) ** 2)))


def line_angle_deg(axes: np.ndarray, truth: np.ndarray) -> np.ndarray:
    """Angles (N,) between lines (N, 3) and a line (3,), 0 to 90; a zero vector is 90 off."""
    across = np.linalg.norm(np.cross(axes, truth), axis=-1)
    along = np.abs(axes @ truth)
    return np.where(across + along > 0.0, np.degrees(np.arctan2(across, along)), 90.0)


@dataclass
class Verdict:
    """A track beside the truth."""

    t_s: np.ndarray
    ready: np.ndarray  # (N,) bool
    errors_deg: np.ndarray  # (N, 2), of the lines
    wrong_sign: np.ndarray  # (N,) bool, the wrong pairing
    bounds_deg: np.ndarray  # (N, 2)
    accepted: np.ndarray  # (N,) bool, paper_accepted
    reason: int  # at the end

    @property
    def bad(self) -> np.ndarray:
        """(N,) too far off to be called ready."""
        return self.wrong_sign | (self.errors_deg.max(axis=1) > MAX_ERROR_DEG)

    @property
    def false_ready(self) -> bool:
        return bool((self.ready & self.bad).any())

    def first_ready(self) -> int | None:
        return int(self.ready.argmax()) if self.ready.any() else None

    def first_ready_s(self) -> float:
        index = self.first_ready()
        return float("inf") if index is None else float(self.t_s[index])

    def covered(self, index: int) -> np.ndarray:
        """(2,) whether the truth lies inside the bound of each axis."""
        return (self.errors_deg[index] <= self.bounds_deg[index]) & ~self.wrong_sign[index]


def axis_errors(track: Track, axis1: np.ndarray, axis2: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(M, 2) angles of a track's axes, of either kind, to unit axes, deg, and (M,) whether the pairing is the other one."""
    errors = np.column_stack([line_angle_deg(track.axis1, axis1), line_angle_deg(track.axis2, axis2)])
    return errors, (track.axis1 @ axis1) * (track.axis2 @ axis2) < 0.0


def judge(track: Track, axis1: np.ndarray, axis2: np.ndarray) -> Verdict:
    errors, wrong = axis_errors(track, axis1 / np.linalg.norm(axis1), axis2 / np.linalg.norm(axis2))
    return Verdict(track.t_s, track.ready, errors, wrong, track.bounds_deg, track.paper_accepted,
                   int(track.reason[-1]))
