"""A run has the bits of `mbs run` on the same scene."""

import csv
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import multibody as mbs
import numpy as np
import pytest
from conftest import SCENES

DURATION = 0.2
"""Simulated time [s]: 200 steps of most scenes, fractions of a second each."""
SCENE_FILES = sorted(SCENES.glob("*.toml"))
TIMES = {"cpu_seconds", "real_time_factor", "worst_step_seconds", "estimate", "id", "checksums", "files"}
"""Keys that differ from run to run, or that only files have."""
STEPS = {"andrews": 1e-5}
"""Steps [s] of scenes whose own step is needed; 1e-3 else."""


def without_times(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: without_times(entry) for key, entry in value.items() if key not in TIMES}
    if isinstance(value, list):
        return [without_times(entry) for entry in value]
    return value


def command(path: Path, step: float, formulation: str, out: Path) -> tuple[dict[str, Any], np.ndarray, list[str]]:
    program = Path(sys.executable).with_name("mbs")
    method = ["--formulation", formulation, "--step", repr(step), "--duration", repr(DURATION), "--no-estimate"]
    done = subprocess.run([program, "run", path, "--json", *method, "--out", out], capture_output=True, text=True)
    assert done.returncode in (0, 2), done.stderr
    with (out / "run.csv").open() as lines:
        columns, *rows = csv.reader(lines)
    return json.loads(done.stdout), np.array([[float(cell) for cell in row] for row in rows]), columns


def same_bits(a: np.ndarray, b: np.ndarray) -> bool:
    return a.shape == b.shape and bool((np.ascontiguousarray(a).view(np.uint64) == np.ascontiguousarray(b).view(np.uint64)).all())


@pytest.mark.parametrize("path", SCENE_FILES, ids=lambda path: path.stem)
def test_a_run_has_the_bits_of_the_command(path: Path, tmp_path: Path) -> None:
    step, formulation = STEPS.get(path.stem, 1e-3), "index-3"
    summary, table, columns = command(path, step, formulation, tmp_path)
    result = mbs.Mechanism(path).run(DURATION, step=step, formulation=formulation)
    assert without_times(result.summary) == without_times(summary)
    assert result.columns == columns[1:]
    assert same_bits(result.t, table[:, 0])
    assert same_bits(result.array, table[:, 1:])


@pytest.mark.parametrize("name", ["double-pendulum", "six-joint-arm", "spinning-top", "four-bar"])
@pytest.mark.parametrize("formulation", ["index-1", "classical", "state-space", "recursive"])
def test_each_formulation_has_the_bits_of_the_command(name: str, formulation: str, tmp_path: Path) -> None:
    path = SCENES / f"{name}.toml"
    summary, table, _ = command(path, 1e-3, formulation, tmp_path)
    result = mbs.Mechanism(path).run(DURATION, step=1e-3, formulation=formulation)
    assert without_times(result.summary) == without_times(summary)
    assert same_bits(result.array, table[:, 1:])


WHEEL = """
[scene]
dimension = 2
duration = 0.3
[[body]]
name = "wheel"
mass = 1
center = [0, 0]
inertia = 2
[[joint]]
name = "axle"
kind = "revolute"
bodies = ["ground", "wheel"]
at = [0, 0]
[[effect]]
name = "motor"
kind = "torque"
joint = "axle"
value = 2
input = true
"""


def test_inputs_as_arrays_are_those_of_a_file(tmp_path: Path) -> None:
    scene, table = tmp_path / "wheel.toml", tmp_path / "motor.csv"
    scene.write_text(WHEEL)
    table.write_text("t,motor\n0.05,0\n0.1,3.7\n0.25,-0.001\n")
    program = Path(sys.executable).with_name("mbs")
    done = subprocess.run([program, "run", scene, "--inputs", table, "--no-estimate", "--out", tmp_path / "out"], capture_output=True)
    assert done.returncode == 0
    with (tmp_path / "out" / "run.csv").open() as lines:
        rows = np.array([[float(cell) for cell in row] for row in list(csv.reader(lines))[1:]])
    result = mbs.Mechanism(scene).run(inputs={"motor": [0.0, 3.7, -1e-3], "t": [0.05, 0.1, 0.25]})
    assert same_bits(result.array, rows[:, 1:])


def test_a_resumed_run_has_the_bits_of_the_whole(tmp_path: Path) -> None:
    pendulum = mbs.Mechanism(SCENES / "double-pendulum.toml")
    whole = pendulum.run(DURATION)
    kept = pendulum.run(DURATION, checkpoints=(tmp_path, 0.15))
    resumed = pendulum.run(resume=tmp_path / "checkpoint.mbs")
    for run in (kept, resumed):
        assert same_bits(run.array, whole.array)
        assert without_times(run.summary) == without_times(whole.summary)
