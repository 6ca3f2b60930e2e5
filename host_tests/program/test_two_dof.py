# SPDX-License-Identifier: MIT
"""`jointcal two-dof`: contract, sources of orientations, options, broken files."""
import json
import math
import os
import pathlib
import re
import unittest

import recordings
from recordings import COLUMNS, ORIENTATION_COLUMNS
from support import REJECT_KEYS, ProgramTest

KEYS = ["event", "t_s", "status", "engine", "weak", "hint", "reason", "axis1", "axis2", "uncertainty_deg",
        "heading_offset_deg", "uncertainty_heading_deg", "carrying_angle_deg", "samples", "rejected", "rejected_by"]
DEMO = pathlib.Path(__file__).resolve().parents[2] / "tools/demo/two_dof_demo.csv"
TRUTH = json.loads(DEMO.with_suffix(".json").read_text())
TEXT = DEMO.read_text()
DATA = pathlib.Path(os.environ.get("JOINTCAL_DATA", "data"))


def angle_deg(a, b):
    """Between two lines."""
    dot = abs(sum(x * y for x, y in zip(a, b)))
    return math.degrees(math.acos(min(dot / math.sqrt(sum(x * x for x in a) * sum(x * x for x in b)), 1.0)))


def table():
    return [line.split(",") for line in TEXT.splitlines()]


class TwoDof(ProgramTest):
    def two_dof(self, text, *arguments):
        return self.run_program("two-dof", self.write(text), *arguments)

    def lines(self, text, *arguments):
        result = self.two_dof(text, "--json", *arguments)
        self.assertEqual(result.stderr, b"")
        return self.parse(result.stdout), result.returncode


class Contract(TwoDof):
    def test_keys_events_and_truth(self):
        lines, status = self.lines(TEXT, "--every", "5")
        self.assertEqual(status, 0)
        for line in lines:
            self.assertEqual(list(line), KEYS)
            self.assertEqual(list(line["rejected_by"]), REJECT_KEYS)
        self.assertEqual([line["event"] for line in lines].count("ready"), 1)
        estimates = [line["t_s"] for line in lines if line["event"] == "estimate"]
        self.assertEqual(estimates, [5 * k for k in range(1, len(estimates) + 1)])
        end = lines[-1]
        self.assertEqual(end["event"], "end")
        self.assertEqual(end["samples"], len(table()) - 1)
        for axis, bound in zip(("axis1", "axis2"), end["uncertainty_deg"]):
            self.assertLess(angle_deg(end[axis], TRUTH[axis]), bound)
            self.assertGreater(max(end[axis], key=abs), 0.0)
        self.assertLess(abs(abs(end["carrying_angle_deg"]) - TRUTH["carrying_angle_deg"]), 2.0)

    def test_unknown_is_null(self):
        lines, status = self.lines("\n".join(TEXT.splitlines()[:20]) + "\n")
        self.assertEqual(status, 3)
        for key in ("axis1", "axis2", "uncertainty_deg", "heading_offset_deg", "uncertainty_heading_deg",
                    "carrying_angle_deg"):
            self.assertIsNone(lines[-1][key], key)

    def test_time_may_start_anywhere(self):
        rows = table()
        shifted = [rows[0]] + [[f"{float(row[0]) - 12345.25:.6f}"] + row[1:] for row in rows[1:]]
        plain, _ = self.lines(TEXT)
        moved, _ = self.lines("\n".join(map(",".join, shifted)))
        for a, b in zip(plain, moved, strict=True):
            self.assertAlmostEqual(a.pop("t_s") - b.pop("t_s"), 12345.25, 6)
            self.assertEqual(a, b)

    def test_line_ends_order_of_columns_and_standard_input(self):
        expected = self.two_dof(TEXT, "--json").stdout
        self.assertEqual(self.two_dof(TEXT.replace("\n", "\r\n"), "--json").stdout, expected)
        turned = "\n".join(",".join(row[::-1]) for row in table()) + "\n"
        self.assertEqual(self.two_dof(turned, "--json").stdout, expected)
        self.assertEqual(self.run_program("two-dof", "-", "--json", stdin=TEXT).stdout, expected)

    def test_rows_that_are_refused_count_once(self):
        rows = table()
        rows[300][3] = ""
        rows[400][5] = "nan"
        rows[500] = [rows[499][0]] + rows[500][1:]  # time does not increase
        rows[600][1:] = rows[599][1:]  # a lost packet
        lines, status = self.lines("\n".join(map(",".join, rows)))
        self.assertEqual(status, 0)
        by = lines[-1]["rejected_by"]
        self.assertEqual((by["not_finite"], by["time_order"], by["repeated"]), (2, 1, 1))
        self.assertEqual(lines[-1]["rejected"], sum(by.values()))
        self.assertEqual(lines[-1]["samples"], len(rows) - 1)

    def test_exchanged_sensors_give_the_exchanged_result(self):
        swap = str.maketrans({"1": "2", "2": "1"})
        rows = table()
        header = [name if name == "t_s" else name.translate(swap) for name in rows[0]]
        one, other = self.lines(TEXT)[0][-1], self.lines("\n".join(map(",".join, [header] + rows[1:])))[0][-1]
        self.assertEqual(other["status"], "ready")
        self.assertLess(angle_deg(one["axis1"], other["axis2"]), 1.0)
        self.assertLess(angle_deg(one["axis2"], other["axis1"]), 1.0)
        self.assertLess(abs(one["heading_offset_deg"] + other["heading_offset_deg"]), 1.0)

    def test_summary_says_what_a_person_asks(self):
        result = self.two_dof(TEXT, "--every", "10")
        text = result.stdout.decode()
        for part in ("estimate", "Joint with two axes, stream engine: ready", "axis in sensor 1", "heading offset",
                     "carrying angle", "first ready", "VQF", "exit status        0"):
            self.assertIn(part, text)
        self.assertEqual(result.returncode, 0)


class Orientations(TwoDof):
    def test_columns_come_before_the_filter(self):
        # Rates and accelerations are noise here: only the columns can have told the axes.
        rows = recordings.texts(recordings.two_dof_rows(30, heading=-1.2, carrying=0.15))
        lines, status = self.lines(recordings.csv(rows, COLUMNS + ORIENTATION_COLUMNS))
        end = lines[-1]
        self.assertEqual(status, 0)
        self.assertLess(angle_deg(end["axis1"], [0, 0, 1]), 1.0)
        self.assertLess(angle_deg(end["axis2"], [0, 1, 0]), 1.0)
        self.assertLess(abs(end["heading_offset_deg"] - math.degrees(-1.2)), 1.0)
        self.assertLess(abs(end["carrying_angle_deg"] - math.degrees(0.15)), 1.0)

    def test_some_columns_are_an_error(self):
        rows = table()
        text = "\n".join(",".join(row + [extra]) for row, extra in zip(rows, ["q1_w"] + ["1"] * len(rows)))
        self.assert_error(self.two_dof(text), "r.csv:1: some columns of orientations are there, but not q1_x, q1_y, "
                                              "q1_z, q2_w, q2_x, q2_y, q2_z")

    def test_a_period_that_no_filter_works_with(self):
        rows = table()
        slow = [rows[0]] + [[f"{k}"] + row[1:] for k, row in enumerate(rows[1:200])]
        result = self.two_dof("\n".join(map(",".join, slow)))
        self.assertEqual(result.returncode, 2)
        self.assertIn("sample period of 1 s", result.stderr.decode())


class Refused(TwoDof):
    def test_options(self):
        base = ["two-dof", "a"]
        for arguments, part in (
                ([*base, "--n-max", "100"], "--n-max goes with --engine window only"),
                ([*base, "--engine", "window", "--constraint", "combined"], "--constraint combined"),
                ([*base, "--constraint", "both"], "--constraint: 'both'"),
                ([*base, "--sign-hint", "same"], "--sign-hint is for a hinge"),
                ([*base, "--window", "1"], "--window"), ([*base, "--window", "601"], "--window"),
                ([*base, "--max-bound", "0.01"], "--max-bound"), ([*base, "--every", "0"], "--every"),
                (["two-dof"], "which recording"), ([*base, "b"], "one recording at a time")):
            with self.subTest(arguments):
                self.assert_usage(arguments, part)

    def test_files(self):
        self.assert_error(self.run_program("two-dof", "none.csv"), "none.csv: No such file or directory")
        self.assert_error(self.two_dof(""), "r.csv: the file is empty")
        rows = table()[:60]
        rows[30][4] = "left"
        result = self.two_dof("\n".join(map(",".join, rows)))
        self.assertEqual(result.returncode, 2)
        self.assertRegex(result.stderr.decode(), r"^r\.csv:31:\d+: .*'left' is not a number")
        self.assertNotIn(b'"end"', result.stdout)


class Rig(TwoDof):
    def test_rig_recordings(self):
        names = [DATA / f"rig_2D_{number}.csv" for number in ("01", "02", "05")]
        if not all(name.exists() for name in names):
            self.skipTest("the rig recordings are not there; JOINTCAL_DATA names their folder")
        for name in names:
            with self.subTest(name.stem):
                result = self.run_program("two-dof", str(name.resolve()), "--json")
                self.assertEqual(result.returncode, 0)
                end = self.parse(result.stdout)[-1]
                self.assertLess(angle_deg(end["axis1"], [0, 1, 0]), 1.3)
                self.assertLess(angle_deg(end["axis2"], [0, 0, 1]), 1.3)

    def test_a_hinge_is_never_ready(self):
        name = DATA / "rig_1D_02.csv"
        if not name.exists():
            self.skipTest("the rig recordings are not there; JOINTCAL_DATA names their folder")
        result = self.run_program("two-dof", str(name.resolve()), "--json")
        self.assertEqual(result.returncode, 3)
        self.assertIsNone(re.search(b'"event": "ready"', result.stdout))


if __name__ == "__main__":
    unittest.main(argv=["test_two_dof.py"])
