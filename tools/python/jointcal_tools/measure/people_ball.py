"""What a person's joint without a common axis says beside the truth: heading, both levers, both axes, each known or not by itself.

Five numbers go together everywhere: ITEMS, as columns, deg or m as UNITS says.
"""

from __future__ import annotations

import functools
import json
from dataclasses import dataclass

import numpy as np

from ..native_two_axes import Track
from ..recordings import Recording
from . import optical
from .harness import Report
from .judge import data_folder, line_angle_deg, recording
from .people_flexion import wrapped_deg
from .people_joints import JOINTS, people_joint

ITEMS = ("heading", "lever 1", "lever 2", "axis 1", "axis 2")
UNITS = ("deg", "mm", "mm", "deg", "deg")
SCALES = (1.0, 1e3, 1e3, 1.0, 1.0)  # from the numbers to UNITS
HEADING, LEVERS, AXES = 0, (1, 2), (3, 4)
HEADING_S = 1.0
BEYOND = 2.0  # times its bound: what is known must never be farther off
UNKNOWN_BOUNDS = np.array([89.0, 9.0, 9.0, 89.0, 89.0])  # deg, m: from here on nothing is stated

Pair = tuple[np.ndarray | None, np.ndarray | None]
NONE: Pair = (None, None)


@dataclass(frozen=True)
class Truth:
    """As far as there is one."""

    heading_deg: np.ndarray | None = None  # (N,) at samples, of level frame 2 to 1 of the sensor stage; NaN where it is not known
    levers: Pair = NONE  # joint to sensor, m, in the sensor's frame
    axes: Pair = NONE  # of bending in sensor frame 1, of turning in sensor frame 2


def yaw_deg(q: np.ndarray) -> np.ndarray:
    """(N,) of rotations (N, 4): the turn about z that is nearest to each."""
    return wrapped_deg(2.0 * np.degrees(np.arctan2(q[:, 3], q[:, 0])))


def circular_mean_deg(angle_deg: np.ndarray, count: int) -> np.ndarray:
    """(N,) mean over `count` samples around each, of those that are known; NaN where that one itself is not."""
    known_ones = np.isfinite(angle_deg)
    turned = np.where(known_ones, np.exp(1j * np.radians(np.where(known_ones, angle_deg, 0.0))), 0.0)
    mean = np.convolve(turned, np.ones(count), "full")[count // 2: count // 2 + len(turned)]
    return np.where(known_ones, np.degrees(np.angle(mean)), np.nan)


def true_heading_deg(own: tuple[np.ndarray, np.ndarray], lab: tuple[np.ndarray, np.ndarray], rate_hz: float | None = None) -> np.ndarray:
    """(N,) heading of level frame 2 to 1: of both sensors' orientations to their level frames and to one frame with z up.

    R_lab,i = Rz(y_i) R_i but for errors of inclination, so R1' Rz(d) R2 = R_lab,1' R_lab,2 wants d = y2 - y1.
    With a rate the mean over HEADING_S: level frames drift slowly, but at 40 Hz and 20 rad/s one orientation may be off by 10 deg.
    """
    y1, y2 = (yaw_deg(optical.multiply(q_lab, optical.conjugate(q_own))) for q_lab, q_own in zip(lab, own, strict=True))
    heading = wrapped_deg(y2 - y1)
    return heading if rate_hz is None else circular_mean_deg(heading, max(round(HEADING_S * rate_hz), 1))


def known(track: Track) -> np.ndarray:
    """(M, 5) bool."""
    return np.column_stack([track.for_heading, track.for_center, track.for_axis])


def bounds(track: Track) -> np.ndarray:
    """(M, 5)"""
    return np.column_stack([track.heading_bound_deg, track.lever_bounds_m, track.axis_bounds_deg])


def errors(track: Track, truth: Truth) -> np.ndarray:
    """(M, 5), NaN where there is no truth."""
    found = np.full((len(track.t_s), 5), np.nan)
    if truth.heading_deg is not None:
        found[:, HEADING] = np.abs(wrapped_deg(track.heading_deg - truth.heading_deg[track.sample]))
    for item, r, right in zip(LEVERS, (track.r1, track.r2), truth.levers, strict=True):
        if right is not None:
            found[:, item] = np.linalg.norm(r - right, axis=1)
    for item, axis, right in zip(AXES, (track.axis1, track.axis2), truth.axes, strict=True):
        if right is not None:
            found[:, item] = line_angle_deg(axis, right)
    return found


def first(flags: np.ndarray) -> int | None:
    """The first that is set."""
    return int(flags.argmax()) if flags.any() else None


def at_ticks(values: np.ndarray, ticks: np.ndarray, count: int) -> np.ndarray:
    """(N, ...) at samples: what was said last; NaN before the first tick. values (M, ...) of ticks at samples (M,)."""
    last = np.searchsorted(ticks, np.arange(count), side="right") - 1
    held = np.asarray(values, float)[np.maximum(last, 0)] if len(ticks) else np.full((count, *np.shape(values)[1:]), np.nan)
    held[last < 0] = np.nan
    return held


Known = tuple[float, str]  # what is reached where a requirement is not met, as a share, and why


def require_share(report: Report, text: str, hits: int, total: int, minimum: float, known_why: Known | None = None) -> None:
    """As Report.require_share; `known_why` is no longer one if less than its share is reached."""
    if total == 0:
        return
    report.require_share(text, hits, total, minimum)
    if known_why and hits >= known_why[0] * total:
        report.requirements[-1].known = known_why[1]


def require_none(report: Report, text: str, count: int, total: int, known_why: Known | None = None) -> None:
    """As Report.require_none; `known_why` is no longer one if more than its share, or one, happen."""
    report.require_none(text, count, total)
    if known_why and count <= max(known_why[0] * total, 1.0):
        report.requirements[-1].known = known_why[1]


def whole(name: str) -> Recording:
    """A joint of people or a rig."""
    return people_joint(name) if name in JOINTS else recording(name)


@functools.cache
def facts(name: str) -> dict:
    return json.loads((data_folder() / f"{JOINTS[name].file if name in JOINTS else name}.json").read_text())


@functools.cache
def lab_quaternions(name: str) -> tuple[np.ndarray, np.ndarray] | None:
    """(N, 4), (N, 4) of both sensors to a laboratory with z up, from optical references; NaN where they are wrong; None without any."""
    rec = whole(name)
    if "ref_q1_w" not in rec.columns:
        return None
    if name in JOINTS:  # the sensors' frames are those of the clusters
        return tuple(np.column_stack([rec.columns[f"ref_q{sensor}_{part}"] for part in "wxyz"]) for sensor in (1, 2))
    return tuple(np.where(aligned.good[:, None], aligned.q, np.nan) for aligned in optical.references(rec))


def unit(values: list[float] | None) -> np.ndarray | None:
    return None if values is None else np.array(values, float) / np.linalg.norm(values)


def lever_truth(name: str) -> Pair:
    return tuple(None if key not in facts(name) else np.array(facts(name)[key]) for key in ("joint_to_sensor1_m", "joint_to_sensor2_m"))


def axis_truth(name: str) -> Pair:
    """Of an elbow, from isolated motion in another trial of the person; of a rig with one or two axes, nominal."""
    return tuple(unit(facts(name).get(f"axis{k}_ref", facts(name).get(f"axis{k}"))) for k in (1, 2))


def truth_of(name: str, track: Track, begin: int = 0, axes: Pair | None = None) -> Truth:
    """What is known of a passage that begins with sample `begin` of a recording."""
    lab, count = lab_quaternions(name), len(track.q1)
    heading = None if lab is None else true_heading_deg((track.q1, track.q2), tuple(q[begin: begin + count] for q in lab),
                                                         whole(name).rate_hz)
    return Truth(heading, lever_truth(name), axis_truth(name) if axes is None else axes)
