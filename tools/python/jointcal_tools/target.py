# SPDX-License-Identifier: MIT
"""Builds port/cortex_m/replay.c for a target or the host and runs it over a recording: for tools/budget.py and
tools/same_bits.py. Needs gcc-arm-none-eabi, picolibc-arm-none-eabi and qemu-system-arm; standard library only."""
import csv
import os
import re
import struct
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
PORT = ROOT / "port/cortex_m"
WORK = ROOT / "build/target"
COLUMNS = [f"{kind}{imu}_{axis}" for imu in "12" for kind in ("gyr", "acc") for axis in "xyz"]
# As tools/cmake/flags.cmake.
FLAGS = ["-std=c99", "-ffp-contract=off", "-fno-math-errno", "-ffunction-sections", "-fdata-sections", "-Wall", "-Wextra"]
QEMU_SECONDS = 300


@dataclass(frozen=True)
class Platform:
    """A processor, and the emulated board that stands for it."""
    name: str
    cpu: tuple[str, ...]  # empty: the host
    machine: str = ""
    flash: int = 0
    ram: int = 0x20000000


M4F = ("-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16")
M3 = ("-mcpu=cortex-m3", "-mthumb", "-mfloat-abi=soft")
PLATFORMS = {p.name: p for p in (Platform("host", ()), Platform("m4f", M4F, "mps2-an386"),
                                 Platform("m3", M3, "mps2-an385"))}


def samples_file(recording: Path) -> Path:
    """The recording's samples as jcal_pair_t, in a folder of its own as samples.bin."""
    folder = WORK / "samples" / recording.stem
    folder.mkdir(parents=True, exist_ok=True)
    part = folder / f"samples.{os.getpid()}"  # renamed when complete: another run may be reading
    with open(recording, newline="", encoding="utf-8") as lines, open(part, "wb") as binary:
        for row in csv.DictReader(line for line in lines if not line.startswith("#")):
            values = [float(row[column]) if row[column] else float("nan") for column in COLUMNS]
            binary.write(struct.pack("<Q12f", round(float(row["t_s"]) * 1e6), *values))
    return part.replace(folder / "samples.bin")


def recordings(names: list[str]) -> list[Path]:
    """The named recordings of $JOINTCAL_DATA, or the bundled one, with a message, if they are not there."""
    data = Path(os.environ.get("JOINTCAL_DATA", ROOT / "data"))
    found = [data / f"{name}.csv" for name in names if (data / f"{name}.csv").exists()]
    if not found:
        print(f"No recordings in {data} (JOINTCAL_DATA): the bundled demo recording stands in for them.", file=sys.stderr)
    return found or [ROOT / "tools/demo/hinge_demo.csv"]


def library_sources() -> list[Path]:
    return sorted((ROOT / "lib").rglob("*.c"))


def compile_objects(platform: Platform, level: str, extra: tuple[str, ...] = ()) -> list[Path]:
    """The library's objects at this level of optimization, one per source."""
    folder = WORK / platform.name / (level.strip("-") + "".join(extra))
    folder.mkdir(parents=True, exist_ok=True)
    compiler = "arm-none-eabi-gcc" if platform.cpu else "cc"
    specs = ["--specs=picolibc.specs"] if platform.cpu else []
    objects = []
    for source in library_sources():
        target = folder / ("_".join(source.relative_to(ROOT / "lib").parts)[:-2] + ".o")
        subprocess.run([compiler, *specs, *platform.cpu, *FLAGS, level, "-DNDEBUG", *extra, f"-I{ROOT}/include", f"-I{ROOT}/lib",
                        "-c", source, "-o", target], check=True)
        objects.append(target)
    return objects


def build(platform: Platform, name: str, definitions: tuple[str, ...] = (), level: str = "-O2") -> Path:
    """The replay program."""
    objects = compile_objects(platform, level)
    image = WORK / platform.name / f"{name}.elf"
    common = [*FLAGS, level, "-DNDEBUG", *[f"-D{d}" for d in definitions], f"-I{ROOT}/include", PORT / "replay.c"]
    if platform.cpu:
        symbols = {"flash": platform.flash, "flash_size": 0x400000, "ram": platform.ram, "ram_size": 0x400000,
                   "stack_size": 0x4000}
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


def run(platform: Platform, image: Path, samples: Path, plugin: Path | None = None, out: Path | None = None) -> dict:
    """What the replay program printed: samples, hash, state, stack."""
    command = [str(image)]
    if platform.cpu:
        command = ["qemu-system-arm", "-M", platform.machine, "-display", "none", "-monitor", "none", "-serial", "none",
                   "-chardev", "stdio,id=sh", "-semihosting-config", "enable=on,target=native,chardev=sh", "-kernel",
                   str(image)]
        if plugin:
            command += ["-plugin", f"{plugin},out={out}"]
    done = subprocess.run(command, cwd=samples.parent, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          timeout=QEMU_SECONDS, check=False)
    match = re.search(r"samples (\d+) hash (\w+) state (\d+) stack (\d+)", done.stdout)
    if done.returncode != 0 or not match:
        raise RuntimeError(f"{image.name} on {platform.name}: exit {done.returncode}: {done.stdout}{done.stderr}")
    return {"samples": int(match[1]), "hash": match[2], "state": int(match[3]), "stack": int(match[4])}
