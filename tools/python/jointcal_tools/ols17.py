"""Joint centre in float64, written from [OLS17] and independent of the C code.

    samples = prepare(recording)                      what both sensors feel, derivatives and smoothing included
    fit = solve_lengths(samples)                      SS; absolute=True: SA; bias: biases of the accelerometers
    r = solve_vectors(samples, turn)                  LS, turn (N, 3, 3) from sensor 2 to sensor 1
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .recordings import Recording

DERIVATIVES = {"symmetric": {1: 0.5}, "five-point": {1: 8.0 / 12.0, 2: -1.0 / 12.0}}
HALF_SPAN = 2  # rows on either side that a derivative needs
WEIGHTS = np.array([1.0, 3.0, 3.0, 1.0]) / 8.0  # of the blocks that smoothing takes
BRIDGE_S = 0.31  # blocks go on over holes that are no longer
MAX_ITERATIONS = 100


FIELDS = ("t_s", "a1", "k1", "turn1", "a2", "k2", "turn2")


@dataclass
class Samples:
    """a_i = a_0 + K_i r_i, (3) and (4), each sensor in a frame of its own to which `turn` takes vectors of its sensor frame."""

    t_s: np.ndarray  # (N,)
    a1: np.ndarray  # (N, 3)
    k1: np.ndarray  # (N, 3, 3)
    turn1: np.ndarray  # (N, 3, 3)
    a2: np.ndarray
    k2: np.ndarray
    turn2: np.ndarray

    def take(self, which: np.ndarray | slice) -> Samples:
        return Samples(*(getattr(self, field)[which] for field in FIELDS))

    def __len__(self) -> int:
        return len(self.t_s)


def cross_matrix(v: np.ndarray) -> np.ndarray:
    """[v x] of (N, 3)."""
    x, y, z = v.T
    zero = np.zeros_like(x)
    return np.stack([np.stack([zero, -z, y], 1), np.stack([z, zero, -x], 1), np.stack([-y, x, zero], 1)], 1)


def k_matrix(w: np.ndarray, dw: np.ndarray) -> np.ndarray:
    """K(w, dw) of (5)."""
    across = cross_matrix(w)
    return across @ across + cross_matrix(dw)


def rotation(vector: np.ndarray) -> np.ndarray:
    """Matrices (N, 3, 3) of rotation vectors (N, 3), by Rodrigues."""
    angle = np.linalg.norm(vector, axis=1)[:, None, None]
    across = cross_matrix(vector)
    safe = np.where(angle > 0.0, angle, 1.0)
    return np.eye(3) + np.sin(angle) / safe * across + (1.0 - np.cos(angle)) / safe**2 * across @ across


def derivative(w: np.ndarray, dt: float, kind: str) -> np.ndarray:
    """(8), or the quotient over five points. The ends wrap around and are wrong."""
    return sum(c * (np.roll(w, -k, axis=0) - np.roll(w, k, axis=0)) for k, c in DERIVATIVES[kind].items()) / dt


def usable_runs(rec: Recording) -> list[slice]:
    """Runs of rows without a repeated reading or a hole between them, each less its first row, from which its rate is known.

    A step that is longer or shorter than the run's first one by more than half begins the next run, at its later row.
    """
    imu = [np.hstack([rec.gyr1, rec.acc1]).astype(np.float32), np.hstack([rec.gyr2, rec.acc2]).astype(np.float32)]
    keep = np.isfinite(np.hstack(imu)).all(axis=1)
    for values in imu:
        keep[1:] &= ~(values[1:] == values[:-1]).all(axis=1)
    rows, usual = np.flatnonzero(keep), float(np.median(np.diff(rec.t_s)))
    runs, first, step = [], 0, 0.0
    for k in range(1, len(rows) + 1):
        dt = rec.t_s[rows[k]] - rec.t_s[rows[k - 1]] if k < len(rows) else np.inf
        if step == 0.0 and k < len(rows):
            step = dt
            continue
        if not step / 1.5 < dt < step * 1.5:
            if step < 1.5 * usual and k - first > 1:
                runs.append(slice(rows[first + 1], rows[k - 1] + 1))
            first, step = k, 0.0
    return runs


def follow(t_s: np.ndarray, w: np.ndarray, outer: np.ndarray, whole: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Frames (N, 3, 3) that do not turn, and numbers (N,) of parts between long holes.

    The way from row k - 1 to k is that of the cubic through four rows, dt/24 (13 (w_k-1 + w_k) - outer_k), where `whole` says that
    nothing is missing between them; over holes that of the mean rate.
    """
    part = np.concatenate([[0], np.cumsum(np.diff(t_s) > BRIDGE_S)])
    dt = np.diff(t_s)[:, None]
    pair = w[1:] + w[:-1]
    steps = rotation(np.where(whole[1:, None], dt / 24.0 * (13.0 * pair - outer[1:]), 0.5 * dt * pair))
    frames = np.empty((len(w), 3, 3))
    for k in range(len(w)):
        frames[k] = np.eye(3) if k == 0 or part[k] != part[k - 1] else frames[k - 1] @ steps[k - 1]
    return frames, part


def blocks(values: np.ndarray, part: np.ndarray, per_block: int) -> np.ndarray:
    """Means over four blocks of rows with weights (1, 3, 3, 1)/8, one for each block; parts do not mix."""
    found = []
    for number in np.unique(part):
        own = values[part == number]
        count = len(own) // per_block
        means = own[: count * per_block].reshape(count, per_block, *own.shape[1:]).mean(axis=1)
        found += [np.tensordot(WEIGHTS, means[k: k + len(WEIGHTS)], axes=1) for k in range(count - len(WEIGHTS) + 1)]
    return np.array(found)


def prepare(rec: Recording, kind: str = "five-point", smoothing_s: float = 0.12, min_rate_rad_s: float = 0.0,
            orientations: tuple[np.ndarray, np.ndarray] | None = None) -> Samples:
    """Samples of a recording of about 50 rows a second; rows whose derivative would need one that is not there are left out.

    With orientations (N, 3, 3), sensor to earth, samples are in both earth frames; else in frames that do not turn, or with no
    smoothing in the sensors' own.
    """
    dt = float(np.median(np.diff(rec.t_s)))
    rows, w, a, k = [], ([], []), ([], []), ([], [])
    for run in usable_runs(rec):
        if run.stop - run.start <= 2 * HALF_SPAN:
            continue
        inner = slice(HALF_SPAN, run.stop - run.start - HALF_SPAN)
        rows.append(np.arange(run.start, run.stop)[inner])
        for i, (gyr, acc) in enumerate(((rec.gyr1, rec.acc1), (rec.gyr2, rec.acc2))):
            w[i].append(gyr[run][inner])
            a[i].append(acc[run][inner])
            k[i].append(k_matrix(gyr[run], derivative(gyr[run], dt, kind))[inner])
    at = np.concatenate(rows)
    t_s = rec.t_s[at]
    per_block = max(int(smoothing_s / (len(WEIGHTS) * dt) + 0.25), 1)  # rounded down unless nearly one more
    whole = np.concatenate([[False], np.diff(at) == 1])
    columns, rate2 = [], []
    for i in (0, 1):
        gyr, acc, k_all = (np.concatenate(parts[i]) for parts in (w, a, k))
        all_rates = (rec.gyr1, rec.gyr2)[i]
        frames, part = follow(t_s, gyr, all_rates[at - 2] + all_rates[at + 1], whole)
        if orientations is not None:
            frames = orientations[i][at]
        elif smoothing_s == 0.0:
            frames = np.broadcast_to(np.eye(3), k_all.shape)
        turned = [np.einsum("nij,nj->ni", frames, acc), frames @ k_all, frames, (gyr**2).sum(axis=1)]
        if smoothing_s > 0.0:
            turned = [blocks(v, part, per_block) for v in turned]
        columns += turned[:3]
        rate2.append(turned[3])
    times = blocks(t_s, part, per_block) if smoothing_s > 0.0 else t_s
    fast = np.maximum(*rate2) >= min_rate_rad_s**2
    return Samples(times, *columns).take(fast)


@dataclass
class Fit:
    r1: np.ndarray  # (3,) m
    r2: np.ndarray
    bias1: np.ndarray  # (3,) m/s^2
    bias2: np.ndarray
    residuals: np.ndarray  # (N,) m/s^2


def lengths(s: Samples, x: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Residuals (16), their slopes by (r1, r2, b1, b2) and |K1 r1|^2 + |K2 r2|^2."""
    turn1, turn2 = s.k1 @ x[:3], s.k2 @ x[3:6]
    e1, e2 = s.a1 - s.turn1 @ x[6:9] - turn1, s.a2 - s.turn2 @ x[9:12] - turn2
    n1, n2 = np.linalg.norm(e1, axis=1), np.linalg.norm(e2, axis=1)
    u1, u2 = e1 / n1[:, None], e2 / n2[:, None]
    slopes = np.hstack([-np.einsum("ni,nij->nj", u1, s.k1), np.einsum("ni,nij->nj", u2, s.k2),
                        -np.einsum("ni,nij->nj", u1, s.turn1), np.einsum("ni,nij->nj", u2, s.turn2)])
    return n1 - n2, slopes, (turn1**2).sum(1) + (turn2**2).sum(1)


def solve_lengths(s: Samples, *, absolute: bool = False, bias: float | None = None, reach_m: float | None = None,
                  noise: tuple[float, float] | None = None, smoothing_s: float = 0.12, start: np.ndarray | None = None,
                  tip: float = 1e-6) -> Fit:
    """SS (15), (17) to (19), or SA (20) by iterated weights 1 / max(|e|, tip).

    With `bias` (m/s^2) biases of that standard deviation are unknowns too, with `reach_m` r has a Gaussian prior, and with
    `noise` = (c, share) a residual's variance is c^2 + share^2 (|K1 r1|^2 + |K2 r2|^2), once per reading: 0.1 s, or half of what is
    smoothed over. Readings that are worse than that count so much less.
    """
    x = np.zeros(12)
    x[:6] = 0.0 if start is None else start
    free = 12 if bias else 6
    prior = np.zeros(12)
    prior[:6] = 0.0 if reach_m is None else reach_m**-2.0
    prior[6:] = bias**-2.0 if bias else 0.0
    dt = float(np.median(np.diff(s.t_s))) if noise else 1.0
    for _ in range(MAX_ITERATIONS):
        e, slopes, turn2 = lengths(s, x)
        weight = dt / max(0.1, 0.5 * smoothing_s) / (noise[0] ** 2 + noise[1] ** 2 * turn2) if noise else np.ones(len(s))
        if absolute:
            usual = np.sqrt(noise[0] ** 2 + noise[1] ** 2 * turn2) if noise else np.full(len(s), tip)
            weight = weight * usual / np.maximum(np.abs(e), usual)
        j = slopes[:, :free]
        readings = len(s) * dt / max(0.1, 0.5 * smoothing_s)
        own = prior[:free] * (max(weight @ e**2 / readings, 1.0) if noise else 1.0)
        step = -np.linalg.solve((j * weight[:, None]).T @ j + np.diag(own), (j * weight[:, None]).T @ e + own * x[:free])
        x[:free] += step
        if np.linalg.norm(step) < 1e-10:
            break
    return Fit(x[:3], x[3:6], x[6:9], x[9:], lengths(s, x)[0])


def solve_vectors(s: Samples, turn: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """LS, (9) to (14): a1 - R a2 = K1 r1 - R K2 r2 with R (N, 3, 3) from sensor 2 to sensor 1."""
    left = np.concatenate([s.k1, -turn @ s.k2], axis=2).reshape(-1, 6)
    right = (s.a1 - np.einsum("nij,nj->ni", turn, s.a2)).reshape(-1)
    x = np.linalg.lstsq(left, right, rcond=None)[0]
    return x[:3], x[3:]
