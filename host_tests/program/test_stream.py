#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of `jointcal stream` with a hub on this machine: test_stream.py PROGRAM HUB."""
import os
import pathlib
import pty
import socket
import subprocess
import sys
import tempfile
import threading
import time
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

import recordings  # noqa: E402
from jointcal_tools import hub  # noqa: E402

PROGRAM, HUB = (str(pathlib.Path(path).resolve()) for path in sys.argv[1:3])
DEMO = str(ROOT / "tools" / "demo" / "hinge_demo.csv")


class Stream(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def hub(self, where):
        """Starts a hub; returns the line that says where it listens."""
        process = subprocess.Popen([HUB, where], stdout=subprocess.PIPE, text=True)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.addCleanup(process.stdout.close)
        return process.stdout.readline().strip()

    def unix_hub(self):
        path = f"unix:{self.folder / 'hub'}"
        self.assertEqual(self.hub(path), "listening")
        return path

    def run_program(self, *arguments):
        return subprocess.run([PROGRAM, *arguments], capture_output=True, timeout=120, cwd=self.folder)

    def stream(self, target, recording, *options):
        return self.run_program("stream", recording, "--to", target, "--speed", "max", *options)

    def same(self, target, recording, *options):
        expected = self.run_program("hinge", recording, "--json", *options)
        got = self.stream(target, recording, *options)
        self.assertEqual(got.stderr, b"")
        self.assertEqual(got.stdout, expected.stdout)
        self.assertEqual(got.returncode, expected.returncode)
        return got

    def write(self, text):
        path = self.folder / "r.csv"
        path.write_text(text)
        return str(path)

    def test_same_bytes_as_hinge(self):
        target = self.unix_hub()
        for options in ([], ["--every", "0.1"], ["--every", "0.37", "--max-bound", "1"], ["--sign-hint", "opposite"]):
            got = self.same(target, DEMO, *options)
            self.assertIn(got.returncode, (0, 3))

    def test_tcp(self):
        port = self.hub("tcp:0").split()[-1]
        self.same(f"tcp:localhost:{port}", DEMO, "--every", "1")

    def test_not_ready_is_three(self):
        rows = recordings.texts(recordings.hinge_rows(1))
        self.assertEqual(self.same(self.unix_hub(), self.write(recordings.csv(rows))).returncode, 3)

    def test_rejected_rows_holes_and_rows_without_time(self):
        rows = recordings.texts(recordings.hinge_rows(20))
        for row in (0, 1, 50, 51, 300):
            rows[row][0] = "nan"
        rows[60][3] = ""
        rows[100], rows[101] = rows[101], rows[100]
        rows[200] = list(rows[199])
        del rows[400:440]
        self.same(self.unix_hub(), self.write(recordings.csv(rows)), "--every", "0.2")

    def test_no_rows(self):
        self.same(self.unix_hub(), self.write(recordings.csv([])))

    def test_wrong_recordings_end_as_with_hinge(self):
        target = self.unix_hub()
        rows = recordings.texts(recordings.hinge_rows(2))
        rows[40][4] = "x"
        for recording in (self.write(recordings.csv(rows)), "absent.csv"):
            expected = self.run_program("hinge", recording, "--json")
            got = self.stream(target, recording)
            self.assertEqual((got.returncode, got.stderr), (2, expected.stderr))
            self.assertNotIn(b'"end"', got.stdout)

    def test_command_line(self):
        for arguments, part in (([DEMO], "where is the hub"), ([DEMO, "--to", "x"], "none of"),
                                (["--to", "unix:x"], "which recording"),
                                ([DEMO, "--to", "unix:x", "--speed", "fast"], "--speed")):
            got = self.run_program("stream", *arguments)
            self.assertEqual(got.returncode, 2)
            self.assertIn(part, got.stderr.decode())

    def test_no_hub(self):
        got = self.stream("unix:absent", DEMO)
        self.assertEqual((got.returncode, got.stderr), (1, b"unix:absent: No such file or directory\n"))

    def silent(self, talk):
        """Runs against a peer that only does what talk(connection) does."""
        server = socket.socket(socket.AF_UNIX)
        self.addCleanup(server.close)
        server.bind(str(self.folder / "silent"))
        server.listen(1)

        def serve():
            connection, _ = server.accept()
            with connection:
                talk(connection)

        thread = threading.Thread(target=serve, daemon=True)
        thread.start()
        return self.stream(f"unix:{self.folder / 'silent'}", DEMO, "--timeout", "1")

    def test_silent_hub(self):
        def talk(connection):
            while connection.recv(4096):
                pass
        got = self.silent(talk)
        self.assertEqual(got.returncode, 1)
        self.assertIn(b"the hub has been silent for 1 seconds", got.stderr)

    def test_hub_that_falls_silent(self):
        def talk(connection):
            greeted = False
            data = b""
            while True:
                more = connection.recv(4096)
                if not more:
                    return
                data += more
                if not greeted and b"\0" in data:
                    frame = hub.decode(data.split(b"\0")[0])
                    connection.sendall(hub.encode(hub.HELLO, 0, frame.payload[:4] + bytes([0, 24, 0, 0, 0])))
                    greeted = True
        got = self.silent(talk)
        self.assertEqual(got.returncode, 1)
        self.assertIn(b"silent", got.stderr)

    def test_hub_that_goes_away(self):
        got = self.silent(lambda connection: connection.recv(10))
        self.assertEqual(got.returncode, 1)
        self.assertRegex(got.stderr, b"closed the connection|reset by peer")

    def test_real_time(self):
        rows = recordings.texts(recordings.hinge_rows(2))
        target, recording = self.unix_hub(), self.write(recordings.csv(rows))
        began = time.monotonic()
        self.assertEqual(self.run_program("stream", recording, "--to", target).returncode, 3)
        self.assertGreater(time.monotonic() - began, 1.8)
        began = time.monotonic()
        self.run_program("stream", recording, "--to", target, "--speed", "10")
        self.assertGreater(time.monotonic() - began, 0.18)

    def test_serial_device(self):
        """A pseudo-terminal stands in for the serial line; bytes are carried to a hub and back."""
        self.unix_hub()
        peer = socket.socket(socket.AF_UNIX)
        self.addCleanup(peer.close)
        peer.connect(str(self.folder / "hub"))
        master, slave = pty.openpty()
        self.addCleanup(os.close, slave)

        def carry(receive, send):
            try:
                while data := receive():
                    send(data)
            except OSError:
                pass

        threading.Thread(target=carry, args=(lambda: os.read(master, 4096), peer.sendall), daemon=True).start()
        threading.Thread(target=carry, args=(lambda: peer.recv(4096), lambda data: os.write(master, data)),
                         daemon=True).start()
        self.same(os.ttyname(slave), DEMO, "--every", "1")

    def test_progress_bar_on_a_terminal_only(self):
        target = self.unix_hub()
        master, slave = pty.openpty()
        process = subprocess.Popen([PROGRAM, "stream", DEMO, "--to", target, "--speed", "max"], stderr=slave,
                                   stdout=subprocess.PIPE)
        process.communicate(timeout=60)
        os.close(slave)
        self.assertIn(b"%", os.read(master, 65536))
        os.close(master)

    def test_faults_on_the_way_are_told(self):
        """A relay drops the frames to the hub that it is told to drop: the run ends well and says so."""
        self.unix_hub()
        relay = socket.socket(socket.AF_UNIX)
        self.addCleanup(relay.close)
        relay.bind(str(self.folder / "relay"))
        relay.listen(1)

        def serve():
            connection, _ = relay.accept()
            peer = socket.socket(socket.AF_UNIX)
            self.addCleanup(connection.close)
            self.addCleanup(peer.close)
            peer.connect(str(self.folder / "hub"))
            threading.Thread(target=back, args=(peer, connection), daemon=True).start()
            rest = b""
            while data := connection.recv(4096):
                *pieces, rest = (rest + data).split(b"\0")
                for piece in pieces:
                    if hub.decode(piece).sequence not in (7, 100, 101, *range(200, 218)):
                        peer.sendall(piece + b"\0")

        def back(peer, connection):
            try:
                while data := peer.recv(4096):
                    connection.sendall(data)
            except OSError:
                pass

        threading.Thread(target=serve, daemon=True).start()
        got = self.stream(f"unix:{self.folder / 'relay'}", DEMO)
        self.assertEqual(got.returncode, 0)
        self.assertIn(b"21 lost, 0 repeated, 0 corrupted", got.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
