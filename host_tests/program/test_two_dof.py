# SPDX-License-Identifier: MIT
"""`jointcal two-dof`: keys, numbers against truth, orientations from columns and from readings, and what it refuses."""
import json
import math
import os
import pathlib
import unittest

import recordings
from support import REJECT_KEYS, TWO_DOF_DEMO, WITHOUT_FILTER, ProgramTest, needs_filter

ROOT = pathlib.Path(__file__).resolve().parents[2]
DEMO = TWO_DOF_DEMO
DATA = pathlib.Path(os.environ.get("JOINTCAL_DATA", ROOT / "data"))
RIG = sorted(DATA.glob("rig_2D_*.csv"))
KEYS = ["event", "t_s", "status", "engine", "weak", "hint", "reason", "axis1", "axis2", "uncertainty_deg",
        "heading_offset_deg", "uncertainty_heading_deg", "carrying_angle_deg", "model", "ready_for", "joint_to_sensor1_m",
        "joint_to_sensor2_m", "uncertainty_m", "lag_s", "advice", "samples", "rejected", "rejected_by"]
COLUMNS = recordings.COLUMNS + recordings.ORIENTATION_COLUMNS
RAW = recordings.COLUMNS
ROWS = recordings.two_dof_rows(30)
CELLS = recordings.texts(ROWS)
FILE = recordings.csv(CELLS, COLUMNS)
DEMO_CELLS = [line.split(",") for line in DEMO.read_text().splitlines()[1:]]


def angle_deg(a, b):
    """Between two axes whose signs do not matter."""
    cosine = abs(sum(x * y for x, y in zip(a, b, strict=True))) / math.hypot(*a) / math.hypot(*b)
    return math.degrees(math.acos(min(1.0, cosine)))


class TwoDofTest(ProgramTest):
    def two_dof(self, text, *arguments):
        return self.run_program("two-dof", self.write(text), *arguments)

    def lines(self, text, *arguments):
        result = self.two_dof(text, "--json", *arguments)
        self.assertEqual(result.stderr, b"")
        return self.parse(result.stdout), result.returncode

    def demo(self, cells, *arguments):
        """Lines from cells in the order of the demo's columns."""
        header = DEMO.read_text().splitlines()[0].split(",")
        return self.lines(recordings.csv(cells, header), *arguments)


class Columns(TwoDofTest):
    """Orientations that are known exactly."""

    def test_rows_without_orientations_are_bad_samples(self):
        """A sensor whose orientations stop keeps nobody waiting for more than two seconds."""
        cells = [list(row) for row in CELLS]
        at = COLUMNS.index("q2_w")
        gone = next(k for k, row in enumerate(ROWS) if row[0] - ROWS[0][0] > 20.0)
        for row in cells[gone:]:
            row[at:at + 4] = ["nan"] * 4
        lines, status = self.lines(recordings.csv(cells, COLUMNS), "--every", "0.5")
        self.assertEqual((status, lines[-1]["status"], lines[-1]["reason"]), (3, "collecting", "bad_samples"))
        start = ROWS[0][0]
        self.assertTrue(all(line["status"] != "ready" for line in lines if line["t_s"] - start > 22.0))
        self.assertTrue(any(line["status"] == "ready" for line in lines if line["t_s"] - start < 20.0))

    def test_axis1_toward_chooses_the_sign(self):
        lines, _ = self.lines(FILE)
        axis = lines[-1]["axis1"]
        for sign in (1.0, -1.0):
            toward = ",".join(f"{sign * x:.9f}" for x in axis)
            turned, status = self.lines(FILE, "--axis1-toward", toward)
            self.assertEqual(status, 0)
            for x, y in zip(turned[-1]["axis1"], axis, strict=True):
                self.assertAlmostEqual(x, sign * y, places=5)

    def test_every_line_has_every_key(self):
        lines, status = self.lines(FILE, "--every", "0.5")
        self.assertEqual(status, 0)
        for line in lines:
            self.assertEqual(list(line), KEYS)
            self.assertEqual(list(line["rejected_by"]), REJECT_KEYS)
            self.assertEqual(line["engine"], "stream")
            self.assertEqual(line["rejected"], sum(line["rejected_by"].values()))
        self.assertIsNone(lines[0]["axis1"])
        self.assertIsNone(lines[0]["heading_offset_deg"])
        self.assertIsNone(lines[0]["uncertainty_heading_deg"])
        self.assertIsNone(lines[0]["carrying_angle_deg"])
        events = [line["event"] for line in lines]
        self.assertEqual((events[0], events[-1], events.count("end")), ("estimate", "end", 1))
        self.assertIn("ready", events)

    def test_truth(self):
        for constraint in ("combined", "rotation", "orientation"):
            end = self.lines(FILE, "--constraint", constraint)[0][-1]
            self.assertEqual(end["status"], "ready", constraint)
            # Exact but for seven digits and the smoothing of the rates: far inside the bounds.
            self.assertLess(angle_deg(end["axis1"], (0, 0, 1)), 0.3)
            self.assertLess(angle_deg(end["axis2"], (0, 1, 0)), 0.3)
            self.assertAlmostEqual(end["heading_offset_deg"], math.degrees(-1.2), delta=0.3)
            self.assertAlmostEqual(end["carrying_angle_deg"], math.degrees(0.15), delta=0.3)

    def test_window_engine(self):
        for constraint in ([], ["--constraint", "orientation"]):
            # Ten seconds of one constraint alone tell less than all: 5 degrees are asked for.
            lines, status = self.lines(FILE, "--every", "1", "--engine", "window", "--max-bound", "5", *constraint)
            for line in lines:
                self.assertEqual(list(line), KEYS[:19] + ["paper_accepted"] + KEYS[19:])
                self.assertEqual(line["engine"], "window")
            self.assertEqual(status, 0)
            self.assertLess(angle_deg(lines[-1]["axis1"], (0, 0, 1)), lines[-1]["uncertainty_deg"][0])
            self.assertLess(angle_deg(lines[-1]["axis2"], (0, 1, 0)), lines[-1]["uncertainty_deg"][1])
            self.assertAlmostEqual(lines[-1]["heading_offset_deg"], math.degrees(-1.2), delta=1.0)

    def test_length_of_the_window(self):
        window = ("--engine", "window", "--every", "1")
        expected = self.lines(FILE, *window)
        self.assertEqual(self.lines(FILE, *window, "--window", "10", "--constraint", "rotation"), expected)
        self.assertEqual(self.lines(FILE, *window, "--n-max", "200"), expected)
        self.assertNotEqual(self.lines(FILE, *window, "--n-max", "100"), expected)
        self.assertEqual(self.lines(FILE, *window, "--window", "5"), self.lines(FILE, *window, "--n-max", "100"))

    def test_heading_over_the_whole_circle(self):
        for heading in (3.1, -3.1, math.pi, 0.0):
            text = recordings.csv(recordings.texts(recordings.two_dof_rows(15, heading)), COLUMNS)
            for line in self.lines(text, "--every", "1")[0]:
                if line["status"] == "ready":
                    found = line["heading_offset_deg"]
                    self.assertTrue(-180.0 < found <= 180.0)
                    error = (found - math.degrees(heading) + 180.0) % 360.0 - 180.0
                    self.assertLess(abs(error), line["uncertainty_heading_deg"])

    def test_every_form_gives_the_same_bytes(self):
        expected = self.two_dof(FILE, "--json", "--every", "1").stdout
        backward = recordings.csv([row[::-1] for row in CELLS], COLUMNS[::-1])
        for text in (FILE.replace("\n", "\r\n"), "\ufeff" + FILE, backward):
            self.assertEqual(self.two_dof(text, "--json", "--every", "1").stdout, expected)
        result = self.run_program("two-dof", "-", "--json", "--every", "1", stdin=FILE)
        self.assertEqual(result.stdout, expected)

    def test_readings_are_of_no_account(self):
        other = [row[:1] + cells[1:13] + row[13:] for row, cells in zip(CELLS, CELLS[1:] + CELLS[:1], strict=True)]
        self.assertEqual(self.lines(recordings.csv(other, COLUMNS)), self.lines(FILE))

    def test_rejected_rows(self):
        cells = [list(row) for row in CELLS]
        cells[100][COLUMNS.index("q1_x")] = ""
        cells[200][COLUMNS.index("gyr2_x")] = "nan"
        cells[300][0] = ""
        cells[400][13:17] = ["2", "0", "0", "0"]
        cells[500][0] = cells[499][0]
        cells[600][13:] = cells[599][13:]
        del cells[700:750]
        end = self.lines(recordings.csv(cells, COLUMNS))[0][-1]
        self.assertEqual(end["samples"], len(cells))
        self.assertEqual(end["rejected_by"], {"not_finite": 3, "out_of_range": 1, "saturated": 0, "frozen": 0,
                                              "repeated": 1, "time_order": 1, "gap": 1})
        self.assertEqual(end["rejected"], 7)

    def test_nothing(self):
        lines, status = self.lines(recordings.csv([], COLUMNS))
        self.assertEqual((status, lines[0]["samples"], lines[0]["t_s"]), (3, 0, None))

    def test_shift_of_time_changes_no_bit(self):
        expected = self.lines(FILE, "--every", "1")[0]
        for shift_us in (10**15 + 7, -(10**15) - 123457):
            got = self.lines(recordings.csv(recordings.texts(ROWS, shift_us), COLUMNS), "--every", "1")[0]
            self.assertEqual([{**line, "t_s": 0} for line in got], [{**line, "t_s": 0} for line in expected])

    def test_memory_and_bound_count(self):
        self.assertNotEqual(self.lines(FILE, "--window", "60"), self.lines(FILE))
        self.assertEqual(self.lines(FILE, "--max-bound", "0.1")[1], 3)

    def test_summary_for_people(self):
        text = self.two_dof(FILE).stdout.decode()
        self.assertTrue(text.startswith("Joint with two axes, stream engine: ready\n"))
        for part in ("heading offset        -68.8 deg   to within ", "carrying angle          8.6 deg",
                     "columns q1_w ... q2_z of the recording", "1500 read, 0 rejected", "exit status        0: "):
            self.assertIn(part, text)


@needs_filter
class Readings(TwoDofTest):
    """Orientations that the program computes."""

    def test_demo(self):
        truth = json.loads(DEMO.with_suffix(".json").read_text())
        lines, status = self.demo(DEMO_CELLS, "--every", "1")
        self.assertEqual(status, 0)
        self.assertIn("ready", [line["event"] for line in lines])
        for line in lines:
            self.assertEqual(list(line), KEYS)
            if line["status"] == "ready":
                for k in (0, 1):
                    axis = line[f"axis{k + 1}"]
                    self.assertLess(angle_deg(axis, truth[f"axis{k + 1}"]), line["uncertainty_deg"][k])
                    self.assertGreater(max(axis, key=abs), 0.0)
        self.assertAlmostEqual(abs(lines[-1]["carrying_angle_deg"]), truth["carrying_angle_deg"], delta=1.0)
        self.assertIn("by VQF", self.run_program("two-dof", str(DEMO)).stdout.decode())

    def test_half_of_the_columns_are_not_used(self):
        header = DEMO.read_text().splitlines()[0].split(",") + COLUMNS[13:17]
        text = recordings.csv([row + ["x", "", "1", "2"] for row in DEMO_CELLS], header)
        self.assertEqual(self.lines(text), self.demo(DEMO_CELLS))

    def test_shift_of_time_changes_no_bit(self):
        expected = self.demo(DEMO_CELLS, "--every", "1")[0]
        for shift_us in (10**15 + 7, -(10**9) - 1):
            shifted = [[recordings.time_text(round(float(row[0]) * 1e6) + shift_us)] + row[1:] for row in DEMO_CELLS]
            got = self.demo(shifted, "--every", "1")[0]
            self.assertEqual([{**line, "t_s": 0} for line in got], [{**line, "t_s": 0} for line in expected])

    def test_lost_packets_are_bridged(self):
        cells = [list(row) for row in DEMO_CELLS]
        for k in range(200, 1900, 50):
            cells[k][1:7] = cells[k - 1][1:7]
        del cells[1510:1514]
        lines, status = self.demo(cells)
        plain = self.demo(DEMO_CELLS)[0]
        self.assertEqual((status, lines[-1]["rejected_by"]["repeated"], lines[-1]["rejected"]), (0, 34, 34))
        # What lines between neighbours leave: hundredths of a degree each time, measured in orientations.h.
        self.assertAlmostEqual(lines[-1]["heading_offset_deg"], plain[-1]["heading_offset_deg"], delta=1.5)

    def test_a_long_hole_starts_again(self):
        lines = self.demo(DEMO_CELLS[:1600] + DEMO_CELLS[1700:], "--every", "0.1")[0]
        at = [line["t_s"] for line in lines].index(34)
        self.assertEqual([line["status"] for line in (lines[at - 2], lines[at + 1])], ["ready", "collecting"])
        self.assertEqual(lines[-1]["rejected_by"]["gap"], 1)

    def test_wrong_units_are_no_calibration(self):
        cells = [row[:1] + [str(float(cell) * 57.3) if k % 6 < 3 else cell for k, cell in enumerate(row[1:])]
                 for row in DEMO_CELLS]
        lines, status = self.demo(cells)
        self.assertEqual((status, lines[-1]["reason"], lines[-1]["hint"]), (3, "wrong_units_gyr", "check_sensors"))

    def test_a_sensor_that_fails_ends_ready(self):
        cells = DEMO_CELLS[:1900] + [row[:7] + DEMO_CELLS[1899][7:] for row in DEMO_CELLS[1900:]]
        lines, status = self.demo(cells)
        self.assertEqual((status, lines[-1]["status"], lines[-1]["reason"]), (3, "collecting", "bad_samples"))

    def test_short_recordings(self):
        for count in (0, 1, 2, 49, 50, 51):
            lines, status = self.demo(DEMO_CELLS[:count])
            self.assertEqual((status, lines[-1]["samples"], lines[-1]["rejected"]), (3, count, 0))

    def test_errors_come_after_the_rows_before_them(self):
        text = recordings.csv(DEMO_CELLS[:40], DEMO.read_text().splitlines()[0].split(",")) + "1,2,3\n"
        result = self.two_dof(text, "--json", "--every", "0.2")
        self.assertEqual(result.stderr, b"r.csv:42: short line: 3 of 13 cells\n")
        self.assertEqual([line["t_s"] for line in self.parse(result.stdout)], [0.2, 0.4, 0.6])

    def test_rows_too_far_apart(self):
        slow = [[str(k)] + row[1:] for k, row in enumerate(DEMO_CELLS[:60])]
        self.assert_error(self.two_dof(recordings.csv(slow, DEMO.read_text().splitlines()[0].split(",")), "--json"),
                          "r.csv: rows are 1 s apart: orientations from rates need 10 to 10000 rows a second")

    @unittest.skipUnless(RIG, "no recordings: JOINTCAL_DATA names their folder")
    def test_rig(self):
        for path in RIG:
            result = self.run_program("two-dof", str(path), "--json")
            self.assertEqual(result.returncode, 0, path.name)
            end = self.parse(result.stdout)[-1]
            self.assertLess(angle_deg(end["axis1"], (0, 1, 0)), 1.3, path.name)
            self.assertLess(angle_deg(end["axis2"], (0, 0, 1)), 1.3, path.name)


class Refused(TwoDofTest):
    def test_help(self):
        result = self.run_program("two-dof", "--help")
        self.assertEqual(result.returncode, 0)
        for option in ("constraint", "engine", "n-max", "window", "every", "max-bound", "json"):
            self.assertIn("--" + option, result.stdout.decode())

    def test_options_that_do_not_go_together(self):
        self.assert_usage(["two-dof", "a", "--n-max", "100"], "--n-max goes with --engine window only")
        self.assert_usage(["two-dof", "a", "--engine", "window", "--constraint", "combined"], "--constraint combined")
        self.assert_usage(["two-dof", "a", "--engine", "window", "--n-max", "100", "--window", "5"],
                          "--n-max and --window")
        self.assert_usage(["two-dof", "a", "--sign-hint", "same"], "--sign-hint is for a hinge")

    def test_values_of_options(self):
        self.assert_usage(["two-dof"], "which recording")
        self.assert_usage(["two-dof", "a", "b", "c"], "'c' is a third one")
        self.assert_usage(["two-dof", "a", "--constraint", "both"], "--constraint: 'both' is neither")
        for value in ("0", "1.9", "601", "x", "nan"):
            self.assert_usage(["two-dof", "a", "--window=" + value], "--window")
        for value in ("0.9", "501", "x"):
            self.assert_usage(["two-dof", "a", "--engine=window", "--window=" + value], "--window")
        for value in ("19", "20.5", "10001", "70000", "x"):
            self.assert_usage(["two-dof", "a", "--engine=window", "--n-max=" + value], "--n-max")
        for value in ("0", "60", "x", "inf"):
            self.assert_usage(["two-dof", "a", "--max-bound=" + value], "--max-bound")

    def test_part_of_an_orientation(self):
        columns = [name for name in COLUMNS if name not in ("q2_w", "q2_y")]
        cells = [[cell for name, cell in zip(COLUMNS, row, strict=True) if name in columns] for row in CELLS[:9]]
        column = ",".join(columns).index("q2_x") + 1
        self.assert_error(self.two_dof(recordings.csv(cells, columns)),
                          f"r.csv:1:{column}: q2_x without q2_w, q2_y: an orientation has four columns")
        hinge = self.run_program("hinge", self.write(recordings.csv(cells, columns)), "--json")
        self.assertEqual((hinge.returncode, hinge.stderr), (3, b""))

    def test_broken_recordings(self):
        cells = [list(row) for row in CELLS[:50]]
        cells[3][COLUMNS.index("q1_z")] = "up"
        position = len(",".join(cells[3][:COLUMNS.index("q1_z")])) + 2
        self.assert_error(self.two_dof(recordings.csv(cells, COLUMNS)),
                          f"r.csv:5:{position}: q1_z: 'up' is not a number")
        self.assert_error(self.two_dof("t_s\n"), "r.csv:1: missing columns " + ", ".join(RAW[1:]))
        self.assert_error(self.two_dof(""), "r.csv: the file is empty")
        self.assert_error(self.two_dof(FILE + FILE), f"r.csv:{len(CELLS) + 2}: a second header line")
        self.assert_error(self.run_program("two-dof", "absent.csv"), "absent.csv: No such file or directory")

    @unittest.skipUnless(WITHOUT_FILTER, "the program was built with VQF")
    def test_without_the_filter(self):
        result = self.two_dof(recordings.csv(CELLS[:9], COLUMNS))
        self.assertEqual(result.returncode, 3)
        result = self.run_program("two-dof", str(DEMO))
        self.assertEqual(result.returncode, 2)
        self.assertIn(b"tools/vqf.sh", result.stderr)
