"""The fewest lines and arcs that any path can have within a band around a curve.

A bound that owes nothing to the fit of the program: pieces need not even meet, and each goes as far as the
linear program says that some circle or line stays in the band. Whatever path is taken has as many at least.
"""

import math

import numpy as np
import shapely
from scipy.optimize import linprog

SPACING = 0.02
"""Of the points that ask for the band, mm: fewer of them ask for less, and the bound stays one."""
CORNER, CLEAR = 0.5, 0.03
"""A path may cut a corner of more than 0.5 rad short: its points within 0.03 mm ask for nothing."""
SLACK = 1.01
"""The band is made wider by the second order of distances from a circle, which linear terms leave out."""
ROUNDS = 3


def least_moves(ring: shapely.LinearRing, left: float, right: float) -> int:
    """Lines and arcs at least of a path that stays within ``left`` and ``right`` of a ring, mm each.

    The count begins somewhere, so the true least may be one less where no corner begins a piece.
    """
    points = _asking(ring)
    first, count, last = 0, 0, len(points) - 1
    while first < last:
        low, step = first + 2, 8
        high = low
        while high < last and _fits(points[first : high + 1], left, right):
            low, step = high, 2 * step
            high = min(last, high + step)
        if high == last and _fits(points[first : high + 1], left, right):
            return count + 1
        while high - low > 1:
            middle = (low + high) // 2
            if _fits(points[first : middle + 1], left, right):
                low = middle
            else:
                high = middle
        first, count = low, count + 1
    return count


def _asking(ring):
    corners = shapely.get_coordinates(ring)
    corners = corners[np.append(True, np.hypot(*np.diff(corners, axis=0).T) > 1e-6)]
    heading = np.arctan2(*np.diff(corners, axis=0).T[::-1])
    turn = np.abs((np.diff(heading) + math.pi) % math.tau - math.pi)
    points = shapely.get_coordinates(shapely.segmentize(ring, SPACING))
    sharp = corners[1:-1][turn > CORNER]
    if not len(sharp):
        return points
    return points[shapely.distance(shapely.points(points), shapely.multipoints(sharp)) > CLEAR]


def _fits(points, left, right):
    """Whether some circle or line has all points within ``left`` and ``right`` of it.

    With u along and v across the chord the signed distance from a circle is to the first order
    (a (u² + v²) + b u + v + d) / w, w² = 1 + b² - 4 a d: linear in a, b and d once w is known.
    """
    if len(points) <= 3:
        return True
    chord = points[-1] - points[0]
    length = math.hypot(*chord)
    along = chord / length
    off = points - points.mean(axis=0)
    u, v = off @ along, off @ np.array((-along[1], along[0]))
    terms = np.column_stack(((u * u + v * v) / length, u / length, np.ones_like(u)))
    root = 1.0
    for _ in range(ROUNDS):
        above = np.column_stack((terms, np.full(len(u), -SLACK * right * root)))
        below = np.column_stack((-terms, np.full(len(u), -SLACK * left * root)))
        found = linprog(
            [0, 0, 0, 1],
            A_ub=np.vstack((above, below)),
            b_ub=np.concatenate((-v, v)),
            bounds=[(None, None)] * 3 + [(0, None)],
            method="highs",
        )
        if found.status != 0:
            return False
        a, b, d, share = found.x[0] / length, found.x[1] / length, found.x[2], found.x[3]
        root = math.sqrt(max(1e-9, 1 + b * b - 4 * a * d))
    return share <= 1
