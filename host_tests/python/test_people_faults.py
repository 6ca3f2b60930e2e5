"""The classes of what must never make a joint of a person ready: numbers, determinism, and that each does what it says."""

import os
import sys
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path
from unittest import mock

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

from jointcal_tools import jets  # noqa: E402
from jointcal_tools import quaternions as quat  # noqa: E402
from jointcal_tools.jets import Clock  # noqa: E402
from jointcal_tools.measure import people_faults as pf  # noqa: E402
from jointcal_tools.measure.judge import available  # noqa: E402
from jointcal_tools.simulate import GRAVITY_M_S2  # noqa: E402
from jointcal_tools.simulate_people import PersonSpec, simulate_person  # noqa: E402

X, Y, Z = np.eye(3)
ALL_HERE = len(available(*pf.RIGS, *pf.BOTH_LEGS, *pf.ELBOWS, "knee_drop", "walk_leg_L", "people_sts_O_5sts")) == 18


def signals_of(case):
    return np.column_stack([case.rec.gyr1, case.rec.acc1, case.rec.gyr2, case.rec.acc2])


def some_case():
    return pf.person(PersonSpec((("walk", 6.0),), seed=1, rate_hz=50.0))


class TableTest(unittest.TestCase):
    def test_it_has_five_thousand_runs(self):
        self.assertEqual(sum(fault.runs for fault in pf.FAULTS.values()), 5000)

    def test_a_run_is_the_same_every_time_and_no_other(self):
        for name in ("unrelated_simulated", "white_noise", "splint"):
            first, again, other = (signals_of(pf.people_case(name, index)) for index in (0, 0, 1))
            np.testing.assert_array_equal(first, again)
            self.assertFalse(first.shape == other.shape and np.allclose(first, other))

    def test_without_recordings_there_are_the_simulated_classes(self):
        with tempfile.TemporaryDirectory() as empty, mock.patch.dict(os.environ, {"JOINTCAL_DATA": empty}):
            names = pf.here()
            self.assertIn("stiff_straps", names)
            self.assertNotIn("rig_2D", names)
            for name in names:
                case = pf.people_case(name, 0)
                self.assertTrue(np.isfinite(signals_of(case)).all(), name)
                self.assertAlmostEqual(len(case.rec) / case.rec.rate_hz, pf.LENGTH_S, delta=0.1, msg=name)
                self.assertEqual(case.wrong == "beyond", case.axis1 is not None, name)

    def test_few_runs_keep_every_class(self):
        few = pf.counts(100)
        self.assertEqual(set(few), set(pf.here()))
        self.assertGreaterEqual(min(few.values()), 1)
        self.assertLess(sum(few.values()), 150)


class WrongTest(unittest.TestCase):
    def test_never_is_wrong_whatever_it_states(self):
        self.assertTrue(pf.wrongly_ready(pf.PeopleCase(None, ""), pf.Ready(5.0, 90.0, Y, Y)))

    def test_beyond_is_wrong_by_error_pairing_or_what_follows(self):
        case = pf.PeopleCase(None, "", wrong="beyond", axis1=Y, axis2=Z)
        off = np.array([0.0, np.cos(0.1), np.sin(0.1)])  # 5.7 deg
        self.assertFalse(pf.wrongly_ready(case, pf.Ready(5.0, 6.0, off, Z)))
        self.assertFalse(pf.wrongly_ready(case, pf.Ready(5.0, 6.0, -off, -Z)))
        self.assertTrue(pf.wrongly_ready(case, pf.Ready(5.0, 5.0, off, Z)))
        self.assertTrue(pf.wrongly_ready(case, pf.Ready(5.0, 6.0, off, -Z)))
        self.assertTrue(pf.wrongly_ready(replace(case, moves_deg=7.0), pf.Ready(5.0, 6.0, Y, Z)))

    def test_one_axis_is_judged_by_what_moved_until_then(self):
        case = pf.PeopleCase(some_case().rec, "", wrong="one axis", name="x", begin=100)
        for share, wrong in ((0.99, False), (0.9, True)):
            with mock.patch.object(pf, "moving_axes", return_value=(Y, Y, share)) as moving:
                self.assertEqual(pf.wrongly_ready(case, pf.Ready(2.0, 3.0, Y, Y)), wrong)
                moving.assert_called_once_with("x", 100, 201)


class StiffTest(unittest.TestCase):
    def test_rocking_is_that_of_a_rigid_body_about_a_line(self):
        # 200 Hz, and motion below 4 Hz: what differences and the smoothed angular acceleration lose is below the tolerances.
        clean = {"skin": 0.0, "noise_scale": 0.0, "gyr_bias_deg_s": 0.0, "acc_bias": 0.0}
        rec = simulate_person(PersonSpec((("random", 10.0),), seed=3, rate_hz=200.0, **clean))
        clock, h = Clock(len(rec), 200.0), 1.0 / 200.0
        line, lever = np.array([0.6, 0.0, 0.8]), np.array([0.03, -0.04, 0.02])
        angle = pf.rocking_angle(np.random.default_rng(1), clock, 3.0, np.radians(4.0))
        gyr, acc = pf.rocked(rec.gyr1, rec.acc1, 200.0, angle, line, lever)
        q = quat.multiply(rec.q1, quat.rotation(angle.value, line))
        r, r0 = quat.matrices(q), quat.matrices(rec.q1)
        p = rec.p1 + (r - r0) @ lever
        accel = (16 * (p[3:-1] + p[1:-3]) - (p[4:] + p[:-4]) - 30 * p[2:-2]) / (12 * h * h) + [0.0, 0.0, GRAVITY_M_S2]
        dr = (8 * (r[3:-1] - r[1:-3]) - (r[4:] - r[:-4])) / (12 * h)
        skew = np.swapaxes(r[2:-2], 1, 2) @ dr
        rate = np.stack([skew[:, 2, 1], skew[:, 0, 2], skew[:, 1, 0]], axis=1)
        inner = slice(20, -20)
        self.assertLess(np.abs(rate - gyr[2:-2])[inner].max(), 1e-3)
        self.assertLess(np.abs(np.einsum("nji,nj->ni", r[2:-2], accel) - acc[2:-2])[inner].max(), 0.05)
        self.assertGreater(np.abs(acc - rec.acc1).max(), 0.5)

    def test_rocking_has_its_amplitude_and_frequency(self):
        clock = Clock(2000, 100.0)
        angle = pf.rocking_angle(np.random.default_rng(2), clock, 5.0, np.radians(3.0))
        self.assertAlmostEqual(np.degrees(angle.value.std()) * np.sqrt(2.0), 3.0, delta=0.4)
        spectrum = np.abs(np.fft.rfft(angle.value))
        self.assertAlmostEqual(np.fft.rfftfreq(2000, 0.01)[spectrum.argmax()], 5.0, delta=0.5)
        self.assertIsInstance(angle, jets.Jet)

    def test_a_copy_is_the_same_segment(self):
        with mock.patch.object(pf, "any_source", return_value=some_case()):
            for index in range(4):
                case = pf.people_case("stiff_copy", index)
                lengths = [np.linalg.norm(gyr, axis=1) for gyr in (case.rec.gyr1, case.rec.gyr2)]
                self.assertLess(np.abs(lengths[0] - lengths[1]).max(), 0.1)
                self.assertGreater(np.abs(case.rec.gyr1 - case.rec.gyr2).max(), 0.5)

    def test_one_that_almost_rests_turns_by_a_little(self):
        with mock.patch.object(pf, "good_joint", return_value=some_case()):
            for index in range(4):
                case = pf.people_case("almost_rests", index)
                still = case.rec.gyr1 if "sensor 1" in case.source else case.rec.gyr2
                size = np.sqrt(np.mean((still**2).sum(axis=1)))
                self.assertTrue(0.003 < size < 0.4, size)


class SensorsTest(unittest.TestCase):
    def made(self, name, index):
        with mock.patch.object(pf, "good_joint", return_value=some_case()):
            return pf.people_case(name, index)

    def best_map(self, before, after):
        return np.linalg.lstsq(before, after, rcond=None)[0].T

    def test_mirrored_sensors_are_left_handed_in_both_kinds(self):
        right, seen = some_case().rec, set()
        for index in range(12):
            case = self.made("mirrored", index)
            for sensor in (1, 2):
                maps = [self.best_map(getattr(right, f"{kind}{sensor}"), getattr(case.rec, f"{kind}{sensor}")) for kind in ("gyr", "acc")]
                np.testing.assert_allclose(*maps, atol=1e-9)
                seen.add((sensor, round(np.linalg.det(maps[0]))))
            self.assertIn("left-handed", case.source)
        self.assertEqual(seen, {(1, 1), (1, -1), (2, 1), (2, -1)})

    def test_one_kind_alone_is_changed(self):
        right = some_case().rec
        for name in ("axis_negated", "axes_swapped", "all_negated"):
            for index in range(6):
                case = self.made(name, index)
                changed = {kind for kind in ("gyr", "acc") for sensor in (1, 2)
                           if not np.array_equal(getattr(right, f"{kind}{sensor}"), getattr(case.rec, f"{kind}{sensor}"))}
                self.assertEqual(len(changed), 1, f"{name}:{index}")

    def test_units_and_dead_components(self):
        right = some_case().rec
        np.testing.assert_allclose(self.made("degrees_both", 0).rec.gyr2, np.degrees(right.gyr2))
        one = self.made("degrees_one", 0).rec
        self.assertNotEqual(np.array_equal(one.gyr1, right.gyr1), np.array_equal(one.gyr2, right.gyr2))
        for index in range(6):
            case = self.made("dead", index)
            columns = np.column_stack([signals_of(pf.PeopleCase(right, "")) != signals_of(case)]).any(axis=0)
            self.assertEqual(columns.sum(), 1)

    def test_a_late_person_has_its_true_axes(self):
        with tempfile.TemporaryDirectory() as empty, mock.patch.dict(os.environ, {"JOINTCAL_DATA": empty}):
            case = pf.people_case("late_500", 0)
        self.assertEqual(case.wrong, "beyond")
        self.assertAlmostEqual(np.linalg.norm(case.axis1), 1.0)
        self.assertIn("late by 0.5 s", case.source)


@unittest.skipUnless(ALL_HERE, "not all recordings are there")
class RecordingsTest(unittest.TestCase):
    def test_every_class_can_be_made(self):
        self.assertEqual(pf.here(), list(pf.FAULTS))
        for name, fault in pf.FAULTS.items():
            case = pf.people_case(name, 0)
            self.assertTrue(np.isfinite(signals_of(case)).all(), name)
            self.assertTrue((np.diff(case.rec.t_s) > 0.0).all(), name)
            self.assertEqual(case.rec.t_s[0], 0.0, name)
            self.assertEqual(case.wrong, fault.wrong, name)
            self.assertLess(case.rec.t_s[-1], pf.LENGTH_S + 1.0, name)  # a recording with gaps takes longer

    def test_unrelated_people_are_two(self):
        for index in range(20):
            case = pf.people_case("unrelated_people", index)
            first, second = (part.split(" from")[0] for part in case.source.split(" + "))
            self.assertNotEqual(pf.JOINTS[first].person, pf.JOINTS[second].person)

    def test_a_late_sensor_is_late_and_the_other_is_not(self):
        rng = np.random.default_rng(0)
        with mock.patch.object(pf, "KNOWN_AXES", {"rig_1D_04": pf.KNOWN_AXES["rig_1D_04"]}):
            case = next(c for c in (pf.late(rng, 0.2) for _ in range(20)) if c.source.startswith("rig"))
        begin = int(case.source.split("sample ")[1].split(",")[0])
        whole, is_late = pf.whole("rig_1D_04"), 1 if "sensor 1 late" in case.source else 2
        rows = slice(begin, begin + 500)  # 10 samples of 20 ms earlier than what is in time
        in_time = getattr(whole, f"gyr{3 - is_late}")[begin + 10:begin + 510]
        np.testing.assert_allclose(getattr(case.rec, f"gyr{is_late}")[:500], getattr(whole, f"gyr{is_late}")[rows], atol=1e-6)
        np.testing.assert_allclose(getattr(case.rec, f"gyr{3 - is_late}")[:500], in_time, atol=1e-12)

    def test_a_rig_hinge_moves_about_its_own_axes(self):
        axis1, axis2, share = pf.moving_axes("rig_1D_04", 500, 2000)
        self.assertGreater(share, 0.99)
        self.assertGreater(abs(axis1[1]), np.cos(np.radians(2.0)))
        self.assertGreater(axis1[1] * axis2[1], 0.0)
        self.assertLess(pf.moving_axes("rig_2D_02", 0, 1300)[2], pf.ONE_AXIS_SHARE)


if __name__ == "__main__":
    unittest.main()
