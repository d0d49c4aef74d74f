"""A cam in MuJoCo pushes its follower by contact alone, as the motion says."""

import math
from pathlib import Path

import numpy as np
import pytest
from mujoco_witness import mujoco

from mechwright import host
from mechwright.designs.design import load
from mechwright_cad.exporters.simulation import mjcf

ROOT = Path(__file__).parents[2]
SPEED = math.pi
"""rad/s of the cam."""


def lift(poses, slides):
    """Way, m, or angle, rad, of the follower from its start."""
    if slides:
        return (poses.position[:, 1] - poses.position[0, 1]) / 1000
    angle = np.unwrap(np.arctan2(poses.rotation[:, 1, 0], poses.rotation[:, 0, 0]))
    return angle - angle[0]


@pytest.mark.parametrize(
    ("name", "push", "close"),
    [("cam-slide", -50.0, 1e-4), ("cam-flat", -50.0, 1e-4), ("cam-lever", 1.0, 2e-3)],
)
def test_a_pressed_follower_moves_as_the_motion_says(name, push, close):
    """m, or rad: the softness of contact, and chords of 0.002 mm."""
    design = load(ROOT / "examples" / f"{name}.toml", host())
    motion = design.solve(721)
    text = mjcf.assembly(name, design.parts(), motion).decode()
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    cam, guide = (
        mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, joint) for joint in ("camshaft", "guide")
    )
    turned = np.abs(motion["theta"] - motion["theta"][0])
    wanted = lift(motion.poses["follower"], model.jnt_type[guide] == mujoco.mjtJoint.mjJNT_SLIDE)
    speed = math.copysign(SPEED, motion["theta"][-1] - motion["theta"][0])
    data.qfrc_applied[guide] = push
    worst = 0.0
    while abs(data.qpos[cam]) < math.tau:
        data.qpos[cam], data.qvel[cam] = speed * data.time, speed
        mujoco.mj_step(model, data)
        worst = max(worst, abs(data.qpos[guide] - np.interp(abs(data.qpos[cam]), turned, wanted)))
    assert worst < close < 0.02 * np.ptp(wanted)
