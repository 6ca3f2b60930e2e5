"""The float64 reference of hip and knee, SAL15, against residuals by hand, differences, exact chains and the simulator."""

import sys
import unittest
from dataclasses import replace
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

import exact_joint as exact  # noqa: E402
from jointcal_tools import ols17, sal15  # noqa: E402
from jointcal_tools import quaternions as quat  # noqa: E402
from jointcal_tools.recordings import Recording  # noqa: E402
from jointcal_tools.sal15 import Ingredients  # noqa: E402
from jointcal_tools.simulate_chain import ChainSpec, simulate_chain  # noqa: E402

SEGMENT = np.array([0.05, -0.4, 0.03])  # hip to knee, frame of the thigh's sensor
HIP_TO_THIGH = np.array([0.04, -0.22, 0.06])
PLACES = np.array([[-0.05, 0.1, 0.08], HIP_TO_THIGH, HIP_TO_THIGH - SEGMENT, [0.03, -0.15, 0.02]])
BIASES = np.array([[0.1, -0.05, 0.02], [-0.1, 0.15, 0.05], [-0.1, 0.15, 0.05], [0.02, 0.0, -0.2]])
HEADINGS = (0.4, -1.1, 2.0)  # of the three sensors' earth frames: common earth to each of them, about z
LENGTH = np.linalg.norm(SEGMENT)
EXACT = (1e-4, 0.0)  # taken for usual where data are exact: priors of 0.3 move nothing then
SD = 0.05


def turned(turns, a, k):
    return np.einsum("nij,nj->ni", turns, a), turns @ k, turns


def exact_chain(n=300, seed=0, biases=None, noise_sd=0.0, step_s=0.1):
    """Hip and knee without any error but biases and white noise of the accelerometers."""
    rng = np.random.default_rng(seed)
    biases = np.zeros((4, 3)) if biases is None else biases
    force = exact.joint_force(rng, n)
    a_p, k_p, turn_p = exact.sensor(rng, force, PLACES[0])
    a_t, k_t, turn_t = exact.sensor(rng, force, PLACES[1])
    at_knee = force + np.einsum("nij,njk,k->ni", turn_t, k_t, SEGMENT)
    a_s, k_s, turn_s = exact.sensor(rng, at_knee, PLACES[3])
    a_p, a_t, a_s = (a + noise_sd * rng.standard_normal((n, 3)) for a in (a_p, a_t, a_s))
    t_s, own = step_s * np.arange(n), np.broadcast_to(np.eye(3), (n, 3, 3))
    earths = [exact.about_z(heading) @ turn for heading, turn in zip(HEADINGS, (turn_p, turn_t, turn_s), strict=True)]
    joints = []
    for first, (a1, k1, earth1), (a2, k2, earth2) in ((0, (a_p, k_p, earths[0]), (a_t, k_t, earths[1])),
                                                      (2, (a_t, k_t, earths[1]), (a_s, k_s, earths[2]))):
        a1, a2 = a1 + biases[first], a2 + biases[first + 1]
        joints.append(sal15.Joint(ols17.Samples(t_s, a1, k1, own, a2, k2, own),
                                  ols17.Samples(t_s, *turned(earth1, a1, k1), *turned(earth2, a2, k2))))
    return joints


def random_point(rng):
    return np.concatenate([rng.uniform(-0.3, 0.3, 12), rng.uniform(-0.3, 0.3, 12), rng.uniform(-3.0, 3.0, 2)])


def residuals(joint, x, first, use):
    """Residuals of one joint from all unknowns, written out once more; and |K r|^2 of both."""
    r1, r2 = x[3 * first: 3 * first + 3], x[3 * first + 3: 3 * first + 6]
    s = joint.oriented if use.orientations else joint.samples
    swing1, swing2 = np.einsum("nij,j->ni", s.k1, r1), np.einsum("nij,j->ni", s.k2, r2)
    swing = (swing1**2).sum(axis=1) + (swing2**2).sum(axis=1)
    if use.orientations:
        e = s.a1 - swing1 - (exact.about_z(x[24 + first // 2]) @ (s.a2 - swing2).T).T
        return e.ravel(), np.repeat(swing, 3)
    b1, b2 = x[12 + 3 * first: 15 + 3 * first], x[15 + 3 * first: 18 + 3 * first]
    return np.linalg.norm(s.a1 - b1 - swing1, axis=1) - np.linalg.norm(s.a2 - b2 - swing2, axis=1), swing


def whole_cost(joints, x, use, noise, weights_at):
    """Half of the weighted sum of squares of everything; weights as they are at another point."""
    total = 0.0
    for joint, first in zip(joints, (0, 2), strict=True):
        e, _ = residuals(joint, x, first, use)
        _, swing = residuals(joint, weights_at, first, use)
        total += (e**2 / (noise[0] ** 2 + noise[1] ** 2 * swing)).sum()
    segment = x[3:6] - x[6:9]
    total += (x[:12] ** 2).sum() / 0.3**2 + (x[12:24] ** 2).sum() / (0.3 if use.biases else 1e-4) ** 2
    if use.shared_bias:
        total += ((x[15:18] - x[18:21]) ** 2).sum() / 1e-3**2
    if use.thigh_m is not None:
        total += (np.linalg.norm(segment) - use.thigh_m) ** 2 / use.thigh_sd_m**2
    if use.normal is not None:
        total += (use.normal @ segment) ** 2 / use.normal_sd_m**2
    return 0.5 * total


def without(a, direction):
    return a - np.outer(a @ direction, direction)


class Rows(unittest.TestCase):
    def setUp(self):
        self.rng = np.random.default_rng(1)
        self.hip, self.knee = exact_chain(50)

    def test_heading_turns_about_the_vertical(self):
        np.testing.assert_allclose(sal15.heading_matrix(np.pi / 2.0) @ [1.0, 2.0, 3.0], [-2.0, 1.0, 3.0], atol=1e-15)

    def test_vector_residual_by_hand(self):
        # The joint feels (3, 0, 10) in sensor 1's earth; seen from sensor 2's, a quarter turn ahead, (0, -3, 10).
        # Sensor 1 turns with 2 rad/s about z, 0.5 m along x: 2 m/s^2 inwards on top. Sensor 2 does not turn.
        own = np.eye(3)[None]
        s = ols17.Samples(np.zeros(1), np.array([[1.0, 0.0, 10.0]]), exact.printed_k(np.array([[0.0, 0.0, 2.0]]), np.zeros((1, 3))),
                          own, np.array([[0.0, -3.0, 10.0]]), np.zeros((1, 3, 3)), own)
        joint, r1 = sal15.Joint(s, s), np.array([0.5, 0.0, 0.0])
        e, _, swing = sal15.vector_rows(joint, r1, np.zeros(3), np.pi / 2.0)
        np.testing.assert_allclose(e, 0.0, atol=1e-14)
        np.testing.assert_allclose(swing, 4.0, atol=1e-14)
        np.testing.assert_allclose(sal15.vector_rows(joint, r1, np.zeros(3), 0.0)[0], [3.0, 3.0, 0.0], atol=1e-14)
        np.testing.assert_allclose(sal15.vector_rows(joint, 0.0 * r1, np.zeros(3), np.pi / 2.0)[0], [-2.0, 0.0, 0.0], atol=1e-14)

    def test_vector_slopes_agree_with_central_differences(self):
        for _ in range(3):
            x = np.concatenate([self.rng.uniform(-0.3, 0.3, 6), self.rng.uniform(-3.0, 3.0, 1)])
            slopes = sal15.vector_rows(self.hip, x[:3], x[3:6], x[6])[1]
            numeric = exact.central_difference(lambda at: sal15.vector_rows(self.hip, at[:3], at[3:6], at[6])[0], x)
            np.testing.assert_allclose(slopes, numeric, atol=1e-7 * np.abs(slopes).max())

    def test_a_joints_matrix_and_gradient_stand_at_its_own_unknowns(self):
        x, noise = random_point(self.rng), (0.07, 0.03)
        joints = exact_chain(50, step_s=0.04)  # two and a half of them count as one reading, of 0.1 s
        for use in (Ingredients(), Ingredients(orientations=True)):
            for joint, first in zip(joints, (0, 2), strict=True):
                e, swing = residuals(joint, x, first, use)
                slopes = exact.central_difference(lambda at, j=joint, f=first, u=use: residuals(j, at, f, u)[0], x)
                weight = 0.4 / (noise[0] ** 2 + noise[1] ** 2 * swing)
                matrix, gradient, total, readings = sal15.joint_system(joint, x, first, use, noise)
                expected = (slopes * weight[:, None]).T @ slopes
                np.testing.assert_allclose(matrix, expected, atol=1e-6 * np.abs(expected).max())
                expected = slopes.T @ (weight * e)
                np.testing.assert_allclose(gradient, expected, atol=1e-6 * np.abs(expected).max())
                self.assertAlmostEqual(total / (weight @ e**2), 1.0, places=9)
                self.assertAlmostEqual(readings, 0.4 * len(e), places=6)

    def test_soft_rows_have_the_slopes_of_their_residuals(self):
        normal = np.array([0.6, 0.0, 0.8])
        use = Ingredients(biases=True, shared_bias=True, thigh_m=0.45, normal=normal)
        x = random_point(self.rng)
        rows = sal15.soft_rows(x, use)
        numeric = exact.central_difference(lambda at: np.array([e for _, e, _ in sal15.soft_rows(at, use)]), x)
        for k, (slope, _, _) in enumerate(rows):
            if slope[24] == 0.0 and slope[25] == 0.0:
                np.testing.assert_allclose(slope, numeric[k], atol=1e-8)
        # 24 priors and 2 of headings, 3 of biases, length, plane.
        self.assertEqual(len(rows), 24 + 2 + 3 + 1 + 1)
        segment = x[3:6] - x[6:9]
        self.assertAlmostEqual(rows[-2][1], np.linalg.norm(segment) - 0.45, places=12)
        self.assertAlmostEqual(rows[-1][1], 0.6 * segment[0] + 0.8 * segment[2], places=12)
        self.assertEqual((rows[-2][2], rows[-1][2]), (use.thigh_sd_m, use.normal_sd_m))

    def test_headings_move_freely_and_biases_do_not_unless_they_are_asked_for(self):
        # Headings have no residual of their own: their rows only hold a step back.
        for use, bias_sd, heading_sd in ((Ingredients(), 1e-4, 1e-4), (Ingredients(orientations=True), 1e-4, 3.0),
                                         (Ingredients(biases=True), 0.3, 1e-4)):
            rows = sal15.soft_rows(random_point(self.rng), use)
            of_biases = [sd for slope, _, sd in rows if slope[12:24].any()]
            of_headings = [(e, sd) for slope, e, sd in rows if slope[24:].any()]
            self.assertEqual(of_biases, [bias_sd] * 12)
            self.assertEqual(of_headings, [(0.0, heading_sd)] * 2)


class Solution(unittest.TestCase):
    def test_exact_data_give_the_exact_places_by_lengths_and_by_vectors(self):
        hip, knee = exact_chain()
        for use in (Ingredients(), Ingredients(biases=True), Ingredients(orientations=True),
                    Ingredients(biases=True, shared_bias=True, thigh_m=LENGTH)):
            fit = sal15.solve(hip, knee, use, EXACT)
            np.testing.assert_allclose(fit.places, PLACES, atol=1e-6)
            self.assertAlmostEqual(fit.segment_m, LENGTH, places=6)
            self.assertLess(fit.residual, 1e-2)

    def test_each_joint_by_itself_gives_what_ols17_gives(self):
        hip, knee = exact_chain(noise_sd=SD)
        fit = sal15.solve(hip, knee, Ingredients(biases=True), (0.05, 0.01))
        for joint, first in ((hip, 0), (knee, 2)):
            own = ols17.solve_lengths(joint.samples, reach_m=0.3, bias=0.3, noise=(0.05, 0.01), smoothing_s=0.2)
            # ols17 makes the prior count more by the residuals' excess; here it does not.
            np.testing.assert_allclose(fit.places[first: first + 2], [own.r1, own.r2], atol=2e-4)
            np.testing.assert_allclose(fit.biases[first: first + 2], [own.bias1, own.bias2], atol=2e-3)

    def test_biases_are_found_with_bias_states_only(self):
        hip, knee = exact_chain(biases=BIASES)
        fit = sal15.solve(hip, knee, Ingredients(biases=True), EXACT)
        np.testing.assert_allclose(fit.places, PLACES, atol=1e-6)
        np.testing.assert_allclose(fit.biases, BIASES, atol=1e-6)
        plain = sal15.solve(hip, knee, Ingredients(), (0.05, 0.0))
        self.assertGreater(np.abs(plain.places - PLACES).max(), 1e-3)
        self.assertLess(np.abs(plain.biases).max(), 1e-4)

    def test_headings_are_those_of_the_earth_frames(self):
        hip, knee = exact_chain()
        x = np.zeros(sal15.UNKNOWNS)
        x[sal15.PLACES] = PLACES.ravel()
        # From the second sensor's earth to the first one's; both are turned against a common one.
        for joint, first, expected in ((hip, 0, HEADINGS[0] - HEADINGS[1]), (knee, 2, HEADINGS[1] - HEADINGS[2])):
            apart = sal15.best_heading(joint, x, first) - expected
            self.assertAlmostEqual(np.angle(np.exp(1j * apart)), 0.0, places=9)

    def test_vectors_do_not_depend_on_where_the_headings_are(self):
        hip, knee = exact_chain(noise_sd=SD)
        fit = sal15.solve(hip, knee, Ingredients(orientations=True), (SD * np.sqrt(2.0), 0.0))
        turn = exact.about_z(2.4)
        s = knee.oriented
        elsewhere = replace(s, a2=s.a2 @ turn.T, k2=turn @ s.k2, turn2=turn @ s.turn2)
        again = sal15.solve(hip, sal15.Joint(knee.samples, elsewhere), Ingredients(orientations=True), (SD * np.sqrt(2.0), 0.0))
        np.testing.assert_allclose(again.places, fit.places, atol=1e-8)

    def test_solution_is_stationary_with_every_tie(self):
        hip, knee = exact_chain(biases=BIASES + 0.1 * np.eye(4, 3), noise_sd=SD)
        normal, noise = np.array([0.6, 0.0, 0.8]), (0.05, 0.02)
        for use in (Ingredients(biases=True), Ingredients(biases=True, shared_bias=True), Ingredients(biases=True, thigh_m=0.42),
                    Ingredients(biases=True, normal=normal), Ingredients(biases=True, shared_bias=True, thigh_m=0.42, normal=normal)):
            fit = sal15.solve(hip, knee, use, noise)
            x = np.concatenate([fit.places.ravel(), fit.biases.ravel(), [0.0, 0.0]])

            def cost(at, use=use, x=x):
                return np.array([whole_cost((hip, knee), at, use, noise, x)])

            slope = exact.central_difference(cost, x)[0]
            # In units of the standard deviation of each unknown.
            sd = np.sqrt(np.diag(np.linalg.inv(fit.matrix)))
            self.assertLess(np.abs(slope * sd).max(), 1e-4)

    def test_stated_deviations_are_the_scatter_of_the_places(self):
        noise, runs = (np.sqrt(2.0) * SD, 0.0), 30  # a residual has the noise of two accelerometers
        scaled, sizes = [], []
        for seed in range(runs):
            hip, knee = exact_chain(150, seed=seed, noise_sd=SD)
            fit = sal15.solve(hip, knee, Ingredients(), noise)
            scaled.append((fit.places - PLACES) / fit.sd_m)
            sizes.append(fit.residual)
        # 360 values, twelve of a run not quite independent: the root of their mean square is good to 5 %.
        self.assertAlmostEqual(np.sqrt(np.mean(np.square(scaled))), 1.0, delta=0.15)
        self.assertAlmostEqual(np.sqrt(np.mean(np.square(sizes))), 1.0, delta=0.05)

    def test_deviations_grow_with_residuals_beyond_the_usual_and_do_not_shrink(self):
        hip, knee = exact_chain(noise_sd=SD)
        small, right, large = (sal15.solve(hip, knee, Ingredients(), (factor * np.sqrt(2.0) * SD, 0.0)) for factor in (0.1, 1.0, 10.0))
        np.testing.assert_allclose(small.sd_m, right.sd_m, rtol=0.1)
        np.testing.assert_allclose(large.sd_m, 10.0 * right.sd_m, rtol=0.1)
        self.assertAlmostEqual(small.residual / large.residual, 100.0, delta=1.0)


class Ties(unittest.TestCase):
    def test_one_accelerometer_has_one_bias(self):
        unlike = BIASES.copy()
        unlike[2] = [0.1, -0.1, 0.0]  # as no accelerometer would
        hip, knee = exact_chain(biases=unlike, noise_sd=SD)
        noise = (np.sqrt(2.0) * SD, 0.0)
        free = sal15.solve(hip, knee, Ingredients(biases=True), noise)
        tied = sal15.solve(hip, knee, Ingredients(biases=True, shared_bias=True), noise)
        self.assertGreater(np.abs(free.biases[1] - free.biases[2]).max(), 0.1)
        self.assertLess(np.abs(tied.biases[1] - tied.biases[2]).max(), 2e-3)
        between = (tied.biases[1] - free.biases[1]) / (free.biases[2] - free.biases[1])
        self.assertTrue(np.all((between > 0.1) & (between < 0.9)))  # both joints give in

    def test_a_known_length_is_kept_and_costs_nothing_where_it_is_right(self):
        hip, knee = exact_chain(noise_sd=SD)
        noise = (np.sqrt(2.0) * SD, 0.0)
        free = sal15.solve(hip, knee, Ingredients(), noise)
        for length in (LENGTH, 0.38):
            tied = sal15.solve(hip, knee, Ingredients(thigh_m=length, thigh_sd_m=1e-5), noise)
            self.assertAlmostEqual(tied.segment_m, length, delta=2e-4)
        self.assertGreater(np.abs(free.segment_m - 0.38), 0.01)
        right = sal15.solve(hip, knee, Ingredients(thigh_m=LENGTH), noise)
        self.assertTrue(np.all(right.sd_m <= free.sd_m * 1.001))

    def test_the_plane_takes_the_thigh_in(self):
        hip, knee = exact_chain(noise_sd=SD)
        normal, noise = np.array([0.6, 0.0, 0.8]), (np.sqrt(2.0) * SD, 0.0)
        free = sal15.solve(hip, knee, Ingredients(), noise)
        tied = sal15.solve(hip, knee, Ingredients(normal=normal, normal_sd_m=1e-5), noise)
        self.assertGreater(abs(normal @ (free.places[1] - free.places[2])), 0.03)
        self.assertLess(abs(normal @ (tied.places[1] - tied.places[2])), 1e-4)

    def test_a_length_closes_what_a_knee_that_only_turns_about_the_thigh_leaves_open(self):
        # Thigh and shank turn about one direction at the knee, so that its place along it is not seen.
        hip, knee = exact_chain()
        rng, along, n = np.random.default_rng(5), SEGMENT / LENGTH, 300
        force = exact.joint_force(rng, n)
        w, dw = np.outer(rng.standard_normal(n), along), np.outer(10.0 * rng.standard_normal(n), along)
        s = knee.samples
        k2 = s.k2
        own = np.einsum("nji,nj->ni", exact.random_turns(rng, n), force) + np.einsum("nij,j->ni", k2, PLACES[3])
        knee = sal15.Joint(ols17.Samples(s.t_s, exact.felt_at(force, w, dw, PLACES[2]), exact.printed_k(w, dw), s.turn1,
                                         own, k2, s.turn2))
        free = sal15.solve(hip, knee, Ingredients(), EXACT)
        tied = sal15.solve(hip, knee, Ingredients(thigh_m=LENGTH, thigh_sd_m=1e-4), EXACT)
        np.testing.assert_allclose(without(free.places[2:3], along), without(PLACES[2:3], along), atol=1e-5)
        self.assertGreater(np.linalg.norm(free.places[2] - PLACES[2]), 0.05)
        np.testing.assert_allclose(tied.places[2], PLACES[2], atol=1e-5)
        self.assertGreater(free.sd_m[2] @ np.abs(along), 0.1)
        self.assertLess(tied.sd_m[2] @ np.abs(along), 0.01)


class SimulatedChain(unittest.TestCase):
    def test_lively_motion_gives_all_places_by_lengths_and_by_vectors(self):
        rec = simulate_chain(ChainSpec(type=2, seconds=20.0, rate_hz=50.0, seed=1, noise_scale=0.0))
        pairs = []
        for k in (0, 1):
            two = Recording(rec.t_s, rec.gyr[k], rec.acc[k], rec.gyr[k + 1], rec.acc[k + 1])
            pairs.append(sal15.Joint(ols17.prepare(two),
                                     ols17.prepare(two, orientations=(quat.matrices(rec.q[k]), quat.matrices(rec.q[k + 1])))))
        for use in (Ingredients(), Ingredients(orientations=True)):
            fit = sal15.solve(*pairs, use)
            np.testing.assert_allclose(fit.places, rec.places(), atol=2e-3)
            self.assertAlmostEqual(fit.segment_m, rec.spec.thigh_m, delta=2e-3)


if __name__ == "__main__":
    unittest.main()
