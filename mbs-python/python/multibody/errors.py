"""Errors of the package: each has a code that does not change, what it is about, and what to do."""

from __future__ import annotations

from typing import Any

FIELDS = ("code", "time", "joint", "body", "hint", "file", "line", "column", "text", "argument", "gap")


class MbsError(Exception):
    """What every error of the package has; a field that an error has no value for is None.

    code: what it is, in a word that does not change. time: time in the run [s]. joint, body: what it is about. hint: what to do.
    file, line, column, text: its place. argument: the argument that is refused. gap: how far a start is open [m or rad].
    """

    code: str
    time: float | None
    joint: str | None
    body: str | None
    hint: str | None
    file: str | None
    line: int | None
    column: int | None
    text: str | None
    argument: str | None
    gap: float | None

    def __init__(self, message: str, code: str = "usage", **fields: Any) -> None:
        super().__init__(message)
        self.code = code
        for name in FIELDS[1:]:
            setattr(self, name, fields.get(name))

    @property
    def message(self) -> str:
        """What is wrong, without the hint."""
        return str(self.args[0])

    def __str__(self) -> str:
        return self.message if not self.hint else f"{self.message}\nhint: {self.hint}"

    def __reduce__(self) -> tuple[Any, ...]:
        fields = {name: getattr(self, name) for name in FIELDS if getattr(self, name) is not None}
        return _restored, (type(self), self.message, fields)


def _restored(kind: type[MbsError], message: str, fields: dict[str, Any]) -> MbsError:
    return kind(message, **fields)


class SceneError(MbsError, ValueError):
    """A scene, a model or a table that is refused, with its place."""


class StartError(MbsError):
    """A mechanism that does not come together, or has no equilibrium."""


class StopError(MbsError, ArithmeticError):
    """A step that cannot be made."""


class UsageError(MbsError, ValueError):
    """An argument that is refused: a shape, a name, a method that cannot."""


class BusyError(MbsError, RuntimeError):
    """Another thread uses the simulation."""


class ModelWarning(UserWarning):
    """Something in a model can act and was left out; `Mechanism.import_report` lists it."""
