"""Plates with chamfers as solids. Imports the CAD kernel.

A chamfer belongs to an edge of the top face: of the outline, or of a recess that begins there. The plate is
made with the broken edges of its outline at once; recesses are cut with broken edges of their own. The whole
is held against the part's volume afterwards.

Engraved lines stay curves on the top face. As V-shaped grooves with pointed ends the kernel takes 15 ms for
each stroke (1.1 s for seven letters, twenty times the rest of such a plate), cuts one text in 24 to pieces,
and leaves holes in the triangles of every third.
"""

from collections.abc import Sequence

import cadquery as cq
import numpy as np
import shapely
from OCP.BRepFilletAPI import BRepFilletAPI_MakeChamfer
from OCP.Standard import Standard_Failure
from OCP.StdFail import StdFail_NotDone

from mechwright.contracts.details import Chamfer
from mechwright.contracts.part import Feature, Part
from mechwright.contracts.sections import blind
from mechwright.errors import GeometryError
from mechwright.geometry import Loop
from mechwright.geometry.prepared import prepared
from mechwright.tolerances import TOLERANCES
from mechwright_cad.solids.broken_edges import Edge, body
from mechwright_cad.solids.recess_tools import cut_out, edges_of, round_floored, taken

SAME_LOOP = 4 * TOLERANCES.flatten
"""A chamfer follows an edge if the two are no further apart than this, mm, on the mean."""
ABOVE = 0.25
"""Tools of broken edges go on above the top face by this share of their width: no face of theirs is in it."""


def detailed(part: Part) -> cq.Solid:
    """The solid of a plate that has details, unchecked.

    Raises GeometryError for a chamfer that follows no edge of the top face, or is too wide, and for a recess
    that the kernel cannot cut.
    """
    assert part.outline is not None  # noqa: S101 - asked for plates only
    chamfers = {detail.name: detail for detail in part.details if isinstance(detail, Chamfer)}
    edges = [
        Edge(loop, _width(chamfers, loop, "outside" if place == 0 else "inside"))
        for place, loop in enumerate(part.outline.loops)
    ]
    tools: list[cq.Shape] = [_tool(feature, part, chamfers) for feature in blind(part)]
    if chamfers:
        name = next(iter(chamfers))
        raise GeometryError(f"chamfer {name} follows no edge of the top face on its side; draw it along one")
    whole = _plate(edges, part.thickness)
    return cut_out(whole, tools) if tools else whole


def _plate(edges: Sequence[Edge], thickness: float) -> cq.Solid:
    """The plate with its broken edges; where a parallel is not regular, by the kernel's own chamfer."""
    try:
        return body(edges, 0.0, thickness)
    except GeometryError as error:
        made = body([Edge(edge.loop) for edge in edges], 0.0, thickness)
        for edge in edges:
            if edge.width:
                made = _chamfered(made, edge, thickness, error)
        return made


def _chamfered(whole: cq.Solid, edge: Edge, thickness: float, error: GeometryError) -> cq.Solid:
    """The kernel's chamfer along a loop; ``error`` says what else was tried."""
    ring = prepared(shapely.LinearRing(edge.loop.flatten()))
    maker = BRepFilletAPI_MakeChamfer(whole.wrapped)
    for one in whole.Edges():
        points = [one.positionAt(t) for t in (0.0, 0.5, 1.0)]
        flat = shapely.points([(p.x, p.y) for p in points])
        level = all(abs(p.z - thickness) < TOLERANCES.closure for p in points)
        if level and shapely.dwithin(ring, flat, SAME_LOOP).all():
            maker.Add(edge.width, one.wrapped)
    try:
        made = cq.Shape.cast(maker.Shape()).Solids()
    except (Standard_Failure, StdFail_NotDone) as failure:
        raise error from failure
    if len(made) != 1 or not made[0].isValid():
        raise error
    return made[0]


def _width(chamfers: dict[str, Chamfer], loop: Loop, side: str) -> float:
    """Width of the chamfer on a loop, 0 if there is none; it is taken from the list."""
    for name, chamfer in chamfers.items():
        if chamfer.side == side and (chamfer.loop is loop or _alike(chamfer.loop, loop)):
            del chamfers[name]
            return chamfer.width
    return 0.0


def _alike(one: Loop, two: Loop) -> bool:
    a, b = shapely.Polygon(one.flatten()), shapely.Polygon(two.flatten())
    if np.abs(np.subtract(a.bounds, b.bounds)).max() > SAME_LOOP:
        return False
    return bool(shapely.symmetric_difference(a, b).area < SAME_LOOP * a.length)


def _tool(feature: Feature, part: Part, chamfers: dict[str, Chamfer]) -> cq.Shape:
    """The body that a recess takes out of the plate, its broken edges with it."""
    walls = edges_of(feature)
    widths = [_width(chamfers, loop, side) if feature.top <= 0 else 0.0 for loop, side in walls]
    if not any(widths):
        return taken(feature, part)
    beyond = ABOVE * max(widths)
    loops = [loop for loop, _ in walls]
    edges = [
        Edge(loop, width + beyond if width else 0.0, -1) for loop, width in zip(loops, widths, strict=True)
    ]
    solid = body(edges, part.thickness - feature.depth, part.thickness + beyond)
    return round_floored(solid, feature, part)
