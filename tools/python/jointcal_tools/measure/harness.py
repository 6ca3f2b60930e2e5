"""What every measurement needs: jobs on several cores, progress, Markdown reports, requirements."""

from __future__ import annotations

import multiprocessing
import sys
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

BAR_WIDTH = 30


@dataclass(frozen=True)
class Settings:
    """The options that all subcommands share."""

    runs: int | None = None  # None: the subcommand's own number
    jobs: int = 2
    quick: bool = False
    engines: tuple[str, ...] = ("stream", "window")
    with_qmt: bool = True
    qmt_every_s: float = 1.0
    only: str | None = None  # `never`, `bounds`: CLASS or CLASS:INDEX; `body`: persons or sections

    def count(self, full: int, quick: int) -> int:
        """How many runs to make where a full measurement makes `full` and a quick one `quick`."""
        return self.runs or (quick if self.quick else full)


def orientations_by(need: str, has_vqf: bool, quick: bool) -> str:
    """What the head of a report says of orientations; `need` is what of it needs VQF. Without it a full measurement is none."""
    if has_vqf:
        return ", orientations by VQF"
    if not quick:
        raise Incomplete(f"the library was built without VQF, which {need} needs: tools/vqf.sh brings it, then build anew. "
                         "Nothing was written: a table without it would hide that")
    return f", WITHOUT VQF: {need} is missing"


class Incomplete(Exception):
    """A measurement that would lack a part of what it is for; the text says which and what to do."""


class Skipped(Exception):
    """A measurement that cannot be made here; the text says why."""


class Progress:
    """A bar on standard error, drawn on terminals only, and a line with the time at the end."""

    def __init__(self, label: str, total: int) -> None:
        self.label, self.total, self.done = label, total, 0
        self.begin_s = self.drawn_s = time.monotonic()

    def step(self) -> None:
        self.done += 1
        now_s = time.monotonic()
        if sys.stderr.isatty() and now_s - self.drawn_s > 0.2:
            self.drawn_s = now_s
            filled = BAR_WIDTH * self.done // max(self.total, 1)
            left_s = (now_s - self.begin_s) * (self.total - self.done) / self.done
            print(f"\r{self.label} [{'#' * filled:{BAR_WIDTH}}] {self.done}/{self.total}, {left_s:.0f} s left  ",
                  end="", file=sys.stderr, flush=True)

    def finish(self) -> None:
        clear = "\r\x1b[K" if sys.stderr.isatty() else ""
        print(f"{clear}{self.label}: {self.done} jobs in {time.monotonic() - self.begin_s:.0f} s", file=sys.stderr)


def numbered(counts: dict[str, int], only: str | None) -> list[tuple[str, int]]:
    """(class, index) of all runs, or of those that `only`, CLASS or CLASS:INDEX, names."""
    if not only:
        return [(kind, k) for kind, count in counts.items() for k in range(count)]
    kind, _, index = only.partition(":")
    if kind not in counts:
        raise SystemExit(f"'{kind}' is not a class; there are {', '.join(counts)}")
    return [(kind, int(index))] if index else [(kind, k) for k in range(counts[kind])]


def run_jobs(function: Callable, jobs: Sequence, label: str, settings: Settings) -> list:
    """function(job) of every job, in order, on several cores. `function` must be a module's own."""
    progress = Progress(label, len(jobs))
    results = []

    def collect(found: Iterable) -> None:
        for result in found:
            results.append(result)
            progress.step()

    if settings.jobs > 1 and len(jobs) > 1:
        with multiprocessing.Pool(settings.jobs) as pool:
            collect(pool.imap(function, jobs, chunksize=max(1, min(8, len(jobs) // (4 * settings.jobs)))))
    else:
        collect(map(function, jobs))
    progress.finish()
    return results


@dataclass
class Requirement:
    text: str
    value: str
    passed: bool
    known: str = ""  # why it is not met, where that is known and not worse than it was

    def line(self) -> str:
        word = "PASS" if self.passed else ("FAIL, known" if self.known else "FAIL")
        return f"- {word}: {self.text}: {self.value}" + (f". {self.known}" if self.known and not self.passed else "")


@dataclass
class Report:
    """One measurement as Markdown, with the requirements it checks."""

    name: str
    title: str
    command: str
    version: str
    quick: bool = False
    source: str = ""  # where orientations come from, if it needs any
    body: list[str] = field(default_factory=list)
    requirements: list[Requirement] = field(default_factory=list)

    @property
    def passed(self) -> bool:
        return all(requirement.passed or requirement.known for requirement in self.requirements)

    def text(self, paragraph: str) -> None:
        self.body.append(paragraph)

    def table(self, header: Sequence[str], rows: Iterable[Sequence]) -> None:
        lines = ["| " + " | ".join(header) + " |", "|" + " --- |" * len(header)]
        lines += ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows]
        self.body.append("\n".join(lines))

    def require(self, text: str, value: str, passed: bool, known: str = "") -> None:
        self.requirements.append(Requirement(text, value, bool(passed), known))

    def require_none(self, text: str, count: int, total: int) -> None:
        """None of `total` may happen."""
        self.require(text, f"{count} of {total}", count == 0 and total > 0)

    def require_share(self, text: str, hits: int | Sequence[int], total: int, minimum: float,
                      known: tuple[float, str] | None = None) -> None:
        """At least `minimum` of `total`, of each of several counts.

        A quick run only fails if chance does not explain what is missing, and judges nothing if it has nothing. `known`: the share that is
        reached instead, and why: the run fails below that only.
        """
        if self.quick and total == 0:
            return
        counts = [int(hits)] if np.isscalar(hits) else [int(count) for count in hits]

        def reached(least: float) -> bool:
            allowed = binomial_quantile(total, least, 0.001) if self.quick else least * total
            return total > 0 and min(counts) >= allowed

        shares = ", ".join(percent(count, total) for count in counts)
        self.require(f"{text}, at least {100 * minimum:g} %", f"{shares} of {total}",
                     reached(minimum), known[1] if known and reached(known[0]) else "")

    def require_most(self, text: str, value: float, limit: float, unit: str = "", known: tuple[float, str] | None = None) -> None:
        """At most `limit`; NaN fails, except in a quick run. `known`: what is reached instead, and why: the run fails above that only."""
        if self.quick and np.isnan(value):
            return
        why = known[1] if known and value <= known[0] else ""
        self.require(f"{text}, at most {limit:g}{unit}", f"{value:.4g}{unit}", value <= limit, why)

    def markdown(self) -> str:
        head = [f"# {self.title}", f"Written by `{self.command}`, library version {self.version}{self.source}."]
        checks = "\n".join(requirement.line() for requirement in self.requirements)
        return "\n\n".join([*head, *self.body, *(["## Requirements", checks] if checks else [])]) + "\n"

    def write(self, folder: Path) -> Path:
        folder.mkdir(parents=True, exist_ok=True)
        path = folder / f"{self.name}.md"
        path.write_text(self.markdown(), newline="\n")
        return path


def binomial_quantile(n: int, p: float, tail: float) -> int:
    """Largest k for which fewer than k hits of n have a probability of at most `tail`."""
    log_factorial = np.concatenate([[0.0], np.cumsum(np.log(np.arange(1, n + 1)))])
    k = np.arange(n + 1)
    log_pmf = (log_factorial[n] - log_factorial[k] - log_factorial[n - k] + k * np.log(p)
               + (n - k) * np.log1p(-p))
    below = np.concatenate([[0.0], np.cumsum(np.exp(log_pmf))[:-1]])  # P(hits < k)
    return int(np.flatnonzero(below <= tail)[-1])


# Formatting. A table cell says nothing rather than nan.

def number(value: float, digits: int = 2) -> str:
    if value is None or np.isnan(value):
        return "-"
    return "never" if np.isinf(value) else f"{value:.{digits}f}"


def percent(hits: float, total: int) -> str:
    return f"{100.0 * hits / total:.1f} %" if total else "-"


def quantile(values: np.ndarray | Sequence[float], share: float) -> float:
    """The smallest value that at least `share` of all reach; infinite values count as such. NaN if there are none."""
    ordered = np.sort(np.asarray(values, float))
    return float(ordered[max(int(np.ceil(share * len(ordered))) - 1, 0)]) if len(ordered) else float("nan")


def median(values: np.ndarray | Sequence[float]) -> float:
    return float(np.median(values)) if len(values) else float("nan")
