# %% [markdown]
# # Forces in the bearings of a four-bar linkage
#
# A motor turns the crank at constant speed. The bearings carry the weights and what accelerates the bodies. The largest force in each
# bearing sizes it. Newton's law for the whole linkage is the check: both bearings on the ground together carry the sum of m (a - g).

# %%
import math

import multibody as mbs
import numpy as np

SPEED = 20.0  # of the crank [rad/s]
MASSES = {"crank": 0.4, "coupler": 1.0, "rocker": 0.8}  # [kg]

# %%
b = mbs.Mechanism.build("four-bar linkage", dimension=2)
b.gravity([0.0, -9.81])
b.duration(2 * math.pi / SPEED)
A, B, C, D = (b.point(name, at) for name, at in {"A": [0, 0], "B": [0.18, 0.24], "C": [0.868, 0.576], "D": [0.7, 0]}.items())
crank = b.body("crank", mass=MASSES["crank"], rod={"from": A, "to": B})
coupler = b.body("coupler", mass=MASSES["coupler"], rod={"from": B, "to": C})
rocker = b.body("rocker", mass=MASSES["rocker"], rod={"from": D, "to": C})
drive = b.joint("A", "revolute", [b.ground, crank], at=A)
joints = [drive]
joints.append(b.joint("B", "revolute", [crank, coupler], at=B))
joints.append(b.joint("C", "revolute", [coupler, rocker], at=C))
joints.append(b.joint("D", "revolute", [b.ground, rocker], at=D))
b.guide(drive, ramp={"rate": SPEED})
for joint in joints:
    b.output(f"force at {joint}", "reaction", joint=joint, magnitude=True)
for body in (crank, coupler, rocker):
    b.output(body, "acceleration", body=body)
b.solver(step=1e-4)
linkage = b.done()

# %%
result = linkage.run().check()
peaks = {joint: result[f"force at {joint}.F"].max() for joint in joints}
for joint, peak in peaks.items():
    at = result.t[result[f"force at {joint}.F"].argmax()]
    print(f"bearing {joint}: {peak:6.1f} N at {1e3 * at:5.1f} ms")

# %%
carried = [result[f"force at A.F{axis}"] + result[f"force at D.F{axis}"] for axis in "xy"]
inertia = [sum(mass * result[f"{body}.{axis}"] for body, mass in MASSES.items()) for axis in "xy"]
weight = [0.0, 9.81 * sum(MASSES.values())]
error = max(np.abs(carried[i] - inertia[i] - weight[i]).max() for i in range(2))
print(f"Newton's law holds within {error:.1e} N")
assert error < 1e-6 * max(peaks.values())
