"""Bodies between two heights whose upper edges are broken at 45 degrees. Imports the CAD kernel.

Below a chamfer stands a prism; the chamfer itself has one face for each segment: a plane on a line, a cone on
an arc, on a spline the ruled surface between the spline and its parallel, which is exactly as steep. All
faces share their edges, and every edge brings its place on each surface, so nothing is sewn or searched for.

Glossary
--------
seam
    The edge between two neighbouring faces of a chamfer, from the wall's edge to the top.
slant
    Distance from the wall's edge along the face, mm: the parameter of seams, and of faces across.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import cadquery as cq
import numpy as np
from OCP.BRep import BRep_Builder, BRep_Tool
from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeSolid
from OCP.BRepLib import BRepLib
from OCP.BRepPrimAPI import BRepPrimAPI_MakePrism
from OCP.Geom import Geom_BSplineCurve, Geom_BSplineSurface, Geom_ConicalSurface, Geom_Plane, Geom_Surface
from OCP.Geom2d import Geom2d_BSplineCurve
from OCP.gp import gp_Ax3, gp_Dir, gp_Pnt, gp_Pnt2d, gp_Vec
from OCP.ShapeFix import ShapeFix_Shell
from OCP.TColgp import TColgp_Array1OfPnt2d, TColgp_Array2OfPnt
from OCP.TColStd import TColStd_Array1OfInteger, TColStd_Array1OfReal
from OCP.TopAbs import TopAbs_Orientation, TopAbs_ShapeEnum
from OCP.TopExp import TopExp, TopExp_Explorer
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import (
    TopoDS,
    TopoDS_Edge,
    TopoDS_Face,
    TopoDS_Shape,
    TopoDS_Shell,
    TopoDS_Vertex,
    TopoDS_Wire,
)

from mechwright.arrays import Array
from mechwright.errors import GeometryError
from mechwright.geometry import Arc, Line, Loop, Segment
from mechwright.geometry.fit import interpolation
from mechwright.geometry.parallel import DEGREE, Parallel
from mechwright.tolerances import TOLERANCES
from mechwright_cad.solids.wires import DOWN, UP, closed_wire, face_of, knots_of, poles_of, wire_of

STEEP = math.pi / 4
"""Chamfers stand at 45 degrees."""
STRAIGHT = TOLERANCES.closure / 100
"""A seam whose points are no further off a line is one, mm."""
SAME = 4 * TOLERANCES.closure
"""What edges may be off the faces beside them, mm: fits of both are within the closure tolerance."""
_FORWARD, _REVERSED = TopAbs_Orientation.TopAbs_FORWARD, TopAbs_Orientation.TopAbs_REVERSED
Sheet = Callable[[Array], Array]


@dataclass(frozen=True)
class Edge:
    """A loop of a body, material on its left; ``width`` of the chamfer on it, mm, 0 for a sharp one.

    ``side`` is 1 where the body gets smaller towards the top, -1 where it gets larger.
    """

    loop: Loop
    width: float = 0.0
    side: int = 1


def body(edges: Sequence[Edge], bottom: float, top: float) -> cq.Solid:
    """The solid between two heights, mm, inside the loops; the outer one first.

    Raises GeometryError for a chamfer that is too wide for its loop, or for the body.
    """
    faces: list[TopoDS_Shape] = []
    lower, upper = [], []
    for edge in edges:
        if edge.width >= top - bottom:
            raise GeometryError(
                f"a chamfer of {edge.width:g} mm takes all of an edge {top - bottom:g} mm high"
            )
        wire, rim = wire_of(edge.loop, top - edge.width)
        prism = BRepPrimAPI_MakePrism(wire, gp_Vec(0.0, 0.0, bottom - top + edge.width))
        faces += _explored(prism.Shape(), TopAbs_ShapeEnum.TopAbs_FACE)
        lower.append(TopoDS.Wire_s(prism.LastShape()))
        if edge.width:
            flare, wire = _chamfer(edge, rim, top)
            faces += flare
        upper.append(wire)
    faces += [face_of(lower, bottom), face_of(upper, top)]
    return _closed(faces)


def _explored(shape: TopoDS_Shape, kind: TopAbs_ShapeEnum) -> list[TopoDS_Shape]:
    found, explorer = [], TopExp_Explorer(shape, kind)
    while explorer.More():
        found.append(explorer.Current())
        explorer.Next()
    return found


def _closed(faces: Sequence[TopoDS_Shape]) -> cq.Solid:
    """The solid inside faces that share their edges."""
    shell, builder = TopoDS_Shell(), BRep_Builder()
    builder.MakeShell(shell)
    for face in faces:
        builder.Add(shell, face)
    fixed = ShapeFix_Shell()
    fixed.FixFaceOrientation(shell)
    shell = fixed.Shell()
    shell.Closed(True)
    solid = BRepBuilderAPI_MakeSolid(shell).Solid()
    if not BRepLib.OrientClosedSolid_s(solid):
        raise GeometryError("the faces of the body leave a gap")
    return cq.Solid(solid)


def _chamfer(edge: Edge, rim: list[TopoDS_Edge], top: float) -> tuple[list[TopoDS_Shape], TopoDS_Wire]:
    """The faces of a chamfer above the edges of a wall, and the wire where they end."""
    parallel = Parallel(edge.loop, edge.side)
    share = interpolation(DEGREE)[0]
    before, after = parallel.joints(edge.width * share)
    wire, ridge = wire_of(parallel.between(np.roll(after[:, -1], 1), before[:, -1], edge.width), top)
    if isinstance(edge.loop.segments[0], Arc) and edge.loop.is_circle:
        return [_round(parallel, edge.loop.segments[0], rim[0], ridge[0], edge.width, top - edge.width)], wire
    places = [
        parallel.point(segment, t, edge.width * share)
        for segment, t in zip(edge.loop.segments, before, strict=True)
    ]
    z = top - edge.width
    height = z + edge.width * share
    seams = [
        _seam(np.column_stack((place, height)), _last(low), _last(high), edge.width)
        for place, low, high in zip(places, rim, ridge, strict=True)
    ]
    faces: list[TopoDS_Shape] = []
    for number, segment in enumerate(edge.loop.segments):
        surface, sheet = _surface(parallel, segment, after[number - 1], before[number], edge.width, z)
        face = TopoDS_Face()
        builder = BRep_Builder()
        builder.MakeFace(face, surface, TOLERANCES.closure)
        sides = (rim[number], seams[number], ridge[number], seams[number - 1])
        if sheet is not None:
            first, last = after[number - 1], before[number]
            slant = share * edge.width * math.sqrt(2)
            ends = np.array([[0.0, 0.0], [1.0, 0.0]])
            at = [
                ends,
                np.column_stack((last, slant)),
                np.array([[first[-1], slant[-1]], [last[-1], slant[-1]]]),
                np.column_stack((first, slant)),
            ]
            for side, curve in zip(sides, at, strict=True):
                _lay(builder, side, sheet(curve), surface)
        ways = (_FORWARD, _FORWARD, _REVERSED, _REVERSED)
        around = [TopoDS.Edge_s(side.Oriented(way)) for side, way in zip(sides, ways, strict=True)]
        loop = closed_wire(around)
        # A wire runs counter-clockwise on its surface; along a clockwise arc it would not.
        turned = isinstance(segment, Arc) and segment.sweep < 0
        builder.Add(face, loop.Reversed() if turned else loop)
        faces.append(face)
    return faces, wire


def _last(edge: TopoDS_Edge) -> TopoDS_Vertex:
    return TopExp.LastVertex_s(edge)


def _seam(points: Array, low: TopoDS_Vertex, high: TopoDS_Vertex, width: float) -> TopoDS_Edge:
    """An edge through points (n, 3) at the Lobatto nodes, parameter the slant."""
    share, inverse = interpolation(DEGREE)
    straight = points[0] + share[:, None] * (points[-1] - points[0])
    if np.abs(points - straight).max() <= STRAIGHT:
        return BRepBuilderAPI_MakeEdge(low, high).Edge()
    poles = poles_of((inverse @ points).tolist())
    knots, folds = _knots([0.0, width * math.sqrt(2)])
    curve = Geom_BSplineCurve(poles, knots, folds, DEGREE)
    return BRepBuilderAPI_MakeEdge(curve, low, high, 0.0, width * math.sqrt(2)).Edge()


def _knots(
    grid: Sequence[float], degree: int = DEGREE
) -> tuple[TColStd_Array1OfReal, TColStd_Array1OfInteger]:
    return knots_of(grid, [degree + (place in (0, len(grid) - 1)) for place in range(len(grid))])


def _surface(
    parallel: Parallel, segment: Segment, first: Array, last: Array, width: float, z: float
) -> tuple[Geom_Surface, "Sheet | None"]:
    """The surface of a segment's chamfer, and what makes its parameters of (t, slant); a plane needs none."""
    match segment:
        case Line():
            (x, y), (dx, dy) = segment.start, segment.derivative(0.0)[0].tolist()
            normal = gp_Dir(dy, -dx, parallel.side * math.hypot(dx, dy))
            return Geom_Plane(gp_Pnt(x, y, z), normal), None
        case Arc():
            return _cone(parallel, segment, z)
        case _:
            slant = width * math.sqrt(2)
            ends = min(0.0, float(first.min())), max(1.0, float(last.max()))
            grid, poles = parallel.strip(segment, *ends, width)
            rows = TColgp_Array2OfPnt(1, DEGREE * (len(grid) - 1) + 1, 1, 2)
            for column, height in ((0, z), (1, z + width)):
                chain = np.concatenate((poles[column, :, :-1].reshape(-1, 2), poles[column, -1:, -1]))
                for row, (x, y) in enumerate(chain.tolist(), start=1):
                    rows.SetValue(row, column + 1, gp_Pnt(x, y, height))
            along, across = _knots(grid.tolist()), _knots([0.0, slant], 1)
            ruled = Geom_BSplineSurface(rows, along[0], across[0], along[1], across[1], DEGREE, 1)
            return ruled, lambda places: places


def _cone(parallel: Parallel, arc: Arc, z: float) -> tuple[Geom_Surface, "Sheet"]:
    """A cone that opens along its axis: that points down where the arc's parallels are smaller."""
    smaller = parallel.side * arc.sweep > 0
    seam = arc.start_angle + arc.sweep / 2 + math.pi  # where the cone's angle jumps: on the other side
    axes = gp_Ax3(
        gp_Pnt(arc.centre[0], arc.centre[1], z),
        DOWN if smaller else UP,
        gp_Dir(math.cos(seam), math.sin(seam), 0.0),
    )
    sign = -1.0 if smaller else 1.0

    def sheet(places: Array) -> Array:
        return np.column_stack((math.pi + sign * arc.sweep * (places[:, 0] - 0.5), sign * places[:, 1]))

    return Geom_ConicalSurface(axes, STEEP, arc.radius), sheet


def _round(
    parallel: Parallel, arc: Arc, rim: TopoDS_Edge, ridge: TopoDS_Edge, width: float, z: float
) -> TopoDS_Face:
    """The chamfer of a whole circle: a cone that meets itself at a seam."""
    surface, sheet = _cone(parallel, arc, z)
    face, builder = TopoDS_Face(), BRep_Builder()
    builder.MakeFace(face, surface, TOLERANCES.closure)
    seam = BRepBuilderAPI_MakeEdge(_last(rim), _last(ridge)).Edge()
    first, last = BRep_Tool.Range_s(seam)
    slant = width * math.sqrt(2)
    corners = sheet(np.array([[0.0, 0.0], [1.0, 0.0], [0.0, slant], [1.0, slant]]))
    _lay(builder, rim, corners[[0, 1]], surface)
    _lay(builder, ridge, corners[[2, 3]], surface)
    ends = [_curve(corners[[1, 3]], first, last), _curve(corners[[0, 2]], first, last)]
    turned = arc.sweep < 0
    builder.UpdateEdge(seam, *(ends[::-1] if turned else ends), surface, TopLoc_Location(), SAME)
    sides, ways = (rim, seam, ridge, seam), (_FORWARD, _FORWARD, _REVERSED, _REVERSED)
    around = [TopoDS.Edge_s(side.Oriented(way)) for side, way in zip(sides, ways, strict=True)]
    loop = closed_wire(around)
    builder.Add(face, loop.Reversed() if turned else loop)
    return face


def _lay(builder: BRep_Builder, edge: TopoDS_Edge, places: Array, surface: Geom_Surface) -> None:
    """Tell an edge where it runs on a surface: straight between two places, or through Lobatto nodes."""
    first, last = BRep_Tool.Range_s(edge)
    builder.UpdateEdge(edge, _curve(places, first, last), surface, TopLoc_Location(), SAME)


def _curve(places: Array, first: float, last: float) -> Geom2d_BSplineCurve:
    inverse = interpolation(DEGREE)[1]
    poles = places if len(places) == 2 else inverse @ places
    straight = poles[0] + np.linspace(0, 1, len(poles))[:, None] * (poles[-1] - poles[0])
    if np.abs(poles - straight).max() <= STRAIGHT:
        poles = poles[[0, -1]]
    degree = len(poles) - 1
    points = TColgp_Array1OfPnt2d(1, len(poles))
    for place, (u, v) in enumerate(poles.tolist(), start=1):
        points.SetValue(place, gp_Pnt2d(u, v))
    knots, folds = _knots([first, last], degree)
    return Geom2d_BSplineCurve(points, knots, folds, degree)
