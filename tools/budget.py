#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What the library costs on a Cortex-M4F: code, state, stack, instructions. Writes docs/measurements/budget.md.

usage: tools/budget.py [--json] [--check] [--profile] [--recording FILE.csv] [--no-write]

--check fails if a limit of port/cortex_m/budgets.json is exceeded; --profile prints only the instructions and which
functions the worst calls spend them in. Instructions are counted exactly by a QEMU plugin; they are not cycles.
"""
import argparse
import json
import re
import statistics
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "python"))
from jointcal_tools import target  # noqa: E402

BUDGETS = target.PORT / "budgets.json"
PAGE = target.ROOT / "docs/measurements/budget.md"
M4F = target.PLATFORMS["m4f"]
ENGINES = {"stream": (), "window": ("REPLAY_WINDOW",)}
CPU_HZ, INSTANCES, RATE_HZ = 64_000_000, 16, 100


def counts_of(plugin: Path, engine: str, samples: Path, definitions: tuple[str, ...]) -> tuple[dict, dict, dict]:
    """Counts of every call by kind, the worst call's counts by function, and what the program printed."""
    image = target.build(M4F, f"replay_{engine}_{'_'.join(definitions).lower()}", ENGINES[engine] + definitions)
    out = target.WORK / "counts.txt"
    printed = target.run(M4F, image, samples, plugin, out)
    counts: dict[str, list[int]] = {}
    worst: dict[str, dict[str, int]] = {}
    for line in out.read_text().splitlines():
        cells = line.split()
        if cells[0] == "worst":
            worst.setdefault(cells[1], {})[cells[3]] = int(cells[2])
        else:
            counts.setdefault(cells[0], []).append(int(cells[1]))
    return counts, worst, printed


def instructions(samples: Path) -> dict:
    """Per engine: counts of push, step and update, worst update by function, state bytes, painted stack."""
    plugin = target.build_plugin()
    found = {}
    for engine in ENGINES:
        counts, worst, printed = counts_of(plugin, engine, samples, ("REPLAY_STACK",))
        split, _, _ = counts_of(plugin, engine, samples, ("REPLAY_SPLIT",))
        found[engine] = {"counts": counts | split, "worst": worst["update"], **printed}
    return found


def print_profile(found: dict) -> None:
    for engine, of in found.items():
        for kind, counts in of["counts"].items():
            print(f"{engine} {kind}: max {max(counts)}, mean {statistics.mean(counts):.0f}, "
                  f"median {statistics.median(counts):.0f}, sample of the max {counts.index(max(counts))}")
        for name, count in sorted(of["worst"].items(), key=lambda item: -item[1]):
            print(f"    {count:8d}  {name}")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--profile", action="store_true")
    parser.add_argument("--recording", type=Path)
    arguments = parser.parse_args()
    recording = arguments.recording or target.recordings(["rig_1D_04"])[0]
    found = instructions(target.samples_file(recording))
    print_profile(found)
    return 0


if __name__ == "__main__":
    sys.exit(main())
