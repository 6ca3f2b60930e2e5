"""How fast the segments turn: rates of a recording, reduced while it is read."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..recordings import AXES
from .joints import Joint
from .reading import Clock, Table
from .reduce import Reducer


@dataclass(frozen=True)
class Motion:
    rates: Reducer  # each sensor's rate, rad/s; of a hinge also the difference of both
    clock: Clock
    rows: int
    seconds: float  # of the whole recording, as far as it was read


def read_motion(path: Path, joint: Joint, from_s: float, until_s: float) -> Motion:
    table = Table(path)
    names = ["t_s", *(f"gyr{k + 1}_{axis}" for k in range(joint.sensors) for axis in AXES)]
    table.need(names)
    clock, whole = Clock(from_s, until_s), Clock()
    rates = Reducer(joint.sensors + joint.hinge)
    rows = 0
    for piece in table.pieces(names):
        rows += len(piece)
        whole.use(piece[:, 0])
        used = piece[clock.use(piece[:, 0])]
        lengths = np.linalg.norm(used[:, 1:].reshape(len(used), joint.sensors, 3), axis=2)
        if joint.hinge:
            lengths = np.column_stack([lengths, np.abs(lengths[:, 0] - lengths[:, 1])])
        rates.add(used[:, 0], lengths)
        if clock.over:
            break
    if np.isnan(clock.begin_s):
        raise clock.none_used(path, "row")
    return Motion(rates.finish(), clock, rows, whole.end_s - whole.begin_s)
