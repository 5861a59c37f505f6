"""Drake on chains and a tree: forward.py (chain | tree) N SECONDS

Called through Python; a call sets the state and evaluates its rate, and what setting alone takes stays in.
"""
import importlib.metadata
import sys
import time

import numpy as np
from pydrake.math import RigidTransform
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import FixedOffsetFrame, RevoluteJoint, SpatialInertia, UnitInertia

STATES, BATCHES = 8, 7


def plant_of(problem, n):
    plant = MultibodyPlant(0.0)
    inertia = SpatialInertia(1.0, [0.5, 0, 0], UnitInertia(1e-3, 1 / 12 + 0.25, 1 / 12 + 0.25))

    def add(parent, x):
        i = plant.num_joints()
        body = plant.AddRigidBody(f"body{i}", inertia)
        frame = plant.AddFrame(FixedOffsetFrame(f"frame{i}", parent, RigidTransform([x, 0, 0])))
        plant.AddJoint(RevoluteJoint(f"joint{i}", frame, body.body_frame(), [0, 0, 1]))
        return body.body_frame()

    def grow(i, parent):
        frame = add(parent, 1.0 if i else 0.0)
        for child in (2 * i + 1, 2 * i + 2):
            if child < n:
                grow(child, frame)

    if problem == "tree":
        grow(0, plant.world_frame())
    else:
        frame = plant.world_frame()
        for i in range(n):
            frame = add(frame, 1.0 if i else 0.0)
    plant.mutable_gravity_field().set_gravity_vector([0, -9.81, 0])
    plant.Finalize()
    return plant


def states_of(plant, n):
    """The same numbers in every program, set joint by joint: Drake may order its coordinates otherwise."""
    seed, states = 1, []
    joints = [plant.GetJointByName(f"joint{i}") for i in range(n)]
    for _ in range(STATES):
        state = np.zeros(2 * n)
        for part, scale in ((0, 3.0), (1, 1.0)):
            for joint in joints:
                seed = (seed * 1664525 + 1013904223) & 0xFFFFFFFF
                at = n + joint.velocity_start() if part else joint.position_start()
                state[at] = scale * ((seed >> 8) / 16777216.0 * 2.0 - 1.0)
        states.append(state)
    return states, n + joints[0].velocity_start()


def main():
    if sys.argv[1] == "version":
        print(importlib.metadata.version("drake"))
        return
    problem, n, seconds = sys.argv[1], int(sys.argv[2]), float(sys.argv[3])
    plant = plant_of(problem, n)
    context = plant.CreateDefaultContext()
    states, first = states_of(plant, n)

    def call(k):
        plant.SetPositionsAndVelocities(context, states[k])
        return plant.EvalTimeDerivatives(context)

    def batch(calls):
        start = time.process_time()
        for i in range(calls):
            call(i % STATES)
        return time.process_time() - start

    value = call(0).CopyToVector()[first]
    calls = 1
    while batch(calls) < seconds / (2 * BATCHES):
        calls *= 2
    print(f"EvalTimeDerivatives,{sorted(batch(calls) / calls for _ in range(BATCHES))[BATCHES // 2]:.6e},{value:.17g},exact")


main()
