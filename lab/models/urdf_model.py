"""A URDF as Pinocchio reads it, in the conventions of README.md.

Pinocchio takes followers (`mimic`) as free joints here. They are tied by q = G z + c from the file's own numbers, so that
chains of followers are tied too, which Pinocchio refuses with mimic=True.
"""

import numpy as np
import pinocchio as pin

import common
import rotation

FREE = "JointModelFreeFlyer"


def kind_of(joint):
    name = joint.shortname()
    if name == FREE:
        return "free"
    if name == "JointModelPlanar":
        return "planar"
    if name.startswith("JointModelP") and joint.nv == 1:
        return "slide"
    if name.startswith("JointModelR") and joint.nv == 1:
        return "turn"
    raise ValueError(f"{name} is not judged")


def followers(path, names):
    """{follower: (leader, multiplier, offset)} of the file, where both move."""
    found = {}
    for joint in common.tree(path).findall("joint"):
        mimic = joint.find("mimic")
        if mimic is not None and joint.get("name") in names and joint.get("type") != "fixed":
            leader = mimic.get("joint")
            if leader not in names:
                raise ValueError(f"{joint.get('name')} follows {leader}, which does not move")
            found[joint.get("name")] = (leader, float(mimic.get("multiplier", 1)), float(mimic.get("offset", 0)))
    return found


def rotors(path):
    """{joint: inertia of its rotor at the joint} of Drake's elements, which Pinocchio passes over."""
    found = {}
    for drive in common.tree(path).findall("transmission"):
        for actuator in drive.findall("actuator"):
            said = {part.tag.rsplit("}", 1)[-1].rsplit(":", 1)[-1]: part.get("value") for part in actuator}
            if "rotor_inertia" in said:
                for joint in drive.findall("joint"):
                    found[joint.get("name")] = float(said.get("gear_ratio", 1)) ** 2 * float(said["rotor_inertia"])
    return found


class Urdf:
    """Rows are the coordinates that are free to choose, in Pinocchio's order without the followers."""

    def __init__(self, path, free_base=False):
        root = [pin.JointModelFreeFlyer(), "base"] if free_base else []
        self.model = pin.buildModelFromUrdf(str(path), *root)
        self.data = self.model.createData()
        self.joints = list(self.model.joints)[1:]
        for name, inertia in rotors(path).items():
            if self.model.existJointName(name):
                self.model.armature[self.model.joints[self.model.getJointId(name)].idx_v] = inertia
        self.all_names = list(self.model.names)[1:]
        if len(set(self.all_names)) < len(self.all_names):
            raise ValueError("two joints have one name")
        self.all_kinds = [kind_of(joint) for joint in self.joints]
        if any(k == "free" and self.model.parents[i + 1] for i, k in enumerate(self.all_kinds)):
            raise ValueError("a floating joint on a moving body is not judged")
        self.followers = followers(path, set(self.all_names))
        self.names = [name for name in self.all_names if name not in self.followers]
        self.kinds = [k for name, k in zip(self.all_names, self.all_kinds) if name not in self.followers]
        self.tie()
        self.damping = np.array(self.model.damping)
        self.gravity = np.array(self.model.gravity.linear)

    def tie(self):
        """G and c of all rates and values; a chain of followers is followed to its leader."""
        starts = np.cumsum([0] + [rotation.ROWS[k] for k in self.kinds])
        row = dict(zip(self.names, starts))
        self.g, self.c = np.zeros((self.model.nv, starts[-1])), np.zeros(self.model.nv)
        for name, kind, joint in zip(self.all_names, self.all_kinds, self.joints):
            factor, offset, links = 1.0, 0.0, 0
            while name in self.followers:
                name, multiplier, shift = self.followers[name]
                offset, factor, links = offset + factor * shift, factor * multiplier, links + 1
                if links > len(self.joints):
                    raise ValueError("followers follow each other")
            for k in range(joint.nv):
                self.g[joint.idx_v + k, row[name] + k] = factor
                self.c[joint.idx_v + k] = offset

    def place(self, y, rates):
        """Pinocchio's q and v, and T with our rates of all joints = T v."""
        q, v, t = pin.neutral(self.model), self.g @ rates, np.eye(self.model.nv)
        at = dict(zip(self.names, np.cumsum([0] + [rotation.SIZE[k] for k in self.kinds])))
        own = np.zeros(self.g.shape[1])
        row = 0
        for name, kind in zip(self.names, self.kinds):
            if kind != "free":
                own[row:row + rotation.ROWS[kind]] = y[at[name]:at[name] + rotation.ROWS[kind]]
            row += rotation.ROWS[kind]
        value = self.g @ own + self.c
        for name, kind, joint in zip(self.all_names, self.all_kinds, self.joints):
            i, k = joint.idx_q, joint.idx_v
            if kind == "free":
                place = self.model.jointPlacements[joint.id]
                turn = rotation.matrix(y[at[name] + 3:at[name] + 7]) @ place.rotation
                inner = rotation.quaternion(place.rotation.T @ turn)
                q[i:i + 3] = place.rotation.T @ y[at[name]:at[name] + 3]
                q[i + 3:i + 7] = inner[[1, 2, 3, 0]]
                t[k:k + 3, k:k + 3] = t[k + 3:k + 6, k + 3:k + 6] = turn
                v[k:k + 3], v[k + 3:k + 6] = turn.T @ v[k:k + 3], turn.T @ v[k + 3:k + 6]
            elif kind == "planar":
                c, s = np.cos(value[k + 2]), np.sin(value[k + 2])
                q[i:i + 4] = value[k], value[k + 1], c, s
                t[k:k + 2, k:k + 2] = [[c, -s], [s, c]]
                v[k:k + 2] = t[k:k + 2, k:k + 2].T @ v[k:k + 2]
            elif joint.nq == 2:
                q[i:i + 2] = np.cos(value[k]), np.sin(value[k])
            else:
                q[i] = value[k]
        return q, v, t

    def parents(self):
        """The rotations of balls' parents: a URDF has no balls, and Pinocchio refuses them."""
        return []

    def swing(self, t, v):
        """What the axes' own turning adds to our accelerations: T' v."""
        out = np.zeros(len(v))
        for kind, joint in zip(self.all_kinds, self.joints):
            k = joint.idx_v
            if kind == "planar":
                out[k:k + 2] = t[k:k + 2, k:k + 2] @ (v[k + 2] * np.array([-v[k + 1], v[k]]))
            if kind == "free":
                out[k:k + 3] = t[k:k + 3, k:k + 3] @ np.cross(v[k + 3:k + 6], v[k:k + 3])
        return out

    def acceleration(self, y, rates):
        """Under no effort but the file's damping."""
        q, v, t = self.place(y, rates)
        force = -self.damping * v
        if not self.followers:
            return t @ pin.aba(self.model, self.data, q, v, force) + self.swing(t, v)
        mass, bias = self.terms(q, v, t)
        return np.linalg.solve(mass, self.g.T @ np.linalg.solve(t.T, force) - bias)

    def terms(self, q, v, t):
        """Mass matrix and bias in our rates, followers tied: M a + bias = effort."""
        inverse = t.T  # T is orthogonal
        mass = pin.crba(self.model, self.data, q).reshape(self.model.nv, self.model.nv)
        mass = inverse.T @ (np.triu(mass) + np.triu(mass, 1).T) @ inverse
        bias = inverse.T @ pin.nle(self.model, self.data, q, v) - mass @ self.swing(t, v)
        return self.g.T @ mass @ self.g, self.g.T @ bias

    def mass_matrix(self, y):
        q, v, t = self.place(y, np.zeros(self.g.shape[1]))
        return self.terms(q, v, t)[0]

    def effort(self, y, rates, acceleration):
        """The effort that gives this acceleration, against the file's damping too."""
        q, v, t = self.place(y, rates)
        mass, bias = self.terms(q, v, t)
        return mass @ acceleration + bias + self.g.T @ (self.damping * (self.g @ rates))

    def report(self, y, rates):
        """Energies, mass, centre, momentum, frames of links, and the Jacobian of the last link."""
        q, v, t = self.place(y, rates)
        model, data = self.model, self.data
        pin.framesForwardKinematics(model, data, q)
        links = [f for f in model.frames if f.type == pin.FrameType.BODY]
        index = {f.name: model.getFrameId(f.name, pin.FrameType.BODY) for f in links}
        last = index[links[-1].name]
        jacobian = pin.computeFrameJacobian(model, data, q, last, pin.ReferenceFrame.LOCAL_WORLD_ALIGNED)
        jacobian = jacobian.reshape(6, model.nv)
        momentum = pin.computeCentroidalMomentum(model, data, q, v)
        return {
            "mass": pin.computeTotalMass(model),
            "center": pin.centerOfMass(model, data, q).copy(),
            "kinetic": pin.computeKineticEnergy(model, data, q, v),
            "potential": pin.computePotentialEnergy(model, data, q),
            "momentum": momentum.linear.copy(),
            "angular_momentum": momentum.angular.copy(),
            "frames": {name: self.pose(data.oMf[i]) for name, i in index.items()},
            "jacobian": {"frame": links[-1].name, "rows": jacobian @ np.linalg.inv(t) @ self.g,
                         "bias": self.frame_bias(q, v, t, last)},
        }

    def frame_bias(self, q, v, t, frame):
        """Acceleration of a frame's origin and its angular acceleration where our accelerations are zero: J' r."""
        still = np.linalg.solve(t, -self.swing(t, v))
        pin.forwardKinematics(self.model, self.data, q, v, still)
        pin.updateFramePlacements(self.model, self.data)
        world = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        moved = pin.getFrameClassicalAcceleration(self.model, self.data, frame, world)
        return np.concatenate([moved.linear, moved.angular])

    def derivatives(self, y, rates):
        """Of the accelerations by values and rates, dampers included; where each joint has one coordinate and none follows."""
        q, v, _ = self.place(y, rates)
        by_value, by_rate, inverse = pin.computeABADerivatives(self.model, self.data, q, v, -self.damping * v)
        inverse = np.triu(inverse) + np.triu(inverse, 1).T
        return {"by_value": by_value.copy(), "by_rate": by_rate - inverse * self.damping, "by_effort": inverse}

    def pose(self, place):
        return {"position": place.translation.copy(), "quaternion": rotation.quaternion(place.rotation)}
