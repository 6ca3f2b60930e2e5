"""What the bias states of the stream engine buy."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .. import native
from ..recordings import Recording
from ..simulate import HingeSpec, random_unit, simulate_hinge
from .harness import Report, Settings, number, percent, quantile, run_jobs
from .judge import MAX_ERROR_DEG, RIG_HINGES, available, cut, judge, nominal_axes, recording

TITLE = "Bias states of the stream engine"
ACC_BIAS_M_S2 = 1.0
GYR_BIAS_DEG_S = 1.0
MOTIONS = ("5", "6", "7", "12", "13", "14")
LENGTHS_S = (10.0, None)  # None: the whole recording
CONFIGS = {
    "all bias states": {},
    "gyroscopes only": {"acc_bias_m_s2": native.BIAS_OFF["acc_bias_m_s2"]},
    "accelerometers only": {"gyr_bias_rad_s": native.BIAS_OFF["gyr_bias_rad_s"]},
    "none": native.BIAS_OFF,
}


@dataclass
class Outcome:
    source: str
    config: str
    errors: np.ndarray  # (2,) deg at the end
    wrong_sign: bool
    ready: bool
    false_ready: bool
    covered: np.ndarray  # (2,)


def biased(rec: Recording, rng: np.random.Generator) -> Recording:
    """The recording with constant biases in random directions added to all four sensors."""
    gyr, acc = np.radians(GYR_BIAS_DEG_S), ACC_BIAS_M_S2
    return replace(rec, gyr1=rec.gyr1 + gyr * random_unit(rng), acc1=rec.acc1 + acc * random_unit(rng),
                   gyr2=rec.gyr2 + gyr * random_unit(rng), acc2=rec.acc2 + acc * random_unit(rng))


def compare(source: str, rec: Recording, axes: tuple[np.ndarray, np.ndarray]) -> list[Outcome]:
    outcomes = []
    for name, config in CONFIGS.items():
        verdict = judge(native.run(rec, **config), *axes)
        outcomes.append(Outcome(source, name, verdict.errors_deg[-1], bool(verdict.wrong_sign[-1]),
                                bool(verdict.ready[-1]), verdict.false_ready, verdict.covered(-1)))
    return outcomes


def measure_job(job: tuple[str, int, float | None]) -> list[Outcome]:
    name, index, length_s = job
    rng = np.random.default_rng([index, 3538])
    if name == "simulated":
        spec = HingeSpec(motions=((MOTIONS[index % len(MOTIONS)], 20.0),), rate_hz=50.0, seed=int(rng.integers(2**31)),
                         acc_bias=ACC_BIAS_M_S2, gyr_bias_deg_s=GYR_BIAS_DEG_S)
        rec = simulate_hinge(spec)
        return compare("simulated, 20 s", rec, (rec.axis1, rec.axis2))
    rec = recording(name)
    begin, count = 0, len(rec)
    if length_s:
        count = round(length_s * rec.rate_hz)
        begin = int(rng.integers(len(rec) - count))
    source = f"rig, {f'{length_s:g} s' if length_s else 'whole'}, bias added"
    return compare(source, biased(cut(rec, begin, begin + count), rng), nominal_axes(name))


def row(source: str, config: str, mine: list[Outcome]) -> list[str]:
    errors = np.concatenate([o.errors for o in mine])
    return [source, config, len(mine), number(np.sqrt(np.mean(errors**2))), number(quantile(errors, 0.5)),
            number(quantile(errors, 0.9)), number(errors.max()), percent(sum(o.wrong_sign for o in mine), len(mine)),
            percent(sum(o.ready for o in mine), len(mine)),
            percent(sum(o.covered.sum() for o in mine), 2 * len(mine)), sum(o.false_ready for o in mine)]


def measure(settings: Settings, report: Report) -> None:
    count = settings.count(150, 12)
    jobs = [("simulated", k, None) for k in range(count)]
    jobs += [(name, k, length_s) for length_s in LENGTHS_S for name in available(*RIG_HINGES) for k in range(count // 3)]
    outcomes = [outcome for found in run_jobs(measure_job, jobs, "bias", settings) for outcome in found]
    report.text(f"Constant biases of {ACC_BIAS_M_S2:g} m/s^2 and {GYR_BIAS_DEG_S:g} deg/s in random directions on every "
                "sensor. Errors of both axes at the end, deg. Cover: truth inside the bound at the end. False ready: at any "
                f"time `ready` with an error above {MAX_ERROR_DEG:g} deg or the wrong pairing. States are turned off by the "
                "smallest values of gyr_bias_rad_s and acc_bias_m_s2.")
    if not available(*RIG_HINGES):
        report.text("The rig recordings are not there; JOINTCAL_DATA names their folder.")
    groups = {(source, config): [o for o in outcomes if o.source == source and o.config == config]
              for source in dict.fromkeys(o.source for o in outcomes) for config in CONFIGS}
    report.table(["data", "bias states", "runs", "rms", "median", "90 %", "largest", "wrong pairing", "ready", "cover",
                  "false ready"], [row(*key, mine) for key, mine in groups.items()])
    mine = [o for o in outcomes if o.config == "all bias states"]
    report.require_none("default config: false ready", sum(o.false_ready for o in mine), len(mine))
