"""Details of a plate that its shape does not show: broken edges, threads, engraved marks.

They are cut into the top face when the shape is made. A solid does not show them, as a drawing shows them
by a note; program and proof do. Depths are measured downwards from the top face.
"""

import math
from dataclasses import dataclass
from typing import Literal

from mechwright.errors import GeometryError
from mechwright.geometry import Loop
from mechwright.geometry.segments import Point


@dataclass(frozen=True)
class Chamfer:
    """A top edge broken at 45 degrees; a few tenths of ``width`` deburr it.

    ``side`` says where the cutter runs, as for a Profile: outside of a part's rim, inside of an opening.
    """

    name: str
    loop: Loop
    side: Literal["outside", "inside"]
    width: float

    def __post_init__(self) -> None:
        if not self.width > 0:
            raise GeometryError(f"chamfer {self.name} needs a width above 0 mm, not {self.width}")


@dataclass(frozen=True)
class Thread:
    """An internal right-hand metric thread in a Bore of its core diameter, from the top face on.

    ``diameter`` is the nominal one (M6: 6), ``depth`` that of the last full turn.
    """

    name: str
    centre: Point
    diameter: float
    pitch: float
    depth: float

    def __post_init__(self) -> None:
        if not 0 < self.pitch < self.diameter / 2:
            raise GeometryError(
                f"thread {self.name}: the pitch is {self.pitch} mm, not 0 to {self.diameter / 2:g}"
            )

    @property
    def core(self) -> float:
        """Diameter of the hole to be threaded, mm: D - 1.0825 P (ISO 724, D1)."""
        return self.diameter - 1.0825 * self.pitch


@dataclass(frozen=True)
class Engraving:
    """Lines engraved ``depth`` mm deep, at most ``width`` mm wide at the top; strokes are polylines."""

    name: str
    strokes: tuple[tuple[Point, ...], ...]
    depth: float
    width: float = 0.6

    def __post_init__(self) -> None:
        if not (self.depth > 0 and self.width > 0):
            raise GeometryError(f"engraving {self.name} needs a depth and a width above 0 mm")
        if not self.strokes or any(len(stroke) < 2 for stroke in self.strokes):
            raise GeometryError(f"engraving {self.name} needs strokes of two points or more")


Detail = Chamfer | Thread | Engraving


def moved(detail: Detail, x: float, y: float, angle: float = 0.0) -> Detail:
    """The detail turned about the origin, rad, then shifted, mm."""
    c, s = math.cos(angle), math.sin(angle)

    def at(point: Point) -> Point:
        return c * point[0] - s * point[1] + x, s * point[0] + c * point[1] + y

    match detail:
        case Chamfer():
            return Chamfer(detail.name, detail.loop.moved(x, y, angle), detail.side, detail.width)
        case Thread():
            return Thread(detail.name, at(detail.centre), detail.diameter, detail.pitch, detail.depth)
        case Engraving():
            strokes = tuple(tuple(at(point) for point in stroke) for stroke in detail.strokes)
            return Engraving(detail.name, strokes, detail.depth, detail.width)
