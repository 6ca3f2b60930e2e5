"""What the program told: its JSON lines over time, reduced while they are read."""

from __future__ import annotations

import json
import subprocess
from collections.abc import Iterable, Iterator
from pathlib import Path

import numpy as np

from .joints import Joint
from .reading import Clock, Progress, RefusedError, reason_of
from .reduce import Reducer
from .truth import Truth

LINES_AT_ONCE = 500
NO_MORE_LINES = 3000  # estimates that the program is asked for, at most
EVERY_S = 0.1  # and how far apart they are, at least


class ProgramError(Exception):
    """The program has said what was wrong; what is left is its exit status."""

    def __init__(self, status: int):
        super().__init__(f"exit status {status}")
        self.status = status


def need_program(program: Path) -> None:
    if not program.is_file():
        raise RefusedError(program, "not there; build it with: cmake --preset host && cmake --build --preset host")


def run_program(program: Path, joint: Joint, recording: Path, seconds: float, options: list[str]) -> Iterator[str]:
    """Lines as the program writes them."""
    need_program(program)
    every_s = max(EVERY_S, seconds / NO_MORE_LINES)
    with subprocess.Popen([program, joint.command, recording, "--json", "--every", f"{every_s:g}", *options],
                          stdout=subprocess.PIPE, text=True) as process:
        try:
            yield from process.stdout
        except GeneratorExit:  # the rest is not drawn
            process.kill()
            raise
    if process.returncode not in (0, 3):  # ready or not at the end
        raise ProgramError(process.returncode)


def stored_lines(path: Path) -> Iterator[str]:
    try:
        bar = Progress(path.stat().st_size)
        file = path.open(encoding="utf-8", errors="replace")
    except OSError as error:
        raise RefusedError(path, reason_of(error)) from None
    try:
        with file:
            done = 0
            for line in file:
                done += len(line)
                bar.show(done)
                yield line
    finally:
        bar.clear()


def numbers(value: object, count: int) -> np.ndarray:
    """A number or a list as (count,); unknown values are NaN."""
    if value is None:
        return np.full(count, np.nan)
    return np.array(value, float).reshape(count)


def errors_of(vectors: np.ndarray, truth: np.ndarray, joint: Joint) -> np.ndarray:
    """(N, K) in the unit drawn; vectors (N, K, 3)."""
    if not joint.directions:
        return joint.per_unit * np.linalg.norm(vectors - truth, axis=2)
    unit = truth / np.linalg.norm(truth, axis=1, keepdims=True)
    across = np.linalg.norm(np.cross(vectors, unit), axis=2)
    return np.degrees(np.arctan2(across, np.abs((vectors * unit).sum(axis=2))))


class Spans:
    """How long something holds: each value until the next line."""

    def __init__(self) -> None:
        self.spans: list[tuple[object, float, float]] = []  # value, from, until

    def add(self, t_s: float, value: object) -> None:
        if self.spans:
            before, begin_s, _ = self.spans[-1]
            self.spans[-1] = (before, begin_s, t_s)
            if before == value:
                return
        self.spans.append((value, t_s, t_s))

    def values(self) -> list[object]:
        """In the order in which they came, each once."""
        return list(dict.fromkeys(value for value, _, _ in self.spans))

    def of(self, value: object) -> list[tuple[float, float]]:
        """Begin and length of each."""
        return [(begin_s, end_s - begin_s) for held, begin_s, end_s in self.spans if held == value]


class Told:
    """The program's lines as curves, times of `ready` and spans of status."""

    def __init__(self, place: Path, joint: Joint, truth: Truth | None, clock: Clock, zero_s: float = 0.0):
        self.zero_s = zero_s  # times are told from here on
        self.place, self.joint, self.truth, self.clock = place, joint, truth, clock
        self.bounds = Reducer(len(joint.keys))
        self.errors = Reducer(len(joint.keys))
        self.others = Reducer(len(joint.others))
        self.wrong_pairing = Spans()  # of a hinge: whether the axes' common sign is wrong
        self.status = Spans()
        self.ready_s: list[float] = []  # times at which `ready` was entered, in the whole recording
        self.last: dict[str, object] = {}
        self._untimed: dict[str, object] = {}  # a line from before the first row that was used
        self._rows: list[tuple[float, np.ndarray, np.ndarray, np.ndarray]] = []

    @property
    def max_bound(self) -> float:
        """What bounds must be below for `ready` where nothing else was asked for: of the model that spoke last."""
        people = self.joint.people_bound if self.last.get("model") == "functional" else None
        return people or self.joint.max_bound

    def read(self, lines: Iterable[str]) -> Told:
        for number, text in enumerate(lines, 1):
            if text.strip():
                self._take(text, number)
            if len(self._rows) == LINES_AT_ONCE:
                self._reduce()
            if self.clock.over:
                break
        self._reduce()
        if not self.status.spans:
            raise self._no_row_used() or self.clock.none_used(self.place, "line of JSON")
        for curves in (self.bounds, self.errors, self.others):
            curves.finish()
        return self

    def _no_row_used(self) -> RefusedError | None:
        """What the program says of a recording of which it uses nothing."""
        causes = self._untimed.get("rejected_by")
        if self.clock.outside or not isinstance(causes, dict):
            return None
        words = ", ".join(f"{count} {cause.replace('_', ' ')}" for cause, count in causes.items() if count)
        return RefusedError(self.place, f"jointcal used none of the {self._untimed.get('samples')} rows: {words}")

    def _take(self, text: str, number: int) -> None:
        joint = self.joint
        foreign = f"this is no line of jointcal {joint.command} --json"
        try:
            line = json.loads(text)
        except json.JSONDecodeError as error:
            raise RefusedError(self.place, f"not JSON: {error.msg}", number, error.colno) from None
        try:
            if line["t_s"] is None:
                self._untimed = line
                return
            t_s = float(line["t_s"])
            row = (t_s, np.array([numbers(line[key], 3) for key in joint.keys]),
                   joint.per_unit * numbers(line[joint.bound], len(joint.keys)),
                   np.array([other.factor * numbers(line[other.key], 1)[0] for other in joint.others]))
            status, event = str(line["status"]), line["event"]
        except KeyError as error:
            raise RefusedError(self.place, f"no {error.args[0]}: {foreign}", number) from None
        except (TypeError, ValueError):
            raise RefusedError(self.place, foreign, number) from None
        if event == "ready":
            self.ready_s.append(t_s)
        # `ready` and `end` may come at the time of an estimate; a later line of one time tells nothing new but its event.
        inside = self.clock.from_s <= t_s <= self.clock.until_s
        if len(self.clock.use(np.array([t_s]))):
            self._rows.append(row)
        if inside:
            self.last = line
            self.status.add(t_s, status)

    def _reduce(self) -> None:
        if not self._rows:
            return
        t_s = np.array([row[0] for row in self._rows])
        vectors, bounds, others = (np.array([row[k] for row in self._rows]) for k in (1, 2, 3))
        self._rows = []
        self.bounds.add(t_s, np.where(bounds < self.joint.known, bounds, np.nan))
        self.others.add(t_s, others)
        if self.truth is None:
            return
        self.errors.add(t_s, errors_of(vectors, self.truth.vectors, self.joint))
        if self.joint.hinge:
            along = (vectors * self.truth.vectors).sum(axis=2)
            for time_s, product in zip(t_s, along[:, 0] * along[:, 1], strict=True):
                self.wrong_pairing.add(float(time_s), bool(product < 0.0))

    @property
    def end_s(self) -> float:
        """Of the last line, as it is told."""
        return float(self.last["t_s"]) - self.zero_s

    def complete(self) -> bool:
        return self.last.get("event") == "end"

    def why_nothing(self) -> str:
        """What the program gave as reason, in its own keys."""
        told = ", ".join(f"{key} {self.last[key]}" for key in ("reason", "weak", "hint") if self.last.get(key))
        return f"{self.last['status']} at {self.end_s:.1f} s{f': {told}' if told else ''}"
