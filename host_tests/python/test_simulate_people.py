"""The simulator of people is checked against its own poses by differences, and against what it promises of skin and axes."""

import json
import subprocess
import sys
import tempfile
import unittest
from dataclasses import replace
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

from jointcal_tools import quaternions as quat  # noqa: E402
from jointcal_tools import simulate_people as people  # noqa: E402
from jointcal_tools.jets import Clock  # noqa: E402
from jointcal_tools.recordings import load_csv  # noqa: E402
from jointcal_tools.simulate import GRAVITY_M_S2  # noqa: E402
from jointcal_tools.simulate_people import ACTIVITIES, PLACES, PersonSpec, simulate_person  # noqa: E402

FINE_HZ = 1000.0
MIXED = (("stand", 3.0), ("walk", 4.0), ("sit_to_stand", 4.0), ("run", 3.0))
# Truncation of a five-point difference at 1 kHz: (2 pi 19 Hz / 1 kHz)^4 / 30 = 7e-6 of the rate, 3e-6 of the acceleration.
RATE_TOL_RAD_S = 2e-4
FORCE_TOL_M_S2 = 2e-3
CLEAN = {"noise_scale": 0.0, "gyr_bias_deg_s": 0.0, "acc_bias": 0.0}


def first_difference(f, h):
    """Five-point derivative; loses two samples at either end."""
    return (8 * (f[3:-1] - f[1:-3]) - (f[4:] - f[:-4])) / (12 * h)


def second_difference(f, h):
    return (16 * (f[3:-1] + f[1:-3]) - (f[4:] + f[:-4]) - 30 * f[2:-2]) / (12 * h * h)


def differenced(sensed, h):
    """Rate and specific force (N - 4, 3) of a pose, in the sensor's frame."""
    r = quat.matrices(sensed.q)
    skew = np.swapaxes(r[2:-2], 1, 2) @ first_difference(r, h)
    rate = np.stack([skew[:, 2, 1], skew[:, 0, 2], skew[:, 1, 0]], axis=1)
    force = second_difference(sensed.p, h) + [0.0, 0.0, GRAVITY_M_S2]
    return rate, np.einsum("nji,nj->ni", r[2:-2], force)


def tilt_deg(a, b):
    return float(np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b)))


def octave_rms_deg(rocking, rate_hz, low_hz):
    spectrum = np.fft.rfft(rocking, axis=0)
    frequency = np.fft.rfftfreq(len(rocking), 1.0 / rate_hz)
    spectrum[(frequency < low_hz) | (frequency >= 2.0 * low_hz)] = 0.0
    return float(np.degrees(np.sqrt((np.fft.irfft(spectrum, len(rocking), axis=0) ** 2).sum(axis=1).mean())))


class SignalsTest(unittest.TestCase):
    def test_rates_and_forces_are_derivatives_of_the_poses(self):
        for joint in PLACES:
            spec = PersonSpec(MIXED, joint, seed=3, **CLEAN)
            clock = Clock(round(spec.duration_s * FINE_HZ), FINE_HZ)
            motion = people.move(spec, clock)
            for index in (0, 1):
                with self.subTest(joint=joint, sensor=index + 1):
                    sensed = people.sense(spec, index, clock, motion)
                    rate, force = differenced(sensed, 1.0 / FINE_HZ)
                    self.assertLess(np.abs(rate - sensed.gyr[2:-2]).max(), RATE_TOL_RAD_S)
                    self.assertLess(np.abs(force - sensed.acc[2:-2]).max(), FORCE_TOL_M_S2)

    def test_a_late_sensor_is_the_same_sensor_later(self):
        spec = PersonSpec((("walk", 8.0),), seed=5, lag_s=0.15, **CLEAN)
        rec, in_time = simulate_person(spec), simulate_person(replace(spec, lag_s=0.0))
        # The means over time, which centre abduction, rotation and skin, are of other instants: below 2 % of the signals.
        for late, right, least in ((rec.gyr2, in_time.gyr2, 0.06), (rec.acc2, in_time.acc2, 0.4)):
            self.assertLess(np.sqrt(np.mean((late[15:] - right[:-15]) ** 2)), 0.25 * least)
            self.assertGreater(np.sqrt(np.mean((late - right) ** 2)), least)

    def test_every_rate_sees_one_motion(self):
        recs = [simulate_person(PersonSpec((("random", 10.0),), rate_hz=rate_hz, seed=2, **CLEAN)) for rate_hz in (50.0, 100.0)]
        np.testing.assert_allclose(recs[0].gyr1, recs[1].gyr1[::2], atol=0.02)
        np.testing.assert_allclose(recs[0].acc2, recs[1].acc2[::2], atol=0.1)

    def test_the_same_spec_is_the_same_recording(self):
        spec = PersonSpec((("walk", 4.0),), seed=1)
        np.testing.assert_array_equal(simulate_person(spec).gyr2, simulate_person(spec).gyr2)
        self.assertGreater(np.abs(simulate_person(spec).gyr2 - simulate_person(replace(spec, seed=2)).gyr2).max(), 0.1)

    def test_what_cannot_be_simulated_is_refused(self):
        for wrong in ({"joint": "hip"}, {"activities": (("swim", 10.0),)}, {"activities": (("walk", 1.0),)}, {"rate_hz": 20.0}):
            with self.subTest(wrong), self.assertRaises(ValueError):
                PersonSpec(**wrong)


class ProgramTest(unittest.TestCase):
    def test_it_writes_a_recording_and_its_truth(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "x.csv"
            command = [sys.executable, ROOT / "tools" / "simulate_people.py", "--activity", "stand:3", "walk:4", "--joint", "ankle",
                       "--rate", "50", "--seed", "3", "--out", path]
            subprocess.run(command, check=True)
            rec, truth = load_csv(path), json.loads(path.with_suffix(".json").read_text())
        made = simulate_person(PersonSpec((("stand", 3.0), ("walk", 4.0)), "ankle", 50.0, 3))
        np.testing.assert_allclose(rec.gyr2, made.gyr2, atol=1e-6)
        np.testing.assert_allclose(rec.columns["ref_flexion_deg"], np.degrees(made.flexion_rad), atol=1e-5)
        np.testing.assert_allclose(truth["axis1"], made.axis1)


class JointTest(unittest.TestCase):
    def test_a_rigid_hinge_is_exact(self):
        spec = PersonSpec((("walk", 6.0), ("squat", 6.0)), seed=4, skin=0.0, out_of_plane=0.0, **CLEAN)
        rec = simulate_person(spec)
        np.testing.assert_array_equal(rec.q1, rec.bone1)
        axis1, axis2 = quat.matrices(rec.q1) @ rec.axis1, quat.matrices(rec.q2) @ rec.axis2
        np.testing.assert_allclose(axis1, axis2, atol=1e-12)
        for q, p, r in ((rec.q1, rec.p1, rec.r1), (rec.q2, rec.p2, rec.r2)):
            np.testing.assert_allclose(p - quat.matrices(q) @ r, rec.center_m, atol=1e-12)
        rate = rec.gyr2 @ rec.axis2 - rec.gyr1 @ rec.axis1
        bent = np.cumsum(0.5 * (rate[1:] + rate[:-1])) / rec.rate_hz
        np.testing.assert_allclose(bent, rec.flexion_rad[1:] - rec.flexion_rad[0], atol=np.radians(0.1))

    def test_motion_out_of_the_plane_is_of_its_size_and_tilts_no_axis(self):
        for joint, name, least_deg, most_deg in (("knee", "walk", 3.5, 4.5), ("knee", "run", 7.0, 9.0),
                                                 ("knee", "squat", 3.0, 4.0), ("elbow", "random", 1.5, 2.5)):
            for seed in (0, 1):
                with self.subTest(joint=joint, activity=name, seed=seed):
                    rec = simulate_person(PersonSpec(((name, 30.0),), joint, seed=seed))
                    size = np.degrees(np.hypot(rec.abduction_rad.std(), rec.rotation_rad.std()))
                    self.assertTrue(least_deg < size < most_deg, size)
                    for main, axis in zip(people.main_axes(rec), (rec.axis1, rec.axis2), strict=True):
                        self.assertLess(tilt_deg(main, axis), 1.5)
                    self.assertLess(abs(np.corrcoef(rec.abduction_rad, rec.flexion_rad)[0, 1]), 0.35)

    def test_stiff_bends_by_nothing_and_bending_by_what_is_asked(self):
        stiff = simulate_person(PersonSpec((("walk", 5.0),), seed=1, stiff=True, skin=0.0, **CLEAN))
        turn = quat.matrices(quat.multiply(quat.conjugate(stiff.q1), stiff.q2))
        np.testing.assert_allclose(turn, np.broadcast_to(turn[0], turn.shape), atol=1e-12)
        small = simulate_person(PersonSpec((("walk", 5.0),), seed=1, bending_deg=7.0))
        self.assertAlmostEqual(float(np.degrees(np.ptp(small.flexion_rad))), 7.0, places=6)


class SkinTest(unittest.TestCase):
    def test_rocking_has_the_spectrum_that_is_asked_for(self):
        for joint, scale in (("knee", 1.0), ("elbow", 0.5)):
            rec = simulate_person(PersonSpec((("random", 120.0),), joint, seed=6, in_phase=0.0))
            for q, bone in ((rec.q1, rec.bone1), (rec.q2, rec.bone2)):
                rocking = quat.rotation_vectors(quat.multiply(quat.conjugate(bone), q))
                for k, deg in enumerate(people.OCTAVES_DEG):
                    found = octave_rms_deg(rocking, rec.rate_hz, people.FIRST_OCTAVE_HZ * 2.0**k)
                    self.assertAlmostEqual(found / (scale * deg), 1.0, delta=0.12, msg=f"{joint}, octave {k}")

    def test_amount_scales_it_and_running_doubles_it(self):
        def size(activity, skin):
            rec = simulate_person(PersonSpec(((activity, 20.0),), seed=7, skin=skin, in_phase=0.0))
            rocking = quat.rotation_vectors(quat.multiply(quat.conjugate(rec.bone2), rec.q2))
            return octave_rms_deg(rocking, rec.rate_hz, 0.6)

        self.assertAlmostEqual(size("walk", 0.5) / size("walk", 1.0), 0.5, delta=0.02)
        self.assertAlmostEqual(size("run", 1.0) / size("walk", 1.0), 2.0, delta=0.1)

    def test_the_proximal_sensor_stays_behind_its_segment(self):
        rec = simulate_person(PersonSpec((("walk", 30.0),), seed=8, in_phase=0.12, skin=0.2))
        rocking = quat.rotation_vectors(quat.multiply(quat.conjugate(rec.bone1), rec.q1)) @ rec.axis1
        along = rec.gyr1 @ rec.axis1  # rate of the sensor's pitch, nearly; the bone's is 1 / 0.88 of it
        angle = np.cumsum(along - along.mean()) / rec.rate_hz
        slope = np.polyfit(angle - angle.mean(), rocking, 1)[0]
        self.assertAlmostEqual(slope, -0.12 / 0.88, delta=0.03)

    def test_skin_moves_a_sensor_by_millimetres(self):
        rec = simulate_person(PersonSpec((("walk", 20.0),), seed=9))
        for q, p, r in ((rec.bone1, rec.p1, rec.r1), (rec.bone2, rec.p2, rec.r2)):
            slide_m = np.linalg.norm(p - quat.matrices(q) @ r - rec.center_m, axis=1)
            self.assertTrue(0.3e-3 < np.sqrt(np.mean(slide_m**2)) < 4e-3)

    def test_rest_is_nearly_still(self):
        rec = simulate_person(PersonSpec((("stand", 10.0),), seed=1, **CLEAN))
        self.assertLess(np.sqrt(np.mean((rec.gyr1**2).sum(axis=1))), 0.15)
        self.assertAlmostEqual(float(np.median(np.linalg.norm(rec.acc1, axis=1))), GRAVITY_M_S2, delta=0.1)


class ActivitiesTest(unittest.TestCase):
    def test_sizes_are_those_of_people(self):
        # rms rates of thigh and shank, rad/s, with room around those of recordings: walking 0.6 to 1.2 and 1.1 to 1.7 with pauses.
        for name, low, high in (("walk", (1.0, 1.5), (2.0, 3.2)), ("run", (2.5, 3.5), (4.5, 7.0)),
                                ("sit_to_stand", (0.6, 0.3), (1.3, 0.9))):
            rec = simulate_person(PersonSpec(((name, 20.0),), seed=3))
            for k, gyr in enumerate((rec.gyr1, rec.gyr2)):
                size = np.sqrt(np.mean((gyr**2).sum(axis=1)))
                self.assertTrue(low[k] < size < high[k], f"{name}, sensor {k + 1}: {size}")

    def test_all_of_them_make_every_joint(self):
        for joint in PLACES:
            for name in ACTIVITIES:
                rec = simulate_person(PersonSpec(((name, 4.0),), joint, rate_hz=40.0))
                self.assertEqual(len(rec), 160)
                self.assertTrue(np.isfinite(np.column_stack([rec.gyr1, rec.acc1, rec.gyr2, rec.acc2])).all())
                self.assertEqual(rec.truth()["spec"]["joint"], joint)


if __name__ == "__main__":
    unittest.main()
