"""A part as the machine leaves it.

Glossary
--------
off
    How far a wall stands from where its cutters were to make it, mm: positive where stock was left.
corner
    A place that no cutter of the program enters: the wall stands farther off there, as planned.
corridor
    How far the control may stray from the programmed path, mm: a wall may lie anywhere so far on either side.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.tolerances import TOLERANCES

if TYPE_CHECKING:
    import shapely

Point = tuple[float, float]

ABOUT = 0.1
"""Share of its radius by which the wall of a hole may be off: a fit or a thread changes a hole by less."""
MOSTLY = 0.5
"""Least share of a wall that is on the circle of a hole."""


@dataclass(frozen=True, eq=False)
class MadeRing:
    """A closed wall as made, in the part's coordinates.

    Parameters
    ----------
    points
        (n, 2) float, mm, in order, material on the left; the first is not repeated.
    outward
        (n, 2) float, unit vectors off the material.
    off
        (n,) float, mm. It is 0 where nothing has to be cut, and where a tab has been cut off by hand.
    corner
        (n,) bool.
    """

    points: Array
    outward: Array
    off: Array
    corner: NDArray[np.bool_]

    @property
    def area(self) -> float:
        """Signed area of the polygon through the points, mm²; negative for the wall of an opening."""
        x, y = self.points.T
        return float(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))) / 2

    @property
    def planned(self) -> Array:
        """Where its cutters were to make it: places (n, 2), mm."""
        points: Array = self.points - self.off[:, None] * self.outward
        return points

    def moved(self, more: float) -> Array:
        """The points (n, 2) with ``more`` mm of material on the wall, less where it is negative."""
        return self.points + more * self.outward


@dataclass(frozen=True, eq=False)
class MadeSection:
    """The part between two depths below its top face, mm, where its walls are upright.

    ``rings`` has the walls; of several pieces of material each has a ring of its own.
    """

    top: float
    bottom: float
    rings: tuple[MadeRing, ...]

    def shape(self, *, planned: bool = False, more: float = 0.0) -> "shapely.Geometry":
        """The cross-section as made, with ``more`` mm on all walls, or as planned; it may have pieces."""
        import shapely

        closed = [
            (ring.area > 0, shapely.Polygon(ring.planned if planned else ring.moved(more)))
            for ring in self.rings
        ]
        solid, open_ = (
            shapely.union_all([shapely.make_valid(shape) for filled, shape in closed if filled is wanted])
            for wanted in (True, False)
        )
        return shapely.difference(solid, open_)

    def polygon(self, more: float = 0.0) -> "shapely.Polygon":
        """The largest piece of :meth:`shape`.

        Raises
        ------
        ValueError
            There are no walls.
        """
        import shapely

        pieces = shapely.get_parts(self.shape(more=more)).tolist()
        if not pieces:
            raise ValueError("a section without walls has no outline")
        largest: shapely.Polygon = max(pieces, key=lambda piece: piece.area)
        return largest

    def hole_at(self, x: float, y: float, diameter: float) -> "MadeHole | None":
        """The round hole of about that diameter, mm, about a point; None if there is none.

        What of its wall is no part of the circle, such as a keyway, does not count. Slivers that passes leave
        between them at the wall are holes as well, and lie on the circle: the hole is the largest of all.
        """
        for ring in sorted(self.rings, key=lambda one: one.area):
            if ring.area >= 0:
                break
            away = np.hypot(*(ring.points - (x, y)).T)
            near = np.abs(away - diameter / 2) < ABOUT * diameter / 2
            if near.mean() > MOSTLY:
                on = np.abs(away - np.median(away[near])) < 2 * TOLERANCES.leftover
                return MadeHole.of(ring.points[on])
        return None


@dataclass(frozen=True, slots=True)
class MadeHole:
    """A hole as made: middle and diameter of the circle that fits its wall best, mm.

    ``least`` is the diameter of what goes in, twice the least distance of its wall from the middle; ``round``
    says how far the wall is off that circle at the most.
    """

    x: float
    y: float
    diameter: float
    least: float
    round: float

    @classmethod
    def of(cls, points: Array) -> "MadeHole":
        """The circle of least squares (Kåsa) through points (n, 2), mm.

        Examples
        --------
        >>> turn = np.linspace(0, -2 * np.pi, 60, endpoint=False)
        >>> hole = MadeHole.of(np.column_stack((5 + 3 * np.cos(turn), 1 + 3 * np.sin(turn))))
        >>> round(hole.x, 9), round(hole.y, 9), round(hole.diameter, 9), round(hole.round, 9)
        (5.0, 1.0, 6.0, 0.0)
        """
        middle = points.mean(axis=0)
        x, y = (points - middle).T
        table = np.column_stack((2 * x, 2 * y, np.ones_like(x)))
        (cx, cy, rest), *_ = np.linalg.lstsq(table, x * x + y * y, rcond=None)
        radius = float(np.sqrt(rest + cx * cx + cy * cy))
        away = np.hypot(x - cx, y - cy)
        return cls(
            float(middle[0] + cx),
            float(middle[1] + cy),
            2 * radius,
            2 * float(away.min()),
            float(np.abs(away - radius).max()),
        )


@dataclass(frozen=True, slots=True)
class Witness:
    """A line on a wall where passes of different depths meet.

    Parameters
    ----------
    depth
        Below the top face, mm.
    step
        How far the wall below it stands out at the most, mm.
    at
        Where that is, mm.
    """

    depth: float
    step: float
    at: Point


@dataclass(frozen=True, eq=False)
class MadePart:
    """A copy of a part as it comes off the machine, where least has been cut at each height.

    Parameters
    ----------
    name
        Of the part.
    label
        What tells copies from each other that are cut on one plate; the name where there is one.
    corridor
        mm; a mechanism has to run wherever in it the walls lie.
    sections
        From the top down.
    witnesses
        From the top down; none where all passes run on one line.
    underside
        Recesses cut from below, by depths below the top face like the others.
    """

    name: str
    label: str
    corridor: float
    sections: tuple[MadeSection, ...]
    witnesses: tuple[Witness, ...] = ()
    underside: tuple[MadeSection, ...] = ()

    def section(self, depth: float) -> MadeSection:
        """The section at a depth, mm; the last one below all."""
        return next((one for one in self.sections if depth < one.bottom), self.sections[-1])

    @property
    def outline(self) -> MadeSection:
        """The section at the underside, which every through cut has opened."""
        return self.sections[-1]

    def hole_at(self, x: float, y: float, diameter: float) -> "MadeHole | None":
        """The through hole at a point, see :meth:`MadeSection.hole_at`."""
        return self.outline.hole_at(x, y, diameter)

    def bore_middle(self, diameter: float) -> Point:
        """The middle, mm, of the shaft's bore of that diameter as made; the origin where there is none."""
        bore = self.hole_at(0.0, 0.0, diameter) if diameter else None
        return (0.0, 0.0) if bore is None else (bore.x, bore.y)

    @cached_property
    def off(self) -> Array:
        """How far off all walls are (n,), mm, corners apart."""
        sections = (*self.sections, *self.underside)
        rings = [ring for section in sections for ring in section.rings]
        if not rings:
            return np.empty(0)
        return np.concatenate([ring.off[~ring.corner] for ring in rings])
