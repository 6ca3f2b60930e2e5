"""The figure of joint angles over time, with a reference and the difference to it where there is one."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

from .panels import draw_band, draw_empty, draw_title, lay_out, line_handle, link_times, set_legend
from .reading import Clock, RefusedError, Table
from .reduce import Reducer
from .style import COLOURS, Style
from .truth import ANGLES_GOOD_TO, GoodTo, facts_of, number_of

TIMES = ("t_s", "time")
NO_ANGLES = ("heading_offset", "bound")  # written beside angles
TURN_DEG = 360.0
GAP_STEPS = 3.0  # between rows that are further apart than so many usual steps there is no reference
OPPOSITE_SHARE = 0.5  # of the spread of the difference, below which that of the sum shows opposite signs
PANEL_MM = {"wide": 70.0, "double": 42.0, "single": 38.0}


def plain(name: str) -> str:
    """What a column holds, without its unit."""
    return name.removesuffix("_deg")


def time_of(table: Table) -> str:
    for name in TIMES:
        if name in table.names:
            return name
    table.need(TIMES[:1])
    raise AssertionError


def angle_columns(table: Table, asked: Sequence[str]) -> list[str]:
    """Those asked for, else all that hold angles; of a .sto file all but the time."""
    if asked:
        named = {plain(name): name for name in table.names}
        missing = [name for name in asked if name not in table.names and name not in named]
        table.need(missing)
        if len(asked) > len(COLOURS):
            raise RefusedError("--angles", f"{len(asked)} angles; at most {len(COLOURS)} can be told apart")
        return [name if name in table.names else named[name] for name in asked]
    found = [name for name in table.names if name not in TIMES and plain(name) not in NO_ANGLES and
             (name.endswith("_deg") or table.separator == "\t") and not is_reference(name)]
    if not found and "gyr1_x" in table.names:
        raise RefusedError(table.path, "a recording, not angles; write them with: jointcal angles "
                           f"{table.path} --joint hinge --out angles.csv", table.header_line)
    if not found:
        raise RefusedError(table.path, "no column with angles, such as flexion_deg", table.header_line)
    if len(found) > len(COLOURS):
        raise RefusedError(table.path, f"{len(found)} columns of angles, {', '.join(found[:3])}, ...: choose at most "
                           f"{len(COLOURS)} with --angles", table.header_line)
    return found


def is_reference(name: str) -> bool:
    return re.fullmatch(r"(ref|reference)_.*_deg", name) is not None


def reference_columns(table: Table, angles: Sequence[str], asked: Sequence[str]) -> dict[int, str]:
    """Which column belongs to which angle: asked in the angles' order, else by name, else the only one to the first angle."""
    if asked:
        if len(asked) > len(angles):
            raise RefusedError("--reference-column", f"{len(asked)} columns for {len(angles)} of angles")
        table.need(asked)
        return dict(enumerate(asked))
    there = [name for name in table.names if is_reference(name)]
    found = {}
    for k, angle in enumerate(angles):
        for name in there:
            if re.fullmatch(rf"(ref|reference)_{re.escape(plain(angle))}_deg", name):
                found[k] = name
    if not found and len(there) == 1:
        found[0] = there[0]
    return found


class Unwrapper:
    """Takes whole turns out of columns, over pieces and missing values."""

    def __init__(self, columns: int):
        self._last = np.full(columns, np.nan)

    def __call__(self, values: np.ndarray) -> np.ndarray:
        """(n, columns), deg."""
        values = values.copy()
        for k, column in enumerate(values.T):
            rows = np.flatnonzero(np.isfinite(column))
            if len(rows) == 0:
                continue
            start = column[rows[0]] if np.isnan(self._last[k]) else self._last[k]
            values[rows, k] = np.unwrap(np.concatenate([[start], column[rows]]), period=TURN_DEG)[1:]
            self._last[k] = values[rows[-1], k]
        return values


class Series:
    """Columns over time in a file, whole turns taken out, a bounded part of it held."""

    def __init__(self, table: Table, columns: Sequence[str], clock: Clock, progress: bool, sign: float = 1.0):
        names = list(dict.fromkeys([time_of(table), *columns]))
        at = [names.index(name) for name in columns]
        self.clock, self.curves = clock, Reducer(len(columns))
        self.table = table
        self._parts = self._read(table, names, at, progress, sign)
        self._held = (np.empty(0), np.empty((0, len(columns))))

    def _read(self, table: Table, names: list[str], at: list[int], progress: bool, sign: float) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        unwrapped = Unwrapper(len(at))
        factor = sign * (1.0 if table.degrees else np.degrees(1.0))
        for piece in table.pieces(names, progress):
            rows = self.clock.use(piece[:, 0])
            values = unwrapped(factor * piece[np.ix_(rows, at)])
            self.curves.add(piece[rows, 0], values)
            yield piece[rows, 0], values
            if self.clock.over:
                return

    def __iter__(self) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        return self._parts

    def at(self, t_s: np.ndarray) -> np.ndarray:
        """(n, columns) between the rows; NaN outside, in gaps and where a row beside is NaN. Times of later calls are later."""
        times, values = self._held
        while len(t_s) and (len(times) == 0 or times[-1] < t_s[-1]):
            part = next(self._parts, None)
            if part is None:
                break
            keep = max(int(np.searchsorted(times, t_s[0], "right")) - 1, 0)
            times, values = np.concatenate([times[keep:], part[0]]), np.concatenate([values[keep:], part[1]])
        self._held = times, values
        if len(times) == 0 or len(t_s) == 0:
            return np.full((len(t_s), values.shape[1]), np.nan)
        found = np.column_stack([np.interp(t_s, times, column, np.nan, np.nan) for column in values.T])
        if len(times) > 1:
            after = np.clip(np.searchsorted(times, t_s), 1, len(times) - 1)
            steps = np.diff(times)
            apart = steps[after - 1] > GAP_STEPS * np.median(steps)
            found[apart & (times[after] != t_s) & (times[after - 1] != t_s)] = np.nan
        return found


class Difference:
    """Angle less reference: a curve, and exact sums of all rows."""

    def __init__(self, columns: int):
        self.curves = Reducer(columns)
        self._count, self._sum, self._squares = np.zeros(columns), np.zeros(columns), np.zeros(columns)

    def add(self, t_s: np.ndarray, values: np.ndarray) -> None:
        self.curves.add(t_s, values)
        self._count += np.isfinite(values).sum(axis=0)
        self._sum += np.nansum(values, axis=0)
        self._squares += np.nansum(values**2, axis=0)

    def mean(self, k: int) -> float:
        """NaN where the two have no time in common."""
        return float(self._sum[k] / self._count[k]) if self._count[k] else np.nan

    def rms(self, k: int, shift: float) -> float:
        """Of the differences less a constant."""
        mean = self.mean(k)
        return float(np.sqrt(max(self._squares[k] / self._count[k] - 2.0 * shift * mean + shift**2, 0.0)))

    def words(self, k: int, shift: float) -> str:
        """What a legend says of the differences less a constant."""
        mean = self.mean(k) - shift
        about = "" if abs(mean) < 0.05 else f" ({self.rms(k, self.mean(k)):.1f} about the mean of {mean:.1f})"
        return f"rms {self.rms(k, shift):.1f} deg{about}"


@dataclass
class Angles:
    """What is drawn."""

    names: list[str]
    series: Series
    reference: Series | None
    references: dict[int, str]  # angle to its column
    difference: Difference
    shifts: list[float]  # taken off each angle, deg
    negated: bool = False  # the reference
    good_to: GoodTo | None = None

    def where(self, k: int) -> int:
        """The column of the k-th angle in reference and difference."""
        return list(self.references).index(k)


def read_angles(path: Path, columns: Sequence[str], reference: tuple[Path | None, Sequence[str]], part_s: tuple[float, float],
                zero: bool, negate: bool = False) -> Angles:
    """A reference is looked for in the file given, else beside the angles in their own. zero: mean differences are taken off; negate:
    the reference changes its sign."""
    table = Table(path)
    names = angle_columns(table, columns)
    reference_table = Table(reference[0]) if reference[0] else table
    references = reference_columns(reference_table, names, reference[1])
    if not references and reference[0]:
        raise RefusedError(reference[0], "no column such as ref_flexion_deg; name it with --reference-column",
                           reference_table.header_line)
    series = Series(table, names, Clock(*part_s), True)
    beside = Series(reference_table, list(references.values()), Clock(*part_s), False, -1.0 if negate else 1.0) if references else None
    difference, total = Difference(len(references)), Difference(len(references))
    for t_s, values in series:
        if beside:
            truth = beside.at(t_s)
            difference.add(t_s, values[:, list(references)] - truth)
            total.add(t_s, values[:, list(references)] + truth)
    if np.isnan(series.clock.begin_s):
        raise series.clock.none_used(path, "row")
    for curves in (series, beside):
        for _ in curves or ():  # the rest of a reference that is longer
            pass
        if curves:
            curves.curves.finish()
    difference.curves.finish()
    shifts = [0.0] * len(names)
    for column, k in enumerate(references):
        mean = difference.mean(column)
        if np.isfinite(mean):  # whole turns mean nothing
            shifts[k] = mean if zero else TURN_DEG * round(mean / TURN_DEG)
        if runs_against(difference, total, column):
            print(f"{path}: {names[k]} and its reference, {references[k]}, count in opposite directions: --negate-reference turns the reference",
                  file=sys.stderr)
    return Angles(names, series, beside, references, difference, shifts, negated=negate)


def runs_against(difference: Difference, total: Difference, column: int) -> bool:
    """True if an angle and its reference make one curve when their signs differ."""
    spreads = [of.rms(column, of.mean(column)) for of in (difference, total) if np.isfinite(of.mean(column))]
    return len(spreads) == 2 and spreads[1] < OPPOSITE_SHARE * spreads[0]


def told_angles_good_to(path: Path) -> GoodTo | None:
    """From the .json beside the reference."""
    beside = path.with_suffix(".json")
    value = number_of(beside, facts_of(beside), ANGLES_GOOD_TO) if beside.is_file() else None
    return None if value is None else GoodTo(value, f"{value:g} deg")


# The panels.

def draw_angle(panel: Axes, angles: Angles, k: int, style: Style) -> None:
    name = plain(angles.names[k]).replace("_", " ")
    panel.set_ylabel(f"{name}, deg")
    nothing = f"no row has a value of {angles.names[k]}: where jointcal is not ready, it writes none"
    handles = []
    t_s, values = angles.series.curves.trace(k)
    if np.isfinite(values).any():
        panel.plot(t_s, values - angles.shifts[k], color=COLOURS[k], linewidth=1.2 * style.scale, zorder=2.2)
        shift = f" {'less' if angles.shifts[k] > 0.0 else 'plus'} {abs(angles.shifts[k]):.1f} deg" if angles.shifts[k] else ""
        handles.append(line_handle(style, f"{name}{shift}", color=COLOURS[k]))
    if k in angles.references:  # below and broader: where both agree, the angle lies inside
        t_s, truth = angles.reference.curves.trace(angles.where(k))
        panel.plot(t_s, truth, color="black", linewidth=2.2 * style.scale, zorder=2.1)
        if np.isfinite(truth).any():
            handles.append(line_handle(style, f"reference ({'-' if angles.negated else ''}{angles.references[k]})", color="black", linewidth=2.2 * style.scale))
    if not handles:
        draw_empty(panel, nothing, style)
        return
    panel.grid(True)
    if k in angles.references:
        set_legend(panel, handles, "" if np.isfinite(values).any() else style.wrapped(nothing))


def draw_difference(panel: Axes, angles: Angles, style: Style) -> None:
    panel.set_ylabel("angle less\nreference, deg")
    handles = []
    for column, k in enumerate(angles.references):
        t_s, values = angles.difference.curves.trace(column)
        if np.isfinite(values).any():
            panel.plot(t_s, values - angles.shifts[k], color=COLOURS[k], linewidth=1.1 * style.scale)
            name = plain(angles.names[k]).replace("_", " ")
            handles.append(line_handle(style, f"{name}: {angles.difference.words(column, angles.shifts[k])}", color=COLOURS[k]))
    if not handles:
        draw_empty(panel, why_no_difference(angles), style)
        return
    if angles.good_to:
        handles.append(draw_band(panel, -angles.good_to.value, angles.good_to.value, f"±{angles.good_to.words}"))
    panel.axhline(0.0, color="black", linewidth=0.8 * style.scale)
    panel.grid(True)
    set_legend(panel, handles)


def why_no_difference(angles: Angles) -> str:
    if not angles.series.curves.any_finite():
        return "nothing to compare: there are no angles"
    if not angles.reference.curves.any_finite():
        return "nothing to compare: the reference is empty"
    ours, theirs = angles.series.clock, angles.reference.clock
    if theirs.begin_s > ours.end_s or theirs.end_s < ours.begin_s:
        return (f"no time in common: angles {ours.begin_s:.1f} to {ours.end_s:.1f} s, "
                f"reference {theirs.begin_s:.1f} to {theirs.end_s:.1f} s")
    return "nothing to compare: nowhere are both an angle and a reference"


def draw_angles(angles: Angles, title: str, style: Style) -> plt.Figure:
    """The caller has entered the style's context."""
    count = len(angles.names) + bool(angles.references)
    kind = "wide" if style.width_mm > 200.0 else "double" if style.width_mm > 120.0 else "single"
    figure, panels = plt.subplots(count, 1, sharex=True, squeeze=False, layout="constrained",
                                  figsize=style.inches(PANEL_MM[kind] * (count + 0.4)))
    panels = panels[:, 0]
    for k in range(len(angles.names)):
        draw_angle(panels[k], angles, k, style)
    if angles.references:
        draw_difference(panels[-1], angles, style)
    link_times(panels, angles.series.clock)
    draw_title(figure, title, style)
    figure.align_ylabels(panels)
    lay_out(figure, style)
    return figure
