"""The methods of LAI22 as they are, in float64, on windows of the rig: what the kind of low-pass does, and how often they are wrong."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import lai22
from ..lai22_signals import prepare
from .harness import Report, Settings, median, number, percent, quantile, run_jobs
from .judge import line_angle_deg
from .two_dof import INFORMATIVE_RAD_S, LENGTHS_S, RIG, Rig, is_informative, need_rig, rig

TITLE = "LAI22 as it is: kinds of low-pass, windows of the rig"
VQF = "all of it"  # what of it needs VQF
FILTERS = {"zero phase": ("zero-phase", True), "causal, orientations delayed alike": ("causal", True),
           "causal, orientations as they come": ("causal", False), "none": ("none", True)}
FORMS = ("rotation", "orientation-variance")  # (7); (9) with sin(beta0) eliminated
WRONG_DEG = 10.0


@dataclass
class Outcome:
    form: str
    filtered: str
    length_s: int  # 0: the whole recording
    informative: bool
    errors: tuple[float, float]  # deg


def solve_part(whole: Rig, part: slice, length_s: int) -> list[Outcome]:
    cut = Rig(whole.t_s[part], whole.q1[part], whole.q2[part], whole.heading_deg[part], whole.axes)
    informative, outcomes = is_informative(cut), []
    for filtered, (kind, matched) in FILTERS.items():
        prepared = prepare(cut.q1.astype(float), cut.q2.astype(float), cut.t_s, kind, matched=matched)
        samples = prepared.samples.take(prepared.select())
        for form in FORMS:
            pose = lai22.solve(samples, form).pose
            errors = tuple(float(line_angle_deg(j[None], axis)[0]) for j, axis in zip((pose.j1, pose.j2), cut.axes, strict=True))
            outcomes.append(Outcome(form, filtered, length_s, informative, errors))
    return outcomes


def measure_job(job: tuple[str, int, int]) -> list[Outcome]:
    name, length_s, index = job
    whole = rig(name)
    begin = index * length_s
    part = slice(*np.searchsorted(whole.t_s, [begin, begin + length_s])) if length_s else slice(0, len(whole.t_s))
    return solve_part(whole, part, length_s)


def row_of(form: str, filtered: str, length_s: int, mine: list[Outcome]) -> list:
    def wrong(of: list[Outcome]) -> str:
        return percent(sum(max(o.errors) > WRONG_DEG for o in of), len(of))

    informative = [o for o in mine if o.informative]
    columns = [[o.errors[k] for o in informative] for k in (0, 1)]
    return [f"{length_s} s" if length_s else "whole", form, filtered, len(mine), len(informative), wrong(informative), wrong(mine),
            *(number(value) for errors in columns for value in (median(errors), quantile(errors, 0.9)))]


def measure(settings: Settings, report: Report) -> None:
    names = need_rig()
    names = names[:1] if settings.quick else names
    jobs = [(name, 0, 0) for name in names]
    jobs += [(name, length_s, index) for name in names for length_s in LENGTHS_S for index in range(int(rig(name).t_s[-1] // length_s))]
    jobs = jobs[::5] if settings.quick else jobs
    outcomes = [o for found in run_jobs(measure_job, jobs, "lai22", settings) for o in found]
    report.text("Global minimum over many starts, 20 samples a second, orientations by VQF, rates by (A41) and (A42) with atan2, low-pass of "
                f"5 Hz. Wrong: an axis more than {WRONG_DEG:g} deg from the nominal one. Informative: both joint rates and that of sensor 1 "
                f"above {INFORMATIVE_RAD_S:g} rad/s rms, as for the library's own engines in two_dof.md; of the others, mostly at rest, nobody "
                "could tell the axes, so what counts is the share of the informative ones. Errors of both axes over the "
                "informative windows: median and 90 %, deg. None of these methods says how sure it is.")
    rows = [row_of(form, filtered, length_s, mine) for length_s in (0, *LENGTHS_S) for form in FORMS for filtered in FILTERS
            if (mine := [o for o in outcomes if (o.form, o.filtered, o.length_s) == (form, filtered, length_s)])]
    report.table(["length", "constraint", "low-pass", "windows", "informative", "wrong, informative", "wrong", "j1", "90 %", "j2", "90 %"], rows)
