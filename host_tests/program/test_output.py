# SPDX-License-Identifier: MIT
"""What the program writes: JSON Lines, the summary, the progress bar; and what happens when it cannot write."""
import json
import math
import os
import pathlib
import subprocess
import unittest

import recordings
from recordings import COLUMNS
from support import CELLS, FILE, KEYS, PROGRAM, REJECT_KEYS, SHORT, WINDOW_KEYS, ProgramTest, with_cell

DEMO = pathlib.Path(__file__).resolve().parents[2] / "tools" / "demo" / "hinge_demo.csv"


class Output(ProgramTest):
    def check_line(self, line, keys):
        self.assertEqual(list(line), keys)
        self.assertEqual(list(line["rejected_by"]), REJECT_KEYS)
        self.assertIn(line["event"], ("estimate", "ready", "moved", "end"))
        self.assertIn(line["status"], ("collecting", "ambiguous", "ready", "moved"))
        for axis in (line["axis1"], line["axis2"]):
            if axis is not None:
                self.assertAlmostEqual(math.hypot(*axis), 1.0, places=5)
        if line["status"] == "ready":
            self.assertIsNone(line["reason"])
            self.assertEqual(len(line["uncertainty_deg"]), 2)

    def test_every_line_has_every_key(self):
        for engine, keys in (("stream", KEYS), ("window", WINDOW_KEYS)):
            lines, _ = self.lines(FILE, "--every", "0.5", "--engine", engine)
            for line in lines:
                self.check_line(line, keys)
                self.assertEqual(line["engine"], engine)
            self.assertEqual([line["event"] for line in lines].count("end"), 1)

    def test_events_in_recording_time(self):
        lines, _ = self.lines(FILE, "--every", "2.5")
        times = [line["t_s"] for line in lines if line["event"] == "estimate"]
        self.assertEqual(times, [2.5, 5, 7.5, 10, 12.5, 15, 17.5])
        self.assertEqual([line["event"] for line in self.lines(FILE)[0] if line["event"] == "estimate"], [])

    def test_every_passes_over_holes(self):
        rows = recordings.hinge_rows(10)
        cells = recordings.texts([row for row in rows if not 2.2 < row[0] < 6.3])
        lines, _ = self.lines(recordings.csv(cells), "--every", "1")
        times = [line["t_s"] for line in lines if line["event"] == "estimate"]
        self.assertEqual(times, [1, 2, 6.3, 7, 8, 9])

    def test_same_input_same_output(self):
        self.assertEqual(self.hinge(FILE, "--json").stdout, self.hinge(FILE, "--json").stdout)

    def test_events_come_at_once(self):
        with subprocess.Popen([PROGRAM, "hinge", "--json", "--every", "0.5", "-"], stdin=subprocess.PIPE,
                              stdout=subprocess.PIPE) as run:
            run.stdin.write(SHORT.encode())
            run.stdin.flush()
            line = run.stdout.readline()
            run.communicate()
        self.assertEqual(json.loads(line)["event"], "estimate")

    def test_summary_for_people(self):
        result = self.hinge(FILE)
        lines = result.stdout.decode().splitlines()
        self.assertTrue(lines[0].startswith("Hinge, stream engine: "))
        self.assertIn("1000 read, 0 rejected", result.stdout.decode())
        self.assertIn(f"exit status        {result.returncode}: ", lines[-1])
        rejected = self.hinge(recordings.csv(with_cell(3, "gyr1_x", "nan")))
        self.assertIn("50 read, 1 rejected: 1 empty or not finite", rejected.stdout.decode())
        unknown = self.hinge(recordings.csv([]))
        self.assertIn("unknown", unknown.stdout.decode())
        self.assertEqual(unknown.returncode, 3)

    def test_no_progress_bar_without_terminal(self):
        self.assertEqual(self.hinge(FILE).stderr, b"")

    def test_progress_bar_on_a_terminal(self):
        terminal, child = os.openpty()
        with subprocess.Popen([PROGRAM, "hinge", self.write(FILE)], cwd=self.folder, stdout=subprocess.DEVNULL,
                              stderr=child) as run:
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

    def test_closed_pipe_and_full_disk(self):
        reader, writer = os.pipe()
        os.close(reader)
        result = subprocess.run([PROGRAM, "hinge", self.write(FILE), "--json", "--every", "0.1"], cwd=self.folder,
                                stdout=writer, stderr=subprocess.PIPE)
        os.close(writer)
        self.assertEqual(result.stderr, b"")  # as `| head` does: nothing to say
        self.assertEqual(result.returncode, 1)
        if os.path.exists("/dev/full"):
            with open("/dev/full", "wb") as full:
                result = subprocess.run([PROGRAM, "hinge", "r.csv"], cwd=self.folder, stdout=full,
                                        stderr=subprocess.PIPE)
            self.assertEqual(result.stderr, b"standard output: No space left on device\n")
            self.assertEqual(result.returncode, 1)

    def test_memory_does_not_grow_with_the_recording(self):
        def peak_kib(repeats):
            """Largest resident size while reading rows from a pipe."""
            body = "\n".join(",".join(row) for row in CELLS).encode() + b"\n"
            with subprocess.Popen([PROGRAM, "hinge", "--json", "-"], stdin=subprocess.PIPE,
                                  stdout=subprocess.PIPE) as run:
                run.stdin.write((",".join(COLUMNS) + "\n").encode())
                for _ in range(repeats):
                    run.stdin.write(body)
                run.stdin.close()
                run.stdout.read()
                _, status, usage = os.wait4(run.pid, 0)
                run.returncode = os.waitstatus_to_exitcode(status)
                self.assertIn(run.returncode, (0, 3))
            return usage.ru_maxrss
        # 1.2 MB against 24 MB of text.
        self.assertLess(peak_kib(200), peak_kib(10) + 2048)


@unittest.skipUnless(DEMO.exists(), "no demo recording")
class Demo(ProgramTest):
    def test_demo_recording_becomes_ready(self):
        lines = self.parse(self.run_program("hinge", str(DEMO), "--json", "--every", "1").stdout)
        events = [line["event"] for line in lines]
        self.assertIn("ready", events)
        self.assertEqual(lines[-1]["status"], "ready")
        self.assertEqual(lines[events.index("ready")]["status"], "ready")
        self.assertLessEqual(max(lines[-1]["uncertainty_deg"]), 3.0)
