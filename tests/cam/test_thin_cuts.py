"""Rest roughing is fed faster where chips are thin, and nowhere else."""

import math
from itertools import pairwise

import numpy as np
import pytest
import shapely
from by_control import posted, prove
from hypothesis import given
from hypothesis import strategies as st
from planning_parts import bore, job, lobes, part

from mechwright_cam.operations import thin_cuts
from mechwright_cam.operations.pen import AIR
from mechwright_cam.operations.thin_cuts import SHARES, split_by_engagement
from mechwright_cam.planning import plan
from mechwright_cam.program.moves import Feed, FeedArc
from mechwright_plane.path import polyline

RADIUS = 1.5
LINE = polyline([(0.0, 0.0), (20.0, 0.0)])


def beside(width, start=-50.0):
    """Stock of which the cutter takes so much on its right side, mm, from a place on."""
    return shapely.box(start, -50, 50, width - RADIUS)


@pytest.mark.parametrize(
    ("degrees", "share"), [(0, 3.0), (15, 3.0), (25, 2.0), (35, 1.5), (50, 1.25), (90, 1.0)]
)
def test_the_thinner_the_chips_the_faster_the_feed(degrees, share):
    """Width of cut r (1 - cos φ): chips of sin φ feeds per tooth."""
    width = RADIUS * (1 - math.cos(math.radians(degrees)))
    (parts,) = split_by_engagement([LINE], beside(width), RADIUS)
    assert [one for _, one in parts] == [share]
    assert parts[0][0] == LINE


def test_a_path_is_divided_where_its_cut_becomes_thick():
    stock = beside(0.1).union(beside(RADIUS, 10.0))
    (parts,) = split_by_engagement([LINE], stock, RADIUS)
    (first, thin), *_, (last, thick) = parts
    assert (thin, thick) == (2.0, 1.0)
    assert (first.start, last.end) == (LINE.start, LINE.end)
    assert all(one.end == other.start for (one, _), (other, _) in pairwise(parts))
    assert [share for _, share in parts] == sorted((share for _, share in parts), reverse=True)
    # The rim comes to the thick stock a radius before the centre does.
    assert 10 - 2 * RADIUS < first.end[0] <= 10 - RADIUS * math.cos(math.radians(30)) + 1e-6


def test_what_a_path_took_is_no_stock_for_the_next():
    back = LINE.reversed()
    first, second = split_by_engagement([LINE, back], beside(RADIUS), RADIUS)
    assert [one for _, one in first] == [1.0]
    assert [one for _, one in second] == [AIR]


def rests(of):
    every = [o for s in plan(of).sections for o in s.operations if o.name.endswith("rough the rest")]
    return [
        m for o in every for m in o.moves if isinstance(m, Feed | FeedArc) and m.x is not None and m.z is None
    ]


def test_gaps_between_teeth_are_left_faster_than_entered():
    toothed = part(lobes(9, 15.0, 4.0, 900, 1.5), bore(8))
    of = job(toothed, "mill-8", "mill-3")
    slow = min(move.feed for move in rests(of))
    assert {round(m.feed / slow, 2) for m in rests(of)} <= {1.0, *SHARES}
    fast = sum(move.feed > slow for move in rests(of))
    plain = rests(job(toothed, "mill-8", "mill-3", chip_thinning=False))
    assert fast > sum(move.feed > slow for move in plain)
    prove(posted(of), of).require()


def test_a_gap_is_cut_to_and_fro():
    """A level each way, without a way back through the air: every other pass begins where the last one ended."""
    toothed = part(lobes(9, 15.0, 4.0, 900, 1.5), bore(8), thickness=10.0)
    of = job(toothed, "mill-8", "mill-3")
    every = [o for s in plan(of).sections for o in s.operations if o.name == "outside: rough the rest"]
    places, here, levels = [], None, []
    for move in every[0].moves:
        if isinstance(move, Feed) and move.x is None and move.z is not None and move.z < 0:
            levels.append((here, move.z))
        if getattr(move, "x", None) is not None:
            here = move.x, move.y
    for (one, above), (two, below), (three, _) in zip(levels, levels[1:], levels[2:], strict=False):
        if below < above and one == three:
            places.append((one, two))
    assert len(places) >= 9
    assert all(one != two for one, two in places)


@given(st.lists(st.tuples(st.integers(1, 5), st.sampled_from([1.0, 1.5, 2.0, 3.0])), min_size=1, max_size=7))
def test_an_edge_is_fed_faster_if_the_one_before_or_behind_is_as_thin(edges) -> None:
    """Against each edge for itself; a way of two edges has no more than the thicker of both."""
    ways, shares = ([float(way) for way, _ in edges], [share for _, share in edges])
    ends = np.cumsum(ways)
    whole = polyline([(0.0, 0.0), *((float(x), 0.0) for x in ends)])
    found = thin_cuts._divided(whole, ends, np.array(shares))
    assert sum(piece.length for piece, _ in found) == pytest.approx(ends[-1])
    told, done = [], 0.0
    for piece, share in found:
        done += piece.length
        told += [share] * int(np.sum(ends <= done + 1e-6) - len(told))
    pairs = [min(one, two) for one, two in pairwise(shares)] or shares
    first, last = [pairs[0], *pairs], [*pairs, pairs[-1]]
    wanted = [max(a, b) for a, b in zip(first, last, strict=True)] if len(shares) > 1 else shares
    assert told == wanted
