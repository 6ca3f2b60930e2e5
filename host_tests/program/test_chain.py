# SPDX-License-Identifier: MIT
"""`jointcal chain`: keys, numbers against the truth of the bundled recording, what it rejects and refuses."""
import json
import math
import pathlib

import recordings
from support import FILE as TWO_SENSORS
from support import REJECT_KEYS, WITHOUT_FILTER, ProgramTest, needs_filter

DEMO = pathlib.Path(__file__).resolve().parents[2] / "tools/demo/chain_demo.csv"
TRUTH = json.loads(DEMO.with_suffix(".json").read_text())
PLACES = ["hip_to_pelvis_m", "hip_to_thigh_m", "knee_to_thigh_m", "knee_to_shank_m"]
KEYS = ["event", "t_s", "status", "engine", "weak", "hint", "reason", *PLACES, "uncertainty_m", "segment_length_m",
        "uncertainty_segment_m", "model", "lag_s", "advice", "samples", "rejected", "rejected_by"]
FILE = DEMO.read_text()
COLUMNS = FILE.split("\n", 1)[0].split(",")
CELLS = [line.split(",") for line in FILE.splitlines()[1:]]
PERSON = recordings.csv(recordings.texts(recordings.leg_rows(20)), recordings.LEG_COLUMNS)
THIGH_PLACES = PLACES[1:3]


class ChainTest(ProgramTest):
    def chain(self, text, *arguments):
        return self.run_program("chain", self.write(text), *arguments)

    def lines(self, text, *arguments):
        result = self.chain(text, "--json", *arguments)
        self.assertEqual(result.stderr, b"")
        return self.parse(result.stdout), result.returncode

    def errors(self, line, truth=TRUTH):
        return [math.dist(line[name], truth[name]) for name in PLACES]


class Accepted(ChainTest):
    def test_every_line_has_every_key(self):
        for arguments in ([], *[["--method", "ls"]] * (not WITHOUT_FILTER)):
            lines, _ = self.lines(FILE, "--every", "2", *arguments)
            for line in lines:
                self.assertEqual(list(line), KEYS)
                self.assertEqual(list(line["rejected_by"]), REJECT_KEYS)
                self.assertEqual(line["engine"], "stream")
            for key in [*PLACES, "uncertainty_m", "segment_length_m", "uncertainty_segment_m", "model"]:
                self.assertIsNone(lines[0][key])
            events = [line["event"] for line in lines]
            self.assertEqual((events[0], events[-1], events.count("end")), ("estimate", "end", 1))

    def test_truth(self):
        for method in ("ss", "sa"):
            lines, status = self.lines(FILE, "--every", "0.5", "--method", method)
            self.assertEqual((status, lines[-1]["status"], lines[-1]["model"]), (0, "ready", "rigid"), method)
            self.assertIn("ready", [line["event"] for line in lines])
            for line in lines:
                if line["status"] == "ready":
                    for error, bound in zip(self.errors(line), line["uncertainty_m"], strict=True):
                        self.assertLess(error, bound)
                    self.assertLess(abs(line["segment_length_m"] - TRUTH["segment_length_m"]), line["uncertainty_segment_m"])
            self.assertLess(max(self.errors(lines[-1])), 0.002)

    @needs_filter
    def test_both_orientations_and_columns_of_them(self):
        """--method ls computes orientations, and says so."""
        lines, _ = self.lines(FILE, "--method", "ls")
        self.assertLess(max(self.errors(lines[-1])), 0.02)
        self.assertIn("computed", self.chain(FILE, "--method", "ls").stdout.decode())

    def test_a_known_length_is_kept_to(self):
        plain = self.lines(FILE)[0][-1]
        known = self.lines(FILE, "--thigh-length", "0.42")[0][-1]
        self.assertLess(known["uncertainty_segment_m"], plain["uncertainty_segment_m"])
        self.assertLess(abs(known["segment_length_m"] - 0.42), 0.002)
        wrong, status = self.lines(FILE, "--thigh-length", "0.3")
        self.assertNotEqual((status, wrong[-1]["status"]), (0, "ready"))

    def test_axes_of_a_knee_choose_the_point_next_to_both_sensors(self):
        self.write(self.run_program("hinge", self.write(TWO_SENSORS, "h.csv"), "--json").stdout, "axes.jsonl")
        axes = json.loads((self.folder / "axes.jsonl").read_text().splitlines()[-1])
        end = self.lines(FILE, "--calibration", "axes.jsonl")[0][-1]
        along = sum(a * b for axis, place in (("axis1", "knee_to_thigh_m"), ("axis2", "knee_to_shank_m"))
                    for a, b in zip(axes[axis], end[place], strict=True))
        self.assertLess(abs(along), 1e-4)

    def test_every_form_gives_the_same_bytes(self):
        expected = self.chain(FILE, "--json", "--every", "1").stdout
        backward = recordings.csv([row[::-1] for row in CELLS], COLUMNS[::-1])
        for text in (FILE.replace("\n", "\r\n"), "\ufeff" + FILE, backward):
            self.assertEqual(self.chain(text, "--json", "--every", "1").stdout, expected)
        self.assertEqual(self.run_program("chain", "-", "--json", "--every", "1", stdin=FILE).stdout, expected)

    def test_rejected_rows(self):
        cells = [list(row) for row in CELLS]
        cells[200][COLUMNS.index("gyr3_x")] = "nan"
        cells[300][0] = ""
        cells[400][COLUMNS.index("acc3_x")] = "4000"
        cells[500][0] = cells[499][0]
        for method in ("ss", *["ls"] * (not WITHOUT_FILTER)):
            lines, _ = self.lines(recordings.csv(cells, COLUMNS), "--method", method)
            self.assertEqual(lines[-1]["samples"], len(cells))
            self.assertEqual((lines[-1]["rejected"], lines[-1]["rejected_by"]["time_order"]), (4, 1), method)
            self.assertEqual((lines[-1]["rejected_by"]["not_finite"], lines[-1]["rejected_by"]["out_of_range"]), (2, 1), method)

    def test_options_count(self):
        plain = self.lines(FILE)
        for option in ("--smoothing=0", "--smoothing=0.3", "--window=10", "--method=sa"):
            self.assertNotEqual(self.lines(FILE, option), plain, option)
        self.assertEqual(self.lines(FILE, "--engine=stream"), plain)
        self.assertEqual(self.lines(FILE, "--max-bound", "0.0012")[1], 3)

    def test_a_still_shank_keeps_the_knee_from_being_ready(self):
        cells = [list(row) for row in CELLS]
        for row in cells:
            row[COLUMNS.index("gyr3_x"):COLUMNS.index("gyr3_x") + 6] = ["0.001", "-0.002", "0.001", "0.1", "0.2", "9.8"]
        lines, status = self.lines(recordings.csv(cells, COLUMNS))
        self.assertEqual(status, 3)
        self.assertNotIn("ready", [line["status"] for line in lines])

    def test_summary_for_people(self):
        text = self.chain(FILE).stdout.decode()
        self.assertTrue(text.startswith("Hip and knee, stream engine: ready\n"))
        for part in ("hip to pelvis        -156", "knee to shank ", "from hip to knee      4", " mm   to within ",
                     "to within 10 mm (95 % confidence)", "1500 read, 0 rejected", "exit status        0: "):
            self.assertIn(part, text)

    def test_nothing(self):
        lines, status = self.lines(recordings.csv([], COLUMNS))
        self.assertEqual((status, lines[0]["samples"], lines[0]["t_s"]), (3, 0, None))


class Person(ChainTest):
    """Sensors that rock on their segments as skin does."""

    def test_the_functional_model_speaks_and_is_ready_for_what_skin_allows(self):
        lines, status = self.lines(PERSON, "--max-bound", "0.06", "--every", "1")
        self.assertEqual((status, lines[-1]["status"], lines[-1]["model"]), (0, "ready", "functional"))
        self.assertIsNone(lines[-1]["weak"])
        for line in lines:
            self.assertEqual(list(line), KEYS)
            if line["model"] == "functional" and line["uncertainty_m"] is not None:
                for error, bound in zip(self.errors(line, recordings.LEG_PLACES), line["uncertainty_m"], strict=True):
                    self.assertTrue(bound is None or error < bound, line)
            if line["status"] == "ready":
                self.assertLess(abs(line["segment_length_m"] - recordings.LEG_THIGH_M), line["uncertainty_segment_m"])
                self.assertAlmostEqual(line["uncertainty_segment_m"], sum(line["uncertainty_m"][1:3]), places=6)
        self.assertEqual(lines[-1]["samples"], 1000)

    def test_ten_millimetres_are_never_reached(self):
        lines, status = self.lines(PERSON, "--every", "1")
        self.assertEqual((status, lines[-1]["model"], lines[-1]["reason"]), (3, "functional", "uncertain"))
        self.assertNotIn("ready", [line["status"] for line in lines])

    def test_a_known_thigh_takes_the_share_of_skin_out(self):
        plain = self.lines(PERSON, "--max-bound", "0.06")[0][-1]
        for length in (0.9 * recordings.LEG_THIGH_M, recordings.LEG_THIGH_M):
            line, status = self.lines(PERSON, "--max-bound", "0.06", "--thigh-length", str(length))
            known = line[-1]
            self.assertEqual((status, known["model"]), (0, "functional"))
            self.assertAlmostEqual(known["segment_length_m"], length, places=6)
            for place, found in plain.items():
                if place in THIGH_PLACES:
                    factor = length / plain["segment_length_m"]
                    self.assertLess(math.dist(known[place], [factor * value for value in found]), 1e-6)
                elif place in PLACES:
                    self.assertEqual(known[place], found)
            for k in (1, 2):
                self.assertLess(known["uncertainty_m"][k], plain["uncertainty_m"][k])
            for k in (0, 3):
                self.assertEqual(known["uncertainty_m"][k], plain["uncertainty_m"][k])

    def test_a_thigh_that_cannot_be_has_no_bounds(self):
        lines, status = self.lines(PERSON, "--max-bound", "0.06", "--thigh-length", "0.7")
        end = lines[-1]
        self.assertEqual((status, end["status"], end["reason"], end["hint"]), (3, "collecting", "does_not_fit", "check_sensors"))
        self.assertEqual([bound is None for bound in end["uncertainty_m"]], [False, True, True, False])
        self.assertIsNone(end["uncertainty_segment_m"])
        self.assertLess(abs(end["segment_length_m"] - recordings.LEG_THIGH_M), 0.02)

    def test_a_still_pelvis_leaves_the_others_known(self):
        cells = recordings.texts(recordings.leg_rows(20, turns_pelvis=False))
        lines, status = self.lines(recordings.csv(cells, recordings.LEG_COLUMNS), "--max-bound", "0.06")
        end = lines[-1]
        self.assertEqual((status, end["model"], end["weak"], end["hint"]), (3, "functional", "center1", "move_segment1"))
        errors = self.errors(end, recordings.LEG_PLACES)
        for error, bound in zip(errors[1:], end["uncertainty_m"][1:], strict=True):
            self.assertLess(error, bound)
            self.assertLess(bound, 0.06)
        self.assertTrue(end["uncertainty_m"][0] is None or errors[0] < end["uncertainty_m"][0])
        text = self.chain(recordings.csv(cells, recordings.LEG_COLUMNS), "--max-bound", "0.06").stdout.decode()
        self.assertIn("centre of the hip", text)
        self.assertIn("turn the pelvis", text)

    def test_rigid_segments_that_a_length_contradicts_are_not_ready(self):
        rigid = recordings.csv(recordings.texts(recordings.leg_rows(20, rock_rad=0.0)), recordings.LEG_COLUMNS)
        self.assertEqual(self.lines(rigid)[0][-1]["model"], "rigid")
        end = self.lines(rigid, "--max-bound", "0.06", "--thigh-length", "0.35")[0][-1]
        self.assertEqual((end["status"], end["reason"], end["model"]), ("collecting", "does_not_fit", "rigid"))

    def test_rates_that_shake_do_not_make_the_rigid_model_speak(self):
        """Its levers shrink to nothing then, with bounds of centimetres."""
        cells = [list(row) for row in CELLS]
        for row in cells:
            for k in range(9):
                at = COLUMNS.index(f"gyr{k // 3 + 1}_{'xyz'[k % 3]}")
                row[at] = f"{float(row[at]) + 2 * math.sin(2 * math.pi * (8 + 0.7 * (k // 3) + 0.3 * k) * float(row[0]) + k):.6f}"
        lines, _ = self.lines(recordings.csv(cells, COLUMNS), "--max-bound", "0.1", "--every", "1")
        for line in lines:
            self.assertFalse(line["status"] == "ready" and line["model"] == "rigid", line)
            if line["uncertainty_m"] is not None:
                for name, bound in zip(PLACES, line["uncertainty_m"], strict=True):
                    self.assertTrue(bound is None or math.dist(line[name], TRUTH[name]) < bound, line)
        self.assertEqual(lines[-1]["model"], "functional")

    def test_summary_for_people(self):
        text = self.chain(PERSON, "--max-bound", "0.06").stdout.decode()
        self.assertTrue(text.startswith("Hip and knee, stream engine: ready\n"))
        for part in ("model              functional: ", "to within 60 mm (95 % confidence)", "from hip to knee      "):
            self.assertIn(part, text)
        self.assertNotIn("functional", self.chain(FILE).stdout.decode())


class Refused(ChainTest):
    def test_help(self):
        result = self.run_program("chain", "--help")
        self.assertEqual(result.returncode, 0)
        for option in ("method", "smoothing", "thigh-length", "calibration", "engine", "window", "every", "max-bound", "json"):
            self.assertIn("--" + option, result.stdout.decode())
        self.assertIn("chain", self.run_program("--help").stdout.decode())

    def test_options_that_are_not_for_a_chain(self):
        self.assert_usage(["chain", "a", "--n-max", "100"], "--n-max goes with --engine window")
        self.assert_usage(["chain", "a", "--engine", "window"], "the chain has the stream engine only")
        self.assert_usage(["chain", "a", "--sign-hint", "same"], "--sign-hint is for a hinge")

    def test_values_of_options(self):
        self.assert_usage(["chain"], "which recording")
        self.assert_usage(["chain", "a", "b"], "'b' is a second one")
        self.assert_usage(["chain", "a", "--method", "best"], "--method: 'best' is neither ss, sa nor ls")
        for option, values in (("window", ("0", "9", "3601", "x")), ("max-bound", ("0", "0.2", "10", "x", "inf")),
                               ("thigh-length", ("0", "0.09", "1.1", "42", "x")), ("smoothing", ("-1", "2.1", "x"))):
            for value in values:
                self.assert_usage(["chain", "a", f"--{option}={value}"], "--" + option)

    def test_two_sensors_are_too_few(self):
        self.assert_error(self.chain(TWO_SENSORS), "r.csv:1: missing columns gyr3_x, gyr3_y, gyr3_z, acc3_x, acc3_y, acc3_z")

    def test_calibrations_of_no_use(self):
        self.write(FILE)
        self.assert_error(self.run_program("chain", "r.csv", "--calibration", "none"), "none: No such file or directory")
        self.write(self.chain(FILE, "--json").stdout, "other.jsonl")
        result = self.run_program("chain", "r.csv", "--calibration", "other.jsonl")
        self.assertEqual(result.returncode, 2)
        self.assertIn(b"no calibration of a hinge", result.stderr)

    def test_broken_recordings(self):
        self.assert_error(self.chain(""), "r.csv: the file is empty")
        self.assert_error(self.chain(FILE + FILE), f"r.csv:{len(CELLS) + 2}: a second header line")
        self.assert_error(self.chain(FILE + "1,2,3\n"), f"r.csv:{len(CELLS) + 2}: short line: 3 of {len(COLUMNS)} cells")
        gyr = COLUMNS.index("gyr3_y")
        cells = [row[:gyr] + ["much"] + row[gyr + 1:] for row in CELLS[:2]]
        result = self.chain(recordings.csv(cells, COLUMNS))
        self.assertEqual(result.returncode, 2)
        self.assertIn(b"gyr3_y", result.stderr)
