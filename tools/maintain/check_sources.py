#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fails if library sources hold what the firmware rules ban: see RULES. Prints FILE:LINE: what is wrong.

usage: check_sources.py FILE...
"""
import re
import sys

MAX_FILE_LINES = 400
MAX_FUNCTION_LINES = 60
BANNED_WORDS = re.compile(
    r"\b(double|goto|malloc|calloc|realloc|free|alloca|printf|fprintf|snprintf|sprintf|puts|abort|exit|assert|setjmp"
    r"|longjmp|errno|stdio|stdlib|sinf?|cosf?|tanf?|asinf?|acosf?|atanf?|atan2f?|expf?|logf?|powf?|hypotf?"
    r"|sqrt|fabs|floor|strcpy|strcat)\b(?!\s*=)"
)
FLOAT_WITHOUT_F = re.compile(r"(?<![\w.])(\d+\.\d*|\.\d+|\d+(?=[eE][-+]?\d))([eE][-+]?\d+)?(?![\w.])")
MUTABLE_STATIC = re.compile(r"^\s*static\s+(?!inline\b|const\b)[^()]*[;=]")
FUNCTION = re.compile(r"^(?!typedef|struct|enum|union|#)[A-Za-z_][\w\s\*]*?\b([A-Za-z_]\w*)\([^;{}]*\)\s*\n\{\n(.*?)^\}",
                      re.MULTILINE | re.DOTALL)
KEYWORDS = {"if", "for", "while", "switch", "return", "sizeof"}


def blank(match):
    """Spaces of the same shape, so that line numbers stay."""
    return re.sub(r"[^\n]", " ", match.group(0))


def without_comments_and_strings(text):
    pattern = r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\''
    return re.sub(pattern, blank, text, flags=re.DOTALL)


def line_problems(code):
    for number, line in enumerate(code.splitlines(), 1):
        for word in BANNED_WORDS.findall(line):
            yield number, f"banned word '{word}'"
        for literal in FLOAT_WITHOUT_F.finditer(line):
            yield number, f"float literal without f: {literal.group(0)}"
        if MUTABLE_STATIC.match(line):
            yield number, "mutable static"


def functions(code):
    """(name, first line, lines, names called) of every function definition."""
    for match in FUNCTION.finditer(code):
        calls = set(re.findall(r"\b([A-Za-z_]\w*)\s*\(", match.group(2))) - KEYWORDS
        start = code.count("\n", 0, match.start()) + 1
        yield match.group(1), start, match.group(0).count("\n") + 1, calls


def file_problems(path, text, code):
    if "SPDX-License-Identifier: MIT" not in text.split("\n", 1)[0]:
        yield 1, "no SPDX line"
    lines = text.count("\n")
    if lines > MAX_FILE_LINES:
        yield lines, f"{lines} lines, the limit is {MAX_FILE_LINES}"
    yield from line_problems(code)
    for name, start, length, _ in functions(code):
        if length > MAX_FUNCTION_LINES:
            yield start, f"{name} has {length} lines, the limit is {MAX_FUNCTION_LINES}"


def resolved(graph):
    """The same graph with every called name replaced by the function meant: that of the same file before others."""
    homes = {}
    for path, name in graph:
        homes.setdefault(name, []).append((path, name))
    return {(path, name): {target for call in calls
                           for target in ([(path, call)] if (path, call) in graph else homes.get(call, []))}
            for (path, name), calls in graph.items()}


def recursion(graph):
    """Functions that reach themselves through the calls in the sources."""
    def reaches(start):
        seen, todo = set(), list(graph[start])
        while todo:
            name = todo.pop()
            if name == start:
                return True
            if name in graph and name not in seen:
                seen.add(name)
                todo.extend(graph[name])
        return False
    return sorted(name for name in graph if reaches(name))


def main(paths):
    failed, graph = False, {}
    for path in paths:
        with open(path, encoding="utf-8") as file:
            text = file.read()
        code = without_comments_and_strings(text)
        for number, problem in file_problems(path, text, code):
            print(f"{path}:{number}: {problem}", file=sys.stderr)
            failed = True
        for name, _, _, calls in functions(code):
            graph[path, name] = calls
    for path, name in recursion(resolved(graph)):
        print(f"{path}: {name} is recursive", file=sys.stderr)
        failed = True
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
