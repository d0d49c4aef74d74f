"""Triangles of solids, for the gate on solids and for the mesh formats. Imports the CAD kernel."""

from dataclasses import dataclass

import cadquery as cq
import numpy as np
from numpy.typing import NDArray
from OCP.BRep import BRep_Tool
from OCP.BRepMesh import BRepMesh_IncrementalMesh
from OCP.BRepTools import BRepTools
from OCP.IMeshTools import IMeshTools_Parameters
from OCP.TopAbs import TopAbs_Orientation
from OCP.TopLoc import TopLoc_Location
from OCP.TopoDS import TopoDS_Shape

from mechwright.arrays import Array
from mechwright.errors import GeometryError

LINEAR = 0.01
"""Largest distance of a triangle from its face, mm: below the layer height of any printer."""

ANGULAR = 0.4
"""Largest turn between neighbouring triangles, rad; the kernel's 0.1 makes ten times as many triangles."""

WELD = 1e-5
"""Corners of neighbouring faces closer than this are one corner, mm; the kernel computes them twice."""

FINER = (1, 4, 16, 64)
"""Parts of the tolerance that are tried where a face gets no triangle."""


@dataclass(frozen=True)
class Mesh:
    """A closed triangle mesh.

    Parameters
    ----------
    points
        (n, 3) float, mm.
    triangles
        (k, 3) int, corners counter-clockwise seen from outside.
    """

    points: Array
    triangles: NDArray[np.int64]


def triangulate(
    shape: TopoDS_Shape, tolerance: float = LINEAR, angle: float = ANGULAR, *, ruled: bool = False
) -> None:
    """Give every face of the shape a fresh triangulation; ``forget`` it after use.

    What an earlier call left is removed first, since the kernel would keep it where it is finer, and the
    result would depend on history. ``ruled`` says that all faces are planes or prismatic walls: points inside
    them serve nothing (11 000 triangles against 60 000 for a gear of 40 teeth).
    """
    forget(shape)
    parameters = IMeshTools_Parameters()
    parameters.Deflection = tolerance
    parameters.Angle = angle
    parameters.InParallel = True
    parameters.InternalVerticesMode = not ruled
    parameters.ControlSurfaceDeflection = not ruled
    BRepMesh_IncrementalMesh(shape, parameters)


def forget(shape: TopoDS_Shape) -> None:
    """Take the triangulation off again: the kernel would base bounding boxes on it, which get wider."""
    BRepTools.Clean_s(shape)


def triangle_count(shape: cq.Shape) -> int:
    """Number of triangles that the shape's faces hold now."""
    place = TopLoc_Location()
    meshes = (BRep_Tool.Triangulation_s(face.wrapped, place) for face in shape.Faces())
    return sum(mesh.NbTriangles() for mesh in meshes if mesh is not None)


def mesh_of(solid: cq.Solid, *, ruled: bool, tolerance: float = LINEAR) -> Mesh:
    """Triangulate a solid within ``tolerance``, mm, and join the faces' triangles along the edges.

    A face narrower than the tolerance may get no triangle: such a solid is triangulated more finely. Raises
    GeometryError where that does not help, or the triangles leave a hole.
    """
    for finer in FINER:
        triangulate(solid.wrapped, tolerance / finer, ruled=ruled)
        if all(_divided(face) for face in solid.Faces()):
            break
    points: list[tuple[float, float, float]] = []
    triangles: list[tuple[int, ...]] = []
    for face in solid.Faces():
        place = TopLoc_Location()
        local = BRep_Tool.Triangulation_s(face.wrapped, place)
        if local is None:
            raise GeometryError("a face of the solid cannot be divided into triangles; the solid is broken")
        turn = place.Transformation()
        first = len(points) - 1
        nodes = (local.Node(i).Transformed(turn) for i in range(1, local.NbNodes() + 1))
        points += [(p.X(), p.Y(), p.Z()) for p in nodes]
        corners = (t.Get() for t in local.Triangles())
        if face.wrapped.Orientation() == TopAbs_Orientation.TopAbs_REVERSED:
            triangles += [(a + first, c + first, b + first) for a, b, c in corners]
        else:
            triangles += [(a + first, b + first, c + first) for a, b, c in corners]
    forget(solid.wrapped)
    return _closed(*_weld(np.array(points), np.array(triangles, dtype=np.int64)))


def _divided(face: cq.Face) -> bool:
    return BRep_Tool.Triangulation_s(face.wrapped, TopLoc_Location()) is not None


def _weld(points: Array, triangles: NDArray[np.int64]) -> tuple[Array, NDArray[np.int64]]:
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    pairs = cKDTree(points).query_pairs(WELD, output_type="ndarray")
    count = len(points)
    joined = coo_array((np.ones(len(pairs)), pairs.T), shape=(count, count))
    _, group = connected_components(joined, directed=False)
    # The first point of a group stands for it, so that the order does not depend on how groups are numbered.
    _, first, index = np.unique(group, return_index=True, return_inverse=True)
    order = np.argsort(first)
    place = np.empty_like(order)
    place[order] = np.arange(len(order))
    welded = place[index][triangles]
    a, b, c = welded.T
    return points[first[order]], welded[(a != b) & (b != c) & (c != a)]


def _closed(points: Array, triangles: NDArray[np.int64]) -> Mesh:
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    forth = np.unique(edges, axis=0)
    back = np.unique(edges[:, ::-1], axis=0)
    if len(forth) != len(edges) or not np.array_equal(forth, back):
        raise GeometryError(
            "the triangles of the solid leave a hole; make the outline's small segments longer"
        )
    return Mesh(points, triangles)
