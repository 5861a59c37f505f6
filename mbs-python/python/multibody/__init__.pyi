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
from .errors import ModelWarning as ModelWarning
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

    @property
    def unsteady(self) -> dict[str, Any] | None:
        """None about a rest and a motion that is steady in standing axes; else `state`, `by`, `unit`: which accelerates, or whose equation
        changes, by how much. The matrices hold for the instant then."""

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
Place = Literal["equilibrium", "initial", "moving"]
StateLike = State | Equilibrium | tuple[ArrayLike, ArrayLike] | tuple[ArrayLike, ArrayLike, ArrayLike] | Place
Wrench = tuple[ArrayLike, ArrayLike] | ArrayLike
"""A force and a moment, or six numbers."""
Forces = Mapping[str, Wrench]
"""Forces and moments by names of frames or bodies."""

class Mechanism:
    """A mechanism, checked and immutable. Threads may share it.

    `source` is the path of a scene (TOML, JSON) or of a model (URDF, MJCF, SDF), the text of a scene, or a scene as a dict.
    A text has more than one line.

    A model takes the options of `mbs import`: base ("fixed", "free"), limits (True, or stiffness and damping), balance, keep_fixed (names),
    key (a keyframe), motors, massless_meshes, packages (folders by names), no_outside. A ModelWarning says where something that can act was
    left out; `import_report` lists it.
    """

    def __init__(
        self,
        source: Source,
        *,
        base: Literal["fixed", "free"] | None = ...,
        limits: bool | tuple[float, float] | None = ...,
        balance: bool = ...,
        keep_fixed: Sequence[str] = ...,
        key: str | None = ...,
        motors: bool = ...,
        massless_meshes: bool = ...,
        packages: Mapping[str, str | PathLike[str]] = ...,
        no_outside: bool = ...,
    ) -> None: ...
    @property
    def import_report(self) -> dict[str, Any] | None:
        """What became of the elements of a model: the object of `mbs import --json`. None where the mechanism comes from a scene."""
    def from_qpos(self, qpos: ArrayLike, qvel: ArrayLike | None = None) -> State:
        """The state of an MJCF's `qpos` and `qvel`, as MuJoCo orders them; without `qvel` at rest."""
    def to_qpos(self, q: ArrayLike, v: ArrayLike | None = None) -> tuple[Array, Array]:
        """`qpos` and `qvel` of an MJCF, as MuJoCo orders them, of q and v; without v at rest."""
    def with_forces(self, *names: str) -> Mechanism:
        """The mechanism with forces and moments on frames or bodies as inputs `NAME.force.x` ... `NAME.moment.z`: its simulations take
        `f_ext` in their steps. `u` may then have the inputs of this mechanism alone."""
    @staticmethod
    def build(name: str, dimension: Literal[2, 3] = 3) -> Builder:
        """A builder of a scene: its parts are added by calls, and `done()` gives the mechanism."""
    @property
    def name(self) -> str:
        """The scene's name."""
    @property
    def dimension(self) -> int:
        """2 or 3."""
    @property
    def bodies(self) -> list[str]:
        """Names of the bodies."""
    @property
    def joints(self) -> list[str]:
        """Names of the joints."""
    @property
    def effects(self) -> list[str]:
        """Names of the effects."""
    @property
    def inputs(self) -> list[str]:
        """Names of the inputs, in the order of `u`."""
    @property
    def input_units(self) -> dict[str, str]:
        """Units of the inputs."""
    @property
    def outputs(self) -> list[str]:
        """Names of the outputs: the columns of runs, without magnitudes."""
    @property
    def output_units(self) -> dict[str, str]:
        """Units of the outputs."""
    @property
    def frames(self) -> list[str]:
        """Names of the frames."""
    @property
    def nq(self) -> int:
        """Numbers in q."""
    @property
    def nv(self) -> int:
        """Numbers in v."""
    @property
    def nu(self) -> int:
        """Number of inputs."""
    @property
    def dof(self) -> int:
        """Freedoms at the start: loops and guides take some of v."""
    @property
    def duration(self) -> float:
        """Length of a run that the scene asks for [s]."""
    @property
    def text(self) -> str:
        """The text of the scene."""
    def to_dict(self) -> dict[str, Any]:
        """The scene as a dict."""
    def coordinates(self, joint: str) -> tuple[slice, slice]:
        """Where the numbers of a joint stand in q and in v. A joint that closes a loop, or is guided, has none: UsageError."""
    def get(self, path: str) -> float:
        """A number of the scene by its path: `body.upper.mass`."""
    def replace(self, values: Mapping[str, float] | None = None, **paths: float) -> Mechanism:
        """The mechanism with other numbers, by their paths: `m.replace({"body.upper.mass": 2.0})`."""
    def reference(self) -> State:
        """The reference configuration at rest."""
    def initial(self) -> State:
        """The state in which runs begin."""
    def explain(self) -> dict[str, Any]:
        """What the mechanism simulates, what it does not, and the measured cost of each effect: the object of `mbs explain --json`."""
    def doctor(self) -> list[Finding]:
        """What is wrong or doubtful, with remedies, the worst first."""
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
        checkpoints: tuple[str | PathLike[str], float] | None = None,
        resume: str | PathLike[str] | None = None,
        threads: int = 1,
        **settings: Any,
    ) -> Result:
        """Runs the mechanism, as `mbs run` does. None leaves a setting to the scene; `error` chooses the method by a pilot. `inputs` is
        `{"t": times, NAME: values}`. `progress` is called with time and duration [s], at most ten times a second. A run that stops early is
        a result with `error`. Ctrl-C raises KeyboardInterrupt, whose `result` has what was recorded; None where a method was still sought.
        `checkpoints` is a folder and the simulated time between two checkpoints [s]; the last one, `checkpoint.mbs`, stays there, and the
        next run replaces it. `resume` is such a file."""
    def simulate(
        self,
        *,
        step: float | None = None,
        formulation: str | None = None,
        integrator: str | None = None,
        precision: Literal["f64", "f32", "dd"] | None = None,
        threads: int = 1,
        **settings: Any,
    ) -> Simulation:
        """A simulation at its start. None leaves a setting to the scene; its default is index-3 with steps of 1 ms."""
    def equilibrium(self, search: Literal["down", "near"] = "down") -> Equilibrium:
        """The static equilibrium: downhill to a stable one, or the one `near` the reference configuration."""
    def modes(self, at: StateLike = "equilibrium", *, u: ArrayLike | None = None, frozen: bool = False) -> Modes:
        """Eigenvalues of the motion about a state, with frequencies, damping ratios and shapes, from the slowest to the fastest. `at` and
        `u` are those of `linearize`. About a state that is neither a rest nor a steady motion `frozen` gives the eigenvalues of the
        instant; else it is refused."""
    def linearize(
        self,
        at: StateLike = "equilibrium",
        inputs: Sequence[str] | None = None,
        outputs: Sequence[str] | None = None,
        *,
        u: ArrayLike | None = None,
    ) -> Linear:
        """dx/dt = A x + B u, y = C x + D u about a state: `"equilibrium"`, `"initial"`, `"moving"`, what `equilibrium()` gives, (q, v), or
        (q, v, u). `u` are the values of all inputs there, else those at which they begin. The states x are independent coordinates and
        their rates, then the states of signals. About a state that is neither a rest nor a steady motion the matrices hold for the instant,
        and `unsteady` says why."""
    def accelerations(
        self,
        q: ArrayLike,
        v: ArrayLike,
        u: ArrayLike | None = None,
        *,
        time: float = 0.0,
        f_ext: Forces | None = None,
        strict: bool = False,
    ) -> Array:
        """Accelerations (nv,) under all effects and inputs `u` (nu,), signals as they begin. All arguments are of one state, or of k
        states. `f_ext` are forces and moments on frames or bodies, {NAME: (force, moment)}: global axes, at the origin of the frame."""
    def forward_dynamics(
        self, q: ArrayLike, v: ArrayLike, effort: ArrayLike, *, f_ext: Forces | None = None, strict: bool = False
    ) -> Array:
        """Accelerations (nv,) under efforts along v, gravity and `f_ext` alone, loops closed."""
    def inverse_dynamics(
        self, q: ArrayLike, v: ArrayLike, a: ArrayLike, *, f_ext: Forces | None = None, strict: bool = False
    ) -> Array:
        """Efforts (nv,) that make accelerations `a`: M a + bias, less what `f_ext` does."""
    def mass_matrix(self, q: ArrayLike, *, strict: bool = False) -> Array:
        """Mass matrix (nv, nv), loops open."""
    def bias(self, q: ArrayLike, v: ArrayLike, *, strict: bool = False) -> Array:
        """Efforts (nv,) that keep all velocities as they are: centrifugal and Coriolis forces, and gravity."""
    def gravity(self, q: ArrayLike, *, strict: bool = False) -> Array:
        """Efforts (nv,) that hold the mechanism at rest against gravity."""
    def jacobian(self, body: str, at: ArrayLike | None = None, q: ArrayLike | None = None, *, strict: bool = False) -> Array:
        """Jacobian (6, nv) of a frame's origin by (frame, q), of a point that moves with a body or a frame by (name, at, q), which is at
        `at` in the reference configuration: linear, then angular, global axes."""
    def loop_jacobian(self, q: ArrayLike, *, strict: bool = False) -> Array:
        """Jacobian (rows, nv) of the joints that close loops."""
    def energies(self, q: ArrayLike, v: ArrayLike) -> tuple[Any, Any]:
        """Kinetic energy, and potential energy of gravity, constant forces and springs [J]."""
    def momentum(self, q: ArrayLike, v: ArrayLike) -> tuple[Array, Array]:
        """Linear momentum [kg m/s], and angular momentum about the centre of mass [kg m^2/s], (3,) each."""
    def pose(self, body: str, q: ArrayLike) -> tuple[Array, Array]:
        """Centre of mass (3,) of a body, and its rotation (3, 3) from the reference configuration."""
    def frame(self, name: str, q: ArrayLike, v: ArrayLike | None = None) -> dict[str, Array]:
        """A frame at a state: position (3,), rotation (3, 3), velocity (3,), angular_velocity (3,), in global axes; of a body without a
        frame of its name the centre of mass."""
    def center_of_mass(self, q: ArrayLike) -> Array:
        """Centre of mass (3,) of all bodies."""
    def forward_derivatives(self, q: ArrayLike, v: ArrayLike, effort: ArrayLike) -> Derivatives:
        """Derivatives of `forward_dynamics` by q, v and effort, (nv, nv) each. Those by q are by moves along v."""
    def inverse_derivatives(self, q: ArrayLike, v: ArrayLike, a: ArrayLike) -> Derivatives:
        """Derivatives of `inverse_dynamics` by q, v and a, (nv, nv) each. Those by q are by moves along v."""
    def inverse_kinematics(
        self,
        frame: str,
        q: ArrayLike | None = None,
        *,
        position: ArrayLike | None = None,
        rotation: ArrayLike | None = None,
    ) -> Array:
        """Coordinates (nq,) in which a frame is at a position (3,) with a rotation (3, 3), from `q` on; of a body without a frame of its
        name it is the centre of mass. What is left out is free; loops stay closed."""
    def integrate(self, q: ArrayLike, step: ArrayLike) -> Array:
        """q moved by `step` (nv,) along the velocities."""
    def difference(self, q0: ArrayLike, q1: ArrayLike) -> Array:
        """The step (nv,) that moves q0 to q1; rotations by the shorter way."""
    def rollout(
        self,
        q: ArrayLike,
        v: ArrayLike,
        u: ArrayLike | None = None,
        dt: float = 1e-3,
        *,
        steps: int | None = None,
        threads: int = 0,
        client: Any = None,
        integrator: str = "rk4",
        f_ext: Forces | None = None,
    ) -> Rollout:
        """Motions from k starts by equal steps of `dt` [s], with all effects; `u` (k, steps, nu), or (steps, nu) for all, is held over each
        step. The numbers do not depend on the number of threads; 0: all processors. `client` is a client of Dask, or "ray": starts then go
        there in chunks. `f_ext` are forces and moments on frames or bodies, {NAME: (force, moment)} or {NAME: (steps, 6)}, as in
        `accelerations`."""
    def compare(
        self,
        methods: Sequence[str] | None = None,
        steps: Sequence[float] | None = None,
        *,
        duration: float | None = None,
        errors: Sequence[float] | None = None,
        quick: bool = True,
        progress: Callable[[float, float], object] | None = None,
    ) -> dict[str, Any]:
        """Time and error of formulations, integrators and steps, against a reference that is not under test: the object of `mbs compare
        --json`. `quick` takes about 5 s. `progress` is called with the part that is done and 1."""
    def sweep(
        self,
        spec: str | PathLike[str] | Mapping[str, Any],
        *,
        threads: int = 0,
        client: Any = None,
        journal: str | PathLike[str] | None = None,
        progress: Callable[[int, int], object] | None = None,
        **settings: Any,
    ) -> Table:
        """Runs the mechanism with all values of a sweep: the path of a file, its text, or a dict. `journal` is a directory in which a
        killed sweep continues. `client` is a client of Dask, or "ray": members then run there. Threads 0: all processors."""
    def __copy__(self) -> Mechanism: ...
    def __eq__(self, other: object) -> bool: ...
    def __hash__(self) -> int: ...

class Event(NamedTuple):
    """A contact that began or ended."""

    time: float
    effect: str
    is_made: bool
    end: str | None

class Recording:
    """The motion of a simulation from where it was when `Simulation.record` was called: instants of its steps, 2400 at most, then every second
    one and so on."""

    @property
    def times(self) -> Array:
        """Times of the instants that are kept [s]."""
    @property
    def outputs(self) -> Array:
        """All outputs at the instants, (instants, outputs)."""
    def __getitem__(self, name: str) -> Array:
        """An output at the instants, by its name."""
    def __len__(self) -> int: ...
    def page(self) -> str:
        """The page of the motion: HTML that stands alone, as `mbs run` writes it."""
    def save(self, path: str | PathLike[str]) -> None:
        """Writes the page."""

class Simulation:
    """A mechanism in motion. One thread at a time: a second one gets a BusyError."""

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism."""
    @property
    def time(self) -> float:
        """Time [s]."""
    @property
    def q(self) -> Array:
        """Coordinates (nq,): a copy."""
    @property
    def v(self) -> Array:
        """Velocities (nv,): a copy."""
    @property
    def a(self) -> Array:
        """Accelerations (nv,) at this state, under all effects and the inputs of the last step."""
    @property
    def u(self) -> Array:
        """Inputs (nu,): a copy. Set, they hold from the next step on."""
    @u.setter
    def u(self, values: ArrayLike) -> None: ...
    @property
    def events(self) -> list[Event]:
        """Contacts that began or ended since `watch_events`, a thousand at most."""
    def step(self, dt: float | None = None, u: ArrayLike | None = None, *, f_ext: Forces | None = None) -> None:
        """One step of `dt` [s], else of the method's step. `u` (nu,) holds from now on. `f_ext` are forces as in `accelerations`, which
        hold too; the mechanism is one of `with_forces`."""
    def steps(self, dt: float | None, n: int, u: ArrayLike | None = None, *, f_ext: Forces | None = None) -> None:
        """`n` steps of `dt` [s] without Python in between. `u` is (nu,), which holds, or (n, nu), a row for each step; `f_ext` as in
        `step`."""
    def record(self) -> Recording:
        """Records the motion from now on, for a page: `recording.page()`, `recording.save("motion.html")`. It begins anew where time goes
        back."""
    def poses(self) -> Array:
        """Poses of all bodies, (bodies, 7): the centre of mass, then the quaternion (w, x, y, z) of the turn since the reference
        configuration."""
    def run_until(self, time: float) -> None:
        """Steps to a time [s]; the last step is shorter where they do not fit."""
    def set_input(self, name: str | int, value: float) -> None:
        """Sets an input, by name or place, from the next step on."""
    def outputs(self, out: Array | None = None) -> Array:
        """All outputs, in the order of the mechanism's `outputs`. `out` (n,) takes them where it is given."""
    def output(self, name: str) -> Array:
        """The components of an output of the scene, or the number of a column."""
    def value(self, joint: str) -> float:
        """The first coordinate of a joint from the reference configuration, turns counted [rad, m]."""
    def values(self, joint: str) -> Array:
        """All coordinates of a joint [rad, m]."""
    def rates(self, joint: str) -> Array:
        """Their rates; of a ball the relative angular velocity in global axes."""
    def reaction(self, joint: str) -> tuple[Array, Array]:
        """Force [N] and moment [N m] of the first body of a joint on the second, at its place on the second."""
    def effect_force(self, effect: str) -> tuple[Array, Array]:
        """Force [N] and moment [N m] of an effect."""
    def pose(self, body: str) -> tuple[Array, Array]:
        """Centre of mass (3,) of a body, and its rotation (3, 3) from the reference configuration."""
    def point(self, body: str, at: ArrayLike) -> tuple[Array, Array, Array]:
        """Position, velocity and acceleration (3, 3) of a point of a body, which is at `at` in the reference configuration."""
    def energies(self) -> tuple[float, float, float]:
        """Kinetic energy, potential energy, and work of dampers, guides and inputs since the start [J]."""
    def set_state(self, q: ArrayLike, v: ArrayLike) -> float:
        """Puts the mechanism into a state; loops are closed. Gives the largest change of a coordinate [rad, m]."""
    def reset(self) -> None:
        """Starts anew at time zero, with the inputs of the mechanism."""
    def watch_events(self) -> None:
        """Lists contacts anew from now on."""
    def copy(self) -> Simulation:
        """Another simulation in the same state."""
    def save(self) -> bytes:
        """All that the next steps depend on, as bytes."""
    def restore(self, data: bytes) -> None:
        """Returns to what `save` gave: the next steps have the same bits."""

def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command `mbs`."""
