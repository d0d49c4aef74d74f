"""Sections of meshes as printed."""

import numpy as np
import shapely

from mechwright_print.meshes.printed_mesh import PrintedMesh
from mechwright_print.meshes.stacked import manifold_of

CHORD = 0.004
"""A mesh of a plate is so near to its walls, mm."""


def is_closed(mesh: PrintedMesh) -> bool:
    """Whether every edge belongs to two triangles that run it either way."""
    edges = np.concatenate([mesh.mesh.triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    forth, counts = np.unique(edges, axis=0, return_counts=True)
    return bool((counts == 1).all() and np.array_equal(forth, np.unique(edges[:, ::-1], axis=0)))


def section(mesh: PrintedMesh, z: float) -> shapely.Geometry:
    """The cross-section of a mesh at a height."""
    body = manifold_of(mesh.mesh)
    rings = [shapely.Polygon(ring) for ring in body.slice(z).to_polygons()]
    rings.sort(key=lambda one: -one.area)
    whole = shapely.Polygon()
    for ring in rings:
        whole = shapely.symmetric_difference(whole, ring)
    return whole
