"""Uses of the package, which mypy checks and nobody runs."""

from pathlib import Path

import multibody as mbs
import numpy as np
from multibody.builder import Body, Joint


def mechanisms() -> mbs.Mechanism:
    mbs.Mechanism("scene.toml")
    mbs.Mechanism(Path("scene.toml"))
    mechanism = mbs.Mechanism({"scene": {"dimension": 2, "duration": 1.0}})
    return mechanism.replace({"body.arm.mass": 1.0}).replace(mass=1.0)


def builders() -> mbs.Mechanism:
    builder: mbs.Builder = mbs.Mechanism.build("arm", dimension=2)
    arm: Body = builder.body("arm", mass=np.float64(1), point=np.zeros(2))
    pivot: Joint = builder.joint("pivot", "revolute", [builder.ground, arm], at=[0, 0])
    builder.initial(pivot, value=0.1)
    return builder.done()


def runs(mechanism: mbs.Mechanism) -> float:
    result = mechanism.run(1.0, step=1e-3, progress=lambda t, end: print(t / end), energy_alarm=0.1).check()
    table: dict[str, mbs.Array] = result.frame()
    peak: float = max(table["tip.x"])
    for name in result:
        peak = max(peak, float(np.abs(result[name]).max()))
    return peak + result.energy["max_error"]


def simulations(mechanism: mbs.Mechanism) -> bytes:
    simulation = mechanism.simulate(formulation="recursive", integrator="rk4")
    simulation.u = [0.0]
    simulation.u = np.zeros(1)
    simulation.step()
    simulation.step(1e-3, [1.0])
    force, moment = simulation.reaction("pivot")
    time, effect, is_made, end = simulation.events[0]
    if is_made and end is not None:
        print(time + force[0] + moment[0], effect + end)
    return simulation.copy().save()


def studies(mechanism: mbs.Mechanism) -> complex:
    q, v = mechanism.equilibrium().state
    linear = mechanism.linearize((q, v), outputs=["tip"])
    again = mechanism.linearize(mechanism.equilibrium())
    motion = mechanism.rollout(np.tile(q, (8, 1)), np.tile(v, (8, 1)), None, 1e-3, steps=10)
    error = motion.errors[0] if not motion.ok[0] else mbs.MbsError("none")
    table = mechanism.sweep({"vary": []}, client="ray", journal=Path("out"), step=1e-3)
    print(table["tip.x"] @ linear.A @ again.A, str(error), error.hint, error.line)
    value: complex = mechanism.modes("initial").eigenvalues[0]
    return value


def program() -> int:
    return mbs.main(["check", "scene.toml"])
