"""What wireless sensors do to simulated hinges: vibration, straps, lag, drift, filters, scale, dead and exchanged readings."""

from __future__ import annotations

import json
import subprocess
import tempfile
import zlib
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from .. import native
from .. import native_functional as functional
from ..recordings import Recording, write_csv
from ..simulate import ACC_STD_M_S2, GYR_STD_RAD_S, HingeRecording, HingeSpec, random_unit, simulate_hinge
from .angles import program
from .faults import choose
from .harness import Report, Settings, median, number, numbered, percent, run_jobs

TITLE = "Faults of real sensors"
RUNS, QUICK_RUNS = 100, 2  # of a row
LENGTH_S, FINE_HZ, RATE_HZ = 30.0, 200.0, 100.0
MOTIONS = ("6", "7", "daily")
WRONG_DEG = 3.0  # off by more than the limit that was asked for
EVERY_S = 0.5  # how often the program is asked
OPEN = ("motion that is late, filtered or scaled is inside the bounds or they say so, but not errors that turn a gyroscope's axes, which leave nothing behind, "
        "clipping that a calibration hid, and columns that are exchanged or negated, which health.h finds")

HINGE, NEVER = "hinge", "never"  # what a row is: a hinge whose axes must be right, or nothing that may be ready


@dataclass
class Fine:
    """Twelve signals without noise at FINE_HZ, and the truth."""

    t_s: np.ndarray
    sensor: list[list[np.ndarray]]  # [sensor][gyr, acc], each (N, 3)
    truth: HingeRecording

    def at(self, index: int, t_s: np.ndarray) -> list[np.ndarray]:
        """Readings of a sensor at other times."""
        return [np.column_stack([np.interp(t_s, self.t_s, column) for column in signal.T]) for signal in self.sensor[index]]


Change = Callable[[Fine, np.random.Generator], None]
Read = Callable[[Recording, np.random.Generator], Recording]


@dataclass(frozen=True)
class Row:
    """A fault: what it does to the signals before they are sampled, to the times of sensor 2, and to the readings."""

    rule: str
    signals: Change | None = None
    times2: Callable[[np.ndarray, np.random.Generator], np.ndarray] | None = None
    readings: Read | None = None
    motions: tuple[str, ...] = MOTIONS
    rate_hz: float = RATE_HZ


# Signals.

def vibrate(hz: float, rate_rad_s: float, sensor: int = 1) -> Change:
    """One sensor vibrates about a line of its own."""

    def change(fine: Fine, rng: np.random.Generator) -> None:
        line, phase = random_unit(rng), rng.uniform(0.0, 2.0 * np.pi)
        # At FINE_HZ what is faster shows as what it aliases to.
        fine.sensor[sensor][0] += rate_rad_s * np.sqrt(2.0) * np.sin(2.0 * np.pi * hz * fine.t_s + phase)[:, None] * line

    return change


def strap(hz: float, degrees: float) -> Change:
    """Sensor 2 rocks on its strap about one line: it turns, so gravity and rates turn in it."""

    def change(fine: Fine, rng: np.random.Generator) -> None:
        line, phase = random_unit(rng), rng.uniform(0.0, 2.0 * np.pi)
        angle = np.radians(degrees) * np.sqrt(2.0) * np.sin(2.0 * np.pi * hz * fine.t_s + phase)
        rate = np.radians(degrees) * np.sqrt(2.0) * 2.0 * np.pi * hz * np.cos(2.0 * np.pi * hz * fine.t_s + phase)
        gyr, acc = fine.sensor[1]
        fine.sensor[1] = [turned_about(gyr, line, -angle) + rate[:, None] * line, turned_about(acc, line, -angle)]

    return change


def turned_about(v: np.ndarray, line: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Rodrigues' formula, each row by its own angle."""
    sine, cosine = np.sin(angle)[:, None], np.cos(angle)[:, None]
    return cosine * v + sine * np.cross(line, v) + (1.0 - cosine) * np.outer(v @ line, line)


def low_pass(hz: float) -> Change:
    """First order, sensor 2 alone."""

    def change(fine: Fine, rng: np.random.Generator) -> None:
        share = 1.0 - np.exp(-2.0 * np.pi * hz / FINE_HZ)
        for signal in fine.sensor[1]:
            for k in range(1, len(signal)):
                signal[k] = signal[k - 1] + share * (signal[k] - signal[k - 1])

    return change


def second_motion(share: float) -> Change:
    """The joint has a second axis, across the first, with so much of the rate."""

    def change(fine: Fine, rng: np.random.Generator) -> None:
        axis2 = fine.truth.axis2
        across = np.cross(axis2, random_unit(rng))
        across /= np.linalg.norm(across)
        size = share * np.sqrt(np.mean(np.gradient(fine.truth.theta, fine.t_s) ** 2)) * np.sqrt(2.0)
        hz = rng.uniform(0.2, 1.0)
        rate, angle = size * np.cos(2.0 * np.pi * hz * fine.t_s), size / (2.0 * np.pi * hz) * np.sin(2.0 * np.pi * hz * fine.t_s)
        gyr, acc = fine.sensor[1]
        fine.sensor[1] = [turned_about(gyr, across, -angle) + rate[:, None] * across, turned_about(acc, across, -angle)]

    return change


# Readings.

def matrix2(make: Callable[[np.random.Generator], np.ndarray], which: str = "gyr2") -> Read:
    def read(rec: Recording, rng: np.random.Generator) -> Recording:
        return replace(rec, **{which: getattr(rec, which) @ make(rng).T})

    return read


def scaled(share: float) -> Read:
    return matrix2(lambda rng: (1.0 + share * (1.0 if rng.random() < 0.5 else -1.0)) * np.eye(3))


def scaled_by_axis(share: float) -> Read:
    return matrix2(lambda rng: np.diag(1.0 + share * (2.0 * (rng.random(3) < 0.5) - 1.0)))


def cross_axis(degrees: float) -> Read:
    return matrix2(lambda rng: np.eye(3) + np.radians(degrees) * random_unit(rng, 9).reshape(3, 3) * np.sqrt(3.0))


def dead(rec: Recording, rng: np.random.Generator) -> Recording:
    name, column = choose(rng, ("gyr1", "gyr2", "acc1", "acc2")), int(rng.integers(3))
    signal = getattr(rec, name).copy()
    signal[:, column] = choose(rng, (0.0, float(signal[0, column])))
    return replace(rec, **{name: signal})


def clipped_early(rec: Recording, rng: np.random.Generator) -> Recording:
    """At 0.4 of the peak, and then a factory calibration turns and shifts what was clipped."""
    limit = 0.4 * np.abs(rec.gyr2).max()
    turn = np.eye(3) + np.radians(1.0) * random_unit(rng, 9).reshape(3, 3)
    return replace(rec, gyr2=np.clip(rec.gyr2, -limit, limit) @ turn.T + np.radians(rng.uniform(-1.0, 1.0, 3)))


def exchanged(rec: Recording, rng: np.random.Generator) -> Recording:
    """1 % of the readings of sensor 2 are those of 50 to 250 ms before."""
    picked = np.flatnonzero(rng.random(len(rec)) < 0.01)
    source = np.maximum(picked - rng.integers(5, 26, len(picked)), 0)
    gyr, acc = rec.gyr2.copy(), rec.acc2.copy()
    gyr[picked], acc[picked] = rec.gyr2[source], rec.acc2[source]
    return replace(rec, gyr2=gyr, acc2=acc)


def negated(name: str, axes: tuple[int, ...]) -> Read:
    def read(rec: Recording, rng: np.random.Generator) -> Recording:
        signal = getattr(rec, name).copy()
        signal[:, list(axes) if len(axes) > 1 else [int(rng.integers(3))]] *= -1.0
        return replace(rec, **{name: signal})

    return read


def swapped(rec: Recording, rng: np.random.Generator) -> Recording:
    return replace(rec, gyr2=rec.gyr2[:, [1, 0, 2]])


def lost(rec: Recording, rng: np.random.Generator) -> Recording:
    """5 % of the packets of 5 readings; the last reading is repeated in their place, as some hubs do."""
    gyr, acc = rec.gyr2.copy(), rec.acc2.copy()
    for begin in range(5, len(rec) - 5, 5):
        if rng.random() < 0.05:
            gyr[begin: begin + 5], acc[begin: begin + 5] = gyr[begin - 1], acc[begin - 1]
    return replace(rec, gyr2=gyr, acc2=acc)


def late(ms: float) -> Row:
    return Row(HINGE, times2=lambda t, rng: t - 1e-3 * ms)


def drifting(share: float) -> Row:
    return Row(HINGE, times2=lambda t, rng: t * (1.0 + share))


def jitter(t_s: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    return t_s + 6e-3 * rng.standard_normal(len(t_s))


ROWS: dict[str, Row] = {
    "no fault": Row(HINGE),
    "stiff, vibrates at 33 Hz": Row(NEVER, vibrate(33.0, 1.0), motions=("stiff",)),
    "stiff, vibrates at 99.3 Hz, aliased": Row(NEVER, vibrate(99.3, 1.0), motions=("stiff",)),
    "stiff, vibrates at 12 Hz": Row(NEVER, vibrate(12.0, 1.0), motions=("stiff",)),
    **{f"vibrates at {hz} Hz": Row(HINGE, vibrate(float(hz), 0.3)) for hz in (20, 33, 47)},
    **{f"strap rocks by {deg} deg at 6 Hz": Row(HINGE, strap(6.0, deg)) for deg in (0.25, 0.5, 1.0, 2.0)},
    "strap rocks by 1 deg at 3 Hz": Row(HINGE, strap(3.0, 1.0)),
    **{f"late by {ms} ms": late(ms) for ms in (5, 10, 20, 50, 100, 200)},
    "early by 50 ms": late(-50),
    **{f"clock drifts by {100 * share:g} %": drifting(share) for share in (0.0005, 0.001, 0.005, 0.01)},
    **{f"low-pass of {hz} Hz": Row(HINGE, low_pass(float(hz))) for hz in (20, 10, 5)},
    **{f"scale {100 * share:g} %": Row(HINGE, readings=scaled(share)) for share in (0.01, 0.02, 0.03, 0.05, 0.10)},
    "scale 2 % per axis": Row(HINGE, readings=scaled_by_axis(0.02)),
    **{f"cross-axis {deg} deg": Row(HINGE, readings=cross_axis(deg)) for deg in (0.5, 1.0, 3.0)},
    "a component is dead": Row(HINGE, readings=dead),
    "clipped at 0.4 of the peak, then calibrated": Row(HINGE, readings=clipped_early),
    "1 % of readings exchanged": Row(HINGE, readings=exchanged),
    "5 % of packets repeated": Row(HINGE, readings=lost),
    "accelerometer 1 negated": Row(HINGE, readings=negated("acc1", (0, 1, 2))),
    "an axis of gyroscope 2 negated": Row(HINGE, readings=negated("gyr2", (0,))),
    "x and y of gyroscope 2 exchanged": Row(HINGE, readings=swapped),
    "times jitter by 6 ms": Row(HINGE, times2=jitter),
    **{f"second motion of {100 * share:g} %": Row(HINGE, second_motion(share)) for share in (0.02, 0.05, 0.10)},
    "25 Hz": Row(HINGE, rate_hz=25.0),
    "stiff": Row(NEVER, motions=("stiff",)),
    "stiff, late by 100 ms": Row(NEVER, times2=lambda t, rng: t - 0.1, motions=("stiff",)),
    "one rests, late by 100 ms": Row(NEVER, times2=lambda t, rng: t - 0.1, motions=("rest1", "rest2")),
}

AS_IT_COMES = 0.01  # jcal_hinge_config_set_gyroscope(..., JCAL_GYR_AS_IT_COMES)
OF_GYROSCOPES = ("no fault", "scale 1 %", "scale 2 %", "scale 2 % per axis", "cross-axis 0.5 deg", "cross-axis 1.0 deg")


@dataclass
class Said:
    """What a model said: when it was first ready, and both errors and bounds then and the largest ratio while ready."""

    ready_s: float
    errors: np.ndarray  # (2,) deg, at the first ready
    bounds: np.ndarray
    worst_deg: float  # largest error while ready
    reason: str


def make(kind: str, index: int) -> tuple[Recording, HingeRecording]:
    return make_of(ROWS[kind], kind, index)


def make_of(row: Row, label: str, index: int) -> tuple[Recording, HingeRecording]:
    rng = np.random.default_rng([zlib.crc32(label.encode()), index, 1717])
    motion = choose(rng, row.motions)
    spec = HingeSpec(motions=((motion, LENGTH_S + 1.0),), rate_hz=FINE_HZ, seed=int(rng.integers(2**31)), noise_scale=0.0,
                     gyr_bias_deg_s=rng.uniform(0.0, 0.5), acc_bias=rng.uniform(0.0, 0.2))
    truth = simulate_hinge(spec)
    fine = Fine(truth.t_s, [[truth.gyr1.copy(), truth.acc1.copy()], [truth.gyr2.copy(), truth.acc2.copy()]], truth)
    if row.signals:
        row.signals(fine, rng)
    t_s = 0.4 + np.arange(round(LENGTH_S * row.rate_hz)) / row.rate_hz
    t2_s = row.times2(t_s, rng) if row.times2 else t_s
    (gyr1, acc1), (gyr2, acc2) = fine.at(0, t_s), fine.at(1, t2_s)
    noise = [std * rng.standard_normal(gyr1.shape) for std in (GYR_STD_RAD_S, ACC_STD_M_S2, GYR_STD_RAD_S, ACC_STD_M_S2)]
    rec = Recording(t_s, gyr1 + noise[0], acc1 + noise[1], gyr2 + noise[2], acc2 + noise[3])
    return (row.readings(rec, rng) if row.readings else rec), truth


def said(track: native.Track | functional.Track, truth: HingeRecording) -> Said:
    off = np.column_stack([errors_deg(axis, true) for axis, true in ((track.axis1, truth.axis1), (track.axis2, truth.axis2))])
    if len(track.t_s) == 0:  # no tick: nothing was taken in
        return Said(float("inf"), np.full(2, np.nan), np.full(2, np.nan), float("nan"), "none")
    ready = track.ready
    if isinstance(track, functional.Track):  # for axes: the angle alone promises nothing of them
        ready = ready & track.for_axes
    k = int(ready.argmax()) if ready.any() else -1
    worst = float(off[ready].max()) if ready.any() else float("nan")
    return Said(float(track.t_s[k]) if ready.any() else float("inf"), off[k], track.bounds_deg[k], worst, native.reason_name(track.reason[-1]))


def errors_deg(axes: np.ndarray, true: np.ndarray) -> np.ndarray:
    size = np.maximum(np.linalg.norm(axes, axis=1), 1e-12)
    return np.degrees(np.arccos(np.clip(np.abs(axes @ true) / size, 0.0, 1.0)))


@dataclass
class Outcome:
    kind: str
    index: int
    rigid: Said  # jcal_hinge_t
    both: Said  # jcal_hinge_auto_t
    program: Said  # jointcal hinge
    as_it_comes: Said | None  # jcal_hinge_t, with the settings for such gyroscopes, where the fault is theirs


def said_by_program(rec: Recording, truth: HingeRecording) -> Said:
    """What `jointcal hinge` makes of it: both models, and what the health of both sensors and the lag between them say."""
    with tempfile.TemporaryDirectory() as name:
        file = Path(name) / "both.csv"
        write_csv(file, rec)
        run = subprocess.run([program(), "hinge", str(file), "--json", "--every", f"{EVERY_S:g}"], capture_output=True, text=True)
    if run.returncode not in (0, 3):
        raise RuntimeError(run.stderr)
    lines = [json.loads(line) for line in run.stdout.splitlines()]
    ready = [line for line in lines if line["status"] == "ready" and line["ready_for"] == "axes"]
    if not ready:
        return Said(float("inf"), np.full(2, np.nan), np.full(2, np.nan), float("nan"), lines[-1]["reason"] or "none")
    off = [np.array([errors_deg(np.array([line[name]]), true)[0] for name, true in (("axis1", truth.axis1), ("axis2", truth.axis2))])
           for line in ready]
    return Said(ready[0]["t_s"] - float(rec.t_s[0]), off[0], np.array(ready[0]["uncertainty_deg"]), float(np.max(off)), lines[-1]["reason"] or "none")


def measure_run(job: tuple[str, int]) -> Outcome:
    rec, truth = make(*job)
    return Outcome(*job, said(native.run(rec), truth), said(functional.run(rec, either=True), truth), said_by_program(rec, truth),
                   said(native.run(rec, rate_mismatch=AS_IT_COMES), truth) if job[0] in OF_GYROSCOPES else None)


def wrong(rule: str, one: Said) -> bool:
    return np.isfinite(one.ready_s) and (rule == NEVER or one.worst_deg > WRONG_DEG)


def report_model(report: Report, name: str, outcomes: list[Outcome], pick: Callable[[Outcome], Said], known: float = 0.0) -> None:
    """A table and its requirement. `known`: the share of false `ready` that OPEN says why; more than chance makes of it fails."""
    rows = []
    for kind, row in ROWS.items():
        mine = [pick(o) for o in outcomes if o.kind == kind]
        if not mine:
            continue
        ready = [one for one in mine if np.isfinite(one.ready_s)]
        false = sum(wrong(row.rule, one) for one in mine)
        covered = sum(bool((one.errors <= one.bounds).all()) for one in ready)
        reasons = ", ".join(f"{word} {count}" for word, count in Counter(one.reason for one in mine).most_common(3))
        rows.append([kind, row.rule, len(mine), len(ready), false, percent(covered, len(ready)) if row.rule == HINGE else "-",
                     number(median([one.ready_s for one in ready]), 1), number(max((one.worst_deg for one in ready), default=float("nan")), 1), reasons])
    report.text(f"## {name}")
    report.table(["fault", "rule", "runs", "ready", "false", "covered when first ready", "ready after, s, median", "worst error while ready, deg", "at the end"],
                 rows)
    count = sum(wrong(ROWS[o.kind].rule, pick(o)) for o in outcomes)
    expected = known * len(outcomes)
    report.require(f"{name}: false", f"{count} of {len(outcomes)}", count == 0, OPEN if count <= expected + 3.0 * np.sqrt(expected) else "")


def report_as_it_comes(report: Report, outcomes: list[Outcome]) -> None:
    mine = [o for o in outcomes if o.as_it_comes]
    if not mine:
        return
    report_model(report, "jcal_hinge_t, with JCAL_GYR_AS_IT_COMES", mine, lambda o: o.as_it_comes)
    ready = [o.as_it_comes for o in mine if np.isfinite(o.as_it_comes.ready_s)]
    report.require_share("gyroscopes as they come: ready", len(ready), len(mine), 0.9)
    report.require_share("gyroscopes as they come: covered when first ready",
                         sum(bool((one.errors <= one.bounds).all()) for one in ready), len(ready), 0.95)


def measure(settings: Settings, report: Report) -> None:
    runs = settings.count(RUNS, QUICK_RUNS)
    jobs = numbered({kind: runs for kind in ROWS}, settings.only)
    outcomes = run_jobs(measure_run, jobs, "sensor_faults", settings)
    report.text(f"Simulated hinges, {LENGTH_S:g} s each at {RATE_HZ:g} Hz if nothing else is said, motions {', '.join(MOTIONS)}. The fault is that of sensor 2 where none "
                f"is named. False: ready with an axis more than {WRONG_DEG:g} deg off at any time, the limit that was asked for; of rows with the rule `{NEVER}` ready at "
                "all. Covered: both axes within their bounds when it is first ready.")
    report_model(report, "jcal_hinge_t, the rigid model", outcomes, lambda o: o.rigid, 0.026)
    report_as_it_comes(report, outcomes)
    report_model(report, "jcal_hinge_auto_t, both models, for axes", outcomes, lambda o: o.both, 0.019)
    report_model(report, "jointcal hinge, the program: both models, health of both sensors, lag", outcomes, lambda o: o.program, 0.017)
