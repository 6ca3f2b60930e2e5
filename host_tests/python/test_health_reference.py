"""The health of one sensor: the float64 reference where the answer is known, and the C library beside it."""

import sys
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

from jointcal_tools import health_reference as reference  # noqa: E402
from jointcal_tools import native_health  # noqa: E402
from jointcal_tools.simulate import HingeSpec, simulate_hinge  # noqa: E402

G_M_S2 = 9.81


def turning(seconds: float, rate_hz: float = 100.0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A sensor that turns about all its axes and does not move: times, rates, forces. The force is that in the middle of the time of a reading."""
    steps = round(seconds * rate_hz)
    t_s = np.arange(steps + 1) / rate_hz
    middle = t_s - 0.5 / rate_hz
    gyr = np.column_stack([1.1 * np.sin(0.9 * middle), 0.9 * np.cos(0.61 * middle), 0.8 * np.sin(0.37 * middle + 1.0)])
    acc, orientation = np.zeros_like(gyr), np.eye(3)
    for k in range(steps + 1):
        acc[k] = (orientation @ reference.rotation(0.5 * gyr[k] / rate_hz)).T @ [0.0, 0.0, G_M_S2]
        orientation = orientation @ reference.rotation(gyr[k] / rate_hz)
    return t_s, gyr, acc


class Reference(unittest.TestCase):
    def test_blocks_turn_forces_back_to_where_gravity_was(self):
        t_s, gyr, acc = turning(3.0)
        blocks = reference.blocks_of(t_s, gyr, acc)
        orientation = reference.rotation(gyr[0] * 0.01)
        for block in blocks:
            np.testing.assert_allclose(orientation @ block.back, [0.0, 0.0, G_M_S2], atol=1e-9)
            orientation = orientation @ reference.rotation(block.angle)

    def test_the_jacobian_is_that_of_finite_differences(self):
        t_s, gyr, acc = turning(6.0)
        acc = acc + np.random.default_rng(1).standard_normal(acc.shape)

        def after(scale: float, bias: np.ndarray) -> np.ndarray:
            past = reference.Past(acc[0], np.zeros((3, 4)))
            for block in reference.blocks_of(t_s, gyr, acc):  # the turn within a block is that of the rates as they stand
                changed = reference.Block(block.turn, scale * block.angle + bias * block.length_s, block.acc, block.back, block.length_s)
                past.take(changed.back, 0.05)
                past.turn(changed)
            return past.g

        past = reference.Past(acc[0], np.zeros((3, 4)))
        for block in reference.blocks_of(t_s, gyr, acc):
            past.take(block.back, 0.05)
            past.turn(block)
        # The change of a turn is taken as that of a small one: half the angle of a block, 0.08 rad, of the bias across it.
        numeric = np.column_stack([*((after(1.0, 1e-5 * axis) - after(1.0, -1e-5 * axis)) / 2e-5 for axis in np.eye(3)),
                                   (after(1.0 + 1e-5, np.zeros(3)) - after(1.0 - 1e-5, np.zeros(3))) / 2e-5])
        np.testing.assert_allclose(past.by, numeric, atol=0.04 * np.abs(numeric).max())

    def test_the_scale_is_found_whatever_the_bias(self):
        t_s, gyr, acc = turning(40.0)
        for true in (0.97, 1.0, 1.02):
            scale, deviation = reference.scale_of(reference.blocks_of(t_s, gyr / true + 0.003, acc))
            self.assertAlmostEqual(scale, true, delta=2e-3)
            self.assertLess(deviation, 0.005)

    def test_each_way_fits_readings_that_were_read_so_and_no_other(self):
        t_s, gyr, acc = turning(4.3)
        ways = reference.ways()
        for true in (0, 2, 16, 47):
            window = reference.blocks_of(t_s, gyr @ ways[true], acc)[: reference.BLOCKS]  # rates are read as M' w, so M puts them right
            left = [reference.open_by(window, way) for way in ways]
            self.assertEqual(int(np.argmin(left)), true)
            self.assertLess(left[true], 1e-3)
            self.assertGreater(sorted(left)[1], 0.01)

    def test_forces_that_are_turned_round_are_no_way(self):
        t_s, gyr, acc = turning(4.3)
        right, round_about = (reference.blocks_of(t_s, gyr, sign * acc)[: reference.BLOCKS] for sign in (1.0, -1.0))
        for way in reference.ways()[::7]:
            self.assertAlmostEqual(reference.open_by(right, way), reference.open_by(round_about, way), delta=1e-12)


class Library(unittest.TestCase):
    def test_scale_and_deviation_are_those_of_the_reference(self):
        for seed in range(4):
            rec = simulate_hinge(HingeSpec((("7", 40.0),), seed=seed, gyr_bias_deg_s=0.3, acc_bias=0.1))
            said = native_health.run(rec.t_s, rec.gyr2, rec.acc2)
            scale, deviation = reference.scale_of(reference.blocks_of(rec.t_s, rec.gyr2, rec.acc2))
            # exp to second order in a low-pass, turns within blocks to second order
            self.assertAlmostEqual(said.scale, scale, delta=0.1 * deviation + 2e-4)
            self.assertAlmostEqual(said.deviation, deviation, delta=0.05 * deviation)

    def test_scores_of_the_first_window_are_those_of_the_reference(self):
        rec = simulate_hinge(HingeSpec((("6", 9.0),), seed=3))
        swapped = rec.gyr1[:, [1, 0, 2]]
        said = native_health.run(rec.t_s[:700], swapped[:700], rec.acc1[:700])
        self.assertEqual(said.trials, 1)
        window = reference.blocks_of(rec.t_s, swapped, rec.acc1)[: reference.BLOCKS]
        expected = np.array([reference.open_by(window, way) for way in reference.ways()])
        # Turns are kept in steps of 1/64 rad, forces in 1/32 of gravity, and what rounding leaves is carried on: 0.01 of gravity a part.
        np.testing.assert_allclose(said.score[:48], expected, rtol=0.1, atol=2e-3)

    def test_a_second_estimate_finds_a_scale_that_is_far_off(self):
        t_s, gyr, acc = turning(60.0)
        for true in (0.8, 1.25):
            said = native_health.run(t_s, gyr / true, acc)
            self.assertIn("scale", said.named)
            self.assertAlmostEqual(said.scale, true, delta=0.01)

    def test_the_way_that_is_named_puts_columns_right(self):
        t_s, gyr, acc = turning(40.0)
        said = native_health.run(t_s, gyr, acc[:, [1, 2, 0]])  # x, y, z stand in columns 3, 1, 2
        self.assertEqual(said.named, {"frames"})
        self.assertEqual((said.number["way_known"], said.number["way_of_gyr"], said.way), (1.0, 0.0, ((2, 0, 1), (1, 1, 1))))
        said = native_health.run(t_s, gyr * [1.0, -1.0, 1.0], acc)
        self.assertEqual((said.named, said.number["way_of_gyr"], said.way), ({"frames"}, 1.0, ((0, 1, 2), (1, -1, 1))))

    def test_nothing_is_said_of_good_readings_or_of_too_few(self):
        t_s, gyr, acc = turning(60.0)
        rng = np.random.default_rng(2)
        noisy = gyr + 0.003 * rng.standard_normal(gyr.shape), acc + 0.1 * rng.standard_normal(acc.shape)
        self.assertEqual(native_health.run(t_s, *noisy).named, set())
        self.assertEqual(native_health.run(t_s, *noisy).state["scale"], "fine")
        few = native_health.run(t_s[:40], noisy[0][:40], noisy[1][:40])
        self.assertEqual(set(few.state.values()), {"unknown"})


if __name__ == "__main__":
    unittest.main()
