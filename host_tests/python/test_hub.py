# SPDX-License-Identifier: MIT
"""The second implementation of docs/PROTOCOL.md agrees with its test vectors."""
import pathlib
import unittest
import zlib

from jointcal_tools import hub

DOC = pathlib.Path(__file__).resolve().parents[2] / "docs" / "PROTOCOL.md"


class Vectors(unittest.TestCase):
    def test_vectors(self):
        lines = [line.split()[1:] for line in DOC.read_text().splitlines() if line.startswith("vector ")]
        self.assertEqual(len(lines), 8)
        for kind, number, payload, wire in lines:
            payload = bytes.fromhex(payload.strip("-"))
            wire = bytes.fromhex(wire)
            self.assertEqual(hub.encode(int(kind, 16), int(number, 16), payload), wire)
            self.assertEqual(hub.decode(wire[:-1]), hub.Frame(hub.VERSION, int(kind, 16), int(number, 16), payload))

    def test_crc(self):
        self.assertEqual(zlib.crc32(b"123456789"), 0xCBF43926)

    def test_expected_counts(self):
        expected = hub.Expected(0)
        used = [expected.piece(number) for number in (1, 1, 3, 2, None, 6)]
        self.assertEqual(used, [True, False, True, False, False, True])
        self.assertEqual(expected.counts, {"received": 6, "taken": 4, "lost": 2, "repeated": 1, "corrupted": 1,
                                           "reordered": 1, "stale": 0})


if __name__ == "__main__":
    unittest.main()
