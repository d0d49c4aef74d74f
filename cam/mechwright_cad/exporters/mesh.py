"""Mesh formats: STL and 3MF, the same bytes for the same parts, mm, z up. Imports the CAD kernel."""

import io
import zipfile
from functools import lru_cache
from xml.sax.saxutils import quoteattr

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.part import Part
from mechwright_cad.solids import solid as solids
from mechwright_cad.solids.tessellate import Mesh, mesh_of

_EPOCH = (1980, 1, 1, 0, 0, 0)
"""Time of files in an archive: the earliest that the format can hold."""

_STL = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])

_CONTENT_TYPES = (
    '<?xml version="1.0" encoding="UTF-8"?>\n'
    '<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">'
    '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
    '<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>'
    "</Types>"
)
_RELATIONS = (
    '<?xml version="1.0" encoding="UTF-8"?>\n'
    '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
    '<Relationship Id="model" Target="/3D/3dmodel.model" '
    'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>'
)

CREASE_COS = 0.8
"""Neighbouring triangles within 37° share a smooth normal in viewers; sharper edges stay sharp."""


@lru_cache(maxsize=32)
def part_mesh(part: Part) -> Mesh:
    """The triangles of a part."""
    return mesh_of(solids.part_solid(part), ruled=part.outline is not None)


def stl(part: Part) -> bytes:
    """A part as binary STL."""
    mesh = part_mesh(part)
    rows = np.zeros(len(mesh.triangles), _STL)
    rows["corners"] = mesh.points[mesh.triangles]
    rows["normal"] = _normals(mesh)
    # Readers take a file for text if it begins with "solid".
    head = f"mechwright {part.name}"[:80].ljust(80).encode("ascii")
    return head + np.uint32(len(rows)).tobytes() + rows.tobytes()


def threemf(part: Part) -> bytes:
    """A part as 3MF (core specification), with its name, material and colour."""
    mesh = part_mesh(part)
    colour = "#" + "".join(f"{round(255 * channel):02X}" for channel in part.colour)
    corners = "".join(f'<vertex x="{x:.6f}" y="{y:.6f}" z="{z:.6f}"/>' for x, y, z in mesh.points.tolist())
    triangles = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in mesh.triangles.tolist())
    model = (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        '<model unit="millimeter" xml:lang="en-US" '
        'xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">'
        f'<metadata name="Title">{part.name}</metadata><metadata name="Application">Mechwright</metadata>'
        f'<resources><basematerials id="1"><base name={quoteattr(part.material)} displaycolor="{colour}"/>'
        f'</basematerials><object id="2" type="model" name="{part.name}" pid="1" pindex="0"><mesh>'
        f"<vertices>{corners}</vertices><triangles>{triangles}</triangles></mesh></object></resources>"
        '<build><item objectid="2"/></build></model>\n'
    )
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        for name, text in (
            ("[Content_Types].xml", _CONTENT_TYPES),
            ("_rels/.rels", _RELATIONS),
            ("3D/3dmodel.model", model),
        ):
            entry = zipfile.ZipInfo(name, _EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, text)
    return file.getvalue()


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
