"""Models of other programs from Python: options and report of the import, motors, states in the file's order."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import Any

import multibody as mbs
import numpy as np
import pytest
from conftest import scene

ARM = """<robot name="arm">
  <link name="base"/>
  <link name="upper"><inertial><origin xyz="0.2 0 0"/><mass value="2"/>
    <inertia ixx="0.01" iyy="0.05" izz="0.05" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="fore"><inertial><origin xyz="0.1 0 0"/><mass value="1"/>
    <inertia ixx="0.01" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="finger"><inertial><mass value="0.1"/>
    <inertia ixx="0.001" iyy="0.001" izz="0.001" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
    <limit effort="50" velocity="3" lower="-2" upper="2"/></joint>
  <joint name="elbow" type="continuous"><origin xyz="0.4 0 0"/><parent link="upper"/><child link="fore"/><axis xyz="0 1 0"/></joint>
  <joint name="grip" type="prismatic"><origin xyz="0.2 0 0"/><parent link="fore"/><child link="finger"/><axis xyz="0 0 1"/>
    <limit effort="0" velocity="1" lower="0" upper="1"/>FOLLOWS</joint>
</robot>
"""
FOLLOWER = ARM.replace("FOLLOWS", '<mimic joint="elbow" multiplier="0.1"/>')
ARM = ARM.replace("FOLLOWS", "")
NEAR = 1e-9
"""How near numbers are that are the same but for rounding; sizes are about one."""


def test_each_joint_that_moves_gets_a_motor() -> None:
    m = mbs.Mechanism(ARM, motors=True)
    assert m.inputs == ["shoulder.motor", "elbow.motor", "grip.motor"]
    assert list(m.input_units.values()) == ["N m", "N m", "N"]
    assert mbs.Mechanism(ARM).inputs == []


def test_a_motor_saturates_at_the_effort_of_its_joint() -> None:
    m = mbs.Mechanism(ARM, motors=True)
    q, v = m.reference()
    asked = [m.accelerations(q, v, [u, 0, 0]) for u in (50.0, 80.0, 49.0)]
    assert np.array_equal(asked[0], asked[1]) and not np.array_equal(asked[0], asked[2])
    # without an effort above zero there is none, and the report says so
    one, far = (m.accelerations(q, v, [0, 0, u]) for u in (1.0, 1001.0))
    none = m.accelerations(q, v, [0, 0, 0])
    assert np.allclose(far - none, 1001.0 * (one - none), rtol=NEAR, atol=NEAR)
    report = m.import_report
    assert report is not None
    assert [line["element"] for line in report["noted"]] == ["joint[elbow]", "joint[grip]"]


def test_followers_and_driven_joints_get_no_motor() -> None:
    assert mbs.Mechanism(FOLLOWER, motors=True).inputs == ["shoulder.motor", "elbow.motor"]
    driven = """<mujoco><worldbody><body><joint name="a"/><geom size="0.1"/>
      <body pos="1 0 0"><joint name="b"/><geom size="0.1"/></body></body></worldbody>
      <actuator><motor name="m" joint="a"/></actuator></mujoco>"""
    assert set(mbs.Mechanism(driven, motors=True).inputs) == {"m", "b.motor"}


def test_balls_and_planar_joints_get_a_motor_for_each_coordinate() -> None:
    ball = mbs.Mechanism(ARM.replace('name="elbow" type="continuous"', 'name="elbow" type="spherical"'), motors=True)
    assert ball.inputs[1:4] == ["elbow.motor.x", "elbow.motor.y", "elbow.motor.z"]
    # a moment between two bodies: the momentum of all about the axis of the shoulder stays
    q, v = ball.reference()
    with_moment, without = (ball.accelerations(q, v, [0, 0, u, 0, 0]) for u in (1.0, 0.0))
    efforts = ball.mass_matrix(q) @ (with_moment - without)
    assert np.allclose(efforts, [0, 0, 1, 0, 0], atol=NEAR)
    plane = mbs.Mechanism(ARM.replace('name="shoulder" type="revolute"', 'name="shoulder" type="planar"'), motors=True)
    assert plane.inputs[:3] == ["shoulder.motor.x", "shoulder.motor.y", "shoulder.motor.turn"]


def test_a_name_that_is_taken_is_refused() -> None:
    taken = """<mujoco><worldbody><body><joint name="a"/><geom size="0.1"/>
      <body pos="1 0 0"><joint name="b"/><geom size="0.1"/></body></body></worldbody>
      <actuator><motor name="b.motor" joint="a"/></actuator></mujoco>"""
    with pytest.raises(mbs.SceneError, match="`b.motor`"):
        mbs.Mechanism(taken, motors=True)


def test_options_are_those_of_the_format() -> None:
    free = mbs.Mechanism(ARM.replace('<link name="base"/>', '<link name="base"><inertial><mass value="5"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>'), base="free")
    assert free.nv == 6 + 3
    with pytest.raises(TypeError, match="`key` is no option of a file in URDF; its options: balance, base"):
        mbs.Mechanism(ARM, key="home")  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="`bas`"):
        mbs.Mechanism(ARM, bas="free")  # type: ignore[call-arg]
    wrong: list[tuple[str, Any]] = [("base", "loose"), ("limits", (1.0,)), ("packages", {"a": "/nowhere"}), ("motors", "yes")]
    for option, value in wrong:
        with pytest.raises(mbs.UsageError) as refused:
            mbs.Mechanism(ARM, **{option: value})
        assert refused.value.argument == option
    with pytest.raises(mbs.UsageError, match="this is a scene"):
        mbs.Mechanism(scene("double-pendulum"), motors=True)


def test_what_can_act_and_is_left_out_is_a_warning() -> None:
    dropped = """<mujoco><worldbody><body><joint name="a" axis="0 1 0"/><geom size="0.1" pos="0.1 0 0"/></body></worldbody>
      <tendon><fixed name="t"><joint joint="a" coef="1"/></fixed></tendon>
      <actuator><muscle name="pull" tendon="t"/></actuator></mujoco>"""
    with pytest.warns(mbs.ModelWarning, match="muscle"):
        m = mbs.Mechanism(dropped)
    report = m.import_report
    assert report is not None
    assert ["muscle" in line["says"] for line in report["ignored"]] == [True]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert mbs.Mechanism(scene("double-pendulum")).import_report is None


def test_the_report_is_that_of_the_command(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    import json

    file = tmp_path / "arm.urdf"
    file.write_text(ARM)
    assert mbs.main(["import", str(file), "--motors", "--json"]) == 0
    assert json.loads(capfd.readouterr().out) == mbs.Mechanism(file, motors=True).import_report


def test_a_held_arm_is_linearised_as_it_is_held() -> None:
    m = mbs.Mechanism(ARM, motors=True)
    q, v = np.array([0.3, 0.7, 0.1]), np.zeros(3)
    u = m.gravity(q)
    held = m.linearize((q, v, u))
    assert held.unsteady is None
    # a second derivation: the recursion's own derivatives, along the same coordinates
    slopes = m.forward_derivatives(q, v, u)
    assert np.allclose(held.A[3:, :3], slopes.q, rtol=1e-7, atol=1e-7)
    assert np.allclose(m.linearize((q, v), u=u).A, held.A)
    assert m.linearize((q, v)).unsteady is not None
    assert len(m.modes((q, v, u)).eigenvalues) > 0
    with pytest.raises(mbs.StartError, match="accelerates"):
        m.modes((q, v))
    with pytest.raises(mbs.UsageError) as refused:
        m.linearize((q, v, u[:1]))
    assert refused.value.hint == "give a number for each of: shoulder.motor, elbow.motor, grip.motor"


def test_derivatives_hold_where_a_joint_follows_another() -> None:
    m = mbs.Mechanism(FOLLOWER)
    q, v, effort = np.array([0.3, 0.7, 0.07]), np.array([0.5, -0.4, -0.04]), np.array([1.0, 2.0, 3.0])
    slopes, h = m.forward_derivatives(q, v, effort), 1e-6
    for given, found in (((1, 0, 0), slopes.q), ((0, 1, 0), slopes.v), ((0, 0, 1), slopes.u)):
        for j in range(3):
            step = h * np.eye(3)[j]
            ends = [m.forward_dynamics(q + s * given[0] * step, v + s * given[1] * step, effort + s * given[2] * step) for s in (1, -1)]
            # central differences of 1e-6 leave 1e-9 of the numbers, which are below a hundred
            assert np.allclose((ends[0] - ends[1]) / (2 * h), found[:, j], atol=2e-7)


ORDERED = """<mujoco><worldbody>
<body name="base" pos="0.1 0.2 1" euler="30 20 10"><freejoint name="root"/><geom type="box" size=".1 .2 .3"/>
 <body name="a" pos=".3 0 .1" euler="0 40 0"><joint name="ball" type="ball" pos="0.05 0 0"/><geom type="capsule" size=".02 .1" pos="0 0 .1"/>
  <body name="b" pos="0 0 .3" quat=".5 .5 -.5 .5"><joint name="h" axis="1 1 0" ref="10"/><joint name="s" type="slide" axis="0 0 1"/><geom type="sphere" size=".05" pos=".1 0 0"/></body></body></body>
</worldbody></mujoco>"""


CENTER = [0.422989355679998, -0.6625710888483446, 1.1615407632426664]
SPIN = [0.3033548172544617, -1.8444460176851392, 0.8177717133468271]
ENERGY = 4.094608053691007
"""Of the last body's centre, its angular velocity, and all kinetic energy: MuJoCo 4.0.0."""


def test_states_of_mujoco_are_states_of_the_mechanism() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        m = mbs.Mechanism(ORDERED)
    qpos = np.array([0.3, -0.2, 0.9, 0.8, 0.4, -0.4, 0.2, 0.5, 0.5, 0.1, -0.7, 0.6, 0.05])
    qvel = np.arange(1, 12) / 10.0
    q, v = m.from_qpos(qpos, qvel)
    center, _ = m.pose("b", q)
    assert np.allclose(center, CENTER, atol=NEAR)
    assert np.allclose(m.frame("b", q, v)["angular_velocity"], SPIN, atol=NEAR)
    assert abs(m.energies(q, v)[0] - ENERGY) < NEAR * ENERGY
    for sizes in (slice(3, 7), slice(7, 11)):
        qpos[sizes] /= np.linalg.norm(qpos[sizes])
    back, speed = m.to_qpos(q, v)
    assert np.allclose(back, qpos, atol=NEAR) and np.allclose(speed, qvel, atol=NEAR)
    with pytest.raises(mbs.UsageError, match=r"\(13,\)"):
        m.from_qpos([0.0])
    with pytest.raises(mbs.UsageError, match="no MJCF"):
        mbs.Mechanism(ARM).from_qpos([0.0])


BARE = """<robot name="bare">
  <link name="base"/><link name="upper"/><link name="fore"/><link name="hand"/>
  <joint name="shoulder" type="revolute"><origin xyz="0 0 0.5" rpy="0 0 0.3"/><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
    <limit effort="9" velocity="9" lower="-3" upper="3"/></joint>
  <joint name="elbow" type="revolute"><origin xyz="0.4 0 0"/><parent link="upper"/><child link="fore"/><axis xyz="0 0 1"/>
    <limit effort="9" velocity="9" lower="-3" upper="3"/></joint>
  <joint name="palm" type="fixed"><origin xyz="0.2 0.1 0" rpy="0.5 0 0"/><parent link="fore"/><child link="hand"/></joint>
</robot>
"""
"""An arm whose links have no inertia."""


def about(axis: int, angle: float) -> np.ndarray[Any, np.dtype[np.float64]]:
    i, j = (axis + 1) % 3, (axis + 2) % 3
    turn = np.eye(3)
    turn[i, i] = turn[j, j] = np.cos(angle)
    turn[j, i], turn[i, j] = np.sin(angle), -np.sin(angle)
    return turn


def hand(q: Any) -> tuple[Any, Any]:
    """Where the hand is, and its axes: a product of the rotations that the file writes."""
    upper = about(2, 0.3) @ about(1, q[0])
    fore = upper @ about(2, q[1])
    return np.array([0, 0, 0.5]) + upper @ [0.4, 0, 0] + fore @ [0.2, 0.1, 0], fore @ about(0, 0.5)


def test_frames_are_those_of_the_links_and_need_no_mass() -> None:
    m = mbs.Mechanism(BARE)
    q = np.array([0.7, -0.4])
    assert m.nq == 2
    place, axes = hand(q)
    found = m.frame("hand", q)
    assert np.allclose(found["position"], place, atol=NEAR) and np.allclose(found["rotation"], axes, atol=NEAR)
    # the Jacobian by differences of places
    step = 1e-6
    slopes = [(hand(q + step * e)[0] - hand(q - step * e)[0]) / (2 * step) for e in np.eye(2)]
    assert np.allclose(m.jacobian("hand", q)[:3], np.transpose(slopes), atol=1e-8)
    back = m.inverse_kinematics("hand", q + 0.2, position=place, rotation=axes)
    assert np.allclose(hand(back)[0], place, atol=1e-8) and np.allclose(hand(back)[1], axes, atol=1e-8)
    with pytest.raises(mbs.MbsError):
        m.accelerations(q, np.zeros(2))
    # the axes of a link at rest are those of its file, not those since the drawing
    assert np.allclose(m.frame("upper", [0.0, 0.0])["rotation"], about(2, 0.3), atol=NEAR)
