# SPDX-License-Identifier: MIT
"""Recordings that are wrong in ways that people meet: what the program says of each must name the fault, and nothing may be called ready."""
import bz2
import gzip
import itertools
import lzma
import math
import os
import pathlib
import signal
import subprocess
import time
import unittest
import zipfile

import recordings
from recordings import COLUMNS
from support import CELLS, FILE, PROGRAM, SHORT, ProgramTest

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROWS = recordings.slow_rows(20)
DATA = os.environ.get("JOINTCAL_DATA")
INDEX = {name: k for k, name in enumerate(COLUMNS)}
NO_GRAVITY = "no gravity in the accelerations of sensor"


def scaled(factors, rows=None):
    """Rows with each column that begins with a key multiplied by its value."""
    return [[value * next((f for start, f in factors.items() if name.startswith(start)), 1.0)
             for name, value in zip(COLUMNS, row, strict=True)] for row in (rows or ROWS)]


def permuted(rows, start, order, signs):
    """Rows whose three columns of `start` hold others of them."""
    result = [list(row) for row in rows]
    for old, new in zip(rows, result, strict=True):
        for axis, source, sign in zip("xyz", order, signs, strict=True):
            new[INDEX[start + axis]] = sign * old[INDEX[start + "xyz"[source]]]
    return result


class Words(ProgramTest):
    def end_of(self, rows, *arguments):
        return self.end(recordings.csv(recordings.texts(rows)), *arguments)

    def text(self, cells, *arguments):
        return self.hinge(recordings.csv(cells), *arguments)

    def assert_refused(self, rows, *parts):
        lines, status = self.lines(recordings.csv(recordings.texts(rows)), "--every", "1")
        self.assertEqual((status, lines[-1]["hint"]), (3, "check_sensors"))
        self.assertNotIn("ready", [line["status"] for line in lines])
        for part in parts:
            self.assertTrue(any(part in sentence for sentence in lines[-1]["advice"]), (part, lines[-1]["advice"]))
        # People get the first sentence as the reason, and no word of more motion.
        summary = self.hinge(recordings.csv(recordings.texts(rows))).stdout.decode()
        self.assertIn(f"  why                {lines[-1]['advice'][0]}\n", summary)
        self.assertNotIn("what would help", summary)
        for sentence in lines[-1]["advice"][1:]:
            self.assertIn(f"  about the data     {sentence}\n", summary)


class Clean(Words):
    def test_nothing_is_said_of_a_clean_recording(self):
        lines, status = self.lines(recordings.csv(recordings.texts(ROWS)), "--every", "0.5")
        self.assertEqual((status, lines[-1]["status"]), (0, "ready"))
        self.assertEqual([line["advice"] for line in lines], [[]] * len(lines))
        lines, _ = self.lines(FILE, "--every", "0.5")
        self.assertEqual([line["advice"] for line in lines], [[]] * len(lines))

    def test_nothing_is_said_of_the_demos(self):
        for name, command in (("hinge", "hinge"), ("two_dof", "two-dof"), ("chain", "chain"), ("chain", "center")):
            lines = self.parse(self.run_program(command, str(ROOT / f"tools/demo/{name}_demo.csv"), "--json", "--every", "1").stdout)
            self.assertEqual([line["advice"] for line in lines], [[]] * len(lines), name)

    # What is wrong with some real recordings: hundreds of samples stand at 2 g; z of a gyroscope has the other sign.
    TRUE_OF = {"people_ankle_orthosis": "it is clipped", "people_sts_O": "are not in one right-handed frame; they fit if gyr x, y, z are read from the columns x, y, -z"}

    @unittest.skipUnless(DATA, "no real recordings")
    def test_nothing_untrue_is_said_of_real_recordings(self):
        for path in sorted(pathlib.Path(DATA).glob("*.csv")):
            lines = self.parse(self.run_program("hinge", str(path), "--json", "--every", "5").stdout)
            said = {sentence for line in lines for sentence in line["advice"]}
            tie = {sentence for sentence in said if "hangs on a tie" in sentence}  # true of where the sensors sit
            true = [words for name, words in self.TRUE_OF.items() if path.stem.startswith(name)]
            self.assertEqual({sentence for sentence in said - tie if not any(words in sentence for words in true)}, set(), path.name)
            self.assertTrue(all(any(words in sentence for sentence in said) for words in true), path.name)


class Times(Words):
    def test_units_of_time(self):
        for factor, apart, words in ((1e3, "20", "milliseconds"), (1e6, "20000", "microseconds"), (1e9, "2e+07", "nanoseconds")):
            for start in (0.0, 1.7e9 * factor):
                cells = [[repr(start + round(row[0] * factor))] + [repr(v) for v in row[1:]] for row in ROWS]
                lines, status = self.lines(recordings.csv(cells))
                self.assertEqual((status, lines[-1]["reason"]), (3, "bad_samples"))
                self.assertIn(f"rows are {apart} s apart; t_s is in seconds: these look like {words}", lines[-1]["advice"][0])
        days = [[f"{739000 + row[0] / 86400:.12f}"] + [repr(v) for v in row[1:]] for row in ROWS]
        self.assertIn("these look like days", self.lines(recordings.csv(days))[0][-1]["advice"][0])
        slow = [[repr(row[0] * 25)] + [repr(v) for v in row[1:]] for row in ROWS]
        self.assertEqual(self.lines(recordings.csv(slow))[0][-1]["advice"], ["rows are 0.5 s apart; t_s is in seconds"])

    def test_time_with_too_few_decimals(self):
        cells = [[f"{1.7e9 + row[0]:.0f}"] + [repr(v) for v in row[1:]] for row in ROWS]
        self.assertIn("have the time of the row before: t_s has too few decimals", self.lines(recordings.csv(cells))[0][-1]["advice"][0])

    def test_rows_out_of_order(self):
        rows = [list(row) for row in ROWS]
        for at in range(0, 200, 20):
            rows[at:at + 20] = rows[at + 10:at + 20] + rows[at:at + 10]
        end = self.end_of(rows)
        self.assertEqual(end["advice"], ["100 rows out of order: sort by t_s, or give --sort"])
        backwards = self.end_of(ROWS[::-1])
        self.assertEqual(backwards["advice"][0], "999 rows out of order: sort by t_s, or give --sort")
        self.assertEqual(self.end_of(ROWS[:10] + ROWS[12:] + ROWS[10:11])["advice"], ["1 row out of order: sort by t_s, or give --sort"])

    def test_sorting_on_request(self):
        plain = self.hinge(recordings.csv(recordings.texts(ROWS)), "--json").stdout
        for rows in (ROWS[::-1], ROWS[500:] + ROWS[:500], ROWS[::2] + ROWS[1::2]):
            self.assertEqual(self.hinge(recordings.csv(recordings.texts(rows)), "--json", "--sort").stdout, plain)
        cells = recordings.texts(ROWS)
        cells[3][0] = ""
        self.assertEqual(self.lines(recordings.csv(cells), "--sort")[0][-1]["rejected_by"]["not_finite"], 1)
        self.assert_error(self.hinge(SHORT + "1,2\n", "--sort"), "r.csv:52: short line: 2 of 13 cells")

    def test_a_clock_that_begins_anew_and_a_wild_time(self):
        again = [[row[0] - 7.5] + row[1:] if row[0] > 10 else row for row in ROWS]
        self.assertIn("t_s goes back 1 time, by 7.48 s: the clock began anew", self.end_of(again)["advice"][0])
        often = [[row[0] % 5] + row[1:] for row in ROWS]
        self.assertIn("t_s goes back 3 times, by up to 4.98 s: sort by t_s", self.end_of(often)["advice"][0])
        wild = [[row[0] + (1e6 if k == 500 else 0)] + row[1:] for k, row in enumerate(ROWS)]
        self.assertIn("1 times are far ahead of those before and after", self.end_of(wild)["advice"][0])


class Readings(Words):
    def test_units_of_accelerations(self):
        for factor, words in ((1 / 9.80665, "look like g;"), (1000 / 9.80665, "look like mg"), (2048 / 9.80665, "raw counts, 2048 to 1 g"),
                              (4096 / 9.80665, "raw counts, 4096"), (8192 / 9.80665, "raw counts, 8192"), (1000.0, "mm/s^2"),
                              (16384 / 9.80665, "raw counts, 16384"), (3.28084, "ft/s^2"), (100.0, "cm/s^2"), (3.0, "gravity is 29")):
            if factor != 3.0:
                self.assert_refused(scaled({"acc": factor}), "accelerations of sensor 1", words)
            self.assert_refused(scaled({"acc2": factor}), "accelerations of sensor 2", words if factor != 3.0 else "of sensor 2")

    def test_units_of_rates(self):
        for factor, words in ((57.29578, "look like deg/s"), (57295.78, "thousandths of deg/s"), (57.29578 * 16.4, "raw counts, about 1"),
                              (57.29578 * 131, "raw counts, about 1"), (9.549, "times as large as rad/s"), (0.01, "times as fast as they say")):
            self.assert_refused(scaled({"gyr": factor}), "rates of sensor 1", words)
            self.assert_refused(scaled({"gyr2": factor}), "rates of sensor 2", words)
        self.assert_refused(scaled({"gyr": 57.29578, "acc": 1 / 9.80665}), "look like deg/s")

    def test_gravity_taken_out(self):
        """Also where the advice of before was followed, and where one sensor has gravity."""
        poses = recordings.center_rows(20)
        free = [list(row[:13]) for row in poses]
        for row, pose in zip(free, poses, strict=True):
            for sensor in (1, 2):
                q = recordings.ball_orientations(pose[0])[sensor - 1]
                g = recordings.rotate(recordings.conjugate(q), (0, 0, 9.81))
                for axis, value in zip("xyz", g, strict=True):
                    row[INDEX[f"acc{sensor}_{axis}"]] -= value
        for factor in (1.0, 9.80665):
            self.assert_refused(scaled({"acc": factor}, free), NO_GRAVITY + " 1", NO_GRAVITY + " 2")
        half = [row[:7] + other[7:13] for row, other in zip(free, poses, strict=True)]
        self.assert_refused(half, NO_GRAVITY + " 1")
        result = self.run_program("center", self.write(recordings.csv(recordings.texts(scaled({"acc": 2.0}, free)))), "--json")
        self.assertEqual(result.returncode, 3)
        self.assertIn(NO_GRAVITY, self.parse(result.stdout)[-1]["advice"][0])

    def test_frames(self):
        for order, signs in itertools.product(itertools.permutations(range(3)), itertools.product((1, -1), repeat=3)):
            rows = permuted(ROWS, "acc2_", order, signs)
            end = self.end_of(rows)
            if order == (0, 1, 2) and len(set(signs)) == 1:
                continue  # as it was, and its opposite, which moves in the same way
            self.assertEqual(end["status"], "collecting", (order, signs))
            self.assertIn("rates and accelerations of sensor 2 are not in one right-handed frame", end["advice"][0])
            inverse = [order.index(axis) for axis in range(3)]
            turned = -1 if sum(signs) < 0 else 1
            way = ", ".join(("-" if turned * signs[k] < 0 else "") + "xyz"[k] for k in inverse)
            if "they fit" in end["advice"][0]:
                self.assertTrue(end["advice"][0].endswith("read from the columns " + way), (order, signs, end["advice"]))
        zyx = permuted(permuted(ROWS, "acc1_", (2, 1, 0), (1, 1, 1)), "acc2_", (2, 1, 0), (1, 1, 1))
        self.assert_refused(zyx, "sensor 1 are not in one right-handed frame; they fit if acc x, y, z are read from the columns z, y, x", "sensor 2")

    def test_left_handed_frames(self):
        self.assert_refused(scaled({"gyr1": -1.0}), "rates of sensor 1 turn the wrong way round")
        mirrored = permuted(permuted(ROWS, "acc1_", (1, 0, 2), (1, 1, 1)), "gyr1_", (1, 0, 2), (1, 1, 1))
        self.assert_refused(mirrored, "rates of sensor 1 turn the wrong way round")

    def test_one_sensor_twice(self):
        self.assert_refused([row[:7] + row[1:7] for row in ROWS], "the columns of sensor 2 are those of sensor 1")
        self.assert_refused([row[:7] + row[1:4] + row[10:] for row in ROWS], "the rates of sensor 2 are those of sensor 1")
        self.assert_refused([row[:10] + row[4:7] for row in ROWS], "the accelerations of sensor 2 are those of sensor 1")

    def test_readings_that_are_held(self):
        for start, times, words in (("acc", 4, "the accelerometer comes 4 times (sensors 1 and 2)"), ("acc2", 2, "the accelerometer comes 2 times (sensor 2)"),
                                    ("gyr1", 3, "the gyroscope comes 3 times (sensor 1)")):
            rows = [[ROWS[k - k % times if name.startswith(start) else k][c] for c, name in enumerate(COLUMNS)] for k in range(len(ROWS))]
            self.assertIn("each reading of " + words, " ".join(self.end_of(rows)["advice"]))
        rows = [row[:1] + ROWS[k - k % 2][1:] for k, row in enumerate(ROWS)]
        self.assertIn("the whole sensor comes 2 times (sensors 1 and 2)", " ".join(self.end_of(rows)["advice"]))

    def test_readings_that_are_not_used_do_not_matter(self):
        rows = recordings.two_dof_rows(20)
        text = recordings.csv(recordings.texts(rows), COLUMNS + recordings.ORIENTATION_COLUMNS)
        lines = self.parse(self.run_program("two-dof", self.write(text), "--json").stdout)
        self.assertEqual((lines[-1]["status"], lines[-1]["advice"]), ("ready", []))

    def test_no_rows(self):
        self.assertEqual(self.lines(recordings.csv([]))[0][-1]["advice"], ["there is a header line and no row below it"])
        self.assertIn("there is a header line and no row below it", self.hinge(recordings.csv([])).stdout.decode())


class Signs(Words):
    """An axis and its opposite are the same line; which is told may hang on a tie."""

    TIE = "the sign of axis 1 hangs on a tie"

    def turned(self, angle):
        """A hinge whose sensor 1 is turned about its x axis, so that the axis lies between y and z; a second angle tips the tie."""
        c, s = math.cos(angle), math.sin(angle)
        rows = []
        for t, *values in recordings.hinge_rows(30):
            for first in (0, 3):  # rate and specific force of sensor 1
                x, y, z = values[first:first + 3]
                values[first:first + 3] = [x, c * y - s * z, s * y + c * z]
            rows.append([t, *values])
        return rows

    def test_a_tie_is_told_and_axis1_toward_settles_it(self):
        axis = self.lines(recordings.csv(recordings.texts(recordings.hinge_rows(30))))[0][-1]["axis1"]
        along = math.atan2(axis[2], axis[1])
        text = recordings.csv(recordings.texts(self.turned(math.pi / 4.0 - along)))
        lines, status = self.lines(text)
        self.assertEqual(status, 0)
        self.assertTrue(any(self.TIE in sentence for sentence in lines[-1]["advice"]), lines[-1])
        told = lines[-1]["axis1"]
        lines, status = self.lines(text, "--axis1-toward", ",".join(f"{-x:.6f}" for x in told))
        self.assertEqual((status, lines[-1]["advice"]), (0, []))
        for x, y in zip(lines[-1]["axis1"], told, strict=True):
            self.assertAlmostEqual(x, -y, places=5)

    def test_no_tie_no_word(self):
        lines, _ = self.lines(recordings.csv(recordings.texts(recordings.hinge_rows(30))))
        self.assertFalse(any(self.TIE in sentence for sentence in lines[-1]["advice"]), lines[-1])


class Check(Words):
    """`jointcal check`, which knows of no joint."""
    def check(self, text, *arguments):
        return self.run_program("check", self.write(text), *arguments)

    def test_a_clean_recording(self):
        result = self.check(recordings.csv(recordings.texts(ROWS)), "--json")
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        line = self.parse(result.stdout)[0]
        self.assertEqual(list(line), ["event", "samples", "rate_hz", "out_of_order", "gravity_m_s2", "gravity_turns", "lag_s", "lag_bound_s", "sensors", "rejected",
                                      "rejected_by", "advice"])
        self.assertEqual((line["samples"], line["out_of_order"], line["rejected"], line["advice"]), (1000, 0, 0, []))
        self.assertAlmostEqual(line["rate_hz"], 50.0, places=3)
        for gravity, turns in zip(line["gravity_m_s2"], line["gravity_turns"], strict=True):
            self.assertLess(abs(gravity - 9.81), 0.4)  # a bin of the histogram
            self.assertLess(abs(turns - 1.0), 0.1)
        self.assertIn("nothing is wrong", self.check(recordings.csv(recordings.texts(ROWS))).stdout.decode())

    def test_wrong_ones(self):
        for rows, part in ((scaled({"gyr": 57.3}), "look like deg/s"), (scaled({"acc": 0.10197}), "look like g"), ([row[:7] + row[1:7] for row in ROWS], "those of sensor 1")):
            result = self.check(recordings.csv(recordings.texts(rows)))
            self.assertEqual(result.returncode, 3)
            self.assertIn(part, result.stdout.decode())
        self.assertEqual(self.parse(self.check(recordings.csv([]), "--json").stdout)[0]["gravity_m_s2"], [None, None])
        self.assert_error(self.check(SHORT + "1,2\n"), "r.csv:52: short line: 2 of 13 cells")

    KEYS = ["verdict", "findings", "rate_hz", "jitter_s", "missing_share", "gaps", "frozen_s", "times_repeated", "dead", "clipped", "gravity_m_s2", "rest_s", "frames",
            "columns", "columns_of", "scale", "scale_bound", "vibration_rad_s", "motion_rad_s", "motion_s"]

    def sensors(self, rows):
        result = self.check(recordings.csv(recordings.texts(rows)), "--json")
        line = self.parse(result.stdout)[0]
        for sensor in line["sensors"]:
            self.assertEqual(list(sensor), self.KEYS)
        return result.returncode, line

    def test_a_component_that_is_dead(self):
        rows = [[*row[:8], 0.125, *row[9:]] for row in ROWS]  # y of gyroscope 2
        status, line = self.sensors(rows)
        one, two = line["sensors"]
        self.assertEqual((status, one["verdict"], two["verdict"], two["findings"], two["dead"]), (3, "ok", "wrong", ["dead"], ["gyr_y"]))
        self.assertIn("y of the gyroscope of sensor 2 stays at one value", line["advice"][0])
        lines, status = self.lines(recordings.csv(recordings.texts(rows)))
        self.assertEqual((status, lines[-1]["status"], lines[-1]["advice"][0]), (3, "collecting", line["advice"][0]))

    def test_time_that_passes_faster_than_it_says(self):
        rows = [[0.8 * row[0], *row[1:]] for row in recordings.slow_rows(60)]
        status, line = self.sensors(rows)
        self.assertEqual(status, 3)
        for number, sensor in enumerate(line["sensors"], 1):
            self.assertLess(abs(sensor["scale"] - 1.25), sensor["scale_bound"])
            self.assertTrue(any(sentence.startswith(f"rates of sensor {number}: gravity turns 1.2") for sentence in line["advice"]), line["advice"])

    def test_rows_that_are_missing(self):
        status, line = self.sensors([row for k, row in enumerate(ROWS) if k % 50 not in (30, 31, 32, 33)])
        self.assertEqual((status, line["sensors"][0]["verdict"], line["sensors"][0]["findings"]), (0, "doubtful", ["gaps"]))
        self.assertLess(abs(line["sensors"][0]["missing_share"] - 0.08), 0.01)
        self.assertTrue(line["advice"][0].endswith("check the radio, or the logger"), line["advice"])

    def test_three_sensors(self):
        demo = (ROOT / "tools/demo/chain_demo.csv").read_text()
        self.assertEqual(len(self.parse(self.check(demo, "--json").stdout)[0]["gravity_m_s2"]), 3)


class Headers(Words):
    def assert_says(self, text, *parts):
        result = self.hinge(text)
        self.assertEqual((result.returncode, result.stdout), (2, b""))
        for part in parts:
            self.assertIn(part, result.stderr.decode())

    def named(self, *changes):
        header, rest = FILE.split("\n", 1)
        for old, new in changes:
            header = header.replace(old, new)
        return header + "\n" + rest

    def test_names_written_in_another_way(self):
        self.assert_says(FILE.split("\n", 1)[0].upper() + "\n" + FILE.split("\n", 1)[1], "r.csv:1: missing columns t_s",
                         "did you mean t_s for 'T_S', gyr1_x for 'GYR1_X'", "and so on?")
        for name in ("time", "Time", "timestamp", "t", "Time (s)", "time_ms", "seconds"):
            self.assert_says(self.named(("t_s", name)), f"missing column t_s; did you mean t_s for '{name}'?", "t_s in s")
        for old, new in (("gyr1_x", "gyro1_x"), ("gyr1_x", "gyr_x_1"), ("gyr1_x", "Gyr1X"), ("gyr1_x", "gyr1 x [rad/s]"), ("acc2_z", "accel2_z"),
                         ("acc2_z", "Acc_Z2"), ("acc2_z", "acceleration2.z"), ("acc2_z", "acc_2_z (m/s^2)")):
            self.assert_says(self.named((old, new)), f"missing column {old}; did you mean {old} for '{new[:24]}'?")
        self.assert_error(self.hinge(self.named(("gyr1_x", "note"))), "r.csv:1: missing column gyr1_x")

    def test_separators(self):
        for sign, name in ((";", "semicolons"), ("\t", "tabs"), ("|", "bars"), (" ", "blanks")):
            self.assert_says(FILE.replace(",", sign), "missing columns t_s", f"separated by commas, and here they are by {name}")
        self.assert_says(FILE.replace(",", ";").replace(".", ","), "semicolons; decimal commas must be points")
        self.assert_says(FILE.replace(".", ","), "r.csv:2:", "are these decimal commas? Write points")
        quoted = recordings.csv([['"' + cell.replace(".", ",") + '"' for cell in row] for row in CELLS])
        self.assert_says(quoted, "r.csv:2:1: t_s: '0,000000' is not a number: decimals must have a point, not a comma")

    def test_lines_before_the_header(self):
        self.assert_says("sep=,\n" + FILE, "r.csv:1: 'sep=,' is a note for spreadsheets, not the header line: take this line out")
        self.assert_says("sep=;\n" + FILE.replace(",", ";"), "r.csv:1: 'sep=;' is a note for spreadsheets")
        for lines in (1, 3, 20):
            self.assert_says("# made by hand, with care\n" * lines + FILE, f"r.csv:1: the header line must come first, and here {lines} lines stand before it")
        self.assert_says("a,b\n" * 100 + FILE, "missing columns")

    def test_exports_of_others(self):
        dot = "sep=,\nDeviceTag:,x\nOutputRate:,60Hz\n\nPacketCounter,SampleTimeFine,"
        self.assert_says(dot + "Quat_W,Quat_X,Quat_Y,Quat_Z,FreeAcc_X,FreeAcc_Y,FreeAcc_Z\n1,2,1,0,0,0,0,0,0\n", "an export of Movella (Xsens) DOT",
                         "lacks angular rates", "accelerations are free of gravity", "orientations alone are not enough", "with 4 lines before the header line")
        self.assert_says(dot + "Acc_X,Acc_Y,Acc_Z,Gyr_X,Gyr_Y,Gyr_Z\n1,2,0,0,9,0,0,0\n", "an export of Movella (Xsens) DOT", "both sensors in one file")
        self.assert_says("time,seconds_elapsed,z,y,x\n1,2,3,4,5\n", "missing columns")
        self.assert_says("Time (s),Linear Acceleration x (m/s^2),Linear Acceleration y (m/s^2),Linear Acceleration z (m/s^2)\n0,0,0,0\n",
                         "the app phyphox", "lacks angular rates", "free of gravity")

    def test_no_header_and_units_below_it(self):
        self.assert_says(FILE.split("\n", 1)[1], "r.csv:1: no header line: the first line has numbers only")
        header, rest = FILE.split("\n", 1)
        self.assert_says(header + "\n" + ",".join(["s"] + ["x"] * 12) + "\n" + rest, "r.csv:2: a line of units or of names below the header")

    def test_dates(self):
        for date in ("2026-11-30T10:00:00.02", "10:15:20.1", "2026/11/30 10:00"):
            cells = [[date] + row[1:] for row in CELLS[:50]]
            self.assert_says(recordings.csv(cells), "is not a number: t_s counts seconds, and this is a date or a time of day")

    def test_files_that_are_no_text(self):
        data = FILE.encode()
        path = self.folder / "r.zip"
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("r.csv", FILE)
        book = self.folder / "r.xlsx"
        with zipfile.ZipFile(book, "w") as archive:
            archive.writestr("[Content_Types].xml", "<x/>")
            archive.writestr("xl/workbook.xml", "<x/>")
        for content, words in ((gzip.compress(data), "compressed with gzip"), (bz2.compress(data), "compressed with bzip2"),
                               (lzma.compress(data), "compressed with xz"), (path.read_bytes(), "a zip archive"),
                               (book.read_bytes(), "an Excel workbook (xlsx)"), (b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" * 9, "an Excel workbook (xls)"),
                               (FILE.encode("utf-16"), "UTF-16"), (FILE.encode("utf-16-le"), "UTF-16"), (FILE.encode("utf-16-be"), "UTF-16"),
                               (FILE.encode("utf-32"), "UTF-32"), (b"\x89HDF\r\n\x1a\n" * 5, "HDF5"), (b"MATLAB 5.0 MAT-file" * 5, "MATLAB")):
            result = self.hinge(content)
            self.assertEqual((result.returncode, result.stdout), (2, b""), words)
            self.assertTrue(result.stderr.decode().startswith("r.csv: this is "), result.stderr)
            self.assertIn(words, result.stderr.decode())
        self.assertEqual(self.hinge(FILE.encode("utf-8-sig")).stderr, b"")


class Manners(Words):
    def test_short_help(self):
        for command in ([], ["hinge"], ["two-dof"], ["center"], ["chain"], ["angles"], ["stream"]):
            short, long = self.run_program(*command, "-h"), self.run_program(*command, "--help")
            self.assertEqual((short.returncode, short.stdout, short.stderr), (0, long.stdout, b""))
            if command and command[0] not in ("angles", "stream"):
                self.assertIn("+9.81 on the axis that points up", " ".join(long.stdout.decode().split()))
                self.assertIn("[ sensor 1 ]-----------( o )-----------[ sensor 2 ]", long.stdout.decode())

    def test_head_of_the_output(self):
        name = self.write(FILE)
        for arguments in (f"hinge {name} --json --every 0.01", f"angles {name} --joint hinge", "hinge --help"):
            result = subprocess.run(["bash", "-c", f"'{PROGRAM}' {arguments} | head -n 1"], cwd=self.folder, capture_output=True)
            self.assertEqual((result.stdout.count(b"\n"), result.stderr), (1, b""), arguments)

    def test_interrupted_angles_leave_no_file(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            out = self.folder / "a.csv"
            with subprocess.Popen([PROGRAM, "angles", "-", "--joint", "hinge", "--out", "a.csv"], cwd=self.folder, stdin=subprocess.PIPE) as run:
                run.stdin.write(FILE.encode())
                run.stdin.flush()
                part = self.folder / "a.csv.part"
                for _ in range(200):
                    if part.exists():
                        break
                    time.sleep(0.05)
                self.assertTrue(part.exists())
                self.assertFalse(out.exists())
                run.send_signal(number)
                run.stdin.close()
                self.assertEqual(run.wait(), -number)
            self.assertEqual(list(self.folder.glob("a.csv*")), [])

    def test_a_file_of_before_stays_until_the_new_one_is_complete(self):
        (self.folder / "a.csv").write_text("before")
        self.assertEqual(self.run_program("angles", self.write(SHORT + "1,2\n"), "--joint", "hinge", "--out", "a.csv").returncode, 2)
        self.assertEqual((self.folder / "a.csv").read_text(), "before")
        self.run_program("angles", self.write(FILE), "--joint", "hinge", "--out", "a.csv")
        self.assertTrue((self.folder / "a.csv").read_text().startswith("t_s,flexion_deg\n"))
        self.assertEqual(list(self.folder.glob("*.part")), [])

    def test_time_left_on_a_terminal(self):
        rows = recordings.csv(CELLS * 60)
        terminal, child = os.openpty()
        with subprocess.Popen([PROGRAM, "two-dof", self.write(rows)], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=child) as run:
            os.close(child)
            text = b""
            try:
                while chunk := os.read(terminal, 4096):
                    text += chunk
            except OSError:
                pass  # what a terminal says when its other side has closed
            run.wait()
        os.close(terminal)
        self.assertIn(b"%", text)
        self.assertTrue(text.endswith(b" \r"))
