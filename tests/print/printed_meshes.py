"""Sections of meshes as printed."""

import manifold3d
import numpy as np
import shapely

from mechwright_print.meshes.printed_mesh import PrintedMesh

CHORD = 0.004
"""A mesh of a plate is so near to its walls, mm."""


def section(mesh: PrintedMesh, z: float) -> shapely.Geometry:
    """The cross-section of a mesh at a height."""
    body = manifold3d.Manifold(manifold3d.Mesh64(mesh.mesh.points, mesh.mesh.triangles.astype(np.uint64)))
    rings = [shapely.Polygon(ring) for ring in body.slice(z).to_polygons()]
    rings.sort(key=lambda one: -one.area)
    whole = shapely.Polygon()
    for ring in rings:
        whole = shapely.symmetric_difference(whole, ring)
    return whole
