#!/usr/bin/env python3
"""Write a simulated recording of a 2-DoF joint (CSV) and its truth (JSON).

    python3 tools/simulate_two_dof.py --motion free --duration 30 --rate 100 --seed 1 --out x.csv
    python3 tools/simulate_two_dof.py --motion rest:5 simple:30 --soft-tissue 2 --drift 3 --inclination 0.3 --out y.csv
    python3 tools/simulate_two_dof.py --motion free:120 --slip 60:2:25 --no-orientations --out z.csv
"""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "python"))

from jointcal_tools.recordings import timed_parts, without_orientations, write_simulated  # noqa: E402
from jointcal_tools.simulate_two_dof import TWO_DOF_MOTIONS, Slip, TwoDofSpec, simulate_two_dof  # noqa: E402


def parse_slip(text: str) -> Slip:
    try:
        at_s, sensor, angle_deg = text.split(":")
        return Slip(float(at_s), int(sensor), float(angle_deg))
    except ValueError:
        raise argparse.ArgumentTypeError(f"'{text}' is not SECONDS:SENSOR:DEG") from None


def make_parser() -> argparse.ArgumentParser:
    default = TwoDofSpec()
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--motion", nargs="+", default=["free"], metavar="NAME[:SECONDS]",
                        help="one or more of " + ", ".join(sorted(TWO_DOF_MOTIONS)))
    parser.add_argument("--duration", type=float, default=20.0, help="seconds per motion that names none")
    parser.add_argument("--rate", type=float, default=default.rate_hz, help="Hz, 25 to 200")
    parser.add_argument("--seed", type=int, default=default.seed)
    parser.add_argument("--carrying", type=float, default=default.carrying_deg, help="carrying angle, deg")
    parser.add_argument("--noise-scale", type=float, default=default.noise_scale)
    parser.add_argument("--acc-bias", type=float, default=default.acc_bias, help="magnitude, m/s^2")
    parser.add_argument("--gyr-bias", type=float, default=default.gyr_bias_deg_s, help="magnitude, deg/s")
    parser.add_argument("--soft-tissue", type=float, default=default.soft_tissue_deg, help="rms, deg")
    parser.add_argument("--heading", type=float, help="heading offset at the beginning, deg; random without it")
    parser.add_argument("--drift", type=float, default=default.drift_deg_min, help="of the heading offset, deg/min")
    parser.add_argument("--inclination", type=float, default=default.inclination_deg,
                        help="rms inclination error of the orientations, deg")
    parser.add_argument("--speed", type=float, default=default.speed, help="rms, rad/s")
    parser.add_argument("--slip", nargs="+", default=[], type=parse_slip, metavar="SECONDS:SENSOR:DEG",
                        help="a sensor turns at a time")
    parser.add_argument("--no-orientations", action="store_true", help="leave out q1_* and q2_*")
    parser.add_argument("--out", type=Path, required=True, help="CSV file; the truth goes beside it as .json")
    return parser


def make_spec(args: argparse.Namespace) -> TwoDofSpec:
    motions = timed_parts(args.motion, args.duration)
    return TwoDofSpec(motions=motions, rate_hz=args.rate, seed=args.seed, carrying_deg=args.carrying,
                      noise_scale=args.noise_scale, acc_bias=args.acc_bias, gyr_bias_deg_s=args.gyr_bias,
                      soft_tissue_deg=args.soft_tissue, heading_deg=args.heading, drift_deg_min=args.drift,
                      inclination_deg=args.inclination, speed=args.speed, slips=tuple(args.slip))


def main() -> int:
    parser = make_parser()
    args = parser.parse_args()
    try:
        spec = make_spec(args)
    except ValueError as error:
        parser.error(str(error))
    rec = simulate_two_dof(spec)
    extra = rec.extra_columns()
    write_simulated(args.out, rec, rec.truth(), without_orientations(extra) if args.no_orientations else extra)
    return 0


if __name__ == "__main__":
    sys.exit(main())
