"""Writes a scene entry by entry. A refusal names the call that made the entry."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, TypeVar

from .errors import SceneError, UsageError

if TYPE_CHECKING:
    from . import Mechanism

Place = tuple[str, int]
"""File and line of a call."""

Name = TypeVar("Name", bound="str | None")


class Handle(str):
    """A name in a scene."""

    __slots__ = ()

    def __repr__(self) -> str:
        return str(self)


class Body(Handle):
    """Name of a body."""


class Joint(Handle):
    """Name of a joint."""


class Effect(Handle):
    """Name of an effect."""


class Coupling(Handle):
    """Name of a coupling."""


class Signal(Handle):
    """Name of a signal."""


class Point(Handle):
    """Name of a point; it stands wherever a place does."""


class Frame(Handle):
    """Name of a frame; it stands wherever a body does."""


class Builder:
    """Builds a mechanism. Keyword arguments are keys of the scene (docs/SCENES.md); a key that is a word of Python gets a `_` behind it.

    A key with the value None is left out. Vectors may be numpy arrays.
    """

    ground = Body("ground")

    def __init__(self, name: str, dimension: Literal[2, 3] = 3) -> None:
        self._begin = _caller()
        self._single: dict[str, dict[str, tuple[Any, Place]]] = {}
        self._entries: dict[str, list[tuple[dict[str, Any], Place]]] = {}
        self._set("scene", {"name": name, "dimension": dimension})

    def body(self, name: str, /, **keys: Any) -> Body:
        """A rigid body: `mass` with `center` and `inertia`, with `rod`, or with `point`."""
        return self._add(Body(name), "body", {"name": name, **keys})

    def joint(self, name: str, kind: str, /, bodies: Sequence[str], **keys: Any) -> Joint:
        """A joint; the second body moves against the first."""
        return self._add(Joint(name), "joint", {"name": name, "kind": kind, "bodies": bodies, **keys})

    def effect(self, name: str, kind: str, /, **keys: Any) -> Effect:
        """A spring, a damper, a force, a motor, a tire, ..."""
        return self._add(Effect(name), "effect", {"name": name, "kind": kind, **keys})

    def coupling(self, name: str, kind: str, /, **keys: Any) -> Coupling:
        """A gear, a rack, a belt, ..."""
        return self._add(Coupling(name), "coupling", {"name": name, "kind": kind, **keys})

    def signal(self, name: str, kind: str, /, **keys: Any) -> Signal:
        """A function of time, of other signals, or of what is measured."""
        return self._add(Signal(name), "signal", {"name": name, "kind": kind, **keys})

    def input(self, name: str, /, *, unit: str | None = None, value: float = 0.0) -> Signal:
        """An input: a signal that is set between steps. `value` is that at the start."""
        return self._add(Signal(name), "signal", {"name": name, "kind": "input", "unit": unit, "value": value})

    def point(self, name: str, /, at: Any) -> Point:
        """A place by name."""
        return self._add(Point(name), "point", {"name": name, "at": at})

    def frame(self, name: str, /, body: str, at: Any, **keys: Any) -> Frame:
        """A named place with axes on a body."""
        return self._add(Frame(name), "frame", {"name": name, "body": body, "at": at, **keys})

    def guide(self, part: str, /, **keys: Any) -> None:
        """Prescribes the motion of a joint or of a body."""
        self._add(None, "guide", {self._kind(part): part, **keys})

    def initial(self, part: str, /, **keys: Any) -> None:
        """Coordinates and rates of a joint, or velocities of a body, at the start."""
        self._add(None, "initial", {self._kind(part): part, **keys})

    def output(self, name: str, quantity: str | None = None, /, **keys: Any) -> str:
        """A channel of the results."""
        return self._add(name, "output", {"name": name, "quantity": quantity, **keys})

    def parameter(self, name: str, value: Any) -> str:
        """A number by name; the name stands wherever a number does."""
        self._set("parameters", {name: value})
        return name

    def gravity(self, value: Any) -> None:
        """Gravity [m/s^2]."""
        self._set("scene", {"gravity": value})

    def duration(self, value: Any) -> None:
        """End of the run [s]."""
        self._set("scene", {"duration": value})

    def solver(self, **keys: Any) -> None:
        """Method and steps."""
        self._set("solver", keys)

    def table(self, table: str, /, **keys: Any) -> None:
        """An entry of any table. `scene`, `parameters`, `road` and `solver` occur once: their keys are set."""
        if table in ("scene", "parameters", "road", "solver"):
            self._set(table, keys)
        else:
            self._add(None, table, keys)

    def text(self) -> str:
        """The scene as JSON: an entry of a list, or a key of a table that occurs once, on a line of its own."""
        return "\n".join(line for line, _ in self._lines())

    def done(self) -> Mechanism:
        """The mechanism, checked."""
        from . import Mechanism

        try:
            return Mechanism(self.text())
        except SceneError as error:
            refusal = error
        raise self._at_call(refusal)

    def _at_call(self, error: SceneError) -> SceneError:
        """The same refusal, with the place of a call."""
        if error.line is None:
            return error
        file, line = [place for _, place in self._lines()][error.line - 1]
        message = error.message.removeprefix(f"{error.file}:{error.line}:{error.column}: ")
        return SceneError(f"{file}:{line}: {message}", error.code, hint=error.hint, file=file, line=line, text=error.text)

    def _kind(self, part: str) -> str:
        def has(table: str) -> bool:
            return any(entry.get("name") == part for entry, _ in self._entries.get(table, ()))

        is_body = isinstance(part, Body) or (type(part) is str and has("body") and not has("joint"))
        return "body" if is_body else "joint"

    def _add(self, name: Name, table: str, keys: dict[str, Any]) -> Name:
        self._entries.setdefault(table, []).append((_plain_keys(keys), _caller()))
        return name

    def _set(self, table: str, keys: dict[str, Any]) -> None:
        place = _caller()
        self._single.setdefault(table, {}).update((key, (value, place)) for key, value in _plain_keys(keys).items())

    def _lines(self) -> Iterator[tuple[str, Place]]:
        from json import dumps

        yield "{", self._begin
        tables = len(self._single) + len(self._entries)
        for number, (table, keys) in enumerate(self._single.items(), 1):
            lines = [(f"{dumps(key)}: {dumps(value)}", place) for key, (value, place) in keys.items()]
            yield from _block(table, "{}", lines, self._begin, is_last=number == tables)
        for number, (table, entries) in enumerate(self._entries.items(), len(self._single) + 1):
            lines = [(dumps(entry), place) for entry, place in entries]
            yield from _block(table, "[]", lines, self._begin, is_last=number == tables)
        yield "}", self._begin


def _block(table: str, brackets: str, lines: list[tuple[str, Place]], begin: Place, *, is_last: bool) -> Iterator[tuple[str, Place]]:
    yield f'"{table}": {brackets[0]}', begin
    for number, (line, place) in enumerate(lines, 1):
        yield (line if number == len(lines) else line + ","), place
    yield brackets[1] + ("" if is_last else ","), begin


def _caller() -> Place:
    """The innermost call from outside this file."""
    frame = sys._getframe(1)
    while frame.f_code.co_filename == __file__ and frame.f_back is not None:
        frame = frame.f_back
    return frame.f_code.co_filename, frame.f_lineno


def _plain_keys(keys: Mapping[str, Any]) -> dict[str, Any]:
    return {key.removesuffix("_"): _plain(value, key) for key, value in keys.items() if value is not None}


def _plain(value: Any, key: str) -> Any:
    """Numbers, texts, lists and tables as JSON has them."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, float) and not math.isfinite(value):
        raise UsageError(f"`{key}` is {value}", code="not-finite", argument=key, hint="write a finite number")
    if isinstance(value, (bool, int, float, str)):
        return value
    if isinstance(value, Mapping):
        return {str(name): _plain(entry, key) for name, entry in value.items()}
    if isinstance(value, Sequence):
        return [_plain(entry, key) for entry in value]
    kind = type(value).__name__
    raise UsageError(f"`{key}` is a {kind}", code="wrong-kind", argument=key, hint="write a number, a text, a list or a dict")
