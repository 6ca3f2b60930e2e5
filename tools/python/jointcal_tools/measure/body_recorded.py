"""Recordings of a person's leg as packets to the hub on the PC, beside what the program says of the same file."""

from __future__ import annotations

import csv
import json
import os
import re
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np

from .harness import Report, number
from .judge import line_angle_deg

ROOT = Path(__file__).resolve().parents[4]
NAMES = ("human_leg_left", "walk_leg_L")
BAD_WIRE = ("--loss", "5", "--burst", "0.5")
STREAM = ("--joint", "hip:ball:1:2", "--joint", "knee:hinge:2:3", "--speed", "max", "--every", "10", "--clock-ppm", "40,-60,100", "--delay-ms", "3,30,60", "--per-packet", "1")
KNOWN = "The hip of walk_leg_L: its lag is known 19 s after the start, of 25 s, and what is left is too short; alone, without a lag to find, it takes 15 s"
UNDER_WAY = 10  # packets of 10 ms
AXES_MOST_DEG = 10.0  # the sum of two bounds of a person's knee is about 20


def lines_of(command: list[str]) -> list[dict]:
    done = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)
    if done.returncode not in (0, 3):
        raise RuntimeError(f"{command[0]}: {done.stderr}")
    return [json.loads(line) for line in done.stdout.splitlines()]


def program(path: Path, kind: str) -> tuple[str, float, list[np.ndarray]]:
    """Status and reason at the end, first ready, axes if it is ready."""
    lines = lines_of([str(ROOT / "build/host/jointcal"), kind, str(path), "--json"])
    return said(lines[-1], lines, None)


def said(end: dict, lines: list[dict], joint: str | None) -> tuple[str, float, list[np.ndarray]]:
    first_s = min((line["t_s"] for line in lines if line["event"] == "ready" and line.get("joint") == joint), default=np.inf)
    axes = [np.array(end[name]) for name in ("axis1", "axis2") if end["status"] == "ready" and end.get(name)]
    return end["status"] + (f" ({end['reason']})" if end["reason"] else ""), first_s, axes


def hub(path: Path, wire: tuple[str, ...], folder: Path) -> tuple[dict, list[dict]]:
    socket = folder / "hub"
    socket.unlink(missing_ok=True)
    with subprocess.Popen([str(ROOT / "build/host/jointcal_hub"), f"unix:{socket}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as server:
        try:
            until = time.monotonic() + 10.0
            while not socket.exists() and time.monotonic() < until:
                time.sleep(0.02)
            lines = lines_of([str(ROOT / "build/host/jointcal"), "stream", str(path), "--to", f"unix:{socket}", *STREAM, *wire])
        finally:
            server.kill()
    return lines[-1], lines


def knee_of(path: Path, folder: Path) -> Path:
    """The same file with sensors 2 and 3 as 1 and 2."""
    with path.open(newline="") as file:
        rows = list(csv.reader(file))
    head = [re.sub(r"^(gyr|acc)([123])", lambda m: m[1] + {"1": "9", "2": "1", "3": "2"}[m[2]], name) for name in rows[0]]
    keep = [k for k, name in enumerate(head) if re.fullmatch(r"t_s|(gyr|acc)[12]_[xyz]", name)]
    out = folder / f"{path.stem}_knee.csv"
    with out.open("w", newline="") as file:
        csv.writer(file).writerows([[row[k] for k in keep] for row in [head, *rows[1:]]])
    return out


def axes_apart_deg(one: list[np.ndarray], other: list[np.ndarray]) -> float:
    return max((float(line_angle_deg(a[None], b)[0]) for a, b in zip(one, other, strict=False)), default=np.nan)


def is_counted(sensor: dict, played: dict) -> bool:
    """Every packet of one reading came or is lost, but for those that were under way at the end."""
    left = played["packets"] - sensor["readings"] - sensor["lost"]
    return 0 <= left <= UNDER_WAY and played["packets_lost"] - UNDER_WAY <= sensor["lost"] <= played["packets_lost"]


def describe(report: Report) -> None:
    data = Path(os.environ.get("JOINTCAL_DATA", ROOT / "data"))
    paths = [data / f"{name}.csv" for name in NAMES]
    if not all(path.exists() for path in paths):
        report.text("**Recordings of people.** Skipped: they are not there; JOINTCAL_DATA names their folder.")
        return
    rows, worst, counted, wrong, same = [], [], 0, 0, 0
    for path in paths:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            alone = {"hip": program(path, "ball"), "knee": program(knee_of(path, folder), "hinge")}
            for wire, word in (((), "nothing lost"), (BAD_WIRE, "5 % lost, and bursts of 0.5 s")):
                end, lines = hub(path, wire, folder)
                for joint in end["joints"]:
                    mine, beside = said(joint, lines, joint["joint"]), alone[joint["joint"]]
                    apart = axes_apart_deg(mine[2], beside[2])
                    worst += [apart] if np.isfinite(apart) else []
                    counted += 1
                    same += mine[0].startswith("ready") == beside[0].startswith("ready")
                    lag = joint["lag_s"]
                    rows.append([path.stem, word, joint["joint"], beside[0], number(beside[1], 1), mine[0], number(mine[1], 1), number(apart, 1), number(1e3 * lag, 0) if lag is not None else "not known"])
                played = {line["sensor"]: line["packets_lost"] for line in lines if line["event"] == "played"}
                played = {line["sensor"]: line for line in lines if line["event"] == "played"}
                wrong += sum(not is_counted(sensor, played[sensor["sensor"]]) for sensor in end["sensors"])
    report.text("**Recordings of people.** A leg with sensors on pelvis, thigh and shank, its hip a ball and its knee a hinge, played by `jointcal stream` to `jointcal_hub`: packets of one reading, clocks off by 40, -60 and 100 ppm, "
                "packets late by 3, 30 and 60 ms. Beside it what `jointcal ball` and `jointcal hinge` say of the same file. Lag: that of the joint, which is to be about 27 ms at the hip and 30 ms at the knee.")
    report.table(["recording", "wire", "joint", "program: at the end", "first ready, s", "hub: at the end", "first ready, s", "knee's axes apart, deg", "lag, ms"], rows)
    report.require_none("recordings of people: sensors whose packets are not all counted, but for 0.1 s at the end", wrong, 6 * len(paths))
    report.require("recordings of people: joints of which hub and program say the same", f"{same} of {counted}", same == counted, KNOWN if same >= counted - 2 else "")
    report.require_most("recordings of people: knee's axes of the hub beside those of the program, where both are ready, worst", max(worst, default=np.nan), AXES_MOST_DEG, " deg")
