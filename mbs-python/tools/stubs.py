"""Writes the documentation of native classes into their stub, for editors. `--check` compares only, with exit status 1 where it differs."""

import ast
import sys
import textwrap
from pathlib import Path

import multibody

STUB = Path(__file__).resolve().parents[1] / "python" / "multibody" / "__init__.pyi"
WIDTH = 140
"""Longest line of the stub [-]."""


def documented(text: str) -> str:
    """The stub with the documentation of each method and property of a native class."""
    lines = text.splitlines()
    for kind in reversed([node for node in ast.parse(text).body if isinstance(node, ast.ClassDef)]):
        native = getattr(multibody, kind.name, None)
        if native not in (multibody.Mechanism, multibody.Simulation):
            continue
        for node in reversed([node for node in kind.body if isinstance(node, ast.FunctionDef)]):
            is_setter = any(isinstance(mark, ast.Attribute) for mark in node.decorator_list)
            doc = getattr(getattr(native, node.name, None), "__doc__", None)
            if doc is None or is_setter or node.name.startswith("__"):
                continue
            first, last = node.body[0].lineno - 1, node.body[-1].end_lineno or node.lineno
            body = textwrap.wrap(f'"""{" ".join(doc.split())}"""', WIDTH - 8)
            head = lines[first][: node.body[0].col_offset].rstrip() if first + 1 == last else ""
            if head:
                lines[first:last] = [head, *(f"        {line}" for line in body)]
            else:
                lines[first:last] = [f"        {line}" for line in body]
    return "\n".join(lines) + "\n"


def main() -> int:
    text = STUB.read_text()
    made = documented(text)
    if "--check" in sys.argv[1:]:
        if made != text:
            print("the stub lacks documentation of the native classes: run tools/stubs.py")
        return int(made != text)
    STUB.write_text(made)
    return 0


if __name__ == "__main__":
    sys.exit(main())
