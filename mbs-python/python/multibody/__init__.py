"""Dynamics of multibody systems: mechanisms, vehicles, robots. SI units, global axes.

    import multibody as mbs
    result = mbs.Mechanism("crank-rocker.toml").run()
    result["force at O.Fx"].max()
"""

from __future__ import annotations

from ._multibody import Mechanism, Recording, Simulation, __version__
from .errors import BusyError, MbsError, ModelWarning, SceneError, StartError, StopError, UsageError
from .result import Result
from .values import Derivatives, Equilibrium, Event, Finding, Linear, Modes, Rollout, State, Table

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = [
    "Builder",
    "BusyError",
    "Derivatives",
    "Equilibrium",
    "Event",
    "Finding",
    "Linear",
    "MbsError",
    "Mechanism",
    "ModelWarning",
    "Modes",
    "Recording",
    "Result",
    "Rollout",
    "SceneError",
    "Simulation",
    "StartError",
    "State",
    "StopError",
    "Table",
    "UsageError",
    "__version__",
    "main",
]


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs the command `mbs` with these arguments, else with those of the process, and gives its exit status."""
    import signal
    import sys

    from ._multibody import command

    words = sys.argv[1:] if arguments is None else list(arguments)
    try:
        # the command hears of Ctrl-C by itself
        before = signal.signal(signal.SIGINT, signal.SIG_DFL)
    except ValueError:
        # this is no main thread, and has no signals
        return command([sys.executable, "-m", "multibody"], words)
    try:
        return command([sys.executable, "-m", "multibody"], words)
    finally:
        signal.signal(signal.SIGINT, before)


def __getattr__(name: str) -> object:
    if name == "Builder":
        from .builder import Builder

        return Builder
    raise AttributeError(f"module `multibody` has no attribute `{name}`")
