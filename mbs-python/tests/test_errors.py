"""A wrong input is refused with its code, its place and a remedy; a run that stops is a result."""

import copy
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import multibody as mbs
import numpy as np
import pytest
from conftest import scene

ARM = {"name": "arm", "mass": 1.0, "rod": {"from": [0, 0], "to": [1, 0]}}
PIVOT = {"name": "A", "kind": "revolute", "bodies": ["ground", "arm"], "at": [0, 0]}


def small(**tables: Any) -> dict[str, Any]:
    return {"scene": {"dimension": 2, "duration": 1.0, "gravity": [0, -9.81]}, "body": [ARM], "joint": [PIVOT], **tables}


def pendulum() -> mbs.Mechanism:
    return mbs.Mechanism(scene("double-pendulum"))


def unclosed() -> dict[str, Any]:
    fixed = {"name": "B", "kind": "revolute", "bodies": ["ground", "arm"], "at": [1, 0]}
    return small(joint=[PIVOT, fixed], initial=[{"joint": "A", "value": 1.0}])


REFUSALS: dict[str, tuple[Callable[[], object], type[mbs.MbsError], str, str]] = {
    "a file that is not there": (lambda: mbs.Mechanism("nothing.toml"), mbs.SceneError, "scene-refused", "exists"),
    "a text that is no TOML": (lambda: mbs.Mechanism("[scene]\nname = = 2\n"), mbs.SceneError, "scene-refused", "toml"),
    "a number as a scene": (lambda: mbs.Mechanism(3), mbs.UsageError, "wrong-type", "path"),  # type: ignore[arg-type]
    "an unknown table": (lambda: mbs.Mechanism(small(bodi=[])), mbs.SceneError, "scene-refused", "`body`"),
    "an unknown key": (lambda: mbs.Mechanism(small(body=[{**ARM, "mas": 1}])), mbs.SceneError, "scene-refused", "`mass`"),
    "an unknown body": (lambda: mbs.Mechanism(small(body=[{**ARM, "name": "arms"}])), mbs.SceneError, "scene-refused", "`arms`"),
    "a NaN in a scene": (lambda: mbs.Mechanism(small(body=[{**ARM, "mass": np.nan}])), mbs.UsageError, "wrong-type", "finite"),
    "an unknown joint": (lambda: pendulum().coordinates("pivt"), mbs.UsageError, "unknown-name", "`pivot`"),
    "the pose of an unknown body": (lambda: pendulum().pose("lowr", [0, 0]), mbs.UsageError, "unknown-name", "`lower`"),
    "an unknown path": (lambda: pendulum().get("body.uper.mass"), mbs.UsageError, "unknown-path", "`upper`"),
    "an unknown path to replace": (lambda: pendulum().replace({"body.upper.mas": 1}), mbs.UsageError, "unknown-path", "`mass`"),
    "a negative mass": (lambda: pendulum().replace({"body.upper.mass": -1}), mbs.SceneError, "scene-refused", "zero or more"),
    "an infinite mass": (lambda: pendulum().replace({"body.upper.mass": np.inf}), mbs.UsageError, "not-finite", "finite"),
    "an unknown output": (lambda: pendulum().run(0.01)["tip.z"], mbs.UsageError, "unknown-name", "`tip."),
    "an unknown setting": (lambda: pendulum().run(stp=1), mbs.UsageError, "unknown-name", "`step`"),
    "an unknown formulation": (lambda: pendulum().run(formulation="recursiv"), mbs.UsageError, "settings-refused", "`recursive`"),
    "a method that cannot": (lambda: pendulum().run(formulation="index-3", integrator="rk4"), mbs.UsageError, "settings-refused", "recursive"),
    "a negative duration": (lambda: pendulum().run(-1.0), mbs.UsageError, "settings-refused", "larger than zero"),
    "a step of NaN": (lambda: pendulum().run(step=np.nan), mbs.UsageError, "settings-refused", "larger than zero"),
    "a q of another size": (lambda: pendulum().mass_matrix([0.0]), mbs.UsageError, "wrong-shape", "nq"),
    "a q with NaN": (lambda: pendulum().mass_matrix([0.0, np.nan]), mbs.UsageError, "not-finite", "finite"),
    "a u of another size": (lambda: pendulum().simulate().step(1e-3, [1.0]), mbs.UsageError, "wrong-shape", "no inputs"),
    "an input that is not there": (lambda: pendulum().simulate().set_input("motor", 1.0), mbs.UsageError, "unknown-name", ""),
    "bytes that are no state": (lambda: pendulum().simulate().restore(b"state"), mbs.UsageError, "checkpoint-refused", "save"),
    "a start that cannot assemble": (lambda: mbs.Mechanism(unclosed()).initial(), mbs.StartError, "cannot-assemble", "hold"),
}


def refusal(name: str) -> mbs.MbsError:
    call, kind, _, _ = REFUSALS[name]
    with pytest.raises(kind) as caught:
        call()
    return caught.value


@pytest.mark.parametrize("name", REFUSALS)
def test_a_refusal_has_its_code_and_a_hint(name: str) -> None:
    error = refusal(name)
    assert error.code == REFUSALS[name][2]
    assert REFUSALS[name][3] in (error.hint or "")
    assert error.message in str(error)


@pytest.mark.parametrize("name", REFUSALS)
def test_a_refusal_is_pickled_and_copied_whole(name: str) -> None:
    error = refusal(name)
    for twin in (pickle.loads(pickle.dumps(error)), copy.copy(error), copy.deepcopy(error)):
        assert type(twin) is type(error)
        assert str(twin) == str(error)
        assert {**twin.__dict__} == {**error.__dict__}


def test_a_refused_file_has_its_place(tmp_path: Path) -> None:
    path = tmp_path / "arm.toml"
    path.write_text('[scene]\ndimension = 2\nduration = 1.0\n[[body]]\nname = "arm"\nmas = 1.0\npoint = [0, 0]\n')
    with pytest.raises(mbs.SceneError) as caught:
        mbs.Mechanism(path)
    error = caught.value
    assert (error.file, error.line, error.column, error.text) == (str(path), 6, 1, "mas = 1.0")
    assert error.hint == "did you mean `mass`?"


def test_kinds_of_errors_are_those_of_python() -> None:
    assert issubclass(mbs.SceneError, ValueError)
    assert issubclass(mbs.UsageError, ValueError)
    assert issubclass(mbs.StopError, ArithmeticError)
    assert issubclass(mbs.BusyError, RuntimeError)
    assert isinstance(refusal("an unknown output"), KeyError)


def test_a_run_that_stops_is_a_result_with_its_error() -> None:
    result = mbs.Mechanism(small(body=[{**ARM, "mass": 0.0}], effect=[])).run()
    assert not result.completed
    assert result.error is not None
    with pytest.raises(mbs.MbsError) as caught:
        result.check()
    assert caught.value.joint == "A"
    assert result.summary["error"]["code"] == caught.value.code
    twin = pickle.loads(pickle.dumps(result))
    assert str(twin.error) == str(result.error)


def test_a_run_that_stops_on_its_way_keeps_its_rows() -> None:
    result = mbs.Mechanism(scene("double-pendulum")).run(step=0.3, energy_alarm=1e-3)
    assert not result.completed
    assert result.error is not None
    assert result.error.time is not None
    assert 0.0 < result.t[-1] <= result.error.time
    assert np.isfinite(result.array).all()


def test_a_start_that_cannot_assemble_is_a_result_of_a_run() -> None:
    result = mbs.Mechanism(unclosed()).run()
    assert isinstance(result.error, mbs.StartError)
    assert result.error.code == "cannot-assemble"
