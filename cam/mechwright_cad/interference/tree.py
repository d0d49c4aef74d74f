"""Bounding spheres over the pieces of a boundary, in a binary tree.

Glossary
--------
piece
    What a boundary is made of: an edge in the plane, a triangle in space, or a ball that moves as a whole.
node
    A run of pieces. The root is number 1, the children of node i are 2 i and 2 i + 1, and the nodes from
    ``leaves`` on are single pieces.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mechwright.arrays import Array
from mechwright_cad.interference.boxes import Boxes

_TURN = 0.1
"""What a difference of normals counts, in sizes of the body: a quarter turn as a seventh of the whole."""


@dataclass(frozen=True)
class Tree:
    """A boundary and its spheres.

    Parameters
    ----------
    points
        (m, k, d) mm: the corners of each piece; neighbours in the list are near each other.
    ball
        Radius of the balls around the points, mm; 0 for edges and triangles.
    centre, radius
        (2 p, d) and (2 p,): the spheres of the nodes, mm; what is no node has the radius -inf.
    leaves
        p, the number of the first leaf.
    boxed
        Whether the nodes have boxes as well.
    """

    points: Array
    ball: float
    centre: Array
    radius: Array
    leaves: int
    boxed: bool = False

    @cached_property
    def box(self) -> Boxes | None:
        """Boxes of the nodes, if there are any; made when they are first asked for."""
        return Boxes.of(_filled(self.points, self.leaves), self.leaves) if self.boxed else None

    @cached_property
    def columns(self) -> Array:
        """The centres with the nodes on the last axis: (d, 2 p)."""
        return np.ascontiguousarray(self.centre.T)

    @cached_property
    def corners(self) -> Array:
        """The corners with the pieces on the last axis: (k, d, m)."""
        return np.ascontiguousarray(self.points.transpose(1, 2, 0))

    @cached_property
    def reach(self) -> Array:
        """Distance (m,) of the furthest corner of each piece from the origin, mm."""
        far: Array = np.linalg.norm(self.points, axis=2).max(axis=1)
        return far

    @cached_property
    def distances(self) -> dict[tuple[float, ...], tuple[Array, Array]]:
        """Least and greatest distances (m,) of the pieces from points that were asked for, by point."""
        return {}

    @classmethod
    def of(cls, points: Array, ball: float = 0.0, *, boxes: bool = False) -> "Tree":
        """Build the tree of some pieces (m, k, d), mm, in the order in which they are given.

        ``boxes`` adds boxes along the surface to the spheres; they pay in space, where wide surfaces slide
        past each other at a small distance.
        """
        m, k, d = points.shape
        leaves = 1 << max(m - 1, 0).bit_length()
        centre = np.zeros((2 * leaves, d))
        radius = np.full(2 * leaves, -np.inf)
        filled = _filled(points, leaves)
        corners = np.moveaxis(filled, 0, -1)  # (k, d, leaves)
        low, high = corners.min(axis=0), corners.max(axis=0)
        size = 1
        while size <= leaves:
            first = leaves // size
            real = -(-m // size)
            middle = (low + high) / 2
            square = np.zeros((k, leaves))
            for axis in range(d):
                square += (corners[:, axis] - np.repeat(middle[axis], size)) ** 2
            reach = np.sqrt(square.reshape(k, first, size).max(axis=(0, 2))) + ball
            centre[first : first + real] = middle[:, :real].T
            radius[first : first + real] = reach[:real]
            low = np.minimum(low[:, ::2], low[:, 1::2])
            high = np.maximum(high[:, ::2], high[:, 1::2])
            size *= 2
        return cls(points, ball, centre, radius, leaves, boxes)


def _filled(points: Array, leaves: int) -> Array:
    """As many pieces as leaves: the last one stands for those that are missing, and changes no sphere."""
    return np.concatenate((points, np.repeat(points[-1:], leaves - len(points), axis=0)))


def ring_edges(points: Array) -> Array:
    """The edges (n, 2, 2) of a closed polygon (n, 2), mm."""
    return np.stack((points, np.roll(points, -1, axis=0)), axis=1)


def by_place_and_direction(triangles: Array) -> Array:
    """Triangles (m, 3, 3) in an order in which the runs of the tree lie together and look one way.

    A run is divided across the longest spread of its centres and normals, so that nodes become flat pieces of
    surface. The first part takes a power of two of them, as the tree does.
    """
    centre = triangles.mean(axis=1)
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    size = float(np.ptp(triangles.reshape(-1, 3), axis=0).max())
    features = np.column_stack((centre, _TURN * size * normal))
    count = len(triangles)
    run = 1 << max(count - 1, 0).bit_length()
    order = np.arange(run)
    while run > 1:
        # What is not there counts as the last triangle in the spread, and comes last in the order.
        there = order < count
        near = features[np.minimum(order, count - 1)].reshape(-1, run, features.shape[1])
        axis = np.ptp(near, axis=1).argmax(axis=1)
        key = np.take_along_axis(near, axis[:, None, None], axis=2)[:, :, 0]
        key = np.where(there.reshape(-1, run), key, np.inf)
        place = np.argsort(key, axis=1, kind="stable")
        order = np.take_along_axis(order.reshape(-1, run), place, axis=1).ravel()
        run //= 2
    ordered: Array = triangles[order[order < count]]
    return ordered
