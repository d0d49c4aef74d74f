import itertools
import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from mechwright.errors import GeometryError
from mechwright.geometry import Arc, BSpline, Line, circle
from mechwright.testing import assert_points_close

patient = settings(deadline=None)  # imports and a busy machine are no faults
T = np.linspace(0, 1, 41)
ROUNDING = 1e-9

coordinates = st.floats(-500, 500)
points = st.tuples(coordinates, coordinates)
angles = st.floats(-7, 7)
tolerances = st.floats(1e-4, 1.0)


@st.composite
def lines(draw):
    return Line(draw(points), draw(points), "wall")


@st.composite
def arcs(draw):
    sweep = draw(st.floats(1e-3, math.tau)) * draw(st.sampled_from([-1, 1]))
    return Arc(draw(points), draw(st.floats(1e-2, 300)), draw(angles), sweep, "round")


@st.composite
def splines(draw):
    degree = draw(st.integers(1, 7))
    inner = sorted(draw(st.lists(st.integers(1, 15), max_size=8)))
    inner = [k / 16 for i, k in enumerate(inner) if inner[:i].count(k) < degree]
    count = degree + 1 + len(inner)
    net = draw(st.lists(points, min_size=count, max_size=count))
    return BSpline(degree, (0.0,) * (degree + 1) + tuple(inner) + (1.0,) * (degree + 1), tuple(net), "flank")


segments = st.one_of(lines(), arcs(), splines())


def distance_to_chords(path, places):
    """Distance of each place (n, 2) from the polyline (m, 2)."""
    a, step = path[:-1], np.diff(path, axis=0)
    square = np.maximum((step**2).sum(axis=1), 1e-300)
    share = np.clip(((places[:, None] - a) * step).sum(axis=2) / square, 0, 1)
    return np.linalg.norm(places[:, None] - a - share[:, :, None] * step, axis=2).min(axis=1)


@patient
@given(segments)
def test_ends_are_those_of_the_curve(segment):
    assert_points_close([segment.start, segment.end], segment.at([0.0, 1.0]), ROUNDING)


@patient
@given(segments, tolerances)
def test_flattening_stays_within_the_tolerance(segment, tolerance):
    path = segment.flatten(tolerance)
    assume(len(path) < 3000)
    assert_points_close([path[0], path[-1]], [segment.start, segment.end], 0.0, "ends")
    dense = segment.at(np.linspace(0, 1, 997))
    assert distance_to_chords(path, dense).max() <= tolerance * (1 + 1e-6) + ROUNDING


@patient
@given(arcs(), tolerances)
def test_flattening_an_arc_needs_no_more_chords_than_it_must(arc, tolerance):
    half = abs(arc.sweep) / (2 * max(len(arc.flatten(tolerance)) - 2, 1))
    if len(arc.flatten(tolerance)) > 4:
        assert arc.radius * (1 - math.cos(half)) > tolerance


@patient
@given(segments)
def test_reversed_runs_the_other_way(segment):
    back = segment.reversed()
    assert_points_close(back.at(T), segment.at(1 - T), ROUNDING * 10)
    assert back.tag == segment.tag
    assert_points_close(back.reversed().at(T), segment.at(T), ROUNDING * 10)


@patient
@given(segments, coordinates, coordinates, angles)
def test_moved_moves_every_point_rigidly(segment, x, y, angle):
    c, s = math.cos(angle), math.sin(angle)
    wanted = segment.at(T) @ np.array([[c, s], [-s, c]]) + (x, y)
    moved = segment.moved(x, y, angle)
    assert_points_close(moved.at(T), wanted, ROUNDING)
    assert moved.tag == segment.tag
    back = moved.moved(-x, -y).moved(0, 0, -angle)
    assert_points_close(back.at(T), segment.at(T), ROUNDING)


@patient
@given(segments)
def test_the_derivative_integrates_to_the_curve(segment):
    nodes, weights = np.polynomial.legendre.leggauss(20)
    breaks = segment.breaks()
    assert breaks[0] == 0.0
    assert breaks[-1] == 1.0
    total = np.zeros(2)
    for a, b in itertools.pairwise(breaks):
        total += (b - a) / 2 * weights @ segment.derivative((a + b) / 2 + (b - a) / 2 * nodes)
    assert_points_close([total], np.subtract([segment.end], [segment.start]), 1e-8)


@patient
@given(splines())
def test_splines_agree_with_scipy(spline):
    from scipy.interpolate import BSpline as Reference

    reference = Reference(np.array(spline.knots), np.array(spline.points), spline.degree)
    assert_points_close(spline.at(T), reference(T), ROUNDING)
    # At a knot of full multiplicity the derivative jumps, and each side is right.
    smooth = T[~np.isin(T, spline.knots[spline.degree + 1 : -spline.degree - 1])]
    assert_points_close(spline.derivative(smooth), reference(smooth, 1), 1e-7)


def test_splines_take_scalars_and_need_no_scipy():
    import subprocess
    import sys

    words = "BSpline(2, (0, 0, 0, 0.5, 1, 1, 1), ((0, 0), (1, 2), (3, 2), (4, 0)))"
    spline = BSpline(2, (0, 0, 0, 0.5, 1, 1, 1), ((0, 0), (1, 2), (3, 2), (4, 0)))
    assert spline.at(0.5).tolist() == [[2.0, 2.0]]
    code = (
        "import sys; from mechwright.geometry import BSpline\n"
        f"s = {words}\n"
        "s.at(0.3), s.derivative(0.3), s.flatten(0.01), s.breaks()\n"
        "assert not [m for m in sys.modules if m.startswith('scipy')]"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_a_spline_of_degree_one_is_its_own_polygon():
    spline = BSpline(1, (0, 0, 0.25, 1, 1), ((0, 0), (1, 0), (1, 5)))
    assert spline.flatten(1e-9).tolist() == [[0, 0], [1, 0], [1, 5]]
    assert spline.derivative([0.1, 0.5]).tolist() == [[4, 0], [0, 5 / 0.75]]


def test_a_circle_starts_and_ends_in_the_very_same_point():
    ring = circle((1.1, 2.2), 3.3)
    assert ring.start == ring.end
    assert ring.is_circle
    path = ring.flatten(0.01)
    assert (path[0] == path[-1]).all()
    assert not Arc((0, 0), 1, 0, math.pi).is_circle


def test_a_coarse_circle_is_still_no_line():
    assert len(circle((0, 0), 1.0).flatten(10.0)) == 4


def test_a_huge_radius_needs_few_chords():
    # A sagitta of 1 µm on a radius of a kilometre; the naive formula loses all digits here.
    arc = Arc((0, 0), 1e6, 0.0, 1e-4)
    path = arc.flatten(0.001)
    assert len(path) == 1 + math.ceil(1e-4 / (4 * math.asin(math.sqrt(0.001 / 2e6))))


@pytest.mark.parametrize(
    "make",
    [
        lambda: Arc((0, 0), 0.0, 0, 1),
        lambda: Arc((0, 0), -1.0, 0, 1),
        lambda: Arc((0, 0), math.nan, 0, 1),
        lambda: Arc((0, 0), math.inf, 0, 1),
        lambda: Arc((0, math.nan), 1.0, 0, 1),
        lambda: Arc((0, 0), 1.0, math.inf, 1),
        lambda: Arc((0, 0), 1.0, 0, 0.0),
        lambda: Arc((0, 0), 1.0, 0, 6.3),
    ],
)
def test_arcs_that_are_none(make):
    with pytest.raises(GeometryError, match="an arc needs a radius above 0"):
        make()


@pytest.mark.parametrize(
    ("degree", "knots", "count"),
    [
        (0, (0, 1), 1),
        (26, (0,) * 27 + (1,) * 27, 27),
        (2, (0, 0, 0, 1, 1, 1), 4),
        (2, (0, 0, 0.1, 1, 1, 1), 3),
        (2, (0, 0, 0, 2, 2, 2), 3),
        (2, (0, 0, 0, 0.7, 0.3, 1, 1, 1), 5),
        (2, (0, 0, 0, 0.5, 0.5, 0.5, 1, 1, 1), 6),  # torn apart at 0.5
        (2, (0, 0, 0, 0, 1, 1, 1), 4),
        (3, (0, 0, 0, 1, 1, 1), 2),
    ],
)
def test_knots_that_are_none(degree, knots, count):
    net = tuple((float(i), 0.0) for i in range(count))
    with pytest.raises(GeometryError, match=f"degree {degree} "):
        BSpline(degree, tuple(map(float, knots)), net)


def test_control_points_are_finite():
    with pytest.raises(GeometryError, match="finite"):
        BSpline.bezier([(0, 0), (math.nan, 1), (2, 0)])


@pytest.mark.parametrize("quarters", [1, 2, 3, 4])
def test_arcs_are_cut_to_quarter_turns(quarters):
    assert Arc((0.0, 0.0), 5.0, 0.3, quarters * math.pi / 2).breaks() == pytest.approx(
        np.linspace(0, 1, quarters + 1)
    )


def test_what_turns_noticeably_has_three_chords_at_least():
    assert [len(Arc((0.0, 0.0), 1e-3, 0.0, sweep).flatten(1.0)) for sweep in (0.9, 1.1, 1.9)] == [2, 4, 4]


@given(corners=st.lists(points, min_size=3, max_size=3), tolerance=tolerances)
def test_chords_of_a_parabola_are_as_few_as_the_tolerance_allows(corners, tolerance):
    """Its second derivative is one vector d: n chords are off by |d| / 8 n² each, which is all that is known."""
    curve = BSpline.bezier(corners)
    d = 2 * (np.array(corners[0]) - 2 * np.array(corners[1]) + np.array(corners[2]))
    wanted = math.sqrt(float(np.hypot(*d)) / (8 * tolerance))
    assume(abs(wanted - round(wanted)) > 1e-6)
    assert len(curve.flatten(tolerance)) - 1 == max(1, math.ceil(wanted))
