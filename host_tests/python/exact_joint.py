"""A joint that obeys rigid-body kinematics exactly, for tests: rates and accelerations are drawn, not differenced.

With r from the joint to the sensor, a = f + dw x r + w x (w x r), [OLS17] (1) and (2); f is what the joint feels.
"""

import numpy as np

GRAVITY = np.array([0.0, 0.0, 9.81])


def felt_at(force, w, dw, r):
    """What a sensor at r feels, by cross products; all (N, 3) but r."""
    return force + np.cross(dw, r) + np.cross(w, np.cross(w, r))


def printed_k(w, dw):
    """K(w, dw) element by element, [OLS17] (5)."""
    (x, y, z), (a, b, c) = w.T, dw.T
    return np.moveaxis(np.array([[-y * y - z * z, x * y - c, x * z + b],
                                 [x * y + c, -x * x - z * z, y * z - a],
                                 [x * z - b, y * z + a, -x * x - y * y]]), 2, 0)


def random_turns(rng, n):
    """(n, 3, 3): rotations, sensor to earth, anywhere."""
    q, r = np.linalg.qr(rng.standard_normal((n, 3, 3)))
    q = q * np.sign(np.einsum("nii->ni", r))[:, None, :]
    return q * np.sign(np.linalg.det(q))[:, None, None]


def joint_force(rng, n):
    """(n, 3): what the joint feels, in earth; accelerations of 1 m/s^2."""
    return GRAVITY + rng.standard_normal((n, 3))


def sensor(rng, force, r):
    """a, K, turn to earth of a sensor at r from a joint that feels `force` (N, 3), in earth; rates of 3 rad/s."""
    n = len(force)
    turn, w, dw = random_turns(rng, n), 3.0 * rng.standard_normal((n, 3)), 20.0 * rng.standard_normal((n, 3))
    own = np.einsum("nji,nj->ni", turn, force)
    return felt_at(own, w, dw, r), printed_k(w, dw), turn


def about_z(angle):
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def central_difference(function, x, h=1e-6):
    """Slopes of function(x) (N,) by x (M,), (N, M)."""
    return np.stack([(function(x + h * step) - function(x - h * step)) / (2.0 * h) for step in np.eye(len(x))], axis=1)
