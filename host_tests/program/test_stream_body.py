#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of `jointcal stream` with a whole body, with a hub on this machine and with one that only pretends: test_stream_body.py PROGRAM HUB."""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools" / "python"))

from fake_hub import FakeHub, OldHub, joint_state, sensor_state  # noqa: E402
from jointcal_tools import hub  # noqa: E402

PROGRAM, HUB = (str(pathlib.Path(path).resolve()) for path in sys.argv[1:3])
LEG = str(ROOT / "tools" / "demo" / "leg_demo.csv")
JOINTS = ("--joint", "hip:ball:pelvis:thigh", "--joint", "knee:hinge:2:3", "--names", "pelvis,thigh,shank")
ORIGIN_US = 1 << 40
COLUMNS = "t_s,gyr_x,gyr_y,gyr_z,acc_x,acc_y,acc_z"


def rows_of_the_leg():
    with open(LEG) as file:
        return list(csv.reader(file))[1:]


class Body(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def hub(self):
        path = self.folder / "hub"
        process = subprocess.Popen([HUB, f"unix:{path}"], stdout=subprocess.PIPE, text=True)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.assertEqual(process.stdout.readline(), "listening\n")
        return f"unix:{path}"

    def fake(self, kind=FakeHub, **settings):
        path = self.folder / f"fake{len(list(self.folder.iterdir()))}"
        fake = kind(path, **settings)
        self.addCleanup(fake.close)
        return fake, f"unix:{path}"

    def run_program(self, *arguments):
        got = subprocess.run([PROGRAM, "stream", *arguments], capture_output=True, text=True, timeout=60, cwd=self.folder)
        self.assertNotIn("nan", got.stdout.lower())
        return got

    def play(self, target, *options, files=(LEG,), joints=JOINTS):
        got = self.run_program(*files, "--to", target, "--speed", "max", *joints, *options)
        return got, [json.loads(line) for line in got.stdout.splitlines()]

    def files_of_the_leg(self, seconds, shift_s=0.0):
        """The leg's sensors in a file each; times of the second one are shifted."""
        rows = rows_of_the_leg()
        names = []
        for k, name in enumerate(("pelvis", "thigh", "shank")):
            lines = [",".join([str(float(row[0]) + (shift_s if k == 1 else 0.0)), *row[1 + 6 * k:7 + 6 * k]]) for row in rows if float(row[0]) < seconds]
            (self.folder / f"{name}.csv").write_text("\n".join([COLUMNS, *lines]) + "\n")
            names.append(f"{name}.csv")
        return names

    def write(self, name, rows):
        (self.folder / name).write_text("\n".join([COLUMNS, *(",".join(map(str, row)) for row in rows)]) + "\n")

    def raw_readings(self, fake, sensor):
        """By counter, from the first one on."""
        packets = [packet for packet in fake.packets if packet["sensor"] == sensor]
        first = packets[0]["counter"]
        return {(packet["counter"] + k - first) % 65536: row for packet in packets for k, row in enumerate(packet["readings"])}


class WithAHub(Body):
    def test_leg_becomes_ready_and_bends_as_it_did(self):
        got, lines = self.play(self.hub(), "--every", "30", "--angles-every", "0.5")
        self.assertEqual((got.returncode, got.stderr), (0, ""))
        ready = {line["joint"]: line["t_s"] for line in lines if line["event"] == "ready"}
        self.assertEqual(set(ready), {"hip", "knee"})
        end = lines[-1]
        self.assertEqual((end["event"], end["ready"], [joint["status"] for joint in end["joints"]]), ("end", True, ["ready", "ready"]))
        truth = json.loads((ROOT / "tools" / "demo" / "leg_demo.json").read_text())
        knee = end["joints"][1]
        for name, bound, true in (("axis1", "uncertainty1_rad", "knee_axis_thigh"), ("axis2", "uncertainty2_rad", "knee_axis_shank")):
            cosine = abs(sum(a * b for a, b in zip(knee[name], truth[true], strict=True)))
            self.assertLess(math.acos(min(1.0, cosine)), knee[bound])
        angles = [line for line in lines if line["event"] == "angles"]
        # A joint is ready from a round on; the event comes with the next look, at most 0.1 s later.
        early = [line for line in angles if line["t_s"] < min(ready.values()) - 0.1]
        self.assertTrue(early)
        self.assertTrue(all(value is None for line in early for value in line["angles"].values()))
        late = [line["angles"] for line in angles if line["t_s"] > max(ready.values()) + 5.0]
        self.assertTrue(all(abs(sum(part * part for part in line["hip"]) - 1.0) < 1e-5 for line in late))
        self.assertGreater(max(line["knee"] for line in late) - min(line["knee"] for line in late), math.radians(30))
        self.assertEqual([line["sensor"] for line in lines if line["event"] == "sensor"], ["pelvis", "thigh", "shank"] * 2)  # at 30 and at 60 s
        self.assertTrue(any(line["event"] == "advice" and line["text"] for line in lines))

    def test_same_seed_same_bytes_and_another_seed_others(self):
        target, files = self.hub(), self.files_of_the_leg(20.0)
        options = ("--loss", "5", "--burst", "0.5", "--clock-ppm", "40,-60,100", "--jitter-ms", "8", "--every", "5")
        joints = ("--joint", "knee:hinge:thigh:shank", "--joint", "hip:ball:pelvis:thigh")
        first, again, other = (self.play(target, *options, "--seed", seed, files=files, joints=joints)[0].stdout for seed in ("3", "3", "4"))
        self.assertEqual(first, again)
        self.assertNotEqual(first, other)

    def test_losses_are_counted_and_not_ready_is_three(self):
        got, lines = self.play(self.hub(), "--loss", "20,0,0", "--burst", "0,0,2", files=self.files_of_the_leg(45.0), joints=JOINTS[:4])
        self.assertEqual(got.returncode, 3)
        played = {line["sensor"]: line for line in lines if line["event"] == "played"}
        self.assertGreater(played["pelvis"]["packets_lost"], 30)
        self.assertEqual(played["thigh"]["packets_lost"], 0)
        sensors = {sensor["sensor"]: sensor for sensor in lines[-1]["sensors"]}
        self.assertEqual(sensors["thigh"]["lost"], 0)
        # The hub cannot know of packets lost after the last one that came, nor before the first.
        told, made = sensors["pelvis"]["lost"], 4 * played["pelvis"]["packets_lost"]
        self.assertLessEqual(made - told, 16)
        self.assertLessEqual(told, made)
        names = [(line["event"], line.get("sensor")) for line in lines]
        self.assertLess(names.index(("sensor_lost", "shank")), len(names) - 1 - names[::-1].index(("sensor_back", "shank")))
        self.assertEqual(lines[-1]["packets"], sum(line["packets"] - line["packets_lost"] for line in played.values()))

    def test_delays_are_found_as_lags(self):
        _, lines = self.play(self.hub(), "--delay-ms", "3,30,60")
        lags = {line["joint"]: line["lag_s"] for line in lines if line["event"] == "lag_found"}
        self.assertAlmostEqual(lags["hip"], 0.027, delta=0.006)
        self.assertAlmostEqual(lags["knee"], 0.030, delta=0.006)

    def test_table_that_the_hub_refuses(self):
        got, _ = self.play(self.hub(), joints=("--joint", "hip:ball:1:2", "--joint", "knee:hinge:3:2"))
        self.assertEqual(got.returncode, 2)
        self.assertIn("the hub refuses the table: distal_twice of knee", got.stderr)


class WithAFake(Body):
    def test_every_event_and_nothing_known(self):
        event = {"t_us": ORIGIN_US + 1_000_000, "joint": 1, "sensor": 255, "value": 0.5}
        of_sensor = {**event, "joint": 255, "sensor": 2}
        told = [{**event, "kind": 0, "what": 0}, {**event, "kind": 1, "what": 3}, {**event, "kind": 2, "what": 0}, {**event, "kind": 3, "what": 0},
                {**event, "kind": 4, "what": 0}, {**of_sensor, "kind": 5, "what": 3}, {**of_sensor, "kind": 6, "what": 0},
                {**of_sensor, "kind": 7, "what": 0}, {**of_sensor, "kind": 8, "what": 0}, {**event, "kind": 9, "what": 0},
                {**event, "kind": 10, "what": 0}, {**event, "kind": 11, "what": 4}, {**event, "joint": 255, "kind": 12, "what": 0},
                {**event, "joint": 200, "kind": 250, "what": 0}]
        nan = float("nan")
        after = {3: [(hub.EVENT, fields) for fields in told],
                 5: [(hub.BODY_STATE, {"token": 0, "t_us": 0, "rounds": 0, "restarts": 0, "lags_refused": 0, "events_dropped": 0, "units": 0, "writes": 0}),
                     (hub.JOINT_STATE, joint_state(0, 0)), (hub.SENSOR_STATE, sensor_state(1, 0, bad=0x8)),
                     (hub.ADVICE, {"joint": 1, "sensor": 255, "hint": 1, "reason": 2, "text": 'Bend "it".'})],
                 7: [(hub.FLEXIONS, {"t_us": ORIGIN_US + 5, "flexions": [(1, nan, 0.25)]}),
                     (hub.ORIENTATIONS, {"t_us": ORIGIN_US + 5, "orientations": [(0, 1.0, 0.0, 0.0, 0.0, 0.25)]}),
                     (hub.FLEXIONS, {"t_us": ORIGIN_US + 6, "flexions": [(1, 0.5, 0.25), (99, 1.0, 1.0)]})]}
        _, target = self.fake(after=after)
        got, lines = self.play(target)
        self.assertEqual(got.returncode, 0)
        self.assertEqual([line["event"] for line in lines[3:17]],
                         ["ready", "left_ready", "moved", "not_one_joint", "lag_found", "sensor_bad", "sensor_fine", "sensor_lost", "sensor_back",
                          "remembered", "confirmed", "dropped", "kept", "unknown"])
        self.assertEqual(lines[4], {"event": "left_ready", "t_s": 1, "joint": "knee", "reason": "uncertain"})
        self.assertEqual(lines[7], {"event": "lag_found", "t_s": 1, "joint": "knee", "lag_s": 0.5})
        self.assertEqual(lines[8], {"event": "sensor_bad", "t_s": 1, "sensor": "shank", "finding": "held", "fact": 0.5})
        self.assertEqual(lines[14], {"event": "dropped", "t_s": 1, "joint": "knee", "reason": "places"})
        self.assertEqual(lines[15], {"event": "kept", "t_s": 1})
        body, joint, sensor, advice, angles, more = lines[17:23]
        self.assertEqual((body["event"], body["t_s"]), ("body", None))
        self.assertEqual({joint[key] for key in ("kept", "lag_s", "axis1", "axis2", "uncertainty1_rad", "heading_rad", "flexion_bound_rad")}, {None})
        self.assertEqual((sensor["sensor"], sensor["bad"]), ("thigh", ["held"]))
        self.assertEqual(advice["text"], 'Bend "it".')
        self.assertEqual(angles["angles"], {"hip": [1, 0, 0, 0], "knee": None})
        self.assertEqual(angles["bounds_rad"], {"hip": 0.25, "knee": None})
        self.assertEqual((more["angles"], more["t_s"]), ({"hip": None, "knee": 0.5}, 0.000006))

    def test_what_is_sent(self):
        fake, target = self.fake()
        self.play(target, "--serials", "18446744073709551615,7,8", "--keep", "--every", "2", "--angles-every", "0.25", "--max-bound", "4",
                  "--gyr-range", "1000", "--acc-range", "8", "--per-packet", "3")
        self.assertEqual({key: fake.begin[key] for key in ("every_us", "angles_every_us", "sensors", "joints", "flags")},
                         {"every_us": 2_000_000, "angles_every_us": 250_000, "sensors": 3, "joints": 2, "flags": 7})
        sensor = fake.sensors[0]
        self.assertEqual((sensor["serial"], sensor["period_ns"], sensor["per_packet"], sensor["name"]), (2**64 - 1, 40_000_000, 3, "pelvis"))
        self.assertAlmostEqual(sensor["gyr_rad_s"] * 32768, math.radians(1000), places=5)
        self.assertAlmostEqual(sensor["acc_m_s2"] * 32768, 8 * 9.80665, places=4)
        self.assertEqual([(joint["kind"], joint["proximal"], joint["distal"]) for joint in fake.joints.values()], [(1, 0, 1), (0, 1, 2)])
        self.assertAlmostEqual(fake.joints[1]["max_bound_rad"], math.radians(4), places=6)
        arrivals = [packet["arrival_us"] for packet in fake.packets]
        self.assertEqual(arrivals, sorted(arrivals))
        rows = rows_of_the_leg()
        for number in range(3):
            found = self.raw_readings(fake, number)
            self.assertEqual(sorted(found), list(range(len(rows))))
            for k in (0, 1, 1000, len(rows) - 1):
                expected = [float(value) for value in rows[k][1 + 6 * number:7 + 6 * number]]
                for value, raw, step in zip(expected, found[k], 3 * [sensor["gyr_rad_s"]] + 3 * [sensor["acc_m_s2"]], strict=True):
                    self.assertLessEqual(abs(raw * step - value), 0.5001 * step)
        # From the last reading on a packet is under way for 5 to 7 ms.
        self.assertTrue(all(5_000 <= packet["arrival_us"] - ORIGIN_US - 80_000 <= 7_000 for packet in fake.packets[:3]))

    def test_clipped_missing_and_repeated_rows(self):
        rows = [[k * 0.01, 0, 0, 0, 0, 0, 9.81] for k in range(100)]
        rows[10][1] = 40.0  # beyond 2000 deg/s
        rows[20][2] = ""
        rows[31] = [rows[30][0], *rows[31][1:]]  # its time again: one reading is missing
        del rows[50:56]
        for name in ("a", "b"):
            self.write(f"{name}.csv", rows if name == "a" else [[k * 0.01, 0, 0, 0, 0, 0, 9.81] for k in range(100)])
        fake, target = self.fake()
        got, lines = self.play(target, files=("a.csv", "b.csv"), joints=("--joint", "knee:hinge:a:b"))
        self.assertEqual(got.returncode, 0)
        first, second = lines[:2]
        self.assertEqual((first["sensor"], first["clipped"], first["missing"], first["readings"]), ("a", 1, 8, 92))
        self.assertEqual((second["clipped"], second["missing"], second["readings"]), (0, 0, 100))
        found = self.raw_readings(fake, 0)
        self.assertEqual(set(range(100)) - set(found), {20, 31, *range(50, 56)})
        self.assertEqual(found[10][0], 32767)

    def test_files_that_begin_at_other_times(self):
        _, target = self.fake()
        _, lines = self.play(target, files=self.files_of_the_leg(10.0, shift_s=5000.0), joints=JOINTS[:4])
        self.assertEqual([line["times_less_s"] for line in lines[:3]], [0, 5000, 0])

    def test_a_hub_of_another_protocol_is_named(self):
        for options in (JOINTS, ()):
            _, target = self.fake(kind=OldHub, version=2)
            got = self.run_program(LEG, "--to", target, "--speed", "max", *options)
            self.assertEqual((got.returncode, got.stderr), (1, f"{target}: the hub speaks protocol 2, this program 3\n"))

    def test_not_ready_is_three(self):
        _, target = self.fake(status=0)
        got, lines = self.play(target)
        self.assertEqual((got.returncode, lines[-1]["ready"]), (3, False))

    def test_refusal_of_a_sensor_is_named(self):
        _, target = self.fake(refuse=(2, "period_ns"))
        got, _ = self.play(target)
        self.assertEqual(got.returncode, 2)
        self.assertIn("the hub refuses the table: period_ns of shank", got.stderr)

    def test_kept_records_up_and_down(self):
        (self.folder / "up").write_bytes(bytes(range(128)) + bytes(128))
        fake, target = self.fake()
        got, _ = self.play(target, "--put-kept", "up", "--get-kept", "down")
        self.assertEqual((got.returncode, got.stderr), (0, ""))
        self.assertEqual([fields["record"] for kind, fields in fake.other if kind == hub.PUT_KEPT], [bytes(range(128)), bytes(128)])
        self.assertEqual([fields["joint"] for kind, fields in fake.other if kind == hub.GET_KEPT], [0, 1])
        self.assertEqual((self.folder / "down").read_bytes(), bytes(range(128)))
        (self.folder / "odd").write_bytes(bytes(100))
        for name, part in (("odd", "128 bytes"), ("absent", "No such file")):
            got, _ = self.play(self.fake()[1], "--put-kept", name)
            self.assertEqual(got.returncode, 2)
            self.assertIn(part, got.stderr)


class CommandLine(Body):
    def refused(self, part, *arguments):
        got = self.run_program(*arguments, "--to", "unix:absent")
        self.assertEqual(got.returncode, 2, arguments)
        self.assertIn(part, got.stderr)

    def test_wrong_options(self):
        joint = ("--joint", "knee:hinge:1:2")
        for part, options in (("which joints has it", (LEG,)), ("--loss is for a whole body", ("--loss", "5")),
                              ("not NAME:KIND:PROXIMAL:DISTAL", ("--joint", "knee:hinge:1")), ("1 to 16 letters", ("--joint", "a-very-very-very-long-name:hinge:1:2")),
                              ("between two sensors", ("--joint", "knee:hinge:2:2")), ("hinge, ball", ("--joint", "knee:saddle:1:2")),
                              ("two joints 'knee'", joint + joint), ("there is no sensor '4'", ("--joint", "knee:hinge:1:4")),
                              ("--names: 2 values for 3 sensors", (*joint, "--names", "a,b")), ("stands there twice", (*joint, "--names", "a,a,b")),
                              ("is no name", (*joint, "--names", 'a,b,"c')), ("--loss: 120 is not from 0 to 100", (*joint, "--loss", "120")),
                              ("--clock-ppm: 2 values for 3 sensors", (*joint, "--clock-ppm", "1,2")), ("--per-packet", (*joint, "--per-packet", "17")),
                              ("whole numbers", (*joint, "--serials", "1,x")), ("--sign-hint is for one hinge", (*joint, "--sign-hint", "same")),
                              ("--seed", (*joint, "--seed", "-1")), ("no list of numbers", (*joint, "--delay-ms", "x"))):
            self.refused(part, LEG, *options)

    def test_wrong_files(self):
        self.write("a.csv", [[0, 0, 0, 0, 0, 0, 9.81]])
        self.write("b.csv", [[0.01 * k, 0, 0, 0, "x" if k == 5 else 0, 0, 9.81] for k in range(9)])
        joint = ("--joint", "knee:hinge:1:2")
        self.refused("a.csv: a sensor needs at least two rows", "a.csv", "a.csv", *joint)
        self.refused("b.csv:7:", "b.csv", "a.csv", *joint)
        self.refused("absent.csv: No such file", "absent.csv", "a.csv", *joint)
        self.refused("a.csv:1", "a.csv", *joint)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
