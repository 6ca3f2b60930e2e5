"""What faults of real sensors do to the joint centre: scales, lag, vibration, clipping, signs, the rate behind the times."""

from __future__ import annotations

import zlib
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from .. import native
from .. import native_center as center
from .. import native_two_axes as ball
from ..recordings import Recording
from ..simulate import ACC_STD_M_S2, GYR_STD_RAD_S
from ..simulate_two_dof import TwoDofRecording, TwoDofSpec, simulate_two_dof
from .center_sim import errors_mm
from .faults import choose
from .harness import Report, Settings, median, number, numbered, percent, run_jobs
from .sensor_faults import FINE_HZ, RATE_HZ, Change, Fine, Read, clipped_early, negated, scaled, vibrate

TITLE = "Faults of real sensors: the joint centre"
RUNS, QUICK_RUNS = 100, 2  # of a row
LENGTH_S = 40.0
MOTIONS = ("three_dof", "free", "daily")
WRONG_MM = 15.0  # off by more than this, and by more than the bound that is stated
COVERAGE = 0.95

CENTER, NEVER = "centre", "never"  # what a row is: a centre that must be right, or nothing that may be ready

CLIPPED_KNOWN = "clipping that a calibration hid leaves rates that fit each other for a while; health.h names it"
BALL_KNOWN = "a 95 % bound that is told at every moment: of many runs some are beyond it for a while"
SCALE_KNOWN = ("an error of scale moves the place and leaves little behind; the bound of jcal_center_t holds as much of it as rate_mismatch says, that of "
               "jcal_ball_t none by name, and health.h names scales that are far off")


@dataclass(frozen=True)
class Row:
    """A fault: what it does to the signals before they are sampled, to the times of sensor 2, and to the readings."""

    rule: str
    signals: Change | None = None
    late_s: float = 0.0
    rate_hz: float = RATE_HZ
    readings: Read | None = None
    settings: dict[str, float] = field(default_factory=dict)  # of jcal_center_t
    known: str = ""  # why what is asked for is not reached


def both_accelerometers(times: float) -> Read:
    return lambda rec, rng: replace(rec, acc1=rec.acc1 * times, acc2=rec.acc2 * times)


def one_accelerometer(times: float) -> Read:
    def read(rec: Recording, rng: np.random.Generator) -> Recording:
        name = choose(rng, ("acc1", "acc2"))
        return replace(rec, **{name: getattr(rec, name) * times})

    return read


def timed_as_of(true_hz: float, said_hz: float) -> Read:
    """Readings came at `true_hz`; their times say `said_hz`."""
    return lambda rec, rng: replace(rec, t_s=rec.t_s[0] + (rec.t_s - rec.t_s[0]) * true_hz / said_hz)


ROWS: dict[str, Row] = {
    "no fault": Row(CENTER),
    "both accelerometers x 2": Row(NEVER, readings=both_accelerometers(2.0)),
    "both accelerometers x 0.5": Row(NEVER, readings=both_accelerometers(0.5)),
    "one accelerometer x 1.05": Row(CENTER, readings=one_accelerometer(1.05)),
    **{f"scale {100 * share:g} %": Row(CENTER, readings=scaled(share), known=SCALE_KNOWN) for share in (0.02, 0.05, 0.10)},
    "no fault, rate_mismatch 0.01": Row(CENTER, settings={"rate_mismatch": 0.01}),
    "scale 2 %, rate_mismatch 0.01": Row(CENTER, readings=scaled(0.02), settings={"rate_mismatch": 0.01}),
    "scale 5 %, rate_mismatch 0.02": Row(CENTER, readings=scaled(0.05), settings={"rate_mismatch": 0.02}, known=SCALE_KNOWN),
    **{f"late by {ms} ms": Row(CENTER, late_s=1e-3 * ms) for ms in (5, 20, 100)},
    "vibrates at 33 Hz": Row(CENTER, vibrate(33.0, 0.3)),
    "clipped at 0.4 of the peak, then calibrated": Row(CENTER, readings=clipped_early, known=CLIPPED_KNOWN),
    "accelerometer 1 negated": Row(CENTER, readings=negated("acc1", (0, 1, 2))),
    "rate 80 read as 100": Row(CENTER, rate_hz=80.0, readings=timed_as_of(80.0, 100.0)),
}


@dataclass
class Said:
    """What a model said of one run."""

    first_s: float
    errors: np.ndarray  # (2,) mm, at the first ready
    bounds: np.ndarray
    worst_mm: float  # largest error while ready
    false: bool
    reason: str


@dataclass
class Outcome:
    kind: str
    center: Said  # jcal_center_t
    ball: Said | None  # jcal_ball_t, where it is asked


def make(kind: str, index: int) -> tuple[Recording, TwoDofRecording]:
    rng = np.random.default_rng([zlib.crc32(kind.encode()), index, 2727])
    row = ROWS[kind]
    spec = TwoDofSpec(motions=((choose(rng, MOTIONS), LENGTH_S + 1.0),), rate_hz=FINE_HZ, seed=int(rng.integers(2**31)), noise_scale=0.0,
                      carrying_deg=rng.uniform(0.0, 30.0), speed=rng.uniform(1.5, 2.5), gyr_bias_deg_s=rng.uniform(0.0, 0.5),
                      acc_bias=rng.uniform(0.0, 0.2))
    truth = simulate_two_dof(spec)
    fine = Fine(truth.t_s, [[truth.gyr1.copy(), truth.acc1.copy()], [truth.gyr2.copy(), truth.acc2.copy()]], truth)
    if row.signals:
        row.signals(fine, rng)
    t_s = 0.4 + np.arange(round(LENGTH_S * row.rate_hz)) / row.rate_hz
    (gyr1, acc1), (gyr2, acc2) = fine.at(0, t_s), fine.at(1, t_s - row.late_s)
    noise = [std * rng.standard_normal(gyr1.shape) for std in (GYR_STD_RAD_S, ACC_STD_M_S2, GYR_STD_RAD_S, ACC_STD_M_S2)]
    rec = Recording(t_s, gyr1 + noise[0], acc1 + noise[1], gyr2 + noise[2], acc2 + noise[3])
    return (row.readings(rec, rng) if row.readings else rec), truth


def said(row: Row, t_s: np.ndarray, ready: np.ndarray, errors: np.ndarray, bounds: np.ndarray, reason: str) -> Said:
    """`ready`, errors and bounds (N, 2) of each vector, mm; ready of a whole is that of both."""
    wrong = ready & (errors > WRONG_MM) & (errors > bounds)
    both = ready.all(axis=1)
    at = int(both.argmax()) if both.any() else -1
    return Said(float(t_s[at]) if both.any() else np.inf, errors[at], bounds[at], float(errors[ready].max()) if ready.any() else float("nan"),
                bool(ready.any() if row.rule == NEVER else wrong.any()), reason)


def measure_run(job: tuple[str, int]) -> Outcome:
    kind, row = job[0], ROWS[job[0]]
    rec, truth = make(*job)
    track = center.run(rec, **row.settings)
    center_said = said(row, track.t_s, np.repeat(track.ready[:, None], 2, axis=1), errors_mm(track, truth), 1e3 * track.bounds_m,
                       native.reason_name(track.reason[-1]))
    if row.settings:
        return Outcome(kind, center_said, None)
    people = ball.run(rec)
    return Outcome(kind, center_said, said(row, people.t_s, people.for_center, errors_mm(people, truth), 1e3 * people.lever_bounds_m,
                                           native.reason_name(people.reason[-1])))


def report_model(report: Report, name: str, kinds: dict[str, list[Said]], known: str) -> None:
    rows = []
    for kind, mine in kinds.items():
        row, ready = ROWS[kind], [one for one in mine if np.isfinite(one.first_s)]
        false, covered = sum(one.false for one in mine), sum(bool((one.errors <= one.bounds).all()) for one in ready)
        reasons = ", ".join(f"{word} {count}" for word, count in Counter(one.reason for one in mine).most_common(3))
        is_covered = row.rule == CENTER and bool(ready)
        rows.append([kind, row.rule, len(mine), len(ready), false, percent(covered, len(ready)) if is_covered else "-",
                     number(median([one.first_s for one in ready]), 1), number(median([one.errors.max() for one in ready]), 1),
                     number(median([one.bounds.max() for one in ready]), 1), number(max((one.worst_mm for one in mine if np.isfinite(one.worst_mm)), default=float("nan")), 1), reasons])
        report.require(f"{name}, {kind}: false", f"{false} of {len(mine)}", false == 0, row.known or known)
        if is_covered:
            report.require(f"{name}, {kind}, first ready: both within their bounds, at least {100 * COVERAGE:g} %",
                           f"{percent(covered, len(ready))} of {len(ready)}", report.quick or covered >= COVERAGE * len(ready), row.known)
    report.text(f"## {name}")
    report.table(["fault", "rule", "runs", "ready", "false", "covered when first ready", "ready after, s, median", "error, mm", "bound, mm",
                  "worst error while ready, mm", "at the end"], rows)


def measure(settings: Settings, report: Report) -> None:
    jobs = numbered({kind: settings.count(RUNS, QUICK_RUNS) for kind in ROWS}, settings.only)
    outcomes = run_jobs(measure_run, jobs, "center_faults", settings)
    report.text(f"Simulated joints on rigid segments, {LENGTH_S:g} s each at {RATE_HZ:g} Hz, motions {', '.join(MOTIONS)}, 1.5 to 2.5 rad/s rms, levers of 5 to 30 cm. The "
                f"fault is that of sensor 2 where none is named. False: ready at any time with a vector that is off by more than its bound and by more than {WRONG_MM:g} mm; "
                f"of rows with the rule `{NEVER}` ready at all. Covered, error and bound (the larger of both, median): when both are first ready.")
    kinds = list(dict.fromkeys(o.kind for o in outcomes))
    report_model(report, "jcal_center_t", {kind: [o.center for o in outcomes if o.kind == kind] for kind in kinds}, "")
    report_model(report, "jcal_ball_t, levers", {kind: [o.ball for o in outcomes if o.kind == kind] for kind in kinds if not ROWS[kind].settings}, BALL_KNOWN)
