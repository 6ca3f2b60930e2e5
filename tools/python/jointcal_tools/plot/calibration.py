"""The figure of a calibration over time: accuracy, status, what else is told, how the segments turn."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.patches import Patch

from .joints import Joint
from .motion import Motion
from .panels import (DASHED, DOTTED, draw_band, draw_empty, draw_title, lay_out, line_handle, link_times, log_limits, set_legend,
                     use_log_axis)
from .style import COLOURS, Style
from .told import Told

SMOOTH_S = 0.5
# Colour and hatch; a status differs from others in hatch, too.
STATUS = {"collecting": ("#DDDDDD", ""), "ambiguous": ("#F0C75E", "////"), "ready": ("#35B48C", ""), "moved": ("#CC79A7", "xxxx")}
OTHER_STATUS = ("#FFFFFF", "....")
READY = "#00664A"
PANEL_HEIGHTS = (3.2, 0.35, 1.2, 1.6)
HEIGHT_MM = {"wide": 215.0, "double": 150.0, "single": 135.0}


def draw_curves(panel: Axes, told: Told, style: Style) -> tuple[np.ndarray, list[Artist], list[str]]:
    """Errors and bounds; returns the values shown, the legend's entries, and what has no bound."""
    errors = told.truth is not None
    shown, handles, unbounded = [], [], []
    for k, label in enumerate(told.joint.labels):
        colour = COLOURS[k]
        if errors:
            t_s, values = told.errors.trace(k)
            panel.plot(t_s, np.maximum(values, 1e-3), color=colour, linewidth=1.5 * style.scale)
            shown.append(values)
            handles.append(line_handle(style, label, color=colour))
        t_s, values = told.bounds.trace(k)
        panel.plot(t_s, values, color=colour, linestyle=DASHED, linewidth=1.5 * style.scale)
        shown.append(values)
        unbounded += [] if np.isfinite(values).any() else [label]
        if not errors and label not in unbounded:
            handles.append(line_handle(style, f"stated 95 % bound, {label}", color=colour, linestyle=DASHED))
    values = np.concatenate(shown)
    if errors:
        handles.append(line_handle(style, "error", color="black"))
    if errors and told.bounds.any_finite():
        handles.append(line_handle(style, "stated 95 % bound", color="black", linestyle=DASHED))
    return values[np.isfinite(values)], handles, unbounded


def draw_accuracy(panel: Axes, told: Told, max_bound: float, style: Style) -> None:
    joint, good_to = told.joint, told.truth.good_to if told.truth else None
    values, handles, unbounded = draw_curves(panel, told, style)
    handles.append(line_handle(style, f"ready below {max_bound:g} {joint.unit}", color="black", linestyle=DOTTED))
    panel.set_ylabel(f"{'angle' if joint.directions else 'distance'}, {joint.unit}")
    if len(values) == 0:
        draw_empty(panel, f"nothing to draw: {no_bound(unbounded, told)}", style)
        return
    low = min(max(float(np.quantile(values, 0.01)) / 1.5, 1e-3), max_bound / 10.0)
    low = min(low, good_to.value / 3.0) if good_to else low
    panel.axhline(max_bound, color="black", linewidth=style.scale, linestyle=DOTTED)
    use_log_axis(panel, low, min(1.45 * joint.known, 2.0 * max(float(values.max()), max_bound)))
    if good_to:
        handles.append(draw_band(panel, low, good_to.value, good_to.words))
    handles += draw_wrong_pairing(panel, told)
    set_legend(panel, handles, style.wrapped(no_bound(unbounded, told)) if unbounded else "")
    panel.grid(True, which="major")


def no_bound(labels: list[str], told: Told) -> str:
    of = "" if len(labels) == len(told.joint.labels) else f" of {' and '.join(labels)}"
    return f"no bound was stated{of} ({told.why_nothing()})"


def draw_wrong_pairing(panel: Axes, told: Told) -> list[Patch]:
    """A black bar along the top of the panel, where no curve comes."""
    spans = told.wrong_pairing.of(True)
    if not spans:
        return []
    panel.broken_barh(spans, (0.975, 0.025), transform=panel.get_xaxis_transform(), color="black")
    return [Patch(facecolor="black", label="sign pairing wrong")]


def draw_status(panel: Axes, told: Told, style: Style) -> None:
    for status in told.status.values():
        colour, hatch = STATUS.get(status, OTHER_STATUS)
        panel.broken_barh(told.status.of(status), (0.0, 1.0), facecolor=colour, hatch=hatch, edgecolor="#666666", linewidth=0.0)
    panel.set_ylim(0.0, 1.0)
    panel.set_yticks([0.5], ["status"])
    panel.tick_params(axis="y", length=0.0)
    handles = [Patch(facecolor=STATUS.get(name, OTHER_STATUS)[0], hatch=STATUS.get(name, OTHER_STATUS)[1], edgecolor="#666666",
                     linewidth=0.5 * style.scale, label=name) for name in told.status.values()]
    if told.ready_s:
        first_s = told.ready_s[0] - told.zero_s
        handles.append(line_handle(style, f"first ready at {first_s:.1f} s", color=READY, linewidth=style.scale))
    set_legend(panel, handles)


def draw_others(panel: Axes, told: Told, style: Style) -> None:
    """What the joint tells besides vectors."""
    joint, handles, shown = told.joint, [], []
    panel.set_ylabel(joint.others_label)
    for k, other in enumerate(joint.others):
        colour = COLOURS[k] if len(joint.others) > 1 else "#222222"
        t_s, values = told.others.trace(k)
        values = np.where(values > 0.0, values, np.nan) if joint.others_log else values
        panel.plot(t_s, values, color=colour, linewidth=1.3 * style.scale)
        shown.append(values[np.isfinite(values)])
        if len(shown[-1]):
            handles.append(line_handle(style, other.label, color=colour))
    values = np.concatenate(shown)
    if len(values) == 0:
        names = " and ".join(other.label for other in joint.others)
        draw_empty(panel, f"no {names} was told ({told.why_nothing()})", style)
        return
    if joint.hinge:
        panel.axhline(1.0, color="black", linewidth=0.8 * style.scale, linestyle=DOTTED)
        use_log_axis(panel, min(0.8, max(float(values.min()) / 1.3, 1e-3)), max(10.0, 1.5 * float(values.max())))
    elif joint.others_log:
        use_log_axis(panel, *log_limits(values, 4.0))
    if len(joint.others) > 1:
        set_legend(panel, handles)
    panel.grid(True, which="major")


def draw_excitation(panel: Axes, motion: Motion, joint: Joint, style: Style) -> None:
    begin_s, end_s = motion.clock.begin_s, motion.clock.end_s
    window_s = max(SMOOTH_S, (end_s - begin_s) / 200.0)
    panel.set_ylabel(f"rate, rad/s\n({window_s:.3g} s mean)")
    if not motion.rates.any_finite():
        draw_empty(panel, "no row has finite angular rates", style)
        return
    t_s, rates = motion.rates.means(window_s)
    handles = []
    for k in range(joint.sensors):
        panel.plot(t_s, rates[:, k], color=COLOURS[k], linewidth=1.2 * style.scale)
        handles.append(line_handle(style, f"sensor {k + 1}", color=COLOURS[k]))
    if joint.hinge:
        panel.fill_between(t_s, rates[:, -1], color="#AAAAAA", linewidth=0.0, zorder=1.5)
        handles.append(Patch(facecolor="#AAAAAA", label="difference, which tells the axes"))
    panel.set_ylim(bottom=0.0)
    panel.grid(True)
    set_legend(panel, handles)


def default_height_mm(style: Style) -> float:
    if style.width_mm > 200.0:
        return HEIGHT_MM["wide"]
    return HEIGHT_MM["double" if style.width_mm > 120.0 else "single"]


def draw_calibration(told: Told, motion: Motion, max_bound: float, title: str, style: Style) -> plt.Figure:
    """The caller has entered the style's context."""
    figure, panels = plt.subplots(4, 1, sharex=True, figsize=style.inches(default_height_mm(style)), layout="constrained",
                                  height_ratios=PANEL_HEIGHTS)
    draw_accuracy(panels[0], told, max_bound, style)
    draw_status(panels[1], told, style)
    draw_others(panels[2], told, style)
    draw_excitation(panels[3], motion, told.joint, style)
    link_times(panels, motion.clock)
    for panel in panels:
        for ready_s in told.ready_s:
            panel.axvline(ready_s, color=READY, linewidth=0.9 * style.scale, zorder=1.6)
    draw_title(figure, title, style)
    figure.align_ylabels(panels)
    lay_out(figure, style)
    return figure


def default_title(recording: str, told: Told) -> str:
    end = "at the end" if told.complete() else f"at {told.end_s:.1f} s"
    return f"{recording}: {told.joint.title}, {told.last.get('engine')} engine; {told.last['status']} {end}"
