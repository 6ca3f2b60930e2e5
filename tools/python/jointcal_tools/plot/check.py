"""The figure of `jointcal check`: what each sensor read over time, where it stopped or was silent, and what is said of it."""

from __future__ import annotations

import json
import subprocess
from dataclasses import dataclass
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.patches import Patch

from ..recordings import AXES
from .panels import DASHED, draw_empty, draw_title, lay_out, line_handle, link_times, set_legend
from .reading import Clock, Table
from .reduce import Reducer
from .style import BAND, COLOURS, Style
from .told import ProgramError, need_program

KINDS = (("gyr", "rate, rad/s"), ("acc", "specific force, m/s$^2$"))
GAP_S = 0.105  # beyond that all joints begin anew
MOST_GAPS = 200  # that are drawn
PANEL_MM = {"wide": 52.0, "double": 36.0, "single": 34.0}
STOPS = "#B00020"


@dataclass(frozen=True)
class Readings:
    values: Reducer  # rates and specific forces of each sensor, a curve for each component
    clock: Clock
    sensors: int
    gaps: list[tuple[float, float]]


def read_readings(path: Path, from_s: float, until_s: float) -> Readings:
    table = Table(path)
    sensors = next(k for k in range(4) if k == 3 or f"gyr{k + 1}_x" not in table.names)
    names = ["t_s", *(f"{kind}{k + 1}_{axis}" for k in range(max(sensors, 2)) for kind, _ in KINDS for axis in AXES)]
    table.need(names)
    clock, values = Clock(from_s, until_s), Reducer(len(names) - 1)
    gaps: list[tuple[float, float]] = []
    last_s = np.nan
    for piece in table.pieces(names):
        used = piece[clock.use(piece[:, 0])]
        values.add(used[:, 0], used[:, 1:])
        t_s = np.concatenate([[last_s], used[:, 0]])
        gaps += [(float(t_s[k]), float(t_s[k + 1])) for k in np.flatnonzero(np.diff(t_s) > GAP_S)]
        last_s = t_s[-1]
        if clock.over:
            break
    if np.isnan(clock.begin_s):
        raise clock.none_used(path, "row")
    return Readings(values.finish(), clock, sensors, gaps)


def run_check(program: Path, recording: Path) -> dict:
    """What `jointcal check` says, as it writes it."""
    need_program(program)
    done = subprocess.run([program, "check", recording, "--json"], stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode not in (0, 3):  # nothing, or something, is wrong as a whole
        raise ProgramError(done.returncode)
    return json.loads(done.stdout)


def words_of(sensor: dict) -> str:
    """The head of a sensor's panels."""
    facts = [sensor["verdict"], *(word.replace("_", " ") for word in sensor["findings"])]
    known = (("gravity_m_s2", "gravity {:.2f} m/s$^2$"), ("scale", "gyroscope's scale {:.3f}"), ("motion_rad_s", "{:.1f} rad/s rms"))
    return ", ".join([*facts, *(words.format(sensor[key]) for key, words in known if sensor[key] is not None)])


def draw_readings(panel: Axes, readings: Readings, sensor: int, kind: int, told: dict, style: Style) -> None:
    """Three components; a dashed line where one stops."""
    handles: list[Artist] = []
    for k, axis in enumerate(AXES):
        t_s, values = readings.values.trace((2 * sensor + kind) * 3 + k)
        panel.plot(t_s, values, color=COLOURS[k], linewidth=0.8 * style.scale)
        name = f"{KINDS[kind][0]}_{axis}"
        note = ", dead" if name in told["dead"] else ""
        if name in told["clipped"] and np.isfinite(values).any():
            stop = float(np.nanmax(np.abs(values)))
            for side in (-stop, stop):
                panel.axhline(side, color=STOPS, linestyle=DASHED, linewidth=style.scale, gid="stop")
            note = ", clipped"
        handles.append(line_handle(style, f"{axis}{note}", color=COLOURS[k]))
    for begin_s, end_s in readings.gaps[:MOST_GAPS]:
        panel.axvspan(begin_s, end_s, facecolor=BAND, edgecolor="none", zorder=0.5, gid="gap")
    if readings.gaps and kind == 0 and sensor == 0:
        count = len(readings.gaps)
        handles.append(Patch(facecolor=BAND, edgecolor="none", label=f"{count} gap{'s' if count > 1 else ''} above 0.1 s"))
    panel.set_ylabel(KINDS[kind][1])
    panel.grid(True)
    if not np.isfinite(np.concatenate([line.get_ydata() for line in panel.get_lines()])).any():
        draw_empty(panel, "no reading is a number", style)
    set_legend(panel, handles, f"sensor {sensor + 1}: {words_of(told)}" if kind == 0 else "")


def draw_check(readings: Readings, told: dict, title: str, style: Style) -> plt.Figure:
    kind = "wide" if style.width_mm > 200.0 else "double" if style.width_mm > 120.0 else "single"
    count = 2 * readings.sensors
    figure, panels = plt.subplots(count, 1, sharex=True, figsize=style.inches(count * PANEL_MM[kind] + 20.0), layout="constrained")
    for sensor in range(readings.sensors):
        for which in range(2):
            draw_readings(panels[2 * sensor + which], readings, sensor, which, told["sensors"][sensor], style)
    advice = [style.wrapped(sentence, 0.9) for sentence in told["advice"]]
    if told.get("lag_s") is not None:
        late, other = (2, 1) if told["lag_s"] >= 0.0 else (1, 2)
        advice.append(f"sensor {late} is {1e3 * abs(told['lag_s']):.0f} ms behind sensor {other}, to within {1e3 * told['lag_bound_s']:.0f} ms")
    draw_title(figure, "\n".join([title, *advice]) if title else "", style)
    link_times(panels, readings.clock)
    lay_out(figure, style)
    return figure
