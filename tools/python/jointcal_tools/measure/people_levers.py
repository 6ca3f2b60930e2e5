"""Levers of people: a thigh's length from hip and knee, and whether separate parts of a recording agree on levers and axes."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations

import numpy as np

from .. import native_two_axes as two_axes
from . import people_joints as people
from .harness import Report, Settings, Skipped, median, number, percent, quantile, run_jobs
from .judge import available, cut
from .people_ball import AXES, ITEMS, LEVERS, SCALES, UNITS, UNKNOWN_BOUNDS, bounds, known
from .people_hinge import TEMPERATURES, settled

TITLE = "People's levers"
LEGS = ("walk_leg_L", "human_leg_left")
REPEATED = ("human_elbow_right", "human_knee_left")
THIGH_PARTS_S = 20.0
PARTS_S = (20.0, 33.0)
LEVERS_APART_MM, AXES_APART_DEG = 20.0, 10.0  # in the median
AGREE = 0.95
SHARPEST = 3.0  # bound over scatter
SCATTER_PARTS = 3  # at least, or the scatter is chance
COMMON = "10 % of the lever and 3 mm, nearly half of the bound, are for what all parts have in common"
NORMAL_95 = 1.96
SKIN = (0.17, 0.10)  # of the levers, within their bounds, for skin that goes along with its segment: the same in every part


@dataclass
class Estimate:
    """At the end of a part."""

    name: str
    length_s: float  # of the part; 0: the whole recording
    warm: bool
    begin_s: float
    r: tuple[np.ndarray, np.ndarray]
    axes: tuple[np.ndarray, np.ndarray]
    bounds: np.ndarray  # (5,)
    known: np.ndarray  # (5,) at the end
    reason: str
    left: float  # of the centre's motion, as a share

    @property
    def is_there(self) -> bool:
        """Not if nothing moved."""
        return bool(np.any(self.r[0]) and np.any(self.r[1]))

    def value(self, item: int) -> np.ndarray:
        return self.r[LEVERS.index(item)] if item in LEVERS else self.axes[AXES.index(item)]


def starts_of(name: str, length_s: float) -> list[tuple[int, int]]:
    """First sample and end of consecutive parts of a recording; 0: the whole of it."""
    t_s = people.people_joint(name).t_s
    if length_s == 0.0:
        return [(0, len(t_s))]
    edges = t_s[0] + np.arange(0.0, t_s[-1] - t_s[0] + 0.011, length_s)
    return [tuple(np.searchsorted(t_s, [begin - 1e-6, end - 1e-6])) for begin, end in zip(edges[:-1], edges[1:], strict=True)]


def measure_part(job: tuple[str, float, int, int, bool]) -> Estimate | None:
    name, length_s, begin, end, warm = job
    rec = people.people_joint(name)
    before = settled(rec, begin) if warm else begin
    if before is None:
        return None
    track = two_axes.run(cut(rec, before, end), begin=begin - before)
    flags = known(track) & (track.sample >= begin - before)[:, None]
    return Estimate(name, length_s, warm, float(rec.t_s[begin] - rec.t_s[0]), (track.r1[-1], track.r2[-1]), (track.axis1[-1], track.axis2[-1]),
                    bounds(track)[-1], flags[-1], two_axes.reason_name(track.reason[-1]),
                    float(track.left[-1] / max(track.speed2[-1], 1e-9)))


# A thigh.

@dataclass
class Thigh:
    name: str
    length_s: float
    warm: bool
    begin_s: float
    length_m: float
    bound_m: float
    known: bool  # both levers, at the end
    stated: bool  # both state a bound
    left: tuple[float, float]  # of hip and knee
    reasons: str


def thigh_of(hip: Estimate, knee: Estimate) -> Thigh:
    """Both levers are of the thigh's sensor: sensor 2 of the hip, sensor 1 of the knee."""
    stated = hip.bounds[2] < UNKNOWN_BOUNDS[2] and knee.bounds[1] < UNKNOWN_BOUNDS[1]
    return Thigh(hip.name.partition(":")[0], hip.length_s, hip.warm, hip.begin_s, float(np.linalg.norm(hip.r[1] - knee.r[0])),
                 float(np.hypot(hip.bounds[2], knee.bounds[1])), bool(hip.known[2] and knee.known[1]), bool(stated), (hip.left, knee.left),
                 f"{hip.reason}, {knee.reason}")


def spread_row(label: str, mine: list[Thigh]) -> list:
    lengths = 1e3 * np.array([t.length_m for t in mine])
    return [label, len(mine), *((number(median(lengths), 0), number(np.std(lengths, ddof=1) if len(mine) > 1 else np.nan, 0),
                                 number(np.ptp(lengths), 0)) if len(mine) else ("-", "-", "-")),
            number(1e3 * median([t.bound_m for t in mine if t.stated]), 0)]


def report_thighs(report: Report, thighs: list[Thigh], truth_m: float | None) -> None:
    report.text("## Thigh length\n\nFrom the hip's lever to the thigh's sensor and the knee's, both in the thigh sensor's frame, at the end of a recording or of "
                "consecutive parts of 20 s, known or not; parts in which nothing moves are left out. Bound: of both together (root of the sum of squares). "
                "Known: both levers. Truth, optical: " + ("-" if truth_m is None else f"{1e3 * truth_m:.0f} mm (walk_leg_L)") + ".")
    report.table(["recording", "filters", "from, s", "part", "length, mm", "bound", "known", "left of the hip's motion, %",
                  "of the knee's", "at the end, hip, knee"],
                 [[t.name, "warm" if t.warm else "cold", number(t.begin_s, 0), "whole" if t.length_s == 0.0 else f"{t.length_s:g} s", number(1e3 * t.length_m, 0),
                   number(1e3 * t.bound_m, 0) if t.stated else "-", "yes" if t.known else "no",
                   *(number(100.0 * share, 1) for share in t.left), t.reasons] for t in thighs])
    rows = []
    for word, warm in TEMPERATURES:
        mine = [t for t in thighs if t.name == LEGS[1] and t.length_s and t.warm == warm]
        rows += [spread_row(f"{LEGS[1]}, {word}, {what}", some) for what, some in (
            ("all parts", mine), ("with bounds", [t for t in mine if t.stated]), ("known", [t for t in mine if t.known]))]
    report.table(["parts", "number", "length, median, mm", "standard deviation", "largest less smallest", "bound"], rows)
    for t in thighs:
        if t.name == LEGS[0] and t.length_s == 0.0 and truth_m is not None:
            off = abs(t.length_m - truth_m)
            report.require(f"{t.name}, whole: thigh length within its bound", f"{1e3 * (t.length_m - truth_m):+.0f} mm, bound {1e3 * t.bound_m:.0f} mm",
                           t.stated and off <= t.bound_m)
    known_parts = [t for t in thighs if t.name == LEGS[1] and t.length_s and t.known and not t.warm]
    report.text(f"{LEGS[1]}: {len(known_parts)} of {sum(bool(t.name == LEGS[1] and t.length_s and not t.warm) for t in thighs)} parts, cold, know both levers.")


# Parts that agree.

@dataclass(frozen=True)
class Repeat:
    """Pairs of parts that both know, or both state a bound."""

    pairs: int
    apart: np.ndarray  # (pairs,) in units
    within: np.ndarray  # (pairs,) bool: within both bounds together
    bound: float  # median
    scatter: float  # of one part, 95 %

    @property
    def ratio(self) -> float:
        return self.bound / self.scatter if self.scatter > 0.0 else float("nan")


def apart(item: int, one: np.ndarray, other: np.ndarray) -> float:
    """Distance of two levers, m, or angle of two axes, deg."""
    if item in LEVERS:
        return float(np.linalg.norm(one - other))
    return float(np.degrees(np.arccos(np.clip(abs(one @ other), 0.0, 1.0))))


def scatter_95(item: int, values: list[np.ndarray]) -> float:
    """What 95 % of estimates would be off by if their spread were all: 1.96 times the root mean square of what they differ from their mean by.

    Unlike the largest of a few this does not grow with their number.
    """
    if len(values) < 2:
        return float("nan")
    stacked = np.array(values)
    if item in LEVERS:
        mean = stacked.mean(axis=0)
        off = np.linalg.norm(stacked - mean, axis=1)
    else:
        mean = np.linalg.eigh(stacked.T @ stacked)[1][:, -1]
        off = np.array([apart(item, value, mean) for value in stacked])
    return NORMAL_95 * float(np.sqrt((off**2).sum() / (len(values) - 1)))


def repeat_of(item: int, estimates: list[Estimate]) -> Repeat:
    pairs = list(combinations(estimates, 2))
    distances = np.array([apart(item, a.value(item), b.value(item)) for a, b in pairs])
    allowed = np.array([np.hypot(a.bounds[item], b.bounds[item]) for a, b in pairs])
    return Repeat(len(pairs), distances, distances <= allowed, median([e.bounds[item] for e in estimates]),
                  scatter_95(item, [e.value(item) for e in estimates]))


def repeat_row(label: str, item: int, mine: list[Estimate]) -> list:
    told = [e for e in mine if e.known[item]]
    stated = [e for e in mine if e.bounds[item] < UNKNOWN_BOUNDS[item]]
    r, scale = repeat_of(item, told), SCALES[item]
    return [label, ITEMS[item], UNITS[item], len(mine), len(told), r.pairs, percent(int(r.within.sum()), r.pairs), number(scale * median(r.apart), 1),
            number(scale * quantile(r.apart, 1.0), 1), number(scale * r.bound, 1), number(scale * r.scatter, 1), number(r.ratio, 1), len(stated),
            number(scale * median(repeat_of(item, stated).apart), 1)]


def report_repeats(report: Report, estimates: list[Estimate]) -> None:
    report.text("## Parts of a recording\n\nConsecutive parts, a fresh instance for each (warm: filters have run before), its estimate at the "
                "end. Pairs: of parts that know it then; agree: the two are within both bounds together (root of the sum of squares). Scatter: "
                "1.96 times the standard deviation of the parts; bound over scatter: how much wider than what shows. Bounds hold what all parts have in common, "
                f"{100 * SKIN[0]:g} and {100 * SKIN[1]:g} % of the lever for skin that goes along with its segment, which no scatter "
                "shows. The last two columns: parts that state a bound, known or not, and how far apart.")
    rows, groups = [], []
    for name in REPEATED:
        for length_s in PARTS_S:
            for word, warm in TEMPERATURES:
                mine = [e for e in estimates if e.name == name and e.length_s == length_s and e.warm == warm]
                rows += [repeat_row(f"{name}, {length_s:g} s, {word}", item, mine) for item in (*LEVERS, *AXES)]
                groups.append((f"{name}, {length_s:g} s, {word}", mine))
    report.table(["parts", "what", "unit", "parts", "known", "pairs", "agree", "apart, median", "largest", "bound", "scatter", "bound over scatter", "state a bound",
                  "apart, median"], rows)
    for word, items, limit, unit in (("levers", LEVERS, LEVERS_APART_MM, " mm"), ("axes", AXES, AXES_APART_DEG, " deg")):
        repeats = {item: [repeat_of(item, [e for e in mine if e.known[item]]) for _, mine in groups] for item in items}
        pairs = sum(r.pairs for item in items for r in repeats[item])
        if pairs == 0:
            continue
        report.require_share(f"{word}: pairs of parts within both bounds", sum(int(r.within.sum()) for item in items for r in repeats[item]), pairs, AGREE)
        for item in items:
            distances = np.concatenate([r.apart for r in repeats[item]])
            if len(distances):
                report.require_most(f"{ITEMS[item]}: pairs of parts apart, median", SCALES[item] * median(distances), limit, unit)


def report_sharpness(report: Report, estimates: list[Estimate]) -> None:
    """Bound over scatter of each recording: median of the lengths and filters with enough parts for a scatter."""
    for name in REPEATED:
        for item in (*LEVERS, *AXES):
            told = [[e for e in estimates if (e.name, e.length_s, e.warm) == (name, length_s, warm) and e.known[item]]
                    for length_s in PARTS_S for _, warm in TEMPERATURES]
            ratios = [repeat_of(item, mine).ratio for mine in told if len(mine) >= SCATTER_PARTS]
            if ratios:
                report.require_most(f"{name}, {ITEMS[item]}: bound over scatter, median where at least {SCATTER_PARTS} parts know it", median(ratios), SHARPEST,
                                    known=(3.9, COMMON) if (name, item) == ("human_knee_left", 2) else None)


def measure(settings: Settings, report: Report) -> None:
    legs, repeated = available(*LEGS), available(*REPEATED)
    if len(legs) < len(LEGS) or len(repeated) < len(REPEATED):
        raise Skipped("the recordings of people are not there; JOINTCAL_DATA names their folder")
    lengths = {**{f"{leg}:{kind}": (0.0, THIGH_PARTS_S) for leg in LEGS for kind in ("hip", "knee")}, **dict.fromkeys(REPEATED, PARTS_S)}
    jobs = [(name, length_s, begin, end, warm) for name, all_s in lengths.items() for length_s in all_s
            for begin, end in starts_of(name, length_s) for _, warm in TEMPERATURES]
    estimates = [e for e in run_jobs(measure_part, jobs, "people_levers", settings) if e]
    by = {(e.name, e.length_s, e.warm, e.begin_s): e for e in estimates}
    thighs = [thigh_of(hip, by[knee]) for key, hip in by.items() if key[0].endswith(":hip")
              and (knee := (key[0].replace(":hip", ":knee"), *key[1:])) in by and hip.is_there and by[knee].is_there]
    report_thighs(report, thighs, people.people_joint(f"{LEGS[0]}:hip").facts.get("thigh_length_m"))
    report_repeats(report, estimates)
    report_sharpness(report, estimates)
