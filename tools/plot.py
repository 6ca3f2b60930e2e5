#!/usr/bin/env python3
"""Draw what `jointcal hinge` says about a recording over time, as PNG.

    python3 tools/plot.py tools/demo/hinge_demo.csv -o hinge.png
    python3 tools/plot.py recording.csv --truth truth.json -o hinge.png
    python3 tools/plot.py recording.csv --jsonl lines.jsonl -o hinge.png

Runs the program with --json, or reads lines that it wrote before (--jsonl). From top to
bottom: the stated bounds, and the errors where the true axes are known (`axis1` and
`axis2` in the truth, by default RECORDING.json); status; sign margin; how the segments
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

from jointcal_tools.measure.judge import line_angle_deg  # noqa: E402
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
KNOWN_DEG = 89.0  # a bound above says that nothing is known
# Okabe and Ito's colours, told apart with any kind of colour vision; status also differs in hatching.
AXIS_COLOURS = ("#0072B2", "#D55E00")
STATUS = {"collecting": ("#DDDDDD", ""), "ambiguous": ("#F0C75E", "////"), "ready": ("#35B48C", ""),
          "moved": ("#CC79A7", "xxxx")}


@dataclass
class Lines:
    """The program's lines as arrays, unknown values as NaN."""

    t_s: np.ndarray
    status: list[str]
    axes: np.ndarray  # (N, 2, 3)
    bounds_deg: np.ndarray  # (N, 2)
    sign_margin: np.ndarray
    ready_s: list[float]  # times at which `ready` was entered
    engine: str


def run_program(program: Path, recording: Path, options: list[str]) -> str:
    if not program.is_file():
        sys.exit(f"{program} is not there; build it with: cmake --preset host && cmake --build --preset host")
    done = subprocess.run([program, "hinge", recording, "--json", "--every", str(EVERY_S), *options],
                          stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode not in (0, 3):  # ready or not at the end
        sys.exit(done.returncode)
    return done.stdout


def numbers(value: object, shape: tuple[int, ...]) -> np.ndarray:
    return np.full(shape, np.nan) if value is None else np.array(value, float)


def parse_lines(text: str, until_s: float) -> Lines:
    lines = [json.loads(line) for line in text.splitlines() if line.strip()]
    lines = [line for line in lines if line["t_s"] is not None and line["t_s"] <= until_s]
    if not lines:
        sys.exit("there is no line with a time: nothing to draw")
    return Lines(
        np.array([line["t_s"] for line in lines], float),
        [line["status"] for line in lines],
        np.array([[numbers(line["axis1"], (3,)), numbers(line["axis2"], (3,))] for line in lines]),
        np.array([numbers(line["uncertainty_deg"], (2,)) for line in lines]),
        np.array([numbers(line["sign_margin"], ()) for line in lines]),
        [line["t_s"] for line in lines if line["event"] == "ready"],
        lines[-1]["engine"])


def load_until(path: Path, until_s: float) -> Recording:
    """The recording up to a time; rows without a time are left out."""
    rec = load_csv(path)
    keep = np.flatnonzero(rec.t_s <= until_s)
    return Recording(rec.t_s[keep], rec.gyr1[keep], rec.acc1[keep], rec.gyr2[keep], rec.acc2[keep])


def read_truth(path: Path | None, recording: Path) -> list[np.ndarray] | None:
    """The true axes; None if they are not known."""
    chosen = path or recording.with_suffix(".json")
    if path is None and not chosen.is_file():
        return None
    facts = json.loads(chosen.read_text())
    if "axis1" not in facts or "axis2" not in facts:
        if path:
            sys.exit(f"{path}: no axis1 and axis2")
        return None
    return [np.array(facts[name], float) / np.linalg.norm(facts[name]) for name in ("axis1", "axis2")]


# The panels.

def draw_accuracy(panel: Axes, lines: Lines, truth: list[np.ndarray] | None, max_bound_deg: float) -> None:
    errors = None
    if truth:
        errors = np.column_stack([line_angle_deg(lines.axes[:, k], truth[k]) for k in (0, 1)])
        along = np.column_stack([lines.axes[:, k] @ truth[k] for k in (0, 1)])
        wrong = along[:, 0] * along[:, 1] < 0.0
    known = np.where(lines.bounds_deg < KNOWN_DEG, lines.bounds_deg, np.nan)
    for k, colour in enumerate(AXIS_COLOURS):
        if errors is not None:
            panel.plot(lines.t_s, np.maximum(errors[:, k], 1e-3), color=colour, linewidth=1.6, label=f"error, axis {k + 1}")
    for k, colour in enumerate(AXIS_COLOURS):
        panel.plot(lines.t_s, known[:, k], color=colour, linestyle=(0, (4, 1.5)), linewidth=1.6,
                   label=f"stated 95 % bound, axis {k + 1}")
    if errors is not None and wrong.any():
        panel.plot(lines.t_s[wrong], np.full(wrong.sum(), 110.0), "kx", markersize=4, label="wrong sign pairing")
    panel.axhline(max_bound_deg, color="black", linewidth=1.0, linestyle=":")
    panel.annotate(f"max_bound {max_bound_deg:g} deg", (1.0, max_bound_deg), xycoords=("axes fraction", "data"),
                   xytext=(-4, 2), textcoords="offset points", ha="right", va="bottom", fontsize=8)
    shown = [known] if errors is None else [known, errors]
    values = np.concatenate([part[np.isfinite(part)] for part in shown])
    low = max(float(np.quantile(values, 0.01)) / 1.5, 0.01) if len(values) else 0.1
    panel.set_yscale("log")
    panel.set_ylim(min(low, max_bound_deg / 10.0), 130.0)
    panel.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    panel.yaxis.set_minor_formatter(NullFormatter())
    panel.set_ylabel("angle, deg")
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


def draw_margin(panel: Axes, lines: Lines) -> None:
    margin = np.where(lines.sign_margin > 0.0, lines.sign_margin, np.nan)
    panel.plot(lines.t_s, margin, color="#222222", linewidth=1.4)
    panel.axhline(1.0, color="black", linewidth=0.8, linestyle=":")
    panel.set_yscale("log")
    top = np.nanmax(margin, initial=1.0)
    panel.set_ylim(0.8, max(10.0, 1.5 * float(top)))
    panel.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    panel.yaxis.set_minor_formatter(NullFormatter())
    panel.set_ylabel("sign margin\n(cost ratio)")
    panel.grid(True, which="major", alpha=0.35)


def smoothed(values: np.ndarray, count: int) -> np.ndarray:
    """Moving average over `count` samples, shorter at the ends."""
    kernel = np.ones(count)
    return np.convolve(values, kernel, "same") / np.convolve(np.ones(len(values)), kernel, "same")


def draw_excitation(panel: Axes, rec: Recording) -> None:
    rows = rec.finite()
    t_s = rec.t_s[rows]
    window_s = max(SMOOTH_S, (t_s[-1] - t_s[0]) / 200.0)
    count = max(1, min(round(window_s * rec.rate_hz), len(rows)))
    rate1, rate2 = (np.linalg.norm(gyr[rows], axis=1) for gyr in (rec.gyr1, rec.gyr2))
    for k, rate in enumerate((rate1, rate2)):
        panel.plot(t_s, smoothed(rate, count), color=AXIS_COLOURS[k], linewidth=1.2, label=f"|ω{k + 1}|, sensor {k + 1}")
    panel.fill_between(t_s, smoothed(np.abs(rate1 - rate2), count), color="#999999", alpha=0.6, linewidth=0.0,
                       label="| |ω1| − |ω2| |: what tells the axes")
    panel.set_ylim(0.0, 1.25 * max(panel.get_ylim()[1], 0.1))  # room for the legend
    panel.set_ylabel(f"rate, rad/s\n({window_s:.1f} s mean)")
    panel.set_xlabel("time, s")
    panel.grid(True, alpha=0.35)
    panel.legend(loc="upper right", fontsize=8, ncols=3, framealpha=0.9)


def draw(rec: Recording, lines: Lines, truth: list[np.ndarray] | None, max_bound_deg: float, title: str) -> plt.Figure:
    figure, panels = plt.subplots(4, 1, sharex=True, figsize=(10.0, 8.5), layout="constrained",
                                  height_ratios=[3.2, 0.35, 1.2, 1.8])
    draw_accuracy(panels[0], lines, truth, max_bound_deg)
    draw_status(panels[1], lines)
    draw_margin(panels[2], lines)
    draw_excitation(panels[3], rec)
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
    parser.add_argument("--truth", type=Path, help="JSON with axis1 and axis2 (default: RECORDING.json if it has them)")
    parser.add_argument("--jsonl", type=Path, help="lines of `jointcal hinge RECORDING --json --every 0.1`")
    parser.add_argument("--engine", choices=["stream", "window"], default="stream")
    parser.add_argument("--max-bound", type=float, default=3.0, help="deg (default 3)")
    parser.add_argument("--until", type=float, metavar="S", default=float("inf"), help="draw up to this time")
    parser.add_argument("--program", type=Path, default=PROGRAM, help="default: build/host/jointcal")
    return parser


def main() -> int:
    args = make_parser().parse_args()
    options = ["--engine", args.engine, "--max-bound", str(args.max_bound)]
    try:
        text = args.jsonl.read_text() if args.jsonl else run_program(args.program, args.recording, options)
        lines = parse_lines(text, args.until)
        rec = load_until(args.recording, args.until)
        truth = read_truth(args.truth, args.recording)
    except (OSError, ValueError, KeyError) as error:
        print(f"plot.py: {error}", file=sys.stderr)
        return 2
    title = f"{args.recording.name}: hinge, {lines.engine} engine; {lines.status[-1]} at the end"
    draw(rec, lines, truth, args.max_bound, title).savefig(args.out, dpi=130)
    return 0


if __name__ == "__main__":
    sys.exit(main())
