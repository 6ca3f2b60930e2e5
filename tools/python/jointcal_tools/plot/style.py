"""What a paper prescribes: size, font and file format of a figure; and colours that everybody can tell apart."""

from __future__ import annotations

import difflib
import re
import textwrap
import warnings
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import matplotlib.pyplot as plt
from matplotlib.font_manager import FontProperties, findfont, fontManager

from .reading import RefusedError, reason_of

MM_PER_INCH = 25.4
MM = {"mm": 1.0, "cm": 10.0, "in": MM_PER_INCH}
# Widths that most journals have: 84 to 90 mm for one column, 174 to 190 mm for two.
COLUMN_MM = {"single": 88.0, "double": 180.0}
SCREEN_MM = 254.0
FONT_SIZE, COLUMN_FONT_SIZE = 10.0, 8.0
DPI, COLUMN_DPI = 130, 300
FORMATS = ("png", "pdf", "svg")
# Okabe and Ito's colours, told apart with any kind of colour vision.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7")
BAND = "#D9D9D9"  # of a reference
NOTE = "#555555"


@dataclass(frozen=True)
class Style:
    width_mm: float
    height_mm: float | None  # None: as the figure needs
    font: str | None
    font_size: float
    dpi: int

    @property
    def scale(self) -> float:
        """Of lines, beside those of a figure on a screen."""
        return self.font_size / FONT_SIZE

    def inches(self, height_mm: float) -> tuple[float, float]:
        """Width and height; the height given if none was asked for."""
        return self.width_mm / MM_PER_INCH, (self.height_mm or height_mm) / MM_PER_INCH

    def wrapped(self, text: str, share: float = 0.8) -> str:
        """In lines of that share of the figure's width; a letter is half as wide as it is high."""
        letter_mm = 0.5 * self.font_size * MM_PER_INCH / 72.0
        return textwrap.fill(text, max(20, int(share * self.width_mm / letter_mm)))

    def context(self) -> AbstractContextManager:
        """Within it matplotlib draws in this style."""
        settings = {
            "font.size": self.font_size, "axes.titlesize": 1.05 * self.font_size, "axes.labelsize": self.font_size,
            "xtick.labelsize": 0.9 * self.font_size, "ytick.labelsize": 0.9 * self.font_size,
            "legend.fontsize": 0.9 * self.font_size, "legend.frameon": False, "legend.handlelength": 1.9,
            "legend.columnspacing": 1.4, "legend.handletextpad": 0.5, "legend.labelspacing": 0.25, "legend.borderpad": 0.1,
            "axes.linewidth": 0.8 * self.scale, "grid.linewidth": 0.6 * self.scale, "grid.color": "#CCCCCC",
            "axes.axisbelow": True, "hatch.linewidth": 0.6 * self.scale, "lines.solid_capstyle": "butt",
            "figure.constrained_layout.h_pad": 0.03 * self.scale, "figure.constrained_layout.w_pad": 0.03 * self.scale,
            "pdf.fonttype": 42,  # journals refuse type 3 fonts
            "svg.fonttype": "none",  # text stays text, to be edited
            "svg.hashsalt": "jointcal",  # the same figure gives the same file
        }
        if self.font:
            settings["font.family"] = [self.font]
        return matplotlib.rc_context(settings)


def parse_size(text: str) -> tuple[float, float]:
    """Width and height in mm from WxH and a unit."""
    match = re.fullmatch(r"([0-9]*\.?[0-9]+) *[x×X] *([0-9]*\.?[0-9]+) *(mm|cm|in)", text.strip())
    if not match:
        raise RefusedError("--size", f"'{text}' is not WIDTHxHEIGHT with mm, cm or in, such as 8.8x12cm")
    width, height = (float(match[k]) * MM[match[3]] for k in (1, 2))
    if not (20.0 <= width <= 1200.0 and 20.0 <= height <= 1200.0):
        raise RefusedError("--size", f"'{text}': width and height must be 20 to 1200 mm")
    return width, height


def check_font(name: str) -> str:
    try:
        findfont(FontProperties(family=name), fallback_to_default=False)
    except ValueError:
        there = sorted({font.name for font in fontManager.ttflist})
        near = difflib.get_close_matches(name, there, 5, 0.4)
        raise RefusedError("--font", f"'{name}' is not installed; there {'is' if len(near) == 1 else 'are'} for example "
                           f"{', '.join(near or there[:5])}") from None
    return name


def make_style(column: str | None, size: str | None, font: str | None, font_size: float | None, dpi: int | None) -> Style:
    width_mm, height_mm = parse_size(size) if size else (COLUMN_MM.get(column, SCREEN_MM), None)
    paper = column is not None or size is not None
    chosen = font_size or (COLUMN_FONT_SIZE if paper else FONT_SIZE)
    if not 3.0 <= chosen <= 40.0:
        raise RefusedError("--font-size", f"{chosen:g} is not between 3 and 40 points")
    if dpi is not None and not 30 <= dpi <= 2400:
        raise RefusedError("--dpi", f"{dpi} is not between 30 and 2400")
    return Style(width_mm, height_mm, check_font(font) if font else None, chosen, dpi or (COLUMN_DPI if paper else DPI))


def check_out(path: Path) -> Path:
    """Before anything is read: a figure can be written there."""
    if path.suffix.lower().lstrip(".") not in FORMATS:
        raise RefusedError(path, "the name must end in .png, .pdf or .svg")
    if not path.parent.is_dir():
        raise RefusedError(path.parent, "there is no such folder")
    return path


def save(figure: plt.Figure, path: Path, style: Style) -> None:
    """The same figure gives the same bytes: no date is written."""
    kind = path.suffix.lower().lstrip(".")
    dates = {"png": {}, "pdf": {"CreationDate": None}, "svg": {"Date": None}}
    try:
        with warnings.catch_warnings():
            warnings.filterwarnings("error", "constrained_layout not applied")
            figure.savefig(path, dpi=style.dpi, metadata={**dates[kind], "Creator" if kind != "png" else "Software": "jointcal"})
    except UserWarning:
        path.unlink(missing_ok=True)
        raise too_small(style) from None
    except OSError as error:
        raise RefusedError(path, reason_of(error)) from None


def too_small(style: Style) -> RefusedError:
    return RefusedError("--size", f"the panels do not fit at {style.font_size:g} points: a larger figure or a smaller --font-size")
