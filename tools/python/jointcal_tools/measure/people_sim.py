"""Simulated knees, ankles and elbows with skin: time to ready, axes and their bounds, flexion; slow motion; rigid mounts."""

from __future__ import annotations

import zlib
from collections import Counter
from dataclasses import dataclass, replace

import numpy as np

from .. import native_functional as functional
from ..recordings import Recording
from ..simulate_people import PersonRecording, PersonSpec, main_axes, simulate_person
from . import people_joints as people
from .faults import choose
from .harness import Report, Settings, median, number, numbered, percent, quantile, run_jobs
from .judge import axis_errors
from .people_flexion import apart_rms_deg, twist_deg

TITLE = "Simulated joints of people"
LENGTH_S = 60.0
RATES_HZ = (40.0, 60.0, 100.0, 200.0)
LAGS_S = (0.0, 0.01)
SKIN = (0.5, 2.0)
GYR_BIAS_DEG_S, ACC_BIAS_M_S2 = 0.5, 0.3
WITHIN_S = (10.0, 20.0, 30.0)  # of motion
COVERED = 0.95
LISTED = 40
MOVE_FASTER = 7  # jcal_hint_t

# Class: joint, activities one after the other, what differs from the usual.
LIVELY = {
    **{f"{joint}, {' and '.join(parts)}": (joint, parts, {}) for joint, parts in (
        ("knee", ("walk",)), ("knee", ("run",)), ("knee", ("walk", "run")), ("knee", ("squat",)), ("knee", ("walk", "squat")),
        ("knee", ("random",)), ("ankle", ("walk",)), ("ankle", ("run",)), ("ankle", ("squat",)), ("ankle", ("random",)),
        ("elbow", ("walk",)), ("elbow", ("run",)), ("elbow", ("random",)))},
}
SLOW = {f"knee, {name}": ("knee", (name,), {}) for name in ("sit_to_stand", "slow_squat")}
EXACT = {"skin": 0.0, "out_of_plane": 0.0, "in_phase": 0.0}
LATE = "ankle, run, rigid, sensor 2 late by 10 ms"
LATE_WHY = "The rigid model's bounds know nothing of time between the sensors: 10 ms make 0.7 deg in running"
RIGID = {
    **{f"{joint}, {part}, rigid, accelerometers wrong by {acc:g} m/s^2": (joint, (part,), {**EXACT, "acc_bias": acc, "lag_s": 0.0})
       for joint, part in (("knee", "random"), ("ankle", "run")) for acc in (ACC_BIAS_M_S2, 1.0)},
    LATE: ("ankle", ("run",), {**EXACT, "lag_s": 0.01}),
}
CLASSES = {**LIVELY, **SLOW, **RIGID}
RUNS, QUICK_RUNS = 20, 1
QUICK_STEP = 4  # a quick run makes every fourth class


@dataclass
class Outcome:
    kind: str
    index: int
    spec: PersonSpec
    ready_motion_s: float  # of motion when first ready; infinite if never
    status: str  # at the end: "ready", or the reason and the hint
    functional: bool  # the model at the end
    wrong_pairing: bool  # at any time while ready
    beyond: bool  # an axis beyond twice its bound at any time while ready
    has_axes: bool
    errors_deg: np.ndarray  # (2,) at the end
    bounds_deg: np.ndarray
    other: bool  # pairing at the end
    bones_deg: float  # flexion after ready, rms
    sensors_deg: float
    hinted: str = ""  # slow motion: at the end, with a sign hint
    hinted_wrong: bool = False


def spec_of(kind: str, index: int) -> PersonSpec:
    """Run `index` of class `kind`: the same every time."""
    joint, parts, changes = CLASSES[kind]
    rng = np.random.default_rng([zlib.crc32(kind.encode()), index, 15])
    spec = PersonSpec(tuple((name, LENGTH_S / len(parts)) for name in parts), joint, choose(rng, RATES_HZ), int(rng.integers(2**31)),
                      skin=rng.uniform(*SKIN), out_of_plane=rng.uniform(0.5, 1.3), lag_s=choose(rng, LAGS_S),
                      gyr_bias_deg_s=GYR_BIAS_DEG_S, acc_bias=ACC_BIAS_M_S2)
    return replace(spec, **changes)


def sign_hint(axis1: np.ndarray, axis2: np.ndarray) -> str:
    """What a user who knows the mounting would say: whether the largest components of both axes have one sign."""
    main = [axis[np.argmax(np.abs(axis))] for axis in (axis1, axis2)]
    return "same" if main[0] * main[1] > 0.0 else "opposite"


def said(track: functional.Track) -> str:
    if track.ready[-1]:
        return "ready"
    return functional.reason_name(track.reason[-1]) + (", move_faster" if track.hint[-1] == MOVE_FASTER else "")


def flexion_rms(rec: PersonRecording, track: functional.Track, first: int) -> tuple[float, float]:
    """From sample `first` on, against the bones, and against the sensors that skin carries."""
    level = np.zeros(len(rec) - first)
    sensors = twist_deg((rec.q1[first:], rec.q2[first:]), level, rec.axis1, rec.axis2)
    found = track.flexion_deg[first:]
    return apart_rms_deg(found, np.degrees(rec.flexion_rad[first:])), apart_rms_deg(found, sensors)


def measure_run(job: tuple[str, int]) -> Outcome:
    kind, index = job
    spec = spec_of(kind, index)
    rec = simulate_person(spec)
    axes = (rec.axis1, rec.axis2) if kind in RIGID else main_axes(rec)  # by steps of the samples: not exact enough for rigid mounts
    plain = Recording(rec.t_s, rec.gyr1, rec.acc1, rec.gyr2, rec.acc2)
    track = functional.run(plain, either=True)
    (errors, other), ready = axis_errors(track, *axes), track.ready
    first = int(track.sample[ready.argmax()]) if ready.any() else None
    bones, sensors = flexion_rms(rec, track, first) if first is not None else (np.nan, np.nan)
    outcome = Outcome(kind, index, spec, float(people.motion_s(plain)[first]) if first is not None else np.inf, said(track),
                      bool(track.is_functional[-1]), bool((ready & other).any()),
                      bool((ready[:, None] & (errors > 2.0 * track.bounds_deg)).any()), bool((track.bounds_deg[-1] < 89.0).all()),
                      errors[-1], track.bounds_deg[-1], bool(other[-1]), bones, sensors)
    if kind in SLOW:
        told = functional.run(plain, either=True, sign_hint=sign_hint(rec.axis1, rec.axis2))
        outcome.hinted, outcome.hinted_wrong = said(told), bool((told.ready & axis_errors(told, *axes)[1]).any())
    return outcome


def covered(outcomes: list[Outcome]) -> tuple[list[int], int]:
    """Runs in which each axis is within its bound at the end, and how many state bounds."""
    known = [o for o in outcomes if o.has_axes]
    return [sum(bool(o.errors_deg[k] <= o.bounds_deg[k]) and not o.other for o in known) for k in range(2)], len(known)


def row_of(label: str, mine: list[Outcome]) -> list:
    (hit1, hit2), known = covered(mine)
    ready = [o for o in mine if np.isfinite(o.ready_motion_s)]
    reasons = Counter(o.status for o in mine)
    return [label, len(mine), *(percent(sum(o.ready_motion_s <= m for o in mine), len(mine)) for m in WITHIN_S),
            percent(sum(o.status == "ready" for o in mine), len(mine)), sum(not o.functional for o in ready),
            *(number(quantile([o.errors_deg.max() for o in ready], share), 1) for share in (0.5, 0.9, 1.0)),
            number(median([o.bounds_deg.max() for o in ready]), 1), percent(hit1, known), percent(hit2, known),
            sum(o.wrong_pairing for o in mine), sum(o.beyond for o in mine), number(median([o.bones_deg for o in ready])),
            number(median([o.sensors_deg for o in ready])), number(quantile([o.sensors_deg for o in ready], 1.0)),
            ", ".join(f"{name} {count}" for name, count in reasons.most_common(3))]

RIGHTLY_SAID = ("ready", "sign_open, move_faster")  # of slow motion, without a hint


def report_slow(report: Report, slow: list[Outcome]) -> None:
    report.text("## Slow motion\n\nWhat is said at the end without a hint, and with the right sign hint; wrong: ready with the wrong pairing "
                "at any time. Told: not ready and told to move faster because the sign is open, or ready, rightly, with the hint or without.")
    rows, told = [], 0
    for kind in SLOW:
        mine = [o for o in slow if o.kind == kind]
        if not mine:
            continue
        pairs = Counter((o.status, o.hinted) for o in mine)
        rows += [[kind, without, hinted, count] for (without, hinted), count in pairs.most_common()]
        told += sum(o.status in RIGHTLY_SAID or o.hinted == "ready" for o in mine)
    report.table(["class", "without", "with a hint", "runs"], rows)
    report.require_none("slow motion: ready with the wrong pairing, with a hint or without",
                        sum(o.wrong_pairing or o.hinted_wrong for o in slow), len(slow))
    report.require_share("slow motion: ready with a hint or without, or told to move faster", told, len(slow), 1.0)


def measure(settings: Settings, report: Report) -> None:
    runs = settings.count(RUNS, QUICK_RUNS)
    kinds = list(CLASSES)[::QUICK_STEP if settings.quick else 1]
    counts = dict.fromkeys(CLASSES if settings.only else kinds, runs)
    outcomes = run_jobs(measure_run, numbered(counts, settings.only), "people_sim", settings)
    report.text(f"{LENGTH_S:g} s each, rates of 40 to 200 Hz, skin of {SKIN[0]:g} to {SKIN[1]:g} times that of "
                f"tools/python/jointcal_tools/simulate_people.py, biases of {GYR_BIAS_DEG_S:g} deg/s and {ACC_BIAS_M_S2:g} m/s^2, sensor 2 late by 0 "
                "or 10 ms; both models with the program's defaults. Within: ready within so much motion. Errors, at the end of runs that were "
                "ready: of the worse axis against the main axis of the bones' relative rate, of rigid mounts against the axis itself; covered: axes within their bounds at the end, "
                "of all runs that state bounds. Wrong pairing, beyond (twice the bound): runs in which it is so at any time while ready. "
                "Flexion after ready, rms, one constant removed: against the bones; against the sensors that skin carries, which is what "
                "IMUs can see: the thigh's sensor stays behind by 8 to 15 % of the thigh's own rotation. deg.")
    rows = [row_of(kind, [o for o in outcomes if o.kind == kind]) for kind in CLASSES if any(o.kind == kind for o in outcomes)]
    report.table(["class", "runs", *(f"within {m:g} s" for m in WITHIN_S), "ready at the end", "rigid", "error median", "90 %", "largest",
                  "bound", "covered, axis 1", "axis 2", "wrong pairing", "beyond", "flexion, bones", "sensors", "sensors, largest",
                  "at the end"], rows)
    slow = [o for o in outcomes if o.kind in SLOW]
    if slow:
        report_slow(report, slow)
    bad = [o for o in outcomes if o.wrong_pairing or o.beyond]
    if bad:
        report.text("Ready and wrong:")
        report.table(["run", "wrong pairing", "beyond", "at the end", "errors", "bounds", "skin", "rate", "lag"],
                     [[f"{o.kind}:{o.index}", o.wrong_pairing, o.beyond, o.status, "/".join(number(e, 1) for e in o.errors_deg),
                       "/".join(number(b, 1) for b in o.bounds_deg), number(o.spec.skin), f"{o.spec.rate_hz:g} Hz", f"{1e3 * o.spec.lag_s:g} ms"]
                      for o in bad[:LISTED]])
    report.require_none("ready with the wrong pairing", sum(o.wrong_pairing for o in outcomes), len(outcomes))
    in_time, late = ([o for o in outcomes if (o.kind == LATE) == is_late] for is_late in (False, True))
    report.require_none("ready with an axis beyond twice its bound", sum(o.beyond for o in in_time), len(in_time))
    if late:
        beyond = sum(o.beyond for o in late)
        report.require("the same, rigid mounts of which one sensor is late", f"{beyond} of {len(late)}", beyond == 0, LATE_WHY)
    for label, kinds in (("knees", [k for k in LIVELY if k.startswith("knee")]), ("ankles", [k for k in LIVELY if k.startswith("ankle")]),
                         ("elbows", [k for k in LIVELY if k.startswith("elbow")]), ("rigid mounts", [k for k in RIGID if k != LATE])):
        mine = [o for o in outcomes if o.kind in kinds]
        hits, known = covered(mine)
        if not known:
            continue
        report.require_share(f"{label}: axes within their bounds at the end", hits, known, COVERED)
