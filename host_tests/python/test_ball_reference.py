"""The float64 reference of joints without an axis, or with two: sums, derivatives by differences, profiles of the cost, exact joints, windows."""

import sys
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))
sys.path.insert(0, str(Path(__file__).resolve().parent))

import exact_joint  # noqa: E402

from jointcal_tools import ball_reference as br  # noqa: E402
from jointcal_tools import functional_sensor as fs  # noqa: E402

TICK_S = 0.05
STEP_S = 0.0625  # of ticks in windows: sums of it are exact, so that parts end where they should
R1, R2 = np.array([0.05, -0.20, 0.06]), np.array([-0.04, 0.12, 0.15])


def turned(tick, angle):
    """A tick whose level frame has another heading."""
    rz = exact_joint.about_z(angle)
    return tick._replace(turn=rz @ tick.turn, rate=rz @ tick.rate, lever=rz @ tick.lever, velocity=rz @ tick.velocity)


def random_ticks(rng, n, heading=0.0, noise=0.0, epoch=1, level=9.81):
    """n pairs of ticks that share nothing but the joint's centre; the equation holds but for `noise`, m/s."""
    turns = exact_joint.random_turns(rng, 2 * n)
    pairs = []
    for k in range(n):
        centre = 0.5 * rng.standard_normal(3)
        both = []
        for turn, r in ((turns[2 * k], R1), (turns[2 * k + 1], R2)):
            lever = rng.standard_normal((3, 3))
            velocity = centre + lever @ r + noise * rng.standard_normal(3)
            both.append(fs.Tick(TICK_S * k, TICK_S, epoch, turn, lever, lever, velocity, 2.0 * rng.standard_normal(3), level))
        pairs.append((both[0], turned(both[1], -heading)))
    return pairs


def add_all(sums, pairs):
    for a, b in pairs:
        sums.add(a, b, TICK_S, 0.5 * TICK_S)


def close_block(sums, heading):
    """As Ball.close, of the sums alone."""
    sums.old = sums.old + (heading * sums.blocks[1].lever).real
    sums.blocks = [br.Block(), sums.blocks[0]]


def unit(angle):
    return complex(np.exp(1j * angle))


def rotation(axis, angle):
    """Rodrigues' formula."""
    x, y, z = axis
    k = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + np.sin(angle) * k + (1.0 - np.cos(angle)) * k @ k


class HardCase:
    """Noisy ticks of three blocks with headings that differ, the oldest merged and known from before, in a minimum without the ridge."""

    ANGLES = (0.70, 0.50, 0.85)

    def __init__(self):
        rng = np.random.default_rng(3)
        self.sums, self.past, self.point = br.Sums(), br.Past(unit(self.ANGLES[0]), 500.0), br.Point()
        for k, angle in enumerate(self.ANGLES):
            if k > 0:
                close_block(self.sums, unit(self.ANGLES[0]))
            add_all(self.sums, random_ticks(rng, 30, angle, noise=0.02))
        self.point.heading = [unit(0.5), unit(0.5)]
        with mock.patch.object(br, "RIDGE", 0.0):
            for _ in range(300):
                br.put_levers(self.sums, self.point)
                br.put_headings(self.sums, self.past, self.point)

    def moved(self, by):
        """by (8,): both levers, heading of the open and of the closed block. The residual's size is held."""
        p = self.point
        return br.Point(p.r + by[:6], [p.heading[0] * unit(by[6]), p.heading[1] * unit(by[7])], p.size, p.lack, p.speed2)

    def cost(self, by):
        return br.cost(self.sums, self.past, self.moved(by))

    def second_differences(self, h=1e-3):
        e = h * np.eye(8)
        return np.array([[(self.cost(a + b) - self.cost(a - b) - self.cost(b - a) + self.cost(-a - b)) / (4 * h * h) for b in e] for a in e])


class SumsTest(unittest.TestCase):
    def test_what_is_left_is_the_sum_of_squared_residuals(self):
        rng = np.random.default_rng(0)
        sums, past, headings, left, own = br.Sums(), br.Past(), [], 0.0, 0.0
        point = br.Point(rng.standard_normal(6))
        for k in range(3):
            if k > 0:
                close_block(sums, headings[0])
            headings.append(unit(rng.uniform(-3.0, 3.0)))
            for a, b in random_ticks(rng, 5, noise=1.0):
                w = rng.uniform(0.1, 1.0)
                sums.add(a, b, w, 0.5 * w)
                one, two = a.velocity - a.lever @ point.r[:3], b.velocity - b.lever @ point.r[3:]
                left += w * np.sum((one - exact_joint.about_z(np.angle(headings[k])) @ two) ** 2)
                own += w * (one @ one + two @ two)
        point.heading = [headings[2], headings[1]]
        tied = br.PULL * (np.conj(headings[2]) * headings[1]).real
        weight = 2.0 / br.weight_of(sums, point.size)
        self.assertAlmostEqual(weight * (br.cost(sums, past, point) + tied), left, delta=1e-9 * left)
        x = sums.cross(point.heading)
        self.assertAlmostEqual(point.x1 @ sums.lever1 @ point.x1 + point.x2 @ sums.lever2 @ point.x2, own, delta=1e-9 * own)
        self.assertAlmostEqual(own - 2.0 * point.x1 @ x @ point.x2, left, delta=1e-9 * own)

    def test_faded_sums_count_half_and_the_block_is_as_old_as_before(self):
        case = HardCase()
        before, time_s = br.Point(case.point.r, case.point.heading), case.sums.blocks[0].time_s
        br.put_levers(case.sums, before)
        motion_s, stiffness = case.sums.motion_s, br.stiffness(case.sums)
        case.sums.fade(0.5)
        after = br.Point(case.point.r, case.point.heading)
        br.put_levers(case.sums, after)
        np.testing.assert_allclose(after.r, before.r, rtol=1e-9)
        self.assertAlmostEqual(after.lack, 0.5 * before.lack, delta=1e-9 * before.lack)
        self.assertAlmostEqual(after.size, before.size, delta=1e-9 * before.size)
        self.assertAlmostEqual(case.sums.motion_s, 0.5 * motion_s)
        self.assertAlmostEqual(br.stiffness(case.sums), stiffness)
        self.assertEqual(case.sums.blocks[0].time_s, time_s)

    def test_rates_of_one_body_are_one_rotation_and_others_are_not(self):
        rng = np.random.default_rng(4)
        mount = exact_joint.random_turns(rng, 1)[0]
        one, two = br.Sums(), br.Sums()
        for a, b in random_ticks(rng, 40):
            one.add(a, b._replace(gyr=mount @ a.gyr), TICK_S, TICK_S)
            two.add(a, b, TICK_S, TICK_S)
        self.assertAlmostEqual(br.stiffness(one), 0.0)
        self.assertGreater(br.stiffness(two), 0.5)


class Derivatives(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.case = HardCase()

    def test_the_case_is_a_hard_one(self):
        """All headings differ, and everything that ties them is worth something."""
        sums, point, past = self.case.sums, self.case.point, self.case.past
        self.assertGreater(min(block.motion_s for block in sums.blocks), 1.0)
        self.assertGreater(np.abs(sums.old).max(), 0.1)
        angles = np.angle([*point.heading, past.heading])
        self.assertGreater(min(abs(angles[0] - angles[1]), abs(angles[1] - angles[2])), 1e-3)
        self.assertGreater(past.pull, 100.0)
        pulls = np.abs(br.pulls(sums, point))
        self.assertTrue(np.all((pulls > 0.1 * br.PULL) & (pulls < 50.0 * br.PULL)), pulls)

    def test_the_slope_vanishes_after_rounds(self):
        h = 1e-5
        slope = [(self.case.cost(h * e) - self.case.cost(-h * e)) / (2.0 * h) for e in np.eye(8)]
        # differences of a cost of some hundreds are known to 1e-16 of it, over 2 h
        scale = np.abs(br.information(self.case.sums, self.case.past, self.case.point)).max()
        np.testing.assert_allclose(slope, np.zeros(8), atol=1e-8 * scale)

    def test_information_is_the_second_derivative(self):
        found = br.information(self.case.sums, self.case.past, self.case.point)
        numeric = self.case.second_differences()
        # What ties headings is counted as if they were the same: off by one minus the cosine of how far they are apart.
        h, past = self.case.point.heading, self.case.past
        bent = br.PULL * (1.0 - (np.conj(h[0]) * h[1]).real) + past.pull * (1.0 - (np.conj(past.heading) * h[1]).real)
        np.testing.assert_allclose(found[:6], numeric[:6], atol=1e-5 * np.abs(found).max())
        np.testing.assert_allclose(found[6:, 6:], numeric[6:, 6:], atol=bent + 1e-5 * np.abs(found).max())

    def test_levers_are_the_minimum_with_the_ridge(self):
        """No other levers leave less, each of the six unknowns paid for by 3/10,000 of the mean diagonal."""
        sums, point = self.case.sums, br.Point(np.zeros(6), self.case.point.heading)
        br.put_levers(sums, point)
        x = sums.cross(point.heading)
        h, _ = sums.normal(x)

        def left(r):
            one, two = np.r_[1.0, -r[:3]], np.r_[1.0, -r[3:]]
            return one @ sums.lever1 @ one + two @ sums.lever2 @ two - 2.0 * one @ x @ two + 3e-4 * np.trace(h) / 6.0 * r @ r

        best = left(point.r)
        for step in 0.01 * np.random.default_rng(5).standard_normal((50, 6)):
            self.assertGreater(left(point.r + step), best)
        slopes = [left(point.r + e) - left(point.r - e) for e in 1e-4 * np.eye(6)]
        np.testing.assert_allclose(slopes, np.zeros(6), atol=1e-11 * best)

    def test_headings_are_the_minimum_given_each_other(self):
        sums, past = self.case.sums, self.case.past
        point = br.Point(self.case.point.r, [unit(0.9), unit(0.3)], self.case.point.size)
        for _ in range(200):
            br.put_headings(sums, past, point)
        best = br.cost(sums, past, point)
        for step in np.linspace(-3.0, 3.0, 61):
            for b in range(2):
                other = br.Point(point.r, list(point.heading), point.size)
                other.heading[b] *= unit(step)
                self.assertGreaterEqual(br.cost(sums, past, other), best - 1e-9)

    def test_bounds_are_those_of_the_profile_of_the_cost(self):
        """Variance of a heading and of the worst direction of a lever: one over the curvature once everything else follows, by solving."""
        found, heading = br.bounds(self.case.sums, self.case.past, self.case.point)
        numeric = self.case.second_differences()
        numeric += 1e-5 * np.max(np.diag(numeric)[:6]) * np.diag([1.0] * 6 + [0.0] * 2)

        def variance(direction):
            """Of direction . x, with the least cost among all x that have it at 1."""
            kkt = np.block([[numeric, direction[:, None]], [direction[None], np.zeros((1, 1))]])
            x = np.linalg.solve(kkt, np.r_[np.zeros(8), 1.0])[:8]
            return 1.0 / (x @ numeric @ x)

        self.assertAlmostEqual(heading, 2.0 * np.sqrt(variance(np.eye(8)[6])), delta=1e-3 * heading)
        directions = np.random.default_rng(6).standard_normal((4000, 3))
        directions /= np.linalg.norm(directions, axis=1, keepdims=True)
        for k, share in enumerate((0.17, 0.10)):
            r = self.case.point.r[3 * k: 3 * k + 3]
            widest = max(variance(np.r_[np.zeros(3 * k), d, np.zeros(5 - 3 * k)]) for d in directions)
            least = 0.003 + 0.5 * np.sqrt(widest) + share * np.linalg.norm(r)
            self.assertGreater(found[k], least)  # what errors of the regressors are worth comes on top
            self.assertLess(found[k] - least, 0.02)

    def test_a_heading_is_known_where_the_centre_is_open_along_a_line(self):
        """Rates about one line of each sensor leave the levers along it open; a heading hangs on the others only."""
        rng = np.random.default_rng(15)
        sums, point = br.Sums(), br.Point()
        across = np.diag([1.0, 1.0, 0.0])
        for a, b in random_ticks(rng, 60, noise=0.02):
            along = a.lever[:, 2] * R1[2], b.lever[:, 2] * R2[2]
            sums.add(a._replace(lever=a.lever @ across, velocity=a.velocity - along[0]),
                     b._replace(lever=b.lever @ across, velocity=b.velocity - along[1]), TICK_S, TICK_S)
        br.put_levers(sums, point)
        levers, heading = br.bounds(sums, br.Past(), point)
        self.assertLess(heading, 0.2)
        self.assertTrue(np.all(levers == br.UNKNOWN_M))
        full = br.information(sums, br.Past(), point)
        keep = [0, 1, 3, 4, 6]
        self.assertAlmostEqual(heading, 2.0 * np.sqrt(np.linalg.inv(full[np.ix_(keep, keep)])[4, 4]), delta=1e-2 * heading)

    def still_distal(self, turned):
        """Bounds with a distal segment that turns by `turned` of what it would."""
        rng = np.random.default_rng(16)
        sums, point = br.Sums(), br.Point()
        for a, b in random_ticks(rng, 200, noise=1e-5):
            lever = turned * b.lever
            sums.add(a, b._replace(lever=lever, velocity=b.velocity - (b.lever - lever) @ R2), TICK_S, TICK_S)
        for _ in range(20):
            br.put_levers(sums, point)
            br.put_headings(sums, br.Past(), point)
        return point, br.bounds(sums, br.Past(), point)

    def test_a_lever_that_nothing_tells_of_spoils_no_other(self):
        _, (both, heading) = self.still_distal(1.0)
        self.assertTrue(np.all(both < 0.05))
        for turned in (0.0, 1e-6, 1e-4):
            point, (levers, still) = self.still_distal(turned)
            self.assertEqual(levers[1], br.UNKNOWN_M)
            self.assertLess(np.linalg.norm(point.r[:3] - R1), levers[0])
            self.assertLess(levers[0], 0.05)
            self.assertAlmostEqual(still, heading, delta=0.2 * heading)

    def test_what_the_ridge_takes_is_in_the_bound(self):
        """2 % of the turning: a ridge that takes a share of the lever."""
        with mock.patch.object(br, "RIDGE", 1e-3):
            point, (levers, _) = self.still_distal(0.02)
        self.assertGreater(np.linalg.norm(point.r[3:] - R2), 0.03)
        self.assertLess(np.linalg.norm(point.r[3:] - R2), levers[1])
        self.assertLess(levers[1], br.UNKNOWN_M)

    def test_errors_of_the_regressors_are_worth_what_they_shorten_levers_by(self):
        rng = np.random.default_rng(7)
        sums, point = br.Sums(), br.Point()
        for a, b in random_ticks(rng, 4000):
            noise = 0.3 * rng.standard_normal((2, 3, 3))
            sums.add(a._replace(lever=a.lever + noise[0]), b._replace(lever=b.lever + noise[1]), TICK_S, TICK_S)
        with mock.patch.object(br, "RIDGE", 0.0):
            br.put_levers(sums, point)
        found, _ = br.bounds(sums, br.Past(), point)
        covariance = np.linalg.inv(br.information(sums, br.Past(), point)[:7, :7])
        for k, (truth, share) in enumerate(((R1, 0.17), (R2, 0.10))):
            part = slice(3 * k, 3 * k + 3)
            r, spread = point.r[part], 0.5 * np.sqrt(np.linalg.eigvalsh(covariance[part, part])[-1])
            added = found[k] - 0.003 - spread - share * np.linalg.norm(r)
            self.assertAlmostEqual(added / np.linalg.norm(truth - r), 1.0, delta=0.2)


class BallTest(unittest.TestCase):
    def test_an_exact_joint_is_found(self):
        rng = np.random.default_rng(8)
        ball = br.Ball()
        with mock.patch.object(br, "RIDGE", 0.0):
            for pair in random_ticks(rng, 360, heading=2.1):
                ball.add(*pair)
        np.testing.assert_allclose(ball.point.r, np.r_[R1, R2], atol=1e-9)
        self.assertTrue(ball.merged)
        np.testing.assert_allclose(np.angle(ball.point.heading), [2.1, 2.1], atol=1e-9)
        self.assertTrue(ball.verdict.is_joint)
        self.assertEqual(ball.verdict.reason, "")

    def test_a_heading_is_followed_from_block_to_block(self):
        """2 deg in 5 s; what ties blocks holds it back by a part of one step."""
        rng = np.random.default_rng(9)
        ball = br.Ball()
        rate = np.radians(0.4)
        for k in range(12):
            for pair in random_ticks(rng, 100, heading=rate * 5.0 * k):
                ball.add(*pair)
        self.assertAlmostEqual(np.angle(ball.point.heading[0]), rate * 55.0, delta=np.radians(2.0))
        self.assertLess(ball.past.pull, br.PULL)  # known worse than one block's drift, whatever is known of it

    def test_sensors_that_share_nothing_are_no_joint(self):
        rng = np.random.default_rng(10)
        ball = br.Ball()
        one, two = random_ticks(rng, 300), random_ticks(rng, 300)
        for (a, _), (_, b) in zip(one, two, strict=True):
            ball.add(a, b)
            self.assertEqual(ball.verdict.agreed, 0)
            if ball.sums.motion_s > 10.0:
                self.assertEqual(ball.verdict.reason, "not-one-joint")
        self.assertLess(ball.sums.motion_s, br.REFUSED_MAX_S)  # begun anew

    def test_reasons(self):
        for reason, level, spoil in (("gravity-off", 9.2, lambda a: a), ("no-bend", 9.81, lambda a: a)):
            ball = br.Ball()
            for a, b in random_ticks(np.random.default_rng(11), 200, level=level):
                ball.add(a, b._replace(gyr=a.gyr) if reason == "no-bend" else b)
            self.assertEqual(ball.verdict.reason, reason)
        ball = br.Ball()
        for a, b in random_ticks(np.random.default_rng(11), 50):
            ball.add(a, b)
        self.assertLess(ball.sums.motion_s, 3.0)
        self.assertEqual(ball.verdict.reason, "no-motion")

    def test_what_is_known_of_the_past_and_of_a_block_adds_up(self):
        """Variances add from block to block, informations of one heading add: of a block what is left once levers are free."""
        rng = np.random.default_rng(12)
        ball = br.Ball()
        for pair in random_ticks(rng, 199, heading=0.4, noise=0.02):
            ball.add(*pair)
        self.assertGreater(ball.sums.blocks[1].motion_s, 0.0)
        ball.past = br.Past(unit(0.4), 300.0)
        weight = br.weight_of(ball.sums, ball.point.size)

        def least(angle):
            """Half the sum of squares with the closed block's heading turned and levers and the open block's heading that follow."""
            heading, r = [ball.point.heading[0], ball.point.heading[1] * unit(angle)], ball.point.r
            for _ in range(60):
                x = ball.sums.cross(heading)
                r = np.linalg.solve(*ball.sums.normal(x))
                one, two = np.r_[1.0, -r[:3]], np.r_[1.0, -r[3:]]
                z = np.conj(one @ ball.sums.blocks[0].lever @ two) * weight + br.PULL * ball.point.heading[1]
                heading[0] = z / abs(z)
            own = one @ ball.sums.lever1 @ one + two @ ball.sums.lever2 @ two - 2.0 * one @ ball.sums.cross(heading) @ two
            return 0.5 * weight * own - br.PULL * (np.conj(heading[0]) * ball.point.heading[1]).real

        step = 0.02
        curve = (least(step) - 2.0 * least(0.0) + least(-step)) / step**2
        left = ball.point.x1 @ ball.sums.cross(ball.point.heading) @ ball.point.x2
        ball.close()
        known = ball.past.known - 1.0 / (1.0 / 300.0 + np.radians(2.0) ** 2)
        self.assertAlmostEqual(known, curve, delta=0.02 * curve)
        self.assertAlmostEqual(ball.point.x1 @ ball.sums.cross(ball.point.heading) @ ball.point.x2, left, delta=1e-9 * abs(left))

    def test_a_gap_before_an_estimate_leaves_nothing_behind(self):
        """Pieces that are too short for a heading are forgotten, not merged with any."""
        rng = np.random.default_rng(13)
        ball = br.Ball()
        for epoch in range(1, 8):
            for pair in random_ticks(rng, 10, heading=float(epoch), epoch=epoch):
                ball.add(*pair)
        self.assertFalse(ball.has_estimate)
        with mock.patch.object(br, "RIDGE", 0.0):
            for pair in random_ticks(rng, 100, heading=0.3, epoch=8):
                ball.add(*pair)
        np.testing.assert_allclose(ball.point.r, np.r_[R1, R2], atol=1e-9)
        self.assertAlmostEqual(np.angle(ball.point.heading[0]), 0.3, delta=1e-9)

    def test_a_gap_after_an_estimate_unties_headings_and_keeps_levers(self):
        rng = np.random.default_rng(14)
        ball = br.Ball()
        with mock.patch.object(br, "RIDGE", 0.0):
            for epoch, heading in ((1, 0.3), (2, -2.0), (3, 1.1)):
                for pair in random_ticks(rng, 160, heading=heading, epoch=epoch):
                    ball.add(*pair)
                self.assertAlmostEqual(np.angle(ball.point.heading[0]), heading, delta=1e-9)
                np.testing.assert_allclose(ball.point.r, np.r_[R1, R2], atol=1e-9)
            self.assertGreater(ball.sums.motion_s, 15.0)
            ball.add(*(tick._replace(epoch=4) for tick in random_ticks(rng, 1)[0]))
        self.assertEqual([block.motion_s for block in ball.sums.blocks], [0.0, 0.0])
        self.assertEqual(ball.past.pull, 0.0)


class Motion:
    """Sensor 1 turns anyhow; sensor 2 on it by turns about lines of frame 1: (axis, amplitude, frequency) one after the other."""

    def __init__(self, *turns, carry=0.3, heading=0.9, mount=None):
        self.turns, self.carry, self.heading = turns, carry, heading
        self.mount = np.eye(3) if mount is None else mount

    def pose(self, t):
        first = rotation([0.0, 0.0, 1.0], self.carry * np.sin(1.1 * t)) @ rotation([1.0, 0.0, 0.0], self.carry * np.sin(0.7 * t + 1.0))
        second = first
        for axis, amplitude, frequency in self.turns:
            second = second @ rotation(axis, amplitude * np.sin(frequency * t))
        return first, exact_joint.about_z(-self.heading) @ second @ self.mount

    def ticks(self, begin_s, seconds, h=1e-4):
        out = []
        for t in begin_s + STEP_S * np.arange(round(seconds / STEP_S)):
            both = []
            for now, before, after in zip(self.pose(t), self.pose(t - h), self.pose(t + h), strict=True):
                w = now.T @ (after - before) / (2.0 * h)
                gyr = 0.5 * np.array([w[2, 1] - w[1, 2], w[0, 2] - w[2, 0], w[1, 0] - w[0, 1]])
                both.append(fs.Tick(t, STEP_S, 1, now, np.zeros((3, 3)), np.zeros((3, 3)), np.zeros(3), gyr, 9.81))
            out.append(tuple(both))
        return out


X, Y, Z = np.eye(3)
MOUNT = rotation(np.array([0.6, 0.0, 0.8]), 0.9)


def windows_of(*motions, r1=X, r2=X, seconds=5.0, heading_bound=0.02, is_joint=True, mount=MOUNT, heading_error=0.0, moved=0.0, bound2=0.03,
               length2=0.25):
    """Windows after motions of so many seconds each. r2 is given in the frame that sensor 2 would have without its mount."""
    windows, begin, point = br.Windows(), 0.0, br.Point(np.r_[0.2 * r1, length2 * mount.T @ r2])
    for turns in motions:
        motion = Motion(*turns, mount=mount)
        for pair in motion.ticks(begin, seconds):
            if windows.add(*pair, unit(motion.heading + heading_error)):
                windows.close(point, unit(motion.heading + heading_error + moved), heading_bound, bound2, is_joint)
        begin += seconds
    return windows


BEND, TURN = ((Y, 0.8, 3.0),), ((X, 0.8, 3.0),)


class WindowsTest(unittest.TestCase):
    def found(self, *motions, **how):
        return [axis.windows > 0 for axis in windows_of(*motions, **how).kept]

    def test_turning_about_one_line_shows_that_line(self):
        bent = windows_of(BEND).kept
        self.assertEqual([axis.windows for axis in bent], [1, 0])
        self.assertLess(br.line_angle(bent[0].direction, Y), 1e-6)
        self.assertAlmostEqual(bent[0].bound, np.hypot(np.radians(2.0) + 0.5 * 0.02, np.radians(6.0)), delta=1e-6)
        turned_ = windows_of(TURN, r1=Z).kept
        self.assertEqual([axis.windows for axis in turned_], [0, 1])
        self.assertLess(br.line_angle(turned_[1].direction, MOUNT.T @ X), 1e-6)

    def test_a_heading_that_is_wrong_about_a_forearm_that_turns_alone_is_no_error(self):
        """The proximal segment rests: its rate is not there to be turned wrongly."""
        self.assertLess(windows_of(TURN, r1=Z, heading_bound=0.4).kept[1].bound, np.hypot(np.radians(2.0) + 0.25 * 0.4, np.radians(12.0)))
        bent = np.hypot(np.radians(2.0) + 0.5 * 0.4, np.radians(6.0))
        self.assertAlmostEqual(windows_of(BEND, heading_bound=0.4).kept[0].bound, bent, delta=1e-6)
        self.assertAlmostEqual(windows_of(BEND, heading_bound=0.24, moved=0.32).kept[0].bound, bent, delta=1e-6)
        wrong = windows_of(TURN, r1=Z, heading_error=0.1, heading_bound=0.1).kept[1]
        self.assertLess(br.line_angle(wrong.direction, MOUNT.T @ X), wrong.bound)

    def test_what_shows_no_axis(self):
        self.assertEqual(self.found(BEND, r1=Y), [False, False])  # skin: about the upper arm's own line
        self.assertEqual(self.found((*BEND, (X, 0.8, 3.7))), [False, False])  # both at once
        self.assertEqual(self.found(BEND, is_joint=False), [False, False])
        self.assertEqual(self.found(BEND, r2=(X + Y) / np.sqrt(2.0)), [False, False])  # neither along nor across
        self.assertEqual(self.found(((Y, 0.2, 9.0),)), [False, False])  # 0.14 rad rms
        self.assertEqual(self.found(((Y, 0.35, 9.0),)), [True, False])  # 0.25
        self.assertEqual(self.found(((Y, 0.8, 0.25),)), [False, False])  # 0.2 rad/s
        self.assertEqual(self.found(BEND, seconds=2.5), [False, False])  # half a window

    def test_a_lever_that_is_short_or_unknown_tells_nothing(self):
        self.assertEqual(self.found(BEND, length2=0.09), [False, False])
        self.assertEqual(self.found(BEND, length2=0.11, bound2=9.0), [True, False])  # bending never tells the lever along its own axis
        self.assertEqual(self.found(TURN, r1=Z, length2=0.09), [False, False])
        self.assertEqual(self.found(TURN, r1=Z, length2=0.11), [False, True])
        self.assertEqual(self.found(TURN, r1=Z, bound2=0.126), [False, False])

    def test_halves_that_differ_show_no_axis(self):
        other = np.array([0.0, np.cos(0.35), np.sin(0.35)])  # 20 deg
        self.assertEqual(self.found(BEND, ((other, 0.8, 3.0),), seconds=2.5), [False, False])
        other = np.array([0.0, np.cos(0.17), np.sin(0.17)])  # 10 deg
        self.assertEqual(self.found(BEND, ((other, 0.8, 3.0),), seconds=2.5), [True, False])

    def test_each_axis_from_its_own_motion(self):
        kept = windows_of(BEND, TURN, r1=Z, seconds=10.0).kept
        self.assertEqual([axis.windows for axis in kept], [3, 3])  # windows overlap by half; the one of both motions shows none
        self.assertLess(br.line_angle(kept[0].direction, Y), 1e-6)
        self.assertLess(br.line_angle(kept[1].direction, MOUNT.T @ X), 1e-6)

    def test_two_windows_that_say_otherwise_are_believed(self):
        def windows(n):
            out = br.Windows()
            point, other = br.Point(np.r_[0.2 * X, 0.25 * X]), ((np.array([0.0, 0.6, 0.8]), 0.8, 3.0),)
            for k, turns in enumerate([BEND] + n * [other]):
                motion = Motion(*turns)
                for pair in motion.ticks(5.0 * k, 5.0):
                    if out.add(*pair, unit(motion.heading)):
                        out.close(point, unit(motion.heading), 0.02 if k == 0 else 0.03, 0.03, True)
                out.parts = [br.Part(), br.Part()]
            return out.kept[0]

        self.assertLess(br.line_angle(windows(1).direction, Y), 1e-6)
        self.assertEqual(windows(1).against, 1)
        self.assertLess(br.line_angle(windows(2).direction, np.array([0.0, 0.6, 0.8])), 1e-6)
        self.assertEqual((windows(2).windows, windows(2).against), (1, 0))

    def test_a_window_that_is_surer_is_believed_at_once(self):
        windows, point = windows_of(BEND, heading_bound=0.3), br.Point(np.r_[0.2 * X, 0.25 * MOUNT.T @ X])
        other = np.array([0.0, 0.6, 0.8])
        windows.parts = [br.Part(), br.Part()]
        motion = Motion((other, 0.8, 3.0), mount=MOUNT)
        for pair in motion.ticks(0.0, 5.0):
            if windows.add(*pair, unit(motion.heading)):
                windows.close(point, unit(motion.heading), 0.02, 0.03, True)
        self.assertLess(br.line_angle(windows.kept[0].direction, other), 1e-6)

    def test_windows_that_agree_are_one_sum(self):
        """10 deg apart: the axis of both lies between, and the spread is in the bound."""
        other = np.array([0.0, np.cos(0.17), np.sin(0.17)])
        kept = windows_of(BEND, ((other, 0.8, 3.0),), heading_bound=0.2).kept[0]
        self.assertEqual(kept.windows, 3)
        self.assertLess(br.line_angle(kept.direction, np.array([0.0, np.cos(0.085), np.sin(0.085)])), 0.01)
        self.assertGreater(kept.bound, np.hypot(np.radians(2.0) + 0.5 * 0.2 + 0.5 * np.tan(0.08), np.radians(3.0)))

    def test_the_last_twelve_windows_count(self):
        other = np.array([0.0, np.cos(0.1), np.sin(0.1)])
        kept = windows_of(BEND, ((other, 0.8, 3.0),), seconds=75.0).kept[0]
        self.assertEqual(kept.windows, 12)
        self.assertLess(br.line_angle(kept.direction, other), 0.02)


if __name__ == "__main__":
    unittest.main()
