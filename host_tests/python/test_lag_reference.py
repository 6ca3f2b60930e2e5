"""The lag of two sensors: the float64 reference on simulated joints, the C library beside it, and pairs at common times."""

import sys
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

from jointcal_tools import functional_sensor, lag_reference, native_pairing  # noqa: E402
from jointcal_tools.native_pairing import Stream  # noqa: E402
from jointcal_tools.recordings import Recording  # noqa: E402
from jointcal_tools.simulate import HingeSpec, simulate_hinge  # noqa: E402
from jointcal_tools.simulate_people import PersonSpec, simulate_person  # noqa: E402

JUDGE_EVERY = 29  # ticks: 135 slices at 100 Hz, less those that finish a term


def person(seed: int, lag_s: float = 0.0, joint: str = "knee", seconds: float = 30.0, rate_hz: float = 100.0) -> Recording:
    return simulate_person(PersonSpec((("squat", seconds / 2), ("walk", seconds / 2)), joint, seed=seed, rate_hz=rate_hz, lag_s=lag_s,
                                      gyr_bias_deg_s=0.0))


def ticks_of(t_s: np.ndarray, gyr: np.ndarray, acc: np.ndarray) -> list[functional_sensor.Tick]:
    return functional_sensor.features(t_s, functional_sensor.orientation(t_s, gyr, acc), gyr, acc)


def until_known(t_s: np.ndarray, one: np.ndarray, two: np.ndarray) -> lag_reference.Lag:
    """The reference up to where it first knows the lag, or to the end. Readings (N, 6); nothing is taken off."""
    lag = lag_reference.Lag()
    pairs = zip(ticks_of(t_s, one[:, :3], one[:, 3:]), ticks_of(t_s, two[:, :3], two[:, 3:]), strict=True)
    for number, (tick1, tick2) in enumerate(pairs, 1):
        lag.add(tick1, tick2)
        if number % JUDGE_EVERY == 0:
            lag.judge()
            if lag.known:
                break
    return lag


def values(rec: Recording, sensor: int) -> np.ndarray:
    return np.hstack([rec.gyr1, rec.acc1] if sensor == 1 else [rec.gyr2, rec.acc2])


class Reference(unittest.TestCase):
    def test_the_polynomial_meets_every_node_and_every_polynomial_of_its_degree(self):
        at = np.arange(-lag_reference.SIDE, lag_reference.SIDE + 1.0)
        for k, node in enumerate(at):
            np.testing.assert_allclose(lag_reference.between(node), np.eye(len(at))[k], atol=1e-12)
        for lag in (-5.9, -2.9, -0.4, 1.3, 5.2):
            weights = lag_reference.between(lag)
            self.assertLessEqual(np.ptp(np.flatnonzero(weights)), lag_reference.NEAR - 1)
            for power in range(lag_reference.NEAR):
                self.assertAlmostEqual(weights @ at**power, lag**power, delta=1e-12 * 6.0**power + 1e-9)

    def test_a_persons_small_lag_is_known_to_milliseconds(self):
        """At the moment at which it is first known: each within its bound, all together within 5 ms rms."""
        errors_s = []
        for seed, true_s in ((1, 0.0), (2, 0.0135), (3, -0.02)):
            rec = person(seed, true_s)
            lag = until_known(rec.t_s, values(rec, 1), values(rec, 2))
            self.assertTrue(lag.known, (seed, lag.share, lag.bound_s))
            self.assertLess(abs(lag.left_s - true_s), lag.known_bound_s, seed)
            errors_s.append(lag.left_s - true_s)
        self.assertLess(np.sqrt(np.mean(np.square(errors_s))), 0.005)

    def test_large_lags_are_known_as_well(self):
        for seed, true_s in ((1, 0.2345), (2, -0.18)):
            rec = person(seed, true_s)
            lag = until_known(rec.t_s, values(rec, 1), values(rec, 2))
            self.assertTrue(lag.known)
            self.assertLess(abs(lag.left_s - true_s), lag.known_bound_s)
            found_s = lag.left_s
            self.assertEqual(lag.shift(), found_s)
            self.assertEqual((lag.applied_s, lag.left_s, lag.sums.count), (found_s, 0.0, 0.0))

    def test_a_rigid_hinge_needs_no_axis(self):
        rec = simulate_hinge(HingeSpec((("7", 25.0),), seed=4))
        lag = until_known(rec.t_s, values(rec, 1), values(rec, 2))
        self.assertTrue(lag.known)
        self.assertLess(abs(lag.left_s), 0.003)

    def test_sensors_of_two_people_share_nothing(self):
        for seed in (1, 2, 3):
            one, two = person(seed), person(seed + 10)
            lag = until_known(one.t_s, values(one, 1), values(two, 2))
            self.assertFalse(lag.known)
            self.assertEqual(lag.agreed, 0)


class Library(unittest.TestCase):
    def test_it_finds_what_the_reference_finds(self):
        for seed, true_s in ((2, 0.0135), (3, -0.02)):
            rec = person(seed, true_s)
            found = native_pairing.run(Stream(rec.t_s, values(rec, 1)), Stream(rec.t_s, values(rec, 2)))
            self.assertTrue(found.known.any())
            first = int(np.argmax(found.known))
            lag = until_known(rec.t_s, values(rec, 1), values(rec, 2))
            self.assertLess(abs(found.lag_s[first] - lag.left_s), 1.5e-3)
            self.assertLess(abs(found.bound_s[first] - lag.known_bound_s), 2e-3)

    def test_lags_of_both_signs_are_taken_off(self):
        for seed, true_s in ((1, 0.2345), (2, -0.18), (5, 0.07)):
            rec = person(seed, seconds=60.0)
            late = Stream(rec.t_s + true_s, values(rec, 2))
            found = native_pairing.run(Stream(rec.t_s, values(rec, 1)), late)
            self.assertTrue(found.known[-1], seed)
            self.assertLess(abs(found.lag_s[-1] - true_s), min(found.bound_s[-1], 0.005))
            self.assertLess(abs(found.taken_s[-1] - true_s), 0.012)
            jumps = np.diff(found.t_s)
            self.assertTrue(((np.abs(jumps - 0.01) < 1e-6) | (jumps > 0.29)).all())

    def test_different_rates_jitter_and_losses(self):
        rng = np.random.default_rng(1)
        rec, slow = person(6, seconds=40.0, rate_hz=200.0), slice(0, None, 4)
        t1 = rec.t_s + rng.uniform(0.0, 0.003, len(rec.t_s))
        kept = rng.uniform(size=len(t1)) > 0.1
        t2 = rec.t_s[slow] + 0.11
        moved = [np.column_stack([np.interp(t1, rec.t_s, column) for column in values(rec, 1).T]), values(rec, 2)[slow]]
        found = native_pairing.run(Stream(t1[kept], moved[0][kept]), Stream(t2, moved[1], late_s=0.05))
        self.assertTrue(found.known[-1])
        self.assertLess(abs(found.lag_s[-1] - 0.11), min(found.bound_s[-1], 0.006))

    def test_sensors_of_two_people_are_never_aligned(self):
        for seed in range(6):
            one, two = person(seed, joint="elbow"), person(seed + 50, joint="elbow")
            found = native_pairing.run(Stream(one.t_s, values(one, 1)), Stream(two.t_s, values(two, 2)))
            self.assertFalse(found.known.any())

    def test_interpolation_loses_what_the_header_says(self):
        t1, t2 = np.arange(0.0, 20.0, 0.01), np.arange(0.0037, 20.0, 0.04)
        for hz in (1.0, 5.0):
            def sine(t, hz=hz):
                return np.repeat(np.sin(2.0 * np.pi * hz * t)[:, None], 6, axis=1)
            found = native_pairing.run(Stream(t1, sine(t1)), Stream(t2, sine(t2)), with_lag=False)
            error = np.abs(found.pairs[:, 6] - sine(found.t_s)[:, 0]).max()
            most = 0.5 * (np.pi * hz * 0.04) ** 2
            self.assertLess(error, most)
            self.assertGreater(error, 0.7 * most)
            self.assertLess(np.abs(found.pairs[:, 0] - sine(found.t_s)[:, 0]).max(), 1e-5)  # at its own times


if __name__ == "__main__":
    unittest.main()
