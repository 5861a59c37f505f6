"""Equalities of an MJCF taken as exact, on MuJoCo's own rows: M a + bias = effort + J^T f, J a = -J' v."""

import mujoco
import numpy as np

from mjcf_model import Mjcf

# Second derivative by seven points, error of sixth order; step along a motion of constant rate, of rates up to 1 [s].
STENCIL, STEP = np.array([2, -27, 270, -490, 270, -27, 2]) / 180, 1e-2

# Singular values below this ratio of the largest are of redundant rows.
REDUNDANT = 1e-9

# And those above this ratio are of independent rows; a place nearby has the same number of them [m, rad].
REGULAR, NEARBY = 1e-4, 1e-2

# Steps of Newton's method to a state on the rows.
STEPS = 60


class Rows(Mjcf):
    """Accelerations have about nine digits, since J' v is a difference quotient."""

    def residual(self):
        model, data = self.model, self.data
        mujoco.mj_fwdPosition(model, data)
        return data.efc_pos[:data.ne].copy(), data.efc_J.reshape(-1, model.nv)[:data.ne].copy()

    def switch(self, is_on):
        """Rows of equalities alone."""
        off = int(mujoco.mjtDisableBit.mjDSBL_CONSTRAINT)
        options = self.model.opt
        options.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
        options.disableflags = options.disableflags & ~off if is_on else options.disableflags | off
        options.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT | mujoco.mjtDisableBit.mjDSBL_LIMIT)

    def near(self):
        """Newton's method from the state that is placed; what is left of the gap."""
        for _ in range(STEPS):
            gap, jacobian = self.residual()
            if len(gap) == 0 or np.max(np.abs(gap)) < 1e-14:
                break
            mujoco.mj_integratePos(self.model, self.data.qpos, -np.linalg.lstsq(jacobian, gap, REDUNDANT)[0], 1.0)
        return float(np.max(np.abs(self.residual()[0]), initial=0))

    def closed(self, y, rates, parts=1):
        """The state on the rows near this one, with its gap; by steps from the reference, so that loops stay on the branch that is drawn."""
        model, data, change = self.model, self.data, np.zeros(self.model.nv)
        self.place(y, rates)
        mujoco.mj_differentiatePos(model, change, 1.0, model.qpos0, data.qpos)
        speed = data.qvel.copy()
        self.switch(True)
        data.qpos[:] = model.qpos0 if parts > 1 else data.qpos
        gap = self.near()
        for _ in range(parts if parts > 1 else 0):
            mujoco.mj_integratePos(model, data.qpos, change, 1.0 / parts)
            gap = self.near()
        _, jacobian = self.residual()
        data.qvel[:] = speed - np.linalg.lstsq(jacobian, jacobian @ speed, REDUNDANT)[0] if len(jacobian) else speed
        state = self.state_of(data.qpos.copy(), data.qvel.copy())
        self.switch(False)
        return *state, gap

    def is_regular(self):
        """Whether the rows are clearly independent or clearly redundant; where loops are singular as drawn, accelerations have no digits."""
        mujoco.mj_resetData(self.model, self.data)
        ranks = []
        for _ in range(2):
            self.switch(True)
            mujoco.mj_forward(self.model, self.data)
            sizes = np.linalg.svd(self.residual()[1], compute_uv=False)
            self.switch(False)
            ranks.append([int(np.sum(sizes > share * sizes[0])) for share in (REDUNDANT, REGULAR)])
            self.data.qpos[:] += NEARBY * np.sin(np.arange(self.model.nq))
        return ranks[0][0] == ranks[0][1] == ranks[1][1]

    def turned(self):
        """J and J' v at the state that is placed."""
        model, data = self.model, self.data
        v, qpos, out = data.qvel.copy(), data.qpos.copy(), 0
        step = STEP / max(1.0, np.max(np.abs(v)))
        self.switch(True)
        _, jacobian = self.residual()
        for k, weight in enumerate(STENCIL):
            data.qpos[:] = qpos
            mujoco.mj_integratePos(model, data.qpos, v, (k - 3) * step)
            out = out + weight * self.residual()[0] / step**2
        data.qpos[:] = qpos
        self.switch(False)
        mujoco.mj_kinematics(model, data)
        return jacobian, out

    def acceleration(self, y, rates, actuators=False):
        t = self.place(y, rates, actuators)
        mass, free, swing = self.matrix(), self.data.qacc_smooth.copy(), self.swing(t)
        jacobian, turned = self.turned()
        if not len(jacobian):
            return t @ free + swing
        # The metric of the masses: redundant rows leave f open, and a as it is.
        lower = np.linalg.cholesky(mass)
        half = np.linalg.solve(lower, jacobian.T).T
        change = np.linalg.lstsq(half, -turned - jacobian @ free, REDUNDANT)[0]
        return t @ (free + np.linalg.solve(lower.T, change)) + swing
