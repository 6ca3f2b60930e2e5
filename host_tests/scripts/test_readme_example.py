#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The C block of the README is the example that is compiled and run, letter for letter.

usage: test_readme_example.py README.md hinge_example.c
"""
import difflib
import re
import sys

SKIPPED = 77


def main():
    readme_path, example_path = sys.argv[1:]
    try:
        with open(readme_path, encoding="utf-8") as file:
            readme = file.read()
    except FileNotFoundError:
        print("skipped: no README.md")
        return SKIPPED
    with open(example_path, encoding="utf-8") as file:
        # The licence line and the file comment are for the repository, not for the reader of the README.
        example = re.sub(r"\A(/\*.*?\*/\n)+\n*", "", file.read(), flags=re.DOTALL)
    blocks = re.findall(r"^```c\n(.*?)^```", readme, re.MULTILINE | re.DOTALL)
    if example in blocks:
        return 0
    nearest = max(blocks, default="", key=lambda block: difflib.SequenceMatcher(None, block, example).ratio())
    sys.stdout.writelines(difflib.unified_diff(nearest.splitlines(True), example.splitlines(True),
                                               readme_path, example_path))
    return 1


if __name__ == "__main__":
    sys.exit(main())
