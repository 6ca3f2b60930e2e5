"""Joint centre, simulated: honest bounds, what must never be ready, knocks, and table I of [OLS17]."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace

import numpy as np

from .. import native, ols17
from .. import native_center as center
from .. import native_two_dof as two_dof
from ..simulate_two_dof import TwoDofRecording, TwoDofSpec, simulate_two_dof
from .harness import Report, Settings, median, number, numbered, percent, quantile, run_jobs

TITLE = "Joint centre, simulated: honest bounds, what must never be ready, knocks, and table I of OLS17"
VQF = "LS"  # what of it needs VQF
MOTIONS = ("three_dof", "free", "daily", "complex", "simple")
NEVER = ("hinge", "pronation", "stiff", "rest", "segment1_rest")
RATES_HZ = (25.0, 40.0, 50.0, 100.0, 128.0, 200.0)
RUNS, NEVER_RUNS, KNOCK_RUNS, BIAS_RUNS, LS_RUNS = 5000, 2000, 60, 100, 3000
ORIENTATIONS = {"exact": {}, "inclined by 1 deg": {"inclination_deg": 1.0, "drift_deg_min": 2.0}, "VQF": {}}  # for LS: what is changed
COVERAGE, SHARPNESS = 0.95, 3.0
MAX_BOUND_M = 0.01
BIAS_M_S2, BIAS_ERROR_MM = 0.3, 3.0

CLASSES = {
    "clean": {},
    "noise": {"noise_scale": (2.0, 5.0)},
    "bias": {"acc_bias": (0.0, 0.5), "gyr_bias_deg_s": (0.0, 1.0)},
    "soft": {"soft_tissue_deg": (0.0, 1.5)},
    "all": {"noise_scale": (1.0, 3.0), "acc_bias": (0.0, 0.3), "gyr_bias_deg_s": (0.0, 0.5), "soft_tissue_deg": (0.0, 1.0)},
}

# Table I of [OLS17]: Gaussian rates and accelerations, 500 samples, noise of its section V-B.
PAPER_RUNS, PAPER_N = 100, 500
PAPER_R = np.array([[-0.118, 0.0, 0.015], [0.147, 0.0, 0.015]])
PAPER_NOISE = (np.sqrt(1e-2), np.sqrt(1e-5), np.sqrt(5e-2))  # m/s^2, rad/s, rad/s^2
PAPER_MM = {"LS": 0.22, "SS": 0.07, "SA": 0.08}
TURN_ERRORS_DEG = (0.0, 1.0, 2.0, 5.0, 10.0)
KNOCK_M_S2, KNOCK_SHARE = 30.0, 0.02


@dataclass
class Outcome:
    run: str
    kind: str
    motion: str
    first_s: float
    first: tuple[np.ndarray, np.ndarray] | None  # errors and bounds (2,), mm, when ready was first entered
    end: tuple[np.ndarray, np.ndarray]
    ready_at_end: bool
    worst_mm: float  # while ready
    moved: int
    hours: float
    reason: str


def make_spec(kind: str, index: int) -> TwoDofSpec:
    kinds = [*CLASSES, *NEVER]
    rng = np.random.default_rng([kinds.index(kind), index, 3333])
    ranges = CLASSES.get(kind, CLASSES["clean" if index % 2 else "all"])
    motion = MOTIONS[index % len(MOTIONS)] if kind in CLASSES else kind
    return TwoDofSpec(motions=((motion, float(rng.uniform(20.0, 60.0))),), rate_hz=RATES_HZ[rng.integers(len(RATES_HZ))],
                      seed=int(rng.integers(2**31)), carrying_deg=float(rng.uniform(0.0, 30.0)),
                      speed=float(rng.uniform(0.7, 2.5)), **{name: float(rng.uniform(*r)) for name, r in ranges.items()})


def errors_mm(track: center.Track, rec: TwoDofRecording) -> np.ndarray:
    """(N, 2)"""
    return 1e3 * np.column_stack([np.linalg.norm(track.r1 - rec.r1, axis=1), np.linalg.norm(track.r2 - rec.r2, axis=1)])


def measure_run(job: tuple[str, int]) -> Outcome:
    kind, index = job
    return judge_run(f"{kind}:{index}", kind, simulate_two_dof(make_spec(kind, index)))


def ls_run(job: tuple[str, str, int]) -> Outcome:
    """LS with true orientations, those in earth frames that wander, or VQF's of the sensors' data."""
    source, kind, index = job
    rec = simulate_two_dof(replace(make_spec(kind, index), **ORIENTATIONS[source]))
    turned = two_dof.orientations(rec) if source == "VQF" else (rec.q1, rec.q2)
    return judge_run(f"LS, {source}, {kind}:{index}", kind, rec, orientations=turned, method="ls")


def judge_run(run: str, kind: str, rec: TwoDofRecording, **settings: str | tuple[np.ndarray, np.ndarray]) -> Outcome:
    track = center.run(rec, **settings)
    errors, bounds = errors_mm(track, rec), 1e3 * track.bounds_m
    first = track.first_ready()
    return Outcome(run, kind, rec.spec.motions[0][0], np.inf if first is None else float(track.t_s[first]),
                   None if first is None else (errors[first], bounds[first]), (errors[-1], bounds[-1]),
                   bool(track.ready[-1]), float(errors[track.ready].max()) if track.ready.any() else 0.0,
                   len(track.moved), float(track.t_s[-1]) / 3600.0, native.reason_name(track.reason[-1]))


def cells_of(moments: list[tuple[np.ndarray, np.ndarray]]) -> tuple[list[str], int, float]:
    """Cells of a table, hits of both sensors, and the sharpness."""
    if not moments:
        return ["-"] * 3, 0, float("nan")
    errors, bounds = (np.array(part) for part in zip(*moments, strict=True))
    hits = int((errors <= bounds).sum())
    error, bound = median(errors.ravel()), median(bounds.ravel())
    return [percent(hits, errors.size), number(error, 1), number(bound / error, 1)], hits, bound / error


def bounds_table(report: Report, groups: dict[str, list[Outcome]]) -> None:
    rows = []
    for kind, mine in groups.items():
        ever, at_end = [o for o in mine if o.first], [o for o in mine if o.ready_at_end]
        times = [o.first_s for o in ever]
        first_cells, first_hits, _ = cells_of([o.first for o in ever])
        end_cells, end_hits, sharpness = cells_of([o.end for o in at_end])
        wrong = sum(o.worst_mm > 1e3 * MAX_BOUND_M for o in mine)
        reasons = Counter(o.reason for o in mine if not o.ready_at_end)
        rows.append([kind, len(mine), percent(len(ever), len(mine)), percent(len(at_end), len(mine)), number(median(times), 1),
                     number(quantile(times, 0.9), 1), *first_cells, *end_cells, wrong,
                     f"{sum(o.moved for o in mine)} in {sum(o.hours for o in mine):.1f} h",
                     ", ".join(f"{n} {c}" for n, c in reasons.most_common(2)) or "-"])
        report.require_none(f"{kind}: false ready", wrong, len(mine))
        for when, hits, count in (("first ready", first_hits, len(ever)), ("end", end_hits, len(at_end))):
            if count:
                report.require_share(f"{kind}, {when}: inside the bound", hits, 2 * count, COVERAGE)
        if kind == "bias" and not report.quick:
            report.require_most(f"{kind}, end: median bound over median error", sharpness, SHARPNESS)
    report.table(["class", "runs", "ever ready", "at end", "time, s", "90 %, s", "first: cover", "error, mm", "ratio",
                  "end: cover", "error, mm", "ratio", "false ready", "moved", "not ready at the end"], rows)


def motion_table(report: Report, groups: dict[str, list[Outcome]]) -> None:
    rows = [[kind, *(percent(sum(o.ready_at_end for o in mine if o.motion == m), sum(o.motion == m for o in mine))
                     for m in MOTIONS)] for kind, mine in groups.items()]
    report.text("Ready at the end, by motion.")
    report.table(["class", *MOTIONS], rows)


def never_table(report: Report, groups: dict[str, list[Outcome]]) -> None:
    rows = []
    for kind, mine in groups.items():
        reasons = Counter(o.reason for o in mine)
        ready = sum(o.first is not None for o in mine)
        rows.append([kind, len(mine), ready, ", ".join(f"{n} {c}" for n, c in reasons.most_common())])
        report.require_none(f"{kind}: ready", ready, len(mine))
    report.table(["motion", "runs", "ever ready", "reason at the end"], rows)


def ls_table(report: Report, settings: Settings) -> None:
    """Whether LS is honest, and what it needs."""
    sources = [source for source in ORIENTATIONS if source != "VQF" or two_dof.has_vqf()]
    count = -(-settings.count(LS_RUNS, 30) // (len(ORIENTATIONS) * (len(CLASSES) + len(NEVER))))
    jobs = [(source, kind, index) for source in sources for kind in (*CLASSES, *NEVER) for index in range(count)]
    outcomes = run_jobs(ls_run, jobs, "center_sim, LS", settings)
    rows = []
    for source in sources:
        for kind in (*CLASSES, "what must never be"):
            kinds = (kind,) if kind in CLASSES else NEVER
            mine = [o for o, job in zip(outcomes, jobs, strict=True) if job[0] == source and o.kind in kinds]
            ready, wrong = [o for o in mine if o.first], sum(o.worst_mm > 1e3 * MAX_BOUND_M for o in mine)
            cells, hits, _ = cells_of([o.first for o in ready])
            error, bound = (median(np.concatenate([o.end[k] for o in mine])) for k in (0, 1))
            reasons = Counter(o.reason for o in mine if not o.ready_at_end)
            rows.append([source, kind, len(mine), len(ready), cells[0], wrong, number(error, 1), number(min(bound, 9999.0), 1),
                         ", ".join(f"{name} {n}" for name, n in reasons.most_common(2))])
            report.require_none(f"LS, {source}, {kind}: false ready", wrong, len(mine))
            if kind not in CLASSES:
                report.require_none(f"LS, {source}, {kind}: ready", len(ready), len(mine))
            elif ready:
                report.require_share(f"LS, {source}, {kind}, first ready: inside the bound", hits, 2 * len(ready), COVERAGE)
    report.text("LS on runs of the same kinds: with the true orientations; with the same in earth frames that wander by 1 deg rms of tilt "
                "and 2 deg/min of heading, which is less than VQF's tilt on the rig; and with VQF's of the same data. Cover: at first ready. "
                "Error and bound: median at the end, ready or not, mm. On the rig it is never ready: center.md says why.")
    report.table(["LS, orientations", "disturbance", "runs", "ready", "cover", "false", "error", "bound", "not ready at the end"], rows)


def bias_run(index: int) -> tuple[bool, np.ndarray, np.ndarray]:
    """Accelerometer biases of 0.3 m/s^2: ready, errors with the bias states, errors without them, mm."""
    rng = np.random.default_rng([index, 3434])
    rec = simulate_two_dof(TwoDofSpec(motions=(("three_dof", 40.0),), rate_hz=50.0, seed=int(rng.integers(2**31)),
                                      speed=2.0, acc_bias=BIAS_M_S2))
    track, plain = center.run(rec), center.run(rec, acc_bias_m_s2=0.0)
    return bool(track.ready[-1]), errors_mm(track, rec)[-1], errors_mm(plain, rec)[-1]


def bias_table(report: Report, settings: Settings) -> None:
    found = run_jobs(bias_run, range(settings.count(BIAS_RUNS, 12)), "center_sim, bias", settings)
    ready = [f for f in found if f[0]]
    rows = []
    for label, errors in (("with bias states, ready", [f[1] for f in ready]),
                          ("with bias states, all", [f[1] for f in found]), ("without", [f[2] for f in found])):
        flat = np.concatenate(errors) if errors else np.zeros(0)
        rows.append([label, len(errors), number(median(flat), 1), number(quantile(flat, 0.95), 1),
                     number(flat.max() if len(flat) else np.nan, 1)])
    report.text(f"Accelerometer biases of {BIAS_M_S2} m/s^2 in random directions, ball joint, 40 s at 2 rad/s rms. "
                "What is not told apart must not be ready.")
    report.table(["", "runs", "median error, mm", "95 %", "largest"], rows)
    report.require_most(f"bias of {BIAS_M_S2} m/s^2: median error of those that are ready",
                        median(np.concatenate([f[1] for f in ready])) if ready else np.nan, BIAS_ERROR_MM, " mm")


def knock_run(index: int) -> dict[str, float]:
    """Larger error (mm) of each engine and method, without and with knocks."""
    rng = np.random.default_rng([index, 3535])
    rec = simulate_two_dof(TwoDofSpec(motions=(("three_dof", 30.0),), rate_hz=50.0, seed=int(rng.integers(2**31)), speed=2.0))
    out = {}
    for knocked in (False, True):
        if knocked:
            for acc in (rec.acc1, rec.acc2):
                hit = rng.random(len(acc)) < KNOCK_SHARE
                acc[hit] += rng.normal(0.0, KNOCK_M_S2, (int(hit.sum()), 3))
        for method in ("ss", "sa"):
            for engine, n_max in (("stream", 0), ("window", 2000)):
                track = center.run(rec, method=method, n_max=n_max)
                out[f"{method} {engine} {'knocks' if knocked else 'calm'}"] = errors_mm(track, rec)[-1].max()
    return out


def knock_table(report: Report, settings: Settings) -> None:
    found = run_jobs(knock_run, range(settings.count(KNOCK_RUNS, 6)), "center_sim, knocks", settings)
    rows = []
    for method in ("ss", "sa"):
        for engine in ("stream", "window"):
            calm, knocks = ([f[f"{method} {engine} {when}"] for f in found] for when in ("calm", "knocks"))
            rows.append([method, engine, number(median(calm), 1), number(median(knocks), 1), number(quantile(knocks, 0.9), 1)])
    calm = median([f["ss window knocks"] for f in found])
    report.text(f"Knocks: {100 * KNOCK_SHARE:g} % of the samples of either accelerometer off by {KNOCK_M_S2:g} m/s^2 rms. Larger "
                "error of both vectors after 30 s of lively motion, mm.")
    report.table(["method", "engine", "without, median", "with, median", "with, 90 %"], rows)
    report.require("SA suffers less from knocks than SS (window)", f"{median([f['sa window knocks'] for f in found]):.1f} against {calm:.1f} mm",
                   median([f["sa window knocks"] for f in found]) < 0.5 * calm)


def paper_run(job: tuple[int, float]) -> dict[str, np.ndarray]:
    """Errors (2,) mm of the three estimators on data as in section V-B of [OLS17]."""
    index, turn_deg = job
    rng = np.random.default_rng([index, round(10 * turn_deg), 1717])

    def gaussian(sd: float) -> np.ndarray:
        return rng.normal(0.0, sd, (PAPER_N, 3))

    def rotations(sd_deg: float) -> np.ndarray:
        return ols17.rotation(np.radians(gaussian(sd_deg)))

    parts, turns = [], []
    down = rng.normal(size=(PAPER_N, 3))
    down *= 9.82 / np.linalg.norm(down, axis=1)[:, None]  # a0 in the common frame
    for r in PAPER_R:
        w, dw = gaussian(10.0), gaussian(10.0)
        turn = rotations(100.0)  # sensor to the common frame, anything
        a = np.einsum("nji,nj->ni", turn, down) + ols17.k_matrix(w, dw) @ r + gaussian(PAPER_NOISE[0])
        parts += [a, ols17.k_matrix(w + gaussian(PAPER_NOISE[1]), dw + gaussian(PAPER_NOISE[2]))]
        turns.append(rotations(turn_deg) @ turn)
    own = np.broadcast_to(np.eye(3), (PAPER_N, 3, 3))
    s = ols17.Samples(np.arange(PAPER_N) * 0.02, *parts[:2], own, *parts[2:], own)
    ss, sa = ols17.solve_lengths(s), ols17.solve_lengths(s, absolute=True, tip=1e-4)
    ls = ols17.solve_vectors(s, np.swapaxes(turns[0], 1, 2) @ turns[1])
    found = {"LS": np.array(ls), "SS": np.array([ss.r1, ss.r2]), "SA": np.array([sa.r1, sa.r2])}
    return {method: 1e3 * np.linalg.norm(at - PAPER_R, axis=1) for method, at in found.items()}


def paper_table(report: Report, settings: Settings) -> None:
    runs = settings.count(PAPER_RUNS, 10)
    rows = []
    for turn_deg in TURN_ERRORS_DEG:
        found = run_jobs(paper_run, [(k, turn_deg) for k in range(runs)], "center_sim, table I", settings)
        cells = []
        for method in PAPER_MM:
            errors = np.array([f[method] for f in found])
            cells.append(f"{errors[:, 0].mean():.2f} ({errors[:, 0].std():.2f}), {errors[:, 1].mean():.2f} ({errors[:, 1].std():.2f})")
            if turn_deg == 5.0 and not report.quick:
                for i in range(2):
                    report.require_most(f"table I, {method}, r{i + 1}: mean error over the paper's",
                                        errors[:, i].mean() / PAPER_MM[method], 1.5)
        rows.append([f"{turn_deg:g}", *cells])
    report.text(f"Table I of [OLS17] in float64: {runs} runs of {PAPER_N} samples with rates and angular accelerations of 10 rad/s and "
                "10 rad/s^2. Mean error (standard deviation) of r1 and r2, mm. The paper's, with orientation errors of 5 deg: LS 0.22 "
                "(0.09), 0.23 (0.10); SS 0.07 (0.03), 0.07 (0.03); SA 0.08 (0.03), 0.09 (0.04).")
    report.table(["orientation error, deg", *PAPER_MM], rows)


def measure(settings: Settings, report: Report) -> None:
    if not settings.only:
        paper_table(report, settings)
        knock_table(report, settings)
        bias_table(report, settings)
        ls_table(report, settings)
    per_class = -(-settings.count(RUNS, 50) // len(CLASSES))
    per_never = -(-settings.count(NEVER_RUNS, 50) // len(NEVER))
    counts = dict.fromkeys(CLASSES, per_class) | dict.fromkeys(NEVER, per_never)
    outcomes = run_jobs(measure_run, numbered(counts, settings.only), "center_sim", settings)
    by_kind = {kind: [o for o in outcomes if o.kind == kind] for kind in dict.fromkeys(o.kind for o in outcomes)}
    report.text(f"Runs of 20 to 60 s: motions {', '.join(MOTIONS)} in turn, random mounting and lever arms of 5 to 30 cm, rates of 25 to "
                "200 Hz, speed 0.7 to 2.5 rad/s rms, sensors' noise of the papers (0.1 m/s^2, five times that of the rig's). Classes: "
                "noise (2 to 5 times that), bias (up to 0.5 m/s^2 and 1 deg/s), soft (soft tissue up to 1.5 deg rms), all (noise 3, 0.3 "
                "m/s^2, 0.5 deg/s, 1 deg). Cover: truth inside the bound, both sensors. Ratio: median bound over median error. False "
                "ready: `ready` at any time with an error above 10 mm, the bound asked for. Moved: alarms, all false here.")
    groups = {kind: mine for kind, mine in by_kind.items() if kind in CLASSES}
    bounds_table(report, groups)
    motion_table(report, groups)
    report.text("Motions that leave a direction open; every other run with the disturbances of class all.")
    never_table(report, {kind: mine for kind, mine in by_kind.items() if kind in NEVER})
    false = [o for o in outcomes if o.worst_mm > 1e3 * MAX_BOUND_M]
    if false:
        report.table(["false ready", "motion", "largest error while ready, mm"], [[o.run, o.motion, number(o.worst_mm, 1)] for o in false[:40]])
