"""Which sensors of which recording make a joint, starts with motion, and the spectrum of what a hinge leaves."""

import sys
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

from jointcal_tools.measure import people_joints as pj  # noqa: E402
from jointcal_tools.measure.judge import available  # noqa: E402
from jointcal_tools.recordings import Recording  # noqa: E402
from jointcal_tools.simulate_people import PersonSpec, simulate_person  # noqa: E402

RATE_HZ = 50.0
SEGMENTS = {"knee": (("thigh", "upper_leg"), ("shank", "lower_leg")), "hip": (("pelvis", "hip"), ("thigh", "upper_leg")),
            "ankle": (("shank",), ("foot",)), "elbow": (("upper_arm",), ("forearm",)), "none": (("thigh",), ("thigh",))}


def turning(rates):
    """A recording whose sensor 1 turns with the given rates (N,), sensor 2 with none."""
    still = np.zeros((len(rates), 3))
    gyr1 = still.copy()
    gyr1[:, 1] = rates
    return Recording(np.arange(len(rates)) / RATE_HZ, gyr1, still, still, still)


class MotionTest(unittest.TestCase):
    def test_one_rad_per_s_counts_half_and_rest_nothing(self):
        np.testing.assert_allclose(pj.motion_weight(turning(np.ones(200))), 0.5)
        np.testing.assert_array_equal(pj.motion_weight(turning(np.zeros(200))), 0.0)
        self.assertAlmostEqual(pj.motion_s(turning(np.ones(200)))[-1], 2.0)
        self.assertAlmostEqual(pj.motion_weight(turning(np.ones(5)), knee=0.25)[-1], 0.8)

    def test_a_part_has_its_motion_within_its_horizon(self):
        rates = np.zeros(3000)  # 60 s: motion from 30 to 40 s
        rates[1500:2000] = 10.0
        with mock.patch.object(pj, "people_joint", return_value=turning(rates)):
            found = pj.parts(["x"], every_s=10.0, horizon_s=15.0, least_s=4.9)  # 100/101 of a second counts
            self.assertEqual([part.begin_s for part in found], [20.0, 30.0])
            self.assertEqual([(part.begin, part.end) for part in found], [(1000, 1750), (1500, 2250)])
            self.assertAlmostEqual(found[0].motion_s, 5.0, delta=0.2)
            self.assertAlmostEqual(found[1].motion_s, 10.0, delta=0.5)  # it takes 0.1 s ln(100) to fade
            self.assertEqual(pj.parts(["x"], horizon_s=15.0, least_s=11.0), [])


class SpectrumTest(unittest.TestCase):
    def test_a_hinge_leaves_nothing_across(self):
        rec = simulate_person(PersonSpec((("walk", 20.0),), seed=1, skin=0.0, out_of_plane=0.0, noise_scale=0.0, gyr_bias_deg_s=0.0))
        rates = pj.octave_rates(rec, rec.axis1, rec.axis2)
        self.assertLess(rates[-1, 0], 0.01 * rates[-1, 1])
        self.assertAlmostEqual(float(np.sum(rates[:-1] ** 2, axis=0)[1] / rates[-1, 1] ** 2), 1.0, delta=0.02)

    def test_axes_are_found_without_the_truth(self):
        rec = simulate_person(PersonSpec((("random", 20.0),), seed=2, rate_hz=50.0))
        for found, axis in zip(pj.fitted_axes(rec), (rec.axis1, rec.axis2), strict=True):
            self.assertGreater(abs(found @ axis), np.cos(np.radians(5.0)))

    def test_a_band_holds_its_sine(self):
        t_s = np.arange(500) / RATE_HZ
        sine = np.sin(2.0 * np.pi * 3.0 * t_s)
        self.assertAlmostEqual(pj.band_rms(sine, RATE_HZ, (2.0, 4.0)), np.sqrt(0.5))
        self.assertAlmostEqual(pj.band_rms(sine, RATE_HZ, (4.0, 8.0)), 0.0)
        np.testing.assert_allclose(pj.low_pass(sine, RATE_HZ, 2.0), 0.0, atol=1e-12)


@unittest.skipUnless(available("walk_leg_L", "people_knee_long_L1", "people_walk_L"), "the recordings of people are not there")
class RecordingsTest(unittest.TestCase):
    def test_segments_are_those_that_the_source_names(self):
        for name in pj.people_joints() + ["people_same_segment_L"]:
            joint = pj.JOINTS[name]
            segments = pj.people_joint(name).facts.get("segments")
            if segments is None:
                self.assertIn(joint.file, ("knee_drop", "walk_leg_L"))  # their notes name the segments
                continue
            for sensor, words in zip(joint.sensors, SEGMENTS[joint.kind], strict=True):
                self.assertTrue(segments[sensor - 1].startswith(words), f"{name}, sensor {sensor}")

    def test_joints_of_three_sensors_take_the_right_ones(self):
        knee, hip = pj.people_joint("walk_leg_L:knee"), pj.people_joint("walk_leg_L:hip")
        np.testing.assert_array_equal(knee.gyr1, hip.gyr2)
        np.testing.assert_array_equal(knee.acc2[:, 0], knee.columns["acc3_x"])

    def test_flexion_grows_with_the_rate_about_the_axes(self):
        rec = pj.people_joint("people_knee_long_L1")
        rate = rec.gyr2 @ rec.facts["axis2_ref"] - rec.gyr1 @ rec.facts["axis1_ref"]
        slope = np.gradient(np.radians(rec.flexion_deg)) * rec.rate_hz
        good = np.isfinite(slope)
        self.assertGreater(np.corrcoef(rate[good], slope[good])[0, 1], 0.9)
        self.assertGreater(np.median(pj.people_joint("knee_drop").flexion_deg), 0.0)

    def test_frames_that_disagree_are_left_out_on_demand(self):
        self.assertFalse(any(name.startswith("people_sts") for name in pj.people_joints()))
        self.assertTrue(any(name.startswith("people_sts") for name in pj.people_joints("knee", frames_agree=False)))
        self.assertEqual({pj.JOINTS[name].kind for name in pj.people_joints("elbow")}, {"elbow"})


if __name__ == "__main__":
    unittest.main()
