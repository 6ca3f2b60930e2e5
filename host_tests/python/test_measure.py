"""Tests of tools/python/jointcal_tools/measure: how runs are judged, and the classes of `never`."""

import math
import sys
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

from jointcal_tools.measure import faults, never  # noqa: E402
from jointcal_tools.measure.harness import Report, binomial_quantile, numbered, quantile  # noqa: E402
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


class FaultsTest(unittest.TestCase):
    def test_full_measurement_has_ten_thousand_runs(self):
        self.assertEqual(sum(count for _, count in faults.CLASSES.values()), 10000)

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
