"""Writes what MuJoCo and Pinocchio say of the ten-line files: conventions.py [FOLDER]

Each file of conventions/ is about one convention of a format; conventions.json has a state of it by seed, and what the other
program computes there. README.md says what the fields mean.
"""

import json
import sys
import zlib
from pathlib import Path

import mujoco
import numpy as np
import pinocchio as pin

import common
import rotation
from mjcf_model import Mjcf
from mjcf_rows import Rows
from references import by_joint, by_name, judge, plain
from urdf_model import Urdf

FOLDER = common.HERE / "conventions"


def six(tensor):
    """xx yy zz xy yz zx, as a scene has it."""
    return tensor[[0, 1, 2, 0, 1, 2], [0, 1, 2, 1, 2, 0]]


def compiled(model):
    """What MuJoCo makes of the attributes of joints and bodies; tensors about the centre, global axes, reference."""
    m, joints, bodies = model.model, {}, {}
    for j, name in enumerate(model.names):
        dof, qpos = m.jnt_dofadr[j], m.jnt_qposadr[j]
        joints[name] = {"armature": m.dof_armature[dof], "damping": m.dof_damping[dof], "stiffness": m.jnt_stiffness[j]}
        joints[name] |= {"invweight": m.dof_invweight0[dof], "place": m.jnt_pos[j], "body": model.body_name(m.jnt_bodyid[j])}
        if model.kinds[j] in ("turn", "slide"):
            joints[name] |= {"ref": m.qpos0[qpos], "springref": m.qpos_spring[qpos]}
            joints[name] |= {"range": m.jnt_range[j], "limited": bool(m.jnt_limited[j])}
    mujoco.mj_resetData(m, model.data)
    mujoco.mj_forward(m, model.data)
    for b in range(1, m.nbody):
        turn = model.data.ximat[b].reshape(3, 3)
        tensor = turn @ np.diag(m.body_inertia[b]) @ turn.T
        bodies[model.body_name(b)] = {"mass": m.body_mass[b], "center": model.data.xipos[b].copy(), "inertia": six(tensor),
                                      "position": model.data.xpos[b].copy()}
    return {"compiled": joints, "bodies": bodies}


def hard(path, y, rates):
    """Equalities taken as exact: a state on them, and its accelerations."""
    model = Rows(path)
    if not model.model.neq:
        return {}
    y, rates, gap = model.closed(y, rates)
    return {"hard": {"gap": gap, "state": by_joint(model, y, rates), "acceleration": by_name(model, model.acceleration(y, rates))}}


def limits(model):
    """Beyond its range by a tenth of it, at rest: MuJoCo's soft acceleration, and that without the limit."""
    m, data = model.model, model.data
    if not any(m.jnt_limited):
        return {}
    y = np.array([m.jnt_range[j][1] * 1.1 - m.qpos0[m.jnt_qposadr[j]] for j in range(m.njnt)])
    free = model.acceleration(y, np.zeros(m.nv))
    m.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT)
    model.place(y, np.zeros(m.nv))
    out = {"value": by_name(model, y), "free": by_name(model, free), "soft": by_name(model, data.qacc.copy())}
    m.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT)
    return {"limit": out | {"solref": m.jnt_solref.copy(), "solimp": m.jnt_solimp.copy()}}


def keys(model, y, rates):
    """The first keyframe: its state, and the accelerations with its controls at the state of the seed."""
    m = model.model
    if not m.nkey:
        return {}
    if not m.nu:
        return {"key": by_joint(model, *model.state_of(m.key_qpos[0].copy(), m.key_qvel[0].copy()))}
    model.place(y, rates, actuators=True)
    model.data.ctrl[:] = m.key_ctrl[0]
    mujoco.mj_forward(m, model.data)
    t = model.place(y, rates)
    model.place(y, rates, actuators=True)
    model.data.ctrl[:] = m.key_ctrl[0]
    mujoco.mj_forward(m, model.data)
    found = by_name(model, t @ model.data.qacc_smooth + model.swing(t))
    return {"ctrl": m.key_ctrl[0].copy(), "acceleration_ctrl": found, "actuator_force": model.data.actuator_force.copy()}


def lumps(model):
    """Mass, centre and tensor of what moves with a joint; global axes, reference configuration."""
    inner, bodies = model.model, {}
    pin.forwardKinematics(inner, model.data, pin.neutral(inner))
    for j in range(1, inner.njoints):
        place, body = model.data.oMi[j], inner.inertias[j]
        bodies[inner.names[j]] = {"mass": body.mass, "center": place.act(body.lever),
                                  "inertia": six(place.rotation @ body.inertia @ place.rotation.T)}
    return {"bodies": bodies}


def one(path):
    seed = zlib.crc32(path.name.encode())
    model = Urdf(path) if path.suffix == ".urdf" else Mjcf(path)
    out = judge(model, seed, False)
    if path.suffix == ".urdf":
        return out | lumps(model)
    y, rates, _ = rotation.random_state(model.kinds, seed)
    out |= keys(model, y, rates) | hard(path, y, rates) | limits(model)
    return out | compiled(model)


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else FOLDER
    out = {"by": {"urdf": f"pinocchio {pin.__version__}", "xml": f"mujoco {mujoco.__version__}"}}
    out["files"] = {p.name: plain(one(p)) for p in sorted(folder.iterdir()) if p.suffix in (".xml", ".urdf") and not p.name.startswith("drake_")}
    lines = [f"{json.dumps(name)}:{json.dumps(found, separators=(',', ':'))}" for name, found in out["files"].items()]
    text = '{"by":' + json.dumps(out["by"]) + ',"files":{\n' + ",\n".join(lines) + "\n}}\n"
    (folder / "conventions.json").write_text(text)
    print(len(lines), "files,", len(text) // 1000, "kB")


if __name__ == "__main__":
    main()
