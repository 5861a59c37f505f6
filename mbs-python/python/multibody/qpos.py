"""States of an MJCF in its own order: `qpos` and `qvel` of MuJoCo, and q and v of a mechanism."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import Mechanism, State, UsageError

Array = NDArray[np.float64]
SIZES = {"single": (1, 1), "ball": (4, 3), "free": (7, 6)}
"""Numbers in qpos and in qvel."""


def state(mechanism: Mechanism, qpos: ArrayLike, qvel: ArrayLike | None) -> State:
    """q and v of qpos and qvel; joints that others lead are those of the file's."""
    joints = _joints(mechanism)
    positions = _numbers("qpos", qpos, sum(SIZES[joint["motion"]][0] for joint in joints))
    n = sum(SIZES[joint["motion"]][1] for joint in joints)
    speeds = np.zeros(n) if qvel is None else _numbers("qvel", qvel, n)
    q, v = (x.copy() for x in mechanism.reference())
    for joint, own, of_speed in _places(joints):
        of_q, of_v = mechanism.coordinates(joint["joint"])
        position, speed = positions[own], speeds[of_speed]
        first, turn = joint["number"], joint["turn"]
        if joint["motion"] == "single":
            q[of_q.start + first] = joint["sign"] * (position[0] - joint["zero"])
            v[of_v.start + first] = joint["sign"] * speed[0]
            continue
        drawn = _quaternion(turn)
        if joint["motion"] == "free":
            q[of_q.start : of_q.start + 3], v[of_v.start : of_v.start + 3] = position[:3] - joint["at"], speed[:3]
            turned = _product(position[3:], _conjugate(drawn))
        else:
            turned = _product(_product(drawn, position), _conjugate(drawn))
        q[of_q.stop - 4 : of_q.stop] = turned / np.linalg.norm(turned)
        v[of_v.stop - 3 : of_v.stop] = turn @ speed[-3:]
    return State(q, v)


def qpos(mechanism: Mechanism, q: ArrayLike, v: ArrayLike | None) -> tuple[Array, Array]:
    """qpos and qvel of q and v."""
    joints = _joints(mechanism)
    q = _numbers("q", q, mechanism.nq)
    v = np.zeros(mechanism.nv) if v is None else _numbers("v", v, mechanism.nv)
    positions: list[Any] = []
    speeds: list[Any] = []
    for joint in joints:
        of_q, of_v = mechanism.coordinates(joint["joint"])
        first, turn = joint["number"], joint["turn"]
        if joint["motion"] == "single":
            positions.append([joint["sign"] * q[of_q.start + first] + joint["zero"]])
            speeds.append([joint["sign"] * v[of_v.start + first]])
            continue
        turned, drawn = q[of_q.stop - 4 : of_q.stop], _quaternion(turn)
        spin = turn.T @ v[of_v.stop - 3 : of_v.stop]
        if joint["motion"] == "free":
            positions += [q[of_q.start : of_q.start + 3] + joint["at"], _product(turned, drawn)]
            speeds += [v[of_v.start : of_v.start + 3], spin]
        else:
            positions.append(_product(_product(_conjugate(drawn), turned), drawn))
            speeds.append(spin)
    return np.concatenate([np.empty(0), *positions]), np.concatenate([np.empty(0), *speeds])


def _joints(mechanism: Mechanism) -> list[dict[str, Any]]:
    joints: list[dict[str, Any]] | None = mechanism._file_coordinates()  # type: ignore[attr-defined]
    if joints is None:
        hint = "make the mechanism of an MJCF: q and v are the states of all others"
        raise UsageError("there is no qpos: this is no MJCF", code="usage", argument="qpos", hint=hint)
    return [joint | {"at": np.array(joint["at"]), "turn": np.array(joint["turn"])} for joint in joints]


def _places(joints: list[dict[str, Any]]) -> Any:
    """Each joint with its slices of qpos and of qvel."""
    first = [0, 0]
    for joint in joints:
        sizes = SIZES[joint["motion"]]
        yield joint, *(slice(a, a + n) for a, n in zip(first, sizes, strict=True))
        first = [a + n for a, n in zip(first, sizes, strict=True)]


def _numbers(name: str, value: ArrayLike, n: int) -> Array:
    numbers = np.asarray(value, dtype=np.float64)
    if numbers.shape != (n,):
        hint = "give the numbers of one state"
        raise UsageError(f"{name} has the shape {numbers.shape}, and ({n},) is expected", code="wrong-shape", argument=name, hint=hint)
    return numbers


def _quaternion(turn: Array) -> Array:
    """The quaternion (w, x, y, z) of a rotation, by its largest number."""
    m = turn
    squares = np.array([m.trace(), *(2.0 * np.diag(m) - m.trace())])
    largest = int(np.argmax(squares))
    if largest == 0:
        q = np.array([1.0 + squares[0], m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]])
    else:
        i = largest - 1
        j, k = (i + 1) % 3, (i + 2) % 3
        q = np.empty(4)
        q[0] = m[k, j] - m[j, k]
        q[1 + i], q[1 + j], q[1 + k] = 1.0 + squares[largest], m[j, i] + m[i, j], m[k, i] + m[i, k]
    unit: Array = q / np.linalg.norm(q)
    return unit


def _conjugate(q: Array) -> Array:
    return q * [1.0, -1.0, -1.0, -1.0]


def _product(a: Array, b: Array) -> Array:
    w, x, y, z = a
    return np.array([[w, -x, -y, -z], [x, w, -z, y], [y, z, w, -x], [z, -y, x, w]]) @ b
