"""The gate that every solid passes before it is written.

The kernel's own validity check passes solids that are not right, so a plate is held against its outline:
number of faces, size, area, and every edge against its segment. This module imports the CAD kernel.
"""

import cadquery as cq
import numpy as np
import shapely
from OCP.Bnd import Bnd_Box
from OCP.BRepAdaptor import BRepAdaptor_Curve
from OCP.BRepBndLib import BRepBndLib
from OCP.BRepGProp import BRepGProp
from OCP.GProp import GProp_GProps

from mechwright.arrays import Array
from mechwright.contracts.mass import QUADRATURE
from mechwright.contracts.moments import volume
from mechwright.contracts.part import Part
from mechwright.errors import GeometryError
from mechwright.geometry import BSpline, Outline, Segment
from mechwright.tolerances import TOLERANCES
from mechwright_cad.solids.tessellate import forget, triangle_count, triangulate

AREA = 1e-6
"""Relative difference of areas: what the kernel's and our own quadrature leave is below 1e-8."""

EDGE_SAMPLES = 9
"""Points on each edge that are held against the segment: more than the degree of most segments."""

COARSE_FACETS = (0.02, 0.5)
"""Tolerance in mm and rad of the triangles that are only counted."""

SURPLUS = 4
"""The walls may have this many triangles per corner of the outline's polygon, and as many more per wall.
Right ones stay below 1, since the polygon is much finer than the triangles; broken ones reach thousands."""

TURN_STEPS = 8
"""Steps in each smooth piece between which a tangent may not turn by more than a right angle."""


def check_solid(solid: cq.Solid) -> None:
    """Raise GeometryError for what is not one valid solid of positive volume."""
    if not isinstance(solid, cq.Solid):
        raise GeometryError(f"a solid is wanted, not {type(solid).__name__}")
    if not solid.isValid():
        raise GeometryError("the CAD kernel finds the solid invalid; look for an outline that touches itself")
    if not solid.Volume() > 0:
        raise GeometryError("the solid is inside out: its volume is not above 0")


def check_plate(solid: cq.Solid, outline: Outline, thickness: float) -> None:
    """Raise GeometryError for a solid that is not the outline extruded from z = 0 up to ``thickness``, mm."""
    segments = [segment for loop in outline.loops for segment in loop.segments]
    _check_splines(segments)
    polygon = outline.polygon()  # refuses an outline that cuts itself, which the kernel lets pass
    if not solid.isValid():
        raise GeometryError("the CAD kernel finds the solid invalid; look for an outline that touches itself")
    faces = solid.Faces()
    if len(faces) != len(segments) + 2:
        raise GeometryError(f"the solid has {len(faces)} faces; its outline gives {len(segments) + 2}")
    top = _top(faces, thickness)
    _check_size(top, polygon.bounds)
    _check_area(top, outline)
    _check_edges(top, segments)
    _check_triangles(faces, shapely.get_num_coordinates(polygon))


RECESSED = 1e-5
"""Relative difference of the volume of a plate with recesses: its polygons are this exact, see FINE."""


def check_recessed(solid: cq.Solid, part: Part) -> None:
    """Raise GeometryError for a plate with recesses whose volume is not that of the part's sections."""
    check_solid(solid)
    wanted = volume(part)
    properties = GProp_GProps()
    # By Gauss and Kronrod: the kernel's other quadrature is 1e-5 off where splines have many spans.
    BRepGProp.VolumePropertiesGK_s(solid.wrapped, properties, QUADRATURE, False, False)
    error = properties.Mass() / wanted - 1
    if abs(error) > RECESSED:
        raise GeometryError(
            f"the solid has {properties.Mass():.4f} mm³, its sections have {wanted:.4f}: "
            f"{error:.2g} apart, limit {RECESSED:g}"
        )


def top_area(face: cq.Face) -> float:
    """Area of a plane face, mm², to ``QUADRATURE``."""
    properties = GProp_GProps()
    BRepGProp.SurfaceProperties_s(face.wrapped, properties, QUADRATURE)
    return float(properties.Mass())


def _check_splines(segments: list[Segment]) -> None:
    for segment in segments:
        if not isinstance(segment, BSpline):
            continue
        breaks = segment.breaks()
        pieces = breaks[:-1, None] + np.diff(breaks)[:, None] * np.linspace(0, 1, TURN_STEPS + 1)
        tangents = segment.derivative(pieces.ravel()).reshape(*pieces.shape, 2)
        back = np.einsum("ijk,ijk->ij", tangents[:, :-1], tangents[:, 1:]) < 0
        if back.any():
            x, y = segment.at(pieces[:, 1:][back][:1])[0]
            raise GeometryError(
                f"the {segment.tag or 'spline'} segment near ({x:.3f}, {y:.3f}) turns back on itself"
            )


def _top(faces: list[cq.Face], thickness: float) -> cq.Face:
    level = [face for face in faces if face.geomType() == "PLANE"]
    tops = [face for face in level if abs(min(v.Z for v in face.Vertices()) - thickness) < 1e-6]
    if len(tops) != 1:
        raise GeometryError(f"the solid has {len(tops)} faces at z = {thickness:g} mm; a plate has one")
    return tops[0]


def _check_size(top: cq.Face, bounds: tuple[float, float, float, float]) -> None:
    box = Bnd_Box()
    BRepBndLib.AddOptimal_s(top.wrapped, box, False, False)
    box.SetGap(0.0)
    x0, y0, _, x1, y1, _ = box.Get()
    worst = float(np.abs(np.array([x0, y0, x1, y1]) - bounds).max())
    # The bounds are those of the outline's chords.
    limit = TOLERANCES.flatten + 2 * TOLERANCES.closure
    if worst > limit:
        raise GeometryError(
            f"the solid's size differs from the outline's by {worst:.3g} mm, limit {limit:g} mm"
        )


def _check_area(top: cq.Face, outline: Outline) -> None:
    # The kernel's quick quadrature is exact unless splines have many spans.
    area = top.Area()
    if abs(area / outline.area - 1) > AREA:
        area = top_area(top)
    error = area / outline.area - 1
    if abs(error) > AREA:
        raise GeometryError(
            f"the solid's top has {area:.6f} mm², the outline {outline.area:.6f}: "
            f"{error:.2g} apart, limit {AREA:g}"
        )


def _check_edges(top: cq.Face, segments: list[Segment]) -> None:
    edges = top.Edges()
    if len(edges) != len(segments):
        raise GeometryError(
            f"the solid's top has {len(edges)} edges; its outline has {len(segments)} segments"
        )
    t = np.linspace(0, 1, EDGE_SAMPLES)
    found = np.array([_edge_points(edge) for edge in edges])
    wanted = np.array([segment.at(t) for segment in segments])
    middle = EDGE_SAMPLES // 2
    near = np.linalg.norm(found[:, None, middle] - wanted[None, :, middle], axis=2).argmin(axis=1)
    forth = np.linalg.norm(found - wanted[near], axis=2).max(axis=1)
    back = np.linalg.norm(found[:, ::-1] - wanted[near], axis=2).max(axis=1)
    gap = np.minimum(forth, back)
    worst = int(gap.argmax())
    limit = 2 * TOLERANCES.closure
    if gap[worst] > limit or len(set(near.tolist())) != len(segments):
        x, y = found[worst, middle]
        raise GeometryError(
            f"the solid's edge at ({x:.4f}, {y:.4f}) is {gap[worst]:.3g} mm off its segment, "
            f"limit {limit:g} mm"
        )


def _edge_points(edge: cq.Edge) -> Array:
    curve = BRepAdaptor_Curve(edge.wrapped)
    first, last = curve.FirstParameter(), curve.LastParameter()
    points = [curve.Value(u) for u in np.linspace(first, last, EDGE_SAMPLES).tolist()]
    return np.array([(point.X(), point.Y()) for point in points])


def _check_triangles(faces: list[cq.Face], corners: int) -> None:
    # The caps' triangles follow from the walls' chords, so only the walls are divided: half of the time.
    walls = cq.Compound.makeCompound([face for face in faces if face.geomType() != "PLANE"])
    triangulate(walls.wrapped, *COARSE_FACETS, ruled=True)
    count = triangle_count(walls)
    forget(walls.wrapped)
    limit = SURPLUS * (corners + len(faces))
    if count > limit:
        raise GeometryError(
            f"the solid's walls take {count} triangles, limit {limit}; a segment is degenerate"
        )
