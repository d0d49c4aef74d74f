"""A rack in MJCF: MuJoCo moves it by its pinion, and feels the inertia of both."""

from dataclasses import replace

import pytest
from mujoco_witness import Witness, mujoco

from mechwright import KinematicsError
from mechwright_cad.exporters.simulation import mjcf
from mechwright_spur_gears.family import SpurGears

RACKS = SpurGears()
PARAMS = RACKS.Params(arrangement="rack", teeth=20, thickness=8)


def test_a_torque_on_the_pinion_moves_the_rack_by_its_radius():
    """φ'' = T/(J + M r²), and the rack goes r φ; MuJoCo's coupling is a spring of some micrometres."""
    motion, parts = RACKS.solve(PARAMS, 25), RACKS.parts(PARAMS)
    witness = Witness(mjcf.assembly("rack", parts, motion, 0))
    model, data = witness.model, witness.data
    pinion, guide = witness.drive, witness.dof("guide")
    torque, radius, worst = 0.02, 0.020, 0.0
    data.ctrl[0] = torque
    for _ in range(1000):
        mujoco.mj_step(model, data)
        worst = max(worst, abs(float(data.qpos[guide] - radius * data.qpos[pinion])))
    own = model.body_inertia[witness.body("gear-1")].max()
    inertia = own + model.body_mass[witness.body("rack")] * radius**2
    assert data.qvel[pinion] == pytest.approx(torque / inertia * data.time, rel=1e-6)
    assert worst < 2e-6


def test_a_rack_that_is_body_one_is_refused_by_name():
    motion, parts = RACKS.solve(PARAMS, 25), RACKS.parts(PARAMS)
    mesh = replace(motion.joints["mesh"], one="rack", two="gear-1", ratio=0.05)
    wrong = replace(motion, joints={**motion.joints, "mesh": mesh})
    with pytest.raises(KinematicsError, match="has the rack rack as its body one; name the pinion so"):
        mjcf.assembly("rack", parts, wrong, 0)
