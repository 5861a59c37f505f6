"""An MJCF as MuJoCo reads it, in the conventions of README.md: no contacts, limits, dry friction or fluid."""

import mujoco
import numpy as np

import rotation

KINDS = {
    mujoco.mjtJoint.mjJNT_HINGE: "turn",
    mujoco.mjtJoint.mjJNT_SLIDE: "slide",
    mujoco.mjtJoint.mjJNT_BALL: "ball",
    mujoco.mjtJoint.mjJNT_FREE: "free",
}


class Mjcf:
    def __init__(self, path):
        self.model = mujoco.MjModel.from_xml_path(str(path))
        self.read()

    @classmethod
    def of_text(cls, text):
        self = cls.__new__(cls)
        self.model = mujoco.MjModel.from_xml_string(text)
        self.read()
        return self

    def read(self):
        model = self.model
        self.off = [name for name, n in (("equality", model.neq), ("fluid", model.opt.density + model.opt.viscosity)) if n]
        self.is_driven = not model.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_ACTUATION
        model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONSTRAINT | mujoco.mjtDisableBit.mjDSBL_SENSOR
        model.opt.density = model.opt.viscosity = 0
        self.data = mujoco.MjData(model)
        self.kinds = [KINDS[mujoco.mjtJoint(kind)] for kind in model.jnt_type]
        self.names = [self.joint_name(j) for j in range(model.njnt)]
        self.followers = {}
        mujoco.mj_resetData(model, self.data)
        mujoco.mj_forward(model, self.data)
        self.reference = np.array(self.data.xmat).reshape(-1, 3, 3)
        self.axes = np.array(self.data.xaxis).reshape(-1, 3)
        weightless = model.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_GRAVITY
        self.gravity = np.zeros(3) if weightless else np.array(model.opt.gravity)
        self.moving = np.array(model.body_weldid) > 0

    def joint_name(self, j):
        """Its own name, or the body's name with the joint's number on that body, counted from 1."""
        body = self.model.jnt_bodyid[j]
        return self.model.joint(j).name or f"{self.body_name(body)}#{j - self.model.body_jntadr[body] + 1}"

    def body_name(self, body):
        return self.model.body(body).name or f"body{body}"

    def place(self, y, rates, actuators=False):
        """Puts the state into MuJoCo; gives T with our rates = T qvel."""
        model, data = self.model, self.data
        flag = int(mujoco.mjtDisableBit.mjDSBL_ACTUATION)
        model.opt.disableflags = model.opt.disableflags & ~flag if actuators and self.is_driven else model.opt.disableflags | flag
        i = 0
        for j, kind in enumerate(self.kinds):
            a, body = model.jnt_qposadr[j], model.jnt_bodyid[j]
            if kind in ("turn", "slide"):
                data.qpos[a] = model.qpos0[a] + y[i]
            else:
                if kind == "free":
                    data.qpos[a:a + 3] = model.qpos0[a:a + 3] + y[i:i + 3]
                turn, rest = rotation.matrix(y[i + rotation.SIZE[kind] - 4:i + rotation.SIZE[kind]]), self.reference[body]
                inner = turn @ rest if kind == "free" else rest.T @ turn @ rest
                a += 3 * (kind == "free")
                data.qpos[a:a + 4] = rotation.quaternion(inner)
            i += rotation.SIZE[kind]
        mujoco.mj_kinematics(model, data)
        t = np.eye(model.nv)
        for j, kind in enumerate(self.kinds):
            if kind in ("ball", "free"):
                k = model.jnt_dofadr[j] + 3 * (kind == "free")
                t[k:k + 3, k:k + 3] = np.array(data.xmat[model.jnt_bodyid[j]]).reshape(3, 3)
        data.qvel[:] = t.T @ rates
        data.ctrl[:] = 0
        data.act[:] = 0
        mujoco.mj_forward(model, data)
        return t

    def parents(self):
        """For each ball the rotation of what it turns on, since the reference, at the state that was placed last: A R^T."""
        out = []
        for j, kind in enumerate(self.kinds):
            if kind == "ball":
                a, body = self.model.jnt_qposadr[j], self.model.jnt_bodyid[j]
                rest, now = self.reference[body], np.array(self.data.xmat[body]).reshape(3, 3)
                out.append(now @ rotation.matrix(self.data.qpos[a:a + 4]).T @ rest.T)
        return out

    def state_of(self, qpos, qvel):
        """Our values and rates of MuJoCo's: the way back of `place`."""
        model, data = self.model, self.data
        data.qpos[:] = qpos
        mujoco.mj_kinematics(model, data)
        y, rates = [], qvel.copy()
        for j, kind in enumerate(self.kinds):
            a, k, body = model.jnt_qposadr[j], model.jnt_dofadr[j], model.jnt_bodyid[j]
            if kind in ("turn", "slide"):
                y.append(qpos[a:a + 1] - model.qpos0[a:a + 1])
                continue
            if kind == "free":
                y.append(qpos[a:a + 3] - model.qpos0[a:a + 3])
                a, k = a + 3, k + 3
            turn, rest = rotation.matrix(qpos[a:a + 4]), self.reference[body]
            y.append(rotation.quaternion(turn @ rest.T if kind == "free" else rest @ turn @ rest.T))
            rates[k:k + 3] = data.xmat[body].reshape(3, 3) @ qvel[k:k + 3]
        return np.concatenate(y), rates

    def swing(self, t):
        """What a ball's axes add: its global rate is crossed with the body's whole rate."""
        out = np.zeros(self.model.nv)
        for j, kind in enumerate(self.kinds):
            if kind == "ball":
                k = self.model.jnt_dofadr[j]
                whole = self.data.cvel[self.model.jnt_bodyid[j]][:3]
                out[k:k + 3] = np.cross(whole, t[k:k + 3, k:k + 3] @ self.data.qvel[k:k + 3])
        return out

    def acceleration(self, y, rates, actuators=False):
        t = self.place(y, rates, actuators)
        return t @ self.data.qacc_smooth + self.swing(t)

    def matrix(self):
        mass = np.zeros((self.model.nv, self.model.nv))
        mujoco.mj_fullM(self.model, self.data, mass)
        return mass

    def mass_matrix(self, y):
        t = self.place(y, np.zeros(self.model.nv))
        return t @ self.matrix() @ t.T

    def effort(self, y, rates, acceleration):
        t = self.place(y, rates)
        inner = t.T @ (acceleration - self.swing(t))
        return t @ (self.matrix() @ inner + self.data.qfrc_bias - self.data.qfrc_passive)

    def report(self, y, rates):
        """Kinetic energy with armature; potential of weight and of springs apart; moving bodies only."""
        t = self.place(y, rates)
        model, data = self.model, self.data
        mass = np.array(model.body_mass) * self.moving
        weighted = mass @ data.xipos
        mujoco.mj_energyPos(model, data)
        whole = data.energy[0] + float(np.array(model.body_mass) @ data.xipos @ self.gravity)
        bodies = {}
        for body in range(1, model.nbody):
            turn = np.array(data.xmat[body]).reshape(3, 3)
            bodies[self.body_name(body)] = {
                "position": data.xpos[body].copy(),
                "quaternion": rotation.quaternion(turn),
                "mass": float(model.body_mass[body]),
            }
        jacobian = np.zeros((6, model.nv))
        mujoco.mj_jacBody(model, data, jacobian[:3], jacobian[3:], model.nbody - 1)
        return {
            "on": {name: self.body_name(model.jnt_bodyid[j]) for j, name in enumerate(self.names)},
            "axes": {name: self.axes[j] for j, name in enumerate(self.names)},
            "mass": float(mass.sum()),
            "center": weighted / mass.sum() if mass.sum() else np.zeros(3),
            "kinetic": float(data.qvel @ self.matrix() @ data.qvel / 2),
            "potential": float(-weighted @ self.gravity),
            "springs": float(whole),
            "frames": bodies,
            "jacobian": {"frame": self.body_name(model.nbody - 1), "rows": jacobian @ t.T},
        }
