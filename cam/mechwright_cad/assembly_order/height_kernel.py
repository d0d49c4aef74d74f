"""Compiled: least and greatest heights of triangles in each place of a grid."""

import math

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.mechanics.compiled import compiled


@compiled
def rasterize(
    corners: Array,
    counts: NDArray[np.int64],
    cell: float,
    first: NDArray[np.int64],
    least: Array,
    most: Array,
) -> None:
    """Enter triangles (k, 3, 3) into ``least`` and ``most`` (nx, ny), whose first place is ``first`` (2,).

    A triangle is looked at in rows parallel to the side from its first to its second corner.
    ``counts`` (k, 2) are steps along a row, and from row to row. Lengths in mm.
    """
    for k in range(len(corners)):
        columns, rows = counts[k, 0], counts[k, 1]
        for row in range(rows + 1):
            t = row / rows
            for column in range(columns + 1):
                s = column / columns
                a, b = (1 - s) * (1 - t), s * (1 - t)
                x = a * corners[k, 0, 0] + b * corners[k, 1, 0] + t * corners[k, 2, 0]
                y = a * corners[k, 0, 1] + b * corners[k, 1, 1] + t * corners[k, 2, 1]
                z = a * corners[k, 0, 2] + b * corners[k, 1, 2] + t * corners[k, 2, 2]
                i = math.floor(x / cell) - first[0]
                j = math.floor(y / cell) - first[1]
                least[i, j] = min(least[i, j], z)
                most[i, j] = max(most[i, j], z)
