"""A sheet as DXF R2010: the part in its true size, dimensions as dimensions. Imports ezdxf.

Lines and texts of a dimension are those of the sheet, in a block of its own: ezdxf would measure text by the
fonts of the machine.
"""

import io

from ezdxf import units
from ezdxf.document import Drawing
from ezdxf.enums import TextEntityAlignment
from ezdxf.filemanagement import new
from ezdxf.layouts.base import BaseLayout

from mechwright.geometry.segments import Point
from mechwright.pipeline.result_store import stored
from mechwright_cad.exporters.decimals import of_dxf
from mechwright_cad.exporters.dxf import fixed_metadata, order_classes
from mechwright_cad.sheet.sheet import (
    ARROW,
    DASHES,
    HEIGHT,
    WIDTH,
    Dimension,
    Fill,
    Item,
    Layer,
    Sheet,
    Stroke,
    Text,
)

COLOURS = {"OUTLINE": 7, "HIDDEN": 6, "DIM": 3, "CENTRE": 1, "HATCH": 8, "TEXT": 7, "FRAME": 7}
"""Layer to colour index."""

LINES: dict[Layer, tuple[str, str]] = {
    "CENTRE": ("CENTER", "Center ____ _ ____ _"),
    "HIDDEN": ("HIDDEN", "Hidden __ __ __ __"),
}
"""Layers whose lines are dashed, to the line's name and description; the second is only written if used."""

STYLE = "MECHWRIGHT"
"""Of dimensions."""


@stored
def dxf(sheet: Sheet) -> bytes:
    """The whole file; the same sheet gives the same bytes."""
    with fixed_metadata():
        document = new("R2010", units=units.MM)
        document.header["$MEASUREMENT"] = 1
        document.header["$LTSCALE"] = 1 / sheet.scale
        used = {piece.layer for item in sheet.items for piece in _pieces(item)}
        for layer, (line, words) in LINES.items():
            if layer == "CENTRE" or layer in used:
                document.linetypes.add(line, [sum(DASHES[layer]), *_dashes(layer)], description=words)
        for name, width in WIDTH.items():
            if name == "HIDDEN" and name not in used:
                continue
            line = LINES[name][0] if name in LINES else "CONTINUOUS"
            document.layers.add(name, color=COLOURS[name], linetype=line, lineweight=round(100 * width))
        _style(document, sheet.scale)
        space = document.modelspace()
        for item in sheet.items:
            _draw(document, space, item, sheet.scale)
        size = (sheet.width / sheet.scale, sheet.height / sheet.scale)
        space.reset_extents((0.0, 0.0, 0.0), (*size, 0.0))
        document.set_modelspace_vport(1.05 * size[1], center=(size[0] / 2, size[1] / 2))
        order_classes(document)
        stream = io.StringIO()
        document.write(stream)
        return of_dxf(stream.getvalue()).encode(document.output_encoding)


def _pieces(item: Item) -> tuple[Stroke | Fill | Text, ...]:
    return item.pieces if isinstance(item, Dimension) else (item,)


def _dashes(layer: Layer) -> list[float]:
    """Lengths of dashes above 0 and of gaps below, in turn."""
    return [length if k % 2 == 0 else -length for k, length in enumerate(DASHES[layer])]


def _style(document: Drawing, scale: float) -> None:
    """For whoever edits a dimension: the sizes that the sheet has."""
    style = document.dimstyles.new(STYLE)
    style.dxf.dimlfac, style.dxf.dimtsz, style.dxf.dimscale = 1.0, 0.0, 1 / scale
    style.dxf.dimtxt, style.dxf.dimasz = HEIGHT, ARROW[0]
    style.dxf.dimexo, style.dxf.dimexe, style.dxf.dimgap = 1.0, 2.0, 1.0
    style.dxf.dimdec, style.dxf.dimzin, style.dxf.dimtad, style.dxf.dimdsep = 3, 8, 1, 46


def _draw(document: Drawing, space: BaseLayout, item: Item, scale: float) -> None:
    def at(point: Point) -> Point:
        return point[0] / scale, point[1] / scale

    match item:
        case Stroke(points, layer):
            attributes = {"layer": layer}
            if len(points) == 2:
                space.add_line(at(points[0]), at(points[1]), dxfattribs=attributes)
            else:
                space.add_lwpolyline([at(point) for point in points], dxfattribs=attributes)
        case Fill(points, layer):
            corners = [at(point) for point in points]
            corners[2:] = corners[:1:-1]  # of four, a SOLID has the last two the other way round
            space.add_solid(corners, dxfattribs={"layer": layer})
        case Text():
            text = space.add_text(
                _coded(item.text), height=item.height / scale, dxfattribs={"layer": item.layer}
            )
            middle = item.align == "middle"
            text.set_placement(
                at(item.at), align=TextEntityAlignment.CENTER if middle else TextEntityAlignment.LEFT
            )
        case Dimension():
            block = document.blocks.new_anonymous_block("D")
            for one in item.pieces:
                _draw(document, block, one, scale)
            drawn = space.add_linear_dim(
                base=at(item.line),
                p1=at(item.first),
                p2=at(item.second),
                angle=90 if item.direction == "y" else 0,
                text=_coded(item.text.text),
                dimstyle=STYLE,
                dxfattribs={"layer": "DIM"},
            ).dimension
            drawn.dxf.geometry = block.name
            drawn.dxf.text_midpoint = at(item.text.at)


def _coded(text: str) -> str:
    return text.replace("⌀", "%%c").replace("±", "%%p").replace("°", "%%d")
