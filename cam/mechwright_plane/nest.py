"""A nest: several placed parts that are cut from one plate, as one part with several outsides.

Its ``outline`` is the rectangle around all, for stock and travel; ``machined`` and ``details`` are those of
the placed parts, moved. Its ``outlines`` are the true shapes.
"""

import math
from dataclasses import dataclass, replace
from functools import cached_property

import shapely

from mechwright.arrays import turned
from mechwright.contracts.details import moved
from mechwright.contracts.part import Bore, Feature, OpenProfile, Part, Pocket, Profile
from mechwright.geometry import Loop, Outline
from mechwright.geometry.segments import Point


@dataclass(frozen=True)
class Placed:
    """One copy of a part: turned about its axis by ``angle``, rad, then moved to ``x``, ``y``, mm.

    ``label`` tells it from the other copies; features bear it in front of their names.
    """

    part: Part
    label: str
    x: float
    y: float
    angle: float = 0.0

    @cached_property
    def outline(self) -> Outline:
        """Where its plate lies in the nest."""
        assert self.part.outline is not None  # noqa: S101 - only plates are nested
        return self.part.outline.moved(self.x, self.y, self.angle)

    def back(self, shape: shapely.Geometry) -> shapely.Geometry:
        """A shape of the nest in the part's own coordinates."""
        return shapely.transform(shape, lambda p: turned(p - (self.x, self.y), -self.angle))


@dataclass(frozen=True, repr=False)
class Nest(Part):
    """Parts on one plate; ``gap`` is the least distance between any two, mm."""

    placed: tuple[Placed, ...] = ()
    gap: float = 0.0

    @property
    def outlines(self) -> tuple[Outline, ...]:
        """The outline of each placed part, where it lies in the nest."""
        return tuple(one.outline for one in self.placed)

    @property
    def axes(self) -> tuple[Point, ...]:
        """Where the axis of each placed part stands, mm."""
        return tuple((one.x, one.y) for one in self.placed)


def moved_feature(feature: Feature, x: float, y: float, angle: float = 0.0) -> Feature:
    """The feature turned about the origin, rad, then shifted, mm."""
    c, s = math.cos(angle), math.sin(angle)

    def at(point: Point) -> Point:
        return c * point[0] - s * point[1] + x, s * point[0] + c * point[1] + y

    match feature:
        case Bore():
            return replace(feature, centre=at(feature.centre))
        case Profile():
            sites = tuple((at(site), width) for site, width in feature.tab_sites)
            return replace(feature, loop=feature.loop.moved(x, y, angle), tab_sites=sites)
        case OpenProfile():
            return feature.moved(x, y, angle)
        case Pocket():
            islands = tuple(loop.moved(x, y, angle) for loop in feature.islands)
            return replace(feature, boundary=feature.boundary.moved(x, y, angle), islands=islands)


def make_nest(name: str, placed: tuple[Placed, ...], gap: float) -> Nest:
    """The nest of parts that are alike in material and thickness."""
    lefts, lows, rights, highs = zip(*(one.outline.bounds for one in placed), strict=True)
    x0, y0, x1, y1 = min(lefts), min(lows), max(rights), max(highs)
    features = tuple(
        replace(moved_feature(feature, one.x, one.y, one.angle), name=f"{one.label} {feature.name}")
        for one in placed
        for feature in one.part.features
    )
    details = tuple(
        replace(moved(detail, one.x, one.y, one.angle), name=f"{one.label} {detail.name}")
        for one in placed
        for detail in one.part.details
    )
    first = placed[0].part
    return Nest(
        name,
        Outline(Loop.polygon([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])),
        first.thickness,
        first.material,
        colour=first.colour,
        machined=features,
        details=details,
        placed=placed,
        gap=gap,
    )
