"""Dynamics of multibody systems: mechanisms, vehicles, robots. SI units, global axes.

q has the coordinates and v the velocities of a mechanism in relative coordinates. Joints stand in the order of the scene; bodies that no
joint holds come last. A ball has a unit quaternion (w, x, y, z) in q and its angular velocity, in axes of the second body, in v.
`Mechanism.coordinates` says where the numbers of a joint stand.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from os import PathLike
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import BusyError as BusyError
from .errors import MbsError as MbsError
from .errors import SceneError as SceneError
from .errors import StartError as StartError
from .errors import StopError as StopError
from .errors import UsageError as UsageError
from .builder import Builder as Builder
from .result import Result as Result

Array = NDArray[np.float64]

__version__: str

class State(NamedTuple):
    """A state: coordinates q (nq,) and velocities v (nv,)."""

    q: Array
    v: Array

class Equilibrium(NamedTuple):
    """A static equilibrium."""

    state: State
    is_stable: bool | None
    """None where the motion about it cannot be linearised."""
    joints: dict[str, list[float]]
    """Joint coordinates [rad, m]."""
    reactions: dict[str, list[float]]
    """What the first body of each joint does to the second [N, N m]."""
    outputs: dict[str, list[float]]
    summary: dict[str, Any]
    """The object of `mbs equilibrium --json`."""

class Modes(NamedTuple):
    """Eigenvalues of the linearised motion, from the slowest to the fastest, conjugate ones once."""

    eigenvalues: NDArray[np.complex128]
    """Eigenvalues [1/s], (n,)."""
    frequencies: Array
    """Damped frequencies [Hz], (n,)."""
    damping: Array
    """Damping ratios [-], (n,); NaN for neutral modes."""
    shapes: NDArray[np.complex128]
    """Shapes, (n, states): how the coordinates of `states` move; the largest number of each is 1."""
    states: list[str]
    """Names of independent joint coordinates."""
    summary: dict[str, Any]
    """The object of `mbs modes --json`."""

class Linear(NamedTuple):
    """dx/dt = A x + B u, y = C x + D u about a state, in independent coordinates and their rates, then the states of signals."""

    A: Array
    B: Array
    C: Array
    D: Array
    states: list[str]
    inputs: list[str]
    outputs: list[str]

class Rollout(NamedTuple):
    """Motions from many starts."""

    q: Array
    """Coordinates, (k, steps + 1, nq); NaN behind a step that failed."""
    v: Array
    """Velocities, (k, steps + 1, nv)."""
    ok: NDArray[np.bool_]
    """Was the whole motion made? (k,)"""
    errors: dict[int, MbsError]
    """Why not, by the number of the start."""

class Finding(NamedTuple):
    """A finding of the doctor."""

    code: str
    severity: Literal["fault", "doubt", "note"]
    message: str
    remedy: str
    summary: dict[str, Any]

class Derivatives(NamedTuple):
    """Derivatives of accelerations by positions, velocities and efforts, or of efforts by positions, velocities and accelerations."""

    q: Array
    v: Array
    u: Array

class Table:
    """A table of a sweep: one row for each member."""

    columns: list[str]
    rows: list[list[str]]
    def __len__(self) -> int: ...
    def __getitem__(self, name: str) -> Array: ...
    def frame(self) -> dict[str, Array | list[str]]: ...
    def to_csv(self) -> str: ...
    @property
    def failures(self) -> dict[int, tuple[str, str]]: ...

Source = str | PathLike[str] | Mapping[str, Any]
StateLike = State | Equilibrium | tuple[ArrayLike, ArrayLike] | Literal["equilibrium", "initial", "moving"]

class Mechanism:
    """A mechanism, checked and immutable. Threads may share it.

    `source` is the path of a scene (TOML, JSON) or of a model (URDF, MJCF, SDF), the text of a scene, or a scene as a dict.
    A text has more than one line.
    """

    def __init__(self, source: Source) -> None: ...
    @staticmethod
    def build(name: str, dimension: Literal[2, 3] = 3) -> Builder: ...
    @property
    def name(self) -> str: ...
    @property
    def dimension(self) -> int: ...
    @property
    def bodies(self) -> list[str]: ...
    @property
    def joints(self) -> list[str]: ...
    @property
    def effects(self) -> list[str]: ...
    @property
    def inputs(self) -> list[str]: ...
    @property
    def input_units(self) -> dict[str, str]: ...
    @property
    def outputs(self) -> list[str]: ...
    @property
    def output_units(self) -> dict[str, str]: ...
    @property
    def frames(self) -> list[str]: ...
    @property
    def nq(self) -> int: ...
    @property
    def nv(self) -> int: ...
    @property
    def nu(self) -> int: ...
    @property
    def dof(self) -> int: ...
    @property
    def duration(self) -> float: ...
    @property
    def text(self) -> str: ...
    def to_dict(self) -> dict[str, Any]: ...
    def coordinates(self, joint: str) -> tuple[slice, slice]: ...
    def get(self, path: str) -> float: ...
    def replace(self, values: Mapping[str, float] | None = None, **paths: float) -> Mechanism: ...
    def reference(self) -> State: ...
    def initial(self) -> State: ...
    def explain(self) -> dict[str, Any]: ...
    def doctor(self) -> list[Finding]: ...
    def run(
        self,
        duration: float | None = None,
        *,
        step: float | None = None,
        formulation: str | None = None,
        integrator: str | None = None,
        precision: Literal["f64", "f32", "dd"] | None = None,
        error: float | None = None,
        inputs: Mapping[str, ArrayLike] | None = None,
        progress: Callable[[float, float], object] | None = None,
        threads: int = 1,
        **settings: Any,
    ) -> Result: ...
    def simulate(
        self,
        *,
        step: float | None = None,
        formulation: str | None = None,
        integrator: str | None = None,
        precision: Literal["f64", "f32", "dd"] | None = None,
        threads: int = 1,
        **settings: Any,
    ) -> Simulation: ...
    def equilibrium(self, search: Literal["down", "near"] = "down") -> Equilibrium: ...
    def modes(self, at: Literal["equilibrium", "initial", "moving"] = "equilibrium") -> Modes: ...
    def linearize(
        self,
        at: StateLike = "equilibrium",
        inputs: Sequence[str] | None = None,
        outputs: Sequence[str] | None = None,
    ) -> Linear: ...
    def accelerations(self, q: ArrayLike, v: ArrayLike, u: ArrayLike | None = None, *, time: float = 0.0, strict: bool = False) -> Array: ...
    def forward_dynamics(self, q: ArrayLike, v: ArrayLike, effort: ArrayLike, *, strict: bool = False) -> Array: ...
    def inverse_dynamics(self, q: ArrayLike, v: ArrayLike, a: ArrayLike, *, strict: bool = False) -> Array: ...
    def mass_matrix(self, q: ArrayLike, *, strict: bool = False) -> Array: ...
    def bias(self, q: ArrayLike, v: ArrayLike, *, strict: bool = False) -> Array: ...
    def gravity(self, q: ArrayLike, *, strict: bool = False) -> Array: ...
    def jacobian(self, body: str, at: ArrayLike, q: ArrayLike, *, strict: bool = False) -> Array: ...
    def loop_jacobian(self, q: ArrayLike, *, strict: bool = False) -> Array: ...
    def energies(self, q: ArrayLike, v: ArrayLike) -> tuple[Any, Any]: ...
    def momentum(self, q: ArrayLike, v: ArrayLike) -> tuple[Array, Array]: ...
    def pose(self, body: str, q: ArrayLike) -> tuple[Array, Array]: ...
    def frame(self, name: str, q: ArrayLike, v: ArrayLike | None = None) -> dict[str, Array]: ...
    def center_of_mass(self, q: ArrayLike) -> Array: ...
    def forward_derivatives(self, q: ArrayLike, v: ArrayLike, effort: ArrayLike) -> Derivatives: ...
    def inverse_derivatives(self, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> Derivatives: ...
    def inverse_kinematics(
        self,
        frame: str,
        q: ArrayLike | None = None,
        *,
        position: ArrayLike | None = None,
        rotation: ArrayLike | None = None,
    ) -> Array: ...
    def integrate(self, q: ArrayLike, step: ArrayLike) -> Array: ...
    def difference(self, q0: ArrayLike, q1: ArrayLike) -> Array: ...
    def rollout(
        self,
        q: ArrayLike,
        v: ArrayLike,
        u: ArrayLike | None = None,
        dt: float = 1e-3,
        *,
        steps: int | None = None,
        threads: int = 0,
        integrator: Literal["rk4", "trapezoidal"] = "rk4",
    ) -> Rollout: ...
    def compare(
        self,
        methods: Sequence[str] | None = None,
        steps: Sequence[float] | None = None,
        *,
        duration: float | None = None,
        errors: Sequence[float] | None = None,
        quick: bool = True,
        progress: Callable[[float, float], object] | None = None,
    ) -> dict[str, Any]: ...
    def sweep(
        self,
        spec: str | PathLike[str] | Mapping[str, Any],
        *,
        threads: int = 0,
        client: Any = None,
        journal: str | PathLike[str] | None = None,
        progress: Callable[[int, int], object] | None = None,
        **settings: Any,
    ) -> Table: ...
    def __copy__(self) -> Mechanism: ...
    def __eq__(self, other: object) -> bool: ...
    def __hash__(self) -> int: ...

class Event(NamedTuple):
    """A contact that began or ended."""

    time: float
    effect: str
    is_made: bool
    end: str | None

class Simulation:
    """A mechanism in motion. One thread at a time: a second one gets a BusyError."""

    @property
    def mechanism(self) -> Mechanism: ...
    @property
    def time(self) -> float: ...
    @property
    def q(self) -> Array: ...
    @property
    def v(self) -> Array: ...
    @property
    def a(self) -> Array: ...
    @property
    def u(self) -> Array: ...
    @u.setter
    def u(self, values: ArrayLike) -> None: ...
    @property
    def events(self) -> list[Event]: ...
    def step(self, dt: float | None = None, u: ArrayLike | None = None) -> None: ...
    def steps(self, dt: float, n: int, u: ArrayLike | None = None) -> None: ...
    def run_until(self, time: float) -> None: ...
    def set_input(self, name: str | int, value: float) -> None: ...
    def outputs(self, out: Array | None = None) -> Array: ...
    def output(self, name: str) -> Array: ...
    def value(self, joint: str) -> float: ...
    def values(self, joint: str) -> Array: ...
    def rates(self, joint: str) -> Array: ...
    def reaction(self, joint: str) -> tuple[Array, Array]: ...
    def effect_force(self, effect: str) -> tuple[Array, Array]: ...
    def pose(self, body: str) -> tuple[Array, Array]: ...
    def point(self, body: str, at: ArrayLike) -> tuple[Array, Array, Array]: ...
    def energies(self) -> tuple[float, float, float]: ...
    def set_state(self, q: ArrayLike, v: ArrayLike) -> float: ...
    def reset(self) -> None: ...
    def watch_events(self) -> None: ...
    def copy(self) -> Simulation: ...
    def save(self) -> bytes: ...
    def restore(self, data: bytes) -> None: ...

def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command `mbs`."""
