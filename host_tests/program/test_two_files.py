# SPDX-License-Identifier: MIT
"""Two files of one sensor each, with clocks of their own; and what is said of the lag of one file."""
import csv
import json
import math
import os
import pathlib
import random

import recordings
from support import KEYS, ProgramTest

DEMO = pathlib.Path(__file__).resolve().parents[2] / "tools" / "demo" / "knee_demo.csv"
TRUTH = json.loads(DEMO.with_suffix(".json").read_text())
HEADER = ["t_s", "gyr_x", "gyr_y", "gyr_z", "acc_x", "acc_y", "acc_z"]
TWO_KEYS = KEYS[:19] + ["lag_uncertainty_s", "drift_ppm"] + KEYS[19:]
HOUR_S = 3600.0


MANY_PACES = (1.3, 1.9, 0.9, 2.6, 0.31, 3.1, 0.5, 4.3, 5.3)  # rad/s
ROUND_S = 1.6
REPEATED_PACES = tuple(2 * math.pi / ROUND_S * k for k in (1, 1, 1, 1, 0, 1, 0, 2, 1))


def one_joint(seconds, rate_hz, sensor, paces=MANY_PACES):
    """Times and readings of one sensor on a hinge about z of both sensors; each sensor feels the same joint centre, which moves."""
    h = 1e-3
    a, b, c, d, e, f, g, i, j = paces
    lever = ((-0.15, 0.04, 0.05), (0.17, -0.03, 0.04))[sensor]

    def pose(t):
        base = recordings.chain_of_turns((0.7 * math.sin(a * t), 2), (0.5 * math.sin(b * t + 1), 0), (0.5 * math.sin(c * t), 1))
        q = recordings.multiply(base, recordings.turn(0.9 * math.sin(d * t) * (1 + 0.4 * math.sin(e * t)), 2)) if sensor else base
        centre = [0.12 * math.sin(f * t + 0.3 * math.sin(g * t)), 0.10 * math.sin(i * t + 1), 0.08 * math.sin(j * t + 2)]
        return q, [at + r for at, r in zip(centre, recordings.rotate(q, lever), strict=True)]

    noise = random.Random(sensor + 7)
    rows = []
    for k in range(int(seconds * rate_hz)):
        t = k / rate_hz
        (q0, at0), (q, at), (q1, at1) = (pose(t + step) for step in (-h, 0.0, h))
        step = recordings.multiply(recordings.conjugate(q0), q1)
        force = [(before - 2 * now + after) / h**2 for before, now, after in zip(at0, at, at1, strict=True)]
        force[2] += 9.81
        felt = recordings.rotate(recordings.conjugate(q), force)
        rows.append([t] + [v / h + noise.gauss(0, 0.003) for v in step[1:]] + [v + noise.gauss(0, 0.03) for v in felt])
    return rows


def stamped(rows, offset_s=0.0, drift_ppm=0.0):
    return [[offset_s + row[0] * (1 + 1e-6 * drift_ppm), *row[1:]] for row in rows]


def text(rows, header=HEADER):
    return recordings.csv(recordings.texts(rows), header)


SECONDS, LAG_S, DRIFT_PPM = 45.0, 0.12, 200.0
ONE = one_joint(SECONDS, 100.0, 0)
TWO = one_joint(SECONDS, 60.0, 1)
LATE = stamped(TWO, LAG_S, DRIFT_PPM)


class TwoFiles(ProgramTest):
    def write_two(self, one=ONE, two=LATE):
        return self.write(text(one), "thigh.csv"), self.write(text(two), "shank.csv")

    def two(self, *arguments, command="hinge", one=ONE, two=LATE):
        result = self.run_program(command, *self.write_two(one, two), "--json", *arguments)
        self.assertEqual(result.stderr, b"")
        lines = self.parse(result.stdout)
        self.assertEqual(result.returncode, 0 if lines[-1]["status"] == "ready" else 3)
        return lines

    def check_axes(self, line):
        """Both are z."""
        self.assertEqual(line["status"], "ready")
        for axis, bound in zip((line["axis1"], line["axis2"]), line["uncertainty_deg"], strict=True):
            self.assertLess(math.degrees(math.acos(min(axis[2], 1.0))), min(bound, 3.0))

    def check_lag(self, line, base_s=0.0):
        true_s = base_s + LAG_S + 1e-6 * DRIFT_PPM * line["t_s"]
        self.assertLess(abs(line["lag_s"] - true_s), min(line["lag_uncertainty_s"], 0.006))
        self.assertLess(line["lag_uncertainty_s"], 0.012)
        self.assertLess(abs(line["drift_ppm"] - DRIFT_PPM), 250.0)

    def test_rates_lag_and_drift(self):
        lines = self.two("--every", "5")
        for line in lines:
            self.assertEqual(list(line), TWO_KEYS)
            self.check_lag(line)
        self.check_axes(lines[-1])
        self.assertGreater(lines[-1]["samples"], 4400)

    def test_clocks_of_other_origin(self):
        end = self.two(two=stamped(LATE, HOUR_S))[-1]
        self.check_axes(end)
        self.check_lag(end, HOUR_S)
        early = self.two(one=stamped(ONE, 1.7e9), two=LATE)[-1]
        self.assertLess(abs(early["lag_s"] + 1.7e9 - LAG_S - 0.5e-6 * DRIFT_PPM * SECONDS), 0.01)
        self.check_axes(early)

    def test_one_clock_and_files_that_begin_apart(self):
        end = self.two(two=[row for row in LATE if row[0] > 6.0])[-1]
        self.check_axes(end)
        self.check_lag(end)

    def test_files_that_begin_apart_by_hand(self):
        for apart_s in (1.5, -1.1):
            end = self.two(two=stamped(LATE, apart_s))[-1]
            self.check_axes(end)
            self.check_lag(end, apart_s)

    def test_motion_that_repeats_itself(self):
        """Every ROUND_S everything comes again: lags that are so much apart fit equally."""
        one, two = (one_joint(SECONDS, rate_hz, sensor, REPEATED_PACES) for sensor, rate_hz in ((0, 100.0), (1, 60.0)))
        end = self.two(one=one, two=stamped(two, LAG_S))[-1]
        self.assertEqual((end["status"], end["reason"], end["lag_s"]), ("collecting", "not_one_joint", None))
        self.assertIn("the motion repeats itself", end["advice"][0])

    def test_a_shift_of_both_clocks_changes_nothing(self):
        first = self.two()[-1]
        shifted = self.two(one=stamped(ONE, 1000.0), two=stamped(LATE, 1000.0))[-1]
        self.assertEqual({**shifted, "t_s": first["t_s"]}, first)

    def test_lag_that_is_given(self):
        end = self.two("--lag", "0.1245")[-1]
        self.assertEqual((end["lag_s"], end["lag_uncertainty_s"], end["drift_ppm"]), (0.1245, None, None))
        self.check_axes(end)
        far = self.two("--lag=-100000", two=stamped(LATE, -100000 - LAG_S))[-1]
        self.assertEqual(far["lag_s"], -100000)
        self.check_axes(far)

    def checked(self, *arguments, one=ONE, two=LATE):
        result = self.run_program("check", *self.write_two(one, two), "--json", *arguments)
        self.assertEqual(result.stderr, b"")
        return result.returncode, self.parse(result.stdout)[0]

    def test_check_of_two_files(self):
        status, line = self.checked()
        self.assertEqual(list(line), ["event", "samples", "rate_hz", "out_of_order", "gravity_m_s2", "gravity_turns", "lag_s", "lag_bound_s", "drift_ppm", "sensors",
                                      "rejected", "rejected_by", "advice"])
        self.assertEqual((status, line["advice"]), (0, []))
        self.assertLess(abs(line["lag_s"] - LAG_S - 1e-6 * DRIFT_PPM * SECONDS), min(line["lag_bound_s"], 0.006))
        self.assertLess(abs(line["drift_ppm"] - DRIFT_PPM), 250.0)
        for sensor, rate_hz in zip(line["sensors"], (100.0, 60.0), strict=True):  # of its own readings, not of the pairs
            self.assertLess(abs(sensor["rate_hz"] - rate_hz), 0.1)
            self.assertEqual((sensor["verdict"], sensor["findings"]), ("ok", []))
        words = self.run_program("check", "thigh.csv", "shank.csv").stdout.decode()
        self.assertIn("nothing is wrong as a whole", words)
        self.assertIn("ms beside that", words)

    def test_check_of_two_files_whose_lag_is_given_or_not_to_be_had(self):
        status, line = self.checked("--lag", "0.1245")
        self.assertEqual((status, line["lag_s"], line["lag_bound_s"], line["drift_ppm"]), (0, 0.1245, None, None))
        other = [[row[0], *other[1:]] for row, other in zip(LATE, stamped(one_joint(SECONDS + 20, 60.0, 1))[1100:], strict=False)]
        status, line = self.checked(two=other)
        self.assertEqual((status, line["lag_s"], line["lag_bound_s"], line["drift_ppm"]), (3, None, None, None))
        self.assertIn("the lag of sensor 2 was not found", line["advice"][0])
        self.assertIn("--lag S gives the lag", line["advice"][0])

    def test_check_says_what_only_one_file_shows(self):
        holed = [row for k, row in enumerate(LATE) if k % 60 not in (20, 21, 22, 23)]
        status, line = self.checked(two=holed)
        one, two = line["sensors"]
        self.assertEqual((status, one["findings"], two["findings"], two["verdict"]), (0, [], ["gaps"], "doubtful"))
        self.assertTrue(any(sentence.startswith("shank.csv: ") and "are missing" in sentence for sentence in line["advice"]), line["advice"])
        slow = [[*LATE[k][:1], *LATE[k - k % 3][1:]] for k in range(len(LATE))]
        status, line = self.checked(two=slow)
        self.assertEqual((line["sensors"][1]["findings"], line["sensors"][0]["findings"]), (["held"], []))
        self.assertTrue(any(sentence.startswith("shank.csv: each reading of sensor 2 comes") for sentence in line["advice"]), line["advice"])

    def test_check_of_one_file_tells_the_lag(self):
        rate_hz, late = 50.0, 3
        one, two = one_joint(SECONDS, rate_hz, 0), one_joint(SECONDS, rate_hz, 1)
        header = ["t_s"] + [f"{kind}{i}_{axis}" for i in (1, 2) for kind in ("gyr", "acc") for axis in "xyz"]
        for shift in (late, -late, 0):
            rows = [[one[k][0], *one[k][1:], *two[k - shift][1:]] for k in range(late, len(one) - late)]
            result = self.run_program("check", self.write(text(rows, header), "both.csv"), "--json")
            line = self.parse(result.stdout)[0]
            self.assertLess(abs(line["lag_s"] - shift / rate_hz), max(line["lag_bound_s"], 0.002))
            self.assertEqual((result.returncode, len(line["advice"])), (3, 1) if shift else (0, 0))
            if shift:
                self.assertRegex(line["advice"][0], f"the readings of sensor {2 if shift > 0 else 1} come (59|6[01]) ms, (2.9|3.[01]) rows later than those of the other one"
                                 ".*: move its columns up by that")
                printed = self.run_program("check", "both.csv").stdout.decode()
                self.assertIn("something is wrong", printed)
                self.assertIn(line["advice"][0], " ".join(printed.split()))

    def test_standard_input_needs_the_lag(self):
        one, _ = self.write_two()
        result = self.run_program("hinge", one, "-", "--lag", "0.1245", "--json", stdin=text(LATE))
        self.assertEqual(self.parse(result.stdout)[-1], self.two("--lag", "0.1245")[-1])
        self.assert_error(self.run_program("hinge", one, "-", stdin=text(LATE)),
                          "-: two files are read several times, which this one cannot be: give the lag by --lag")
        self.assert_usage(["hinge", "-", "-", "--lag", "0"], "- is standard input, which is one")

    def test_a_lag_that_is_not_found(self):
        other = [[row[0], *other[1:]] for row, other in zip(LATE, stamped(one_joint(SECONDS + 20, 60.0, 1))[1100:], strict=False)]
        end = self.two(two=other)[-1]
        self.assertEqual((end["status"], end["reason"], end["hint"]), ("collecting", "not_one_joint", "check_sensors"))
        self.assertEqual((end["lag_s"], end["lag_uncertainty_s"], end["drift_ppm"]), (None, None, None))
        self.assertIn("the lag of sensor 2 was not found", end["advice"][0])
        self.assertEqual([line["event"] for line in self.two(two=other)], ["end"])

    def test_too_little_motion_for_a_lag(self):
        lines = self.two(one=[row for row in ONE if row[0] < 6.0], two=[row for row in LATE if row[0] < 6.0])
        self.assertEqual([line["event"] for line in lines], ["end"])
        self.assertEqual((lines[-1]["status"], lines[-1]["reason"], lines[-1]["lag_s"]), ("collecting", "no_motion", None))
        self.assertIn("too little motion to find the lag", lines[-1]["advice"][0])

    def test_other_joints(self):
        for command in ("center", "ball"):
            end = self.two("--max-bound", {"center": "0.03", "ball": "15"}[command], command=command)[-1]
            self.check_lag(end)
            self.assertEqual(list(end)[-6:-4], ["lag_uncertainty_s", "drift_ppm"])
        one, two = self.write_two()
        result = self.run_program("angles", one, two, "--joint", "hinge", "--out", "angles.csv")
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        rows = list(csv.DictReader((self.folder / "angles.csv").open()))
        late = [row for row in rows if row["flexion_deg"] and float(row["t_s"]) > 20.0]
        self.assertGreater(len(late), 2000)
        offs = [math.degrees(0.9 * math.sin(2.6 * t) * (1 + 0.4 * math.sin(0.31 * t))) - float(row["flexion_deg"])
                for row in late for t in [float(row["t_s"])]]
        middle = sum(offs) / len(offs)
        self.assertLess(math.sqrt(sum((off - middle) ** 2 for off in offs) / len(offs)), 1.5)

    def test_summary(self):
        output = self.run_program("hinge", *self.write_two(two=stamped(LATE, HOUR_S))).stdout.decode()
        self.assertIn("taken to begin at once, where their times are 3600.12 s apart", output)
        self.assertRegex(output, r"lag of sensor 2 +3600\.1[23]\d? s at the end, \+\d+ ms beside that, to within \d+ ms; taken off")
        self.assertRegex(output, r"clock of sensor 2 +\+\d+ ppm")
        self.assertRegex(output, r"readings +4(500|49\d) and 2(700|69\d), which make 44\d\d pairs, one every 10 ms")
        self.assertIn("taken to have one clock", self.run_program("hinge", *self.write_two()).stdout.decode())


class BrokenFiles(ProgramTest):
    def setUp(self):
        super().setUp()
        self.one = self.write(text(ONE[:50]), "thigh.csv")

    def refused(self, content, message, *arguments):
        two = self.write(content, "shank.csv")
        self.assert_error(self.run_program("hinge", self.one, two, *arguments), message)
        self.assert_error(self.run_program("hinge", two, self.one, *arguments), message)

    def test_columns(self):
        self.refused(text([row[:6] for row in TWO[:50]], HEADER[:6]), "shank.csv:1: missing column acc_z")
        self.refused(text(recordings.hinge_rows(1), recordings.COLUMNS),
                     "shank.csv:1: the columns of two sensors: of two files each has one, in the columns t_s, gyr_x ... acc_z")
        self.assert_error(self.run_program("hinge", self.one), "thigh.csv:1: the columns of one sensor: the file of the other sensor is "
                          "missing, or gyr1_x ... acc2_z of both in this one")
        self.refused(text([row[1:] for row in TWO[:50]], HEADER[1:]), "shank.csv:1: missing column t_s")

    def test_cells_and_lines(self):
        good = text(TWO[:50])
        self.refused(good + "1,2,3\n", "shank.csv:52: short line: 3 of 7 cells")
        self.refused(good + "1,2,3,4,x,6,7\n", "shank.csv:52:9: acc_x: 'x' is not a number")
        self.refused(good + good, "shank.csv:52: a second header line")
        self.refused("", "shank.csv: the file is empty")

    def test_files(self):
        self.assert_error(self.run_program("hinge", self.one, "absent.csv"), "absent.csv: No such file or directory")
        self.assert_error(self.run_program("hinge", "absent.csv", self.one), "absent.csv: No such file or directory")
        self.assert_error(self.run_program("hinge", self.one, self.one), "thigh.csv: the same file twice: each sensor has its own")
        os.link(self.folder / self.one, self.folder / "link.csv")
        self.assert_error(self.run_program("hinge", self.one, "link.csv"), "link.csv: the same file twice: each sensor has its own")

    def test_options(self):
        self.assert_usage(["hinge", "a", "--lag", "1"], "--lag goes with two files")
        for value in ("x", "", "nan", "inf", "1s"):
            self.assert_usage(["hinge", "a", "b", "--lag=" + value], "--lag: ")
        self.assert_usage(["chain", "a", "b"], "'b' is a second one")
        self.assert_usage(["stream", "--to", "unix:x", "a", "b"], "several files are a body's")

    def test_what_is_wrong_with_a_file_is_said_of_it(self):
        for rows, reason in (([[1e6 * row[0], *row[1:]] for row in TWO], "rows are"),
                             ([], "there is a header line and no row below it"), (TWO[::12], "rows are 0.2 s apart")):
            result = self.run_program("hinge", self.write(text(ONE), "thigh.csv"), self.write(text(rows), "shank.csv"), "--json")
            end = self.parse(result.stdout)[-1]
            self.assertEqual((result.returncode, end["status"], end["reason"]), (3, "collecting", "bad_samples"))
            self.assertIn("shank.csv: " + reason, end["advice"][0])
        frozen = [[row[0], *TWO[0][1:]] for row in TWO]
        end = self.parse(self.run_program("hinge", "thigh.csv", self.write(text(frozen), "shank.csv"), "--json").stdout)[-1]
        self.assertIn("shank.csv: 2699 of 2700 readings repeat the one before", end["advice"][0])

    def test_a_wild_time_costs_one_reading(self):
        wild = [list(row) for row in LATE]
        wild[700][0] += 1e5
        names = self.write(text(ONE), "thigh.csv"), self.write(text(wild), "shank.csv")
        end = self.parse(self.run_program("hinge", *names, "--json").stdout)[-1]
        self.assertEqual(end["status"], "ready")
        self.assertGreater(end["samples"], 4400)


class OneFile(ProgramTest):
    """What is said of the lag where both sensors are in one file: the rows stay as they are."""

    def shifted(self, rows_late):
        """Sensor 2's readings in rows `rows_late` later, which is 20 ms each."""
        lines = [line.split(",") for line in DEMO.read_text().split("\n")[:-1]]
        place = [k for k, name in enumerate(lines[0]) if name[:4] in ("gyr2", "acc2")]
        head, body = lines[0], lines[1:]
        source = body[:len(body) - rows_late] if rows_late >= 0 else body[-rows_late:]
        target = body[rows_late:] if rows_late >= 0 else body[:rows_late]
        out = [list(row) for row in target]
        for new, old in zip(out, source, strict=True):
            for k in place:
                new[k] = old[k]
        return recordings.csv(out, head)

    def test_a_lag_is_told_and_what_to_do(self):
        for rows_late, sensor in ((2, 2), (-3, 1)):
            end = self.parse(self.hinge(self.shifted(rows_late), "--json").stdout)[-1]
            self.assertLess(abs(end["lag_s"] - 0.02 * rows_late), 0.006)
            told = [sentence for sentence in end["advice"] if "later than those of the other one" in sentence]
            self.assertEqual(len(told), 1)
            self.assertIn(f"the readings of sensor {sensor} come", told[0])
            self.assertRegex(told[0], r"[23]\.\d rows|[12]\.9 rows")

    def test_no_word_where_the_sensors_are_in_step(self):
        lines = self.parse(self.hinge(DEMO.read_text(), "--json", "--every", "5").stdout)
        self.assertLess(abs(lines[-1]["lag_s"]), 0.005)
        self.assertEqual(lines[-1]["advice"], [])
        self.assertIsNone(lines[0]["lag_s"])
