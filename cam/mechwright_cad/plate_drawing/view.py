"""The plan of a plate and its edge, as strokes of a sheet."""

import math
from collections.abc import Callable, Iterator

import shapely

from mechwright.contracts.details import Chamfer, Engraving, Thread, chamfer_lines
from mechwright.contracts.part import Bore, OpenProfile, Part, Pocket, Profile, is_outside
from mechwright.geometry import Loop, circle
from mechwright.geometry.segments import Point
from mechwright.geometry.trim import stretches
from mechwright_cad.sheet.sheet import Layer, Sheet

To = Callable[[Point], Point]
Line = tuple[Layer, tuple[Point, ...]]

CHORD = 0.02
"""How far chords of a curve are off it on the paper, mm."""

OVERHANG = 2.0
"""How far a centre line goes beyond its circle, mm."""


def plan(part: Part, scale: float) -> Iterator[Line]:
    """Layer and points of each line of the plan, mm of the part."""
    chord = CHORD / scale
    plate = shapely.union_all([outline.polygon() for outline in part.outlines])
    for feature in part.features:
        match feature:
            case Bore():
                yield "OUTLINE", _circle(feature.centre, feature.diameter / 2, chord)
                yield from _cross(feature.centre, feature.diameter / 2 + OVERHANG / scale)
            case Profile():
                yield "OUTLINE", _points(feature.loop, chord)
            case Pocket():
                for loop in (feature.boundary, *feature.islands):
                    for edge in stretches(loop, plate):
                        yield "OUTLINE", tuple(map(tuple, edge.flatten(chord).tolist()))
                if isinstance(feature, OpenProfile) and feature.side == "on":
                    for edge in feature.path:
                        yield "CENTRE", tuple(map(tuple, edge.flatten(chord).tolist()))
    for detail in part.details:
        match detail:
            case Thread():
                start, sweep = math.radians(100), math.radians(270)
                turn = _turn(detail.diameter / 2, chord)
                steps = max(math.ceil(sweep / turn), 8)
                x, y, r = *detail.centre, detail.diameter / 2
                yield (
                    "DIM",
                    tuple(
                        (
                            x + r * math.cos(start + sweep * k / steps),
                            y + r * math.sin(start + sweep * k / steps),
                        )
                        for k in range(steps + 1)
                    ),
                )
            case Chamfer():
                for loop in chamfer_lines(detail):
                    for edge in stretches(loop, plate):
                        yield "DIM", tuple(map(tuple, edge.flatten(chord).tolist()))
            case Engraving():
                for stroke in detail.strokes:
                    yield "DIM", stroke


def edge(part: Part, *, third_angle: bool) -> Iterator[Line]:
    """The plate seen along its plane, mm: x to the right is the thickness, y the part's own.

    In the first angle it is seen from the left and its upper face stands on the right; in the third angle it
    is seen from the right, and its upper face stands on the left. Recesses and blind holes are hidden.
    """
    thick = part.thickness
    _, low, _, high = bounds(part)

    def at(depth: float) -> float:
        return depth if third_angle else thick - depth

    yield "OUTLINE", ((0.0, low), (thick, low), (thick, high), (0.0, high), (0.0, low))
    for feature in part.features:
        if isinstance(feature, Bore):
            centre = feature.centre[1]
            yield "CENTRE", ((-0.1 * thick, centre), (1.1 * thick, centre))
        if is_outside(feature) or feature.top + feature.depth >= thick:
            continue
        y0, y1 = _reach(feature)
        y0, y1, top, floor = max(y0, low), min(y1, high), at(feature.top), at(feature.top + feature.depth)
        yield "HIDDEN", ((top, y0), (floor, y0), (floor, y1), (top, y1))


def _reach(feature: Bore | Profile | Pocket) -> tuple[float, float]:
    match feature:
        case Bore():
            return feature.centre[1] - feature.diameter / 2, feature.centre[1] + feature.diameter / 2
        case Profile():
            rows = feature.loop.flatten()
        case Pocket():
            rows = feature.boundary.flatten()
    return float(rows[:, 1].min()), float(rows[:, 1].max())


def bounds(part: Part) -> tuple[float, float, float, float]:
    """Least x and y, greatest x and y of the plan, mm."""
    return tuple(shapely.union_all([outline.polygon() for outline in part.outlines]).bounds)


def draw(sheet: Sheet, lines: Iterator[Line] | list[Line], to: To) -> None:
    """Draw lines of the part, brought to the paper by ``to``."""
    for layer, points in lines:
        sheet.lines([to(point) for point in points], layer)


def _circle(centre: Point, radius: float, chord: float) -> tuple[Point, ...]:
    return tuple(map(tuple, circle(centre, radius).flatten(chord).tolist()))


def _turn(radius: float, chord: float) -> float:
    return 2 * math.acos(max(1 - chord / radius, 0.0))


def _points(loop: Loop, chord: float) -> tuple[Point, ...]:
    rows = loop.flatten(chord).tolist()
    return tuple(map(tuple, [*rows, rows[0]]))


def _cross(centre: Point, arm: float) -> Iterator[Line]:
    x, y = centre
    yield "CENTRE", ((x - arm, y), (x + arm, y))
    yield "CENTRE", ((x, y - arm), (x, y + arm))
