"""Moments of plates against closed forms: boxes, cylinders, recesses, fillets and chamfers."""

import math

import numpy as np

from mechwright.contracts.details import Chamfer
from mechwright.contracts.moments import moments, volume
from mechwright.contracts.part import Bore, Part, Pocket, Profile
from mechwright.geometry import Loop, Outline, circle


def box(low, high):
    """Moments of a box between two corners: products of ∫ x dx, ∫ x² dx, ∫ dx."""
    low, high = np.array(low, dtype=float), np.array(high, dtype=float)
    ones, first, second = high - low, (high**2 - low**2) / 2, (high**3 - low**3) / 3
    found = np.zeros((4, 4))
    for i in range(3):
        others = [k for k in range(3) if k != i]
        found[i, i] = second[i] * ones[others].prod()
        found[i, 3] = found[3, i] = first[i] * ones[others].prod()
        for j in others:
            (rest,) = {0, 1, 2} - {i, j}
            found[i, j] = first[i] * first[j] * ones[rest]
    found[3, 3] = ones.prod()
    return found


def cylinder(x, y, radius, low, high):
    """Moments of an upright cylinder."""
    area = math.pi * radius**2
    found = np.zeros((4, 4))
    length, first, second = high - low, (high**2 - low**2) / 2, (high**3 - low**3) / 3
    own = area * radius**2 / 4
    found[:2, :2] = length * (own * np.eye(2) + area * np.outer((x, y), (x, y)))
    found[:2, 2] = found[2, :2] = first * area * np.array([x, y])
    found[2, 2] = second * area
    found[:3, 3] = found[3, :3] = area * np.array([x * length, y * length, first])
    found[3, 3] = area * length
    return found


def rectangle(x0, y0, x1, y1):
    return Loop.polygon([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


def same(found, wanted, rel):
    np.testing.assert_allclose(found, wanted, rtol=0, atol=rel * np.abs(wanted).max())


def test_a_plate_with_a_bore_is_exact():
    outline = Outline(rectangle(-3, 2, 17, 9), (Loop((circle((4.0, 5.0), 1.5, clockwise=True),)),))
    part = Part("plate", outline, 4.0, "steel")
    wanted = box((-3, 2, 0), (17, 9, 4)) - cylinder(4, 5, 1.5, 0, 4)
    same(moments(part), wanted, 1e-14)
    assert volume(part) == moments(part)[3, 3]


def test_recesses_of_both_sides_are_taken_out():
    outer = rectangle(0, 0, 30, 20)
    machined = (
        Bore("blind", (7.0, 6.0), 6.0, 0, 2.5),
        Pocket("groove", rectangle(-5, 14, 35, 17), (), 0, 3),
        Pocket("under", rectangle(20, 2, 26, 8), (), 4, 2),
        Profile("outside", outer, "outside", 0, 6),
    )
    part = Part("plate", Outline(outer), 6.0, "steel", machined=machined)
    wanted = box((0, 0, 0), (30, 20, 6)) - cylinder(7, 6, 3, 3.5, 6)
    wanted -= box((0, 14, 3), (30, 17, 6)) + box((20, 2, 0), (26, 8, 2))
    same(moments(part), wanted, 1e-6)


def test_a_floor_with_a_fillet():
    """A round recess with a fillet is one of revolution: its sections by fine slices."""
    outer = rectangle(-20, -20, 20, 20)
    pocket = Pocket("round", Loop((circle((3.0, 0.0), 10.0),)), (), 0, 4, floor_radius=2.0)
    part = Part("p", Outline(outer), 6.0, "steel", machined=(pocket, Profile("o", outer, "outside", 0, 6)))
    nodes, weights = np.polynomial.legendre.leggauss(60)
    wanted = box((-20, -20, 0), (20, 20, 6)) - cylinder(3, 0, 10, 4, 6)
    # In terms of the angle the section is smooth: height 2 - 2 cos, radius 8 + 2 sin.
    for angle, weight in zip((nodes + 1) * math.pi / 4, weights * math.pi / 4, strict=True):
        height, radius = 2 + 2 - 2 * math.cos(angle), 8 + 2 * math.sin(angle)
        slice_ = cylinder(3, 0, radius, height - 1e-3, height + 1e-3) / 2e-3
        wanted = wanted - weight * 2 * math.sin(angle) * slice_
    same(moments(part), wanted, 2e-6)


def test_a_chamfered_disc_is_a_cylinder_and_a_cone():
    rim = Loop((circle((0.0, 0.0), 12.0),))
    part = Part("disc", Outline(rim), 5.0, "steel", details=(Chamfer("rim", rim, "outside", 1.0),))
    # A truncated cone from 12 to 11 in the uppermost millimetre.
    nodes, weights = np.polynomial.legendre.leggauss(8)
    wanted = cylinder(0, 0, 12, 0, 4)
    for z, weight in zip(4.5 + nodes / 2, weights / 2, strict=True):
        wanted = wanted + weight * cylinder(0, 0, 16 - z, z - 1e-3, z + 1e-3) / 2e-3
    same(moments(part), wanted, 2e-6)


def test_a_solid_has_none_of_its_own():
    part = Part("solid", None, 0.0, "steel", build=lambda: None)
    assert not moments(part).any()
