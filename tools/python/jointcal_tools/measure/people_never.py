"""Wrong pairs, stiff pairs, faulty sensors and joints that are no hinge must never be ready: both models, and the functional one alone."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

import numpy as np

from .. import native_functional as functional
from .harness import Report, Settings, numbered, run_jobs
from .people_faults import FAULTS, PeopleCase, Ready, counts, here, people_case, wrongly_ready

TITLE = "Never ready: people"
LIMITS_DEG = (3.0, 10.0, 15.0)
FOR_FLEXION = "flexion"
FLEXION_AXES_DEG = 15.0  # of axes that are ready for flexion: so far off they cost 1.2 deg of a knee's angle
PURPOSES = (*(f"{limit:g} deg" for limit in LIMITS_DEG), FOR_FLEXION)
ENGINES = {"either": True, "functional": False}
QUICK_RUNS = 50
EVERY_TICKS = 10  # of those that are ready, for cases in which it depends on the axes
LISTED = 8  # of a class and engine
# Classes in which the functional model is ready for a reason that is known: the most of them, in parts of the runs, and the reason.
ONE_AXIS_MOVED = ("One axis alone had moved until then, or nearly, and was found; it stays ready for some seconds after the other axis begins to "
                  "move, then the status says more_axes or does_not_fit. rig_2D:35 is none of these: both axes moved")
GRAVITY_TURNED = ("Both accelerometers negated: gravity and the places of the sensors change sign with them, all equations hold, axes and angle are "
                  "right. all_negated:19 and, by the rigid model, all_negated:36 are none of these")
RATES_AGREE = ("Rates agree about one axis, and the accelerometers leave less of the centre's motion than what is held against rigid segments: 35 % of "
               "it, where it is fast enough to say anything")
KNOWN: dict[tuple[str, str], tuple[float, str]] = {
    ("functional", "rig_2D"): (0.07, ONE_AXIS_MOVED),
    ("functional", "all_negated"): (0.08, GRAVITY_TURNED),
    ("functional", "axis_negated"): (0.01, "axis_negated:91: the same component of both accelerometers negated; why nothing contradicts is not known"),
    ("either", "rig_2D"): (0.15, ONE_AXIS_MOVED),
    ("either", "all_negated"): (0.09, GRAVITY_TURNED),
    ("either", "axis_negated"): (0.05, RATES_AGREE),
    ("either", "axes_swapped"): (0.04, RATES_AGREE),
    ("either", "stiff_straps"): (0.02, "Straps that rock by 2 to 5 deg about one line beside motion so slow that this is bending of 8 deg rms and more"),
}


@dataclass
class Wrong:
    """A run that was wrongly ready: when first, for what, and what the functional model was judged by then."""

    engine: str
    purposes: list[str]
    t_s: float
    model: str  # of the two
    numbers: dict[str, float]


@dataclass
class Outcome:
    kind: str
    index: int
    source: str
    reason: str  # of both models at the end
    wrong: list[Wrong] = field(default_factory=list)

    def is_wrong(self, engine: str, purpose: str | None = None) -> bool:
        return any(w.engine == engine and (purpose is None or purpose in w.purposes) for w in self.wrong)


def judged_ticks(case: PeopleCase, ready: np.ndarray) -> np.ndarray:
    """Ticks of those that are ready at which a case is judged: one where `ready` itself is wrong, else some, first and last among them."""
    ticks = np.flatnonzero(ready)
    return ticks[:1] if case.wrong == "never" or not len(ticks) else np.unique(np.r_[ticks[::EVERY_TICKS], ticks[-1]])


def first_wrong(case: PeopleCase, track: functional.Track, ready: np.ndarray, limit_deg: float) -> int | None:
    """The first tick, of those that are judged, at which that was wrong."""
    for k in judged_ticks(case, ready):
        if wrongly_ready(case, Ready(float(case.rec.t_s[track.sample[k]]), limit_deg, track.axis1[k], track.axis2[k])):
            return int(k)
    return None


def numbers_at(track: functional.Track, k: int) -> dict[str, float]:
    inside = {name: float(values[k]) for name, values in track.inside.items()}
    speed2 = max(inside["speed2"], 1e-9)
    return {"bound": float(track.bounds_deg[k].max()), "flexion": float(track.flexion_bound_deg[k]), "motion_s": inside["motion_s"],
            "evidence": inside["evidence_turn"] + inside["evidence_rate"] + inside["evidence_lever"],
            "lever": inside["evidence_lever"], "share": inside["share"], "bend": float(np.degrees(inside["bend_rad"])),
            "stiffness": inside["stiffness"], "lack": inside["lack"] / speed2, "speed2": speed2,
            "opposite": inside["opposite"] / max(inside["lack"], 1e-9)}


def measure_case(job: tuple[str, int]) -> Outcome:
    kind, index = job
    case = people_case(kind, index)
    outcome = Outcome(kind, index, case.source, "")
    for engine, either in ENGINES.items():
        first, purposes, model, numbers = np.inf, [], "", {}
        for limit in LIMITS_DEG:
            track = functional.run(case.rec, max_bound_deg=limit, either=either)
            asked = {f"{limit:g} deg": (track.ready & track.for_axes, limit)}
            if limit == LIMITS_DEG[0]:
                asked[FOR_FLEXION] = (track.ready & track.for_flexion, FLEXION_AXES_DEG)
                outcome.reason = outcome.reason or ("ready" if track.ready[-1:].any() else functional.reason_name(track.reason[-1])
                                                    if len(track.reason) else "no_data")
            for purpose, (ready, most_deg) in asked.items():
                k = first_wrong(case, track, ready, most_deg)
                if k is not None:
                    purposes.append(purpose)
                    if track.t_s[k] < first:
                        first, numbers = float(track.t_s[k]), numbers_at(track, k)
                        model = "functional" if track.is_functional[k] or not either else "rigid"
        if purposes:
            outcome.wrong.append(Wrong(engine, purposes, first, model, numbers))
    return outcome


def report_offenders(report: Report, outcomes: list[Outcome], kinds: list[str]) -> None:
    """The first few of each class and engine, and what the functional model was judged by when they were wrong."""
    listed = []
    for kind in kinds:
        for engine in reversed(ENGINES):
            listed += [(o, w) for o in outcomes if o.kind == kind for w in o.wrong if w.engine == engine][:LISTED]
    report.text(f"The first {LISTED} of each class, and what the functional model was judged by then. Bound and flexion uncertainty, deg; "
                "evidence for the pairing, in all and of the centre's motion; lack: what is left of the centre's motion as a share of "
                "it; speed2: its size, (m/s)^2; opposite: what the other pairing leaves over what this one does.")
    keys = list(listed[0][1].numbers)
    report.table(["run", "asked", "model", "for", "at, s", *keys, "made from"],
                 [[f"{o.kind}:{o.index}", w.engine, w.model, ", ".join(w.purposes), f"{w.t_s:.1f}",
                   *(f"{w.numbers[key]:.3g}" if abs(w.numbers[key]) < 1e6 else "-" for key in keys), o.source] for o, w in listed])


def measure(settings: Settings, report: Report) -> None:
    total = sum(FAULTS[name].runs for name in here())
    jobs = numbered(counts(settings.count(total, QUICK_RUNS)), settings.only)
    outcomes = run_jobs(measure_case, jobs, "people_never", settings)
    report.text("Runs of 26 s, real where recordings are, else simulated; the classes, and what `ready` would be in each, are described in "
                "tools/python/jointcal_tools/measure/people_faults.py. Never: wrong whatever is stated. Beyond: wrong if an axis is farther off "
                "than the limit, the pairing is wrong, or the axis moves farther afterwards. One axis: the same as long as one of two axes alone "
                "moved, else wrong. Each run with limits of 3, 10 and 15 deg for the axes, by both models (either: what `jointcal hinge` "
                f"says) and by the functional one alone; flexion: ready for flexion (3 deg), wrong if the axes are then more than "
                f"{FLEXION_AXES_DEG:g} deg off. The counts are of runs that are wrongly ready at any time. `measure.py people_never "
                "--only CLASS:NUMBER` makes a run again.")
    kinds = list(dict.fromkeys(o.kind for o in outcomes))
    rows = []
    for kind in kinds:
        mine = [o for o in outcomes if o.kind == kind]
        reasons = Counter(o.reason for o in mine)
        rows.append([kind, FAULTS[kind].wrong, len(mine),
                     *(sum(o.is_wrong(engine, purpose) for o in mine) for engine in ENGINES for purpose in PURPOSES),
                     ", ".join(f"{name} {count}" for name, count in reasons.most_common(4))])
    rows.append(["all", "", len(outcomes), *(sum(o.is_wrong(engine, purpose) for o in outcomes) for engine in ENGINES for purpose in PURPOSES), ""])
    report.table(["class", "ready is", "runs", *(f"{engine}, {purpose}" for engine in ENGINES for purpose in PURPOSES),
                  "either, 3 deg, at the end"], rows)
    by = Counter((o.kind, w.engine, w.model) for o in outcomes for w in o.wrong)
    if by:
        report.text("Wrongly ready, by the model that said so first:")
        report.table(["class", "asked", "model", "runs"], [[*key, count] for key, count in sorted(by.items(), key=lambda item: kinds.index(item[0][0]))])
        report_offenders(report, outcomes, kinds)
    for kind in kinds:
        mine = [o for o in outcomes if o.kind == kind]
        for engine in ENGINES:
            most, why = KNOWN.get((engine, kind), (0.0, ""))
            wrong = sum(o.is_wrong(engine) for o in mine)
            if wrong:
                report.require(f"{engine}: {kind} wrongly ready", f"{wrong} of {len(mine)}", False, why if wrong <= max(most * len(mine), 1.0) else "")
    for engine in ENGINES:
        mine = [o for o in outcomes if (engine, o.kind) not in KNOWN]
        report.require_none(f"{engine}: wrongly ready, all classes without a known reason", sum(o.is_wrong(engine) for o in mine), len(mine))
