"""Parallels of loops: closed forms, polygons, and what has none."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.contracts.details import Chamfer, Engraving, Thread, band_of, chamfer_lines
from mechwright.contracts.moments import volume
from mechwright.contracts.part import Bore, Part, Profile
from mechwright.errors import GeometryError
from mechwright.geometry import Arc, BSpline, Line, Loop, Outline, circle
from mechwright.geometry.parallel import Parallel


def slot(half, radius):
    """Two lines and two half circles, counter-clockwise."""
    return Loop(
        (
            Line((-half, -radius), (half, -radius)),
            Arc((half, 0.0), radius, -math.pi / 2, math.pi),
            Line((half, radius), (-half, radius)),
            Arc((-half, 0.0), radius, math.pi / 2, math.pi),
        )
    )


def keyed():
    """A bore with a keyway: an arc and three lines that meet at corners."""
    a = math.asin(0.3)
    x = 10 * math.cos(a)
    return Loop(
        (
            Arc((0.0, 0.0), 10.0, a, 2 * math.pi - 2 * a),
            Line((x, -3.0), (12.8, -3.0)),
            Line((12.8, -3.0), (12.8, 3.0)),
            Line((12.8, 3.0), (x, 3.0)),
        )
    )


def lens():
    """Two splines that meet at two sharp corners."""
    over = BSpline.bezier([(10, 0), (6, 6), (-6, 6), (-10, 0)])
    return Loop((over, BSpline.bezier([(-10, 0), (-6, -6), (6, -6), (10, 0)])))


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("turned", [False, True])
def test_a_slot_has_the_area_of_steiners_formula(side, turned):
    loop = slot(10.0, 4.0)
    wide = 0.5 if (side == -1) != turned else -0.5
    moved = Parallel(loop.reversed() if turned else loop, side).at(0.5)
    assert abs(moved.area) == pytest.approx(slot(10.0, 4.0 + wide).area, rel=1e-9)
    assert len(moved.segments) == 4
    assert (moved.area > 0) != turned


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("make", [keyed, lens])
def test_corners_are_mitred_and_every_point_is_at_the_distance(side, make):
    loop = make()
    moved = Parallel(loop, side).at(0.4)
    polygon = shapely.Polygon(loop.flatten(1e-6))
    wanted = polygon.buffer(-0.4 * side, join_style="mitre", mitre_limit=50)
    assert moved.area == pytest.approx(wanted.area, abs=5e-3)  # polygons run on straight past corners
    ring = shapely.LinearRing(loop.flatten(1e-6))
    for old, new in zip(loop.segments, moved.segments, strict=True):
        assert type(old) is type(new)
        inner = new.at(np.linspace(0.2, 0.8, 7))
        assert shapely.distance(ring, shapely.points(inner)) == pytest.approx(0.4, abs=3e-6)
    for one, two in zip(moved.segments, (*moved.segments[1:], moved.segments[0]), strict=True):
        assert math.dist(one.end, two.start) < 1e-7


@settings(max_examples=25)
@given(
    radii=st.lists(st.floats(8, 20), min_size=3, max_size=9),
    distance=st.floats(0.05, 1.5),
    side=st.sampled_from([1, -1]),
)
def test_random_polygons_move_as_polygons_do_or_are_refused(radii, distance, side):
    angles = np.linspace(0, 2 * math.pi, len(radii), endpoint=False)
    corners = [(r * math.cos(a), r * math.sin(a)) for r, a in zip(radii, angles.tolist(), strict=True)]
    loop = Loop.polygon(corners)
    wanted = shapely.Polygon(corners).buffer(-side * distance, join_style="mitre", mitre_limit=100)
    try:
        moved = Parallel(loop, side).at(distance)
    except GeometryError as error:
        assert "moved" in str(error)  # noqa: PT017 - refusing is one of two right answers
        return
    assert moved.area == pytest.approx(wanted.area, abs=0.02)


@pytest.mark.parametrize(
    ("loop", "distance", "words"),
    [
        (Loop((circle((1, 2), 3.0),)), 3.0, "cannot be moved inwards by 3 mm"),
        (Loop.polygon([(0, 0), (20, 0), (20, 9.7), (19.7, 10), (0, 10)]), 1.0, "moved by 1 mm"),
        (Loop.polygon([(0, 0), (20, 0), (20, 1), (0, 1)]), 0.6, "moved"),
    ],
)
def test_what_has_no_parallel_is_refused(loop, distance, words):
    with pytest.raises(GeometryError, match=words):
        Parallel(loop).at(distance)


def test_chamfer_lines_fall_back_to_polygons():
    short = Loop.polygon([(0, 0), (20, 0), (20, 10), (10.3, 10), (10, 10.1), (9.7, 10), (0, 10)])
    (line,) = chamfer_lines(Chamfer("rim", short, "outside", 2.0))
    assert abs(line.area) == pytest.approx(16 * 6, abs=0.2)
    with pytest.raises(GeometryError):
        Parallel(short).at(2.0)
    (hole,) = chamfer_lines(Chamfer("hole", Loop((circle((0, 0), 5.0, clockwise=True),)), "inside", 0.5))
    assert abs(hole.area) == pytest.approx(math.pi * 5.5**2, rel=1e-9)


def test_the_volume_of_a_part_with_details():
    """A square plate: chamfer w²/2 L - 4 w³/3; engravings and threads count as nothing."""
    square = Loop.polygon([(0, 0), (30, 0), (30, 20), (0, 20)])
    rim, stroke = Chamfer("rim", square, "outside", 0.6), Engraving("mark", (((5, 5), (25, 5)),), 0.2, 0.5)
    thread = Thread("m6", (15.0, 12.0), 6.0, 1.0, 5.0)
    bore = Bore("core", thread.centre, thread.core, 0.0, 5.0)
    outline = Outline(square, (Loop((circle(thread.centre, thread.core / 2, clockwise=True),)),))
    machined = (bore, Profile("outside", square, "outside", 0.0, 5.0))
    plate = Part("plate", outline, 5.0, "steel", machined=machined)
    chamfer = 0.6**2 / 2 * 100 - 4 / 3 * 0.6**3
    for details, taken in (
        ((rim,), chamfer),
        ((stroke,), 0.0),
        ((thread,), 0.0),
        ((rim, stroke), chamfer),
    ):
        with_them = Part("plate", outline, 5.0, "steel", machined=machined, details=details)
        assert volume(plate) - volume(with_them) == pytest.approx(taken, abs=2e-4)
    assert band_of(rim, 0.6, 1e-3).area == pytest.approx(0.0)


@pytest.mark.parametrize("kink", [0.0, 1e-5, 4e-5, 1e-4])
@pytest.mark.parametrize("side", [1, -1])
def test_segments_that_go_on_in_nearly_the_same_direction_have_a_joint(kink, side):
    # As an arc and the spline that is fitted to what follows it.
    arc = Arc((0.0, 100.0), 100.0, -math.pi / 2 - 0.02, 0.02)
    end = (50 * math.cos(kink), 50 * math.sin(kink))
    top = (arc.start[0], 30.0)
    loop = Loop(
        (
            arc,
            Line((0.0, 0.0), end),
            Line(end, (end[0], 30.0)),
            Line((end[0], 30.0), top),
            Line(top, arc.start),
        )
    )
    moved = Parallel(loop, side).at(0.4)
    assert len(moved.segments) == len(loop.segments)
    assert moved.segments[1].start == pytest.approx((0.0, 0.4 * side), abs=1e-4)


def test_a_strip_has_no_piece_of_no_length():
    curve = BSpline.bezier([(0.0, 0.0), (10.0, 4.0), (20.0, -4.0), (30.0, 0.0)])
    ends = Loop((curve, Line((30.0, 0.0), (30.0, 30.0)), Line((30.0, 30.0), (0.0, 0.0))))
    for first, last in ((0.0, 1.0), (0.25, 0.75)):
        grid, _ = Parallel(ends).strip(curve, first, last, 0.5)
        assert (grid[0], grid[-1]) == (first, last)
        assert np.diff(grid).min() > 1e-6
