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
