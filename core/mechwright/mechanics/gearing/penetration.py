"""How deep points stand in an outline: the distance from its nearest edge, and their side of it."""

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.gearing.candidates import Ints
from mechwright.tolerances import TOLERANCES


def depths(points: Array, group: Ints, starts: Array, ends: Array, edge_group: Ints) -> Array:
    """Distance (n,), mm, of points from the outline's nearest edge: positive in material, negative outside.

    Parameters
    ----------
    points
        (n, 2), mm.
    group, edge_group
        Groups (n,) and (m,); points and edges meet only within their group. -inf for a point without edges.
    starts, ends
        End points (m, 2), mm, of edges of a counter-clockwise outline: material lies on their left.

    Examples
    --------
    >>> corners = np.array([[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [0.0, 2.0]])
    >>> points, one = np.array([[1.0, 0.5], [5.0, -1.0]]), np.zeros(2, dtype=np.int64)
    >>> ends, four = np.roll(corners, -1, axis=0), np.zeros(4, dtype=np.int64)
    >>> depths(points, one, corners, ends, four).round(3).tolist()
    [0.5, -1.414]
    """
    result = np.full(len(points), -np.inf)
    for number in np.unique(group):
        own, edges = np.flatnonzero(group == number), np.flatnonzero(edge_group == number)
        if edges.size:
            result[own] = _signed(points[own], starts[edges], ends[edges])
    return result


def _signed(points: Array, starts: Array, ends: Array) -> Array:
    along = ends - starts
    square = (along * along).sum(axis=1)
    # Along and across each edge: a point's place in the edge's own frame.
    length = np.sqrt(square)
    (c, s), (x, y) = along.T / length, points.T[..., None]
    u = c * x + s * y - (c * starts[:, 0] + s * starts[:, 1])
    left = c * y - s * x - (c * starts[:, 1] - s * starts[:, 0])
    beyond = np.maximum(np.maximum(u - length, -u), 0.0)
    distance = np.sqrt(beyond * beyond + left * left)
    # Where two edges are equally near, the point is nearest to their corner: it lies on the side of the one
    # whose line is farther from it.
    least = distance.min(axis=1, keepdims=True)
    edge = np.where(distance <= least + TOLERANCES.noise, np.abs(left), -1.0).argmax(axis=1)
    signed: Array = np.copysign(least[:, 0], left[np.arange(len(points)), edge])
    return signed
