# SPDX-License-Identifier: MIT
"""Recordings that the program takes, in whatever form, and the rows in them that it rejects."""
import json
import os
import subprocess

import recordings
from recordings import COLUMNS
from support import CELLS, FILE, PROGRAM, SHORT, ProgramTest, with_cell


class GoodRecordings(ProgramTest):
    """The same data in every form gives the same bytes."""

    @classmethod
    def setUpClass(cls):
        result = subprocess.run([PROGRAM, "hinge", "--json", "--every", "1", "-"], input=FILE.encode(),
                                capture_output=True, check=False)
        cls.expected = result.stdout

    def assert_same(self, text):
        result = self.hinge(text, "--json", "--every", "1")
        self.assertEqual(result.stderr, b"")
        self.assertEqual(result.stdout, self.expected)

    def test_file_and_standard_input(self):
        self.assert_same(FILE)

    def test_line_ends_and_byte_order_mark(self):
        self.assert_same(FILE.replace("\n", "\r\n"))
        self.assert_same(FILE.replace("\n", "\r"))
        self.assert_same("\ufeff" + FILE)
        self.assert_same(FILE.rstrip("\n"))
        self.assert_same(FILE.replace("\n", "\n\n") + "\n \n")

    def test_columns_in_any_order_among_others(self):
        columns = COLUMNS[::-1]
        self.assert_same(recordings.csv([row[::-1] for row in CELLS], columns))
        columns = ["note"] + COLUMNS + ["q1_w", ""]
        self.assert_same(recordings.csv([['"a, ""b""\nc"'] + row + ["x", ""] for row in CELLS], columns))

    def test_quotes_blanks_and_commas_at_the_end(self):
        quoted = [['"' + cell + '"' for cell in row] for row in CELLS]
        self.assert_same(recordings.csv(quoted, ['"' + name + '"' for name in COLUMNS]))
        self.assert_same(FILE.replace(",", " ,\t"))
        self.assert_same(recordings.csv([row + [""] for row in CELLS]))

    def test_spelling_of_numbers(self):
        cells = [[f"{float(row[0]) * 1e3:.3f}e-3", "+" + row[1] if row[1][0] != "-" else row[1]] + row[2:]
                 for row in CELLS]
        self.assert_same(recordings.csv(cells))

    def test_locale_does_not_matter(self):
        result = self.run_program("hinge", "--json", "--every", "1", self.write(FILE),
                                  env={**os.environ, "LC_ALL": "de_DE.UTF-8"})
        self.assertEqual(result.stdout, self.expected)

    def test_a_pipe_that_hands_over_single_bytes(self):
        text = ("\ufeff" + SHORT).encode()
        with subprocess.Popen([PROGRAM, "hinge", "--json", "-"], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as run:
            for byte in text[:600]:
                run.stdin.write(bytes([byte]))
                run.stdin.flush()
            output = run.communicate(text[600:])[0]
        self.assertEqual(output, self.hinge(SHORT, "--json").stdout)

    def test_shift_of_time_changes_no_bit(self):
        rows = recordings.hinge_rows(20)
        for shift_us in (1, 10**15 + 7, -(10**15) - 123457, -10 * 10**6):
            lines, _ = self.lines(recordings.csv(recordings.texts(rows, shift_us)), "--every", "1")
            for line, expected in zip(lines, self.parse(self.expected), strict=True):
                self.assertAlmostEqual(line["t_s"], expected["t_s"] + shift_us / 1e6, places=2)
                self.assertEqual({**line, "t_s": 0}, {**expected, "t_s": 0})

    def test_times_of_events_are_exact(self):
        for first, last in (("0.1", "0.3"), ("-0.25", "0"), ("1700000000.000001", "1700000000.123457")):
            cells = [[first] + CELLS[0][1:], [last] + CELLS[1][1:]]
            output = self.hinge(recordings.csv(cells), "--json").stdout.decode()
            self.assertIn(f'"t_s": {last},', output)


class RejectedRows(ProgramTest):
    def rejected(self, cells):
        end = self.end(recordings.csv(cells))
        self.assertEqual(end["rejected"], sum(end["rejected_by"].values()))
        self.assertEqual(end["samples"], len(cells))
        return end["rejected_by"]

    def test_cells_that_are_not_finite(self):
        for text in ("", "nan", "NaN", "-nan", "inf", "-Infinity", "+INF", "1e39", " "):
            for column in ("gyr1_x", "acc2_z", "t_s"):
                if text == "1e39" and column != "t_s":
                    continue
                rejected = self.rejected(with_cell(7, column, text))
                self.assertEqual(rejected["not_finite"], 1, (text, column))
        self.assertEqual(self.rejected(with_cell(7, "acc1_x", "1e39"))["not_finite"], 1)

    def test_orientations_that_end(self):
        columns = COLUMNS + recordings.ORIENTATION_COLUMNS
        rows = recordings.texts(recordings.two_dof_rows(30))
        for broken in ([], ["q2_w"], ["q1_x", "q1_y"], ["acc2_z"], ["t_s"]):
            cells = [list(row) for row in rows]
            for row in cells[1350:]:  # of 1500
                for column in broken:
                    row[columns.index(column)] = "nan"
            result = self.run_program("two-dof", self.write(recordings.csv(cells, columns)), "--json")
            end = json.loads(result.stdout.decode().splitlines()[-1])
            self.assertEqual((result.returncode, end["status"], end["reason"]),
                             (3, "collecting", "bad_samples") if broken else (0, "ready", None), broken)
            self.assertEqual(end["rejected_by"]["not_finite"], 150 if broken else 0)

    def test_first_rows_without_time(self):
        cells = with_cell(0, "t_s", "")
        cells[1][0] = "nan"
        rejected = self.rejected(cells)
        self.assertEqual((rejected["not_finite"], rejected["time_order"]), (2, 0))

    def test_only_rows_without_time(self):
        cells = [[""] + row[1:] for row in CELLS[:5]]
        self.assertEqual(self.rejected(cells)["not_finite"], 5)
        self.assertIsNone(self.end(recordings.csv(cells))["t_s"])

    def test_time_that_does_not_increase(self):
        self.assertEqual(self.rejected(with_cell(20, "t_s", CELLS[19][0]))["time_order"], 1)
        self.assertEqual(self.rejected(with_cell(20, "t_s", "-1000"))["time_order"], 1)
        self.assertEqual(self.rejected(with_cell(1, "t_s", "-1e9"))["time_order"], 1)

    def test_header_alone_is_a_recording_of_nothing(self):
        end = self.end(recordings.csv([]))
        self.assertEqual((end["samples"], end["rejected"], end["t_s"]), (0, 0, None))
