# SPDX-License-Identifier: MIT
"""`jointcal ball`, and what the other commands say of a person's joint without a hinge: the bundled elbow."""
import csv
import io
import json
import math
import pathlib
import unittest

import recordings
from support import FILE, REJECT_KEYS, ProgramTest, needs_filter

DEMO = pathlib.Path(__file__).resolve().parents[2] / "tools" / "demo" / "elbow_demo.csv"
TRUTH = json.loads(DEMO.with_suffix(".json").read_text())
KEYS = ["event", "t_s", "status", "engine", "weak", "hint", "reason", "heading_offset_deg", "uncertainty_heading_deg",
        "joint_to_sensor1_m", "joint_to_sensor2_m", "uncertainty_m", "center1_known", "center2_known", "ready_for", "lag_s",
        "advice", "samples", "rejected", "rejected_by"]


def line_angle_deg(a, b):
    cosine = abs(sum(x * y for x, y in zip(a, b, strict=True))) / math.hypot(*a) / math.hypot(*b)
    return math.degrees(math.acos(min(1.0, cosine)))


def rows_until(seconds):
    """The demo up to a time."""
    lines = DEMO.read_text().splitlines()
    return "\n".join([lines[0], *(line for line in lines[1:] if float(line.split(",")[0]) < seconds)]) + "\n"


class BallTest(ProgramTest):
    def run_lines(self, command, *arguments):
        result = self.run_program(command, *arguments, "--json")
        self.assertEqual(result.stderr, b"")
        return self.parse(result.stdout), result.returncode


class Ball(BallTest):
    def test_every_line_has_every_key(self):
        lines, status = self.run_lines("ball", str(DEMO), "--every", "1")
        self.assertEqual((status, lines[-1]["status"], lines[-1]["ready_for"]), (0, "ready", "orientation_and_center"))
        for line in lines:
            self.assertEqual(list(line), KEYS)
            self.assertEqual(list(line["rejected_by"]), REJECT_KEYS)
        for key in ("uncertainty_heading_deg", "uncertainty_m", "ready_for"):
            self.assertIsNone(lines[0][key])
        self.assertEqual(sum(line["event"] == "ready" for line in lines), 1)

    def test_places_are_inside_their_bounds(self):
        lines, _ = self.run_lines("ball", str(DEMO), "--every", "1")
        told = [line for line in lines if line["status"] == "ready"]
        self.assertGreater(len(told), 20)
        bounded = [0, 0]
        for line in told:
            for k in (0, 1):
                off, bound = math.dist(line[f"joint_to_sensor{k + 1}_m"], TRUTH[f"joint_to_sensor{k + 1}_m"]), line["uncertainty_m"][k]
                self.assertTrue(bound is None or off < bound, (line["t_s"], k, off, bound))
                bounded[k] += bound is not None
        self.assertGreater(min(bounded), 20)

    def test_limits_count(self):
        lines, status = self.run_lines("ball", str(DEMO), "--max-lever", "0.02")
        self.assertEqual((status, lines[-1]["center1_known"], lines[-1]["center2_known"], lines[-1]["ready_for"]),
                         (0, False, False, "orientation"))
        lines, status = self.run_lines("ball", str(DEMO), "--max-bound", "2")
        self.assertEqual((status, lines[-1]["reason"], lines[-1]["weak"]), (3, "uncertain", "heading"))

    def test_a_stiff_pair_is_none(self):
        """Sensor 2 sends what sensor 1 does, mounted otherwise."""
        rows = list(csv.reader(io.StringIO(DEMO.read_text())))
        at = {name: k for k, name in enumerate(rows[0])}
        for row in rows[1:]:
            for kind in ("gyr", "acc"):
                for axis, other in zip("xyz", "yzx", strict=True):
                    row[at[f"{kind}2_{axis}"]] = row[at[f"{kind}1_{other}"]]
        lines, status = self.run_lines("ball", self.write("\n".join(map(",".join, rows)) + "\n"))
        self.assertEqual((status, lines[-1]["status"], lines[-1]["reason"]), (3, "collecting", "no_bend"))

    def test_sensors_of_two_people_are_none(self):
        """Sensor 2 is that of twenty seconds later."""
        rows = list(csv.reader(io.StringIO(DEMO.read_text())))
        at = {name: k for k, name in enumerate(rows[0])}
        body = [list(row) for row in rows[1:600]]
        for row, later in zip(body, rows[1001:], strict=False):
            for kind in ("gyr", "acc"):
                for axis in "xyz":
                    row[at[f"{kind}2_{axis}"]] = later[at[f"{kind}2_{axis}"]]
        lines, status = self.run_lines("ball", self.write("\n".join(map(",".join, [rows[0], *body])) + "\n"), "--every", "1")
        self.assertEqual(status, 3)
        self.assertNotIn("ready", [line["status"] for line in lines])

    def test_summary_for_people(self):
        text = self.run_program("ball", str(DEMO)).stdout.decode()
        self.assertTrue(text.startswith("Ball joint, stream engine: ready\n"))
        for part in ("heading offset ", "centre, sensor 1   known", "the centre moved   at 0.", "1600 read, 0 rejected", "exit status        0: "):
            self.assertIn(part, text)

    def test_what_it_refuses(self):
        for arguments, words in ((["--engine", "window"], b"stream engine only"), (["--n-max", "100"], b"--n-max"),
                                 (["--window", "9"], b"fixed"), (["--sign-hint", "same"], b"no axes"),
                                 (["--axis1-toward", "1,0,0"], b"has none"), (["--max-lever", "3"], b"--max-lever"),
                                 (["--max-bound", "90"], b"--max-bound")):
            result = self.run_program("ball", self.write(FILE), *arguments)
            self.assertEqual((result.returncode, result.stdout), (2, b""), arguments)
            self.assertIn(words, result.stderr)


@needs_filter
class Elbow(BallTest):
    def test_two_axes_each_from_its_own_motion(self):
        lines, status = self.run_lines("two-dof", str(DEMO), "--every", "1")
        end = lines[-1]
        self.assertEqual((status, end["status"], end["model"], end["ready_for"]), (0, "ready", "functional", "angles"))
        for k in (0, 1):
            self.assertLess(line_angle_deg(end[f"axis{k + 1}"], TRUTH[f"axis{k + 1}"]), end["uncertainty_deg"][k])
        bent = [line for line in lines if line["t_s"] < 18.0][-1]
        self.assertIsNotNone(bent["axis1"])
        self.assertIsNone(bent["axis2"])
        self.assertEqual((bent["weak"], bent["hint"]), ("axis2", "turn_only"))

    def test_hints_say_what_to_do(self):
        before = self.run_program("two-dof", self.write(rows_until(7.5))).stdout.decode()
        self.assertIn("what would help    bend and stretch the joint only", before)
        between = self.run_program("two-dof", self.write(rows_until(18.0))).stdout.decode()
        self.assertIn("axis in sensor 2   unknown", between)
        self.assertIn("what would help    hold the joint bent and turn", between)

    def test_the_hinge_notices_that_the_forearm_begins_to_turn(self):
        """While it only bends it is a hinge; then it says when that ended, and which command to take."""
        bends = self.run_program("hinge", self.write(rows_until(16)))
        self.assertEqual(bends.returncode, 0)
        self.assertNotIn(b"two-dof", bends.stdout)
        both = self.run_program("hinge", str(DEMO))
        self.assertEqual(both.returncode, 3)
        line = next(line for line in both.stdout.decode().splitlines() if line.startswith("  moved "))
        self.assertGreater(float(line.split()[1]), 16.0)
        self.assertIn("'jointcal two-dof'", line)

    def test_angles_have_columns_of_both(self):
        result = self.run_program("angles", str(DEMO), "--joint", "two-dof")
        self.assertEqual(result.returncode, 0)
        header, *rows = csv.reader(io.StringIO(result.stdout.decode()))
        self.assertEqual(header, ["t_s", "flexion_deg", "pronation_deg", "carrying_deg", "heading_offset_deg"])
        self.assertGreater(sum(row[1] != "" for row in rows), 250)


class Angles(BallTest):
    def angles(self, *arguments):
        return self.run_program("angles", str(DEMO), "--joint", "ball", *arguments)

    def test_hip_and_shoulder_name_their_columns(self):
        right = ",".join(map(str, TRUTH["axis1"]))
        for sequence, names in (("hip", ["flexion_deg", "rotation_deg", "adduction_deg"]),
                                ("shoulder", ["elevation_deg", "axial_rotation_deg", "plane_of_elevation_deg"])):
            result = self.angles(f"--axis1-toward={right}", "--sequence", sequence)
            self.assertEqual((result.returncode, result.stderr), (0, b""))
            header, *rows = csv.reader(io.StringIO(result.stdout.decode()))
            self.assertEqual(header, ["t_s", *names, "heading_offset_deg"])
            first = next(row for row in rows if row[1] != "")
            self.assertLess(abs(float(first[1])), 0.01)

    def test_angles_count_from_the_pose(self):
        right = ",".join(map(str, TRUTH["axis1"]))
        result = self.angles(f"--axis1-toward={right}", "--zero", "10")
        header, *rows = csv.reader(io.StringIO(result.stdout.decode()))
        self.assertTrue(all(row[1] == "" for row in rows if float(row[0]) < 10.0))
        first = next(row for row in rows if row[1] != "")
        self.assertEqual(float(first[0]), 10.0)
        for cell in first[1:4]:
            self.assertLess(abs(float(cell)), 0.01)

    def test_what_it_refuses(self):
        for arguments, words in (([], b"--axis1-toward"), (["--axis1-toward", "1,0,0", "--zero", "range"], b"do not go"),
                                 (["--axis1-toward", "1,0,0", "--axis2-toward", "1,0,0"], b"do not go")):
            result = self.angles(*arguments)
            self.assertEqual(result.returncode, 2)
            self.assertIn(words, result.stderr)
        result = self.run_program("angles", str(DEMO), "--joint", "hinge", "--sequence", "hip")
        self.assertEqual(result.returncode, 2)
        self.assertIn(b"--joint ball only", result.stderr)


class Centre(BallTest):
    def test_a_persons_centre_has_wide_bounds(self):
        lines, status = self.run_lines("center", str(DEMO))
        self.assertEqual((status, lines[-1]["model"]), (3, "functional"))
        lines, status = self.run_lines("center", str(DEMO), "--max-bound", "0.06")
        end = lines[-1]
        self.assertEqual((status, end["status"], end["model"]), (0, "ready", "functional"))
        for k in (0, 1):
            off = math.dist(end[f"joint_to_sensor{k + 1}_m"], TRUTH[f"joint_to_sensor{k + 1}_m"])
            self.assertLess(off, end["uncertainty_m"][k])

    def test_a_rigid_one_stays_rigid(self):
        cells = recordings.texts(recordings.center_rows(25))
        lines, status = self.run_lines("center", self.write(recordings.csv(cells, recordings.COLUMNS + recordings.ORIENTATION_COLUMNS)))
        self.assertEqual((status, lines[-1]["model"]), (0, "rigid"))


if __name__ == "__main__":
    unittest.main()
