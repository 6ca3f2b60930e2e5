"""Signals for the float64 reference of LAI22: rates from orientations, the 5 Hz low-pass, sample selection.

Where the paper (appendix C.1, C.2, section 4.4) is silent this reference decides as follows:

- (A42) divides arccos(q_w) by |v|; near no rotation that loses half of the digits, and it needs q_w >= 0. Here
  the angle is 2 atan2(|v|, q_w) of the quaternion with q_w >= 0.
- (A41) gives the mean rate between two samples, which belongs half a sample before t_k. `prepare` can pair it with
  the orientations of that moment (`centred`) or with those of t_k as the paper does.
- The kind of the 5 Hz low-pass is not said: Butterworth of order 2, forward and backward (zero phase, -6 dB at
  5 Hz) or forward only (-3 dB). Forward only, the orientations are delayed by the filter's delay at frequency 0.
- One sample "every 0.05 s": the first one at least 0.05 s after the last one kept, in whole microseconds.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from . import quaternions as quat

CUTOFF_HZ = 5.0  # C.2
SELECT_S = 0.05  # 4.4
PAD = 9  # samples of odd extension before either pass of the zero-phase filter


class Samples(NamedTuple):
    """Data sets (15): orientations as matrices, sensor to E1 or E2, and rates in E1 and E2, rad/s."""

    r1: np.ndarray  # (M, 3, 3)
    r2: np.ndarray
    w1: np.ndarray  # (M, 3)
    w2: np.ndarray

    def take(self, indices: np.ndarray) -> Samples:
        return Samples(*(part[indices] for part in self))


class Prepared(NamedTuple):
    """All samples of a recording. `source` says which row of the recording made each of them."""

    samples: Samples
    t_s: np.ndarray  # (M,) time of the row, not of the delayed signals
    source: np.ndarray  # (M,) row numbers
    delay_s: float  # how much older than `t_s` the signals are

    def select(self, gap_s: float = SELECT_S) -> np.ndarray:
        return select_indices(self.t_s, gap_s)


def earth_rates(q: np.ndarray, t_s: np.ndarray) -> np.ndarray:
    """Rates (N - 1, 3) in the orientations' own earth frame, (A41), (A42); row k belongs to samples k and k + 1."""
    steps = quat.rotation_vectors(quat.multiply(q[1:], quat.conjugate(q[:-1])))
    return steps / np.diff(t_s)[:, None]


def butterworth(cutoff_hz: float, rate_hz: float) -> tuple[np.ndarray, np.ndarray]:
    """Numerator and denominator (3,) of the second-order low-pass, by the bilinear transform with prewarping."""
    if not 0.0 < cutoff_hz < rate_hz / 2.0:
        raise ValueError("the cutoff frequency must lie between 0 and half of the sampling rate")
    k = np.tan(np.pi * cutoff_hz / rate_hz)
    norm = 1.0 + np.sqrt(2.0) * k + k * k
    b = k * k / norm * np.array([1.0, 2.0, 1.0])
    return b, np.array([1.0, 2.0 * (k * k - 1.0) / norm, (1.0 - np.sqrt(2.0) * k + k * k) / norm])


def low_pass(x: np.ndarray, cutoff_hz: float, rate_hz: float) -> np.ndarray:
    """One forward pass over the rows of (N, d), begun in the steady state of the first row."""
    b, a = butterworth(cutoff_hz, rate_hz)
    y = np.empty_like(x, dtype=float)
    s1, s2 = (1.0 - b[0]) * x[0], (b[2] - a[2]) * x[0]  # the output is x[0] as long as the input is
    for k, row in enumerate(x):
        y[k] = b[0] * row + s1
        s1 = b[1] * row - a[1] * y[k] + s2
        s2 = b[2] * row - a[2] * y[k]
    return y


def low_pass_delay(cutoff_hz: float, rate_hz: float) -> float:
    """Group delay of `low_pass` at frequency 0, s."""
    b, a = butterworth(cutoff_hz, rate_hz)
    k = np.arange(3)
    return float((k @ b / b.sum() - k @ a / a.sum()) / rate_hz)


def low_pass_zero_phase(x: np.ndarray, cutoff_hz: float, rate_hz: float) -> np.ndarray:
    """Forward and backward pass over (N, d), with odd extension at both ends; N > PAD."""
    begin = 2.0 * x[0] - x[PAD:0:-1]
    end = 2.0 * x[-1] - x[-2:-PAD - 2:-1]
    y = low_pass(np.concatenate([begin, x, end]), cutoff_hz, rate_hz)
    return low_pass(y[::-1], cutoff_hz, rate_hz)[::-1][PAD:-PAD]


def delayed(q: np.ndarray, t_s: np.ndarray, delay_s: float) -> tuple[np.ndarray, np.ndarray]:
    """Orientations at t_k - delay_s for every k where they are known, and those k."""
    wanted = t_s - delay_s
    rows = np.flatnonzero(wanted >= t_s[0])
    after = np.clip(np.searchsorted(t_s, wanted[rows]), 1, len(t_s) - 1)
    share = (wanted[rows] - t_s[after - 1]) / (t_s[after] - t_s[after - 1])
    return quat.interpolate(q[after - 1], q[after], share), rows


def prepare(q1: np.ndarray, q2: np.ndarray, t_s: np.ndarray, low_pass_kind: str = "zero-phase",
            centred: bool = True, matched: bool = True) -> Prepared:
    """Data sets from orientations alone (C.1) at the recording's rate.

    `low_pass_kind`: "zero-phase", "causal" or "none". `centred`: orientations of the moment the rates belong to.
    `matched`: orientations are delayed as much as a causal filter delays the rates.
    """
    rate_hz = 1.0 / np.median(np.diff(t_s))
    rates = np.hstack([earth_rates(q, t_s) for q in (q1, q2)])
    delay_s = 0.0
    if low_pass_kind == "zero-phase":
        rates = low_pass_zero_phase(rates, CUTOFF_HZ, rate_hz)
    elif low_pass_kind == "causal":
        rates = low_pass(rates, CUTOFF_HZ, rate_hz)
        delay_s = low_pass_delay(CUTOFF_HZ, rate_hz) if matched else 0.0
    elif low_pass_kind != "none":
        raise ValueError("low_pass_kind must be 'zero-phase', 'causal' or 'none'")
    if centred:
        delay_s += 0.5 / rate_hz
    (q1, rows), (q2, _) = delayed(q1, t_s, delay_s), delayed(q2, t_s, delay_s)
    q1, q2, rows = (part[rows >= 1] for part in (q1, q2, rows))  # the first sample has no rate
    samples = Samples(quat.matrices(q1), quat.matrices(q2), rates[rows - 1, :3], rates[rows - 1, 3:])
    return Prepared(samples, t_s[rows], rows, delay_s)


def select_indices(t_s: np.ndarray, gap_s: float = SELECT_S) -> np.ndarray:
    """Indices kept: the first, then each first one at least `gap_s` after the last one kept (4.4, B.2)."""
    t_us, gap_us = np.rint(t_s * 1e6).astype(np.int64), round(gap_s * 1e6)
    kept = [0]
    for k in range(1, len(t_us)):
        if t_us[k] - t_us[kept[-1]] >= gap_us:
            kept.append(k)
    return np.array(kept)


def yaw(q: np.ndarray) -> np.ndarray:
    """Heading of (N, 4): the angle about z of the rotation about z that is nearest to q, rad."""
    return 2.0 * np.arctan2(q[:, 3], q[:, 0])


def reference_heading(ref_q1: np.ndarray, q1: np.ndarray, ref_q2: np.ndarray, q2: np.ndarray) -> np.ndarray:
    """Heading offset delta (N,) of (6), rad in (-pi, pi], from optical references of both sensors in one frame.

    ref_q q* takes E_i to the laboratory. E2 to E1 is (E1 to laboratory)^-1 (E2 to laboratory), hence yaw 2 - yaw 1.
    """
    first, second = (yaw(quat.multiply(ref, quat.conjugate(q))) for ref, q in ((ref_q1, q1), (ref_q2, q2)))
    return -np.mod(-(second - first) + np.pi, 2.0 * np.pi) + np.pi


def median_angle(angles: np.ndarray) -> float:
    """Median of angles that lie within less than half a turn, rad in (-pi, pi]."""
    centre = np.angle(np.exp(1j * angles).sum())
    return float(np.angle(np.exp(1j * (centre + np.median(np.angle(np.exp(1j * (angles - centre))))))))
