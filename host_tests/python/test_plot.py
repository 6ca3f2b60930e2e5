# SPDX-License-Identifier: MIT
"""tools/plot.py: what is drawn is what was written, nothing is covered, empty panels say why, memory is bounded."""
import contextlib
import io
import json
import os
import pathlib
import pty
import re
import subprocess
import sys
import tempfile
import tracemalloc
import unittest

import matplotlib
import numpy as np

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402

from jointcal_tools.plot import angles, calibration, check, command, motion, panels, reading, reduce, style, told  # noqa: E402
from jointcal_tools.plot.joints import JOINTS  # noqa: E402
from jointcal_tools.plot.truth import Truth, read_truth  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "build" / "host" / "jointcal"
DEMO = ROOT / "tools" / "demo"
ALL_TIME = (float("-inf"), float("inf"))
STYLES = {name: style.make_style(name, None, None, None, None) for name in ("single", "double", None)}
HEADER = ",".join(["t_s", *(f"{kind}{sensor}_{axis}" for sensor in "123" for kind in ("gyr", "acc") for axis in "xyz")])
SECONDS = 20.0


def recording_text(rows, rate_hz=50.0, text="{:.3f}"):
    """Three sensors that turn."""
    t_s = np.arange(rows) / rate_hz
    columns = [t_s, *(np.sin((0.7 + 0.1 * k) * t_s + k) for k in range(18))]
    return "\n".join([HEADER, *(",".join(text.format(value) for value in row) for row in zip(*columns, strict=True))]) + "\n"


def lines_of(joint, seconds=SECONDS, known=True, others=True, every_s=0.1, status=None):
    """Lines such as the program writes: errors and bounds shrink, ready at half time."""
    directions = joint.directions
    for k in range(1, round(seconds / every_s) + 1):
        t_s = k * every_s
        level = 30.0 * np.exp(-5.0 * t_s / seconds)
        tilt = np.radians(level)
        line = {"event": "estimate", "t_s": t_s, "status": status or ("collecting" if t_s < seconds / 2 else "ready"),
                "engine": "stream", "weak": "axis2", "hint": "move_joint", "reason": "no_data"}
        for n, key in enumerate(joint.keys):
            line[key] = [np.sin(tilt), 0.0, np.cos(tilt)] if directions else [0.1 + 0.001 * level, 0.02 * n, 0.3]
        line[joint.bound] = [2.0 * level / joint.per_unit] * len(joint.keys) if known else None
        for other in joint.others:
            line[other.key] = (0.019 + 0.0005 * np.sin(t_s)) if others else None
        yield json.dumps(line)
    yield json.dumps({**line, "event": "end"})


def truth_of(joint, good_to=None):
    vectors = [[0.0, 0.0, 1.0] if joint.directions else [0.1, 0.02 * n, 0.3] for n in range(len(joint.keys))]
    return Truth(np.array(vectors), good_to)


class Folder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(plt.close, "all")
        self.folder = pathlib.Path(folder.name)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def recording(self, rows=round(50 * SECONDS)):
        return self.write("recording.csv", recording_text(rows))

    def calibration(self, joint, which=None, truth=None, **how):
        """A figure."""
        moved = motion.read_motion(self.recording(), joint, *ALL_TIME)
        lines = told.Told("lines", joint, truth, reading.Clock()).read(lines_of(joint, **how))
        with STYLES[which].context():
            return calibration.draw_calibration(lines, moved, joint.max_bound, "A title", STYLES[which])

    def run_command(self, *arguments):
        """Exit status and what was said on standard error."""
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            try:
                status = command.main([str(argument) for argument in arguments])
            except SystemExit as leaving:
                status = leaving.code
        return status, said.getvalue()

    def drawn(self, *arguments, kind="svg"):
        """The figure's text."""
        out = self.folder / f"out.{kind}"
        self.assertEqual(self.run_command(*arguments, "-o", out), (0, ""))
        return out.read_text() if kind == "svg" else out.read_bytes()

    def refused(self, message, *arguments, out="out.png"):
        status, said = self.run_command(*arguments, "-o", self.folder / out)
        self.assertEqual((status, said.strip().replace(f"{self.folder}/", "")), (2, message))
        self.assertFalse((self.folder / out).is_file())


class Reducing(unittest.TestCase):
    def test_a_line_passes_through_every_row_while_rows_are_few(self):
        t_s = np.arange(reduce.BUCKETS) * 0.01
        curves = reduce.Reducer(1)
        curves.add(t_s, np.sin(t_s)[:, None])
        times, values = curves.finish().trace(0)
        np.testing.assert_array_equal(times, t_s)
        np.testing.assert_array_equal(values, np.sin(t_s))

    def test_no_peak_is_lost_in_a_bounded_number_of_points(self):
        rows = 100 * reduce.BUCKETS + 77
        values = np.sin(np.arange(rows) * 1e-3)
        values[12345], values[123456], values[-1] = 5.0, -7.0, 6.0
        curves = reduce.Reducer(1)
        curves.add(np.arange(rows) * 0.01, values[:, None])
        times, drawn = curves.finish().trace(0)
        self.assertLessEqual(len(times), 4 * reduce.BUCKETS + 2)
        for row in (12345, 123456, rows - 1):
            at = np.flatnonzero(drawn == values[row])
            self.assertEqual([times[k] for k in at], [row * 0.01])
        self.assertTrue((np.diff(times) >= 0.0).all())

    def test_pieces_do_not_matter(self):
        rng = np.random.default_rng(5)
        t_s, values = np.arange(30000) * 0.02, rng.normal(size=(30000, 2))
        values[rng.random(30000) < 0.1] = np.nan
        whole, pieces = reduce.Reducer(2), reduce.Reducer(2)
        whole.add(t_s, values)
        begin = 0
        while begin < len(t_s):
            end = begin + int(rng.integers(0, 4000))
            pieces.add(t_s[begin:end], values[begin:end])
            begin = end
        whole.finish(), pieces.finish()
        for k in range(2):
            for one, other in zip(whole.trace(k), pieces.trace(k), strict=True):
                np.testing.assert_array_equal(one, other)
        np.testing.assert_allclose(whole.means(5.0)[1], pieces.means(5.0)[1], rtol=1e-12)

    def test_means_of_a_long_curve_are_those_of_its_rows(self):
        t_s = np.arange(20 * reduce.BUCKETS) * 0.01
        curves = reduce.Reducer(1)
        curves.add(t_s, (3.0 + 0.01 * t_s)[:, None])
        times, means = curves.finish().means(2.0)
        inside = (times > 2.0) & (times < t_s[-1] - 2.0)
        pitch_s = times[1] - times[0]
        self.assertLess(np.abs(means[inside, 0] - 3.0 - 0.01 * times[inside]).max(), 0.01 * pitch_s)

    def test_a_line_is_broken_at_a_gap(self):
        t_s = np.concatenate([np.arange(100) * 0.1, 60.0 + np.arange(100) * 0.1])
        times, values = reduce.broken_at_gaps(t_s, np.ones(200))
        self.assertEqual(np.flatnonzero(np.isnan(values)).tolist(), [100])
        self.assertEqual(len(times), 201)


class Memory(Folder):
    def peak_mb(self, work):
        tracemalloc.start()
        work()
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        return peak / 1e6

    def test_a_recording_is_read_in_pieces(self):
        block = recording_text(1000).splitlines()[1:]
        rest = [row.split(",", 1)[1] for row in block]
        peaks = []
        for blocks in (30, 120):
            path = self.folder / "long.csv"
            with path.open("w") as file:
                file.write(HEADER + "\n")
                for number in range(blocks):
                    file.writelines(f"{20 * number + k * 0.02:.2f},{row}\n" for k, row in enumerate(rest))
            peaks.append(self.peak_mb(lambda path=path: motion.read_motion(path, JOINTS["chain"], *ALL_TIME)))
        self.assertLess(peaks[1], 20.0)
        self.assertLess(peaks[1], 1.1 * peaks[0] + 0.5)

    def test_lines_are_read_one_by_one(self):
        joint = JOINTS["hinge"]
        peaks = [self.peak_mb(lambda n=n: told.Told("lines", joint, truth_of(joint), reading.Clock()).read(
            lines_of(joint, seconds=n))) for n in (500, 1500)]
        self.assertLess(peaks[1], 10.0)
        self.assertLess(peaks[1], 1.1 * peaks[0] + 0.5)

    def test_angles_and_a_reference_are_read_in_pieces(self):
        peaks = []
        for rows in (100_000, 400_000):
            for name, rate_hz, column in (("angles", 100.0, "flexion_deg"), ("reference", 80.0, "ref_flexion_deg")):
                self.write(f"{name}.csv", f"t_s,{column}\n" + "".join(f"{k / rate_hz:.4f},{k % 70}\n" for k in range(rows)))
            peaks.append(self.peak_mb(lambda: angles.read_angles(
                self.folder / "angles.csv", [], (self.folder / "reference.csv", []), ALL_TIME, False)))
        self.assertLess(peaks[1], 40.0)
        self.assertLess(peaks[1], 1.1 * peaks[0] + 0.5)


class LogAxes(Folder):
    def test_three_numbers_at_least_in_any_range(self):
        for factor in (1.05, 1.3, 2.0, 4.0, 9.0, 30.0, 1e3, 1e5, 1e12):
            for low in (1.1e-3, 0.0184, 0.97, 3.3, 8.1, 640.0):
                ticks = panels.log_ticks(low, low * factor)
                self.assertTrue(3 <= len(ticks) <= panels.MOST_TICKS, (low, factor, ticks))
                self.assertTrue(all(low <= tick <= low * factor for tick in ticks))

    def test_a_misfit_within_a_decade_has_numbers(self):
        panel = self.calibration(JOINTS["center"]).axes[2]
        low, high = panel.get_ylim()
        self.assertLess(high / low, 10.0)
        shown = [label.get_text() for tick, label in zip(panel.get_yticks(), panel.get_yticklabels(), strict=True)
                 if low <= tick <= high]
        self.assertGreaterEqual(len([text for text in shown if text]), 3)

    def test_a_margin_below_one_is_seen(self):
        panel = self.calibration(JOINTS["hinge"]).axes[2]  # margins of 0.02 are told
        self.assertLess(panel.get_ylim()[0], 0.0185)


class Legends(Folder):
    def covered(self, figure):
        """Curves' points under a legend, and legends that leave the figure or lie on a panel."""
        figure.canvas.draw()
        renderer = figure.canvas.get_renderer()
        wrong = []
        for panel in figure.axes:
            legend = panel.get_legend()
            if legend is None:
                continue
            box = legend.get_window_extent(renderer)
            if not (figure.bbox.x0 <= box.x0 and box.x1 <= figure.bbox.x1 and box.y1 <= figure.bbox.y1):
                wrong.append(f"{legend.get_texts()[0].get_text()} leaves the figure")
            for other in figure.axes:
                over = other.get_window_extent(renderer)
                if box.x0 < over.x1 and over.x0 < box.x1 and box.y0 < over.y1 - 0.5 and over.y0 < box.y1:
                    wrong.append(f"{legend.get_texts()[0].get_text()} on a panel")
                for line in other.lines:
                    points = line.get_transform().transform(line.get_xydata())
                    points = np.clip(points[np.isfinite(points).all(axis=1)], over.min, over.max)
                    if ((points > box.min) & (points < box.max)).all(axis=1).any():
                        wrong.append(f"{legend.get_texts()[0].get_text()} covers a curve")
        return wrong

    def test_no_legend_covers_a_curve(self):
        variants = [*(("single", name, True, True) for name in JOINTS), *((which, "chain", True, True) for which in STYLES),
                    ("single", "chain", True, False), ("single", "chain", False, True), ("double", "hinge", False, True)]
        for which, name, truth, known in variants:
            joint = JOINTS[name]
            with self.subTest(joint=name, column=which, truth=truth, known=known):
                figure = self.calibration(joint, which, truth_of(joint, reading_good_to(joint)) if truth else None, known=known)
                self.assertEqual(self.covered(figure), [])
                self.assertEqual(len([panel for panel in figure.axes if panel.get_legend()]), 4 if name == "two-dof" else 3)
                plt.close(figure)

    def test_nor_in_a_figure_of_angles(self):
        path = self.write("angles.csv", "t_s,flexion_deg,pronation_deg,ref_flexion_deg,ref_pronation_deg\n" + "".join(
            f"{k / 50},{60 * np.sin(k / 40)},{k % 90},{60 * np.sin(k / 40) + 1},{k % 90}\n" for k in range(1000)))
        read = angles.read_angles(path, [], (None, []), ALL_TIME, False)
        for which, look in STYLES.items():
            with self.subTest(column=which), look.context():
                figure = angles.draw_angles(read, "A title", look)
                self.assertEqual(len([panel for panel in figure.axes if panel.get_legend()]), 3)
                self.assertEqual(self.covered(figure), [])


def reading_good_to(joint):
    """A goodness with many letters."""
    return angles.GoodTo(1.0, f"5 % (17.3 {joint.unit})")


class EmptyPanels(Folder):
    def notes(self, figure):
        return [" ".join(text.get_text().split()) for panel in figure.axes for text in panel.texts]

    def test_neither_bound_nor_truth(self):
        notes = self.notes(self.calibration(JOINTS["hinge"], known=False, status="collecting"))
        self.assertEqual(notes, ["nothing to draw: no bound was stated (collecting at 20.0 s: reason no_data, weak axis2, hint "
                                 "move_joint)"])

    def test_no_bound_but_errors(self):
        joint = JOINTS["hinge"]
        figure = self.calibration(joint, truth=truth_of(joint), known=False)
        self.assertEqual(self.notes(figure), [])
        legend = figure.axes[0].get_legend()
        self.assertTrue(legend.get_title().get_text().startswith("no bound was stated"))
        self.assertNotIn("stated 95 % bound", [text.get_text() for text in legend.get_texts()])

    def test_nothing_else_was_told(self):
        for joint in JOINTS.values():
            with self.subTest(joint.command):
                notes = self.notes(self.calibration(joint, others=False))
                self.assertEqual(len(notes), 1)
                self.assertTrue(notes[0].startswith(f"no {joint.others[0].label}"))

    def test_rates_that_are_no_numbers(self):
        rows = recording_text(100).splitlines()
        path = self.write("nan.csv", "\n".join([rows[0], *(f"{row.split(',')[0]}{',nan' * 18}" for row in rows[1:])]))
        moved = motion.read_motion(path, JOINTS["hinge"], *ALL_TIME)
        lines = told.Told("lines", JOINTS["hinge"], None, reading.Clock()).read(lines_of(JOINTS["hinge"]))
        figure = calibration.draw_calibration(lines, moved, 3.0, "", STYLES[None])
        self.assertEqual(self.notes(figure), ["no row has finite angular rates"])

    def test_angles_that_were_never_ready(self):
        path = self.write("angles.csv", "t_s,flexion_deg,ref_flexion_deg\n" + "".join(f"{k},,\n" for k in range(100)))
        read = angles.read_angles(path, [], (None, []), ALL_TIME, False)
        figure = angles.draw_angles(read, "", STYLES[None])
        self.assertEqual(self.notes(figure), ["no row has a value of flexion_deg: where jointcal is not ready, it writes none",
                                              "nothing to compare: there are no angles"])

    def test_a_reference_at_other_times(self):
        path = self.write("angles.csv", "t_s,flexion_deg\n" + "".join(f"{k},1\n" for k in range(10)))
        other = self.write("other.csv", "t_s,ref_flexion_deg\n" + "".join(f"{k + 30},1\n" for k in range(10)))
        read = angles.read_angles(path, [], (other, []), ALL_TIME, False)
        figure = angles.draw_angles(read, "", STYLES[None])
        self.assertEqual(self.notes(figure), ["no time in common: angles 0.0 to 9.0 s, reference 30.0 to 39.0 s"])

    def test_a_reference_only_where_there_are_no_angles(self):
        path = self.write("angles.csv", "t_s,flexion_deg,ref_flexion_deg\n" + "".join(
            f"{k},{k if k < 50 else ''},{k if k >= 50 else ''}\n" for k in range(100)))
        read = angles.read_angles(path, [], (None, []), ALL_TIME, True)
        figure = angles.draw_angles(read, "", STYLES[None])
        self.assertEqual(self.notes(figure), ["nothing to compare: nowhere are both an angle and a reference"])


class Calibrations(Folder):
    def test_errors_bounds_and_status_are_those_of_the_lines(self):
        joint = JOINTS["hinge"]
        figure = self.calibration(joint, truth=truth_of(joint, reading_good_to(joint)))
        t_s = np.arange(1, 201) * 0.1
        error, bound = (line for line in figure.axes[0].lines[:2])
        np.testing.assert_allclose(error.get_xdata(), t_s)
        np.testing.assert_allclose(error.get_ydata(), 30.0 * np.exp(-t_s / 4.0), rtol=1e-6)
        np.testing.assert_allclose(bound.get_ydata(), 60.0 * np.exp(-t_s / 4.0), rtol=1e-6)
        spans = [collection.get_paths()[0].get_extents() for collection in figure.axes[1].collections]
        np.testing.assert_allclose([(span.x0, span.x1) for span in spans], [(0.1, 10.0), (10.0, 20.0)])

    def test_the_grey_band_ends_where_the_reference_does(self):
        path, joint = self.recording(), JOINTS["center"]
        facts = {key: [0.1, 0.02 * n, 0.3] for n, key in enumerate(joint.keys)}
        expected = {"vectors_good_to_percent": (5.0, 50.0 * np.linalg.norm([0.1, 0.02, 0.3])), "vectors_good_to_m": (0.004, 4.0)}
        for key, (value, millimetres) in expected.items():
            self.write("recording.json", json.dumps({**facts, key: value}))
            truth = read_truth(None, path, joint, None)
            self.assertAlmostEqual(truth.good_to.value, millimetres)
        figure = self.calibration(joint, truth=truth)
        bands = [patch for patch in figure.axes[0].patches if patch.get_gid() == "reference band"]
        self.assertAlmostEqual(bands[0].get_xy()[:, 1].max(), 4.0)
        self.assertIn("reference good to 4 mm", [text.get_text() for text in figure.axes[0].get_legend().get_texts()])
        self.assertAlmostEqual(read_truth(None, path, joint, "7mm").good_to.value, 7.0)

    def test_a_part_of_a_recording(self):
        joint = JOINTS["hinge"]
        moved = motion.read_motion(self.recording(), joint, 5.0, 15.0)
        self.assertEqual((moved.clock.begin_s, moved.clock.end_s), (5.0, 15.0))
        lines = told.Told("lines", joint, None, reading.Clock(5.0, 12.0)).read(lines_of(joint))
        self.assertAlmostEqual(lines.bounds.trace(0)[0][0], 5.0)
        self.assertAlmostEqual(lines.bounds.trace(0)[0][-1], 12.0)
        self.assertFalse(lines.complete())

    def test_a_clock_that_began_long_ago(self):
        figure, panel = plt.subplots()
        clock = reading.Clock()
        clock.use(1.7e9 + np.array([0.25, 40.0]))
        panels.link_times([panel], clock)
        figure.canvas.draw()
        self.assertEqual([label.get_text() for label in panel.get_xticklabels()], ["10", "20", "30", "40"])
        self.assertEqual(panel.get_xlabel(), "time since 1700000000 s, s")

    def test_the_program_draws_its_demo(self):
        if not PROGRAM.is_file():
            self.skipTest(f"{PROGRAM} is not built")
        for joint, name in (("hinge", "hinge"), ("two-dof", "two_dof"), ("center", "chain"), ("chain", "chain")):
            with self.subTest(joint):
                text = self.drawn(DEMO / f"{name}_demo.csv", "--joint", joint)
                self.assertIn("ready at the end", text)
                self.assertIn("first ready at", text)


class Checks(Folder):
    """tools/plot.py --joint check."""

    @staticmethod
    def told(**how):
        sensor = {"verdict": "ok", "findings": [], "dead": [], "clipped": [], "gravity_m_s2": 9.81, "scale": None, "motion_rad_s": 1.5, **how}
        return {"sensors": [sensor, {**sensor, "clipped": []}], "advice": [], "lag_s": 0.032, "lag_bound_s": 0.004}

    def figure(self, text, **how):
        readings = check.read_readings(self.write("recording.csv", text), *ALL_TIME)
        with STYLES[None].context():
            return readings, check.draw_check(readings, self.told(**how), "A title", STYLES[None])

    def test_curves_are_the_readings(self):
        text = recording_text(500).replace("gyr3_", "other_").replace("acc3_", "else_")
        readings, figure = self.figure(text)
        self.assertEqual((readings.sensors, len(figure.axes)), (2, 4))
        t_s = np.arange(500) / 50.0
        for panel, first in zip(figure.axes, (0, 3, 6, 9), strict=True):
            for k, line in enumerate(panel.get_lines()):
                np.testing.assert_allclose(line.get_ydata(), np.sin((0.7 + 0.1 * (first + k)) * t_s + first + k), atol=1e-3)
        self.assertIn("sensor 2 is 32 ms behind sensor 1, to within 4 ms", figure._suptitle.get_text())

    def test_three_sensors_have_six_panels(self):
        readings = check.read_readings(self.recording(), *ALL_TIME)
        self.assertEqual(readings.sensors, 3)

    def test_stops_and_gaps_are_marked(self):
        lines = recording_text(500).replace("gyr3_", "other_").replace("acc3_", "else_").splitlines()
        readings, figure = self.figure("\n".join(lines[:200] + lines[230:]) + "\n", clipped=["acc_y"], findings=["clipped", "gaps"])
        self.assertEqual([(round(a, 2), round(b, 2)) for a, b in readings.gaps], [(3.96, 4.58)])
        self.assertEqual([sum(line.get_gid() == "stop" for line in panel.get_lines()) for panel in figure.axes], [0, 2, 0, 0])
        self.assertEqual(sum(patch.get_gid() == "gap" for patch in figure.axes[3].patches), 1)
        heads = [panel.legend_head for panel in figure.axes]
        self.assertEqual(heads[0], "sensor 1: ok, clipped, gaps, gravity 9.81 m/s$^2$, 1.5 rad/s rms")

    def test_the_program_draws_a_demo(self):
        if not PROGRAM.is_file():
            self.skipTest(f"{PROGRAM} is not built")
        self.assertIn("specific force", self.drawn(DEMO / "hinge_demo.csv", "--joint", "check"))
        self.refused("--truth: not with --joint check", DEMO / "hinge_demo.csv", "--joint", "check", "--truth", "x.json")
        self.refused("recording.csv:1: missing column acc2_z", self.write("recording.csv", recording_text(50).replace("acc2_z", "acc2_w")), "--joint", "check")


class Angles(Folder):
    rate_hz = 50.0

    def angle(self, t_s):
        return 30.0 + 40.0 * np.sin(t_s)

    def files(self, offset=7.0, gap=(0.0, 0.0)):
        """Angles of 20 s, and a reference of another rate, `offset` less, with a gap."""
        t_s = np.arange(1000) / self.rate_hz
        path = self.write("angles.csv", "t_s,flexion_deg\n" + "".join(f"{t:.4f},{self.angle(t):.6f}\n" for t in t_s))
        times = np.arange(0.0, 25.0, 1.0 / 128.0)
        times = times[(times <= gap[0]) | (times >= gap[1])]
        reference = self.write("reference.csv", "t_s,gyr1_x,ref_flexion_deg\n" + "".join(
            f"{t:.6f},0,{self.angle(t) - offset:.6f}\n" for t in times))
        return path, reference

    def test_the_difference_to_a_reference_of_another_rate(self):
        path, reference = self.files()
        read = angles.read_angles(path, [], (reference, []), ALL_TIME, False)
        # Interpolation of 40 sin(t) at 128 Hz is wrong by at most 40 / 8 / 128^2 deg.
        self.assertAlmostEqual(read.difference.mean(0), 7.0, delta=40.0 / 8.0 / 128.0**2)
        self.assertAlmostEqual(read.difference.rms(0, 0.0), 7.0, delta=40.0 / 8.0 / 128.0**2)
        self.assertLess(read.difference.rms(0, 7.0), 40.0 / 8.0 / 128.0**2)
        read = angles.read_angles(path, [], (reference, []), ALL_TIME, True)
        self.assertAlmostEqual(read.shifts[0], 7.0, delta=1e-3)
        figure = angles.draw_angles(read, "", STYLES["single"])
        drawn = figure.axes[0].lines[0]
        np.testing.assert_allclose(drawn.get_ydata(), self.angle(drawn.get_xdata()) - 7.0, atol=1e-3)
        self.assertEqual([text.get_text() for text in figure.axes[0].get_legend().get_texts()],
                         ["flexion less 7.0 deg", "reference (ref_flexion_deg)"])

    def test_a_reference_that_counts_the_other_way(self):
        path, _ = self.files()
        t_s = np.arange(1000) / self.rate_hz
        turned = self.write("turned.csv", "t_s,ref_flexion_deg\n" + "".join(f"{t:.4f},{7.0 - self.angle(t):.6f}\n" for t in t_s))
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            angles.read_angles(path, [], (turned, []), ALL_TIME, False)
        self.assertIn("count in opposite directions: --negate-reference turns the reference", said.getvalue())
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            read = angles.read_angles(path, [], (turned, []), ALL_TIME, False, True)
            angles.read_angles(path, [], (self.files()[1], []), ALL_TIME, False)
        self.assertNotIn("opposite", said.getvalue())
        self.assertAlmostEqual(read.difference.mean(0), 7.0, delta=1e-3)
        self.assertLess(read.difference.rms(0, 7.0), 1e-3)
        figure = angles.draw_angles(read, "", STYLES["single"])
        self.assertIn("reference (-ref_flexion_deg)", [text.get_text() for text in figure.axes[0].get_legend().get_texts()])

    def test_a_gap_of_the_reference_is_not_bridged(self):
        path, reference = self.files(gap=(8.0, 11.0))
        read = angles.read_angles(path, [], (reference, []), ALL_TIME, False)
        self.assertLess(read.difference.rms(0, 7.0), 1e-3)
        t_s, values = read.difference.curves.trace(0)
        self.assertTrue(np.isnan(values[(t_s > 8.0) & (t_s < 11.0)]).all())

    def test_whole_turns_are_taken_out(self):
        t_s = np.arange(2000) * 0.01
        turning = 100.0 * t_s  # five turns
        wrapped = (turning + 180.0) % 360.0 - 180.0
        path = self.write("angles.csv", "t_s,flexion_deg,ref_flexion_deg\n" + "".join(
            f"{t},{angle},{truth + 720.0}\n" for t, angle, truth in zip(t_s, wrapped, turning, strict=True)))
        read = angles.read_angles(path, [], (None, []), ALL_TIME, False)
        self.assertEqual(read.shifts, [-720.0])
        np.testing.assert_allclose(read.series.curves.trace(0)[1], turning, atol=1e-6)

    def test_a_sto_file_draws_as_a_csv_file(self):
        t_s = np.arange(100) * 0.02
        rows = [f"{t:.2f}\t{self.angle(t):.4f}\t{np.cos(t):.4f}\t5" for t in t_s]
        head = "jointcal angles\nversion=1\nnRows=100\nnColumns=4\ninDegrees={}\nendheader\ntime\tknee_angle_r\tpronation\t" \
               "heading_offset\n"
        path = self.write("angles.sto", head.format("yes") + "\n".join(rows) + "\n")
        read = angles.read_angles(path, [], (None, []), ALL_TIME, False)
        self.assertEqual(read.names, ["knee_angle_r", "pronation"])
        np.testing.assert_allclose(read.series.curves.trace(0)[1], self.angle(t_s), atol=1e-4)
        path.write_text(head.format("no") + "\n".join(rows) + "\n")
        read = angles.read_angles(path, ["pronation"], (None, []), ALL_TIME, False)
        np.testing.assert_allclose(read.series.curves.trace(0)[1], np.degrees(np.cos(t_s)), atol=0.01)

    def test_a_band_from_the_file_beside_the_reference(self):
        path, reference = self.files()
        self.write("reference.json", '{"angles_good_to_deg": 1.5}')
        text = self.drawn(path, "--joint", "angles", "--reference", reference)
        self.assertIn("reference good to ±1.5 deg", text)
        self.assertIn("rms 7.0 deg (0.0 about the mean of 7.0)", text)
        text = self.drawn(path, "--joint", "angles", "--reference", reference, "--reference-good-to", "2")
        self.assertIn("reference good to ±2 deg", text)

    def test_which_reference_belongs_to_which_angle(self):
        names = ["t_s", "flexion_deg", "pronation_deg", "ref_pronation_deg", "ref_flexion_deg", "ref_q1_w", "encoder"]
        table = reading.Table(self.write("all.csv", ",".join(names) + "\n" + ",".join("1" * len(names)) + "\n"))
        both = angles.angle_columns(table, [])
        self.assertEqual(both, ["flexion_deg", "pronation_deg"])
        self.assertEqual(angles.reference_columns(table, both, []), {0: "ref_flexion_deg", 1: "ref_pronation_deg"})
        self.assertEqual(angles.reference_columns(table, both, ["encoder"]), {0: "encoder"})
        table.names.remove("ref_flexion_deg")
        self.assertEqual(angles.reference_columns(table, ["flexion_deg"], []), {0: "ref_pronation_deg"})


class Paper(Folder):
    def arguments(self, **how):
        recording = self.recording()
        lines = self.write("lines.jsonl", "\n".join(lines_of(JOINTS["hinge"], **how)))
        return [recording, "--jsonl", lines]

    def test_size_and_title_of_a_column(self):
        text = self.drawn(*self.arguments(), "--column", "single", "--title", "Of a knee")
        width, height = (float(re.search(rf'<svg[^>]* {side}="([0-9.]+)pt"', text)[1]) for side in ("width", "height"))
        self.assertAlmostEqual(width, 88.0 / 25.4 * 72.0, delta=0.1)
        self.assertAlmostEqual(height, calibration.HEIGHT_MM["single"] / 25.4 * 72.0, delta=0.1)
        self.assertIn("Of a knee", text)
        self.assertNotIn("at the end", text)

    def test_size_font_and_type_in_a_pdf(self):
        content = self.drawn(*self.arguments(), "--size", "3.5x5in", "--font", "DejaVu Serif", "--title", "", kind="pdf")
        self.assertIn(b"/MediaBox [ 0 0 252 360 ]", content)
        self.assertIn(b"DejaVuSerif", content)
        self.assertNotIn(b"/Type3", content)
        self.assertEqual(self.drawn(*self.arguments(), "--size", "3.5x5in", "--font", "DejaVu Serif", "--title", "", kind="pdf"),
                         content)

    def test_sizes(self):
        for text, expected in (("88x120mm", (88.0, 120.0)), ("8.8 x 12 cm", (88.0, 120.0)), ("3.5x5in", (88.9, 127.0))):
            np.testing.assert_allclose(style.parse_size(text), expected)

    def test_what_is_refused(self):
        recording, *lines = self.arguments()
        self.refused("--size: '8x12' is not WIDTHxHEIGHT with mm, cm or in, such as 8.8x12cm", recording, *lines, "--size", "8x12")
        self.refused("--size: the panels do not fit at 8 points: a larger figure or a smaller --font-size", recording, *lines,
                     "--size", "21x21mm")
        self.refused("out.jpg: the name must end in .png, .pdf or .svg", recording, *lines, out="out.jpg")
        self.refused("none: there is no such folder", recording, *lines, out="none/out.png")
        self.refused("--font-size: 100 is not between 3 and 40 points", recording, *lines, "--font-size", "100")
        self.refused("--reference: only with --joint angles", recording, *lines, "--reference", recording)
        status, said = self.run_command(recording, "-o", self.folder / "x.png", "--font", "DejaVu Seriph")
        self.assertEqual(status, 2)
        self.assertIn("--font: 'DejaVu Seriph' is not installed; there are for example DejaVu Serif", said)


class Refusals(Folder):
    def check(self, message, text, *arguments, name="bad.csv"):
        path = self.write(name, text)
        self.refused(message, path, *arguments)

    def test_recordings(self):
        good = recording_text(50)
        rows = good.splitlines()
        self.check("bad.csv: the file is empty", "")
        self.check("bad.csv:1: there is no row below the columns' names", rows[0])
        self.check("bad.csv:1: missing column gyr1_y", good.replace("gyr1_y", "gyr1_v"))
        self.check("bad.csv:1: missing columns t_s, gyr1_x, gyr1_y, gyr1_z, gyr2_x, gyr2_y, gyr2_z "
                   "(cells must be separated by commas)", good.replace(",", ";"))
        self.check("bad.csv:4: short line: 3 of 19 cells", "\n".join([*rows[:3], "1,2,3", *rows[3:]]))
        self.check("bad.csv:4: long line: 20 cells where the header has 19", "\n".join([*rows[:3], rows[3] + ",1"]))
        self.check("bad.csv:5: a second header line", "\n".join([*rows[:4], rows[0]]))
        self.check("bad.csv:3:7: gyr1_x: 'fast' is not a number",
                   "\n".join([*rows[:2], re.sub(",[^,]*", ",fast", rows[2], count=1)]))
        self.check("bad.csv:1: 'sep=,' stands where the columns' names belong; take this line out", "sep=,\n" + good)
        self.check("bad.csv: a zero byte: this is not a text file", "\0\0")
        self.check("bad.csv: no row has a time", "\n".join([rows[0], *(re.sub("^[^,]*", "nan", row) for row in rows[1:])]))
        self.check("bad.csv: no row in the part asked for, from 100 s", good, "--from", "100")
        self.refused("absent.csv: No such file or directory", self.folder / "absent.csv")
        packed = self.folder / "packed.csv"
        packed.write_bytes(b"\x1f\x8b\x08")
        self.refused("packed.csv: compressed by gzip; unpack it first", packed)

    def test_empty_cells_are_no_error(self):
        rows = recording_text(50).splitlines()
        path = self.write("gaps.csv", "\n".join([*rows[:10], "0.18" + "," * 18, "", *rows[11:]]))
        self.assertEqual(motion.read_motion(path, JOINTS["hinge"], *ALL_TIME).rows, 50)

    def test_lines_may_end_as_windows_ends_them(self):
        path = self.folder / "windows.csv"
        path.write_bytes(recording_text(50).replace("\n", "\r\n").encode())
        self.assertEqual(motion.read_motion(path, JOINTS["chain"], *ALL_TIME).rates.trace(2)[0].tolist(),
                         motion.read_motion(self.recording(50), JOINTS["chain"], *ALL_TIME).rates.trace(2)[0].tolist())

    def test_rows_out_of_order_are_said(self):
        rows = recording_text(50).splitlines()
        path = self.write("order.csv", "\n".join([rows[0], *rows[21:31], *rows[11:21], *rows[31:]]))
        lines = self.write("lines.jsonl", "\n".join(lines_of(JOINTS["hinge"], seconds=1.0)))
        status, said = self.run_command(path, "--jsonl", lines, "-o", self.folder / "out.png")
        self.assertEqual((status, said), (0, f"{path}: 10 of 40 rows are not drawn: their time does not increase\n"))

    def test_lines(self):
        recording, good = self.recording(), list(lines_of(JOINTS["hinge"], seconds=1.0))
        for message, text in (("lines.jsonl:2:1: not JSON: Expecting value", f"{good[0]}\nthis\n"),
                              ("lines.jsonl:1: no axis1: this is no line of jointcal hinge --json", '{"t_s": 1}'),
                              ("lines.jsonl:1: this is no line of jointcal hinge --json", "[1, 2]"),
                              ("lines.jsonl: no line of JSON has a time", "")):
            self.refused(message, recording, "--jsonl", self.write("lines.jsonl", text))
        end = {"t_s": None, "samples": 9, "rejected_by": {"not_finite": 2, "out_of_range": 7, "gap": 0}}
        self.refused("lines.jsonl: jointcal used none of the 9 rows: 2 not finite, 7 out of range", recording, "--jsonl",
                     self.write("lines.jsonl", json.dumps(end)))
        self.refused("none.jsonl: No such file or directory", recording, "--jsonl", self.folder / "none.jsonl")

    def test_truth(self):
        recording = self.recording()
        for message, text in (("truth.json:1:1: not JSON: Expecting value", "axis"), ("truth.json:1: not a JSON object", "[]"),
                              ("truth.json: no axis2: nothing to compare with", '{"axis1": [1, 0, 0]}'),
                              ("truth.json: axis1: three numbers are needed", '{"axis1": [1, 0], "axis2": [1, 0, 0]}'),
                              ("truth.json: axes_good_to_deg: a number above 0 is needed",
                               '{"axis1": [1, 0, 0], "axis2": [1, 0, 0], "axes_good_to_deg": "one"}')):
            self.refused(message, recording, "--truth", self.write("truth.json", text))
        self.refused("recording.json: no axis1 and no axis2: nothing to compare with", recording, "--reference-good-to", "1")
        self.write("recording.json", '{"axis1": [1, 0, 0], "axis2": [1, 0, 0]}')
        self.refused("--reference-good-to: '5%': this figure is in deg", recording, "--reference-good-to", "5%")
        self.refused("--reference-good-to: 'much' is not a number above 0, such as 1deg, 7mm or 5%", recording,
                     "--reference-good-to", "much")

    def test_angles(self):
        recording = self.recording()
        self.refused(f"recording.csv:1: a recording, not angles; write them with: jointcal angles recording.csv --joint hinge "
                     "--out angles.csv", recording, "--joint", "angles")
        path = self.write("angles.csv", "t_s,flexion_deg\n1,2\n2,3\n")
        self.refused("angles.csv: no column such as ref_flexion_deg: nothing to compare with; see --reference", path, "--joint",
                     "angles", "--zero-to-reference")
        self.refused("recording.csv:1: no column such as ref_flexion_deg; name it with --reference-column", path, "--joint",
                     "angles", "--reference", recording)
        self.refused("angles.csv:1: missing column elbow", path, "--joint", "angles", "--angles", "elbow")
        self.refused("many.csv:1: 5 columns of angles, a_deg, b_deg, c_deg, ...: choose at most 4 with --angles",
                     self.write("many.csv", "t_s,a_deg,b_deg,c_deg,d_deg,e_deg\n1,1,1,1,1,1\n"), "--joint", "angles")
        self.refused("angles.sto: no line endheader: this is not a .sto file", self.write("angles.sto", "a\n"), "--joint", "angles")

    def test_a_program_that_is_not_built(self):
        self.refused("none: not there; build it with: cmake --preset host && cmake --build --preset host", self.recording(),
                     "--program", self.folder / "none")

    def test_a_program_that_fails_has_said_why(self):
        fails = self.write("fails", "#!/bin/sh\nexit 2\n")
        fails.chmod(0o755)
        self.assertEqual(self.run_command(self.recording(), "--program", fails, "-o", self.folder / "out.png"), (2, ""))


class Terminal(Folder):
    def command_line(self):
        lines = self.write("lines.jsonl", "\n".join(lines_of(JOINTS["hinge"])))
        return [sys.executable, ROOT / "tools" / "plot.py", self.recording(), "--jsonl", lines, "-o", self.folder / "out.png"]

    def test_a_bar_on_a_terminal_only(self):
        done = subprocess.run(self.command_line(), capture_output=True, check=True)
        self.assertEqual((done.stdout, done.stderr), (b"", b""))
        ours, theirs = pty.openpty()
        with subprocess.Popen(self.command_line(), stderr=theirs) as process:
            os.close(theirs)
            said = b""
            with contextlib.suppress(OSError):  # so ends a terminal that nobody writes to any more
                while part := os.read(ours, 10000):
                    said += part
        os.close(ours)
        self.assertEqual(process.returncode, 0)
        self.assertIn(b"100 %", said)
        self.assertTrue(said.endswith(b" \r"))

    def test_help_has_examples(self):
        self.assertTrue(os.access(ROOT / "tools" / "plot.py", os.X_OK))
        done = subprocess.run([sys.executable, ROOT / "tools" / "plot.py", "--help"], capture_output=True, text=True, check=True)
        self.assertIn("examples:", done.stdout)
        self.assertIn("--joint angles", done.stdout)


if __name__ == "__main__":
    unittest.main()
