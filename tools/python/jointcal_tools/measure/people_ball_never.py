"""Wrong pairs, faulty sensors and motion that shows no axis: what no heading, lever or axis of a person's joint may be said of."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

import numpy as np

from .. import native_two_axes as two_axes
from .harness import Report, Settings, median, number, numbered, percent, quantile, run_jobs
from .people_ball import BEYOND, HEADING, ITEMS, SCALES, UNITS, Known, bounds, errors, known
from .people_ball_cases import CLASSES, NEVER, RULES, Judged, ball_case, counts, here, judged

TITLE = "Never known: people's joints without a common axis"
QUICK_RUNS = 60
LISTED = 8  # of a class
LEAST_RIGHT = 5
# Classes in which something is known for a reason that is understood: the most of it, in parts of the runs, and the reason.
THIGHS = ("Two thighs move as one joint about the pelvis in squats and jumps: 0.2 to 1.6 % of the centre's motion is left")
BELOW_LIMIT = "What is left of the centre's motion, 1 to 5 %, is below the limit of 5 %, mostly in slow or short motion"
KNOWN: dict[str, Known] = {
    "both_thighs": (0.02, THIGHS),
    "other_thigh": (0.014, THIGHS),
    "other_shank_simulated": (0.017, BELOW_LIMIT),
    "degrees_both": (0.017, "Motion so slow that rates in deg/s pass for rates in rad/s; 5.5 % of the centre's motion, at 7 cm/s, is within the limit and noise"),
    "axis_negated": (0.03, BELOW_LIMIT),
    "axes_swapped": (0.014, BELOW_LIMIT),
    "all_negated": (0.163, "Both accelerometers negated: gravity and the places of the sensors change sign with them, and all equations hold"),
    "bends_and_turns": (0.015, "Slow bending and turning in phase is one line in each of two windows that overlap"),
    "rig_2D": (0.039, "Which axis a window shows is told by the lever, and the rig's second axis is across its lever, as no forearm's is: it is taken "
                      "for axis 1"),
}


@dataclass
class Wrong:
    item: int
    t_s: float  # the first time
    error: float  # NaN without a truth
    bound: float
    numbers: dict[str, float]  # what the joint was judged by then


@dataclass
class Outcome:
    kind: str
    index: int
    source: str
    reason: str  # at the end
    known: np.ndarray  # (5,) at any time
    at_end: np.ndarray  # (5,) known then
    errors: np.ndarray = field(default_factory=lambda: np.full(5, np.nan))  # (5,) at the end, NaN without a truth
    bounds: np.ndarray = field(default_factory=lambda: np.full(5, np.nan))
    wrong: list[Wrong] = field(default_factory=list)

    def is_wrong(self, item: int | None = None) -> bool:
        return any(item is None or w.item == item for w in self.wrong)


def wrong_ticks(rule: tuple[str, ...], flags: np.ndarray, off: np.ndarray, stated: np.ndarray) -> np.ndarray:
    """(M, 5) where what is known (M, 5) is wrong; errors off and bounds stated (M, 5). No error, NaN, is not beyond."""
    never = np.array([what == NEVER for what in rule])
    return flags & (never | (off > BEYOND * stated))


def numbers_at(track: two_axes.Track, k: int) -> dict[str, float]:
    return {"motion_s": track.motion_s[k], "speed2": track.speed2[k], "left": track.left[k] / max(track.speed2[k], 1e-9),
            "stiffness": track.stiffness[k], "heading bound": track.heading_bound_deg[k], "windows 1": track.windows[k, 0],
            "windows 2": track.windows[k, 1]}


def off_by(track: two_axes.Track, what: Judged) -> np.ndarray:
    """(M, 5) errors, less what the truth itself may be off by."""
    off = errors(track, what.truth)
    if what.slack_deg is not None:
        off[:, HEADING] = np.maximum(off[:, HEADING] - what.slack_deg[track.sample], 0.0)
    return off


def measure_case(job: tuple[str, int]) -> Outcome:
    kind, index = job
    case = ball_case(kind, index)
    track = two_axes.run(case.rec)
    flags = known(track)
    reason = two_axes.reason_name(track.reason[-1]) if len(track.reason) else "no_data"
    outcome = Outcome(kind, index, case.source, "ready" if track.ready[-1:].any() else reason, flags.any(axis=0), flags[-1:].any(axis=0))
    if not flags.any():
        return outcome
    off, stated = off_by(track, judged(kind, case, track)), bounds(track)
    outcome.errors, outcome.bounds = off[-1], stated[-1]
    bad = wrong_ticks(RULES[CLASSES[kind].rule], flags, off, stated)
    for item in np.flatnonzero(bad.any(axis=0)):
        k = int(bad[:, item].argmax())
        outcome.wrong.append(Wrong(int(item), float(track.t_s[k]), float(off[k, item]), float(stated[k, item]), numbers_at(track, k)))
    return outcome


def report_offenders(report: Report, outcomes: list[Outcome], kinds: list[str]) -> None:
    """The first few of each class, and what they were judged by when they first were wrong."""
    listed = []
    for kind in kinds:
        listed += [(o, w) for o in outcomes if o.kind == kind for w in o.wrong][:LISTED]
    if not listed:
        return
    report.text(f"The first {LISTED} of each class, when it first was wrong: error, where there is a truth, and bound, deg or mm; seconds of motion "
                "in the sums; speed2: square of the centre's speed, (m/s)^2; left: what of it is left; stiffness: what one rotation does not "
                "explain of both rates; bound of the heading, deg; windows that agree on either axis.")
    keys = list(listed[0][1].numbers)
    report.table(["run", "what", "at, s", "error", "bound", *keys, "made from"],
                 [[f"{o.kind}:{o.index}", ITEMS[w.item], number(w.t_s, 1), *(f"{number(SCALES[w.item] * value, 1)}" for value in (w.error, w.bound)),
                   *(f"{value:.3g}" for value in w.numbers.values()), o.source] for o, w in listed])


def report_right(report: Report, outcomes: list[Outcome], kinds: list[str]) -> None:
    """Of what may be known and has a truth: how good it is."""
    rows = []
    for kind in kinds:
        for item, what in enumerate(RULES[CLASSES[kind].rule]):
            mine = [o for o in outcomes if o.kind == kind and o.at_end[item] and np.isfinite(o.errors[item])]
            if what == NEVER or len(mine) < LEAST_RIGHT:
                continue
            off, stated = (np.array([getattr(o, of)[item] for o in mine]) for of in ("errors", "bounds"))
            digits = 1 if UNITS[item] == "deg" else 0
            rows.append([kind, ITEMS[item], UNITS[item], len(mine), percent(int((off <= stated).sum()), len(mine)),
                         *(number(SCALES[item] * value, digits) for value in (median(off), quantile(off, 0.9), quantile(off, 1.0), median(stated)))])
    if rows:
        report.text(f"What is known at the end and has a truth, in classes where there are at least {LEAST_RIGHT} such runs, real ones among them: how many are "
                    "within their bound, errors (less what the truth itself may be off by, 5 deg of sensors on one body), and the median bound.")
        report.table(["class", "what", "unit", "known at the end", "within the bound", "error, median", "90 %", "largest", "bound"], rows)


def measure(settings: Settings, report: Report) -> None:
    total = sum(CLASSES[name].runs for name in here())
    outcomes = run_jobs(measure_case, numbered(counts(settings.count(total, QUICK_RUNS)), settings.only), "people_ball_never", settings)
    rules = "; ".join(f"{name}: {', '.join(item for item, what in zip(ITEMS, rule, strict=True) if what == NEVER) or 'nothing'}"
                      for name, rule in RULES.items())
    report.text("Runs of 26 s (of the last four classes of 20 to 350 s), real where recordings are, else simulated, each to a fresh instance of the joint with two axes, whose heading and "
                "levers are those of the ball joint; the classes are described in tools/python/jointcal_tools/measure/people_faults.py and "
                f"people_ball_cases.py. By its rule a class says what must never be known ({rules}); everything else must never be known and off by more than "
                f"{BEYOND:g} times its bound, where there is a truth. The counts are of runs in which it is so at any time, in "
                "parentheses: of runs in which it is known at any time. Truth: orientations (of headings the mean over 1 s), levers and axes of the simulation; optical orientations and measured levers of rigs "
                "and elbows; of pelvis and shank the headings of hip and knee; of two sensors on one body the turn between their rates; of both legs "
                "none. `measure.py people_ball_never --only CLASS:NUMBER` makes a run again.")
    kinds = list(dict.fromkeys(o.kind for o in outcomes))

    def cells(mine: list[Outcome]) -> list[str]:
        return [f"{sum(o.is_wrong(item) for o in mine)} ({sum(bool(o.known[item]) for o in mine)})" for item in range(5)]

    rows = []
    for kind in kinds:
        mine = [o for o in outcomes if o.kind == kind]
        rows.append([kind, CLASSES[kind].rule, len(mine), *cells(mine), sum(o.is_wrong() for o in mine),
                     ", ".join(f"{name} {count}" for name, count in Counter(o.reason for o in mine).most_common(3))])
    rows.append(["all", "", len(outcomes), *cells(outcomes), sum(o.is_wrong() for o in outcomes), ""])
    report.table(["class", "rule", "runs", *(f"{item}" for item in ITEMS), "any", "at the end"], rows)
    report_right(report, outcomes, kinds)
    report_offenders(report, outcomes, kinds)
    for kind in kinds:
        mine = [o for o in outcomes if o.kind == kind]
        wrong = sum(o.is_wrong() for o in mine)
        if wrong:
            most, why = KNOWN.get(kind, (0.0, ""))
            what = ", ".join(f"{ITEMS[item]} {count}" for item in range(5) if (count := sum(o.is_wrong(item) for o in mine)))
            report.require(f"{kind}: wrongly known", f"{wrong} of {len(mine)} ({what})", False, why if wrong <= max(most * len(mine), 1.0) else "")
    rest = [o for o in outcomes if o.kind not in KNOWN]
    report.require_none("wrongly known, all classes without a known reason", sum(o.is_wrong() for o in rest), len(rest))

