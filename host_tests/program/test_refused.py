# SPDX-License-Identifier: MIT
"""Command lines and recordings that the program refuses: message and exit status of each."""
import os

import recordings
from recordings import COLUMNS
from support import CELLS, FILE, SHORT, ProgramTest, with_cell


class CommandLine(ProgramTest):
    def test_version_and_help(self):
        for arguments in (["--version"], ["hinge", "--version"]):
            result = self.run_program(*arguments)
            self.assertRegex(result.stdout.decode(), r"^jointcal \d+\.\d+\.\d+\n$")
            self.assertEqual(result.returncode, 0)
        result = self.run_program("--help")
        self.assertIn("hinge", result.stdout.decode())
        self.assertEqual(result.returncode, 0)
        result = self.run_program("hinge", "--help")
        self.assertEqual(result.returncode, 0)
        for option in ("engine", "n-max", "window", "every", "max-bound", "sign-hint", "json"):
            self.assertIn("--" + option, result.stdout.decode())

    def test_subcommands(self):
        self.assert_usage([], "which subcommand")
        self.assert_usage(["knee"], "no subcommand 'knee'")
        self.assert_usage(["hinge"], "which recording")
        self.assert_usage(["hinge", "a.csv", "b.csv", "c.csv"], "'c.csv' is a third one")

    def test_values_of_options(self):
        self.assert_usage(["hinge", "a", "--engine", "steam"], "--engine: 'steam' is neither stream nor window")
        self.assert_usage(["hinge", "a", "--sign-hint", "both"], "--sign-hint: 'both' is neither same nor opposite")
        for value in ("0", "-1", "x", "", "nan", "inf", "1s"):
            self.assert_usage(["hinge", "a", "--every=" + value], "--every")
            self.assert_usage(["hinge", "a", "--window=" + value], "--window")
            self.assert_usage(["hinge", "a", "--max-bound=" + value], "--max-bound")
        self.assert_usage(["hinge", "a", "--max-bound=60"], "--max-bound")
        for value in ("19", "21.5", "10001", "1e9", "x", "-20"):
            self.assert_usage(["hinge", "a", "--engine=window", "--n-max=" + value], "--n-max")
        self.assert_usage(["hinge", "a", "--wrong"], "unrecognized option '--wrong'")

    def test_options_that_do_not_go_together(self):
        self.assert_usage(["hinge", "a", "--n-max", "100"], "--n-max goes with --engine window only")
        self.assert_usage(["hinge", "a", "--n-max", "100", "--engine", "stream"], "--n-max goes with")
        self.assert_usage(["hinge", "a", "--window", "10", "--engine", "window"], "--window does not go with")

    def test_window_changes_nothing_for_the_stream_engine(self):
        self.assertEqual(self.hinge(FILE, "--json").stdout, self.hinge(FILE, "--json", "--window", "5").stdout)


class WrongRecordings(ProgramTest):
    def test_missing_columns_are_all_named(self):
        name = self.write("t_s,gyr1_x,note\n0,1,a\n")
        self.assert_error(self.run_program("hinge", name), "r.csv:1: missing columns " + ", ".join(COLUMNS[2:]))
        cells = [row[:4] + row[5:] for row in CELLS]
        columns = COLUMNS[:4] + COLUMNS[5:]
        self.assert_error(self.hinge(recordings.csv(cells, columns)), "r.csv:1: missing column acc1_x")
        semicolons = FILE.replace(",", ";")
        self.assertIn("separated by commas", self.hinge(semicolons).stderr.decode())

    def test_column_twice(self):
        text = recordings.csv([row + ["1"] for row in CELLS], COLUMNS + ["gyr1_x"])
        self.assert_error(self.hinge(text), f"r.csv:1:{len(','.join(COLUMNS)) + 2}: column gyr1_x appears twice")

    def test_text_where_a_number_belongs(self):
        for text in ("x", "1.0.0", "1,", "0x10", "1e", "--1", "1 2", "nan(1)", "1f", "+", ".", "\xe9"):
            cells = with_cell(2, "gyr1_x", '"' + text + '"')
            position = len(cells[2][0]) + 2
            shown = "??" if text == "\xe9" else text
            self.assert_error(self.hinge(recordings.csv(cells)),
                              f"r.csv:4:{position}: gyr1_x: '{shown}' is not a number")
        self.assert_error(self.hinge(recordings.csv(with_cell(0, "t_s", "noon"))),
                          "r.csv:2:1: t_s: 'noon' is not a number")
        long = self.hinge(recordings.csv(with_cell(0, "t_s", "y" * 1000)))
        self.assert_error(long, f"r.csv:2:1: t_s: '{'y' * 28}...' is not a number")

    def test_lines_of_other_length(self):
        self.assert_error(self.hinge(SHORT + "1,2,3\n"), "r.csv:52: short line: 3 of 13 cells")
        self.assert_error(self.hinge(SHORT.rstrip("\n").rsplit(",", 1)[0]), "r.csv:51: short line: 12 of 13 cells")
        row = ",".join(CELLS[50])
        self.assert_error(self.hinge(SHORT + row + ",7\n"),
                          f"r.csv:52:{len(row) + 2}: long line: 14 cells where the header has 13")

    def test_second_header(self):
        self.assert_error(self.hinge(SHORT + SHORT), "r.csv:52: a second header line")

    def test_lines_written_before_an_error_stay(self):
        result = self.hinge(SHORT + "1,2,3\n", "--json", "--every", "0.5")
        self.assertEqual([line["event"] for line in self.parse(result.stdout)], ["estimate"])
        self.assertEqual(result.returncode, 2)

    def test_empty_absent_directory_binary(self):
        for text in ("", "\n\n", "\ufeff", " \r\n"):
            self.assert_error(self.hinge(text), "r.csv: the file is empty")
        self.assert_error(self.run_program("hinge", "absent.csv"), "absent.csv: No such file or directory")
        self.assert_error(self.run_program("hinge", "."), ".: Is a directory")
        self.assert_error(self.hinge(b"\x7fELF\x02\x01\x01\x00\x00"),
                          "r.csv:1:8: a zero byte: this is not a text file")
        self.assert_error(self.hinge(SHORT.encode() + b"1,\x00"), "r.csv:52:3: a zero byte: this is not a text file")
        self.assert_error(self.hinge(os.urandom(1 << 21).replace(b"\0", b"a").replace(b"\n", b"b")
                                     .replace(b"\r", b"c").replace(b'"', b"d").replace(b",", b"e")),
                          "r.csv:1: a row of more than a million bytes: this is not a recording")

    def test_quotes(self):
        self.assert_error(self.hinge(SHORT + '"1,2\n'), "r.csv:52:1: a quote that is never closed")
        self.assert_error(self.hinge(SHORT + '"1"2,3\n'), "r.csv:52:4: text after a closing quote")

    def test_standard_input_is_named_in_messages(self):
        self.assert_error(self.run_program("hinge", "-", stdin="t_s\n"),
                          "-:1: missing columns " + ", ".join(COLUMNS[1:]))
