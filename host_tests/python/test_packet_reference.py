"""The float64 reference of packets: exact clocks, drift and jitter, order, sensors that begin anew."""

import sys
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

from jointcal_tools import packet_reference as pr  # noqa: E402


def run(follower, packets):
    return [time for packet in packets for time in follower.take(packet)]


def true_times(radio, n):
    return radio.hub0_us + 1e6 * radio.period_s * (1.0 + 1e-6 * radio.drift_ppm) * np.arange(n)


class Line(unittest.TestCase):
    def test_support_is_that_of_the_hull(self):
        points = np.array([[0.0, 1.0], [1.0, 0.0], [2.0, 3.0], [3.0, 0.5], [4.0, 4.0]])
        self.assertAlmostEqual(pr.support(points), 0.25)

    def test_a_clock_without_jitter_is_found_exactly(self):
        radio = pr.Radio(drift_ppm=321.0, jitter_s=0.0, delay_s=0.004)
        follower = pr.Follower(pr.Config())
        times = run(follower, pr.simulate(radio, 60.0, np.random.default_rng(1)))
        self.assertLess(abs(follower.clock.drift_ppm - 321.0), 0.1)
        self.assertLess(np.abs(times - true_times(radio, len(times)) - 4000.0)[3000:].max(), 3.0)

    def test_jitter_of_25_ms_leaves_less_than_half_a_millisecond(self):
        for seed, drift, count in ((1, 500.0, 1), (2, -500.0, 10), (3, 100.0, 16)):
            radio = pr.Radio(drift_ppm=drift, count=count)
            follower = pr.Follower(pr.Config())
            times = run(follower, pr.simulate(radio, 150.0, np.random.default_rng(seed)))
            off = (times - true_times(radio, len(times)))[3000:]
            self.assertLess(off.std(), 500.0)
            self.assertLess(abs(follower.clock.drift_ppm - drift), 12.0)
            self.assertGreater(np.diff(times).min(), 9800.0)
            self.assertEqual(follower.counts["readings"], len(times))


class Order(unittest.TestCase):
    def setUp(self):
        self.radio = pr.Radio(bits=8)
        self.config = pr.Config(bits=8, max_delay_s=1.0)

    def test_wraps_losses_late_and_duplicate_packets_are_counted(self):
        packets = pr.simulate(self.radio, 20.0, np.random.default_rng(1))
        late = packets[500]._replace(arrival_us=packets[501].arrival_us + 1)
        order = packets[:500] + [packets[501], late, late] + packets[502:900] + packets[1300:]
        follower = pr.Follower(self.config)
        times = run(follower, order)
        self.assertEqual(follower.counts, {"readings": 1599, "lost": 401, "late": 1, "duplicate": 1, "odd": 0, "restarts": 0,
                                           "steps": 0})
        self.assertAlmostEqual(times[899] - times[898], 4.01e6, delta=5e4)

    def test_a_sensor_that_begins_anew_is_learnt_anew(self):
        follower = pr.Follower(pr.Config())
        radio = pr.Radio(counter0=40000)
        run(follower, pr.simulate(radio, 20.0, np.random.default_rng(1)))
        again = pr.Radio(hub0_us=25000000)
        times = run(follower, pr.simulate(again, 20.0, np.random.default_rng(2)))
        self.assertEqual((follower.counts["restarts"], follower.counts["odd"], len(times)), (1, 2, 1998))
        self.assertLess(abs(times[-1] - true_times(again, 2000)[-1] - 5000.0), 1000.0)

    def test_a_radio_that_becomes_slower_is_a_step_of_the_clock(self):
        rng = np.random.default_rng(1)
        packets = pr.simulate(pr.Radio(), 60.0, rng)
        slower = [p._replace(arrival_us=p.arrival_us + 300000) for p in packets[3000:]]
        follower = pr.Follower(pr.Config())
        times = np.array(run(follower, packets[:3000] + slower))
        self.assertEqual(follower.counts["steps"], 1)
        self.assertGreater(np.diff(times).max(), 250000.0)
        self.assertLess(abs(times[-1] - 60.29e6 - 1e6 - 5000.0), 2000.0)


if __name__ == "__main__":
    unittest.main()
