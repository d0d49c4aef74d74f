import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.arrays import GRID
from mechwright.errors import GeometryError
from mechwright.geometry import Arc, BSpline, Line, Loop, Outline, circle
from mechwright.testing import assert_points_close, assert_same_outline
from mechwright.tolerances import TOLERANCES

patient = settings(deadline=None)
sizes = st.floats(0.5, 200)
shifts = st.floats(-300, 300)
angles = st.floats(-7, 7)


def rectangle(width, height):
    return Loop.polygon([(0, 0), (width, 0), (width, height), (0, height)])


def plate():
    """A rounded plate with a round and a splined opening."""
    outer = Loop(
        (
            Line((0, 0), (60, 0)),
            Arc((60, 20), 20, -math.pi / 2, math.pi),
            Line((60, 40), (0, 40)),
            BSpline.bezier([(0, 40), (-12, 30), (5, 12), (0, 0)]),
        )
    )
    leaf = Loop(
        (BSpline.bezier([(15, 10), (25, 12), (32, 30)]), BSpline.bezier([(32, 30), (12, 25), (15, 10)]))
    )
    return Outline(outer, (Loop((circle((60, 20), 6, clockwise=True),)), leaf.reversed()))


@patient
@given(shifts, shifts, sizes)
def test_moments_of_a_circle(x, y, r):
    area = math.pi * r * r
    wanted = [area, area * x, area * y, area * (x * x + r * r / 4), area * (y * y + r * r / 4), area * x * y]
    loop = Loop((circle((x, y), r),))
    scale = area * (1 + x * x + y * y + r * r)
    np.testing.assert_allclose(loop.moments, wanted, rtol=0, atol=1e-12 * scale)
    np.testing.assert_allclose(loop.reversed().moments, -loop.moments, rtol=0, atol=1e-12 * scale)


@patient
@given(sizes, sizes)
def test_moments_of_a_rectangle(w, h):
    wanted = [w * h, w * w * h / 2, w * h * h / 2, w**3 * h / 3, w * h**3 / 3, w * w * h * h / 4]
    np.testing.assert_allclose(rectangle(w, h).moments, wanted, rtol=1e-12)
    plate = Outline(rectangle(w, h))
    assert plate.polar_moment == pytest.approx(w * h * (w * w + h * h) / 3)
    assert plate.centroid == pytest.approx((w / 2, h / 2))


@pytest.mark.parametrize("degree", range(1, 11))
def test_moments_of_splines_are_exact_up_to_degree_ten(degree):
    # Under the Bezier curve (s, s^k), from 0 to 1, lie the integrals of x^i of y.
    net = [(i / degree, 1.0 if i == degree else 0.0) for i in range(degree + 1)]
    loop = Loop((Line((0, 0), (1, 0)), Line((1, 0), (1, 1)), BSpline.bezier(net).reversed()))
    k = degree
    wanted = [
        1 / (k + 1),
        1 / (k + 2),
        1 / (2 * (2 * k + 1)),
        1 / (k + 3),
        1 / (3 * (3 * k + 1)),
        1 / (4 * (k + 1)),
    ]
    np.testing.assert_allclose(loop.moments, wanted, rtol=1e-12)


@patient
@given(shifts, shifts, angles)
def test_moments_follow_a_move(x, y, angle):
    still = plate()
    moved = still.moved(x, y, angle)
    assert moved.area == pytest.approx(still.area, rel=1e-11)
    c, s = math.cos(angle), math.sin(angle)
    px, py = still.centroid
    assert_points_close([moved.centroid], [(c * px - s * py + x, s * px + c * py + y)], 1e-8)
    # Steiner: about its own centroid the polar moment is the same.
    assert moved.polar_moment - moved.area * np.hypot(*moved.centroid) ** 2 == pytest.approx(
        still.polar_moment - still.area * np.hypot(px, py) ** 2, rel=1e-7
    )


def test_integrals_agree_with_a_fine_polygon():
    outline, fine = plate(), plate().polygon(1e-6)
    assert outline.area == pytest.approx(fine.area, rel=1e-7)
    assert_points_close([outline.centroid], [(fine.centroid.x, fine.centroid.y)], 1e-5)
    assert_points_close([outline.bounds], [fine.bounds], 2 * TOLERANCES.flatten)
    assert outline.area == pytest.approx(outline.outer.area + sum(loop.area for loop in outline.inner))


def test_the_polygon_is_made_once_for_each_tolerance():
    outline = plate()
    assert outline.polygon() is outline.polygon()
    assert len(outline.polygon(0.1).exterior.coords) < len(outline.polygon().exterior.coords)


def test_outlines_are_values():
    assert plate() == plate()
    assert hash(plate()) == hash(plate())
    asked = plate()
    asked.polygon()
    assert asked == plate()
    assert plate().moved(1, 0) != plate()


@pytest.mark.parametrize("gap", [2e-7, 0.1, math.nan])
def test_an_open_loop_is_refused_with_place_and_gap(gap):
    with pytest.raises(GeometryError, match=r"open at \(1\.000000, 1\.000000\): a gap of"):
        Loop((Line((0, 0), (1, 0)), Line((1, 0), (1, 1)), Line((1, 1 + gap), (0, 0))))


def test_a_gap_within_the_tolerance_is_closed():
    Loop((Line((0, 0), (1, 0)), Line((1, 0), (1, 1)), Line((1, 1 + TOLERANCES.closure / 2), (0, 0))))


def test_a_loop_has_segments():
    with pytest.raises(GeometryError, match="at least one segment"):
        Loop(())


def test_a_loop_without_size_is_refused():
    with pytest.raises(GeometryError, match="has no size: all its corners are within 1e-07 mm"):
        Outline(Loop.polygon([(0.0, 0.0), (1e-9, 0.0), (0.0, 1e-9)]))


def test_loops_that_run_the_wrong_way_are_refused():
    box, hole = rectangle(10, 10), Loop((circle((5, 5), 2, clockwise=True),))
    Outline(box, (hole,))
    with pytest.raises(GeometryError, match="outer loop has a signed area of -100 mm²; it must run counter"):
        Outline(box.reversed())
    with pytest.raises(GeometryError, match=r"inner loop 2 has a signed area of 12\.5664 mm²; it must run"):
        Outline(box, (hole, hole.reversed()))
    with pytest.raises(GeometryError, match="encloses no area"):
        Outline(Loop((Line((0, 0), (1, 0)), Line((1, 0), (0, 0)))))


@pytest.mark.parametrize(
    "outline",
    [
        Outline(Loop.polygon([(0, 0), (10, 0), (10, 10), (4, -2), (0, 10)])),
        Outline(rectangle(10, 10), (Loop((circle((9, 5), 2, clockwise=True),)),)),
        Outline(rectangle(10, 10), (Loop((circle((40, 5), 2, clockwise=True),)),)),
        Outline(
            rectangle(10, 10),
            (Loop((circle((4, 5), 2, clockwise=True),)), Loop((circle((5, 5), 2, clockwise=True),))),
        ),
    ],
    ids=["bow tie", "hole through the edge", "hole outside", "holes cut each other"],
)
def test_an_outline_that_cuts_itself_is_refused(outline):
    with pytest.raises(GeometryError, match="the outline cuts itself: "):
        outline.polygon()


def test_only_a_single_whole_turn_is_a_circle():
    assert Loop((circle((0, 0), 1),)).is_circle
    halves = (Arc((0, 0), 1, 0, math.pi), Arc((0, 0), 1, math.pi, math.pi))
    assert not Loop(halves).is_circle
    assert Loop(halves).area == pytest.approx(math.pi, rel=1e-14)


def test_flattening_repeats_no_corner():
    corners = plate().outer.flatten()
    step = np.hypot(*np.diff(np.vstack((corners, corners[:1])), axis=0).T)
    assert step.min() > 0


@pytest.mark.parametrize("length", [1e-15, -1e-15, 1e-9, -1e-9])
def test_segments_of_next_to_no_length_do_not_fold_the_polygon(length):
    """The short ends of a slot whose corners are half as wide as it: rounding decides which way they go."""
    right, left = Arc((5.0, 0.0), 2.0, -math.pi / 2, math.pi), Arc((-5.0, 0.0), 2.0, math.pi / 2, math.pi)
    ends = Line(right.end, (5.0, 2.0 + length)), Line((5.0, 2.0 + length), (-5.0, 2.0))
    corners = Loop((right, *ends, left, Line(left.end, right.start))).flatten()
    assert shapely.Polygon(corners).is_valid
    assert np.hypot(*(corners - np.roll(corners, 1, axis=0)).T).min() > 1e-7


def test_comparison_of_outlines_sees_what_differs():
    outline = plate()
    assert_same_outline(outline, outline.polygon(1e-5))
    turned = Outline(Loop(outline.outer.segments[2:] + outline.outer.segments[:2]), outline.inner[::-1])
    assert_same_outline(turned, outline)
    with pytest.raises(AssertionError, match=r"0\.0[12]\d* mm from the other; the limit is 0\.001 mm"):
        assert_same_outline(outline.moved(0.02, 0), outline)
    with pytest.raises(AssertionError, match="1 openings, expected 2"):
        assert_same_outline(Outline(outline.outer, outline.inner[:1]), outline)
    # A tooth that is missing is seen, whichever of the two has it.
    toothed = shapely.union(outline.polygon(), shapely.box(20, 39, 21, 41))
    for pair in ((toothed, outline), (outline, toothed)):
        with pytest.raises(AssertionError, match="outlines differ"):
            assert_same_outline(*pair)


@pytest.mark.parametrize("degree", [1, 2, 5])
def test_curves_of_a_loop_are_flattened_at_once_as_each_is(degree):
    corners = [(0.0, 0.0), (40.0, 0.0), (30.0, 25.0), (-5.0, 30.0)]
    rng = np.random.default_rng(degree)
    sides = []
    for one, two in zip(corners, corners[1:] + corners[:1], strict=True):
        inner = np.linspace(one, two, degree + 1)[1:-1] + rng.uniform(-3, 3, (degree - 1, 2))
        sides.append(BSpline.bezier([one, *map(tuple, inner.tolist()), two]))
    loop = Loop(tuple(sides))
    for tolerance in (1e-3, 0.1):
        wanted = np.concatenate([side.flatten(tolerance)[:-1] for side in sides])
        assert loop.flatten(tolerance) == pytest.approx(wanted, abs=GRID / 2)


def test_what_encloses_nothing_is_told_by_its_size():
    """The area of a rounding error grows with the square of the size."""
    with pytest.raises(GeometryError, match="encloses no area"):
        Outline(Loop.polygon([(0.0, 0.0), (1e7, 0.0), (5e6, 1.5e-7)]))
