"""Boxes of bodies that never meet: what they part is apart, and what touches is not."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright import Instance, Part
from mechwright.contracts.motion import Poses
from mechwright.contracts.turned import Step, Turned
from mechwright.geometry import Loop, Outline
from mechwright_cad.bodies import Body
from mechwright_cad.interference.apart import apart, box_of
from mechwright_cad.interference.path import relative

SQUARE = Outline(Loop.polygon(((-5.0, -5.0), (5.0, -5.0), (5.0, 5.0), (-5.0, 5.0))))


def turn(angle, about):
    c, s = np.cos(angle), np.sin(angle)
    return np.array(
        ((c, -s, 0), (s, c, 0), (0, 0, 1)) if about == "z" else ((1, 0, 0), (0, c, -s), (0, s, c))
    )


def body(name, position, rotation, z=0.0):
    part = Part(name, SQUARE, 4.0, "steel")
    return Body(
        part, Instance(name, z), Poses(np.asarray(position, float), np.asarray(rotation, float)), name
    )


@settings(max_examples=60)
@given(
    x=st.floats(-20, 20),
    y=st.floats(-20, 20),
    z=st.floats(-12, 12),
    angle=st.floats(-3, 3),
    swing=st.floats(0, 2),
)
def test_bodies_with_a_common_point_are_never_apart(x, y, z, angle, swing):
    times = np.linspace(0.0, 1.0, 9)
    still = body("one", np.zeros((9, 3)), np.tile(np.eye(3), (9, 1, 1)))
    place = np.stack([x * np.cos(swing * times), y + 0 * times, z + 3 * times], axis=1)
    moving = body("two", place, [turn(angle + swing * t, "x") for t in times], 1.0)
    rotation, position = relative(still.poses, moving.poses)
    corners = np.random.default_rng(1).uniform((-5, -5, 1), (5, 5, 5), (400, 3))
    seen = np.einsum("nij,kj->nki", rotation, corners) + position[:, None]
    inside = (np.abs(seen[..., :2]) <= 5).all(axis=2) & (seen[..., 2] >= 0) & (seen[..., 2] <= 4)
    assert not (inside.any() and apart(still, moving, rotation, position))


def test_what_passes_far_away_is_apart_and_what_jumps_through_between_two_samples_is_not():
    still = body("one", np.zeros((2, 3)), np.tile(np.eye(3), (2, 1, 1)))
    far = body("two", [(30.0, 0, 0), (31.0, 0, 0)], np.tile(np.eye(3), (2, 1, 1)))
    assert apart(still, far, *relative(still.poses, far.poses))
    through = body("two", [(30.0, 0, 0), (-30.0, 0, 0)], np.tile(np.eye(3), (2, 1, 1)))
    assert not apart(still, through, *relative(still.poses, through.poses))


def test_the_box_of_a_solid_holds_it():
    pin = Part("pin", None, 0.0, "steel", turned=Turned((Step(6.0, 20.0), Step(10.0, 3.0))))
    low, high = box_of(pin, Instance("pin", 7.0))
    assert low == pytest.approx((-5, -5, 7), abs=1e-3)
    assert high == pytest.approx((5, 5, 30), abs=1e-3)
