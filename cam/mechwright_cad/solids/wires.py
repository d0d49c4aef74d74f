"""Wires and prisms of the CAD kernel: every segment becomes exactly one edge and one wall. Imports it."""

import math
from collections.abc import Iterable, Sequence
from itertools import pairwise

import cadquery as cq
import numpy as np
from OCP.BRep import BRep_Builder
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeFace, BRepBuilderAPI_MakeVertex
from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
from OCP.Geom import Geom_BSplineCurve, Geom_Circle, Geom_Curve
from OCP.gp import gp_Ax2, gp_Dir, gp_Pln, gp_Pnt, gp_Vec
from OCP.TColgp import TColgp_Array1OfPnt
from OCP.TColStd import TColStd_Array1OfInteger, TColStd_Array1OfReal
from OCP.TopoDS import TopoDS_Edge, TopoDS_Face, TopoDS_Vertex, TopoDS_Wire

from mechwright.errors import GeometryError
from mechwright.geometry import Arc, BSpline, Line, Loop, Outline, Segment
from mechwright.geometry.segments import Point

UP = gp_Dir(0.0, 0.0, 1.0)
DOWN = gp_Dir(0.0, 0.0, -1.0)


def wire_of(loop: Loop, z: float = 0.0) -> tuple[TopoDS_Wire, list[TopoDS_Edge]]:
    """A closed wire at a height, mm, and its edges, one for each segment; neighbours share their vertex.

    The parameter of an edge is the angle run on an arc, the segment's own on a spline.
    """
    segments = loop.segments
    # A vertex in the middle of the gap (at most the kernel's tolerance) is near enough to both ends.
    vertices = [
        vertex(((one.end[0] + two.start[0]) / 2, (one.end[1] + two.start[1]) / 2), z)
        for one, two in zip((segments[-1], *segments[:-1]), segments, strict=True)
    ]
    pairs = pairwise([*vertices, vertices[0]])
    edges = [_edge(segment, start, end, z) for segment, (start, end) in zip(segments, pairs, strict=True)]
    return closed_wire(edges), edges


def closed_wire(edges: Sequence[TopoDS_Edge]) -> TopoDS_Wire:
    """Edges that share their vertices, in order."""
    wire, builder = TopoDS_Wire(), BRep_Builder()
    builder.MakeWire(wire)
    for edge in edges:
        builder.Add(wire, edge)
    wire.Closed(True)
    return wire


def vertex(point: Point, z: float) -> TopoDS_Vertex:
    """A vertex at a height, mm."""
    return BRepBuilderAPI_MakeVertex(gp_Pnt(point[0], point[1], z)).Vertex()


def _edge(segment: Segment, start: TopoDS_Vertex, end: TopoDS_Vertex, z: float) -> TopoDS_Edge:
    match segment:
        case Line():
            edge = BRepBuilderAPI_MakeEdge(start, end)
        case Arc():
            edge = BRepBuilderAPI_MakeEdge(circle_at(segment, z), start, end, 0.0, abs(segment.sweep))
        case BSpline():
            edge = BRepBuilderAPI_MakeEdge(_spline(segment, z), start, end, 0.0, 1.0)
    if not edge.IsDone():
        x, y = segment.start
        raise GeometryError(f"the segment at ({x:.6f}, {y:.6f}) gives no edge ({edge.Error().name})")
    return edge.Edge()


def circle_at(arc: Arc, z: float) -> Geom_Circle:
    """A circle whose parameter is the angle run from the arc's start, clockwise if the arc is."""
    along = gp_Dir(math.cos(arc.start_angle), math.sin(arc.start_angle), 0.0)
    axes = gp_Ax2(gp_Pnt(arc.centre[0], arc.centre[1], z), UP if arc.sweep > 0 else DOWN, along)
    return Geom_Circle(axes, arc.radius)


def _spline(spline: BSpline, z: float) -> Geom_Curve:
    values, counts = np.unique(spline.knots, return_counts=True)
    knots, folds = knots_of(values.tolist(), counts.tolist())
    return Geom_BSplineCurve(poles_of((x, y, z) for x, y in spline.points), knots, folds, spline.degree)


def poles_of(points: Iterable[Sequence[float]]) -> TColgp_Array1OfPnt:
    """Points in space as the kernel takes them."""
    made = [gp_Pnt(*point) for point in points]
    poles = TColgp_Array1OfPnt(1, len(made))
    for place, point in enumerate(made, start=1):
        poles.SetValue(place, point)
    return poles


def knots_of(
    values: Sequence[float], counts: Sequence[int]
) -> tuple[TColStd_Array1OfReal, TColStd_Array1OfInteger]:
    """Knots and their multiplicities as the kernel takes them."""
    knots, folds = TColStd_Array1OfReal(1, len(values)), TColStd_Array1OfInteger(1, len(values))
    for place, (value, count) in enumerate(zip(values, counts, strict=True), start=1):
        knots.SetValue(place, value)
        folds.SetValue(place, count)
    return knots, folds


def face_of(wires: Sequence[TopoDS_Wire], z: float) -> TopoDS_Face:
    """The level face at a height, mm, in the first wire and outside of the others; raises GeometryError."""
    face = BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(0.0, 0.0, z), UP), wires[0], True)
    for wire in wires[1:]:
        face.Add(wire)
    if not face.IsDone():
        raise GeometryError(f"the outline gives no face ({face.Error().name})")
    return face.Face()


def extruded(outline: Outline, thickness: float) -> cq.Solid:
    """The face inside an outline, drawn from z = 0 up to ``thickness``, mm; raises GeometryError."""
    face = face_of([wire_of(loop)[0] for loop in outline.loops], 0.0)
    prism = BRepPrimAPI_MakePrism(face, gp_Vec(0.0, 0.0, thickness))
    solid = cq.Shape.cast(prism.Shape())
    if not isinstance(solid, cq.Solid):
        raise GeometryError(f"the outline extrudes to a {solid.ShapeType()}, not to one solid")
    return solid
