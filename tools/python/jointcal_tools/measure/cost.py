"""Time and memory on this machine, beside qmt run again every second."""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from .. import native
from ..recordings import Recording
from ..simulate import HingeSpec, simulate_hinge
from . import qmt_reference
from .harness import Progress, Report, Settings, number
from .judge import available, cut, recording

TITLE = "Cost on a PC"
RECORDING = "rig_1D_04"  # 5 minutes
STREAM_BYTES = 2048  # with bias states
RATIO = 1000.0
PAIR = np.dtype([("t_us", "<u8"), ("values", "<f4", 12)])  # jcal_pair_t


@contextlib.contextmanager
def one_core() -> Iterator[str]:
    """Keeps this process and its children on one core where the system can do that."""
    if not hasattr(os, "sched_setaffinity"):
        yield "not bound to a core"
        return
    before = os.sched_getaffinity(0)
    core = max(before)
    os.sched_setaffinity(0, {core})
    try:
        yield f"bound to core {core}"
    finally:
        os.sched_setaffinity(0, before)


def five_minutes(quick: bool) -> tuple[Recording, str]:
    if available(RECORDING):
        rec, name = recording(RECORDING), RECORDING
    else:
        rec, name = simulate_hinge(HingeSpec(motions=(("daily", 300.0),), rate_hz=50.0, seed=1)), "simulated daily motion"
    return (cut(rec, 0, round(60.0 * rec.rate_hz)), f"the first minute of {name}") if quick else (rec, name)


def run_bench(rec: Recording, repeats: int) -> list[dict]:
    """What jcal_bench, built beside the library, says."""
    program = native.library_path().parent / "jcal_bench"
    pairs = np.zeros(len(rec), PAIR)
    pairs["t_us"], pairs["values"] = native.microseconds(rec.t_s), native.values(rec)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "pairs.bin"
        pairs.tofile(path)
        done = subprocess.run([program, path, str(repeats)], check=True, capture_output=True, text=True)
    return [json.loads(line) for line in done.stdout.splitlines()]


def run_qmt(rec: Recording, every_s: float) -> tuple[float, int]:
    """Seconds and number of estimates, each on all data so far."""
    ends = range(round(every_s * rec.rate_hz), len(rec) + 1, round(every_s * rec.rate_hz))
    progress = Progress("cost, qmt", len(ends))
    total_s = 0.0
    for end in ends:
        part = cut(rec, 0, end)
        begin_s = time.perf_counter()
        qmt_reference.estimate(part)
        total_s += time.perf_counter() - begin_s
        progress.step()
    progress.finish()
    return total_s, len(ends)


def processor() -> str:
    with contextlib.suppress(OSError):
        for line in Path("/proc/cpuinfo").read_text().splitlines():
            if line.startswith("model name"):
                return line.split(":", 1)[1].strip()
    return "unknown processor"


def measure(settings: Settings, report: Report) -> None:
    rec, name = five_minutes(settings.quick)
    duration_s = len(rec) / rec.rate_hz
    with one_core() as bound:
        found = run_bench(rec, 5 if settings.quick else 20)
        version = qmt_reference.qmt_version() if settings.with_qmt else None
        qmt_s, estimates = run_qmt(rec, settings.qmt_every_s) if version else (float("nan"), 0)
    report.text(f"{processor()}, {bound}; {name}, {duration_s:.0f} s at {rec.rate_hz:.0f} Hz. A step is what one sample "
                "costs besides its push, shares of searches and full solves included; 99 %: of the steps taken singly. "
                "State: sizeof; storage: what the caller hands over besides.")
    report.table(["engine", "n_max", "push, ns", "step, ns", "step 99 %, ns", "state, bytes", "storage, bytes",
                  "recording, s", "times real time"],
                 [[row["engine"], row["n_max"] or "-", f"{row['push_ns']:.0f}", f"{row['step_ns']:.0f}",
                   f"{row['step_p99_ns']:.0f}", row["state_bytes"], row["storage_bytes"], f"{row['recording_s']:.4f}",
                   f"{duration_s / row['recording_s']:.0f}"] for row in found])
    stream = found[0]
    report.require_most("stream: state with bias states", stream["state_bytes"], STREAM_BYTES, " bytes")
    if not version:
        report.text(qmt_reference.INSTALL_HINT if settings.with_qmt else "Without qmt.")
        return
    ratio = qmt_s / stream["recording_s"]
    report.text(f"The same recording with an estimate every {settings.qmt_every_s:g} s: qmt {version} on all data so far, "
                f"its output suppressed, {qmt_s:.2f} s for {estimates} estimates; stream engine, every sample pushed and one "
                f"result taken per second, {stream['recording_s']:.4f} s: {ratio:.0f} times less.")
    if settings.qmt_every_s == 1.0 and not settings.quick:  # a short recording is easier for qmt
        report.require("qmt's time over the stream engine's, at least 1000", number(ratio, 0), ratio >= RATIO)
