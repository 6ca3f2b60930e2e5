#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The checks of the library's sources and symbols find what they are there for: a check that never fires is none.

usage: test_checks.py CC AR NM
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "tools" / "maintain"
CC, AR, NM = sys.argv[1:4]
GOOD = "/* SPDX-License-Identifier: MIT */\n"


class Checks(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)

    def source_check(self, code):
        source = self.path / "a.c"
        source.write_text(GOOD + code)
        return subprocess.run([sys.executable, SCRIPTS / "check_sources.py", source], capture_output=True, text=True)

    def archive_check(self, code):
        source, thing, archive = (self.path / name for name in ("a.c", "a.o", "a.a"))
        source.write_text(code)
        subprocess.run([CC, "-std=c99", "-O0", "-w", "-fno-builtin", "-c", source, "-o", thing], check=True)
        subprocess.run([AR, "rcs", archive, thing], check=True, capture_output=True)
        return subprocess.run([sys.executable, SCRIPTS / "check_archive.py", NM, archive],
                              capture_output=True, text=True)

    def test_banned_words_are_found_in_code_only(self):
        for code in ("static double x(void);\n", "void *p = malloc(3);\n", "goto out;\n", "y = sinf(x);\n"):
            self.assertEqual(self.source_check(code).returncode, 1, code)
        self.assertEqual(self.source_check("/* no double, malloc or goto; 0.5 */ // 1.0\nint x = '0';\n").returncode, 0)

    def test_float_literals_need_an_f(self):
        for code in ("x = 0.5;\n", "x = 1.;\n", "x = .5;\n", "x = 1e-3;\n", "x = 2.5e3 + y;\n"):
            self.assertIn("float literal", self.source_check(code).stderr, code)
        for code in ("x = 0.5f;\n", "x = 1e-3f;\n", "x = 15;\n", "x = 0x1e3;\n", "x = v.x;\n", "x = a1.y;\n"):
            self.assertEqual(self.source_check(code).returncode, 0, code)

    def test_recursion_is_found_through_other_functions(self):
        code = "static int a(int x)\n{\n    return b(x);\n}\n\nint b(int x)\n{\n    return a(x - 1);\n}\n"
        self.assertIn("recursive", self.source_check(code).stderr)
        self.assertEqual(self.source_check(code.replace("return a(", "return c(")).returncode, 0)

    def test_mutable_statics_and_length_are_found(self):
        self.assertIn("mutable", self.source_check("static int count;\n").stderr)
        self.assertEqual(self.source_check("static const int n = 3;\n").returncode, 0)
        body = "    x = 1;\n" * 61
        self.assertIn("limit", self.source_check("void f(void)\n{\n" + body + "}\n").stderr)
        self.assertIn("limit", self.source_check("\n" * 400).stderr)

    def test_forbidden_symbols_are_found(self):
        for name in ("malloc", "printf", "sinf", "abort", "sqrt"):
            result = self.archive_check(f"void {name}(void);\nvoid jcal_f(void) {{ {name}(); }}\n")
            self.assertIn(f"forbidden symbol: {name}", result.stderr)
        self.assertEqual(self.archive_check("float sqrtf(float);\nfloat jcal_f(float x) { return sqrtf(x); }\n")
                         .returncode, 0)

    def test_mutable_data_and_foreign_names_are_found(self):
        self.assertIn("mutable", self.archive_check("static int x; int jcal_f(void) { return ++x; }\n").stderr)
        self.assertIn("mutable", self.archive_check("int jcal_x = 3;\n").stderr)
        self.assertIn("prefix", self.archive_check("int f(void) { return 0; }\n").stderr)
        names = 'static const char *const names[] = {"a", "b"};\nconst char *jcal_n(int i) { return names[i]; }\n'
        self.assertEqual(self.archive_check(names).returncode, 0)

    def include_check(self, **changes):
        """A small tree: lib/math/low, lib/hinge/{sums,judge,stream}, one public header. `changes` are files by their name."""
        files = {"lib/layers.txt": "math <-\nhinge <- math\nhinge: sums judge stream\n",
                 "lib/math/low.h": "", "include/jointcal/hinge.h": "",
                 "lib/hinge/sums.h": '#include "math/low.h"\n', "lib/hinge/judge.h": '#include "hinge/sums.h"\n',
                 "lib/hinge/stream.c": '#include "hinge/judge.h"\n#include "jointcal/hinge.h"\n'}
        files.update({name.replace("__", "/").replace("_dot_", "."): text for name, text in changes.items()})
        for name, text in files.items():
            (self.path / name).parent.mkdir(parents=True, exist_ok=True)
            (self.path / name).write_text(GOOD + text if name != "lib/layers.txt" else text)
        return subprocess.run([sys.executable, SCRIPTS / "check_includes.py", self.path], capture_output=True, text=True)

    def test_arrows_that_run_down_are_fine(self):
        result = self.include_check()
        self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_an_include_that_runs_up_is_found(self):
        self.assertIn("hinge/judge is not below it", self.include_check(lib__hinge__sums_dot_h='#include "hinge/judge.h"\n').stderr)
        self.assertIn("math may not use hinge", self.include_check(lib__math__low_dot_h='#include "hinge/sums.h"\n').stderr)

    def test_a_call_that_runs_up_is_found_without_its_header(self):
        result = self.include_check(lib__hinge__stream_dot_c="void jcal_go(void)\n{\n}\n",
                                    lib__hinge__sums_dot_c="void jcal_add(void)\n{\n    jcal_go();\n}\n")
        self.assertIn("hinge/stream is not below it", result.stderr)

    def test_circles_places_and_private_state_are_found(self):
        self.assertIn("circle", self.include_check(include__jointcal__hinge_dot_h='#include "jointcal/types.h"\n',
                                                   include__jointcal__types_dot_h='#include "jointcal/hinge.h"\n').stderr)
        self.assertIn("no place", self.include_check(lib__hinge__more_dot_c='#include "hinge/sums.h"\n').stderr)
        self.assertIn("private state", self.include_check(include__jointcal__hinge_dot_h="/// Private: sums.\n").stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
