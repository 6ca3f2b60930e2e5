# SPDX-License-Identifier: MIT
"""What the tests of the program share."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

import recordings
from recordings import COLUMNS

PROGRAM = str(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "build/host/jointcal").resolve())
REJECT_KEYS = ["not_finite", "out_of_range", "saturated", "frozen", "repeated", "time_order", "gap"]
KEYS = ["event", "t_s", "status", "engine", "weak", "hint", "reason", "axis1", "axis2", "uncertainty_deg",
        "sign_margin", "model", "ready_for", "flexion_uncertainty_deg", "heading_offset_deg", "joint_to_sensor1_m",
        "joint_to_sensor2_m", "uncertainty_m", "lag_s", "advice", "samples", "rejected", "rejected_by"]
WINDOW_KEYS = KEYS[:19] + ["paper_accepted"] + KEYS[19:]
CELLS = recordings.texts(recordings.hinge_rows(20))
FILE = recordings.csv(CELLS)
SHORT = recordings.csv(CELLS[:50])
TWO_DOF_DEMO = pathlib.Path(__file__).resolve().parents[2] / "tools" / "demo" / "two_dof_demo.csv"
# The program may be built without the filter that computes orientations.
WITHOUT_FILTER = b"built without" in subprocess.run([PROGRAM, "two-dof", str(TWO_DOF_DEMO)], capture_output=True,
                                                    check=False).stderr
needs_filter = unittest.skipIf(WITHOUT_FILTER, "the program was built without VQF")


def no_constants(name):
    raise ValueError(f"{name} is not JSON")


class ProgramTest(unittest.TestCase):
    """Runs the program in an empty folder."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, text, name="r.csv"):
        path = self.folder / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return name

    def run_program(self, *arguments, stdin=None, **options):
        data = stdin.encode() if isinstance(stdin, str) else stdin
        return subprocess.run([PROGRAM, *arguments], input=data, capture_output=True, cwd=self.folder, timeout=300,
                              **options)

    def hinge(self, text, *arguments):
        return self.run_program("hinge", self.write(text), *arguments)

    def lines(self, text, *arguments):
        """Parsed lines of --json."""
        result = self.hinge(text, "--json", *arguments)
        self.assertEqual(result.stderr, b"")
        return self.parse(result.stdout), result.returncode

    def parse(self, output):
        return [json.loads(line, parse_constant=no_constants) for line in output.decode().splitlines()]

    def end(self, text, *arguments):
        lines, status = self.lines(text, *arguments)
        self.assertEqual(lines[-1]["event"], "end")
        self.assertEqual(status, 0 if lines[-1]["status"] == "ready" else 3)
        return lines[-1]

    def assert_error(self, result, message, status=2):
        self.assertEqual(result.stderr.decode(), message + "\n")
        self.assertEqual(result.returncode, status)
        self.assertNotIn(b'"event": "end"', result.stdout)

    def assert_usage(self, arguments, part):
        result = self.run_program(*arguments)
        self.assertIn(part, result.stderr.decode().splitlines()[0])
        self.assertEqual(result.returncode, 2)
        self.assertEqual(result.stdout, b"")


def with_cell(row, column, text, cells=CELLS):
    """A copy of the cells of 50 rows with one of them changed."""
    copy = [list(line) for line in cells[:50]]
    copy[row][COLUMNS.index(column)] = text
    return copy
