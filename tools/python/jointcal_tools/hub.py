# SPDX-License-Identifier: MIT
"""Frames and messages of docs/PROTOCOL.md, written from that text and not from the C code, so that each checks the other.

    wire = encode(BEGIN, 0, pack(BEGIN, nonce=7, every_us=0, angles_every_us=0, sensors=3, joints=2, flags=7))
    unpack(frame.kind, frame.payload)["status"]

hub_vectors.py prints the test vectors at the end of that text.
"""
from __future__ import annotations

import re
import struct
import zlib
from dataclasses import dataclass

VERSION = 3
START, SAMPLE, REQUEST = 0x01, 0x02, 0x03
BEGIN, SENSOR, JOINT, PACKET, TIME = 0x04, 0x05, 0x06, 0x07, 0x08
PUT_KEPT, GET_KEPT, FORGET, SLEEP = 0x09, 0x0A, 0x0B, 0x0C
HELLO, ESTIMATE, COUNTERS, CREDIT = 0x81, 0x82, 0x83, 0x84
TABLE, EVENT, JOINT_STATE, SENSOR_STATE, BODY_STATE = 0x85, 0x86, 0x87, 0x88, 0x89
FLEXIONS, ORIENTATIONS, ADVICE, KEPT, VERSION_TOLD = 0x8A, 0x8B, 0x8C, 0x8D, 0x8E
PAYLOAD_MAX = 206
UNKNOWN_US = 2**64 - 1
READINGS_MAX, ADVICE_MAX, RECORD_BYTES = 16, 200, 128
LOOK_FOR_LAGS, EXAMINE_SENSORS, USE_KEPT = 1, 2, 4
HINGE, BALL, TWO_AXES = 0, 1, 2
NO_NUMBER = 255
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


# A field is its type and its name; `f32*3` is an array, `text16` ASCII with zeros behind it, `bytes128` bytes as they are.
MESSAGES = {
    START: "u32 nonce, u64 every_us, f32 max_bound_rad, u8 sign_hint",
    SAMPLE: "u64 t_us, f32*12 values",
    REQUEST: "u32 token",
    BEGIN: "u32 nonce, u64 every_us, u64 angles_every_us, u8 sensors, u8 joints, u8 flags",
    SENSOR: "u8 number, u64 serial, u32 period_ns, u8 counter_bits, u8 per_packet, f32 gyr_rad_s, f32 acc_m_s2, "
            "i16 gyr_rail, i16 acc_rail, f32 max_drift_ppm, text16 name",
    JOINT: "u8 number, u8 kind, u8 proximal, u8 distal, f32 max_bound_rad, text16 name",
    PACKET: "u8 sensor, u64 arrival_us, u32 counter",
    TIME: "u64 now_us",
    PUT_KEPT: "u32 token, bytes128 record",
    GET_KEPT: "u32 token, u8 joint",
    FORGET: "u32 token, u8 joint",
    SLEEP: "u8 joint, u8 asleep",
    HELLO: "u32 nonce, u8 refused, u8 credit, u8*3 version",
    ESTIMATE: "u8 events, u32 token, u64 now_us, u8 status, u8 engine, u8 weak, u8 hint, u8 reason, u8 flags, u8 model, "
              "u8 ready_for, f32*3 axis1, f32*3 axis2, f32*2 uncertainty_rad, f32 sign_margin, f32*3 progress, "
              "f32 flexion_uncertainty_rad, f32 heading_rad, f32*3 joint_to_sensor1_m, f32*3 joint_to_sensor2_m, u64 t_us, "
              "u32 samples, u32*7 rejected",
    COUNTERS: "u32 token, u32*10 counts, u32*7 rejected",
    CREDIT: "u32 limit",
    TABLE: "u8 refused, u8 at, text24 what",
    EVENT: "u64 t_us, u8 kind, u8 joint, u8 sensor, u8 what, f32 value",
    JOINT_STATE: "u32 token, u8 joint, u8 status, u8 weak, u8 hint, u8 reason, u8 flags, u8 kept, u8 kept_reason, f32 lag_s, "
                 "f32 lag_bound_s, f32*3 axis1, f32*3 axis2, f32*2 uncertainty_rad, f32*3 joint_to_sensor1_m, "
                 "f32*3 joint_to_sensor2_m, f32 heading_rad, f32 flexion_bound_rad, f32 relative_bound_rad, u32 samples",
    SENSOR_STATE: "u32 token, u8 sensor, u8 heard, u16 bad, u32 readings, u32 lost, u32 late, u32 duplicate, u32 odd, u32 restarts, "
                  "u32 steps, u32 overruns, f32 period_s, f32 drift_ppm, f32 shift_s, u32 samples, u32 missed, u32 rejected, "
                  "u32 late_readings",
    BODY_STATE: "u32 token, u64 t_us, u32 rounds, u32 restarts, u32 lags_refused, u32 events_dropped, u64 units, u32 writes",
    FLEXIONS: "u64 t_us",
    ORIENTATIONS: "u64 t_us",
    ADVICE: "u8 joint, u8 sensor, u8 hint, u8 reason",
    KEPT: "u32 token, u8 joint, u8 refusal, bytes128 record",
    VERSION_TOLD: "u8 refused",
}
# What repeats behind those fields: the list's name, how often at least and at most, and one of it.
REPEATED = {
    PACKET: ("readings", 1, READINGS_MAX, "<6h"),
    FLEXIONS: ("flexions", 0, 22, "<Bff"),
    ORIENTATIONS: ("orientations", 1, 9, "<B5f"),
}
CODES = {"u8": "B", "u16": "H", "u32": "I", "u64": "Q", "i16": "h", "f32": "f"}


def fields(kind: int) -> list[tuple[str, int, str]]:
    """Code for struct, how many (0: text), and name of each field of a message."""
    found = []
    for field in MESSAGES[kind].split(", "):
        kept, name = field.split()
        if match := re.fullmatch(r"(text|bytes)(\d+)", kept):
            found.append((match[2] + "s", 0 if match[1] == "text" else 1, name))
        else:
            code, _, count = kept.partition("*")
            found.append((count + CODES[code], int(count or "1"), name))
    return found


def fixed(kind: int) -> str:
    """Format of the fields that a message always has."""
    return "<" + "".join(code for code, _, _ in fields(kind))


def pack(kind: int, /, **values) -> bytes:
    """The payload of a message. Names are those of MESSAGES, and of REPEATED; the sentence of ADVICE is `text`."""
    flat = []
    for _, count, name in fields(kind):
        value = values.pop(name)
        if count == 0:
            flat.append(value.encode("ascii"))
        elif count == 1:
            flat.append(value)
        else:
            if len(value) != count:
                raise ValueError(f"{name} has {count} values")
            flat += value
    payload = struct.pack(fixed(kind), *flat)
    if kind in REPEATED:
        name, least, most, one = REPEATED[kind]
        rows = values.pop(name)
        if not least <= len(rows) <= most:
            raise ValueError(f"{least} to {most} {name}")
        payload += b"".join(struct.pack(one, *row) for row in rows)
    elif kind == ADVICE:
        text = values.pop("text").encode("ascii")
        if len(text) > ADVICE_MAX:
            raise ValueError("the text is too long")
        payload += text
    if values:
        raise ValueError(f"no such field: {', '.join(values)}")
    return payload


def unpack(kind: int, payload: bytes) -> dict | None:
    """The fields of a message by name; None if it is none: an unknown type, or a length that no such message has."""
    if kind not in MESSAGES:
        return None
    size = struct.calcsize(fixed(kind))
    rest = payload[size:]
    if len(payload) < size or (rest and kind not in REPEATED and kind != ADVICE):
        return None
    flat, found = iter(struct.unpack(fixed(kind), payload[:size])), {}
    for _, count, name in fields(kind):
        value = tuple(next(flat) for _ in range(count)) if count > 1 else next(flat)
        found[name] = value.rstrip(b"\0").decode("ascii", "replace") if count == 0 else value
    if kind in REPEATED:
        name, least, most, one = REPEATED[kind]
        count, left = divmod(len(rest), struct.calcsize(one))
        if left or not least <= count <= most:
            return None
        found[name] = list(struct.iter_unpack(one, rest))
    elif kind == ADVICE:
        if len(rest) > ADVICE_MAX:
            return None
        found["text"] = rest.decode("ascii", "replace")
    return found


def start(nonce: int, every_us: int = 0, max_bound_rad: float = 0.0523598775, sign_hint: int = 0) -> bytes:
    return pack(START, nonce=nonce, every_us=every_us, max_bound_rad=max_bound_rad, sign_hint=sign_hint)


def sample(t_us: int, values) -> bytes:
    return pack(SAMPLE, t_us=t_us, values=values)


def estimate(payload: bytes) -> dict:
    found = unpack(ESTIMATE, payload)
    return {**found, "has_axes": bool(found["flags"] & 1), "rejected_by": dict(zip(REJECTS, found["rejected"]))}


def counters(payload: bytes) -> dict:
    found = unpack(COUNTERS, payload)
    return {"token": found["token"], **dict(zip(COUNTER_NAMES, found["counts"])), "rejected_by": dict(zip(REJECTS, found["rejected"]))}


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
