#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""tools/maintain/prose_numbers.py notices a number that is not the table's, and puts the right one in.

usage: test_prose_numbers.py
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "tools" / "maintain" / "prose_numbers.py"
TABLE = """# Silent

1200 simulated runs. PASS: largest, at most 2: 1.349

| length | method | share | errors, deg |
| --- | --- | --- | --- |
| 3 s | stream | 52.5 % | 1.15, 2.34 |
| 3 s | window | 45.9 % | 1.09 (2.64) |
| 5 s | stream | 90.5 % | - |

| length | other |
| --- | --- |
| 3 s | 7 in 1.9 h |
"""


class Numbers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        (self.root / "docs" / "measurements").mkdir(parents=True)
        (self.root / "docs" / "measurements" / "silent.md").write_text(TABLE)

    def run_script(self, prose, lines, *arguments):
        (self.root / "README.md").write_text(prose)
        (self.root / "docs" / "numbers.ini").write_text("[silent]\n" + lines + "\n")
        return subprocess.run([sys.executable, SCRIPT, "--root", self.root, *arguments], capture_output=True, text=True, check=False)

    def number(self, line):
        """What the script makes of one line of numbers.ini."""
        result = self.run_script("a <!--n silent.x-->?<!--/n--> b", f"x = {line}")
        self.assertEqual(result.returncode, 0, result.stderr)
        return (self.root / "README.md").read_text().removeprefix("a <!--n silent.x-->").removesuffix("<!--/n--> b")

    def test_a_wrong_number_is_noticed_and_corrected(self):
        line, prose = "x = length=5 s & method=stream | share | .1f", "first\n<!--n silent.x-->90.5<!--/n--> %\n"
        self.assertEqual(self.run_script(prose, line, "--check").returncode, 0)
        wrong = prose.replace("90.5", "90.4")
        result = self.run_script(wrong, line, "--check")
        self.assertEqual(result.returncode, 1)
        self.assertIn("README.md:2: silent.x: '90.4' is '90.5' in the table", result.stderr)
        self.assertEqual((self.root / "README.md").read_text(), wrong, "--check writes nothing")
        self.assertEqual(self.run_script(wrong, line).returncode, 0)
        self.assertEqual((self.root / "README.md").read_text(), prose)

    def test_a_table_that_changes_is_noticed(self):
        (self.root / "docs" / "measurements" / "silent.md").write_text(TABLE.replace("90.5", "90.6"))
        prose = "<!--n silent.x-->90.5<!--/n-->"
        self.assertEqual(self.run_script(prose, "x = length=5 s | share | .1f", "--check").returncode, 1)

    def test_cells(self):
        self.assertEqual(self.number("length=3 s & method=stream | share | .1f"), "52.5")
        self.assertEqual(self.number("length=3 s & method=stream | share | .0f"), "53")
        self.assertEqual(self.number("length=3 s & method=stream | share | down .0f"), "52")
        self.assertEqual(self.number("method=stream | share | sum .1f"), "143.0")
        self.assertEqual(self.number("* | errors, deg | max .2f"), "2.64")
        self.assertEqual(self.number("method=w* | err* | nth 2 .2f"), "2.64")
        self.assertEqual(self.number("* | errors, deg | min nth 2 x 1000 to 100 up ,.0f"), "2,400")
        self.assertEqual(self.number("length=3 s | other | nth 1 .0f"), "7")

    def test_text(self):
        self.assertEqual(self.number(r"/(\d+) simulated runs/ | ,.0f"), "1,200")
        self.assertEqual(self.number(r"/largest, at most 2: ([\d.]+)/ | .1f"), "1.3")

    def test_what_is_not_found_or_not_clear_is_an_error(self):
        for line in ("length=9 s | share | .1f", "length=3 s | share | .1f", "length=3 s | shares | .1f", "* | share | max", "*",
                     r"/(\d+) real runs/ | .0f", "* | share | largest .1f", "* | share | max nth .1f"):
            for arguments in ([], ["--check"]):
                result = self.run_script("<!--n silent.x-->?<!--/n-->", f"x = {line}", *arguments)
                self.assertEqual(result.returncode, 1, line)
                self.assertIn("README.md:1: silent.x", result.stderr)
                self.assertNotIn("Traceback", result.stderr, line)

    def test_marks_that_do_not_fit_are_errors(self):
        line = "x = length=5 s | share | .1f"
        for prose in ("<!--n silent.y-->1<!--/n-->", "<!--n other.x-->1<!--/n-->", "<!--n silent.x-->90.5", "90.5<!--/n-->"):
            self.assertEqual(self.run_script(prose, line, "--check").returncode, 1, prose)

    def test_a_line_that_nothing_uses_is_said(self):
        result = self.run_script("no number", "x = length=5 s | share | .1f", "--check")
        self.assertEqual(result.returncode, 0)
        self.assertIn("silent.x is not used", result.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
