"""Ctrl-C ends a run, a comparison and a sweep at once."""

import signal
import threading
import time
from collections.abc import Callable
from pathlib import Path

import multibody as mbs
import numpy as np
import pytest
from conftest import scene

PROMPT = 0.1
"""Longest time from the signal to the exception [s]."""
TRIES = 3
"""Tries to be prompt, on a machine that does other things too."""
AFTER = 0.2
"""When the signal comes [s]."""


def delay(work: Callable[[], object]) -> float:
    """Interrupts work. Returns the time from the signal to the exception [s]."""
    before = signal.signal(signal.SIGALRM, lambda *_: signal.raise_signal(signal.SIGINT))
    signal.setitimer(signal.ITIMER_REAL, AFTER)
    began = time.monotonic()
    try:
        with pytest.raises(KeyboardInterrupt):
            work()
        return time.monotonic() - began - AFTER
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def pendulum() -> mbs.Mechanism:
    return mbs.Mechanism(scene("double-pendulum"))


def chain(n: int) -> mbs.Mechanism:
    b = mbs.Mechanism.build("chain", dimension=2)
    b.duration(1.0)
    before = b.ground
    for i in range(n):
        link = b.body(f"link-{i}", mass=1.0, rod={"from": [0, -i], "to": [0, -i - 1]})
        b.joint(f"joint-{i}", "revolute", [before, link], at=[0, -i])
        before = link
    return b.done()


SWEEP = {"vary": [{"path": "body.upper.mass", "from": 1.0, "to": 2.0, "count": 10000}]}
LONG: dict[str, Callable[[], object]] = {
    "run": lambda: pendulum().run(1e4),
    "run with progress": lambda: pendulum().run(1e4, progress=lambda t, end: None),
    "run of a large scene": lambda: mbs.Mechanism(scene("iltis-bump-5")).run(1e4),
    "steps": lambda: pendulum().simulate().steps(1e-3, 10**7),
    "run_until": lambda: pendulum().simulate().run_until(1e4),
    "rollout": lambda: pendulum().rollout([[0.0, 0.0]] * 64, [[0.0, 0.0]] * 64, steps=10**5, threads=1),
    "many states": lambda: pendulum().accelerations(np.zeros((3 * 10**6, 2)), np.zeros((3 * 10**6, 2))),
    "a step of a method that chooses its own": lambda: pendulum().simulate(formulation="recursive", integrator="rk54").step(1e5),
    "run_until of such a method": lambda: pendulum().simulate(formulation="recursive", integrator="rk54").run_until(1e5),
    "steps of such a method": lambda: pendulum().simulate(formulation="recursive", integrator="rk54").steps(1e5, 2),
    "fewer of its steps": lambda: pendulum().simulate(formulation="recursive", integrator="rk54").step(1e4),
    "compare": lambda: pendulum().compare(duration=1e3),
    "sweep": lambda: pendulum().sweep(SWEEP, threads=2),
    "doctor": lambda: [mbs.Mechanism(scene("hexapod")).doctor() for _ in range(1000)],
}


@pytest.mark.parametrize("name", LONG)
def test_an_interrupt_is_prompt(name: str) -> None:
    assert any(delay(LONG[name]) < PROMPT for _ in range(TRIES))


def test_a_simulation_that_was_interrupted_goes_on() -> None:
    simulation = pendulum().simulate()
    delay(lambda: simulation.steps(1e-3, 10**7))
    time_ = simulation.time
    assert time_ > 0.0
    simulation.step(1e-3)
    assert simulation.time == pytest.approx(time_ + 1e-3)


def test_an_interrupt_ends_no_copy() -> None:
    simulation = pendulum().simulate()
    copy = simulation.copy()
    end = 400.0
    runs = threading.Thread(target=copy.run_until, args=(end,))
    runs.start()
    delay(lambda: simulation.run_until(1e5))
    runs.join()
    assert copy.time == end


def test_an_interrupted_sweep_resumes_from_its_journal(tmp_path: Path) -> None:
    spec = {"vary": [{"path": "body.upper.mass", "from": 1.0, "to": 2.0, "count": 60}]}
    delay(lambda: pendulum().sweep(spec, journal=tmp_path, threads=1, duration=5.0))
    counts: list[int] = []
    table = pendulum().sweep(spec, journal=tmp_path, threads=1, duration=5.0, progress=lambda done, n: counts.append(done))
    assert counts[0] > 0
    assert len(table) == 60
    assert not table.failures


def test_a_progress_that_raises_ends_the_run() -> None:
    def refuse(t: float, end: float) -> None:
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        pendulum().run(1e4, progress=refuse)


# the last one: what is left to itself goes on for a second or two
def test_an_interrupt_leaves_what_looks_at_no_flag() -> None:
    mechanism = chain(70)
    assert any(delay(lambda: mechanism.modes("initial")) < PROMPT for _ in range(TRIES))
