"""Masses of plain forms by their own numbers are those of their solids."""

import numpy as np
import pytest

from mechwright import Bought, Part, Step, Turned
from mechwright.contracts.mass import body_moments, mass_moments
from mechwright.contracts.shape import Prism, Revolve, Shape, box, hexagon, ring
from mechwright.contracts.turned import Groove, KeySeat
from mechwright.standards.parts import dowel_part

KERNEL = 1e-6
"""Error of the kernel's quadrature of round faces: the two moments across an axis differ by as much."""

SHAPES = {
    "ring": Shape((ring(4, 12, 7, 3.0, 0.5),)),
    "cone": Shape((Revolve(((0.0, 1.0), (6.0, 1.0), (2.0, 9.0), (0.0, 9.0)), (5.0, -2.0)),)),
    "backwards": Shape((Revolve(((0.0, 9.0), (2.0, 9.0), (6.0, 1.0), (0.0, 1.0))),)),
    "box": Shape((box((1, 4), (-2, 3), (0.5, 9)),)),
    "clockwise": Shape((Revolve(((1.0, 0.0), (1.0, 5.0), (3.0, 5.0), (3.0, 0.0))),)),
    "mirrored": Shape((Prism(((0.0, 0.0), (0.0, 3.0), (4.0, 1.0)), 1.0, 5.0),)),
    "hexagon": Shape((hexagon(7, 1, 4),)),
    "two": Shape((ring(0, 12, 7), ring(0, 6, 20))),
    "socket": Shape(
        (Revolve(((0, -5), (4, -5), (4, 0), (2, 0), (2, 16), (0, 16))),), (hexagon(4, -5, -2.5),)
    ),
    "hollowed": Shape((ring(0, 12, 7),), (ring(0, 4, 3, 2.0),)),
    "beside": Shape((ring(0, 12, 7),), (Revolve(((0, 1), (1, 1), (1, 3), (0, 3)), (4.0, 1.0)),)),
    "through": Shape((ring(4, 12, 7),), (hexagon(6, 0, 7),)),
    "cut": Shape((ring(0, 12, 7),), (box((3, 9), (-2, 2), (0, 7)),)),
}


@pytest.mark.parametrize("name", SHAPES)
def test_a_form_has_the_moments_of_its_solid(name):
    shape = SHAPES[name]
    whole = mass_moments(Part("form", None, 0.0, "steel", bought=Bought("form", shape=shape)))
    solid = mass_moments(Part("solid", None, 0.0, "steel", build=shape.solid))
    np.testing.assert_allclose(whole, solid, rtol=0, atol=KERNEL * np.abs(solid).max())


@pytest.mark.parametrize("name", SHAPES)
def test_upside_down_a_form_has_the_moments_of_its_mirror_image(name):
    shape, mirror = SHAPES[name], np.diag([1.0, 1.0, -1.0, 1.0])
    up, down = (
        mass_moments(Part("form", None, 0.0, "steel", bought=Bought("form", shape=one)))
        for one in (shape, shape.turned_over())
    )
    np.testing.assert_allclose(down, mirror @ up @ mirror, rtol=1e-12, atol=1e-15)


def test_a_shaft_with_a_groove_is_plain_and_one_with_a_seat_asks_the_kernel():
    steps = (Step(10.0, 20.0), Step(14.0, 8.0), Step(8.0, 12.0, start=10.0))
    plain = Turned(steps, 3.0, chamfer=0.5, grooves=(Groove(3.0, 1.1, 9.0),))
    seated = Turned(steps, seats=(KeySeat(4.0, 10.0, 3.0, 3.2),))
    for turned in (plain, seated):
        part = Part("shaft", None, 0.0, "steel", turned=turned)
        solid = Part("solid", None, 0.0, "steel", build=turned.shape.solid)
        np.testing.assert_allclose(mass_moments(part), mass_moments(solid), rtol=KERNEL, atol=1e-9)

    def refuse(part):
        raise AssertionError(f"{part.name} needs no solid")

    mass_moments(Part("shaft", None, 0.0, "steel", turned=plain), refuse)
    mass_moments(dowel_part("dowel", 4, 16, ()), refuse)
    for name in ("socket", "hollowed", "beside"):
        mass_moments(Part(name, None, 0.0, "steel", bought=Bought(name, shape=SHAPES[name])), refuse)


def test_bodies_are_their_parts_at_their_heights():
    part = Part("form", None, 0.0, "steel", bought=Bought("form", shape=SHAPES["box"]))
    one, two = body_moments([(part, 0.0)]), body_moments([(part, 0.0), (part, 10.0)])
    assert two[3, 3] == pytest.approx(2 * one[3, 3])
    assert two[2, 3] == pytest.approx(2 * one[2, 3] + 10 * one[3, 3])
