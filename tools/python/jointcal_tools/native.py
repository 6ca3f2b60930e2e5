"""The hinge engines of the C library over whole arrays, through ctypes.

    track = run(recording, engine="window", n_max=1000)
    track.ready, track.axis1, track.bounds_deg

Needs libjcal_batch, which the build makes beside the program; JOINTCAL_BATCH may
name another one.
"""

from __future__ import annotations

import ctypes
import functools
import os
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .recordings import Recording

REPOSITORY = Path(__file__).resolve().parents[3]
LIBRARY_NAMES = ("libjcal_batch.so", "libjcal_batch.dylib")
BUILD_HINT = "build it with: cmake --preset host && cmake --build --preset host"
COLUMNS = 17
REJECTIONS = ("not_finite", "out_of_range", "saturated", "frozen", "repeated", "time_order", "gap")
COLLECTING, AMBIGUOUS, READY, MOVED = range(4)
ENGINES = {"stream": 0, "window": 1}
SIGN_HINTS = {"unknown": 0, "same": 1, "opposite": 2}
OVERRIDES: dict[str, float] = {}  # settings that measure.py puts over the library's defaults, for all runs
BIAS_OFF = {"gyr_bias_rad_s": 1e-5, "acc_bias_m_s2": 1e-4}  # the config's smallest values: no bias to speak of


class Options(ctypes.Structure):
    """jcal_batch_options_t of tools/native/batch.h."""

    _fields_ = [("engine", ctypes.c_int32), ("sign_hint", ctypes.c_int32), ("max_bound_rad", ctypes.c_float),
                ("gyr_noise_rad_s", ctypes.c_float), ("acc_noise_m_s2", ctypes.c_float),
                ("lever_arm_m", ctypes.c_float), ("rate_mismatch", ctypes.c_float), ("gyr_bias_rad_s", ctypes.c_float),
                ("acc_bias_m_s2", ctypes.c_float), ("slices_per_s", ctypes.c_float), ("n_max", ctypes.c_int32),
                ("half_window", ctypes.c_int32),
                ("acc_min", ctypes.c_int32), ("accept_count", ctypes.c_int32), ("seed", ctypes.c_uint32),
                ("w0", ctypes.c_float), ("energy_max_rad2_s2", ctypes.c_float), ("accept_bound_rad", ctypes.c_float),
                ("solve_period_s", ctypes.c_float)]


class Input(ctypes.Structure):
    _fields_ = [("t_us", ctypes.c_void_p), ("values", ctypes.c_void_p), ("count", ctypes.c_size_t)]


class Output(ctypes.Structure):
    _fields_ = [("rows", ctypes.c_void_p), ("rejected_by", ctypes.c_void_p), ("gyr_ids", ctypes.c_void_p),
                ("acc_ids", ctypes.c_void_p), ("gyr_count", ctypes.c_size_t), ("acc_count", ctypes.c_size_t)]


@dataclass
class Track:
    """What an engine said after each of N samples."""

    t_s: np.ndarray  # (N,) from the first sample
    status: np.ndarray  # (N,) COLLECTING, AMBIGUOUS, READY or MOVED
    reason: np.ndarray  # (N,) jcal_reason_t, see reason_name()
    weak: np.ndarray
    hint: np.ndarray
    axis1: np.ndarray  # (N, 3), zero before there is an estimate
    axis2: np.ndarray
    bounds_deg: np.ndarray  # (N, 2)
    sign_margin: np.ndarray
    paper_accepted: np.ndarray  # (N,) bool
    progress: np.ndarray  # (N, 3) axis1, axis2, sign
    rejected_by: dict[str, int]
    gyr_ids: np.ndarray | None = None  # window engine: samples selected at the end, ascending
    acc_ids: np.ndarray | None = None

    @property
    def ready(self) -> np.ndarray:
        return self.status == READY

    def first_ready_s(self) -> float:
        """Time from the first sample to `ready`; infinite if it never was."""
        return float(self.t_s[self.ready.argmax()]) if self.ready.any() else float("inf")


def library_path() -> Path:
    """Where the library is; FileNotFoundError says how to build it."""
    named = os.environ.get("JOINTCAL_BATCH")
    candidates = [Path(named)] if named else [REPOSITORY / "build" / "host" / name for name in LIBRARY_NAMES]
    for path in candidates:
        if path.is_file():
            return path
    raise FileNotFoundError(f"{candidates[0]} is not there; {BUILD_HINT}")


def warn_if_stale(path: Path) -> None:
    """An old library would be measured without anyone noticing."""
    sources = [*REPOSITORY.glob("lib/**/*.[ch]"), *REPOSITORY.glob("include/**/*.h")]
    if any(source.stat().st_mtime > path.stat().st_mtime for source in sources):
        print(f"warning: {path.name} is older than the sources; {BUILD_HINT}", file=sys.stderr)


@functools.cache
def library() -> ctypes.CDLL:
    path = library_path()
    warn_if_stale(path)
    lib = ctypes.CDLL(str(path))
    lib.jcal_batch_options_size.restype = ctypes.c_size_t
    lib.jcal_batch_run.restype = ctypes.c_int32
    for name in ("check", "version", "reason"):
        getattr(lib, f"jcal_batch_{name}").restype = ctypes.c_char_p
    if lib.jcal_batch_options_size() != ctypes.sizeof(Options):
        raise RuntimeError(f"{path.name} does not belong to these scripts; {BUILD_HINT}")
    return lib


def version() -> str:
    return library().jcal_batch_version().decode()


def reason_name(reason: int) -> str:
    name = library().jcal_batch_reason(int(reason))
    return name.decode() if name else "none"


def make_options(**settings: float | str) -> Options:
    """The library's defaults with `settings`, named as the fields of Options, put over them."""
    options = Options()
    library().jcal_batch_defaults(ctypes.byref(options))
    known = {name for name, _ in Options._fields_}
    for name, value in {**OVERRIDES, **settings}.items():
        if name not in known:
            raise TypeError(f"'{name}' is not an option; there are {', '.join(sorted(known))}")
        words = {"engine": ENGINES, "sign_hint": SIGN_HINTS}.get(name)
        setattr(options, name, words[value] if words else value)
    wrong = library().jcal_batch_check(ctypes.byref(options))
    if wrong:
        raise ValueError(f"{wrong.decode()} is out of its range")
    return options


def microseconds(t_s: np.ndarray) -> np.ndarray:
    """Times as the library wants them, from 1 s on; shifting all times changes nothing."""
    return (np.rint((np.asarray(t_s, float) - t_s[0]) * 1e6) + 1e6).astype(np.uint64)


def values(rec: Recording) -> np.ndarray:
    """The twelve signals (N, 12) in the library's order and precision."""
    return np.ascontiguousarray(np.hstack([rec.gyr1, rec.acc1, rec.gyr2, rec.acc2]), np.float32)


def run(rec: Recording, **settings: float | str) -> Track:
    """A fresh instance over the whole recording; see make_options() for the settings."""
    options = make_options(**settings)
    data, t_us = values(rec), microseconds(rec.t_s)
    rows = np.zeros((len(data), COLUMNS), np.float32)
    rejected = np.zeros(len(REJECTIONS), np.uint32)
    ids = np.zeros((2, options.n_max), np.uint32)
    source = Input(t_us.ctypes.data, data.ctypes.data, len(data))
    target = Output(rows.ctypes.data, rejected.ctypes.data, ids[0].ctypes.data, ids[1].ctypes.data, 0, 0)
    done = library().jcal_batch_run(ctypes.byref(options), ctypes.byref(source), ctypes.byref(target))
    if done != 0:
        raise RuntimeError(f"jcal_batch_run returned {done}")
    track = make_track(np.asarray(rec.t_s, float) - rec.t_s[0], rows, rejected)
    if options.engine == ENGINES["window"]:
        track.gyr_ids = np.sort(ids[0, : target.gyr_count]).astype(int)
        track.acc_ids = np.sort(ids[1, : target.acc_count]).astype(int)
    return track


def make_track(t_s: np.ndarray, rows: np.ndarray, rejected: np.ndarray) -> Track:
    status, reason, weak, hint = rows[:, :4].astype(int).T
    return Track(t_s, status, reason, weak, hint, rows[:, 4:7].astype(float), rows[:, 7:10].astype(float),
                 np.degrees(rows[:, 10:12].astype(float)), rows[:, 12], rows[:, 13] > 0, rows[:, 14:17],
                 dict(zip(REJECTIONS, rejected.tolist(), strict=True)))
