"""Writes notebooks/*.ipynb from examples/*.py, without outputs. `--check` compares only, with exit status 1 where one differs.

A line `# %%` begins a cell of code, and `# %% [markdown]` one of text, whose lines are comments.
"""

import json
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
MARK = "# %%"
TEXT = "# %% [markdown]"


def cell(number: int, mark: str, lines: list[str]) -> dict[str, Any]:
    is_text = mark == TEXT
    if is_text:
        lines = [line.removeprefix("#").removeprefix(" ") for line in lines]
    source = "\n".join(lines).strip().splitlines(keepends=True)
    common = {"id": f"cell-{number}", "metadata": {}, "source": source}
    return {"cell_type": "markdown", **common} if is_text else {"cell_type": "code", "execution_count": None, "outputs": [], **common}


def notebook(script: str) -> str:
    """The notebook of a script."""
    parts: list[tuple[str, list[str]]] = []
    for line in script.splitlines():
        if line.startswith(MARK):
            parts.append((line.strip(), []))
        elif parts:
            parts[-1][1].append(line)
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    content = {
        "cells": [cell(number, *part) for number, part in enumerate(parts, 1)],
        "metadata": {"kernelspec": kernel, "language_info": {"name": "python"}},
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return json.dumps(content, indent=1, ensure_ascii=False) + "\n"


def main() -> int:
    is_check = "--check" in sys.argv[1:]
    status = 0
    for script in sorted((ROOT / "examples").glob("*.py")):
        path = ROOT / "notebooks" / f"{script.stem}.ipynb"
        text = notebook(script.read_text())
        if not is_check:
            path.write_text(text)
        elif not path.exists() or path.read_text() != text:
            print(f"{path.name} is not that of {script.name}: run tools/notebooks.py")
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
