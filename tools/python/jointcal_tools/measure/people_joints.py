"""Joints of people: which sensors of which recording make one, its reference flexion, its evaluation parts, its spectrum.

Recordings lie in the folder of `judge.data_folder`. Sensors are numbered 1, 2, 3 as in the
columns of a file; segment 1 of a joint is the proximal one.
"""

from __future__ import annotations

import functools
import json
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from ..common_rate import Samples, block_starts, integral, make_frame, make_point, minimise, vector_rows
from ..recordings import AXES, Recording
from .judge import available, data_folder, recording

MOTION_RAD2_S2 = 1.0  # |w1|^2 + |w2|^2 at which a second of motion counts one half
MOTION_TIME_S = 0.1  # its low-pass
BLOCK_S = 5.0  # the headings of a joint's two sensors are free of each other from block to block
AXIS_CUTOFF_HZ = 3.0  # above this the rates of a person hold skin, not the axis
OCTAVES_HZ = ((0.0, 1.0), (1.0, 2.0), (2.0, 4.0), (4.0, 8.0), (8.0, 16.0))


@dataclass(frozen=True)
class Joint:
    """Where a joint's signals are."""

    file: str
    kind: str  # "knee", "hip", "ankle", "elbow", or "none": two sensors of one segment
    person: str  # recordings of one person at one time are not unrelated
    sensors: tuple[int, int] = (1, 2)
    flexion: str = ""  # column of the reference, deg
    sign: float = 1.0  # of the reference: flexion is positive here
    frames_agree: bool = True  # gyroscope and accelerometer have one frame


JOINTS: dict[str, Joint] = {
    "human_knee_left": Joint("human_knee_left", "knee", "human"),
    "human_leg_left:knee": Joint("human_leg_left", "knee", "human", (2, 3)),
    "human_leg_left:hip": Joint("human_leg_left", "hip", "human", (1, 2)),
    "human_elbow_right": Joint("human_elbow_right", "elbow", "human"),
    "knee_drop": Joint("knee_drop", "knee", "drop", flexion="ref_flexion_deg", sign=-1.0),
    "people_knee_long_L1": Joint("people_knee_long_L1", "knee", "A", flexion="ref_flexion_deg"),
    "people_knee_long_R1": Joint("people_knee_long_R1", "knee", "A"),
    "people_ankle_long_L": Joint("people_ankle_long_L", "ankle", "A"),
    "people_same_segment_L": Joint("people_same_segment_L", "none", "A"),
    "walk_leg_L:knee": Joint("walk_leg_L", "knee", "walk_leg", (2, 3)),
    "walk_leg_L:hip": Joint("walk_leg_L", "hip", "walk_leg", (1, 2)),
    "people_walk_L:knee": Joint("people_walk_L", "knee", "L", (1, 2)),
    "people_walk_L:ankle": Joint("people_walk_L", "ankle", "L", (2, 3)),
    "people_ankle_orthosis": Joint("people_ankle_orthosis", "ankle", "K", flexion="ref_encoder_deg"),
    "people_elbow_B_JA_Fast": Joint("people_elbow_B_JA_Fast", "elbow", "B"),
    "people_elbow_D_ROM": Joint("people_elbow_D_ROM", "elbow", "D"),
    "people_elbow_E_ROM": Joint("people_elbow_E_ROM", "elbow", "E"),
    **{f"people_sts_O_{task}:{kind}": Joint(f"people_sts_O_{task}", kind, "O", sensors, frames_agree=False)
       for task in ("calib", "5sts", "30sts") for kind, sensors in (("knee", (2, 3)), ("hip", (1, 2)))},
}


@dataclass
class JointRecording(Recording):
    """Two sensors of a person's joint; `columns` are those of the whole file."""

    name: str
    joint: Joint
    flexion_deg: np.ndarray | None = None  # (N,) optical or encoder, positive in flexion; nan where it was lost
    facts: dict = field(default_factory=dict)  # the .json beside the data


@dataclass(frozen=True)
class Part:
    """A start in a recording of a joint."""

    name: str
    begin: int  # sample
    end: int  # of the horizon, or of the recording
    begin_s: float  # since the recording's first sample
    motion_s: float  # within the horizon


def people_joints(*kinds: str, frames_agree: bool = True) -> list[str]:
    """Names of the joints that are there, of the given kinds or of all but "none"."""
    return [name for name, joint in JOINTS.items()
            if (joint.kind in kinds if kinds else joint.kind != "none") and (joint.frames_agree or not frames_agree)
            and available(joint.file)]


def sensor_signals(rec: Recording, sensor: int) -> tuple[np.ndarray, np.ndarray]:
    """Rates and specific forces (N, 3) of sensor 1, 2 or 3."""
    return tuple(np.column_stack([rec.columns[f"{kind}{sensor}_{axis}"] for axis in AXES]) for kind in ("gyr", "acc"))


@functools.cache
def people_joint(name: str) -> JointRecording:
    """The joint `name` of JOINTS. Rows in which a signal is missing are left out."""
    joint = JOINTS[name]
    whole = recording(joint.file)
    (gyr1, acc1), (gyr2, acc2) = (sensor_signals(whole, sensor) for sensor in joint.sensors)
    rows = Recording(whole.t_s, gyr1, acc1, gyr2, acc2).finite()
    columns = {key: column[rows] for key, column in whole.columns.items()}
    flexion = joint.sign * columns[joint.flexion] if joint.flexion else None
    facts = json.loads((data_folder() / f"{joint.file}.json").read_text())
    return JointRecording(whole.t_s[rows], gyr1[rows], acc1[rows], gyr2[rows], acc2[rows], columns=columns,
                          name=name, joint=joint, flexion_deg=flexion, facts=facts)


# Parts.

def motion_weight(rec: Recording, knee: float = MOTION_RAD2_S2) -> np.ndarray:
    """(N,) m/(m + knee): how much of a second of motion a second counts; m: |w1|^2 + |w2|^2, low-passed."""
    energy = (rec.gyr1**2).sum(axis=1) + (rec.gyr2**2).sum(axis=1)
    share = 1.0 / (1.0 + MOTION_TIME_S * rec.rate_hz)
    m, state = np.empty(len(energy)), float(energy[0])
    for k, value in enumerate(energy):
        state += share * (value - state)
        m[k] = state
    return m / (m + knee)


def motion_s(rec: Recording, knee: float = MOTION_RAD2_S2) -> np.ndarray:
    """(N,) seconds of motion since the first sample, W; a gap in time counts as one period."""
    return np.cumsum(motion_weight(rec, knee)) / rec.rate_hz


def motion_before(rec: Recording) -> np.ndarray:
    """(N + 1,) seconds of motion before each sample, and of all."""
    return np.concatenate([[0.0], motion_s(rec)])


def parts(names: Sequence[str], every_s: float = 10.0, horizon_s: float = 30.0, least_s: float = 5.0) -> list[Part]:
    """Starts every `every_s` of the named joints with at least `least_s` of motion within `horizon_s`.

    A start whose horizon goes beyond the end of the recording is one if what is left holds the motion.
    """
    found = []
    for name in names:
        rec = people_joint(name)
        t_s, moved = rec.t_s - rec.t_s[0], motion_before(rec)
        for begin_s in np.arange(0.0, t_s[-1], every_s):
            begin, end = np.searchsorted(t_s, [begin_s - 1e-6, begin_s + horizon_s - 1e-6])
            amount = float(moved[end] - moved[begin])
            if amount >= least_s:
                found.append(Part(name, int(begin), int(end), float(begin_s), amount))
    return found


# Spectrum of what a hinge does not explain (the first table of people's joints).

def low_pass(signal: np.ndarray, rate_hz: float, cutoff_hz: float) -> np.ndarray:
    """(N, ...) with everything above `cutoff_hz` taken out, without delay."""
    spectrum = np.fft.rfft(signal, axis=0)
    spectrum[np.fft.rfftfreq(len(signal), 1.0 / rate_hz) > cutoff_hz] = 0.0
    return np.fft.irfft(spectrum, len(signal), axis=0)


def across_and_along(rec: Recording, axis1: np.ndarray, axis2: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """What is left (N,) complex of the rates across the axis when one hinge is taken for the joint, and the joint's rate (N,).

    z_i: rate of sensor i across its axis, turned by the angle of the joint (integral of its own rate)
    and by one phase for each block: p exp(-i theta) z1 - z2.
    """
    frame1, frame2 = make_frame(axis1), make_frame(axis2)
    z1, z2 = (gyr @ frame.u + 1j * (gyr @ frame.v) for gyr, frame in ((rec.gyr1, frame1), (rec.gyr2, frame2)))
    along = rec.gyr2 @ frame2.j - rec.gyr1 @ frame1.j
    starts = block_starts(rec.t_s, BLOCK_S)
    turned = np.exp(-1j * integral(along, rec.t_s, starts)) * z1
    match = np.add.reduceat(turned.conj() * z2, starts)
    phase = np.repeat(np.exp(1j * np.angle(match)), np.diff(np.r_[starts, len(rec)]))
    return phase * turned - z2, along


def fitted_axes(rec: Recording) -> tuple[np.ndarray, np.ndarray]:
    """The pair of axes for which least is left below 3 Hz; found from several starts."""
    gyr1, gyr2 = (low_pass(gyr, rec.rate_hz, AXIS_CUTOFF_HZ) for gyr in (rec.gyr1, rec.gyr2))
    rows = vector_rows(Samples(rec.t_s, gyr1, rec.acc1, gyr2, rec.acc2), BLOCK_S)
    main1, main2 = (np.linalg.eigh(gyr.T @ gyr)[1][:, ::-1].T for gyr in (gyr1, gyr2))
    points = [minimise(rows, make_point(j1, sign * j2)) for j1 in main1[:2] for j2 in main2[:2] for sign in (1.0, -1.0)]
    best = min(points, key=lambda point: float(np.sum(rows(point)[0] ** 2)))
    return best.frame1.j, best.frame2.j


def band_rms(signal: np.ndarray, rate_hz: float, band_hz: tuple[float, float]) -> float:
    """rms of a real or complex (N,) signal within a band."""
    spectrum = np.fft.fft(signal)
    frequency = np.abs(np.fft.fftfreq(len(signal), 1.0 / rate_hz))
    inside = (frequency >= band_hz[0]) & (frequency < band_hz[1])
    return float(np.sqrt(np.sum(np.abs(spectrum[inside]) ** 2)) / len(signal))


def octave_rates(rec: Recording, axis1: np.ndarray, axis2: np.ndarray) -> np.ndarray:
    """(6, 2) rms rate across the hinge and of the joint, rad/s: the octaves of OCTAVES_HZ, then all together."""
    across, along = across_and_along(rec, axis1, axis2)
    bands = (*OCTAVES_HZ, (0.0, np.inf))
    return np.array([[band_rms(signal, rec.rate_hz, band) for signal in (across, along)] for band in bands])
