"""Dynamics of multibody systems: mechanisms, vehicles, robots. SI units, global axes.

    import multibody as mbs
    result = mbs.Mechanism("crank-rocker.toml").run()
    result["force at O.Fx"].max()
"""

from __future__ import annotations

from ._multibody import Mechanism, Simulation, __version__
from .errors import BusyError, MbsError, SceneError, StartError, StopError, UsageError
from .result import Result
from .values import Derivatives, Equilibrium, Event, Finding, Linear, Modes, Rollout, State, Table

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = [
    "BusyError",
    "Derivatives",
    "Equilibrium",
    "Event",
    "Finding",
    "Linear",
    "MbsError",
    "Mechanism",
    "Modes",
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
    import sys

    from ._multibody import command

    words = sys.argv[1:] if arguments is None else list(arguments)
    return command([sys.executable, "-m", "multibody"], words)
