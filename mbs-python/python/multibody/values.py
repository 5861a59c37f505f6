"""Values that mechanisms give, and how values of Python become the text of a scene."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, NamedTuple

from .errors import MbsError, UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


class State(NamedTuple):
    """A state: coordinates q (nq,) and velocities v (nv,)."""

    q: Array
    v: Array


class Equilibrium(NamedTuple):
    """A static equilibrium. joints, reactions and outputs by name; summary: the object of `mbs equilibrium --json`."""

    state: State
    is_stable: bool | None
    joints: dict[str, list[float]]
    reactions: dict[str, list[float]]
    outputs: dict[str, list[float]]
    summary: dict[str, Any]


class Modes(NamedTuple):
    """Eigenvalues [1/s], damped frequencies [Hz], damping ratios [-] and shapes (n, states) of the linearised motion."""

    eigenvalues: NDArray[np.complex128]
    frequencies: Array
    damping: Array
    shapes: NDArray[np.complex128]
    states: list[str]
    summary: dict[str, Any]


class _Matrices(NamedTuple):
    A: Array
    B: Array
    C: Array
    D: Array
    states: list[str]
    inputs: list[str]
    outputs: list[str]


class Linear(_Matrices):
    """dx/dt = A x + B u, y = C x + D u about a state, in independent coordinates and their rates, then the states of signals.

    unsteady: None about a rest and a motion that is steady in standing axes; else which state accelerates or which equation changes, by how
    much: the matrices hold for the instant."""

    unsteady: dict[str, Any] | None

    def __new__(cls, fields: tuple[Any, ...], unsteady: dict[str, Any] | None) -> Linear:
        self = super().__new__(cls, *fields)
        self.unsteady = unsteady
        return self

    def __getnewargs__(self) -> tuple[Any, ...]:
        return tuple(self), self.unsteady


class Rollout(NamedTuple):
    """Motions from many starts: q (k, steps + 1, nq), v (k, steps + 1, nv), NaN behind a step that failed; ok (k,); errors by start."""

    q: Array
    v: Array
    ok: NDArray[np.bool_]
    errors: dict[int, MbsError]


class Finding(NamedTuple):
    """A finding of the doctor: severity is `fault`, `doubt` or `note`."""

    code: str
    severity: str
    message: str
    remedy: str
    summary: dict[str, Any]


class Derivatives(NamedTuple):
    """Derivatives by positions, by velocities, and by efforts or accelerations, each (nv, nv)."""

    q: Array
    v: Array
    u: Array


class Event(NamedTuple):
    """A contact that began or ended at a time [s]."""

    time: float
    effect: str
    is_made: bool
    end: str | None


class Table:
    """A table of a sweep: one row for each member; `table["tip.x"]` is a column, NaN where a run did not come to a number."""

    def __init__(self, columns: list[str], rows: list[list[str]]) -> None:
        self.columns = columns
        self.rows = rows

    def __len__(self) -> int:
        return len(self.rows)

    def __repr__(self) -> str:
        return f"<Table: {len(self.rows)} members, {len(self.columns)} columns, {len(self.failures)} failed>"

    def __getitem__(self, name: str) -> Array:
        import numpy as np

        if name not in self.columns:
            from ._multibody import nearest_name

            hint = nearest_name(name, self.columns)
            raise UsageError(f"there is no column `{name}`", code="unknown-name", hint=hint, argument="name")
        place = self.columns.index(name)
        return np.array([_number(row[place]) for row in self.rows])

    def frame(self) -> dict[str, Any]:
        """Columns by name, in order: `pandas.DataFrame(table.frame())`. Codes and messages are lists of texts."""
        texts = ("completed", "error", "message")
        places = {name: i for i, name in enumerate(self.columns) if name in texts}
        return {n: [row[places[n]] for row in self.rows] if n in places else self[n] for n in self.columns}

    def to_csv(self) -> str:
        """The text of `table.csv` of `mbs sweep`."""
        import csv
        import io

        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        writer.writerow(self.columns)
        writer.writerows(self.rows)
        return text.getvalue()

    @property
    def failures(self) -> dict[int, tuple[str, str]]:
        """Members, from 1, that were not completed: code and message."""
        done, code, message = (self.columns.index(name) for name in ("completed", "error", "message"))
        return {int(row[0]): (row[code], row[message]) for row in self.rows if row[done] != "true"}


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return float("nan")


def dumps(value: Any, argument: str) -> str:
    """The text of JSON of an argument; numbers and arrays of numpy are taken too."""
    try:
        return json.dumps(value, default=_plain, allow_nan=False)
    except (TypeError, ValueError) as error:
        hint = "write texts, finite numbers, lists and dicts"
        raise UsageError(f"the dict cannot be written: {error}", code="wrong-type", hint=hint, argument=argument) from None


def _plain(value: Any) -> Any:
    if hasattr(value, "tolist"):
        return value.tolist()
    if hasattr(value, "__fspath__"):
        return value.__fspath__()
    if hasattr(value, "items"):
        return dict(value.items())
    raise TypeError(f"{type(value).__name__} cannot be written")
