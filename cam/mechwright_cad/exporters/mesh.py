"""Mesh formats: STL and 3MF, the same bytes for the same parts, mm, z up. Imports the CAD kernel."""

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.by_form import kept_by_form
from mechwright.contracts.part import Part
from mechwright_cad.exporters.threemf import BuildItem, MeshObject, package
from mechwright_cad.solids import solid as solids
from mechwright_cad.solids.tessellate import Mesh, mesh_of

_STL = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])

CREASE_COS = 0.8
"""Neighbouring triangles within 37° share a smooth normal in viewers; sharper edges stay sharp."""


@kept_by_form(32)
def part_mesh(part: Part) -> Mesh:
    """The triangles of a part."""
    return mesh_of(solids.part_solid(part), ruled=part.outline is not None)


def stl(part: Part) -> bytes:
    """A part as binary STL."""
    return stl_of(part.name, part_mesh(part))


def stl_of(name: str, mesh: Mesh) -> bytes:
    """A mesh as binary STL, with a name in its head."""
    rows = np.zeros(len(mesh.triangles), _STL)
    rows["corners"] = mesh.points[mesh.triangles]
    rows["normal"] = _normals(mesh)
    # Readers take a file for text if it begins with "solid".
    head = f"mechwright {name}"[:80].ljust(80).encode("ascii")
    return head + np.uint32(len(rows)).tobytes() + rows.tobytes()


def threemf(part: Part) -> bytes:
    """A part as 3MF (core specification), with its name, material and colour."""
    return package(
        part.name, [MeshObject(part.name, part_mesh(part), part.material, part.colour)], [BuildItem(0)]
    )


def _normals(mesh: Mesh) -> Array:
    a, b, c = mesh.points[mesh.triangles].transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    unit: Array = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), np.finfo(float).tiny)
    return unit


def corner_normals(mesh: Mesh) -> Array:
    """Normals (k, 3, 3) of the triangles' corners.

    Every corner takes the normal of its own triangle or, where the mean of the walls at its point is near to
    that, the mean: walls look smooth, and edges sharp.
    """
    flat = _normals(mesh)
    horizontal = np.abs(flat[:, 2]) < CREASE_COS
    mean = np.zeros_like(mesh.points)
    for corner in range(3):
        np.add.at(mean, mesh.triangles[horizontal, corner], flat[horizontal])
    mean /= np.maximum(np.linalg.norm(mean, axis=1, keepdims=True), np.finfo(float).tiny)
    smooth = mean[mesh.triangles]
    near = np.einsum("kci,ki->kc", smooth, flat) > CREASE_COS
    normals: Array = np.where(near[..., None], smooth, flat[:, None])
    return normals
