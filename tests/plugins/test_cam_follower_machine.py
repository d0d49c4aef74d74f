"""What a cam asks of its drive, and the frame around it."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from mechwright.contracts.load import Load
from mechwright.contracts.mounting import MountingError
from mechwright.errors import KinematicsError
from mechwright.machine.drive import SAMPLES, drive_of
from mechwright.machine.settings import MachineSettings
from mechwright_cam_follower.family import CamFollower
from mechwright_cam_follower.kinematics.extremes import load_peak
from mechwright_cam_follower.kinematics.mechanism import mechanism_of
from mechwright_cam_follower.kinematics.motion import motion_of
from mechwright_cam_follower.parameters import CamParams
from mechwright_cam_follower.parts.parts import parts_of

FAMILY = CamFollower()
TABLES = [
    {"laws": ["4-5-6-7"], "speed": 400, "spring_preload": 200, "load": 5},
    {"laws": ["4-5-6-7"], "follower": "oscillating", "turning": "cw", "speed": 300, "load_torque": 1},
    {"laws": ["4-5-6-7"], "conjugate": True, "speed": 700, "mass": 2},
]


@pytest.mark.parametrize("table", TABLES)
def test_drive_by_virtual_power_is_the_torque_of_the_camshaft(table):
    """Two ways: poses, masses and loads of the motion; and F s' of the contact."""
    params = CamParams.model_validate(table)
    motion = motion_of(params, SAMPLES)
    drive = drive_of(motion, parts_of(params), MachineSettings(direction="forwards"))
    torque = motion["torque"]
    assert_allclose(params.sense * drive.runs[0].torque, torque, rtol=0, atol=2e-3 * np.abs(torque).max())


def test_a_share_has_a_number_for_each_sample():
    params = CamParams()
    motion = motion_of(params, 9)
    with pytest.raises(KinematicsError, match="shape"):
        type(motion)(
            motion.input_name, motion.channels, motion.poses, loads={"x": Load("follower", share=np.ones(8))}
        )
    with pytest.raises(KinematicsError, match="finite"):
        Load("follower", share=np.array([np.nan]))
    with pytest.raises(KinematicsError, match="limit"):
        Load("follower", mass=-1.0)


def test_shafts_of_a_lever_carry_the_contact():
    params = CamParams(follower="oscillating", spring_torque=4.0)
    cam, lever = FAMILY.mounting(params).spindles
    m = mechanism_of(params)
    torque = load_peak(m, "torque_max").value
    assert cam.force * torque == pytest.approx(load_peak(m, "contact_force_max").value)
    assert lever.torque * torque == pytest.approx(load_peak(m, "contact_force_max").value * 75 / 1000)


@pytest.mark.parametrize(
    ("table", "word"),
    [
        ({}, "guide"),
        ({"follower": "oscillating"}, "spring"),
        ({"conjugate": True, "follower": "oscillating"}, "pair"),
        ({"follower": "oscillating", "bore": 0}, "bore"),
    ],
)
def test_what_has_no_frame_is_refused_by_name(table, word):
    with pytest.raises(MountingError, match=word):
        FAMILY.mounting(CamParams.model_validate(table))
