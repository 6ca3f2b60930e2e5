"""Tables of numbers, read in pieces: CSV by the columns' names, and OpenSim's .sto."""

from __future__ import annotations

import csv
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TextIO

import numpy as np

PIECE_BYTES = 1 << 20
HEADER_BYTES = 1 << 20
BAR_WIDTH = 40
LONG_AGO_S = 1e6
# What is often given in place of a text file, by its first bytes.
MAGIC = ((b"\x1f\x8b", "compressed by gzip; unpack it first"),
         (b"PK\x03\x04", "a zip archive or an .xlsx workbook; save it as CSV"), (b"\xff\xfe", "UTF-16 text; save it as UTF-8"),
         (b"\xfe\xff", "UTF-16 text; save it as UTF-8"))


class RefusedError(Exception):
    """An input that cannot be used; the text is what the user reads: FILE:LINE:COLUMN: what is wrong."""

    def __init__(self, place: object, what: str, line: int = 0, column: int = 0):
        parts = [str(place), *(str(number) for number in (line, column) if number > 0)]
        super().__init__(f"{':'.join(parts)}: {what}")


class Progress:
    """A bar on standard error, on a terminal only; as the program's own."""

    def __init__(self, total: int, stream: TextIO | None = None):
        self._stream = stream or sys.stderr
        self._total = total if self._stream.isatty() else 0
        self._percent = -1

    def show(self, done: int) -> None:
        if self._total == 0:
            return
        percent = int(100.0 * min(done, self._total) / self._total)
        if percent != self._percent:
            self._percent = percent
            bar = "".join("#" if 100 * k < percent * BAR_WIDTH else "." for k in range(BAR_WIDTH))
            self._stream.write(f"\r[{bar}] {percent:3d} %")
            self._stream.flush()

    def clear(self) -> None:
        if self._percent >= 0:
            self._stream.write(f"\r{'':{BAR_WIDTH + 8}}\r")
            self._stream.flush()
            self._percent = -1


def reason_of(error: OSError) -> str:
    return error.strerror or str(error)


class Table:
    """A file of numbers with one line of names; nothing but the current piece is held."""

    def __init__(self, path: Path):
        self.path = path
        self.degrees = True  # a .sto file may be in radians
        try:
            with path.open("rb") as file:
                head = file.read(4096)
        except OSError as error:
            raise RefusedError(path, reason_of(error)) from None
        if not head:
            raise RefusedError(path, "the file is empty")
        for magic, what in MAGIC:
            if head.startswith(magic):
                raise RefusedError(path, what)
        if b"\0" in head:
            raise RefusedError(path, "a zero byte: this is not a text file")
        self.separator = "," if path.suffix.lower() != ".sto" else "\t"
        with self._open() as file:
            self.header_line = self._skip_sto_head(file) + 1
            header = file.readline(HEADER_BYTES)
        if header.lower().startswith("sep="):
            raise RefusedError(path, f"'{header.strip()}' stands where the columns' names belong; take this line out", 1)
        self.names = [name.strip() for name in next(csv.reader([header], delimiter=self.separator), [])]
        if not any(self.names):
            raise RefusedError(path, "there is no line with the columns' names", self.header_line)

    def _open(self) -> TextIO:
        return self.path.open(encoding="utf-8-sig", errors="replace", newline="")

    def _skip_sto_head(self, file: TextIO) -> int:
        """Lines before the names."""
        if self.separator == ",":
            return 0
        for number, line in enumerate(iter(lambda: file.readline(HEADER_BYTES), ""), 1):
            text = line.strip().lower()
            if text == "endheader":
                return number
            if text.startswith("indegrees"):
                self.degrees = not text.endswith("no")
        raise RefusedError(self.path, "no line endheader: this is not a .sto file")

    def need(self, names: Sequence[str], advice: str = "") -> None:
        missing = [name for name in names if name not in self.names]
        if missing:
            other = len(self.names) == 1 and any(mark in self.names[0] for mark in ";\t|")
            advice = " (cells must be separated by commas)" if other else advice
            raise RefusedError(self.path, f"missing column{'s' if len(missing) > 1 else ''} {', '.join(missing)}{advice}",
                               self.header_line)

    def pieces(self, names: Sequence[str], progress: bool = True) -> Iterator[np.ndarray]:
        """Yield (n, len(names)); empty cells are NaN."""
        self.need(names)
        columns = [self.names.index(name) for name in names]
        bar = Progress(self.path.stat().st_size if progress else 0)
        rows = 0
        try:
            with self._open() as file:
                done = sum(len(file.readline()) for _ in range(self.header_line))
                number = self.header_line + 1
                while lines := file.readlines(PIECE_BYTES):
                    piece = self._numbers(lines, columns, number)
                    rows += len(piece)
                    number += len(lines)
                    done += sum(map(len, lines))  # characters, which are bytes but in comments
                    bar.show(done)
                    yield piece
        finally:
            bar.clear()
        if rows == 0:
            raise RefusedError(self.path, "there is no row below the columns' names", self.header_line)

    def _numbers(self, lines: list[str], columns: list[int], first: int) -> np.ndarray:
        separators = len(self.names) - 1
        if all(line.count(self.separator) == separators for line in lines):
            try:
                return np.loadtxt(lines, delimiter=self.separator, usecols=columns, ndmin=2, comments=None)
            except ValueError:
                pass  # empty cells, quotes or text: row by row
        return self._row_by_row(lines, columns, first)

    def _row_by_row(self, lines: list[str], columns: list[int], first: int) -> np.ndarray:
        rows = []
        for number, cells in enumerate(csv.reader(lines, delimiter=self.separator), first):
            if not cells or (len(cells) == 1 and not cells[0].strip()):
                continue
            if len(cells) < len(self.names):
                raise RefusedError(self.path, f"short line: {len(cells)} of {len(self.names)} cells", number)
            if len(cells) > len(self.names):
                raise RefusedError(self.path, f"long line: {len(cells)} cells where the header has {len(self.names)}", number)
            rows.append([self._number(cells, column, number) for column in columns])
        return np.array(rows, float).reshape(-1, len(columns))

    def _number(self, cells: list[str], column: int, line: int) -> float:
        text = cells[column].strip()
        try:
            return float(text) if text else float("nan")
        except ValueError:
            if [cell.strip() for cell in cells] == self.names:
                raise RefusedError(self.path, "a second header line", line) from None
            at = 1 + sum(len(cell) + 1 for cell in cells[:column])
            short = text if len(text) <= 28 else f"{text[:28]}..."
            raise RefusedError(self.path, f"{self.names[column]}: '{short}' is not a number", line, at) from None


class Clock:
    """Tells which rows to use: their time is finite, increases and lies in the part to be drawn."""

    def __init__(self, from_s: float = -np.inf, until_s: float = np.inf):
        self.from_s, self.until_s = from_s, until_s
        self.begin_s = self.end_s = np.nan  # of the rows used
        self.untimely = 0  # rows whose time is none, or does not increase
        self.outside = 0
        self._last_s = -np.inf

    def use(self, t_s: np.ndarray) -> np.ndarray:
        """Indices of the rows to use."""
        known = np.where(np.isfinite(t_s), t_s, -np.inf)
        before = np.maximum.accumulate(np.concatenate([[self._last_s], known]))
        timely = known > before[:-1]
        self._last_s = float(before[-1])
        inside = (t_s >= self.from_s) & (t_s <= self.until_s)
        self.untimely += int(np.count_nonzero(~timely))
        self.outside += int(np.count_nonzero(timely & ~inside))
        rows = np.flatnonzero(timely & inside)
        if len(rows):
            self.begin_s = float(t_s[rows[0]]) if np.isnan(self.begin_s) else self.begin_s
            self.end_s = float(t_s[rows[-1]])
        return rows

    @property
    def zero_s(self) -> float:
        """Times are drawn and told from here on: clocks that began long ago are counted from the first row used."""
        return float(np.floor(self.begin_s)) if abs(self.begin_s) > LONG_AGO_S else 0.0

    @property
    def over(self) -> bool:
        """Nothing that follows can be inside."""
        return self._last_s > self.until_s

    def none_used(self, path: Path, what: str) -> RefusedError:
        """Why no row was used."""
        if self.outside == 0:
            return RefusedError(path, f"no {what} has a time")
        part = f"from {self.from_s:g} s" if np.isfinite(self.from_s) else ""
        part += f"{' ' if part else ''}until {self.until_s:g} s" if np.isfinite(self.until_s) else ""
        return RefusedError(path, f"no {what} in the part asked for, {part}")
