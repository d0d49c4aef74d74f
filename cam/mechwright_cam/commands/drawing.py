"""A plate part from a DXF drawing of anybody: one outline, and the openings in it. Imports ezdxf.

Lines, arcs and circles, also those of polylines and blocks, are taken as they are; ellipses and splines
become chords that stay within half a micrometre. Text, dimensions and hatches are left out, and so are lines
that are not drawn through, such as centre lines.
"""

import math
import re
from collections.abc import Iterator, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import shapely

from mechwright.contracts.part import Part
from mechwright.errors import DesignError, GeometryError
from mechwright.geometry import Arc, Line, Loop, Outline, Segment, circle
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES

UNITS = {1: 25.4, 4: 1.0, 5: 10.0, 6: 1000.0, 13: 0.001}
"""$INSUNITS to mm: inches, millimetres, centimetres, metres, micrometres."""
NAMED = {"mm": 1.0, "cm": 10.0, "inch": 25.4}
"""Units that may be said where a drawing says none."""
OURS = ("OUTLINE", "BORE", "OPENING")
"""Layers of our own drawings that hold what is cut through."""
JOIN = 0.01
"""Ends nearer than this meet, mm: what drawings are rounded to."""
CHORD = TOLERANCES.outline / 2
"""Chord error of ellipses and splines, mm."""
THROUGH = frozenset({"continuous", "bylayer", "byblock", ""})
"""Line types that draw a line through."""

Edge = tuple[Segment, ...]


def read_drawing(
    path: Path, thickness: float, material: str, units: str = "", layers: Sequence[str] = ()
) -> Part:
    """The part that a drawing shows.

    Raises DesignError that names the file, what is wrong, where, and what to do.
    """
    try:
        return _part(path, thickness, material, units, layers)
    except GeometryError as error:
        raise DesignError(f"{path}: {error}") from error


def _part(path: Path, thickness: float, material: str, units: str, layers: Sequence[str]) -> Part:
    document = _document(path)
    scale = _scale(path, int(document.header.get("$INSUNITS", 0)), units)
    known = sorted({str(layer.dxf.name) for layer in document.layers})
    for name in layers:
        if name not in known:
            raise DesignError(f"{path}: --layers: there is no layer {name!r}; it has: {', '.join(known)}")
    wanted = set(layers) or (set(OURS) if "OUTLINE" in known else set())
    edges, closed = list[Edge](), list[Edge]()
    for edge in _edges(document, wanted, scale):
        start, end = edge[0].start, edge[-1].end
        (closed if math.dist(start, end) <= JOIN else edges).append(edge)
    loops = [Loop(_bridged(edge)) for edge in [*closed, *_chained(path, edges)]]
    name = re.sub(r"[^a-z0-9]+", "-", path.stem.lower()).strip("-") or "part"
    return Part(name[:40].strip("-"), _outline(path, loops), thickness, material)


def _document(path: Path) -> Any:
    from ezdxf.filemanagement import readfile

    try:
        return readfile(path)
    except OSError as error:
        raise DesignError(f"{path}: cannot be read as DXF: {error.strerror or error}") from error
    except Exception as error:  # whatever a broken file makes ezdxf raise
        reason = " ".join(f"{type(error).__name__}: {error}".split())[:200]
        raise DesignError(f"{path}: is no DXF drawing that can be read ({reason})") from error


def _scale(path: Path, code: int, units: str) -> float:
    """Length of a unit of the drawing, mm."""
    if units:
        if units not in NAMED:
            raise DesignError(f"--units: {units!r} is not known; one of: {', '.join(NAMED)}")
        return NAMED[units]
    if code not in UNITS:
        raise DesignError(
            f"{path}: says no unit that a mill knows ($INSUNITS {code}); say it with --units: "
            f"{', '.join(NAMED)}"
        )
    return UNITS[code]


def _edges(document: Any, wanted: set[str], scale: float) -> Iterator[Edge]:
    """What is drawn through on the wanted layers, or on all that are shown, mm."""
    from ezdxf.disassemble import recursive_decompose

    for entity in recursive_decompose(document.modelspace()):
        name = str(entity.dxf.layer)
        layer = document.layers.get(name) if name in document.layers else None
        if wanted and name not in wanted:
            continue
        if not wanted and (name.lower() == "defpoints" or (layer and (layer.is_off() or layer.is_frozen()))):
            continue
        kind = str(entity.dxf.get("linetype", "bylayer")).lower()
        if kind in {"bylayer", ""} and layer is not None:
            kind = str(layer.dxf.linetype).lower()
        if wanted or kind in THROUGH:
            yield from _edge(entity, scale)


def _edge(entity: Any, scale: float) -> Iterator[Edge]:
    """The edges of one entity: one, or none for what is no curve."""
    kind = entity.dxftype()
    if kind in {"LWPOLYLINE", "POLYLINE"}:
        parts = (edge for part in entity.virtual_entities() for edge in _edge(part, scale))
        segments = tuple(one for edge in parts for one in edge)
        if segments:
            yield segments
    elif kind == "LINE":
        ends = _at(entity.dxf.start, scale), _at(entity.dxf.end, scale)
        if math.dist(*ends) > TOLERANCES.closure:
            yield (Line(*ends),)
    elif kind in {"ARC", "CIRCLE"}:
        yield (_arc(entity, scale),)
    elif kind in {"ELLIPSE", "SPLINE"}:
        points = [_at(point, scale) for point in entity.flattening(CHORD / scale, 16)]
        lines = tuple(Line(a, b) for a, b in pairwise(points) if math.dist(a, b) > TOLERANCES.closure)
        if lines:
            yield lines


def _arc(entity: Any, scale: float) -> Segment:
    over = entity.dxf.extrusion.z < 0  # drawn from below: X runs the other way
    x, y = _at(entity.dxf.center, scale)
    centre, radius = (-x if over else x, y), float(entity.dxf.radius) * scale
    if entity.dxftype() == "CIRCLE":
        return circle(centre, radius)
    first = math.radians(entity.dxf.start_angle)
    sweep = (math.radians(entity.dxf.end_angle) - first) % math.tau or math.tau
    return Arc(centre, radius, math.pi - first, -sweep) if over else Arc(centre, radius, first, sweep)


def _at(point: Any, scale: float) -> Point:
    return float(point[0]) * scale, float(point[1]) * scale


def _chained(path: Path, edges: list[Edge]) -> Iterator[Edge]:
    """Closed chains of edges that meet end to end; raises DesignError where one ends, or three meet."""
    near: dict[tuple[int, int], list[tuple[int, Point]]] = {}
    for number, edge in enumerate(edges):
        for x, y in (edge[0].start, edge[-1].end):
            near.setdefault((math.floor(x / JOIN), math.floor(y / JOIN)), []).append((number, (x, y)))

    def others(at: Point, own: int) -> list[int]:
        column, row = math.floor(at[0] / JOIN), math.floor(at[1] / JOIN)
        cells = ((column + i, row + j) for i in (-1, 0, 1) for j in (-1, 0, 1))
        found = (one for cell in cells for one in near.get(cell, ()))
        return [number for number, place in found if number != own and math.dist(place, at) <= JOIN]

    left = set(range(len(edges)))
    while left:
        number = min(left)
        left.remove(number)
        chain = list(edges[number])
        while math.dist(chain[0].start, chain[-1].end) > JOIN:
            at = chain[-1].end
            following = others(at, number)
            if len(following) != 1:
                said = "ends, and no other line begins" if not following else "meets two others"
                cure = (
                    "close the outline" if not following else "delete what is drawn twice, or name --layers"
                )
                raise DesignError(f"{path}: a line {said} at X{at[0]:.3f} Y{at[1]:.3f}; {cure}")
            (number,) = following
            if number not in left:
                raise DesignError(
                    f"{path}: lines run into each other at X{at[0]:.3f} Y{at[1]:.3f}; close the outline"
                )
            left.remove(number)
            edge = edges[number]
            if math.dist(edge[0].start, at) > JOIN:
                edge = tuple(one.reversed() for one in reversed(edge))
            chain += edge
        yield tuple(chain)


def _bridged(edge: Edge) -> Edge:
    """The same chain, with short lines where ends meet only nearly."""
    found: list[Segment] = []
    for one, two in zip(edge, (*edge[1:], edge[0]), strict=True):
        found.append(one)
        if math.dist(one.end, two.start) > TOLERANCES.closure:
            found.append(Line(one.end, two.start))
    return tuple(found)


def _outline(path: Path, loops: list[Loop]) -> Outline:
    """One outline of loops in any order; raises DesignError where they are none, or more."""
    if not loops:
        raise DesignError(f"{path}: shows no closed outline; draw one, or name its layers with --layers")
    shapes = [shapely.Polygon(loop.flatten()) for loop in loops]
    for shape in shapes:
        if not shape.is_valid:
            where = shapely.is_valid_reason(shape)
            raise DesignError(f"{path}: an outline crosses itself ({where}); draw it as one simple loop")
    order = sorted(range(len(loops)), key=lambda k: -shapes[k].area)
    outer, inner = order[0], order[1:]
    for k in inner:
        x, y = shapes[k].representative_point().coords[0]
        if not shapely.contains(shapes[outer], shapes[k]):
            what = "cross each other" if shapely.intersects(shapes[outer], shapes[k]) else "lie side by side"
            raise DesignError(
                f"{path}: two outlines {what}, one of them at X{x:.3f} Y{y:.3f}; draw one part, with its "
                "openings"
            )
        if any(shapely.intersects(shapes[k], shapes[j]) for j in inner if j < k):
            raise DesignError(
                f"{path}: openings meet, or lie in each other, at X{x:.3f} Y{y:.3f}; draw one part, and its "
                "recesses on a layer that --layers leaves out"
            )

    def turned(loop: Loop, *, ccw: bool) -> Loop:
        return loop if (loop.area > 0) == ccw else loop.reversed()

    return Outline(turned(loops[outer], ccw=True), tuple(turned(loops[k], ccw=False) for k in sorted(inner)))
