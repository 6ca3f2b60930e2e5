"""The command tools/plot.py: options, and who is called."""

from __future__ import annotations

import argparse
import sys
from contextlib import closing
from pathlib import Path

from .angles import draw_angles, read_angles, told_angles_good_to
from .calibration import default_title, draw_calibration
from .check import draw_check, read_readings, run_check
from .joints import JOINTS
from .motion import read_motion
from .reading import Clock, RefusedError
from .style import Style, check_out, make_style, save
from .told import ProgramError, Told, run_program, stored_lines
from .truth import asked_good_to, read_truth

TOOLS = Path(__file__).resolve().parents[3]
PROGRAM = TOOLS.parent / "build" / "host" / "jointcal"

DESCRIPTION = """\
Draw what jointcal says about a recording over time, or joint angles, as PNG, PDF or SVG.

A calibration (--joint hinge, two-dof, ball, center, chain): runs the program with --json, or reads
lines that it wrote before (--jsonl). From top to bottom: the stated bounds, and the errors where
the truth is known; status; what else is told: sign margin, heading offset and carrying angle,
misfit, or distance of hip and knee; how the segments turn.

Angles (--joint angles): FILE is what `jointcal angles` wrote, .csv or .sto. From top to bottom:
each angle, with its reference if there is one; the difference of both, with its rms. Whole turns
of 360 deg are taken out of both.

What the sensors do (--joint check): rates and specific forces of each sensor, components that are
clipped or dead, gaps, and what `jointcal check` says.

A panel with nothing to show says why. Long files are read in pieces; every peak is kept.
"""

EPILOG = """\
examples:
  tools/plot.py tools/demo/hinge_demo.csv -o hinge.png
  tools/plot.py tools/demo/chain_demo.csv --joint chain -o chain.svg
  tools/plot.py recording.csv --jsonl lines.jsonl --truth truth.json -o hinge.png
  tools/plot.py recording.csv --column single --title "" --font "DejaVu Serif" -o figure3.pdf
  tools/plot.py recording.csv --joint check -o check.png
  build/host/jointcal angles knee.csv --joint hinge --out angles.csv
  tools/plot.py angles.csv --joint angles -o angles.pdf
  tools/plot.py angles.csv --joint angles --reference knee.csv --zero-to-reference \\
      --reference-good-to 1deg --from 20 --until 30 -o angles.pdf

truth and reference:
  RECORDING.json, or the file of --truth, may hold the true vectors under the program's names
  (axis1, axis2, joint_to_sensor1_m, ..., hip_to_pelvis_m, ...) and say how good they are:
  axes_good_to_deg; vectors_good_to_m or vectors_good_to_percent (of the longest vector's length).
  REFERENCE.json may hold angles_good_to_deg. A grey band then shows which differences say
  nothing about jointcal.

exit status: 0 drawn; 2 the command line or a file is wrong; else as the program's.
"""


def make_parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="plot.py", description=DESCRIPTION, epilog=EPILOG, allow_abbrev=False,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file", metavar="FILE", type=Path, help="recording (CSV); with --joint angles a file of angles")
    parser.add_argument("-o", "--out", type=Path, required=True, help="figure to write: .png, .pdf or .svg")
    parser.add_argument("--joint", choices=[*JOINTS, "angles", "check"], default="hinge", help="what to draw (default hinge)")
    parser.add_argument("--from", dest="from_s", type=float, metavar="S", default=float("-inf"), help="draw from then on")
    parser.add_argument("--until", type=float, metavar="S", default=float("inf"), help="draw until then")
    parser.add_argument("--reference-good-to", metavar="X", help="grey band for what truth or reference is good for: 1deg, 7mm, "
                        "5%% (default: as the .json says)")

    calibration = parser.add_argument_group("a calibration")
    calibration.add_argument("--truth", type=Path, metavar="JSON", help="file with the true vectors (default: RECORDING.json if it "
                             "has them)")
    calibration.add_argument("--jsonl", type=Path, metavar="LINES", help="lines of jointcal JOINT RECORDING --json --every 0.1")
    calibration.add_argument("--engine", choices=["stream", "window"], default="stream", help="of the program (default stream)")
    calibration.add_argument("--max-bound", type=float, metavar="X", help="limit for ready, deg or mm (default 3 deg, 10 mm; two axes of a person 15 deg, ball joint 60 mm)")
    calibration.add_argument("--program", type=Path, default=PROGRAM, help="default: build/host/jointcal")

    angles = parser.add_argument_group("angles")
    angles.add_argument("--angles", metavar="NAMES", default="", help="angles to draw, at most four, with commas between "
                        "(default: all but the heading offset)")
    angles.add_argument("--reference", type=Path, metavar="FILE", help="file with reference angles over the same time (default: "
                        "the file of angles, if it has some)")
    angles.add_argument("--reference-column", metavar="NAMES", default="", help="its columns in the order of the angles (default: "
                        "ref_flexion_deg for flexion_deg and so on; else the only ref_..._deg for the first angle)")
    angles.add_argument("--zero-to-reference", action="store_true", help="take the mean difference off each angle: where zero is, "
                        "is the mounting's choice; the legend says how much")

    angles.add_argument("--negate-reference", action="store_true", help="turn the reference's sign: which way counts as bending, is a "
                        "convention (jointcal's is that of axis 1, see --axis1-toward)")

    paper = parser.add_argument_group("for a paper")
    paper.add_argument("--title", help="text above the figure; \"\" for none (default: file, joint, engine, status)")
    paper.add_argument("--column", choices=["single", "double"], help="88 or 180 mm wide, 8 point font, 300 dots per inch")
    paper.add_argument("--size", metavar="WxH", help="width and height with a unit: 88x120mm, 8.8x12cm, 3.5x5in")
    paper.add_argument("--font", metavar="NAME", help="of an installed font, such as \"DejaVu Serif\"")
    paper.add_argument("--font-size", type=float, metavar="PT", help="default 10, with --column or --size 8")
    paper.add_argument("--dpi", type=int, help="of a PNG: dots per inch (default 130, with --column or --size 300)")
    return parser


def check_options(args: argparse.Namespace) -> None:
    """Options that would change nothing are mistakes."""
    of_calibration = ("truth", "jsonl", "max_bound")
    of_angles = ("angles", "reference", "reference_column", "zero_to_reference", "negate_reference")
    of_either = of_calibration if args.joint == "angles" else of_angles if args.joint != "check" else (*of_calibration, *of_angles, "reference_good_to")
    for name in of_either:
        if getattr(args, name):
            option = "--" + name.replace("_", "-")
            raise RefusedError(option, "only with --joint angles" if args.joint in JOINTS else f"not with --joint {args.joint}")
    if args.until <= args.from_s:
        raise RefusedError("--until", f"{args.until:g} s is not after {args.from_s:g} s")
    if args.max_bound is not None and not 0.0 < args.max_bound < float("inf"):
        raise RefusedError("--max-bound", "a number above 0 is needed")
    if str(args.file) == "-":
        raise RefusedError("-", "standard input can be read only once; give the name of a file")


def plot_calibration(args: argparse.Namespace, style: Style) -> None:
    joint = JOINTS[args.joint]
    truth = read_truth(args.truth, args.file, joint, args.reference_good_to)
    motion = read_motion(args.file, joint, args.from_s, args.until)
    if motion.clock.untimely:
        print(f"{args.file}: {motion.clock.untimely} of {motion.rows} rows are not drawn: their time does not increase",
              file=sys.stderr)
    if args.jsonl:
        place, lines = args.jsonl, stored_lines(args.jsonl)
    else:
        limit = [joint.limit_option, f"{args.max_bound / joint.per_unit:g}"] if args.max_bound else []
        options = ["--engine", args.engine, *limit]
        place, lines = args.file, run_program(args.program, joint, args.file, motion.seconds, options)
    with closing(lines):
        told = Told(place, joint, truth, Clock(args.from_s, args.until), motion.clock.zero_s).read(lines)
    title = default_title(args.file.name, told) if args.title is None else args.title
    with style.context():
        save(draw_calibration(told, motion, args.max_bound or told.max_bound, title, style), args.out, style)


def names_of(text: str) -> list[str]:
    return [name.strip() for name in text.split(",") if name.strip()]


def plot_angles(args: argparse.Namespace, style: Style) -> None:
    angles = read_angles(args.file, names_of(args.angles), (args.reference, names_of(args.reference_column)),
                         (args.from_s, args.until), args.zero_to_reference, args.negate_reference)
    if angles.references:
        angles.good_to = (asked_good_to(args.reference_good_to, "deg") if args.reference_good_to
                          else told_angles_good_to(args.reference or args.file))
    elif args.reference_good_to or args.zero_to_reference or args.negate_reference:
        raise RefusedError(args.file, "no column such as ref_flexion_deg: nothing to compare with; see --reference")
    title = args.file.name if args.title is None else args.title
    with style.context():
        save(draw_angles(angles, title, style), args.out, style)


def plot_check(args: argparse.Namespace, style: Style) -> None:
    readings = read_readings(args.file, args.from_s, args.until)
    told = run_check(args.program, args.file)
    title = args.file.name if args.title is None else args.title
    with style.context():
        save(draw_check(readings, told, title, style), args.out, style)


def main(arguments: list[str] | None = None) -> int:
    args = make_parser().parse_args(arguments)
    try:
        check_options(args)
        check_out(args.out)
        style = make_style(args.column, args.size, args.font, args.font_size, args.dpi)
        {"angles": plot_angles, "check": plot_check}.get(args.joint, plot_calibration)(args, style)
    except RefusedError as error:
        print(error, file=sys.stderr)
        return 2
    except ProgramError as error:
        return error.status
    except KeyboardInterrupt:
        return 130
    return 0
