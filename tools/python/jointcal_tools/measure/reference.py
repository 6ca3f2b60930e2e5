"""The stream engine beside float64: what direction tells beyond length, and what the engine makes of it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from .. import common_rate, native
from ..recordings import Recording
from ..simulate import HingeSpec, simulate_hinge
from .bounds import LISTED, RATES_HZ, Disturbance
from .harness import Report, Settings, median, number, numbered, quantile, run_jobs
from .judge import (INFORMATIVE_RAD_S, MAX_ERROR_DEG, RIG_HINGES, available, cut, joint_rate_rms, judge, line_angle_deg,
                    nominal_axes, recording)
from .silent import signed_error

TITLE = "The stream engine beside float64"
LENGTHS = "lengths"
BLOCKS_S = {"vectors, 0.25 s": 0.25, "vectors, 0.5 s": 0.5, "vectors, 1 s": 1.0}
VECTORS = "vectors, 0.5 s"
ENGINE = "stream engine"
REFERENCES = (LENGTHS, *BLOCKS_S)
REFERENCES_SIMULATED = (LENGTHS, VECTORS)
LENGTHS_S = (3, 5, 10)
COLUMNS = ("90 %", "largest", "from vectors: median", "90 %", "largest")
WHOLE_DEG = 0.1  # engine and reference on whole rig recordings
WINDOW_S, WINDOW_DEG = 10, 0.3  # median over windows of this length

MOTIONS = ("5", "6", "12", "14", "daily")
DURATION_S = 15.0
RUNS = 800  # as many of each motion in each class
CLASSES = {
    "clean": Disturbance(),
    "noise": Disturbance(noise=(5.0, 5.0)),
    "bias": Disturbance(acc_bias=(1.0, 1.0), gyr_bias_deg_s=(1.0, 1.0)),
    "soft": Disturbance(soft_tissue_deg=(0.0, 1.5)),
}

Axes = tuple[np.ndarray, np.ndarray]


@dataclass
class Outcome:
    """All methods on one piece of data: angles of the worse axis, deg; 180 minus it where the pairing is wrong."""

    source: str  # recording or class
    index: int  # of the window or run
    length_s: float  # 0: the whole recording
    motion: str
    from_truth: dict[str, float]  # windows: from the whole recording's axes; whole recordings: from the nominal ones
    from_vectors: dict[str, float]  # from VECTORS on the same data
    end: str  # what the engine says at the end: "ready" or why not
    false_ready: bool  # the engine at any time

    @property
    def remarkable(self) -> bool:
        return self.false_ready or self.from_truth[ENGINE] > MAX_ERROR_DEG


def angle_deg(axes: Axes, truth: Axes) -> float:
    errors = [float(line_angle_deg(a[None], b / np.linalg.norm(b))[0]) for a, b in zip(axes, truth, strict=True)]
    return signed_error(*errors, bool((axes[0] @ truth[0]) * (axes[1] @ truth[1]) < 0.0))


def solve(method: str, rec: Recording, start: Axes) -> Axes:
    """The axes by one of the references."""
    data = (rec.t_s, rec.gyr1, rec.acc1, rec.gyr2, rec.acc2, start)
    found = (common_rate.solve_lengths(*data) if method == LENGTHS
             else common_rate.solve_vectors(*data, block_s=BLOCKS_S[method]))
    return found.j1, found.j2


def compare(methods: Iterable[str], rec: Recording, start: Axes, truth: Axes, **names: str | float) -> Outcome:
    """The references from `start`, the engine from nothing."""
    found = {method: solve(method, rec, start) for method in methods}
    track = native.run(rec)
    found[ENGINE] = track.axis1[-1], track.axis2[-1]
    verdict = judge(track, *truth)
    return Outcome(from_truth={method: angle_deg(axes, truth) for method, axes in found.items()},
                   from_vectors={method: angle_deg(axes, found[VECTORS]) for method, axes in found.items()},
                   end="ready" if verdict.ready[-1] else native.reason_name(verdict.reason),
                   false_ready=verdict.false_ready, **names)


def make_spec(kind: str, index: int) -> HingeSpec:
    rng = np.random.default_rng([list(CLASSES).index(kind), index, 3539])
    return HingeSpec(motions=((MOTIONS[index % len(MOTIONS)], DURATION_S),),
                     rate_hz=RATES_HZ[rng.integers(len(RATES_HZ))], seed=int(rng.integers(2**31)),
                     speed=float(rng.uniform(0.7, 2.5)), **CLASSES[kind].draw(rng))


def measure_simulated(job: tuple[str, int]) -> Outcome:
    spec = make_spec(*job)
    rec = simulate_hinge(spec)
    truth = (rec.axis1, rec.axis2)
    return compare(REFERENCES_SIMULATED, rec, truth, truth, source=job[0], index=job[1], length_s=DURATION_S,
                   motion=spec.motions[0][0])


def measure_rig(job: tuple[str, bool]) -> list[Outcome]:
    """One recording as a whole, then its informative windows."""
    name, quick = job
    rec, nominal = recording(name), nominal_axes(name)
    outcomes = [compare(REFERENCES, rec, nominal, nominal, source=name, index=0, length_s=0.0, motion="")]
    whole = solve(VECTORS, rec, nominal)
    for length_s in LENGTHS_S:
        count = round(length_s * rec.rate_hz)
        for index in range(0, len(rec) // count, 3 if quick else 1):
            part = cut(rec, index * count, (index + 1) * count)
            if joint_rate_rms(part, *nominal) > INFORMATIVE_RAD_S:
                outcomes.append(compare(REFERENCES, part, whole, whole, source=name, index=index, length_s=length_s,
                                        motion=""))
    return outcomes


def cells(method: str, mine: list[Outcome]) -> list[str]:
    """Median, 90 %, largest of both angles."""
    truth = [o.from_truth[method] for o in mine]
    vectors = [o.from_vectors[method] for o in mine] if method != VECTORS else []
    return [number(value) for angles in (truth, vectors)
            for value in (median(angles), quantile(angles, 0.9), quantile(angles, 1.0))]


def list_remarkable(report: Report, outcomes: list[Outcome]) -> None:
    mine = [o for o in outcomes if o.remarkable]
    if mine:
        report.text(f"Where the {ENGINE} ends more than {MAX_ERROR_DEG:g} deg off, or was `ready` at any time with more "
                    "than that or the wrong pairing (false ready):")
        report.table(["data", "number", "s", "motion", f"{ENGINE}, end", VECTORS, "at the end", "false ready"],
                     [[o.source, o.index, f"{o.length_s:g}", o.motion or "-", number(o.from_truth[ENGINE]),
                       number(o.from_truth[VECTORS]), o.end, "yes" if o.false_ready else "-"] for o in mine[:LISTED]])


def describe_rig(settings: Settings, report: Report, outcomes: list[Outcome]) -> None:
    wholes = [o for o in outcomes if not o.length_s]
    methods = (*REFERENCES, ENGINE)
    report.text(f"Whole rig recordings: from {VECTORS}, and in brackets from the nominal axes, which are good to about "
                "1 deg.")
    report.table(["recording", *methods], [[o.source, *(f"{number(o.from_vectors[m], 3)} ({number(o.from_truth[m])})"
                                                        for m in methods)] for o in wholes])
    every = " (every third)" if settings.quick else ""
    report.text(f"Consecutive windows of rig_1D_01, 02 and 04{every} with an rms joint rate above {INFORMATIVE_RAD_S} "
                f"rad/s, each given to a fresh instance. From whole: from the axes by {VECTORS} on the whole recording, "
                f"where the references start. From vectors: from {VECTORS} on the same window.")
    windows = {length_s: [o for o in outcomes if o.length_s == length_s] for length_s in LENGTHS_S}
    report.table(["length", "method", "windows", "from whole: median", *COLUMNS],
                 [[f"{length_s} s", method, len(mine), *cells(method, mine)]
                  for length_s, mine in windows.items() for method in methods])
    list_remarkable(report, [o for o in outcomes if o.length_s])
    for o in wholes:
        report.require_most(f"{o.source}: {ENGINE} from {VECTORS}", o.from_vectors[ENGINE], WHOLE_DEG, " deg")
    report.require_most(f"rig, {WINDOW_S} s windows: median of {ENGINE} from {VECTORS}",
                        median([o.from_vectors[ENGINE] for o in windows[WINDOW_S]]), WINDOW_DEG, " deg")


def describe_simulated(report: Report, outcomes: list[Outcome]) -> None:
    rates = ", ".join(f"{rate:g}" for rate in RATES_HZ)
    report.text(f"{len(outcomes)} simulated runs of {DURATION_S:g} s: motions {', '.join(MOTIONS)} of OLS20 in turn, "
                f"random mounting, lever arms, rate ({rates} Hz) and speed (0.7 to 2.5 rad/s rms). Classes: clean (the "
                "paper's noise), noise (5 times it), bias (1 m/s^2 and 1 deg/s), soft (soft tissue up to 1.5 deg rms). "
                "Seeds: class and number. Errors against the truth, where the references start.")
    for title, key in (("class", lambda o: o.source), ("motion", lambda o: o.motion)):
        groups = {value: [o for o in outcomes if key(o) == value] for value in dict.fromkeys(map(key, outcomes))}
        report.table([title, "method", "runs", "error: median", *COLUMNS],
                     [[value, method, len(mine), *cells(method, mine)]
                      for value, mine in groups.items() for method in (*REFERENCES_SIMULATED, ENGINE)])
    list_remarkable(report, outcomes)
    report.require_none("simulated: false ready", sum(o.false_ready for o in outcomes), len(outcomes))


def measure(settings: Settings, report: Report) -> None:
    names = available(*RIG_HINGES)
    per_class = -(-settings.count(RUNS, 40) // len(CLASSES))
    rig = [o for found in run_jobs(measure_rig, [(name, settings.quick) for name in names], "reference, rig", settings)
           for o in found]
    simulated = run_jobs(measure_simulated, numbered(dict.fromkeys(CLASSES, per_class), None), "reference, simulated",
                         settings)
    report.text("Float64 numpy (tools/python/jointcal_tools/common_rate.py) beside the stream engine. Lengths: METHOD "
                "section 2. Vectors: section 4, with blocks of the given length. Both with the accelerometer part and "
                "bias states, over all samples at once, to the minimum nearest to a start that is right. Stream engine: "
                "its estimate at the end, from nothing, whatever its status. Angles are those of the worse axis, deg; "
                "180 minus it where the pairing is wrong.")
    if names:
        describe_rig(settings, report, rig)
    else:
        report.text("The rig recordings are not there; JOINTCAL_DATA names their folder.")
    describe_simulated(report, simulated)
