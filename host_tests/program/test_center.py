# SPDX-License-Identifier: MIT
"""`jointcal center`: keys, numbers against truth, methods, hinges, and what it refuses."""
import math
import os
import pathlib
import unittest

import recordings
from support import REJECT_KEYS, ProgramTest

ROOT = pathlib.Path(__file__).resolve().parents[2]
DATA = pathlib.Path(os.environ.get("JOINTCAL_DATA", ROOT / "data"))
RIG = sorted(DATA.glob("rig_3D_*.csv"))
KEYS = ["event", "t_s", "status", "engine", "weak", "hint", "reason", "joint_to_sensor1_m", "joint_to_sensor2_m",
        "uncertainty_m", "weakest_direction1", "weakest_direction2", "uncertainty_weakest_m", "acc_bias1_m_s2",
        "acc_bias2_m_s2", "heading_offset_deg", "model", "misfit", "lag_s", "advice",
        "samples", "rejected", "rejected_by"]
WINDOW_KEYS = KEYS[:19] + ["paper_accepted"] + KEYS[19:]
ALL = recordings.COLUMNS + recordings.ORIENTATION_COLUMNS
CELLS = recordings.texts(recordings.center_rows(25))
FILE = recordings.csv(CELLS, ALL)
HINGE_CELLS = recordings.texts(recordings.center_rows(25, free=1))
HINGE = recordings.csv(HINGE_CELLS, ALL)


class CenterTest(ProgramTest):
    def center(self, text, *arguments):
        return self.run_program("center", self.write(text), *arguments)

    def lines(self, text, *arguments):
        result = self.center(text, "--json", *arguments)
        self.assertEqual(result.stderr, b"")
        return self.parse(result.stdout), result.returncode

    def assert_inside(self, line):
        for found, truth, bound in zip((line["joint_to_sensor1_m"], line["joint_to_sensor2_m"]),
                                       (recordings.R1, recordings.R2), line["uncertainty_m"], strict=True):
            self.assertLess(math.dist(found, truth), bound)


class Accepted(CenterTest):
    def test_every_line_has_every_key(self):
        for arguments, keys in (([], KEYS), (["--engine", "window"], WINDOW_KEYS), (["--method", "ls"], KEYS)):
            lines, _ = self.lines(FILE, "--every", "0.5", *arguments)
            for line in lines:
                self.assertEqual(list(line), keys)
                self.assertEqual(list(line["rejected_by"]), REJECT_KEYS)
            for key in ("joint_to_sensor1_m", "uncertainty_m", "weakest_direction2", "heading_offset_deg", "misfit"):
                self.assertIsNone(lines[0][key])
            events = [line["event"] for line in lines]
            self.assertEqual((events[0], events[-1], events.count("end")), ("estimate", "end", 1))

    def test_truth(self):
        for method in ("ss", "sa", "ls"):
            for engine in (["--engine", "stream"], ["--engine", "window", "--window", "25"]):
                lines, status = self.lines(FILE, "--every", "1", "--method", method, *engine)
                self.assertEqual((status, lines[-1]["status"]), (0, "ready"), (method, engine))
                self.assertIn("ready", [line["event"] for line in lines])
                for line in lines:
                    if line["status"] == "ready":
                        self.assert_inside(line)
                end = lines[-1]
                self.assertLess(math.dist(end["joint_to_sensor1_m"], recordings.R1), 0.002)
                self.assertLess(math.dist(end["joint_to_sensor2_m"], recordings.R2), 0.002)
                if method == "ls":
                    self.assertAlmostEqual(end["heading_offset_deg"], math.degrees(recordings.CENTER_HEADING), delta=0.3)
                    self.assertIsNone(end["acc_bias1_m_s2"])
                else:
                    self.assertIsNone(end["heading_offset_deg"])
                    self.assertLess(math.hypot(*end["acc_bias1_m_s2"]), 0.05)

    def test_a_hinge_is_open_along_its_axis_unless_that_is_known(self):
        lines, status = self.lines(HINGE)
        self.assertEqual((status, lines[-1]["hint"]), (3, "more_directions"))
        self.assertGreater(abs(lines[-1]["weakest_direction1"][2]), 0.95)
        self.write(self.run_program("hinge", self.write(HINGE), "--json").stdout, "axes.jsonl")
        lines, status = self.lines(HINGE, "--calibration", "axes.jsonl")
        self.assertEqual(status, 0)
        for found, truth in ((lines[-1]["joint_to_sensor1_m"], recordings.R1),
                             (lines[-1]["joint_to_sensor2_m"], recordings.R2)):
            self.assertLess(math.dist(found[:2], truth[:2]), 0.004)
        self.assertIsNone(lines[-1]["uncertainty_weakest_m"])
        text = self.center(HINGE, "--calibration", "axes.jsonl").stdout.decode()
        self.assertIn("along the axis", text)
        self.assertIn("uncertainty unknown", text)

    def test_every_form_gives_the_same_bytes(self):
        expected = self.center(FILE, "--json", "--every", "1").stdout
        backward = recordings.csv([row[::-1] for row in CELLS], ALL[::-1])
        for text in (FILE.replace("\n", "\r\n"), "\ufeff" + FILE, backward):
            self.assertEqual(self.center(text, "--json", "--every", "1").stdout, expected)
        self.assertEqual(self.run_program("center", "-", "--json", "--every", "1", stdin=FILE).stdout, expected)

    def test_shift_of_time_changes_no_bit(self):
        rows = recordings.center_rows(10)
        for method in ("ss", "ls"):
            expected = self.lines(recordings.csv(recordings.texts(rows), ALL), "--every", "1", "--method", method)[0]
            for shift_us in (10**15 + 7, -(10**9) - 1):
                got = self.lines(recordings.csv(recordings.texts(rows, shift_us), ALL), "--every", "1", "--method", method)[0]
                self.assertEqual([{**line, "t_s": 0} for line in got], [{**line, "t_s": 0} for line in expected])

    def test_rejected_rows(self):
        cells = [list(row) for row in CELLS]
        cells[200][ALL.index("gyr2_x")] = "nan"
        cells[300][0] = ""
        cells[400][ALL.index("acc1_x")] = "4000"
        cells[500][0] = cells[499][0]
        cells[600][1:7] = cells[599][1:7]
        for method in ("ss", "ls"):
            lines, status = self.lines(recordings.csv(cells, ALL), "--method", method)
            self.assertEqual(status, 0)
            self.assertEqual(lines[-1]["samples"], len(cells))
            self.assertEqual(lines[-1]["rejected_by"], {"not_finite": 2, "out_of_range": 1, "saturated": 0, "frozen": 0,
                                                        "repeated": 1, "time_order": 1, "gap": 0}, method)

    def test_options_count(self):
        plain = self.lines(FILE)
        for option in ("--derivative=symmetric", "--smoothing=0", "--smoothing=0.2", "--min-rate=2", "--acc-bias=0", "--window=10"):
            self.assertNotEqual(self.lines(FILE, option), plain, option)
        self.assertEqual(self.lines(FILE, "--max-bound", "0.0012")[1], 3)
        self.assertEqual(self.lines(FILE, "--engine=window", "--n-max=400"), self.lines(FILE, "--engine=window", "--window=8"))

    def test_summary_for_people(self):
        text = self.center(FILE).stdout.decode()
        self.assertTrue(text.startswith("Joint centre, stream engine: ready\n"))
        for part in ("joint to sensor 1    -1", " mm   to within ", "to within 10 mm (95 % confidence)", "1250 read, 0 rejected",
                     "exit status        0: "):
            self.assertIn(part, text)
        self.assertIn("columns q1_w", self.center(FILE, "--method", "ls").stdout.decode())
        events = self.center(FILE, "--every", "5").stdout.decode().splitlines()
        self.assertIn("centre to within", events[-9] + events[2] + events[3])

    def test_nothing(self):
        lines, status = self.lines(recordings.csv([], ALL))
        self.assertEqual((status, lines[0]["samples"], lines[0]["t_s"]), (3, 0, None))

    @unittest.skipUnless(RIG, "no recordings: JOINTCAL_DATA names their folder")
    def test_rig(self):
        ends = []
        for path in RIG:
            result = self.run_program("center", str(path), "--json")
            self.assertEqual(result.returncode, 0, path.name)
            ends.append(self.parse(result.stdout)[-1])
        for end in ends:  # the same sockets in all of them
            for key in ("joint_to_sensor1_m", "joint_to_sensor2_m"):
                self.assertLess(math.dist(end[key], ends[0][key]), 0.004)


class Refused(CenterTest):
    def test_help(self):
        result = self.run_program("center", "--help")
        self.assertEqual(result.returncode, 0)
        for option in ("method", "derivative", "smoothing", "min-rate", "acc-bias", "calibration", "engine", "n-max", "window", "every",
                       "max-bound", "json"):
            self.assertIn("--" + option, result.stdout.decode())
        self.assertIn("For research, ls:", " ".join(result.stdout.decode().split()))
        self.assertIn("center", self.run_program("--help").stdout.decode())

    def test_options_that_do_not_go_together(self):
        self.assert_usage(["center", "a", "--n-max", "100"], "--n-max goes with --engine window only")
        self.assert_usage(["center", "a", "--engine", "window", "--n-max", "100", "--window", "5"], "--n-max and --window")
        self.assert_usage(["center", "a", "--sign-hint", "same"], "--sign-hint is for a hinge")

    def test_values_of_options(self):
        self.assert_usage(["center"], "which recording")
        self.assert_usage(["center", "a", "b", "c"], "'c' is a third one")
        self.assert_usage(["center", "a", "--method", "best"], "--method: 'best' is neither ss, sa nor ls")
        self.assert_usage(["center", "a", "--derivative", "x"], "--derivative: 'x' is neither")
        for option, values in (("window", ("0", "9", "3601", "x")), ("max-bound", ("0", "0.2", "10", "x", "inf")),
                               ("acc-bias", ("-1", "2.1", "x")), ("min-rate", ("-1", "21", "nan")), ("smoothing", ("-1", "2.1", "x"))):
            for value in values:
                self.assert_usage(["center", "a", f"--{option}={value}"], "--" + option)
        for value in ("49", "20001", "70000", "50.5", "x"):
            self.assert_usage(["center", "a", "--engine=window", "--n-max=" + value], "--n-max")
        for value in ("0.5", "401"):
            self.assert_usage(["center", "a", "--engine=window", "--window=" + value], "--window")

    def test_calibrations_of_no_use(self):
        self.write(FILE)
        self.assert_error(self.run_program("center", "r.csv", "--calibration", "none"), "none: No such file or directory")
        self.write(self.center(FILE, "--json").stdout, "other.jsonl")
        result = self.run_program("center", "r.csv", "--calibration", "other.jsonl")
        self.assertEqual(result.returncode, 2)
        self.assertIn(b"no calibration of a hinge", result.stderr)

    def test_broken_recordings(self):
        self.assert_error(self.center(""), "r.csv: the file is empty")
        self.assert_error(self.center("t_s\n"), "r.csv:1: missing columns " + ", ".join(recordings.COLUMNS[1:]))
        self.assert_error(self.center(FILE + FILE), f"r.csv:{len(CELLS) + 2}: a second header line")
        columns = [name for name in ALL if name != "q2_w"]
        cells = [[c for name, c in zip(ALL, row, strict=True) if name != "q2_w"] for row in CELLS[:9]]
        result = self.center(recordings.csv(cells, columns), "--method", "ls")
        self.assertEqual(result.returncode, 2)
        self.assertIn(b"an orientation has four columns", result.stderr)
