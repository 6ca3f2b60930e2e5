#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Puts what the program prints into the pages that show it: the lines of a fenced block after `$ build/host/jointcal ...`.

usage: update_outputs.py [--check] PROGRAM PAGE...

--check writes nothing and leaves with 1 where a page shows something else than the program prints. A block whose command
needs what this build lacks (orientations without VQF) is left as it is, and said so.
"""
import difflib
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BLOCK = re.compile(r"^```(?:text)?\n\$ build/host/jointcal ([^\n]*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
WRONG_INPUT = 2


def printed(program, words):
    """What the command prints, or None if this build cannot run it."""
    run = subprocess.run([program, *words], capture_output=True, text=True, cwd=ROOT, timeout=120)
    if run.returncode == WRONG_INPUT and "VQF" in run.stderr:
        return None
    return run.stdout + run.stderr


def updated(program, text, skipped):
    def block(match):
        output = printed(program, match.group(1).split())
        if output is None:
            skipped.append(match.group(1))
            return match.group(0)
        return f"```text\n$ build/host/jointcal {match.group(1)}\n{output}```"
    return BLOCK.sub(block, text)


def main(arguments):
    check = "--check" in arguments
    program, *pages = [word for word in arguments if word != "--check"]
    same = True
    for page in map(Path, pages):
        skipped, text = [], page.read_text(encoding="utf-8")
        fresh = updated(program, text, skipped)
        for command in skipped:
            print(f"{page}: not compared, this build has no VQF: jointcal {command}")
        if fresh != text:
            same = False
            sys.stdout.writelines(difflib.unified_diff(text.splitlines(True), fresh.splitlines(True), str(page), "printed"))
            if not check:
                page.write_text(fresh, encoding="utf-8")
    return 1 if check and not same else 0


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1:]))
