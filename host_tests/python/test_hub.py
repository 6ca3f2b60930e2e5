# SPDX-License-Identifier: MIT
"""The second implementation of docs/PROTOCOL.md agrees with its table of messages and its test vectors."""
import pathlib
import re
import struct
import unittest
import zlib

from jointcal_tools import hub, hub_vectors

DOC = pathlib.Path(__file__).resolve().parents[2] / "docs" / "PROTOCOL.md"
BYTES = {"u8": 1, "u16": 2, "u32": 4, "u64": 8, "i16": 2, "f32": 4}


def bytes_in_words(payload: str) -> int:
    """Bytes of the fields that a row of the table always has, counted from its words: `6 f32 axis1, axis2` is 24."""
    size = 0
    for part in re.sub(r"\([^)]*\)", "", payload).split(";"):
        if re.match(r"\s*\d to \d+", part):
            break
        match = re.search(r"(?:^|: | )(?:(\d+) )?(u8|u16|u32|u64|i16|f32|text)\b(.*)", part)
        if match:
            size += int(match[1] or 1 + match[3].count(",")) * BYTES.get(match[2], 1)
    return size


class Vectors(unittest.TestCase):
    def setUp(self):
        self.lines = [line for line in DOC.read_text().splitlines() if line.startswith("vector ")]

    def test_vectors(self):
        for line in self.lines:
            kind, number, payload, wire = line.split()[1:]
            kind, payload, wire = int(kind, 16), bytes.fromhex(payload.strip("-")), bytes.fromhex(wire)
            self.assertEqual(hub.encode(kind, int(number, 16), payload), wire)
            self.assertEqual(hub.decode(wire[:-1]), hub.Frame(hub.VERSION, kind, int(number, 16), payload))
            self.assertLessEqual(len(payload), hub.PAYLOAD_MAX)
            self.assertLess(len(wire), 254)
            if kind in hub.MESSAGES:
                self.assertEqual(hub.pack(kind, **hub.unpack(kind, payload)), payload)

    def test_every_message_has_one(self):
        self.assertEqual({int(line.split()[1], 16) for line in self.lines} - {0x7F}, set(hub.MESSAGES))
        rows = dict(re.findall(r"^\| (0x[0-9a-f]{2}) \| \w+ hub \| ([\w ]+) \|", DOC.read_text(), re.MULTILINE))
        self.assertEqual({int(kind, 16) for kind in rows}, set(hub.MESSAGES))

    def test_text_holds_the_vectors_of_the_command(self):
        self.assertEqual(self.lines, hub_vectors.lines())

    def test_sizes_are_those_of_the_table(self):
        for kind, payload in re.findall(r"^\| (0x[0-9a-f]{2}) \| \w+ hub \| [\w ]+ \| (.*) \|$", DOC.read_text(), re.MULTILINE):
            self.assertEqual(struct.calcsize(hub.fixed(int(kind, 16))), bytes_in_words(payload), (kind, payload))

    def test_edges_by_hand(self):
        """Bytes that a reader of the text would write."""
        self.assertEqual(hub.pack(hub.PACKET, sensor=2, arrival_us=3, counter=4, readings=[(1, -1, 256, 0, 0, -32768)]),
                         bytes.fromhex("02 0300000000000000 04000000 0100 ffff 0001 0000 0000 0080"))
        self.assertEqual(hub.pack(hub.FLEXIONS, t_us=1, flexions=[]), bytes.fromhex("0100000000000000"))
        self.assertEqual(hub.pack(hub.JOINT, number=1, kind=0, proximal=2, distal=3, max_bound_rad=1.0, name="knee"),
                         bytes.fromhex("01 00 02 03 0000803f") + b"knee" + bytes(12))
        self.assertTrue(hub.pack(hub.JOINT, number=1, kind=0, proximal=2, distal=3, max_bound_rad=1.0, name="x" * 16).endswith(b"x" * 16))
        self.assertEqual(hub.pack(hub.ADVICE, joint=1, sensor=255, hint=2, reason=3, text="Bend."), bytes.fromhex("01ff0203") + b"Bend.")

    def test_lengths_that_no_message_has(self):
        for kind, _, payload in hub_vectors.vectors():
            if kind not in hub.MESSAGES:
                continue
            for wrong in (payload[:-1], payload + b"\0"):
                is_advice = kind == hub.ADVICE and 4 <= len(wrong) <= 204
                self.assertEqual(hub.unpack(kind, wrong) is not None, is_advice, (kind, len(wrong)))
        self.assertIsNone(hub.unpack(hub.PACKET, bytes(13)))
        self.assertIsNone(hub.unpack(hub.PACKET, bytes(13 + 17 * 12)))
        self.assertIsNone(hub.unpack(hub.ORIENTATIONS, bytes(8)))
        self.assertIsNone(hub.unpack(0x7F, b""))

    def test_what_does_not_fit_is_refused(self):
        for wrong in (dict(sensor=0, arrival_us=0, counter=0, readings=[]), dict(sensor=0, arrival_us=0, counter=0, readings=[(0,) * 6] * 17),
                      dict(sensor=0, arrival_us=0, counter=0, readings=[(0,) * 6], more=1)):
            with self.assertRaises(ValueError):
                hub.pack(hub.PACKET, **wrong)
        with self.assertRaises(KeyError):
            hub.pack(hub.BEGIN, nonce=1)

    def test_another_version_is_named(self):
        body = struct.pack("<BBI", 2, hub.HELLO, 0)
        piece = hub.stuff(body + struct.pack("<I", zlib.crc32(body)))[:-1]
        self.assertEqual(hub.decode(piece).version, 2)

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
