"""Linearised motions with a closed form."""

from __future__ import annotations

import json
import math
import pickle
import subprocess
import sys
from pathlib import Path
from typing import Any

import multibody as mbs
import numpy as np
import pytest
from conftest import scene

MASS, STIFFNESS, DAMPING = 2.0, 50.0, 3.0
EXACT = 1e-9
"""Of derivatives that are not made by differences, on numbers up to 25."""


def mass_on_a_spring() -> mbs.Mechanism:
    b = mbs.Mechanism.build("mass on a spring", dimension=2)
    b.duration(1.0)
    cart = b.body("cart", mass=MASS, center=[0, 0], inertia=1.0)
    rail = b.joint("rail", "prismatic", [b.ground, cart], at=[0, 0], axis=[1, 0])
    b.effect("spring", "spring-damper", terms=[{"joint": rail, "factor": 1.0}], stiffness=STIFFNESS, damping=DAMPING)
    b.effect("motor", "torque", joint=rail, coordinate="slide", signal=b.input("push", unit="N"))
    b.output("place", "value", joint=rail)
    b.output("speed", "rate", joint=rail)
    b.output("acceleration", "acceleration", body=cart)
    return b.done()


@pytest.mark.parametrize("at", ["initial", "equilibrium", "moving", (np.zeros(1), np.zeros(1))])
def test_a_mass_on_a_spring_has_its_matrices(at: mbs.StateLike) -> None:
    linear = mass_on_a_spring().linearize(at)
    row = [-STIFFNESS / MASS, -DAMPING / MASS]
    assert np.abs(linear.A - [[0, 1], row]).max() < EXACT
    assert np.abs(linear.B - [[0], [1 / MASS]]).max() < EXACT
    assert linear.inputs == ["push"]
    assert linear.outputs == ["place", "speed", "acceleration.x", "acceleration.y"]
    assert np.abs(linear.C - [[1, 0], [0, 1], row, [0, 0]]).max() < EXACT
    assert np.abs(linear.D - [[0], [0], [1 / MASS], [0]]).max() < EXACT
    assert len(linear.states) == 2


def test_matrices_of_an_instant_say_what_accelerates() -> None:
    pendulum = mbs.Mechanism(scene("simple-pendulum"))
    assert pendulum.linearize("equilibrium").unsteady is None
    linear = pendulum.linearize("initial")
    unsteady = linear.unsteady
    assert unsteady is not None
    state = pendulum.initial()
    fall = pendulum.forward_dynamics(state.q, state.v, [0.0])[0]
    assert unsteady["state"] == linear.states[0]
    assert unsteady["unit"] == "rad/s^2"
    assert unsteady["by"] == pytest.approx(fall, rel=1e-9)
    a, b, c, d, states, inputs, outputs = linear
    assert a.shape == (2, 2) and len(states) == 2
    again = pickle.loads(pickle.dumps(linear))
    assert again.unsteady == unsteady and again.states == states


def test_inputs_and_outputs_are_chosen_by_name() -> None:
    linear = mass_on_a_spring().linearize("initial", inputs=[], outputs=["speed"])
    assert linear.B.shape == (2, 0)
    assert np.abs(linear.C - [[0, 1]]).max() < EXACT
    assert linear.D.shape == (1, 0)
    with pytest.raises(mbs.UsageError):
        mass_on_a_spring().linearize("initial", outputs=["sped"])


def test_a_mass_on_a_spring_has_its_mode() -> None:
    modes = mass_on_a_spring().modes()
    decay = DAMPING / (2 * MASS)
    frequency = math.sqrt(STIFFNESS / MASS - decay**2)
    assert modes.eigenvalues[0] == pytest.approx(-decay + 1j * frequency, rel=EXACT)
    assert modes.frequencies[0] == pytest.approx(frequency / (2 * math.pi), rel=EXACT)
    assert modes.damping[0] == pytest.approx(decay / math.sqrt(STIFFNESS / MASS), rel=EXACT)


def test_shapes_have_largest_number_one() -> None:
    modes = mbs.Mechanism(scene("quarter-car")).modes()
    n = len(modes.eigenvalues)
    assert modes.shapes.shape == (n, len(modes.states))
    assert np.abs(modes.shapes).max(axis=1) == pytest.approx(np.ones(n))
    published = [-3.52349506 + 9.87441993j, -22.24074845 + 88.57146051j]  # of scenes/quarter-car.toml, to 1e-8
    assert sorted(modes.eigenvalues, key=abs) == pytest.approx(published, abs=2e-8)
    assert modes.frequencies.shape == modes.damping.shape == (n,)


def test_eigenvalues_of_modes_are_those_of_the_matrix() -> None:
    mechanism = mbs.Mechanism(scene("quarter-car"))
    values = np.linalg.eigvals(mechanism.linearize().A)
    upper = sorted(values[values.imag > 0], key=abs)
    assert upper == pytest.approx(sorted(mechanism.modes().eigenvalues, key=abs), rel=1e-6)


def test_an_equilibrium_is_a_state_without_accelerations() -> None:
    mechanism = mbs.Mechanism(scene("quarter-car"))
    equilibrium = mechanism.equilibrium()
    assert equilibrium.is_stable
    q, v = equilibrium.state
    assert not v.any()
    assert np.abs(mechanism.accelerations(q, v)).max() < 1e-6  # of 9.81 m/s^2
    assert equilibrium.outputs["wheel"][1] == pytest.approx(0.35638423152, abs=1e-9)


def modes_of_command(name: str, at: str, *options: str) -> tuple[dict[str, Any], list[complex]]:
    """The JSON of `mbs modes`, and its eigenvalues."""
    program = Path(sys.executable).with_name("mbs")
    done = subprocess.run([program, "modes", scene(name), "--at", at, "--json", *options], capture_output=True, text=True)
    said = json.loads(done.stdout)
    return said, [complex(mode["real"], mode["imaginary"]) for mode in said.get("modes", [])]


@pytest.mark.parametrize("at", ["equilibrium", "initial", "moving"])
@pytest.mark.parametrize(
    "name", ["quarter-car", "iltis-links", "double-pendulum", "spinning-top", "free-body", "servo-arm", "rolling-disc"]
)
def test_command_and_package_give_the_same_eigenvalues_or_the_same_refusal(name: str, at: str) -> None:
    mechanism = mbs.Mechanism(scene(name))
    said, of_command = modes_of_command(name, at)
    try:
        modes = mechanism.modes(at)
    except mbs.MbsError as refused:
        assert refused.code == said["error"]["code"]
        if refused.code != "not-steady":
            return
        modes = mechanism.modes(at, frozen=True)
        assert modes.summary["stable"] is None
        said, of_command = modes_of_command(name, at, "--frozen")
    assert list(modes.eigenvalues) == of_command
    assert modes.summary["modes"] == said["modes"]


def test_a_spinning_rotor_whirls_and_its_eigenvalues_are_those_of_the_command() -> None:
    """Values of closed form, to 1e-9."""
    rotor = scene("spinning-top").parents[1] / "mbs/tests/field/23-whirl-of-a-rotor.toml"
    mechanism = mbs.Mechanism(rotor)
    modes = mechanism.modes("initial")
    whirl = [44.274661460, 170.736245313]
    assert sorted(modes.eigenvalues.imag)[-2:] == pytest.approx(whirl, rel=1e-9)
    assert modes.summary["stable"]
