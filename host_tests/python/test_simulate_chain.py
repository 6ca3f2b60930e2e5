"""The simulated chain is checked against its orientations and its truth, never against its own formulas."""

import json
import sys
import unittest
from dataclasses import replace
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

import exact_joint as exact  # noqa: E402
from jointcal_tools.recordings import IMU_COLUMNS  # noqa: E402
from jointcal_tools.simulate import ACC_STD_M_S2, GYR_STD_RAD_S  # noqa: E402
from jointcal_tools.simulate_chain import RATES, ChainSpec, simulate_chain  # noqa: E402
from test_simulate import (  # noqa: E402
    FORCE_TOL_M_S2, RATE_TOL_RAD_S, differenced_rate, first_difference, matrices, rms, second_difference)

CLEAN = ChainSpec(type=2, seconds=20.0, rate_hz=200.0, seed=3, noise_scale=0.0, same_heading=True)
H = 1.0 / CLEAN.rate_hz
TYPES = (1, 2)
PELVIS, THIGH, SHANK = range(3)


def earth_force_at(rec, sensor, r):
    """(N - 4, 3): what is felt where the vector r (3,) from there to the sensor begins, in the sensor's earth frame.

    Of the sensor's acceleration, the second difference of R r is what its motion about that point adds.
    """
    turn = matrices(rec.q[sensor])
    return np.einsum("nij,nj->ni", turn, rec.acc[sensor])[2:-2] - second_difference(turn @ r, H)


def force_by_k(rec, sensor, r):
    """The same by a - K r, in the sensor's earth frame."""
    k = exact.printed_k(rec.gyr[sensor][2:-2], first_difference(rec.gyr[sensor], H))
    return np.einsum("nij,nj->ni", matrices(rec.q[sensor])[2:-2], rec.acc[sensor][2:-2] - k @ r)


def turn_between(q, p):
    """(N,) rad: angle between orientations."""
    return 2.0 * np.arccos(np.clip(np.abs((q * p).sum(axis=1)), 0.0, 1.0))


class Consistency(unittest.TestCase):
    def test_gyroscopes_are_the_rate_of_the_orientations_soft_tissue_included(self):
        for kind in TYPES:
            for soft_tissue_deg in (0.0, 1.0):
                rec = simulate_chain(replace(CLEAN, type=kind, soft_tissue_deg=soft_tissue_deg, same_heading=False))
                for q, gyr in zip(rec.q, rec.gyr, strict=True):
                    np.testing.assert_allclose(np.linalg.norm(q, axis=1), 1.0, atol=1e-12)
                    self.assertLess(np.abs(differenced_rate(q, H) - gyr[2:-2]).max(), RATE_TOL_RAD_S)

    def test_both_sensors_of_a_joint_see_the_same_force_there(self):
        for kind in TYPES:
            rec = simulate_chain(replace(CLEAN, type=kind))
            for force in (earth_force_at, force_by_k):
                at_hip = force(rec, PELVIS, rec.hip_to_pelvis), force(rec, THIGH, rec.hip_to_thigh)
                at_knee = force(rec, THIGH, rec.knee_to_thigh), force(rec, SHANK, rec.knee_to_shank)
                for one, other in (at_hip, at_knee):
                    np.testing.assert_allclose(one, other, atol=FORCE_TOL_M_S2)
                # Another point would not do: ten times the tolerance if it is 2 cm away.
                elsewhere = force(rec, SHANK, rec.knee_to_shank + [0.02, 0.0, 0.0])
                self.assertGreater(np.abs(elsewhere - at_knee[0]).max(), 10.0 * FORCE_TOL_M_S2)

    def test_the_hip_feels_gravity_and_the_stated_acceleration(self):
        for a0_rms in (0.0, 0.8):
            rec = simulate_chain(replace(CLEAN, a0_rms=a0_rms))
            a0 = earth_force_at(rec, PELVIS, rec.hip_to_pelvis) - exact.GRAVITY
            self.assertAlmostEqual(np.sqrt((a0**2).sum(axis=1).mean()), a0_rms, delta=0.01 * a0_rms + FORCE_TOL_M_S2)

    def test_the_knee_moves_with_the_thigh(self):
        rec = simulate_chain(CLEAN)
        knee = matrices(rec.q[THIGH]) @ (rec.hip_to_thigh - rec.knee_to_thigh)  # from the hip, earth
        added = earth_force_at(rec, SHANK, rec.knee_to_shank) - earth_force_at(rec, PELVIS, rec.hip_to_pelvis)
        np.testing.assert_allclose(added, second_difference(knee, H), atol=FORCE_TOL_M_S2)
        self.assertGreater(rms(added), 0.5)

    def test_the_thigh_has_its_length_and_the_levers_theirs(self):
        for thigh_m in (0.38, 0.42):
            for seed in range(5):
                rec = simulate_chain(replace(CLEAN, seconds=2.0, thigh_m=thigh_m, seed=seed, lever_m=(0.1, 0.2)))
                self.assertAlmostEqual(np.linalg.norm(rec.hip_to_thigh - rec.knee_to_thigh), thigh_m, places=12)
                for r in (rec.hip_to_pelvis, rec.hip_to_thigh, rec.knee_to_shank):
                    self.assertTrue(0.1 <= np.linalg.norm(r) <= 0.2)
                np.testing.assert_array_equal(rec.places(), [rec.hip_to_pelvis, rec.hip_to_thigh, rec.knee_to_thigh, rec.knee_to_shank])

    def test_the_thigh_is_across_the_axes_of_flexion(self):
        for seed in range(5):
            rec = simulate_chain(replace(CLEAN, seconds=2.0, seed=seed))
            thigh = rec.hip_to_thigh - rec.knee_to_thigh
            for axis in (rec.hip_axis, rec.knee_axis, rec.knee_axis_shank):
                self.assertAlmostEqual(np.linalg.norm(axis), 1.0, places=12)
            np.testing.assert_allclose([thigh @ rec.hip_axis, thigh @ rec.knee_axis], 0.0, atol=1e-12)


class Motion(unittest.TestCase):
    def knee_rate(self, rec):
        """(N, 3): rate of the shank against the thigh, earth."""
        w = [np.einsum("nij,nj->ni", matrices(q), gyr) for q, gyr in zip(rec.q, rec.gyr, strict=True)]
        return w[SHANK] - w[THIGH]

    def test_the_knee_of_type_1_is_a_hinge_about_its_axis(self):
        rec = simulate_chain(replace(CLEAN, type=1))
        axes = matrices(rec.q[THIGH]) @ rec.knee_axis, matrices(rec.q[SHANK]) @ rec.knee_axis_shank
        np.testing.assert_allclose(*axes, atol=1e-12)
        rate = self.knee_rate(rec)
        along = (rate * axes[0]).sum(axis=1)
        np.testing.assert_allclose(rate, along[:, None] * axes[0], atol=1e-12)
        self.assertAlmostEqual(rms(along), RATES[1][6], places=9)

    def test_the_knee_of_type_2_is_none(self):
        rec = simulate_chain(CLEAN)
        rate = self.knee_rate(rec)
        spread = np.linalg.svd(rate / np.sqrt(len(rate)))[1]  # rms along its principal directions
        self.assertGreater(spread[2], 0.8)
        axes = matrices(rec.q[THIGH]) @ rec.knee_axis, matrices(rec.q[SHANK]) @ rec.knee_axis_shank
        self.assertGreater(np.abs(axes[0] - axes[1]).max(), 0.1)

    def test_type_2_is_livelier_and_speed_scales_both(self):
        for index in range(3):
            sizes = [rms(simulate_chain(replace(CLEAN, type=kind)).gyr[index]) for kind in TYPES]
            self.assertGreater(sizes[1], 1.3 * sizes[0])
        for kind in TYPES:
            slow, fast = (simulate_chain(replace(CLEAN, type=kind, speed=speed)) for speed in (0.5, 1.0))
            ratios = [rms(f) / rms(s) for s, f in zip(slow.gyr, fast.gyr, strict=True)]
            self.assertLess(np.abs(np.array(ratios) - 2.0).max(), 0.5)

    def test_another_rate_samples_the_same_motion(self):
        slow, fast = (simulate_chain(replace(CLEAN, rate_hz=rate)) for rate in (50.0, 200.0))
        np.testing.assert_allclose(slow.t_s, fast.t_s[::4], atol=1e-12)
        for s, f in zip(slow.q, fast.q, strict=True):
            self.assertLess(turn_between(s, f[::4]).max(), 0.02)
        np.testing.assert_allclose(slow.places(), fast.places(), atol=1e-12)


class Disturbances(unittest.TestCase):
    def test_noise_and_biases_have_the_stated_size(self):
        spec = replace(CLEAN, noise_scale=2.0, acc_bias=0.3, gyr_bias_deg_s=1.0)
        rec, clean = simulate_chain(spec), simulate_chain(CLEAN)
        for kind, std, bias in (("gyr", 2.0 * GYR_STD_RAD_S, np.radians(1.0)), ("acc", 2.0 * ACC_STD_M_S2, 0.3)):
            means = []
            for noisy, exact_ones in zip(getattr(rec, kind), getattr(clean, kind), strict=True):
                error = noisy - exact_ones
                self.assertAlmostEqual(error.std(axis=0).mean() / std, 1.0, delta=0.05)
                self.assertAlmostEqual(np.linalg.norm(error.mean(axis=0)) / bias, 1.0, delta=0.05)
                means.append(error.mean(axis=0) / bias)
            self.assertGreater(np.linalg.norm(means[0] - means[1]), 0.1)  # each sensor has its own
            self.assertGreater(np.linalg.norm(means[1] - means[2]), 0.1)

    def test_each_earth_frame_is_turned_about_the_vertical_only(self):
        common, own = simulate_chain(CLEAN), simulate_chain(replace(CLEAN, same_heading=False))
        angles = []
        for k in range(3):
            np.testing.assert_array_equal(common.gyr[k], own.gyr[k])
            np.testing.assert_array_equal(common.acc[k], own.acc[k])
            turn = matrices(own.q[k]) @ np.swapaxes(matrices(common.q[k]), 1, 2)
            angle = np.arctan2(turn[0, 1, 0], turn[0, 0, 0])
            np.testing.assert_allclose(turn, np.broadcast_to(exact.about_z(angle), turn.shape), atol=1e-9)
            angles.append(angle)
        self.assertGreater(np.abs(np.diff(angles)).min(), 0.05)

    def test_orientations_err_by_the_stated_rms_and_signals_do_not(self):
        spec = replace(CLEAN, seconds=60.0, orientation_deg=2.0)
        right, wrong = simulate_chain(replace(spec, orientation_deg=0.0)), simulate_chain(spec)
        for k in range(3):
            np.testing.assert_array_equal(right.acc[k], wrong.acc[k])
            error = np.degrees(turn_between(right.q[k], wrong.q[k]))
            self.assertAlmostEqual(rms(error), 2.0, delta=0.05)
            self.assertLess(np.abs(np.diff(error)).max() * spec.rate_hz, 20.0)  # deg/s: it wanders, it does not jump

    def test_soft_tissue_turns_each_sensor_and_leaves_places_and_axes(self):
        hard, soft = simulate_chain(CLEAN), simulate_chain(replace(CLEAN, soft_tissue_deg=0.8, inertia_ratio=0.0))
        for name in ("hip_axis", "knee_axis", "knee_axis_shank"):
            np.testing.assert_array_equal(getattr(hard, name), getattr(soft, name))
        np.testing.assert_array_equal(hard.places(), soft.places())
        for k in range(3):
            angle = np.degrees(rms(turn_between(hard.q[k], soft.q[k])))
            self.assertTrue(0.7 * 0.8 < angle < 1.15 * 0.8)


class Recordings(unittest.TestCase):
    def test_the_seed_decides_everything(self):
        spec = replace(CLEAN, seconds=5.0, noise_scale=1.0, soft_tissue_deg=0.5, acc_bias=0.1, orientation_deg=1.0,
                       same_heading=False)
        first, again, other = simulate_chain(spec), simulate_chain(spec), simulate_chain(replace(spec, seed=4))
        for kind in ("gyr", "acc", "q"):
            for a, b, c in zip(getattr(first, kind), getattr(again, kind), getattr(other, kind), strict=True):
                np.testing.assert_array_equal(a, b)
                self.assertFalse(np.allclose(a, c))
        self.assertEqual(first.truth(), again.truth())
        self.assertFalse(np.allclose(first.places(), other.places()))

    def test_truth_survives_json_and_names_what_is_true(self):
        spec = replace(CLEAN, seconds=2.0, thigh_m=0.39)
        rec = simulate_chain(spec)
        truth = json.loads(json.dumps(rec.truth()))
        names = ("hip_to_pelvis_m", "hip_to_thigh_m", "knee_to_thigh_m", "knee_to_shank_m")
        np.testing.assert_array_equal([truth[name] for name in names], rec.places())
        np.testing.assert_array_equal([truth["joint_to_sensor1_m"], truth["joint_to_sensor2_m"]], rec.places()[:2])
        np.testing.assert_array_equal([truth["knee_axis_thigh"], truth["knee_axis_shank"]], [rec.knee_axis, rec.knee_axis_shank])
        self.assertEqual((truth["segment_length_m"], truth["rate_hz"]), (0.39, 200.0))
        # Enough to simulate it again; levers that are not given are not there.
        self.assertNotIn("r1", truth["spec"])
        back = ChainSpec(**{**truth["spec"], "lever_m": tuple(truth["spec"]["lever_m"])})
        self.assertEqual(back, spec)

    def test_columns_hold_the_right_sensors(self):
        rec = simulate_chain(replace(CLEAN, seconds=1.0))
        two, third, turns = rec.first_two(), rec.third_columns(), rec.orientation_columns()
        self.assertEqual(len(rec.t_s), 200)
        for found, expected in ((two.gyr1, rec.gyr[PELVIS]), (two.acc1, rec.acc[PELVIS]), (two.gyr2, rec.gyr[THIGH]),
                                (two.acc2, rec.acc[THIGH])):
            np.testing.assert_array_equal(found, expected)
        self.assertEqual(list(third), [name.replace("2", "3") for name in IMU_COLUMNS[6:]])
        np.testing.assert_array_equal(third["gyr3_y"], rec.gyr[SHANK][:, 1])
        np.testing.assert_array_equal(third["acc3_z"], rec.acc[SHANK][:, 2])
        self.assertEqual(len(turns), 12)
        np.testing.assert_array_equal(turns["q1_w"], rec.q[PELVIS][:, 0])
        np.testing.assert_array_equal(turns["q3_z"], rec.q[SHANK][:, 3])


if __name__ == "__main__":
    unittest.main()
