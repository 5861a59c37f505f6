"""Rollouts under external forces."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from . import Mechanism, Rollout, UsageError


def rollout(
    mechanism: Mechanism,
    f_ext: Mapping[str, Any],
    q: ArrayLike,
    v: ArrayLike,
    u: ArrayLike | None,
    dt: float,
    *,
    steps: int | None,
    **words: Any,
) -> Rollout:
    """Motions under forces that are inputs: each (force, moment), or (steps, 6), is held over each step."""
    forces = {name: _numbers(name, value) for name, value in f_ext.items()}
    counts = [len(force) for force in forces.values() if force.ndim == 2] + ([] if steps is None else [steps])
    extended = mechanism.with_forces(*forces)
    start, own, places = extended._force_inputs()  # type: ignore[attr-defined]
    if u is None:
        if not counts:
            raise UsageError("nothing says how many steps are to be made", code="no-count", argument="steps", hint="give u, or steps")
        u = np.tile(np.array(start)[own], (counts[0], 1))
    given = np.asarray(u, dtype=np.float64)
    if given.ndim not in (2, 3) or given.shape[-1] != len(own):
        hint = "give a number for each of: " + (", ".join(mechanism.inputs) or "nothing, there are no inputs")
        message = f"u has the shape {given.shape}, and (steps, {len(own)}) is expected"
        raise UsageError(message, code="wrong-shape", argument="u", hint=hint)
    row = np.empty((*given.shape[:-1], len(start)))
    row[..., own] = given
    for name, force in forces.items():
        if force.ndim == 2 and len(force) != given.shape[-2]:
            message = f"f_ext of `{name}` is of {len(force)} steps, and u of {given.shape[-2]}"
            raise UsageError(message, code="wrong-shape", argument="f_ext", hint="give a row for each step")
        inputs, parts = places[name]
        row[..., inputs] = force[..., parts]
    return extended.rollout(q, v, row, dt, steps=steps, **words)


def _numbers(name: str, value: Any) -> np.ndarray[Any, np.dtype[np.float64]]:
    """A force and its moment, (6,), or one for each step, (steps, 6)."""
    try:
        numbers = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError):
        numbers = np.array([])
    if numbers.shape == (2, 3):
        return numbers.reshape(6)
    if numbers.ndim in (1, 2) and numbers.shape[-1] == 6:
        return numbers
    hint = "give (force, moment), three numbers each, or (steps, 6)"
    raise UsageError(f"f_ext of `{name}` is no force and moment", code="wrong-shape", argument="f_ext", hint=hint)
