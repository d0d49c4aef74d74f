import copy
import math

import numpy as np
import pytest

from mechwright.contracts import motion
from mechwright.contracts.motion import Channel, Motion, Poses, Trace
from mechwright.errors import KinematicsError
from mechwright.testing import assert_points_close, assert_rotations

ANGLE = np.linspace(0, math.tau, 9)


def channel(n=9):
    return Channel(np.zeros(n), "rad")


def test_planar_poses_turn_about_z_and_shift():
    poses = Poses.planar(10.0, np.arange(9.0), ANGLE, z=3.0)
    assert_rotations(poses.rotation)
    seen = poses.transform(np.array([[2.0, 0.0, 0.0], [0.0, 0.0, 1.0]]))
    assert seen.shape == (9, 2, 3)
    wanted = np.column_stack((10 + 2 * np.cos(ANGLE), np.arange(9) + 2 * np.sin(ANGLE), np.full(9, 3.0)))
    assert_points_close(seen[:, 0], wanted, 1e-14)
    assert_points_close(seen[:, 1], np.column_stack((np.full(9, 10.0), np.arange(9), np.full(9, 4.0))), 1e-14)


def test_poses_of_many_samples_are_the_same_and_are_not_kept(monkeypatch):
    angle = np.linspace(0, math.tau, 50)
    x, y = np.cos(angle), 2.0
    few = Poses.planar(x, y, angle, 3.0)
    monkeypatch.setattr(motion, "_KEPT", 10)
    many = Poses.planar(x, y, angle, 3.0)
    for one in (many, copy.deepcopy(many)):
        np.testing.assert_array_equal(one.position, few.position)
        np.testing.assert_array_equal(one.rotation, few.rotation)
        np.testing.assert_array_equal(one.frames, few.frames)
        assert one.shapes == few.shapes
        assert one.rates is None
    assert many.rotation is not many.rotation
    with pytest.raises(KinematicsError, match="positions of body b"):
        Motion("t", {"t": Channel(angle[:20], "rad")}, {"b": many})


def test_samples_are_those_of_the_input():
    assert Motion("theta", {"theta": channel()}, {"crank": Poses.planar(0, 0, ANGLE)}).samples == 9


def test_the_path_of_a_trace_is_that_of_its_point():
    poses = Poses.planar(10.0, np.arange(9), ANGLE)
    motion = Motion(
        "theta", {"theta": channel()}, {"crank": poses}, traces={"P": Trace("crank", (2.0, 0.0, 3.0))}
    )
    wanted = np.column_stack((10 + 2 * np.cos(ANGLE), np.arange(9) + 2 * np.sin(ANGLE), np.full(9, 3.0)))
    assert_points_close(motion.path("P"), wanted, 1e-14)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Motion("phi", {"theta": channel()}), "input 'phi' of the motion is none of its channels"),
        (lambda: Motion("theta", {"theta": channel(), "x": channel(8)}), r"channel x: shape \(8,\)"),
        (
            lambda: Motion("theta", {"theta": channel()}, {"crank": Poses.planar(0, 0, ANGLE[1:])}),
            "positions of body crank",
        ),
        (
            lambda: Motion("theta", {"theta": channel()}, {"crank": Poses(np.zeros((9, 3)), np.eye(3))}),
            "rotations of body crank",
        ),
        (
            lambda: Motion("theta", {"theta": channel()}, traces={"P": Trace("rod", (0, 0, 0))}),
            "trace 'P' is a point of body 'rod'",
        ),
    ],
)
def test_a_motion_of_uneven_length_is_refused(make, words):
    with pytest.raises(KinematicsError, match=words):
        make()
