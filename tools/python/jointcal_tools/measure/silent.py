"""Silent failures: short windows of the rig recordings, each given to a fresh instance, beside qmt."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

import numpy as np

from .. import native
from . import qmt_reference
from .harness import Report, Settings, median, number, percent, quantile, run_jobs
from .judge import (INFORMATIVE_RAD_S, MAX_ERROR_DEG, cut, joint_rate_rms, judge, need_rig, nominal_axes,
                    recording)

TITLE = "Silent failures: short windows of the rig recordings"
LENGTHS_S = (3, 5, 10)
READY_SHARE = {3: 0.70, 5: 0.85, 10: 0.95}
WIDE = "bounds hold what a scale, a lag or a second motion could do to so few blocks: docs/METHOD.md, section 5"
KNOWN_SHARE = {3: (0.47, WIDE), 5: (0.75, WIDE)}
EIGHT, MANY = (f"{count} starts, lowest cost" for count in (qmt_reference.STARTS, qmt_reference.MANY))
QMT = {"qmt, one start": (None, 1), f"qmt, {EIGHT}": (None, qmt_reference.STARTS), f"qmt, {MANY}": (None, qmt_reference.MANY),
       "qmt, sample selection, one start": (qmt_reference.SELECTED, 1),
       f"qmt, sample selection, {EIGHT}": (qmt_reference.SELECTED, qmt_reference.STARTS)}  # settings and number of starts


@dataclass
class Outcome:
    """One method on one window."""

    method: str
    length_s: int
    place: str  # recording and number of the window
    informative: bool
    ready: bool  # at the end; qmt has no such word and always answers
    false_ready: bool  # at any time
    error_deg: float  # at the end, the larger of both; 180 minus it where the pairing is wrong
    first: tuple[float, float] = field(default=(np.nan, np.nan))  # error minus bound of each axis at first ready
    reason: str = "none"
    by_draw: tuple[bool, ...] = ()  # qmt with all starts: wrong from eight of them, by draw


def signed_error(error1: float, error2: float, wrong_sign: bool) -> float:
    worst = max(error1, error2)
    return 180.0 - worst if wrong_sign else worst


def run_engine(engine: str, rec, axes, length_s: int, place: str, informative: bool) -> Outcome:
    verdict = judge(native.run(rec, engine=engine), *axes)
    index = verdict.first_ready()
    first = (np.nan, np.nan) if index is None else tuple(verdict.errors_deg[index] - verdict.bounds_deg[index])
    error = signed_error(*verdict.errors_deg[-1], bool(verdict.wrong_sign[-1]))
    return Outcome(engine, length_s, place, informative, bool(verdict.ready[-1]), verdict.false_ready, error, first,
                   native.reason_name(verdict.reason))


def run_qmt(method: str, rec, axes, length_s: int, place: str, informative: bool) -> Outcome:
    settings, count = QMT[method]

    def off(one: tuple) -> float:
        return signed_error(*qmt_reference.errors(one, *axes))

    found = qmt_reference.run_starts(rec, settings, count)
    error, by_draw = off(qmt_reference.cheapest(found)), ()
    if count == qmt_reference.MANY:
        by_draw = tuple(off(qmt_reference.cheapest([found[k] for k in draw])) > MAX_ERROR_DEG for draw in qmt_reference.draws())
    return Outcome(method, length_s, place, informative, True, error > MAX_ERROR_DEG, error, by_draw=by_draw)


def measure_window(job: tuple) -> list[Outcome]:
    name, length_s, index, methods = job
    rec, axes = recording(name), nominal_axes(name)
    count = round(length_s * rec.rate_hz)
    part = cut(rec, index * count, (index + 1) * count)
    informative = joint_rate_rms(part, *axes) > INFORMATIVE_RAD_S
    place = f"{name}, window {index} of {length_s} s"
    return [(run_qmt if method in QMT else run_engine)(method, part, axes, length_s, place, informative)
            for method in methods]


def make_jobs(settings: Settings, methods: list[str]) -> list[tuple]:
    jobs = []
    for name in need_rig():
        for length_s in LENGTHS_S:
            windows = int(len(recording(name)) // round(length_s * recording(name).rate_hz))
            jobs += [(name, length_s, index, methods) for index in range(windows)]
    return jobs[:: 3] if settings.quick else jobs


def summary_row(length_s: int, method: str, mine: list[Outcome]) -> list[str]:
    informative = [o for o in mine if o.informative]
    claimed = [o.error_deg for o in mine if o.ready]
    errors = [o.error_deg for o in informative]
    is_qmt = method in QMT
    return [f"{length_s} s", method, len(mine), len(informative),
            "-" if is_qmt else percent(sum(o.ready for o in informative), len(informative)),
            sum(o.false_ready for o in mine) if not is_qmt else "-",
            percent(sum(e > MAX_ERROR_DEG for e in claimed), len(claimed)),
            number(median(errors)), number(quantile(errors, 0.9)),
            percent(sum(e > MAX_ERROR_DEG for e in errors), len(errors))]


def measure(settings: Settings, report: Report) -> None:
    version = qmt_reference.qmt_version() if settings.with_qmt else None
    methods = [*settings.engines, *(QMT if version else ())]
    jobs = make_jobs(settings, methods)
    outcomes = [outcome for found in run_jobs(measure_window, jobs, "silent", settings) for outcome in found]
    report.text(f"Consecutive windows of rig_1D_01, 02 and 04{' (every third)' if settings.quick else ''}. Informative: "
                f"rms joint rate above {INFORMATIVE_RAD_S} rad/s. False ready: at any time `ready` with an error above "
                f"{MAX_ERROR_DEG:g} deg or the wrong pairing. Silently wrong: share of the answers not marked as doubtful "
                "at the end (ready; qmt marks none) that are off by more. Errors are those of the worse axis at the end, "
                "over all informative windows, ready or not.")
    if version:
        options = ", ".join(f"{name}={value}" for name, value in qmt_reference.SELECTED.items())
        report.text(f"qmt {version}: `jointAxisEstHingeOlsson` with its default settings, and with {options}. One start: as the code "
                    f"is, from axes along x and with both signs of axis 2. {qmt_reference.STARTS} and {qmt_reference.MANY} starts: that "
                    "one and others drawn from the sphere, the same for all windows; of what they find, what costs least.")
    elif settings.with_qmt:
        report.text(qmt_reference.INSTALL_HINT)
    groups = {(length_s, method): [o for o in outcomes if o.length_s == length_s and o.method == method]
              for length_s in LENGTHS_S for method in methods}
    report.table(["length", "method", "windows", "informative", "informative that end ready", "false ready",
                  "silently wrong", "median error, deg", "90 %, deg", f"above {MAX_ERROR_DEG:g} deg"],
                 [summary_row(*key, mine) for key, mine in groups.items()])
    describe_draws(report, groups)
    describe_not_ready(settings, report, groups)
    for (length_s, method), mine in groups.items():
        if method in QMT:
            continue
        report.require_none(f"{method}, {length_s} s: false ready", sum(o.false_ready for o in mine), len(mine))
        if method == "stream":
            informative = [o.ready for o in mine if o.informative]
            report.require_share(f"{method}, {length_s} s: informative windows that end ready", sum(informative),
                                 len(informative), READY_SHARE[length_s], KNOWN_SHARE.get(length_s))


def describe_draws(report: Report, groups: dict) -> None:
    """How much eight starts depend on which eight."""
    parts = []
    for (length_s, method), mine in groups.items():
        if not mine or not mine[0].by_draw:
            continue
        counts = np.array([o.by_draw for o in mine]).sum(axis=0)
        resting = sum(o.error_deg > MAX_ERROR_DEG and not o.informative for o in mine)
        parts.append(f"{length_s} s: {percent(median(counts), len(mine))} in the median, {percent(counts.min(), len(mine))} to "
                     f"{percent(counts.max(), len(mine))}; from all {qmt_reference.MANY}, resting windows: {resting} of "
                     f"{sum(o.error_deg > MAX_ERROR_DEG for o in mine)} wrong ones")
    if parts:
        report.text(f"Which {qmt_reference.STARTS} starts matters: silently wrong over {len(qmt_reference.draws())} draws out of the "
                    f"{qmt_reference.MANY}. {'. '.join(parts)}.")


def describe_not_ready(settings: Settings, report: Report, groups: dict) -> None:
    """Coverage at first ready, why informative windows end without ready, and which were false."""
    rows = []
    for (length_s, method), mine in groups.items():
        if method in QMT:
            continue
        slack = np.array([o.first for o in mine if np.isfinite(o.first[0])]).reshape(-1, 2)
        reasons = Counter(o.reason for o in mine if o.informative and not o.ready)
        rows.append([f"{length_s} s", method, *(percent(np.sum(slack[:, k] <= 0.0), len(slack)) for k in (0, 1)),
                     ", ".join(f"{name} {count}" for name, count in reasons.most_common()) or "-"])
    report.text("Share of first `ready` at which the nominal axis lies inside the bound (the sockets add about 1 deg that "
                "no bound can know), and why informative windows end without `ready`.")
    report.table(["length", "engine", "inside bound 1", "inside bound 2", "reasons"], rows)
    false = [o for mine in groups.values() for o in mine if o.false_ready and o.method not in QMT]
    if false:
        report.text("False ready: " + "; ".join(f"{o.method}, {o.place}" for o in false[:30]))
