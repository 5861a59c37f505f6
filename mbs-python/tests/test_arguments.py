"""A wrong argument is refused by its name."""

from collections.abc import Callable
from typing import Any

import multibody as mbs
import numpy as np
import pytest
from conftest import scene


def pendulum() -> mbs.Mechanism:
    return mbs.Mechanism(scene("double-pendulum"))


def arm() -> mbs.Mechanism:
    return mbs.Mechanism(scene("six-joint-arm"))


def sim(**settings: Any) -> mbs.Simulation:
    return pendulum().simulate(**settings)


def driven() -> mbs.Mechanism:
    return mbs.Mechanism(
        {
            "scene": {"dimension": 2, "duration": 1.0},
            "body": [{"name": "slide", "mass": 1.0, "center": [0, 0], "inertia": 1.0}],
            "joint": [{"name": "rail", "kind": "prismatic", "bodies": ["ground", "slide"], "at": [0, 0], "axis": [1, 0]}],
            "effect": [{"name": "push", "kind": "torque", "joint": "rail", "coordinate": "slide", "value": 0.0, "input": True}],
        }
    )


def rollout(q: Any = ((0, 0),), v: Any = ((0, 0),), **words: Any) -> mbs.Rollout:
    return pendulum().rollout(q, v, **{"steps": 2, **words})


MASKED = np.ma.masked_array([0.0, 0.0], mask=[True, False])
REST = np.zeros((3, 2))
BROKEN = np.array([[0.0, 0.0], [0.0, np.nan], [0.0, 0.0]])
REFUSED: dict[str, tuple[Callable[[], object], str, str | None]] = {
    "texts as numbers": (lambda: pendulum().bias(["1", "2"], [0, 0]), "wrong-type", "q"),
    "complex numbers": (lambda: pendulum().bias([1j, 0], [0, 0]), "wrong-type", "q"),
    "times as numbers": (lambda: pendulum().bias(np.array([0, 0], "datetime64[s]"), [0, 0]), "wrong-type", "q"),
    "masked numbers": (lambda: pendulum().bias(MASKED, [0, 0]), "wrong-type", "q"),
    "rows of several lengths": (lambda: pendulum().bias([[0, 0], [0]], [0, 0]), "wrong-type", "q"),
    "nothing as numbers": (lambda: pendulum().bias([None, None], [0, 0]), "wrong-type", "q"),
    "a velocity with NaN": (lambda: pendulum().bias([0, 0], [0, np.nan]), "not-finite", "v"),
    "a NaN among many states": (lambda: pendulum().bias(REST, BROKEN), "not-finite", "v"),
    "effort with NaN": (lambda: pendulum().forward_dynamics([0, 0], [0, 0], [np.inf, 0]), "not-finite", "effort"),
    "a time of NaN": (lambda: pendulum().accelerations([0, 0], [0, 0], time=np.nan), "not-finite", "time"),
    "a point with NaN": (lambda: arm().jacobian("hand", [0, 0, np.nan], np.zeros(6)), "not-finite", "at"),
    "a plane point in space": (lambda: arm().jacobian("hand", [0, 0], np.zeros(6)), "wrong-shape", "at"),
    "a state to set with NaN": (lambda: sim().set_state([np.nan, 0], [0, 0]), "not-finite", "q"),
    "a step of NaN": (lambda: sim().step(np.nan), "bad-step", "dt"),
    "steps backwards": (lambda: sim().steps(-1e-3, 2), "bad-step", "dt"),
    "fewer steps than none": (lambda: sim().steps(1e-3, -1), "no-count", "n"),
    "an end of NaN": (lambda: sim().run_until(np.nan), "bad-step", "time"),
    "an input before the first": (lambda: sim().set_input(-1, 0.0), "no-count", "name"),
    "an unknown input": (lambda: sim().set_input("push", 0.0), "unknown-name", "name"),
    "an unknown joint": (lambda: sim().reaction("elbw"), "unknown-name", "joint"),
    "an unknown body": (lambda: sim().pose("lowr"), "unknown-name", "body"),
    "an unknown path": (lambda: pendulum().get("body.uper.mass"), "unknown-path", "path"),
    "an unknown path to set": (lambda: pendulum().replace({"body.uper.mass": 1}), "unknown-path", "values"),
    "a number in place of paths": (lambda: pendulum().replace(3), "wrong-type", "values"),  # type: ignore[arg-type]
    "several numbers for one": (lambda: pendulum().replace({"body.upper.mass": [1, 2]}), "wrong-shape", "body.upper.mass"),  # type: ignore[dict-item]
    "a list in place of inputs": (lambda: pendulum().run(0.1, inputs=[1]), "wrong-type", "inputs"),  # type: ignore[arg-type]
    "inputs without times": (lambda: pendulum().run(0.1, inputs={"x": [1.0]}), "inputs-refused", "inputs"),
    "an unknown input of a run": (lambda: driven().run(0.1, inputs={"t": [0.0], "puhs": [1.0]}), "inputs-refused", "inputs"),
    "inputs of another length": (lambda: driven().run(0.1, inputs={"t": [0.0, 1.0], "push": [1.0]}), "inputs-refused", "inputs"),
    "a step beside an error": (lambda: pendulum().run(0.1, error=1e-3, step=1e-3), "goal-refused", "error"),
    "a checkpoint beside an error": (lambda: pendulum().run(0.1, error=1e-3, checkpoints=(".", 0.1)), "settings-refused", None),
    "a checkpoint of nothing": (lambda: pendulum().run(0.1, resume="nothing.mbs"), "checkpoint-refused", "resume"),
    "fewer threads than none": (lambda: pendulum().run(0.1, threads=-1), "settings-refused", "threads"),
    "a number as a method": (lambda: pendulum().run(0.1, formulation=3), "settings-refused", "formulation"),  # type: ignore[arg-type]
    "a negative step": (lambda: pendulum().run(0.1, step=-1.0), "settings-refused", "step"),
    "an unknown integrator": (lambda: sim(integrator="rk5"), "settings-refused", "integrator"),
    "a method that cannot": (lambda: sim(formulation="index-3", integrator="rk4"), "settings-refused", "integrator"),
    "a doctor of steps of NaN": (lambda: pendulum().doctor(step=np.nan), "settings-refused", "step"),
    "a comparison of negative steps": (lambda: pendulum().compare(steps=[-1.0]), "settings-refused", "steps"),
    "an unknown output to linearise": (lambda: pendulum().linearize(outputs=["nope"]), "unknown-name", "outputs"),
    "an unknown input to linearise": (lambda: pendulum().linearize(inputs=["nope"]), "unknown-name", "inputs"),
    "a NaN in a scene": (lambda: mbs.Mechanism({"scene": {"duration": np.nan}}), "wrong-type", "source"),
    "a NaN in a sweep": (lambda: pendulum().sweep({"vary": np.nan}), "wrong-type", "spec"),
    "a rollout on a cluster from texts": (lambda: rollout([["1", "2"]], client="ray"), "wrong-type", "q"),
    "an unknown formulation to compare": (lambda: pendulum().compare(["index-4"]), "unknown-name", "methods"),
    "an unknown search": (lambda: pendulum().equilibrium("up"), "unknown-name", "search"),  # type: ignore[arg-type]
    "an unknown place": (lambda: pendulum().linearize("start"), "unknown-name", "at"),
    "a number as a place": (lambda: pendulum().linearize(3), "wrong-type", "at"),  # type: ignore[arg-type]
    "a number as a sweep": (lambda: pendulum().sweep(5), "wrong-type", "spec"),  # type: ignore[arg-type]
    "a sweep on fewer threads than none": (lambda: pendulum().sweep({}, threads=-1), "no-count", "threads"),
    "a rollout of no length": (lambda: rollout(steps=None), "no-count", "steps"),
    "a rollout of negative length": (lambda: rollout(steps=-1), "no-count", "steps"),
    "a rollout on fewer threads than none": (lambda: rollout(threads=-1), "no-count", "threads"),
    "a rollout backwards": (lambda: rollout(dt=-1e-3), "bad-step", "dt"),
    "a rollout by steps of NaN": (lambda: rollout(dt=np.nan), "bad-step", "dt"),
    "a rollout from NaN": (lambda: rollout([[0, np.nan]]), "not-finite", "q"),
    "a rollout by an unknown integrator": (lambda: rollout(integrator="rk5"), "unknown-name", "integrator"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_it_is_named(name: str) -> None:
    call, code, argument = REFUSED[name]
    with pytest.raises(mbs.UsageError) as caught:
        call()
    assert (caught.value.code, caught.value.argument) == (code, argument)
    assert caught.value.hint


def test_the_place_of_a_number_is_told() -> None:
    with pytest.raises(mbs.UsageError, match=r"v\[1, 1\]"):
        pendulum().bias(REST, BROKEN)


def test_integers_truths_and_single_precision_are_numbers() -> None:
    expected = pendulum().bias([1.0, 0.0], [0.0, 0.0])
    for q in ([1, 0], [True, False], np.array([1, 0], np.float32), np.array([1, 0], np.uint8), np.ma.masked_array([1.0, 0.0])):
        assert pendulum().bias(q, [0, 0]).tolist() == expected.tolist()


def test_what_an_argument_raises_itself_is_raised() -> None:
    class Stops:
        def __array__(self, *_: object, **__: object) -> None:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        pendulum().mass_matrix(Stops())  # type: ignore[arg-type]
