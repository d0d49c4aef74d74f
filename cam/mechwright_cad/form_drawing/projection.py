"""Views of a solid: its edges as seen along a direction, with those that it hides. Imports the CAD kernel."""

from dataclasses import dataclass

import cadquery as cq
import numpy as np
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.BRepLib import BRepLib
from OCP.GCPnts import GCPnts_QuasiUniformDeflection
from OCP.gp import gp_Ax2, gp_Dir, gp_Pnt
from OCP.HLRAlgo import HLRAlgo_Projector
from OCP.HLRBRep import HLRBRep_Algo, HLRBRep_HLRToShape
from OCP.TopAbs import TopAbs_EDGE
from OCP.TopExp import TopExp_Explorer
from OCP.TopoDS import TopoDS, TopoDS_Shape

from mechwright.arrays import Array
from mechwright.geometry.segments import Point

CHORD = 0.02
"""Largest distance of a line on the sheet from its curve, mm of the part."""

SHORTEST = 0.02
"""Pieces of edges shorter than this are numerical dust, mm of the part."""

Polyline = tuple[Point, ...]


@dataclass(frozen=True)
class View:
    """A direction of view by what is to the right and what is up on paper: unit vectors (3,) of the part."""

    name: str
    right: tuple[float, float, float]
    up: tuple[float, float, float]

    @property
    def towards(self) -> Array:
        """From the part to who looks at it."""
        return np.cross(self.right, self.up)

    def seen(self, at: "Array | tuple[float, float, float]") -> Point:
        """A point of the part on paper, mm of the part."""
        return float(np.dot(self.right, at)), float(np.dot(self.up, at))


FRONT = View("front", (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
TOP = View("top", (1.0, 0.0, 0.0), (0.0, 0.0, -1.0))
LEFT = View("left", (0.0, 0.0, 1.0), (0.0, 1.0, 0.0))
RIGHT = View("right", (0.0, 0.0, -1.0), (0.0, 1.0, 0.0))
"""ISO 5456-2. In first-angle projection the top view stands below the front view and the view from the left
beside it; in third-angle projection the top view stands above it, and the view from the right beside it."""


@dataclass(frozen=True)
class Projection:
    """Lines of a view, mm of the part."""

    view: View
    visible: tuple[Polyline, ...]
    hidden: tuple[Polyline, ...]


def projected(solid: cq.Solid, view: View) -> Projection:
    """The edges and outlines of a solid in a view."""
    algorithm = HLRBRep_Algo()
    algorithm.Add(solid.wrapped)
    origin, towards, right = gp_Pnt(0.0, 0.0, 0.0), gp_Dir(*view.towards.tolist()), gp_Dir(*view.right)
    algorithm.Projector(HLRAlgo_Projector(gp_Ax2(origin, towards, right)))
    algorithm.Update()
    algorithm.Hide()
    shapes = HLRBRep_HLRToShape(algorithm)
    # Edges between smooth faces are not drawn.
    visible = [shapes.VCompound(), shapes.OutLineVCompound()]
    hidden = [shapes.HCompound(), shapes.OutLineHCompound()]
    return Projection(view, tuple(_lines(visible)), tuple(_lines(hidden)))


def _lines(shapes: "list[TopoDS_Shape | None]") -> list[Polyline]:
    found = []
    for shape in shapes:
        if shape is None or shape.IsNull():
            continue
        BRepLib.BuildCurves3d_s(shape)
        explorer = TopExp_Explorer(shape, TopAbs_EDGE)
        while explorer.More():
            line = _flattened(BRepAdaptor_Curve(TopoDS.Edge_s(explorer.Current())))
            if _length(line) > SHORTEST:
                found.append(line)
            explorer.Next()
    return found


def _flattened(curve: BRepAdaptor_Curve) -> Polyline:
    points = GCPnts_QuasiUniformDeflection(curve, CHORD)
    places = [points.Value(k) for k in range(1, points.NbPoints() + 1)]
    return tuple((round(at.X(), 4) + 0.0, round(at.Y(), 4) + 0.0) for at in places)


def _length(line: Polyline) -> float:
    return float(np.linalg.norm(np.diff(np.array(line), axis=0), axis=1).sum()) if len(line) > 1 else 0.0
