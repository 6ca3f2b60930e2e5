#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Numbers in prose come from the tables that commands write: puts them there, or checks them.

    tools/maintain/prose_numbers.py            writes README.md and docs/*.md, and port/**/*.md
    tools/maintain/prose_numbers.py --check    exit 1 if one differs; says which

In the prose a number stands between marks that do not show:

    ready in <!--n silent.ready_3s-->53<!--/n--> % of the windows

docs/numbers.ini says where it is found: section [silent] stands for docs/measurements/silent.md, and its line

    ready_3s = length=3 s & method=stream | informative that end ready | .0f

names rows, columns and form. Rows: conditions on cells, * for any text, joined by &; * alone is every row. Columns: headings,
also with * and joined by &. All tables of the page that have these columns are looked at. In place of rows and columns a
/regular expression/ finds numbers in the page's text, one a group:

    runs = /(\\d+) simulated runs/ | ,.0f

The form is a Python format, before which may stand: min, max, sum (of all numbers found; without, there must be one), nth N (the
N-th number of a cell), x FACTOR, to STEP (a multiple of it), up or down (rounding; else to the nearest), in this order.
What the program prints is put into pages by update_outputs.py.
"""
import argparse
import configparser
import decimal
import fnmatch
import re
import sys
from decimal import Decimal
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PAGES = ("README.md", "docs/*.md", "port/**/*.md")
NUMBER = re.compile(r"(?<![\w.])[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?(?![\w.]*\d)")
MARK = re.compile(r"<!--n ([\w.+-]+)-->(.*?)<!--/n-->", re.DOTALL)
OPEN = re.compile(r"<!--n\b|<!--/n-->")


class Problem(Exception):
    """What is wrong with a line of numbers.ini or with a page."""


def tables(page):
    """(headings, rows of cells) of every table of a page."""
    heads, rows = [], []
    for line in [*page.splitlines(), ""]:
        if line.startswith("|"):
            cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]]
            if not heads:
                heads = cells
            elif not all(re.fullmatch(r":?-+:?", cell) for cell in cells):
                rows.append(cells)
        elif heads:
            yield heads, rows
            heads, rows = [], []


def matching(headings, pattern):
    return [k for k, heading in enumerate(headings) if fnmatch.fnmatchcase(heading, pattern)]


def cells(page, rows, columns):
    """The texts of the cells that rows and columns name."""
    conditions = [] if rows == "*" else [tuple(part.strip() for part in each.split("=", 1)) for each in rows.split(" & ")]
    if any(len(condition) != 2 for condition in conditions):
        raise Problem(f"no 'column=text': {rows}")
    patterns = [part.strip() for part in columns.split(" & ")]
    for headings, body in tables(page):
        keys = [(matching(headings, name), text) for name, text in conditions]
        chosen = [matching(headings, pattern) for pattern in patterns]
        if not all(found for found, _ in keys) or not all(chosen):
            continue
        for row in body:
            if all(any(fnmatch.fnmatchcase(row[k], text) for k in found) for found, text in keys):
                yield from (row[k] for k in sorted({k for group in chosen for k in group}))


def numbers_in(texts, nth):
    for text in texts:
        found = NUMBER.findall(text)
        if nth is None:
            yield from map(Decimal, found)
        elif len(found) >= nth:
            yield Decimal(found[nth - 1])


def formed(page, place, form):
    """The number as the prose has it. place: (rows, columns) or (regular expression,)."""
    words = form.split()
    if not words:
        raise Problem("no form")
    combine = words.pop(0) if words[0] in ("min", "max", "sum") else None

    def option(name):
        if words and words[0] == name:
            words.pop(0)
            return Decimal(words.pop(0))
        return None
    nth, factor, step = option("nth"), option("x"), option("to")
    rounding = decimal.ROUND_HALF_UP
    if words[0] in ("up", "down"):
        rounding = decimal.ROUND_CEILING if words.pop(0) == "up" else decimal.ROUND_FLOOR
    if len(words) != 1:
        raise Problem(f"cannot read the form '{form}'")
    if len(place) == 1:
        texts = [group for match in re.finditer(place[0], page) for group in match.groups()]
    else:
        texts = list(cells(page, *place))
    found = list(numbers_in(texts, None if nth is None else int(nth)))
    if not found or (combine is None and len(found) != 1):
        raise Problem(f"{len(found)} numbers found: {', '.join(texts[:4])}")
    value = {"min": min, "max": max, "sum": sum, None: lambda values: values[0]}[combine](found) * (factor or 1)
    with decimal.localcontext() as context:
        context.rounding = rounding
        if step:
            value = (value / step).quantize(Decimal(1)) * step
        return format(value, words[0])


class Source:
    """docs/numbers.ini and the pages that it names."""

    def __init__(self, root):
        self.root = root
        self.config = configparser.ConfigParser(delimiters=("=",), comment_prefixes=("#",), interpolation=None, strict=True)
        self.config.optionxform = str
        with open(root / "docs" / "numbers.ini", encoding="utf-8") as file:
            self.config.read_file(file)
        self.used = set()

    def number(self, key):
        section, _, name = key.partition(".")
        if not self.config.has_option(section, name):
            raise Problem(f"docs/numbers.ini has no {name} in [{section}]")
        self.used.add(key)
        parts = [part.strip() for part in self.config.get(section, name).rsplit(" | ", 1)]
        if len(parts) != 2:
            raise Problem("a line is: rows | columns | form, or /expression/ | form")
        where, form = parts
        if where.startswith("/") and where.endswith("/"):
            place = (where[1:-1],)
        elif where.count(" | ") == 1:
            place = tuple(part.strip() for part in where.split(" | "))
        else:
            raise Problem("a line is: rows | columns | form, or /expression/ | form")
        page = (self.root / "docs" / "measurements" / f"{section}.md").read_text(encoding="utf-8")
        return formed(page, place, form)

    def unused(self):
        every = {f"{section}.{name}" for section in self.config.sections() for name in self.config.options(section)}
        return sorted(every - self.used)


def with_numbers(text, source, problems):
    """The text with every number as the tables have it; problems takes one line for each that differs."""
    def line_of(position):
        return text.count("\n", 0, position) + 1

    def replace(match):
        key, old = match.groups()
        try:
            new = source.number(key)
        except (Problem, OSError, re.error, ValueError, IndexError, decimal.InvalidOperation) as problem:
            problems.append((line_of(match.start()), f"{key}: {problem}", True))
            return match.group(0)
        if new != old:
            problems.append((line_of(match.start()), f"{key}: '{old}' is '{new}' in the table", False))
        return f"<!--n {key}-->{new}<!--/n-->"
    for match in OPEN.finditer(MARK.sub(lambda match: " " * len(match.group(0)), text)):
        problems.append((line_of(match.start()), "a mark without the other one", True))
    return MARK.sub(replace, text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="write nothing, exit 1 if a number differs")
    parser.add_argument("--root", type=Path, default=ROOT, help=argparse.SUPPRESS)
    args = parser.parse_args()
    source = Source(args.root)
    count, failed = 0, False
    for path in sorted({path for pattern in PAGES for path in args.root.glob(pattern)}):
        text, problems = path.read_text(encoding="utf-8"), []
        new = with_numbers(text, source, problems)
        count += len(MARK.findall(text))
        for line, problem, fatal in problems:
            failed |= fatal or args.check
            print(f"{path.relative_to(args.root)}:{line}: {problem}", file=sys.stderr)
        if new != text and not args.check:
            path.write_text(new, encoding="utf-8")
    for key in source.unused():
        print(f"docs/numbers.ini: {key} is not used")
    print(f"{count} numbers{' checked' if args.check else ''}")
    if failed and args.check:
        print("tools/maintain/prose_numbers.py puts the tables' numbers in place", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
