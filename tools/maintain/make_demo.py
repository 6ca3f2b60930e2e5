#!/usr/bin/env python3
"""Write the bundled demo recordings tools/demo/{hinge,knee,elbow,two_dof,chain,leg}_demo.csv, thigh_demo.csv and shank_demo.csv, and their
truths, .json.

    python3 tools/maintain/make_demo.py            write all
    python3 tools/maintain/make_demo.py --check    exit 1 if the files in the repository differ

Hinge: rest, then motion with a stiff joint (nothing to learn about the axis),
then informative motion: 30 s at 50 Hz with realistic disturbances.
Knee: a person stands, walks, squats; sensors on skin: 36 s at 50 Hz, with the bones' flexion.
Thigh and shank: a knee in two files of one sensor each, with clocks and rates of their own.
Elbow: a person walks, bends, turns the forearm; sensors on skin: 32 s at 50 Hz.
Two axes: rest, motion about one axis only, then about both: 40 s at 50 Hz.
Gyroscope bias lets the heading of orientations computed from it drift.
Hip and knee: three sensors, motion of type 2 of SAL15: 30 s at 50 Hz, with a
third of the papers' noise, which is what sensors of today have.
Leg, for the hub: pelvis, thigh and shank, skin under all three, 90 s at 25 Hz, as long as a hub takes until it keeps what it found.
"""

import argparse
import json
import sys
import tempfile
from pathlib import Path

import numpy as np

TOOLS = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(TOOLS / "python"))

from jointcal_tools.recordings import without_orientations, write_csv  # noqa: E402
from jointcal_tools.simulate import HingeSpec, simulate_hinge  # noqa: E402
from jointcal_tools.simulate_body import RATE_HZ, simulate_body  # noqa: E402
from jointcal_tools.simulate_chain import ChainSpec, simulate_chain  # noqa: E402
from jointcal_tools.simulate_people import PersonSpec, simulate_person  # noqa: E402
from jointcal_tools.simulate_two_dof import TwoDofSpec, simulate_two_dof  # noqa: E402
from jointcal_tools.two_files import Clock, lag_s, split, write  # noqa: E402

DEMO = TOOLS / "demo"
HINGE = HingeSpec(motions=(("rest", 4.0), ("stiff", 4.0), ("7", 10.0), ("6", 9.0)),  # and 3 s of transitions
                  rate_hz=50.0, seed=2020, acc_bias=0.1, gyr_bias_deg_s=0.3, soft_tissue_deg=0.5)
KNEE = PersonSpec((("stand", 4.0), ("walk", 16.0), ("squat", 16.0)), rate_hz=50.0, seed=2026)
ELBOW = PersonSpec((("walk", 6.0), ("bend", 13.0), ("turn", 13.0)), "elbow", 50.0, seed=2026)
TWO_DOF = TwoDofSpec(motions=(("rest", 4.0), ("hinge", 6.0), ("free", 28.0)),
                     rate_hz=50.0, seed=2022, carrying_deg=8.0, acc_bias=0.1, gyr_bias_deg_s=0.1, soft_tissue_deg=0.3)
CHAIN = ChainSpec(type=2, seconds=30.0, rate_hz=50.0, seed=2015, noise_scale=0.3, acc_bias=0.1, gyr_bias_deg_s=0.1)
TWO_FILES = PersonSpec((("stand", 3.0), ("walk", 20.0), ("random", 20.0)), rate_hz=100.0, seed=2027)
CLOCKS = (Clock(rate_hz=50.0), Clock(rate_hz=40.0, begin_s=0.16, offset_s=3600.0, lag_s=0.12, drift_ppm=200.0))
LEG_S, LEG_STEP, LEG_SEED = 90.0, 4, 1  # every fourth of its rows, so that the file is small
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


def write_truth(path: Path, truth: dict) -> None:
    path.write_text(json.dumps(rounded(truth), indent=1) + "\n", newline="\n")


def write_leg(folder: Path) -> None:
    leg = simulate_body(LEG_S, LEG_SEED, (-1, 0, 1))
    columns = [f"{quantity}{sensor}_{axis}" for sensor in (1, 2, 3) for quantity in ("gyr", "acc") for axis in "xyz"]
    digits = [3 if name.startswith("gyr") else 2 for name in columns]
    rows = [",".join([f"{k * LEG_STEP / RATE_HZ:.2f}", *(f"{value:.{digit}f}" for value, digit in zip(row, digits, strict=True))])
            for k, row in enumerate(np.hstack(leg.values)[::LEG_STEP])]
    (folder / "leg_demo.csv").write_text("\n".join([",".join(["t_s", *columns]), *rows]) + "\n")
    hip, knee = leg.axes
    write_truth(folder / "leg_demo.json", {"hip_axis_pelvis": hip[0].tolist(), "hip_axis_thigh": hip[1].tolist(), "knee_axis_thigh": knee[0].tolist(),
                                           "knee_axis_shank": knee[1].tolist(), "source": "simulated (tools/maintain/make_demo.py)"})


def write_demo(folder: Path) -> None:
    folder.mkdir(exist_ok=True)
    for name, rec in (("hinge_demo", simulate_hinge(HINGE)), ("two_dof_demo", simulate_two_dof(TWO_DOF))):
        write_csv(folder / f"{name}.csv", rec, digits=DIGITS)
        # The heading offset of computed orientations is not that of the simulated ones, which no file holds.
        truth = {**rec.truth(), "source": "simulated (tools/maintain/make_demo.py)"}
        truth.pop("heading_offset_deg", None)
        write_truth(folder / f"{name}.json", truth)
    for name, spec in (("knee_demo", KNEE), ("elbow_demo", ELBOW)):
        person = simulate_person(spec)
        write_csv(folder / f"{name}.csv", person, digits=DIGITS, extra=without_orientations(person.extra_columns()))
        truth = {**person.truth(), "source": "simulated (tools/maintain/make_demo.py)"}
        if spec.joint == "elbow":  # what 'jointcal two-dof' calls axis 2
            truth["axis2"] = truth["turn_axis2"]
        write_truth(folder / f"{name}.json", truth)
    person = simulate_person(TWO_FILES)
    for name, rows in zip(("thigh_demo", "shank_demo"), split(person, CLOCKS, np.random.default_rng(TWO_FILES.seed)), strict=True):
        write(folder / f"{name}.csv", rows, digits=DIGITS - 1)
    facts = {name: value for name, value in person.truth().items() if name != "lag_s"}
    write_truth(folder / "thigh_shank_demo.json", {**facts, "lag_s": lag_s(CLOCKS, 0.0), "drift_ppm": CLOCKS[1].drift_ppm,
                                                   "source": "simulated (tools/maintain/make_demo.py)"})
    chain = simulate_chain(CHAIN)
    write_csv(folder / "chain_demo.csv", chain.first_two(), digits=DIGITS, extra=chain.third_columns())
    write_truth(folder / "chain_demo.json", {**chain.truth(), "source": "simulated (tools/maintain/make_demo.py)"})
    write_leg(folder)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="compare instead of writing")
    if not parser.parse_args().check:
        write_demo(DEMO)
        return 0
    with tempfile.TemporaryDirectory() as folder:
        write_demo(Path(folder))
        names = sorted(path.name for path in Path(folder).iterdir())
        different = [name for name in names
                     if not (DEMO / name).is_file() or (DEMO / name).read_bytes() != (Path(folder) / name).read_bytes()]
    for name in different:
        print(f"tools/demo/{name} differs from what tools/maintain/make_demo.py writes", file=sys.stderr)
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
