#!/usr/bin/env python3
"""Write a simulated hinge recording (CSV) and its truth (JSON).

    python3 tools/simulate.py --motion 7 --duration 30 --rate 100 --seed 1 --out x.csv
    python3 tools/simulate.py --motion 1:5 2:10 daily:60 --acc-bias 0.1 --out y.csv
    python3 tools/simulate.py --scenario 2 --rate 50 --out z.csv
"""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "python"))

from jointcal_tools.recordings import timed_parts, write_simulated  # noqa: E402
from jointcal_tools.simulate import MOTIONS, SEQUENTIAL, HingeSpec, scenario, simulate_hinge  # noqa: E402


def make_parser() -> argparse.ArgumentParser:
    default = HingeSpec()
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--motion", nargs="+", default=["7"], metavar="NAME[:SECONDS]",
                      help="one or more of " + ", ".join(sorted({*MOTIONS, *SEQUENTIAL})))
    what.add_argument("--scenario", type=int, choices=(1, 2, 3, 4), help="sequence of motions of OLS20 7.1")
    parser.add_argument("--duration", type=float, default=20.0, help="seconds per motion that names none")
    parser.add_argument("--rate", type=float, default=default.rate_hz, help="Hz, 25 to 200")
    parser.add_argument("--seed", type=int, default=default.seed)
    parser.add_argument("--noise-scale", type=float, default=default.noise_scale)
    parser.add_argument("--acc-bias", type=float, default=default.acc_bias, help="magnitude, m/s^2")
    parser.add_argument("--gyr-bias", type=float, default=default.gyr_bias_deg_s, help="magnitude, deg/s")
    parser.add_argument("--soft-tissue", type=float, default=default.soft_tissue_deg, help="rms, deg")
    parser.add_argument("--wobble", type=float, default=default.wobble_deg, help="rms, deg")
    parser.add_argument("--speed", type=float, default=default.speed, help="rms, rad/s")
    parser.add_argument("--cut-transitions", action="store_true", help="remove the samples between motions")
    parser.add_argument("--out", type=Path, required=True, help="CSV file; the truth goes beside it as .json")
    return parser


def make_spec(args: argparse.Namespace) -> HingeSpec:
    if args.scenario:
        motions = scenario(args.scenario, args.duration)
    else:
        motions = timed_parts(args.motion, args.duration)
    return HingeSpec(motions=motions, rate_hz=args.rate, seed=args.seed, noise_scale=args.noise_scale,
                     acc_bias=args.acc_bias, gyr_bias_deg_s=args.gyr_bias, soft_tissue_deg=args.soft_tissue,
                     wobble_deg=args.wobble, speed=args.speed, keep_transitions=not args.cut_transitions)


def main() -> int:
    parser = make_parser()
    args = parser.parse_args()
    try:
        spec = make_spec(args)
    except ValueError as error:
        parser.error(str(error))
    rec = simulate_hinge(spec)
    write_simulated(args.out, rec, rec.truth())
    return 0


if __name__ == "__main__":
    sys.exit(main())
