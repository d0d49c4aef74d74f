"""3MF files (core specification): objects with materials, and where each stands in the build; mm, z up."""

import io
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from xml.sax.saxutils import escape, quoteattr

from mechwright.arrays import Array
from mechwright.contracts.part import Colour
from mechwright_cad.solids.tessellate import Mesh

_EPOCH = (1980, 1, 1, 0, 0, 0)
"""Time of files in an archive: the earliest that the format can hold."""

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


@dataclass(frozen=True, eq=False)
class MeshObject:
    """A mesh with its name, the name of its material, and its colour."""

    name: str
    mesh: Mesh
    material: str
    colour: Colour


@dataclass(frozen=True, eq=False)
class BuildItem:
    """A copy of an object: its number in the list, and (4, 3) rows for x, y, z and the shift, mm.

    A point p, a row, goes to ``p @ transform[:3] + transform[3]``. Without a transform it stands where its
    mesh has it.
    """

    number: int
    transform: Array | None = None


def package(
    title: str,
    objects: Sequence[MeshObject],
    items: Sequence[BuildItem],
    metadata: Mapping[str, str] = MappingProxyType({}),
) -> bytes:
    """The file, the same bytes for the same objects; ``metadata`` follows the title."""
    bases = list(dict.fromkeys((one.material, _hex(one.colour)) for one in objects))
    said = {"Title": title, "Application": "Mechwright", **metadata}
    model = (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        '<model unit="millimeter" xml:lang="en-US" '
        'xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">'
        + "".join(f"<metadata name={quoteattr(key)}>{escape(text)}</metadata>" for key, text in said.items())
        + '<resources><basematerials id="1">'
        + "".join(f'<base name={quoteattr(name)} displaycolor="{colour}"/>' for name, colour in bases)
        + "</basematerials>"
        + "".join(
            _object(number, one, bases.index((one.material, _hex(one.colour))))
            for number, one in enumerate(objects, start=2)
        )
        + "</resources><build>"
        + "".join(_item(item) for item in items)
        + "</build></model>\n"
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


def _hex(colour: Colour) -> str:
    return "#" + "".join(f"{round(255 * channel):02X}" for channel in colour)


def _object(number: int, one: MeshObject, base: int) -> str:
    mesh = one.mesh
    corners = "".join(f'<vertex x="{x:.6f}" y="{y:.6f}" z="{z:.6f}"/>' for x, y, z in mesh.points.tolist())
    triangles = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in mesh.triangles.tolist())
    return (
        f'<object id="{number}" type="model" name={quoteattr(one.name)} pid="1" pindex="{base}"><mesh>'
        f"<vertices>{corners}</vertices><triangles>{triangles}</triangles></mesh></object>"
    )


def _item(item: BuildItem) -> str:
    if item.transform is None:
        return f'<item objectid="{item.number + 2}"/>'
    rows = " ".join(f"{value + 0.0:.6f}" for value in item.transform.ravel().tolist())
    return f'<item objectid="{item.number + 2}" transform="{rows}"/>'
