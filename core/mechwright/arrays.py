"""Arrays of numbers."""

import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

GRID = 2.0**-24
"""mm, some 6e-8: the grid of places that decide what is computed from them. Last digits of sines, sums and
solved equations differ from processor to processor by some 1e-13 mm; on the grid they are the same, but for
one place in a million. A power of two is exact."""
_FACTORS = np.uint64(0xBF58476D1CE4E5B9), np.uint64(0x94D049BB133111EB)
_SHIFTS = np.uint64(30), np.uint64(27)
"""Those of the mixing function of SplitMix64 (Steele, Lea, Flood: Fast splittable pseudorandom number
generators, 2014): each bit of a number goes into all bits of the mixed one. A weighted sum would not do:
coordinates of a program are multiples of its last decimal, and a little more of one is often as much less of
another."""


def on_grid(places: Array) -> Array:
    """Places, mm, at the nearest points of :data:`GRID`.

    >>> float(on_grid(np.array(0.1 + 1e-13))) == float(on_grid(np.array(0.1)))
    True
    """
    found: Array = np.rint(places / GRID) * GRID
    return found


def turned(points: Array, angle: float) -> Array:
    """Points (..., 2) turned about the origin, counter-clockwise, by an angle, rad.

    By sums in order: a product of matrices has the last digits of the processor's kernel.

    >>> turned(np.array([[2.0, 0.0]]), np.pi / 2).round(12).tolist()
    [[0.0, 2.0]]
    """
    c, s = math.cos(angle), math.sin(angle)
    x, y = points[..., 0], points[..., 1]
    return np.stack((x * c - y * s, x * s + y * c), axis=-1)


def first_of_each(rows: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Index (k,) of the first of each kind of row (n, m), and the kind (n,) of every row.

    Examples
    --------
    >>> first, kind = first_of_each(np.array([[7, 1], [5, 2], [7, 1]]))
    >>> sorted(first.tolist()), bool(kind[0] == kind[2] != kind[1])
    ([0, 1], True)
    """
    keys = np.zeros(len(rows), dtype=np.uint64)
    for column in rows.T.astype(np.uint64):
        keys += column
        for shift, factor in zip(_SHIFTS, _FACTORS, strict=True):
            keys ^= keys >> shift
            keys *= factor
    _, index, kind = np.unique(keys, return_index=True, return_inverse=True)
    if (rows[index][kind] != rows).any():  # different rows with one key
        _, index, kind = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    return index, kind.reshape(-1)
