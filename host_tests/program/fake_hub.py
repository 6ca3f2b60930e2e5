# SPDX-License-Identifier: MIT
"""A hub for tests of its senders: it speaks docs/PROTOCOL.md by the second implementation, remembers what came, and answers what it is told to."""
import contextlib
import socket
import struct
import threading
import zlib

from jointcal_tools import hub

CREDIT = 8
READY = 2
UNKNOWN = 1.5707963705062866  # a right angle, as float32
NONE = (0.0, 0.0, 0.0)


def joint_state(joint, token, **changes):
    """Of a joint of which nothing is known."""
    return {"token": token, "joint": joint, "status": 0, "weak": 1, "hint": 1, "reason": 1, "flags": 0, "kept": 0, "kept_reason": 0, "lag_s": 0.0,
            "lag_bound_s": 1.0, "axis1": NONE, "axis2": NONE, "uncertainty_rad": (UNKNOWN, UNKNOWN), "joint_to_sensor1_m": NONE,
            "joint_to_sensor2_m": NONE, "heading_rad": 0.0, "flexion_bound_rad": UNKNOWN, "relative_bound_rad": UNKNOWN, "samples": 0, **changes}


def sensor_state(sensor, token, **changes):
    counts = dict.fromkeys(("readings", "lost", "late", "duplicate", "odd", "restarts", "steps", "overruns", "samples", "missed", "rejected",
                            "late_readings"), 0)
    return {"token": token, "sensor": sensor, "heard": 1, "bad": 0, "period_s": 0.01, "drift_ppm": 0.0, "shift_s": 0.0, **counts, **changes}


class FakeHub:
    """One session. `status` is what its joints are at the end; `after` maps the number of a packet to frames (type, fields) that follow it."""

    def __init__(self, path, status=READY, after=None, refuse=None, drop=()):
        self.status, self.after, self.refuse, self.drop = status, after or {}, refuse, drop
        self.begin, self.sensors, self.joints, self.packets, self.other = None, {}, {}, [], []
        self.sequence, self.arrival_us = 0, 0
        self.server = socket.socket(socket.AF_UNIX)
        self.server.bind(str(path))
        self.server.listen(1)
        self.thread = threading.Thread(target=self.serve, daemon=True)
        self.thread.start()

    def close(self):
        self.thread.join(10)
        self.server.close()

    def serve(self):
        """Until the sender goes, which may be at any moment."""
        self.connection, _ = self.server.accept()
        rest = b""
        with self.connection, contextlib.suppress(ConnectionError):
            while data := self.connection.recv(4096):
                *pieces, rest = (rest + data).split(b"\0")
                for piece in filter(None, pieces):
                    self.take(hub.decode(piece))

    def send(self, kind, /, **fields):
        if (kind, self.sequence) not in self.drop:
            self.connection.sendall(hub.encode(kind, self.sequence, hub.pack(kind, **fields)))
        self.sequence += 1

    def take(self, frame):
        fields = hub.unpack(frame.kind, frame.payload)
        if frame.kind == hub.BEGIN:
            self.begin, self.sequence = fields, 0
            self.send(hub.HELLO, nonce=fields["nonce"], refused=0, credit=CREDIT, version=(0, 3, 0))
        elif frame.kind == hub.REQUEST:
            self.answer(fields["token"])
            return
        elif frame.kind in (hub.SENSOR, hub.JOINT):
            (self.sensors if frame.kind == hub.SENSOR else self.joints)[fields["number"]] = fields
            if len(self.sensors) == self.begin["sensors"] and len(self.joints) == self.begin["joints"]:
                at, what = self.refuse or (hub.NO_NUMBER, "")
                self.send(hub.TABLE, refused=int(self.refuse is not None), at=at, what=what)
        elif frame.kind == hub.PACKET:
            for kind, told in self.after.get(len(self.packets), []):
                self.send(kind, **told)
            self.packets.append(fields)
            self.arrival_us = max(self.arrival_us, fields["arrival_us"])
        else:
            self.other.append((frame.kind, fields))
            self.kept(frame.kind, fields)
        self.send(hub.CREDIT, limit=frame.sequence + 1 + CREDIT)

    def kept(self, kind, fields):
        """Keeps whatever it is told; of joint 1 it has nothing."""
        if kind == hub.PUT_KEPT:
            self.send(hub.KEPT, token=fields["token"], joint=0, refusal=7, record=fields["record"])
        elif kind == hub.GET_KEPT:
            found = fields["joint"] == 0
            self.send(hub.KEPT, token=fields["token"], joint=fields["joint"], refusal=0 if found else 1,
                      record=bytes(range(128)) if found else bytes(128))

    def answer(self, token):
        self.send(hub.BODY_STATE, token=token, t_us=self.arrival_us, rounds=5, restarts=0, lags_refused=0, events_dropped=0, units=1, writes=0)
        for k in self.sensors:
            self.send(hub.SENSOR_STATE, **sensor_state(k, token))
        for k in self.joints:
            self.send(hub.JOINT_STATE, **joint_state(k, token, status=self.status))
        self.send(hub.ADVICE, joint=255, sensor=255, hint=0, reason=0, text="")
        self.send(hub.COUNTERS, token=token, counts=(0,) * 9 + (len(self.packets),), rejected=(0,) * 7)


class OldHub:
    """A hub of another version: it answers the first frame that comes with `version`, in a frame of its own."""

    def __init__(self, path, version):
        self.server = socket.socket(socket.AF_UNIX)
        self.server.bind(str(path))
        self.server.listen(1)
        self.thread = threading.Thread(target=self.serve, args=(version,), daemon=True)
        self.thread.start()

    def close(self):
        self.thread.join(10)
        self.server.close()

    def serve(self, version):
        connection, _ = self.server.accept()
        with connection, contextlib.suppress(ConnectionError):
            connection.recv(4096)
            body = struct.pack("<BBIB", version, hub.VERSION_TOLD, 0, hub.VERSION)
            connection.sendall(hub.stuff(body + struct.pack("<I", zlib.crc32(body))))
            while connection.recv(4096):
                pass
