"""Loops and couplings of an SDF or a URDF that Drake takes in discrete plants only: exact rows beside Drake's own terms of the open tree."""

import re
from xml.etree import ElementTree

import numpy as np
from pydrake.multibody.tree import JacobianWrtVariable

LOOPS = ("drake:ball_constraint", "drake:distance_constraint")


def declared(text):
    """Drake's prefix stands for itself: files declare it as they like, or not at all."""
    text = re.sub(r'\s+xmlns:drake="[^"]*"', "", text)
    return re.sub(r"<(sdf|robot)\b", r'<\1 xmlns:drake="drake"', text, count=1)


def split(path):
    """The text without what makes rows, and the rows: loops by their elements, couplings as ({joint: factor}, value)."""
    ElementTree.register_namespace("drake", "drake")
    root = ElementTree.fromstring(declared(path.read_text()))
    loops, couplings = [], []
    for model in [root] if root.tag == "robot" else root.iter("model"):
        for child in list(model):
            name = child.tag.replace("{drake}", "drake:")
            if name in LOOPS:
                loops.append((name, {part.tag.split("_constraint_")[1]: said(part) for part in child}))
                model.remove(child)
            elif child.get("type") == "gearbox":
                couplings.append(gearbox(model, child))
                model.remove(child)
            elif child.tag == "joint" and child.find("{drake}mimic") is not None:
                mimic = child.find("{drake}mimic")
                factor = float(mimic.get("multiplier", 1))
                couplings.append(({child.get("name"): 1.0, mimic.get("joint"): -factor}, float(mimic.get("offset", 0))))
                child.remove(mimic)
    return ElementTree.tostring(root, encoding="unicode"), loops, couplings


def said(part):
    """What an element says: as text in an SDF, as an attribute in a URDF."""
    return (part.text or "").strip() or part.get("name") or part.get("value")


def gearbox(model, element):
    """The joints from the reference body to parent and child, both about the axes of the gearbox as they are written."""
    def joint(word):
        ends = element.find("gearbox_reference_body").text.strip(), element.find(word).text.strip()
        found = [j for j in model.findall("joint") if (j.findtext("parent"), j.findtext("child")) == ends]
        return found[0].get("name")
    return {joint("child"): 1.0, joint("parent"): float(element.findtext("gearbox_ratio"))}, 0.0


class Rows:
    def __init__(self, plant, context, loops, couplings):
        self.plant, self.context, self.couplings = plant, context, couplings
        self.loops = [(name, self.ends(parts)) for name, parts in loops]
        self.lengths = [np.linalg.norm(self.gap(ends)) for _, ends in self.loops]

    def ends(self, parts):
        def frame(name):
            return self.plant.world_frame() if name == "world" else self.plant.GetBodyByName(name).body_frame()
        numbers = lambda key: np.array(parts[key].split(), float)
        return [(frame(parts["body_A"]), numbers("p_AP")), (frame(parts["body_B"]), numbers("p_BQ"))]

    def gap(self, ends):
        a, b = (self.plant.CalcPointsPositions(self.context, frame, at, self.plant.world_frame()).ravel() for frame, at in ends)
        return a - b

    def rows(self):
        """Residual, J and J' v at the state of the context."""
        plant, context, world = self.plant, self.context, self.plant.world_frame()
        v, kind = plant.GetVelocities(context), JacobianWrtVariable.kV
        residual, jacobian, bias = [], [], []
        for (name, ends), length in zip(self.loops, self.lengths):
            d = self.gap(ends)
            a, b = (plant.CalcJacobianTranslationalVelocity(context, kind, frame, at, world, world) for frame, at in ends)
            p, q = (plant.CalcBiasTranslationalAcceleration(context, kind, frame, at, world, world).ravel() for frame, at in ends)
            if name == "drake:ball_constraint":
                residual.append(d), jacobian.append(a - b), bias.append(p - q)
            else:
                speed = (a - b) @ v
                residual.append([(d @ d - length**2) / 2]), jacobian.append([d @ (a - b)]), bias.append([speed @ speed + d @ (p - q)])
        values = plant.GetPositions(context)
        for terms, value in self.couplings:
            row = np.zeros(plant.num_velocities())
            for name, factor in terms.items():
                row[plant.GetJointByName(name).velocity_start()] = factor
            residual.append([row @ values - value]), jacobian.append([row]), bias.append([0.0])
        return np.concatenate(residual), np.vstack(jacobian), np.concatenate(bias)

    def settle(self):
        """The nearest state on the rows; coordinates are those of joints with one freedom or two."""
        plant, context = self.plant, self.context
        for _ in range(30):
            residual, jacobian, _ = self.rows()
            plant.SetPositions(context, plant.GetPositions(context) - np.linalg.lstsq(jacobian, residual, 1e-9)[0])
        _, jacobian, _ = self.rows()
        v = plant.GetVelocities(context)
        plant.SetVelocities(context, v - np.linalg.lstsq(jacobian, jacobian @ v, 1e-9)[0])

    def accelerations(self, free):
        """Those on the rows, by M (a - a of the open tree) + J^T f = 0 and J a = -J' v."""
        _, jacobian, bias = self.rows()
        mass, size = self.plant.CalcMassMatrix(self.context), len(bias)
        whole = np.block([[mass, jacobian.T], [jacobian, np.zeros((size, size))]])
        return np.linalg.lstsq(whole, np.concatenate([mass @ free, -bias]), 1e-12)[0][:len(free)]
