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


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
