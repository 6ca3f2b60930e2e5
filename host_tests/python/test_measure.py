"""Tests of tools/python/jointcal_tools/measure: how runs are judged, and the classes of `never`."""

import math
import sys
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

from jointcal_tools import ols17  # noqa: E402
from jointcal_tools.measure import center_vectors, faults, never, qmt_reference, soak  # noqa: E402
from jointcal_tools.measure.harness import (Incomplete, Report, binomial_quantile, numbered, orientations_by,  # noqa: E402
                                            quantile)
from jointcal_tools.measure.judge import Verdict, line_angle_deg  # noqa: E402


def verdict(ready, errors, wrong, bounds):
    count = len(ready)
    return Verdict(np.arange(count, dtype=float), np.array(ready, bool), np.array(errors, float),
                   np.array(wrong, bool), np.array(bounds, float), np.zeros(count, bool), 0)


class JudgeTest(unittest.TestCase):
    def test_angle_between_lines_ignores_the_sense(self):
        axes = np.array([[0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, math.cos(0.1), -math.sin(0.1)], [0.0, 0.0, 0.0]])
        np.testing.assert_allclose(line_angle_deg(axes, np.array([0.0, 1.0, 0.0])),
                                   [0.0, 0.0, math.degrees(0.1), 90.0], atol=1e-9)

    def test_wrong_pairing_while_ready_is_false_ready(self):
        self.assertFalse(verdict([0, 1], [[9, 9], [1, 1]], [1, 0], [[90, 90], [2, 2]]).false_ready)
        self.assertTrue(verdict([0, 1], [[9, 9], [1, 1]], [0, 1], [[90, 90], [2, 2]]).false_ready)
        self.assertTrue(verdict([1, 1], [[1, 3.1], [1, 1]], [0, 0], [[2, 2], [2, 2]]).false_ready)

    def test_wrong_pairing_is_not_covered(self):
        self.assertEqual(verdict([1], [[1, 3]], [0], [[2, 2]]).covered(0).tolist(), [True, False])
        self.assertEqual(verdict([1], [[1, 1]], [1], [[2, 2]]).covered(0).tolist(), [False, False])


class SoakTest(unittest.TestCase):
    def counted(self, packets, restart_at=1000):
        sent = soak.Sent(np.arange(2000.0), (np.arange(2000) >= restart_at).astype(int), np.zeros((2000, 6)))
        sent.first, sent.count = [first for first, _ in packets], [count for _, count in packets]
        return soak.expected(sent)

    def test_what_is_lost_late_and_doubled_follows_from_the_order_of_arrival(self):
        # 2 and 3 come after 4 and 5, so they are lost and late; then once more; 6 and 7 never; 8 twice, and once more after 70 others.
        counts, out = self.counted([(0, 2), (4, 2), (2, 2), (2, 2), (8, 1), (8, 1), *((k, 10) for k in range(9, 79, 10)), (8, 1)])
        self.assertEqual(counts, {"readings": 75, "lost": 4, "late": 3, "duplicate": 3, "odd": 0, "restarts": 0})
        self.assertEqual(out, [0, 1, 4, 5, *range(8, 79)])

    def test_two_packets_of_a_sensor_that_begins_anew_are_odd(self):
        counts, out = self.counted([(0, 1), (10, 3), (13, 2), (15, 2), (17, 1)], restart_at=10)
        self.assertEqual(counts, {"readings": 4, "lost": 0, "late": 0, "duplicate": 0, "odd": 5, "restarts": 1})
        self.assertEqual(out, [0, 15, 16, 17])

    def test_common_times_that_readings_enclose(self):
        # From 4 ms to 25 ms: 10 and 20 ms; then 130 ms are too long; then 170 ms.
        np.testing.assert_array_equal(soak.told_of(np.array([4000, 25000, 155000, 165000, 170000])), [1, 2, 16, 17])


class HarnessTest(unittest.TestCase):
    def test_quantile_counts_what_never_happened(self):
        self.assertEqual(quantile([1.0, 2.0, 3.0, math.inf], 0.5), 2.0)
        self.assertEqual(quantile([1.0, 2.0, 3.0, math.inf], 0.9), math.inf)
        self.assertTrue(math.isnan(quantile([], 0.5)))

    def test_binomial_quantile_of_a_coin(self):
        # 4 throws: P(hits < 1) = 1/16, P(hits < 2) = 5/16.
        self.assertEqual(binomial_quantile(4, 0.5, 0.1), 1)
        self.assertEqual(binomial_quantile(4, 0.5, 0.05), 0)

    def test_a_share_below_the_minimum_fails(self):
        report = Report("x", "X", "command", "0")
        report.require_share("enough", [95, 96], 100, 0.95)
        self.assertTrue(report.passed)
        report.require_share("too few", [96, 94], 100, 0.95)
        self.assertFalse(report.passed)
        self.assertIn("FAIL: too few", report.markdown())

    def test_a_full_measurement_without_any_run_fails(self):
        for quick, passed in ((False, False), (True, True)):
            report = Report("x", "X", "command", "0", quick=quick)
            report.require_share("nothing", 0, 0, 0.95)
            self.assertEqual(report.passed, passed)

    def test_only_names_one_run(self):
        self.assertEqual(numbered({"a": 2, "b": 1}, None), [("a", 0), ("a", 1), ("b", 0)])
        self.assertEqual(numbered({"a": 2, "b": 1}, "a"), [("a", 0), ("a", 1)])
        self.assertEqual(numbered({"a": 2, "b": 1}, "b:7"), [("b", 7)])


    def test_a_full_measurement_without_vqf_is_none(self):
        self.assertEqual(orientations_by("LS", True, False), ", orientations by VQF")
        self.assertIn("WITHOUT VQF: LS", orientations_by("LS", False, True))
        with self.assertRaisesRegex(Incomplete, "LS needs: tools/vqf.sh"):
            orientations_by("LS", False, False)

    def test_head_says_where_orientations_come_from(self):
        report = Report("x", "X", "command", "0", source=orientations_by("LS", True, False))
        self.assertIn("library version 0, orientations by VQF.", report.markdown())


class QmtStartsTest(unittest.TestCase):
    def test_every_draw_has_the_own_start_and_no_start_twice(self):
        self.assertEqual(qmt_reference.starts()[0].tolist(), [0.0] * 4)
        for draw in qmt_reference.draws():
            self.assertEqual((draw[0], len(set(draw))), (0, qmt_reference.STARTS))

    def test_starts_are_spread_over_the_sphere(self):
        inclination = qmt_reference.starts()[1:, [0, 2]].ravel()
        self.assertLess(abs(np.sin(inclination).mean()), 0.15)  # uniform in the sine: standard deviation 0.05
        self.assertAlmostEqual(np.sin(inclination).std(), 3.0**-0.5, delta=0.1)

    def test_what_costs_least_is_taken(self):
        self.assertEqual(qmt_reference.cheapest([(1, 1, 3.0), (2, 2, 1.0), (3, 3, np.inf)])[0], 2)


class VectorsTest(unittest.TestCase):
    """The float64 fit behind the table that says why LS is never ready."""

    R = np.array([-0.12, 0.01, 0.02, 0.15, -0.01, 0.02])

    def samples(self, tilt_rad: float) -> ols17.Samples:
        """Exact samples in two earth frames 40 deg apart; sensor 1's is tilted about x."""
        rng = np.random.default_rng(7)
        turn = [ols17.rotation(rng.normal(0.0, 2.0, (400, 3))) for _ in range(2)]
        k = [turn[i] @ ols17.k_matrix(rng.normal(0.0, 2.0, (400, 3)), rng.normal(0.0, 10.0, (400, 3))) for i in range(2)]
        a0 = rng.normal(0.0, 1.0, (400, 3)) + [0.0, 0.0, 9.81]
        tilt = ols17.rotation(np.array([[tilt_rad, 0.0, 0.0]]))[0]
        to2 = center_vectors.heading_matrix(np.radians(-40.0))
        a = [(a0 + k[0] @ self.R[:3]) @ tilt.T, (a0 + k[1] @ self.R[3:]) @ to2.T]
        return ols17.Samples(0.02 * np.arange(400.0), a[0], tilt @ k[0], tilt @ turn[0], a[1], to2 @ k[1], to2 @ turn[1])

    def test_exact_samples_leave_nothing(self):
        left = center_vectors.solve(self.samples(0.0), self.R + 0.01)
        np.testing.assert_allclose(left.places.ravel(), self.R, atol=1e-6)
        self.assertLess(left.misfit, 1e-6)
        self.assertAlmostEqual(left.hidden_mm, 2.0, places=3)

    def test_a_degree_of_tilt_is_gravity_in_the_horizontal_only(self):
        left = center_vectors.solve(self.samples(np.radians(1.0)), self.R)
        self.assertAlmostEqual(left.horizontal, 9.81 * np.radians(1.0) / 2.0**0.5, delta=0.01)  # in one of two components
        self.assertLess(left.vertical, 0.03)
        self.assertGreater(left.lasting, 0.5)
        slow_left_out = center_vectors.solve(self.samples(np.radians(1.0)), self.R, slow_rows=51)
        self.assertLess(slow_left_out.horizontal, 0.05)


class FaultsTest(unittest.TestCase):
    def test_full_measurement_has_more_than_ten_thousand_runs(self):
        self.assertGreaterEqual(sum(count for _, count in faults.CLASSES.values()), 10000)

    def test_every_class_gives_the_same_finite_case_again(self):
        for kind in never.ALL:
            with self.subTest(kind=kind):
                one, other = never.make_case(kind, 3), never.make_case(kind, 3)
                self.assertGreaterEqual(len(one.rec), 200)
                self.assertEqual(len(one.rec.finite()), len(one.rec))
                for name in ("t_s", "gyr1", "acc1", "gyr2", "acc2"):
                    np.testing.assert_array_equal(getattr(one.rec, name), getattr(other.rec, name))

    def test_clipped_signals_stand_at_a_quarter(self):
        signal = np.array([[4.0, 0.5, -2.0]])
        np.testing.assert_array_equal(faults.clip(signal), [[1.0, 0.5, -1.0]])


if __name__ == "__main__":
    unittest.main()
