"""What holds a part: tabs, jaws, a clamp."""

import math
from dataclasses import dataclass

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.geometry.segments import Point


@dataclass(frozen=True)
class Clamp:
    """A round clamp on the part that the cutter and its holder must go around or over."""

    centre: Point
    diameter: float
    top: float


@dataclass(frozen=True)
class ToeClamp:
    """A clamp on the plate: its number, its plan view with the bolt, its top, z in mm."""

    number: int
    shape: shapely.Polygon
    top: float


@dataclass(frozen=True)
class Tab:
    """A bridge from the part to the frame."""

    shape: shapely.Polygon
    """Plan view, at the underside."""
    top: float
    """Its upper side, z in mm, below 0."""
    width: float
    """At the top, mm."""
    slope: float = math.inf
    """Tangent of its sides: the upper side falls so steeply beyond the width; inf where they are upright."""
    at: Point = (0.0, 0.0)
    """Its middle on the wall."""
    along: Point = (1.0, 0.0)
    """The unit vector along the wall there; out is to the right of it."""
    ends: tuple[float, float] = (0.0, 0.0)
    """Where it ends, inside the part and in the frame, ``out`` in mm."""

    @property
    def ramped(self) -> bool:
        """Whether the cutter runs over it on slopes."""
        return math.isfinite(self.slope)

    @property
    def level(self) -> shapely.Polygon:
        """Plan view of its level top."""
        if not self.ramped:
            return self.shape
        place = (*self.at, self.along)
        return _piece_at(shapely.intersection(rectangle(place, self.width, self.ends), self.shape), place)

    def least_z(self, points: Array, radius: float) -> Array:
        """Lowest z (n,) of a flat cutter of ``radius`` at places (n, 2) that leaves a ramped tab whole, mm.

        -inf where the cutter is beside the tab. The nearest of the tab's strips that the disc covers is the
        highest one.
        """
        (dx, dy), (tx, ty) = (points - self.at).T, self.along
        s, out = dx * tx + dy * ty, dx * ty - dy * tx
        beyond = np.maximum(np.maximum(self.ends[0] - out, out - self.ends[1]), 0.0)
        half = np.sqrt(np.maximum(radius**2 - beyond**2, 0.0))
        height = self.top - self.slope * np.maximum(np.abs(s) - half - self.width / 2, 0.0)
        return np.asarray(np.where(beyond < radius, height, -np.inf))


def least_z(tabs: tuple[Tab, ...], points: Array, radius: float) -> Array:
    """Lowest z (n,) of a flat cutter over all of these ramped tabs, mm; see :meth:`Tab.least_z`."""
    lowest = np.full(len(points), -np.inf)
    for tab in tabs:
        np.maximum(lowest, tab.least_z(points, radius), out=lowest)
    return lowest


def _piece_at(shape: shapely.Geometry, place: tuple[float, float, Point]) -> shapely.Polygon:
    """The piece of a tab, cut by openings of the part, that lies on the wall."""
    pieces = shapely.get_parts(shape)
    return pieces[int(np.argmin(shapely.distance(pieces, shapely.Point(place[:2]))))]


def rectangle(place: tuple[float, float, Point], base: float, ends: tuple[float, float]) -> shapely.Polygon:
    """The plan view of a tab across the wall."""
    return shapely.Polygon(_corners(place, base, ends))


def _corners(place: tuple[float, float, Point], base: float, ends: tuple[float, float]) -> list[Point]:
    """Corners of a rectangle across the wall, those of its inner end first."""
    x, y, (tx, ty) = place
    nx, ny = ty, -tx  # outwards of a counter-clockwise ring
    inner, outer = ends
    return [
        (x + along * tx + out * nx, y + along * ty + out * ny)
        for along, out in ((-base / 2, inner), (base / 2, inner), (base / 2, outer), (-base / 2, outer))
    ]


@dataclass(frozen=True)
class Jaw:
    """A jaw of the vice: its plan view with all behind it, the face the part touches, its top, z in mm."""

    edge: str
    shape: shapely.Polygon
    face: shapely.LineString
    top: float
