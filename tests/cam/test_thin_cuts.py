"""Rest roughing is fed faster where chips are thin, and nowhere else."""

import math

import pytest
import shapely
from by_control import posted, prove
from planning_parts import bore, job, lobes, part

from mechwright_cam.operations.pen import AIR
from mechwright_cam.operations.thin_cuts import stretches
from mechwright_cam.plane.path import polyline
from mechwright_cam.planning import plan
from mechwright_cam.program.moves import Feed, FeedArc

RADIUS = 1.5
LINE = polyline([(0.0, 0.0), (20.0, 0.0)])


def beside(width, start=-50.0):
    """Stock of which the cutter takes so much on its right side, mm, from a place on."""
    return shapely.box(start, -50, 50, width - RADIUS)


@pytest.mark.parametrize(("degrees", "thin"), [(0, True), (15, True), (25, True), (35, False), (90, False)])
def test_chips_are_thin_up_to_half_a_right_angle_s_sine(degrees, thin):
    """Width of cut r (1 - cos φ): chips of sin φ feeds per tooth."""
    width = RADIUS * (1 - math.cos(math.radians(degrees)))
    (parts,) = stretches([LINE], beside(width), RADIUS)
    assert [one for _, one in parts] == [thin]
    assert parts[0][0] == LINE


def test_a_path_is_divided_where_its_cut_becomes_thick():
    stock = beside(0.1).union(beside(RADIUS, 10.0))
    (parts,) = stretches([LINE], stock, RADIUS)
    (first, thin), (second, thick) = parts
    assert (thin, thick) == (True, False)
    assert first + second == LINE or (first.start, second.end) == (LINE.start, LINE.end)
    assert first.end == second.start
    # The rim comes to the thick stock a radius before the centre does.
    assert 10 - 2 * RADIUS < first.end[0] <= 10 - RADIUS * math.cos(math.radians(30)) + 1e-6


def test_what_a_path_took_is_no_stock_for_the_next():
    back = LINE.reversed()
    first, second = stretches([LINE, back], beside(RADIUS), RADIUS)
    assert [one for _, one in first] == [False]
    assert [one for _, one in second] == [True]


def rests(of):
    every = [o for s in plan(of).sections for o in s.operations if o.name.endswith("rough the rest")]
    return [
        m for o in every for m in o.moves if isinstance(m, Feed | FeedArc) and m.x is not None and m.z is None
    ]


def test_gaps_between_teeth_are_left_faster_than_entered():
    toothed = part(lobes(9, 15.0, 4.0, 900, 1.5), bore(8))
    of = job(toothed, "mill-8", "mill-3")
    slow = min(move.feed for move in rests(of))
    assert all(m.feed == pytest.approx(slow) or m.feed == pytest.approx(AIR * slow) for m in rests(of))
    fast = sum(move.feed > slow for move in rests(of))
    plain = rests(job(toothed, "mill-8", "mill-3", chip_thinning=False))
    assert fast > sum(move.feed > slow for move in plain) > 0
    prove(posted(of), of).require()
