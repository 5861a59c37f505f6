"""Examples run, and notebooks are made of them."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from conftest import needs

ROOT = Path(__file__).resolve().parents[1]
EXAMPLES = sorted((ROOT / "examples").glob("*.py"))
NEEDED = {"identify_damper": "scipy"}
LONGEST = 60.0
"""Time of a notebook [s]; its kernel starts in some seconds."""


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_has_its_main_figure(path: Path) -> None:
    needs(NEEDED.get(path.stem, "numpy"))
    done = subprocess.run([sys.executable, path], capture_output=True, text=True, cwd=ROOT)
    assert done.returncode == 0, done.stderr


def test_notebooks_are_those_of_the_examples() -> None:
    done = subprocess.run([sys.executable, ROOT / "tools" / "notebooks.py", "--check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
    assert len(list((ROOT / "notebooks").glob("*.ipynb"))) == len(EXAMPLES)


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_a_notebook_runs(path: Path) -> None:
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    pytest.importorskip(NEEDED.get(path.stem, "numpy"))
    notebook = nbformat.read(ROOT / "notebooks" / f"{path.stem}.ipynb", as_version=4)
    nbformat.validate(notebook)
    nbclient.NotebookClient(notebook, timeout=LONGEST, resources={"metadata": {"path": ROOT}}).execute()
