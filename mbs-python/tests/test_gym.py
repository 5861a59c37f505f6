"""Mechanisms are environments of Gymnasium."""

from __future__ import annotations

from typing import Any

import multibody as mbs
import numpy as np
import pytest
from conftest import needs

gymnasium = needs("gymnasium")

from multibody.gym import MechanismEnv, MechanismVectorEnv  # noqa: E402  # it needs gymnasium

EPISODE = 25
"""Actions of an episode: some ends within the hundred of a test."""


def cart_pole() -> mbs.Mechanism:
    b = mbs.Mechanism.build("cart and pole", dimension=2)
    b.gravity([0.0, -9.81])
    b.duration(10.0)
    cart = b.body("cart", mass=1.0, center=[0, 0], inertia=0.1)
    pole = b.body("pole", mass=0.1, rod={"from": [0, 0], "to": [0, 1]})
    rail = b.joint("rail", "prismatic", [b.ground, cart], at=[0, 0], axis=[1, 0])
    b.joint("hinge", "revolute", [cart, pole], at=[0, 0])
    b.effect("motor", "torque", joint=rail, coordinate="slide", signal=b.input("push", unit="N"))
    b.output("tip", body=pole, at=[0, 1])
    return b.done()


def settings(**others: Any) -> dict[str, Any]:
    return {
        "dt": 0.02,
        "substeps": 4,
        "action": {"push": (-10.0, 10.0)},
        "reward": lambda seen, action, simulation: 1.0 - abs(seen[1]),
        "terminated": lambda seen, action, simulation: abs(seen[1]) > 0.1,
        "reset_noise": 0.05,
        "max_steps": EPISODE,
        **others,
    }


@pytest.mark.parametrize("others", [{}, {"outputs": ["tip"]}, {"formulation": "recursive", "integrator": "rk4"}, {"reset_noise": 0.0}])
@pytest.mark.filterwarnings("error")
def test_it_passes_the_checks_of_gymnasium(others: dict[str, Any]) -> None:
    checker = needs("gymnasium.utils.env_checker")
    env = MechanismEnv(cart_pole(), **settings(**others))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(env, "spec", gymnasium.envs.registration.EnvSpec("CartAndPole-v0", entry_point=lambda: env), raising=False)
        import warnings

        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", message=".*infinity.*")  # coordinates have no limits
            warnings.filterwarnings("ignore", message=".*normalized.*")  # forces are in newtons
            checker.check_env(env, skip_render_check=True, skip_close_check=True)


def test_a_seed_makes_an_episode() -> None:
    def episode(seed: int) -> list[float]:
        env = MechanismEnv(cart_pole(), **settings())
        seen, _ = env.reset(seed=seed)
        all_seen = [seen]
        for _ in range(10):
            all_seen.append(env.step(np.array([1.0]))[0])
        return [float(number) for number in np.concatenate(all_seen)]

    assert episode(1) == episode(1)
    assert episode(1) != episode(2)


def test_an_action_is_a_force() -> None:
    env = MechanismEnv(cart_pole(), **settings(reset_noise=0.0, terminated=None))
    env.reset()
    seen, _, _, _, _ = env.step(np.array([99.0]))  # clipped to 10 N
    assert env.simulation.u.tolist() == [10.0]
    assert 0.0 < seen[2] < 10.0 / 1.0 * 0.02


def test_an_episode_ends() -> None:
    env = MechanismEnv(cart_pole(), **settings(reset_noise=0.0, terminated=None))
    env.reset()
    ends = [env.step(np.array([0.0]))[2:4] for _ in range(EPISODE)]
    assert ends == [(False, False)] * (EPISODE - 1) + [(False, True)]


def test_a_step_that_cannot_be_made_truncates() -> None:
    env = MechanismEnv(cart_pole(), **settings(action={"push": (-1e308, 1e308)}))
    env.reset(seed=1)
    outcome = env.step(np.array([1e308]))
    assert outcome[3]
    assert isinstance(outcome[4]["error"], mbs.MbsError)


def test_an_unknown_input_is_refused() -> None:
    with pytest.raises(mbs.UsageError, match="pull"):
        MechanismEnv(cart_pole(), **settings(action={"pull": (0.0, 1.0)}))


@pytest.mark.parametrize(("argument", "value"), [("substeps", 0), ("outputs", []), ("action", ["push"])])
def test_a_wrong_argument_is_named(argument: str, value: Any) -> None:
    with pytest.raises(mbs.UsageError) as caught:
        MechanismEnv(cart_pole(), **settings(**{argument: value}))
    assert caught.value.argument == argument


@pytest.mark.parametrize("argument", ["num_envs", "threads"])
def test_a_vector_has_members_and_threads(argument: str) -> None:
    with pytest.raises(mbs.UsageError) as caught:
        MechanismVectorEnv(cart_pole(), **{"num_envs": 1, argument: 0}, **settings())
    assert caught.value.argument == argument


@pytest.mark.parametrize("threads", [1, 2])
def test_a_vector_of_environments_is_each_of_them(threads: int) -> None:
    mechanism = cart_pole()
    one = gymnasium.vector.SyncVectorEnv([lambda: MechanismEnv(mechanism, **settings())] * 5)
    two = MechanismVectorEnv(mechanism, 5, threads=threads, **settings())
    assert two.action_space == one.action_space
    assert two.observation_space == one.observation_space
    assert two.reset(seed=3)[0].tobytes() == one.reset(seed=3)[0].tobytes()
    random = np.random.default_rng(4)
    ended = 0
    for _ in range(100):
        actions = random.uniform(-10, 10, (5, 1))
        a, b = one.step(actions), two.step(actions)
        for x, y in zip(a[:4], b[:4], strict=True):
            assert np.asarray(x).tobytes() == np.asarray(y).tobytes()
        ended += int((b[2] | b[3]).sum())
    assert ended > 5
    two.close()
