"""Arcs between two headings, into round walls and in corners: in line where they meet, and real pieces."""

import math
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mechwright_plane import contour
from mechwright_plane.bends import Bend, biarc
from mechwright_plane.leads import half_circles
from mechwright_plane.path import circle

B = (8.0, 6.0)
AHEAD = math.atan2(6.0, 8.0)
"""Heading from the origin to B, rad."""


def apart(one: float, two: float) -> float:
    """Angle between two headings, rad."""
    return abs(math.remainder(one - two, math.tau))


def checked(one: Bend, two: Bend, start: float, end: float) -> None:
    assert (one.start, two.end) == ((0.0, 0.0), B)
    assert one.end == two.start
    q = one.end
    assert min(math.dist(one.start, q), math.dist(q, B)) > 0.01
    assert apart(one.heading(one.start), start) < 1e-6
    assert apart(two.heading(B), end) < 1e-6
    assert apart(one.heading(q), two.heading(q)) < 1e-6
    # Neither turns back: each is at most half a circle, and both are no longer than an arc would be.
    assert max(one.sweep, two.sweep) < math.pi


angles = st.floats(-1.2, 1.2)


@given(angles, angles)
def test_two_arcs_touch_and_have_the_headings_that_are_asked_for(one: float, two: float) -> None:
    if min(abs(one), abs(two)) < 0.05:
        return
    found = biarc((0.0, 0.0), B, AHEAD + one, AHEAD + two)
    assert found is not None
    checked(*found, AHEAD + one, AHEAD + two)


@pytest.mark.parametrize(("one", "two"), [(0.0, 0.4), (0.0, -0.4), (0.4, 0.0), (-0.4, 0.0)])
def test_one_heading_may_be_that_of_the_chord(one: float, two: float) -> None:
    """To the right along X, where the chord's heading is exactly 0."""
    found = biarc((0.0, 0.0), (10.0, 0.0), one, two)
    assert found is not None
    first, last = found
    assert 1.0 < first.end[0] < 9.0
    assert apart(first.heading((0.0, 0.0)), one) < 1e-6
    assert apart(last.heading((10.0, 0.0)), two) < 1e-6


def test_straight_on_there_are_two_lines() -> None:
    found = biarc((0.0, 0.0), (10.0, 0.0), 0.0, 0.0)
    assert found == (Bend((0.0, 0.0), (5.0, 0.0)), Bend((5.0, 0.0), (10.0, 0.0)))
    assert biarc((1.0, 1.0), (1.0, 1.0), 0.0, 0.0) is None


@pytest.mark.parametrize("climb", [True, False])
def test_a_round_wall_is_come_to_and_left_on_half_circles(climb: bool) -> None:
    """From the middle, half as large as the wall: the same way round, and in line with it where they meet."""
    middle, radius = (3.0, -7.0), 5.0
    turn = circle(middle, radius, (middle[0] + 3.0, middle[1] + 4.0), climb)
    into, off = half_circles(middle, turn)
    assert (into.start, into.end, off.start, off.end) == (middle, turn.start, turn.start, middle)
    for way in (into, off):
        assert way.length == pytest.approx(math.pi * radius / 2, rel=1e-4)
        (cut,) = way.cuts
        assert cut.turn == turn.cuts[0].turn
        assert math.dist((cut.cx, cut.cy), middle) == pytest.approx(radius / 2, abs=2e-4)
        assert math.dist((cut.cx, cut.cy), turn.start) == pytest.approx(radius / 2, abs=2e-4)


@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("before", [0, 1])
def test_every_slight_inside_corner_of_an_open_contour_is_rounded(side: int, before: int) -> None:
    """The first as well as one behind a piece that goes straight on; outside corners stay."""
    start = [Bend((-20.0 * k, 0.0), (-20.0 * (k - 1), 0.0)) for k in range(before, 0, -1)]
    bent = [Bend((0.0, 0.0), (20.0, 0.0)), Bend((20.0, 0.0), (40.0, 0.4 * side))]
    found = contour._filleted([*start, *bent], closed=False, side=side, tolerance=0.002)
    assert len(found) == before + 4
    for one, two in pairwise(found):
        assert one.end == two.start
        assert apart(one.heading(one.end), two.heading(two.start)) < 1e-6
    outside = contour._filleted([*start, *bent], closed=False, side=-side, tolerance=0.002)
    assert outside == [*start, *bent]
