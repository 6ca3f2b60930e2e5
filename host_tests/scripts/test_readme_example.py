#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Every C block of the README stands, letter for letter, in the example that is compiled and run.

usage: test_readme_example.py README.md hinge_example.c
"""
import re
import sys
from pathlib import Path


def main():
    readme, example = (Path(path).read_text(encoding="utf-8") for path in sys.argv[1:])
    blocks = re.findall(r"^```c\n(.*?)^```", readme, re.MULTILINE | re.DOTALL)
    if not blocks:
        print("the README has no C block")
        return 1
    missing = [block for block in blocks if block not in example]
    for block in missing:
        print(f"not in {sys.argv[2]}:\n{block}")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
