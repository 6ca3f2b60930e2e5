# SPDX-License-Identifier: MIT
"""`jointcal angles`: columns, rows before ready, calibrations, zero and signs, storage files, and what it refuses."""
import json
import math
import unittest

import recordings
from support import ProgramTest

COLUMNS = recordings.COLUMNS + recordings.ORIENTATION_COLUMNS
HINGE_CELLS = recordings.texts(recordings.hinge_with_orientations(30))
HINGE = recordings.csv(HINGE_CELLS, COLUMNS)
ELBOW_ROWS = recordings.two_dof_rows(30)
ELBOW_CELLS = recordings.texts(ELBOW_ROWS)
ELBOW = recordings.csv(ELBOW_CELLS, COLUMNS)
HINGE_LINE = {"event": "end", "t_s": 5, "status": "ready", "weak": None, "axis1": [0, 0, 1], "axis2": [0, 0, 1],
              "uncertainty_deg": [1.0, 1.0], "sign_margin": 12.5, "rejected": 0, "rejected_by": {"gap": 0, "frozen": 1}}
ELBOW_LINE = {"event": "ready", "t_s": 5, "status": "ready", "axis1": [0, 0, 1], "axis2": [0, 1, 0],
              "heading_offset_deg": 1.0, "carrying_angle_deg": math.degrees(0.15), "paper_accepted": True}
TWO_DOF_HEADER = "t_s,flexion_deg,pronation_deg,carrying_deg,heading_offset_deg"
# Seven digits in the file, single precision, and the heading, which smoothing takes from data that fit exactly.
EXACT_DEG = 0.02


def apart(a, b):
    return abs((a - b + 180.0) % 360.0 - 180.0)


class AnglesTest(ProgramTest):
    def angles(self, text, joint, *arguments):
        return self.run_program("angles", self.write(text), "--joint", joint, *arguments)

    def calibration(self, *lines):
        return self.write("".join(json.dumps(line) + "\n" for line in lines), "line.json")

    def rows(self, result, status=0):
        """Header and rows of numbers; None for empty cells."""
        self.assertEqual(result.stderr, b"")
        self.assertEqual(result.returncode, status)
        lines = result.stdout.decode().splitlines()
        return lines[0], [[float(cell) if cell else None for cell in line.split(",")] for line in lines[1:]]

    def with_calibration(self, text, *arguments):
        return self.rows(self.angles(text, "two-dof", "--calibration", self.calibration(ELBOW_LINE), *arguments))[1]


class Hinge(AnglesTest):
    def test_rows_are_empty_before_ready_and_right_afterwards(self):
        header, rows = self.rows(self.angles(HINGE, "hinge"))
        self.assertEqual(header, "t_s,flexion_deg")
        self.assertEqual([row[0] for row in rows], [float(cells[0]) for cells in HINGE_CELLS])
        known = [row for row in rows if row[1] is not None]
        self.assertIsNone(rows[0][1])
        self.assertGreater(len(known), 500)
        # Noise of 0.01 rad/s makes axes that are some tenths of a degree off, and where zero lies depends on them.
        errors = [row[1] - math.degrees(recordings.bend(row[0])) for row in known]
        middle = sorted(errors)[len(errors) // 2]
        self.assertLess(max(abs(error - middle) for error in errors), 1.5)

    def test_ready_at_the_same_row_as_the_calibration(self):
        result = self.run_program("hinge", self.write(HINGE), "--json")
        ready = next(line for line in self.parse(result.stdout) if line["event"] == "ready")
        _, rows = self.rows(self.angles(HINGE, "hinge"))
        self.assertEqual(next(row[0] for row in rows if row[1] is not None), ready["t_s"])

    def test_never_ready_leaves_with_3(self):
        short = recordings.csv(HINGE_CELLS[:20], COLUMNS)
        result = self.angles(short, "hinge")
        self.assertEqual(result.stderr.decode(), "r.csv: no row has angles: too few usable samples; what would help: bend and stretch the joint\n")
        result.stderr = b""
        _, rows = self.rows(result, status=3)
        self.assertEqual([row[1] for row in rows], [None] * 20)

    def test_calibration_gives_angles_from_the_first_row_on(self):
        name = self.calibration(HINGE_LINE)
        _, rows = self.rows(self.angles(HINGE, "hinge", "--calibration", name))
        for t, flexion in rows:
            self.assertLess(apart(flexion, math.degrees(recordings.bend(t))), EXACT_DEG)

    def test_output_of_hinge_is_a_calibration(self):
        self.write(self.run_program("hinge", self.write(HINGE), "--json", "--every", "1").stdout, "line.json")
        _, rows = self.rows(self.angles(HINGE, "hinge", "--calibration", "line.json"))
        self.assertNotIn(None, [row[1] for row in rows])

    def test_both_axes_turn_round_together(self):
        name = self.calibration(HINGE_LINE)
        _, rows = self.rows(self.angles(HINGE, "hinge", "--calibration", name, "--axis1-toward", "1,0,-0.1",
                                        "--zero", "first"))
        for t, flexion in rows:
            self.assertLess(apart(flexion, -math.degrees(recordings.bend(t))), EXACT_DEG)


class TwoDof(AnglesTest):
    def test_angles_and_heading_of_the_engine(self):
        header, rows = self.rows(self.angles(ELBOW, "two-dof", "--axis1-toward", "0,0,1", "--axis2-toward", "0,1,0"))
        self.assertEqual(header, TWO_DOF_HEADER)
        self.assertEqual(rows[0][1:], [None] * 4)
        known = [row for row in rows if row[1] is not None]
        self.assertGreater(len(known), 300)
        for t, flexion, pronation, carrying, heading in known:
            truth = [math.degrees(angle) for angle in recordings.elbow(t)]
            # Data without noise; the engine's readiness asks for 3 deg.
            self.assertLess(apart(flexion, truth[0]), 3.0)
            self.assertLess(apart(pronation, truth[1]), 3.0)
            self.assertLess(apart(carrying, math.degrees(0.15)), 3.0)
            self.assertLess(apart(heading, math.degrees(-1.2)), 3.0)

    def test_calibration_needs_a_few_postures_for_the_heading(self):
        rows = self.with_calibration(ELBOW)
        self.assertIsNone(rows[0][1])
        first = next(row[0] for row in rows if row[1] is not None)
        self.assertLess(first, 5.0)
        for t, *angles in rows:
            if t > first:
                truth = [*map(math.degrees, recordings.elbow(t)), math.degrees(0.15), math.degrees(-1.2)]
                for angle, expected in zip(angles, truth):
                    self.assertLess(apart(angle, expected), 5 * EXACT_DEG)

    def test_zero_at_a_time_and_reference(self):
        for t0, reference in ((10.0, None), (10.01, None), (20.0, (30.0, -20.0))):
            more = ["--reference", "%g,%g" % reference] if reference else []
            rows = self.with_calibration(ELBOW, "--zero", str(t0), *more)
            pose = recordings.elbow(math.ceil(t0 * 50 - 1e-9) / 50)
            for t, *angles in rows[1000:]:
                for k in (0, 1):
                    expected = math.degrees(recordings.elbow(t)[k] - pose[k]) + (reference or (0, 0))[k]
                    self.assertLess(apart(angles[k], expected), 5 * EXACT_DEG)

    def test_zero_at_the_first_row_with_angles(self):
        rows = self.with_calibration(ELBOW, "--zero", "first")
        first = next(row for row in rows if row[1] is not None)
        self.assertEqual(first[1:3], [0.0, 0.0])

    def test_zero_at_the_end_of_the_range(self):
        rows = [row for row in self.with_calibration(ELBOW, "--zero", "range") if row[1] is not None]
        for k, span in ((1, 2 * 0.8), (2, 2 * 1.0)):
            self.assertAlmostEqual(min(row[k] for row in rows), 0.0, places=3)
            self.assertLess(abs(max(row[k] for row in rows) - math.degrees(span)), 1.0)

    def test_signs_by_half_space(self):
        for s1 in (1, -1):
            for s2 in (1, -1):
                rows = self.with_calibration(ELBOW, "--zero", "10", f"--axis1-toward=0,0.1,{s1}",
                                             f"--axis2-toward=0.1,{s2},0")
                pose = recordings.elbow(10.0)
                for t, flexion, pronation, carrying, _ in rows[600:]:
                    truth = recordings.elbow(t)
                    self.assertLess(apart(flexion, s1 * math.degrees(truth[0] - pose[0])), 5 * EXACT_DEG)
                    self.assertLess(apart(pronation, s2 * math.degrees(truth[1] - pose[1])), 5 * EXACT_DEG)
                    self.assertLess(apart(carrying, s1 * s2 * math.degrees(0.15)), 5 * EXACT_DEG)

    def test_signs_by_range(self):
        # Zero where flexion is least and pronation most negative, about: mean angles from there are positive.
        least = min(ELBOW_ROWS[500:], key=lambda row: sum(recordings.elbow(row[0])))[0]
        plain = self.with_calibration(ELBOW, "--zero", str(least), "--signs", "range")
        for s1, s2 in ((1, -1), (-1, 1), (-1, -1)):
            line = {**ELBOW_LINE, "axis1": [0, 0, s1], "axis2": [0, s2, 0],
                    "carrying_angle_deg": s1 * s2 * ELBOW_LINE["carrying_angle_deg"]}
            name = self.calibration(line)
            _, rows = self.rows(self.angles(ELBOW, "two-dof", "--calibration", name, "--zero", str(least),
                                            "--signs", "range"))
            for row, expected in zip(rows[500:], plain[500:]):
                for k in range(1, 5):
                    self.assertLess(apart(row[k], expected[k]), EXACT_DEG)
        self.assertGreater(sum(row[1] for row in plain[500:]), 0.0)
        self.assertGreater(sum(row[2] for row in plain[500:]), 0.0)

    def test_what_counts_as_positive(self):
        plain = self.with_calibration(ELBOW)
        for words, s1, s2 in (("flexion,supination", 1, -1), ("extension", -1, 1), ("extension,supination", -1, -1)):
            for row, other in zip(plain[500:], self.with_calibration(ELBOW, "--positive", words)[500:]):
                self.assertEqual(other[1:4], [s1 * row[1], s2 * row[2], row[3]])

    def test_rejected_rows_are_empty(self):
        cells = [list(row) for row in ELBOW_CELLS]
        cells[1000][13] = "nan"
        cells[1001][14] = ""
        cells[1002][13] = "1.5"
        cells[1003][0] = cells[999][0]  # that of the last row of use
        cells[1004][0] = ""
        rows = self.with_calibration(recordings.csv(cells, COLUMNS))
        self.assertEqual([row[1] is None for row in rows[999:1006]], [False] + [True] * 5 + [False])
        self.assertIsNone(rows[1004][0])

    def test_shifted_times_change_no_angle(self):
        shifted = recordings.csv(recordings.texts(ELBOW_ROWS, -10**12), COLUMNS)
        plain = self.angles(ELBOW, "two-dof").stdout.decode().splitlines()[1:]
        moved = self.angles(shifted, "two-dof").stdout.decode().splitlines()[1:]
        self.assertEqual([line.split(",")[1:] for line in plain], [line.split(",")[1:] for line in moved])
        self.assertNotEqual(plain, moved)


class Files(AnglesTest):
    def storage(self, text):
        """Header entries, column names and rows, read as OpenSim's format asks."""
        lines = text.splitlines()
        end = lines.index("endheader")
        entries = dict(line.split("=") for line in lines[1:end])
        return entries, lines[end + 1].split("\t"), [[float(cell) for cell in line.split("\t")] for line in lines[end + 2:]]

    def test_storage_file(self):
        cells = [list(row) for row in ELBOW_CELLS]
        cells[1000][13] = "nan"
        text = recordings.csv(cells, COLUMNS)
        name = self.calibration(ELBOW_LINE)
        result = self.angles(text, "two-dof", "--calibration", name, "--out", "a.sto")
        self.assertEqual((result.stdout, result.stderr, result.returncode), (b"", b"", 0))
        entries, names, rows = self.storage((self.folder / "a.sto").read_text())
        self.assertEqual(entries, {"version": "1", "nRows": str(len(rows)), "nColumns": "5", "inDegrees": "yes"})
        self.assertEqual(names, ["time", "flexion", "pronation", "carrying", "heading_offset"])
        known = [row for row in self.with_calibration(text) if row[1] is not None]
        self.assertEqual(rows, known)

    def test_storage_file_of_a_hinge_without_angles(self):
        short = recordings.csv(HINGE_CELLS[:20], COLUMNS)
        self.assertEqual(self.angles(short, "hinge", "--out", "a.sto").returncode, 3)
        entries, names, rows = self.storage((self.folder / "a.sto").read_text())
        self.assertEqual((entries["nRows"], entries["nColumns"]), ("0", "2"))
        self.assertEqual((names, rows), (["time", "flexion"], []))

    def test_csv_file_is_what_standard_output_would_get(self):
        result = self.angles(HINGE, "hinge", "--out", "a.csv")
        self.assertEqual(result.stdout, b"")
        self.assertEqual((self.folder / "a.csv").read_bytes(), self.angles(HINGE, "hinge").stdout)

    def test_standard_input(self):
        for more in ([], ["--zero", "10"]):
            result = self.run_program("angles", "-", "--joint", "hinge", *more, stdin=HINGE)
            self.assertEqual(result.stdout, self.angles(HINGE, "hinge", *more).stdout)

    def test_output_that_cannot_be_written(self):
        self.assert_error(self.angles(HINGE, "hinge", "--out", "none/a.csv"), "none/a.csv: No such file or directory")


class Refused(AnglesTest):
    def assert_line(self, line, message, joint="two-dof"):
        self.write(line if isinstance(line, str) else json.dumps(line) + "\n", "line.json")
        self.assert_error(self.angles(ELBOW, joint, "--calibration", "line.json"), message)

    def test_command_lines(self):
        self.assert_usage(["angles", "a.csv"], "which joint")
        self.assert_usage(["angles", "--joint", "hinge"], "which recording")
        self.assert_usage(["angles", "a", "--joint", "knee"], "--joint: 'knee' is neither hinge, two-dof nor ball")
        self.assert_usage(["angles", "a", "b", "c", "--joint", "hinge"], "'c' is a third one")
        base = ["angles", "a", "--joint", "two-dof"]
        for option, values in (("--out", ["a", "a.txt", ".sto"]), ("--zero", ["here", "", "nan"]),
                               ("--signs", ["both"]), ("--positive", ["up", "pronation,flexion"]),
                               ("--axis1-toward", ["1,2", "0,0,0", "x", "1,2,3,4", "1,,2"]),
                               ("--axis2-toward", ["1,2,nan"]), ("--reference", ["x", "1,2,3", "200", ""]),
                               ("--window", ["1", "601", "x", "0"]), ("--max-bound", ["0", "60"])):
            for value in values:
                self.assert_usage([*base, f"{option}={value}"], option)

    def test_options_that_do_not_go_together(self):
        elbow, hinge = ["angles", "a", "--joint", "two-dof"], ["angles", "a", "--joint", "hinge"]
        self.assert_usage([*elbow, "--reference", "10"], "--reference needs --zero")
        self.assert_usage([*elbow, "--signs", "range"], "--signs range needs --zero")
        self.assert_usage([*elbow, "--signs", "range", "--zero", "range"], "--signs range needs --zero")
        self.assert_usage([*elbow, "--signs", "range", "--zero", "first", "--axis1-toward", "1,0,0"], "does not go with")
        self.assert_usage([*elbow, "--calibration", "c", "--max-bound", "2"], "do not go with --calibration")
        self.assert_usage([*elbow, "--sign-hint", "same"], "--sign-hint goes with --joint hinge only")
        self.assert_usage([*hinge, "--axis2-toward", "1,0,0"], "--axis2-toward does not go with --joint hinge")
        self.assert_usage([*hinge, "--zero", "1", "--reference", "1,2"], "a hinge has one angle")

    def test_recordings(self):
        some = "r.csv:1:109: q2_w without q2_y, q2_z: an orientation has four columns"
        self.assert_error(self.angles(recordings.csv([row[:19] for row in HINGE_CELLS], COLUMNS[:19]), "hinge"), some)
        self.assert_error(self.run_program("angles", "none.csv", "--joint", "hinge"), "none.csv: No such file or directory")
        cells = [list(row) for row in HINGE_CELLS[:50]]
        cells[3][14] = "left"
        self.assert_error(self.angles(recordings.csv(cells, COLUMNS), "hinge"),
                          "r.csv:5:%d: q1_x: 'left' is not a number" % (len(",".join(cells[3][:14])) + 2))

    def test_calibrations(self):
        self.assert_error(self.angles(ELBOW, "two-dof", "--calibration", "none"), "none: No such file or directory")
        self.assert_line("", "line.json: the file is empty")
        other = "line.json:1: this is no line of --json output"
        whole = json.dumps(ELBOW_LINE)
        for text in ("\n", "axes", "[]", "{}", whole[:-1], whole + "x", whole.replace(": ", " ", 1), whole[1:],
                     whole.replace("[0, 0, 1]", "[0, 0, nan]"), whole.replace("[0, 0, 1]", "[0, 0 1]"),
                     whole.replace('"t_s"', '"t\\n"')):
            self.assert_line(text, other)
        self.assert_line({**ELBOW_LINE, "axis1": [0, 0, 2]}, "line.json:1: an axis is not a unit vector of three numbers")
        self.assert_line({**ELBOW_LINE, "axis2": [0, 1]}, "line.json:1: an axis is not a unit vector of three numbers")
        self.assert_line({**ELBOW_LINE, "carrying_angle_deg": 91},
                         "line.json:1: carrying_angle_deg is not a number from -90 to 90")
        self.assert_line(HINGE_LINE, "line.json:1: this is no calibration of a joint with two axes; it was made with "
                                     "another subcommand")
        self.assert_line(ELBOW_LINE, "line.json:1: this is no calibration of a hinge; it was made with another subcommand",
                         "hinge")
        open_line = "line.json:1: this calibration is not ready: its axes are not known well enough"
        self.assert_line({**ELBOW_LINE, "status": "collecting"}, open_line)
        self.assert_line({**ELBOW_LINE, "axis1": None}, open_line)
        self.assert_line({**ELBOW_LINE, "carrying_angle_deg": None}, open_line)

    def test_last_ready_line_counts(self):
        wrong = {**ELBOW_LINE, "axis1": [1, 0, 0]}
        later = {**ELBOW_LINE, "status": "collecting", "axis1": None}
        name = self.calibration(wrong, ELBOW_LINE, later)
        _, rows = self.rows(self.angles(ELBOW, "two-dof", "--calibration", name))
        self.assertEqual(rows, self.with_calibration(ELBOW))

    def test_no_pose_at_the_time_of_zero(self):
        name = self.calibration(ELBOW_LINE)
        self.assert_error(self.angles(ELBOW, "two-dof", "--calibration", name, "--zero", "99"),
                          "jointcal: --zero: no row with angles at or after 99 s")


class Series(AnglesTest):
    def test_angles_that_turn_on_do_not_jump(self):
        """Two and a half turns there and back."""
        def flexion(t):
            return 8.0 - 8.0 * math.cos(0.4 * t)
        cells = recordings.texts([[k / 50] + [0.1] * 12 + recordings.joint_orientations(k / 50, flexion(k / 50), 0.7) for k in range(800)])
        name = self.calibration(HINGE_LINE)
        for arguments in ([], ["--zero", "first"], ["--zero", "range"]):
            _, rows = self.rows(self.angles(recordings.csv(cells, COLUMNS), "hinge", "--calibration", name, *arguments))
            known = [row[1] for row in rows if row[1] is not None]
            self.assertGreater(len(known), 700)
            self.assertLess(max(abs(a - b) for a, b in zip(known, known[1:])), 10)
            self.assertGreater(max(known) - min(known), 800)

    def test_best_estimate_with_its_bound(self):
        header, rows = self.rows(self.angles(HINGE, "hinge", "--accept", "best"))
        self.assertEqual(header, "t_s,flexion_deg,bound_deg")
        ready = [row for row in self.rows(self.angles(HINGE, "hinge"))[1] if row[1] is not None]
        best = [row for row in rows if row[1] is not None]
        self.assertGreater(len(best), len(ready))
        self.assertLess(best[0][0], ready[0][0])
        self.assertGreater(best[0][2], 3.0)
        self.assertLess(best[-1][2], 3.0)
        self.assertEqual(best[-1][0], ready[-1][0])
        self.assertLess(abs(best[-1][1] - ready[-1][1]), 0.5)  # the heading has been followed for longer
        self.assertTrue(all((row[1] is None) == (row[2] is None) for row in rows))
        header, rows = self.rows(self.angles(ELBOW, "two-dof", "--accept", "best"))
        self.assertEqual(header, TWO_DOF_HEADER + ",bound_deg")
        self.assertEqual({len(row) for row in rows}, {6})
        name = self.calibration(ELBOW_LINE)
        self.assert_usage(["angles", "a", "--joint", "hinge", "--accept", "best", "--calibration", name], "--accept best does not go with")
        self.assert_usage(["angles", "a", "--joint", "hinge", "--accept", "worst"], "--accept: 'worst' is neither ready nor best")

    def test_names_of_columns_in_a_storage_file(self):
        names = ["--flexion-name", "elbow_flexion_r", "--pronation-name", "pro_sup_r", "--carrying-name", "carry", "--heading-name", "h"]
        for more, bound in (([], []), (["--accept", "best", "--bound-name", "b95"], ["b95"])):
            self.angles(ELBOW, "two-dof", "--out", "a.sto", *names, *more)
            lines = (self.folder / "a.sto").read_text().splitlines()
            self.assertEqual(lines[lines.index("endheader") + 1].split("\t"), ["time", "elbow_flexion_r", "pro_sup_r", "carry", "h", *bound])
            self.assertIn(f"nColumns={5 + len(bound)}", lines)
        self.angles(HINGE, "hinge", "--out", "h.sto", "--flexion-name", "knee_angle_r")
        lines = (self.folder / "h.sto").read_text().splitlines()
        self.assertEqual(lines[lines.index("endheader") + 1], "time\tknee_angle_r")
        for name in ("", "a b", "a\tb", "a,b"):
            self.assert_usage(["angles", "a", "--joint", "hinge", "--out", "a.sto", "--flexion-name", name], "is no name of a column")
        self.assert_usage(["angles", "a", "--joint", "hinge", "--flexion-name", "knee"], "go with --out FILE.sto")
        self.assert_usage(["angles", "a", "--joint", "hinge", "--out", "a.csv", "--flexion-name", "knee"], "go with --out FILE.sto")

    def test_why_no_row_has_angles(self):
        units = [[repr(v * (57.3 if "gyr" in c else 1.0)) for c, v in zip(recordings.COLUMNS, row)] for row in recordings.slow_rows(20)]
        result = self.angles(recordings.csv(units), "hinge")
        self.assertEqual(result.returncode, 3)
        first, *others = result.stderr.decode().splitlines()
        self.assertTrue(first.startswith("r.csv: no row has angles: rates of sensor 1 "), first)
        self.assertEqual([line[:14] for line in others], ["r.csv: rates o"])
        still = recordings.csv([[repr(k / 50)] + ["0.001", "0", "0", "0", "0", "9.81"] * 2 for k in range(500)])
        self.assertTrue(self.angles(still, "hinge").stderr.decode().startswith("r.csv: no row has angles: "))


if __name__ == "__main__":
    unittest.main()
