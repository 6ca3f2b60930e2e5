"""What fewer slices of work per second cost: windows that end ready, time to ready, false ready."""

from __future__ import annotations

from dataclasses import dataclass

from .. import native
from ..simulate import HingeSpec, simulate_hinge
from .harness import Report, Settings, number, percent, quantile, run_jobs
from .judge import INFORMATIVE_RAD_S, available, cut, joint_rate_rms, judge, need_rig, nominal_axes, recording
from .silent import LENGTHS_S
from .time_to_ready import STREAM_S, informative_starts

TITLE = "Slices of work per second"
SLICES_PER_S = (200, 100, 50, 25)
FEWER = ("With half of the work, ready is entered for some tenths of a second before the axes are found: rig_1D_04 from sample 3700, "
         "3.5 deg")
MOTIONS = ("5", "6", "7", "12", "13", "14", "daily")


@dataclass
class Outcome:
    kind: str  # "3 s", ... for windows, else where the starts are from
    slices: int
    counts: bool  # windows: informative
    ready: bool  # at the end
    first_s: float
    false_ready: bool


def run_each(kind: str, rec, axes, counts: bool) -> list[Outcome]:
    verdicts = [(slices, judge(native.run(rec, slices_per_s=float(slices)), *axes)) for slices in SLICES_PER_S]
    return [Outcome(kind, slices, counts, bool(verdict.ready[-1]), verdict.first_ready_s(), verdict.false_ready)
            for slices, verdict in verdicts]


def measure_window(job: tuple[str, int, int]) -> list[Outcome]:
    name, length_s, index = job
    rec, axes = recording(name), nominal_axes(name)
    count = round(length_s * rec.rate_hz)
    part = cut(rec, index * count, (index + 1) * count)
    return run_each(f"{length_s} s", part, axes, joint_rate_rms(part, *axes) > INFORMATIVE_RAD_S)


def measure_start(job: tuple[str, int]) -> list[Outcome]:
    name, start = job
    rec = recording(name)
    return run_each("rig", cut(rec, start, start + round(STREAM_S * rec.rate_hz)), nominal_axes(name), True)


def measure_simulated(job: tuple[str, int]) -> list[Outcome]:
    """100 Hz, biases and the paper's noise."""
    motion, index = job
    rec = simulate_hinge(HingeSpec(motions=((motion, STREAM_S),), rate_hz=100.0, seed=1000 * MOTIONS.index(motion) + index,
                                   speed=1.5, gyr_bias_deg_s=0.3, acc_bias=0.1))
    return run_each("simulated", rec, (rec.axis1, rec.axis2), True)


def row_of(slices: int, outcomes: list[Outcome]) -> list:
    mine = [o for o in outcomes if o.slices == slices]
    cells: list = [slices]
    for length_s in LENGTHS_S:
        windows = [o.ready for o in mine if o.kind == f"{length_s} s" and o.counts]
        cells.append(percent(sum(windows), len(windows)))
    for kind in ("rig", "simulated"):
        times = [o.first_s for o in mine if o.kind == kind]
        cells += [number(quantile(times, share)) for share in (0.5, 0.9)]
    return [*cells, sum(o.false_ready for o in mine), len(mine)]


def measure(settings: Settings, report: Report) -> None:
    names = need_rig()
    thin = 5 if settings.quick else 1
    windows = [(name, length_s, index) for name in names for length_s in LENGTHS_S
               for index in range(int(len(recording(name)) // round(length_s * recording(name).rate_hz)))][::thin]
    starts = [(name, start) for name in available(*names)
              for start in informative_starts(recording(name), nominal_axes(name), 1.0)][::thin]
    simulated = [(motion, k) for motion in MOTIONS for k in range(settings.count(60, 2))]
    found = [*run_jobs(measure_window, windows, "slices, windows", settings),
             *run_jobs(measure_start, starts, "slices, starts", settings),
             *run_jobs(measure_simulated, simulated, "slices, simulated", settings)]
    outcomes = [outcome for some in found for outcome in some]
    report.text("Stream engine, `slices_per_s` of its config. Consecutive windows of rig_1D_01, 02 and 04 (50 Hz): share of the "
                f"informative ones (rms joint rate above {INFORMATIVE_RAD_S} rad/s) that end ready. Time to ready from informative "
                f"starts on the rig recordings, and from the beginning of {len(simulated)} simulated motions at 100 Hz with biases; "
                f"what is not ready within {STREAM_S:g} s counts as never. False ready: at any time `ready` with an error above "
                "3 deg or the wrong pairing, in all of these runs.")
    report.table(["slices per second", *(f"{length} s" for length in LENGTHS_S), "rig, median, s", "90 %, s",
                  "simulated, median, s", "90 %, s", "false ready", "of runs"],
                 [row_of(slices, outcomes) for slices in SLICES_PER_S])
    for slices in SLICES_PER_S:
        mine = [o for o in outcomes if o.slices == slices]
        false = sum(o.false_ready for o in mine)
        report.require(f"{slices} slices: false ready: none", f"{false} of {len(mine)}", false == 0, FEWER if slices < SLICES_PER_S[0] and false <= 2 else "")
