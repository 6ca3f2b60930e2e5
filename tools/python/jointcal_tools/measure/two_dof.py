"""2-DoF joint on the rig: whole recordings, and every 5, 10, 20 s window given to a fresh instance."""

from __future__ import annotations

import functools
from collections import Counter
from dataclasses import dataclass

import numpy as np

from .. import lai22, native
from .. import native_two_dof as two_dof
from .. import quaternions as quat
from ..lai22_signals import SELECT_S, Prepared, Samples, median_angle, prepare, reference_heading, select_indices
from .harness import Report, Settings, Skipped, median, number, percent, quantile, run_jobs
from .judge import available, line_angle_deg, nominal_axes, recording

TITLE = "2-DoF joint: rig recordings, whole and in windows"
VQF = "all of it"  # what of it needs VQF
RIG = ("rig_2D_01", "rig_2D_02", "rig_2D_05")
CONSTRAINTS = ("combined", "rotation", "orientation")
LENGTHS_S = (5, 10, 20)
AXIS_DEG = HEADING_DEG = 1.3
INFORMATIVE_RAD_S = 0.3  # of both joint rates and of the first sensor's rate, rms
READY_SHARE_10_S = 0.85
MEDIAN_DEG, MOST_DEG = 0.8, 2.0
SAME_MINIMUM_DEG = 0.05  # window engine and float64 on its buffer, at the end of a recording
NUMPY_FORM = {"rotation": "rotation", "orientation": "orientation-variance"}  # sin(beta0) eliminated
WINDOW_ENDS = 12  # places in each recording at which they are compared besides
SAME_FORM_DEG = 0.2  # stream and window engine, same constraint and data
HEADING_LAST_S = 10.0


@dataclass
class Rig:
    t_s: np.ndarray
    q1: np.ndarray
    q2: np.ndarray
    heading_deg: np.ndarray  # optical, (N,)
    axes: tuple[np.ndarray, np.ndarray]


@functools.cache
def rig(name: str) -> Rig:
    rec = recording(name)
    q1, q2 = two_dof.orientations(rec)
    refs = [np.column_stack([rec.columns[f"ref_q{i}_{part}"] for part in "wxyz"]) for i in (1, 2)]
    heading = np.degrees(reference_heading(refs[0], q1.astype(float), refs[1], q2.astype(float)))
    return Rig(rec.t_s - rec.t_s[0], q1, q2, heading, nominal_axes(name))


def need_rig() -> list[str]:
    names = available(*RIG)
    if len(names) < len(RIG):
        raise Skipped("the rig recordings are not there; JOINTCAL_DATA names their folder")
    if not two_dof.has_vqf():
        raise Skipped("the library was built without VQF; tools/vqf.sh brings it")
    return names


def wrap_deg(angle: np.ndarray | float) -> np.ndarray | float:
    return -(np.mod(-np.asarray(angle) + 180.0, 360.0) - 180.0)


def is_false(errors: np.ndarray, bounds: np.ndarray) -> np.ndarray:
    """(N,) axis errors (N, 2) that `ready` must not have: above 10 deg, or beyond twice the bound plus 1 deg of the rig."""
    return ((errors > 10.0) | (errors > (2.0 * bounds + 1.0))).any(axis=1)


def errors_of(track: two_dof.Track, axes: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    return np.column_stack([line_angle_deg(track.axis1, axes[0]), line_angle_deg(track.axis2, axes[1])])


def is_informative(part: Rig) -> bool:
    """Rates about both axes of the joint, solved for at the nominal axes and the optical heading, and of sensor 1."""
    s = prepare(part.q1.astype(float), part.q2.astype(float), part.t_s, "none").samples
    turn = lai22.heading_matrix(median_angle(np.radians(part.heading_deg)))
    first, second = s.r1 @ part.axes[0], (s.r2 @ part.axes[1]) @ turn.T
    relative = s.w2 @ turn.T - s.w1
    basis = np.stack([first, second, np.cross(first, second)], axis=-1)
    rates = np.linalg.solve(basis, relative[..., None])[..., 0]
    rms = [*np.sqrt(np.mean(rates[:, :2] ** 2, axis=0)), np.sqrt(np.mean(np.sum(s.w1**2, axis=1)))]
    return min(rms) > INFORMATIVE_RAD_S


@dataclass
class Outcome:
    constraint: str
    length_s: int
    place: str
    informative: bool
    ready: bool
    false_ready: bool
    errors: np.ndarray  # (3,) axis1, axis2, heading at the end, deg
    bounds: np.ndarray
    covered_first: np.ndarray | None  # (3,) at first ready
    reason: str


def measure_window(job: tuple[str, int, int]) -> list[Outcome]:
    name, length_s, index = job
    whole = rig(name)
    part = slice(*np.searchsorted(whole.t_s, [index * length_s, (index + 1) * length_s]))
    cut = Rig(whole.t_s[part], whole.q1[part], whole.q2[part], whole.heading_deg[part], whole.axes)
    informative = is_informative(cut)
    outcomes = []
    for constraint in CONSTRAINTS:
        track = two_dof.run(cut.t_s, cut.q1, cut.q2, constraint=constraint)
        errors = errors_of(track, cut.axes)
        heading = np.abs(wrap_deg(track.heading_deg - np.degrees(median_angle(np.radians(cut.heading_deg)))))
        every = np.column_stack([errors, heading])
        first = track.first_ready()
        outcomes.append(Outcome(constraint, length_s, f"{name}, window {index} of {length_s} s", informative,
                                bool(track.ready[-1]),
                                bool((track.ready & is_false(errors, track.bounds_deg[:, :2])).any()), every[-1],
                                track.bounds_deg[-1], None if first is None else every[first] <= track.bounds_deg[first],
                                native.reason_name(track.reason[-1])))
    return outcomes


def window_row(length_s: int, constraint: str, mine: list[Outcome]) -> list:
    informative = [o for o in mine if o.informative]
    ready = [o for o in mine if o.ready]
    axes = np.array([o.errors[:2] for o in ready]).ravel()
    bounds = np.array([o.bounds[:2] for o in ready]).ravel()
    first = [o.covered_first for o in mine if o.covered_first is not None]
    reasons = Counter(o.reason for o in informative if not o.ready)
    return [f"{length_s} s", constraint, len(mine), len(informative),
            percent(sum(o.ready for o in informative), len(informative)), sum(o.false_ready for o in mine),
            number(median(axes)), number(quantile(axes, 0.9)), number(median(bounds)), number(median([o.errors[2] for o in ready])),
            number(quantile([o.errors[2] for o in ready], 0.9)),
            *(percent(sum(c[k] for c in first), len(first)) for k in range(3)),
            ", ".join(f"{name} {count}" for name, count in reasons.most_common()) or "-"]


def optical_heading(whole: Rig) -> float:
    """Median over the last 10 s, deg."""
    last = whole.t_s > (whole.t_s[-1] - HEADING_LAST_S)
    return float(np.degrees(median_angle(np.radians(whole.heading_deg[last]))))


def whole_recordings(names: list[str], report: Report) -> None:
    rows = []
    for name in names:
        whole = rig(name)
        for constraint in CONSTRAINTS:
            track = two_dof.run(whole.t_s, whole.q1, whole.q2, constraint=constraint)
            errors = errors_of(track, whole.axes)
            heading = abs(float(wrap_deg(track.heading_deg[-1] - optical_heading(whole))))
            first = track.first_ready()
            ready = track.ready
            rows.append([name, constraint, number(np.inf if first is None else track.t_s[first], 1),
                         number(errors[-1, 0]), number(errors[-1, 1]), number(heading),
                         *(number(b) for b in track.bounds_deg[-1]),
                         number(errors[ready].max() if ready.any() else np.nan), percent(ready.sum(), len(ready)),
                         len(track.moved)])
            if constraint == "combined":
                report.require_most(f"{name}: axis errors at the end", max(errors[-1]), AXIS_DEG, " deg")
                report.require_most(f"{name}: heading error at the end", heading, HEADING_DEG, " deg")
                report.require_none(f"{name}: false ready or false moved",
                                    int((ready & is_false(errors, track.bounds_deg[:, :2])).sum()) + len(track.moved),
                                    len(ready))
    report.text("Whole recordings from a cold start, orientations by VQF, nominal axes j1 = y, j2 = z, deg. The heading is "
                "compared with the optical one, the median over the last 10 s.")
    report.table(["recording", "constraint", "ready after, s", "error 1", "error 2", "heading", "bound 1", "bound 2",
                  "bound h", "worst while ready", "ready", "moved"], rows)


def against_numpy(names: list[str], report: Report) -> None:
    """The rotation-based stream engine on 20 s, and float64 on the samples themselves."""
    apart = []
    for name in names:
        whole = rig(name)
        for begin in range(0, int(whole.t_s[-1]) - 20, 40):
            part = slice(*np.searchsorted(whole.t_s, [begin, begin + 20]))
            track = two_dof.run(whole.t_s[part], whole.q1[part], whole.q2[part], constraint="rotation", memory_s=600.0)
            if not track.ready[-1]:
                continue
            prepared = prepare(whole.q1[part].astype(float), whole.q2[part].astype(float), whole.t_s[part], "none")
            best = lai22.solve(prepared.samples, "rotation")
            apart.append(max(float(line_angle_deg(track.axis1[-1], best.pose.j1)),
                             float(line_angle_deg(track.axis2[-1], best.pose.j2))))
    report.text("Rotation-based constraint on windows of 20 s: axes of the stream engine and of float64 on the samples, "
                f"which weighs all alike and low-passes nothing: {number(median(apart))} deg apart in the median, "
                f"{number(max(apart, default=np.nan))} deg at most, {len(apart)} windows.")


def kept_samples(t_us: np.ndarray, q1: np.ndarray, q2: np.ndarray) -> Prepared:
    """Data sets by the window engine's rule: one every 0.05 s or more, rates from its neighbours on both sides."""
    indices = select_indices(t_us * 1e-6)
    span_s = (t_us[indices[2:]] - t_us[indices[:-2]])[:, None] * 1e-6
    poses = [q[indices].astype(float) for q in (q1, q2)]
    poses = [q / np.linalg.norm(q, axis=1, keepdims=True) for q in poses]
    rates = [quat.rotation_vectors(quat.multiply(q[2:], quat.conjugate(q[:-2]))) / span_s for q in poses]
    middle = indices[1:-1]
    return Prepared(Samples(*(quat.matrices(q[1:-1]) for q in poses), *rates), t_us[middle] * 1e-6, middle, 0.0)


def window_apart(whole: Rig, constraint: str, end_s: float) -> tuple[float, bool]:
    """Window engine after `end_s`, float64 on its buffer: largest angle between their axes, deg; ready."""
    part = slice(0, int(np.searchsorted(whole.t_s, end_s, "right")))
    t_us, q1, q2 = native.microseconds(whole.t_s[part]).astype(np.int64), whole.q1[part], whole.q2[part]
    track, kept_us = two_dof.run_window(whole.t_s[part], q1, q2, constraint=constraint)
    prepared = kept_samples(t_us, q1, q2)
    indices = np.flatnonzero(np.isin(t_us[prepared.source], kept_us.astype(np.int64)))
    if len(indices) != len(kept_us):
        raise RuntimeError("the window engine kept other samples than its rule says")
    pose = lai22.solve_on_indices(prepared, indices, NUMPY_FORM[constraint]).pose
    apart = max(float(line_angle_deg(track.axis1[-1], pose.j1)), float(line_angle_deg(track.axis2[-1], pose.j2)))
    return apart, bool(track.ready[-1])


def window_engine(names: list[str], report: Report) -> None:
    """The window engine on whole recordings, and against float64 from many starts on the samples in its buffer."""
    rows = []
    for name in names:
        whole = rig(name)
        for constraint in NUMPY_FORM:
            track, _ = two_dof.run_window(whole.t_s, whole.q1, whole.q2, constraint=constraint)
            errors, ready, first = errors_of(track, whole.axes), track.ready, track.first_ready()
            at_end = window_apart(whole, constraint, whole.t_s[-1])[0]
            places = [window_apart(whole, constraint, end_s) for end_s in np.linspace(20.0, whole.t_s[-1], WINDOW_ENDS)]
            while_ready = [apart for apart, is_ready in places if is_ready]
            rows.append([name, constraint, number(np.inf if first is None else track.t_s[first], 1),
                         percent(ready.sum(), len(ready)), number(errors[ready].max() if ready.any() else np.nan),
                         number(at_end, 4), number(max(while_ready, default=np.nan), 4), len(while_ready)])
            report.require_most(f"window engine, {constraint}, {name}: apart from float64 at the end", at_end,
                                SAME_MINIMUM_DEG, " deg")
            report.require_none(f"window engine, {constraint}, {name}: false ready",
                                int((ready & is_false(errors, track.bounds_deg[:, :2])).sum()), len(ready))
    report.text("Window engine, 200 samples, whole recordings. Apart: largest angle between its axes and those of float64, "
                "solved from many starts, on the samples in its buffer; at the end, and the most at "
                f"{WINDOW_ENDS} places per recording, those at which it is ready. deg.")
    report.table(["recording", "constraint", "ready after, s", "ready", "worst while ready", "apart at the end",
                  "apart while ready", "places"], rows)


def both_engines(part: Rig, constraint: str) -> tuple[float, bool]:
    """Stream engine that forgets nothing and window engine whose buffer holds all: angle between their axes, deg; both ready."""
    samples = int((part.t_s[-1] - part.t_s[0]) / SELECT_S) + 2
    stream = two_dof.run(part.t_s, part.q1, part.q2, constraint=constraint, memory_s=600.0)
    window, _ = two_dof.run_window(part.t_s, part.q1, part.q2, constraint=constraint, n_max=samples)
    apart = max(float(line_angle_deg(stream.axis1[-1], window.axis1[-1])), float(line_angle_deg(stream.axis2[-1], window.axis2[-1])))
    return apart, bool(stream.ready[-1] and window.ready[-1])


def stream_against_window(names: list[str], report: Report) -> None:
    """Both engines, same constraint, same data."""
    rows = []
    for constraint in NUMPY_FORM:
        for length_s in (10, 20, 50, None):
            aparts, count = [], 0
            for name in names:
                whole = rig(name)
                span_s = length_s or int(whole.t_s[-1])
                for begin in range(0, int(whole.t_s[-1]) - span_s + 1, span_s):
                    part = slice(*np.searchsorted(whole.t_s, [begin, begin + span_s]))
                    cut = Rig(whole.t_s[part], whole.q1[part], whole.q2[part], whole.heading_deg[part], whole.axes)
                    apart, ready = both_engines(cut, constraint)
                    count += 1
                    aparts += [apart] if ready else []
            rows.append([constraint, f"{length_s} s" if length_s else "whole", count, len(aparts), number(median(aparts), 3),
                         number(max(aparts, default=np.nan), 3)])
            if not length_s and aparts:
                report.require_most(f"{constraint}, whole recordings: stream and window engine apart", max(aparts), SAME_FORM_DEG,
                                    " deg")
    report.text("Stream engine that forgets nothing and window engine whose buffer holds all samples, same constraint, same data: "
                "largest angle between their axes where both end ready, deg. The window engine weighs all samples alike and takes "
                "20 a second; the stream engine weighs each by what it can tell, which is what sets them apart on short data. In the "
                "five minutes of rig_2D_05 the heading drifts by more than one constant can describe.")
    report.table(["constraint", "data", "windows", "both ready", "apart, median", "apart, most"], rows)


def measure(settings: Settings, report: Report) -> None:
    names = need_rig()
    whole_recordings(names, report)
    against_numpy(names[:1] if settings.quick else names, report)
    window_engine(names[:1] if settings.quick else names, report)
    stream_against_window(names[:1] if settings.quick else names, report)
    jobs = [(name, length_s, index) for name in names for length_s in LENGTHS_S
            for index in range(int(rig(name).t_s[-1] // length_s))]
    jobs = jobs[::3] if settings.quick else jobs
    outcomes = [o for found in run_jobs(measure_window, jobs, "two_dof", settings) for o in found]
    report.text("Consecutive windows, each given to a fresh instance. Informative: both joint rates and that of sensor 1 "
                f"above {INFORMATIVE_RAD_S} rad/s rms. False ready: at any time `ready` with an axis more than 10 deg off, "
                "or beyond twice its bound plus 1 deg for the rig's own error. Errors of the windows that end ready, deg; "
                "heading against the optical median of the window. Cover: inside the bound at first ready.")
    groups = {(length_s, constraint): [o for o in outcomes if (o.length_s, o.constraint) == (length_s, constraint)]
              for length_s in LENGTHS_S for constraint in CONSTRAINTS}
    report.table(["length", "constraint", "windows", "informative", "of these ready", "false ready", "axis median",
                  "axis 90 %", "axis bound, median", "heading median", "heading 90 %", "cover 1", "cover 2", "cover h", "reasons"],
                 [window_row(*key, mine) for key, mine in groups.items()])
    for (length_s, constraint), mine in groups.items():
        report.require_none(f"{constraint}, {length_s} s: false ready", sum(o.false_ready for o in mine), len(mine))
    ten = groups[10, "combined"]
    informative = [o.ready for o in ten if o.informative]
    report.require_share("combined, 10 s: informative windows that end ready", sum(informative), len(informative),
                         READY_SHARE_10_S)
    axes = np.array([o.errors[:2] for o in ten if o.ready]).ravel()
    report.require_most("combined, 10 s: median axis error", median(axes), MEDIAN_DEG, " deg")
    report.require_most("combined, 10 s: 90 % of the axis errors", quantile(axes, 0.9), MOST_DEG, " deg")
