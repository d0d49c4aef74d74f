"""Engraved lines and broken edges of a drawing."""

from collections.abc import Iterator, Sequence

import shapely

from mechwright.contracts.details import Chamfer, Engraving, chamfer_lines
from mechwright.contracts.part import Part, Pocket, Profile
from mechwright.drawings.contours import Contour
from mechwright.drawings.doubles import single
from mechwright.drawings.fault import Told, at
from mechwright.drawings.meaning import ENGRAVED, LINE, Meaning
from mechwright.drawings.strokes import Stroke
from mechwright.errors import GeometryError
from mechwright.geometry import Loop, circle
from mechwright.geometry.prepared import prepared

CHORD = 0.01
"""Chord error of engraved curves, mm: a sixtieth of their width."""
NEAR = 0.02
"""A line within this of where a chamfer ends, mm, is that line."""


def engraving(
    name: str, meant: Meaning, strokes: Sequence[Stroke], plate: Contour, thickness: float, told: Told
) -> Engraving | None:
    """Lines engraved along strokes; a fault where they leave the plate or go through it."""
    depth, width = meant.depth or ENGRAVED, meant.width or LINE
    if depth >= thickness:
        told.fault(
            "feature", f"lines engraved {depth:g} mm deep go through the plate", "engrave less", "layers"
        )
        return None
    pieces = single([(segment, stroke) for stroke in strokes for segment in stroke.segments], told)
    lines = [shapely.LineString(segment.flatten(CHORD)) for segment, _ in pieces]
    rim = plate.shape
    for line, (segment, stroke) in zip(lines, pieces, strict=True):
        if not shapely.intersects(rim, line):
            said = f"the engraved line of {stroke.name} at {at(segment.start)} lies beside the plate"
            told.fault("feature", said, "engrave on the plate")
        elif not shapely.covers(rim, line):
            told.note(f"the engraved line of {stroke.name} at {at(segment.start)} leaves the plate")
    merged = shapely.get_parts(shapely.line_merge(shapely.multilinestrings(lines)))
    made = tuple(tuple((float(x), float(y)) for x, y in line.coords) for line in merged)
    return Engraving(name, made, depth, width)


def chamfers(part: Part, meant: Meaning, contours: Sequence[Contour], told: Told) -> list[Chamfer]:
    """The edges that contours break: a contour lies on the edge itself, or where the chamfer ends."""
    assert meant.width is not None  # noqa: S101 - a chamfer has one
    found: list[Chamfer] = []
    edges = [
        Chamfer(f"edge-{name}", loop, "outside" if side else "inside", meant.width)
        for name, loop, side in _edges(part)
    ]
    for contour in contours:
        edge = next((one for one in edges if is_edge(contour, one)), None)
        if edge is None:
            told.fault(
                "feature",
                f"the contour of {contour.name} is no edge of the plate, nor where a chamfer of "
                f"{meant.width:g} mm ends",
                "draw it on the edge",
            )
        elif edge not in found:
            found.append(edge)
    return found


def _edges(part: Part) -> Iterator[tuple[str, Loop, bool]]:
    """Name, loop and whether it is the rim, of every edge of the top face."""
    assert part.outline is not None  # noqa: S101 - a plate has one
    yield "outside", part.outline.outer, True
    for feature in part.features:
        if feature.top > 0:
            continue
        match feature:
            case Pocket():
                yield feature.name, feature.boundary, False
                for number, island in enumerate(feature.islands, start=1):
                    yield f"{feature.name}-island-{number}", island, True
            case Profile(side="inside"):
                yield feature.name, feature.loop, False
            case Profile():
                continue
            case _:
                yield feature.name, Loop((circle(feature.centre, feature.diameter / 2),)), False


def is_edge(contour: Contour, edge: Chamfer) -> bool:
    """Whether a contour is the edge that a chamfer breaks, or where the chamfer ends."""
    ring = shapely.LinearRing(contour.loop.flatten())
    if _near(ring, [edge.loop]):
        return True
    try:
        return _near(ring, chamfer_lines(edge))
    except GeometryError:
        return False


def _near(ring: shapely.LinearRing, loops: Sequence[Loop]) -> bool:
    return any(alike(ring, shapely.LinearRing(loop.flatten())) for loop in loops)


def alike(one: shapely.LinearRing, other: shapely.LinearRing) -> bool:
    """Whether neither of two rings is anywhere farther than :data:`NEAR` from the other."""
    if max(abs(a - b) for a, b in zip(one.bounds, other.bounds, strict=True)) > NEAR:
        return False
    return all(shapely.covers(prepared(shapely.buffer(a, NEAR)), b) for a, b in ((one, other), (other, one)))
