"""MuJoCo as a witness: poses by Newton on the closed loops, the drive's torque from its own equations.

Nothing of it is ours but the file: Jacobians, mass matrix, Coriolis forces and poses are MuJoCo's. Torques are
exact, not those of its soft constraints: v and a follow from J v = 0 and J a = -J' v, and M a + bias =
drive + load + Jᵀ λ.
"""

import numpy as np
import pytest

mujoco = pytest.importorskip("mujoco", reason="MuJoCo simulates independently; pip install mujoco")


class Witness:
    """A model from MJCF, its loops closed by Newton's method."""

    def __init__(self, mjcf: bytes) -> None:
        self.model = mujoco.MjModel.from_xml_string(mjcf.decode())
        self.data = mujoco.MjData(self.model)
        self.drive = int(self.model.actuator_trnid[0, 0])
        self.free = [dof for dof in range(self.model.nv) if dof != self.drive]

    def constraints(self):
        """What has to be 0, its Jacobian and that one's rate at the present velocity."""
        model, data = self.model, self.data
        residuals, rows, rates = [], [], []
        for number in range(model.neq):
            one, two = int(model.eq_obj1id[number]), int(model.eq_obj2id[number])
            if model.eq_type[number] == mujoco.mjtEq.mjEQ_JOINT:
                row = np.zeros(model.nv)
                row[one], row[two] = 1.0, -model.eq_data[number, 1]
                residuals.append([data.qpos[one] - model.eq_data[number, 1] * data.qpos[two]])
                rows.append(row[None])
                rates.append(np.zeros((1, model.nv)))
                continue
            residuals.append(data.site_xpos[one] - data.site_xpos[two])
            rows.append(self.of_site(one) - self.of_site(two))
            rates.append(self.rate_of_site(one) - self.rate_of_site(two))
        return np.concatenate(residuals), np.concatenate(rows), np.concatenate(rates)

    def of_site(self, site):
        jacobian = np.zeros((3, self.model.nv))
        mujoco.mj_jacSite(self.model, self.data, jacobian, None, site)
        return jacobian

    def rate_of_site(self, site):
        rate = np.zeros((3, self.model.nv))
        body = int(self.model.site_bodyid[site])
        mujoco.mj_jacDot(self.model, self.data, rate, None, self.data.site_xpos[site], body)
        return rate

    def close(self, value):
        """Put the drive at ``value`` and close all loops from where the mechanism stands."""
        self.data.qpos[self.drive] = value
        self.data.qvel[:] = 0
        for _ in range(30):
            mujoco.mj_forward(self.model, self.data)
            if not self.model.neq:
                return
            residual, jacobian, _ = self.constraints()
            step = np.linalg.lstsq(jacobian[:, self.free], -residual, rcond=1e-10)[0]
            self.data.qpos[self.free] += step
            if np.abs(step).max() < 1e-14:
                break
        mujoco.mj_forward(self.model, self.data)
        assert np.abs(self.constraints()[0]).max() < 1e-13

    def torque(self, speed, load=None):
        """The drive's torque, N m, that keeps it at a constant speed, rad/s, against generalised forces."""
        model, data = self.model, self.data
        rest = np.zeros(model.nv)
        mujoco.mj_forward(model, data)
        _, jacobian, _ = self.constraints()
        rest[self.drive] = speed
        rest[self.free] = np.linalg.lstsq(jacobian[:, self.free], -jacobian @ rest, rcond=1e-10)[0]
        data.qvel[:] = rest
        mujoco.mj_forward(model, data)
        _, jacobian, rate = self.constraints()
        acceleration = np.zeros(model.nv)
        wanted = -rate @ data.qvel
        acceleration[self.free] = np.linalg.lstsq(jacobian[:, self.free], wanted, rcond=1e-10)[0]
        needed = np.zeros(model.nv)
        mujoco.mj_mulM(model, data, needed, acceleration)
        needed += data.qfrc_bias - (0 if load is None else load)
        # In rows of the free joints nothing but the loops' forces acts.
        forces = np.linalg.lstsq(jacobian[:, self.free].T, needed[self.free], rcond=1e-10)[0]
        assert np.abs(jacobian[:, self.free].T @ forces - needed[self.free]).max() < 1e-9
        return float(needed[self.drive] - jacobian[:, self.drive] @ forces)

    def dof(self, joint):
        return mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_JOINT, joint)

    def body(self, name):
        return mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_BODY, name)


def follow(witness, motion):
    """Follow the input of a motion: greatest difference of the rotations, rad, and of the places, mm."""
    drive = motion.channels[motion.input_name].values
    turned, moved = 0.0, 0.0
    for sample, value in enumerate(drive - drive[0]):
        witness.close(value)
        for name, poses in motion.poses.items():
            body = witness.body(name)
            turn = witness.data.xmat[body].reshape(3, 3) - poses.rotation[sample]
            turned = max(turned, float(np.abs(turn).max()))
            place = 1000 * witness.data.xpos[body] - poses.position[sample]
            moved = max(moved, float(np.abs(place).max()))
    return turned, moved


def torques(witness, motion, speed, load=None):
    """Torques of the drive over a motion, N m."""
    drive = motion.channels[motion.input_name].values
    found = []
    for value in drive - drive[0]:
        witness.close(value)
        found.append(witness.torque(speed, load))
    return np.array(found)
