"""The planes of a chain: how high each stage stands, so that none of its parts meets those of another.

Stages are stacked upwards, each over all of the one before. A stage with a ground plate of its own has its
input's shaft below it: the hub that turns it sits on that shaft's end.
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from mechwright.contracts.mounting import GroundPlate, Hub, Mounting
from mechwright.contracts.part import Part
from mechwright.contracts.shape import Prism, Shape
from mechwright.errors import GeometryError
from mechwright.mechanics.chain.links import Link
from mechwright.tolerances import TOLERANCES

AIR = 1.0
"""Between the planes of two stages, mm, where the design says nothing: room for chips and a little wobble."""


@dataclass(frozen=True)
class Plane:
    """A stage between two heights, mm, in its own coordinates, and where its shafts are held.

    Parameters
    ----------
    low, high
        Of all its parts.
    mounting
        As its family says; None where it says nothing.
    bottom
        Of what comes over the stage before: a shaft of its own, which stands out into it, does not count.
    origins
        Heights of the origins of its bodies, mm, in the stage's own coordinates.
    """

    low: float
    high: float
    mounting: Mounting | GroundPlate | None
    bottom: float
    origins: Mapping[str, float]

    def hub(self, body: str) -> Hub | None:
        """The hub on the shaft of a body; None where no shaft goes through it."""
        if not isinstance(self.mounting, Mounting):
            return None
        return next((one.hub for one in self.mounting.spindles if one.body == body), None)


def heights(shape: Shape) -> tuple[float, float]:
    """Least and greatest height of a shape, mm."""
    every: list[float] = []
    for piece in shape.pieces:
        if isinstance(piece, Prism):
            every += [piece.low, piece.high]
        else:
            every += [z for _, z in piece.profile]
    return min(every), max(every)


def part_heights(part: Part) -> tuple[float, float]:
    """Of a part about its own z = 0, mm; raises GeometryError for a solid that does not say them."""
    if part.outline is not None:
        return 0.0, part.thickness
    shape = None
    if part.turned is not None:
        shape = part.turned.shape
    elif part.bought is not None:
        shape = part.bought.shape
    if shape is None:
        raise GeometryError(f"part {part.name}: a solid that does not say how high it is has no plane")
    return heights(shape)


def plane_of(
    parts: Iterable[Part], levels: Mapping[str, float], mounting: Mounting | GroundPlate | None
) -> Plane:
    """The plane of a stage with its parts; ``levels`` are the heights of its bodies, mm."""
    lows, highs, bottom = [], [], math.inf
    plate = mounting if isinstance(mounting, GroundPlate) else None
    for part in parts:
        low, high = part_heights(part)
        for one in part.instances:
            at = one.z + levels[one.body]
            lows.append(low + at)
            highs.append(high + at)
            if plate is None or one.body != plate.shaft or low + at > plate.end + TOLERANCES.closure:
                bottom = min(bottom, low + at)
    if plate is not None:
        bottom = min(bottom, plate.bare)
    return Plane(min(lows), max(highs), mounting, bottom, dict(levels))


def levels_of(links: tuple[Link, ...], planes: tuple[Plane, ...]) -> tuple[float, ...]:
    """By how much each stage is raised, mm; the first stays where it is."""
    found = [0.0]
    for link, below, plane in zip(links[1:], planes, planes[1:], strict=False):
        air = AIR if link.table.gap is None else link.table.gap
        top = found[-1] + below.high + air
        found.append(top - plane.bottom)
    return tuple(found)
