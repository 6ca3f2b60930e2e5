"""The simulator's signals are checked against its orientations, never against its own formulas."""

import sys
import tempfile
import time
import unittest
from dataclasses import replace
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

from jointcal_tools.recordings import load_csv, write_csv  # noqa: E402
from jointcal_tools.simulate import (  # noqa: E402
    ACC_STD_M_S2, GRAVITY_M_S2, GYR_STD_RAD_S, MOTIONS, HingeSpec, scenario, simulate_hinge)

EVERY_KIND = (("1", 2.0), ("2", 6.0), ("3", 8.0), ("6", 6.0), ("7", 6.0), ("11", 8.0), ("14", 8.0), ("daily", 8.0))
CLEAN = HingeSpec(motions=EVERY_KIND, rate_hz=200.0, seed=5, noise_scale=0.0)
SOFT = replace(CLEAN, soft_tissue_deg=1.0)
RATE_TOL_RAD_S = 1e-4  # truncation of the five-point difference at 200 Hz; the sensor noise is 3e-3
FORCE_TOL_M_S2 = 5e-3  # likewise for second differences; the sensor noise is 0.1


def matrices(q):
    """(N, 3, 3) sensor to earth from (N, 4)."""
    w, x, y, z = q.T
    return np.moveaxis(np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]), 2, 0)


def first_difference(f, h):
    """Five-point derivative; loses two samples at either end."""
    return (8 * (f[3:-1] - f[1:-3]) - (f[4:] - f[:-4])) / (12 * h)


def second_difference(f, h):
    return (16 * (f[3:-1] + f[1:-3]) - (f[4:] + f[:-4]) - 30 * f[2:-2]) / (12 * h * h)


def differenced_rate(q, h):
    """Body rate from R^T dR, which is [w]x."""
    r = matrices(q)
    skew = np.swapaxes(r[2:-2], 1, 2) @ first_difference(r, h)
    return np.stack([skew[:, 2, 1], skew[:, 0, 2], skew[:, 1, 0]], axis=1)


def kinematic_matrix(w, dw):
    """K(w, dw) as printed in OLS20 eq. (7)."""
    x, y, z = w.T
    a, b, c = dw.T
    return np.moveaxis(np.array([[-y * y - z * z, x * y - c, x * z + b],
                                 [x * y + c, -x * x - z * z, y * z - a],
                                 [x * z - b, y * z + a, -x * x - y * y]]), 2, 0)


def hinge_residual(rec):
    return (np.linalg.norm(np.cross(rec.gyr1, rec.axis1), axis=1)
            - np.linalg.norm(np.cross(rec.gyr2, rec.axis2), axis=1))


def rms(values):
    return float(np.sqrt(np.mean(np.asarray(values) ** 2)))


class Consistency(unittest.TestCase):
    def test_gyroscopes_are_the_rate_of_the_orientations_soft_tissue_included(self):
        for spec in (CLEAN, SOFT):
            rec = simulate_hinge(spec)
            for q, gyr in ((rec.q1, rec.gyr1), (rec.q2, rec.gyr2)):
                error = differenced_rate(q, 1 / spec.rate_hz) - gyr[2:-2]
                self.assertLess(np.abs(error).max(), RATE_TOL_RAD_S)

    def test_quaternions_are_unit(self):
        rec = simulate_hinge(SOFT)
        for q in (rec.q1, rec.q2):
            np.testing.assert_allclose(np.linalg.norm(q, axis=1), 1.0, atol=1e-12)

    def test_hinge_constraint_holds_exactly_without_disturbances(self):
        self.assertLess(np.abs(hinge_residual(simulate_hinge(CLEAN))).max(), 1e-9)

    def test_both_axes_are_the_same_direction_in_earth_with_the_same_sign(self):
        rec = simulate_hinge(CLEAN)
        np.testing.assert_allclose(matrices(rec.q1) @ rec.axis1, matrices(rec.q2) @ rec.axis2, atol=1e-12)

    def test_joint_angle_is_the_difference_of_the_rates_about_the_axis(self):
        rec = simulate_hinge(CLEAN)
        rate = rec.gyr2 @ rec.axis2 - rec.gyr1 @ rec.axis1
        error = first_difference(rec.theta, 1 / CLEAN.rate_hz) - rate[2:-2]
        self.assertLess(np.abs(error).max(), RATE_TOL_RAD_S)

    def test_accelerometers_are_joint_acceleration_gravity_and_the_lever_arms_motion(self):
        # OLS20 eq. (4) and (5): what is left after the sensor's motion about the joint is common.
        rec = simulate_hinge(CLEAN)
        h = 1 / CLEAN.rate_hz
        common = []
        for q, acc, r in ((rec.q1, rec.acc1, rec.r1), (rec.q2, rec.acc2, rec.r2)):
            rotation = matrices(q)
            force = np.einsum("nij,nj->ni", rotation, acc)
            common.append(force[2:-2] - second_difference(rotation @ r, h))
        np.testing.assert_allclose(common[0], common[1], atol=FORCE_TOL_M_S2)
        a0 = common[0] - [0.0, 0.0, GRAVITY_M_S2]
        ids = rec.motion_id[2:-2]
        self.assertLess(np.abs(a0[ids == 1]).max(), FORCE_TOL_M_S2)
        self.assertAlmostEqual(np.sqrt((a0[ids == 7] ** 2).sum(axis=1).mean()), CLEAN.a0_rms, delta=0.2)

    def test_exact_acceleration_constraint_of_the_paper_holds(self):
        # OLS20 eq. (17) with K as printed in (7).
        rec = simulate_hinge(CLEAN)
        sides = []
        for gyr, acc, axis, r in ((rec.gyr1, rec.acc1, rec.axis1, rec.r1), (rec.gyr2, rec.acc2, rec.axis2, rec.r2)):
            k = kinematic_matrix(gyr[2:-2], first_difference(gyr, 1 / CLEAN.rate_hz))
            sides.append((acc[2:-2] @ axis, k @ r @ axis))
        (a1, k1), (a2, k2) = sides
        self.assertGreater(np.abs(a1 - a2).max(), 0.1)  # the approximate constraint (18) does not hold
        np.testing.assert_allclose(a1 - a2, k1 - k2, atol=FORCE_TOL_M_S2)

    def test_no_signal_jumps_in_the_transitions(self):
        spec = HingeSpec(motions=scenario(2, 6.0), noise_scale=0.0, soft_tissue_deg=0.5, rate_hz=200.0)
        rec = simulate_hinge(spec)
        for signal in (rec.gyr1, rec.gyr2, rec.acc1, rec.acc2):
            steps = np.linalg.norm(np.diff(signal, axis=0), axis=1)
            inside = (rec.motion_id[1:] == 13) | (rec.motion_id[1:] == 14)
            self.assertLess(steps[rec.motion_id[1:] == 0].max(), 3 * steps[inside].max())


class Disturbances(unittest.TestCase):
    def test_noise_and_bias_have_the_stated_size(self):
        spec = HingeSpec(motions=(("7", 40.0),), noise_scale=2.0, acc_bias=0.3, gyr_bias_deg_s=1.0)
        rec = simulate_hinge(spec)
        clean = simulate_hinge(replace(spec, noise_scale=0.0, acc_bias=0.0, gyr_bias_deg_s=0.0))
        for name, std, bias in (("gyr", 2 * GYR_STD_RAD_S, np.radians(1.0)), ("acc", 2 * ACC_STD_M_S2, 0.3)):
            for sensor in "12":
                error = getattr(rec, name + sensor) - getattr(clean, name + sensor)
                self.assertAlmostEqual(error.std(axis=0).mean() / std, 1.0, delta=0.05)
                self.assertAlmostEqual(np.linalg.norm(error.mean(axis=0)) / bias, 1.0, delta=0.05)

    def test_soft_tissue_turns_the_sensor_by_the_stated_rms(self):
        still = HingeSpec(motions=(("7", 40.0),), noise_scale=0.0)
        for ratio, factor in ((0.0, 1.0), (1.0, 2.0 ** 0.5)):
            moved = simulate_hinge(replace(still, soft_tissue_deg=0.8, inertia_ratio=ratio))
            for a, b in ((moved.q1, simulate_hinge(still).q1), (moved.q2, simulate_hinge(still).q2)):
                angle = 2 * np.arccos(np.clip(np.abs((a * b).sum(axis=1)), 0.0, 1.0))
                # Below the nominal value: the random part is smaller while the bone is slow.
                self.assertGreater(np.degrees(rms(angle)), 0.7 * 0.8 * factor)
                self.assertLess(np.degrees(rms(angle)), 1.15 * 0.8 * factor)
            self.assertGreater(rms(hinge_residual(moved)), 0.01)

    def test_soft_tissue_is_almost_quiet_at_rest(self):
        rec = simulate_hinge(HingeSpec(motions=(("rest", 20.0),), noise_scale=0.0, soft_tissue_deg=1.0))
        self.assertGreater(rms(rec.gyr1), 0.0)
        self.assertLess(rms(rec.gyr1), 0.03)

    def test_wobble_turns_the_axis_by_the_stated_rms_and_zero_is_planar(self):
        for name, elevation_deg in (("5", 0.0), ("6", 45.0)):
            for wobble_deg in (0.0, 3.0):
                rec = simulate_hinge(HingeSpec(motions=((name, 40.0),), noise_scale=0.0, wobble_deg=wobble_deg))
                axis = matrices(rec.q1) @ rec.axis1
                mean = axis.mean(axis=0) / np.linalg.norm(axis.mean(axis=0))
                self.assertAlmostEqual(np.degrees(np.arcsin(mean[2])), elevation_deg, delta=0.05 + wobble_deg)
                wander = np.degrees(rms(np.linalg.norm(axis - mean, axis=1)))
                self.assertLess(wander, wobble_deg * 1.1 + 1e-9)
                self.assertGreaterEqual(wander, wobble_deg * 0.6)


class Motions(unittest.TestCase):
    def test_every_motion_turns_what_it_should(self):
        for name, motion in MOTIONS.items():
            rec = simulate_hinge(HingeSpec(motions=((name, 20.0),), noise_scale=0.0, wobble_deg=0.0, seed=3))
            turns = [rms(np.linalg.norm(gyr, axis=1)) for gyr in (rec.gyr1, rec.gyr2)]
            self.assertEqual(set(rec.motion_id), {motion.id})
            self.assertEqual(turns[0] > 0.3, motion.turn1 > 0 or motion.axis > 0, name)
            self.assertEqual(turns[1] > 0.3, motion.turn2 > 0, name)
            joint_moves = np.ptp(rec.theta) > 1e-9
            self.assertEqual(joint_moves, (motion.turn1 > 0 or motion.turn2 > 0) and not motion.stiff, name)
            if motion.fast and motion.turn2:
                self.assertGreater(max(turns), 2.5)

    def test_sequential_motion_turns_segment_1_then_segment_2(self):
        rec = simulate_hinge(HingeSpec(motions=(("3", 20.0),), noise_scale=0.0, wobble_deg=0.0, rate_hz=50.0))
        half = slice(0, 500), slice(550, None)
        for moving, still, part in ((rec.gyr1, rec.gyr2, half[0]), (rec.gyr2, rec.gyr1, half[1])):
            self.assertGreater(rms(moving[part]), 0.3)
            self.assertLess(np.abs(still[part]).max(), 1e-12)
        self.assertEqual(set(rec.motion_id), {3})

    def test_scenarios_have_the_papers_sequences(self):
        ids = {1: [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14],
               2: [1, 3, 10, 8, 2, 9, 3, 10, 4, 11, 5, 12, 6, 13, 7, 14],
               3: [6, 1, 8, 2, 9], 4: [1, 8, 2, 9, 6, 2, 9]}
        for number, expected in ids.items():
            spec = HingeSpec(motions=scenario(number, 6.0), rate_hz=50.0, keep_transitions=False)
            rec = simulate_hinge(spec)
            changes = np.flatnonzero(np.diff(rec.motion_id)) + 1
            self.assertEqual([int(k) for k in rec.motion_id[np.r_[0, changes]]], expected)
            if number == 3:
                self.assertEqual(np.count_nonzero(rec.motion_id == 6), 1000)
            if number == 2:
                self.assertEqual(changes[1] - changes[0], 500)
            np.testing.assert_allclose(np.diff(rec.t_s), 0.02, atol=1e-12)

    def test_joint_never_moves_in_a_sequence_of_rest_and_stiff_motions(self):
        rec = simulate_hinge(HingeSpec(motions=(("1", 5.0), ("8", 5.0), ("2", 5.0), ("9", 5.0), ("stiff", 5.0))))
        self.assertLess(np.ptp(rec.theta), 1e-9)

    def test_unknown_motion_is_refused(self):
        for bad in ({"motions": (("21", 5.0),)}, {"rate_hz": 10.0}, {"motions": (("7", 0.1),)}):
            with self.assertRaises(ValueError):
                HingeSpec(**bad)


class Reproducibility(unittest.TestCase):
    def test_the_seed_decides_everything(self):
        spec = HingeSpec(soft_tissue_deg=0.5, acc_bias=0.1, seed=7)
        first, again, other = simulate_hinge(spec), simulate_hinge(spec), simulate_hinge(replace(spec, seed=8))
        self.assertTrue(np.array_equal(first.acc2, again.acc2))
        self.assertFalse(np.allclose(first.axis1, other.axis1))
        self.assertFalse(np.allclose(first.gyr1, other.gyr1))

    def test_another_rate_samples_the_same_motion(self):
        slow, fast = (simulate_hinge(HingeSpec(motions=(("7", 20.0),), rate_hz=rate)) for rate in (50.0, 200.0))
        np.testing.assert_allclose(slow.theta, fast.theta[::4], atol=0.01 * np.ptp(fast.theta))

    def test_a_minute_at_100_hz_takes_milliseconds(self):
        spec = HingeSpec(motions=(("7", 60.0),), soft_tissue_deg=0.5)
        times = []
        for _ in range(3):
            start = time.perf_counter()
            simulate_hinge(spec)
            times.append(time.perf_counter() - start)
        self.assertLess(min(times), 0.1)  # 8 ms on the developers' machine; loaded machines are slower


class Files(unittest.TestCase):
    def test_a_recording_survives_the_file(self):
        rec = simulate_hinge(HingeSpec(motions=(("7", 2.0),)))
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "x.csv"
            write_csv(path, rec, digits=17)
            back = load_csv(path)
        for name in ("t_s", "gyr1", "acc1", "gyr2", "acc2"):
            self.assertTrue(np.array_equal(getattr(rec, name), getattr(back, name)), name)

    def test_columns_are_found_by_name_and_empty_cells_are_nan(self):
        names = ["acc2_z", "extra", "t_s"] + [f"{s}_{a}" for s in ("gyr2", "gyr1", "acc1", "acc2") for a in "xyz"
                                              if (s, a) != ("acc2", "z")]
        rows = [[str(100 * row + column) for column in range(len(names))] for row in range(3)]
        rows[1][4] = ""
        rows[2][5] = "nan"
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "x.csv"
            path.write_bytes("\r\n".join([",".join(names), *map(",".join, rows), ""]).encode())
            rec = load_csv(path)
            path.write_text("t_s,gyr1_x\n0,0\n")
            with self.assertRaises(ValueError):
                load_csv(path)
        self.assertEqual(rec.acc2[0, 2], 0.0)
        self.assertEqual(rec.t_s[2], 202.0)
        self.assertEqual(rec.columns["extra"][0], 1.0)
        self.assertTrue(np.isnan(rec.gyr2[1, 1]) and np.isnan(rec.gyr2[2, 2]))
        self.assertEqual(rec.finite().tolist(), [0])


if __name__ == "__main__":
    unittest.main()
