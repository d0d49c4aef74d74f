"""Strips along a path against closed forms, and against the buffer of a polyline."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.contracts.moments import volume
from mechwright.contracts.part import Bore, OpenProfile, Part, Pocket, Profile
from mechwright.contracts.sections import sections
from mechwright.errors import GeometryError
from mechwright.geometry import Arc, BSpline, Line, Loop, Outline, circle
from mechwright.geometry.strip import strip
from mechwright.testing.rules import feature_faults

ARC = Arc((0.0, 0.0), 10.0, 0.3, 2.0)


def turned(*lengths_and_turns):
    """A smooth path from lengths of lines and (radius, turn) of arcs."""
    place, heading, path = np.zeros(2), 0.0, []
    for item in lengths_and_turns:
        along = np.array((math.cos(heading), math.sin(heading)))
        if isinstance(item, tuple):
            radius, turn = item
            side = math.copysign(1.0, turn)
            centre = place + side * radius * np.array((-along[1], along[0]))
            arc = Arc(tuple(centre.tolist()), radius, heading - side * math.pi / 2, turn)
            path.append(arc)
            place, heading = np.array(arc.end), heading + turn
        else:
            end = place + item * along
            path.append(Line(tuple(place.tolist()), tuple(end.tolist())))
            place = end
    return tuple(path)


def test_both_sides_of_an_arc():
    assert strip([ARC], 2.0, 0.0).area == pytest.approx((10**2 - 8**2) / 2 * 2.0, rel=1e-12)
    assert strip([ARC], 0.0, 2.0).area == pytest.approx((12**2 - 10**2) / 2 * 2.0, rel=1e-12)
    assert strip([ARC], 2.0, 2.0, "round").area == pytest.approx(20 * 4.0 + math.pi * 4, rel=1e-12)


@pytest.mark.parametrize("ends", ["round", "square"])
def test_a_smooth_strip_is_as_long_as_wide_as_its_path(ends):
    path = turned(12.0, (6.0, 1.2), 5.0, (9.0, -2.0), 8.0)
    length = 12 + 7.2 + 5 + 18 + 8
    caps = math.pi * 9 if ends == "round" else 0.0
    loop = strip(path, 3.0, 3.0, ends)
    assert loop.area == pytest.approx(6 * length + caps, rel=1e-12)
    assert all(isinstance(segment, Line | Arc) for segment in loop.segments)


def test_a_corner_is_round_outside_and_sharp_inside():
    corner = [Line((0.0, 0.0), (20.0, 0.0)), Line((20.0, 0.0), (20.0, 20.0))]
    assert strip(corner, 0.0, 3.0).area == pytest.approx(120 + math.pi * 9 / 4, rel=1e-12)
    assert strip(corner, 3.0, 0.0).area == pytest.approx(120 - 9, rel=1e-12)


def test_a_spline_is_followed_to_half_a_micrometre():
    spline = BSpline.bezier([(0, 0), (10, 15), (25, -10), (40, 5)])
    loop = strip([spline], 2.0, 2.0, "round")
    line = shapely.LineString(spline.flatten(1e-6))
    points = np.concatenate([segment.at(np.linspace(0, 1, 60)) for segment in loop.segments])
    np.testing.assert_allclose(shapely.distance(line, shapely.points(points)), 2.0, atol=6e-4)
    assert loop.area == pytest.approx(4 * line.length + math.pi * 4, rel=1e-4)


@settings(max_examples=40, deadline=None)
@given(
    items=st.lists(
        st.one_of(
            st.floats(1, 30),
            st.tuples(st.floats(4, 30), st.floats(-1.5, 1.5).filter(lambda a: abs(a) > 0.05)),
        ),
        min_size=1,
        max_size=5,
    ),
    left=st.floats(0, 3),
    right=st.floats(0.1, 3),
)
def test_any_smooth_path_has_its_strip_or_is_refused(items, left, right):
    path = turned(*items)
    try:
        loop = strip(path, left, right)
    except GeometryError as error:
        assert "meets itself" in str(error)  # noqa: PT017
        return
    length = sum(abs(item[0] * item[1]) if isinstance(item, tuple) else item for item in items)
    bend = sum(item[1] for item in items if isinstance(item, tuple))
    # Steiner: a side at a distance d on the left is shorter by d times the turn.
    assert loop.area == pytest.approx((left + right) * length - (left**2 - right**2) / 2 * bend, rel=1e-9)
    back = strip([segment.reversed() for segment in reversed(path)], right, left)
    assert back.area == pytest.approx(loop.area, rel=1e-9)


@pytest.mark.parametrize(
    ("path", "left", "right", "says"),
    [
        ([], 1, 1, "at least one segment"),
        ([Line((0, 0), (1, 0))], 0, 0, "a width above 0"),
        ([Line((0, 0), (1, 0)), Line((1, 0.1), (2, 0))], 1, 1, "torn at"),
        ([circle((0, 0), 5.0)], 1, 1, "the path closes"),
        ([Arc((0, 0), 2.0, 0, 1)], 3, 0, "too sharply for 3 mm"),
        ([BSpline.bezier([(0, 0), (10, 10), (0, 10), (10, 0)])], 8, 8, "too sharply"),
        ([Line((0, 0), (1, 0)), Line((1, 0), (1, 1))], 3, 0, "segments too short"),
        ([Line((0, 0), (20, 0)), Line((20, 0), (20, 10)), Line((20, 10), (5, -20))], 0, 1, "meets itself"),
    ],
)
def test_what_has_no_strip_is_refused(path, left, right, says):
    with pytest.raises(GeometryError, match=says):
        strip(path, left, right)


PLATE = Loop.polygon([(-30, -20), (30, -20), (30, 20), (-30, 20)])
OUTSIDE = Profile("outside", PLATE, "outside", 0, 6.0)


def part(*features):
    return Part("plate", Outline(PLATE), 6.0, "steel", machined=(*features, OUTSIDE))


def test_a_step_along_an_edge_and_a_groove_are_taken_from_part_and_volume():
    step = OpenProfile("step", 0, 2, path=(Line((-35, 12), (35, 12)),), side="left", width=10.0)
    groove = OpenProfile("groove", 0, 1.5, path=(Line((-10, 0), (10, 0)),), side="on", width=4.0)
    of = part(step, groove)
    assert [f.name for f in of.features] == ["step", "groove", "outside"]
    assert not feature_faults(of)
    top = sections(of)[0]
    assert top.shape.area == pytest.approx(60 * 32 - (80 + math.pi * 4), abs=0.01)
    assert volume(of) == pytest.approx(60 * 40 * 6 - 60 * 8 * 2 - (80 + math.pi * 4) * 1.5, rel=1e-6)


def test_left_of_a_path_is_right_of_it_run_the_other_way():
    path = turned(12.0, (6.0, 1.2), 5.0)
    back = tuple(segment.reversed() for segment in reversed(path))
    one = OpenProfile("a", 0, 2, path=path, side="left", width=3.0).boundary
    two = OpenProfile("a", 0, 2, path=back, side="right", width=3.0).boundary
    shapes = [shapely.Polygon(loop.flatten()) for loop in (one, two)]
    assert shapely.symmetric_difference(*shapes).area < 1e-3


def test_a_moved_feature_is_the_moved_strip():
    feature = OpenProfile("a", 0, 2, path=turned(12.0, (6.0, 1.2)), side="on", width=3.0)
    moved = feature.moved(3.0, -2.0, 0.7)
    wanted = shapely.Polygon(feature.boundary.moved(3.0, -2.0, 0.7).flatten())
    assert shapely.symmetric_difference(shapely.Polygon(moved.boundary.flatten()), wanted).area < 1e-3
    assert isinstance(moved, Pocket)
    assert not isinstance(moved, Bore)


def test_the_feature_names_itself_where_it_cannot_be():
    with pytest.raises(GeometryError, match=r"^slit: the path bends"):
        OpenProfile("slit", 0, 2, path=(Arc((0, 0), 2.0, 0, 1),), side="on", width=6.0)


def test_curves_that_meet_on_the_inner_side_are_trimmed_where_they_cross():
    """A line along y = 3 and a circle of 12 mm about (5, 0), neither of them at a sample."""
    path = [Line((0.0, 0.0), (20.0, 0.0)), Arc((5.0, 0.0), 15.0, 0.0, 1.0)]
    crossing = np.array([5 + math.sqrt(12**2 - 3**2), 3.0])
    ends = np.array([segment.end for segment in strip(path, 3.0, 0.0).segments])
    assert np.hypot(*(ends - crossing).T).min() < 1e-6
