#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Same recording, same bits: hashes every result of both hinge engines on the host, on a Cortex-M4F, on a Cortex-M3 without
FPU, and of the stream engine on a Cortex-M0 with 16 KiB of RAM. Prints a hash per recording, engine and platform, writes
docs/measurements/same_bits.md and exits with 1 if any of them differ. Recordings are those of JOINTCAL_DATA if it is set, and the
bundled one.

usage: tools/same_bits.py [--no-write]
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "python"))
from jointcal_tools import target  # noqa: E402

NAMES = ["rig_1D_01", "rig_1D_02", "rig_1D_04"]
ENGINES = {"stream": (), "window, N_max 125": ("REPLAY_WINDOW",)}
NOT_ON = {"window, N_max 125": ("m0",)}  # its buffers and those of the program are more than 16 KiB
PAGE = target.ROOT / "docs/measurements/same_bits.md"


def main() -> int:
    demo = target.ROOT / "tools/demo/hinge_demo.csv"
    recordings = [r for r in target.recordings(NAMES) if r != demo] + [demo]
    lines = ["# Same bits", "",
             "Written by `tools/same_bits.py`: FNV-1a (64 bit) over every field of the result after every sample. m0 is QEMU's",
             "microbit, a Cortex-M0 with 16 KiB of RAM; the window engine does not fit there beside the program that feeds it.", "",
             "| recording | samples | engine | " + " | ".join(target.PLATFORMS) + " | same |",
             "|---|---|---|" + "---|" * (len(target.PLATFORMS) + 1)]
    same_everywhere = True
    for engine, definitions in ENGINES.items():
        images = {name: target.build(platform, f"same_bits_{engine.split(',')[0]}", definitions)
                  for name, platform in target.PLATFORMS.items() if name not in NOT_ON.get(engine, ())}
        for recording in recordings:
            samples = target.samples_file(recording)
            printed = {name: target.run(target.PLATFORMS[name], image, samples) for name, image in images.items()}
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
