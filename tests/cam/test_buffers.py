"""Parallel curves: nothing of them is nearer to the shape than the distance, and nothing that is farther is lost."""

import math

import numpy as np
import pytest
import shapely
from by_night import NIGHT, examples
from hypothesis import given, settings
from hypothesis import strategies as st
from planning_parts import job, lobes, part
from planning_simulation import motions

from mechwright.contracts.part import Profile
from mechwright_cam.planning import plan
from mechwright_plane.buffers import THINNING, buffered

# An opening with a bulge; with a distance of 2.5, GEOS 3.14 leaves a ring that is 1.9 from its walls.
BULGE = [(4.957, 0.818), (-3.0197, -4.2554), (-1.7939, 1.7778), (-1.7, 2.07), (-1.554, 2.314), (-1.31, 2.58)]
BULGE += [(-1.0, 2.77), (-0.7, 2.863), (-0.4, 2.889), (-0.125, 2.854), (0.0859, 2.788)]
QUAD = 16


def check(shape, distance):
    found = buffered(shape, distance, QUAD)
    assert found.is_valid
    slack = abs(distance) * (1 - math.cos(math.pi / (4 * QUAD)) + THINNING)
    edge = shapely.points(shapely.get_coordinates(found))
    far = shapely.distance(edge, shape if distance > 0 else shapely.boundary(shape))
    assert far.size == 0 or far.min() >= abs(distance) - slack
    # What is farther away than the distance is free, or gone; what is nearer is not.
    x0, y0, x1, y1 = shape.bounds
    grid = np.array(np.meshgrid(np.linspace(x0, x1, 60), np.linspace(y0, y1, 60))).reshape(2, -1).T
    points = shapely.points(grid)
    inside = shapely.contains(found, points)
    if distance > 0:
        away = shapely.distance(points, shape)
        assert not inside[away > distance + slack].any()
        assert inside[away < distance - slack].all()
    else:
        away = np.where(shapely.contains(shape, points), shapely.distance(points, shapely.boundary(shape)), 0)
        assert inside[away > -distance + slack].all()
        assert not inside[away < -distance - slack].any()
    return found


@pytest.mark.parametrize("distance", np.arange(1.2, 3.0, 0.1))
def test_an_opening_that_turns_inside_out_vanishes(distance):
    plate = shapely.box(-20, -20, 20, 20)
    bulge = shapely.Polygon(BULGE)
    check(plate.difference(bulge), distance)
    check(bulge, -distance)
    island = shapely.Point(0.1, 0.0).buffer(0.05)
    check(plate.difference(bulge).union(island), distance)


def test_islands_in_openings_stay():
    ring = shapely.Point(0, 0).buffer(20).difference(shapely.Point(0, 0).buffer(15))
    found = check(shapely.union(ring, shapely.Point(0, 0).buffer(2)), 1.0)
    assert [len(part.interiors) for part in shapely.get_parts(found)] == [1, 0]


@settings(max_examples=examples(30, 100))
@given(seed=st.integers(0, 10**6), distance=st.floats(0.2, 6))
def test_random_openings(seed, distance):
    rng = np.random.default_rng(seed)
    turn = np.sort(rng.uniform(0, math.tau, rng.integers(3, 12)))
    far = rng.uniform(2, 8, len(turn))
    opening = shapely.Polygon(np.column_stack((far * np.cos(turn), far * np.sin(turn)))).buffer(0)
    opening = max(shapely.get_parts(opening), key=lambda part: part.area)
    if rng.random() < 0.5:
        opening = opening.buffer(rng.uniform(0.1, 1)).buffer(-0.05)
    check(shapely.box(-20, -20, 20, 20).difference(opening), distance)
    check(opening, -distance)


@given(seed=st.integers(0, 10**6), share=st.floats(0.9, 0.999))
def test_the_middle_of_an_opening_that_is_just_wide_enough_stays(seed, share):
    rng = np.random.default_rng(seed)
    turn = np.sort(rng.uniform(0, math.tau, rng.integers(3, 12)))
    opening = shapely.Polygon(10 * np.column_stack((np.cos(turn), np.sin(turn))))
    widest = shapely.maximum_inscribed_circle(opening, 1e-6)
    middle, radius = shapely.Point(widest.coords[0]), widest.length
    if radius < 0.1:
        return
    assert shapely.contains(buffered(opening, -share * radius, QUAD), middle)
    plate = shapely.union(shapely.box(-20, -20, 20, 20).difference(opening), shapely.box(30, 0, 31, 1))
    assert not shapely.contains(buffered(plate, share * radius, QUAD), middle)


def test_all_pieces_of_a_shape_are_shrunk():
    pieces = [shapely.box(0, 0, 5, 5), shapely.box(8, 0, 13, 5)]
    assert buffered(shapely.MultiPolygon(pieces), -1, QUAD).area == pytest.approx(18)


def test_specks_of_lines_beside_a_shape_do_not_keep_it_from_shrinking():
    mixed = shapely.geometrycollections([shapely.LineString([(60, 0), (70, 0)]), shapely.box(0, 0, 4, 4)])
    assert buffered(mixed, -0.5, QUAD).area == pytest.approx(9)
    assert buffered(shapely.geometrycollections([shapely.Point(0, 0)]), -0.5, QUAD).is_empty


def off(shape, distance):
    """How far the edge of the grown or shrunk shape is from where it should be, at the worst."""
    found = buffered(shape, distance, 90)
    edge = shapely.points(shapely.get_coordinates(shapely.segmentize(shapely.boundary(found), 0.5)))
    return float(np.abs(shapely.distance(edge, shapely.boundary(shape)) - abs(distance)).max(initial=0.0))


def test_short_edges_beside_a_bar_that_stands_in_an_opening():
    """Taken for an outer edge, such an opening is 1.6 mm off behind the bar."""
    rim = shapely.Polygon(lobes(4, 24, 4.346439254032361, 2500).flatten())
    opening = shapely.union(rim, shapely.box(20, -2, 40, 2))
    assert off(shapely.box(-80, -80, 80, 80).difference(opening), -8.0) < 0.0005


def test_an_opening_keeps_its_distance_whichever_piece_it_is_in():
    """Taken for an outer edge, a bar in it has a straight line of centimetres beside its end: 6 µm there."""
    rim, bar = shapely.Polygon(lobes(3, 24, 6, 2500).flatten()), shapely.box(-2, 15, 2, 45)
    shape = shapely.union(shapely.box(-80, -80, 80, 80).difference(rim), bar)
    assert off(shape, 3.0) < 0.0005
    assert off(shapely.MultiPolygon([shapely.box(100, 0, 110, 10), shape]), 3.0) < 0.0005


def test_short_edges_before_a_long_one_are_no_straight_line():
    """GEOS 3.14 goes straight from the end of the bar to the far side of the rim, 8 mm above it in between."""
    rim = shapely.Polygon(lobes(2, 26, 8, 2500).flatten())
    shape = shapely.union(rim, shapely.box(20, -2, 40, 2))
    assert off(shape, 8.0) < 0.0005
    for way in (8.0, -8.0):
        assert off(shapely.box(-80, -80, 80, 80).difference(shape), way) < 0.0005  # of an opening, too
    mixed = shapely.geometrycollections([shapely.LineString([(60, 0), (70, 0)]), shape])
    assert buffered(mixed, 8.0, 90).area == pytest.approx(
        buffered(shape, 8.0, 90).area + 160 + 64 * math.pi, abs=0.05
    )
    true = shapely.union(
        *(shapely.buffer(one, 8.0, quad_segs=90) for one in (rim, shapely.box(20, -2, 40, 2)))
    )
    assert buffered(shape, 8.0, 90).area == pytest.approx(true.area, abs=0.05)


@settings(max_examples=examples(30, 100))
@given(
    points=st.sampled_from([300, 900, 2500] if NIGHT else [300, 900]),
    count=st.integers(2, 8),
    depth=st.floats(0.5, 9),
    bars=st.lists(st.tuples(*[st.floats(-28, 28)] * 2, st.floats(1, 4), st.floats(1, 9)), max_size=3),
    distance=st.sampled_from([1.0, 3.0, 8.0, -0.5, -3.0]),
)
def test_edges_are_at_the_distance_however_dense_the_points(points, count, depth, bars, distance):
    rim = shapely.Polygon(lobes(count, 24, depth, points).flatten())
    shape = shapely.union_all([rim, *(shapely.box(x, y, x + w, y + h) for x, y, w, h in bars)])
    assert off(shape, distance) < 2.5e-4 * abs(distance) + 0.0005


def test_a_dense_rim_with_tabs_is_cut_all_round():
    rim = lobes(2, 26, 8, 2500)
    plate = part(rim, machined=(Profile("outside", rim, "outside", 0.0, 6.0),))
    of = job(plate, "mill-16")
    cuts = [
        m.points[:, :2]
        for m in motions(plan(of), 0.2)
        if m.kind in {"feed", "arc"} and m.points[-1, 2] < -5.5
    ]
    wall = shapely.points(shapely.get_coordinates(shapely.segmentize(of.target.exterior, 0.5)))
    tabs = shapely.union_all([tab.shape for tab in of.tabs])
    wall = wall[shapely.distance(wall, tabs) > 9]
    ways = shapely.multilinestrings([shapely.linestrings(way) for way in cuts])
    assert (shapely.distance(wall, ways) - 8).max() < 0.005
