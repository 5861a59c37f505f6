"""Lists every URDF, MJCF and SDF of the packages: collect.py [TABLE.csv]

One row a file: who reads it (Pinocchio for URDF, MuJoCo for MJCF), and what moves in it.
"""

import csv
import sys
from collections import Counter

import mujoco
import numpy as np
import pinocchio as pin

import common

COLUMNS = [
    "package", "path", "format", "sha256", "read", "bodies", "joints", "freedoms",
    "loops", "mimic", "massless", "impossible", "actuators", "reason",
]

# Moments may miss the triangle inequality by this share of the largest: the digits of a file.
TRIANGLE = 1e-9


def impossible(mass, moments):
    """Whether no distribution of mass has these principal moments."""
    a, b, c = sorted(moments)
    return bool(mass > 0 and (a < -TRIANGLE * c or a + b < c * (1 - TRIANGLE)))


def urdf(path):
    model = pin.buildModelFromUrdf(str(path), mimic=True)
    lumps = [model.inertias[i] for i in range(1, model.njoints)]
    moments = [np.linalg.eigvalsh(lump.inertia) for lump in lumps]
    return {
        "bodies": len(lumps),
        "joints": len(lumps),
        "freedoms": model.nv,
        "mimic": len(model.mimicking_joints),
        "massless": sum(lump.mass == 0 for lump in lumps),
        "impossible": sum(impossible(lump.mass, m) for lump, m in zip(lumps, moments)),
        "actuators": len(common.tree(path).findall("transmission")),
    }


def mjcf(path):
    model = mujoco.MjModel.from_xml_path(str(path))
    moving = [i for i in range(1, model.nbody) if model.body_weldid[i] == i]
    mass = np.zeros(model.nbody)
    np.add.at(mass, model.body_weldid, model.body_mass)
    closing = (mujoco.mjtEq.mjEQ_CONNECT, mujoco.mjtEq.mjEQ_WELD)
    return {
        "bodies": len(moving),
        "joints": model.njnt,
        "freedoms": model.nv,
        "loops": sum(kind in closing for kind in model.eq_type),
        "mimic": sum(kind == mujoco.mjtEq.mjEQ_JOINT for kind in model.eq_type),
        "massless": sum(mass[i] == 0 for i in moving),
        "actuators": model.nu,
    }


def sdf(path):
    """Counts by name alone: neither program reads SDF."""
    root = common.tree(path)
    joints = [j for j in root.iter("joint") if j.get("type")]
    links = {link.get("name") for link in root.iter("link")}
    cuts, group = 0, {name: name for name in links | {"world"}}

    def top(name):
        while group.setdefault(name, name) != name:
            name = group[name]
        return name

    for joint in joints:
        parent, child = top(joint.findtext("parent", "").strip()), top(joint.findtext("child", "").strip())
        cuts += parent == child
        group[child] = parent
    return {
        "bodies": len(links),
        "joints": sum(j.get("type") != "fixed" for j in joints),
        "loops": cuts,
        "mimic": len(list(root.iter("mimic"))),
        "massless": sum(link.find("inertial") is None for link in root.iter("link")),
    }


def row(package, path, kind):
    full = common.data() / package / path
    result = {"package": package, "path": path, "format": kind, "sha256": common.digest(full)}
    read = {"urdf": urdf, "mjcf": mjcf, "sdf": sdf}.get(kind)
    if read is None:
        return result | {"read": "part"}
    try:
        result |= {"read": "counted" if kind == "sdf" else "yes"} | read(full)
    except Exception as fault:  # each program has its own
        reason = str(fault).strip().replace(str(common.data()) + "/", "").splitlines() or [type(fault).__name__]
        result |= {"read": "no", "reason": reason[0][:120]}
    return result


def main():
    pin_rows = [row(*model) for model in common.models()]
    out = open(sys.argv[1], "w", newline="") if len(sys.argv) > 1 else sys.stdout
    table = csv.DictWriter(out, COLUMNS, restval="", lineterminator="\n")
    table.writeheader()
    table.writerows(pin_rows)
    counts = Counter((r["package"], r["format"], r["read"]) for r in pin_rows)
    moving = Counter((r["package"], r["format"], r["read"]) for r in pin_rows if r.get("bodies"))
    for key in sorted(counts):
        print(*key, counts[key], f"({moving[key]} with a moving body)", file=sys.stderr)


if __name__ == "__main__":
    main()
