"""First looks at thinned shapes: they are quick, and never decide against the exact ones."""

import math

import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright_cam.operations.channel import FILLS, fills_a_slot
from mechwright_plane.offsets import BIAS, ROUGH, grow, simplified, thinned
from mechwright_plane.reach import (
    ROUGHLY,
    closing,
    leaves_at_most,
    leaves_much_more,
    remainder,
    roughly_closed_area,
    roughly_swollen,
)


def slotted(width, length=20.0, taper=0.0):
    """A plate with one slot from above, ``width`` wide at its bottom; its corners are round."""
    half = width / 2
    slot = shapely.Polygon([(-half, 0), (half, 0), (half + taper, length + 1), (-half - taper, length + 1)])
    return shapely.box(-20, -10, 20, length).difference(slot).buffer(-1).buffer(1)


@settings(max_examples=40, deadline=None)
@given(
    radius=st.sampled_from([1.0, 2.0, 3.0]),
    play=st.floats(-0.6, 0.9),
    taper=st.sampled_from([0.0, 0.1, 2.0]),
    allowance=st.sampled_from([0.0, 0.03, 0.2]),
)
def test_a_mill_fills_a_slot_as_the_exact_shapes_say(radius, play, taper, allowance):
    part = slotted(2 * radius + play, taper=taper)
    least = max(allowance, BIAS)
    only = closing(part, radius + least).difference(closing(part, radius + BIAS))
    exact = not only.buffer(-FILLS * radius, quad_segs=8).is_empty
    assert fills_a_slot(radius, part, allowance, BIAS) is exact


def test_both_answers_occur():
    assert fills_a_slot(3.0, slotted(6.2), 0.2, BIAS)
    assert not fills_a_slot(3.0, slotted(5.8), 0.2, BIAS)  # it does not get in
    assert not fills_a_slot(3.0, slotted(6.6), 0.2, BIAS)  # it has room for its allowance
    assert not fills_a_slot(3.0, slotted(6.2, taper=4.0), 0.2, BIAS)  # only its bottom is so narrow


@given(radius=st.floats(0.3, 8.0), corners=st.integers(3, 40), size=st.floats(4.0, 30.0))
def test_a_rough_shape_is_never_smaller_than_the_exact_one(radius, corners, size):
    star = [
        (size * f * math.cos(math.tau * i / corners), size * f * math.sin(math.tau * i / corners))
        for i in range(corners)
        for f in [1.0 if i % 2 else 0.6]
    ]
    part = shapely.Polygon(star).buffer(0.5)
    rough, exact = roughly_swollen(part, radius), grow(part, radius, 1e-4)
    assert shapely.covers(rough.buffer(1e-3), exact)
    assert shapely.covers(exact.buffer(ROUGHLY + ROUGH, quad_segs=64), rough)
    left = grow(exact, -radius, 1e-4).area
    assert roughly_closed_area(part, radius) == pytest.approx(left, abs=3 * ROUGHLY * part.length)


@settings(max_examples=40, deadline=None)
@given(radius=st.floats(0.4, 4.0), fillet=st.floats(0.3, 3.0), limit=st.sampled_from([0.005, 0.05]))
def test_what_a_mill_leaves_is_the_remainder(radius, fillet, limit):
    part = shapely.box(-15, -15, 15, 15).difference(
        shapely.box(0, 0, 20, 20).buffer(-fillet).buffer(fillet, 64)
    )
    left = remainder(part, radius)
    if abs(left - limit) > 1e-3:
        assert leaves_at_most(part, radius, limit) is (left <= limit)
    # A first look at whether a finer cutter is worth it errs on one side only.
    if leaves_much_more(part, radius, 0.3, limit):
        assert left > limit
    if left > limit + 8 * ROUGHLY:
        assert leaves_much_more(part, radius, 0.3, limit)


def test_a_shape_with_walls_as_near_as_the_tolerance_keeps_them():
    thin = shapely.Polygon([(0, 0), (10, 0), (10, 0.004), (5, 0.002), (0, 0.004)])
    comb = shapely.union_all([shapely.box(0, 0, 10, 1), thin.buffer(0).union(shapely.box(0, 1.003, 10, 2))])
    for shape in (comb, shapely.box(0, 0, 4, 4).difference(shapely.box(1, 1, 1.004, 3))):
        found = simplified(shape, ROUGH)
        assert found.is_valid
        assert found.area == pytest.approx(shape.area, abs=ROUGH * shape.length)
        rings = [len(part.interiors) for part in shapely.get_parts(found)]
        assert rings == [len(part.interiors) for part in shapely.get_parts(shape)]
    assert len(shapely.get_coordinates(thinned(shapely.Point(0, 0).buffer(5, 512)))) < 200
