"""The float64 reference of OLS20 against brute force, simulations with known truth and real recordings."""

import os
import sys
import unittest
from dataclasses import replace
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

from jointcal_tools import ols20  # noqa: E402
from jointcal_tools.recordings import load_csv  # noqa: E402
from jointcal_tools.simulate import HingeSpec, simulate_hinge  # noqa: E402

DATA = Path(os.environ.get("JOINTCAL_DATA", ROOT / "data"))
NOMINAL_TOL_DEG = 1.2  # how well the rig's sockets hold the sensors
FREE = HingeSpec(motions=(("7", 20.0),), rate_hz=50.0, seed=2)


def errors_deg(j1, j2, axis1, axis2):
    """Angular errors of both axes; the sign of the pair is free, the pairing is not (OLS20 7.2)."""
    sign = 1.0 if j1 @ axis1 >= 0.0 else -1.0
    return np.degrees([ols20.angular_deviation(sign * j1, axis1), ols20.angular_deviation(sign * j2, axis2)])


def problem_of(spec, **options):
    rec = simulate_hinge(spec)
    everything = np.arange(len(rec))
    return rec, ols20.make_problem(rec, everything, everything, **options)


class Estimation(unittest.TestCase):
    def test_jacobian_agrees_with_central_differences(self):
        rng = np.random.default_rng(0)
        for squared in (False, True):
            _, problem = problem_of(FREE, squared=squared)
            for _ in range(3):
                x = rng.uniform(-1.4, 1.4, 4)
                jacobian = ols20.residuals_and_jacobian(problem, x)[1]
                h = 1e-6
                numeric = np.stack([(ols20.residuals(problem, x + h * step) - ols20.residuals(problem, x - h * step))
                                    / (2 * h) for step in np.eye(4)], axis=1)
                np.testing.assert_allclose(jacobian, numeric, atol=1e-5 * np.abs(jacobian).max())

    def test_angles_invert_axes(self):
        rng = np.random.default_rng(1)
        j1, j2 = rng.standard_normal((2, 3))
        k1, k2 = ols20.axes(ols20.angles(j1, j2))
        np.testing.assert_allclose([k1, k2], [j1 / np.linalg.norm(j1), j2 / np.linalg.norm(j2)], atol=1e-12)
        m1, m2 = ols20.axes(ols20.opposite_pairing(ols20.angles(j1, j2)))
        np.testing.assert_allclose([m1, m2], [k1, -k2], atol=1e-12)

    def test_exact_planar_data_give_the_exact_axes(self):
        # With a fixed axis both constraints hold exactly, the approximate (18) too.
        rec, problem = problem_of(replace(FREE, motions=(("6", 20.0),), noise_scale=0.0, wobble_deg=0.0))
        found = ols20.solve(problem)
        self.assertLess(errors_deg(found.j1, found.j2, rec.axis1, rec.axis2).max(), 1e-4)
        self.assertLess(found.cost, 1e-9)

    def test_noisy_free_motion_gives_the_axes_whatever_the_start(self):
        rec, problem = problem_of(FREE)
        best = ols20.solve(problem)
        self.assertLess(errors_deg(best.j1, best.j2, rec.axis1, rec.axis2).max(), 0.5)
        wrong = ols20.solve(problem, start=(rec.axis1, -rec.axis2))
        np.testing.assert_allclose([abs(wrong.j1 @ best.j1), wrong.j1 @ best.j1 * (wrong.j2 @ best.j2)], 1.0,
                                   atol=1e-9)

    def test_minimum_is_stationary_and_no_random_start_is_better(self):
        _, problem = problem_of(FREE)
        best = ols20.solve(problem)
        e, jacobian = ols20.residuals_and_jacobian(problem, ols20.angles(best.j1, best.j2))
        self.assertLess(np.abs(jacobian.T @ e).max(), 1e-4 * np.sqrt((jacobian**2).sum() * (e**2).sum()))
        rng = np.random.default_rng(3)
        for _ in range(10):
            _, v, v_other = ols20.algorithm1(problem, ols20.angles(*rng.standard_normal((2, 3))))
            self.assertLessEqual(best.cost, v * (1 + 1e-9))
            self.assertLessEqual(v, v_other)

    def test_turning_a_sensor_turns_its_axis_also_to_the_pole(self):
        _, problem = problem_of(FREE)
        best = ols20.solve(problem)
        turn = ols20.turn_to_equator(best.j1)[[1, 2, 0]]  # takes j1 to +z, where the angles are singular
        turned = ols20.solve(problem._replace(gyr1=problem.gyr1 @ turn.T, acc1=problem.acc1 @ turn.T))
        self.assertLess(errors_deg(turned.j1, turned.j2, np.array([0.0, 0.0, 1.0]), best.j2).max(), 1e-5)
        self.assertAlmostEqual(turned.cost / best.cost, 1.0, places=9)

    def test_a_rate_along_its_axis_has_no_gradient_instead_of_nan(self):
        norm, gradient = ols20.perpendicular_rate(np.array([[0.0, 2.0, 0.0]]), np.array([0.0, 1.0, 0.0]))
        self.assertEqual(norm.tolist() + gradient.ravel().tolist(), [0.0] * 4)


class Selection(unittest.TestCase):
    def setUp(self):
        self.rec = simulate_hinge(HingeSpec(motions=(("1", 4.0), ("3", 10.0), ("7", 10.0)), rate_hz=50.0, seed=4))

    def test_scores_and_penalties_agree_with_brute_force(self):
        rec = self.rec
        delta = np.linalg.norm(rec.gyr1, axis=1) - np.linalg.norm(rec.gyr2, axis=1)
        for n in (ols20.HALF_WINDOW_PAPER, ols20.HALF_WINDOW_CODE):
            scores = ols20.gyro_scores(rec.gyr1, rec.gyr2, n)
            penalties = ols20.acc_penalties(rec.gyr1, rec.gyr2, n)
            for k in (0, 5, n, 400, len(rec) - n - 1, len(rec) - 1):
                near = delta[max(k - n, 0): k + n + 1]
                self.assertEqual(scores[k], near[np.argmin(np.abs(near))])
                if n <= k < len(rec) - n:  # (45) counts from 1
                    span = slice(k - n, k + n + 1)
                    expected = min((g[span] ** 2).sum() / (2 * n + 1) for g in (rec.gyr1, rec.gyr2))
                    self.assertAlmostEqual(penalties[k], expected, places=12)
                else:
                    self.assertEqual(penalties[k], np.inf)

    def test_gyroscope_selection_takes_half_from_either_end(self):
        rec = self.rec
        chosen = ols20.algorithm2(rec.gyr1, rec.gyr2, 200)
        scores = ols20.gyro_scores(rec.gyr1, rec.gyr2, ols20.HALF_WINDOW_PAPER)
        self.assertEqual(len(np.unique(chosen)), 200)
        left_out = np.delete(scores, chosen)
        self.assertEqual(np.count_nonzero(scores[chosen] >= left_out.max()), 100)
        self.assertEqual(np.count_nonzero(scores[chosen] <= left_out.min()), 100)
        self.assertEqual(len(ols20.algorithm2(rec.gyr1, rec.gyr2, 10**6)), len(rec))

    def test_followed_eigenvector_selects_what_the_svd_selects(self):
        fast = ols20.algorithm3(self.rec, 150)
        slow = ols20.algorithm3(self.rec, 150, svd=True)
        self.assertEqual(len(fast), 150)
        self.assertTrue(np.array_equal(fast, slow))

    def test_accelerometer_selection_keeps_only_quiet_samples(self):
        penalties = ols20.acc_penalties(self.rec.gyr1, self.rec.gyr2, ols20.HALF_WINDOW_PAPER)
        chosen = ols20.algorithm3(self.rec, 300)
        self.assertLessEqual(penalties[chosen].max(), ols20.E_TH)

    def test_each_removal_takes_the_largest_penalty_among_coherent_rows(self):
        rng = np.random.default_rng(5)
        acc1, acc2, penalties = rng.standard_normal((40, 3)), rng.standard_normal((40, 3)), rng.uniform(0, 1, 40)
        a = np.hstack([acc1, -acc2])
        keep = set(range(40))
        while len(keep) > 30:
            rows = sorted(keep)
            c = ols20.coherence(a[rows], np.linalg.svd(a[rows])[2][0])
            candidates = [k for k, value in zip(rows, c, strict=True) if value > 0.5] or rows
            keep.remove(max(candidates, key=lambda k: penalties[k]))
        self.assertEqual(ols20.select_acc(acc1, acc2, penalties, 30).tolist(), sorted(keep))

    def test_without_a_coherent_row_the_largest_penalty_goes(self):
        rows = np.eye(6)
        w1 = np.full(6, 6 ** -0.5)  # coherence 0.41 with every row
        self.assertEqual(ols20.first_coherent(rows, np.array([3, 1, 2, 0]), w1), 0)
        self.assertEqual(ols20.first_coherent(rows, np.array([3, 1, 2, 0]), rows[2]), 2)

    def test_few_quiet_samples_are_all_and_min_acc_adds_the_next_quietest(self):
        acc = np.random.default_rng(6).standard_normal((2, 100, 3))
        penalties = np.linspace(0.9, 5.0, 100)
        quiet = np.count_nonzero(penalties <= ols20.E_TH)
        self.assertEqual(ols20.select_acc(*acc, penalties, 50).tolist(), list(range(quiet)))
        self.assertEqual(ols20.select_acc(*acc, penalties, 50, min_acc=20).tolist(), list(range(20)))
        self.assertEqual(len(ols20.select_acc(*acc, penalties, 200)), 100)
        self.assertEqual(len(ols20.select_acc(*acc, penalties, 200, seen=300)), quiet)


class Uncertainty(unittest.TestCase):
    def test_elliptic_integral_agrees_with_quadrature(self):
        t = (np.arange(20000) + 0.5) * (np.pi / 2 / 20000)
        for m in (0.0, 0.3, 0.9, 0.999, 1.0):
            self.assertAlmostEqual(ols20.complete_elliptic_e(m), np.mean(np.sqrt(1 - m * np.sin(t) ** 2)) * np.pi / 2,
                                   places=8)

    def test_closed_form_agrees_with_the_monte_carlo(self):
        x = np.array([0.7, 0.4, -0.9, 2.0])
        root = np.radians([[1.5, 0, 0, 0], [1.0, 2.0, 0, 0], [0.3, 0, 0.8, 0], [0, 0.5, 0.2, 3.0]])
        p_x = root @ root.T
        sampled = ols20.mu_plus_2_sigma_monte_carlo(x, p_x, np.random.default_rng(7), 20000)
        np.testing.assert_allclose(ols20.mu_plus_2_sigma(x, p_x), sampled, rtol=0.02)

    def test_covariance_predicts_the_scatter_where_its_assumptions_hold(self):
        # White noise, no lever arms (so (18) is exact), rates away from the axis (where
        # (24) has a kink), and weights that match the noise: (57) is the covariance of
        # the best weighting, which w0 = 50 is not.
        spec = replace(FREE, motions=(("7", 10.0),), r1=(0.0, 0.0, 0.0), r2=(0.0, 0.0, 0.0), noise_scale=0.0)
        gyr_std, acc_std = 0.01, 0.1
        rec, exact = problem_of(spec, w0=acc_std / gyr_std)
        rng = np.random.default_rng(8)
        errors, predicted = [], []
        for _ in range(60):
            noisy = exact._replace(**{name: getattr(exact, name) + std * rng.standard_normal(exact.gyr1.shape)
                                      for name, std in (("gyr1", gyr_std), ("gyr2", gyr_std),
                                                        ("acc1", acc_std), ("acc2", acc_std))})
            x, _ = ols20.gauss_newton(noisy, ols20.angles(rec.axis1, rec.axis2))
            errors.append(errors_deg(*ols20.axes(x), rec.axis1, rec.axis2))
            predicted.append(np.degrees(ols20.mu_plus_2_sigma(x, ols20.covariance(noisy, x))))
        # mu + 2 sigma of a two-dimensional Gaussian covers 0.955 (one strong direction) to 0.963 (none);
        # three standard deviations of 60 runs are 0.08.
        covered = (np.array(errors) < predicted).mean(axis=0)
        self.assertGreater(covered.min(), 0.88)
        ratio = np.mean(predicted, axis=0) / np.sqrt(np.mean(np.square(errors), axis=0))
        self.assertLess(ratio.max(), 2.2)  # 1.8 for equal variances
        self.assertGreater(ratio.min(), 1.4)

    def test_missing_samples_and_open_directions_have_infinite_uncertainty(self):
        rec, problem = problem_of(FREE)
        x = ols20.angles(rec.axis1, rec.axis2)
        for lacking in (problem._replace(acc1=np.empty((0, 3)), acc2=np.empty((0, 3))),
                        problem._replace(gyr1=0 * problem.gyr1, gyr2=0 * problem.gyr2, acc2=0 * problem.acc2)):
            self.assertTrue(np.isinf(ols20.mu_plus_2_sigma(x, ols20.covariance(lacking, x))).all())

    def test_sequential_deviation_forgives_the_common_sign_only(self):
        a, b = np.eye(3)[:2]
        (c1, c2), same = ols20.sequential_deviation((-a, -b), (a, b))
        self.assertAlmostEqual(same, 0.0)
        np.testing.assert_array_equal([c1, c2], [a, b])
        self.assertAlmostEqual(ols20.sequential_deviation((a, -b), (a, b))[1], np.pi)
        self.assertEqual(ols20.sequential_deviation((a, b), None)[1], np.pi)

    def test_algorithm_4_accepts_informative_motion_and_is_right(self):
        rec = simulate_hinge(HingeSpec(motions=(("6", 20.0), ("7", 10.0)), rate_hz=50.0, soft_tissue_deg=0.3))
        estimates = list(ols20.algorithm4(rec, np.random.default_rng(9), n_max=500))
        self.assertEqual(len(estimates), len(rec) // 50)
        accepted = [e for e in estimates if e.accepted]
        self.assertGreater(len(accepted), 0)
        self.assertGreaterEqual(accepted[0].t_s, 10.0)  # the first SEQAD is 180 deg
        for estimate in accepted:
            self.assertLess(errors_deg(estimate.j1, estimate.j2, rec.axis1, rec.axis2).max(), 3.0)
            self.assertLessEqual(max(len(estimate.gyr_idx), len(estimate.acc_idx)), 500)


class Stream(unittest.TestCase):
    def test_moments_give_the_cost_of_the_squared_residuals(self):
        _, problem = problem_of(FREE, squared=True)
        moments = ols20.stream_moments(problem)
        rng = np.random.default_rng(10)
        for _ in range(5):
            x = rng.uniform(-1.5, 1.5, 4)
            direct = ols20.cost(problem, x)
            self.assertAlmostEqual(ols20.stream_cost(moments, *ols20.axes(x)) / direct, 1.0, places=11)

    def test_squared_residuals_find_nearly_the_same_axes(self):
        rec, problem = problem_of(FREE)
        a, b = ols20.solve(problem), ols20.solve(problem._replace(squared=True))
        self.assertLess(errors_deg(a.j1, a.j2, b.j1, b.j2).max(), 0.3)


@unittest.skipUnless((DATA / "rig_1D_01.csv").exists(), f"no recordings in {DATA.name}/; set JOINTCAL_DATA")
class RealRecordings(unittest.TestCase):
    def errors(self, name, **options):
        rec = load_csv(DATA / f"{name}.csv")
        gyr_idx = acc_idx = rec.finite()
        if "half_window" in options:
            n = options.pop("half_window")
            gyr_idx = ols20.algorithm2(rec.gyr1, rec.gyr2, 1000, n)
            acc_idx = ols20.algorithm3(rec, 1000, n)
        found = ols20.solve_on_indices(rec, gyr_idx, acc_idx, **options)
        y = np.array([0.0, 1.0, 0.0])  # OLS20 eq. (69)
        return errors_deg(found.j1, found.j2, y, y)

    def test_all_samples_give_the_nominal_axes(self):
        for name in ("rig_1D_01", "rig_1D_02", "rig_1D_04"):
            for squared in (False, True):
                with self.subTest(name, squared=squared):
                    self.assertLess(self.errors(name, squared=squared).max(), NOMINAL_TOL_DEG)

    def test_selected_samples_give_the_nominal_axes_for_both_readings_of_the_window(self):
        for name in ("rig_1D_01", "rig_1D_02", "rig_1D_04"):
            for n in (ols20.HALF_WINDOW_PAPER, ols20.HALF_WINDOW_CODE):
                with self.subTest(name, half_window=n):
                    self.assertLess(self.errors(name, half_window=n).max(), NOMINAL_TOL_DEG)


if __name__ == "__main__":
    unittest.main()
