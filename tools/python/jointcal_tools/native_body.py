"""A body of hinges of the C library over whole arrays of packets, through ctypes.

    found = run(joints, values, packets, units=65)
    found.rows[k, j], found.events, found.sensors[s]["missed"]
"""

from __future__ import annotations

import ctypes
from dataclasses import dataclass

import numpy as np

from .native import library
from .native_hub import PacketCounts, Packets, as_dict

SENSORS, COLUMNS, EVENT_COLUMNS, FLASH_BYTES = 16, 19, 5, 2 * 4096  # of tools/native/batch_body.h
EVENTS = ("ready", "left_ready", "moved", "not_one", "lag_found", "sensor_bad", "sensor_fine", "sensor_lost", "sensor_back",
          "remembered", "confirmed", "dropped", "kept", "exchanged")
EVENT_ROOM = 20000


class Input(ctypes.Structure):
    """jcal_batch_body_in_t."""

    _fields_ = [("sensor_count", ctypes.c_int32), ("joint_count", ctypes.c_int32), ("proximal", ctypes.c_void_p), ("distal", ctypes.c_void_p),
                ("si", ctypes.c_void_p * SENSORS), *((name, ctypes.c_void_p) for name in ("which", "arrival_us", "counter", "readings", "at")),
                ("count", ctypes.c_size_t), ("counter_bits", ctypes.c_int32), ("units", ctypes.c_int32), ("every", ctypes.c_int32),
                ("serials", ctypes.c_void_p), ("flash", ctypes.c_void_p), ("keeps", ctypes.c_int32), ("mark", ctypes.c_int32),
                ("sleeps", ctypes.c_int32)]


class Status(ctypes.Structure):
    """jcal_body_status_t."""

    _fields_ = [*((name, ctypes.c_uint32) for name in ("rounds", "restarts", "lags_refused", "events_dropped")),
                ("units", ctypes.c_uint64), ("t_us", ctypes.c_uint64)]


class SensorResult(ctypes.Structure):
    """jcal_body_sensor_result_t."""

    _fields_ = [("packets", PacketCounts), ("shift_s", ctypes.c_float),
                *((name, ctypes.c_uint32) for name in ("samples", "missed", "rejected", "late")),
                ("bad", ctypes.c_uint16), ("is_heard", ctypes.c_bool), ("orientation", ctypes.c_float * 4), ("t_us", ctypes.c_uint64)]


class Output(ctypes.Structure):
    """jcal_batch_body_out_t."""

    _fields_ = [("row_us", ctypes.c_void_p), ("rows", ctypes.c_void_p), ("time_us", ctypes.c_void_p), ("room", ctypes.c_size_t), ("row_count", ctypes.c_size_t),
                ("event_us", ctypes.c_void_p), ("events", ctypes.c_void_p), ("event_room", ctypes.c_size_t), ("event_count", ctypes.c_size_t),
                *((name, ctypes.c_uint32) for name in ("most_units", "full_steps", "steps", "state_bytes")), ("mark_units", ctypes.c_uint64),
                ("status", Status), ("sensors", SensorResult * SENSORS)]


@dataclass
class Found:
    row_us: np.ndarray  # (K,) hub times of rows
    time_us: np.ndarray  # (K,) hub times of the common time that results are of
    rows: np.ndarray  # (K, joints, COLUMNS) of batch_body.h
    event_us: np.ndarray
    events: np.ndarray  # (E, EVENT_COLUMNS): kind, joint, sensor, what, value
    status: dict
    sensors: list[dict]  # counters of each sensor, those of its packets among them
    most_units: int
    full_steps: int
    steps: int
    mark_units: int = 0  # until step `mark`


def run(joints: list[tuple[int, int]], values: list[np.ndarray], packets: Packets, counter_bits: int, units: int, every: int = 25,
        serials: list[int] | None = None, flash: np.ndarray | None = None, keeps: bool = False, mark: int = 0, sleeps: bool = False) -> Found:
    """`joints`: proximal and distal sensor; `values`: (N, 6) of each sensor; a row every `every` hundredths of a second.

    `flash`: FLASH_BYTES that outlast the run, with the `serials` of all sensors; `keeps`: at the end what is ready is written to it.
    `mark`: step at which units are noted, and from which on, if `sleeps`, whatever is ready is put to sleep.
    """
    given, out, keep = Input(), Output(), []

    def pointer(array: np.ndarray, kind: type) -> int:
        keep.append(np.ascontiguousarray(array, kind))
        return keep[-1].ctypes.data

    given.sensor_count, given.joint_count = len(values), len(joints)
    given.proximal, given.distal = (pointer(np.array(part), np.uint8) for part in zip(*joints, strict=True))
    for s, of in enumerate(values):
        given.si[s] = pointer(of, np.float32)
    for name, kind in (("which", np.uint8), ("arrival_us", np.uint64), ("counter", np.uint32), ("readings", np.uint8), ("at", np.uint32)):
        setattr(given, name, pointer(getattr(packets, name), kind))
    given.count, given.counter_bits, given.units, given.every = len(packets.which), counter_bits, units, every
    given.mark, given.sleeps = mark, int(sleeps)
    if serials is not None and flash is not None:
        given.serials, given.flash, given.keeps = pointer(np.array(serials), np.uint64), flash.ctypes.data, int(keeps)
    room = int((int(packets.arrival_us[-1]) - int(packets.arrival_us[0])) / (10000 * every)) + 300
    row_us, time_us, rows = np.zeros(room, np.uint64), np.zeros(room, np.uint64), np.zeros((room, len(joints), COLUMNS), np.float32)
    event_us, events = np.zeros(EVENT_ROOM, np.uint64), np.zeros((EVENT_ROOM, EVENT_COLUMNS), np.float32)
    out.row_us, out.time_us, out.rows, out.room = row_us.ctypes.data, time_us.ctypes.data, rows.ctypes.data, room
    out.event_us, out.events, out.event_room = event_us.ctypes.data, events.ctypes.data, EVENT_ROOM
    done = library().jcal_batch_body(ctypes.byref(given), ctypes.byref(out))
    if done != 0:
        raise RuntimeError(f"jcal_batch_body returned {done}")
    n, count = out.row_count, min(out.event_count, EVENT_ROOM)
    sensors = [as_dict(out.sensors[s].packets) | {name: getattr(out.sensors[s], name) for name in ("shift_s", "samples", "missed", "rejected", "bad")}
               | {"too_late": out.sensors[s].late}
               for s in range(len(values))]
    return Found(row_us[:n], time_us[:n], rows[:n].astype(float), event_us[:count], events[:count].astype(float), as_dict(out.status), sensors,
                 out.most_units, out.full_steps, out.steps, out.mark_units)
