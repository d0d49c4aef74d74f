"""The contours of a plate as its table of corners has them: outline, openings, recesses."""

from dataclasses import dataclass

from mechwright.contracts.part import OpenProfile, Part, Pocket, Profile, is_outside
from mechwright.geometry import Arc, BSpline, Line, Loop
from mechwright.geometry.segments import Point
from mechwright_cad.sheet.words import number

MOST = 60
"""Corners that a table holds; a contour that brings more is told by its drawing in DXF."""


@dataclass(frozen=True)
class Contour:
    """A loop, its name on the drawing, and how deep it is cut."""

    name: str
    loop: Loop
    words: str


@dataclass(frozen=True)
class Corner:
    """A corner of a contour, and what leads from it to the next one.

    ``radius`` is that of an arc, mm, positive where it turns to the left, 0 for a straight line.
    """

    name: str
    at: Point
    radius: float
    centre: Point | None

    def words(self, datum: Point) -> str:
        """What leads to the next corner."""
        if self.centre is None:
            return "straight"
        x, y = (number(value) for value in shifted(self.centre, datum))
        way = "left" if self.radius > 0 else "right"
        return f"R{number(abs(self.radius))} {way}, centre {x}, {y}"


def shifted(point: Point, datum: Point) -> Point:
    """A place as it is measured from the datum, mm; never -0."""
    return round(point[0] - datum[0], 3) + 0.0, round(point[1] - datum[1], 3) + 0.0


def contours(part: Part) -> tuple[Contour, ...]:
    """The rim first, then openings that are no bores, then recesses."""
    rims, openings, recesses = [], [], []
    for feature in part.features:
        if is_outside(feature):
            rims.append((feature.loop, "outline"))
        elif isinstance(feature, Profile):
            through = feature.top + feature.depth >= part.thickness
            words = "through" if through else _deep(feature.top, feature.depth)
            openings.append((feature.loop, f"opening, {words}"))
        elif isinstance(feature, Pocket):
            recesses += [(feature.boundary, _of_recess(feature))]
            recesses += [(island, "island") for island in feature.islands]
    found = [*rims, *openings, *recesses]
    return tuple(Contour(f"{count}", loop, words) for count, (loop, words) in enumerate(found, start=1))


def _deep(top: float, depth: float) -> str:
    return f"{number(depth)} deep" + (f" from {number(top)} on" if top > 0 else "")


def _of_recess(feature: Pocket) -> str:
    words = f"recess, {_deep(feature.top, feature.depth)}"
    if feature.floor_radius > 0:
        words += f", floor R{number(feature.floor_radius)}"
    if isinstance(feature, OpenProfile):
        return words + f", {number(feature.width)} wide"
    return words


def is_table(of: tuple[Contour, ...]) -> bool:
    """Whether lines and arcs alone make the contours, few enough for a table."""
    segments = [segment for one in of for segment in one.loop.segments]
    return len(segments) <= MOST and not any(isinstance(one, BSpline) for one in segments)


def circle_of(loop: Loop) -> Arc | None:
    """The whole circle that a loop is."""
    first = loop.segments[0]
    return first if loop.is_circle and isinstance(first, Arc) else None


def corners(of: Contour) -> tuple[Corner, ...]:
    """The corners of a contour in their order; none of a circle."""
    if circle_of(of.loop) is not None:
        return ()
    found = []
    for count, segment in enumerate(of.loop.segments, start=1):
        match segment:
            case Line():
                radius, centre = 0.0, None
            case Arc():
                radius = segment.radius if segment.sweep > 0 else -segment.radius
                centre = segment.centre
            case _:
                raise TypeError(f"{type(segment).__name__} has no row in a table of corners")
        found.append(Corner(f"{of.name}.{count}", segment.start, radius, centre))
    return tuple(found)
