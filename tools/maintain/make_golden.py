#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Write the golden vectors, host_tests/golden/*.h, from the float64 references.

    python3 tools/maintain/make_golden.py            write the files
    python3 tools/maintain/make_golden.py --check    exit 1 if the numbers in the repository differ

Another version of numpy may round differently, so --check compares numbers with a
tolerance, and everything between them exactly.

The numbers know nothing of the C code: samples come from the simulator, the costs of
the stream form and of OLS20 from jointcal_tools.ols20 and from the formulas of
docs/METHOD.md section 2, written out below; those of the 2-DoF joint from
jointcal_tools.lai22 and lai22_angles, those of the joint centre from jointcal_tools.ols17,
those of what ties hip and knee from weighted least squares, written out below, those
of the functional joint from jointcal_tools.functional_reference, those of ball joints
and of axes from windows from jointcal_tools.ball_reference, and those of packets from
jointcal_tools.packet_reference.
"""

from __future__ import annotations

import argparse
import re
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np

TOOLS = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(TOOLS / "python"))

from jointcal_tools import ball_reference as ball  # noqa: E402
from jointcal_tools import functional_reference as functional  # noqa: E402
from jointcal_tools import functional_sensor, lai22, lai22_angles, ols17, ols20  # noqa: E402
from jointcal_tools import packet_reference as packet  # noqa: E402
from jointcal_tools import quaternions as quat  # noqa: E402
from jointcal_tools.lai22_signals import Samples  # noqa: E402
from jointcal_tools.recordings import Recording  # noqa: E402
from jointcal_tools.simulate import HingeSpec, simulate_hinge  # noqa: E402
from jointcal_tools.simulate_two_dof import TwoDofRecording, TwoDofSpec, simulate_two_dof  # noqa: E402

GOLDEN = TOOLS.parent / "host_tests" / "golden"
SEED = 42
SAMPLES = 40
POINTS = 6
TWO_DOF_SAMPLES = 30
CENTER_SAMPLES, CENTER_SHOWN = 250, 12
CENTER_RATE_HZ = 50.0
FUNCTIONAL_S, FUNCTIONAL_STEP, FUNCTIONAL_POINTS, FUNCTIONAL_POSES = 18.0, 6, 4, 8
BALL_S, BALL_EARLY, BALL_TRACKED = 18.0, 14, 20  # s; ticks of the early sums; ticks that the heading of the moment is followed over
BALL_POINTS = (2, 3)  # with early and with all sums
WINDOW_STEP, WINDOW_PARTS = 3, 6
WINDOW_HEADING_BOUND, WINDOW_LEVER_BOUND = 0.15, 0.04
PACKET_S, PACKET_AGAIN_S, PACKET_SLOWER_S, PACKET_SLOWER_US = 160.0, 60.0, 40.0, 200000
PACKET_LOST, PACKET_LATE, PACKET_TWICE = 0.04, 0.02, 0.02  # shares of the packets
CHAIN_STATES = 18
CHAIN_OBSERVED = 3
SAME_BIAS_M_S2 = 0.01  # by how much one accelerometer may differ from itself
CONTRADICTION = 3.0  # standard deviations
RATE_HZ = 50.0
GYR_NOISE_RAD_S = 0.03  # fields of jcal_hinge_config_t with their defaults
ACC_BIAS_M_S2 = 0.5
ACC_WEIGHT = 0.25  # one number for all samples: the schedule of that weight is not part of the model
UNIT_S = 0.05  # docs/METHOD.md section 2: 50 ms count as one reading, eps is 0.05 (rad/s)^2
RATE_EPS = 0.05
TOLERANCE = 1e-6  # relative to the largest magnitude of the table: one rounding to float32 may differ
NUMBER = re.compile(r"-?\d+\.\d*(?:e[-+]?\d+)?")


def float32(values: np.ndarray) -> np.ndarray:
    """The float64 numbers that the C test will see after its own conversion."""
    return np.asarray(values, np.float32).astype(float)


def make_samples() -> np.ndarray:
    """(SAMPLES, 12): gyr1, acc1, gyr2, acc2 of a lively simulated hinge, one sample each 0.2 s."""
    rec = simulate_hinge(HingeSpec(motions=(("7", 10.0),), rate_hz=RATE_HZ, seed=SEED, soft_tissue_deg=0.5,
                                   acc_bias=0.2, gyr_bias_deg_s=0.5))
    rows = np.hstack([rec.gyr1, rec.acc1, rec.gyr2, rec.acc2])[::10][:SAMPLES]
    assert len(rows) == SAMPLES
    return float32(rows)


def make_axes(rng: np.random.Generator) -> np.ndarray:
    """(POINTS, 6): pairs of unit axes."""
    pairs = rng.standard_normal((POINTS, 2, 3))
    return float32((pairs / np.linalg.norm(pairs, axis=2, keepdims=True)).reshape(POINTS, 6))


def stream_costs(problem: ols20.Problem, axes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Both parts of the cost from moments: 78 of the gyroscopes, 21 of the accelerometers, c eliminated by hand."""
    # ols20 weights with 1 / (|w1|^2 + |w2|^2 + eps); the engine counts readings of UNIT_S against the noise.
    scale = 1.0 / RATE_HZ / UNIT_S / GYR_NOISE_RAD_S**2
    moments = ols20.stream_moments(problem)
    gyr_only = moments._replace(acc=np.zeros((6, 6)))
    gyr = [scale * ols20.stream_cost(gyr_only, j[:3], j[3:], w0=1.0) for j in axes]
    a = np.hstack([problem.acc1, -problem.acc2])
    sums, prior = ACC_WEIGHT * a.sum(axis=0), 1.0 / (2.0 * ACC_BIAS_M_S2**2)
    reduced = ACC_WEIGHT * moments.acc - np.outer(sums, sums) / (ACC_WEIGHT * len(a) + prior)
    return np.array(gyr), np.array([j @ reduced @ j for j in axes])


def ols20_rows(problem: ols20.Problem, x: np.ndarray) -> np.ndarray:
    """(SAMPLES, 10): unweighted e_w and its 4 derivatives, then e_a and its 4, by spherical angles."""
    e, jacobian = ols20.residuals_and_jacobian(problem._replace(w0=1.0), x)
    return np.hstack([part for rows in (slice(None, SAMPLES), slice(SAMPLES, None))
                      for part in (e[rows, None], jacobian[rows])])


def table(name: str, comment: str, values: np.ndarray, kind: str = "double") -> str:
    """A C array; floats with 9 significant digits, doubles with 15."""
    values = np.atleast_2d(values)
    digits = 8 if kind == "float" else 14
    suffix = "f" if kind == "float" else ""
    rows = []
    for row in values:
        cells = [f"{value:.{digits}e}{suffix}" for value in row]
        lines = [", ".join(cells[k: k + 4]) for k in range(0, len(cells), 4)]
        rows.append("    {" + (",\n     ".join(lines)) + "},")
    shape = f"[{values.shape[0]}][{values.shape[1]}]"
    return f"/// {comment}\nstatic const {kind} {name}{shape} = {{\n" + "\n".join(rows) + "\n};\n"


def hinge_header() -> str:
    rng = np.random.default_rng(SEED)
    samples, axes = make_samples(), make_axes(rng)
    gyr1, acc1, gyr2, acc2 = (samples[:, k: k + 3] for k in (0, 3, 6, 9))
    problem = ols20.Problem(gyr1, gyr2, acc1, acc2, squared=True, eps=RATE_EPS)
    gyr_cost, acc_cost = stream_costs(problem, axes)
    x = ols20.angles(axes[0, :3], axes[0, 3:])
    rows = ols20_rows(problem._replace(squared=False), x)
    d = np.hstack([ols20.axis_jacobian(*x[:2]), ols20.axis_jacobian(*x[2:])]).T
    tables = [
        table("golden_samples", "gyr1, acc1, gyr2, acc2; rad/s and m/s^2.", samples, "float"),
        table("golden_axes", "j1, j2 of the points at which costs are given.", axes, "float"),
        table("golden_costs", "Gyroscope part and accelerometer part of the stream cost at each point.",
              np.stack([gyr_cost, acc_cost], axis=1)),
        table("golden_directions", "Derivatives of j1 by theta_1, phi_1 and of j2 by theta_2, phi_2 at the first "
              "point, (41).", d),
        table("golden_rows", "At the first point: e_w of (24), its derivatives (31), e_a of (25), its derivatives; "
              "without weights.", rows),
    ]
    return f"""/* SPDX-License-Identifier: MIT */
/// @file
/// Golden vectors of the hinge in float64, generated: do not edit. Compared by unit/hinge/test_golden.c.
///
/// Generator tools/maintain/make_golden.py, seed {SEED}, numpy {np.__version__}.
#ifndef GOLDEN_HINGE_H
#define GOLDEN_HINGE_H

/* clang-format off */
#define GOLDEN_SAMPLES {SAMPLES}
#define GOLDEN_POINTS {POINTS}
#define GOLDEN_DT_S {1.0 / RATE_HZ:.2f}f
#define GOLDEN_GYR_NOISE_RAD_S {GYR_NOISE_RAD_S:.2f}f
#define GOLDEN_ACC_BIAS_M_S2 {ACC_BIAS_M_S2:.1f}f
#define GOLDEN_ACC_WEIGHT {ACC_WEIGHT:.2f}f

""" + "\n".join(tables) + """/* clang-format on */

#endif /* GOLDEN_HINGE_H */
"""


def random_directions(rng: np.random.Generator, rows: int, size: int) -> np.ndarray:
    """(rows, size): unit vectors."""
    v = rng.standard_normal((rows, size))
    return float32(v / np.linalg.norm(v, axis=1, keepdims=True))


def lai22_rows(rows: lai22.Rows) -> np.ndarray:
    """(n, 8): residual, its gradient by j1 (3) and j2 (3) as if they were free, and by delta."""
    return np.column_stack([rows.e, rows.j1, rows.j2, rows.delta])


def two_dof_header() -> str:
    rng = np.random.default_rng(SEED)
    q1, q2 = random_directions(rng, TWO_DOF_SAMPLES, 4), random_directions(rng, TWO_DOF_SAMPLES, 4)
    w1, w2 = (float32(rng.standard_normal((TWO_DOF_SAMPLES, 3))) for _ in range(2))
    axes = np.hstack([random_directions(rng, POINTS, 3), random_directions(rng, POINTS, 3)])
    delta = float32(rng.uniform(-np.pi, np.pi, POINTS))
    poses = [lai22.Pose(j[:3], j[3:], float(d)) for j, d in zip(axes, delta, strict=True)]
    # What the C code gets are rounded quaternions: their matrices are those of the nearest unit ones.
    unit1, unit2 = (q / np.linalg.norm(q, axis=1, keepdims=True) for q in (q1, q2))
    samples = Samples(quat.matrices(unit1), quat.matrices(unit2), w1, w2)
    costs = [[lai22.cost(samples, pose, kind) for kind in ("rotation-ratio", "orientation-variance")] for pose in poses]
    relative = [lai22_angles.euler_zxy(lai22_angles.relative(unit1, unit2, pose.j1, pose.j2, pose.delta))
                for pose in poses[:1]]
    tables = [
        table("golden_samples", "q1, q2, sensor to E1 and E2, and w1, w2 in E1 and E2, rad/s.",
              np.hstack([q1, q2, w1, w2]), "float"),
        table("golden_points", "j1, j2 and delta, rad, of the points.", np.column_stack([axes, delta]), "float"),
        table("golden_costs", "At each point, summed over all samples: (7) squared with the mean of |n|^2, and the squared "
              "deviation of (13) from its mean.", np.array(costs)),
        table("golden_rotation", "At the first point: (7), its gradient by j1, j2 as if they were free, and by delta.",
              lai22_rows(lai22.rotation_rows(samples, poses[0]))),
        table("golden_orientation", "At the first point: (13), likewise.", lai22_rows(lai22.sine_rows(samples, poses[0]))),
        table("golden_angles", "With the axes and the heading of the first point: flexion (22), carrying angle (23), "
              "pronation (24), rad.", np.column_stack(relative[0])),
    ]
    return f"""/* SPDX-License-Identifier: MIT */
/// @file
/// Golden vectors of the 2-DoF joint in float64, generated: do not edit. Compared by unit/two_dof/test_golden.c.
///
/// Generator tools/maintain/make_golden.py, seed {SEED}, numpy {np.__version__}.
#ifndef GOLDEN_TWO_DOF_H
#define GOLDEN_TWO_DOF_H

/* clang-format off */
#define GOLDEN_SAMPLES {TWO_DOF_SAMPLES}
#define GOLDEN_POINTS {POINTS}

""" + "\n".join(tables) + """/* clang-format on */

#endif /* GOLDEN_TWO_DOF_H */
"""


def center_recording() -> Recording:
    """A lively simulated ball joint, in float32."""
    rec = simulate_two_dof(TwoDofSpec(motions=(("three_dof", CENTER_SAMPLES / CENTER_RATE_HZ),), rate_hz=CENTER_RATE_HZ,
                                      seed=SEED, speed=2.0, noise_scale=0.3, acc_bias=0.1))
    return Recording(rec.t_s, *(float32(v) for v in (rec.gyr1, rec.acc1, rec.gyr2, rec.acc2)))


def center_rows(s: ols17.Samples, x: np.ndarray) -> np.ndarray:
    """(n, 14): residual (16), its slopes by r1, r2, b1, b2 and |K1 r1|^2 + |K2 r2|^2."""
    e, slopes, turn2 = ols17.lengths(s, x)
    return np.column_stack([e, slopes, turn2])


def center_header() -> str:
    rec = center_recording()
    point = np.round(np.random.default_rng(SEED + 1).uniform(-0.3, 0.3, 12), 2)
    model = {"bias": 0.3, "reach_m": 0.3, "noise": (0.05, 0.01)}
    bodies = []
    for kind, smoothing_s in (("five-point", 0.12), ("five-point", 0.0), ("symmetric", 0.0)):
        s = ols17.prepare(rec, kind, smoothing_s)
        bodies.append(np.hstack([s.a1, s.k1.reshape(-1, 9), s.a2, s.k2.reshape(-1, 9)])[:CENTER_SHOWN])
    plain = ols17.prepare(rec)
    fits = [ols17.solve_lengths(plain, absolute=absolute, **model) for absolute in (False, True)]
    shape = "a1, K1 row by row, a2, K2"
    tables = [
        table("golden_samples", "gyr1, rad/s, acc1, m/s^2, gyr2, acc2.", np.hstack([rec.gyr1, rec.acc1, rec.gyr2, rec.acc2]), "float"),
        table("golden_point", "r1, r2, m, and biases, m/s^2, of the rows.", point[None], "float"),
        table("golden_smoothed", f"First bodies, five points, smoothed over 0.12 s: {shape}.", bodies[0]),
        table("golden_five_point", f"First bodies, five points: {shape}.", bodies[1]),
        table("golden_symmetric", f"First bodies, (8): {shape}.", bodies[2]),
        table("golden_rows", "Of the unsmoothed bodies, five points, at the point: (16), its slopes by r1, r2, b1, b2, |K1 r1|^2 + |K2 r2|^2.",
              center_rows(ols17.prepare(rec, smoothing_s=0.0).take(slice(CENTER_SHOWN)), point)),
        table("golden_fits", "SS and SA with the default weights and priors: r1, r2, m, and biases, m/s^2.",
              np.array([np.concatenate([f.r1, f.r2, f.bias1, f.bias2]) for f in fits])),
    ]
    return f"""/* SPDX-License-Identifier: MIT */
/// @file
/// Golden vectors of the joint centre in float64, generated: do not edit. Compared by unit/center/test_golden.c.
///
/// Generator tools/maintain/make_golden.py, seed {SEED}, numpy {np.__version__}.
#ifndef GOLDEN_CENTER_H
#define GOLDEN_CENTER_H

/* clang-format off */
#define GOLDEN_SAMPLES {CENTER_SAMPLES}
#define GOLDEN_SHOWN {CENTER_SHOWN}
#define GOLDEN_RATE_HZ {CENTER_RATE_HZ:.1f}

""" + "\n".join(tables) + """/* clang-format on */

#endif /* GOLDEN_CENTER_H */
"""


class Row(NamedTuple):
    """A linear observation: slope . x is `target` but for a standard deviation."""

    slope: np.ndarray
    target: float
    sd: float


class Tie(NamedTuple):
    """One case of hip and knee. Places of the state: lib/chain/tie.h."""

    biases: bool
    normal: np.ndarray  # (3,); zero: no plane
    plane_sd: float
    length: float  # zero: not known
    length_sd: float
    fits: bool  # no tie contradicts


def least_squares(mean: np.ndarray, covariance: np.ndarray, rows: list[Row]) -> tuple[np.ndarray, np.ndarray]:
    """Minimum of (x - mean)' C^-1 (x - mean) + sum ((slope . x - target) / sd)^2, all at once, and its covariance."""
    information = np.linalg.inv(covariance)
    right = information @ mean
    for row in rows:
        information = information + np.outer(row.slope, row.slope) / row.sd**2
        right = right + row.slope * row.target / row.sd**2
    return np.linalg.solve(information, right), np.linalg.inv(information)


def between(v: np.ndarray) -> np.ndarray:
    """Slope of v . (r_HT - r_KT)."""
    slope = np.zeros(CHAIN_STATES)
    slope[3:6], slope[12:15] = v, -v
    return slope


def agrees(mean: np.ndarray, covariance: np.ndarray, rows: list[Row], more: Row) -> bool:
    """Whether one more observation is less than CONTRADICTION away from what the others say, and clearly so or clearly not."""
    x, c = least_squares(mean, covariance, rows)
    away = abs(more.slope @ x - more.target) / np.sqrt(more.slope @ c @ more.slope + more.sd**2)
    assert abs(away - CONTRADICTION) > 0.2
    return bool(away < CONTRADICTION)


def direction_after(mean: np.ndarray, covariance: np.ndarray, rows: list[Row]) -> np.ndarray:
    x = least_squares(mean, covariance, rows)[0]
    return (x[3:6] - x[12:15]) / np.linalg.norm(x[3:6] - x[12:15])


def tied(mean: np.ndarray, covariance: np.ndarray, tie: Tie) -> tuple[np.ndarray, np.ndarray, bool]:
    """Estimate and covariance with all ties that do not contradict, and whether none does.

    The distance |s| = length, s = r_HT - r_KT, takes two steps of Gauss-Newton from where the other ties lead. Linearised at s_0, |s| is
    |s_0| + d . (s - s_0) = d . s with d = s_0 / |s_0|, so that a step is linear least squares with the row d . s = length, and its
    result gives the next step's d.
    """
    rows, candidates = [], []
    if tie.biases:
        unit = np.eye(CHAIN_STATES)
        candidates += [Row(unit[6 + k] - unit[9 + k], 0.0, SAME_BIAS_M_S2) for k in range(3)]
    if tie.normal.any():
        candidates.append(Row(between(tie.normal), 0.0, tie.plane_sd))
    fits = True
    for row in candidates:
        keep = agrees(mean, covariance, rows, row)
        rows, fits = rows + [row] * keep, fits and keep
    if tie.length > 0.0:
        first = Row(between(direction_after(mean, covariance, rows)), tie.length, tie.length_sd)
        if agrees(mean, covariance, rows, first):
            second = Row(between(direction_after(mean, covariance, rows + [first])), tie.length, tie.length_sd)
            assert agrees(mean, covariance, rows, second)
            rows.append(second)
        else:
            fits = False
    return *least_squares(mean, covariance, rows), fits


def chain_gaussian(rng: np.random.Generator, coupled: bool) -> tuple[np.ndarray, np.ndarray]:
    """What hip and knee might know: a thigh of 0.4 m, vectors known to 5 to 40 mm, biases to 0.02 to 0.1 m/s^2."""
    mean = np.concatenate([rng.uniform(-0.2, 0.2, 6), rng.uniform(-0.05, 0.05, 6), rng.uniform(-0.2, 0.2, 6)])
    along = rng.standard_normal(3)
    mean[12:15] = mean[3:6] - 0.4 * along / np.linalg.norm(along)
    sd = np.concatenate([rng.uniform(0.005, 0.04, 6), rng.uniform(0.02, 0.1, 6), rng.uniform(0.005, 0.04, 6)])
    factor = rng.standard_normal((CHAIN_STATES, 2 * CHAIN_STATES))
    correlation = factor @ factor.T
    if not coupled:  # as the joints are before any tie
        correlation[:9, 9:] = correlation[9:, :9] = 0.0
    scale = sd / np.sqrt(np.diag(correlation))
    return float32(mean), float32(correlation * np.outer(scale, scale))


def chain_ties(rng: np.random.Generator, gaussians: list[tuple[np.ndarray, np.ndarray]]) -> list[Tie]:
    """Each tie by itself, all of them, and those that contradict. Planes and lengths are near what each Gaussian says, but for those."""
    ties = []
    for number, (mean, _) in enumerate(gaussians):
        segment = mean[3:6] - mean[12:15]
        normal = np.cross(segment, rng.standard_normal(3))
        off = 0.05 * segment / (segment @ segment) if number != 7 else 2.0 * segment
        normal = normal / np.linalg.norm(normal) + off
        ties.append(Tie(biases=number not in (1, 2),
                        normal=float32(normal / np.linalg.norm(normal)) * (number not in (0, 2)),
                        plane_sd=float(float32(0.03)),
                        length=float(float32(np.linalg.norm(segment) + (0.3 if number == 6 else 0.02))) * (number not in (0, 1)),
                        length_sd=float(float32(0.005)), fits=number < 6))
    return ties


def packed(matrix: np.ndarray) -> np.ndarray:
    """Lower triangle, row after row."""
    return matrix[np.tril_indices(len(matrix))]


def chain_header() -> str:
    rng = np.random.default_rng(SEED)
    gaussians = [chain_gaussian(rng, coupled=number == 5) for number in range(9)]
    gaussians[8][0][10] = 1.0  # m/s^2: one bias contradicts the other
    ties = chain_ties(rng, gaussians)
    results = [tied(mean, covariance, tie) for (mean, covariance), tie in zip(gaussians, ties, strict=True)]
    assert [fits for *_, fits in results] == [tie.fits for tie in ties]
    mean, covariance = gaussians[0]
    slopes, sd = float32(rng.standard_normal((CHAIN_OBSERVED, CHAIN_STATES))), float32([0.05, 0.1, 0.2])
    targets = float32(slopes @ mean + 0.05 * rng.standard_normal(CHAIN_OBSERVED))
    observed = least_squares(mean, covariance, [Row(*row) for row in zip(slopes, targets, sd, strict=True)])
    tables = [
        table("golden_means", "What hip and knee know: states as in chain/tie.h.", np.array([m for m, _ in gaussians]), "float"),
        table("golden_covariances", "Their covariances, packed.", np.array([packed(c) for _, c in gaussians]), "float"),
        table("golden_ties", "1 if biases are tied, normal of the plane, its tolerance, m, length, m, its tolerance, 1 if nothing "
              "contradicts.", np.array([[t.biases, *t.normal, t.plane_sd, t.length, t.length_sd, t.fits] for t in ties], float), "float"),
        table("golden_tied_means", "After the ties.", np.array([m for m, _, _ in results])),
        table("golden_tied_covariances", "After the ties, packed.", np.array([packed(c) for _, c, _ in results])),
        table("golden_observations", "Of the first state: slope, what slope . x should be, standard deviation.",
              np.column_stack([slopes, targets, sd]), "float"),
        table("golden_observed_mean", "The first state after all of these observations.", observed[0]),
        table("golden_observed_covariance", "Its covariance, packed.", packed(observed[1])),
    ]
    return f"""/* SPDX-License-Identifier: MIT */
/// @file
/// Golden vectors of what ties hip and knee, in float64, generated: do not edit. Compared by unit/chain/test_golden.c.
///
/// Generator tools/maintain/make_golden.py, seed {SEED}, numpy {np.__version__}.
#ifndef GOLDEN_CHAIN_H
#define GOLDEN_CHAIN_H

/* clang-format off */
#define GOLDEN_CASES {len(gaussians)}
#define GOLDEN_STATES {CHAIN_STATES}
#define GOLDEN_OBSERVED {CHAIN_OBSERVED}

""" + "\n".join(tables) + """/* clang-format on */

#endif /* GOLDEN_CHAIN_H */
"""


class FunctionalCase(NamedTuple):
    """A made-up hinge whose second level frame drifts, in float32, and sums of it."""

    ticks: list[tuple[functional_sensor.Tick, functional_sensor.Tick]]
    weights: list[functional.Weights]
    closes: np.ndarray  # number of ticks before it, heading and turn of what is merged (if anything)
    sums: functional.Sums
    truth: functional.Point


def sparse_ticks(rec: Recording, step: int) -> list[tuple[functional_sensor.Tick, functional_sensor.Tick]]:
    """After a second of rest every so many ticks one only, as if sensors had fewer: less to store, and sums do not mind."""
    sensors = []
    for gyr, acc, drift_rad_s in ((rec.gyr1, rec.acc1, 0.0), (rec.gyr2, rec.acc2, 0.01)):
        ticks = functional_sensor.features(rec.t_s, functional_sensor.orientation(rec.t_s, gyr, acc), gyr, acc)
        ticks = ticks[round(1.0 / ticks[0].dt_s)::step]
        rz = [functional.about_z(complex(np.exp(1j * (0.7 + drift_rad_s * tick.t_s)))) for tick in ticks]
        sensors.append([functional_sensor.Tick(tick.t_s, float(float32(step * tick.dt_s)), 1, *map(float32, (
            z @ tick.turn, z @ tick.rate, z @ tick.lever, z @ tick.velocity, tick.gyr)), tick.acc_level)
            for tick, z in zip(ticks, rz, strict=True)])
    return list(zip(*sensors, strict=True))


def functional_ticks() -> tuple[list[tuple[functional_sensor.Tick, functional_sensor.Tick]], Recording]:
    rec = simulate_hinge(HingeSpec(motions=(("rest", 1.0), ("7", FUNCTIONAL_S)), rate_hz=RATE_HZ, seed=SEED, soft_tissue_deg=0.5,
                                   acc_bias=0.2, gyr_bias_deg_s=0.5))
    return sparse_ticks(rec, FUNCTIONAL_STEP), rec


def leaning_turn(rng: np.random.Generator, heading: complex) -> np.ndarray:
    """A relative turn that is a few degrees away from its heading."""
    return functional.about_z(heading) @ functional.turn_of(0.05 * rng.standard_normal(3))


def functional_case(rng: np.random.Generator) -> FunctionalCase:
    ticks, rec = functional_ticks()
    sums, point, closes, weights = functional.Sums(), functional.Point(rec.axis1, rec.axis2), [], []
    for number, (tick1, tick2) in enumerate(ticks, 1):
        rate2 = float(tick1.gyr @ tick1.gyr + tick2.gyr @ tick2.gyr)
        weights.append(functional.Weights(*map(float, float32(functional.weights_of(tick1.dt_s, rate2)))))
        sums.add(tick1, tick2, weights[-1])
        if sums.is_full:
            functional.find_heading(sums, point, functional.BLOCKS - 1)
            angle = np.angle(point.heading[-1]) + 0.1 * rng.standard_normal()
            heading = complex(*float32([np.cos(angle), np.sin(angle)]))
            turn = float32(leaning_turn(rng, heading))
            point.heading[-1], point.turn[-1] = heading, turn
            closes.append(np.r_[number, heading.real, heading.imag, turn.ravel()])
            sums.close(point)
    assert len(closes) == 3
    return FunctionalCase(ticks, weights, np.array(closes), sums, functional.Point(rec.axis1, rec.axis2))


def functional_point(rng: np.random.Generator, case: FunctionalCase) -> functional.Point:
    """Axes a few degrees off, levers anywhere, headings and turns that are the best but for some degrees."""
    point = case.truth.copy()
    point.j1, point.j2 = (float32(functional.moved(j, 0.1 * rng.standard_normal(3))) for j in (point.j1, point.j2))
    point.r1, point.r2 = float32(rng.uniform(-0.2, 0.2, (2, 3)))
    functional.measure(case.sums, functional.cross_of(case.sums, point), point)
    for b in range(functional.BLOCKS):
        functional.find_heading(case.sums, point, b)
        angle = np.angle(point.heading[b]) + 0.1 * rng.standard_normal()
        point.heading[b] = complex(*float32([np.cos(angle), np.sin(angle)]))
        point.turn[b] = float32(leaning_turn(rng, point.heading[b]))
    return point


def point_row(point: functional.Point) -> np.ndarray:
    headings = [[h.real, h.imag] for h in point.heading]
    return np.concatenate([point.j1, point.j2, point.r1, point.r2, np.ravel(headings), np.ravel(point.turn)])


def functional_rows(sums: functional.Sums, point: functional.Point) -> dict[str, np.ndarray]:
    """What each step makes of a point. Levers and weights of the first steps are those that all later ones have."""
    rows = {}
    cross = functional.cross_of(sums, point)
    rows["cross"] = np.concatenate([x.ravel() for x in (cross.turn, cross.rate, cross.lever, cross.level)])
    functional.put_levers(sums, cross.lever, point)
    rows["levers"] = np.r_[point.r1, point.r2, point.lack, point.speed2]
    functional.measure(sums, cross, point)
    rows["sizes"] = np.r_[point.size, point.weight, point.energy]
    h = functional.weighted_quadric(sums, cross, point)
    rows["quadric"] = np.r_[packed(h[:3, :3]), packed(h[3:, 3:]), h[:3, 3:].ravel(), h @ point.j]
    stepped = point.copy()
    functional.step_axes(h, stepped)
    rows["axes"] = np.r_[stepped.j1, stepped.j2]
    blocks = range(functional.BLOCKS)
    headings = [functional.best_heading(sums, point, b) for b in blocks]
    rows["headings"] = np.ravel([[z.real, z.imag] for z in headings])
    slopes = [functional.slope_vector(point.turn[b].T @ functional.rate_pull(sums, point, b)) for b in blocks]
    rows["turn_slopes"] = np.ravel(slopes)
    rows["nuisances"] = np.ravel([packed(functional.nuisance(sums, point, b)) for b in blocks])
    rows["nuisance_slopes"] = np.ravel([functional.nuisance_slope(sums, point, b) for b in blocks])
    rows["couplings"] = np.ravel([functional.coupling(sums, point, b) for b in blocks])
    for _ in range(200):
        for b in blocks:
            functional.find_heading(sums, point, b)
    rows["settled"] = np.concatenate([np.ravel([[z.real, z.imag] for z in point.heading]), np.ravel(point.turn)])
    described = functional.describe(sums, point)
    u, _, vt = np.linalg.svd(functional.cross_of(sums, point).turn)
    other, evidence = functional.rival_of(sums, point)
    bounds = functional.bounds_of(sums, point)
    assert bounds.max() < 0.5
    rows["bounds"] = np.r_[bounds, functional.flexion_bound(float(bounds.max()), point.size, described[1])]
    rows["home"] = point.j
    rows["described"] = np.array(described)
    rows["stiffest"] = np.r_[u[:, 0], vt[0]]
    rows["rivals"] = np.r_[evidence, other.lack / sums.motion_s, other.j1, other.j2]
    return rows


FUNCTIONAL_TABLES = {
    "cross": "X of turn, rate (3 x 3), lever (4 x 4) and of the rate with level turns (3 x 3).",
    "levers": "r1, r2, m, of that X, what they leave, (m/s)^2 s, mean square of both sides, (m/s)^2.",
    "sizes": "With these levers: sizes, weights, energy.",
    "quadric": "With these weights: blocks 11 and 22 of H, packed, and 12, and H j.",
    "axes": "j1, j2 after a Newton step.",
    "headings": "The best headings of both blocks while relative turns go with them.",
    "turn_slopes": "At the point: first derivative of -tr(D' M) of both blocks.",
    "nuisances": "Second derivatives by the turns of both blocks, packed.",
    "nuisance_slopes": "First derivatives by the same.",
    "couplings": "Derivatives of the slope by the turns of both blocks: by the six components of j1 and j2 (6 x 3).",
    "settled": "Headings and relative turns that are the best for the axes.",
    "home": "From there: j1, j2 after the last step.",
    "bounds": "There: bounds of both axes and of the angle, rad.",
    "described": "There: share, bending, rad, stiffness.",
    "stiffest": "There: the axes that lean least, by the singular vectors of X of turn.",
    "rivals": "There: evidence of turn, rate and lever, what the other pairing leaves, (m/s)^2, its axes.",
}


def functional_poses(rng: np.random.Generator, point: functional.Point) -> np.ndarray:
    """(FUNCTIONAL_POSES, 9): orientations and the angle with the heading of the open block."""
    q = random_directions(rng, 2 * FUNCTIONAL_POSES, 4)
    turns = quat.matrices(q / np.linalg.norm(q, axis=1, keepdims=True))
    angles = [functional.flexion(point, point.heading[0], a, b) for a, b in zip(turns[::2], turns[1::2], strict=True)]
    return np.column_stack([q[::2], q[1::2], angles])


def functional_header() -> str:
    rng = np.random.default_rng(SEED)
    case = functional_case(rng)
    points = [functional_point(rng, case) for _ in range(FUNCTIONAL_POINTS)]
    poses = functional_poses(rng, points[0])
    point_table = np.array([point_row(point) for point in points])
    rows = [functional_rows(case.sums, point) for point in points]
    ticks = np.array([np.concatenate([*(np.r_[t.turn.ravel(), t.rate.ravel(), t.lever.ravel(), t.velocity, t.gyr] for t in pair), w])
                      for pair, w in zip(case.ticks, case.weights, strict=True)])
    shape = "turn, rate, lever (3 x 3 each), velocity, gyr"
    tables = [
        table("golden_ticks", f"Of sensor 1, then of sensor 2: {shape}; then the weights: motion, s, spin, rate2.", ticks, "float"),
        table("golden_closes", "A block is closed after so many ticks; heading (re, im) and turn of the one that is merged.",
              case.closes, "float"),
        table("golden_points", "j1, j2, r1, r2, headings (re, im) of both blocks, turns of both blocks.", point_table, "float"),
        table("golden_poses", "q1, q2, sensor to level frame, and the angle at the first point with the heading of its open block; its "
              "zero is arbitrary.", poses),
        *(table(f"golden_{name}", comment, np.array([row[name] for row in rows])) for name, comment in FUNCTIONAL_TABLES.items()),
    ]
    return f"""/* SPDX-License-Identifier: MIT */
/// @file
/// Golden vectors of the functional joint in float64, generated: do not edit. Compared by unit/functional/test_golden.c.
///
/// Tables behind golden_poses have one row for each of golden_points.
/// Generator tools/maintain/make_golden.py, seed {SEED}, numpy {np.__version__}.
#ifndef GOLDEN_FUNCTIONAL_H
#define GOLDEN_FUNCTIONAL_H

/* clang-format off */
#define GOLDEN_TICKS {len(ticks)}
#define GOLDEN_TICK_S {case.ticks[0][0].dt_s:.2f}f
#define GOLDEN_CLOSES {len(case.closes)}
#define GOLDEN_POINTS {FUNCTIONAL_POINTS}
#define GOLDEN_POSES {FUNCTIONAL_POSES}

""" + "\n".join(tables) + """/* clang-format on */

#endif /* GOLDEN_FUNCTIONAL_H */
"""


class BallMoment(NamedTuple):
    """Sums of some ticks, and the points that are looked at with them."""

    sums: ball.Sums
    points: list[ball.Point]
    pasts: list[ball.Past]


def true_heading(rec: TwoDofRecording, pair: tuple[functional_sensor.Tick, functional_sensor.Tick]) -> float:
    """Level frame 2 to level frame 1, rad: what makes the pair's orientations stand to each other as the segments do."""
    k = int(np.argmin(np.abs(rec.t_s - pair[0].t_s)))
    one, two = (quat.matrices(q[k][None])[0] for q in (rec.q1, rec.q2))
    delta = complex(np.exp(1j * rec.delta[k]))
    z = pair[0].turn @ one.T @ functional.about_z(delta) @ two @ pair[1].turn.T
    return float(np.arctan2(z[1, 0] - z[0, 1], z[0, 0] + z[1, 1]))


def float32_heading(angle: float) -> complex:
    return complex(*float32([np.cos(angle), np.sin(angle)]))


def ball_case(rng: np.random.Generator) -> tuple[list, np.ndarray, np.ndarray, list[BallMoment]]:
    """Ticks of a lively ball joint whose second level frame drifts, their weights, where blocks were closed, and two moments."""
    rec = simulate_two_dof(TwoDofSpec(motions=(("rest", 1.0), ("three_dof", BALL_S)), rate_hz=RATE_HZ, seed=SEED, soft_tissue_deg=0.5,
                                      acc_bias=0.1, gyr_bias_deg_s=0.3, lever_m=(0.15, 0.3)))
    ticks = sparse_ticks(rec, FUNCTIONAL_STEP)
    sums, weights, closes, moments = ball.Sums(), [], [], []
    for number, (tick1, tick2) in enumerate(ticks, 1):
        rate2 = float(tick1.gyr @ tick1.gyr + tick2.gyr @ tick2.gyr)
        motion_s, spin, _ = map(float, float32(functional.weights_of(tick1.dt_s, rate2)))
        weights.append((motion_s, spin))
        sums.add(tick1, tick2, motion_s, spin)
        if sums.is_full:
            heading = float32_heading(rng.uniform(-3.0, 3.0))
            closes.append([number, heading.real, heading.imag])
            sums.old = sums.old + (heading * sums.blocks[1].lever).real
            sums.blocks = [ball.Block(), sums.blocks[0]]
        if number in (BALL_EARLY, len(ticks)):
            count = BALL_POINTS[len(moments)]
            points = [ball_point(rng, sums, true_heading(rec, (tick1, tick2))) for _ in range(count)]
            pasts = [ball.Past(float32_heading(rng.uniform(-3.0, 3.0)), float(float32(rng.uniform(100.0, 2000.0)))) for _ in range(count)]
            moments.append(BallMoment(ball_copy(sums), points, pasts))
    assert len(closes) == 3 and closes[0][0] > BALL_EARLY
    return ticks, np.array(weights), np.array(closes), moments


def ball_copy(sums: ball.Sums) -> ball.Sums:
    out = ball.Sums()
    for name, value in vars(sums).items():
        if name != "blocks":
            setattr(out, name, value + 0.0)
    out.blocks = [ball.Block(b.lever.copy(), b.motion_s, b.time_s) for b in sums.blocks]
    return out


def ball_point(rng: np.random.Generator, sums: ball.Sums, about: float) -> ball.Point:
    """Headings that are the best but for some degrees, with the levers and sizes that go with them, in float32."""
    point = ball.Point(heading=[complex(np.exp(1j * about))] * 2)
    for _ in range(20):
        ball.put_levers(sums, point)
        ball.put_headings(sums, ball.Past(), point)
    point.heading = [float32_heading(np.angle(h) + 0.1 * rng.standard_normal()) for h in point.heading]
    return point


def ball_sums_row(sums: ball.Sums) -> np.ndarray:
    blocks = [part for b in sums.blocks for part in (b.lever.real.ravel(), b.lever.imag.ravel())]
    return np.concatenate([[sums.motion_s, sums.energy1, sums.energy2, *(b.motion_s for b in sums.blocks)], sums.along.ravel(),
                           packed(sums.lever1), packed(sums.lever2), sums.up.ravel(), sums.old.ravel(), *blocks])


def ball_rows(sums: ball.Sums, past: ball.Past, point: ball.Point) -> dict[str, np.ndarray]:
    """What each step makes of a point."""
    rows = {"cross": sums.cross(point.heading).ravel()}
    ball.put_levers(sums, point)
    rows["levers"] = np.r_[point.r, point.lack, point.speed2, point.size]
    rows["conditions"] = np.r_[np.linalg.cond(sums.normal(sums.cross(point.heading))[0]), 0.0]
    point.r, point.size, point.lack = float32(point.r), float(float32(point.size)), float(float32(point.lack))
    full = ball.information(sums, past, point)
    rows["information"] = np.concatenate([packed(full[:6, :6]), full[:6, 6], full[:6, 7], packed(full[6:, 6:])])
    size = 8 if sums.blocks[1].motion_s > 0.0 else 7
    known = full[:size, :size] + ball.open_information(full[:6, :6]) * np.diag(np.arange(size) < 6)
    rows["conditions"][1] = np.linalg.cond(known)
    left = np.eye(2)
    left[: size - 6, : size - 6] = np.linalg.inv(np.linalg.inv(known)[6:, 6:])
    rows["left"] = packed(left)
    levers, heading = ball.bounds(sums, past, point)
    assert max(levers) < 1.0 and heading < 0.5
    rows["bounds"] = np.r_[heading, levers]
    joint = ball.Ball()
    joint.sums, joint.past, joint.point = ball_copy(sums), past, ball.Point(point.r, list(point.heading), point.size, point.lack)
    joint.close()
    rows["pasts"] = np.r_[past.pull, joint.past.known]
    settled = ball.Point(point.r, list(point.heading), point.size)
    ball.put_headings(sums, past, settled)
    rows["headings"] = np.ravel([[h.real, h.imag] for h in settled.heading])
    return rows


BALL_TABLES = {
    "cross": "X (4 x 4).",
    "levers": "r1, r2, m, what they leave, (m/s)^2 s, mean square of both sides and size, (m/s)^2.",
    "conditions": "Condition of the normal equations without their ridge, and of the information.",
    "headings": "With these levers and this size: headings (re, im) of both blocks after a slice of a round.",
    "information": "There, with the headings of before: about both levers (6 x 6, packed), their coupling to both headings (2 x 6), about the "
                   "headings (2 x 2, packed).",
    "left": "What is left of the last once the levers have taken their share; 1 for a block that is empty.",
    "bounds": "Bounds of the heading, rad, and of both levers, m.",
    "pasts": "What the past is worth one block later, and what is known once the closed block is merged, 1/rad^2.",
}


def ball_track(ticks: list, weights: np.ndarray, point: ball.Point) -> np.ndarray:
    """Heading of the moment after the last ticks, as one sum: all of them at once, each as old as it is; and what they leave, smoothed."""
    ticks, motion = ticks[-BALL_TRACKED:], weights[-BALL_TRACKED:, 0]
    v1 = np.array([a.velocity - a.lever @ point.r[:3] for a, _ in ticks])
    v2 = np.array([b.velocity - b.lever @ point.r[3:] for _, b in ticks])
    level1, level2 = v1[:, 0] + 1j * v1[:, 1], v2[:, 0] + 1j * v2[:, 1]
    kept, old = [], 0.0  # what a tick leaves of those before; their mean age
    for tick, moved in zip(ticks, motion, strict=True):
        kept.append(1.0 / (1.0 + moved * (1.0 + old / 10.0) / 6.0))
        old = kept[-1] * (old + tick[0].dt_s)
    recent = 0.0
    for k in range(BALL_TRACKED):
        z = np.sum(motion[: k + 1] * np.array([np.prod(kept[i + 1: k + 1]) for i in range(k + 1)]) * np.conj(level2[: k + 1]) * level1[: k + 1])
        heading = z / abs(z)
        left = abs(level1[k] - heading * level2[k]) ** 2 + (v1[k, 2] - v2[k, 2]) ** 2
        recent += motion[k] / (motion[k] + 1.5) * (min(left / (3.0 * point.size), 50.0) - recent)
    return np.array([heading.real, heading.imag, recent])


def turned(tick: functional_sensor.Tick, heading: complex) -> functional_sensor.Tick:
    """As if its level frame had another heading."""
    return tick._replace(turn=float32(functional.about_z(heading) @ tick.turn))


def window_ticks() -> tuple[list, np.ndarray, complex]:
    """Bending, turning, bending, each of two parts; levers of an elbow whose axes they are, and a heading."""
    ticks, point = [], np.zeros(6)
    for number, kind in enumerate(("hinge", "pronation", "hinge")):
        rec = simulate_two_dof(TwoDofSpec(motions=(("rest", 1.0), (kind, 8.0)), rate_hz=RATE_HZ, seed=SEED, soft_tissue_deg=1.0, speed=2.0))
        parts = sparse_ticks(rec, WINDOW_STEP)
        each = int(np.ceil(ball.PART_S / parts[0][0].dt_s))
        begin = float32_heading(true_heading(rec, parts[4 * number]))
        ticks += [(a, turned(b, begin)) for a, b in parts[4 * number: 4 * number + 2 * each]]
        across = np.cross(rec.axis1, [-0.3, -0.9, -0.1])
        point = float32(np.r_[0.2 * across / np.linalg.norm(across), 0.25 * rec.axis2])
    heading = float32_heading(0.6)
    return [(a, turned(b, np.conj(heading))) for a, b in ticks], point, heading


def window_rows(ticks: list, r: np.ndarray, heading: complex) -> tuple[np.ndarray, np.ndarray]:
    """Each part as it is closed, and both axes after it."""
    windows, parts, found = ball.Windows(), [], []
    for tick1, tick2 in ticks:
        if not windows.add(tick1, tick2, heading):
            continue
        part = windows.parts[0]
        parts.append(np.concatenate([packed(part.seen1), packed(part.seen2), part.mean.ravel(), [part.carried2, part.motion_s, part.time_s]]))
        windows.close(ball.Point(r), heading, WINDOW_HEADING_BOUND, WINDOW_LEVER_BOUND, True)
        found.append(np.concatenate([np.r_[a.windows, a.bound, a.heading_bound if a.windows else 0.0, a.direction if a.windows else np.zeros(3)]
                                     for a in windows.kept]))
    assert len(parts) == WINDOW_PARTS and [found[-1][0], found[-1][6]] == [2.0, 1.0]
    return np.array(parts), np.array(found)


def ball_header() -> str:
    rng = np.random.default_rng(SEED)
    ticks, weights, closes, moments = ball_case(rng)
    table_rows = [(number, point, past) for number, moment in enumerate(moments) for point, past in zip(moment.points, moment.pasts, strict=True)]
    points = np.array([[number, *np.ravel([[h.real, h.imag] for h in point.heading]), past.heading.real, past.heading.imag, past.known]
                       for number, point, past in table_rows])
    rows = [ball_rows(moments[number].sums, past, point) for number, point, past in table_rows]
    tick_rows = np.array([np.concatenate([*(np.r_[t.turn.ravel(), t.lever.ravel(), t.velocity, t.gyr] for t in pair), w])
                          for pair, w in zip(ticks, weights, strict=True)])
    tracked = ball_track(ticks, weights, table_rows[-1][1])
    w_ticks, r, heading = window_ticks()
    parts, found = window_rows(w_ticks, r, heading)
    tables = [
        table("golden_ticks", "Of sensor 1, then of sensor 2: turn, lever (3 x 3 each), velocity, gyr; then the weights: motion, s, spin.",
              tick_rows, "float"),
        table("golden_closes", "A block is closed after so many ticks; heading (re, im) of the one that is merged.", closes, "float"),
        table("golden_sums", "After the early ticks and after all: motion, energies, motion of both blocks; along, S11, S22 (packed), Sv, old, "
              "Sc of both blocks (re, im).", np.array([ball_sums_row(moment.sums) for moment in moments])),
        table("golden_stiffness", "Of both.", np.array([ball.stiffness(moment.sums) for moment in moments])),
        table("golden_points", "With which sums; headings (re, im) of both blocks; heading of the past and what is known of it.", points, "float"),
        *(table(f"golden_{name}", comment, np.array([row[name] for row in rows])) for name, comment in BALL_TABLES.items()),
        table("golden_track", "With the levers and the size of the last point, after the last ticks: heading of the moment, and what is left.",
              tracked),
        table("golden_window_ticks", "Of sensor 1, then of sensor 2: turn, gyr.",
              np.array([np.concatenate([np.r_[t.turn.ravel(), t.gyr] for t in pair]) for pair in w_ticks]), "float"),
        table("golden_window_point", "Levers of all windows, and the heading.", np.r_[r, heading.real, heading.imag], "float"),
        table("golden_parts", "Each part: relative rate in frame 1 and 2 (packed), mean of R1' Rz R2 times seconds, carried, motion, time.", parts),
        table("golden_found", "After each part, of bending and of turning: windows, bound, what the heading may add, rad, axis.", found),
    ]
    return f"""/* SPDX-License-Identifier: MIT */
/// @file
/// Golden vectors of ball joints and of axes from windows in float64, generated: do not edit. Compared by unit/ball/test_golden.c and
/// unit/two_axes/test_golden.c.
///
/// Tables from golden_cross to golden_pasts have one row for each of golden_points.
/// Generator tools/maintain/make_golden.py, seed {SEED}, numpy {np.__version__}.
#ifndef GOLDEN_BALL_H
#define GOLDEN_BALL_H

/* clang-format off */
#define GOLDEN_TICKS {len(ticks)}
#define GOLDEN_TICK_S {ticks[0][0].dt_s:.2f}f
#define GOLDEN_EARLY {BALL_EARLY}
#define GOLDEN_TRACKED {BALL_TRACKED}
#define GOLDEN_CLOSES {len(closes)}
#define GOLDEN_POINTS {len(points)}
#define GOLDEN_WINDOW_TICKS {len(w_ticks)}
#define GOLDEN_WINDOW_TICK_S {w_ticks[0][0].dt_s:.2f}f
#define GOLDEN_WINDOW_HEADING_BOUND {WINDOW_HEADING_BOUND:.2f}f
#define GOLDEN_WINDOW_LEVER_BOUND {WINDOW_LEVER_BOUND:.2f}f
#define GOLDEN_PARTS {len(parts)}

""" + "\n".join(tables) + """/* clang-format on */

#endif /* GOLDEN_BALL_H */
"""


def packet_case(rng: np.random.Generator) -> tuple[packet.Config, list[packet.Packet]]:
    """A sensor that is learnt, begins anew, and whose radio becomes slower; some packets lost, late or twice."""
    radio = packet.Radio(period_s=0.05, drift_ppm=-430.0, count=8, bits=12, counter0=3000)
    sent = packet.simulate(radio, PACKET_S, rng)
    again = radio.__class__(**{**radio.__dict__, "counter0": 0, "hub0_us": sent[-1].arrival_us + 1234567})
    sent += packet.simulate(again, PACKET_AGAIN_S, rng)
    sent = [p if p.arrival_us < sent[-1].arrival_us - 1e6 * PACKET_SLOWER_S else p._replace(arrival_us=p.arrival_us + PACKET_SLOWER_US)
            for p in sent]
    came, held = [], None
    for each in sent:
        draw = rng.random()
        if draw < PACKET_LOST:
            continue
        if held is None and draw < PACKET_LOST + PACKET_LATE:
            held = each
            continue
        came += [each, each] if draw > 1.0 - PACKET_TWICE else [each]
        if held is not None:
            came.append(held._replace(arrival_us=each.arrival_us))
            held = None
    return packet.Config(period_s=radio.period_s, bits=radio.bits), came


def packet_header() -> str:
    config, came = packet_case(np.random.default_rng(SEED))
    follower, found = packet.Follower(config), []
    for each in came:
        times = follower.take(each)
        clock = follower.clock
        ends = [times[0] - came[0].arrival_us, times[-1] - came[0].arrival_us] if times else [0.0, 0.0]
        found.append([len(times), *ends, clock.drift_ppm, clock.bound_ppm, clock.jitter_us])
    counts = follower.counts
    assert all(counts.values())
    arrivals = ",\n".join(f"    {{{each.arrival_us}u, {each.counter}u, {each.count}u}}" for each in came)
    return f"""/* SPDX-License-Identifier: MIT */
/// @file
/// Golden vectors of packets in float64, generated: do not edit. Compared by unit/packet/test_golden.c.
///
/// Generator tools/maintain/make_golden.py, seed {SEED}, numpy {np.__version__}.
#ifndef GOLDEN_PACKET_H
#define GOLDEN_PACKET_H

#include <stdint.h>

/* clang-format off */
#define GOLDEN_PACKETS {len(came)}
#define GOLDEN_PERIOD_NS {round(1e9 * config.period_s)}u
#define GOLDEN_BITS {config.bits}u

/// Readings by what became of them: given out, lost, late, duplicate, odd; restarts, steps.
static const uint32_t golden_counts[7] = {{{", ".join(f"{counts[name]}u" for name in counts)}}};

/// Arrival, us; counter; readings.
static const uint32_t golden_packets[{len(came)}][3] = {{
{arrivals},
}};

""" + table("golden_found", "Readings given out; time of the first and of the last one since the first arrival, us; drift, bound, ppm; jitter, us.",
            np.array(found)) + """/* clang-format on */

#endif /* GOLDEN_PACKET_H */
"""


HEADERS = {"hinge.h": hinge_header, "two_dof.h": two_dof_header, "center.h": center_header, "chain.h": chain_header,
           "functional.h": functional_header, "ball.h": ball_header, "packet.h": packet_header}


def differences(old: str, new: str) -> list[str]:
    """What differs between two files beyond rounding, block by block."""
    def body(text: str) -> str:
        return re.sub(r"numpy [\w.+]+", "numpy", text)
    problems = []
    old_blocks, new_blocks = (body(text).split("/// ") for text in (old, new))
    if len(old_blocks) != len(new_blocks):
        return ["other tables"]
    for old_block, new_block in zip(old_blocks, new_blocks, strict=True):
        title = new_block.split("\n", 1)[0]
        if NUMBER.sub("#", old_block) != NUMBER.sub("#", new_block):
            problems.append(f"{title}: other text or shape")
            continue
        a, b = (np.array([float(n) for n in NUMBER.findall(block)]) for block in (old_block, new_block))
        if len(a) and not (np.abs(a - b).max() <= TOLERANCE * np.abs(b).max()):
            problems.append(f"{title}: differs by {np.abs(a - b).max():.3g}")
    return problems


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="compare instead of writing")
    check = parser.parse_args().check
    problems = []
    for name, make in HEADERS.items():
        path, header = GOLDEN / name, make()
        if not check:
            path.parent.mkdir(exist_ok=True)
            path.write_text(header, newline="\n")
            continue
        found = differences(path.read_text(), header) if path.is_file() else ["no such file"]
        problems += [f"host_tests/golden/{name} differs from what tools/maintain/make_golden.py writes: {each}" for each in found]
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
