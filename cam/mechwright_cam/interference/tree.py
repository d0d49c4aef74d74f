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

import numpy as np

from mechwright.motion import Array

_MORTON_BITS = 16
"""Bits per axis of the order along a space-filling curve: 65,000 steps across a body."""


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
    """

    points: Array
    ball: float
    centre: Array
    radius: Array
    leaves: int

    @classmethod
    def of(cls, points: Array, ball: float = 0.0) -> "Tree":
        """Build the tree of some pieces (m, k, d), mm, in the order in which they are given."""
        m, k, d = points.shape
        leaves = 1 << max(m - 1, 0).bit_length()
        centre = np.zeros((2 * leaves, d))
        radius = np.full(2 * leaves, -np.inf)
        # The last piece stands for those that are missing, and changes no sphere.
        filled = np.concatenate((points, np.repeat(points[-1:], leaves - m, axis=0)))
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
        return cls(points, ball, centre, radius, leaves)


def ring_edges(points: Array) -> Array:
    """The edges (n, 2, 2) of a closed polygon (n, 2), mm."""
    return np.stack((points, np.roll(points, -1, axis=0)), axis=1)


def along_curve(pieces: Array) -> Array:
    """Pieces (m, k, 3) in the order of a space-filling curve, so that neighbours are near each other."""
    centre = pieces.mean(axis=1)
    low, size = centre.min(axis=0), max(float(np.ptp(centre, axis=0).max()), 1e-9)
    cell = ((centre - low) / size * (2**_MORTON_BITS - 1)).astype(np.int64)
    key = np.zeros(len(pieces), dtype=np.int64)
    for bit in range(_MORTON_BITS):
        for axis in range(3):
            key |= ((cell[:, axis] >> bit) & 1) << (3 * bit + axis)
    ordered: Array = pieces[np.argsort(key, kind="stable")]
    return ordered
