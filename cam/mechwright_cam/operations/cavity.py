"""A cavity that is cleared with bounded engagement, and its moves: a helix, a spiral, and passes."""

from dataclasses import dataclass

import shapely

from mechwright.geometry.segments import Point
from mechwright_cam.operations.pen import Pen, levels
from mechwright_plane.path import Path, circle


@dataclass(frozen=True)
class Pass:
    """One way through stock; ``linked``: it may be reached straight from the end of the pass before."""

    path: Path
    linked: bool


@dataclass(frozen=True)
class Cavity:
    """All ways of one connected area, from its helix on; shapes and lengths in mm."""

    centre: Point
    helix: float
    """Radius of the helix's path."""
    begin: Point
    """Where on it the first pass starts."""
    passes: tuple[Pass, ...]
    cleared: shapely.Geometry

    def swept(self, radius: float) -> shapely.Geometry:
        """What a disc sweeps on all ways, links apart."""
        turn = circle(self.centre, self.helix, self.begin, True)
        ways = [path.points(radius / 4) for path in (turn, *(one.path for one in self.passes))]
        return shapely.union_all(
            shapely.buffer([shapely.LineString(way) for way in ways], radius, quad_segs=8)
        )


def write_cavities(
    cavities: list[Cavity], pen: Pen, top: float, bottom: float, step_down: float, climb: bool
) -> None:
    """Write the moves of all cavities, each level by level from ``top`` to ``bottom``, z in mm."""
    for cavity in cavities:
        above = top
        for z in levels(top, bottom, step_down):
            turn = circle(cavity.centre, cavity.helix, cavity.begin, climb)
            pen.helix(turn, cavity.helix, above, z)
            for one in cavity.passes:
                if one.linked:
                    pen.straight(one.path.start, pen.air)
                else:
                    pen.above(one.path.start)
                    pen.sink(z, pen.air_down)
                pen.follow(one.path)
            above = z
    pen.retract()
