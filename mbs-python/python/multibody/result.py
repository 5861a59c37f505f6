"""What a run gives."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from .errors import MbsError, UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]


class Result(Mapping[str, Any]):
    """Outputs of a run over time, by name: `result["tip.x"]`. A run that stops early is a result too: see `completed` and `check`.

    t: instants of the rows [s], (n,). columns: names of the outputs. array: all of them, (n, columns). units: their units.
    summary: the object of `mbs run --json`. notes: what the user should know. error: why the run stopped early, else None.
    """

    t: Array
    columns: list[str]
    units: dict[str, str]
    summary: dict[str, Any]
    notes: list[str]
    error: MbsError | None

    def __init__(
        self,
        t: Array,
        data: Array,
        columns: list[str],
        units: list[str],
        summary: dict[str, Any],
        notes: list[str],
        error: MbsError | None,
        record: Any,
        run: tuple[Any, dict[str, Any]],
    ) -> None:
        self.t = t
        self.columns = columns
        self.units = dict(zip(columns, units))
        self.summary = summary
        self.notes = notes
        self.error = error
        self._data = data
        self._places = {name: i for i, name in enumerate(columns)}
        self._record = record
        self._run = run

    @property
    def array(self) -> Array:
        """All outputs, (n, columns)."""
        return self._data.T

    def __getitem__(self, name: str) -> Array:
        try:
            return self._data[self._places[name]]  # type: ignore[no-any-return]
        except KeyError:
            from ._multibody import nearest_name

            hint = nearest_name(name, self.columns)
            message = f"there is no output `{name}`"
            raise UnknownOutput(message, code="unknown-name", hint=hint, argument="name") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __len__(self) -> int:
        return len(self.columns)

    def __repr__(self) -> str:
        end = "completed" if self.completed else "stopped"
        return f"<Result: {end} at {self.summary['end_time']} s, {len(self.t)} rows, {len(self.columns)} outputs>"

    @property
    def completed(self) -> bool:
        """Was the whole duration reached?"""
        return bool(self.summary["completed"])

    def check(self) -> Result:
        """This result; raises the error of a run that stopped early."""
        if self.error is not None:
            raise self.error
        return self

    @property
    def energy(self) -> dict[str, float]:
        """The energy invariant and its errors [J]."""
        return self.summary["energy"]  # type: ignore[no-any-return]

    @property
    def violation(self) -> dict[str, float]:
        """Largest residuals of the constraints: position, velocity, acceleration."""
        return self.summary["violation"]  # type: ignore[no-any-return]

    @property
    def contacts(self) -> list[dict[str, Any]]:
        """Contacts of bumpers, limits and tires that were made or broken: time [s], effect, event."""
        return self.summary.get("contacts", [])  # type: ignore[no-any-return]

    def frame(self) -> dict[str, Array]:
        """Time and outputs by name, in order: `pandas.DataFrame(result.frame())`."""
        return {"t": self.t, **{name: self[name] for name in self.columns}}

    def page(self) -> str:
        """A page (HTML) that stands alone: motion, plots, energies, peaks. A result from another process runs once more for it."""
        if self._record is None:
            mechanism, settings = self._run
            self._record = mechanism.run(**settings)._record
        return self._record.page()  # type: ignore[no-any-return]

    def _repr_html_(self) -> str:
        return embedded(self.page())

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_record": None}


def embedded(page: str) -> str:
    """A page within that of a notebook."""
    from html import escape

    return f'<iframe srcdoc="{escape(page)}" width="100%" height="720" style="border:0"></iframe>'


class UnknownOutput(UsageError, KeyError):
    """An output that is not there."""
