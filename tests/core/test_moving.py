"""The small moving pictures on the page of a study."""

import math

import numpy as np
import pytest

import mechwright as mw
from mechwright.scripting import moving as module
from mechwright.scripting.moving import FRAMES, moving


def test_the_crank_of_a_picture_turns_evenly_and_the_ground_rests():
    found = moving(mw.design("four-bar", crank=30, coupler=80, follower=70, ground=90))
    assert found is not None
    left, bottom, width, height = found["window"]
    angles = []
    for shape in found["shapes"]:
        numbers = [
            float(x) for x in shape["path"].replace("M", " ").replace("L", " ").replace("Z", " ").split()
        ]
        corners = np.reshape(numbers, (-1, 2))
        for a, b, c, d, e, f in shape["at"]:
            placed = corners @ np.array([[a, b], [c, d]]) + (e, f)
            assert (placed > (left, bottom)).all(), "it is cut off"
            assert (placed < (left + width, bottom + height)).all(), "it is cut off"
        angles.append(np.unwrap([math.atan2(b, a) for a, b, *_ in shape["at"]]))
    assert any(len(one) == 1 for one in angles), "no ground"
    even = math.tau * np.arange(FRAMES) / FRAMES
    assert any(len(one) == FRAMES and np.abs(one - one[0] - even).max() < 1e-3 for one in angles)


@pytest.mark.parametrize("family", ["spherical"])
def test_in_space_links_are_lines(family):
    found = moving(mw.design(family))
    assert found is not None
    assert all("path" not in shape and len(shape["at"]) == FRAMES for shape in found["shapes"])
    assert any(np.ptp(shape["at"], axis=0).max() > 1 for shape in found["shapes"]), "nothing moves"


def test_points_that_are_asked_for_are_dots_where_they_are():
    asked = np.array([[10.0, 20.0, 0.0], [-31.25, 4.5, 0.0], [0.0, 0.0, 0.0]])
    found = moving(mw.design("four-bar", crank=30, coupler=80, follower=70, ground=90), asked)
    assert found is not None
    assert found["asked"] == "M10 20h0M-31.25 4.5h0M0 0h0"


def test_what_does_not_move_has_none():
    assert moving(mw.design("four-bar", crank=300, coupler=10, follower=10, ground=20)) is None


def test_a_link_of_two_joints_is_a_line_and_one_of_a_joint_is_none():
    angle = np.linspace(0, math.tau, 2 * FRAMES)
    poses = {name: mw.Poses.planar(0.0, 0.0, angle) for name in ("crank", "rod", "wheel")}
    joints = {
        "shaft": mw.Joint("revolute", mw.GROUND, "crank", drives=True),
        "pin": mw.Joint("revolute", "crank", "rod", (10.0, 0.0, 0.0)),
        "axle": mw.Joint("revolute", "rod", "wheel", (10.0, 5.0, 0.0)),
        "mesh": mw.Joint("gear", "crank", "wheel", ratio=1.0),
    }
    motion = mw.Motion("phi", {"phi": mw.Channel(angle, "rad")}, poses, joints=joints)
    crank, rod = module._lines(motion, np.eye(3)[:2])
    assert crank.shape == rod.shape == (FRAMES, 2, 2)
    turned = 10 * np.exp(1j * angle[:FRAMES])
    for line in (crank[:, 1], rod[:, 0]):
        np.testing.assert_allclose(line[:, 0] + 1j * line[:, 1], turned)
    assert not crank[:, 0].any()
