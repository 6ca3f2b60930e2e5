#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Stream a simulated hour to a hub over a bad wire and check what it counts and finds.

    python3 tools/maintain/hub_soak.py                         one hour at 100 Hz; writes its section of docs/measurements/hub.md
    python3 tools/maintain/hub_soak.py --board mps2_an386      the same to the firmware in QEMU (build of preset m4f); takes half an hour
    python3 tools/maintain/hub_soak.py --minutes 1             as CI does, with and without --board; writes build/measurements/hub.md
    python3 tools/maintain/hub_soak.py --minutes 1 --to unix:PATH    a hub that runs already

1 % of the sample frames are lost, 0.1 % damaged (one to three bits of any byte, the final zero included), 0.1 %
repeated, 0.1 % swapped with the next one. Sent as fast as the hub gives credit. Expected counters are computed from the bytes
that were really sent. Exit status 1 if a requirement fails. Needs numpy and the build of preset host.
"""

import argparse
import contextlib
import math
import random
import re
import select
import socket
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

import numpy as np  # noqa: E402

from jointcal_tools import hub  # noqa: E402
from jointcal_tools.simulate import HingeSpec, simulate_hinge  # noqa: E402

RATE_HZ = 100
FAULTS = {"lost": 0.01, "damaged": 0.001, "repeated": 0.001, "swapped": 0.001}
ORIGIN_US = 1 << 40
SILENCE_S = 10.0
BOARDS = {"mps2_an386": "mps2-an386", "stm32f405": "netduinoplus2"}
TITLE = "# Hub over a bad wire\n"


class Link:
    """The sender's end: splits what comes into frames, follows the credit."""

    def __init__(self, path: str):
        self.socket = socket.socket(socket.AF_UNIX)
        self.socket.connect(path)
        self.socket.setblocking(False)
        self.rest = b""
        self.limit = 0
        self.credit = 0
        self.frames = 0
        self.longest_wait_s = 0.0
        self.answers: dict[int, list[bytes]] = {}

    def read(self, wait_s: float) -> None:
        if not select.select([self.socket], [], [], wait_s)[0]:
            return
        data = self.socket.recv(65536)
        if not data:
            raise RuntimeError("the hub has closed the connection")
        *pieces, self.rest = (self.rest + data).split(b"\0")
        for piece in pieces:
            frame = hub.decode(piece) if piece else None
            if frame is None:
                raise RuntimeError("a damaged frame from the hub, where no damage is made")
            self.frames += 1
            if frame.kind == hub.CREDIT:
                self.limit = struct.unpack("<I", frame.payload)[0]
            else:
                self.answers.setdefault(frame.kind, []).append(frame.payload)

    def wait(self, condition) -> None:
        """Until the condition holds; a hub that says nothing for long has stalled."""
        began = time.monotonic()
        while not condition():
            self.read(1.0)
            if time.monotonic() - began > SILENCE_S:
                raise RuntimeError("the hub has stalled")
        self.longest_wait_s = max(self.longest_wait_s, time.monotonic() - began)

    def send(self, data: bytes) -> None:
        while data:
            try:
                data = data[self.socket.send(data):]
            except BlockingIOError:
                select.select([self.socket], [self.socket], [], SILENCE_S)
                self.read(0)

    def last(self, kind: int) -> bytes:
        return self.answers[kind][-1]


class BadWire:
    """Frames in, bytes out, with faults; remembers what the receiver must have counted."""

    def __init__(self, seed: int):
        self.random = random.Random(seed)
        self.injected = dict.fromkeys(FAULTS, 0)
        self.expected = hub.Expected(0)
        self.numbers: dict[bytes, int] = {}
        self.rest = b""
        self.held = b""
        self.used = 0

    def fault(self) -> str | None:
        value = self.random.random()
        for name, share in FAULTS.items():
            if value < share:
                self.injected[name] += 1
                return name
            value -= share
        return None

    def damage(self, wire: bytes) -> bytes:
        body = bytearray(wire)
        for bit in self.random.sample(range(8 * len(body)), self.random.randint(1, 3)):
            body[bit // 8] ^= 1 << (bit % 8)
        return bytes(body)

    def carry(self, sequence: int, wire: bytes) -> bytes:
        """What goes out when this frame comes in."""
        self.numbers[wire[:-1]] = sequence
        if self.held:
            out, self.held = wire + self.held, b""
            return self.seen(out)
        fault = self.fault()
        if fault == "lost":
            return b""
        if fault == "swapped":
            self.held = wire
            return b""
        return self.seen({None: wire, "repeated": wire + wire, "damaged": self.damage(wire)}[fault])

    def seen(self, out: bytes) -> bytes:
        *pieces, self.rest = (self.rest + out).split(b"\0")
        for piece in pieces:
            if piece:
                self.used += self.expected.piece(self.numbers.get(piece))
        return out

    def end(self, request: bytes, sequence: int) -> bytes:
        """The request goes out unharmed; whatever a hit zero has left behind is ended before it."""
        out = self.held + b"\0" + request
        self.numbers[request[:-1]] = sequence
        return self.seen(out)


def angle_deg(first, second) -> float:
    """Between two lines."""
    sine = float(np.linalg.norm(np.cross(first, second)))
    return math.degrees(math.atan2(sine, abs(float(np.dot(first, second)))))


def stream(link: Link, wire: BadWire, rec) -> None:
    nonce = random.SystemRandom().getrandbits(32)
    link.send(b"\0" + hub.encode(hub.START, 0, hub.start(nonce, every_us=60_000_000)))
    link.wait(lambda: hub.HELLO in link.answers)
    told, refused, credit = struct.unpack("<IBB", link.last(hub.HELLO)[:6])
    if told != nonce or refused:
        raise RuntimeError("the hub did not start")
    link.limit, link.credit = 1 + credit, credit
    values = np.hstack([rec.gyr1, rec.acc1, rec.gyr2, rec.acc2])
    times = ORIGIN_US + np.round(rec.t_s * 1e6).astype(np.int64)
    for k, (t_us, row) in enumerate(zip(times.tolist(), values.tolist())):
        sequence = k + 1
        if sequence >= link.limit:
            link.wait(lambda number=sequence: number < link.limit)
        link.send(wire.carry(sequence, hub.encode(hub.SAMPLE, sequence, hub.sample(t_us, row))))
    sequence = len(values) + 1
    link.answers.clear()
    link.send(wire.end(hub.encode(hub.REQUEST, sequence, struct.pack("<I", 4711)), sequence))

    def answered() -> bool:
        return any(hub.counters(payload)["token"] == 4711 for payload in link.answers.get(hub.COUNTERS, []))

    link.wait(answered)


def judge(link: Link, wire: BadWire, rec, wall_s: float, where: tuple[str, str]) -> tuple[str, bool]:
    counted = hub.counters(link.last(hub.COUNTERS))
    found = hub.estimate(link.last(hub.ESTIMATE))
    expected = {**wire.expected.counts, "unknown": 0, "overrun": 0, "samples": wire.used - 1}
    errors = [angle_deg(found["axis1"], rec.axis1), angle_deg(found["axis2"], rec.axis2)]
    bounds = [math.degrees(bound) for bound in found["uncertainty_rad"]]
    pairing = np.dot(found["axis1"], rec.axis1) * np.dot(found["axis2"], rec.axis2) > 0
    requirements = {
        "no stall: every sample was taken in with the credit of the protocol, and the last request was answered": True,
        "every counter equals what follows from the bytes sent": all(counted[name] == expected[name]
                                                                    for name in hub.COUNTER_NAMES),
        "`ready` at the end": found["status"] == 2,
        "right pairing, both axes within 3 deg of the truth and inside their bounds":
            bool(pairing) and all(error < min(3.0, bound) for error, bound in zip(errors, bounds)),
    }
    rows = "\n".join(f"| {name} | {expected[name]} | {counted[name]} |" for name in hub.COUNTER_NAMES)
    rejected = ", ".join(f"{name} {number}" for name, number in counted["rejected_by"].items() if number) or "none"
    passed = "\n".join(f"- {'PASS' if ok else 'FAIL'}: {name}" for name, ok in requirements.items())
    made = ", ".join(f"{number} {name}" for name, number in wire.injected.items())
    text = f"""## {where[0]}

Written by `{f"python3 tools/maintain/hub_soak.py {where[1]}".strip()}`.

{len(rec.t_s)} samples ({rec.t_s[-1] / 60:.0f} minutes of simulated daily motion at {RATE_HZ} Hz, gyroscope biases 0.3 deg/s, accelerometer
biases 0.1 m/s^2), as fast as the hub gives credit ({link.credit} frames). Faults made in frames to the hub: {made}. A damage flips one
to three bits of a frame with its final zero, so that now and then it makes two pieces of one or one of two: the
expected counters are computed from the bytes that went out, by other code than the hub's (docs/PROTOCOL.md has the definitions).

| counter | expected | hub |
| --- | --- | --- |
{rows}

Rejected by the gate: {rejected}. Errors of the axes {errors[0]:.3f} and {errors[1]:.3f} deg, bounds {bounds[0]:.2f} and {bounds[1]:.2f} deg.
{wall_s:.0f} s ({rec.t_s[-1] / wall_s:.1f} times real time, sender included, which is Python); longest wait for credit or an
answer {1000 * link.longest_wait_s:.0f} ms.

{passed}
"""
    return text, all(requirements.values())


@contextlib.contextmanager
def hub_at(args):
    """Starts the hub that was asked for: yields the path of its socket, what it is called, and the command that names it."""
    with tempfile.TemporaryDirectory() as temporary:
        path, seed = str(Path(temporary) / "hub"), f" --seed {args.seed}" if args.seed != 1 else ""
        if args.to:
            yield args.to.removeprefix("unix:"), "Another hub", f"--to {args.to}{seed}"
            return
        if args.board:
            image = ROOT / "build" / "m4f" / f"hub_{args.board}.elf"
            command = ["qemu-system-arm", "-M", BOARDS[args.board], "-display", "none", "-monitor", "none", "-serial",
                       f"unix:{path},server=on,wait=off", "-kernel", str(image)]
            name, option = f"Firmware `hub_{args.board}` in QEMU ({BOARDS[args.board]})", f"--board {args.board}{seed}"
        else:
            command = [str(ROOT / "build" / "host" / "jointcal_hub"), f"unix:{path}"]
            name, option = "Hub core on the PC (jointcal_hub)", seed.strip()
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
        try:
            while not Path(path).exists() and process.poll() is None:
                time.sleep(0.02)
            yield path, name, option
        finally:
            process.kill()
            process.wait()


def with_section(page: str, section: str) -> str:
    """The page with this section in place of the one of the same heading."""
    sections = re.split(r"(?m)^(?=## )", page)[1:]
    heading = section.splitlines()[0]
    kept = {text.splitlines()[0]: text.rstrip() + "\n" for text in sections}
    return "\n".join([TITLE, *(kept | {heading: section}).values()])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--board", choices=BOARDS, help="the board whose firmware to run in QEMU")
    parser.add_argument("--to", metavar="unix:PATH", help="a hub that runs already")
    parser.add_argument("--out", type=Path)
    args = parser.parse_args()
    rec = simulate_hinge(HingeSpec(motions=(("daily", 60.0 * args.minutes),), rate_hz=RATE_HZ, seed=args.seed,
                                   gyr_bias_deg_s=0.3, acc_bias=0.1))
    folder = "docs" if args.minutes >= 60.0 and args.to is None else "build"
    out = args.out or ROOT / folder / "measurements" / "hub.md"
    with hub_at(args) as (path, name, option):
        link, wire = Link(path), BadWire(args.seed)
        began = time.monotonic()
        stream(link, wire, rec)
        text, ok = judge(link, wire, rec, time.monotonic() - began, (name, option))
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(with_section(out.read_text() if out.exists() else TITLE, text))
    print(text)
    print(f"written to {out}")
    return 0 if ok else 1


if __name__ == "__main__":
    sys.exit(main())
