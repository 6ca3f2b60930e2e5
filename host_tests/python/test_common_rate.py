"""The float64 reference of the stream engine's axes: exact motion, derivatives, what direction tells beyond length."""

import sys
import unittest
from dataclasses import replace
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

from jointcal_tools import common_rate as cr  # noqa: E402
from jointcal_tools.simulate import HingeSpec, simulate_hinge  # noqa: E402

# Without lever arms (18) holds exactly, too.
EXACT = HingeSpec(motions=(("7", 10.0),), rate_hz=100.0, seed=2, noise_scale=0.0, r1=(0.0, 0.0, 0.0),
                  r2=(0.0, 0.0, 0.0))
PLANAR = HingeSpec(motions=(("6", 10.0),), rate_hz=50.0, noise_scale=0.0, wobble_deg=0.0, speed=0.7)
BIAS_RAD_S = np.radians(1.0)
METHODS = {"lengths": cr.solve_lengths, "vectors": cr.solve_vectors}


def error_deg(found, j1, j2):
    """Of the worse axis; the sign of the pair is free, the pairing is not."""
    sign = 1.0 if found.j1 @ j1 >= 0.0 else -1.0
    return max(float(np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b)), sign * (a @ b))))
               for a, b in ((found.j1, j1), (found.j2, j2)))


def data(rec):
    return rec.t_s, rec.gyr1, rec.acc1, rec.gyr2, rec.acc2


def tilted(rec, d):
    """Axes off the truth by the tilts d (4,)."""
    point = cr.move(cr.make_point(rec.axis1, rec.axis2), np.r_[d, np.zeros(5)])
    return point.frame1.j, point.frame2.j


class Derivatives(unittest.TestCase):
    def test_jacobians_agree_with_central_differences(self):
        rec = simulate_hinge(replace(EXACT, motions=(("7", 3.0),), noise_scale=1.0, r1=None, r2=None))
        samples = cr.Samples(*data(rec))
        rng = np.random.default_rng(0)
        h = 1e-6
        for name, rows in {"lengths": cr.length_rows(samples), "vectors": cr.vector_rows(samples),
                           "one block": cr.vector_rows(samples, 10.0), "acc": cr.acc_rows(samples),
                           "prior": cr.prior_rows(2.0)}.items():
            for _ in range(3):
                point = cr.move(cr.make_point(rec.axis1, rec.axis2), 0.3 * rng.standard_normal(cr.UNKNOWNS))
                jacobian = rows(point)[1]
                numeric = np.stack([(rows(cr.move(point, h * step))[0] - rows(cr.move(point, -h * step))[0]) / (2 * h)
                                    for step in np.eye(cr.UNKNOWNS)], axis=1)
                with self.subTest(name):
                    np.testing.assert_allclose(jacobian, numeric, atol=1e-7 * np.abs(jacobian).max())

    def test_the_phase_of_a_block_is_the_best_one(self):
        rec = simulate_hinge(replace(EXACT, motions=(("7", 1.0),), noise_scale=1.0))
        samples = cr.Samples(*data(rec))
        point = cr.make_point(*tilted(rec, [0.1, -0.2, 0.0, 0.1]))
        view1, view2 = cr.look_both(samples, point)
        turned = np.exp(-1j * cr.integral(view2.along - view1.along, rec.t_s, np.array([0]))) * view1.across
        costs = [np.sum(np.abs(np.exp(1j * phase) * turned - view2.across) ** 2)
                 for phase in np.linspace(0.0, 2.0 * np.pi, 3601)]
        weight = rec.t_s[1] / cr.UNIT_S / cr.GYR_NOISE_RAD_S**2
        found = np.sum(cr.vector_rows(samples, 10.0)(point)[0] ** 2) / weight
        self.assertLessEqual(found, min(costs) * (1.0 + 1e-12))
        self.assertAlmostEqual(found / min(costs), 1.0, places=5)

    def test_no_motion_has_no_gradient_instead_of_nan(self):
        still = np.zeros((100, 3))
        samples = cr.Samples(np.arange(100) / 50.0, still, still, still, still)
        residual, jacobian = cr.vector_rows(samples)(cr.make_point(*np.eye(3)[:2]))
        self.assertEqual(np.abs(residual).max(), 0.0)
        self.assertEqual(np.abs(jacobian[:, cr.TILTS]).max(), 0.0)
        self.assertTrue(np.isfinite(jacobian).all())


class Blocks(unittest.TestCase):
    def test_a_short_rest_belongs_to_the_block_before_it(self):
        t_s = np.arange(110) / 100.0
        self.assertEqual(cr.block_starts(t_s, 0.5).tolist(), [0, 50])
        self.assertEqual(cr.block_starts(t_s[:80], 0.5).tolist(), [0, 50])
        self.assertEqual(cr.block_starts(t_s[:70], 0.5).tolist(), [0])
        self.assertEqual(cr.block_starts(t_s[:10], 0.5).tolist(), [0])

    def test_a_gap_begins_a_new_block(self):
        t_s = np.r_[np.arange(60), 100 + np.arange(30)] / 100.0
        self.assertEqual(cr.block_starts(t_s, 0.5).tolist(), [0, 60])

    def test_integrals_begin_with_their_block(self):
        t_s = np.arange(6) / 10.0
        found = cr.integral(np.arange(6.0), t_s, np.array([0, 3]))
        np.testing.assert_allclose(found, [0.0, 0.05, 0.2, 0.0, 0.35, 0.8], atol=1e-12)


class Axes(unittest.TestCase):
    def test_exact_motion_gives_the_exact_axes(self):
        for motion in ("5", "6", "7", "12", "14", "daily"):
            rec = simulate_hinge(replace(EXACT, motions=((motion, 10.0),)))
            start = tilted(rec, [0.05, -0.03, 0.02, 0.06])
            for name, solve in METHODS.items():
                with self.subTest(motion, method=name):
                    self.assertLess(error_deg(solve(*data(rec), start), rec.axis1, rec.axis2), 0.01)

    def test_a_gap_does_no_harm(self):
        rec = simulate_hinge(EXACT)
        keep = np.r_[0:420, 560:1000]
        found = cr.solve_vectors(*(values[keep] for values in data(rec)), tilted(rec, [0.05, 0.0, 0.0, -0.05]))
        self.assertLess(error_deg(found, rec.axis1, rec.axis2), 0.01)

    def test_turning_a_sensor_turns_its_axis(self):
        rec = simulate_hinge(replace(EXACT, noise_scale=1.0))
        turn = np.linalg.qr(np.random.default_rng(1).standard_normal((3, 3)))[0]
        turn *= np.linalg.det(turn)
        for name, solve in METHODS.items():
            plain = solve(*data(rec), (rec.axis1, rec.axis2))
            other = solve(rec.t_s, rec.gyr1 @ turn.T, rec.acc1 @ turn.T, rec.gyr2, rec.acc2,
                          (turn @ rec.axis1, rec.axis2))
            with self.subTest(name):
                self.assertLess(error_deg(other, turn @ plain.j1, plain.j2), 1e-4)

    def test_direction_resolves_planar_motion_with_a_bias_and_length_does_not(self):
        # Gyroscopes alone: the specific forces say nothing.
        for seed in range(4):
            rec = simulate_hinge(replace(PLANAR, seed=seed))
            nothing = np.zeros_like(rec.acc1)
            gyr2 = rec.gyr2 + BIAS_RAD_S * cr.make_frame(rec.axis2).u
            ends = {name: [solve(rec.t_s, rec.gyr1, nothing, gyr2, nothing, tilted(rec, [off, 0.0, off, 0.0]))
                           for off in (0.05, -0.05)] for name, solve in METHODS.items()}
            with self.subTest(seed):
                one, other = ends["lengths"]  # a minimum to either side of the truth
                self.assertGreater(min(error_deg(end, rec.axis1, rec.axis2) for end in ends["lengths"]), 2.0)
                self.assertGreater(error_deg(one, other.j1, other.j2), 4.0)
                one, other = ends["vectors"]
                self.assertLess(error_deg(one, rec.axis1, rec.axis2), 0.05)
                self.assertLess(error_deg(one, other.j1, other.j2), 0.05)
                difference = one.bias2 - BIAS_RAD_S * cr.make_frame(rec.axis2).u
                self.assertLess(np.linalg.norm(one.bias1), 0.1 * BIAS_RAD_S)
                self.assertLess(np.linalg.norm(difference), 0.1 * BIAS_RAD_S)

    def test_the_axes_of_planar_motion_leave_lengths_alike_to_first_order(self):
        rec = simulate_hinge(replace(PLANAR, seed=5))
        samples, point = cr.Samples(*data(rec)), cr.make_point(rec.axis1, rec.axis2)
        self.assertLess(np.abs(cr.length_rows(samples)(point)[1][:, cr.TILTS]).max(), 1e-9)
        vectors = cr.vector_rows(samples)(point)[1][:, cr.TILTS]
        self.assertGreater(np.linalg.svd(vectors, compute_uv=False)[-1], 10.0)


if __name__ == "__main__":
    unittest.main()
