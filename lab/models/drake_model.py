"""An SDF as Drake 1.51.1 reads it, for versions and elements that sdf_model.py does not know: no limits; rows by drake_loops.py."""

from pathlib import Path

import numpy as np
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import BodyIndex

import rotation
from drake_loops import Rows, split

GRAVITY = [0.0, 0.0, -9.8]
# The format has none; this is what our reader writes.
URDF_GRAVITY = [0.0, 0.0, -9.81]


class Drake:
    def __init__(self, path):
        self.plant = MultibodyPlant(0.0)
        parser = Parser(self.plant)
        for folder in filter(Path.is_dir, path.parent.iterdir()):
            parser.package_map().Add(folder.name, str(folder))
        text, loops, couplings = split(path)
        parser.AddModelsFromString(text, path.suffix[1:])
        self.plant.mutable_gravity_field().set_gravity_vector(URDF_GRAVITY if path.suffix == ".urdf" else GRAVITY)
        self.plant.Finalize()
        self.context = self.plant.CreateDefaultContext()
        self.rows = Rows(self.plant, self.context, loops, couplings) if loops or couplings else None
        indices = self.plant.GetJointIndices()
        self.joints = [j for j in map(self.plant.get_joint, indices) if j.num_velocities()]

    def bodies(self):
        """Mass, centre and tensor about the centre; global axes, reference configuration."""
        out = {}
        for i in range(1, self.plant.num_bodies()):
            body = self.plant.get_body(BodyIndex(i))
            place = self.plant.EvalBodyPoseInWorld(self.context, body)
            inertia = body.default_spatial_inertia()
            turn = place.rotation().matrix()
            tensor = turn @ inertia.Shift(inertia.get_com()).CalcRotationalInertia().CopyToFullMatrix3() @ turn.T
            out[body.scoped_name().get_full()] = {
                "mass": inertia.get_mass(),
                "center": place.multiply(inertia.get_com()),
                "inertia": tensor[[0, 1, 2, 0, 1, 2], [0, 1, 2, 1, 2, 0]],
                "position": place.translation().copy(),
            }
        return out

    def ours(self, joint, found):
        """What Drake counts in another way, in our conventions: a ball, and a screw as slide and turn."""
        if joint.type_name() == "screw":
            slide = joint.screw_pitch() / (2 * np.pi)
            return {"ours": {key: [slide * found[key][0], found[key][0]] for key in ("value", "rate", "acceleration")}}
        if joint.type_name() != "ball_rpy":
            return {}
        plant, context, rest = self.plant, self.context, self.plant.CreateDefaultContext()
        ends = [joint.child_body(), joint.parent_body()]
        turn = lambda body, at: plant.EvalBodyPoseInWorld(at, body).rotation().matrix()
        child, parent = (turn(body, context) @ turn(body, rest).T for body in ends)
        speed = [plant.EvalBodySpatialVelocityInWorld(context, body).rotational() for body in ends]
        change = [plant.EvalBodySpatialAccelerationInWorld(context, body).rotational() for body in ends]
        return {"ours": {"value": rotation.quaternion(parent.T @ child), "rate": speed[0] - speed[1], "acceleration": change[0] - change[1]}}

    def numbers(self, draw):
        """A state by seed, and the accelerations under no effort, as Drake counts coordinates of each joint."""
        plant, context = self.plant, self.context
        q = plant.GetPositions(context)
        for joint in self.joints:
            a, n = joint.position_start(), joint.num_positions()
            if n < 7:
                q[a:a + n] += draw.uniform(-0.3, 0.3, n)
        v = draw.uniform(-1, 1, plant.num_velocities())
        plant.SetPositions(context, q)
        plant.SetVelocities(context, v)
        if self.rows:
            self.rows.settle()
            q, v = plant.GetPositions(context), plant.GetVelocities(context)
        slopes = plant.EvalTimeDerivatives(context).CopyToVector()[len(q):]
        if self.rows:
            slopes = self.rows.accelerations(slopes)
        out = {}
        for joint in self.joints:
            a, k, n = joint.position_start(), joint.velocity_start(), joint.num_velocities()
            out[joint.name()] = {"type": joint.type_name(), "value": q[a:a + joint.num_positions()], "rate": v[k:k + n],
                                 "acceleration": slopes[k:k + n]}
            out[joint.name()] |= self.ours(joint, out[joint.name()])
        frames = {}
        for i in range(1, plant.num_bodies()):
            body = plant.get_body(BodyIndex(i))
            frames[body.scoped_name().get_full()] = plant.EvalBodyPoseInWorld(context, body).GetAsMatrix4()[:3]
        energy = plant.EvalKineticEnergy(context), plant.EvalPotentialEnergy(context)
        return {"joints": out, "frames": frames, "kinetic": energy[0], "potential": energy[1],
                "mass_matrix": plant.CalcMassMatrix(context)}
