"""The arithmetic of the measurements on people: angles, headings, windows, parts, what counts as wrong; and an estimate that is held."""

import sys
import unittest
from pathlib import Path
from types import SimpleNamespace

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

from jointcal_tools import native, native_functional, native_two_axes  # noqa: E402
from jointcal_tools import quaternions as quat  # noqa: E402
from jointcal_tools.measure import (judge, people_angles, people_ball, people_ball_cases, people_ball_never, people_ball_sim,  # noqa: E402
                                    people_elbow, people_flexion, people_hinge, people_levers, people_never, people_sim)
from jointcal_tools.measure.people_faults import PeopleCase  # noqa: E402
from jointcal_tools.recordings import Recording  # noqa: E402
from jointcal_tools.simulate_people import PersonSpec, simulate_person  # noqa: E402


def has_library():
    try:
        native.library()
    except (FileNotFoundError, RuntimeError):
        return False
    return True


def track(**parts):
    """What a functional joint said, as far as a test needs it."""
    return SimpleNamespace(**parts)


class FlexionTest(unittest.TestCase):
    def test_twist_is_the_turn_about_the_axis(self):
        rng = np.random.default_rng(1)
        angle = np.linspace(-170.0, 170.0, 40)
        mount1, mount2 = (rng.standard_normal(4) for _ in range(2))
        mount1, mount2 = mount1 / np.linalg.norm(mount1), mount2 / np.linalg.norm(mount2)
        axis = np.array([0.0, 1.0, 0.0])
        segment1 = quat.rotation(np.linspace(0.0, 2.0, 40), np.array([0.6, 0.0, 0.8]))
        segment2 = quat.multiply(segment1, quat.rotation(np.radians(angle), axis))
        heading = np.linspace(20.0, 90.0, 40)
        back = quat.rotation(np.radians(-heading), np.array([0.0, 0.0, 1.0]))
        q1 = quat.multiply(segment1, np.tile(mount1, (40, 1)))
        q2 = quat.multiply(back, quat.multiply(segment2, np.tile(mount2, (40, 1))))
        j1, j2 = (quat.matrices(mount[None])[0].T @ axis for mount in (mount1, mount2))
        found = people_flexion.twist_deg((q1, q2), heading, j1, j2)
        self.assertLess(np.abs(people_flexion.apart_deg(found, angle)).max(), 1e-6)
        self.assertGreater(np.polyfit(angle, np.unwrap(np.radians(found)), 1)[0], 0.0)  # grows with turns of sensor 2 about the axis

    def test_a_constant_and_the_sense_do_not_count(self):
        angle = np.r_[np.linspace(0.0, 100.0, 50), np.nan]
        found = people_flexion.wrapped_deg(-angle + 150.0)
        self.assertLess(people_flexion.apart_rms_deg(found, angle), 1e-9)
        found[:25] += 2.0
        self.assertAlmostEqual(people_flexion.apart_rms_deg(found, angle), 1.0, places=6)

    def test_too_little_says_nothing(self):
        few = np.arange(people_flexion.LEAST_SAMPLES - 1.0)
        self.assertTrue(np.isnan(people_flexion.apart_rms_deg(few, few)))
        self.assertTrue(np.isnan(people_flexion.apart_deg(np.full(3, np.nan), np.zeros(3))).all())

    def test_heading_is_the_last_that_was_known(self):
        found = people_flexion.heading_at_samples(track(sample=np.array([1, 3]), heading_deg=np.array([5.0, 7.0])), 5)
        np.testing.assert_array_equal(found, [np.nan, 5.0, 5.0, 7.0, 7.0])


class HingeTest(unittest.TestCase):
    def test_parts_follow_one_another_with_the_same_motion(self):
        moved = np.concatenate([[0.0], np.cumsum(np.r_[np.zeros(10), np.full(20, 0.5), np.zeros(5), np.full(12, 0.5)])])
        parts = people_hinge.separate(moved, 5.0)
        self.assertEqual([begin for begin, _ in parts[1:]], [end for _, end in parts[:-1]])
        self.assertEqual([moved[end] - moved[begin] for begin, end in parts], [5.0, 5.0, 5.0])

    def test_both_bounds_count_and_the_other_pairing_never(self):
        bounds, whole = np.array([3.0, 3.0]), np.array([4.0, 4.0])
        self.assertEqual(people_hinge.covered(np.array([4.9, 5.1]), False, bounds, whole), (True, False))
        self.assertEqual(people_hinge.covered(np.array([0.0, 0.0]), True, bounds, whole), (False, False))

    def test_changes_of_status(self):
        self.assertEqual(people_hinge.status_changes(np.array([0, 0, 2, 2, 0, 2])), 3)
        self.assertEqual(people_hinge.status_changes(np.array([2, 2])), 0)

    def test_pairing_is_wrong_if_one_axis_alone_is_turned(self):
        y = np.array([0.0, 1.0, 0.0])
        errors, other = judge.axis_errors(track(axis1=np.array([y, y, -y]), axis2=np.array([y, -y, -y])), y, y)
        self.assertEqual(other.tolist(), [False, True, False])
        np.testing.assert_allclose(errors, 0.0)

    def test_calibrations_are_judged_at_the_first_and_every_few_seconds_of_motion(self):
        moved = np.arange(0.0, 12.0, 0.5)
        among = moved >= 1.0
        self.assertEqual([moved[k] for k in people_hinge.judged_ticks(moved, among)], [1.0, 6.0, 11.0])
        self.assertEqual(people_hinge.judged_ticks(moved, moved < 0.0), [])

    def test_never_ready_is_not_within_any_time(self):
        starts = [track(ready_motion_s=value) for value in (4.0, 10.0, np.inf)]
        self.assertEqual([people_hinge.within(starts, m) for m in (5.0, 10.0, 30.0)], [1, 2, 2])

    def test_filters_settle_before_a_warm_start_if_there_is_time(self):
        rec = Recording(np.arange(6000) / 100.0, *(np.zeros((6000, 3)) for _ in range(4)))
        self.assertIsNone(people_hinge.settled(rec, 900))
        self.assertEqual(people_hinge.settled(rec, 1000), 0)
        self.assertEqual(people_hinge.settled(rec, 5000), 2000)


class AnglesTest(unittest.TestCase):
    def test_windows_begin_with_the_first_angle(self):
        t = np.arange(0.0, 40.0, 0.1)
        error = np.where(t < 5.0, np.nan, np.where(t < 15.0, 1.0, -2.0))
        bound = np.where(t < 15.0, 1.5, 1.9)
        errors, bounds = people_angles.windows(t, error, bound)
        np.testing.assert_allclose(errors, [1.0, 2.0, 2.0, 2.0])
        np.testing.assert_allclose(bounds, [1.5, 1.9, 1.9, 1.9])
        found = people_angles.Windows("x", 5.0, 0.0, errors, bounds, 0.0)
        self.assertEqual(found.covered, 1)

    def test_windows_that_are_mostly_unknown_do_not_count(self):
        t = np.arange(0.0, 20.0, 0.1)
        error = np.ones(len(t))
        error[(t >= 10.0) & (t < 16.0)] = np.nan
        self.assertEqual(len(people_angles.windows(t, error, np.ones(len(t)))[0]), 1)
        self.assertEqual(len(people_angles.windows(t, np.full(len(t), np.nan), np.ones(len(t)))[0]), 0)


class NeverTest(unittest.TestCase):
    AXIS = np.array([0.0, 1.0, 0.0])

    def said(self, degrees):
        tilted = np.column_stack([np.sin(np.radians(degrees)), np.cos(np.radians(degrees)), np.zeros(len(degrees))])
        return track(sample=np.arange(len(degrees)), axis1=tilted, axis2=np.tile(self.AXIS, (len(degrees), 1)))

    def case(self, wrong):
        still = np.zeros((40, 3))
        return PeopleCase(Recording(np.arange(40) / 10.0, still, still, still, still), "x", wrong=wrong, axis1=self.AXIS, axis2=self.AXIS)

    def test_where_ready_is_wrong_the_first_tick_counts(self):
        ready = np.arange(40) >= 7
        self.assertEqual(people_never.first_wrong(self.case("never"), self.said(np.zeros(40)), ready, 3.0), 7)
        self.assertIsNone(people_never.first_wrong(self.case("never"), self.said(np.zeros(40)), ready & False, 3.0))

    def test_beyond_the_limit_is_wrong_also_at_the_end(self):
        ready = np.ones(40, bool)
        late = np.where(np.arange(40) == 39, 5.0, 1.0)
        self.assertIsNone(people_never.first_wrong(self.case("beyond"), self.said(np.ones(40)), ready, 3.0))
        self.assertEqual(people_never.first_wrong(self.case("beyond"), self.said(late), ready, 3.0), 39)
        self.assertIsNone(people_never.first_wrong(self.case("beyond"), self.said(late), ready, 10.0))


class SimTest(unittest.TestCase):
    def test_hint_compares_the_largest_components(self):
        self.assertEqual(people_sim.sign_hint(np.array([0.1, -0.9, 0.3]), np.array([-0.8, 0.5, 0.1])), "same")
        self.assertEqual(people_sim.sign_hint(np.array([0.1, 0.9, 0.3]), np.array([-0.8, 0.5, 0.1])), "opposite")

    def test_classes_are_as_they_are_called(self):
        for kind in people_sim.CLASSES:
            spec = people_sim.spec_of(kind, 0)
            self.assertEqual(spec, people_sim.spec_of(kind, 0))
            self.assertEqual(spec.duration_s, people_sim.LENGTH_S)
            self.assertEqual(spec.skin == 0.0, kind in people_sim.RIGID)

    def test_an_axis_with_the_other_pairing_is_not_covered(self):
        def outcome(error, other, has_axes=True):
            return track(has_axes=has_axes, errors_deg=np.array([error, 1.0]), bounds_deg=np.array([2.0, 2.0]), other=other)

        self.assertEqual(people_sim.covered([outcome(1.0, False), outcome(3.0, False), outcome(1.0, True), outcome(9.0, False, False)]),
                         ([1, 2], 3))


def said_of_all(count, **parts):
    """What a joint with two axes said at `count` ticks, one a sample, as far as a test needs it."""
    nothing = {"t_s": np.arange(float(count)), "sample": np.arange(count), "heading_deg": np.zeros(count), "r1": np.zeros((count, 3)),
               "r2": np.zeros((count, 3)), "axis1": np.tile([0.0, 1.0, 0.0], (count, 1)), "axis2": np.tile([0.0, 0.0, 1.0], (count, 1))}
    return track(**(nothing | parts))


class BallTest(unittest.TestCase):
    def test_true_heading_turns_level_frame_2_to_1(self):
        rng = np.random.default_rng(5)
        z = np.array([0.0, 0.0, 1.0])
        lab = [quat.from_rotation_vectors(rng.standard_normal((30, 3))) for _ in range(2)]
        yaws = np.linspace(-200.0, 300.0, 30), np.linspace(10.0, 90.0, 30)
        own = tuple(quat.multiply(quat.rotation(np.radians(-yaw), z), q) for yaw, q in zip(yaws, lab, strict=True))
        heading = people_ball.true_heading_deg(own, tuple(lab))
        relative = quat.multiply(quat.conjugate(own[0]), quat.multiply(quat.rotation(np.radians(heading), z), own[1]))
        right = quat.multiply(quat.conjugate(lab[0]), lab[1])
        self.assertLess(np.abs(quat.matrices(relative) - quat.matrices(right)).max(), 1e-9)

    def test_a_small_tilt_does_not_turn_the_heading(self):
        tilt = quat.rotation(np.array([0.03]), np.array([1.0, 0.0, 0.0]))
        yaw = quat.rotation(np.array([0.7]), np.array([0.0, 0.0, 1.0]))
        self.assertAlmostEqual(float(people_ball.yaw_deg(quat.multiply(yaw, tilt))[0]), float(np.degrees(0.7)), places=6)

    def test_mean_heading_forgives_one_sample_and_knows_the_circle(self):
        heading = np.r_[np.full(20, 179.0), np.full(21, -179.0)]
        heading[5] = np.nan
        mean = people_ball.circular_mean_deg(heading, 5)
        self.assertEqual(np.flatnonzero(np.isnan(mean)).tolist(), [5])
        np.testing.assert_allclose(mean[[0, 4, 10, 40]], [179.0, 179.0, 179.0, -179.0])
        self.assertLess(np.abs(people_flexion.wrapped_deg(mean[18:22] - 180.0)).max(), 1.0)
        self.assertLess(abs(mean[19]) - 179.0, 1.0)
        heading[10] = 160.0
        self.assertLess(abs(people_ball.circular_mean_deg(heading, 5)[10] - 179.0), 4.0)

    def test_errors_are_those_of_lines_points_and_angles_on_the_circle(self):
        joint = said_of_all(2, heading_deg=np.array([179.0, 10.0]), axis1=np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0]]))
        truth = people_ball.Truth(np.array([-179.0, 10.0]), (np.array([0.0, 0.3, 0.4]), None), (np.array([0.0, 1.0, 0.0]), None))
        np.testing.assert_allclose(people_ball.errors(joint, truth), [[2.0, 0.5, np.nan, 0.0, np.nan], [0.0, 0.5, np.nan, 90.0, np.nan]], atol=1e-9)

    def test_samples_have_what_the_last_tick_said(self):
        found = people_ball.at_ticks(np.array([5.0, 7.0]), np.array([1, 3]), 5)
        np.testing.assert_array_equal(found, [np.nan, 5.0, 5.0, 7.0, 7.0])
        self.assertEqual(people_ball.at_ticks(np.zeros((0, 3)), np.zeros(0, int), 4).shape, (4, 3))

    def test_a_known_reason_does_not_outlive_what_it_was_given_for(self):
        for hits, known in ((90, True), (80, False)):
            report = people_ball.Report("x", "x", "x", "x")
            people_ball.require_share(report, "x", hits, 100, 0.95, (0.85, "why"))
            self.assertEqual((report.requirements[-1].passed, report.passed), (False, known))
        for count, known in ((0, True), (1, True), (5, True), (6, False)):
            report = people_ball.Report("x", "x", "x", "x")
            people_ball.require_none(report, "x", count, 100, (0.05, "why"))
            self.assertEqual(report.passed, known)


class ElbowTest(unittest.TestCase):
    def test_motion_changes_where_most_of_each_is_on_its_side(self):
        bends, turns = np.r_[np.full(40, 1.0), np.full(60, 0.1)], np.r_[np.full(40, 0.2), np.full(60, 2.0)]
        self.assertEqual(people_elbow.change_at(bends, turns), 40)
        self.assertEqual(people_elbow.change_at(np.zeros(5), np.ones(5)), 0)

    def test_mostly_wants_speed_and_one_line_over_the_last_seconds(self):
        along = np.r_[np.zeros(50), np.ones(100), np.ones(50)]
        total2 = along**2 + np.r_[np.zeros(150), np.ones(50)]
        found = people_elbow.mostly(along, total2, 20)
        self.assertFalse(found[:51].any())
        self.assertTrue(found[60:150].all())
        self.assertFalse(found[160:].any())
        self.assertFalse(people_elbow.mostly(0.1 * along, 0.01 * total2, 20).any())

    def test_angles_of_axes_that_change_are_those_of_each(self):
        turned = quat.rotation(np.linspace(0.0, 1.0, 40), np.array([0.0, 1.0, 0.0]))
        y, z = np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0])
        still = people_elbow.angles_deg(turned, y, z)
        np.testing.assert_allclose(people_flexion.apart_deg(still[:, 0], np.degrees(np.linspace(0.0, 1.0, 40))), 0.0, atol=1e-9)
        self.assertLess(np.ptp(still[:, 1]), 1e-9)
        axis1 = np.tile(y, (40, 1))
        axis1[:10] = np.nan
        axis1[30:] = [0.0, 0.6, 0.8]
        moving = people_elbow.angles_deg(turned, axis1, np.tile(z, (40, 1)))
        self.assertTrue(np.isnan(moving[:10]).all())
        np.testing.assert_array_equal(moving[10:30], still[10:30])
        np.testing.assert_array_equal(moving[30:], people_elbow.angles_deg(turned[30:], axis1[-1], z))

    def test_axes_get_the_sense_of_the_reference(self):
        y = np.array([0.0, 1.0, 0.0])
        np.testing.assert_array_equal(people_elbow.toward(-y, y), y)
        np.testing.assert_array_equal(people_elbow.toward(np.array([y, -y]), y), [y, y])

    def test_spread_is_on_the_circle(self):
        self.assertAlmostEqual(people_elbow.spread_deg(np.array([179.0, -179.0, np.nan])), 1.0, places=6)


class LeversTest(unittest.TestCase):
    def estimate(self, r2, bound_m, **parts):
        nothing = {"name": "leg:hip", "length_s": 20.0, "warm": False, "begin_s": 0.0, "r": (np.zeros(3), np.array(r2)),
                   "axes": (np.array([0.0, 1.0, 0.0]),) * 2, "bounds": np.array([5.0, bound_m, bound_m, 10.0, 90.0]),
                   "known": np.ones(5, bool), "reason": "none", "left": 0.01}
        return people_levers.Estimate(**(nothing | parts))

    def test_parts_agree_within_both_bounds(self):
        parts = [self.estimate([0.0, 0.0, 0.1], 0.02), self.estimate([0.0, 0.0, 0.125], 0.02), self.estimate([0.0, 0.0, 0.2], 0.02)]
        found = people_levers.repeat_of(2, parts)
        self.assertEqual((found.pairs, found.within.tolist()), (3, [True, False, False]))
        np.testing.assert_allclose(found.apart, [0.025, 0.1, 0.075])

    def test_scatter_of_axes_is_that_of_lines(self):
        tilted = [np.array([np.sin(a), np.cos(a), 0.0]) for a in np.radians([-3.0, 3.0])]
        self.assertAlmostEqual(people_levers.scatter_95(3, [tilted[0], -tilted[1]]), 1.96 * 3.0 * np.sqrt(2.0), places=3)
        self.assertTrue(np.isnan(people_levers.scatter_95(3, tilted[:1])))

    def test_thigh_is_between_hip_and_knee(self):
        hip = self.estimate([0.0, 0.0, -0.2], 0.03)
        knee = self.estimate([0.0, 0.0, 0.0], 0.04, r=(np.array([0.0, 0.0, 0.2]), np.zeros(3)))
        thigh = people_levers.thigh_of(hip, knee)
        self.assertAlmostEqual(thigh.length_m, 0.4)
        self.assertAlmostEqual(thigh.bound_m, 0.05)
        self.assertTrue(thigh.known and thigh.stated)


class BallNeverTest(unittest.TestCase):
    def test_never_and_beyond(self):
        flags = np.array([[True] * 5, [False, True, True, True, True]])
        off = np.array([[9.0, 0.3, np.nan, 1.0, np.nan], [99.0, 0.1, 0.1, 30.0, np.nan]])
        stated = np.tile([5.0, 0.1, 0.1, 10.0, 10.0], (2, 1))
        found = people_ball_never.wrong_ticks(people_ball_cases.RULES["hinge"], flags, off, stated)
        np.testing.assert_array_equal(found, [[False, True, False, False, True], [False, False, False, True, True]])
        self.assertTrue(people_ball_never.wrong_ticks(people_ball_cases.RULES["unrelated"], flags, off, stated)[0].all())

    def test_a_truth_that_is_uncertain_itself_forgives(self):
        joint = said_of_all(3, heading_deg=np.array([0.0, 20.0, 5.0]))
        what = people_ball_cases.Judged(people_ball.Truth(np.zeros(3)), np.full(3, 8.0))
        np.testing.assert_allclose(people_ball_never.off_by(joint, what)[:, 0], [0.0, 12.0, 0.0])

    def test_every_class_has_a_rule_and_those_of_people_are_among_them(self):
        self.assertLessEqual({fault.rule for fault in people_ball_cases.CLASSES.values()}, set(people_ball_cases.RULES))
        self.assertLessEqual(set(people_ball_cases.NO_JOINT) | set(people_ball_cases.HINGES) | set(people_ball_never.KNOWN),
                             set(people_ball_cases.CLASSES))

    def test_heading_of_one_body_is_that_of_the_turn_between_its_sensors(self):
        rng = np.random.default_rng(8)
        gyr, turn = rng.standard_normal((200, 3)), quat.rotation(1.1, np.array([0.3, -0.5, 0.8]))
        rec = Recording(np.arange(200) / 100.0, gyr, gyr, gyr @ quat.matrices(turn[None])[0], gyr)  # v1 = T v2
        q1 = quat.from_rotation_vectors(rng.standard_normal((200, 3)))
        back = quat.rotation(np.radians(-40.0), np.array([0.0, 0.0, 1.0]))
        q2 = quat.multiply(np.tile(back, (200, 1)), quat.multiply(q1, np.tile(turn, (200, 1))))
        found = people_ball_cases.stiff_heading(PeopleCase(rec, "x"), track(q1=q1, q2=q2)).truth.heading_deg
        np.testing.assert_allclose(found, 40.0, atol=1e-6)


class BallSimTest(unittest.TestCase):
    def test_lag_is_what_errors_have_of_the_drift(self):
        drift = np.linspace(-0.5, 0.5, 11)
        late_s, alike = people_ball_sim.lag_of(-10.0 * drift, drift)
        self.assertAlmostEqual(late_s, 10.0)
        self.assertAlmostEqual(alike, 1.0)

    def test_inside_counts_those_that_are_asked_for(self):
        def outcome(after_s, known, error, bound):
            return track(after_s=np.full(5, after_s), first_errors=np.full(5, 1.0), first_bounds=np.full(5, 2.0), known=np.full(5, known),
                         errors=np.full(5, error), bounds=np.full(5, bound))

        runs = [outcome(3.0, True, 1.0, 2.0), outcome(3.0, False, 3.0, 2.0), outcome(np.inf, False, 3.0, 90.0)]
        self.assertEqual([people_ball_sim.inside(runs, 0, when) for when in ("first", "end", "stated")], [(2, 2), (1, 1), (1, 2)])

    def test_rigid_mounts_are_rigid_and_seeds_differ(self):
        specs = [people_ball_sim.person_of(kind, 0) for kind in people_ball_sim.CLASSES]
        self.assertEqual([spec.skin == 0.0 for spec in specs], [kind in people_ball_sim.RIGID for kind in people_ball_sim.CLASSES])
        self.assertEqual(len({spec.seed for spec in specs}), len(specs))
        self.assertEqual(specs[0], people_ball_sim.person_of(people_ball_sim.CLASSES[0], 0))


@unittest.skipUnless(has_library(), native.BUILD_HINT)
class BallTruthTest(unittest.TestCase):
    def test_heading_of_a_simulated_elbow_is_found(self):
        case = people_ball_cases.ball_case("elbow_bends", 0)
        said = native_two_axes.run(case.rec)
        what = people_ball_cases.judged("elbow_bends", case, said)
        off, flags = people_ball_never.off_by(said, what), people_ball.known(said)
        self.assertTrue(flags[:, 0].any())
        self.assertLess(off[flags[:, 0], 0].max(), 2.0 * people_ball.bounds(said)[flags[:, 0], 0].max())
        self.assertIsNone(what.truth.axes[1])
        np.testing.assert_array_equal(what.truth.levers[0], case.person.r1)


@unittest.skipUnless(has_library(), native.BUILD_HINT)
class HoldTest(unittest.TestCase):
    def setUp(self):
        rec = simulate_person(PersonSpec((("random", 30.0),), seed=3, rate_hz=50.0, skin=0.3))
        self.truth, self.rec = rec, Recording(rec.t_s, rec.gyr1, rec.acc1, rec.gyr2, rec.acc2)

    def test_axes_stay_and_the_heading_goes_on(self):
        held, free = native_functional.run(self.rec, hold=1000), native_functional.run(self.rec)
        before, after = held.sample < 1000, held.sample >= 1000
        np.testing.assert_array_equal(held.axis1[before], free.axis1[before])
        self.assertEqual(np.ptp(held.axis1[after], axis=0).max(), 0.0)
        self.assertEqual(np.ptp(held.axis2[after], axis=0).max(), 0.0)
        self.assertGreater(np.ptp(held.heading_deg[after]), 0.0)
        self.assertGreater(np.ptp(free.axis1[after], axis=0).max(), 0.0)

    def test_angle_from_orientations_heading_and_axes_is_the_engine_s(self):
        held = native_functional.run(self.rec, hold=1000)
        heading = people_flexion.heading_at_samples(held, len(self.rec))[1000:]
        found = people_flexion.twist_deg((held.q1[1000:], held.q2[1000:]), heading, held.axis1[-1], held.axis2[-1])
        self.assertLess(people_flexion.apart_rms_deg(found, held.flexion_deg[1000:]), 0.02)


if __name__ == "__main__":
    unittest.main()
