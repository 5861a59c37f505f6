"""Runs the notebooks, each in a kernel of its own; exit status 1 where one fails."""

import sys
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError

ROOT = Path(__file__).resolve().parents[1]


def main() -> int:
    status = 0
    for path in sorted((ROOT / "notebooks").glob("*.ipynb")):
        notebook = nbformat.read(path, as_version=4)
        try:
            NotebookClient(notebook, resources={"metadata": {"path": ROOT / "notebooks"}}).execute()
        except CellExecutionError as error:
            print(f"{path.name}: {error}")
            status = 1
        else:
            print(f"{path.name} runs")
    return status


if __name__ == "__main__":
    sys.exit(main())
