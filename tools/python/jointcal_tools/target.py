# SPDX-License-Identifier: MIT
"""Builds port/cortex_m/replay.c for a target or the host and runs it over a recording: for tools/budget.py and
tools/same_bits.py. Needs gcc-arm-none-eabi, picolibc-arm-none-eabi and qemu-system-arm; standard library only."""
import csv
import ctypes
import math
import os
import random
import re
import struct
import subprocess
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
PORT = ROOT / "port/cortex_m"
WORK = ROOT / "build/target" / Path(sys.argv[0]).stem  # one per script, so that two may run at once
TWO_SENSORS, THREE_SENSORS = "12", "123"
# For programs only: the library is built by CMake, which alone knows its flags.
PROGRAM_FLAGS = ["-std=c99", "-Wall", "-Wextra", "-O2", "-DNDEBUG", "-ffunction-sections", "-fdata-sections"]
QEMU_SECONDS = 300
# Of port/cortex_m/replay_person.h: values of a packet, and what a raw rate and a raw force are worth (LSM6DSV, 2000 deg/s and 16 g).
PERSON_VALUES, PERSON_SCALES = 24, (math.radians(0.070), 0.488e-3 * 9.80665)


@dataclass(frozen=True)
class Platform:
    """A processor, and the emulated board that stands for it."""
    name: str
    cpu: tuple[str, ...]  # empty: the host
    machine: str = ""
    flash: int = 0
    ram: int = 0x20000000
    flash_bytes: int = 0x400000
    ram_bytes: int = 0x400000
    stack_bytes: int = 0x4000


def from_toolchain_file(name: str) -> Platform:
    values = dict(re.findall(r'set\(JOINTCAL_(\w+) "?([^")]*)"?\)', (PORT / f"{name}.cmake").read_text()))
    return Platform(name, tuple(values["CPU_FLAGS"].split()), values["QEMU_MACHINE"], int(values["FLASH"], 16),
                    int(values["RAM"], 16))


# The smallest one: the program with its buffers, the engine and its stack in 16 KiB of RAM.
MICROBIT = replace(from_toolchain_file("m0"), machine="microbit", flash_bytes=0x40000, ram_bytes=0x4000, stack_bytes=0x1000)
PLATFORMS = {"host": Platform("host", ()), "m4f": from_toolchain_file("m4f"), "m3": from_toolchain_file("m3"), "m0": MICROBIT}


def resampled(rows: list[list[float]], rate_hz: float, seconds: float) -> list[list[float]]:
    """The beginning of a recording, interpolated linearly at this rate. First column: time, s."""
    found, k = [], 0
    for n in range(int(rate_hz * min(seconds, rows[-1][0] - rows[0][0]))):
        t = rows[0][0] + n / rate_hz
        while rows[k + 1][0] < t:
            k += 1
        share = (t - rows[k][0]) / (rows[k + 1][0] - rows[k][0])
        found.append([t, *(x + share * (y - x) for x, y in zip(rows[k][1:], rows[k + 1][1:]))])
    return found


def rows_of(recording: Path, sensors: str = TWO_SENSORS) -> list[list[float]]:
    """Time and the six readings of each sensor, of every row."""
    columns = [f"{kind}{imu}_{axis}" for imu in sensors for kind in ("gyr", "acc") for axis in "xyz"]
    with open(recording, newline="", encoding="utf-8") as lines:
        return [[float(row["t_s"])] + [float(row[column]) if row[column] else float("nan") for column in columns]
                for row in csv.DictReader(line for line in lines if not line.startswith("#"))]


def samples_file(recording: Path, rate_hz: float | None = None, seconds: float = 60.0, sensors: str = TWO_SENSORS) -> Path:
    """The recording's samples as jcal_pair_t or jcal_triple_t, in a folder of its own as samples.bin; with a rate, its beginning only."""
    folder = WORK / f"samples_{sensors}" / (recording.stem + (f"_{rate_hz:g}hz" if rate_hz else ""))
    folder.mkdir(parents=True, exist_ok=True)
    rows = rows_of(recording, sensors)
    rows = resampled(rows, rate_hz, seconds) if rate_hz else rows
    part = folder / f"samples.{os.getpid()}"  # renamed when complete: another run may be reading
    part.write_bytes(b"".join(struct.pack(f"<Q{len(row) - 1}f", round(row[0] * 1e6), *row[1:]) for row in rows))
    return part.replace(folder / "samples.bin")


def vqf(rows: list[list[float]], sensor: int, period_s: float) -> list[tuple[float, ...]]:
    """Orientations of one sensor by VQF, from libjcal_batch of the host's build."""
    library = ctypes.CDLL(str(ROOT / "build/host/libjcal_batch.so"))
    first = 1 + 6 * (sensor - 1)
    values = (ctypes.c_float * (6 * len(rows)))(*(x for row in rows for x in row[first:first + 6]))
    out = (ctypes.c_float * (4 * len(rows)))()
    if library.jcal_batch_vqf(values, ctypes.c_size_t(len(rows)), ctypes.c_float(period_s), out) != 0:
        raise RuntimeError("build/host was built without VQF: run tools/vqf.sh and build again")
    return [tuple(out[4 * k:4 * k + 4]) for k in range(len(rows))]


def readings_file(recording: Path, rate_hz: float | None = None, seconds: float = 60.0, jitter_us: int = 0) -> Path:
    """As samples_file, of sensor 2 alone, as jcal_reading_t. Times off by up to jitter_us: no two distances are the same."""
    folder = WORK / "readings" / (recording.stem + (f"_{rate_hz:g}hz" if rate_hz else "") + (f"_{jitter_us}us" if jitter_us else ""))
    folder.mkdir(parents=True, exist_ok=True)
    rows = rows_of(recording, "2")
    rows = resampled(rows, rate_hz, seconds) if rate_hz else rows
    part = folder / f"samples.{os.getpid()}"
    part.write_bytes(b"".join(struct.pack("<Q6f", round(row[0] * 1e6) + (k * k * 7919) % (jitter_us + 1), *row[1:])
                              for k, row in enumerate(rows)))
    return part.replace(folder / "samples.bin")


def triples_file(recording: Path, rate_hz: float | None = None, seconds: float = 60.0) -> Path:
    """As samples_file, of three sensors."""
    return samples_file(recording, rate_hz, seconds, THREE_SENSORS)


def orientations_file(recording: Path, rate_hz: float | None = None, seconds: float = 300.0) -> Path:
    """As samples_file, but the orientations of both sensors, as jcal_orientation_pair_t."""
    folder = WORK / "orientations" / (recording.stem + (f"_{rate_hz:g}hz" if rate_hz else ""))
    folder.mkdir(parents=True, exist_ok=True)
    rows = rows_of(recording)
    rows = resampled(rows, rate_hz, seconds) if rate_hz else rows
    steps = sorted(b[0] - a[0] for a, b in zip(rows, rows[1:]))
    pairs = zip(rows, *(vqf(rows, sensor, steps[len(steps) // 2]) for sensor in (1, 2)))
    part = folder / f"samples.{os.getpid()}"
    part.write_bytes(b"".join(struct.pack("<Q8f", round(row[0] * 1e6), *q1, *q2) for row, q1, q2 in pairs))
    return part.replace(folder / "samples.bin")


def write_packets(path: Path, packets: Iterable[tuple[int, int, int, Sequence[int]]], end_us: int) -> Path:
    """Packets in the order of arrival for REPLAY_PERSON: arrival, us, counter, sensor, six raw values of each reading; then time until `end_us`."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f"{path.name}.{os.getpid()}")  # renamed when complete: another run may be reading
    with part.open("wb") as out:
        for arrival_us, counter, sensor, raw in packets:
            out.write(struct.pack(f"<QIBBH{PERSON_VALUES}h", arrival_us, counter, sensor, len(raw) // 6, 0, *raw, *[0] * (PERSON_VALUES - len(raw))))
        out.write(struct.pack(f"<QIBBH{PERSON_VALUES}h", end_us, 0, 0, 0, 0, *[0] * PERSON_VALUES))
    return part.replace(path)


def person_file(recording: Path, seconds: float = 20.0) -> Path:
    """A body of sixteen sensors that read in turns what both sensors of the recording do, with clocks, delays and losses of their own."""
    rows, draw, packets = resampled(rows_of(recording), 100.0, seconds), random.Random(5), []
    for sensor in range(16):
        first, late_us, step_us = 1 + 6 * (sensor % 2), draw.random() * 50e3, 1e4 * (1.0 + 1e-4 * (2.0 * draw.random() - 1.0))
        counter, at, before_us = int(draw.random() * 65536), 0, 0
        while at + 4 <= len(rows):
            raw = [max(-32768, min(32767, round(x / PERSON_SCALES[k // 3]))) for row in rows[at:at + 4] for k, x in enumerate(row[first:first + 6])]
            before_us = max(before_us + 1, round(1e6 + (at + 4) * step_us + late_us - 6e3 * math.log(1.0 - draw.random())))
            if draw.random() > 0.05 and (at // 100) % 16 != sensor:  # one packet in twenty, and once a second without any
                packets.append((before_us, (counter + at) % 65536, sensor, raw))
            at += 4
    return write_packets(WORK / "person" / recording.stem / "samples.bin", sorted(packets), round(1e6 * (seconds + 2.0)))


def recordings(names: list[str], bundled: str = "hinge_demo") -> list[Path]:
    """The named recordings of $JOINTCAL_DATA, or the bundled one, with a message, if they are not there."""
    data = Path(os.environ.get("JOINTCAL_DATA", ROOT / "data"))
    found = [data / f"{name}.csv" for name in names if (data / f"{name}.csv").exists()]
    if not found:
        print(f"No recordings in {data} (JOINTCAL_DATA): the bundled demo recording stands in for them.", file=sys.stderr)
    return found or [ROOT / f"tools/demo/{bundled}.csv"]


def compile_objects(platform: Platform, level: str, extra: tuple[str, ...] = ()) -> list[Path]:
    """The library's objects at this level of optimization, one per source, built by CMake as any consumer's would be."""
    folder = WORK / platform.name / (level.strip("-") + "".join(extra))
    toolchain = [f"-DCMAKE_TOOLCHAIN_FILE={PORT / platform.name}.cmake"] if platform.cpu else []
    for command in (["cmake", "-S", ROOT, "-B", folder, *toolchain, "-DCMAKE_BUILD_TYPE=Release",
                     f"-DCMAKE_C_FLAGS_RELEASE={' '.join((level, '-DNDEBUG', *extra))}", "-DJOINTCAL_WERROR=ON",
                     "-DJOINTCAL_BUILD_TESTS=OFF", "-DJOINTCAL_BUILD_PROGRAM=OFF"],
                    ["cmake", "--build", folder, "--parallel", "2"]):
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(done.stdout)
    sources = sorted(str(source.relative_to(ROOT)) for source in (ROOT / "lib").rglob("*.c"))
    found = [folder / f"CMakeFiles/jointcal.dir/{source}" for source in sources]
    return [next(o for suffix in (".o", ".obj") if (o := source.with_name(source.name + suffix)).exists()) for source in found]


def build(platform: Platform, name: str, definitions: tuple[str, ...] = (), source: str = "replay.c") -> Path:
    """A program of port/cortex_m, by default the replay, linked with the library at -O2."""
    objects = compile_objects(platform, "-O2")
    image = WORK / platform.name / f"{name}.elf"
    common = [*PROGRAM_FLAGS, *[f"-D{d}" for d in definitions], f"-I{ROOT}/include", PORT / source]
    if platform.cpu:
        symbols = {"flash": platform.flash, "flash_size": platform.flash_bytes, "ram": platform.ram,
                   "ram_size": platform.ram_bytes, "stack_size": platform.stack_bytes}
        subprocess.run(["arm-none-eabi-gcc", "--specs=picolibc.specs", "--crt0=hosted", "--oslib=semihost", *platform.cpu,
                        *common, PORT / "fault.c", *objects, "-Wl,--gc-sections", "-Tpicolibc.ld", "-o", image, "-lm",
                        *[f"-Wl,--defsym=__{key}={value:#x}" for key, value in symbols.items()]], check=True)
    else:
        subprocess.run(["cc", *common, *objects, "-o", image, "-lm"], check=True)
    return image


def build_plugin() -> Path:
    WORK.mkdir(parents=True, exist_ok=True)
    plugin = WORK / "count_plugin.so"
    subprocess.run(["cc", "-std=gnu99", "-O2", "-Wall", "-Wextra", "-shared", "-fPIC", PORT / "count_plugin.c", "-o",
                    plugin], check=True)
    return plugin


def run(platform: Platform, image: Path, samples: Path, plugin: Path | None = None, out: Path | None = None, most_s: float = QEMU_SECONDS) -> dict:
    """What the replay program printed: samples, hash, state, stack, samples before the first that was ready, slices (if shown)."""
    command = [str(image)]
    if platform.cpu:
        command = ["qemu-system-arm", "-M", platform.machine, "-display", "none", "-monitor", "none", "-serial", "none",
                   "-chardev", "stdio,id=sh", "-semihosting-config", "enable=on,target=native,chardev=sh", "-kernel",
                   str(image)]
        if plugin:
            command += ["-plugin", f"{plugin},out={out}"]
    done = subprocess.run(command, cwd=samples.parent, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          timeout=most_s, check=False)
    match = re.search(r"samples (\d+) hash (\w+) state (\d+) stack (\d+) before_ready (\d+)", done.stdout)
    if done.returncode != 0 or not match:
        raise RuntimeError(f"{image.name} on {platform.name}: exit {done.returncode}: {done.stdout}{done.stderr}")
    return {"samples": int(match[1]), "hash": match[2], "state": int(match[3]), "stack": int(match[4]),
            "before_ready": int(match[5]), "slices": [int(slice_) for slice_ in re.findall(r"slice (\d+)", done.stdout)]}
