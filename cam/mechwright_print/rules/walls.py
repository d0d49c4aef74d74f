"""Where a part, or what is open between its walls, is narrow.

Walls are found by rays: each starts on the boundary of a section, along the normal into the material (a wall)
or away from it (a gap), ends at the next boundary, and counts where that one faces it. Tips are found along
the boundary: within a short way it turns by more than a corner does.

Glossary
--------
tip
    End of a tooth or of an arm: two corners, or a rounding, with less than a width between them.
"""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.contracts.part import Part
from mechwright.contracts.sections import sections

FACING = -0.8
"""Cosine between the normals of two walls that face each other, at most: they meet at 37 degrees or less."""
TIP = 110.0
"""By so many degrees at least the boundary turns at a tip: a corner of 90 degrees is none."""
CORNER = 25.0
"""So many degrees of it do not belong to its sharpest corner: a point is rounded off by any nozzle."""
MOST_CHORDS = 60
"""Chords of a tip, at most."""
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


@dataclass(frozen=True, eq=False)
class _Walls:
    """Chords of the rings of a section.

    ``ends`` (n, 2, 2), mm; ``ring`` (n,) numbers their rings. The material is on the left.
    """

    ends: Array
    ring: NDArray[np.int64]

    @property
    def normals(self) -> Array:
        """Unit vectors (n, 2) into the material."""
        way = self.ends[:, 1] - self.ends[:, 0]
        unit: Array = np.column_stack((-way[:, 1], way[:, 0])) / np.hypot(*way.T)[:, None]
        return unit


def _walls(shape: "shapely.Geometry") -> _Walls:
    rings = shapely.get_rings(shapely.get_parts(shapely.orient_polygons(shape)))
    found = []
    for ring in rings:
        corners = np.asarray(ring.coords)
        ends = np.stack((corners[:-1], corners[1:]), axis=1)
        found.append(ends[np.hypot(*(ends[:, 1] - ends[:, 0]).T) > 0])
    return _Walls(np.concatenate(found), np.repeat(np.arange(len(found)), [len(ends) for ends in found]))


def _narrowest(shape: "shapely.Geometry", below: float, kind: Literal["wall", "gap"]) -> Narrow | None:
    walls = _walls(shape)
    found = [_across(walls, below, kind)]
    if kind == "wall":
        found += [_tip(walls.ends[walls.ring == number], below) for number in np.unique(walls.ring)]
    return min((one for one in found if one is not None), key=lambda one: one.width, default=None)


def _across(walls: _Walls, below: float, kind: Literal["wall", "gap"]) -> Narrow | None:
    """The shortest ray between walls that face each other."""
    inward = walls.normals
    sign = 1.0 if kind == "wall" else -1.0
    place, starts = _starts(walls, below)
    ray = shapely.linestrings(
        np.stack((starts + sign * OFF * inward[place], starts + sign * below * inward[place]), axis=1)
    )
    lines = shapely.linestrings(walls.ends)
    which, hit = shapely.STRtree(lines).query(ray, predicate="intersects")
    counts = np.einsum("ij,ij->i", inward[hit], inward[place[which]]) < FACING
    if not counts.any():
        return None
    which, hit = which[counts], hit[counts]
    width = shapely.distance(shapely.points(starts[which]), shapely.intersection(ray[which], lines[hit]))
    least = int(np.argmin(width))
    x, y = starts[which[least]].tolist()
    return Narrow(float(width[least]), x, y, kind)


def _starts(walls: _Walls, below: float) -> tuple[NDArray[np.int64], Array]:
    """Chord (m,) of each ray, and its start (m, 2), mm."""
    way = walls.ends[:, 1] - walls.ends[:, 0]
    count = np.maximum(1, np.ceil(np.hypot(*way.T) / min(STEP, below)).astype(int))
    place = np.repeat(np.arange(len(count)), count)
    share = (np.concatenate([np.arange(n) for n in count.tolist()]) + 0.5) / count[place]
    return place, walls.ends[place, 0] + share[:, None] * way[place]


def _tip(ends: Array, below: float) -> Narrow | None:
    """The narrowest tip of a ring, chords (n, 2, 2) in order."""
    way = ends[:, 1] - ends[:, 0]
    angle = np.arctan2(way[:, 1], way[:, 0])
    turn = np.degrees((angle - np.roll(angle, 1) + np.pi) % math.tau - np.pi)  # at the start of each chord
    length = np.hypot(*way.T)
    best: Narrow | None = None
    turned, sharpest, run = turn.copy(), turn.copy(), np.zeros(len(ends))
    for step in range(1, min(MOST_CHORDS, len(ends))):
        run = run + np.roll(length, 1 - step)
        turned = turned + np.roll(turn, -step)
        sharpest = np.maximum(sharpest, np.roll(turn, -step))
        there = np.roll(ends[:, 0], -step, axis=0)
        width = np.hypot(*(there - ends[:, 0]).T)
        tips = (turned > TIP) & (turned - sharpest > CORNER) & (turn > 0) & (run < 2 * below)
        tips &= width < below
        if tips.any():
            least = int(np.argmin(np.where(tips, width, np.inf)))
            if best is None or width[least] < best.width:
                x, y = ((ends[least, 0] + there[least]) / 2).tolist()
                best = Narrow(float(width[least]), x, y, "wall")
    return best
