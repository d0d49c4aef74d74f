"""Text engraved on a plate's top face, in the freest place there is; and the dots of fitting marks."""

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from mechwright.arrays import turned
from mechwright.contracts.details import Chamfer, Engraving, Thread, band_of
from mechwright.contracts.fitting_marks import rings
from mechwright.contracts.part import Part
from mechwright.contracts.sections import sections
from mechwright.errors import GeometryError
from mechwright.geometry import circle
from mechwright.geometry.lettering import Strokes, lettering
from mechwright.geometry.segments import Point

if TYPE_CHECKING:
    import shapely

LEAST_HEIGHT = 1.5
"""Lowest letters, mm: lower ones run together under a line of 0.3 mm."""
MARGIN = 0.5
"""Least from a line to the next edge, mm."""
CHORD = 0.01
"""Chord error of the edges that a place keeps away from, mm: a fiftieth of the margin."""
NEAR = 0.05
"""How near to the freest place a mark stands, mm."""
_HALVINGS = 7
"""Steps in which the highest letters are looked for that find a place: to a hundredth of the height."""


def marked(part: Part, text: str, height: float = 4.0, depth: float = 0.2, line: float = 0.6) -> Part:
    """The plate with a line of text engraved where most room is: level, upright, or along the plate.

    Parameters
    ----------
    part
        A plate with all its other details: the text keeps clear of them.
    text
        What :func:`~mechwright.geometry.lettering.lettering` can write.
    height
        Of capitals, mm.
    depth, line
        Of the lines, and the widest that they may be, mm.

    Raises
    ------
    DesignError
        A character is not in the font.
    GeometryError
        Nowhere is room for the text; the message says for what there is.
    """
    if depth >= part.thickness:
        raise GeometryError(
            f"a mark {depth:g} mm deep goes through part {part.name}, {part.thickness:g} mm thick"
        )
    if not lettering(text, height):
        raise GeometryError(f"the mark {text!r} of part {part.name} has nothing to engrave")
    free = _free(part, line / 2 + MARGIN)
    found = _place(free, text, height)
    if found is None:
        raise GeometryError(
            f"no free place on part {part.name} for the mark {text!r} in letters of {height:g} mm; "
            + _instead(free, text, height)
        )
    return replace(
        part, details=(*part.details, Engraving("mark", lettering(text, height, *found), depth, line))
    )


FITTING_MARKS = "fitting-marks"
"""Name of the engraving that is all dots of a part."""


def engraved_dots(part: Part, depth: float = 0.2, line: float = 0.6) -> Part:
    """The plate with the dots of its fitting marks, ``depth`` mm deep in lines at most ``line`` mm wide.

    Raises GeometryError for a depth that goes through the part.
    """
    strokes = tuple(ring for mark in part.marks for ring in rings(mark))
    if not strokes:
        return part
    if depth >= part.thickness:
        raise GeometryError(
            f"dots {depth:g} mm deep go through part {part.name}, {part.thickness:g} mm thick"
        )
    return replace(part, details=(*part.details, Engraving(FITTING_MARKS, strokes, depth, line)))


def _instead(free: "shapely.Geometry", text: str, height: float) -> str:
    """What to do where there is no room; a height that is named has been tried."""
    low, high = LEAST_HEIGHT, height
    if height <= low or _place(free, text, low) is None:
        return f"shorten it: not even letters of {min(low, height):g} mm find one"
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        low, high = (middle, high) if _place(free, text, middle) is not None else (low, middle)
    tenths = math.floor(low * 10) / 10
    return f"letters of {tenths:g} mm find one"


def _free(part: Part, margin: float) -> "shapely.Geometry":
    """Where the middle of a line may run: the top face, ``margin`` mm from its edges and its details."""
    import shapely

    top = sections(part, CHORD, steps=0)[0].shape
    for detail in part.details:
        match detail:
            case Chamfer():
                top = shapely.difference(top, band_of(detail, 0.0, CHORD))
            case Thread():
                top = shapely.difference(
                    top, shapely.Polygon(circle(detail.centre, detail.diameter / 2).flatten(CHORD))
                )
            case Engraving():
                strokes = shapely.multilinestrings([shapely.LineString(stroke) for stroke in detail.strokes])
                top = shapely.difference(top, shapely.buffer(strokes, detail.width / 2))
    return shapely.simplify(shapely.buffer(top, -margin), CHORD)


def _place(free: "shapely.Geometry", text: str, height: float) -> tuple[Point, float] | None:
    """Middle and angle, rad, of a line of text within the free part of a face."""
    import shapely

    for angle in _angles(free):
        c, s = math.cos(angle), math.sin(angle)
        level = shapely.transform(free, lambda p, angle=angle: turned(p, -angle))
        room = _eroded(level, lettering(text, height))
        if shapely.area(room) > NEAR**2:
            deepest = shapely.maximum_inscribed_circle(room, NEAR)
            x, y = shapely.get_coordinates(deepest)[0].tolist()
            return (round(c * x - s * y, 3), round(s * x + c * y, 3)), angle
    return None


def _angles(free: "shapely.Geometry") -> Iterator[float]:
    """Level, upright, along the longer side of the plate, and across it."""
    import shapely

    yield 0.0
    yield math.pi / 2
    corners = shapely.get_coordinates(shapely.minimum_rotated_rectangle(free))
    if len(corners) >= 4:
        one, two = np.diff(corners, axis=0)[:2]
        along = one if np.hypot(*one) >= np.hypot(*two) else two
        angle = math.atan2(along[1], along[0]) % math.pi
        angle -= math.pi if angle > math.pi / 2 else 0.0  # read from below or from the right
        yield angle
        yield angle + math.pi / 2 if angle <= 0 else angle - math.pi / 2


def _eroded(region: "shapely.Geometry", strokes: Strokes) -> "shapely.Geometry":
    """Where the middle of strokes may stand so that the rectangle round them lies in a region."""
    points = np.concatenate([np.asarray(stroke) for stroke in strokes])
    (x0, y0), (x1, y1) = points.min(axis=0), points.max(axis=0)
    # The middle itself is held too: letters such as _ stand below it.
    return _swept(_swept(region, min(x0, 0.0), max(x1, 0.0), 0), min(y0, 0.0), max(y1, 0.0), 1)


def _swept(region: "shapely.Geometry", low: float, high: float, axis: int) -> "shapely.Geometry":
    """The points of a region from which it holds all points from ``low`` to ``high`` mm along an axis."""
    import shapely

    shifts = np.zeros((2, 2))
    shifts[:, axis] = -low, -high
    swept = []
    for ring in shapely.get_rings(shapely.get_parts(region)):
        points = shapely.get_coordinates(ring)
        ends = np.stack([points[:-1], points[1:]], axis=1)  # (edges, ends, 2)
        corners = (ends[:, :, None, :] + shifts).reshape(len(ends), 4, 2)
        swept.append(shapely.convex_hull(shapely.multipoints(list(corners))))
    if not swept:
        return region
    return shapely.difference(region, shapely.union_all(np.concatenate(swept)))
