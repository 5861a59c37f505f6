"""Progress is reported at most ten times a second, and at the end."""

import time
from collections.abc import Callable

import multibody as mbs
import pytest
from conftest import scene

AT_MOST = 10.0
"""Calls in a second, beside the first and the last one."""

Report = Callable[[float, float], None]
JOBS: dict[str, Callable[[Report], object]] = {
    "run": lambda report: mbs.Mechanism(scene("iltis-bump-5")).run(2.0, progress=report),
    "sweep": lambda report: mbs.Mechanism(scene("double-pendulum")).sweep(
        {"vary": [{"path": "body.upper.mass", "from": 1, "to": 2, "count": 40}]}, duration=2.0, progress=report
    ),
    "compare": lambda report: mbs.Mechanism(scene("double-pendulum")).compare(duration=0.5, progress=report),
}


@pytest.mark.parametrize("name", JOBS)
def test_progress_is_rare_and_ends(name: str) -> None:
    calls: list[tuple[float, float]] = []
    began = time.monotonic()
    JOBS[name](lambda done, end: calls.append((done, end)))
    assert 1 <= len(calls) <= AT_MOST * (time.monotonic() - began) + 2
    assert calls == sorted(calls)
    assert calls[-1][0] == calls[-1][1]
    assert len({end for _, end in calls}) == 1
