"""The stage of one sensor: its orientation beside VQF and beside optics, cold starts, the gyroscope's bias, which rates turn it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import native_sensor
from .. import native_two_dof as two_dof
from .. import quaternions as quat
from ..native import microseconds
from ..sensor_features import features
from . import optical
from .harness import Report, Settings, Skipped, median, number, quantile, run_jobs
from .judge import available, recording

TITLE = "The stage of one sensor"
VQF = "all of it"  # what of it needs VQF
RIGS = tuple(f"rig_{kind}D_0{k}" for kind in (1, 2, 3) for k in ((1, 2, 4) if kind != 2 else (1, 2, 5)))
PEOPLE = ("human_elbow_right", "human_knee_left", "human_leg_left", "knee_drop", "people_ankle_long_L", "people_ankle_orthosis",
          "people_elbow_B_JA_Fast", "people_elbow_D_ROM", "people_elbow_E_ROM", "people_knee_long_L1", "people_knee_long_R1",
          "people_walk_L", "walk_leg_L")
QUICK = ("rig_1D_01", "knee_drop", "people_elbow_D_ROM")
NO_BIAS = "people_elbow_"  # rates of these were made from orientations
SETTLED_S = 5.0
COLD_S = (1.0, 2.0, 3.0, 5.0, 10.0, 20.0)
COLD_EVERY_S = 7.0
BIAS_S = (10.0, 30.0, 60.0)
QUIET_S = {"rig": 0.9, "people": 8.0}  # the quietest stretch of this length tells the bias ...
QUIET_DEG_S = 1.5  # ... if rates scatter by less than this
LAGS = np.linspace(-1.0, 1.0, 21)  # samples
BLOCK_S = 5.0  # of a heading of its own


@dataclass
class Signals:
    """One sensor at even times."""

    name: str
    sensor: int
    t_s: np.ndarray
    gyr: np.ndarray
    acc: np.ndarray
    ref: np.ndarray | None  # (N, 4) marker cluster to laboratory

    @property
    def dt_s(self) -> float:
        return float(np.median(np.diff(self.t_s)))


def signals(name: str, sensor: int) -> Signals:
    """VQF takes even steps only: where they are not, everything is interpolated."""
    rec = recording(name)
    gyr, acc = getattr(rec, f"gyr{sensor}"), getattr(rec, f"acc{sensor}")
    keys = [f"ref_q{sensor}_{part}" for part in "wxyz"]
    ref = np.column_stack([rec.columns[key] for key in keys]) if keys[0] in rec.columns else None
    good = np.isfinite(np.hstack([gyr, acc])).all(axis=1)
    t_s, gyr, acc, ref = rec.t_s[good] - rec.t_s[good][0], gyr[good], acc[good], None if ref is None else ref[good]
    dt_s = float(np.median(np.diff(t_s)))
    if np.ptp(np.diff(t_s)) > 0.1 * dt_s:
        even = np.arange(0.0, t_s[-1], dt_s)
        gyr, acc = (np.column_stack([np.interp(even, t_s, column) for column in v.T]) for v in (gyr, acc))
        t_s, ref = even, None
    return Signals(name, sensor, t_s, gyr, acc, ref if ref is not None and np.isfinite(ref).all() else None)


def mean_rates(gyr: np.ndarray) -> np.ndarray:
    """Mean of each rate and the one before: with these VQF turns as the stage does."""
    return np.vstack([gyr[:1], 0.5 * (gyr[1:] + gyr[:-1])])


def vqf(of: Signals, gyr: np.ndarray) -> np.ndarray:
    found = two_dof.vqf(np.hstack([gyr, of.acc]), of.dt_s)
    assert found is not None
    return found.astype(float)


def tilt_deg(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    """Angle (N,) between the directions that two orientations take for up."""
    cosine = (quat.matrices(p)[:, 2] * quat.matrices(q)[:, 2]).sum(axis=1)
    return np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))


def drift_deg_min(p: np.ndarray, q: np.ndarray, t_s: np.ndarray) -> float:
    """How fast the headings part."""
    r = np.einsum("nij,nkj->nik", quat.matrices(p), quat.matrices(q))
    heading = np.degrees(np.unwrap(np.arctan2(r[:, 1, 0] - r[:, 0, 1], r[:, 0, 0] + r[:, 1, 1])))
    return 60.0 * float(np.polyfit(t_s, heading, 1)[0])


def true_bias(of: Signals) -> np.ndarray | None:
    """rad/s; None if there is no quiet stretch."""
    if of.name.startswith(NO_BIAS):
        return np.zeros(3)
    n = int(QUIET_S["rig" if of.name.startswith("rig") else "people"] / of.dt_s)
    total, square = (np.cumsum(np.vstack([np.zeros(3), v]), axis=0) for v in (of.gyr, of.gyr**2))
    mean = (total[n:] - total[:-n]) / n
    scatter = ((square[n:] - square[:-n]) / n - mean**2).sum(axis=1)
    at = int(scatter.argmin())
    return mean[at] if np.degrees(np.sqrt(max(scatter[at], 0.0))) < QUIET_DEG_S else None


def optical_rms_deg(q: np.ndarray, of: Signals, aligned: optical.Aligned, late: np.ndarray) -> float:
    """Inclination against the optical one: up in the laboratory is the mean of what is found; the lag that suits best."""
    index, best = np.arange(len(q), dtype=float), np.inf
    ups = quat.matrices(q)[:, 2]
    use = aligned.good & late
    for lag in LAGS:
        lab = quat.matrices(optical.interpolate(aligned.q, index + lag))
        up = np.einsum("nij,nj->ni", lab, ups)[use].mean(axis=0)
        seen = np.einsum("nij,i->nj", lab, up / np.linalg.norm(up))
        angle = np.degrees(np.arccos(np.clip((seen * ups).sum(axis=1), -1.0, 1.0)))[use]
        best = min(best, float(np.sqrt(np.mean(angle**2))))
    return best


@dataclass
class Beside:
    """One sensor beside VQF."""

    name: str
    sensor: int
    as_is: np.ndarray  # inclination: median, 95 %, most, deg; heading: deg/min
    same_rates: np.ndarray
    optics: tuple[float, float] | None  # inclination of the stage and of VQF, rms, deg
    optics_drift: tuple[float, float] | None
    bias: float | None  # deg/s
    bias_left: np.ndarray | None  # after BIAS_S, and the most after 30 s
    cold: np.ndarray  # (starts, COLD_S) inclination to the filter that runs, deg


def beside(job: tuple[str, int]) -> Beside:
    of = signals(*job)
    mine = native_sensor.run(of.t_s, of.gyr, of.acc)
    late = of.t_s > SETTLED_S
    others = [vqf(of, of.gyr), vqf(of, mean_rates(of.gyr))]
    rows = []
    for q in others:
        tilt = tilt_deg(mine.q, q)[late]
        rows.append(np.array([median(tilt), quantile(tilt, 0.95), tilt.max(), drift_deg_min(mine.q[late], q[late], of.t_s[late])]))
    optics = drifts = None
    if of.ref is not None:
        aligned = optical.align(of.gyr, of.ref, of.dt_s)
        optics = tuple(optical_rms_deg(q, of, aligned, late) for q in (mine.q, others[0]))
        drifts = tuple(drift_deg_min(q[late], aligned.q[late], of.t_s[late]) for q in (mine.q, others[0]))
    truth, left = true_bias(of), None
    if truth is not None:
        error = np.degrees(np.linalg.norm(mine.bias - truth, axis=1))
        later = error[of.t_s > 30.0]
        left = np.array([error[np.searchsorted(of.t_s, s)] if s < of.t_s[-1] else np.nan for s in BIAS_S]
                        + [later.max() if len(later) else np.nan])
    cold = []
    for begin in np.arange(20.0, of.t_s[-1] - COLD_S[-1], COLD_EVERY_S):
        part = slice(int(begin / of.dt_s), int((begin + COLD_S[-1]) / of.dt_s) + 1)
        tilt = tilt_deg(native_sensor.run(of.t_s[part], of.gyr[part], of.acc[part]).q, mine.q[part])
        cold.append([tilt[min(int(s / of.dt_s), len(tilt) - 1)] for s in COLD_S])
    return Beside(*job, *rows, optics, drifts, None if truth is None else float(np.degrees(np.linalg.norm(truth))), left,
                  np.array(cold).reshape(-1, len(COLD_S)))


def shared_misfit(one, two, block: np.ndarray) -> float:
    """Share of U - B r that differs between the sensors of a joint: levers by least squares, a heading for each block."""
    r = np.zeros(6)
    for _ in range(30):
        e1, e2 = one.velocity - one.lever @ r[:3], two.velocity - two.lever @ r[3:]
        z = (e1[:, 0] + 1j * e1[:, 1]) * np.conj(e2[:, 0] + 1j * e2[:, 1])
        angle = np.array([np.angle(z[block == b].sum()) for b in range(block.max() + 1)])[block]
        c, s, zero, unit = np.cos(angle), np.sin(angle), np.zeros(len(angle)), np.ones(len(angle))
        turn = np.stack([c, -s, zero, s, c, zero, zero, zero, unit], axis=1).reshape(-1, 3, 3)
        rows = np.concatenate([one.lever, -turn @ two.lever], axis=2).reshape(-1, 6)
        right = (one.velocity - np.einsum("nij,nj->ni", turn, two.velocity)).ravel()
        r = np.linalg.lstsq(rows, right, rcond=None)[0]
    misfit = float(np.sum((rows @ r - right) ** 2))
    return misfit / float(np.sum((one.velocity - one.lever @ r[:3]) ** 2) + np.sum((two.velocity - two.lever @ r[3:]) ** 2))


def which_rates(name: str) -> list[float]:
    """That share for VQF as it is, VQF with mean rates, and the stage."""
    both = [signals(name, sensor) for sensor in (1, 2)]
    t_us, found = microseconds(both[0].t_s), []
    for rates in (lambda gyr: gyr, mean_rates):
        ticks = [features(t_us, quat.matrices(vqf(of, rates(of.gyr))), of.gyr, of.acc) for of in both]
        block = (both[0].t_s[ticks[0].at] // BLOCK_S).astype(int)
        found.append(shared_misfit(*ticks, block))
    ticks = [native_sensor.run(of.t_s, of.gyr, of.acc).ticks for of in both]
    found.append(shared_misfit(*ticks, (ticks[0].t_s // BLOCK_S).astype(int)))
    return found


def table_of_vqf(report: Report, rows: list[Beside]) -> None:
    report.text("The orientation beside VQF (its defaults): angle between the directions taken for up after 5 s, deg (median, 95 %, most), and "
                "how fast the headings part, deg/min. VQF turns by the rate of a sample since the sample before; the stage by the mean of both "
                "rates. `same rates`: VQF is given those means. Where samples are not evenly spaced both get interpolated ones.")
    report.table(["recording", "sensor", *(f"{which}: {what}" for which in ("as it is", "same rates") for what in ("median", "95 %", "most", "heading"))],
                 [[r.name, r.sensor, *(number(v) for v in r.as_is), *(number(v) for v in r.same_rates)] for r in rows])


def table_of_optics(report: Report, rows: list[Beside]) -> None:
    report.text("Beside optics where there are any: inclination, rms deg, up in the laboratory and a lag of up to a sample fitted for each; how "
                "fast the heading parts from the optical one, deg/min.")
    report.table(["recording", "sensor", "stage", "VQF", "stage, heading", "VQF, heading"],
                 [[r.name, r.sensor, *(number(v) for v in r.optics), *(number(v) for v in r.optics_drift)] for r in rows if r.optics])


def table_of_bias(report: Report, rows: list[Beside]) -> None:
    report.text("Bias of the gyroscopes, deg/s: its length by the quietest 8 s (rig: 0.9 s) of a recording, 0 where rates were made from "
                "orientations; the error of the estimate after 10, 30 and 60 s, and the largest after 30 s. There is no rest of 2 s on the "
                "rig and with the elbows: what is found there is found in motion.")
    report.table(["recording", "sensor", "bias", *(f"after {s:g} s" for s in BIAS_S), "most after 30 s"],
                 [[r.name, r.sensor, number(r.bias), *(number(v) for v in r.bias_left)] for r in rows if r.bias_left is not None])


def table_of_cold(report: Report, rows: list[Beside]) -> None:
    report.text("Cold starts every 7 s: inclination beside that of the stage that has run since the beginning, deg.")
    out = []
    for label, of in (("rig", [r for r in rows if r.name.startswith("rig")]), ("people", [r for r in rows if not r.name.startswith("rig")])):
        cold = np.vstack([r.cold for r in of]) if of else np.zeros((0, len(COLD_S)))
        if len(cold):
            out += [[label, len(cold), what, *(number(f(cold[:, k])) for k in range(len(COLD_S)))]
                    for what, f in (("median", median), ("95 %", lambda v: quantile(v, 0.95)))]
    report.table(["recordings", "starts", "share", *(f"{s:g} s" for s in COLD_S)], out)


def measure(settings: Settings, report: Report) -> None:
    names = available(*(QUICK if settings.quick else RIGS + PEOPLE))
    if not names:
        raise Skipped("the recordings are not there; JOINTCAL_DATA names their folder")
    if not two_dof.has_vqf():
        raise Skipped("the library was built without VQF; tools/vqf.sh brings it")
    rows = run_jobs(beside, [(name, sensor) for name in names for sensor in (1, 2)], "sensor", settings)
    table_of_vqf(report, rows)
    table_of_optics(report, rows)
    table_of_bias(report, rows)
    table_of_cold(report, rows)
    shared = run_jobs(which_rates, names, "which rates", settings)
    report.text("Which rates: share of the velocity at the joint, U - B r, that differs between its two sensors (squares; levers fitted, a "
                "heading for each 5 s). Rate and specific force of a sample belong to one instant; an orientation that is turned by the last "
                "rate alone is half a sample ahead of both.")
    report.table(["recording", "VQF as it is", "VQF, mean rates", "stage"],
                 [[name, *(number(v, 4) for v in of)] for name, of in zip(names, shared, strict=True)])
    report.require_most("inclination beside VQF with the same rates, 95 % of the time, worst recording", max(r.same_rates[1] for r in rows), 1.5,
                        " deg", (1.9, "walk_leg_L begins with a bias of 1.15 deg/s and 7 s of rest; VQF believes the first reading, the stage takes "
                                      "seconds, because people who stand sway"))
    rigs = [of for name, of in zip(names, shared, strict=True) if name.startswith("rig")]
    if rigs:
        report.require_most("rig: what differs between two sensors, over that with VQF as it is, worst recording",
                            max(of[2] / of[0] for of in rigs), 0.8)
    left = [r.bias_left[3] for r in rows if r.bias_left is not None and np.isfinite(r.bias_left[3])]
    report.require_most("error of the bias after 30 s, mean of the recordings' largest", float(np.mean(left)) if left else np.nan, 0.25, " deg/s")
