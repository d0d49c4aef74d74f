"""What a STEP file holds: outlines and parts, for proofs that start at the file, not at what wrote it.

The CAD kernel crashes on some broken files, so read only files of your own here; read a stranger's in a child
process.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import cadquery as cq
import numpy as np
import shapely
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.BRepTools import BRepTools_WireExplorer
from OCP.GCPnts import GCPnts_TangentialDeflection
from OCP.IFSelect import IFSelect_ReturnStatus
from OCP.STEPControl import STEPControl_Reader
from OCP.TopAbs import TopAbs_Orientation
from shapely.geometry.polygon import orient

from mechwright.arrays import Array
from mechwright.contracts.part import Part
from mechwright.errors import GeometryError, OutputError
from mechwright.geometry import Loop, Outline
from mechwright.tolerances import TOLERANCES

READING = TOLERANCES.flatten / 5
"""Chord error of outlines read back, mm. With ``flatten`` itself the chords alone would give a pair of gears
a transmission error of 30 µrad; with this it is below 5."""


def read_step_solids(path: Path) -> list[cq.Solid]:
    """All solids of a STEP file in the order of the file, assembly poses applied.

    Raises
    ------
    OutputError
        The file cannot be read as STEP.
    """
    reader = STEPControl_Reader()
    if not path.is_file() or reader.ReadFile(str(path)) != IFSelect_ReturnStatus.IFSelect_RetDone:
        raise OutputError(f"{path} cannot be read as a STEP file")
    reader.TransferRoots()
    return cq.Shape.cast(reader.OneShape()).Solids()


def read_step_outline(source: bytes | Path, tolerance: float = READING) -> list[shapely.Polygon]:
    """The plan view of every plate in a STEP file.

    Parameters
    ----------
    source
        The file's text, or where it lies.
    tolerance
        Chord error of the polygons, mm.

    Returns
    -------
    polygons
        One per solid, in the order of the file, mm, holes included: its uppermost plane face. Outsides run
        counter-clockwise.

    Raises
    ------
    OutputError
        The file cannot be read as STEP.
    GeometryError
        A solid has no plane face that looks up.
    """
    if isinstance(source, Path):
        found = read_step_solids(source)
    else:
        from tempfile import TemporaryDirectory

        with TemporaryDirectory() as folder:
            path = Path(folder) / "part.step"
            path.write_bytes(source)
            found = read_step_solids(path)
    return [plan_of(solid, tolerance) for solid in found]


def top_face(solid: cq.Solid) -> cq.Face:
    """The uppermost plane face that looks up (towards +z)."""
    faces = [
        face
        for face in solid.Faces()
        if face.geomType() == "PLANE" and face.normalAt().z > 1 - TOLERANCES.closure
    ]
    if not faces:
        raise GeometryError("the solid is no plate: no plane face of it looks up")
    return max(faces, key=lambda face: face.Center().z)


def plan_of(solid: cq.Solid, tolerance: float = READING) -> shapely.Polygon:
    """The plan view of a plate, mm: its uppermost plane face; the outside runs counter-clockwise."""
    face = top_face(solid)
    polygon = shapely.Polygon(
        _ring(face.outerWire(), tolerance), [_ring(wire, tolerance) for wire in face.innerWires()]
    )
    return orient(polygon)


def _ring(wire: cq.Wire, tolerance: float) -> Array:
    explorer = BRepTools_WireExplorer(wire.wrapped)
    pieces = []
    while explorer.More():
        edge = explorer.Current()
        curve = BRepAdaptor_Curve(edge)
        # The turn between points is left free: the chord error alone decides.
        fine = GCPnts_TangentialDeflection(curve, math.pi / 4, tolerance, 3)
        points = [fine.Value(i) for i in range(1, fine.NbPoints() + 1)]
        if edge.Orientation() == TopAbs_Orientation.TopAbs_REVERSED:
            points.reverse()
        pieces.append(np.array([(point.X(), point.Y()) for point in points[:-1]]))
        explorer.Next()
    return np.concatenate(pieces)


def parts_from_step(parts: Sequence[Part], files: Mapping[str, Path]) -> list[Part]:
    """The same parts, each with the shape that its file holds.

    Parameters
    ----------
    parts
        Of a mechanism.
    files
        Part name to its STEP file.

    Returns
    -------
    parts
        A plate without recesses has its plan view from the file, all other parts the solid.

    Raises
    ------
    OutputError
        A file cannot be read as STEP.
    GeometryError
        A file holds another number of solids than one, or a plate of another thickness.
    """
    found = []
    for part in parts:
        solids = read_step_solids(files[part.name])
        if len(solids) != 1:
            raise GeometryError(f"{files[part.name]} holds {len(solids)} solids; a part is one")
        found.append(part_from_solid(part, solids[0]))
    return found


def part_from_solid(part: Part, solid: cq.Solid) -> Part:
    """The same part with the shape of a solid; raises GeometryError if a plate has another thickness."""
    if part.outline is None or any(f.top > 0 or f.depth < part.thickness for f in part.features):
        return replace(part, outline=None, thickness=0.0, machined=(), build=lambda: solid)
    box = solid.BoundingBox()
    if abs(box.zlen - part.thickness) > 1e-3 or abs(box.zmin) > 1e-3:
        raise GeometryError(
            f"part {part.name} is {part.thickness:g} mm thick and stands on Z0; its solid reaches from "
            f"{box.zmin:.4f} to {box.zmax:.4f}"
        )
    plan = plan_of(solid)
    outer, *inner = (
        Loop.polygon(map(tuple, np.asarray(shapely.get_coordinates(ring))[:-1].tolist()))
        for ring in (plan.exterior, *plan.interiors)
    )
    return replace(part, outline=Outline(outer, tuple(inner)), machined=())
