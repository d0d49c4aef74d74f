"""Fillets between the floor of a recess and its walls: what cuts into them, and what they keep.

In a section across the wall the fillet is a quarter of a circle of radius f, and the end of a mill is a disc
of its nose's radius c with all that is above and towards the axis. At a distance d of the axis from the wall,
and with the tip t above the floor, the disc's middle is at (d - R + c, t + c). It is in the clear as far as c
is below its distance from fillet, wall and floor.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.contracts.part import Pocket
from mechwright.geometry.prepared import prepared
from mechwright_cam.proof.bands import bands, floor_of
from mechwright_cam.proof.gouge import Gouge
from mechwright_cam.proof.paths import NEAR, Paths
from mechwright_cam.proof.plane import Boundary, Shape, grow
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.views import SKIN, inside_of
from mechwright_plane.offsets import polygons

HEIGHTS = 6
"""A fillet's leftover is measured at so many heights, at even angles: in between it differs by 1 % of the
radius from a straight wall, and a cutter that has made both ends has made that as well."""


@dataclass(frozen=True)
class Fillet:
    """The fillet of one recess."""

    feature: Pocket
    """The recess, work coordinates."""
    floor: float
    """Its z, mm."""
    walls: shapely.Geometry
    """Lines at which a wall stands on the floor."""
    inside: Shape
    """Plan view of the floor."""

    @property
    def radius(self) -> float:
        """Of the fillet, mm."""
        return self.feature.floor_radius

    @property
    def heights(self) -> tuple[float, ...]:
        """The heights z at which it is looked at, from just above the floor to where it ends, mm."""
        return self.heights_in(HEIGHTS)

    def heights_in(self, steps: int) -> tuple[float, ...]:
        """So many heights, at even angles."""
        angles = np.linspace(0.0, np.pi / 2, steps + 1)[1:]
        return tuple((self.floor + self.radius * (1 - np.cos(angles))).tolist())

    def solid(self, z: float) -> Shape:
        """What the fillet keeps at a height, plan view."""
        if not self.floor - NEAR <= z < self.floor + self.radius:
            return shapely.Polygon()
        strip = shapely.intersection(self.inside, grow(self.walls, self.feature.inset(z - self.floor)))
        return shapely.union_all(polygons(strip))  # without the edges at which the two only touch

    @cached_property
    def foot(self) -> Shape:
        """Plan view of the fillet."""
        return shapely.intersection(self.inside, grow(self.walls, self.radius))

    def rise(self, away: Array) -> Array:
        """Height of the fillet above the floor at distances (n,) from the wall, mm."""
        short = np.maximum(self.radius - away, 0.0)
        return self.radius - np.sqrt(self.radius**2 - short**2)

    def deepest(self, paths: Paths) -> Gouge | None:
        """The deepest cut into the fillet."""
        top = self.floor + self.radius
        pieces = paths.below(top - NEAR)
        lines, steps = paths.lines(pieces), pieces.step
        foot = self.foot
        foot = prepared(foot)
        shape = paths.cutters(steps)
        near = np.flatnonzero(shapely.dwithin(foot, lines, shape.radius))
        if near.size == 0:
            return None
        pieces, lines, shape = pieces.only(near), lines[near], paths.cutters(steps[near])
        overlap = shape.radius_at(top - pieces.low) - shapely.distance(foot, lines)
        away = shapely.distance(self.walls, lines) - shape.radius + shape.nose
        up = pieces.low - self.floor + shape.nose
        f = self.radius
        # Elsewhere the wall or the floor is nearest, which are looked at for themselves.
        room = np.where((away < f) & (up < f), f - np.hypot(f - away, f - up), np.inf)
        depth = np.minimum(shape.nose - room, overlap)
        worst = int(np.argmax(depth))
        if depth[worst] <= 0:
            return None
        x, y = Boundary(foot).nearest(lines[worst])
        return Gouge(float(depth[worst]), int(pieces.step[worst]), (x, y, float(pieces.low[worst])))


def fillets(job: Job) -> tuple[Fillet, ...]:
    """The fillets of a job's recesses."""
    found = []
    for feature in job.features:
        if isinstance(feature, Pocket) and feature.floor_radius > 0:
            floor = -(feature.top + feature.depth)
            above = next(band for band in bands(job) if abs(band.bottom - floor) < NEAR)
            walls = shapely.intersection(shapely.boundary(inside_of(feature)), grow(above.keep, SKIN))
            deeper = [
                inside_of(other)
                for other in job.features
                if other is not feature
                and isinstance(other, Pocket)
                and other.top + other.depth > NEAR - floor
            ]
            inside = shapely.difference(floor_of(feature, job), shapely.union_all(deeper))
            found.append(Fillet(feature, floor, walls, inside))
    return tuple(found)


def stay(nose: float, radius: float, tip: float) -> float:
    """How far off the wall a mill with its tip so high above the floor stays, to leave the fillet, mm.

    Its nose fits into a fillet of radius f at every distance for which the two circles do not cross: as if it
    were a point and the fillet one of radius f - c.
    """
    left = radius - nose
    short = max(left - max(tip, 0.0), 0.0)
    return left - float(np.sqrt(max(left**2 - short**2, 0.0))) if left > 0 else 0.0
