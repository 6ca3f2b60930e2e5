"""What panels share: notes in empty ones, log axes with numbers, bands, legends that stand outside."""

from __future__ import annotations

import math
import warnings
from collections.abc import Sequence

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, MaxNLocator, NullFormatter, NullLocator

from .reading import Clock
from .style import BAND, NOTE, Style, too_small

DASHED = (0, (4, 1.5))
DOTTED = (0, (1, 1.5))
MOST_TICKS = 7


def line_handle(style: Style, label: str, **how: object) -> Line2D:
    return Line2D([], [], label=label, **{"linewidth": 1.5 * style.scale, **how})


def draw_empty(panel: Axes, why: str, style: Style) -> None:
    """An axis that measures nothing has no numbers."""
    panel.set_yscale("linear")
    panel.yaxis.set_major_locator(NullLocator())
    panel.yaxis.set_minor_locator(NullLocator())
    panel.text(0.5, 0.5, style.wrapped(why, 0.65), transform=panel.transAxes, ha="center", va="center", color=NOTE)


def draw_title(figure: plt.Figure, title: str, style: Style) -> None:
    """Lines that the title brings are kept."""
    if title:
        figure.suptitle(title if "\n" in title else style.wrapped(title), fontsize=plt.rcParams["axes.titlesize"])


def draw_band(panel: Axes, low: float, high: float, words: str) -> Patch:
    """Grey where the reference says nothing; returns what the legend shows."""
    panel.axhspan(low, high, facecolor=BAND, edgecolor="none", zorder=0.5, gid="reference band")
    return Patch(facecolor=BAND, edgecolor="none", label=f"reference good to {words}")


def log_ticks(low: float, high: float, most: int = MOST_TICKS) -> list[float]:
    """At least three round numbers between two limits, however near they are."""
    begin, end = math.floor(math.log10(low)), math.ceil(math.log10(high))
    for heads in ((1,), (1, 3), (1, 2, 5), (1, 2, 3, 5, 7)):
        ticks = [head * 10.0**decade for decade in range(begin, end + 1) for head in heads]
        ticks = [tick for tick in ticks if low <= tick <= high]
        if len(ticks) >= 3:
            return ticks[::math.ceil(len(ticks) / most)]
    for count in range(3, 2 * most):
        ticks = MaxNLocator(nbins=count, steps=[1, 2, 2.5, 5, 10]).tick_values(low, high)
        ticks = [float(tick) for tick in ticks if low <= tick <= high]
        if len(ticks) >= 3:
            break
    return ticks


def use_log_axis(panel: Axes, low: float, high: float) -> None:
    panel.set_yscale("log")
    panel.set_ylim(low, high)
    panel.yaxis.set_major_locator(FixedLocator(log_ticks(low, high)))
    panel.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.6g}"))
    panel.yaxis.set_minor_locator(LogLocator(subs="all", numticks=99))
    panel.yaxis.set_minor_formatter(NullFormatter())


def log_limits(values: np.ndarray, least_factor: float) -> tuple[float, float]:
    """Around positive values; at least a factor apart, so that noise does not fill the panel."""
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    middle, half = math.sqrt(low * high), max(math.sqrt(high / low) * 1.15, math.sqrt(least_factor))
    return middle / half, middle * half


def link_times(panels: Sequence[Axes], clock: Clock) -> None:
    """One axis of time for all panels, with numbers below the last one."""
    begin_s, zero_s = clock.begin_s, clock.zero_s
    end_s = clock.end_s if clock.end_s > begin_s else begin_s + 1.0
    for panel in panels:
        panel.set_xlim(begin_s, end_s)
    panels[-1].set_xlabel("time, s")
    if zero_s:
        ticks = MaxNLocator(nbins=7, steps=[1, 2, 5, 10]).tick_values(begin_s - zero_s, end_s - zero_s)
        panels[-1].xaxis.set_major_locator(FixedLocator([zero_s + tick for tick in ticks if begin_s <= zero_s + tick <= end_s]))
        panels[-1].xaxis.set_major_formatter(FuncFormatter(lambda t_s, _: f"{t_s - zero_s:.5g}"))
        panels[-1].set_xlabel(f"time since {zero_s:.0f} s, s")


def set_legend(panel: Axes, handles: Sequence[Artist], head: str = "") -> None:
    """Remembered until the layout is known."""
    panel.legend_handles, panel.legend_head = list(handles), head


def lay_out(figure: plt.Figure, style: Style) -> None:
    """Put each legend above its panel, never on it, in as many columns as its width allows."""
    with warnings.catch_warnings():
        warnings.filterwarnings("error", "constrained_layout not applied")
        try:
            figure.draw_without_rendering()
            for panel in figure.axes:
                if getattr(panel, "legend_handles", None):
                    place_legend(panel)
            figure.draw_without_rendering()
        except UserWarning:
            raise too_small(style) from None


def place_legend(panel: Axes) -> None:
    handles = panel.legend_handles
    renderer = panel.figure.canvas.get_renderer()
    for rows in range(1, len(handles) + 1):
        columns = math.ceil(len(handles) / rows)  # filled column by column
        legend = panel.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=columns, borderaxespad=0.15,
                              title=panel.legend_head or None, title_fontsize=plt.rcParams["legend.fontsize"], alignment="left")
        if legend.get_window_extent(renderer).width <= panel.bbox.width:
            return
