"""Simulated knees, ankles and elbows with skin: coverage and sharpness of the bounds of heading and levers, and how soon they are known."""

from __future__ import annotations

import zlib
from collections import Counter
from dataclasses import dataclass, replace

import numpy as np

from .. import native_two_axes as two_axes
from ..recordings import Recording
from ..simulate_people import PersonSpec, main_axes, simulate_person
from . import people_joints as people
from .harness import Report, Settings, median, number, numbered, percent, quantile, run_jobs
from .people_ball import (BEYOND, HEADING, ITEMS, LEVERS, SCALES, UNITS, UNKNOWN_BOUNDS, Known, Truth, bounds, errors, first, known, require_none,
                          require_share, true_heading_deg)
from .people_flexion import wrapped_deg
from .people_sim import EXACT, LIVELY, WITHIN_S, spec_of

TITLE = "Simulated joints of people: heading and levers"
RUNS, QUICK_RUNS = 30, 1
QUICK_STEP = 4  # a quick run makes every fourth class
COVERED = 0.95
LISTED = 40
RIGID = {f"{joint}, {part}, rigid": (joint, part) for joint, part in (("knee", "walk"), ("knee", "random"), ("elbow", "random"))}
CLASSES = (*LIVELY, *RIGID)
JUDGED = (HEADING, *LEVERS, 3)  # axis 2 is not there
GROUPS = {"knees": "knee", "ankles": "ankle", "elbows": "elbow"}
DRIFT_S = 20.0  # of the true heading, over the last seconds
# What is reached where a requirement is not met, and why.
INCLINED = "Four ankles that run, of whose sensors an inclination is wrong by 10 to 60 deg for a while"
KNOWN_BEYOND: dict[int, Known] = {HEADING: (0.0085, INCLINED)}
KNOWN_INSIDE: dict[tuple[str, int, str], Known] = {}


@dataclass
class Outcome:
    kind: str
    index: int
    spec: PersonSpec
    after_s: np.ndarray  # (5,) of motion until known; infinite if never
    first_errors: np.ndarray  # (5,) then
    first_bounds: np.ndarray
    known: np.ndarray  # (5,) at the end
    errors: np.ndarray  # (5,) at the end
    bounds: np.ndarray
    beyond: np.ndarray  # (5,) beyond twice its bound at any time while known
    outside: np.ndarray  # (5,) share of the time while known that the error is above the bound
    reason: str
    off_deg: float  # heading at the end, with its sign
    drift_deg_s: float  # of the true heading


def person_of(kind: str, index: int) -> PersonSpec:
    """Run `index` of class `kind`: as of people_sim, with a seed of its own."""
    name = kind.removesuffix(", rigid")
    spec = spec_of(name, index)
    seed = int(np.random.default_rng([zlib.crc32(kind.encode()), index, 26]).integers(2**31))
    return replace(spec, seed=seed, **(EXACT | {"lag_s": 0.0} if kind in RIGID else {}))


def measure_run(job: tuple[str, int]) -> Outcome:
    kind, index = job
    spec = person_of(kind, index)
    rec = simulate_person(spec)
    plain = Recording(rec.t_s, rec.gyr1, rec.acc1, rec.gyr2, rec.acc2)
    track = two_axes.run(plain)
    axis1 = rec.axis1 if kind in RIGID else main_axes(rec)[0]
    truth = Truth(true_heading_deg((track.q1, track.q2), (rec.q1, rec.q2), spec.rate_hz), (rec.r1, rec.r2), (axis1, None))
    off, stated, flags = errors(track, truth), bounds(track), known(track)
    moved = people.motion_s(plain)[track.sample]
    ks = [first(flags[:, item]) for item in range(5)]

    def true_then(seconds: float) -> float:
        return float(truth.heading_deg[np.searchsorted(rec.t_s, rec.t_s[-1] - seconds)])

    def at_first(values: np.ndarray) -> np.ndarray:
        return np.array([np.nan if k is None else values[k, item] for item, k in enumerate(ks)])

    return Outcome(kind, index, spec, np.array([np.inf if k is None else moved[k] for k in ks]), at_first(off), at_first(stated),
                   flags[-1], off[-1], stated[-1], (flags & (off > BEYOND * stated)).any(axis=0),
                   (flags & (off > stated)).sum(axis=0) / np.maximum(flags.sum(axis=0), 1), two_axes.reason_name(track.reason[-1]),
                   float(wrapped_deg(track.heading_deg[-1] - truth.heading_deg[track.sample[-1]])),
                   float(wrapped_deg(true_then(0.0) - true_then(DRIFT_S))) / DRIFT_S)


def inside(outcomes: list[Outcome], item: int, when: str) -> tuple[int, int]:
    """Runs whose item is within its bound: when it is first known ("first"), of those known at the end ("end"), of all that state one ("stated")."""
    if when == "first":
        pairs = [(o.first_errors[item], o.first_bounds[item]) for o in outcomes if np.isfinite(o.after_s[item])]
    else:
        pairs = [(o.errors[item], o.bounds[item]) for o in outcomes
                 if (o.known[item] if when == "end" else o.bounds[item] < UNKNOWN_BOUNDS[item])]
    return sum(bool(error <= bound) for error, bound in pairs), len(pairs)


def row_of(label: str, mine: list[Outcome], item: int) -> list:
    ended = [o for o in mine if o.known[item]]
    off, stated = ([SCALES[item] * getattr(o, what)[item] for o in ended] for what in ("errors", "bounds"))
    middle, bound = median(off), median(stated)
    return [label, ITEMS[item], UNITS[item], len(mine), *(percent(sum(o.after_s[item] <= m for o in mine), len(mine)) for m in WITHIN_S),
            percent(len(ended), len(mine)), *(percent(*inside(mine, item, when)) for when in ("first", "end", "stated")),
            number(middle, 1), number(quantile(off, 0.9), 1), number(bound, 1), number(bound / middle if ended else np.nan, 1),
            sum(bool(o.beyond[item]) for o in mine),
            percent(float(np.mean([o.outside[item] for o in mine if np.isfinite(o.after_s[item])] or [np.nan])), 1)]


def lag_of(off_deg: np.ndarray, drift_deg_s: np.ndarray) -> tuple[float, float]:
    """How late (s) the heading is, if its errors come of its drift, and the correlation of both."""
    return -float(off_deg @ drift_deg_s / (drift_deg_s @ drift_deg_s)), float(-np.corrcoef(off_deg, drift_deg_s)[0, 1])


def report_lag(report: Report, groups: dict[str, list[Outcome]]) -> None:
    rows = []
    for label, mine in groups.items():
        ended = [o for o in mine if o.known[HEADING]]
        if len(ended) < 3:
            continue
        off, drift, stated = (np.array([value(o) for o in ended]) for value in
                              (lambda o: o.off_deg, lambda o: o.drift_deg_s, lambda o: o.bounds[HEADING]))
        late_s, alike = lag_of(off, drift)
        rows.append([label, len(ended), number(quantile(np.abs(drift), 0.5)), number(quantile(np.abs(drift), 1.0)), number(late_s, 1), number(alike),
                     percent(int((np.abs(off) <= stated).sum()), len(ended)),
                     percent(int((np.abs(off + late_s * drift) <= stated).sum()), len(ended))])
    report.text(f"## Headings that drift\n\nThe true heading's drift over the last {DRIFT_S:g} s (biases of gyroscopes that are not known yet), "
                "and what the errors at the end have of it: error = -lag x drift, of runs in which the heading is known then. "
                "Covered without the lag: with lag x drift taken off.")
    report.table(["runs of", "known", "drift, median, deg/s", "largest", "lag, s", "correlation", "covered, end", "without the lag"], rows)


def measure(settings: Settings, report: Report) -> None:
    runs = settings.count(RUNS, QUICK_RUNS)
    kinds = CLASSES[::QUICK_STEP] if settings.quick and not settings.only else CLASSES
    outcomes = run_jobs(measure_run, numbered(dict.fromkeys(kinds, runs), settings.only), "people_ball_sim", settings)
    report.text("60 s each: rates of 40 to 200 Hz, skin of 0.5 to 2 times that of tools/python/jointcal_tools/simulate_people.py, biases and lag as in "
                "people_sim.md. Truth: orientations of the sensors that skin carries, the true heading as its mean over 1 s; levers in the mean over skin, the main axis of the bones. Within: known "
                "within so much motion. Covered: within its bound when it is first known, of runs in which it ever is; at the end, of "
                "those in which it is known then, and of all that state a bound then. A rigid hinge's centre may be anywhere on its axis: levers "
                "are not to be known there. Errors, bounds, and sharpness (median bound over median "
                f"error): of those known at the end. Beyond: runs in which it is known and more than {BEYOND:g} times its bound off at any time; "
                "outside: share of the time while known in which the error is above the bound, mean over runs. The levers' bounds hold 17 and "
                "10 % of the lever for skin that goes along with its segment; simulated skin does so by 8 to 15 % of the proximal segment's rotation.")
    rows = []
    for kind in CLASSES:
        mine = [o for o in outcomes if o.kind == kind]
        rows += [row_of(kind, mine, item) for item in JUDGED if mine]
    groups = {label: [o for o in outcomes if o.spec.joint == joint and o.kind not in RIGID] for label, joint in GROUPS.items()}
    groups["rigid mounts"] = [o for o in outcomes if o.kind in RIGID]
    for label, mine in groups.items():
        rows += [row_of(f"all {label}", mine, item) for item in JUDGED if mine]
    report.table(["class", "what", "unit", "runs", *(f"within {m:g} s" for m in WITHIN_S), "known at the end", "covered, first", "covered, end",
                  "covered, all that state one", "error median", "90 %", "bound", "sharpness", "beyond", "outside"], rows)
    report_lag(report, groups)
    report.text("What is said at the end:")
    report.table(["class", "runs"], [[label, ", ".join(f"{name} {count}" for name, count in Counter(o.reason for o in mine).most_common())]
                                     for label, mine in groups.items() if mine])
    bad = [(o, item) for o in outcomes for item in range(5) if o.beyond[item] or (item == 4 and np.isfinite(o.after_s[item]))]
    if bad:
        report.text("Known and beyond, or axis 2, which is not there, known:")
        report.table(["run", "what", "error at the end", "bound", "outside", "skin", "rate", "lag"],
                     [[f"{o.kind}:{o.index}", ITEMS[item], number(SCALES[item] * o.errors[item], 1), number(SCALES[item] * o.bounds[item], 1),
                       percent(o.outside[item], 1), number(o.spec.skin), f"{o.spec.rate_hz:g} Hz", f"{1e3 * o.spec.lag_s:g} ms"] for o, item in bad[:LISTED]])
    for item in JUDGED:
        require_none(report, f"{ITEMS[item]} known and beyond twice its bound", sum(bool(o.beyond[item]) for o in outcomes), len(outcomes),
                     KNOWN_BEYOND.get(item))
    report.require_none("axis 2 known, though nothing turns about it", sum(bool(np.isfinite(o.after_s[4])) for o in outcomes), len(outcomes))
    for label, mine in groups.items():
        for item in (HEADING, *LEVERS):
            for when, word in (("first", "when first known"), ("end", "at the end")):
                hits, total = inside(mine, item, when)
                require_share(report, f"{label}: {ITEMS[item]} within its bound {word}", hits, total, COVERED, KNOWN_INSIDE.get((label, item, when)))
