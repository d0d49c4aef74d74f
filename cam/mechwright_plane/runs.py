"""Cut a polyline into the fewest runs that one line or one arc each can follow.

Every vertex looks for the farthest vertex that one line, and that one arc, can reach within the tolerance:
all of them at once, by bisection, with a few samples per trial. The shortest chain of reaches follows from
the end backwards; only its runs are tested everywhere. Where one does not hold, its vertex looks again with
every sample there is, and the chain is made anew.

Glossary
--------
node
    Where one run ends and the next one starts.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.geometry.segments import Point

CORNER = 0.5
"""A turn of more than this at one vertex, rad, is a corner of the path; offset arcs turn by less."""
LONGEST_TURN = 2.2
"""An arc turns by little more than a third of a circle, rad: a circle is three of them, and the round end of
a slot two, none of them a scrap."""
ONE_VERTEX = 1e-6
"""Vertices nearer than this are one, mm."""
STRAIGHT = 1e-9
"""A vertex this near to the line of its neighbours, mm, is none: a line of the drawing is one edge."""
LEAST_LINE = 1.0
"""A shorter edge may be one of a polyline that stands for a curve, mm; a longer one that would be told from
the arcs beside it is a line of the drawing, and stays one."""
LONGEST = 600
"""Edges under one run at most: bounds the search; a longer one comes in two."""
SAMPLES = 12
"""Vertices tested per trial; those of the chosen runs are all tested afterwards."""
FRACTIONS = (1 - np.cos(math.pi * (np.arange(SAMPLES) + 0.5) / SAMPLES))[:, None] / 2
"""Where they stand between both ends: closer to them, for there an arc leaves its band first."""
SURE = 0.98
"""Share of the tolerance for samples: what holds at them then nearly always holds in between."""
BATCH = 1024
"""Runs tested at once: their samples stay in the processor's cache."""
TRIALS = 4
"""Times that chains are made; what does not hold in the last one is cut in two."""
GREATEST_RADIUS = 2000.0
"""A flatter arc, mm, is printed with too few significant digits; it becomes lines."""
ROUNDS = 2
"""Times that the centre of an arc is found, each with the radius of the one before."""
LEAST_HEIGHT = 1e-12
"""Of a point over the chord, mm: one on the chord says nothing about the arc, and must not divide by zero."""
ARC_GUESS, LINE_GUESS = 16, 4
"""Edges of a run to begin with."""

Index = NDArray[np.intp]
Mask = NDArray[np.bool_]
Axes = tuple[Array, ...]
"""x and y apart: rows are taken from them much faster than from pairs."""


@dataclass(frozen=True, eq=False)
class PreparedPolylines:
    """Polylines one after the other, ready to be searched."""

    points: Axes
    """x and y of the vertices, (n,) each, mm."""
    most: Index
    """(n,) the vertex that no run from here may pass: the next corner, or where an arc has turned enough."""
    bounds: Index
    """(k + 1,) where each of the polylines begins, and their end."""


@dataclass(frozen=True, eq=False)
class Runs:
    """Runs of lines and arcs along polylines."""

    nodes: Index
    """(k + 1,) vertices at which they begin and end."""
    straight: Mask
    """(k,) whether a line will do."""
    height: Array
    """(k,) of an arc's centre over the chord, to the left of it, mm."""


def prepared_polylines(polylines: Sequence[Array], tolerance: float) -> PreparedPolylines:
    """Make polylines (n, 2), mm, ready: what does not matter left out, corners found."""
    points = np.concatenate([np.asarray(part, dtype=float) for part in polylines])
    bounds = np.cumsum([0, *map(len, polylines)])
    points, bounds = _without(_doubled(points), points, bounds)
    points, bounds = _without(_on_straights(points) & ~_ends(bounds), points, bounds)
    n, ends = len(points), _ends(bounds)
    edge = np.diff(points, axis=0).T
    heading = np.arctan2(edge[1], edge[0])
    turn = np.zeros(n)
    turn[1:-1] = np.abs((np.diff(heading) + math.pi) % math.tau - math.pi)
    corners = _corners(np.hypot(*edge), turn, ends, tolerance)
    turned = np.cumsum(turn)  # where the way leaves a vertex
    index = np.arange(n)
    found = np.flatnonzero(corners)
    corner = found[np.minimum(np.searchsorted(found, index, side="right"), len(found) - 1)]
    enough = np.searchsorted(turned, turned + LONGEST_TURN)
    axes = points[:, 0].copy(), points[:, 1].copy()
    return PreparedPolylines(
        axes, np.minimum.reduce([index + LONGEST, corner, enough, np.full(n, n - 1)]), bounds
    )


def _ends(bounds: Index) -> Mask:
    """Which vertices are the first or last ones of polylines."""
    ends = np.zeros(bounds[-1], dtype=bool)
    ends[bounds[:-1]] = ends[bounds[1:] - 1] = True
    return ends


def _without(gone: Mask, points: Array, bounds: Index) -> tuple[Array, Index]:
    """Points and bounds of polylines without some of their vertices; the first ones stay."""
    gone[bounds[:-1]] = False
    left = np.append(0, np.cumsum(~gone))
    return points[~gone], left[bounds]


def _doubled(points: Array) -> Mask:
    """Which vertices are where the one before is."""
    step = np.diff(points, axis=0)
    return np.append(False, np.hypot(step[:, 0], step[:, 1]) <= ONE_VERTEX)


def _on_straights(points: Array) -> Mask:
    """Which vertices lie on the line of their neighbours, between them."""
    step = np.diff(points, axis=0)
    before, after, whole = step[:-1], step[1:], points[2:] - points[:-2]
    across = np.abs(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0])
    on = (across <= STRAIGHT * np.hypot(whole[:, 0], whole[:, 1])) & ((before * after).sum(axis=1) >= 0)
    return np.concatenate(([False], on, [False]))


def _corners(step: Array, turn: Array, ends: Mask, tolerance: float) -> Mask:
    """Which vertices are nodes in any case: ends of polylines, their corners, and the ends of long lines.

    From the lengths of edges (n - 1,), mm, and the turns at vertices (n,), rad.
    """
    corners: Mask = (turn > CORNER) | ends
    # The turn at a corner says nothing about the edge beside it.
    bend = np.where(corners, 0.0, turn)
    # An arc over such an edge and on beside it would stand off from it.
    drawn = (step >= LEAST_LINE) & (step * np.maximum(bend[:-1], bend[1:]) / 8 > tolerance)
    corners[:-1] |= drawn
    corners[1:] |= drawn
    return corners


def runs_of(way: PreparedPolylines, tolerance: float, lines_per_arc: int = 1) -> Runs:
    """The fewest runs that are found within ``tolerance``, mm, of every vertex and middle of an edge.

    An arc counts as ``lines_per_arc`` lines.
    """
    index = np.arange(len(way.most))
    by_arc = _reach(way, index, way.most, tolerance)
    by_line = _reach(way, index, by_arc, tolerance, lines=True)
    for _ in range(TRIALS):
        nodes, lines = _chain(by_line, by_arc, lines_per_arc)
        found, bad = _tested(way, nodes, tolerance, lines & (lines_per_arc > 1))
        if not bad.size:
            return found
        place, end = found.nodes[bad], found.nodes[bad + 1]
        most = by_arc[place] - (by_arc[place] == end)
        by_arc[place] = most = _reach(way, place, most, tolerance, everywhere=True)
        most = np.minimum(by_line[place] - (by_line[place] == end), most)
        by_line[place] = _reach(way, place, most, tolerance, lines=True, everywhere=True)
    while bad.size:
        middle = (found.nodes[bad] + found.nodes[bad + 1]) // 2
        nodes = np.insert(found.nodes, bad + 1, middle)
        found, bad = _tested(way, nodes, tolerance, np.zeros(len(nodes) - 1, dtype=np.bool_))
    return found


def over_chord(a: Point, b: Point, height: float) -> Point:
    """The centre of an arc so high over the chord from a to b, to the left of it, mm."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    chord = math.hypot(dx, dy)
    return (a[0] + b[0]) / 2 - height * dy / chord, (a[1] + b[1]) / 2 + height * dx / chord


def _chain(by_line: Index, by_arc: Index, lines_per_arc: int) -> tuple[Index, Mask]:
    """The vertices of a way with the fewest runs, and which of them begin a line.

    Of two as short it is the one whose first run is an arc: a line only where an arc goes no farther, for a
    line into a bend is a corner that the machine feels.
    """
    last, more = len(by_line) - 1, lines_per_arc - 1
    count, follow = [0] * (last + 1), [last] * (last + 1)
    one, two = by_line.tolist(), by_arc.tolist()
    lines = [False] * last
    for here in range(last - 1, -1, -1):
        line, arc = one[here], two[here]
        if line == arc or count[line] < count[arc] + more:
            count[here], follow[here], lines[here] = count[line] + 1, line, True
        else:
            count[here], follow[here] = count[arc] + 1 + more, arc
    nodes = [0]
    while nodes[-1] < last:
        nodes.append(follow[nodes[-1]])
    return np.array(nodes, dtype=np.intp), np.array([lines[node] for node in nodes[:-1]], dtype=np.bool_)


def _tested(way: PreparedPolylines, nodes: Index, tolerance: float, lines: Mask) -> tuple[Runs, Index]:
    """The runs between nodes, and which of them do not hold; some have to be ``lines``."""
    first, last = nodes[:-1], nodes[1:]
    straight, curved, height = shapes(way, first, last, _everywhere(way, first, last), tolerance)
    straight |= last - first == 1
    return Runs(nodes, straight, height), np.flatnonzero(~(straight | (curved & ~lines)))


def _everywhere(way: PreparedPolylines, first: Index, last: Index) -> Axes:
    """Vertices and middles of edges between ``first`` and ``last`` (k,), as columns."""
    # By their position in half edges; the last one fills the column up.
    count = 2 * int((last - first).max(initial=1)) - 1
    here = 2 * first + np.minimum(np.arange(1, count + 1)[:, None], 2 * (last - first) - 1)
    one, two = here // 2, (here + 1) // 2
    return tuple((axis.take(one) + axis.take(two)) / 2 for axis in way.points)


def _reach(
    way: PreparedPolylines,
    place: Index,
    most: Index,
    tolerance: float,
    *,
    lines: bool = False,
    everywhere: bool = False,
) -> Index:
    """The farthest vertex up to ``most`` that an arc, or a line, can reach from each ``place``, (k,)."""
    low = np.minimum(place + 1, len(way.most) - 1)
    high = np.maximum(most, low) + 1
    trial = np.minimum(place + (LINE_GUESS if lines else ARC_GUESS), high - 1)
    open_ = np.flatnonzero(low + 1 < high)
    known = np.zeros(len(place), dtype=bool)
    while open_.size:
        first, other = place[open_], trial[open_]
        good = np.concatenate(
            [
                _holds(way, first[at : at + BATCH], other[at : at + BATCH], tolerance, lines, everywhere)
                for at in range(0, len(first), BATCH)
            ]
        )
        low[open_] = np.where(good, other, low[open_])
        high[open_] = np.where(good, high[open_], other)
        known[open_] |= ~good
        # Twice as far until it is too far, then by halves.
        ahead = np.minimum(2 * low[open_] - first, high[open_] - 1)
        trial[open_] = np.where(known[open_], (low[open_] + high[open_]) // 2, ahead)
        open_ = open_[low[open_] + 1 < high[open_]]
    return low


def _holds(
    way: PreparedPolylines, first: Index, last: Index, tolerance: float, lines: bool, everywhere: bool
) -> Mask:
    """Whether a line, or an arc, from ``first`` to ``last`` (k,) holds."""
    if everywhere:
        inner = _everywhere(way, first, last)
    else:
        tolerance *= SURE
        at = (first + 0.5 + (last - first) * FRACTIONS).astype(np.intp)
        inner = tuple(axis.take(at) for axis in way.points)
    straight, curved, _ = shapes(way, first, last, inner, tolerance, lines=lines)
    return straight | curved


def shapes(
    way: PreparedPolylines,
    first: Index,
    last: Index,
    inner: Axes,
    tolerance: float,
    *,
    lines: bool = False,
) -> tuple[Mask, Mask, Array]:
    """Whether ``inner``, (m, k) each, is near enough to the lines, and to the best arcs, and their heights.

    The arc through both ends has one free number, the height k of its centre over the chord. With u along
    and v across the chord of half length h, the circle is u² + v² - 2kv = h². A point stands off the arc of
    radius r by at most t if its power r' squared - r squared is between t² - 2rt and t² + 2rt, which bounds
    k from both sides; the middle of what all points leave is taken. With ``lines`` no arc is looked for.
    """
    (x0, x1), (y0, y1) = ((axis.take(first), axis.take(last)) for axis in way.points)
    hx, hy = (x1 - x0) / 2, (y1 - y0) / 2
    h = np.hypot(hx, hy)
    scale = 1 / np.where(h > 0, h, 1.0)
    ax, ay = hx * scale, hy * scale
    x, y = inner[0] - (x0 + hx), inner[1] - (y0 + hy)
    v = y * ax
    v -= x * ay
    most, least = v.max(axis=0), v.min(axis=0)
    straight = (np.maximum(most, -least) <= tolerance) & (h > 0)
    if lines:
        return straight, np.zeros_like(straight), h
    x *= x
    y *= y
    power = np.add(x, y, out=x)  # of the circle over the chord as its diameter
    power -= h * h
    # To begin with, as if the arc were as high as the highest point; it is on that side of the chord.
    side = np.where(most > -least, most, least)
    k = (side * side - h * h) / np.where(side != 0, 2 * side, 1.0)
    # Each point wants the centre between two heights. What they agree on hardly depends on the radius.
    v[np.abs(v) < LEAST_HEIGHT] = LEAST_HEIGHT
    share = np.abs(np.divide(tolerance, v, out=y), out=y)
    middle = np.divide(power, 2 * v)
    for _ in range(ROUNDS):
        play = share * np.hypot(h, k)
        k = (np.subtract(middle, play).max(axis=0) + np.add(middle, play, out=play).min(axis=0)) / 2
    # Of more than half a turn the centre is on the side of the arc, and it would be written the other way.
    less_than_half = k * side < 0
    radius = np.hypot(h, k)
    off = np.subtract(power, np.multiply(v, 2 * k, out=y), out=y)
    most, least = tolerance * (tolerance + 2 * radius), tolerance * (tolerance - 2 * radius)
    curved = (off.max(axis=0) <= most) & (off.min(axis=0) >= least)
    return straight, curved & less_than_half & (radius <= GREATEST_RADIUS) & (h > 0), k
