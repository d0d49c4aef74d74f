"""Bodies of any form across a way: how far along it each place of them lies, on a grid.

A body that goes along a way meets another if somewhere on the grid the other reaches further along it than
the first begins. So each body needs two heights at each place, its least and its greatest.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array

CELL = 0.3
"""Width of a place, mm. A body is taken one place narrower than it is, so that a pin passes through its bore;
a shoulder that is higher than two places bars it."""

LOOSE = 0.1
"""How much further along a way a body may reach and bar none, mm: faces that lie on each other."""

_FLAT = 1e-6
"""Least share of a triangle's area that is seen along a way; others stand along it."""


@dataclass(frozen=True)
class Heights:
    """Least and greatest heights on a grid (nx, ny), mm; +inf and -inf where the body is not.

    ``corner`` are the grid's first place, in places from the origin.
    """

    low: Array
    high: Array
    corner: tuple[int, int]

    @classmethod
    def of(cls, points: Array, triangles: NDArray[np.int64]) -> "Heights":
        """Of a mesh with points (n, 3) whose third coordinate is along the way."""
        from mechwright_cad.assembly_order.height_kernel import rasterize

        corners = points[triangles]
        edges = corners[:, 1:] - corners[:, :1]
        seen = np.abs(edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0])
        whole = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)
        corners = corners[seen > _FLAT * np.maximum(whole, _FLAT)]
        first = np.floor(points[:, :2].min(axis=0) / CELL).astype(np.int64) - 1
        last = np.floor(points[:, :2].max(axis=0) / CELL).astype(np.int64) + 1
        size = tuple((last - first + 1).tolist())
        low, high = np.full(size, np.inf), np.full(size, -np.inf)
        rasterize(*_in_rows(corners), CELL, first, low, high)
        return cls(low, high, (int(first[0]), int(first[1])))

    def slim(self) -> "Heights":
        """The body one place narrower, all round; one so thin that nothing would be left as it is."""
        from scipy.ndimage import maximum_filter

        low = maximum_filter(self.low, 3, mode="constant", cval=np.inf)
        return self if np.isinf(low).all() else Heights(low, self.high, self.corner)

    def bars(self, other: "Heights") -> bool:
        """Whether ``other``, going along the way, would meet this body."""
        start = np.maximum(self.corner, other.corner)
        end = np.minimum(np.add(self.corner, self.high.shape), np.add(other.corner, other.low.shape))
        if (end <= start).any():
            return False
        mine = self._window(self.high, self.corner, start, end)
        theirs = self._window(other.low, other.corner, start, end)
        return bool((mine > theirs + LOOSE).any())

    @staticmethod
    def _window(values: Array, corner: tuple[int, int], start: Array, end: Array) -> Array:
        (x0, y0), (x1, y1) = start - corner, end - corner
        window: Array = values[x0:x1, y0:y1]
        return window


def _in_rows(corners: Array) -> tuple[Array, NDArray[np.int64]]:
    """Triangles (k, 3, 3), the longest side first, and steps (k, 2) along it and up to the corner opposite.

    Steps are at most a place over √2 long: so one of their points lies in every place that a triangle covers,
    however the rows run across the grid.
    """
    edges = np.linalg.norm((np.roll(corners, -1, axis=1) - corners)[:, :, :2], axis=2)
    turned = (edges.argmax(axis=1)[:, None] + np.arange(3)) % 3
    corners = np.take_along_axis(corners, turned[:, :, None], axis=1)
    along, up = (corners[:, k, :2] - corners[:, 0, :2] for k in (1, 2))
    long = np.maximum(edges.max(axis=1, initial=_FLAT), _FLAT)
    tall = np.abs(along[:, 0] * up[:, 1] - along[:, 1] * up[:, 0]) / long
    counts = np.ceil(np.column_stack((long, tall)) * (math.sqrt(2) / CELL)).astype(np.int64) + 1
    return np.ascontiguousarray(corners), counts
