"""The float64 reference of OLS17 against cross products, differences, exact joints, the simulator and real recordings."""

import json
import os
import sys
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

import exact_joint as exact  # noqa: E402
from jointcal_tools import ols17  # noqa: E402
from jointcal_tools import quaternions as quat  # noqa: E402
from jointcal_tools.recordings import Recording, load_csv  # noqa: E402
from jointcal_tools.simulate_two_dof import TwoDofSpec, simulate_two_dof  # noqa: E402

DATA = Path(os.environ.get("JOINTCAL_DATA", ROOT / "data"))
R1, R2 = np.array([-0.12, 0.03, 0.02]), np.array([0.15, -0.01, 0.04])
BIAS1, BIAS2 = np.array([0.1, -0.2, 0.05]), np.array([-0.15, 0.02, 0.1])
TRUTH = np.concatenate([R1, R2])
CLEAN = TwoDofSpec(motions=(("three_dof", 20.0),), rate_hz=50.0, seed=3, noise_scale=0.0)


def exact_samples(n=200, seed=0, bias1=0.0, bias2=0.0):
    """Samples of a ball joint without any error but biases, each sensor in its own frame; and both turns to earth."""
    rng = np.random.default_rng(seed)
    force = exact.joint_force(rng, n)
    (a1, k1, to_earth1), (a2, k2, to_earth2) = exact.sensor(rng, force, R1), exact.sensor(rng, force, R2)
    own = np.broadcast_to(np.eye(3), k1.shape)
    return ols17.Samples(0.02 * np.arange(n), a1 + bias1, k1, own, a2 + bias2, k2, own), to_earth1, to_earth2


def error_m(fit):
    return np.linalg.norm(np.concatenate([fit.r1, fit.r2]) - TRUTH)


def with_outliers(s, share, size, seed=1):
    """`share` of sensor 1's readings knocked along what it feels, so that the knocks do not cancel."""
    rng = np.random.default_rng(seed)
    hit = rng.choice(len(s), round(share * len(s)), replace=False)
    a1 = s.a1.copy()
    a1[hit] += size * a1[hit] / np.linalg.norm(a1[hit], axis=1)[:, None]
    return ols17.Samples(s.t_s, a1, s.k1, s.turn1, s.a2, s.k2, s.turn2)


class Kinematics(unittest.TestCase):
    def setUp(self):
        self.rng = np.random.default_rng(0)

    def test_k_times_r_is_what_turning_adds(self):
        w, dw, r = self.rng.standard_normal((3, 50, 3))
        k = ols17.k_matrix(w, dw)
        np.testing.assert_allclose(np.einsum("nij,nj->ni", k, r), exact.felt_at(np.zeros((50, 3)), w, dw, r), atol=1e-13)
        np.testing.assert_allclose(k, exact.printed_k(w, dw), atol=1e-13)

    def test_rotation_of_a_vector_about_an_axis(self):
        quarter = ols17.rotation(np.array([[0.0, 0.0, np.pi / 2.0]]))[0]
        np.testing.assert_allclose(quarter @ [1.0, 2.0, 3.0], [-2.0, 1.0, 3.0], atol=1e-14)
        vectors = np.concatenate([self.rng.standard_normal((20, 3)), 1e-9 * self.rng.standard_normal((5, 3)), np.zeros((1, 3))])
        turns = ols17.rotation(vectors)
        np.testing.assert_allclose(turns @ np.swapaxes(turns, 1, 2), np.broadcast_to(np.eye(3), turns.shape), atol=1e-14)
        np.testing.assert_allclose(np.einsum("nij,nj->ni", turns, vectors), vectors, atol=1e-14)
        np.testing.assert_allclose(turns @ turns, ols17.rotation(2.0 * vectors), atol=1e-13)

    def test_derivatives_of_a_sine_are_off_by_what_the_quotients_leave(self):
        # sin(p (t + h)) - sin(p (t - h)) = 2 cos(p t) sin(p h): both quotients are p cos(p t) times a known factor.
        h, p = 0.02, 9.0
        t = h * np.arange(100)
        wave, slope = np.sin(p * t)[:, None] * [1.0, -2.0, 0.5], p * np.cos(p * t)[:, None] * [1.0, -2.0, 0.5]
        factors = {"symmetric": np.sin(p * h) / (p * h),
                   "five-point": (8.0 * np.sin(p * h) - np.sin(2.0 * p * h)) / (6.0 * p * h)}
        for kind, factor in factors.items():
            np.testing.assert_allclose(ols17.derivative(wave, h, kind)[2:-2], factor * slope[2:-2], atol=1e-11)
        self.assertLess(abs(factors["five-point"] - 1.0), 1e-4)
        self.assertGreater(abs(factors["symmetric"] - 1.0), 5e-3)

    def test_derivatives_are_exact_on_polynomials_of_their_order(self):
        t = np.linspace(-1.0, 1.0, 21)
        for kind, order in (("symmetric", 2), ("five-point", 4)):
            for power in range(order + 1):
                slope = power * t ** max(power - 1, 0)
                found = ols17.derivative(t[:, None] ** power, 0.1, kind)[2:-2, 0]
                np.testing.assert_allclose(found, slope[2:-2], atol=1e-13)
            with self.assertRaises(AssertionError):
                np.testing.assert_allclose(ols17.derivative(t[:, None] ** (order + 1), 0.1, kind)[2:-2, 0],
                                           (order + 1) * t[2:-2] ** order, atol=1e-5)

    def test_frames_follow_a_cubic_rate_exactly_and_the_mean_rate_over_holes(self):
        t = 0.02 * np.arange(41)
        rate, angle = 1.0 + t - 4.0 * t**2 + 9.0 * t**3, t + t**2 / 2.0 - 4.0 * t**3 / 3.0 + 9.0 * t**4 / 4.0
        axis = np.array([2.0, -1.0, 2.0]) / 3.0
        w, rows = rate[:, None] * axis, np.r_[2:20, 24:36]  # three rows lost: 0.1 s
        outer = w[rows - 2] + w[rows + 1]
        whole = np.concatenate([[False], np.diff(rows) == 1])
        frames, part = ols17.follow(t[rows], w[rows], outer, whole)
        over = 0.5 * (rate[24] + rate[19]) * (t[24] - t[19]) - (angle[24] - angle[19])
        turned = angle[rows] - angle[2] + np.where(rows >= 24, over, 0.0)
        np.testing.assert_allclose(frames, ols17.rotation(turned[:, None] * axis), atol=1e-12)
        self.assertEqual(set(part), {0})

    def test_a_long_hole_begins_anew(self):
        t, w = np.array([0.0, 0.02, 0.04, 0.36, 0.38]), np.ones((5, 3))
        frames, part = ols17.follow(t, w, 2.0 * w, np.array([False, True, True, False, True]))
        self.assertEqual(part.tolist(), [0, 0, 0, 1, 1])
        np.testing.assert_array_equal(frames[[0, 3]], [np.eye(3), np.eye(3)])
        np.testing.assert_allclose(frames[4], ols17.rotation(np.full((1, 3), 0.02))[0], atol=1e-14)

    def test_blocks_by_hand(self):
        values = np.arange(11.0)  # means of two: 0.5, 2.5, 4.5, 6.5, 8.5; the eleventh is left over
        part = np.zeros(11, int)
        np.testing.assert_allclose(ols17.blocks(values, part, 2), [3.5, 5.5])
        np.testing.assert_allclose(ols17.blocks(np.array([0.0, 8.0, 0.0, 0.0]), np.zeros(4, int), 1), [3.0])
        np.testing.assert_allclose(ols17.blocks(values, np.repeat([0, 1], [4, 7]), 1), [1.5, 5.5, 6.5, 7.5, 8.5])


class Preparation(unittest.TestCase):
    def test_runs_end_at_repeated_readings_holes_and_nan(self):
        rng = np.random.default_rng(2)
        t = 0.02 * np.arange(60)
        t[40:] += 0.03  # a step of two and a half
        imu = rng.standard_normal((4, 60, 3))
        imu[2:, 10] = imu[2:, 9]  # sensor 2 repeats
        imu[0, 25, 1] = np.nan
        # A row is left out with what is wrong; the first row of a run too, as it only tells the run's rate.
        expected = [slice(1, 10), slice(12, 25), slice(27, 40), slice(41, 60)]
        self.assertEqual(ols17.usable_runs(Recording(t, *imu)), expected)

    def test_without_smoothing_the_rows_are_those_of_the_recording(self):
        rec = simulate_two_dof(CLEAN)
        for kind in ols17.DERIVATIVES:
            s = ols17.prepare(rec, kind, smoothing_s=0.0)
            rows = np.round(s.t_s * CLEAN.rate_hz).astype(int)
            # One row tells the run's rate, two on either side are for the derivative.
            np.testing.assert_array_equal(rows, np.arange(3, len(rec) - 2))
            for acc, gyr, a, k in ((rec.acc1, rec.gyr1, s.a1, s.k1), (rec.acc2, rec.gyr2, s.a2, s.k2)):
                np.testing.assert_array_equal(a, acc[rows])
                near = [gyr[rows + step] for step in (-2, -1, 1, 2)]
                dw = (near[2] - near[1]) * (CLEAN.rate_hz / 2.0)
                if kind == "five-point":
                    dw = (8.0 * (near[2] - near[1]) - (near[3] - near[0])) * (CLEAN.rate_hz / 12.0)
                np.testing.assert_allclose(k, exact.printed_k(gyr[rows], dw), atol=1e-12)

    def test_smoothing_takes_both_sensors_into_frames_that_do_not_turn(self):
        rec = simulate_two_dof(CLEAN)
        dt, per_block = 1.0 / CLEAN.rate_hz, 3  # 0.24 s in four blocks
        s = ols17.prepare(rec, smoothing_s=0.24)
        frames = quat.matrices(quat.multiply(rec.earth1, rec.q1))
        turned = np.einsum("nij,nj->ni", frames, rec.acc1)[3:-2]
        means = turned[: len(turned) // per_block * per_block].reshape(-1, per_block, 3).mean(axis=1)
        smooth = (means[:-3] + 3.0 * means[1:-2] + 3.0 * means[2:-1] + means[3:]) / 8.0
        self.assertEqual(len(s), len(smooth))
        # The frame of the first row is that of the sensor then: one constant turn to earth, but for the drift of steps that
        # leave out dt^2/12 of w x dw: 4e-4 rad in 20 s at these rates, of 10 m/s^2.
        np.testing.assert_allclose(s.a1 @ frames[3].T, smooth, atol=1e-2)
        self.assertAlmostEqual(s.t_s[0], (3 + 5.5) * dt, places=9)

    def test_a_block_is_the_largest_whole_number_of_rows_or_one_more_if_nearly(self):
        rec = simulate_two_dof(CLEAN)
        for rows_wanted, rows in ((0.2, 1), (1.5, 1), (1.8, 2), (3.7, 3), (3.8, 4)):
            t_s = ols17.prepare(rec, smoothing_s=4.0 * rows_wanted / CLEAN.rate_hz).t_s
            np.testing.assert_allclose(np.diff(t_s), rows / CLEAN.rate_hz, atol=1e-9)

    def test_with_orientations_samples_are_in_earth_frames(self):
        rec = simulate_two_dof(CLEAN)
        turns = quat.matrices(rec.q1), quat.matrices(rec.q2)
        s = ols17.prepare(rec, smoothing_s=0.0, orientations=turns)
        np.testing.assert_allclose(s.a2, np.einsum("nij,nj->ni", turns[1], rec.acc2)[3:-2], atol=1e-12)
        np.testing.assert_array_equal(s.turn1, turns[0][3:-2])

    def test_slow_samples_are_left_out_on_request(self):
        rec = simulate_two_dof(CLEAN)
        limit = 2.0
        s = ols17.prepare(rec, smoothing_s=0.0, min_rate_rad_s=limit)
        inner = slice(3, -2)
        fast = np.maximum(np.linalg.norm(rec.gyr1[inner], axis=1), np.linalg.norm(rec.gyr2[inner], axis=1)) >= limit
        self.assertTrue(0 < np.count_nonzero(fast) < len(fast))
        np.testing.assert_array_equal(s.t_s, rec.t_s[inner][fast])


class Lengths(unittest.TestCase):
    def test_slopes_agree_with_central_differences(self):
        s = ols17.prepare(simulate_two_dof(CLEAN), smoothing_s=0.24)  # turns differ from one
        rng = np.random.default_rng(3)
        for _ in range(3):
            x = np.concatenate([rng.uniform(-0.3, 0.3, 6), rng.uniform(-0.5, 0.5, 6)])
            slopes = ols17.lengths(s, x)[1]
            numeric = exact.central_difference(lambda at: ols17.lengths(s, at)[0], x)
            np.testing.assert_allclose(slopes, numeric, atol=1e-6 * np.abs(slopes).max())

    def test_residual_by_hand(self):
        # The joint feels (0, 0, 10). Sensor 1 turns with 2 rad/s about x, 0.5 m along y: 2 m/s^2 inwards. Sensor 2 rests.
        eye = np.eye(3)[None]
        s = ols17.Samples(np.zeros(1), np.array([[0.0, -2.0, 10.0]]), exact.printed_k(np.array([[2.0, 0, 0]]), np.zeros((1, 3))),
                          eye, np.array([[0.0, 10.0, 0.0]]), np.zeros((1, 3, 3)), eye)
        x = np.zeros(12)
        self.assertAlmostEqual(ols17.lengths(s, x)[0][0], np.sqrt(104.0) - 10.0, places=12)
        x[1] = 0.5
        e, _, turn2 = ols17.lengths(s, x)
        self.assertAlmostEqual(e[0], 0.0, places=12)
        self.assertAlmostEqual(turn2[0], 4.0, places=12)
        x[10] = 1.0  # of sensor 2's 10 m/s^2 along y
        self.assertAlmostEqual(ols17.lengths(s, x)[0][0], 1.0, places=12)

    def test_exact_data_give_the_exact_centre_by_either_method_from_any_start(self):
        s = exact_samples()[0]
        rng = np.random.default_rng(4)
        for start in (None, TRUTH, *rng.uniform(-0.3, 0.3, (3, 6))):
            for absolute in (False, True):
                self.assertLess(error_m(ols17.solve_lengths(s, absolute=absolute, start=start)), 1e-6)

    def test_biases_are_found_where_they_are_unknowns_and_move_the_centre_where_not(self):
        s = exact_samples(bias1=BIAS1, bias2=BIAS2)[0]
        for absolute in (False, True):
            fit = ols17.solve_lengths(s, absolute=absolute, bias=1e5)  # a prior that says nothing
            self.assertLess(error_m(fit), 1e-6)
            np.testing.assert_allclose([fit.bias1, fit.bias2], [BIAS1, BIAS2], atol=1e-6)
        plain = ols17.solve_lengths(s)
        self.assertGreater(error_m(plain), 1e-3)
        self.assertEqual(np.abs([plain.bias1, plain.bias2]).max(), 0.0)

    def test_solution_is_the_minimum_of_its_cost(self):
        s = with_outliers(exact_samples(bias1=BIAS1)[0], 0.05, 1.0)
        for absolute, cost in ((False, lambda e: (e**2).sum()), (True, lambda e: np.abs(e).sum())):
            fit = ols17.solve_lengths(s, absolute=absolute)
            x = np.concatenate([fit.r1, fit.r2, np.zeros(6)])
            best = cost(fit.residuals)
            np.testing.assert_array_equal(fit.residuals, ols17.lengths(s, x)[0])
            rng = np.random.default_rng(5)
            for size in (1e-3, 1e-2, 1e-1):
                for step in rng.standard_normal((20, 6)):
                    self.assertGreater(cost(ols17.lengths(s, x + size * np.r_[step, np.zeros(6)])[0]), best)

    def test_prior_pulls_by_its_share_of_the_information(self):
        # One sensor turns about z, so only x and y of r1 are seen; what is not seen is the prior's.
        n, reach = 40, 0.3
        rng = np.random.default_rng(6)
        w, dw = np.zeros((2, n, 3))
        w[:, 2], dw[:, 2] = 2.0, 10.0 * rng.standard_normal(n)
        eye, force = np.broadcast_to(np.eye(3), (n, 3, 3)), exact.joint_force(rng, n)
        s = ols17.Samples(0.02 * np.arange(n), exact.felt_at(force, w, dw, R1), exact.printed_k(w, dw), eye,
                          force, np.zeros((n, 3, 3)), eye)
        fit = ols17.solve_lengths(s, reach_m=reach)
        self.assertEqual([fit.r1[2], *fit.r2], [0.0] * 4)
        e, slopes, _ = ols17.lengths(s, np.concatenate([fit.r1, np.zeros(9)]))
        np.testing.assert_allclose(slopes[:, :2].T @ e, -fit.r1[:2] / reach**2, rtol=1e-6)
        self.assertLess(np.linalg.norm(fit.r1), np.linalg.norm(R1[:2]))

    def test_weights_are_readings_over_the_variance_of_each_residual(self):
        # By hand: the slope of the loss of e / usual, once per reading, against the prior, times the residuals' excess.
        s = with_outliers(exact_samples()[0], 0.2, 1.0)
        noise, dt, reach = (0.05, 0.02), 0.02, 0.05
        for absolute, smoothing_s, reading_s in ((False, 0.12, 0.1), (True, 0.12, 0.1), (False, 0.6, 0.3), (True, 0.6, 0.3)):
            fit = ols17.solve_lengths(s, absolute=absolute, noise=noise, smoothing_s=smoothing_s, reach_m=reach)
            e, slopes, _ = ols17.lengths(s, np.concatenate([fit.r1, fit.r2, np.zeros(6)]))
            swing = [(np.einsum("nij,j->ni", k, r) ** 2).sum(axis=1) for k, r in ((s.k1, fit.r1), (s.k2, fit.r2))]
            usual = np.sqrt(noise[0] ** 2 + noise[1] ** 2 * sum(swing))
            self.assertTrue(np.any(np.abs(e) > usual) and np.any(np.abs(e) < usual))
            pull = np.clip(e / usual, -1.0, 1.0) / usual if absolute else e / usual**2  # Huber's loss, or squares
            excess = np.mean(pull * e)
            self.assertGreater(excess, 1.1)
            prior = excess * np.concatenate([fit.r1, fit.r2]) / reach**2
            np.testing.assert_allclose(dt / reading_s * slopes[:, :6].T @ pull, -prior, rtol=1e-5)

    def test_outliers_move_sa_less_than_ss(self):
        for share, size in ((0.02, 5.0), (0.05, 2.0), (0.1, 2.0)):
            s = with_outliers(exact_samples()[0], share, size)
            squares, absolute = ols17.solve_lengths(s), ols17.solve_lengths(s, absolute=True)
            self.assertGreater(error_m(squares), 1e-3)
            self.assertLess(error_m(absolute), 1e-4)  # the rest is exact, and most of all readings

    def test_simulated_motion_gives_the_centre_with_and_without_smoothing(self):
        rec = simulate_two_dof(CLEAN)
        for smoothing_s in (0.0, 0.12, 0.3):
            s = ols17.prepare(rec, smoothing_s=smoothing_s)
            for absolute in (False, True):
                fit = ols17.solve_lengths(s, absolute=absolute)
                apart = np.linalg.norm([fit.r1 - rec.r1, fit.r2 - rec.r2], axis=1)
                self.assertLess(apart.max(), 1e-3)


class Vectors(unittest.TestCase):
    def test_exact_data_give_the_exact_centre(self):
        s, to_earth1, to_earth2 = exact_samples()
        r1, r2 = ols17.solve_vectors(s, np.swapaxes(to_earth1, 1, 2) @ to_earth2)
        np.testing.assert_allclose(np.concatenate([r1, r2]), TRUTH, atol=1e-12)

    def test_a_heading_offset_must_be_taken_out(self):
        # Sensor 2's orientation is to an earth frame that is turned by -1.1 rad against that of sensor 1.
        s, to_earth1, to_earth2 = exact_samples()
        own2 = exact.about_z(-1.1) @ to_earth2
        right = np.swapaxes(to_earth1, 1, 2) @ exact.about_z(1.1) @ own2
        np.testing.assert_allclose(np.concatenate(ols17.solve_vectors(s, right)), TRUTH, atol=1e-12)
        wrong = np.swapaxes(to_earth1, 1, 2) @ own2
        self.assertGreater(np.abs(np.concatenate(ols17.solve_vectors(s, wrong)) - TRUTH).max(), 1e-3)

    def test_earth_frames_with_a_heading_offset_and_smoothing(self):
        rec = simulate_two_dof(CLEAN)
        s = ols17.prepare(rec, orientations=(quat.matrices(rec.q1), quat.matrices(rec.q2)))
        heading = exact.about_z(rec.delta[0])  # E2 to E1; no drift in this recording
        r1, r2 = ols17.solve_vectors(s, np.broadcast_to(heading, s.k2.shape))
        self.assertLess(np.linalg.norm([r1 - rec.r1, r2 - rec.r2], axis=1).max(), 1e-3)

    def test_noisy_solution_is_stationary(self):
        s, to_earth1, to_earth2 = exact_samples()
        turn = np.swapaxes(to_earth1, 1, 2) @ to_earth2
        s.a1[:] += np.random.default_rng(7).standard_normal(s.a1.shape)
        x = np.concatenate(ols17.solve_vectors(s, turn))

        def cost(at):
            e = s.a1 - s.k1 @ at[:3] - np.einsum("nij,nj->ni", turn, s.a2 - s.k2 @ at[3:])
            return np.array([(e**2).sum()])

        slope, scale = exact.central_difference(cost, x, 1e-4), exact.central_difference(cost, x + 0.1, 1e-4)
        self.assertLess(np.abs(slope).max(), 1e-6 * np.abs(scale).max())


@unittest.skipUnless((DATA / "rig_3D_01.csv").exists(), f"no recordings in {DATA.name}/; set JOINTCAL_DATA")
class RealRecordings(unittest.TestCase):
    def test_two_recordings_of_the_rig_agree_and_lie_near_what_was_measured(self):
        for absolute in (False, True):
            found = []
            for name in ("rig_3D_01", "rig_3D_02"):
                measured = json.loads((DATA / f"{name}.json").read_text())
                s = ols17.prepare(load_csv(DATA / f"{name}.csv"))
                fit = ols17.solve_lengths(s, absolute=absolute, bias=0.3, reach_m=0.3, noise=(0.05, 0.01))
                found.append(np.concatenate([fit.r1, fit.r2]))
                for sensor, r in ((1, fit.r1), (2, fit.r2)):
                    # docs/METHOD_CENTER.md section 6: the measured vectors are 5 % short.
                    self.assertLess(np.linalg.norm(r - measured[f"joint_to_sensor{sensor}_m"]), 0.02)
            self.assertLess(np.ptp(found, axis=0).max(), 4e-3)  # sd of one result 1 mm: 1.4 for a difference, thrice that


if __name__ == "__main__":
    unittest.main()
