"""The arithmetic of the measurements on people: angles, windows, parts, what counts as wrong; and an estimate that is held."""

import sys
import unittest
from pathlib import Path
from types import SimpleNamespace

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

from jointcal_tools import native, native_functional  # noqa: E402
from jointcal_tools import quaternions as quat  # noqa: E402
from jointcal_tools.measure import judge, people_angles, people_flexion, people_hinge, people_never, people_sim  # noqa: E402
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
