"""Limits of size in STEP files: dimensions with their tolerances on the faces of holes and shafts.

A reader of AP242 gets each as a diameter with limit deviations, or with its least and greatest size where
neither limit is on the other side of the basic size (ISO 10303-242, semantic PMI). Any reader gets it as the
name of the face: ``"bore 12 H7 (0/+0.018)"``. All are the limits that drawing and sheet have.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import cadquery as cq
import numpy as np
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.GeomAbs import GeomAbs_SurfaceType
from OCP.TCollection import TCollection_ExtendedString, TCollection_HAsciiString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_Label, TDF_LabelSequence
from OCP.TDocStd import TDocStd_Document
from OCP.XCAFDimTolObjects import XCAFDimTolObjects_DimensionObject, XCAFDimTolObjects_DimensionType
from OCP.XCAFDoc import XCAFDoc_Dimension, XCAFDoc_DimTolTool, XCAFDoc_DocumentTool, XCAFDoc_ShapeTool

from mechwright.arrays import Array
from mechwright.contracts.fits import Fit
from mechwright.contracts.part import Part
from mechwright.mechanics.mating.rounds import Face, faces_of
from mechwright_cad.solids import solid as solids

SAME = 1e-4
"""How far a face of the solid may be from the one that is meant, mm."""

DIAMETER = XCAFDimTolObjects_DimensionType.XCAFDimTolObjects_DimensionType_Size_Diameter


def limited_faces(part: Part) -> list[tuple[Face, Fit]]:
    """The round faces of a part that have limits of size."""
    return [(face, face.fit) for face in faces_of(part) if face.fit is not None]


def add_limits(document: TDocStd_Document, label: TDF_Label, part: Part) -> None:
    """Put the limits of a part's round faces into a document, onto the faces of the shape with that label.

    A face that the solid does not have, as one that a keyway leaves nothing of, has no dimension.
    """
    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    dimensions = XCAFDoc_DocumentTool.DimTolTool_s(document.Main())
    cylinders = list(_cylinders(solids.part_solid(part)))
    for face, fit in limited_faces(part):
        text = f"{face.face} {fit.text}"
        labels = TDF_LabelSequence()
        for one, cylinder in cylinders:
            if cylinder.belongs_to(face):
                labels.Append(_named(shapes, label, one, text))
        if labels.Length():
            _dimension(dimensions, labels, fit, text)


@dataclass(frozen=True)
class _Cylinder:
    """A cylindrical face: the middle of its axis, the axis, a unit vector, and its diameter; mm."""

    middle: Array
    axis: Array
    diameter: float

    def belongs_to(self, face: Face) -> bool:
        """Whether it is all or some of a round face."""
        direction = np.asarray(face.direction)
        away = self.middle - np.asarray(face.centre)
        along = float(away @ direction)
        return bool(
            abs(self.diameter - face.diameter) <= 2 * SAME
            and np.linalg.norm(np.cross(self.axis, direction)) <= SAME
            and np.linalg.norm(away - along * direction) <= SAME
            and face.low - SAME <= along <= face.high + SAME
        )


def _cylinders(solid: cq.Solid) -> Iterator[tuple[cq.Face, _Cylinder]]:
    for face in solid.Faces():
        surface = BRepAdaptor_Surface(face.wrapped)
        if surface.GetType() != GeomAbs_SurfaceType.GeomAbs_Cylinder:
            continue
        found = surface.Cylinder()
        place, way = found.Axis().Location(), found.Axis().Direction()
        axis = np.array((way.X(), way.Y(), way.Z()))
        along = (surface.FirstVParameter() + surface.LastVParameter()) / 2
        middle = np.array((place.X(), place.Y(), place.Z())) + along * axis
        yield face, _Cylinder(middle, axis, 2 * found.Radius())


def _named(shapes: XCAFDoc_ShapeTool, label: TDF_Label, face: cq.Face, text: str) -> TDF_Label:
    found = TDF_Label()
    if not shapes.FindSubShape(label, face.wrapped, found):
        found = shapes.AddSubShape(label, face.wrapped)
    TDataStd_Name.Set_s(found, TCollection_ExtendedString(text))
    return found


def _dimension(tool: XCAFDoc_DimTolTool, faces: TDF_LabelSequence, fit: Fit, text: str) -> None:
    label = tool.AddDimension()
    size = XCAFDimTolObjects_DimensionObject()
    size.SetType(DIAMETER)
    if fit.lower <= 0 <= fit.upper:
        size.SetValue(fit.size)
        size.SetLowerTolValue(-fit.lower)  # how far below: the writer turns its sign
        size.SetUpperTolValue(fit.upper)
    else:
        # The kernel reads no sign of a lower deviation, so these are written as least and greatest size.
        least, greatest = fit.limits
        size.SetLowerBound(round(least, 6))
        size.SetUpperBound(round(greatest, 6))
    size.SetSemanticName(TCollection_HAsciiString(text))
    XCAFDoc_Dimension.Set_s(label).SetObject(size)
    if faces.Length() == 1:
        tool.SetDimension(faces.First(), label)
    else:
        tool.SetDimension(faces, TDF_LabelSequence(), label)
