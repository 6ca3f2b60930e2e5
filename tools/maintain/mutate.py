#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Break one formula at a time in a copy of the tree and see whether a unit test fails.

    python3 tools/maintain/mutate.py                   all of mutation_list.py; writes docs/measurements/mutations.md
    python3 tools/maintain/mutate.py --only TEXT ...   those whose file or text holds one of these; prints, writes nothing

Exit 1 if a mutation survives that has no reason in SURVIVORS. The tree itself is never
touched: each worker has its own copy with an incremental build.
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from queue import Queue
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).resolve().parent))

from mutation_list import MUTATIONS, SURVIVORS  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
TABLE = ROOT / "docs" / "measurements" / "mutations.md"
PARTS = ("CMakeLists.txt", "CMakePresets.json", "include", "lib", "port", "host_tests", "tools", "README.md")
UNITY = Path("build") / "unity"
WORKERS = 2
SLOW = ("test_hinge_long", "test_hinge_window")  # run last: quicker tests kill most
TEST_TIMEOUT_S = 60
PASSED, FAILED = "passed", "failed"


class Outcome(NamedTuple):
    killed: bool
    by: str


class Worker:
    """A copy of the tree with its own build."""

    def __init__(self, folder: Path) -> None:
        self.root = folder
        self.build = folder / "build" / "mutants"
        folder.mkdir()
        for part in PARTS:
            source = ROOT / part
            copy = shutil.copytree if source.is_dir() else shutil.copy
            copy(source, folder / part)
        shutil.copytree(ROOT / UNITY, folder / UNITY)
        generator = ["-G", "Ninja"] if shutil.which("ninja") else []
        self.call("cmake", *generator, "-S", folder, "-B", self.build, "-DCMAKE_BUILD_TYPE=Release",
                  "-DJOINTCAL_BUILD_PROGRAM=OFF", "-DJOINTCAL_INSTALL=OFF", "-DJOINTCAL_WERROR=OFF", check=True)
        self.targets = sorted(f"test_{path.parent.name}_{path.stem[len('test_'):]}"
                              for path in (folder / "host_tests").glob("unit/*/test_*.c"))
        self.targets += sorted(f"test_boards_{path.stem[len('test_'):]}" for path in (folder / "host_tests").glob("boards/test_*.c"))

    def call(self, *command, check: bool = False) -> subprocess.CompletedProcess:
        return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=check)

    def test(self) -> Outcome:
        """Builds the unit tests and runs them until one fails."""
        built = self.call("cmake", "--build", self.build, "--target", *self.targets)
        if built.returncode != 0:
            return Outcome(True, "the compiler")
        quick = [target for target in self.targets if target not in SLOW]
        for names in (quick, SLOW):
            run = self.call("ctest", "--test-dir", self.build, "-R", f"^({'|'.join(names)})$", "--stop-on-failure",
                            "--timeout", TEST_TIMEOUT_S)
            if run.returncode != 0:
                names = [line.split(" - ")[1].split()[0] for line in run.stdout.splitlines() if "(Failed)" in line
                         or "(Timeout)" in line or "Exception" in line and " - " in line]
                return Outcome(True, names[0] if names else "ctest")
        return Outcome(False, "")

    def try_mutation(self, mutation: tuple[str, str, str, str]) -> Outcome:
        path = self.root / mutation[0]
        original = path.read_text()
        path.write_text(original.replace(mutation[1], mutation[2]))
        try:
            return self.test()
        finally:
            path.write_text(original)


def check_list() -> list[str]:
    """Mutations that no longer fit the sources."""
    problems = []
    for file, old, new, _ in MUTATIONS:
        count = (ROOT / file).read_text().count(old)
        if count != 1 or old == new:
            problems.append(f"{file}: {count} times: {old}")
    known = {old for _, old, _, _ in MUTATIONS}
    return problems + [f"SURVIVORS: no such mutation: {old}" for old in SURVIVORS if old not in known]


def run_all(mutations: list[tuple[str, str, str, str]], folder: Path) -> list[Outcome]:
    workers: Queue[Worker] = Queue()
    with ThreadPoolExecutor(WORKERS) as pool:
        for worker in pool.map(Worker, [folder / f"copy{k}" for k in range(WORKERS)]):
            workers.put(worker)

        def work(mutation: tuple[str, str, str, str]) -> Outcome:
            worker = workers.get()
            try:
                outcome = worker.try_mutation(mutation)
            finally:
                workers.put(worker)
            print("." if outcome.killed else f"\nsurvives: {mutation[0]}: {mutation[1]}", end="", flush=True)
            return outcome

        first = workers.get()
        unchanged = first.test()
        workers.put(first)
        if unchanged.killed:
            sys.exit(f"the tests fail without any mutation: {unchanged.by}")
        outcomes = list(pool.map(work, mutations))
    print()
    return outcomes


def cell(text: str) -> str:
    return "`" + text.strip().replace("|", "\\|") + "`"


def write_table(outcomes: list[Outcome]) -> None:
    killed = sum(outcome.killed for outcome in outcomes)
    lines = ["# Mutations", "", "Written by `python3 tools/maintain/mutate.py`.", "",
             f"{len(outcomes)} mutations of formulas (sign, factor, index, comparison), one at a time: {killed} make a "
             f"unit test fail, {len(outcomes) - killed} do not.", "",
             "| file | text | becomes | what it breaks | noticed by |", "| --- | --- | --- | --- | --- |"]
    for (file, old, new, what), outcome in zip(MUTATIONS, outcomes, strict=True):
        noticed = outcome.by if outcome.killed else "nothing: " + SURVIVORS.get(old, "NO REASON GIVEN")
        lines.append(f"| {Path(*Path(file).parts[1:])} | {cell(old)} | {cell(new)} | {what.replace('|', chr(92) + '|')} | {noticed} |")
    TABLE.write_text("\n".join(lines) + "\n")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--only", nargs="+", metavar="TEXT", help="only mutations whose file or text holds TEXT")
    only = parser.parse_args().only
    problems = check_list()
    if problems:
        print("\n".join(problems), file=sys.stderr)
        return 1
    chosen = [m for m in MUTATIONS if only is None or any(text in m[0] or text in m[1] for text in only)]
    with tempfile.TemporaryDirectory(prefix="jointcal-mutants-") as folder:
        outcomes = run_all(chosen, Path(folder))
    if only is None:
        write_table(outcomes)
    lost = [m for m, outcome in zip(chosen, outcomes, strict=True) if not outcome.killed and m[1] not in SURVIVORS]
    print(f"{len(chosen)} mutations, {sum(o.killed for o in outcomes)} noticed, {len(lost)} lost without a reason")
    return 1 if lost else 0


if __name__ == "__main__":
    sys.exit(main())
