"""Joints of a motion: what may be said, and that the test kit holds them against the poses."""

import math
from dataclasses import replace

import numpy as np
import pytest

from mechwright.contracts.joint import GROUND, Joint, fixed
from mechwright.contracts.motion import Channel, Motion, Poses
from mechwright.errors import KinematicsError
from mechwright.testing.joints import joint_faults

ANGLE = np.linspace(0, math.tau, 73)
STILL = np.zeros_like(ANGLE)


def slider_crank(**changes):
    """A crank of 10, a rod of 30, a slider on x; joints by name may be changed, None leaves one out."""
    turn = np.arcsin(-10 * np.sin(ANGLE) / 30)
    poses = {
        "crank": Poses.planar(0.0, 0.0, ANGLE),
        "disc": Poses.planar(10 * np.cos(ANGLE), 10 * np.sin(ANGLE), ANGLE + 1),
        "rod": Poses.planar(10 * np.cos(ANGLE), 10 * np.sin(ANGLE), turn),
        "slider": Poses.planar(10 * np.cos(ANGLE) + 30 * np.cos(turn), 0.0, STILL),
        "wheel": Poses.planar(50.0, 0.0, -2 * ANGLE),
    }
    joints = {
        "shaft": Joint("revolute", GROUND, "crank", drives=True),
        **fixed("crank", "disc"),
        "a": Joint("revolute", "crank", "rod", (10.0, 0.0, 0.0)),
        "b": Joint("revolute", "rod", "slider", (30.0, 0.0, 0.0)),
        "guide": Joint("prismatic", GROUND, "slider", axis=(1.0, 0.0, 0.0)),
        "axle": Joint("revolute", GROUND, "wheel", (50.0, 0.0, 0.0)),
        "mesh": Joint("gear", "crank", "wheel", ratio=-2.0),
    } | changes
    named = {name: joint for name, joint in joints.items() if joint is not None}
    return Motion("phi", {"phi": Channel(ANGLE, "rad")}, poses, joints=named)


def test_right_joints_have_no_fault():
    assert joint_faults(slider_crank()) == []


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (
            {"a": Joint("revolute", "crank", "rod", (10.01, 0.0, 0.0))},
            "joint a: its point comes apart by 0.0",
        ),
        ({"a": Joint("revolute", "crank", "rod", (10.0, 0.0, 0.0), (0.6, 0.0, 0.8))}, "its axis tilts"),
        ({"disc": Joint("fixed", "rod", "disc")}, "joint disc: turns by"),
        ({"guide": Joint("prismatic", GROUND, "slider", axis=(0.8, 0.6, 0.0))}, "leaves its axis"),
        ({"guide": Joint("prismatic", GROUND, "rod", axis=(1.0, 0.0, 0.0))}, "joint guide: turns by"),
        ({"mesh": Joint("gear", "crank", "wheel", ratio=2.0)}, "joint mesh: the gear slips by"),
        (
            {"mesh": Joint("gear", "disc", "wheel", ratio=-2.0)},
            "no revolute or prismatic joint has disc as its body two",
        ),
        ({"axle": None, "mesh": None}, "body wheel is held by no joint"),
        (
            {"shaft": Joint("revolute", GROUND, "crank", axis=(0.0, 0.0, -1.0), drives=True)},
            "away from the input",
        ),
        ({"mesh": Joint("gear", "crank", "wheel", ratio=-2.0, drives=True)}, "no input drives a gear joint"),
    ],
)
def test_wrong_joints_are_named(changes, words):
    faults = joint_faults(slider_crank(**changes))
    assert any(words in fault for fault in faults), faults


@pytest.mark.parametrize(("share", "found"), [(0.0, False), (0.7, False), (1.3, True)])
def test_a_driven_joint_may_differ_from_its_input_by_rounding_of_the_largest_angle(share, found):
    """By 10^-8 of one more than the angle, which is a whole turn here."""
    motion, limit = slider_crank(), 1e-8 * (2 * math.pi + 1)
    off = Channel(ANGLE + share * limit * (1 - np.cos(ANGLE)) / 2, "rad")
    faults = joint_faults(replace(motion, channels={"phi": off}))
    assert [fault.startswith("joint shaft:") for fault in faults] == [True] * found


def test_a_gear_of_changing_ratio_and_an_input_of_time_are_let_be():
    motion = slider_crank(mesh=Joint("gear", "crank", "wheel"))
    assert joint_faults(motion) == []
    timed = Motion("t", {"t": Channel(3 * ANGLE, "s")}, motion.poses, joints=motion.joints)
    assert joint_faults(timed) == []


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("revolute", "a", "a"), "cannot hold itself"),
        (("revolute", "a", "b", (math.nan, 0.0, 0.0)), "are finite"),
        (("revolute", "a", "b", (0.0, 0.0, 0.0), (0.0, 0.0, 2.0)), "no unit vector"),
        (("gear", "a", "b", (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), math.inf), "are finite"),
        (("contact", "a", "b", (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), None, -1.0), "the limit is 0"),
    ],
)
def test_joints_that_cannot_be(arguments, words):
    with pytest.raises(KinematicsError, match=words):
        Joint(*arguments)


@pytest.mark.parametrize(("one", "two"), [("crank", "nothing"), ("nothing", "crank"), ("crank", GROUND)])
def test_a_joint_holds_bodies_of_the_motion(one, two):
    with pytest.raises(KinematicsError, match="has no poses; those that have: crank"):
        Motion(
            "phi",
            {"phi": Channel(ANGLE, "rad")},
            {"crank": Poses.planar(0.0, 0.0, ANGLE)},
            joints={"j": Joint("revolute", one, two)},
        )
