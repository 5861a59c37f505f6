"""The builder writes a scene, and its refusals name the call."""

from __future__ import annotations

import json
import sys

import multibody as mbs
import numpy as np
import pytest
from conftest import scene


def crank_rocker() -> mbs.Builder:
    b = mbs.Mechanism.build("crank and rocker", dimension=2)
    b.gravity(np.array([0.0, -9.81]))
    b.duration(np.float64(0.5))
    pin = b.point("pin", [0.18, 0.24])
    crank = b.body("crank", mass=0.4, rod={"from": [0, 0], "to": pin})
    coupler = b.body("coupler", mass=1.0, rod={"from": pin, "to": [0.868, 0.576]})
    rocker = b.body("rocker", mass=np.float32(0.5), rod={"from": [0.7, 0], "to": [0.868, 0.576]})
    drive = b.joint("drive", "revolute", [b.ground, crank], at=[0, 0])
    b.joint("pin", "revolute", [crank, coupler], at=pin)
    b.joint("pin 2", "revolute", [coupler, rocker], at=[0.868, 0.576])
    b.joint("rocker pivot", "revolute", [b.ground, rocker], at=[0.7, 0])
    b.guide(drive, ramp={"rate": np.pi})
    b.output("rocker", body=rocker, at=[0.868, 0.576])
    b.solver(step=1e-3)
    return b


def test_it_builds_what_a_file_says() -> None:
    file = mbs.Mechanism(scene("guided-four-bar")).replace({"body.rocker.mass": 0.5})
    built = crank_rocker().done()
    assert (built.name, built.duration, built.dof) == ("crank and rocker", 0.5, file.dof)
    assert built.bodies == file.bodies
    theirs, mine = (mechanism.simulate(step=1e-3) for mechanism in (file, built))
    theirs.steps(1e-3, 100)
    mine.steps(1e-3, 100)
    assert mine.pose("rocker")[0].tobytes() == theirs.pose("rocker")[0].tobytes()


def test_handles_go_where_names_go() -> None:
    b = mbs.Mechanism.build("pendulum", 2)
    arm = b.body("arm", mass=1, center=[1, 0], inertia=0.1)
    assert repr(arm) == "arm" and arm == "arm"
    assert isinstance(b.joint("A", "revolute", [b.ground, arm], at=[0, 0]), str)
    b.duration(1.0)
    mechanism = b.done()
    assert len(mechanism.pose(arm, [0.0])) == 2


def test_bodies_and_joints_are_told_apart() -> None:
    b = mbs.Mechanism.build("pendulum", 2)
    arm = b.body("arm", mass=1, center=[1, 0], inertia=0.1)
    pivot = b.joint("arm", "revolute", [b.ground, arm], at=[0, 0])
    b.body("free", mass=1, center=[1, 0], inertia=0.1)
    b.initial(pivot, value=0.1)
    b.initial(arm, angular_velocity=1.0)
    b.initial("free", angular_velocity=1.0)
    b.initial("arm", rate=0.0)
    kinds = [next(iter(entry)) for entry in json.loads(b.text())["initial"]]
    assert kinds == ["joint", "body", "body", "joint"]


def test_each_entry_has_a_line_of_its_own() -> None:
    b = crank_rocker()
    lines = b.text().splitlines()
    assert sum(line.startswith('{"name": "crank"') for line in lines) == 1
    assert json.loads(b.text())["scene"] == {"name": "crank and rocker", "dimension": 2, "gravity": [0.0, -9.81], "duration": 0.5}
    assert json.loads(b.text())["body"][2]["mass"] == 0.5


def test_a_refusal_names_the_call() -> None:
    b = mbs.Mechanism.build("pendulum", 2)
    b.duration(1.0)
    line = sys._getframe().f_lineno + 1
    b.body(
        "arm",
        mas=1.0,
        point=[0, 0],
    )
    with pytest.raises(mbs.SceneError) as caught:
        b.done()
    error = caught.value
    assert error.file == __file__
    assert line <= (error.line or 0) <= line + 4  # Python counts a call's lines by its version
    assert error.code == "scene-refused"
    assert error.hint == "did you mean `mass`?"
    assert error.message == f"{__file__}:{error.line}: unknown key `mas`"
    assert error.__context__ is None


def test_a_key_of_the_scene_is_refused_at_its_call() -> None:
    b = mbs.Mechanism.build("pendulum", 2)
    b.body("arm", mass=1, point=[0, 0])
    begin = sys._getframe().f_lineno - 2
    with pytest.raises(mbs.SceneError, match="duration") as caught:
        b.done()
    assert caught.value.line == begin
    b.duration(1.0)
    b.gravity([0.0])
    here = sys._getframe().f_lineno - 1
    with pytest.raises(mbs.SceneError) as caught:
        b.done()
    assert caught.value.line == here


@pytest.mark.parametrize("value", [float("nan"), np.inf, np.array([1.0, np.nan]), [0.0, float("-inf")]])
def test_numbers_that_are_none_are_refused_at_the_call(value: object) -> None:
    b = mbs.Mechanism.build("pendulum", 2)
    with pytest.raises(mbs.UsageError) as caught:
        b.body("arm", mass=value, point=[0, 0])
    assert caught.value.argument == "mass"


def test_other_values_are_refused_at_the_call() -> None:
    b = mbs.Mechanism.build("pendulum", 2)
    with pytest.raises(mbs.UsageError):
        b.body("arm", mass=1j)


def test_all_tables_can_be_written() -> None:
    b = mbs.Mechanism.build("ball on a floor", 3)
    b.duration("10 ms")
    b.gravity([0, 0, -9.81])
    size = b.parameter("size", 0.1)
    ball = b.body("ball", mass=1, center=[0, 0, size], inertia=[0.01, 0.01, 0.01, 0, 0, 0])
    b.table("rolling", name="contact", kind="ball", body=ball, center=[0, 0, size], radius=size)
    tip = b.frame("tip", ball, [0, 0, 0.2])
    b.output("turn", "orientation", body=ball, as_="matrix")
    b.output("tip", "position", body=tip)
    b.table("solver", step=1e-3)
    assert b.done().run().completed
