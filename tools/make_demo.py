#!/usr/bin/env python3
"""Write the bundled demo recordings tools/demo/*_demo.csv and their truth, *_demo.json.

    python3 tools/make_demo.py            write them
    python3 tools/make_demo.py --check    exit 1 if the files in the repository differ

hinge: rest, then motion with a stiff joint (nothing to learn about the axis), then
informative motion: 30 s at 50 Hz with realistic disturbances.

two_dof: an elbow with a carrying angle of 8 deg, which first only bends (nothing to
learn about the second axis), then bends and turns: 36 s at 50 Hz.
"""

import argparse
import json
import sys
import tempfile
from pathlib import Path

TOOLS = Path(__file__).resolve().parent
sys.path.insert(0, str(TOOLS / "python"))

from jointcal_tools.recordings import write_csv  # noqa: E402
from jointcal_tools.simulate import HingeSpec, simulate_hinge  # noqa: E402
from jointcal_tools.simulate_two_dof import TwoDofSpec, simulate_two_dof  # noqa: E402

DEMO = TOOLS / "demo"
FILES = tuple(f"{joint}_demo.{ending}" for joint in ("hinge", "two_dof") for ending in ("csv", "json"))
SPEC = HingeSpec(motions=(("rest", 4.0), ("stiff", 4.0), ("7", 10.0), ("6", 9.0)),  # and 3 s of transitions
                 rate_hz=50.0, seed=2020, acc_bias=0.1, gyr_bias_deg_s=0.3, soft_tissue_deg=0.5)
TWO_DOF = TwoDofSpec(motions=(("hinge", 8.0), ("free", 26.0)), rate_hz=50.0, seed=2022, carrying_deg=8.0,
                     acc_bias=0.05, gyr_bias_deg_s=0.1, soft_tissue_deg=0.2)
DIGITS = 7  # few enough that no platform's last bit shows


def rounded(value):
    """JSON values with DIGITS significant digits."""
    if isinstance(value, float):
        return float(f"{value:.{DIGITS}g}")
    if isinstance(value, dict):
        return {key: rounded(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [rounded(item) for item in value]
    return value


def write_demo(folder: Path) -> None:
    folder.mkdir(exist_ok=True)
    for joint, rec in (("hinge", simulate_hinge(SPEC)), ("two_dof", simulate_two_dof(TWO_DOF))):
        write_csv(folder / f"{joint}_demo.csv", rec, digits=DIGITS)
        truth = {**rec.truth(), "source": "simulated (tools/make_demo.py)"}
        (folder / f"{joint}_demo.json").write_text(json.dumps(rounded(truth), indent=1) + "\n", newline="\n")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="compare instead of writing")
    if not parser.parse_args().check:
        write_demo(DEMO)
        return 0
    with tempfile.TemporaryDirectory() as folder:
        write_demo(Path(folder))
        different = [name for name in FILES
                     if not (DEMO / name).is_file() or (DEMO / name).read_bytes() != (Path(folder) / name).read_bytes()]
    for name in different:
        print(f"tools/demo/{name} differs from what tools/make_demo.py writes", file=sys.stderr)
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
