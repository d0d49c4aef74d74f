"""Features that are turned copies of each other: what is planned for one serves for all.

The slots of an index wheel are as many features with the same drawing. Whether one is a turned copy of
another shows in their outlines, corner by corner; that nothing around them is different is compared apart.
"""

import cmath
from dataclasses import dataclass, replace

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.contracts.part import Pocket, Profile
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.cavity import Cavity, Pass
from mechwright_cam.operations.engagement import clear
from mechwright_cam.shop.tool import Tool
from mechwright_plane.offsets import ROUGH, areas
from mechwright_plane.path import Path, arc, line, rounded

COPY = 10 * TOLERANCES.closure
"""Corners of copies agree to this, mm: rounding of the turn on a part of a metre, and no drawing is finer."""
SAME = 2 * ROUGH
"""Areas to clear are the same to this, mm: both are drawn with chords of ROUGH, which fall differently."""


@dataclass(frozen=True)
class Turn:
    """A rotation about the origin, then a shift: in the complex plane z goes to ``by`` z + ``shift``."""

    by: complex
    shift: complex

    def point(self, at: Point) -> Point:
        """Where a point goes, rounded as programs print it."""
        z = self.by * complex(*at) + self.shift
        return rounded(z.real), rounded(z.imag)

    def points(self, at: Array) -> Array:
        """Where points (n, 2) go, mm."""
        z = self.by * (at[:, 0] + 1j * at[:, 1]) + self.shift
        return np.asarray(np.column_stack((z.real, z.imag)))

    def shape(self, at: shapely.Geometry) -> shapely.Geometry:
        """Where a shape goes; rings that all but touch may cross there by a last digit, and are mended."""
        moved = shapely.transform(at, self.points)
        return moved if shapely.is_valid(moved) else areas(shapely.make_valid(moved))

    def path(self, at: Path) -> Path:
        """Where a path goes; its ends are rounded, and its centres are those of arcs between them."""
        start = here = self.point(at.start)
        cuts = []
        for cut in at.cuts:
            end = self.point((cut.x, cut.y))
            if end == here:
                continue
            centre = self.by * complex(cut.cx, cut.cy) + self.shift
            cuts.append(arc(here, end, (centre.real, centre.imag), cut.turn) if cut.turn else line(here, end))
            here = end
        return Path(start, tuple(cuts))

    def cavity(self, at: Cavity) -> Cavity:
        """Where a cavity goes, with all its passes."""
        passes = tuple(Pass(self.path(one.path), one.linked) for one in at.passes)
        return replace(
            at,
            centre=self.point(at.centre),
            begin=self.point(at.begin),
            passes=passes,
            cleared=self.shape(at.cleared),
        )


def turn_between(one: Pocket | Profile, other: Pocket | Profile) -> Turn | None:
    """The turn that makes the second feature of the first, or None if it is no copy.

    Examples
    --------
    >>> from mechwright.geometry import Loop
    >>> slot = Pocket("one", Loop.polygon([(10, -1), (20, -1), (20, 1), (10, 1)]), (), 0, 3)
    >>> across = Pocket("two", Loop.polygon([(1, 10), (1, 20), (-1, 20), (-1, 10)]), (), 0, 3)
    >>> turn_between(slot, across).point((20, 1))
    (-1.0, 20.0)
    """
    first, second = corners_of(one), corners_of(other)
    if (one.top, one.depth) != (other.top, other.depth) or len(first) != len(second):
        return None
    middle, centre = first.mean(), second.mean()
    way = complex(np.vdot(first - middle, second - centre))
    if way == 0:
        return None
    by = cmath.exp(1j * cmath.phase(way))
    if np.abs(by * (first - middle) + centre - second).max() > COPY:
        return None
    return Turn(by, complex(centre - by * middle))


def same(one: shapely.Geometry, other: shapely.Geometry) -> bool:
    """Whether two shapes are the same but for the chords that they are drawn with."""
    if shapely.is_empty(one) or shapely.is_empty(other):
        return bool(shapely.is_empty(one) and shapely.is_empty(other))
    return float(shapely.hausdorff_distance(one, other)) <= SAME and len(shapely.get_parts(one)) == len(
        shapely.get_parts(other)
    )


class Copies:
    """Clears areas with bounded engagement, those around copies of one feature with one plan."""

    def __init__(self) -> None:
        self._known: list[tuple[Pocket | Profile, shapely.Geometry, Tool, list[Cavity]]] = []

    def clear(
        self,
        feature: Pocket | Profile,
        area: shapely.Geometry,
        tool: Tool,
        engagement: float,
        climb: bool,
    ) -> list[Cavity]:
        """Clear the area around a feature; see :func:`mechwright_cam.operations.adaptive.clear`."""
        for known, place, mill, cavities in self._known:
            turn = turn_between(known, feature) if mill is tool else None
            if turn is not None and same(turn.shape(place), area):
                return [turn.cavity(cavity) for cavity in cavities]
        found = clear(area, tool, engagement, climb)
        self._known.append((feature, area, tool, found))
        return found


def corners_of(feature: Pocket | Profile) -> np.ndarray[tuple[int], np.dtype[np.complex128]]:
    """The corners of a drawing (n,), in the complex plane, mm."""
    loops = (feature.boundary, *feature.islands) if isinstance(feature, Pocket) else (feature.loop,)
    points = np.concatenate([loop.flatten() for loop in loops])
    return np.asarray(points[:, 0] + 1j * points[:, 1], dtype=np.complex128)
