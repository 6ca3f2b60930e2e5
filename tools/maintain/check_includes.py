#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fails if an include or a call in lib/ runs up the table lib/layers.txt, or if includes go round in a circle.

Both are looked at: what a file includes, and which functions of other files it calls, whatever header declares them.
Prints FILE: what is wrong.

usage: check_includes.py ROOT
"""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from check_sources import functions, without_comments_and_strings  # noqa: E402

INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)


class Layers:
    """The table: which folders a folder may use, and the order of the files in it."""

    def __init__(self, text):
        self.folders, self.order = {}, {}
        for number, line in enumerate(text.splitlines(), 1):
            line = line.split("#")[0].strip()
            if "<-" in line:
                folder, uses = line.split("<-")
                self.folders[folder.strip()] = uses.split()
            elif ":" in line:
                folder, files = line.split(":")
                self.order[folder.strip()] = files.split()
            elif line:
                raise SystemExit(f"layers.txt:{number}: neither 'FOLDER <- FOLDERS' nor 'FOLDER: FILES'")

    def problem(self, user, used):
        """What is wrong if `user` uses `used`, both as folder/name without ending; None if nothing is."""
        (folder, name), (other, low) = user.split("/"), used.split("/")
        if folder not in self.folders:
            return f"folder {folder} is not in lib/layers.txt"
        if folder != other:
            return None if other in self.folders[folder] else f"{folder} may not use {other}"
        order = self.order.get(folder)
        if order is None or name == low:
            return None
        for part in (name, low):
            if part not in order:
                return f"{folder}/{part} has no place in the order of lib/layers.txt"
        return None if order.index(low) < order.index(name) else f"{used} is not below it in lib/layers.txt"


def stem(path):
    return f"{path.parent.name}/{path.stem}"


def circles(graph):
    """One circle for each file that reaches itself."""
    found = []
    for start in sorted(graph):
        todo, seen = [(start, (start,))], set()
        while todo:
            at, way = todo.pop()
            for to in sorted(graph.get(at, ())):
                if to == start and len(way) > 0:
                    found.append(way + (start,))
                    todo = []
                    break
                if to not in seen and to in graph:
                    seen.add(to)
                    todo.append((to, way + (to,)))
    return found


def public_problems(root):
    """Public headers hold no private state: that is in include/jointcal/private/."""
    for path in sorted((root / "include/jointcal").glob("*.h")):
        text = path.read_text(encoding="utf-8")
        if re.search(r"///.*\b[Pp]rivate:|all members are private", text):
            yield f"{path.relative_to(root)}: private state in a public header"


def check(root):
    layers = Layers((root / "lib/layers.txt").read_text(encoding="utf-8"))
    files = sorted([*root.glob("lib/*/*.[ch]"), *root.glob("include/jointcal/**/*.h")])
    includes, defined, calls, problems = {}, {}, {}, set(public_problems(root))
    for path in files:
        text = path.read_text(encoding="utf-8")
        includes[path] = INCLUDE.findall(text)
        if "lib" in path.relative_to(root).parts:
            listed = list(functions(without_comments_and_strings(text)))
            defined.update({name: path for name, *_ in listed if name.startswith("jcal_")})
            calls[path] = {call for *_, called in listed for call in called}
    graph = {}
    for path, names in includes.items():
        found = {(root / base / name) for name in names for base in ("lib", "include") if (root / base / name).exists()}
        graph[path] = found
        if path not in calls:
            continue
        used = {to for to in found if to in calls} | {defined[call] for call in calls[path] if call in defined}
        for to in used - {path}:
            what = layers.problem(stem(path), stem(to))
            if what:
                problems.add(f"{path.relative_to(root)}: uses {to.relative_to(root)}: {what}")
    for circle in circles(graph):
        problems.add("circle: " + " -> ".join(str(path.relative_to(root)) for path in circle))
    return sorted(problems)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    problems = check(Path(sys.argv[1]).resolve())
    print("\n".join(problems), file=sys.stderr, end="\n" if problems else "")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
