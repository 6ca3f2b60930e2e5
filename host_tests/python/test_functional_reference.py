"""The float64 reference of the functional joint: sums, derivatives by differences, elimination, symmetries, an exact hinge."""

import sys
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

from jointcal_tools import functional_reference as fr  # noqa: E402
from jointcal_tools import functional_sensor as fs  # noqa: E402
from jointcal_tools.simulate import HingeSpec, simulate_hinge  # noqa: E402

SECONDS = 14.0
LEANING = HingeSpec(motions=(("7", SECONDS),), rate_hz=50.0, seed=5, soft_tissue_deg=1.0, acc_bias=0.3, gyr_bias_deg_s=1.0)
# At rest at first, so that the level frames are right from the beginning.
EXACT = HingeSpec(motions=(("rest", 2.0), ("14", SECONDS)), rate_hz=100.0, seed=2, noise_scale=0.0)
LEAN_RAD, LEAST_LEAN_RAD = 0.08, 0.006  # turns are tied to the heading, and follow a part of it


def ticks_of(rec):
    sensors = ((rec.gyr1, rec.acc1), (rec.gyr2, rec.acc2))
    return list(zip(*(fs.features(rec.t_s, fs.orientation(rec.t_s, g, a), g, a) for g, a in sensors), strict=True))


def turned(tick, heading):
    """A tick whose level frame has another heading."""
    rz = fr.about_z(heading)
    return tick._replace(turn=rz @ tick.turn, rate=rz @ tick.rate, lever=rz @ tick.lever, velocity=rz @ tick.velocity)


def drifting(pairs, rad_s):
    return [(a, turned(b, np.exp(1j * (0.7 + rad_s * b.t_s)))) for a, b in pairs]


def leaning(pairs):
    """Level frames of sensor 2 that lean, slowly another way: relative turns are no turns about z then."""
    out = []
    for a, b in pairs:
        lean = fr.turn_of(LEAN_RAD * np.array([np.cos(0.1 * b.t_s), np.sin(0.1 * b.t_s), 0.0]))
        out.append((a, b._replace(turn=lean @ b.turn, rate=lean @ b.rate, lever=lean @ b.lever, velocity=lean @ b.velocity)))
    return out


def joint_of(pairs):
    joint = fr.Joint()
    for pair in pairs:
        joint.add(*pair)
    return joint


def settle(joint, point, rounds=100):
    """Headings and relative turns of `point` <- the best for its axes."""
    for _ in range(rounds):
        for b in range(fr.BLOCKS):
            fr.find_heading(joint.sums, point, b)


def error_deg(a, b):
    return float(np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b)), abs(a @ b))))


def second_differences(f, n, h):
    """(n, n) Hessian of f at 0."""
    e = h * np.eye(n)
    return np.array([[(f(e[i] + e[k]) - f(e[i] - e[k]) - f(e[k] - e[i]) + f(-e[i] - e[k])) / (4 * h * h) for k in range(n)]
                     for i in range(n)])


class Moved:
    """A point with its axes moved along tangents and block b turned, the heading going along about z."""

    def __init__(self, joint):
        self.sums, self.point = joint.sums, joint.point
        _, _, self.t = fr.tangent_hessian(np.eye(6), joint.point)

    def at(self, axes=(0, 0, 0, 0), turn=(0, 0, 0), b=0):
        p = self.point.copy()
        step = self.t @ np.asarray(axes, float)
        p.j1, p.j2 = fr.moved(p.j1, step[:3]), fr.moved(p.j2, step[3:])
        p.turn[b] = p.turn[b] @ fr.turn_of(np.asarray(turn, float))
        p.heading[b] = p.heading[b] * np.exp(1j * turn[2])
        return p

    def cost(self, axes=(0, 0, 0, 0), turn=(0, 0, 0), b=0):
        return fr.cost(self.sums, self.at(axes, turn, b))


class SumsTest(unittest.TestCase):
    def test_sums_are_the_residuals(self):
        """A few ticks by hand: three blocks, each with another heading, the oldest one merged."""
        rng = np.random.default_rng(0)
        point = fr.Point(*(v / np.linalg.norm(v) for v in rng.standard_normal((2, 3))), *rng.standard_normal((2, 3)))
        sums, squares, own = fr.Sums(), np.zeros(3), 0.0
        for k in range(3):
            if k > 0:
                sums.close(point)
            point.heading[0] = complex(np.exp(1j * rng.uniform(-3, 3)))
            point.turn[0] = fr.nearest_rotation(rng.standard_normal((3, 3)))
            for _ in range(4):
                a, b = (fs.Tick(0.0, 0.05, 1, fr.nearest_rotation(rng.standard_normal((3, 3))), *rng.standard_normal((2, 3, 3)),
                                *rng.standard_normal((2, 3)), 9.81) for _ in range(2))
                w = fr.weights_of(0.05, rng.uniform(0.1, 4.0))
                sums.add(a, b, w)
                rz, f1, f2 = fr.about_z(point.heading[0]), fr.lever_rows(a), fr.lever_rows(b)
                turn = a.turn @ point.j1 - rz @ b.turn @ point.j2
                rate = a.rate @ point.j1 - point.turn[0] @ b.rate @ point.j2
                lever = f1 @ point.x1 - rz @ f2 @ point.x2
                squares += [w.motion_s * turn @ turn, w.spin * rate @ rate, w.motion_s * lever @ lever]
                own += w.motion_s * (np.sum((f1 @ point.x1) ** 2) + np.sum((f2 @ point.x2) ** 2))
        cross = fr.cross_of(sums, point)
        turns, rates = fr.quadrics(sums, cross)
        left = fr.lever_squares(sums, cross.lever, point.x1, point.x2)
        np.testing.assert_allclose([point.j @ turns @ point.j, point.j @ rates @ point.j, *left], [*squares, own], rtol=1e-12)

    def test_reversing_twice_changes_nothing_but_relative_turns(self):
        joint = joint_of(ticks_of(simulate_hinge(LEANING)))
        sums = joint.sums
        before = [x.copy() for x in (sums.old_turn, sums.old_lever, sums.old_rate)]
        self.assertGreater(np.abs(before[2]).max(), 0.0)
        sums.reverse()
        first = sums.rate_free.copy()
        np.testing.assert_allclose(sums.old_turn, -before[0])
        sums.reverse()
        for now, was in zip((sums.old_turn, sums.old_lever, sums.old_rate), before, strict=True):
            np.testing.assert_allclose(now, was)
        up = sums.rate_free - sums.old_rate
        np.testing.assert_allclose(first, up - sums.old_rate, atol=1e-12)


class Derivatives(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.joint = joint_of(drifting(leaning(ticks_of(simulate_hinge(LEANING))), 0.01))
        settle(cls.joint, cls.joint.point)
        cls.moved = Moved(cls.joint)

    def test_the_point_is_a_hard_one(self):
        """Relative turns that lean, merged sums, both blocks with motion."""
        for b in range(fr.BLOCKS):
            lean = self.joint.point.turn[b][2, 2]
            self.assertLess(lean, np.cos(LEAST_LEAN_RAD))
            self.assertGreater(self.joint.sums.blocks[b].motion_s, 0.3)
        self.assertGreater(np.abs(self.joint.sums.old_turn).max(), 0.1)

    def test_slope_and_hessian_of_the_axes(self):
        h = fr.weighted_quadric(self.joint.sums, fr.cross_of(self.joint.sums, self.joint.point), self.joint.point)
        hessian, slope, _ = fr.tangent_hessian(h, self.joint.point)
        step = 1e-5
        numeric = [(self.moved.cost(step * e) - self.moved.cost(-step * e)) / (2 * step) for e in np.eye(4)]
        np.testing.assert_allclose(slope, numeric, atol=1e-6 * np.abs(hessian).max())
        numeric = second_differences(self.moved.cost, 4, 1e-3)
        np.testing.assert_allclose(hessian, numeric, atol=1e-5 * np.abs(hessian).max())

    def test_slope_and_hessian_of_a_turn(self):
        """D alone, heading held: first derivative anywhere, second derivative too."""
        rng = np.random.default_rng(1)
        for b in range(fr.BLOCKS):
            m = fr.rate_pull(self.joint.sums, self.joint.point, b)
            d = fr.nearest_rotation(rng.standard_normal((3, 3)))
            n = d.T @ m
            numeric = [-np.trace((d @ fr.turn_of(1e-5 * e) - d @ fr.turn_of(-1e-5 * e)).T @ m) / 2e-5 for e in np.eye(3)]
            np.testing.assert_allclose(fr.slope_vector(n), numeric, atol=1e-7 * np.abs(n).max())
            sym = 0.5 * (n + n.T)
            numeric = second_differences(lambda t, d=d, m=m: -np.trace((d @ fr.turn_of(t)).T @ m), 3, 1e-3)
            np.testing.assert_allclose(np.trace(sym) * np.eye(3) - sym, numeric, atol=1e-5 * np.abs(n).max())

    def test_pulls_are_slopes_of_the_heading(self):
        for b in range(fr.BLOCKS):
            p, h = self.joint.point.copy(), 1e-5
            slopes = []
            for s in (h, -h):
                q = p.copy()
                q.heading[b] *= np.exp(1j * s)
                slopes.append(fr.cost(self.joint.sums, q) + fr.KAPPA * np.trace(q.turn[b].T @ fr.about_z(q.heading[b])))
            pull = p.heading[b] * (fr.turn_pull(self.joint.sums, p, b) + fr.lever_pull(self.joint.sums, p, b))
            self.assertAlmostEqual((slopes[0] - slopes[1]) / (2 * h), pull.imag, delta=1e-6 * abs(pull))

    def test_couplings_with_the_heading_in_the_third_column(self):
        h = 1e-4
        for b in range(fr.BLOCKS):
            q = self.moved.t.T @ fr.coupling(self.joint.sums, self.joint.point, b)
            numeric = np.array([[(self.moved.cost(h * u, h * v, b) - self.moved.cost(h * u, -h * v, b)
                                  - self.moved.cost(-h * u, h * v, b) + self.moved.cost(-h * u, -h * v, b)) / (4 * h * h)
                                 for v in np.eye(3)] for u in np.eye(4)])
            np.testing.assert_allclose(q, numeric, atol=2e-5 * np.abs(q).max())

    def test_nuisances_but_for_how_far_the_turn_leans(self):
        """The tie of D to Rz is counted as if D did not lean: off by kappa times the lean between z and the others."""
        for b in range(fr.BLOCKS):
            he = fr.nuisance(self.joint.sums, self.joint.point, b)
            numeric = second_differences(lambda t, b=b: self.moved.cost(turn=t, b=b), 3, 1e-3)
            lean = np.arccos(np.clip(self.joint.point.turn[b][2, 2], -1.0, 1.0))
            np.testing.assert_allclose(he, numeric, atol=fr.KAPPA * lean * 1.1 + 1e-3)

    def test_slopes_of_the_nuisances_away_from_their_best(self):
        for b in range(fr.BLOCKS):
            p = self.moved.at(turn=(0.03, -0.02, 0.05), b=b)
            p.heading[b] *= np.exp(0.04j)
            away = Moved(self.joint)
            away.point = p
            numeric = [(away.cost(turn=1e-5 * e, b=b) - away.cost(turn=-1e-5 * e, b=b)) / 2e-5 for e in np.eye(3)]
            found = fr.nuisance_slope(self.joint.sums, p, b)
            np.testing.assert_allclose(found, numeric, atol=1e-6 * np.abs(fr.nuisance(self.joint.sums, p, b)).max())

    def test_one_step_is_enough_near_the_minimum(self):
        """Axes, headings and turns all off: the step of the axes ends where everything is best, but for second order."""
        best = self.joint.point.copy()
        for _ in range(200):
            step = np.linalg.solve(*fr.information(self.joint.sums, best)[:2])
            best.j1, best.j2 = fr.moved(best.j1, -self.t3(best)[:3] @ step), fr.moved(best.j2, -self.t3(best)[3:] @ step)
            settle(self.joint, best, 1)
        off = best.copy()
        off.j1, off.j2 = fr.moved(best.j1, 0.01 * fr.tangents(best.j1)[:, 0]), fr.moved(best.j2, 0.02 * fr.tangents(best.j2)[:, 1])
        off.turn = [d @ fr.turn_of(np.array([0.01, -0.02, 0.01])) for d in best.turn]
        off.heading = [h * np.exp(0.02j) for h in best.heading]
        fr.bounds_of(self.joint.sums, off)
        self.assertLess(max(error_deg(off.j1, best.j1), error_deg(off.j2, best.j2)), 0.05 * np.degrees(0.02))

    @staticmethod
    def t3(point):
        return fr.tangent_hessian(np.eye(6), point)[2]

    def test_information_is_that_of_eliminated_headings_and_turns(self):
        """Minima over headings and turns for axes moved by +-h, and their second differences, against the closed form."""
        found, _, _ = fr.information(self.joint.sums, self.joint.point)

        def least(axes):
            p = self.moved.at(axes)
            settle(self.joint, p, 100)
            return fr.cost(self.joint.sums, p)

        numeric = second_differences(least, 4, 3e-3)
        widths = [np.sqrt([np.linalg.eigvalsh(np.linalg.inv(m)[s, s])[-1] for s in (slice(0, 2), slice(2, 4))])
                  for m in (found, numeric)]
        np.testing.assert_allclose(widths[0], widths[1], rtol=0.01)


class SolveTest(unittest.TestCase):
    def test_an_exact_hinge(self):
        rec = simulate_hinge(EXACT)
        joint = joint_of(drifting(ticks_of(rec), 0.002))
        self.assertEqual(joint.verdict.reason, "")
        self.assertLess(max(error_deg(joint.point.j1, rec.axis1), error_deg(joint.point.j2, rec.axis2)), 0.3)
        self.assertGreater((joint.point.j1 @ rec.axis1) * (joint.point.j2 @ rec.axis2), 0.0)

    def test_sensors_may_be_exchanged(self):
        pairs = ticks_of(simulate_hinge(LEANING))
        one, other = joint_of(pairs), joint_of([(b, a) for a, b in pairs])
        self.assertLess(max(error_deg(one.point.j1, other.point.j2), error_deg(one.point.j2, other.point.j1)), 0.01)
        np.testing.assert_allclose(one.verdict.bounds, other.verdict.bounds[::-1], rtol=1e-3)
        np.testing.assert_allclose([h.real for h in one.point.heading], [h.real for h in other.point.heading], atol=1e-4)

    def test_gaps_before_an_estimate_leave_nothing_behind(self):
        """Pieces that are too short for a heading are forgotten, not merged with any."""
        rec = simulate_hinge(EXACT)
        pairs = ticks_of(rec)
        pieces = [tuple(t._replace(epoch=min(1 + k // 8, 6)) for t in pair) for k, pair in enumerate(drifting(pairs, 0.0))]
        joint = joint_of(pieces)
        self.assertLess(max(error_deg(joint.point.j1, rec.axis1), error_deg(joint.point.j2, rec.axis2)), 0.5)


if __name__ == "__main__":
    unittest.main()
