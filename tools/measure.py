#!/usr/bin/env python3
"""Measure what the README and docs/MEASUREMENTS.md claim.

    python3 tools/measure.py rig                 one measurement
    python3 tools/measure.py all --quick         a small one of each, as CI does
    python3 tools/measure.py never --only clip:7 one run again

Each subcommand prints a report and writes it to docs/measurements (--quick, --only and
--slices: build/measurements). Exit status 1 if a requirement fails. Recordings are looked for in
the folder that JOINTCAL_DATA names, else in data/.
"""

import argparse
import importlib
import os
import shlex
import sys
from pathlib import Path

# Many small matrices: one thread per process is fastest. Read when numpy is loaded.
for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(variable, "1")

TOOLS = Path(__file__).resolve().parent
sys.path.insert(0, str(TOOLS / "python"))

from jointcal_tools import native, native_two_dof  # noqa: E402
from jointcal_tools.measure.harness import Incomplete, Report, Settings, Skipped, orientations_by  # noqa: E402

MEASUREMENTS = {
    "rig": "whole rig recordings: accuracy, both engines, numpy",
    "silent": "every 3, 5, 10 s window of the rig recordings, beside qmt",
    "never": "data that determine nothing must never be ready",
    "bounds": "coverage and sharpness of the bounds, simulated",
    "scenarios": "the four scenarios of OLS20 beside Algorithm 4",
    "time": "time to ready",
    "slices": "what fewer slices of work per second cost in time to ready",
    "bias": "what the bias states buy",
    "reference": "the stream engine beside float64, rig and simulated",
    "two_dof": "2-DoF joint: whole rig recordings, and every 5, 10, 20 s window",
    "hinge_models": "rigid and functional model of a hinge on the rig, each alone and together",
    "hinge_orientations": "What orientations would add to a hinge: 27 first moments, in float64",
    "lai22": "the methods of LAI22 as they are: kinds of low-pass, how often they are wrong",
    "people": "a person's elbow and knee: repeatability of parts",
    "people_hinge": "people's joints as hinges: whole recordings, starts, parts",
    "people_never": "wrong pairs, faulty sensors and joints that are no hinge must never be ready, people's model",
    "people_sim": "simulated knees, ankles, elbows: time to ready, coverage, flexion",
    "people_angles": "angles of a person's joint row by row beside references, and their bounds",
    "people_elbow": "people's elbows: heading, axes, levers, angles beside optics; when each is known",
    "people_levers": "people's levers: a thigh's length, and whether parts of a recording agree",
    "people_ball_never": "wrong pairs, faulty sensors, motion that shows no axis: what no heading, lever or axis may be said of",
    "people_ball_sim": "simulated joints of people: coverage and sharpness of headings and levers",
    "two_dof_sim": "2-DoF joint, simulated: coverage, sharpness, what must never be ready",
    "handling": "sensors handled before they are on the joint: how much later ready",
    "moved": "slips: how soon they are noticed, false alarms",
    "angles": "joint angles of the rig beside the optical ones",
    "center": "joint centre: rig recordings, measured vectors, float64, parts, hinges",
    "center_sim": "joint centre, simulated: coverage, sharpness, what must never be ready, table I of OLS17",
    "chain": "hip and knee: SAL15 simulated, ingredient by ingredient, a person's thigh",
    "sensor": "the stage of one sensor: beside VQF and optics, cold starts, bias",
    "sensor_faults": "what wireless sensors do to hinges: vibration, straps, lag, drift, scale, dead and exchanged readings",
    "center_faults": "what faults of sensors do to the joint centre: scales, lag, vibration, clipping, signs, the rate behind the times",
    "two_files": "two files with clocks of their own beside the recording that they are split from",
    "sensor_health": "what one sensor's health says of faults, of good recordings, and of faults put into them",
    "lag_left": "simulated hinges whose sensor 2 is late by as much as the bound of a known lag allows",
    "pairing": "the lag of two sensors: recordings and simulated joints told a lag, unrelated pairs",
    "remember": "kept calibrations restored on the same sensors, and on ones that sit otherwise: confirmed, dropped, or neither",
    "restore": "yesterday's calibrations in a body: how soon joints give angles, how good they are, what is dropped",
    "body": "a whole person: sixteen sensors over a bad wire, fifteen joints: ready, errors, lags, angles, faults that are named",
    "body_m4f": "ten minutes of a whole person on an emulated Cortex-M4F: instructions of every 10 ms, memory, the same bits as here",
    "soak": "an hour of packets of two sensors over a bad wire: counters, times, lag and calibration beside the truth",
    "cost": "time and memory, beside qmt",
}
MODULES = {"time": "time_to_ready", "lai22": "lai22_paper"}  # where the name differs


def make_parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=[*MEASUREMENTS, "all"],
                        help="; ".join(f"{name}: {text}" for name, text in MEASUREMENTS.items()))
    parser.add_argument("--runs", type=int, help="number of runs, where there are any to choose")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="processes (default: all cores)")
    parser.add_argument("--quick", action="store_true", help="few runs, and chance is allowed for")
    parser.add_argument("--engine", choices=["stream", "window", "both"], default="both")
    parser.add_argument("--no-qmt", action="store_true", help="leave the comparison with qmt out")
    parser.add_argument("--qmt-every", type=float, default=1.0, metavar="S",
                        help="cost: estimate with qmt every S seconds; the requirement is about 1")
    parser.add_argument("--only", metavar="CLASS[:INDEX]", help="never, bounds: this class or run alone; body: persons or sections")
    parser.add_argument("--slices", type=float, metavar="N", help="slices_per_s of the config (default: the library's)")
    parser.add_argument("--out", type=Path, help="folder of the reports")
    return parser


def settings_from(args: argparse.Namespace) -> Settings:
    engines = ("stream", "window") if args.engine == "both" else (args.engine,)
    return Settings(runs=args.runs, jobs=max(args.jobs, 1), quick=args.quick, engines=engines,
                    with_qmt=not args.no_qmt, qmt_every_s=args.qmt_every, only=args.only)


def command_line(name: str) -> str:
    """This call, for the report: without what has no influence on the result."""
    words, skip = [], False
    for word in sys.argv[1:]:
        if skip or word.startswith(("--jobs", "--out")):
            skip = not skip and "=" not in word
            continue
        words.append(name if word == "all" else word)
    return shlex.join(["python3", "tools/measure.py", *words])


def measure(name: str, settings: Settings, folder: Path) -> bool:
    """One measurement; True if all its requirements hold or it cannot be made here."""
    module = importlib.import_module(f"jointcal_tools.measure.{MODULES.get(name, name)}")
    report = Report(name, module.TITLE, command_line(name), native.version(), settings.quick)
    need = getattr(module, "VQF", "")
    try:
        if need:
            report.source = orientations_by(need, native_two_dof.has_vqf(), settings.quick)
        if "WITHOUT" in report.source:
            print(f"{name}: the library was built{report.source[1:]}", file=sys.stderr)
        module.measure(settings, report)
    except Incomplete as reason:
        print(f"{name}: not measured: {reason}", file=sys.stderr)
        return False
    except Skipped as reason:
        print(f"{name}: skipped, {reason}\n")
        return True
    print(report.markdown())
    report.write(folder)
    return report.passed


def main() -> int:
    args = make_parser().parse_args()
    if args.runs is not None and args.runs < 1:
        print("--runs must be at least 1", file=sys.stderr)
        return 2
    try:
        native.library()
    except (FileNotFoundError, RuntimeError) as error:
        print(error, file=sys.stderr)
        return 2
    if args.slices is not None:
        native.OVERRIDES["slices_per_s"] = args.slices
    default = "build/measurements" if args.quick or args.only or args.slices is not None else "docs/measurements"
    folder = args.out or TOOLS.parent / default
    names = list(MEASUREMENTS) if args.what == "all" else [args.what]
    passed = [measure(name, settings_from(args), folder) for name in names]
    return 0 if all(passed) else 1


if __name__ == "__main__":
    sys.exit(main())
