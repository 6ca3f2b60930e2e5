"""Curves over time in a bounded number of points, however many rows come.

Rows are gathered in buckets of equally many rows. When there is no room for another bucket,
neighbours are joined and buckets hold twice as many rows from then on. A bucket keeps sum, lowest
and highest value and when these came, so that no peak is lost: a line through lowest and highest
values of 2,000 buckets looks on paper as the line through all rows.
"""

from __future__ import annotations

import numpy as np

BUCKETS = 2000
GAP_S = 1.0  # a line is broken where nothing came for so long, and for ten times as long as usually


class Reducer:
    """`curves` curves with common times; between BUCKETS and 2 * BUCKETS points each once there are so many rows."""

    def __init__(self, curves: int):
        self.rows_per_bucket = 1
        self._room = 2 * BUCKETS
        self._used = 0
        self._span_s = np.empty((self._room, 2))  # time of the first and last row
        self._count = np.empty((self._room, curves))  # finite values
        self._sum = np.empty((self._room, curves))
        self._low = np.empty((self._room, curves))
        self._low_s = np.empty((self._room, curves))
        self._high = np.empty((self._room, curves))
        self._high_s = np.empty((self._room, curves))
        self._rest_s = np.empty(0)  # rows that fill no bucket yet
        self._rest = np.empty((0, curves))

    def add(self, t_s: np.ndarray, values: np.ndarray) -> None:
        """Rows with times (n,) that increase and values (n, curves), of which any may be NaN."""
        t_s, values = np.concatenate([self._rest_s, t_s]), np.concatenate([self._rest, values])
        begin = 0
        while len(t_s) - begin >= self.rows_per_bucket:
            if self._used == self._room:
                self._join()
                continue
            buckets = min((len(t_s) - begin) // self.rows_per_bucket, self._room - self._used)
            end = begin + buckets * self.rows_per_bucket
            self._store(t_s[begin:end].reshape(buckets, -1), values[begin:end].reshape(buckets, -1, values.shape[1]))
            begin = end
        self._rest_s, self._rest = t_s[begin:].copy(), values[begin:].copy()

    def _store(self, t_s: np.ndarray, values: np.ndarray) -> None:
        """Buckets with times (n, rows) and values (n, rows, curves)."""
        new = slice(self._used, self._used + len(t_s))
        self._used += len(t_s)
        finite = np.isfinite(values)
        self._span_s[new] = t_s[:, [0, -1]]
        self._count[new] = finite.sum(axis=1)
        self._sum[new] = np.where(finite, values, 0.0).sum(axis=1)
        for kept, kept_s, sign in ((self._low, self._low_s, 1.0), (self._high, self._high_s, -1.0)):
            ordered = np.where(finite, sign * values, np.inf)
            at = ordered.argmin(axis=1)
            kept[new] = sign * np.take_along_axis(ordered, at[:, None, :], axis=1)[:, 0]
            kept_s[new] = np.take_along_axis(t_s, at, axis=1)

    def _join(self) -> None:
        half = self._room // 2
        even, odd = slice(0, None, 2), slice(1, None, 2)
        for kept, kept_s, first in ((self._low, self._low_s, self._low[even] <= self._low[odd]),
                                    (self._high, self._high_s, self._high[even] >= self._high[odd])):
            kept[:half] = np.where(first, kept[even], kept[odd])
            kept_s[:half] = np.where(first, kept_s[even], kept_s[odd])
        for total in (self._count, self._sum):
            total[:half] = total[even] + total[odd]
        self._span_s[:half] = np.column_stack([self._span_s[even, 0], self._span_s[odd, 1]])
        self._used = half
        self.rows_per_bucket *= 2

    def finish(self) -> Reducer:
        """No row follows."""
        if len(self._rest_s):
            if self._used == self._room:
                self._join()
            self._store(self._rest_s[None], self._rest[None])
            self._rest_s, self._rest = self._rest_s[:0], self._rest[:0]
        return self

    def any_finite(self) -> bool:
        return bool(self._count[:self._used].any())

    def trace(self, curve: int) -> tuple[np.ndarray, np.ndarray]:
        """Times and values of a line that shows all peaks, NaN where it is broken."""
        used = slice(0, self._used)
        known = self._count[used, curve] > 0
        low, high = (np.where(known, kept[used, curve], np.nan) for kept in (self._low, self._high))
        low_s, high_s = self._low_s[used, curve], self._high_s[used, curve]
        if self.rows_per_bucket == 1:
            return broken_at_gaps(low_s, low)
        low_first = low_s <= high_s
        times = np.column_stack([np.where(low_first, low_s, high_s), np.where(low_first, high_s, low_s)])
        values = np.column_stack([np.where(low_first, low, high), np.where(low_first, high, low)])
        return broken_at_gaps(times.ravel(), values.ravel())

    def means(self, window_s: float) -> tuple[np.ndarray, np.ndarray]:
        """Times (n,) and moving averages (n, curves) over a window, shorter at the ends; broken as a trace is."""
        used = slice(0, self._used)
        t_s = self._span_s[used].mean(axis=1)
        pitch_s = float(np.median(np.diff(t_s))) if len(t_s) > 1 else window_s
        kernel = np.ones(max(1, min(round(window_s / pitch_s), len(t_s))))
        curves = []
        for count, total in zip(self._count[used].T, self._sum[used].T, strict=True):
            weights = np.convolve(count, kernel, "same")
            sums = np.convolve(total, kernel, "same")
            curves.append(np.where(count > 0, sums / np.maximum(weights, 1.0), np.nan))
        return broken_at_gaps(t_s, np.column_stack(curves))


def broken_at_gaps(t_s: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The same points with a NaN in each gap; values (n,) or (n, curves)."""
    if len(t_s) < 3:
        return t_s, values
    steps = np.diff(t_s)
    gaps = np.flatnonzero(steps > max(GAP_S, 10.0 * float(np.median(steps)))) + 1
    return np.insert(t_s, gaps, t_s[gaps]), np.insert(values, gaps, np.nan, axis=0)
