#!/usr/bin/env python3
"""Draw what jointcal says about a recording over time, as PNG.

    python3 tools/plot.py tools/demo/hinge_demo.csv -o hinge.png
    python3 tools/plot.py tools/demo/two_dof_demo.csv --joint two-dof -o two_dof.png
    python3 tools/plot.py tools/demo/chain_demo.csv --joint center -o center.png
    python3 tools/plot.py tools/demo/chain_demo.csv --joint chain -o chain.png
    python3 tools/plot.py recording.csv --truth truth.json -o hinge.png
    python3 tools/plot.py recording.csv --jsonl lines.jsonl -o hinge.png

Runs the program with --json, or reads lines that it wrote before (--jsonl). From top to
bottom: the stated bounds, and the errors where the truth is known (under the names of the
program's keys, by default in RECORDING.json); status; what else is told: sign margin,
heading offset and carrying angle, misfit, or distance of hip and knee; how the segments
turn. Needs matplotlib.
"""

import argparse
import json
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

TOOLS = Path(__file__).resolve().parent
sys.path.insert(0, str(TOOLS / "python"))

from jointcal_tools.recordings import AXES as XYZ  # noqa: E402
from jointcal_tools.recordings import Recording, load_csv  # noqa: E402

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from matplotlib.axes import Axes
    from matplotlib.patches import Patch
    from matplotlib.ticker import FuncFormatter, NullFormatter
except ImportError:
    sys.exit("matplotlib is not installed: pip install matplotlib")

PROGRAM = TOOLS.parent / "build" / "host" / "jointcal"
EVERY_S = 0.1
SMOOTH_S = 0.5
# Okabe and Ito's colours, told apart with any kind of colour vision; status also differs in hatching.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7")
STATUS = {"collecting": ("#DDDDDD", ""), "ambiguous": ("#F0C75E", "////"), "ready": ("#35B48C", ""),
          "moved": ("#CC79A7", "xxxx")}


@dataclass(frozen=True)
class Joint:
    """What a command of the program tells, and how it is drawn."""

    title: str
    keys: tuple[str, ...]  # the vectors that are sought; their bounds are at `bound`, in this order
    labels: tuple[str, ...]
    bound: str
    unit: str
    per_unit: float  # from the program's numbers to the unit drawn
    known: float  # a bound above says that nothing is known
    max_bound: float  # default
    max_bound_per_unit: float  # from the unit drawn to the option's
    directions: bool  # errors are angles between lines, not distances
    sensors: int
    others: tuple[tuple[str, str, float], ...]  # key, label, factor of what the third panel shows
    others_label: str
    others_log: bool = False


JOINTS = {
    "hinge": Joint("hinge", ("axis1", "axis2"), ("axis 1", "axis 2"), "uncertainty_deg", "deg", 1.0, 89.0, 3.0, 1.0, True, 2,
                   (("sign_margin", "sign margin", 1.0),), "sign margin\n(cost ratio)", True),
    "two-dof": Joint("two axes", ("axis1", "axis2"), ("axis 1", "axis 2"), "uncertainty_deg", "deg", 1.0, 89.0, 3.0, 1.0, True, 2,
                     (("heading_offset_deg", "heading offset", 1.0), ("carrying_angle_deg", "carrying angle", 1.0)), "angle, deg"),
    "center": Joint("joint centre", ("joint_to_sensor1_m", "joint_to_sensor2_m"), ("joint to sensor 1", "joint to sensor 2"),
                    "uncertainty_m", "mm", 1e3, 900.0, 10.0, 1e-3, False, 2, (("misfit", "misfit", 1.0),), "misfit", True),
    "chain": Joint("hip and knee", ("hip_to_pelvis_m", "hip_to_thigh_m", "knee_to_thigh_m", "knee_to_shank_m"),
                   ("hip to pelvis", "hip to thigh", "knee to thigh", "knee to shank"), "uncertainty_m", "mm", 1e3, 900.0, 10.0,
                   1e-3, False, 3, (("segment_length_m", "hip to knee", 1e3),), "distance, mm"),
}


@dataclass
class Lines:
    """The program's lines as arrays, unknown values as NaN."""

    t_s: np.ndarray
    status: list[str]
    vectors: np.ndarray  # (N, K, 3) as the joint's keys
    bounds: np.ndarray  # (N, K) in the unit drawn
    others: np.ndarray  # (N, M)
    ready_s: list[float]  # times at which `ready` was entered
    engine: str


def run_program(program: Path, joint: str, recording: Path, options: list[str]) -> str:
    if not program.is_file():
        sys.exit(f"{program} is not there; build it with: cmake --preset host && cmake --build --preset host")
    done = subprocess.run([program, joint, recording, "--json", "--every", str(EVERY_S), *options],
                          stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode not in (0, 3):  # ready or not at the end
        sys.exit(done.returncode)
    return done.stdout


def numbers(value: object, shape: tuple[int, ...]) -> np.ndarray:
    return np.full(shape, np.nan) if value is None else np.array(value, float)


def parse_lines(text: str, joint: Joint, until_s: float) -> Lines:
    lines = [json.loads(line) for line in text.splitlines() if line.strip()]
    lines = [line for line in lines if line["t_s"] is not None and line["t_s"] <= until_s]
    if not lines:
        sys.exit("there is no line with a time: nothing to draw")
    return Lines(
        np.array([line["t_s"] for line in lines], float),
        [line["status"] for line in lines],
        np.array([[numbers(line[key], (3,)) for key in joint.keys] for line in lines]),
        joint.per_unit * np.array([numbers(line[joint.bound], (len(joint.keys),)) for line in lines]),
        np.array([[factor * numbers(line[key], ()) for key, _, factor in joint.others] for line in lines]),
        [line["t_s"] for line in lines if line["event"] == "ready"],
        lines[-1]["engine"])


def load_until(path: Path, until_s: float) -> Recording:
    """The recording up to a time; rows without a time are left out."""
    rec = load_csv(path)
    keep = np.flatnonzero(rec.t_s <= until_s)
    return Recording(rec.t_s[keep], rec.gyr1[keep], rec.acc1[keep], rec.gyr2[keep], rec.acc2[keep],
                     columns={name: column[keep] for name, column in rec.columns.items()})


def read_truth(path: Path | None, recording: Path, joint: Joint) -> np.ndarray | None:
    """(K, 3) the true vectors; None if they are not known."""
    chosen = path or recording.with_suffix(".json")
    if path is None and not chosen.is_file():
        return None
    facts = json.loads(chosen.read_text())
    if any(key not in facts for key in joint.keys):
        if path:
            sys.exit(f"{path}: no {' and '.join(joint.keys)}")
        return None
    return np.array([facts[key] for key in joint.keys], float)


def errors_of(lines: Lines, truth: np.ndarray, joint: Joint) -> np.ndarray:
    """(N, K) in the unit drawn."""
    if not joint.directions:
        return joint.per_unit * np.linalg.norm(lines.vectors - truth, axis=2)
    unit = truth / np.linalg.norm(truth, axis=1, keepdims=True)
    across = np.linalg.norm(np.cross(lines.vectors, unit), axis=2)
    return np.degrees(np.arctan2(across, np.abs((lines.vectors * unit).sum(axis=2))))


# The panels.

def draw_accuracy(panel: Axes, lines: Lines, truth: np.ndarray | None, joint: Joint, max_bound: float) -> None:
    errors = None if truth is None else errors_of(lines, truth, joint)
    known = np.where(lines.bounds < joint.known, lines.bounds, np.nan)
    for k, label in enumerate(joint.labels):
        if errors is not None:
            panel.plot(lines.t_s, np.maximum(errors[:, k], 1e-3), color=COLOURS[k], linewidth=1.6, label=f"error, {label}")
    for k, label in enumerate(joint.labels):
        panel.plot(lines.t_s, known[:, k], color=COLOURS[k], linestyle=(0, (4, 1.5)), linewidth=1.6,
                   label=f"stated 95 % bound, {label}")
    if errors is not None and joint.title == "hinge":
        along = (lines.vectors * truth).sum(axis=2)
        wrong = along[:, 0] * along[:, 1] < 0.0
        if wrong.any():
            panel.plot(lines.t_s[wrong], np.full(wrong.sum(), 110.0), "kx", markersize=4, label="wrong sign pairing")
    panel.axhline(max_bound, color="black", linewidth=1.0, linestyle=":")
    panel.annotate(f"max_bound {max_bound:g} {joint.unit}", (1.0, max_bound), xycoords=("axes fraction", "data"),
                   xytext=(-4, 2), textcoords="offset points", ha="right", va="bottom", fontsize=8)
    shown = [known] if errors is None else [known, errors]
    values = np.concatenate([part[np.isfinite(part)] for part in shown])
    low = max(float(np.quantile(values, 0.01)) / 1.5, 0.01) if len(values) else 0.1
    panel.set_yscale("log")
    panel.set_ylim(min(low, max_bound / 10.0), 1.45 * joint.known)
    panel.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    panel.yaxis.set_minor_formatter(NullFormatter())
    panel.set_ylabel(f"{'angle' if joint.directions else 'distance'}, {joint.unit}")
    panel.grid(True, which="major", alpha=0.35)
    panel.legend(loc="upper right", fontsize=8, framealpha=0.9)


def draw_status(panel: Axes, lines: Lines) -> None:
    """A band; each line's status holds until the next line."""
    edges = np.append(lines.t_s, lines.t_s[-1])
    begin = 0
    for k in range(1, len(lines.status) + 1):
        if k == len(lines.status) or lines.status[k] != lines.status[begin]:
            colour, hatch = STATUS[lines.status[begin]]
            panel.axvspan(edges[begin], edges[k], facecolor=colour, hatch=hatch, edgecolor="#666666", linewidth=0.0)
            begin = k
    panel.set_yticks([])
    panel.set_ylabel("status", rotation=0, ha="right", va="center")
    seen = [name for name in STATUS if name in lines.status]
    panel.legend(handles=[Patch(facecolor=STATUS[name][0], hatch=STATUS[name][1], edgecolor="#666666", label=name)
                          for name in seen], loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=len(seen), fontsize=8,
                 frameon=False, borderaxespad=0.1)


def draw_others(panel: Axes, lines: Lines, joint: Joint) -> None:
    """What the joint tells besides vectors."""
    for k, (_, label, _) in enumerate(joint.others):
        values = lines.others[:, k]
        shown = np.where(values > 0.0, values, np.nan) if joint.others_log else values
        panel.plot(lines.t_s, shown, color=COLOURS[k] if len(joint.others) > 1 else "#222222", linewidth=1.4, label=label)
    if joint.others_log:
        panel.set_yscale("log")
        panel.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        panel.yaxis.set_minor_formatter(NullFormatter())
    if joint.title == "hinge":
        panel.axhline(1.0, color="black", linewidth=0.8, linestyle=":")
        panel.set_ylim(0.8, max(10.0, 1.5 * float(np.nanmax(lines.others, initial=1.0))))
    if len(joint.others) > 1:
        panel.legend(loc="upper right", fontsize=8, framealpha=0.9)
    panel.set_ylabel(joint.others_label)
    panel.grid(True, which="major", alpha=0.35)


def smoothed(values: np.ndarray, count: int) -> np.ndarray:
    """Moving average over `count` samples, shorter at the ends."""
    kernel = np.ones(count)
    return np.convolve(values, kernel, "same") / np.convolve(np.ones(len(values)), kernel, "same")


def rates_of(rec: Recording, sensor: int) -> np.ndarray:
    """(N,) length of the rate of a sensor."""
    return np.linalg.norm(np.column_stack([rec.columns[f"gyr{sensor}_{axis}"] for axis in XYZ]), axis=1)


def draw_excitation(panel: Axes, rec: Recording, joint: Joint) -> None:
    rows = rec.finite()
    t_s = rec.t_s[rows]
    window_s = max(SMOOTH_S, (t_s[-1] - t_s[0]) / 200.0)
    count = max(1, min(round(window_s * rec.rate_hz), len(rows)))
    rates = [rates_of(rec, k + 1)[rows] for k in range(joint.sensors)]
    for k, rate in enumerate(rates):
        panel.plot(t_s, smoothed(np.nan_to_num(rate), count), color=COLOURS[k], linewidth=1.2, label=f"|ω{k + 1}|, sensor {k + 1}")
    if joint.title == "hinge":
        panel.fill_between(t_s, smoothed(np.abs(rates[0] - rates[1]), count), color="#999999", alpha=0.6, linewidth=0.0,
                           label="| |ω1| − |ω2| |: what tells the axes")
    panel.set_ylim(0.0, 1.25 * max(panel.get_ylim()[1], 0.1))  # room for the legend
    panel.set_ylabel(f"rate, rad/s\n({window_s:.1f} s mean)")
    panel.set_xlabel("time, s")
    panel.grid(True, alpha=0.35)
    panel.legend(loc="upper right", fontsize=8, ncols=3, framealpha=0.9)


def draw(rec: Recording, lines: Lines, truth: np.ndarray | None, joint: Joint, max_bound: float, title: str) -> plt.Figure:
    figure, panels = plt.subplots(4, 1, sharex=True, figsize=(10.0, 8.5), layout="constrained",
                                  height_ratios=[3.2, 0.35, 1.2, 1.8])
    draw_accuracy(panels[0], lines, truth, joint, max_bound)
    draw_status(panels[1], lines)
    draw_others(panels[2], lines, joint)
    draw_excitation(panels[3], rec, joint)
    for panel in panels:
        for ready_s in lines.ready_s:
            panel.axvline(ready_s, color="#00664A", linewidth=0.9, alpha=0.8)
    begin_s, end_s = np.nanmin(rec.t_s), np.nanmax(rec.t_s)
    if lines.ready_s:
        left = lines.ready_s[0] < begin_s + 0.8 * (end_s - begin_s)
        panels[1].annotate(f"ready at {lines.ready_s[0]:.1f} s", (lines.ready_s[0], 0.5), xycoords=("data", "axes fraction"),
                           xytext=(5 if left else -5, 0), textcoords="offset points", fontsize=9, va="center",
                           ha="left" if left else "right")
    panels[0].set_xlim(begin_s, end_s)
    panels[0].set_title(title, fontsize=11)
    return figure


def make_parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("recording", type=Path, help="CSV file")
    parser.add_argument("-o", "--out", type=Path, required=True, help="PNG file")
    parser.add_argument("--joint", choices=list(JOINTS), default="hinge", help="command of the program (default hinge)")
    parser.add_argument("--truth", type=Path, help="JSON with the true vectors under the program's names (default: RECORDING.json "
                        "if it has them)")
    parser.add_argument("--jsonl", type=Path, help="lines of `jointcal JOINT RECORDING --json --every 0.1`")
    parser.add_argument("--engine", choices=["stream", "window"], default="stream")
    parser.add_argument("--max-bound", type=float, help="deg or mm (default 3 deg, 10 mm)")
    parser.add_argument("--until", type=float, metavar="S", default=float("inf"), help="draw up to this time")
    parser.add_argument("--program", type=Path, default=PROGRAM, help="default: build/host/jointcal")
    return parser


def main() -> int:
    args = make_parser().parse_args()
    joint = JOINTS[args.joint]
    max_bound = args.max_bound or joint.max_bound
    options = ["--engine", args.engine, "--max-bound", f"{max_bound * joint.max_bound_per_unit:g}"]
    try:
        text = args.jsonl.read_text() if args.jsonl else run_program(args.program, args.joint, args.recording, options)
        lines = parse_lines(text, joint, args.until)
        rec = load_until(args.recording, args.until)
        truth = read_truth(args.truth, args.recording, joint)
        title = f"{args.recording.name}: {joint.title}, {lines.engine} engine; {lines.status[-1]} at the end"
        draw(rec, lines, truth, joint, max_bound, title).savefig(args.out, dpi=130)
    except (OSError, ValueError, KeyError) as error:
        print(f"plot.py: {error if not isinstance(error, KeyError) else f'no {error} in lines or recording'}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
