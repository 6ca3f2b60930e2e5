"""The features of one sensor: the C library beside float64 numpy on the same orientations, and what two sensors of one body share."""

import sys
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

from jointcal_tools import native, native_sensor  # noqa: E402
from jointcal_tools import quaternions as quat  # noqa: E402
from jointcal_tools.sensor_features import features, skew  # noqa: E402

FINE = 8  # steps of the motion in one sample


def body(seconds: float, rate_hz: float):
    """Times, rates (body frame), derivatives of the rates, orientations and accelerations plus gravity (earth frame) of a made-up motion."""
    n = int(seconds * rate_hz)
    t = np.arange(n * FINE + 1) / (rate_hz * FINE)
    f, p = np.array([4.1, 5.3, 3.2]), np.array([0.0, 1.0, 2.0])
    w, dw = 2.0 * np.sin(np.outer(t, f) + p), 2.0 * f * np.cos(np.outer(t, f) + p)
    middle = 2.0 * np.sin(np.outer(0.5 * (t[1:] + t[:-1]), f) + p)
    q = [np.array([[0.8, 0.2, -0.4, 0.4]])]
    for step in quat.from_rotation_vectors(middle * np.diff(t)[:, None]):
        q.append(quat.multiply(q[-1], step[None, :]))
    force = 3.0 * np.sin(np.outer(t, [3.1, 2.7, 5.1]) + p) + np.array([0.0, 0.0, 9.81])
    return (v[::FINE] for v in (t, w, dw, np.vstack(q) / np.linalg.norm(q[0]), force))


def sensor(frame: np.ndarray, place: np.ndarray, w, dw, q, force):
    """Rates, specific forces and orientation matrices of a sensor with this frame (sensor to body) and place (body frame)."""
    r = quat.matrices(q)
    acc = np.einsum("nji,nj->ni", r, force) + np.einsum("nij,j->ni", skew(dw) + skew(w) @ skew(w), place)
    return w @ frame, acc @ frame, r @ frame


class Features(unittest.TestCase):
    def test_two_sensors_of_one_body_share_what_their_levers_leave(self):
        for rate_hz, limit in ((100.0, 2e-3), (400.0, 1.3e-4)):
            t, w, dw, q, force = body(5.0, rate_hz)
            places = np.array([[0.12, -0.25, 0.08], [-0.2, 0.07, 0.15]])
            frames = quat.matrices(np.array([[0.5, 0.5, -0.5, 0.5], [0.6, 0.0, 0.8, 0.0]]))
            left = []
            for frame, place in zip(frames, places, strict=True):
                gyr, acc, turn = sensor(frame, place, w, dw, q, force)
                found = features(native.microseconds(t), turn, gyr, acc)
                left.append(found.velocity - found.lever @ (frame.T @ place))
            size = np.abs(found.velocity).max()
            self.assertLess(np.abs(left[0] - left[1]).max(), limit * size)

    def test_the_library_makes_the_same_of_its_own_orientations(self):
        for rate_hz, tolerance in ((100.0, 1e-4), (40.0, 1e-4)):
            t, w, dw, q, force = body(8.0, rate_hz)
            gyr, acc, _ = sensor(np.eye(3), np.array([0.1, 0.2, -0.1]), w, dw, q, force)
            gyr, acc = gyr.astype(np.float32).astype(float), acc.astype(np.float32).astype(float)
            found = native_sensor.run(t, gyr, acc)
            bias = np.vstack([np.zeros(3), found.bias[:-1]])  # a tick changes it for the samples that follow
            expected = features(native.microseconds(t), quat.matrices(found.q), gyr - bias, acc)
            ticks = found.ticks
            np.testing.assert_allclose(ticks.t_s, t[expected.at] - t[0], atol=1e-6)
            np.testing.assert_allclose(ticks.turn, quat.matrices(found.q)[expected.at], atol=1e-6)
            for name in ("rate", "lever", "velocity", "gyr"):
                np.testing.assert_allclose(getattr(ticks, name), getattr(expected, name), atol=tolerance, err_msg=name)
            self.assertTrue((ticks.epoch == 1).all())


if __name__ == "__main__":
    unittest.main()
