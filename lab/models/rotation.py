"""Quaternions w x y z, and the layout of states: turns and slides have one number, balls four, free joints seven."""

import numpy as np

SIZE = {"turn": 1, "slide": 1, "planar": 3, "ball": 4, "free": 7}
ROWS = {"turn": 1, "slide": 1, "planar": 3, "ball": 3, "free": 6}


def product(a, b):
    w, x, y, z = a
    p, i, j, k = b
    return np.array([w * p - x * i - y * j - z * k, w * i + x * p + y * k - z * j, w * j - x * k + y * p + z * i, w * k + x * j - y * i + z * p])


def matrix(q):
    w, x, y, z = q / np.linalg.norm(q)
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ])


def quaternion(r):
    """Of a rotation matrix, w not negative; the largest component is divided by, so none is lost."""
    k = np.array([
        [r[0, 0] - r[1, 1] - r[2, 2], r[0, 1] + r[1, 0], r[0, 2] + r[2, 0], r[2, 1] - r[1, 2]],
        [r[0, 1] + r[1, 0], r[1, 1] - r[0, 0] - r[2, 2], r[1, 2] + r[2, 1], r[0, 2] - r[2, 0]],
        [r[0, 2] + r[2, 0], r[1, 2] + r[2, 1], r[2, 2] - r[0, 0] - r[1, 1], r[1, 0] - r[0, 1]],
        [r[2, 1] - r[1, 2], r[0, 2] - r[2, 0], r[1, 0] - r[0, 1], r[0, 0] + r[1, 1] + r[2, 2]],
    ])
    column = (k + np.eye(4))[:, np.argmax(np.diag(k))]
    q = column[[3, 0, 1, 2]] / np.linalg.norm(column)
    return -q if q[0] < 0 else q


def of_vector(u):
    """The rotation by |u| about u."""
    angle = np.linalg.norm(u)
    return np.concatenate([[np.cos(angle / 2)], np.sinc(angle / (2 * np.pi)) * u / 2])


def drift(kinds, y, rates, parents):
    """The rates of the coordinates: of a quaternion half its product with the rate on its left.

    A free joint's rate is global, as its rotation is. A ball's rotation is in axes of the parent; `parents` has B for each ball, the
    parent's rotation since the reference, so B^T turns the global rate into these axes.
    """
    out, i, k, parents = [], 0, 0, iter(parents)
    for kind in kinds:
        if kind == "free":
            out.append(rates[k:k + 3])
        if kind in ("free", "ball"):
            turn = rates[k + ROWS[kind] - 3:k + ROWS[kind]]
            turn = turn if kind == "free" else next(parents).T @ turn
            start = i + SIZE[kind] - 4
            out.append(product(np.concatenate([[0.0], turn]), y[start:start + 4]) / 2)
        else:
            out.append(rates[k:k + ROWS[kind]])
        i, k = i + SIZE[kind], k + ROWS[kind]
    return np.concatenate(out) if out else np.zeros(0)


def random_state(kinds, seed):
    """Turns within 1 rad, slides within 0.1 m, rates within 1; the same numbers for a seed on every machine."""
    draw = np.random.default_rng(seed)
    values = {
        "turn": lambda: draw.uniform(-1, 1, 1),
        "slide": lambda: draw.uniform(-0.1, 0.1, 1),
        "planar": lambda: draw.uniform(-0.5, 0.5, 3),
        "ball": lambda: of_vector(draw.uniform(-0.7, 0.7, 3)),
        "free": lambda: np.concatenate([draw.uniform(-0.5, 0.5, 3), of_vector(draw.uniform(-0.7, 0.7, 3))]),
    }
    y = np.concatenate([values[kind]() for kind in kinds]) if kinds else np.zeros(0)
    rows = sum(ROWS[kind] for kind in kinds)
    return y, draw.uniform(-1, 1, rows), draw.uniform(-1, 1, rows)
