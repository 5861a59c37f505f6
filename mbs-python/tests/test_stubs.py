"""The stub has the names of the module, and the module those of the stub."""

from __future__ import annotations

import ast
import os
import subprocess
import sys
from pathlib import Path

import multibody as mbs
import pytest
from conftest import needs

STUB = ast.parse(Path(mbs.__file__).with_name("__init__.pyi").read_text())
TYPES_ALONE = {"Array", "Forces", "Place", "Source", "StateLike", "Wrench"}
"""Names for annotations, which the module does not have."""


def names_of(body: list[ast.stmt]) -> set[str]:
    found: set[str] = set()
    for entry in body:
        if isinstance(entry, (ast.ClassDef, ast.FunctionDef)):
            found.add(entry.name)
        elif isinstance(entry, ast.AnnAssign) and isinstance(entry.target, ast.Name):
            found.add(entry.target.id)
        elif isinstance(entry, ast.Assign):
            found |= {target.id for target in entry.targets if isinstance(target, ast.Name)}
        elif isinstance(entry, ast.ImportFrom) and entry.level == 1:
            found |= {alias.asname for alias in entry.names if alias.asname}
    return found


def public(names: object) -> set[str]:
    return {name for name in names if not name.startswith("_")}  # type: ignore[attr-defined]


def classes() -> dict[str, ast.ClassDef]:
    return {entry.name: entry for entry in STUB.body if isinstance(entry, ast.ClassDef)}


def test_names_of_the_module_are_those_of_the_stub() -> None:
    stub = names_of(STUB.body) - TYPES_ALONE
    assert set(vars(mbs)["__all__"]) == stub
    assert {name for name in stub if not hasattr(mbs, name)} == set()


@pytest.mark.parametrize("name", classes())
def test_names_of_a_class_are_those_of_the_stub(name: str) -> None:
    stub = public(names_of(classes()[name].body))
    made = getattr(mbs, name)
    if issubclass(made, tuple):
        # beside its fields, what a tuple carries with it
        own = set(vars(made).get("__annotations__", {}))
        assert set(made._fields) | own == stub
        return
    attributes = public(vars(made))
    assert attributes - stub == set(), "the stub lacks them"
    assert stub - attributes - {"columns", "rows"} == set(), "the class lacks them"


@pytest.mark.parametrize("name", classes())
def test_fields_of_a_tuple_stand_in_the_order_of_the_stub(name: str) -> None:
    made = getattr(mbs, name)
    if not issubclass(made, tuple):
        return
    order = [entry.target.id for entry in classes()[name].body if isinstance(entry, ast.AnnAssign)]  # type: ignore[union-attr]
    assert list(made._fields) == order


def test_every_public_thing_has_a_docstring() -> None:
    things = [getattr(mbs, name) for name in vars(mbs)["__all__"] if name != "__version__"]
    things += [getattr(made, name) for made in (mbs.Mechanism, mbs.Simulation, mbs.Result) for name in public(vars(made))]
    assert [thing for thing in things if not getattr(thing, "__doc__", None)] == []


@pytest.mark.parametrize("checked", [["uses.py"], ["--package", "multibody"]], ids=["uses", "package"])
def test_mypy_takes_the_uses_and_the_package(checked: list[str]) -> None:
    needs("mypy")
    command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", os.devnull, *checked]
    done = subprocess.run(command, capture_output=True, text=True, cwd=Path(__file__).parent, check=False)
    assert done.returncode == 0, done.stdout


def test_the_stub_has_the_documentation_of_the_native_classes() -> None:
    tool = Path(__file__).resolve().parents[1] / "tools" / "stubs.py"
    done = subprocess.run([sys.executable, tool, "--check"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


def test_no_optional_package_is_imported() -> None:
    optional = "ray", "dask", "distributed", "gymnasium", "scipy"
    code = f"import sys, multibody, multibody.parallel; print([n for n in {optional} if n in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"
