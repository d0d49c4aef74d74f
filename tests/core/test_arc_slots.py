"""Arc slots of plates: walls, distances, and when a joint gets one."""

import cmath
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mechwright.contracts.part import Instance
from mechwright.geometry import Outline
from mechwright.mechanics.linkage import disc, hull_link
from mechwright.mechanics.linkage.clamp import FACE, clamps, screw_parts, stud_part
from mechwright.mechanics.linkage.scale import scale
from mechwright.mechanics.linkage.slots import ArcSlot, gaps, point_gaps, setting

SLOTS = st.builds(
    ArcSlot,
    st.complex_numbers(max_magnitude=50),
    st.floats(10, 100),
    st.floats(-3, 3),
    st.floats(0.05, 5.5),
    st.floats(2, 6),
)


@given(slot=SLOTS, x=st.floats(-150, 150), y=st.floats(-150, 150))
def test_the_distance_is_that_of_the_nearest_point(slot, x, y):
    place = complex(x, y)
    along = np.linspace(0, slot.sweep, 20_001)
    points = slot.centre + slot.radius * np.exp(1j * (slot.start + along))
    nearest = float(np.abs(points - place).min())
    assert slot.distance(place) == pytest.approx(nearest, abs=slot.radius * slot.sweep / 2e4)


@given(slot=SLOTS)
def test_the_wall_is_half_a_width_off_the_centre_line_and_closes(slot):
    loop = slot.loop()
    points = np.asarray(loop.flatten(0.01))
    off = [slot.distance(complex(*point)) for point in points[:: max(1, len(points) // 50)]]
    assert off == pytest.approx([slot.width / 2] * len(off), abs=0.02)
    turned = math.tau - slot.sweep > 0.0
    assert turned
    assert loop.area == pytest.approx(-(slot.radius * slot.sweep * slot.width + math.pi * slot.width**2 / 4))


@given(slot=SLOTS, land=st.floats(4, 12))
def test_the_hull_leaves_its_land_all_along(slot, land):
    hull = hull_link(slot.bosses(land)).outer
    outline = np.asarray(hull.flatten(0.01))
    for along in np.linspace(0, slot.sweep, 25):
        at = slot.at(float(along))
        assert np.abs(outline @ [1, 1j] - at).min() >= land - 0.05


def test_a_plate_with_a_slot_is_an_outline():
    slot = ArcSlot(0j, 40.0, 0.2, 1.0, 5.0)
    plate = Outline(disc(60.0, ()).outer, (slot.loop(),))
    assert plate.area == pytest.approx(math.pi * 3600 + slot.loop().area)


def test_places_with_land_between_them_get_holes_and_others_a_slot():
    apart = [cmath.rect(50, angle) for angle in (0.0, 0.4, -0.4)]
    assert setting("A", apart, 0j, 10, 4, 4.5).slot is None
    near = [cmath.rect(50, angle) for angle in (0.0, 0.1, -0.3)]
    found = setting("A", near, 0j, 10, 4, 4.5)
    assert found.slot.sweep == pytest.approx(0.4)
    assert found.slot.start == pytest.approx(-0.3)
    assert len(setting("A", [50 + 0j, 50.001 + 0j], 0j, 10, 4, 4.5).places) == 1


def test_a_slot_goes_the_short_way_round():
    places = [cmath.rect(30, math.radians(angle)) for angle in (175, -178, 179)]
    slot = setting("A", places, 0j, 10, 4, 4.5).slot
    assert math.degrees(slot.sweep) == pytest.approx(7)


def test_gaps_are_between_walls():
    a = setting("A", [30 + 0j, cmath.rect(30, 0.1)], 0j, 8, 4, 4.0)
    b = setting("B", [50 + 0j], 60 + 0j, 8, 4, 4.0)
    (gap,) = gaps(a, b, 8.0)
    assert (gap.distance, gap.walls, gap.land) == pytest.approx((20, 6, 14))
    (own,) = point_gaps(a, cmath.rect(40, 0.05), 8.0, 6.0)
    assert (own.distance, own.walls) == pytest.approx((10, 5))
    (holes,) = gaps(b, setting("C", [0j], 1j, 8, 4, 4.0), 8.0)
    assert (holes.distance, holes.walls) == (50, 8)


@pytest.mark.parametrize("stud", [5.0, 6.0, 8.0, 10.0, 12.0])
def test_clamps_fit_their_studs(stud):
    for clamp in clamps(stud, 6.0, 8.0):
        assert clamp.width <= FACE * stud
        deep = clamp.screw.length - clamp.washer[1] - 6.0
        assert clamp.size.size <= deep <= 8.0
        head, part = (1.6 * stud, 0.3 * stud), Instance("coupler")
        made = stud_part("stud", stud, 8.0 - head[1], head, clamp, part)
        assert made.turned.length == pytest.approx(8.0)
        assert made.turned.bore == clamp.size.size < stud


def test_screws_that_point_up_stand_below_their_washers():
    clamp = clamps(8.0, 6.0, 8.0)[0]
    for upwards in (False, True):
        washers, screws = screw_parts("clamp", clamp, [Instance("plate", 10.0)], upwards=upwards)
        heights = [z for piece in screws.bought.shape.pieces for _, z in piece.profile]
        under, over = (limit(heights) + screws.instances[0].z for limit in (min, max))
        ring = clamp.washer[1]
        if upwards:
            assert washers.instances[0].z == pytest.approx(10 - ring)
            assert over == pytest.approx(10 - ring + clamp.screw.length)
            assert under == pytest.approx(10 - ring - clamp.size.head_height)
        else:
            assert washers.instances[0].z == 10
            assert under == pytest.approx(10 + ring - clamp.screw.length)


def test_a_clamp_holds_the_friction_of_its_preload():
    clamp = clamps(8.0, 6.0, 8.0)[0]
    assert clamp.size.size == 5
    assert clamp.holds == pytest.approx(0.12 * 0.7 * 640 * math.pi / 4 * (5 - 0.938194 * 0.8) ** 2)


def test_a_scale_has_a_mark_for_each_place_beside_the_washer():
    slot = ArcSlot(0j, 50.0, 0.0, 1.0, 5.0)
    places = [slot.at(along) for along in (0.0, 0.5, 0.51, 1.0)]
    found = scale("scale", slot, places, [10.0, 38.6, 39.2, 67.3], 6.0)
    marks = [
        stroke
        for stroke in found.strokes
        if len(stroke) == 2 and math.hypot(*stroke[0]) == pytest.approx(56.0)
    ]
    assert len(marks) == 4
    assert min(math.hypot(*point) for stroke in found.strokes for point in stroke) > 55.9
