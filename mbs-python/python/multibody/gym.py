"""Mechanisms as environments of Gymnasium: `from multibody.gym import MechanismEnv`.

An action sets inputs of the mechanism and holds them over `dt` [s]. An observation is q and v, or outputs by name.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from . import MbsError, Mechanism, Simulation, StopError, UsageError
from .render import Picture, Renderer, browser

Array = NDArray[np.float64]
Flags = NDArray[np.bool_]
Reward = Callable[[Array, Array, Simulation], float]
"""Of an observation, the action before it, and the simulation there."""
Terminated = Callable[[Array, Array, Simulation], bool]


class MechanismEnv(gymnasium.Env[Array, Array]):
    """A mechanism as an environment.

    dt: time between actions [s], made in `substeps` equal steps. action: inputs by name, each with its least and largest value; an action
    beyond them is clipped. outputs: names of outputs to observe; None: q and v. reward, terminated: functions of observation, action and
    simulation; None: 0 and never. reset_noise: largest random change of each coordinate and velocity at a reset. max_steps: actions of an
    episode; None: no end. render_mode: `"rgb_array"` lets `render` draw the mechanism where it is, `size` wide and high, by
    `multibody.render`. settings: those of `Mechanism.simulate`. A step that cannot be made ends the episode: it is truncated, and
    `info["error"]` has the error.
    """

    metadata = {"render_modes": ["rgb_array"]}

    def __init__(
        self,
        mechanism: Mechanism,
        *,
        dt: float,
        action: Mapping[str, tuple[float, float]],
        render_mode: str | None = None,
        size: tuple[int, int] = (640, 480),
        substeps: int = 1,
        reward: Reward | None = None,
        terminated: Terminated | None = None,
        reset_noise: float = 0.0,
        outputs: Sequence[str] | None = None,
        max_steps: int | None = None,
        **settings: Any,
    ) -> None:
        _check_count("substeps", substeps)
        if not isinstance(action, Mapping):
            hint = "give {NAME: (least, largest)}"
            raise UsageError("action is no dict", code="wrong-type", argument="action", hint=hint)
        if outputs is not None and len(outputs) == 0:
            hint = "name an output, or leave outputs out"
            raise UsageError("outputs has no name", code="wrong-shape", argument="outputs", hint=hint)
        if render_mode not in (None, "rgb_array"):
            hint = 'give "rgb_array", or None'
            raise UsageError(f"there is no render mode `{render_mode}`", code="unknown-name", argument="render_mode", hint=hint)
        if render_mode is not None:
            # an environment that cannot draw is refused here, not at its first picture
            browser()
        self.metadata = self.metadata | {"render_fps": max(1, round(1.0 / dt))}
        self.render_mode = render_mode
        self._size = size
        self._renderer: Renderer | None = None
        self.mechanism = mechanism
        self._simulation = mechanism.simulate(step=dt / substeps, **settings)
        self._step, self._substeps = dt / substeps, substeps
        self._reward, self._terminated = reward, terminated
        self._noise, self._outputs, self._max_steps = reset_noise, outputs, max_steps
        self._places = [_place(mechanism, name) for name in action]
        self._start = self._simulation.u
        self._action = np.zeros(len(action))
        self._error: MbsError | None = None
        self._count = 0
        low, high = np.array(list(action.values()), dtype=np.float64).reshape(-1, 2).T
        self.action_space = gymnasium.spaces.Box(low, high, dtype=np.float64)
        n = self._observation().size
        self.observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (n,), dtype=np.float64)

    @property
    def simulation(self) -> Simulation:
        """The simulation, which the next step moves."""
        return self._simulation

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Array, dict[str, Any]]:
        super().reset(seed=seed)
        self._simulation.reset()
        if self._noise > 0.0:
            self._scatter()
        self._count = 0
        return self._observation(), {}

    def step(self, action: Array) -> tuple[Array, float, bool, bool, dict[str, Any]]:
        self._advance(action)
        return self._outcome()

    def render(self) -> Picture | None:
        """The picture of the mechanism where it is, (height, width, 3); None without a `render_mode`."""
        if self.render_mode is None:
            return None
        if self._renderer is None:
            self._renderer = Renderer(self.mechanism, *self._size)
        return self._renderer.picture(self._simulation)

    def close(self) -> None:
        if self._renderer is not None:
            self._renderer.close()
            self._renderer = None

    def _scatter(self) -> None:
        q, v = self.mechanism.initial()
        change = self._noise * self.np_random.uniform(-1.0, 1.0, 2 * v.size)
        self._simulation.set_state(self.mechanism.integrate(q, change[: v.size]), v + change[v.size :])

    def _advance(self, action: Array) -> None:
        """The part of a step that needs no Python: threads may do it for several environments."""
        self._action = np.clip(np.asarray(action, dtype=np.float64), self.action_space.low, self.action_space.high)  # type: ignore[attr-defined]
        u = self._start.copy()
        u[self._places] = self._action
        self._error = None
        try:
            self._simulation.steps(self._step, self._substeps, u)
        except StopError as error:
            self._error = error

    def _outcome(self) -> tuple[Array, float, bool, bool, dict[str, Any]]:
        self._count += 1
        seen = self._observation()
        arguments = seen, self._action, self._simulation
        reward = 0.0 if self._reward is None else float(self._reward(*arguments))
        is_terminated = self._terminated is not None and bool(self._terminated(*arguments))
        is_truncated = self._error is not None or self._count == self._max_steps
        return seen, reward, is_terminated, is_truncated, {} if self._error is None else {"error": self._error}

    def _observation(self) -> Array:
        if self._outputs is None:
            return np.concatenate((self._simulation.q, self._simulation.v))
        return np.concatenate([self._simulation.output(name) for name in self._outputs])


class MechanismVectorEnv(gymnasium.vector.VectorEnv[Array, Array, NDArray[Any]]):
    """Environments of one mechanism, stepped by threads. `settings` are those of MechanismEnv.

    It has the numbers of gymnasium's SyncVectorEnv over such environments. One that ended is reset by the next step.
    """

    metadata = {"render_modes": [], "autoreset_mode": gymnasium.vector.AutoresetMode.NEXT_STEP}
    render_mode = None

    def __init__(self, mechanism: Mechanism, num_envs: int, *, threads: int = 1, **settings: Any) -> None:
        _check_count("num_envs", num_envs)
        _check_count("threads", threads)
        self.envs = [MechanismEnv(mechanism, **settings) for _ in range(num_envs)]
        self.num_envs = num_envs
        self.single_action_space = self.envs[0].action_space
        self.single_observation_space = self.envs[0].observation_space
        self.action_space = batch_space(self.single_action_space, num_envs)
        self.observation_space = batch_space(self.single_observation_space, num_envs)
        self._is_over = np.zeros(num_envs, dtype=np.bool_)
        self._shares = [range(i, num_envs, threads) for i in range(min(threads, num_envs))]
        self._pool = ThreadPoolExecutor(threads) if threads > 1 else None

    def reset(self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, Any] | None = None) -> tuple[Array, dict[str, Any]]:
        """Resets all. A seed is that of the first environment, and the next ones take the next numbers."""
        seeds = [None if seed is None else seed + i for i in range(self.num_envs)] if not isinstance(seed, Sequence) else seed
        self._is_over[:] = False
        return np.stack([env.reset(seed=seed)[0] for env, seed in zip(self.envs, seeds, strict=True)]), {}

    def step(self, actions: Array) -> tuple[Array, Array, Flags, Flags, dict[str, Any]]:
        """Steps all but those that ended in the step before: these are reset."""
        self._advance(actions)
        infos: dict[str, Any] = {}
        outcomes = [self._outcome(i) for i in range(self.num_envs)]
        for i, outcome in enumerate(outcomes):
            infos = self._add_info(infos, outcome[4], i)
        seen, rewards, terminated, truncated, _ = zip(*outcomes)
        ends = np.array(terminated), np.array(truncated)
        self._is_over = ends[0] | ends[1]
        return np.stack(seen), np.array(rewards), *ends, infos

    def close_extras(self, **kwargs: Any) -> None:
        if self._pool is not None:
            self._pool.shutdown()

    def _advance(self, actions: Array) -> None:
        def advance(share: range) -> None:
            for i in share:
                if not self._is_over[i]:
                    self.envs[i]._advance(actions[i])

        if self._pool is None:
            advance(range(self.num_envs))
        else:
            list(self._pool.map(advance, self._shares))

    def _outcome(self, i: int) -> tuple[Array, float, bool, bool, dict[str, Any]]:
        if self._is_over[i]:
            seen, info = self.envs[i].reset()
            return seen, 0.0, False, False, info
        return self.envs[i]._outcome()


def _check_count(name: str, number: int) -> None:
    if number < 1:
        raise UsageError(f"{name} is {number}", code="no-count", argument=name, hint="give a whole number, one or more")


def _place(mechanism: Mechanism, name: str) -> int:
    if name not in mechanism.inputs:
        known = ", ".join(mechanism.inputs) or "none"
        raise UsageError(f"there is no input `{name}`", code="unknown-name", argument="action", hint=f"inputs: {known}")
    return mechanism.inputs.index(name)
