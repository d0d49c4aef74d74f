"""Mesh formats: STL, 3MF and GLB, the same bytes for the same parts. Imports the CAD kernel.

STL and 3MF are in millimetres with z up. glTF is in metres with y up, as its specification demands.
"""

import io
import json
import zipfile
from collections.abc import Sequence
from functools import lru_cache
from xml.sax.saxutils import quoteattr

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.motion import Motion
from mechwright.contracts.part import Colour, Part
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

_Y_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
_TRIANGLES, _FLOAT, _UNSIGNED, _VERTICES, _INDICES = 4, 5126, 5125, 34962, 34963
"""Numbers of the glTF 2.0 specification: primitive mode, component types, buffer targets."""

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


def glb_part(part: Part) -> bytes:
    """A part as binary glTF."""
    return _glb(part.name, [(part, part.colour)], [(part.name, 0, np.eye(3), np.zeros(3))])


def glb_assembly(name: str, parts: Sequence[Part], motion: Motion, sample: int = 0) -> bytes:
    """All instances in their poses as binary glTF, nodes named by their bodies."""
    whole = solids.assembly(name, parts, motion, sample)
    shown = [(part, part.colour_of(instance)) for part in parts for instance in part.instances]
    looks = list(dict.fromkeys((parts.index(part), colour) for part, colour in shown))
    nodes = []
    for (part, colour), child in zip(shown, whole.children, strict=True):
        number = looks.index((parts.index(part), colour))
        placed = child.loc.wrapped.Transformation()
        rows = np.array([[placed.Value(i, j) for j in range(1, 5)] for i in range(1, 4)])
        nodes.append((child.name, number, rows[:, :3], rows[:, 3]))
    return _glb(name, [(parts[number], colour) for number, colour in looks], nodes)


def _normals(mesh: Mesh) -> Array:
    a, b, c = mesh.points[mesh.triangles].transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    unit: Array = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), np.finfo(float).tiny)
    return unit


def _corner_normals(mesh: Mesh) -> Array:
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


def _glb(
    name: str, looks: Sequence[tuple[Part, Colour]], nodes: Sequence[tuple[str, int, Array, Array]]
) -> bytes:
    """Nodes with their number in ``looks`` and their pose; parts that differ in colour share triangles."""
    chunks: list[bytes] = []
    accessors: list[dict[str, object]] = []
    views: list[dict[str, int]] = []

    def store(values: Array, kind: str, target: int, component: int, **extra: object) -> int:
        data = values.tobytes()
        views.append(
            {"buffer": 0, "byteOffset": sum(map(len, chunks)), "byteLength": len(data), "target": target}
        )
        chunks.append(data)
        accessors.append(
            {
                "bufferView": len(views) - 1,
                "componentType": component,
                "count": len(values),
                "type": kind,
                **extra,
            }
        )
        return len(accessors) - 1

    shapes: dict[int, dict[str, object]] = {}
    for part, _ in looks:
        if id(part) in shapes:
            continue
        mesh = part_mesh(part)
        corners = np.concatenate([mesh.points[mesh.triangles] / 1000, _corner_normals(mesh)], axis=2).reshape(
            -1, 2, 3
        )
        corners = (corners @ _Y_UP.T).reshape(-1, 6).astype("<f4")
        corners, index = np.unique(corners, axis=0, return_inverse=True)
        points = np.ascontiguousarray(corners[:, :3])
        limits = {"min": points.min(axis=0).tolist(), "max": points.max(axis=0).tolist()}
        attributes = {
            "POSITION": store(points, "VEC3", _VERTICES, _FLOAT, **limits),
            "NORMAL": store(np.ascontiguousarray(corners[:, 3:]), "VEC3", _VERTICES, _FLOAT),
        }
        indices = store(index.ravel().astype("<u4"), "SCALAR", _INDICES, _UNSIGNED)
        shapes[id(part)] = {"attributes": attributes, "indices": indices, "mode": _TRIANGLES}
    meshes = [
        {"name": part.name, "primitives": [{**shapes[id(part)], "material": number}]}
        for number, (part, _) in enumerate(looks)
    ]
    body = b"".join(chunks)
    document = {
        "asset": {"version": "2.0", "generator": "Mechwright"},
        "scene": 0,
        "scenes": [{"name": name, "nodes": list(range(len(nodes)))}],
        "nodes": [
            {"name": label, "mesh": mesh, "matrix": _matrix(turn, shift)}
            for label, mesh, turn, shift in nodes
        ],
        "meshes": meshes,
        "materials": [_material(part.material, colour) for part, colour in looks],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(body)}],
    }
    head = json.dumps(document, separators=(",", ":")).encode()
    head += b" " * (-len(head) % 4)
    return b"".join(
        [
            b"glTF" + np.array([2, 12 + 8 + len(head) + 8 + len(body)], "<u4").tobytes(),
            np.uint32(len(head)).tobytes() + b"JSON" + head,
            np.uint32(len(body)).tobytes() + b"BIN\0" + body,
        ]
    )


def _matrix(turn: Array, shift: Array) -> list[float]:
    """A pose as glTF holds it: column by column, y up, metres."""
    matrix = np.eye(4)
    matrix[:3, :3] = _Y_UP @ turn @ _Y_UP.T
    matrix[:3, 3] = _Y_UP @ shift / 1000
    return [round(value, 12) + 0.0 for value in matrix.T.ravel().tolist()]


def _material(name: str, colour: Colour) -> dict[str, object]:
    # glTF colours are linear, ours are meant for a screen.
    linear = [((c + 0.055) / 1.055) ** 2.4 if c > 0.04045 else c / 12.92 for c in colour]
    metal = {"baseColorFactor": [*linear, 1.0], "metallicFactor": 0.4, "roughnessFactor": 0.5}
    return {"name": name, "pbrMetallicRoughness": metal}
