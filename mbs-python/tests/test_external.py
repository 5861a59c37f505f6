"""External forces in dynamics, steps and rollouts."""

from __future__ import annotations

from typing import Any

import multibody as mbs
import numpy as np
import pytest

NEAR = 1e-12
"""Rounding of numbers of about one."""


def pendulum() -> mbs.Mechanism:
    """Two kilograms at 0.5 m below a pin along y; the hand is at 1 m."""
    b = mbs.Mechanism.build("pendulum")
    b.gravity([0, 0, 0])
    b.duration(1.0)
    bar = b.body("bar", mass=2.0, center=[0, 0, -0.5], inertia=[0.1, 0.1, 0.01, 0, 0, 0])
    pin = b.joint("pin", "revolute", [b.ground, bar], at=[0, 0, 0], axis=[0, 1, 0])
    b.frame("hand", body=bar, at=[0, 0, -1.0])
    b.effect("motor", "torque", joint=pin, signal=b.input("drive", unit="N m"))
    return b.done()


INERTIA = 0.1 + 2.0 * 0.25
"""About the pin [kg m^2]."""


def test_a_force_at_a_frame_and_a_moment_turn_a_pendulum() -> None:
    m = pendulum()
    q, v = np.array([0.4]), np.array([0.0])
    # turned about y by q the hand is at (-sin q, 0, -cos q); its force (3, 0, 2) has the moment z Fx - x Fz about y
    moment = -np.cos(0.4) * 3.0 + np.sin(0.4) * 2.0 + 0.7
    push = {"hand": ([3.0, 5.0, 2.0], [9.0, 0.7, 9.0])}
    assert abs(m.accelerations(q, v, [0.3], f_ext=push)[0] - (moment + 0.3) / INERTIA) < NEAR
    assert abs(m.forward_dynamics(q, v, [0.3], f_ext=push)[0] - (moment + 0.3) / INERTIA) < NEAR
    assert abs(m.inverse_dynamics(q, v, [0.0], f_ext=push)[0] + moment) < NEAR
    assert m.accelerations([[0.4], [0.0]], [[0.0], [0.0]], f_ext=push).shape == (2, 1)


def test_steps_and_rollouts_under_a_force_are_one_motion() -> None:
    m = pendulum()
    push: dict[str, Any] = {"hand": [1.0, 0, 0.5, 0, 0.1, 0]}
    rollout = m.rollout([[0.1]], [[0.2]], np.full((50, 1), 0.3), 1e-3, f_ext=push)
    sim = m.with_forces("hand").simulate(formulation="recursive", integrator="rk4", step=1e-3)
    sim.set_state([0.1], [0.2])
    for _ in range(50):
        sim.step(u=[0.3], f_ext=push)
    assert np.array_equal(rollout.q[0, -1], sim.q)
    # without a word forces hold, and without a name they end
    assert sim.u.tolist() == [1.0, 0, 0.5, 0, 0.1, 0, 0.3]
    sim.step(u=[0.0])
    assert sim.u.tolist() == [1.0, 0, 0.5, 0, 0.1, 0, 0.0]
    sim.step(f_ext={})
    assert sim.u.tolist() == [0.0] * 7
    rows = m.rollout([0.1], [0.2], f_ext={"hand": np.zeros((3, 6))})
    assert rows.q.shape[-2] == 4


def test_a_force_in_the_plane_has_three_numbers() -> None:
    b = mbs.Mechanism.build("arm", dimension=2)
    b.gravity([0, 0])
    b.duration(1.0)
    arm = b.body("arm", mass=2.0, center=[0.5, 0.0], inertia=0.1)
    b.joint("pin", "revolute", [b.ground, arm], at=[0, 0])
    m = b.done()
    assert m.with_forces("arm").inputs == ["arm.force.x", "arm.force.y", "arm.moment"]
    found = m.accelerations([0.0], [0.0], f_ext={"arm": ([1.0, 3.0], [0.5])})
    assert abs(found[0] - (0.5 * 3.0 + 0.5) / INERTIA) < NEAR


def test_forces_that_cannot_be_meant_are_refused() -> None:
    m = pendulum()
    q, v = [0.0], [0.0]
    calls: list[tuple[str, Any]] = [
        ("no frame `hnd`", lambda: m.accelerations(q, v, f_ext={"hnd": ([0, 0, 0], [0, 0, 0])})),
        ("no force and moment", lambda: m.accelerations(q, v, f_ext={"hand": [1, 2]})),
        ("no dict", lambda: m.accelerations(q, v, f_ext=3)),  # type: ignore[arg-type]
        ("takes no force on `hand`", lambda: m.simulate().step(f_ext={"hand": [0] * 6})),
        ("no force and moment", lambda: m.rollout(q, v, steps=2, f_ext={"hand": [0] * 5})),
        ("2 steps", lambda: m.rollout(q, v, np.zeros((3, 1)), f_ext={"hand": np.zeros((2, 6))})),
        ("is expected", lambda: m.rollout(q, v, np.zeros((3, 2)), f_ext={"hand": [0] * 6})),
    ]
    for words, call in calls:
        with pytest.raises(mbs.UsageError, match=words):
            call()
