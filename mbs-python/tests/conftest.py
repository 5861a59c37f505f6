"""What the tests share."""

import importlib
import os
import signal
from pathlib import Path
from types import ModuleType

import pytest
from multibody import UsageError

SCENES = Path(__file__).resolve().parents[2] / "scenes"


def scene(name: str) -> Path:
    """The path of a scene of the repository."""
    return SCENES / f"{name}.toml"


def needs(name: str) -> ModuleType:
    """A module that a test needs: without it the test is skipped, or fails where MBS_STRICT is 1."""
    if os.environ.get("MBS_STRICT") == "1":
        return importlib.import_module(name)
    return pytest.importorskip(name)  # type: ignore[no-any-return]


def needs_browser() -> None:
    """A browser for pictures: without it the test is skipped, or fails where MBS_STRICT is 1."""
    from multibody.render import browser

    try:
        browser()
    except UsageError:
        if os.environ.get("MBS_STRICT") == "1":
            raise
        pytest.skip("no browser that draws pictures")


# a shell that starts this in the background has Ctrl-C ignored, and Python leaves it so
signal.signal(signal.SIGINT, signal.default_int_handler)
