"""Where a part, or what is open between its walls, is narrow: rays from a wall to the one that faces it.

A ray starts on the boundary of a section, along the normal into the material (a wall) or away from it (a
gap), and ends at the next boundary. It counts where that one faces it: corners, whose sides meet at more than
about 50 degrees, are no narrow places.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.contracts.part import Part
from mechwright.contracts.sections import sections

FACING = -0.6
"""Cosine between the normals of two walls that face each other, at most: they meet at 53 degrees or less."""
STEP = 0.1
"""Distance of the rays along the boundary, mm: a quarter of a nozzle."""
OFF = 1e-4
"""A ray starts so far from its wall, mm."""
CHORD = 0.005
"""Chord error of the sections, mm."""


@dataclass(frozen=True)
class Narrow:
    """The narrowest place: its width, mm, where its ray starts, and whether it is a wall or a gap."""

    width: float
    x: float
    y: float
    kind: Literal["wall", "gap"]


def narrowest(part: Part, below: float, kind: Literal["wall", "gap"]) -> Narrow | None:
    """The narrowest place of a plate below a width, mm; None where all are wider."""
    found = [_narrowest(layer.shape, below, kind) for layer in sections(part, CHORD, 0)]
    return min((one for one in found if one is not None), key=lambda one: one.width, default=None)


def _narrowest(shape: "shapely.Geometry", below: float, kind: Literal["wall", "gap"]) -> Narrow | None:
    rings = shapely.get_rings(shapely.get_parts(shapely.orient_polygons(shape)))
    rays = [_rays(np.asarray(ring.coords), below, 1.0 if kind == "wall" else -1.0) for ring in rings]
    starts, normals = (np.concatenate(each) for each in zip(*rays, strict=True))
    edges = np.concatenate([_edges(np.asarray(ring.coords)) for ring in rings])
    lines = shapely.linestrings(edges)
    tree = shapely.STRtree(lines)
    ray = shapely.linestrings(np.stack((starts + OFF * normals, starts + below * normals), axis=1))
    which, hit = tree.query(ray, predicate="intersects")
    if not which.size:
        return None
    way = edges[hit, 1] - edges[hit, 0]
    away = np.column_stack((-way[:, 1], way[:, 0])) / np.hypot(*way.T)[:, None]
    facing = np.einsum("ij,ij->i", away * (1.0 if kind == "wall" else -1.0), normals[which]) < FACING
    if not facing.any():
        return None
    met = shapely.distance(
        shapely.points(starts[which[facing]]), shapely.intersection(ray[which[facing]], lines[hit[facing]])
    )
    place = int(np.argmin(met))
    x, y = starts[which[facing][place]].tolist()
    return Narrow(float(met[place]), x, y, kind)


def _edges(corners: Array) -> Array:
    return np.stack((corners[:-1], corners[1:]), axis=1)


def _rays(corners: Array, below: float, sign: float) -> tuple[Array, Array]:
    """Starts (n, 2) and unit normals (n, 2) along a ring with the material on its left."""
    ends = _edges(corners)
    way = ends[:, 1] - ends[:, 0]
    length = np.hypot(*way.T)
    ends, way, length = ends[length > 0], way[length > 0], length[length > 0]
    count = np.maximum(1, np.ceil(length / min(STEP, below)).astype(int))
    index = np.repeat(np.arange(len(count)), count)
    share = (np.concatenate([np.arange(n) for n in count.tolist()]) + 0.5) / count[index]
    starts = ends[index, 0] + share[:, None] * way[index]
    unit = way / length[:, None]
    normals: Array = sign * np.column_stack((-unit[:, 1], unit[:, 0]))[index]
    return starts, normals
