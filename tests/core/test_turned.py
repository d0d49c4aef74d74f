"""Turned parts: one description, its solid against closed forms, and what it refuses."""

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.contracts.bought import Bought
from mechwright.contracts.fits import shaft_fit
from mechwright.contracts.part import Part
from mechwright.contracts.shape import Shape, ring
from mechwright.contracts.turned import Groove, KeySeat, Length, Step, Turned, tube
from mechwright.errors import GeometryError
from mechwright.geometry.keyway import Opening
from mechwright.standards.parts import dowel_part, key_part


def volume(turned):
    """By the sections of the steps: cylinders and cones, less grooves and the corners of chamfers."""
    sections = [
        math.pi / 12 * s.length * (s.foot**2 + s.foot * s.diameter + s.diameter**2) for s in turned.steps
    ]
    grooves = [
        math.pi / 4 * g.width * (step_at(turned, g.at).diameter ** 2 - g.diameter**2) for g in turned.grooves
    ]
    c = turned.chamfer
    corners = [math.pi * c * c * (end.diameter / 2 - c / 3) for end in (turned.steps[0], turned.steps[-1])]
    return sum(sections) - math.pi / 4 * turned.bore**2 * turned.length - sum(grooves) - sum(corners)


def step_at(turned, z):
    return next(s for low, s in zip(turned.starts, turned.steps, strict=True) if low <= z < low + s.length)


SHAFT = Turned(
    (Step(10, 9, shaft_fit(10, "k6")), Step(14, 4), Step(12, 20, shaft_fit(12, "h6")), Step(8, 12)),
    chamfer=0.5,
    grooves=(Groove(6.0, 1.1, 9.6, 0.11), Groove(40.0, 0.9, 7.6)),
)


def test_a_groove_may_end_where_its_step_does():
    assert replace(SHAFT, grooves=(Groove(7.9, 1.1, 9.0),)).grooves[0].at == 7.9
    with pytest.raises(GeometryError, match="lies in no one step"):
        replace(SHAFT, grooves=(Groove(7.91, 1.1, 9.0),))


@pytest.mark.parametrize("turned", [SHAFT, tube(8, 12, 6), replace(SHAFT, bore=4.0)])
def test_the_solid_is_what_the_steps_say(turned):
    solid = turned.shape.solid()
    assert solid.isValid()
    assert solid.Volume() == pytest.approx(volume(turned), rel=1e-9)
    box = solid.BoundingBox()
    assert (box.zmin, box.zmax, 2 * box.xmax) == pytest.approx((0, turned.length, turned.greatest), abs=1e-6)


@given(
    steps=st.lists(st.tuples(st.floats(4, 30), st.floats(0.5, 40), st.booleans()), min_size=1, max_size=5),
    bore=st.sampled_from([0.0, 2.0]),
)
@settings(max_examples=15, deadline=None)
def test_any_steps_make_one_solid(steps, bore):
    made = Turned(tuple(Step(d, h, start=3.0 if cone else None) for d, h, cone in steps), bore)
    assert made.shape.solid().Volume() == pytest.approx(volume(made), rel=1e-9)


def test_a_cone_may_end_in_a_point():
    made = Turned((Step(6.0, 6.0, start=0.0), Step(6.0, 10.0)))
    assert made.shape.solid().Volume() == pytest.approx(math.pi * 9 * (6 / 3 + 10), rel=1e-9)


def test_a_key_seat_takes_a_slot_with_a_flat_floor():
    plain = Turned((Step(12.0, 30.0),))
    r, half, floor = 6.0, 2.0, 3.5
    y, weights = np.polynomial.legendre.leggauss(400)
    deep, end = np.sqrt(r * r - (half * y) ** 2) - floor, np.sqrt(half * half - (half * y) ** 2)
    for at, round_ends in ((10.0, 1), (5.0, 2)):
        cut = replace(plain, seats=(KeySeat(at, 20.0, 4.0, floor),))
        straight = 20 - round_ends * half
        taken = half * (weights * deep * (straight + round_ends * end)).sum()
        assert plain.shape.solid().Volume() - cut.shape.solid().Volume() == pytest.approx(taken, rel=1e-5)


def test_a_length_with_limits_goes_from_edge_to_edge():
    groove = Groove(40.0, 0.9, 7.6)
    wall = Length("shoulder to far wall of the groove", 33.0, 40.9, 0.0, 0.1)
    made = replace(SHAFT, grooves=(groove,), lengths=(wall,))
    assert made.length_of(wall.name).nominal == 7.9
    moved = made.lengthened(3.0).lengths[0]
    assert (moved.low, moved.high, moved.nominal) == (36.0, 43.9, 7.9)
    with pytest.raises(GeometryError, match="no length 'hub'; it has: shoulder"):
        made.length_of("hub")
    with pytest.raises(
        GeometryError, match=r"ends at 40\.5 mm, where the part has no edge; edges: 0, 9, 13, 33"
    ):
        replace(made, lengths=(replace(wall, high=40.5),))
    with pytest.raises(GeometryError, match="the lower one comes first"):
        replace(made, lengths=(replace(wall, lower=0.2),))


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Turned(()), "has steps"),
        (lambda: Turned((Step(0.0, 4.0),)), "has steps"),
        (lambda: tube(8, 8, 4), "a bore of 8 mm leaves nothing of a step of 8 mm"),
        (
            lambda: Turned((Step(8, 4),), chamfer=2.0),
            "a chamfer of 2 mm does not fit on both ends; one below 2",
        ),
        (lambda: Turned((Step(8, 4),), chamfer=-0.1), "a chamfer of -0.1 mm"),
        (lambda: replace(SHAFT, grooves=(Groove(8.5, 1.1, 9.0),)), "from 8.5 to 9.6 mm lies in no one step"),
        (lambda: replace(SHAFT, grooves=(Groove(1.0, 1.1, 10.0),)), "a groove of 10 mm diameter"),
        (lambda: replace(SHAFT, seats=(KeySeat(40, 6, 3, 3.0),)), "from 40 to 46 mm; the part is 45 mm long"),
        (lambda: replace(SHAFT, seats=(KeySeat(20, 6, 3, 7.0),)), "cuts nothing"),
    ],
)
def test_what_cannot_be_turned_is_refused(make, words):
    with pytest.raises(GeometryError, match=words):
        make()


def test_a_part_says_what_it_is():
    turned = Part("shaft", None, 0.0, "steel", turned=SHAFT)
    bought = Part("ball", None, 0.0, "steel", bought=Bought("ball 6 mm", shape=Shape((ring(0, 6, 1),))))
    solid = Part("block", None, 0.0, "steel", build=SHAFT.shape.solid)
    assert [part.kind for part in (turned, bought, solid)] == ["turned", "bought", "solid"]
    assert turned.build().Volume() == pytest.approx(volume(SHAFT))
    assert replace(turned, name="shaft-2").build().Volume() == pytest.approx(volume(SHAFT))
    assert pickle.loads(pickle.dumps(turned)).turned == SHAFT  # noqa: S301 - our own
    with pytest.raises(GeometryError, match="either an outline or a solid"):
        Part("ghost", None, 0.0, "steel", bought=Bought("a thing without shape"))
    with pytest.raises(GeometryError, match="turned, bought or of free form, one of them alone"):
        Part("both", None, 0.0, "steel", turned=SHAFT, bought=Bought("thing"))


def test_a_catalogues_mass_counts_before_the_envelopes():
    from mechwright.standards.bearings import bearing
    from mechwright_cad.solids.inertia import mass_moments

    whole = Part("bearing", None, 0.0, "steel", bought=bearing("608").bought)
    assert mass_moments(whole)[3, 3] == pytest.approx(0.012)
    envelope = Part("ring", None, 0.0, "steel", build=whole.build)
    ratio = mass_moments(whole) / mass_moments(envelope)[3, 3]
    assert ratio[3, 3] == pytest.approx(12 / (2300.6 * 7.85e-3), rel=1e-4)


def test_what_no_standard_has_is_made():
    steel = (0.5, 0.5, 0.5)
    assert dowel_part("dowel", 4, 16, (), steel).bought.designation == "ISO 8734 - 4 x 16"
    assert dowel_part("dowel", 4, 8, (), steel).bought.designation == "ISO 2338 - 4 m6 x 8 - St"
    odd = dowel_part("dowel", 4, 16.5, (), steel)
    assert odd.kind == "turned"
    assert odd.turned.steps[0].fit.text == "4 m6 (+0.004/+0.012)"
    standard, plain = Opening(12, 4, 1.8), Opening(12, 3.5, 2.0)
    # The seats of these keys are open at the end of their shaft.
    assert key_part("key", standard, 10, (), steel).bought.designation == "DIN 6885 - B 4 x 4 x 10"
    cut = key_part("key", plain, 10, (), steel)
    assert cut.kind == "solid"
    assert cut.build().Volume() == pytest.approx(3.5 * (plain.key_top - 4.0) * 10)
    assert key_part("key", standard, 10.5, (), steel).kind == "solid"
