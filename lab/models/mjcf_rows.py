"""Equalities of an MJCF taken as exact, on MuJoCo's own rows: M a + bias = effort + J^T f, J a = -J' v."""

import mujoco
import numpy as np

from mjcf_model import Mjcf

# Second derivative by seven points, error of sixth order; step in seconds along a motion of constant rate.
STENCIL, STEP = np.array([2, -27, 270, -490, 270, -27, 2]) / 180, 1e-2

# Singular values below this ratio of the largest are of redundant rows.
REDUNDANT = 1e-9

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

    def closed(self, y, rates):
        """The state on the rows near this one, and what is left of the gap."""
        model, data = self.model, self.data
        self.place(y, rates)
        self.switch(True)
        for _ in range(STEPS):
            gap, jacobian = self.residual()
            if len(gap) == 0 or np.max(np.abs(gap)) < 1e-14:
                break
            mujoco.mj_integratePos(model, data.qpos, -np.linalg.lstsq(jacobian, gap, REDUNDANT)[0], 1.0)
        gap, jacobian = self.residual()
        if len(gap):
            data.qvel[:] -= np.linalg.lstsq(jacobian, jacobian @ data.qvel, REDUNDANT)[0]
        state = self.state_of(data.qpos.copy(), data.qvel.copy())
        self.switch(False)
        return *state, float(np.max(np.abs(gap), initial=0))

    def turned(self):
        """J and J' v at the state that is placed."""
        model, data = self.model, self.data
        v, qpos, out = data.qvel.copy(), data.qpos.copy(), 0
        self.switch(True)
        _, jacobian = self.residual()
        for k, weight in enumerate(STENCIL):
            data.qpos[:] = qpos
            mujoco.mj_integratePos(model, data.qpos, v, (k - 3) * STEP)
            out = out + weight * self.residual()[0] / STEP**2
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
