"""The package brings the command `mbs`."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import multibody as mbs
import pytest
from conftest import scene

PROGRAMS = {"entry point": [str(Path(sys.executable).with_name("mbs"))], "module": [sys.executable, "-m", "multibody"]}


def run(program: str, *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run([*PROGRAMS[program], *arguments], capture_output=True, text=True)


@pytest.mark.parametrize("program", PROGRAMS)
def test_it_has_the_version_of_the_package(program: str) -> None:
    done = run(program, "--version")
    assert (done.returncode, done.stdout) == (0, f"mbs {mbs.__version__}\n")


@pytest.mark.parametrize("program", PROGRAMS)
def test_its_status_says_how_it_ended(program: str, tmp_path: Path) -> None:
    assert run(program, "check", str(scene("four-bar"))).returncode == 0
    assert run(program, "check", "nothing.toml").returncode == 1
    assert run(program, "chek").returncode == 1
    stopped = run(program, "run", str(scene("double-pendulum")), "--step", "0.3", "--energy-alarm", "1e-3", "--json")
    assert stopped.returncode == 2
    assert not json.loads(stopped.stdout)["completed"]


def test_a_program_can_call_it(capfd: pytest.CaptureFixture[str]) -> None:
    assert mbs.main(["--version"]) == 0
    assert capfd.readouterr().out == f"mbs {mbs.__version__}\n"
    assert mbs.main(["check", "nothing.toml"]) == 1
    assert "nothing.toml" in capfd.readouterr().err


def test_an_interrupted_run_keeps_what_there_is(tmp_path: Path) -> None:
    import signal
    import time

    program = [*PROGRAMS["entry point"], "run", str(scene("double-pendulum")), "--duration", "1e6", "--out", str(tmp_path), "--json"]
    process = subprocess.Popen(program, stdout=subprocess.PIPE, text=True)
    time.sleep(1.0)
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=20)
    assert process.returncode == 2
    assert json.loads(out)["error"]["code"] == "interrupted"
