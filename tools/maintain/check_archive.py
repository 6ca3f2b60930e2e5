#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Fails if the archive needs a symbol that firmware must not pull in, or holds mutable static data.

usage: check_archive.py NM ARCHIVE
"""
import re
import subprocess
import sys

# Everything the library may take from outside. sqrtf is one instruction where there is an FPU; floorf and fabsf are
# exact everywhere; the compiler itself may call the mem functions. Nothing else: no heap, no I/O, no other libm.
ALLOWED = re.compile(
    r"^(sqrtf|fabsf|floorf|mem(cpy|set|cmp|move)"
    # Hardened builds: stack protector, fortified mem functions, position independent code.
    r"|__stack_chk_(fail|fail_local|guard)|__mem\w+_chk|_GLOBAL_OFFSET_TABLE_"
    # ARM run-time: soft float, 64-bit integers and mem functions; no double (d*, f2d, *2d).
    r"|__aeabi_(f(add|sub|rsub|mul|div|cmp\w\w|2iz|2uiz|2lz|2ulz)|(i|ui|l|ul)2f|cfr?cmple|cfcmpeq"
    r"|(u?i|u?l)div(mod)?|l(mul|lsl|lsr|asr|cmp)|ulcmp|mem\w+|unwind_cpp_pr\d))$"
)


def symbols(nm, archive):
    """(name, class letter, section) of every symbol."""
    text = subprocess.run([nm, "-f", "sysv", archive], check=True, capture_output=True, text=True).stdout
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.split("|")]
        if len(cells) == 7 and cells[0] != "Name":
            yield cells[0], cells[2], cells[6]


def problems(nm, archive):
    """One sentence per violation."""
    found = list(symbols(nm, archive))
    if not found:
        yield f"no symbols found in {archive}"
    own = {name for name, kind, _ in found if kind != "U"}
    for name in sorted({name for name, kind, _ in found if kind == "U"} - own):
        if not ALLOWED.match(name):
            yield f"forbidden symbol: {name}"
    for name, kind, section in found:
        # .data.rel.ro is constant data that holds addresses: the loader writes it once, nobody else does.
        if kind in "bBdDcC" and not section.startswith(".data.rel.ro"):
            yield f"mutable static data: {name} in {section or 'common'}"
        if kind in "TDRBC" and not name.startswith("jcal_"):
            yield f"public symbol without the prefix jcal_: {name}"


def main():
    nm, archive = sys.argv[1:]
    found = list(problems(nm, archive))
    for problem in found:
        print(f"{archive}: {problem}", file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
