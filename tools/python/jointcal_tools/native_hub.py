"""A hub of the C library over whole arrays of packets, through ctypes: packets, pairing, lag and a hinge of either kind.

    found = run((Sender(...), Sender(...)), packets)
    found.counts[0]["lost"], found.times_s[0], found.status
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass

import numpy as np

from .native import library

COLUMNS = 16
READY = 2  # JCAL_READY


class SenderIn(ctypes.Structure):
    """jcal_batch_sender_t of tools/native/batch_hub.h."""

    _fields_ = [("period_ns", ctypes.c_uint32), ("counter_bits", ctypes.c_int32), ("per_packet", ctypes.c_int32), ("is_raw", ctypes.c_int32),
                ("max_delay_s", ctypes.c_float), ("si", ctypes.c_void_p), ("raw", ctypes.c_void_p)]


class Input(ctypes.Structure):
    """jcal_batch_hub_in_t."""

    _fields_ = [("sender", SenderIn * 2), *((name, ctypes.c_void_p) for name in ("which", "arrival_us", "counter", "readings", "at")),
                ("count", ctypes.c_size_t)]


class Readings(ctypes.Structure):
    """jcal_batch_hub_readings_t."""

    _fields_ = [("t_us", ctypes.c_void_p), ("values", ctypes.c_void_p), ("room", ctypes.c_size_t), ("count", ctypes.c_size_t)]


class PacketCounts(ctypes.Structure):
    """jcal_packets_status_t."""

    _fields_ = [*((name, ctypes.c_uint32) for name in ("readings", "lost", "late", "duplicate", "odd", "restarts", "steps", "overruns", "waiting")),
                *((name, ctypes.c_float) for name in ("period_s", "drift_ppm", "bound_ppm", "jitter_s"))]


class PairCounts(ctypes.Structure):
    """jcal_pairing_result_t."""

    _fields_ = [("shift_s", ctypes.c_float), *((name, ctypes.c_uint32) for name in ("pairs", "lost1", "lost2", "rejected")),
                ("waiting", ctypes.c_uint), ("ahead", ctypes.c_uint)]


class Output(ctypes.Structure):
    """jcal_batch_hub_out_t."""

    _fields_ = [("readings", Readings * 2), ("pair_us", ctypes.c_void_p), ("rows", ctypes.c_void_p), ("room", ctypes.c_size_t),
                ("pair_count", ctypes.c_size_t), ("taken", ctypes.c_uint32), ("packets", PacketCounts * 2), ("pairing", PairCounts)]


@dataclass
class Sender:
    period_ns: int
    counter_bits: int
    per_packet: int
    max_delay_s: float
    values: np.ndarray  # (N, 6), rad/s and m/s^2 as float32, or raw as int16


@dataclass
class Packets:
    """In the order of arrival."""

    which: np.ndarray  # (M,) 0 or 1
    arrival_us: np.ndarray
    counter: np.ndarray
    readings: np.ndarray
    at: np.ndarray  # row of the first reading


@dataclass
class Found:
    times_us: tuple[np.ndarray, np.ndarray]  # of the readings that came out
    values: tuple[np.ndarray, np.ndarray]  # (n, 6)
    counts: tuple[dict, dict]
    pairing: dict
    taken: int  # times that a lag was taken off
    pair_us: np.ndarray
    rows: np.ndarray  # (P, COLUMNS) of batch_hub.h


def as_dict(counts: ctypes.Structure) -> dict:
    return {name: getattr(counts, name) for name, _ in counts._fields_}


def run(senders: tuple[Sender, Sender], packets: Packets, room: int) -> Found:
    """`room`: most pairs."""
    given, out, keep = Input(), Output(), []

    def pointer(values: np.ndarray, kind: type) -> int:
        keep.append(np.ascontiguousarray(values, kind))
        return keep[-1].ctypes.data

    times, values = [], []
    for k, sender in enumerate(senders):
        is_raw = sender.values.dtype == np.int16
        data = pointer(sender.values, np.int16 if is_raw else np.float32)
        given.sender[k] = SenderIn(sender.period_ns, sender.counter_bits, sender.per_packet, is_raw, sender.max_delay_s,
                                   None if is_raw else data, data if is_raw else None)
        times.append(np.zeros(len(sender.values), np.uint64))
        values.append(np.zeros((len(sender.values), 6), np.float32))
        out.readings[k] = Readings(times[k].ctypes.data, values[k].ctypes.data, len(sender.values), 0)
    for name, kind in (("which", np.uint8), ("arrival_us", np.uint64), ("counter", np.uint32), ("readings", np.uint8), ("at", np.uint32)):
        setattr(given, name, pointer(getattr(packets, name), kind))
    given.count = len(packets.which)
    pair_us, rows = np.zeros(room, np.uint64), np.zeros((room, COLUMNS), np.float32)
    out.pair_us, out.rows, out.room = pair_us.ctypes.data, rows.ctypes.data, room
    done = library().jcal_batch_hub(ctypes.byref(given), ctypes.byref(out))
    if done != 0:
        raise RuntimeError(f"jcal_batch_hub returned {done}")
    n = [min(out.readings[k].count, len(times[k])) for k in range(2)]
    return Found(tuple(times[k][:n[k]] for k in range(2)), tuple(values[k][:n[k]] for k in range(2)), tuple(as_dict(out.packets[k]) for k in range(2)),
                 as_dict(out.pairing), out.taken, pair_us[:out.pair_count], rows[:out.pair_count].astype(float))
