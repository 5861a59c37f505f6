"""Calls with many states give the bits of calls with one."""

from collections.abc import Callable
from typing import Any

import multibody as mbs
import numpy as np
import pytest
from conftest import scene

STARTS = 7
TREES = ["double-pendulum", "six-joint-arm", "spatial-chain-20", "free-body"]
SAME_METHOD = 1e-12
"""Rounding between two programs of rk4 over fifty steps."""

Array = np.ndarray[Any, np.dtype[np.float64]]
CALLS: dict[str, Callable[[mbs.Mechanism, Array, Array, Array], Array]] = {
    "accelerations": lambda m, q, v, a: m.accelerations(q, v),
    "forward_dynamics": lambda m, q, v, a: m.forward_dynamics(q, v, a),
    "inverse_dynamics": lambda m, q, v, a: m.inverse_dynamics(q, v, a),
    "mass_matrix": lambda m, q, v, a: m.mass_matrix(q),
    "bias": lambda m, q, v, a: m.bias(q, v),
    "gravity": lambda m, q, v, a: m.gravity(q),
    "jacobian": lambda m, q, v, a: m.jacobian(m.bodies[-1], [0.1, 0.2, 0.3][: m.dimension], q),
}


def states(mechanism: mbs.Mechanism, k: int = STARTS) -> tuple[Array, Array, Array]:
    random = np.random.default_rng(1)
    q, v = mechanism.initial()
    qs = np.array([mechanism.integrate(q, random.uniform(-0.5, 0.5, mechanism.nv)) for _ in range(k)])
    return qs, v + random.uniform(-1, 1, (k, mechanism.nv)), random.uniform(-1, 1, (k, mechanism.nv))


@pytest.mark.parametrize("name", TREES)
@pytest.mark.parametrize("call", CALLS)
def test_many_states_have_the_bits_of_each(name: str, call: str) -> None:
    mechanism = mbs.Mechanism(scene(name))
    q, v, a = states(mechanism)
    many = CALLS[call](mechanism, q, v, a)
    each = np.array([CALLS[call](mechanism, q[i], v[i], a[i]) for i in range(STARTS)])
    assert many.shape == each.shape
    assert many.tobytes() == each.tobytes()


def test_shapes_are_those_of_the_stub() -> None:
    mechanism = mbs.Mechanism(scene("six-joint-arm"))
    q, v, a = states(mechanism)
    assert mechanism.mass_matrix(q).shape == (STARTS, 6, 6)
    assert mechanism.jacobian("hand", [1, 0, 1], q).shape == (STARTS, 6, 6)
    assert mechanism.jacobian("hand", [1, 0, 1], q[0]).shape == (6, 6)
    assert [part.shape for part in mechanism.forward_derivatives(q[0], v[0], a[0])] == [(6, 6)] * 3
    assert mechanism.loop_jacobian(q[0]).shape[-1] == 6
    assert mechanism.accelerations(q[:0], v[:0]).shape == (0, 6)


@pytest.mark.parametrize("name", TREES)
def test_inverse_dynamics_undo_forward_dynamics(name: str) -> None:
    mechanism = mbs.Mechanism(scene(name))
    q, v, effort = states(mechanism)
    again = mechanism.inverse_dynamics(q, v, mechanism.forward_dynamics(q, v, effort))
    scale = max(1.0, float(np.abs(mechanism.inverse_dynamics(q, v, 0 * v)).max()))
    assert np.abs(again - effort).max() < SAME_METHOD * scale * 100  # condition of chains of twenty bodies


@pytest.mark.parametrize("wrong", [lambda q: np.asfortranarray(q), lambda q: q.astype(np.float32), lambda q: q.tolist(), lambda q: q[::2]])
def test_strict_calls_take_no_conversion(wrong: Callable[[Array], Any]) -> None:
    mechanism = mbs.Mechanism(scene("double-pendulum"))
    q = states(mechanism)[0]
    assert mechanism.mass_matrix(q, strict=True).shape == (STARTS, 2, 2)
    assert mechanism.mass_matrix(wrong(q)).shape[1:] == (2, 2)
    with pytest.raises(TypeError):
        mechanism.mass_matrix(wrong(q), strict=True)


def test_arrays_that_are_not_aligned_are_converted() -> None:
    mechanism = mbs.Mechanism(scene("double-pendulum"))
    q, v, _ = states(mechanism)
    # an array within a message of a cluster
    odd_q, odd_v = (np.frombuffer(b"x" + part.tobytes(), dtype=np.uint8)[1:].view(np.float64).reshape(part.shape) for part in (q, v))
    assert not odd_q.flags.aligned
    assert mechanism.mass_matrix(odd_q).tobytes() == mechanism.mass_matrix(q).tobytes()
    assert mechanism.rollout(odd_q, odd_v, steps=5).q.tobytes() == mechanism.rollout(q, v, steps=5).q.tobytes()
    simulation = mechanism.simulate()
    simulation.set_state(odd_q[0], odd_v[0])
    assert np.abs(simulation.q - q[0]).max() < SAME_METHOD


@pytest.mark.parametrize("name", ["double-pendulum", "spatial-chain-20", "simple-pendulum"])
def test_a_rollout_is_a_simulation_from_each_start(name: str) -> None:
    mechanism = mbs.Mechanism(scene(name))
    q, v, _ = states(mechanism, 3)
    motion = mechanism.rollout(q, v, None, 1e-3, steps=50)
    assert motion.ok.all() and not motion.errors
    simulation = mechanism.simulate(formulation="recursive", integrator="rk4", step=1e-3)
    for i in range(3):
        simulation.reset()
        simulation.set_state(q[i], v[i])
        for k in range(1, 51):
            simulation.step(1e-3)
            assert np.abs(simulation.q - motion.q[i, k]).max() < SAME_METHOD
            assert np.abs(simulation.v - motion.v[i, k]).max() < SAME_METHOD


def test_a_rollout_takes_inputs() -> None:
    mechanism = mbs.Mechanism(scene("servo-arm"))
    q, v, _ = states(mechanism, 3)
    u = np.zeros((3, 20, mechanism.nu))
    motion = mechanism.rollout(q, v, u, 1e-3)
    assert motion.q.shape == (3, 21, mechanism.nq)
    pushed = mechanism.rollout(q, v, u + 0.1, 1e-3)
    assert not np.array_equal(motion.q[:, -1], pushed.q[:, -1])
    with pytest.raises(mbs.UsageError):
        mechanism.rollout(q, v, u[:, :, :2], 1e-3)


@pytest.mark.parametrize("integrator", ["rk4", "trapezoidal"])
def test_threads_do_not_change_bits(integrator: Any) -> None:
    mechanism = mbs.Mechanism(scene("six-joint-arm"))
    q, v, _ = states(mechanism, 16)
    one, two = (mechanism.rollout(q, v, None, 1e-3, steps=20, threads=n, integrator=integrator) for n in (1, 2))
    assert one.q.tobytes() == two.q.tobytes()
    assert one.v.tobytes() == two.v.tobytes()


def test_a_start_that_fails_leaves_the_others() -> None:
    mechanism = mbs.Mechanism(scene("double-pendulum"))
    q, v, _ = states(mechanism, 4)
    good = mechanism.rollout(q, v, None, 1e-3, steps=20)
    v[2] = 1e200  # its square is no number
    bad = mechanism.rollout(q, v, None, 1e-3, steps=20)
    assert bad.ok.tolist() == [True, True, False, True]
    assert list(bad.errors) == [2]
    assert bad.errors[2].hint
    assert np.isnan(bad.q[2, -1]).all()
    others = [0, 1, 3]
    assert bad.q[others].tobytes() == good.q[others].tobytes()
