# SPDX-License-Identifier: MIT
"""Frames and messages of docs/PROTOCOL.md, written from that text and not from the C code, so that each checks the other."""
from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass

VERSION = 2
START, SAMPLE, REQUEST = 0x01, 0x02, 0x03
HELLO, ESTIMATE, COUNTERS, CREDIT = 0x81, 0x82, 0x83, 0x84
REJECTS = ("not_finite", "out_of_range", "saturated", "frozen", "repeated", "time_order", "gap")
COUNTER_NAMES = ("received", "taken", "lost", "repeated", "corrupted", "reordered", "stale", "unknown", "overrun",
                 "samples")
HISTORY = 64


def stuff(body: bytes) -> bytes:
    """COBS with the final zero, for bodies of less than 254 bytes."""
    groups = body.split(b"\0")
    return b"".join(bytes([len(group) + 1]) + group for group in groups) + b"\0"


def unstuff(piece: bytes) -> bytes | None:
    """The body of what stood between two zeros, or None if it is none."""
    body, at = bytearray(), 0
    while at < len(piece):
        code = piece[at]
        group = piece[at + 1:at + code]
        if len(group) != code - 1:
            return None
        at += code
        body += group
        if code < 255 and at < len(piece):
            body.append(0)
    return bytes(body)


def encode(kind: int, sequence: int, payload: bytes) -> bytes:
    body = struct.pack("<BBI", VERSION, kind, sequence) + payload
    return stuff(body + struct.pack("<I", zlib.crc32(body)))


@dataclass(frozen=True)
class Frame:
    version: int
    kind: int
    sequence: int
    payload: bytes


def decode(piece: bytes) -> Frame | None:
    body = unstuff(piece)
    if body is None or len(body) < 10 or struct.unpack("<I", body[-4:])[0] != zlib.crc32(body[:-4]):
        return None
    return Frame(*struct.unpack("<BBI", body[:6]), body[6:-4])


def start(nonce: int, every_us: int = 0, max_bound_rad: float = 0.0523598775, sign_hint: int = 0) -> bytes:
    return struct.pack("<IQfB", nonce, every_us, max_bound_rad, sign_hint)


def sample(t_us: int, values) -> bytes:
    return struct.pack("<Q12f", t_us, *values)


def estimate(payload: bytes) -> dict:
    v = struct.unpack("<BIQ8B20fQI7I", payload)
    return {"events": v[0], "token": v[1], "now_us": v[2], "status": v[3], "weak": v[5], "hint": v[6], "reason": v[7],
            "has_axes": bool(v[8] & 1), "model": v[9], "ready_for": v[10], "axis1": v[11:14], "axis2": v[14:17],
            "uncertainty_rad": v[17:19], "flexion_uncertainty_rad": v[23], "heading_rad": v[24], "joint_to_sensor1_m": v[25:28],
            "joint_to_sensor2_m": v[28:31], "t_us": v[31], "samples": v[32], "rejected_by": dict(zip(REJECTS, v[33:40]))}


def counters(payload: bytes) -> dict:
    v = struct.unpack("<11I7I", payload)
    return {"token": v[0], **dict(zip(COUNTER_NAMES, v[1:11])), "rejected_by": dict(zip(REJECTS, v[11:]))}


class Expected:
    """What a receiver must have counted, from the bytes that were really sent; slow and plain on purpose.

    `sent` maps each correct piece to its sequence number: whatever else stands between zeros is no frame."""

    def __init__(self, start_sequence: int):
        self.counts = dict.fromkeys(COUNTER_NAMES[:7], 0)
        self.counts["received"] = self.counts["taken"] = 1
        self.highest = start_sequence
        self.missing: set[int] = set()

    def piece(self, sequence: int | None):
        """Takes note of a piece; None for one that is no frame. Returns True if the frame is used."""
        if sequence is None:
            self.counts["corrupted"] += 1
            return False
        self.counts["received"] += 1
        if sequence > self.highest:
            self.missing.update(range(self.highest + 1, sequence))
            self.counts["lost"] += sequence - self.highest - 1
            self.highest = sequence
            self.counts["taken"] += 1
            return True
        if self.highest - sequence >= HISTORY:
            self.counts["stale"] += 1
        elif sequence in self.missing:
            self.missing.remove(sequence)
            self.counts["lost"] -= 1
            self.counts["reordered"] += 1
        else:
            self.counts["repeated"] += 1
        return False
