"""Does a remembered hinge still hold? Reference of lib/remember in float64; docs/METHOD_HUB.md, section 4, has the equations.

    looks = list(look_at(ticks1, ticks2, kept))
    decide(looks, kept)

Thresholds are those of the library; `measure.py remember` says what they were chosen on.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from .native_sensor import Ticks

REST_RAD2_S2 = 0.3  # |w1|^2 + |w2|^2 at which a tick counts half
BLOCK_MIN_S = 0.3
BLOCK_S = 5.0  # in which the heading stands still
LOOK_TICKS = 5
SETTLED_S = 3.0  # a sensor has run for so long
PAST_MAX_S = 30.0
RATE_SMOOTHING_S = 0.1
HEADINGS = 24  # that are tried
LONG_S = {"turn": 4.8, "rate": 1.1, "lever": 1.8}  # how long a residual of each kind lasts
LEAST = {"turn": np.radians(4.0) ** 2, "rate": 0.01**2, "lever": 0.014**2}  # of its mean square per direction
LEVER_M = (0.015, 0.03)  # how far kept levers may be off, rigid and functional
SPEED_NOISE2 = 6e-4  # of the centre's velocity, (m/s)^2
TIES = 0.005  # damping of the step
STEPS = 3  # of Newton for the heading


@dataclass
class Kept:
    axis1: np.ndarray
    axis2: np.ndarray
    bounds_deg: tuple[float, float]
    r1: np.ndarray | None  # None: levers are not known
    r2: np.ndarray | None
    rigid: bool


@dataclass
class Look:
    """What the motion up to one moment says."""

    t_s: float
    motion_s: float
    off_deg: np.ndarray  # (2,) how far the axes want to be elsewhere
    sigma_deg: np.ndarray  # (2,) standard deviation of that, in the direction known least
    lack: float  # what is left of the centre's motion, share
    speed2: float  # mean square of the centre's velocity, both sides
    evidence: float  # for the pairing of signs
    bend_rad: float  # bending within a block, rms
    sizes: dict[str, float]


def basis(axis: np.ndarray) -> np.ndarray:
    """[u v j], right-handed, u and v as lib/math/sphere.h has them."""
    x, y, z = axis
    sign = 1.0 if z >= 0.0 else -1.0
    a = -1.0 / (sign + z)
    b = x * y * a
    return np.column_stack([[1.0 + sign * x * x * a, sign * b, -sign * x], [b, sign + y * y * a, -y], axis])


def parts(a: np.ndarray, b: np.ndarray, w: np.ndarray) -> np.ndarray:
    """(N, 3, K, L): a' Rz b = cos of the first + sin of the second + the third, for columns a (N, 3, K) and b (N, 3, L)."""
    def pair(i: int, j: int) -> np.ndarray:
        return np.einsum("n,nk,nl->nkl", w, a[:, i], b[:, j])

    return np.stack([pair(0, 0) + pair(1, 1), pair(1, 0) - pair(0, 1), pair(2, 2)], axis=1)


@dataclass
class Sums:
    """One block."""

    w: float = 0.0
    turn: np.ndarray | float = 0.0  # (3, 3, 3) parts
    turn_k: np.ndarray | float = 0.0  # (2,) coupling of axis 2 and heading
    rate: np.ndarray | float = 0.0
    rate_k: np.ndarray | float = 0.0
    rate1: np.ndarray | float = 0.0  # (3, 3)
    rate2: np.ndarray | float = 0.0
    lever: np.ndarray | float = 0.0  # (3,) parts
    gain: float = 0.0  # |B1|^2 + |B2|^2
    power: float = 0.0  # y1^2 + y2^2


def add(sums: Sums, one: Sums) -> None:
    for name in sums.__dataclass_fields__:
        setattr(sums, name, getattr(sums, name) + getattr(one, name))


def smoothed(rate2: np.ndarray, dt_s: np.ndarray) -> np.ndarray:
    out, last = np.zeros(len(rate2)), 0.0
    for n, dt in enumerate(dt_s):
        last += dt / (dt + RATE_SMOOTHING_S) * (rate2[n] - last)
        out[n] = last
    return out


def tick_sums(ticks1: Ticks, ticks2: Ticks, kept: Kept, begin: int = 0) -> list[Sums]:
    """Of each tick; those before `begin` were not taken in."""
    e1, e2 = basis(kept.axis1), basis(kept.axis2)
    w1, w2, dt_s = ticks1.gyr, ticks2.gyr, ticks1.dt_s
    m = (w1**2).sum(axis=1) + (w2**2).sum(axis=1)
    m[begin:] = smoothed(m[begin:], dt_s[begin:])
    w = dt_s * m / (m + REST_RAD2_S2)
    wr = w / (m + REST_RAD2_S2)
    a, b, p, q = ticks1.turn @ e1, ticks2.turn @ e2, ticks1.rate @ e1, ticks2.rate @ e2
    if kept.r1 is None:
        y1 = y2 = np.zeros_like(w1)
    else:
        y1, y2 = ticks1.velocity - ticks1.lever @ kept.r1, ticks2.velocity - ticks2.lever @ kept.r2
    turn, rate = parts(a, b, w), parts(p, q, wr)
    lever = parts(y1[:, :, None], y2[:, :, None], w)[:, :, 0, 0]

    def coupling(c: np.ndarray, weight: np.ndarray) -> np.ndarray:
        return weight[:, None] * (c[:, 1, :2] * c[:, :1, 2] - c[:, 0, :2] * c[:, 1:2, 2])

    turn_k, rate_k = coupling(b, w), coupling(q, wr)
    rate1, rate2 = np.einsum("n,nik,nil->nkl", wr, p, p), np.einsum("n,nik,nil->nkl", wr, q, q)
    power = w * ((y1**2).sum(axis=1) + (y2**2).sum(axis=1))
    gain = w * ((ticks1.lever**2).sum(axis=(1, 2)) + (ticks2.lever**2).sum(axis=(1, 2)))
    return [Sums(w[n], turn[n], turn_k[n], rate[n], rate_k[n], rate1[n], rate2[n], lever[n], gain[n], power[n])
            for n in range(len(w))]


def at(part: np.ndarray, heading: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Value and two derivatives by the heading."""
    c, s = np.cos(heading), np.sin(heading)
    return c * part[0] + s * part[1] + part[2], -s * part[0] + c * part[1], -c * part[0] - s * part[1]


def costs(sums: Sums, heading: float, pairing: float = 1.0) -> dict[str, float]:
    """Sums of squares of each kind; pairing -1: of the other one."""
    turn, rate, lever = (at(part, heading)[0] for part in (sums.turn[:, 2, 2], sums.rate[:, 2, 2], sums.lever))
    return {"turn": 2.0 * sums.w - 2.0 * pairing * turn, "rate": sums.rate1[2, 2] + sums.rate2[2, 2] - 2.0 * pairing * rate,
            "lever": sums.power - 2.0 * lever}


def sizes_of(cost: dict[str, float], w: float) -> dict[str, float]:
    return {kind: max(cost[kind] / (2.0 * w), LEAST[kind]) for kind in LEAST}


def score(sums: Sums, heading: float, has_levers: bool, pairing: float = 1.0) -> float:
    sizes = sizes_of(costs(sums, heading, pairing), sums.w)
    return sum(sums.w / LONG_S[kind] * np.log(sizes[kind] / LEAST[kind]) for kind in LEAST if has_levers or kind != "lever")


def best_heading(sums: Sums, has_levers: bool, pairing: float = 1.0) -> tuple[float, float]:
    grid = 2.0 * np.pi * np.arange(HEADINGS) / HEADINGS
    scores = [score(sums, heading, has_levers, pairing) for heading in grid]
    return float(grid[int(np.argmin(scores))]), float(min(scores))


def weights_of(sizes: dict[str, float], has_levers: bool) -> dict[str, float]:
    return {kind: (1.0 / (sizes[kind] * LONG_S[kind]) if has_levers or kind != "lever" else 0.0) for kind in LEAST}


def settle(sums: Sums, heading: float, has_levers: bool) -> float:
    """Newton for the heading, by weights that follow the residuals."""
    for _ in range(STEPS):
        lam = weights_of(sizes_of(costs(sums, heading), sums.w), has_levers)
        g = h = 0.0
        for kind, part in (("turn", sums.turn[:, 2, 2]), ("rate", sums.rate[:, 2, 2]), ("lever", sums.lever)):
            _, first, second = at(part, heading)
            g, h = g - lam[kind] * first, h - lam[kind] * second
        if h > 0.0:
            heading -= float(np.clip(g / h, -0.2, 0.2))
    return heading


def system(sums: Sums, heading: float, lam: dict[str, float]) -> tuple[np.ndarray, np.ndarray]:
    """H (4, 4) and g (4,) of the tilts, the heading eliminated."""
    h, g = np.zeros((5, 5)), np.zeros(5)
    eye = sums.w * np.eye(3)
    for kind, part, own1, own2, k in (("turn", sums.turn, eye, eye, sums.turn_k), ("rate", sums.rate, sums.rate1, sums.rate2, sums.rate_k)):
        m, d, dd = at(part, heading)
        block = np.zeros((5, 5))
        block[:2, :2], block[2:4, 2:4], block[:2, 2:4] = own1[:2, :2], own2[:2, :2], -m[:2, :2]
        block[:2, 4], block[2:4, 4], block[4, 4] = -d[:2, 2], k, -dd[2, 2]
        h += lam[kind] * (np.triu(block) + np.triu(block, 1).T)
        g += lam[kind] * np.concatenate([own1[:2, 2] - m[:2, 2], own2[:2, 2] - m[2, :2], [-d[2, 2]]])
    _, d, dd = at(sums.lever, heading)
    h[4, 4] -= lam["lever"] * dd
    g[4] -= lam["lever"] * d
    if h[4, 4] > 0.0:
        g = g - h[:, 4] * g[4] / h[4, 4]
        h = h - np.outer(h[:, 4], h[4, :]) / h[4, 4]
    return h[:4, :4], g[:4]


def bending(sums: Sums, heading: float) -> float:
    """Variance of the angle of bending times the motion, rad^2 s."""
    m = at(sums.turn, heading)[0]
    return max(2.0 * (sums.w - 0.5 * np.hypot(m[0, 0] + m[1, 1], m[1, 0] - m[0, 1])), 0.0)


def look_at(ticks1: Ticks, ticks2: Ticks, kept: Kept, begin: int = 0, most_s: float = 60.0) -> Iterator[Look]:
    """Looks at the ticks from number `begin` on, as long as motion is below `most_s`."""
    has_levers = kept.r1 is not None
    block, block_s = Sums(), 0.0
    h_past, g_past, evidence_past = np.zeros((4, 4)), np.zeros(4), 0.0
    past = {"w": 0.0, "turn": 0.0, "rate": 0.0, "lever": 0.0, "gain": 0.0, "power": 0.0, "bend2": 0.0}
    n = min(len(ticks1.t_s), len(ticks2.t_s))
    settled = np.minimum(ticks1.since_s[:n], ticks2.since_s[:n]) >= np.float32(SETTLED_S)
    begin = max(begin, int(np.argmax(settled)))
    count = 0
    for number, one in enumerate(tick_sums(ticks1, ticks2, kept, begin)[begin:n], begin):
        add(block, one)
        block_s += ticks1.dt_s[number]
        count += 1
        closes = block_s >= BLOCK_S
        if count < LOOK_TICKS and not closes:
            continue
        count = 0
        if block.w < BLOCK_MIN_S:
            if closes:
                block, block_s = Sums(), 0.0
            continue
        start, this = best_heading(block, has_levers)
        _, other = best_heading(block, has_levers, -1.0)
        heading = settle(block, start, has_levers)
        cost = costs(block, heading)
        w = past["w"] + block.w
        sizes = sizes_of({kind: past[kind] + cost[kind] for kind in LEAST}, w)
        h, g = system(block, heading, weights_of(sizes, has_levers))
        evidence = evidence_past + 0.5 * (other - this)
        total = h_past + h
        d, sigma = solve(total, g_past + g)
        gain, power = past["gain"] + block.gain, past["power"] + block.power
        spare = LEVER_M[0 if kept.rigid else 1] ** 2 / 3.0 * gain
        bend2 = past["bend2"] + bending(block, heading)
        yield Look(float(ticks1.t_s[number]), w, d, sigma, max(past["lever"] + cost["lever"] - spare - SPEED_NOISE2 * w, 0.0) / max(power, 1e-9), power / w, evidence,
                   float(np.sqrt(bend2 / w)), sizes)
        if closes:
            h_past, g_past, evidence_past = total, g_past + g, evidence
            past = {"w": w, **{kind: past[kind] + cost[kind] for kind in LEAST}, "gain": gain, "power": power, "bend2": bend2}
            block, block_s = Sums(), 0.0
            if w > PAST_MAX_S:
                h_past, g_past, evidence_past = h_past / 2.0, g_past / 2.0, evidence_past / 2.0
                past = {name: value / 2.0 for name, value in past.items()}
        if w > most_s:
            return


def solve(h: np.ndarray, g: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """How far the axes want to go, and how well that is known, deg."""
    damped = h + TIES * np.diag(np.diag(h)) + 1e-6 * np.eye(4)
    try:
        np.linalg.cholesky(damped)
    except np.linalg.LinAlgError:  # at a heading that is no minimum: nothing is known
        return np.zeros(2), np.full(2, 90.0)
    d, c = -np.linalg.solve(damped, g), np.linalg.inv(damped)
    off = np.degrees([np.hypot(d[0], d[1]), np.hypot(d[2], d[3])])
    return off, np.degrees(np.sqrt([np.linalg.eigvalsh(c[:2, :2])[-1], np.linalg.eigvalsh(c[2:, 2:])[-1]]))


MOTION_MIN_S, AGREED_MIN, SIGMAS = 2.0, 3, 0.5
BEND_MIN_RAD, SPEED_MIN_M_S = np.radians(10.0), (0.063, 0.08)
MOST_DEG, OFF_DEG = (3.0, 10.0), (3.0, 6.0)  # rigid, functional: confirmed below, dropped above
LACK_MAX, LACK_OFF, EVIDENCE_MIN, EVIDENCE_OFF = 0.12, 0.3, 1.5, -3.0


def decide(looks: list[Look], kept: Kept) -> tuple[str, Look | None]:
    """`confirmed`, `dropped` or `remembered`, and the look that decided."""
    kind, agreed = (0 if kept.rigid else 1), {"confirmed": 0, "dropped": 0}
    for look in looks:
        if look.motion_s < MOTION_MIN_S:
            continue
        bends, moves = look.bend_rad >= BEND_MIN_RAD, kept.r1 is not None and np.sqrt(look.speed2) >= SPEED_MIN_M_S[kind]
        least, most = (look.off_deg - SIGMAS * look.sigma_deg).max(), (look.off_deg + SIGMAS * look.sigma_deg).max()
        says = {"dropped": (moves and look.lack > LACK_OFF) or look.evidence < EVIDENCE_OFF or (bends and least > OFF_DEG[kind]),
                "confirmed": bends and moves and look.lack <= LACK_MAX and most <= MOST_DEG[kind] and look.evidence >= EVIDENCE_MIN}
        for word in ("dropped", "confirmed"):
            agreed[word] = agreed[word] + 1 if says[word] else 0
            if agreed[word] >= AGREED_MIN:
                return word, look
    return "remembered", None
