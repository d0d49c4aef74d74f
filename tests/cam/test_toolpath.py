import math
from itertools import pairwise

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright_plane import runs
from mechwright_plane.arcfit import fit, fit_all
from mechwright_plane.offsets import SPARE, grow, pieces, rings
from mechwright_plane.path import Path, arc, circle, line, polyline
from mechwright_plane.runs import GREATEST_RADIUS, LONGEST_TURN


def wavy(n, teeth, depth, radius=40.0):
    t = np.linspace(0, math.tau, n + 1)
    r = radius + depth * np.sin(teeth * t)
    points = np.column_stack((r * np.cos(t), r * np.sin(t)))
    points[-1] = points[0]
    return points


def distance(points, path):
    """Hausdorff distance of a polyline and a path."""
    return shapely.hausdorff_distance(shapely.LineString(points), shapely.LineString(path.points(0.05)))


def sound(path):
    """Every arc meets both ends with one radius, is no full turn, and its length is that of its sweep."""
    here = path.start
    for cut in path.cuts:
        assert (cut.x, cut.y) != here
        assert (round(cut.x, 4), round(cut.y, 4)) == (cut.x, cut.y)
        if cut.turn:
            one = math.dist(here, (round(cut.cx, 4), round(cut.cy, 4)))
            two = math.dist((cut.x, cut.y), (round(cut.cx, 4), round(cut.cy, 4)))
            assert abs(one - two) < 0.002
            assert cut.length < 1.05 * math.pi * one
            assert one <= GREATEST_RADIUS * 1.01
        here = (cut.x, cut.y)


@settings(max_examples=20, deadline=None)
@given(teeth=st.integers(3, 16), depth=st.floats(0.01, 0.4), tolerance=st.sampled_from([0.0005, 0.002, 0.01]))
def test_fit_stays_within_its_tolerance(teeth, depth, tolerance):
    points = wavy(2000, teeth, depth, 8.0)
    path = fit(points, tolerance)
    sound(path)
    assert path.closed
    assert distance(points, path) <= tolerance + 0.0004
    assert len(path.cuts) < len(points) / 4


def chain(pieces, step=0.05):
    """Points of a line (length, 0) or arc (length, radius) after the other, each tangent to the one before."""
    place, heading, points = 0j, 0.0, [np.zeros(1, dtype=complex)]
    for length, radius in pieces:
        way = np.linspace(0, length, math.ceil(length / step) + 1)[1:]
        ahead = np.exp(1j * heading)
        if radius:
            points.append(place + radius / 1j * (np.exp(1j * (heading + way / radius)) - ahead))
            heading += length / radius
        else:
            points.append(place + way * ahead)
        place = points[-1][-1]
    every = np.concatenate(points)
    return np.column_stack((every.real, every.imag))


PIECES = st.lists(
    st.tuples(st.floats(1.0, 12.0), st.sampled_from([0.0, 3.0, -4.0, 6.5, -9.0, 40.0])),
    min_size=1,
    max_size=8,
)


@settings(max_examples=60, deadline=None)
@given(pieces=PIECES, tolerance=st.sampled_from([0.0014, 0.004, 0.01]))
def test_fit_has_no_more_moves_than_the_drawing(pieces, tolerance):
    points = chain(pieces)
    path = fit(points, tolerance)
    sound(path)
    assert distance(points, path) <= tolerance + 0.0004
    # A chord of the points stands off an arc of the drawing by step²/8r, which is within all tolerances.
    most = sum(math.ceil(length / abs(radius) / LONGEST_TURN) if radius else 1 for length, radius in pieces)
    assert len(path.cuts) <= most


@pytest.mark.parametrize("tolerance", [0.0014, 0.004])
def test_fit_of_a_smooth_curve_comes_near_to_the_fewest_arcs(tolerance):
    # Arcs that meet on a curve whose curvature changes by c per mm reach (125 t / c)^(1/3) mm each.
    t = np.linspace(0, 40, 4001)
    heading = 0.02 * t**2 / 2  # a clothoid of c = 0.02
    step = np.diff(t)[:, None] * np.column_stack((np.cos(heading[:-1]), np.sin(heading[:-1])))
    points = np.vstack(([[0.0, 0.0]], np.cumsum(step, axis=0)))
    path = fit(points, tolerance)
    assert distance(points, path) <= tolerance + 0.0004
    assert len(path.cuts) <= 40 / (125 * tolerance / 0.02) ** (1 / 3) * 1.1 + 1


def test_a_line_of_the_drawing_stays_one():
    box = shapely.box(-20, -10, 20, 10).buffer(5, quad_segs=60)
    path = fit(shapely.get_coordinates(box.exterior), 0.0014)
    lines = [cut for cut in path.cuts if not cut.turn]
    assert len(path.cuts) <= 9  # one of the four sides may be met in its middle
    assert sorted({round(abs(c), 3) for cut in lines for c in (cut.x, cut.y)}) == [10, 15, 20, 25]
    assert all(abs(math.hypot(cut.cx, cut.cy) - math.hypot(20, 10)) < 1e-3 for cut in path.cuts if cut.turn)


def test_corners_near_a_bend_cost_no_line():
    # Two fine arcs that meet in a corner are two moves, however short the edges are beside it.
    one = chain([(4.0, 6.5)], 0.02)
    turned = one[::-1] * (1.0, -1.0)
    points = np.concatenate((one, turned[1:] - turned[0] + one[-1]))
    assert [cut.turn for cut in fit(points, 0.0014).cuts] in ([1, 1], [1, -1])


def test_lines_that_go_on_straight_are_one():
    along = np.array([(0, 0), (3, 0), (3.5, 1e-5), (10, 0), (10, 4), (10, 9)], dtype=float)
    assert [(cut.x, cut.y) for cut in fit(along, 1e-6).cuts] == [(10, 0), (10, 9)]
    there_and_back = np.array([(0, 0), (8, 0), (8, 0.0), (2, 0), (0, 0)], dtype=float)
    assert [cut.x for cut in fit(there_and_back, 1e-6).cuts] == [8, 0]


@pytest.mark.parametrize("way", [1, -1])
def test_the_round_end_of_a_slot_turns_the_right_way(way):
    # Half a turn of few corners between two straight walls: one arc would be written either way.
    for corners in range(6, 40):
        for turn in (3.0, 3.1, 3.14, math.pi, 3.2):
            t = np.linspace(-turn / 2, turn / 2, corners)
            end = np.column_stack((10 + 0.74 * np.cos(t), 0.74 * np.sin(t)))
            points = np.vstack(([(0, end[0, 1])], end, [(0, end[-1, 1])]))[::way]
            path = fit(points, 0.01)
            sound(path)
            assert distance(points, path) < 0.02
            assert {cut.turn for cut in path.cuts if cut.turn} <= {way}


def test_a_slow_bend_is_not_straightened():
    # Every vertex is nearly on the line of its neighbours, and the whole is far from straight.
    x = np.linspace(0, 100, 4001)
    bend = np.column_stack((x, x**2 / 20000))
    path = fit(bend, 0.0005)
    assert distance(bend, path) <= 0.0005 + 0.0004


def test_fit_of_a_circle_is_a_few_arcs_of_its_radius():
    points = wavy(500, 1, 0.0)
    path = fit(points, 0.002)
    assert len(path.cuts) <= 4
    assert all(cut.turn == 1 for cut in path.cuts)
    assert path.length == pytest.approx(80 * math.pi, abs=1e-2)
    assert all(cut.turn == -1 for cut in fit(points[::-1], 0.002).cuts)


def test_fit_keeps_corners_and_lines():
    square = np.array([[0, 0], [10, 0], [10, 10], [0, 10], [0, 0]], float)
    path = fit(square, 0.002)
    assert [cut.turn for cut in path.cuts] == [0, 0, 0, 0]
    assert path.length == 40


def test_a_long_line_into_a_fine_arc_stays_a_line():
    t = np.linspace(-math.pi / 2, math.pi / 2, 200)
    points = np.concatenate(
        ([[-30.0, -5.0]], np.column_stack((5 * np.cos(t), 5 * np.sin(t))), [[-30.0, 5.0]])
    )
    path = fit(points, 0.002)
    assert path.cuts[0].turn == path.cuts[-1].turn == 0
    assert distance(points, path) < 0.0025


def test_fit_all_is_fit_of_each():
    lines = [wavy(600, 5, 0.4), wavy(90, 3, 0.1, 4.0)[:40], np.array([[0.0, 0.0], [1.0, 1.0]])]
    assert fit_all(lines, 0.002) == [fit(points, 0.002) for points in lines]
    assert fit_all([], 0.002) == []


def test_an_arc_that_rounding_would_close_is_a_line():
    assert arc((1.0, 0.0), (1.0, 0.0001), (0.0, 0.0), 1).turn == 0
    assert arc((1.0, 0.0), (0.0, 1.0), (0.0, 0.0), 1).length == pytest.approx(math.pi / 2)
    assert arc((1.0, 0.0), (0.0, 1.0), (0.0, 0.0), -1).length == pytest.approx(1.5 * math.pi)


@settings(max_examples=30, deadline=None)
@given(at=st.floats(0.0, 40.0))
def test_split_and_reverse_keep_the_way(at):
    path = fit(wavy(700, 4, 0.5, 6.0), 0.002)
    before, after = path.split(at)
    assert before.end == after.start
    assert before.length + after.length == pytest.approx(path.length, abs=1e-3)
    assert before.length == pytest.approx(min(at, path.length), abs=1e-3)
    turned = after + before if after.cuts else path
    assert turned.closed
    sound(turned)
    back = path.reversed()
    assert back.start == path.end
    assert back.length == pytest.approx(path.length)
    assert distance(path.points(0.05), back) < 1e-3


def test_paths_that_do_not_meet_cannot_be_joined():
    with pytest.raises(ValueError, match="do not meet"):
        polyline([(0, 0), (1, 0)]) + polyline([(2, 0), (3, 0)])
    joined = polyline([(0, 0), (1, 0)]) + Path((1.0, 0.0), (line((1.0, 0.0), (1.0, 2.0)),))
    assert joined.length == 3


def test_circle_comes_back_to_its_start():
    path = circle((1.0, 2.0), 3.0, (4.0, 2.0), ccw=False)
    assert path.closed
    assert path.length == pytest.approx(6 * math.pi)
    assert all(cut.turn == -1 for cut in path.cuts)


def test_rings_have_the_wall_on_the_right_when_climbing():
    frame = shapely.box(0, 0, 20, 20).difference(shapely.box(5, 5, 15, 15))
    for climb in (True, False):
        outer, inner = rings(grow(frame, 1.0), climb)
        assert bool(shapely.is_ccw(shapely.LinearRing(outer))) is not climb
        assert bool(shapely.is_ccw(shapely.LinearRing(inner))) is climb


@pytest.mark.parametrize("seam", [0, 7, 30])
def test_a_run_goes_one_vertex_on_at_either_end_and_to_the_edge_of_its_room(seam):
    """Of a ring of 40 vertices 5 to 9 are near something and 7 is to be cut; the room may end in between."""
    turn = np.linspace(0, math.tau, 41)
    ring = 10 * np.column_stack((np.cos(turn), np.sin(turn)))

    wide, at = shapely.box(-11, -11, 11, 11), (np.arange(41) + seam) % 40

    def run(room, *around, wanted=7):
        near = (at >= 5) & (at <= 9)
        (one,) = pieces(ring[at], at == wanted, near, room, 3, around)
        assert one.order == 3
        assert not one.closed
        return one.points

    for wanted in (5, 7, 9):
        np.testing.assert_allclose(run(wide, wanted=wanted), ring[4:11])
    for wanted, near in ((4, at == 5), (10, at == 9), (3, at > 40)):
        assert pieces(ring[at], at == wanted, near, wide, 3) == []
    (whole,) = pieces(ring[at], at == 7, at >= 0, wide, 3)
    assert whole.closed
    np.testing.assert_array_equal(whole.points, ring[at])
    assert pieces(ring[at], at > 40, at >= 0, wide, 3) == []
    # A room that ends half way from vertex 9 to the next: a thousandth of the edge is exact enough.
    edge = (ring[9, 1] + ring[10, 1]) / 2
    ended = run(shapely.box(-11, -11, 11, edge))
    np.testing.assert_allclose(ended[:-1], ring[4:10])
    np.testing.assert_allclose(ended[-1], (ring[9] + ring[10]) / 2, atol=1e-3)
    assert ended[-1, 1] <= edge
    begun = run(shapely.box(-11, (ring[4, 1] + ring[5, 1]) / 2, 11, 11))
    np.testing.assert_allclose(begun[1:], ring[5:11])
    np.testing.assert_allclose(begun[0], (ring[4] + ring[5]) / 2, atol=1e-3)
    # With a shape around, the run ends 0.02 mm behind its edge.
    disc = shapely.box(-11, (ring[4, 1] + ring[5, 1]) / 2, 11, edge)
    both = run(wide, disc)
    np.testing.assert_allclose(both[1:-1], ring[5:10])
    for end, (a, b) in ((both[0], ring[[5, 4]]), (both[-1], ring[[9, 10]])):
        along = (b - a) / math.dist(a, b)
        np.testing.assert_allclose(end, (a + b) / 2 + SPARE * along, atol=1e-3)


@given(radius=st.floats(0.1, 20.0))
def test_growing_a_point_is_within_the_chord_error(radius):
    disc = grow(shapely.Point(0, 0), radius, 0.0003)
    inner = np.hypot(*shapely.get_coordinates(shapely.segmentize(disc, radius / 500)).T).min()
    assert radius - 0.00032 <= inner <= radius


reaches = st.lists(st.tuples(st.integers(1, 4), st.integers(0, 4)), min_size=1, max_size=9)


@given(reaches, st.sampled_from([1, 2, 3]))
def test_a_way_is_divided_into_the_fewest_runs_and_goes_on_along_an_arc_where_two_are_as_few(reach, per_arc):
    """How far a line goes from each vertex, and an arc, at least as far; against every choice there is."""
    last = len(reach)
    by_line = [min(here + line, last) for here, (line, _) in enumerate(reach)] + [last]
    by_arc = [min(here + line + more, last) for here, (line, more) in enumerate(reach)] + [last]

    def least(here):
        """Of all ways on from a vertex the least in lines, and whether an arc is first."""
        if here == last:
            return 0, False
        by = 1 + least(by_line[here])[0], per_arc + least(by_arc[here])[0]
        return (by[0], False) if by_line[here] == by_arc[here] or by[0] < by[1] else (by[1], True)

    nodes, lines = runs._chain(np.array(by_line), np.array(by_arc), per_arc)
    assert (nodes[0], nodes[-1]) == (0, last)
    assert sum(1 if straight else per_arc for straight in lines) == least(0)[0]
    for (here, there), straight in zip(pairwise(nodes.tolist()), lines.tolist(), strict=True):
        assert straight != least(here)[1]
        assert there == (by_line if straight else by_arc)[here]
