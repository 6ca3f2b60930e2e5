"""Why LS, equal vectors in earth frames, is hardly ever ready: what is left of (9) of [OLS17], in float64."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import native_center as center
from .. import native_two_dof as two_dof
from .. import ols17
from .. import quaternions as quat
from . import optical
from .harness import Report, median, number
from .judge import recording

SLOW_S = 1.0  # what is slower is taken for tilt and left out
NOISE_M_S2, BIAS_M_S2 = 0.05, 0.3  # the library's
JUMP_ROWS = 15  # about a jump of the optical data
LAG_ROWS = 4  # as in lib/center/sums.c: what still agrees after these rows lasts
HIDDEN_SHARE, LASTING_MIN, MISMATCH_M = 0.65, 0.15, 0.002  # lib/center/judge.c


@dataclass
class Left:
    """A fit, and what it leaves."""

    places: np.ndarray  # (2, 3) m
    horizontal: float  # rms of a component, m/s^2
    vertical: float
    misfit: float  # root of the unexplained share of what turning adds
    lasting: float  # share of that which lasts

    @property
    def hidden_mm(self) -> float:
        """The library's bound if nothing but the misfit counted: below it no data lead."""
        reach = np.linalg.norm(self.places, axis=1).max()
        hidden = HIDDEN_SHARE * self.misfit * np.sqrt(max(self.lasting, LASTING_MIN)) * reach
        return 1e3 * (MISMATCH_M + hidden + self.misfit**2 * reach)


def slow(values: np.ndarray, rows: int) -> np.ndarray:
    """Weighted means over `rows` of (N, ...)."""
    weights = np.hanning(rows + 2)[1:-1]
    flat = values.reshape(len(values), -1)
    mean = np.column_stack([np.convolve(column, weights / weights.sum(), "same") for column in flat.T])
    return mean.reshape(values.shape)


def heading_matrix(angle: float) -> np.ndarray:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def heading_of(s: ols17.Samples, x: np.ndarray) -> float:
    """The turn about the vertical that takes what sensor 2 feels at the joint nearest to what sensor 1 feels."""
    f1, f2 = s.a1 - s.k1 @ x[:3], s.a2 - s.k2 @ x[3:6]
    return float(np.angle(np.sum((f1[:, 0] + 1j * f1[:, 1]) * (f2[:, 0] - 1j * f2[:, 1]))))


def solve(s: ols17.Samples, start: np.ndarray, biases: bool = False, slow_rows: int = 0, components: slice = slice(3)) -> Left:
    """LS with a constant heading offset: Gauss-Newton from `start` (6). `slow_rows`: slower residuals than these left out."""
    x = np.concatenate([start, np.zeros(6)])
    heading, weak = heading_of(s, x), NOISE_M_S2 / BIAS_M_S2
    for _ in range(8):
        turn = heading_matrix(heading)
        a2, k2, turn2 = s.a2 @ turn.T, turn @ s.k2, turn @ s.turn2
        at2 = a2 - k2 @ x[3:6] - turn2 @ x[9:]
        e = s.a1 - s.k1 @ x[:3] - s.turn1 @ x[6:9] - at2
        by_heading = np.stack([at2[:, 1], -at2[:, 0], np.zeros(len(e))], axis=1)[:, :, None]
        slopes = np.concatenate([-s.k1, k2, -s.turn1, turn2, by_heading], axis=2)
        apart = s.a1 - a2
        if slow_rows:
            e, slopes, apart = (v - slow(v, slow_rows) for v in (e, slopes, apart))
        e, slopes, apart = e[:, components], slopes[:, components], apart[:, components]
        prior = np.zeros((6, 13))
        prior[:, 6:12] = (weak if biases else 1e6) * np.eye(6)
        step = np.linalg.lstsq(np.vstack([slopes.reshape(-1, 13), prior]), -np.concatenate([e.ravel(), prior[:, 6:12] @ x[6:]]), rcond=None)[0]
        x += step[:12]
        heading += step[12]
    square = (e**2).sum()
    lasting = max((e[LAG_ROWS:] * e[:-LAG_ROWS]).sum() / square, 0.0)
    every = np.sqrt((e**2).mean(axis=0))
    flat = np.sqrt((every[:2] ** 2).mean()) if len(every) == 3 else np.nan
    return Left(x[:6].reshape(2, 3), float(flat), float(every[-1]), float(np.sqrt(square / (apart**2).sum())), float(lasting))


def near(bad: np.ndarray) -> np.ndarray:
    return np.convolve(bad, np.ones(2 * JUMP_ROWS + 1), "same") > 0.5


def without_jumps(s: ols17.Samples, t_s: np.ndarray, good: np.ndarray) -> ols17.Samples:
    return s.take(~near(~good)[np.clip(np.searchsorted(t_s, s.t_s), 0, len(t_s) - 1)])


def tilt_deg(q: np.ndarray, ref: np.ndarray, good: np.ndarray) -> float:
    """Rms angle between both orientations' verticals, as the sensor sees them."""
    cosine = (quat.matrices(q.astype(float))[:, 2] * quat.matrices(ref)[:, 2]).sum(axis=1)[good]
    return float(np.degrees(np.sqrt(np.mean(np.arccos(np.clip(cosine, -1.0, 1.0)) ** 2))))


def why_not(report: Report, names: list[str]) -> None:
    """Residuals of LS by where orientations come from, beside those of SS."""
    rows, fits, tilted = [], [], []
    for name in names:
        rec = recording(name)
        turned, refs = two_dof.orientations(rec), optical.references(rec)
        good = refs[0].good & refs[1].good
        track = center.run(rec)
        ss = np.concatenate([track.r1[-1], track.r2[-1]])
        lengths = ols17.solve_lengths(ols17.prepare(rec), bias=BIAS_M_S2).residuals
        by_filter = ols17.prepare(rec, orientations=tuple(quat.matrices(q.astype(float)) for q in turned))
        by_light = without_jumps(ols17.prepare(rec, orientations=tuple(quat.matrices(ref.q) for ref in refs)), rec.t_s, good)
        slow_rows = 2 * round(0.5 * SLOW_S * rec.rate_hz) + 1
        every = [solve(by_filter, ss), solve(by_light, ss), solve(by_filter, ss, biases=True),
                 solve(by_filter, ss, biases=True, slow_rows=slow_rows), solve(by_filter, ss, biases=True, components=slice(2, 3))]
        off = [1e3 * np.linalg.norm(fit.places - ss.reshape(2, 3), axis=1).max() for fit in every]
        tilts = [tilt_deg(q, ref.q, good) for q, ref in zip(turned, refs, strict=True)]
        tilted += tilts
        rows.append([name, ", ".join(number(tilt, 1) for tilt in tilts), number(np.sqrt(np.mean(lengths**2)), 3), number(track.misfit[-1], 3),
                     *(f"{number(f.horizontal, 2)}, {number(f.vertical, 2)}" for f in every[:2]),
                     *(f"{number(f.misfit, 3)}, {number(f.hidden_mm, 0)}, {number(mm, 1)}" for f, mm in zip(every, off, strict=True))])
        fits.append(every)
    report.text(f"Why LS is never ready, in float64. VQF is off the optical vertical by {min(tilted):.1f} to {max(tilted):.1f} deg rms, and "
                "a degree of tilt turns 0.17 m/s^2 of gravity into the horizontal components of (9). It changes no length: SS does not "
                "see it. Residuals in m/s^2, rms of a component; misfit: root of the unexplained share of what turning adds; bound: mm, what the library's rule makes of "
                "the misfit alone, however long the recording; off: the larger distance from the stream engine's SS, mm. Slow ones left out: "
                f"a mean over {SLOW_S:g} s taken from both sides of the equation. Vertical: the third component of (9) alone.")
    report.table(["recording", "tilt of VQF, sensors 1, 2, deg", "SS residual", "SS misfit", "VQF: residual horizontal, vertical",
                  "optical: the same", "VQF: misfit, bound, off", "optical: the same", "VQF, biases", "VQF, biases, slow ones left out",
                  "VQF, biases, vertical"], rows)
    tellable = [sum(f[k].hidden_mm < 10.0 for f in fits) for k in range(5)]
    report.text(f"Of {len(fits)} recordings the misfit alone would allow `ready` on {tellable[0]} with VQF, {tellable[1]} with the optical "
                f"orientations, {tellable[2]} with bias states, {tellable[3]} without what is slow, {tellable[4]} by the vertical "
                f"component; median bound {', '.join(number(median([f[k].hidden_mm for f in fits]), 1) for k in range(5))} mm.")
