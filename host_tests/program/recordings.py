# SPDX-License-Identifier: MIT
"""Recordings for the tests of the program, made with nothing but the standard library."""
import math
import random

COLUMNS = ["t_s"] + [f"{kind}{sensor}_{axis}" for sensor in (1, 2) for kind in ("gyr", "acc") for axis in "xyz"]


def hinge_rows(seconds, rate_hz=50.0, seed=1):
    """Rows (lists of 13 numbers) of two sensors on a hinge about z of both; the base turns too, everything is noisy."""
    noise = random.Random(seed)
    rows = []
    for k in range(int(seconds * rate_hz)):
        t = k / rate_hz
        bend, bend_rate = 0.8 * math.sin(2.5 * t), 2.0 * math.cos(2.5 * t)
        base = [0.9 * math.sin(1.3 * t), 0.7 * math.cos(0.7 * t), 0.5 * math.sin(0.9 * t + 1)]
        gravity = [3 * math.sin(0.6 * t), 8 + math.cos(1.3 * t), 4 * math.cos(0.4 * t)]
        turned_rate, turned_gravity = turn_back(base, bend), turn_back(gravity, bend)
        turned_rate[2] += bend_rate
        values = base + gravity + turned_rate + turned_gravity
        rows.append([t] + [value + noise.gauss(0, 0.01) for value in values])
    return rows


def turn_back(vector, angle):
    """The vector in a frame that is turned by `angle` about z."""
    x, y, z = vector
    c, s = math.cos(angle), math.sin(angle)
    return [c * x + s * y, c * y - s * x, z]


def texts(rows, shift_us=0):
    """The cells as text; times with six decimals, shifted by whole microseconds."""
    return [[time_text(round(row[0] * 1e6) + shift_us)] + [f"{value:.7g}" for value in row[1:]] for row in rows]


def time_text(us):
    sign = "-" if us < 0 else ""
    return f"{sign}{abs(us) // 10**6}.{abs(us) % 10**6:06d}"


def csv(cells, columns=None, end="\n"):
    """A file of a header and rows of text."""
    lines = [",".join(columns or COLUMNS)] + [",".join(row) for row in cells]
    return end.join(lines) + end
