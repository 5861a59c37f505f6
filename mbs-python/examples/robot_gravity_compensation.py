# %% [markdown]
# # A robot that carries its own weight
#
# The six-joint arm gets motors in place of its springs. A controller p e - d q' alone sags by its weight: in each joint by the moment of
# gravity over p. With the moments of `Mechanism.gravity` on top it stands where it should.

# %%
import tomllib
from pathlib import Path

import multibody as mbs
import numpy as np

ROOT = next(folder for folder in (Path.cwd(), *Path.cwd().parents) if (folder / "scenes").is_dir())
scene = tomllib.loads((ROOT / "scenes" / "six-joint-arm.toml").read_text())
names = [joint["name"] for joint in scene["joint"]]
scene["effect"] = [{"name": f"motor {name}", "kind": "torque", "joint": name, "input": True, "value": 0.0} for name in names]
arm = mbs.Mechanism(scene)
print(arm.inputs)

# %%
P = np.array([9000.0, 9000.0, 5000.0, 300.0, 300.0, 30.0])  # [N m/rad]
D = np.array([400.0, 400.0, 160.0, 4.0, 5.0, 0.3])  # [N m s/rad]
TARGET = np.array([0.4, 0.3, -0.5, 0.6, 0.5, -0.8])  # [rad]
STEP = 1e-3  # of the controller [s]


def reached(is_compensated: bool) -> np.ndarray:
    """Angles after four seconds."""
    simulation = arm.simulate(step=STEP)
    for _ in range(4000):
        q, v = simulation.q, simulation.v
        torque = P * (TARGET - q) - D * v
        if is_compensated:
            torque += arm.gravity(q)
        simulation.step(STEP, torque)
    return simulation.q


# %%
sags, stands = (np.abs(reached(is_compensated) - TARGET).max() for is_compensated in (False, True))
print(f"sag without compensation {1e3 * sags:.2f} mrad, with it {1e3 * stands:.2e} mrad")
assert 5e-3 < sags < 5e-2
assert stands < 1e-6
