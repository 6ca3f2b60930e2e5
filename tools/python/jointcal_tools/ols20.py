"""Float64 reference of OLS20 (joint axis of a hinge), written from the paper alone.

Equation and algorithm numbers are OLS20's. Where the paper is silent or misprinted
this reference decides as follows:

- (25) repeats sensor 1; the second term is sensor 2. (31) repeats phi_1; the last
  column is phi_2.
- (37) is 0/0 where a rate is parallel to its axis. The gradient there is taken as 0.
- (30) J^T J is singular at the poles of the spherical angles. Its pseudo-inverse is
  used. `solve_on_indices` turns the sensor frames so that its axes stay at the
  equator, far from the poles.
- V_tol and the constants of the line search have no values: see the constants below.
- (44) prints an open interval for a window of 2n+1 samples; it is taken as closed,
  and cut off at the ends of the data.
- n = 21 is called 0.42 s, which at 50 Hz is 21 samples in all. `half_window` is n;
  HALF_WINDOW_PAPER is the text's 2n+1 = 43 samples, HALF_WINDOW_CODE the 0.42 s.
- (45) makes the penalty infinite at the ends of the data, so Algorithm 3 never keeps
  such a sample once it selects at all. In `algorithm4` samples at the end of a
  batch wait for the next one, which completes their window.
- Algorithm 3, no row with c_k > 0.5: the row with the largest penalty goes.
- Algorithm 3, fewer than N_max rows below the threshold: they are all, unless
  `min_acc` asks for more; then the rows with the smallest penalties are taken back.
- 5.3 saves scores between batches. `algorithm4` keeps what the last batch selected
  and judges it together with the new samples; N counts all samples seen.
- Equal scores: the earlier sample comes first in the sorted order.
- (55)-(58) need the second-order matrix of V/2; (34) and (54) are short of the same
  factor 2, so that (57) is right as printed.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from .recordings import Recording

W0 = 50.0  # 7.3
E_TH = 1.0  # rad^2/s^2, 7.3
HALF_WINDOW_PAPER = 21  # 2n + 1 = 43 samples
HALF_WINDOW_CODE = 10  # 2n + 1 = 21 samples, 0.42 s at 50 Hz
V_TOL = 1e-8  # relative to V: the paper's V_tol is absolute and has no value
ARMIJO = 1e-4  # share of the linear decrease that a step must reach
MAX_HALVINGS = 30
MAX_ITERATIONS = 200
STREAM_EPS = 3e-3  # rad^2/s^2, eps of docs/METHOD.md 2.1


class Problem(NamedTuple):
    """The data of one estimation: gyroscope rows and accelerometer rows are selected separately."""

    gyr1: np.ndarray  # (n, 3)
    gyr2: np.ndarray
    acc1: np.ndarray  # (m, 3)
    acc2: np.ndarray
    w0: float = W0
    squared: bool = False  # gyroscope residual of the stream engine instead of (24)
    eps: float = STREAM_EPS


class Solution(NamedTuple):
    j1: np.ndarray
    j2: np.ndarray
    cost: float


def make_problem(rec: Recording, gyr_idx: np.ndarray, acc_idx: np.ndarray, w0: float = W0,
                 squared: bool = False) -> Problem:
    return Problem(rec.gyr1[gyr_idx], rec.gyr2[gyr_idx], rec.acc1[acc_idx], rec.acc2[acc_idx], w0, squared)


# Section 4: residuals, Jacobian, Gauss-Newton.

def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Cross product of (N, 3) with (N, 3) or (3,); faster than numpy's."""
    a, b = a.T, b.T
    return np.stack([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]], axis=1)


def axes(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Unit axes j1, j2 of x = (theta_1, phi_1, theta_2, phi_2), eq. (20), (21)."""
    theta, phi = x[0::2], x[1::2]
    j = np.stack([np.cos(theta) * np.cos(phi), np.cos(theta) * np.sin(phi), np.sin(theta)], axis=1)
    return j[0], j[1]


def angles(j1: np.ndarray, j2: np.ndarray) -> np.ndarray:
    """Inverse of `axes`."""
    return np.array([f for j in (j1, j2)
                     for f in (np.arctan2(j[2], np.hypot(j[0], j[1])), np.arctan2(j[1], j[0]))])


def axis_jacobian(theta: float, phi: float) -> np.ndarray:
    """(3, 2) derivative of one axis, eq. (41) transposed."""
    return np.array([[-np.sin(theta) * np.cos(phi), -np.cos(theta) * np.sin(phi)],
                     [-np.sin(theta) * np.sin(phi), np.cos(theta) * np.cos(phi)],
                     [np.cos(theta), 0.0]])


def perpendicular_rate(gyr: np.ndarray, j: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """|w x j| (N,) and its gradient (w x j) x w / |w x j| (N, 3), eq. (37)."""
    wxj = cross(gyr, j)
    norm = np.sqrt((wxj**2).sum(axis=1))
    safe = np.where(norm > 0.0, norm, 1.0)
    return norm, cross(wxj, gyr) / safe[:, None]


def gyro_part(problem: Problem, j1: np.ndarray, j2: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Unweighted gyroscope residual (n,) and its gradients with respect to j1 and j2 (n, 3)."""
    n1, g1 = perpendicular_rate(problem.gyr1, j1)
    n2, g2 = perpendicular_rate(problem.gyr2, j2)
    if not problem.squared:
        return n1 - n2, g1, -g2  # (24), (36)
    weight = stream_weight(problem)
    return weight * (n1**2 - n2**2), (2 * weight * n1)[:, None] * g1, -(2 * weight * n2)[:, None] * g2


def stream_weight(problem: Problem) -> np.ndarray:
    """Weight (n,) on |w1 x j1|^2 - |w2 x j2|^2 that makes it a proxy of (24); docs/METHOD.md 2.1."""
    return 1.0 / np.sqrt((problem.gyr1**2).sum(axis=1) + (problem.gyr2**2).sum(axis=1) + problem.eps)


def residuals(problem: Problem, x: np.ndarray) -> np.ndarray:
    """e(x) (n + m,), gyroscope rows first, eq. (24), (25), (32) with the weights (70)."""
    j1, j2 = axes(x)
    e_gyr = gyro_part(problem, j1, j2)[0]
    e_acc = problem.acc1 @ j1 - problem.acc2 @ j2
    return np.concatenate([np.sqrt(problem.w0) * e_gyr, e_acc / np.sqrt(problem.w0)])


def residuals_and_jacobian(problem: Problem, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """e(x) (n + m,) and J(x) (n + m, 4), eq. (31)-(41)."""
    j1, j2 = axes(x)
    e_gyr, g1, g2 = gyro_part(problem, j1, j2)
    e_acc = problem.acc1 @ j1 - problem.acc2 @ j2
    d1, d2 = axis_jacobian(*x[:2]), axis_jacobian(*x[2:])
    w_gyr, w_acc = np.sqrt(problem.w0), 1.0 / np.sqrt(problem.w0)
    rows_gyr = w_gyr * np.hstack([g1 @ d1, g2 @ d2])
    rows_acc = w_acc * np.hstack([problem.acc1 @ d1, -problem.acc2 @ d2])
    return np.concatenate([w_gyr * e_gyr, w_acc * e_acc]), np.vstack([rows_gyr, rows_acc])


def cost(problem: Problem, x: np.ndarray) -> float:
    """V(x), eq. (23)."""
    return float(np.sum(residuals(problem, x) ** 2))


def gauss_newton(problem: Problem, x: np.ndarray, v_tol: float = V_TOL) -> tuple[np.ndarray, float]:
    """Local minimum from x: Gauss-Newton (30) with backtracking. Returns x and V(x)."""
    v = cost(problem, x)
    for _ in range(MAX_ITERATIONS):
        e, jacobian = residuals_and_jacobian(problem, x)
        gradient = jacobian.T @ e  # half of the gradient of V
        delta = np.linalg.pinv(jacobian.T @ jacobian, rcond=1e-12, hermitian=True) @ gradient
        alpha, v_new = 1.0, cost(problem, x - delta)
        for _ in range(MAX_HALVINGS):
            if v_new <= v - 2.0 * ARMIJO * alpha * (gradient @ delta):
                break
            alpha *= 0.5
            v_new = cost(problem, x - alpha * delta)
        if v_new > v:
            break  # no step lowers V
        x, drop, v = x - alpha * delta, v - v_new, v_new
        if drop <= v_tol * v:
            break
    return x, v


def opposite_pairing(x: np.ndarray) -> np.ndarray:
    """The same j1 with -j2, eq. (28)."""
    return np.array([x[0], x[1], -x[2], x[3] + np.pi])


def algorithm1(problem: Problem, x: np.ndarray, v_tol: float = V_TOL) -> tuple[np.ndarray, float, float]:
    """Joint axis estimation. Returns x, V(x) and the cost of the other pairing's minimum."""
    first, v_first = gauss_newton(problem, x, v_tol)
    second, v_second = gauss_newton(problem, opposite_pairing(first), v_tol)
    return (first, v_first, v_second) if v_first <= v_second else (second, v_second, v_first)


def turn_to_equator(j: np.ndarray) -> np.ndarray:
    """Rotation Q (3, 3) with Q j = (1, 0, 0), where theta = phi = 0."""
    helper = np.eye(3)[np.argmin(np.abs(j))]
    second = np.cross(j, helper)
    second /= np.linalg.norm(second)
    return np.array([j, second, np.cross(j, second)])


def converge(problem: Problem, j1: np.ndarray, j2: np.ndarray) -> Solution:
    """Minimum near (j1, j2) to numerical precision, in frames turned to the current axes."""
    v = np.inf
    for _ in range(20):
        q1, q2 = turn_to_equator(j1), turn_to_equator(j2)
        turned = problem._replace(gyr1=problem.gyr1 @ q1.T, gyr2=problem.gyr2 @ q2.T,
                                  acc1=problem.acc1 @ q1.T, acc2=problem.acc2 @ q2.T)
        x, v = gauss_newton(turned, np.zeros(4), v_tol=1e-15)
        k1, k2 = axes(x)
        j1, j2 = q1.T @ k1, q2.T @ k2
        if np.abs(x).max() < 1e-9:
            break
    return Solution(j1 / np.linalg.norm(j1), j2 / np.linalg.norm(j2), v)


def solve(problem: Problem, start: tuple[np.ndarray, np.ndarray] | None = None) -> Solution:
    """Global minimum: from `start`, or from the eigenvectors of both sums of w w^T; both pairings each.

    Every start is followed coarsely; the best minimum is then followed to the end.
    """
    if start is None:
        e1 = np.linalg.eigh(problem.gyr1.T @ problem.gyr1)[1].T
        e2 = np.linalg.eigh(problem.gyr2.T @ problem.gyr2)[1].T
        pairs = [(j1, j2) for j1 in e1 for j2 in e2]
    else:
        pairs = [start]
    coarse = [gauss_newton(problem, angles(j1, sign * j2), 1e-6) for j1, j2 in pairs for sign in (1.0, -1.0)]
    x, _ = min(coarse, key=lambda found: found[1])
    ends = [converge(problem, *axes(each)) for each in (x, opposite_pairing(x))]
    return min(ends, key=lambda found: found.cost)


def solve_on_indices(rec: Recording, gyr_idx: np.ndarray, acc_idx: np.ndarray, w0: float = W0,
                     start: tuple[np.ndarray, np.ndarray] | None = None, squared: bool = False) -> Solution:
    """Fully converged (j1, j2, V) on the given gyroscope and accelerometer samples."""
    return solve(make_problem(rec, gyr_idx, acc_idx, w0, squared), start)


# Section 5: sample selection. Indices come back in ascending order.

def windows(values: np.ndarray, half_window: int) -> np.ndarray:
    """View (N, 2n+1) of `values` with NaN beyond the ends."""
    padded = np.pad(values, half_window, constant_values=np.nan)
    return np.lib.stride_tricks.sliding_window_view(padded, 2 * half_window + 1)


def gyro_scores(gyr1: np.ndarray, gyr2: np.ndarray, half_window: int) -> np.ndarray:
    """s_w(k), eq. (42)-(44): the difference of rates with the smallest magnitude near k."""
    delta = np.linalg.norm(gyr1, axis=1) - np.linalg.norm(gyr2, axis=1)
    near = windows(delta, half_window)
    return near[np.arange(len(delta)), np.nanargmin(np.abs(near), axis=1)]


def select_by_score(scores: np.ndarray, n_max: int) -> np.ndarray:
    """Algorithm 2 after the scores: half from either end of the sorted list (5.1)."""
    if len(scores) <= n_max:
        return np.arange(len(scores))
    order = np.argsort(scores, kind="stable")
    half = n_max // 2
    return np.sort(np.concatenate([order[:half], order[len(order) - (n_max - half):]]))


def algorithm2(gyr1: np.ndarray, gyr2: np.ndarray, n_max: int, half_window: int = HALF_WINDOW_PAPER) -> np.ndarray:
    """Gyroscope sample selection: indices of at most `n_max` samples."""
    return select_by_score(gyro_scores(gyr1, gyr2, half_window), n_max)


def acc_penalties(gyr1: np.ndarray, gyr2: np.ndarray, half_window: int) -> np.ndarray:
    """s_a(k), eq. (45), (46); infinite where the window is not complete."""
    energies = [windows((gyr**2).sum(axis=1), half_window).mean(axis=1) for gyr in (gyr1, gyr2)]
    return np.nan_to_num(np.minimum(*energies), nan=np.inf)


def top_right_singular_vector(rows: np.ndarray) -> np.ndarray:
    """w_1 of A (M, 6), eq. (47)-(50), by the SVD the paper prints."""
    return np.linalg.svd(rows, full_matrices=False)[2][0]


def coherence(rows: np.ndarray, w1: np.ndarray) -> np.ndarray:
    """c_k, eq. (52)."""
    return np.abs(rows @ w1) / np.maximum(np.linalg.norm(rows, axis=1), np.finfo(float).tiny)


def select_acc(acc1: np.ndarray, acc2: np.ndarray, penalties: np.ndarray, n_max: int, e_th: float = E_TH,
               min_acc: int = 0, svd: bool = False, seen: int = 0) -> np.ndarray:
    """Algorithm 3 after the penalties: indices of at most `n_max` samples.

    w_1 is the top eigenvector of A^T A, which loses one outer product per removed
    row; `svd=True` decomposes A itself each time, as printed and much slower.
    `seen` is N where the given samples are what earlier selections left of N: the
    threshold applies as soon as N > N_max, also when few samples are left.
    """
    if max(seen, len(penalties)) <= n_max:
        return np.arange(len(penalties))
    order = np.argsort(-penalties, kind="stable")  # largest penalty first
    passed = np.count_nonzero(penalties <= e_th)
    keep = order[len(order) - max(passed, min(min_acc, n_max, len(order))):]
    a = np.hstack([acc1, -acc2])  # (27)
    gram = a[keep].T @ a[keep]
    while len(keep) > n_max:
        if svd:
            w1 = top_right_singular_vector(a[keep])
        else:
            if len(keep) % 256 == 0:  # drop the rounding errors of the subtractions
                gram = a[keep].T @ a[keep]
            w1 = np.linalg.eigh(gram)[1][:, -1]
        worst = first_coherent(a, keep, w1)
        gram = gram - np.outer(a[keep[worst]], a[keep[worst]])
        keep = np.delete(keep, worst)
    return np.sort(keep)


def first_coherent(a: np.ndarray, keep: np.ndarray, w1: np.ndarray) -> int:
    """Position in `keep` (largest penalty first) of the first row with c_k > 0.5, else 0."""
    block = 256  # almost always among the first
    for begin in range(0, len(keep), block):
        hits = np.flatnonzero(coherence(a[keep[begin: begin + block]], w1) > 0.5)
        if len(hits):
            return begin + int(hits[0])
    return 0


def algorithm3(rec: Recording, n_max: int, half_window: int = HALF_WINDOW_PAPER, e_th: float = E_TH,
               min_acc: int = 0, svd: bool = False) -> np.ndarray:
    """Accelerometer sample selection on the whole recording."""
    penalties = acc_penalties(rec.gyr1, rec.gyr2, half_window)
    return select_acc(rec.acc1, rec.acc2, penalties, n_max, e_th, min_acc, svd)


# Section 6: uncertainty.

def covariance(problem: Problem, x: np.ndarray) -> np.ndarray:
    """P_x (4, 4), eq. (57), (58). Infinite when a kind of sample is missing or a direction is open."""
    e, jacobian = residuals_and_jacobian(problem, x)
    n = len(problem.gyr1)
    if n < 2 or len(e) - n < 2:
        return np.full((4, 4), np.inf)
    scale = np.repeat([np.std(e[:n], ddof=1), np.std(e[n:], ddof=1)], [n, len(e) - n])
    scaled = jacobian / np.maximum(scale, np.finfo(float).tiny)[:, None]
    information = scaled.T @ scaled
    if np.linalg.cond(information) > 1e12:
        return np.full((4, 4), np.inf)
    return np.linalg.inv(information)


def complete_elliptic_e(m: float) -> float:
    """Complete elliptic integral of the second kind E(m), 0 <= m <= 1, by the arithmetic-geometric mean."""
    if m >= 1.0:
        return 1.0
    a, g, total, power = 1.0, np.sqrt(1.0 - m), m / 2.0, 0.5
    while abs(a - g) > 1e-15:
        c = (a - g) / 2.0
        a, g = (a + g) / 2.0, np.sqrt(a * g)
        power *= 2.0
        total += power * c * c
    return float(np.pi / (2.0 * a) * (1.0 - total))


def angular_deviation(v1: np.ndarray, v2: np.ndarray) -> float:
    """AD(v1, v2) in rad, eq. (59); the arctangent keeps small angles exact."""
    return float(np.arctan2(np.linalg.norm(np.cross(v1, v2)), v1 @ v2))


def mu_plus_2_sigma(x: np.ndarray, p_x: np.ndarray) -> np.ndarray:
    """mu_z + 2 sigma_z (2,) in rad, in closed form instead of (62)-(65).

    For small angles the deviation is the length of a two-dimensional Gaussian with
    variances s1^2 >= s2^2 in the tangent plane: mean sqrt(2/pi) s1 E(1 - s2^2/s1^2),
    mean square s1^2 + s2^2.
    """
    out = np.full(2, np.inf)
    if not np.isfinite(p_x).all():
        return out
    for i in (0, 1):
        d = axis_jacobian(*x[2 * i: 2 * i + 2])
        variances = np.linalg.eigvalsh(d @ p_x[2 * i: 2 * i + 2, 2 * i: 2 * i + 2] @ d.T)
        s2, s1 = np.maximum(variances[1:], 0.0)  # the first belongs to the axis itself and is zero
        mu = np.sqrt(2.0 / np.pi * s1) * complete_elliptic_e(1.0 - s2 / s1) if s1 > 0.0 else 0.0
        out[i] = mu + 2.0 * np.sqrt(max(s1 + s2 - mu**2, 0.0))
    return out


def mu_plus_2_sigma_monte_carlo(x: np.ndarray, p_x: np.ndarray, rng: np.random.Generator,
                                count: int = 1000) -> np.ndarray:
    """mu_z + 2 sigma_z (2,) in rad as printed, eq. (59)-(65)."""
    centre = axes(x)
    z = np.array([[angular_deviation(j, c) for j, c in zip(axes(sample), centre, strict=True)]
                  for sample in rng.multivariate_normal(x, p_x, count)])
    return z.mean(axis=0) + 2.0 * z.std(axis=0, ddof=1)


def sequential_deviation(j: tuple[np.ndarray, np.ndarray], previous: tuple[np.ndarray, np.ndarray] | None
                         ) -> tuple[tuple[np.ndarray, np.ndarray], float]:
    """The sign (66) of an estimate and its SEQAD (67) in rad."""
    if previous is None:
        return j, np.pi
    deviations = [[angular_deviation(sign * a, b) for a, b in zip(j, previous, strict=True)] for sign in (1.0, -1.0)]
    best = 0 if min(deviations[0]) <= min(deviations[1]) else 1
    sign = (1.0, -1.0)[best]
    return (sign * j[0], sign * j[1]), max(deviations[best])


@dataclass
class Estimate:
    """What Algorithm 4 knows at one time; angles in rad."""

    t_s: float
    j1: np.ndarray
    j2: np.ndarray
    local: np.ndarray  # (2,) mu + 2 sigma
    seqad: float
    accepted: bool  # both criteria hold; the paper stops at the first one
    margin: float  # cost of the other pairing over the cost of this one
    gyr_idx: np.ndarray
    acc_idx: np.ndarray


def algorithm4(rec: Recording, rng: np.random.Generator, n_max: int = 1000, e_max_deg: float = 3.0, n_min: int = 10,
               w0: float = W0, half_window: int = HALF_WINDOW_PAPER, min_acc: int = 0,
               batch_s: float = 1.0, monte_carlo: int = 0) -> Iterator[Estimate]:
    """One estimate per batch, each from a random start, on the samples selected so far (5.3, 6.3, 7.3).

    Selection works on what the previous batch left plus the new samples. `accepted` is
    the paper's verdict; the caller decides whether to stop at the first one.
    """
    batch = round(batch_s * rec.rate_hz)
    e_max = np.radians(e_max_deg)
    gyr_idx = acc_idx = np.arange(0)
    previous, history = None, []
    for end in range(batch, len(rec) + 1, batch):
        scores = gyro_scores(rec.gyr1[:end], rec.gyr2[:end], half_window)
        penalties = acc_penalties(rec.gyr1[:end], rec.gyr2[:end], half_window)
        # Samples whose windows were cut off by the end of the previous batch get a second chance.
        fresh = np.arange(max(end - batch - half_window, 0), end)
        gyr_idx, acc_idx = np.union1d(gyr_idx, fresh), np.union1d(acc_idx, fresh)
        gyr_idx = gyr_idx[select_by_score(scores[gyr_idx], n_max)]
        acc_idx = acc_idx[select_acc(rec.acc1[acc_idx], rec.acc2[acc_idx], penalties[acc_idx], n_max,
                                     min_acc=min_acc, seen=end)]
        problem = make_problem(rec, gyr_idx, acc_idx, w0)
        start = rng.standard_normal((2, 3))  # uniform directions
        x, v, v_other = algorithm1(problem, angles(*start))
        p_x = covariance(problem, x)
        if monte_carlo and np.isfinite(p_x).all():
            local = mu_plus_2_sigma_monte_carlo(x, p_x, rng, monte_carlo)
        else:
            local = mu_plus_2_sigma(x, p_x)
        previous, seqad = sequential_deviation(axes(x), previous)
        history = (history + [seqad])[-n_min:]
        accepted = bool(local.max() < e_max and len(history) == n_min and max(history) < e_max)
        yield Estimate(float(rec.t_s[end - 1]), *previous, local, seqad, accepted, v_other / max(v, 1e-300),
                       gyr_idx, acc_idx)


# The stream engine's moments (docs/METHOD.md 2.1), summed in float64 over a whole recording.

class Moments(NamedTuple):
    gyr: np.ndarray  # (12, 12) of the weighted features of w1 w1^T and -w2 w2^T
    acc: np.ndarray  # (6, 6): A^T A of (27)


def half_vector(matrix: np.ndarray, off_diagonal: float = 1.0) -> np.ndarray:
    """xx, yy, zz, xy, xz, yz of symmetric (..., 3, 3); the last three times `off_diagonal`."""
    i, j = [0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]
    return matrix[..., i, j] * np.array([1.0] * 3 + [off_diagonal] * 3)


def stream_moments(problem: Problem) -> Moments:
    """Second moments of the features: <W1, I - j1 j1^T> - <W2, I - j2 j2^T> is linear in them."""
    outer = [gyr[:, :, None] * gyr[:, None, :] for gyr in (problem.gyr1, problem.gyr2)]
    features = stream_weight(problem)[:, None] * np.hstack([half_vector(outer[0]), -half_vector(outer[1])])
    a = np.hstack([problem.acc1, -problem.acc2])
    return Moments(features.T @ features, a.T @ a)


def stream_cost(moments: Moments, j1: np.ndarray, j2: np.ndarray, w0: float = W0) -> float:
    """Cost of unit axes from the moments alone; equals the cost of the `squared` problem."""
    phi = np.concatenate([half_vector(np.eye(3) - np.outer(j, j), 2.0) for j in (j1, j2)])
    j = np.concatenate([j1, j2])
    return float(w0 * (phi @ moments.gyr @ phi) + (j @ moments.acc @ j) / w0)
