"""Line pictures of scenes: edges of meshes, hidden where another body, or the same, stands before them.

Each body is looked at once: how near to the eye it is at every place, and where its edges run. A scene shifts
what was seen, so that a picture of twenty bodies takes no longer than drawing their lines.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.ndimage import minimum_filter

from mechwright.arrays import Array
from mechwright.contracts.fitting_marks import rings
from mechwright_cad.assembly_order.heights import CELL, Heights
from mechwright_cad.assembly_order.layers import UP, mesh_points
from mechwright_cad.bodies import Body

EYE = np.array((1.0, -1.6, 1.1))
"""Whence the pictures are seen: from the front, the right and above."""

SHARP = np.cos(np.radians(30.0))
"""Cosine of the angle between two triangles from which on their edge is drawn; facets of pins have less."""

BEFORE = 1.0
"""How much nearer to the eye a face that hides a line is, mm: a cell of a steep face spans as much."""

SHORTEST = 3
"""Cells of a line that is drawn, and of a gap in one, at least."""

FINE = 0.12
"""What may be left out of a line to have fewer corners, mm."""

Lines = dict[int, shapely.Geometry]
"""Number of a body to its visible lines in the plane of the picture, mm."""


@dataclass(frozen=True)
class _Seen:
    """A body where it stands: nearness to the eye, and its edges (n, 2, 3) with the eye along z."""

    heights: Heights
    edges: Array


class View:
    """All bodies of an assembly at a sample, seen from one side."""

    def __init__(self, bodies: Sequence[Body], sample: int, eye: Array = EYE) -> None:
        self._bodies, self._sample = bodies, sample
        self._towards = eye / np.linalg.norm(eye)
        self._seen: dict[int, _Seen] = {}

    @cached_property
    def frame(self) -> Array:
        """Rows (3, 3): right, up, and towards the eye."""
        right = np.cross(UP, self._towards)
        right /= np.linalg.norm(right)
        return np.array((right, np.cross(self._towards, right), self._towards))

    def flat(self, points: Array) -> Array:
        """Points (n, 3) of space as the picture has them (n, 2), mm."""
        flat: Array = np.atleast_2d(points) @ self.frame[:2].T
        return flat

    def lines(self, scene: Mapping[int, Array]) -> Lines:
        """What is seen of each body of a scene: number of a body to its shift (3,), mm."""
        shifts = {k: self._cells(shift) for k, shift in scene.items()}
        maps = {k: self._look(k).heights for k in scene}
        corners = np.array([np.add(maps[k].corner, shifts[k][0]) for k in scene])
        ends = np.array([np.add(maps[k].corner, shifts[k][0]) + maps[k].high.shape for k in scene])
        first, size = corners.min(axis=0), ends.max(axis=0) - corners.min(axis=0)
        nearest = np.full(size, -np.inf)
        for k, corner in zip(scene, corners, strict=True):
            (x, y), high = corner - first, maps[k].high
            window = nearest[x : x + high.shape[0], y : y + high.shape[1]]
            np.maximum(window, high + shifts[k][1], out=window)
        # Beside the line where a pin turns away from the eye its face is far nearer: ask neighbours too.
        nearest = minimum_filter(nearest, 3, mode="constant", cval=-np.inf)
        return {k: self._visible(k, shifts[k], nearest, first) for k in scene}

    def _cells(self, shift: Array) -> tuple[NDArray[np.int64], float]:
        """A shift in whole cells of the picture, and towards the eye, mm."""
        x, y, z = self.frame @ shift
        return np.array((round(x / CELL), round(y / CELL))), float(z)

    def _look(self, number: int) -> _Seen:
        if number not in self._seen:
            body = self._bodies[number]
            points, triangles = mesh_points(body, self._sample)
            seen = points @ self.frame.T
            drawn = np.concatenate((_edges(seen, triangles), self._dots(body)))
            self._seen[number] = _Seen(Heights.of(seen, triangles), drawn)
        return self._seen[number]

    def _dots(self, body: Body) -> Array:
        """The fitting marks on the top face of a plate, as edges (n, 2, 3)."""
        lines = [line for mark in body.part.marks for line in rings(mark)]
        if not lines:
            return np.empty((0, 2, 3))
        top = body.instance.z + body.part.thickness
        flat = np.concatenate([np.stack((line[:-1], line[1:]), axis=1) for line in map(np.array, lines)])
        points = np.concatenate((flat, np.full((*flat.shape[:2], 1), top)), axis=2)
        turn, place = body.poses.rotation[self._sample], body.poses.position[self._sample]
        dots: Array = (points @ turn.T + place) @ self.frame.T
        return dots

    def _visible(
        self, number: int, shift: tuple[NDArray[np.int64], float], nearest: Array, first: Array
    ) -> shapely.Geometry:
        cells, lift = shift
        edges = self._seen[number].edges + np.array((*(cells * CELL), lift))
        pieces: list[Array] = []
        steps = np.ceil(np.linalg.norm(np.diff(edges[:, :, :2], axis=1)[:, 0], axis=1) / CELL).astype(int) + 1
        for count in np.unique(steps).tolist():
            some = edges[steps == count]
            share = np.linspace(0.0, 1.0, count + 1)[None, :, None]
            points = some[:, :1] * (1 - share) + some[:, 1:] * share
            place = np.floor(points[..., :2] / CELL).astype(int) - first
            clear = points[..., 2] > nearest[place[..., 0], place[..., 1]] - BEFORE
            pieces.append(_runs(points[..., :2], clear))
        found = np.concatenate(pieces) if pieces else np.empty((0, 2, 2))
        merged = shapely.line_merge(shapely.multilinestrings(shapely.linestrings(found)))
        parts = shapely.get_parts(merged)
        long = parts[shapely.length(parts) > SHORTEST * CELL]
        return shapely.simplify(shapely.multilinestrings(long), FINE)


def _edges(points: Array, triangles: NDArray[np.int64]) -> Array:
    """Edges (n, 2, 3) of a mesh that are sharp, or where it turns away from the eye, which is along z."""
    corners = points[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    ends = triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    of = np.repeat(np.arange(len(triangles)), 3)
    key = np.sort(ends, axis=1)
    order = np.lexsort((key[:, 1], key[:, 0]))
    key, of = key[order], of[order]
    same = np.flatnonzero((key[1:] == key[:-1]).all(axis=1))
    one, two = normal[of[same]], normal[of[same + 1]]
    facing = (one[:, 2] > 0) != (two[:, 2] > 0)
    sharp = ((one * two).sum(axis=1) < SHARP) & ((one[:, 2] > 0) | (two[:, 2] > 0))
    edges: Array = points[key[same[facing | sharp]]]
    return edges


def _runs(lines: Array, seen: NDArray[np.bool_]) -> Array:
    """Ends (k, 2, 2) of the pieces of sampled lines (m, n, 2) that are seen (m, n); short gaps are closed."""
    edge = np.zeros((len(seen), 1), dtype=np.int8)
    change = np.diff(np.concatenate((edge, seen, edge), axis=1), axis=1)
    row, begin = np.nonzero(change > 0)
    end = np.nonzero(change < 0)[1] - 1
    apart = (row[1:] != row[:-1]) | (begin[1:] - end[:-1] > SHORTEST)
    first, last = np.append(True, apart), np.append(apart, True)
    if not len(row):
        return np.empty((0, 2, 2))
    row, begin, end = row[first], begin[first], end[last]
    is_long = end > begin
    row, begin, end = row[is_long], begin[is_long], end[is_long]
    return np.stack((lines[row, begin], lines[row, end]), axis=1)
