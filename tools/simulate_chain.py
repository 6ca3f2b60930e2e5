#!/usr/bin/env python3
"""Write a simulated recording of pelvis, thigh and shank (CSV) and its truth (JSON).

    python3 tools/simulate_chain.py --type 2 --duration 40 --rate 100 --seed 1 --out x.csv
    python3 tools/simulate_chain.py --type 1 --soft-tissue 2 --acc-bias 0.2 --orientations --out y.csv

Type 1 is motion with little variation about the other axes than those of flexion, the knee a hinge; type 2 much motion about
all axes of both joints, as in section 5 of [SAL15]. Without --orientations the program computes them where it needs any.
"""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "python"))

from jointcal_tools.recordings import write_simulated  # noqa: E402
from jointcal_tools.simulate_chain import ChainSpec, simulate_chain  # noqa: E402


def make_parser() -> argparse.ArgumentParser:
    default = ChainSpec()
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--type", type=int, choices=(1, 2), default=default.type, help="of the motion")
    parser.add_argument("--duration", type=float, default=default.seconds, help="seconds")
    parser.add_argument("--rate", type=float, default=default.rate_hz, help="Hz, 25 to 200")
    parser.add_argument("--seed", type=int, default=default.seed)
    parser.add_argument("--noise-scale", type=float, default=default.noise_scale, help="times the noise of the papers")
    parser.add_argument("--acc-bias", type=float, default=default.acc_bias, help="magnitude, m/s^2")
    parser.add_argument("--gyr-bias", type=float, default=default.gyr_bias_deg_s, help="magnitude, deg/s")
    parser.add_argument("--soft-tissue", type=float, default=default.soft_tissue_deg, help="rms, deg")
    parser.add_argument("--thigh-length", type=float, default=default.thigh_m, help="distance of hip and knee, m")
    parser.add_argument("--speed", type=float, default=default.speed, help="times the rates of the type")
    parser.add_argument("--orientations", action="store_true", help="write q1_*, q2_* and q3_* too")
    parser.add_argument("--out", type=Path, required=True, help="CSV file; the truth goes beside it as .json")
    return parser


def main() -> int:
    args = make_parser().parse_args()
    rec = simulate_chain(ChainSpec(type=args.type, seconds=args.duration, rate_hz=args.rate, seed=args.seed,
                                   noise_scale=args.noise_scale, acc_bias=args.acc_bias, gyr_bias_deg_s=args.gyr_bias,
                                   soft_tissue_deg=args.soft_tissue, thigh_m=args.thigh_length, speed=args.speed))
    columns = rec.third_columns() | (rec.orientation_columns() if args.orientations else {})
    write_simulated(args.out, rec.first_two(), rec.truth(), columns)
    return 0


if __name__ == "__main__":
    sys.exit(main())
