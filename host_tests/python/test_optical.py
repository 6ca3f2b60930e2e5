"""Tests of tools/python/jointcal_tools/measure/optical.py and angles.py on made-up references."""

import sys
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

from jointcal_tools.measure import angles, optical  # noqa: E402

RATE_HZ = 50.0


def about(axis, angle):
    """Quaternions (N, 4) of rotations about a unit vector."""
    half = np.asarray(angle, float)[:, None] / 2.0
    return np.hstack([np.cos(half), np.sin(half) * np.asarray(axis, float)])


def motion(t):
    z, x, y = np.eye(3)[[2, 0, 1]]
    return optical.multiply(about(z, 1.1 * np.sin(1.7 * t)), optical.multiply(about(x, 0.9 * np.cos(1.1 * t)),
                                                                             about(y, 0.7 * np.sin(2.3 * t))))


class AlignTest(unittest.TestCase):
    def test_frame_lag_and_jumps_are_found(self):
        t = np.arange(1500) / RATE_HZ
        lag, turn = 0.6, about(np.array([0.6, 0.0, 0.8]), np.array([0.02]))
        gyr = optical.steps(motion(np.concatenate([[-1.0 / RATE_HZ], t]))) * RATE_HZ
        ref = optical.multiply(motion(t - lag / RATE_HZ), turn)  # a cluster turned against the IMU, and late
        ref[700] = optical.multiply(ref[700:701], about([1.0, 0.0, 0.0], np.array([3.0])))[0]
        found = optical.align(gyr, ref, 1.0 / RATE_HZ)
        self.assertAlmostEqual(found.lag, lag, places=6)
        self.assertAlmostEqual(found.turn_deg, np.degrees(0.02), delta=0.02)
        self.assertFalse(found.good[699:702].any())
        self.assertGreater(found.good.mean(), 0.99)
        apart = optical.multiply(optical.conjugate(found.q), motion(t))
        angle = 2.0 * np.degrees(np.arctan2(np.linalg.norm(apart[:, 1:], axis=1), np.abs(apart[:, 0])))
        # Chords of a motion of some rad/s^2, sampled each 20 ms, are off by a hundredth of a degree.
        self.assertLess(angle[found.good][2:-2].max(), 0.1)


class AnglesTest(unittest.TestCase):
    def setUp(self):
        t = np.arange(500) / RATE_HZ
        self.flexion, self.pronation = 0.9 * np.sin(1.9 * t), 1.2 * np.sin(1.3 * t)
        self.q1 = motion(t)
        x, y, z = np.eye(3)
        bent = optical.multiply(about(z, self.flexion), about(x, np.full(500, 0.2)))
        self.q2 = optical.multiply(self.q1, optical.multiply(bent, about(y, self.pronation)))
        self.q2_hinge = optical.multiply(self.q1, about(z, self.flexion))

    def test_angles_of_known_joints(self):
        _, y, z = np.eye(3)
        found = optical.two_dof_angles(self.q1, self.q2, z, y)
        np.testing.assert_allclose(found, np.column_stack([self.flexion, np.full(500, 0.2), self.pronation]), atol=1e-9)
        np.testing.assert_allclose(optical.hinge_angle(self.q1, self.q2_hinge, z, z), self.flexion, atol=1e-9)

    def test_axes_are_fitted(self):
        _, y, z = np.eye(3)
        near_y, near_z = (v / np.linalg.norm(v) for v in (np.array([0.02, 1.0, -0.01]), np.array([0.02, 0.03, 1.0])))
        for hinge, q2, end in ((False, self.q2, y), (True, self.q2_hinge, z)):
            j1, j2 = optical.fit_axes(self.q1, q2, near_z, near_y if end is y else near_z, hinge)
            if not hinge:
                np.testing.assert_allclose(j1, z, atol=1e-9)
                np.testing.assert_allclose(j2, end, atol=1e-9)
            else:
                np.testing.assert_allclose(j1, j2, atol=1e-9)
                self.assertLess(abs(j1 @ z - 1.0), 1e-9)

    def test_errors_leave_out_a_constant_and_count_missing_windows_as_infinite(self):
        truth = np.linspace(-170.0, 170.0, 1500)
        found = np.mod(truth + 120.0 + np.tile([1.0, -1.0], 750), 360.0)
        good = np.ones(1500, bool)
        np.testing.assert_allclose(angles.window_rms(angles.errors_deg(found, truth, good), RATE_HZ), [1.0, 1.0, 1.0])
        found[500:800] = np.nan
        rms = angles.window_rms(angles.errors_deg(found, truth, good), RATE_HZ)
        self.assertEqual(rms[1], np.inf)
        np.testing.assert_allclose(rms[[0, 2]], 1.0)


if __name__ == "__main__":
    unittest.main()
