"""The health of one sensor in float64: blocks, the scale of the gyroscope, ways to read the rates. Written for clarity, apart from the C library.

With the right rates gravity stays where it is. A block of a tenth of a second has the turn over it and the mean specific force, turned back to its begin.

Scale: low-passes of the force in a frame that does not turn, with time constants of 2 and 10 s, differ by e. If the true rates are s w + b, what both are
changes by J (s - 1, b); e = 0 is solved by weighted least squares. A block in which e is 3 % of gravity counts half.

Frames: windows of 40 blocks; a way M of 48 leaves open the share of the means of four parts of R a that is not common to them, R by the turns M th.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import permutations, product

import numpy as np

BLOCK_S = 0.099
FAST_S, SLOW_S, WARM_S = 2.0, 10.0, 4.0
EASY_SHARE, SPREAD, BIAS_RAD_S = 0.03, 0.01, 0.01
LEFT_MIN = 0.02
BLOCKS, PARTS = 40, 4


@dataclass
class Block:
    turn: np.ndarray  # sum of w dt
    angle: np.ndarray  # rotation vector over the block
    acc: np.ndarray  # mean as it stands
    back: np.ndarray  # mean, each turned back to the begin
    length_s: float


def rotation(v: np.ndarray) -> np.ndarray:
    """The matrix of a rotation vector."""
    angle = float(np.linalg.norm(v))
    if angle < 1e-12:
        return np.eye(3) + cross_matrix(v)
    k = cross_matrix(v / angle)
    return np.eye(3) + np.sin(angle) * k + (1.0 - np.cos(angle)) * k @ k


def cross_matrix(v: np.ndarray) -> np.ndarray:
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def vector_of(matrix: np.ndarray) -> np.ndarray:
    """The rotation vector of a matrix, of less than half a turn."""
    axis = np.array([matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0], matrix[1, 0] - matrix[0, 1]])
    sine, cosine = 0.5 * np.linalg.norm(axis), 0.5 * (np.trace(matrix) - 1.0)
    return 0.5 * axis if sine < 1e-12 else axis / (2.0 * sine) * np.arctan2(sine, cosine)


def blocks_of(t_s: np.ndarray, gyr: np.ndarray, acc: np.ndarray) -> list[Block]:
    """Turns within a block exactly, reading by reading: the library does them to second order."""
    found: list[Block] = []
    members: list[int] = []
    length_s = 0.0
    for k in range(1, len(t_s)):
        members.append(k)
        length_s += t_s[k] - t_s[k - 1]
        if length_s >= BLOCK_S:
            turned, back = np.eye(3), np.zeros(3)
            for i in members:
                th = gyr[i] * (t_s[i] - t_s[i - 1])
                back += turned @ rotation(0.5 * th) @ acc[i]
                turned = turned @ rotation(th)
            turn = sum(gyr[i] * (t_s[i] - t_s[i - 1]) for i in members)
            found.append(Block(turn, vector_of(turned), acc[members].mean(axis=0), back / len(members), length_s))
            members, length_s = [], 0.0
    return found


@dataclass
class Past:
    """A low-pass, and its derivatives with respect to scale and bias as four columns: bias x, y, z, scale."""

    g: np.ndarray
    by: np.ndarray  # (3, 4)

    def take(self, force: np.ndarray, q: float) -> None:
        self.g = self.g + q * (force - self.g)
        self.by = (1.0 - q) * self.by

    def turn(self, block: Block) -> None:
        back = rotation(block.angle).T
        self.g = back @ self.g
        self.by = back @ self.by
        self.by[:, :3] += block.length_s * cross_matrix(self.g)
        self.by[:, 3] -= np.cross(block.angle, self.g)


def scale_of(blocks: list[Block]) -> tuple[float, float]:
    """The scale and its standard deviation; nothing is taken off on the way."""
    fast, slow = Past(blocks[0].back, np.zeros((3, 4))), Past(blocks[0].back, np.zeros((3, 4)))
    squares, products, left, weights, length_s, since_s = np.zeros((4, 4)), np.zeros(4), 0.0, 0.0, 0.0, 0.0
    for block in blocks:
        since_s += block.length_s
        fast.take(block.back, -np.expm1(-block.length_s / min(FAST_S, since_s)))
        slow.take(block.back, -np.expm1(-block.length_s / min(SLOW_S, since_s)))
        if since_s >= WARM_S:
            g2 = slow.g @ slow.g
            e, jacobian = (fast.g - slow.g) / np.sqrt(g2), (fast.by - slow.by) / np.sqrt(g2)
            weight = 1.0 / (1.0 + e @ e / EASY_SHARE**2)
            squares += weight * jacobian.T @ jacobian
            products -= weight * jacobian.T @ e
            left += weight * e @ e
            weights += weight
            length_s += block.length_s
        fast.turn(block)
        slow.turn(block)
    unit = length_s / (weights * FAST_S * SPREAD**2)
    matrix = unit * squares + np.diag([1.0 / BIAS_RAD_S**2] * 3 + [1.0])
    x = np.linalg.solve(matrix, unit * products)
    share = max((unit * left - unit * products @ x) / max(3.0 * length_s / FAST_S, 1.0), LEFT_MIN)
    return 1.0 + x[3], float(np.sqrt(share * np.linalg.inv(matrix)[3, 3]))


def ways() -> list[np.ndarray]:
    """The 48 signed permutations, in the library's order: first those that leave x, y, z where they are; signs of x change fastest."""
    found = []
    for order in permutations(range(3)):
        for signs in product((1.0, -1.0), repeat=3):
            matrix = np.zeros((3, 3))
            for row in range(3):
                matrix[row, order[row]] = signs[2 - row]
            found.append(matrix)
    return found


def open_by(window: list[Block], way: np.ndarray) -> float:
    """What a way leaves open in a window."""
    turned, means = np.eye(3), np.zeros((PARTS, 3))
    for k, block in enumerate(window):
        half = rotation(0.5 * way @ block.turn)
        means[k * PARTS // BLOCKS] += turned @ half @ block.acc
        turned = turned @ half @ half
    return float(np.sum((means - means.mean(axis=0)) ** 2) / np.sum(means**2))
