"""Compares the motion of balls on turning parents with MuJoCo's own steps of Runge and Kutta: motion_check.py

The model has a turned frame at each body, a ball on a hinge, and a ball on that ball.
"""

import mujoco
import numpy as np

import motion
import rotation
from mjcf_model import Mjcf

MODEL = """
<mujoco>
  <option integrator="RK4" timestep="1e-4"/>
  <worldbody>
    <body euler="20 30 40"><joint type="hinge" axis="1 2 3"/><geom type="box" size=".1 .2 .3"/>
      <body pos=".3 .1 0" euler="-50 10 70"><joint type="ball"/><geom type="box" size=".3 .1 .2" pos=".1 0 .2"/>
        <body pos="0 .2 .1" euler="15 -80 5"><joint type="ball" pos=".05 0 0"/><geom type="box" size=".1 .3 .1" pos="0 .2 0"/></body>
      </body>
    </body>
  </worldbody>
</mujoco>
"""

# Steps of 1e-4 s to 0.3 s: their error is below 1e-9.
STEPS, TIME = 3000, 0.3

# Largest difference of values and rates.
NEAR = 1e-9


def main():
    model = Mjcf.of_text(MODEL)
    y, rates, _ = rotation.random_state(model.kinds, 7)
    ends, fault = motion.motion(model, model.acceleration, y, rates, [TIME])
    model.place(y, rates)
    for _ in range(STEPS):
        mujoco.mj_step(model.model, model.data)
    theirs = np.concatenate(model.state_of(model.data.qpos.copy(), model.data.qvel.copy()))
    difference = float(np.max(np.abs(np.concatenate(ends[0][1:3]) - theirs)))
    print(f"{difference:.1e} after {TIME} s, fault {fault}")
    return not difference < NEAR


if __name__ == "__main__":
    raise SystemExit(main())
