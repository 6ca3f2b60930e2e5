"""The lag of two sensors: recordings and simulated joints whose second sensor is told a known lag, and pairs that share no joint."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .. import native_pairing
from ..native_pairing import Stream
from ..recordings import Recording
from ..simulate import HingeSpec, simulate_hinge
from ..simulate_people import PersonSpec, simulate_person
from .harness import Report, Settings, number, percent, quantile, run_jobs
from .judge import available, recording

TITLE = "Lag of two sensors"
RIG = ("rig_1D_01", "rig_1D_02", "rig_1D_04", "rig_2D_01", "rig_2D_02", "rig_2D_05", "rig_3D_01", "rig_3D_02", "rig_3D_04")
PEOPLE = ("knee_drop", "people_ankle_long_L", "people_ankle_orthosis", "people_elbow_B_JA_Fast", "people_elbow_D_ROM",
          "people_elbow_E_ROM", "people_knee_long_L1", "people_knee_long_R1", "human_elbow_right", "human_knee_left")
SIMULATED = tuple((joint, activity) for joint in ("knee", "ankle", "elbow") for activity in ("walk", "squat", "random")) + (("hinge", "7"),)
CHOSEN_ON = (*RIG, *PEOPLE)[::2]  # the recordings on which the limits of lib/pairing/lag.c were chosen
LENGTHS_S = (20.0, 40.0)
LAG_MAX_S = 0.25
APART_S = 40.0  # of unrelated pairs
STARTS, SIMULATIONS, UNRELATED = 40, 40, 4000
TARGET_MS, OVER_MAX = 3.0, 0.05
MOTION_S = 20.0  # in which a lag should become known
SIMULATED_SEED = 100  # limits were chosen on seeds below


@dataclass
class Outcome:
    kind: str
    name: str
    length_s: float
    lag_s: float
    known: bool  # at the end
    ever: bool
    found_s: float
    bound_s: float
    first_s: float  # when it was first known
    first_over: bool  # and beyond its bound then
    first_motion_s: float  # motion until then
    motion_s: float

    @property
    def error_ms(self) -> float:
        return 1e3 * abs(self.found_s - self.lag_s)

    @property
    def is_over(self) -> bool:
        return abs(self.found_s - self.lag_s) > self.bound_s


def stream(rec: Recording, sensor: int, begin_s: float, length_s: float, lag_s: float = 0.0) -> Stream:
    """A part of a recording from 0 s on; readings with numbers that are missing are lost."""
    values = np.hstack([rec.gyr1, rec.acc1] if sensor == 1 else [rec.gyr2, rec.acc2])
    t_s = rec.t_s - rec.t_s[0] - begin_s
    kept = (t_s >= 0.0) & (t_s < length_s) & np.isfinite(values).all(axis=1)
    return Stream(t_s[kept] + lag_s, values[kept])


def outcome(kind: str, name: str, lag_s: float, one: Stream, two: Stream, length_s: float) -> Outcome:
    found = native_pairing.run(one, two)
    if not len(found.t_s):
        return Outcome(kind, name, length_s, lag_s, False, False, 0.0, 1.0, np.inf, False, np.inf, 0.0)
    motion_s = np.cumsum(np.maximum(np.diff(found.motion_s, prepend=0.0), 0.0))  # sums begin anew where a lag is taken off
    first_s, first_over, first_motion_s = np.inf, False, np.inf
    if found.known.any():
        first = int(np.argmax(found.known))
        first_s, first_motion_s = float(found.t_s[first]), float(motion_s[first])
        first_over = bool(abs(found.lag_s[first] - lag_s) > found.bound_s[first])
    return Outcome(kind, name, length_s, lag_s, bool(found.known[-1]), bool(found.known.any()), float(found.lag_s[-1]), float(found.bound_s[-1]),
                   first_s, first_over, first_motion_s, float(motion_s[-1]))


def span_s(name: str) -> float:
    t_s = recording(name).t_s
    return float(t_s[-1] - t_s[0])


def measure_start(job: tuple[str, float, int, int]) -> Outcome:
    name, length_s, number_of, count = job
    rec, rng = recording(name), np.random.default_rng([1, number_of, round(length_s)])
    begin_s = (span_s(name) - length_s) * number_of / max(count - 1, 1)
    lag_s = float(rng.uniform(-LAG_MAX_S, LAG_MAX_S))
    return outcome("rig" if name in RIG else "people", name, lag_s, stream(rec, 1, begin_s, length_s),
                   stream(rec, 2, begin_s, length_s, lag_s), length_s)


def simulated(joint: str, activity: str, seed: int, length_s: float) -> Recording:
    if joint == "hinge":
        return simulate_hinge(HingeSpec(((activity, length_s),), seed=seed, gyr_bias_deg_s=0.3, acc_bias=0.1))
    return simulate_person(PersonSpec(((activity, length_s),), joint, seed=seed))


def measure_simulated(job: tuple[str, str, float, int]) -> Outcome:
    joint, activity, length_s, seed = job
    rec, rng = simulated(joint, activity, seed, length_s), np.random.default_rng([2, seed])
    lag_s = float(rng.uniform(-LAG_MAX_S, LAG_MAX_S))
    return outcome("simulated", f"{joint} {activity}", lag_s, stream(rec, 1, 0.0, length_s), stream(rec, 2, 0.0, length_s, lag_s), length_s)


def measure_unrelated(job: tuple[tuple[str, ...], int]) -> Outcome:
    """Any sensor of one recording beside any of another one."""
    names, index = job
    rng = np.random.default_rng([3, index])
    streams = [stream(recording(name), int(rng.integers(1, 3)), float(rng.uniform(0.0, span_s(name) - APART_S)), APART_S)
               for name in rng.choice(names, 2, replace=False)]
    return outcome("unrelated", " and ".join(names), 0.0, *streams, APART_S)


def within_motion(outcomes: list[Outcome]) -> tuple[int, int]:
    """(known within so much motion, those that moved so much or knew it before)."""
    done = sum(o.first_motion_s <= MOTION_S for o in outcomes)
    return done, done + sum(o.first_motion_s > MOTION_S and o.motion_s >= MOTION_S for o in outcomes)


def row_of(label: str, length_s: float, mine: list[Outcome]) -> list:
    known, ever, moved = [o for o in mine if o.known], [o for o in mine if o.ever], [o for o in mine if o.motion_s >= 10.0]
    errors = [o.error_ms for o in known]
    return [label, f"{length_s:g}", len(mine), percent(len(known), len(mine)), percent(sum(o.known for o in moved), len(moved)),
            percent(*within_motion(mine)) if length_s > MOTION_S else "-", *(number(quantile(errors, share), 1) for share in (0.5, 0.9)), number(max(errors, default=np.nan), 1),
            number(quantile([1e3 * o.bound_s for o in known], 0.5), 1), percent(sum(o.is_over for o in known), len(known)),
            percent(sum(o.first_over for o in ever), len(ever)), number(quantile([o.first_s for o in mine], 0.5), 0)]


def rows_of(outcomes: list[Outcome]) -> list[list]:
    kinds = [kind for kind in ("rig", "people", "simulated") if any(o.kind == kind for o in outcomes)]
    return [row_of(kind, length_s, [o for o in outcomes if (o.kind, o.length_s) == (kind, length_s)]) for kind in kinds for length_s in LENGTHS_S]


HEAD = ["data", "length, s", "starts", "known at the end", "of those that moved", f"in {MOTION_S:g} s of motion", "error, median, ms", "90 %",
        "largest", "bound, median, ms", "over", "over at first", "first known, median, s"]


def measure(settings: Settings, report: Report) -> None:
    starts, seeds = settings.count(STARTS, 3), settings.count(SIMULATIONS, 1)
    jobs = [(name, length_s, k, starts) for name in available(*RIG, *PEOPLE) for length_s in LENGTHS_S if span_s(name) > length_s
            for k in range(starts)]
    outcomes = run_jobs(measure_start, jobs, "recordings", settings)
    outcomes += run_jobs(measure_simulated, [(*what, length_s, seed) for what in SIMULATED for length_s in LENGTHS_S
                                               for seed in range(SIMULATED_SEED, SIMULATED_SEED + seeds)],
                         "simulated", settings)
    report.text("Both sensors of a recording are in step; the times of sensor 2 are made wrong by -250 to 250 ms, another number at each start. "
                "Pairs at 100 Hz, one slice of work for each, filters cold. Moved: at least 10 s of motion in all. In motion: of those that moved for so "
                "long, or knew the lag before. Error: what the recording's own sensors are out of step by is in it. Over: beyond the 95 % bound; at "
                "first: when the lag was first known.")
    report.table(HEAD, rows_of(outcomes))
    report.text("The recordings that the limits were not chosen on: " + ", ".join(n for n in (*RIG, *PEOPLE) if n not in CHOSEN_ON) + ".")
    report.table(["data of these", *HEAD[1:]], rows_of([o for o in outcomes if o.kind != "simulated" and o.name not in CHOSEN_ON]))
    long_names = tuple(name for name in available(*RIG, *PEOPLE) if span_s(name) > APART_S)
    if len(long_names) > 1:
        apart = run_jobs(measure_unrelated, [(long_names, k) for k in range(settings.count(UNRELATED, 100))], "unrelated", settings)
        report.text(f"Unrelated: any sensor of one recording beside any of another one, {APART_S:g} s.")
        report.require_none("unrelated pairs whose lag was ever known", sum(o.ever for o in apart), len(apart))
    known = [o for o in outcomes if o.known]
    report.require_most("median error of all that are known", quantile([o.error_ms for o in known], 0.5), TARGET_MS, " ms")
    ever = [o for o in outcomes if o.ever]
    report.require_most("share beyond the bound when first known", sum(o.first_over for o in ever) / max(len(ever), 1), OVER_MAX)
    report.require_most("share beyond the bound", sum(o.is_over for o in known) / max(len(known), 1), OVER_MAX)
