"""Recordings of two IMUs as CSV files (columns by name, docs/METHOD.md sections 5 and 6)."""

from __future__ import annotations

import csv
import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

AXES = ("x", "y", "z")
IMU_COLUMNS = tuple(f"{sensor}_{axis}" for sensor in ("gyr1", "acc1", "gyr2", "acc2") for axis in AXES)


@dataclass
class Recording:
    """Two IMUs sampled at the same instants; rates in rad/s, specific force in m/s^2."""

    t_s: np.ndarray  # (N,)
    gyr1: np.ndarray  # (N, 3)
    acc1: np.ndarray
    gyr2: np.ndarray
    acc2: np.ndarray
    columns: dict[str, np.ndarray] = field(default_factory=dict, kw_only=True)  # every numeric column of the file

    def __len__(self) -> int:
        return len(self.t_s)

    @property
    def rate_hz(self) -> float:
        """Sampling rate; the median forgives gaps."""
        return float(1.0 / np.median(np.diff(self.t_s)))

    def finite(self) -> np.ndarray:
        """Indices of the rows in which time and all twelve signals are finite."""
        imu = np.column_stack([self.t_s, self.gyr1, self.acc1, self.gyr2, self.acc2])
        return np.flatnonzero(np.isfinite(imu).all(axis=1))


def load_csv(path: str | Path) -> Recording:
    """Read a recording; empty cells and `nan` become NaN, the order of the columns is free."""
    path = Path(path)
    with path.open(newline="") as file:
        names = [name.strip() for name in next(csv.reader(file))]
    missing = [name for name in ("t_s", *IMU_COLUMNS) if name not in names]
    if missing:
        raise ValueError(f"{path.name}: missing columns {', '.join(missing)}")
    try:
        table = np.loadtxt(path, delimiter=",", skiprows=1, ndmin=2)
    except ValueError:  # empty cells: the slower reader knows them
        table = np.genfromtxt(path, delimiter=",", skip_header=1, ndmin=2)
    columns = dict(zip(names, table.T, strict=True))
    vectors = (np.column_stack([columns[f"{sensor}_{axis}"] for axis in AXES])
               for sensor in ("gyr1", "acc1", "gyr2", "acc2"))
    return Recording(columns["t_s"], *vectors, columns=columns)


def write_csv(path: str | Path, rec: Recording, digits: int = 9,
              extra: Mapping[str, np.ndarray] | None = None) -> None:
    """Write `t_s`, the twelve signals and the columns `extra` (N,) with `digits` significant digits."""
    extra = extra or {}
    table = np.column_stack([rec.t_s, rec.gyr1, rec.acc1, rec.gyr2, rec.acc2, *extra.values()])
    np.savetxt(path, table, fmt=f"%.{digits}g", delimiter=",", newline="\n",
               header=",".join(("t_s", *IMU_COLUMNS, *extra)), comments="")


def write_simulated(path: Path, rec: Recording, truth: Mapping, extra: Mapping[str, np.ndarray] | None = None) -> None:
    """Write a simulated recording as CSV and its truth beside it as .json."""
    write_csv(path, rec, extra=extra)
    path.with_suffix(".json").write_text(json.dumps(truth, indent=1) + "\n")


def without_orientations(columns: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
    return {name: column for name, column in columns.items() if not name.startswith("q")}


def timed_parts(items: Iterable[str], seconds: float) -> tuple[tuple[str, float], ...]:
    """Of NAME[:SECONDS] each; `seconds` where none are named."""
    return tuple((name, float(own) if own else seconds) for name, _, own in (item.partition(":") for item in items))
