"""Makes the robots that programs are timed on: robots.py DATA FOLDER

DATA has the models of example-robot-data. Of each robot FOLDER gets N.urdf, N.txt (the same for a program without a reader of URDF) and, where
MuJoCo takes it, N.mjb; N is the number of its freedoms. What only some programs compute is left out: pictures, contact, friction, mimic.
"""
import pathlib
import sys
import xml.etree.ElementTree as ET

import mujoco
import numpy as np
import pinocchio as pin

# file, and whether the base moves freely
ROBOTS = [
    ("ur_description/urdf/ur5_robot.urdf", False),
    ("panda_description/urdf/panda.urdf", False),
    ("solo_description/robots/solo12.urdf", True),
    ("baxter_description/urdf/baxter.urdf", False),
    ("g1_description/urdf/g1_29dof_rev_1_0.urdf", True),
    ("talos_data/robots/talos_full_v2.urdf", True),
]


def stripped(path):
    root = ET.parse(path).getroot()
    for owner in [root, *root.iter("link"), *root.iter("joint")]:
        for element in list(owner):
            if element.tag in ("visual", "collision", "gazebo", "transmission", "mimic", "dynamics", "safety_controller"):
                owner.remove(element)
    return root


def base_of(root):
    children = {joint.find("child").get("link") for joint in root.findall("joint")}
    return next(link.get("name") for link in root.findall("link") if link.get("name") not in children)


def free(root, base):
    """The base on a floating joint."""
    joint = ET.SubElement(root, "joint", name="floating_base", type="floating")
    ET.SubElement(joint, "parent", link="world")
    ET.SubElement(joint, "child", link=base)
    ET.SubElement(root, "link", name="world")


def lines(model):
    """A line for each joint: kind, parent, name, place, body."""
    for i in range(1, model.njoints):
        kind = model.joints[i].shortname().replace("JointModel", "")
        place, body = model.jointPlacements[i], model.inertias[i]
        # an axis that is no coordinate axis: the first vector of the motion of unit rate
        axis = [0.0, 0.0, 0.0]
        if kind.endswith("Unaligned"):
            data = model.joints[i].createData()
            model.joints[i].calc(data, np.zeros(1))
            column = np.reshape(data.S, -1)
            axis = column[3:] if kind.startswith("Revolute") else column[:3]
        numbers = [*place.rotation.flatten(), *place.translation, body.mass, *body.lever, *body.inertia.flatten(), *axis]
        yield " ".join([kind, str(model.parents[i]), model.names[i], *(repr(float(x)) for x in numbers)])


def main(data, folder):
    folder.mkdir(parents=True, exist_ok=True)
    for path, is_free in ROBOTS:
        root = stripped(next(data.rglob(path)))
        plain = ET.tostring(root).decode()
        base = base_of(root)
        model = pin.buildModelFromXML(plain, pin.JointModelFreeFlyer()) if is_free else pin.buildModelFromXML(plain)
        if is_free:
            free(root, base)
        name = folder / str(model.nv)
        name.with_suffix(".urdf").write_bytes(ET.tostring(root))
        name.with_suffix(".txt").write_text("\n".join(lines(model)) + "\n")
        spec = mujoco.MjSpec.from_string(plain)
        if is_free:
            (spec.body(base) or spec.worldbody.first_body()).add_freejoint()
        try:
            mujoco.mj_saveModel(spec.compile(), str(name.with_suffix(".mjb")))
        except ValueError as why:
            print(f"{path}: MuJoCo: {why}".splitlines()[0], file=sys.stderr)
        print(model.nv, path)


main(*map(pathlib.Path, sys.argv[1:]))
