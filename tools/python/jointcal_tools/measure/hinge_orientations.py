"""What orientations would add to a hinge: its axis is the same vector in both sensors' earth frames, up to a heading offset.

|R1 j1 - D R2 j2|^2 summed over time is 2 N - 2 j1' M j2 with M = sum R1' D R2 = c Mc + s Ms + M1: 27 first moments. They are
solved for here in float64, alone and together with the rates' vectors (common_rate.solve_vectors), at several weights.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import common_rate
from .. import native_two_dof as two_dof
from .. import quaternions as quat
from ..recordings import Recording
from ..simulate import simulate_hinge
from .harness import Report, Settings, Skipped, median, number, percent, quantile, run_jobs
from .judge import INFORMATIVE_RAD_S, RIG_HINGES, available, cut, joint_rate_rms, nominal_axes, recording
from .reference import CLASSES, LENGTHS_S, VECTORS, Axes, angle_deg, make_spec, solve

TITLE = "What orientations would add to a hinge"
VQF = "all of it"  # what of it needs VQF
RUNS = 200
ROUNDS = 300  # of the alternating maximisation
ALONE = "orientations alone"
SIGMAS_DEG = (8.0, 4.0, 2.0, 1.0, 0.5)  # error of an orientation that counts as independent every UNIT_S
UNIT_S = 0.5
DC, DS, D1 = np.diag([1.0, 1.0, 0.0]), np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]]), np.diag([0.0, 0.0, 1.0])


def moments(q1: np.ndarray, q2: np.ndarray) -> np.ndarray:
    """(3, 3, 3): means of R1' Dc R2, R1' Ds R2, R1' D1 R2."""
    r1, r2 = quat.matrices(q1), quat.matrices(q2)
    return np.array([np.einsum("nki,kl,nlj->ij", r1, d, r2, optimize=True) for d in (DC, DS, D1)]) / len(r1)


def with_heading(m: np.ndarray, j1: np.ndarray, j2: np.ndarray) -> np.ndarray:
    """M (3, 3) at the heading that suits these axes best."""
    c, s = j1 @ m[0] @ j2, j1 @ m[1] @ j2
    size = max(np.hypot(c, s), np.finfo(float).tiny)
    return (c * m[0] + s * m[1]) / size + m[2]


def alone(m: np.ndarray, start: Axes) -> Axes:
    """The largest j1' M j2 that is reached from `start`: each of j1, j2 and the heading in turn never makes it smaller."""
    j1, j2 = start
    for _ in range(ROUNDS):
        j1 = with_heading(m, j1, j2) @ j2
        j1 = j1 / np.linalg.norm(j1)
        j2 = with_heading(m, j1, j2).T @ j1
        j2 = j2 / np.linalg.norm(j2)
    return j1, j2


def information(rec: Recording, axes: Axes) -> tuple[np.ndarray, common_rate.Point]:
    """Gauss-Newton matrix (4, 4) of the tilts by the rates and the accelerometers at these axes, biases eliminated."""
    samples = common_rate.Samples(rec.t_s, rec.gyr1, rec.acc1, rec.gyr2, rec.acc2)
    rates = common_rate.vector_rows(samples)
    rows = common_rate.joined(rates, common_rate.acc_rows(samples), common_rate.prior_rows(1.0))
    point = common_rate.make_point(*axes)
    jacobian = rows(point)[1]
    full = jacobian.T @ jacobian
    readings = 2.0 * len(rec) * samples.period_s / common_rate.UNIT_S
    power = max(float(np.sum(rates(point)[0] ** 2)) / readings, common_rate.POWER_MIN)
    return (full[:4, :4] - full[:4, 4:] @ np.linalg.solve(full[4:, 4:], full[4:, :4])) / power, point


def together(m: np.ndarray, weight: float, matrix: np.ndarray, point: common_rate.Point) -> Axes:
    """Minimum of d' H d + weight (2 - 2 j1' M j2) over the tilts d, by Newton's method with differences for the second part."""
    def tilted(d: np.ndarray) -> Axes:
        return common_rate.tilt(point.frame1, d[:2]).j, common_rate.tilt(point.frame2, d[2:]).j

    def misfit(d: np.ndarray) -> float:
        j1, j2 = tilted(d)
        return 2.0 - 2.0 * float(j1 @ with_heading(m, j1, j2) @ j2)

    step, units = 1e-4, np.eye(4)
    d = np.zeros(4)
    for _ in range(10):
        here = misfit(d)
        plus, minus = [misfit(d + step * u) for u in units], [misfit(d - step * u) for u in units]
        slope = (np.array(plus) - minus) / (2.0 * step)
        curve = np.empty((4, 4))
        for i in range(4):
            for k in range(i + 1):
                corner = misfit(d + step * (units[i] + units[k]))
                curve[i, k] = curve[k, i] = (corner - plus[i] - plus[k] + here) / step**2
        values, vectors = np.linalg.eigh(curve)
        curve = (vectors * np.maximum(values, 0.0)) @ vectors.T
        d = d - np.linalg.solve(2.0 * matrix + weight * curve, 2.0 * matrix @ d + weight * slope)
    return tilted(d)


@dataclass
class Outcome:
    source: str
    length_s: float
    errors: dict[str, float]  # worse axis, deg


def compare(source: str, length_s: float, rec: Recording, q: tuple[np.ndarray, np.ndarray], truth: Axes) -> Outcome:
    m = moments(*q)
    axes = solve(VECTORS, rec, truth)
    found = {VECTORS: axes, ALONE: alone(m, truth)}
    matrix, point = information(rec, axes)
    readings = len(rec) / rec.rate_hz / UNIT_S
    for sigma in SIGMAS_DEG:
        found[f"both, {sigma:g} deg"] = together(m, readings / np.radians(sigma) ** 2, matrix, point)
    return Outcome(source, length_s, {name: angle_deg(each, truth) for name, each in found.items()})


def measure_simulated(job: tuple[str, int]) -> list[Outcome]:
    spec = make_spec(*job)
    rec = simulate_hinge(spec)
    q = tuple(part.astype(float) for part in two_dof.orientations(rec))
    return [compare(job[0], spec.motions[0][1], rec, q, (rec.axis1, rec.axis2))]


def measure_rig(name: str) -> list[Outcome]:
    """Informative windows against the axes of the whole recording; the orientation filter has run since its beginning."""
    rec, nominal = recording(name), nominal_axes(name)
    q1, q2 = (part.astype(float) for part in two_dof.orientations(rec))
    whole = solve(VECTORS, rec, nominal)
    outcomes = [compare(name, 0.0, rec, (q1, q2), nominal)]
    for length_s in LENGTHS_S:
        count = round(length_s * rec.rate_hz)
        for begin in range(0, len(rec) - count + 1, count):
            part = cut(rec, begin, begin + count)
            if joint_rate_rms(part, *nominal) > INFORMATIVE_RAD_S:
                outcomes.append(compare("rig", length_s, part, (q1[begin:begin + count], q2[begin:begin + count]), whole))
    return outcomes


def measure_job(job: tuple[str, int]) -> list[Outcome]:
    return measure_simulated(job) if job[0] in CLASSES else measure_rig(job[0])


def measure(settings: Settings, report: Report) -> None:
    if not two_dof.has_vqf():
        raise Skipped("the library was built without VQF; tools/vqf.sh brings it")
    names = available(*RIG_HINGES)
    jobs = [(name, 0) for name in (names[:1] if settings.quick else names)]
    jobs += [(kind, index) for kind in CLASSES for index in range(settings.count(RUNS, 8) // len(CLASSES))]
    outcomes = [o for found in run_jobs(measure_job, jobs, "hinge_orientations", settings) for o in found]
    methods = list(outcomes[0].errors)
    report.text("Errors of the worse axis, deg, all in float64 and started at the truth: median and 90 %. Whole recordings against "
                "the nominal axes, windows against the whole recording's axes by the rates, simulated runs against the truth. "
                f"Orientations by VQF. `both`: the rates' vectors and the orientations, an orientation every {UNIT_S:g} s taken for an "
                "independent reading with that error.")
    rows = []
    groups = dict.fromkeys((o.source, o.length_s) for o in outcomes)
    for source, length_s in groups:
        mine = [o for o in outcomes if (o.source, o.length_s) == (source, length_s)]
        errors = {name: [o.errors[name] for o in mine] for name in methods}
        rows.append([source, f"{length_s:g}" if length_s else "whole", len(mine),
                     *(f"{number(median(of))} / {number(quantile(of, 0.9))}" for of in errors.values())])
    report.table(["data", "s", "runs", *methods], rows)
    short = [o for o in outcomes if o.source == "rig"] or outcomes
    best = min(methods[2:], key=lambda name: median([o.errors[name] for o in short]))
    better = sum(o.errors[best] < o.errors[VECTORS] for o in short)
    report.text(f"At its best weight ({best}) the orientations make {percent(better, len(short))} of the "
                f"{'windows' if names else 'runs'} better and the others worse.")
