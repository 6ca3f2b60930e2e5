"""Remembered hinges: the float64 reference where the answer is known, and the C library beside it."""

import sys
import unittest
from dataclasses import replace
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

from jointcal_tools import native_remember  # noqa: E402
from jointcal_tools import remember_reference as reference  # noqa: E402
from jointcal_tools.measure import remember as measure  # noqa: E402
from jointcal_tools.simulate import HingeSpec, simulate_hinge  # noqa: E402
from jointcal_tools.simulate_people import PersonSpec, simulate_person  # noqa: E402


def rigid() -> tuple[reference.Kept, tuple]:
    rec = simulate_hinge(HingeSpec(motions=(("daily", 20.0),), rate_hz=50.0, seed=3, speed=1.5))
    return reference.Kept(rec.axis1, rec.axis2, (1.0, 1.0), rec.r1, rec.r2, True), measure.ticks_of(rec)


def person() -> tuple[reference.Kept, tuple]:
    rec = simulate_person(PersonSpec(activities=(("walk", 25.0),), seed=4))
    return reference.Kept(rec.axis1, rec.axis2, (6.0, 6.0), rec.r1, rec.r2, False), measure.ticks_of(rec)


def off_by(axis: np.ndarray, angle_deg: float) -> np.ndarray:
    return measure.matrix(angle_deg, reference.basis(axis)[:, 0]) @ axis


class Reference(unittest.TestCase):
    def test_axes_that_are_off_want_back_by_as_much(self):
        kept, (one, two) = rigid()
        for angle_deg in (2.0, 5.0, 10.0):
            wrong = replace(kept, axis1=off_by(kept.axis1, angle_deg))
            last = list(reference.look_at(one, two, wrong, most_s=8.0))[-1]
            self.assertAlmostEqual(last.off_deg[0], angle_deg, delta=0.15 * angle_deg)
            self.assertLess(last.off_deg[1], 1.0)

    def test_a_basis_is_right_handed(self):
        for seed in range(20):
            axis = np.random.default_rng(seed).standard_normal(3)
            e = reference.basis(axis / np.linalg.norm(axis))
            np.testing.assert_allclose(e.T @ e, np.eye(3), atol=1e-12)
            self.assertAlmostEqual(np.linalg.det(e), 1.0)


class Library(unittest.TestCase):
    def compare(self, kept: reference.Kept, ticks: tuple) -> None:
        """Every look the same, and the same decision."""
        looks = list(reference.look_at(*ticks, kept, most_s=1e9))
        track = native_remember.run(*ticks, kept, goes_on=True)
        for look in looks:
            at = int(np.searchsorted(track.t_s, look.t_s - 1e-6))
            if look.sigma_deg.max() > 60.0:
                continue  # hardly anything is known: float32 may have given the matrix up
            np.testing.assert_allclose(track.off_deg[at], look.off_deg, atol=0.02, rtol=2e-3)
            np.testing.assert_allclose(track.sigma_deg[at], look.sigma_deg, rtol=2e-3)
            np.testing.assert_allclose([track.lack[at], track.evidence[at], track.bend_rad[at], track.motion_s[at], track.speed_m_s[at]],
                                       [look.lack, look.evidence, look.bend_rad, look.motion_s, np.sqrt(look.speed2)], atol=5e-3, rtol=2e-3)
        word, look = reference.decide(looks, kept)
        decided = native_remember.run(*ticks, kept)
        self.assertEqual(("remembered", "confirmed", "dropped")[decided.state[-1]], word)
        if look is not None:
            self.assertAlmostEqual(decided.motion_s[-1], look.motion_s, places=3)

    def test_looks_and_decisions_are_those_of_the_reference(self):
        for kept, ticks in (rigid(), person()):
            for case in (kept, replace(kept, axis1=off_by(kept.axis1, 15.0)), replace(kept, axis2=-kept.axis2),
                         replace(kept, r1=kept.r2, r2=kept.r1), replace(kept, r1=None, r2=None)):
                self.compare(case, ticks)

    def test_the_right_axes_are_confirmed_and_wrong_ones_dropped(self):
        for kept, ticks in (rigid(), person()):
            self.assertEqual(native_remember.run(*ticks, kept).state[-1], native_remember.CONFIRMED)
            wrong = replace(kept, axis1=off_by(kept.axis1, 20.0))
            self.assertEqual(native_remember.run(*ticks, wrong).state[-1], native_remember.DROPPED)


if __name__ == "__main__":
    unittest.main()
