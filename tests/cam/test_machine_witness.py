"""The drive against MuJoCo, whose masses, Jacobians and Coriolis forces are its own: weights too."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from by_night import by_night
from mujoco_witness import Witness, torques

from mechwright import Channel, Poses, host
from mechwright.designs.design import load
from mechwright.machine import MachineSettings, drive_of
from mechwright.machine.drive import GRAVITY, SAMPLES
from mechwright_cad.exporters.simulation import mjcf

ROOT = Path(__file__).parents[2]
EVERY = 60
"""Samples of the drive between two that MuJoCo is asked."""
UP = {"-x": (GRAVITY, 0, 0), "y": (0, -GRAVITY, 0), "z": (0, 0, -GRAVITY)}


def few(motion):
    """Some samples of a motion, for a witness that takes its time."""
    return replace(
        motion,
        channels={key: Channel(one.values[::EVERY], one.unit) for key, one in motion.channels.items()},
        poses={key: Poses(one.position[::EVERY], one.rotation[::EVERY]) for key, one in motion.poses.items()},
    )


@pytest.mark.parametrize(
    ("name", "up", "speed"),
    [
        ("spherical-crank-rocker", "z", 60.0),
        pytest.param("crank-rocker-three-poles", "y", 200.0, marks=by_night),
        ("slider-crank-quick-return", "-x", None),
    ],
)
def test_the_drive_needs_the_torque_that_mujoco_needs(name, up, speed):
    design = load(ROOT / "examples" / f"{name}.toml", host())
    motion, parts = design.family.solve(design.params, SAMPLES), design.parts()
    drive = drive_of(motion, parts, MachineSettings(up=up, speed=speed))
    some = few(motion)
    witness = Witness(mjcf.assembly(name, parts, some))
    witness.model.opt.gravity[:] = UP[up]
    found = torques(witness, some, drive.course.speed[0])
    wanted = (drive.inertia + drive.weight)[::EVERY]
    assert np.abs(drive.weight).max() > 0.05 * np.abs(wanted).max()
    np.testing.assert_allclose(found, wanted, rtol=0, atol=1e-6 * np.abs(wanted).max())
