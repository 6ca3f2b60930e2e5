"""A person's elbow and knee, raw data through VQF: no reference, so only whether parts of a recording agree."""

from __future__ import annotations

import numpy as np

from .. import native
from .. import native_two_dof as two_dof
from .harness import Report, Settings, Skipped, median, number
from .judge import available, recording

TITLE = "A person's elbow and knee: repeatability"
VQF = "all of it"  # what of it needs VQF
RECORDINGS = ("human_elbow_right", "human_knee_left")
PARTS_S = (20, 33)
LIMITS_DEG = (3.0, 10.0, 28.0)  # of max_bound_rad: the default, and up to the largest that there is


def from_mean_deg(axes: list[np.ndarray]) -> np.ndarray:
    """Angles of lines to the line that is nearest to all of them."""
    stacked = np.array(axes)
    mean = np.linalg.eigh(stacked.T @ stacked)[1][:, -1]
    return np.degrees(np.arccos(np.clip(np.abs(stacked @ mean), 0.0, 1.0)))


def runs_of(name: str, length_s: float, limit_deg: float) -> list[two_dof.Track]:
    rec = recording(name)
    q1, q2 = two_dof.orientations(rec)
    t_s = rec.t_s - rec.t_s[0]
    parts = [slice(*np.searchsorted(t_s, [begin, begin + length_s])) for begin in np.arange(0.0, t_s[-1] - length_s + 0.1, length_s)]
    return [two_dof.run(t_s[p] - t_s[p][0], q1[p], q2[p], max_bound_rad=np.radians(limit_deg)) for p in parts]


def measure(settings: Settings, report: Report) -> None:
    del settings
    names = available(*RECORDINGS)
    if not names:
        raise Skipped("the recordings of a person are not there; JOINTCAL_DATA names their folder")
    if not two_dof.has_vqf():
        raise Skipped("the library was built without VQF; tools/vqf.sh brings it")
    report.text("Separate parts of a recording, each given to a fresh stream engine with both constraints. Apart: angles of the parts' "
                "estimates to their mean, in the median, whether ready or not; bound: the median bound they state at the end, 90 if none. "
                "Elbow: forearm sensor distal; knee: taken for a joint with two axes, bending and turning. deg.")
    rows = []
    for name in names:
        whole = recording(name)
        for length_s in (*PARTS_S, whole.t_s[-1] - whole.t_s[0]):
            tracks = {limit: runs_of(name, length_s - 1e-6, limit) for limit in LIMITS_DEG}
            mine = tracks[LIMITS_DEG[0]]
            apart = [from_mean_deg([getattr(t, axis)[-1] for t in mine]) for axis in ("axis1", "axis2")]
            bounds = np.array([t.bounds_deg[-1] for t in mine])
            reasons = sorted({native.reason_name(t.reason[-1]) for t in mine})
            rows.append([name, f"{length_s:.0f} s", len(mine), *(sum(bool(t.ready.any()) for t in tracks[limit]) for limit in LIMITS_DEG),
                         *(number(median(a), 0) if len(mine) > 1 else "-" for a in apart),
                         *(number(median(bounds[:, k]), 0) for k in range(3)), ", ".join(reasons)])
            if length_s == PARTS_S[0]:
                report.require_none(f"{name}: ready although the parts are {number(max(median(a) for a in apart), 0)} deg apart",
                                    sum(bool(t.ready.any()) for t in mine), len(mine))
    report.table(["recording", "parts", "number", *(f"ever ready, limit {limit:g}" for limit in LIMITS_DEG), "axis 1 apart", "axis 2 apart",
                  "bound 1", "bound 2", "bound h", "why not"], rows)
