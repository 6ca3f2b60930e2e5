"""Joint centre in float64, written from [OLS17] and independent of the C code.

    samples = prepare(recording)                      what both sensors feel, derivatives of the rates included
    fit = solve_lengths(samples)                      SS; absolute=True: SA; bias: biases of the accelerometers
    r = solve_vectors(samples, turn)                  LS, turn (N, 3, 3) from sensor 2 to sensor 1
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .recordings import Recording

DERIVATIVES = {"symmetric": {1: 0.5}, "five-point": {1: 8.0 / 12.0, 2: -1.0 / 12.0}}
HALF_SPAN = 3  # rows on either side that a derivative with smoothing needs
MAX_ITERATIONS = 100


@dataclass
class Samples:
    """a_i = a_0 + K_i r_i, (3) and (4)."""

    t_s: np.ndarray  # (N,)
    a1: np.ndarray  # (N, 3)
    k1: np.ndarray  # (N, 3, 3)
    a2: np.ndarray
    k2: np.ndarray

    def take(self, which: np.ndarray | slice) -> Samples:
        return Samples(self.t_s[which], self.a1[which], self.k1[which], self.a2[which], self.k2[which])

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


def smooth(w: np.ndarray, values: np.ndarray, dt: float) -> np.ndarray:
    """(1, 2, 1)/4 of vectors or matrices in a frame that turns by w, each taken to the frame of the middle."""
    def in_middle(shift: int) -> np.ndarray:
        turn = rotation(0.5 * dt * shift * (w + np.roll(w, -shift, axis=0)))
        moved = np.roll(values, -shift, axis=0)
        return np.einsum("nij,nj...->ni...", turn, moved)

    return 0.5 * values + 0.25 * (in_middle(1) + in_middle(-1))


def usable_runs(rec: Recording) -> list[slice]:
    """Runs of rows without a repeated reading or a hole between them."""
    imu = [np.hstack([rec.gyr1, rec.acc1]).astype(np.float32), np.hstack([rec.gyr2, rec.acc2]).astype(np.float32)]
    keep = np.ones(len(rec), bool)
    for values in imu:
        keep[1:] &= ~(values[1:] == values[:-1]).all(axis=1)
    keep &= np.isfinite(np.hstack(imu)).all(axis=1)
    runs, begin = [], None
    for k, kept in enumerate([*keep, False]):
        if kept and begin is None:
            begin = k
        elif not kept and begin is not None:
            runs.append(slice(begin, k))
            begin = None
    return runs


def body(w: np.ndarray, a: np.ndarray, dt: float, kind: str) -> tuple[np.ndarray, np.ndarray]:
    """Specific force and K of one sensor; "smoothed": five points, both sides of the equation smoothed alike."""
    k = k_matrix(w, derivative(w, dt, "five-point" if kind == "smoothed" else kind))
    return (smooth(w, a, dt), smooth(w, k, dt)) if kind == "smoothed" else (a, k)


def prepare(rec: Recording, kind: str = "smoothed", min_rate_rad_s: float = 0.0) -> Samples:
    """Samples of a recording of about 50 rows a second; those whose derivative would need a row that is not there are left out."""
    dt = float(np.median(np.diff(rec.t_s)))
    parts = []
    for run in usable_runs(rec):
        run = slice(run.start + 1, run.stop)  # as the library: the first row of a run tells the rate only
        if run.stop - run.start <= 2 * HALF_SPAN:
            continue
        w1, a1, w2, a2 = (v[run] for v in (rec.gyr1, rec.acc1, rec.gyr2, rec.acc2))
        samples = Samples(rec.t_s[run], *body(w1, a1, dt, kind), *body(w2, a2, dt, kind))
        fast = np.maximum(np.linalg.norm(w1, axis=1), np.linalg.norm(w2, axis=1)) >= min_rate_rad_s
        fast[:HALF_SPAN] = fast[len(fast) - HALF_SPAN:] = False
        parts.append(samples.take(fast))
    return Samples(*(np.concatenate([getattr(p, f) for p in parts]) for f in ("t_s", "a1", "k1", "a2", "k2")))


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
    e1, e2 = s.a1 - x[6:9] - turn1, s.a2 - x[9:12] - turn2
    n1, n2 = np.linalg.norm(e1, axis=1), np.linalg.norm(e2, axis=1)
    u1, u2 = e1 / n1[:, None], e2 / n2[:, None]
    slopes = np.hstack([-np.einsum("ni,nij->nj", u1, s.k1), np.einsum("ni,nij->nj", u2, s.k2), -u1, u2])
    return n1 - n2, slopes, (turn1**2).sum(1) + (turn2**2).sum(1)


def solve_lengths(s: Samples, *, absolute: bool = False, bias: float | None = None, reach_m: float | None = None,
                  noise: tuple[float, float] | None = None, start: np.ndarray | None = None, tip: float = 1e-6) -> Fit:
    """SS (15), (17) to (19), or SA (20) by iterated weights 1 / max(|e|, tip).

    With `bias` (m/s^2) biases of that standard deviation are unknowns too, with `reach_m` r has a Gaussian prior, and with
    `noise` = (c, share) a residual's variance is c^2 + share^2 (|K1 r1|^2 + |K2 r2|^2), taken per 0.1 s at 50 Hz.
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
        weight = dt / 0.1 / (noise[0] ** 2 + noise[1] ** 2 * turn2) if noise else np.ones(len(s))
        if absolute:
            usual = np.sqrt(noise[0] ** 2 + noise[1] ** 2 * turn2) if noise else np.full(len(s), tip)
            weight = weight * usual / np.maximum(np.abs(e), usual)
        j = slopes[:, :free]
        step = -np.linalg.solve((j * weight[:, None]).T @ j + np.diag(prior[:free]),
                                (j * weight[:, None]).T @ e + prior[:free] * x[:free])
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
