# SPDX-License-Identifier: MIT
"""Recordings for the tests of the program, made with nothing but the standard library."""
import math
import random

COLUMNS = ["t_s"] + [f"{kind}{sensor}_{axis}" for sensor in (1, 2) for kind in ("gyr", "acc") for axis in "xyz"]


def hinge_rows(seconds, rate_hz=50.0, seed=1):
    """Rows (lists of 13 numbers) of two sensors on a hinge about z of both; the base turns too, everything is noisy."""
    noise = random.Random(seed)
    rows = []
    for k in range(int(seconds * rate_hz)):
        t = k / rate_hz
        bend, bend_rate = 0.8 * math.sin(2.5 * t), 2.0 * math.cos(2.5 * t)
        base = [0.9 * math.sin(1.3 * t), 0.7 * math.cos(0.7 * t), 0.5 * math.sin(0.9 * t + 1)]
        gravity = [3 * math.sin(0.6 * t), 8 + math.cos(1.3 * t), 4 * math.cos(0.4 * t)]
        turned_rate, turned_gravity = turn_back(base, bend), turn_back(gravity, bend)
        turned_rate[2] += bend_rate
        values = base + gravity + turned_rate + turned_gravity
        rows.append([t] + [value + noise.gauss(0, 0.01) for value in values])
    return rows


def turn_back(vector, angle):
    """The vector in a frame that is turned by `angle` about z."""
    x, y, z = vector
    c, s = math.cos(angle), math.sin(angle)
    return [c * x + s * y, c * y - s * x, z]


def texts(rows, shift_us=0):
    """The cells as text; times with six decimals, shifted by whole microseconds."""
    return [[time_text(round(row[0] * 1e6) + shift_us)] + [f"{value:.7g}" for value in row[1:]] for row in rows]


def time_text(us):
    sign = "-" if us < 0 else ""
    return f"{sign}{abs(us) // 10**6}.{abs(us) % 10**6:06d}"


def csv(cells, columns=None, end="\n"):
    """A file of a header and rows of text."""
    lines = [",".join(columns or COLUMNS)] + [",".join(row) for row in cells]
    return end.join(lines) + end


ORIENTATION_COLUMNS = [f"q{sensor}_{part}" for sensor in (1, 2) for part in "wxyz"]


def multiply(p, q):
    """Hamilton product of quaternions (w, x, y, z)."""
    (a, b, c, d), (e, f, g, h) = p, q
    return [a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g, a * g - b * h + c * e + d * f,
            a * h + b * g - c * f + d * e]


def turn(angle, axis):
    """Rotation by `angle` about coordinate axis 0, 1 or 2."""
    q = [math.cos(angle / 2), 0.0, 0.0, 0.0]
    q[1 + axis] = math.sin(angle / 2)
    return q


def joint_orientations(t, flexion, heading, carrying=0.0, pronation=0.0):
    """Eight numbers: sensors whose frames are those of the segments, the second one in an earth frame of its own."""
    tilt = turn(math.pi / 2 + 0.6 * math.cos(0.5 * t), 0)
    q1 = multiply(multiply(turn(0.8 * math.sin(0.7 * t), 2), turn(0.5 * math.sin(0.9 * t), 1)), tilt)
    joint = multiply(multiply(turn(flexion, 2), turn(carrying, 0)), turn(pronation, 1))
    return q1 + multiply(turn(-heading, 2), multiply(q1, joint))


def bend(t):
    """Flexion in hinge_rows()."""
    return 0.8 * math.sin(2.5 * t)


def hinge_with_orientations(seconds, heading=0.7):
    """hinge_rows() and the orientations that belong to its joint."""
    return [row + joint_orientations(row[0], bend(row[0]), heading) for row in hinge_rows(seconds)]


def elbow(t):
    """Flexion and pronation of two_dof_rows()."""
    return 0.9 + 0.8 * math.sin(1.9 * t), 1.0 * math.sin(1.3 * t + 1.0)


def two_dof_rows(seconds, heading=-1.2, carrying=0.15, rate_hz=50.0):
    """Two axes, z of sensor 1 and y of sensor 2; what gyroscopes and accelerometers say is of no account here."""
    noise = random.Random(2)
    rows = []
    for k in range(int(seconds * rate_hz)):
        t = k / rate_hz
        flexion, pronation = elbow(t)
        imus = [noise.gauss(0, 1) for _ in range(12)]
        rows.append([t] + imus + joint_orientations(t, flexion, heading, carrying, pronation))
    return rows


def conjugate(q):
    return [q[0], -q[1], -q[2], -q[3]]


def rotate(q, v):
    return multiply(multiply(q, [0.0] + list(v)), conjugate(q))[1:]


R1, R2 = (-0.12, 0.03, 0.05), (0.04, 0.16, -0.02)  # joint to sensor of center_rows(), m
CENTER_HEADING = -0.8


def ball_orientations(t, free=3):
    """Both sensors to one earth frame; `free` of the joint's three turns move."""
    q1 = multiply(multiply(turn(0.9 * math.sin(2.9 * t), 2), turn(0.9 * math.sin(3.7 * t + 1), 0)), turn(0.9 * math.sin(3.3 * t), 1))
    q2 = q1
    for axis, (size, pace) in enumerate(((0.8, 4.1), (0.7, 3.3), (0.6, 4.7))[:free]):
        q2 = multiply(q2, turn(size * math.sin(pace * t + axis), (2, 1, 0)[axis]))
    return q1, q2


def center_rows(seconds, rate_hz=50.0, free=3):
    """A joint centre that is carried about; everything is a difference of poses. Orientations: sensor 2 with its own heading."""
    noise = random.Random(3)
    h = 1e-4
    rows = []
    for k in range(int(seconds * rate_hz)):
        t = k / rate_hz
        imus = []
        for sensor, r in enumerate((R1, R2)):
            poses = [ball_orientations(t + d, free)[sensor] for d in (-h, 0.0, h)]
            step = multiply(conjugate(poses[0]), poses[2])
            rate = [c / h for c in step[1:]]
            places = [[a + 0.02 * math.sin((3 + i) * (t + d)) for i, a in enumerate(rotate(q, r))]
                      for q, d in zip(poses, (-h, 0.0, h), strict=True)]
            force = [(before - 2 * at + after) / h**2 for before, at, after in zip(*places, strict=True)]
            force[2] += 9.81
            felt = rotate(conjugate(poses[1]), force)
            imus += [v + noise.gauss(0, 0.001) for v in rate] + [v + noise.gauss(0, 0.02) for v in felt]
        q1, q2 = ball_orientations(t, free)
        rows.append([t] + imus + q1 + multiply(turn(-CENTER_HEADING, 2), q2))
    return rows


def slow_rows(seconds, rate_hz=50.0):
    """A hinge about z of both sensors in slow motion: what the sensors feel is gravity, turning as fast as the rates say, and little else."""
    noise = random.Random(4)
    h = 1e-4

    def pose(t):
        q1 = multiply(multiply(turn(0.9 * math.sin(0.9 * t), 2), turn(0.8 * math.sin(1.1 * t + 1), 0)), turn(0.9 * math.sin(0.7 * t), 1))
        return q1, multiply(q1, turn(bend(t) * 0.8, 2))

    rows = []
    for k in range(int(seconds * rate_hz)):
        t = k / rate_hz
        before, now, after = pose(t - h), pose(t), pose(t + h)
        imus = []
        for sensor in (0, 1):
            rate = [c / h for c in multiply(conjugate(before[sensor]), after[sensor])[1:]]
            force = [0.2 * math.sin(2.3 * t + sensor), 0.2 * math.cos(1.9 * t), 9.81 + 0.2 * math.sin(2.9 * t)]
            imus += [v + noise.gauss(0, 0.01) for v in rate] + [v + noise.gauss(0, 0.05) for v in rotate(conjugate(now[sensor]), force)]
        rows.append([t] + imus)
    return rows


LEG_COLUMNS = ["t_s"] + [f"{kind}{sensor}_{axis}" for sensor in (1, 2, 3) for kind in ("gyr", "acc") for axis in "xyz"]
# Joint to sensor, each in its sensor's frame, m; hip to knee is what the two of the thigh differ by.
LEG_PLACES = {"hip_to_pelvis_m": [-0.05, 0.1, 0.08], "hip_to_thigh_m": [0.05, -0.2, 0.06], "knee_to_thigh_m": [0.03, 0.2, 0.05],
              "knee_to_shank_m": [0.04, -0.18, 0.05]}
LEG_THIGH_M = math.dist(LEG_PLACES["hip_to_thigh_m"], LEG_PLACES["knee_to_thigh_m"])


def rotate(q, v):
    """The vector in the frame that q leads to."""
    turned = multiply(multiply(q, [0.0, *v]), [q[0], -q[1], -q[2], -q[3]])
    return turned[1:]


def chain_of_turns(*turns):
    """Product of turns (angle, axis)."""
    q = [1.0, 0.0, 0.0, 0.0]
    for angle, axis in turns:
        q = multiply(q, turn(angle, axis))
    return q


def leg_poses(t, rock_rad, turns_pelvis):
    """Of the sensors on pelvis, thigh and shank: orientation to earth, and position. After a second of rest everything moves. Each sensor
    rocks on its segment at 7 to 9 Hz, as skin does, that of a pelvis which does not turn a hundredth as much."""
    since = t - 1.0
    p = 0.0 if since <= 0 else (since ** 3 * (1 - 0.5 * since) if since < 1 else since - 0.5)

    def wave(hz, phase):
        return math.sin(2 * math.pi * hz * p + phase) - math.sin(phase)

    turns = 1.0 if turns_pelvis else 0.0
    pelvis = chain_of_turns((0.5 * turns * wave(0.5, 0.3), 2), (0.4 * turns * wave(0.7, 1.0), 0), (0.4 * turns * wave(0.9, 2.0), 1))
    thigh = multiply(pelvis, chain_of_turns((0.7 * wave(0.8, 0.5), 0), (0.3 * wave(0.6, 1.5), 1), (0.3 * wave(1.1, 2.5), 2)))
    shank = multiply(thigh, chain_of_turns((0.8 * wave(0.9, 0.9), 0), (0.25 * wave(0.7, 0.1), 1), (0.25 * wave(1.0, 1.1), 2)))
    hip = [0.10 * wave(0.9, 0.2), 0.10 * wave(0.8, 1.2), 0.06 * wave(1.3, 2.2)]
    places = LEG_PLACES
    along = [a - b for a, b in zip(places["hip_to_thigh_m"], places["knee_to_thigh_m"], strict=True)]
    knee = [a + b for a, b in zip(hip, rotate(thigh, along), strict=True)]
    found = []
    for sensor, (segment, joint, place) in enumerate(((pelvis, hip, "hip_to_pelvis_m"), (thigh, hip, "hip_to_thigh_m"),
                                                      (shank, knee, "knee_to_shank_m"))):
        at = [a + b for a, b in zip(joint, rotate(segment, places[place]), strict=True)]
        rock = rock_rad if turns_pelvis or sensor > 0 else 0.01 * rock_rad
        skin = chain_of_turns(*((rock * wave(7.1 + 0.7 * sensor + 0.3 * axis, 0.4 * axis), axis) for axis in range(3)))
        found.append((multiply(segment, skin), at))
    return found


def leg_rows(seconds, rock_rad=0.02, turns_pelvis=True, rate_hz=50.0, seed=1):
    """Rows (lists of 19 numbers) of sensors on a person's pelvis, thigh and shank: differences of poses, and noise."""
    noise = random.Random(seed)
    h = 1e-4
    rows = []
    for k in range(int(seconds * rate_hz)):
        t = k / rate_hz
        row = [t]
        for before, now, after in zip(*(leg_poses(t + step, rock_rad, turns_pelvis) for step in (-h, 0.0, h)), strict=True):
            (q0, at0), (q, at), (q1, at1) = before, now, after
            step = multiply([q0[0], -q0[1], -q0[2], -q0[3]], q1)
            force = [(a - 2 * b + c) / h ** 2 for a, b, c in zip(at0, at, at1, strict=True)]
            force[2] += 9.81
            rates = [value / h for value in step[1:]]
            felt = rotate([q[0], -q[1], -q[2], -q[3]], force)
            row += [value + noise.gauss(0, 0.002) for value in rates] + [value + noise.gauss(0, 0.02) for value in felt]
        rows.append(row)
    return rows
