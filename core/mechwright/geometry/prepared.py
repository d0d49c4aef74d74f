"""Shapes that are asked many questions."""

from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array

BLOCK = 16
"""Points along the side of a square that is asked for as a whole first: only where the boundary goes through
one, its points are asked one by one."""


def prepared(shape: Any) -> Any:
    """A copy of a shape, prepared for many questions.

    A prepared shape builds indices while it is asked, and threads that ask the same one at once spoil them:
    so what is prepared is never what others may hold.
    """
    own = shapely.force_2d(shape)
    shapely.prepare(own)
    return own


def gridded(shape: shapely.Geometry, x: Array, y: Array) -> NDArray[np.bool_]:
    """Whether each point of a grid lies within polygons, (m, n).

    Parameters
    ----------
    shape
        Polygons, mm.
    x, y
        (n,) and (m,), rising, mm.

    >>> gridded(shapely.box(0, 0, 2, 1), np.array([-1.0, 1.0]), np.array([0.5, 3.0])).tolist()
    [[False, True], [False, False]]
    """
    own = prepared(shape)
    (west, east), (south, north) = _ends(x), _ends(y)
    blocks = shapely.box(west, south[:, None], east, north[:, None])
    whole = shapely.contains_properly(own, blocks)
    inside = _spread(whole, y.size, x.size)
    rows, columns = np.nonzero(_spread(shapely.intersects(own, blocks) & ~whole, y.size, x.size))
    inside[rows, columns] = shapely.contains_xy(own, x[columns], y[rows])
    return inside


def _ends(at: Array) -> tuple[Array, Array]:
    """Lower and upper ends of the blocks, which reach somewhat over their points."""
    first = np.arange(0, at.size, BLOCK)
    over = float(np.diff(at).min(initial=1.0)) / 4
    return at[first] - over, at[np.minimum(first + BLOCK, at.size) - 1] + over


def _spread(blocks: NDArray[np.bool_], rows: int, columns: int) -> NDArray[np.bool_]:
    """What is said of blocks, of their points."""
    return np.repeat(np.repeat(blocks, BLOCK, axis=0), BLOCK, axis=1)[:rows, :columns]
