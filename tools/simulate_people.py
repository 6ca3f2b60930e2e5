#!/usr/bin/env python3
"""Write a simulated recording of a person's joint (CSV) and its truth (JSON).

    python3 tools/simulate_people.py --activity walk:30 --rate 100 --seed 1 --out x.csv
    python3 tools/simulate_people.py --activity stand:5 sit_to_stand:20 walk:20 --joint ankle --skin 0.5 --out y.csv
    python3 tools/simulate_people.py --activity run --stiff --lag 0.02 --out z.csv
"""

import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "python"))

from jointcal_tools.recordings import timed_parts, without_orientations, write_simulated  # noqa: E402
from jointcal_tools.simulate_people import ACTIVITIES, PLACES, PersonSpec, simulate_person  # noqa: E402


def make_parser() -> argparse.ArgumentParser:
    default = PersonSpec()
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--activity", nargs="+", default=["walk"], metavar="NAME[:SECONDS]",
                        help="one or more of " + ", ".join(sorted(ACTIVITIES)))
    parser.add_argument("--duration", type=float, default=30.0, help="seconds per activity that names none")
    parser.add_argument("--joint", choices=sorted(PLACES), default=default.joint)
    parser.add_argument("--rate", type=float, default=default.rate_hz, help="Hz, 40 to 200")
    parser.add_argument("--seed", type=int, default=default.seed)
    parser.add_argument("--skin", type=float, default=default.skin, help="times what is usual; 0: rigid mount")
    parser.add_argument("--out-of-plane", type=float, default=default.out_of_plane, help="times what is usual; 0: an exact hinge")
    parser.add_argument("--loop", type=float, default=default.loop, help="share of it that is the same in every cycle, 0 to 1")
    parser.add_argument("--bending", type=float, help="range of flexion, deg; without it the activity's")
    parser.add_argument("--stiff", action="store_true", help="the joint does not bend")
    parser.add_argument("--lag", type=float, default=default.lag_s, help="seconds that sensor 2 is late")
    parser.add_argument("--noise-scale", type=float, default=default.noise_scale)
    parser.add_argument("--acc-bias", type=float, default=default.acc_bias, help="magnitude, m/s^2")
    parser.add_argument("--gyr-bias", type=float, default=default.gyr_bias_deg_s, help="magnitude, deg/s")
    parser.add_argument("--no-orientations", action="store_true", help="leave out q1_* and q2_*")
    parser.add_argument("--out", type=Path, required=True, help="CSV file; the truth goes beside it as .json")
    return parser


def make_spec(args: argparse.Namespace) -> PersonSpec:
    activities = timed_parts(args.activity, args.duration)
    return PersonSpec(activities, args.joint, args.rate, args.seed, skin=args.skin, out_of_plane=args.out_of_plane,
                      loop=args.loop, bending_deg=args.bending, stiff=args.stiff, lag_s=args.lag,
                      noise_scale=args.noise_scale, gyr_bias_deg_s=args.gyr_bias, acc_bias=args.acc_bias)


def main() -> int:
    parser = make_parser()
    args = parser.parse_args()
    try:
        spec = make_spec(args)
    except ValueError as error:
        parser.error(str(error))
    rec = simulate_person(spec)
    extra = rec.extra_columns()
    write_simulated(args.out, rec, rec.truth(), without_orientations(extra) if args.no_orientations else extra)
    return 0


if __name__ == "__main__":
    sys.exit(main())
