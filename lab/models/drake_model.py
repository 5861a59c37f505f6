"""An SDF as Drake 1.51.1 reads it, for versions and elements that sdf_model.py does not know: open trees, no limits, no loops."""

from pathlib import Path

import numpy as np
from pydrake.multibody.parsing import Parser
from pydrake.multibody.plant import MultibodyPlant
from pydrake.multibody.tree import BodyIndex

GRAVITY = [0.0, 0.0, -9.8]


class Drake:
    def __init__(self, path):
        self.plant = MultibodyPlant(0.0)
        parser = Parser(self.plant)
        for folder in filter(Path.is_dir, path.parent.iterdir()):
            parser.package_map().Add(folder.name, str(folder))
        parser.AddModels(str(path))
        self.plant.mutable_gravity_field().set_gravity_vector(GRAVITY)
        self.plant.Finalize()
        self.context = self.plant.CreateDefaultContext()
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
        slopes = plant.EvalTimeDerivatives(context).CopyToVector()[len(q):]
        out = {}
        for joint in self.joints:
            a, k, n = joint.position_start(), joint.velocity_start(), joint.num_velocities()
            out[joint.name()] = {"type": joint.type_name(), "value": q[a:a + joint.num_positions()], "rate": v[k:k + n],
                                 "acceleration": slopes[k:k + n]}
        frames = {}
        for i in range(1, plant.num_bodies()):
            body = plant.get_body(BodyIndex(i))
            frames[body.scoped_name().get_full()] = plant.EvalBodyPoseInWorld(context, body).GetAsMatrix4()[:3]
        energy = plant.EvalKineticEnergy(context), plant.EvalPotentialEnergy(context)
        return {"joints": out, "frames": frames, "kinetic": energy[0], "potential": energy[1],
                "mass_matrix": plant.CalcMassMatrix(context)}
