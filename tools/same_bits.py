#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Same recording, same bits: hashes every result of all engines on the host, on a Cortex-M4F, on a Cortex-M3 without FPU, and of
the stream engines on a Cortex-M0 with 16 KiB of RAM. Prints a hash per recording, engine and platform, writes
docs/measurements/same_bits.md and exits with 1 if any of them differ. Recordings are those of JOINTCAL_DATA if it is set, and the
bundled one.

usage: tools/same_bits.py [--no-write]
"""
import os
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "python"))
from jointcal_tools import target  # noqa: E402

HINGES = ["rig_1D_01", "rig_1D_02", "rig_1D_04"], "hinge_demo"
CENTER = ["rig_3D_01", "rig_3D_02", "rig_2D_05"], "two_dof_demo"
CHAIN = ["human_leg_left"], "chain_demo"
KNEE = ["people_knee_long_R1", "knee_drop", "rig_1D_01"], "hinge_demo"
ELBOW = ["people_elbow_D_ROM", "human_elbow_right", "rig_2D_02"], "elbow_demo"
SENSOR = ["knee_drop", "people_ankle_orthosis", "rig_1D_01"], "hinge_demo"
PERSON = ["people_knee_long_R1"], "hinge_demo"
TWO_DOF = ["rig_2D_01", "rig_2D_02", "rig_2D_05"], "two_dof_demo"
# What the image is called, its definitions, recordings, and how they become samples.
ENGINES = {"hinge, stream": ("hinge_stream", (), HINGES, target.samples_file),
           "hinge, window, N_max 125": ("hinge_window", ("REPLAY_WINDOW",), HINGES, target.samples_file),
           "two-dof, stream": ("two_dof_stream", ("REPLAY_TWO_DOF",), TWO_DOF, target.orientations_file),
           "centre, stream": ("center_stream", ("REPLAY_CENTER",), CENTER, target.samples_file),
           "chain": ("chain", ("REPLAY_CHAIN",), CHAIN, target.triples_file),
           "one sensor": ("sensor", ("REPLAY_SENSOR",), SENSOR, target.readings_file),
           "packets of one sensor": ("packets", ("REPLAY_PACKETS",), SENSOR, target.readings_file),
           "pairing of two": ("pairing", ("REPLAY_PAIRING",), KNEE, target.samples_file),
           "health of one sensor": ("health", ("REPLAY_HEALTH",), SENSOR, target.readings_file),
           "hinge, functional": ("functional", ("REPLAY_FUNCTIONAL",), KNEE, target.samples_file),
           "two axes, functional": ("two_axes", ("REPLAY_TWO_AXES",), ELBOW, target.samples_file),
           "hip and knee of a person": ("leg", ("REPLAY_LEG",), CHAIN, target.triples_file),
           "whole person": ("person", ("REPLAY_PERSON",), PERSON, target.person_file),
           "hinge of either kind": ("hinge_auto", ("REPLAY_AUTO",), KNEE, target.samples_file)}
# With the buffers of the program more than 16 KiB; a person without FPU takes too long.
NOT_ON = {"hinge, window, N_max 125": ("m0",), "whole person": ("m3", "m0"), "chain": ("m0",), "hip and knee of a person": ("m0",)}
PAGE = target.ROOT / "docs/measurements/same_bits.md"


def recordings_of(names: list[str], bundled: str) -> list[Path]:
    demo = target.ROOT / f"tools/demo/{bundled}.csv"
    return [r for r in target.recordings(names, bundled) if r != demo] + [demo]


def main() -> int:
    lines = ["# Same bits", "",
             "Written by `tools/same_bits.py`: FNV-1a (64 bit) over every field of the result after every sample. m0 is QEMU's",
             "microbit, a Cortex-M0 with 16 KiB of RAM; the window engine and the chains do not fit there beside the program that feeds them.", "",
             "| recording | samples | engine | " + " | ".join(target.PLATFORMS) + " | same |",
             "|---|---|---|" + "---|" * (len(target.PLATFORMS) + 1)]
    same_everywhere = True
    for engine, (image_name, definitions, recordings, make_samples) in ENGINES.items():
        images = {name: target.build(platform, f"same_bits_{image_name}", definitions)
                  for name, platform in target.PLATFORMS.items() if name not in NOT_ON.get(engine, ())}
        for recording in recordings_of(*recordings):
            samples = make_samples(recording)
            with ThreadPoolExecutor(os.cpu_count()) as pool:  # an emulator each
                runs = pool.map(lambda item: target.run(target.PLATFORMS[item[0]], item[1], samples), images.items())
                printed = dict(zip(images, runs, strict=True))
            same = len({of["hash"] for of in printed.values()}) == 1
            same_everywhere &= same
            lines.append(f"| {recording.stem} | {printed['host']['samples']} | {engine} | "
                         + " | ".join(f"`{printed[name]['hash']}`" if name in printed else "-" for name in target.PLATFORMS)
                         + f" | {'yes' if same else 'NO'} |")
            print(lines[-1], flush=True)
    if "--no-write" not in sys.argv:
        PAGE.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return 0 if same_everywhere else 1


if __name__ == "__main__":
    sys.exit(main())
