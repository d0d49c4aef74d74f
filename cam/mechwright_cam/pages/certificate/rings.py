"""Rings of polygons as lines and arcs, in µm.

Glossary
--------
node
    Where a piece of a ring ends: ``[x, y]`` of a line, ``[x, y, cx, cy, turn]`` of an arc about (cx, cy);
    turn is 1 counter-clockwise and -1 clockwise.
"""

from itertools import pairwise
from typing import Any

import numpy as np
import shapely

from mechwright.arrays import Array

MICRONS = 1000.0
NOISE = 1e-6
"""Corners of chords lie so near to their arc, mm; the centre of a circle through three of them is off by
more, as the square of its radius over a chord's length."""
FITS = 1e-4
"""Corners of an arc lie so near to it, mm: a fifth of a chord's own error."""
LEAST = 4
"""Corners with one circle that make an arc; fewer are lines."""
FLATTEST = 1e4
"""Arcs of a larger radius are lines, mm: their centres are not certain."""
SHARPEST = 0.5
"""Cosine of the turn at a corner, below which it is no chord of an arc."""


def rings(shape: Any) -> list[list[list[float]]]:
    """Each ring of a shape by its nodes, outer rings counter-clockwise and holes clockwise.

    Examples
    --------
    >>> rings(shapely.box(0, 0, 2, 1))
    [[[0.0, 0.0], [2000.0, 0.0], [2000.0, 1000.0], [0.0, 1000.0]]]
    >>> [len(ring) for ring in rings(shapely.Point(0, 0).buffer(5, quad_segs=90))]
    [2]
    """
    oriented = shapely.orient_polygons(shapely.normalize(shape))
    found = shapely.get_rings(shapely.get_parts(oriented))
    return [_nodes(shapely.get_coordinates(ring)[:-1]) for ring in found.tolist() if ring.length > 0]


def _nodes(points: Array) -> list[list[float]]:
    """The nodes of a ring of corners (n, 2), mm."""
    count = len(points)
    before, after = np.roll(points, 1, axis=0), np.roll(points, -1, axis=0)
    centre, turn = _circles(before, points, after)
    # A corner goes on with the circle of the one before it.
    chord = np.hypot(*(points - before).T)
    slack = NOISE * (np.hypot(*(centre - points).T) / chord) ** 2
    same = np.hypot(*(centre - np.roll(centre, 1, axis=0)).T) < slack + np.roll(slack, 1)
    same &= (turn != 0) & (turn == np.roll(turn, 1))
    if same.all():  # a whole circle, as two halves
        middle = _middle(points)
        if middle is not None:
            return [_node(points[count // 2], middle, turn[0]), _node(points[0], middle, turn[0])]
        same[0] = False
    start = int(np.flatnonzero(~same)[0])
    order = np.roll(np.arange(count), -start)
    points, turn, same = points[order], turn[order], same[order]
    starts = np.flatnonzero(~same).tolist()
    nodes: list[list[float]] = []
    for first, last in pairwise([*starts, count]):
        # These corners have one circle, which goes on to the corners on either side of them.
        middle = None
        if last - first >= LEAST:
            middle = _middle(points[np.arange(first - 1, last + 1) % count])
        if middle is None:
            nodes += [_node(one) for one in points[first:last]]
        else:
            nodes += [_node(points[first - 1]), _node(points[last % count], middle, turn[first])]
    return [node for node, one in zip(nodes, [nodes[-1], *nodes], strict=False) if node[:2] != one[:2]]


def _middle(points: Array) -> Array | None:
    """The centre of the circle that corners (n, 2) lie on; None if they do not."""
    near = points - points.mean(axis=0)
    table = np.column_stack((2 * near, np.ones(len(near))))
    x, y, _ = np.linalg.lstsq(table, (near**2).sum(axis=1), rcond=None)[0]
    away = np.hypot(near[:, 0] - x, near[:, 1] - y)
    return points.mean(axis=0) + np.array((x, y)) if np.ptp(away) < FITS else None


def _circles(a: Array, b: Array, c: Array) -> tuple[Array, Array]:
    """Centre (n, 2) of the circle through three corners each, and its turn; 0 where there is none."""
    u, v = b - a, c - b
    cross = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    dot = (u * v).sum(axis=1)
    lengths = np.hypot(*u.T) * np.hypot(*v.T)
    w = c - a
    scale = np.where(cross == 0, 1.0, 2 * cross)
    squares = (u**2).sum(axis=1), (w**2).sum(axis=1)
    offset = np.column_stack(
        (w[:, 1] * squares[0] - u[:, 1] * squares[1], u[:, 0] * squares[1] - w[:, 0] * squares[0])
    )
    offset /= scale[:, None]
    round_ = (cross != 0) & (dot > SHARPEST * lengths) & (np.hypot(*offset.T) < FLATTEST)
    return a + offset, np.where(round_, np.sign(cross), 0.0)


def _node(point: Array, centre: Array | None = None, turn: float = 0.0) -> list[float]:
    x, y = (np.round(point * MICRONS, 1) + 0.0).tolist()  # no zero has a sign
    if centre is None:
        return [x, y]
    return [x, y, *(np.round(centre * MICRONS, 2) + 0.0).tolist(), int(turn)]
