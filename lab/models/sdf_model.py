"""An SDF of versions 1.4 to 1.6 on Pinocchio's terms: a tree of joints, and loops as rows of a saddle-point system.

Pinocchio reads no SDF here. Every joint frame has the global axes of the drawn configuration, so values count from there.
What `urdf_model.py` says of rows, T and swing holds here too.
"""

import numpy as np
import pinocchio as pin

import common
import rotation
import urdf_model

# Gravity of a file without its own, as the format's description has it.
GRAVITY = np.array([0.0, 0.0, -9.8])

# Rows of loops below this share of the largest singular value are redundant: axes are written with six digits.
REDUNDANT = 1e-6


def numbers(text, default):
    return np.array([float(word) for word in text.split()]) if text and text.strip() else np.array(default)


def place(text):
    p = numbers(text, [0.0] * 6)
    return pin.SE3(pin.rpy.rpyToMatrix(*p[3:]), p[:3])


def straightened(axes, most, rounding=2e-13):
    """Axes within `most` [rad] of each other made parallel, and those within it of a right angle to what more axes have put across it.

    A direction is that which most of its axes have exactly, the first of the file where as many have another.
    """
    groups = []
    for i, axis in enumerate(axes):
        near = [g for g in groups if np.linalg.norm(np.cross(axes[g[0]], axis)) <= most]
        near[0].append(i) if near else groups.append([i])
    values = []
    for group in groups:
        same = [sum(np.linalg.norm(np.cross(axes[i], axes[k])) <= rounding for k in group) for i in group]
        values.append(axes[group[int(np.argmax(same))]])
    for i, one in enumerate(groups):
        for j, common in enumerate(groups):
            across = values[i] @ values[j]
            if len(common) > 1 and (len(common), j) > (len(one), i) and rounding < abs(across) <= most:
                turned = values[i] - values[j] * across
                values[i] = turned / np.linalg.norm(turned)
    out = list(axes)
    for group, value in zip(groups, values):
        for i in group:
            out[i] = value if axes[i] @ value > 0 else -value
    return out


class Sdf(urdf_model.Urdf):
    """`most` [rad]: axes that are off by less are taken as they are meant; 0 leaves them as they are written."""

    def __init__(self, path, most=0.0):
        root = common.tree(path)
        self.version = tuple(int(part) for part in root.get("version").split("."))
        model = root.find("model") if root.find("model") is not None else root.find("world/model")
        if model.find("model") is not None or self.version > (1, 6):
            raise ValueError("nested models and frames of 1.7 are not judged")
        self.frame = place(model.findtext("pose"))
        self.links = {link.get("name"): link for link in model.findall("link")}
        self.poses = {name: self.frame * place(link.findtext("pose")) for name, link in self.links.items()}
        self.file_joints = [self.read_joint(joint) for joint in model.findall("joint")]
        turned = [joint for joint in self.file_joints if "axis" in joint]
        if most:
            for joint, axis in zip(turned, straightened([joint["axis"] for joint in turned], most)):
                joint["axis"] = axis
        weight = root.find("world/gravity")
        self.gravity = numbers(weight.text if weight is not None else "", GRAVITY)
        self.build()

    def read_joint(self, joint):
        axis, kind = joint.find("axis"), joint.get("type")
        frame = self.poses[joint.findtext("child").strip()] * place(joint.findtext("pose"))
        out = {"name": joint.get("name"), "type": kind, "at": frame.translation}
        out |= {"parent": joint.findtext("parent").strip(), "child": joint.findtext("child").strip()}
        if kind in ("revolute", "prismatic"):
            in_model = axis.findtext("use_parent_model_frame", "0").strip() in ("1", "true") or self.version < (1, 5)
            direction = (self.frame.rotation if in_model else frame.rotation) @ numbers(axis.findtext("xyz"), [0, 0, 1])
            out["axis"] = direction / np.linalg.norm(direction)
            dynamics = {key: float(axis.findtext(f"dynamics/{key}", "0")) for key in
                        ("damping", "spring_stiffness", "spring_reference")}
            out |= dynamics
        elif kind not in ("ball", "fixed"):
            raise ValueError(f"joint type {kind} is not judged")
        return out

    def build(self):
        """The tree from the world or the first link; balls are cut before other joints are."""
        self.model, self.host = pin.Model(), {"world": (0, np.zeros(3))}
        self.model.gravity.linear = self.gravity
        self.all_kinds, self.tree_joints, self.cuts = [], [], []
        edges, roots, rest = self.spanning_tree()
        for root in roots:
            if root != "world":
                self.add(root, 0, np.zeros(3), pin.JointModelFreeFlyer(), self.poses[root].translation, "base", "free", {})
            # Depth first: Pinocchio's recursions take the joints of a branch as neighbours.
            stack = list(reversed(edges.get(root, [])))
            while stack:
                joint, known, new = stack.pop()
                self.grow(joint, known)
                stack.extend(reversed(edges.get(new, [])))
        for joint in rest:
            if joint["type"] != "ball":
                raise ValueError("only balls are cut")
            self.cuts.append(joint)
        self.data = self.model.createData()
        self.joints = list(self.model.joints)[1:]
        self.all_names = self.names = list(self.model.names)[1:]
        self.kinds, self.followers = self.all_kinds, {}
        self.tie()
        at_row = lambda key: np.concatenate([np.full(j.nv, d.get(key, 0.0)) for j, d in zip(self.joints, self.tree_joints)])
        self.damping, self.stiffness, self.rest = at_row("damping"), at_row("spring_stiffness"), at_row("spring_reference")

    def spanning_tree(self):
        """{link: joints that lead on from it}, the roots, and the joints that close loops."""
        order = ["fixed", "revolute", "prismatic", "ball"]
        rest = sorted(self.file_joints, key=lambda joint: order.index(joint["type"]))
        edges, known, roots = {}, {"world"}, ["world"]
        while not known >= set(self.links):
            for joint in rest:
                ends = (joint["parent"], joint["child"])
                if (ends[0] in known) != (ends[1] in known):
                    old, new = ends if ends[0] in known else ends[::-1]
                    edges.setdefault(old, []).append((joint, old, new))
                    known.add(new)
                    rest.remove(joint)
                    break
            else:
                roots.append(next(name for name in self.links if name not in known))
                known.add(roots[-1])
        return edges, roots, rest

    def grow(self, joint, known):
        forward = known == joint["parent"]
        new = joint["child"] if forward else joint["parent"]
        parent, origin = self.host[known]
        if joint["type"] == "fixed":
            self.host[new] = (parent, origin)
            self.weigh(new)
            return
        if joint["type"] == "ball":
            raise ValueError("a ball in the tree is not judged")
        axis = joint["axis"] if forward else -joint["axis"]
        kind = {"revolute": "turn", "prismatic": "slide"}[joint["type"]]
        made = {"turn": pin.JointModelRevoluteUnaligned, "slide": pin.JointModelPrismaticUnaligned}[kind](*axis)
        self.add(new, parent, origin, made, joint["at"], joint["name"], kind, joint)

    def add(self, link, parent, origin, made, at, name, kind, joint):
        index = self.model.addJoint(parent, made, pin.SE3(np.eye(3), at - origin), name)
        self.host[link] = (index, np.array(at))
        self.all_kinds.append(kind)
        self.tree_joints.append(joint)
        self.weigh(link)

    def weigh(self, name):
        inertial = self.links[name].find("inertial")
        index, origin = self.host[name]
        drawn = pin.SE3(self.poses[name].rotation, self.poses[name].translation - origin)
        self.model.addFrame(pin.Frame(name, index, 0, drawn, pin.FrameType.BODY))
        if inertial is not None:
            read = lambda key: float(inertial.findtext(f"inertia/{key}", "0"))
            inertia = np.array([[read("ixx"), read("ixy"), read("ixz")], [read("ixy"), read("iyy"), read("iyz")],
                                [read("ixz"), read("iyz"), read("izz")]])
            body = pin.Inertia(float(inertial.findtext("mass", "1")), np.zeros(3), inertia)
            self.model.appendBodyToJoint(index, body, drawn * place(inertial.findtext("pose")))

    def ends(self, joint):
        return [(self.host[joint[end]][0], joint["at"] - self.host[joint[end]][1]) for end in ("parent", "child")]

    def rows(self, y, rates):
        """Of the cut balls: violation, Jacobian in our rates, and its bias J' v."""
        return self.rows_at(*self.place(y, rates))

    def rows_at(self, q, v, t):
        model, data = self.model, self.data
        pin.forwardKinematics(model, data, q, v, np.zeros(model.nv))
        pin.computeJointJacobians(model, data, q)
        world, inverse = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED, t.T  # T is orthogonal
        gap, jacobian, bias = [], [], []
        for joint in self.cuts:
            parts = []
            for index, local in self.ends(joint):
                arm = data.oMi[index].rotation @ local
                j = pin.getJointJacobian(model, data, index, world)
                spin = pin.getVelocity(model, data, index, world).angular
                still = pin.getClassicalAcceleration(model, data, index, world)
                turned = still.linear + np.cross(still.angular, arm) + np.cross(spin, np.cross(spin, arm))
                parts.append((data.oMi[index].translation + arm, (j[:3] - pin.skew(arm) @ j[3:]) @ inverse, turned))
            (a, ja, ba), (b, jb, bb) = parts
            gap, jacobian, bias = gap + [b - a], jacobian + [jb - ja], bias + [bb - ba]
        if not self.cuts:
            return np.zeros(0), np.zeros((0, model.nv)), np.zeros(0)
        jacobian = np.vstack(jacobian)
        return np.concatenate(gap), jacobian, np.concatenate(bias) - jacobian @ self.swing(t, v)

    def own_effort(self, y, rates):
        """Dampers and springs of the file."""
        value, i = np.zeros(self.model.nv), 0
        for kind, joint in zip(self.kinds, self.joints):
            if kind != "free":
                value[joint.idx_v] = y[i]
            i += rotation.SIZE[kind]
        return -self.damping * rates - self.stiffness * (value - self.rest)

    def acceleration(self, y, rates):
        """Saddle point: M a + bias - J^T f = own effort, J a = -J' v; redundant rows by least squares."""
        q, v, t = self.place(y, rates)
        mass, bias = self.terms(q, v, t)
        force = self.own_effort(y, rates) - bias
        _, jacobian, turned = self.rows_at(q, v, t)
        lower = np.linalg.cholesky(mass)
        free = np.linalg.solve(lower, force)
        half = np.linalg.solve(lower, jacobian.T).T
        if len(half):
            free = free + np.linalg.lstsq(half, -turned - half @ free, REDUNDANT)[0]
        return np.linalg.solve(lower.T, free)

    def effort(self, y, rates, acceleration):
        """Of the tree, with cut balls open."""
        q, v, t = self.place(y, rates)
        mass, bias = self.terms(q, v, t)
        return mass @ acceleration + bias - self.own_effort(y, rates)
