"""Tool libraries of FreeCAD CAM: ``.fctl``, a list of numbers and files, and the ``.fctb`` of each tool.

The bits lie in ``../Bit/`` of the library, as FreeCAD has them, in ``Bit/`` or beside it. They have no feeds;
the number of a tool is that of the list.
"""

import json
import math
import re
from collections.abc import Mapping, Sequence
from pathlib import Path, PurePosixPath
from typing import Any

from mechwright.designs.files import read_text
from mechwright.errors import DesignError, MechwrightError
from mechwright_cam.shop.formats.contract import Format, OmittedToolError, ToolRecord, number, tool_number
from mechwright_cam.shop.formats.jsons import parsed
from mechwright_cam.shop.tool import Tool, ToolKind

LIBRARY_VERSION, BIT_VERSION = 1, 2
"""Newest versions of both files that are known."""
KINDS = {
    "endmill": ToolKind.END_MILL,
    "bullnose": ToolKind.BULL_NOSE,
    "torus": ToolKind.BULL_NOSE,
    "ballend": ToolKind.BALL,
    "ballnose": ToolKind.BALL,
    "chamfer": ToolKind.CHAMFER,
    "vbit": ToolKind.CHAMFER,
    "drill": ToolKind.DRILL,
    "threadmill": ToolKind.THREAD_MILL,
    "tap": ToolKind.TAP,
    "reamer": ToolKind.REAMER,
}
"""Shapes, by their letters alone."""
SHAPES = {
    ToolKind.END_MILL: ("Endmill", "endmill.fcstd"),
    ToolKind.BULL_NOSE: ("Bullnose", "bullnose.fcstd"),
    ToolKind.BALL: ("Ballend", "ballend.fcstd"),
    ToolKind.CHAMFER: ("Chamfer", "chamfer.fcstd"),
    ToolKind.DRILL: ("Drill", "drill.fcstd"),
    ToolKind.THREAD_MILL: ("ThreadMill", "thread-mill.fcstd"),
    ToolKind.TAP: ("Tap", "tap.fcstd"),
    ToolKind.REAMER: ("Reamer", "reamer.fcstd"),
}
"""The other way; FreeCAD has no spot drill."""
REACHES = {ToolKind.THREAD_MILL: "NeckLength", ToolKind.TAP: "CuttingEdgeLength"}
"""What says how deep a tool cuts, where it is not its ``CuttingEdgeHeight``."""
UNITS = {
    "length": {
        "mm": 1.0,
        "cm": 10.0,
        "m": 1000.0,
        "in": 25.4,
        '"': 25.4,
        "um": 0.001,
        "µm": 0.001,
        "\u03bcm": 0.001,
    },
    "angle": {"°": 1.0, "deg": 1.0, "rad": 180 / math.pi},
}
SAME_ANGLE = 1.0
"""Degrees by which a stated angle may differ from that of diameter, tip and height."""
_QUANTITY = re.compile(r"\s*([+-]?\d+(?:[.,]\d+)?)\s*(\S+)\s*")
_NEWER = "save it with an older FreeCAD, or tell us"


class FreeCadLibrary(Format):
    """``.fctl`` with its bits."""

    title = "a FreeCAD tool library"
    suffixes = (".fctl",)
    fields = {  # noqa: RUF012 - as the contract has it
        "number": "nr",
        "diameter": "Diameter",
        "flute_length": "CuttingEdgeHeight or NeckLength",
        "shank_diameter": "ShankDiameter",
        "flutes": "Flutes",
        "corner_radius": "CornerRadius",
        "point_angle": "TipAngle or CuttingEdgeAngle",
        "tip_diameter": "TipDiameter",
        "neck_diameter": "NeckDiameter",
    }

    def read(self, path: Path) -> list[ToolRecord]:
        """A tool for each entry of the list."""
        return [_said(path, row, place) for place, row in enumerate(_rows(path), start=1)]

    def companion_files(self, path: Path) -> tuple[Path, ...]:
        """The bits that are there."""
        found = (_bit(path, row) for row in _rows(path))
        return tuple(bit for bit in found if bit is not None)

    def files(self, tools: Sequence[Tool], path: Path) -> dict[Path, bytes]:
        """The list, and a bit for each tool in ``../Bit/``, but for spot drills."""
        if path.absolute().parent.name != "Library":
            raise DesignError(
                f"{path}: FreeCAD keeps bits beside a folder Library; export to Library/{path.name}, which "
                "writes Bit/ beside it"
            )
        held = [tool for tool in tools if tool.kind in SHAPES]
        rows = [{"nr": tool.number, "path": f"{tool.name}.fctb"} for tool in held]
        files = {path: _json({"version": LIBRARY_VERSION, "label": path.stem, "tools": rows})}
        folder = path.parent.parent / "Bit" if path.parent.name else path.absolute().parent.parent / "Bit"
        return files | {folder / f"{tool.name}.fctb": _json(_content(tool)) for tool in held}


def _json(data: object) -> bytes:
    return (json.dumps(data, indent=2, ensure_ascii=False) + "\n").encode()


def _rows(path: Path) -> list[Any]:
    rows = parsed(read_text(path)[0], path, LIBRARY_VERSION, _NEWER).get("tools")
    if not isinstance(rows, list):
        raise DesignError(
            f"{path}: is no FreeCAD tool library: it has no list 'tools'; is it the right file?"
        )
    return rows


def _bit(path: Path, row: object) -> Path | None:
    """The file of a row; None where it is not there, or would lie elsewhere."""
    name = row.get("path") if isinstance(row, Mapping) else None
    if (
        not isinstance(name, str)
        or not 0 < len(name) <= 200
        or PurePosixPath(name).name != name
        or "\\" in name
        or "\0" in name
    ):
        return None
    name = name if name.endswith(".fctb") else f"{name}.fctb"
    folder = path.absolute().parent
    places = (folder.parent / "Bit", folder / "Bit", folder)
    return next((place / name for place in places if (place / name).is_file()), None)


def _said(path: Path, row: object, place: int) -> ToolRecord:
    said = ToolRecord(f"entry {place}")
    try:
        if not isinstance(row, Mapping):
            raise OmittedToolError(f"is {row!r:.40} and no tool; delete it")
        said.label = str(row.get("path") or said.label).removesuffix(".fctb")
        said.keys["number"] = tool_number(row.get("nr"))
        bit = _bit(path, row)
        if bit is None:
            raise OmittedToolError(
                "its .fctb is neither in ../Bit nor in Bit nor beside the library; copy it"
            )
        data = parsed(read_text(bit)[0], bit, BIT_VERSION, _NEWER)
        _shape(said, data)
    except (OmittedToolError, MechwrightError) as error:
        said.fault = str(error)
    return said


def _kind(data: Mapping[str, Any]) -> ToolKind:
    shape = str(data.get("shape-type") or Path(str(data.get("shape", ""))).stem)
    kind = KINDS.get(re.sub(r"[^a-z]", "", shape.lower()))
    if kind is None:
        raise OmittedToolError(
            f"there is no {shape!r:.40} among our kinds of tools; leave it to other programs"
        )
    return kind


def _shape(said: ToolRecord, data: Mapping[str, Any]) -> None:
    said.label = str(data.get("name") or data.get("label") or said.label)
    values: dict[str, Any] = {}
    for table in (data.get("attribute"), data.get("parameter")):
        values |= table if isinstance(table, Mapping) else {}
    kind, keys = _kind(data), said.keys
    backwards = str(values.get("SpindleDirection", "")).lower() == "reverse"
    if kind is ToolKind.TAP:
        keys["left_hand"] = backwards
        if not (pitch := _quantity(values, "Pitch")):
            raise OmittedToolError("a tap without a pitch (Pitch); give it one")
        keys["pitch"] = pitch
    elif backwards:
        raise OmittedToolError("it turns left (SpindleDirection), and programs start the spindle with M3")
    keys["kind"] = kind.value
    if not (wide := _quantity(values, "Diameter")):
        raise OmittedToolError("has no diameter (Diameter); give it one")
    keys["diameter"] = wide
    reach = REACHES.get(kind, "CuttingEdgeHeight")
    if kind is ToolKind.DRILL and reach not in values:
        raise OmittedToolError("does not say how long its flutes are; add a CuttingEdgeHeight to its .fctb")
    for key, name in (("flute_length", reach), ("shank_diameter", "ShankDiameter")):
        if value := _quantity(values, name):
            keys[key] = value
    if kind is ToolKind.BULL_NOSE:
        keys["corner_radius"] = _corner(values, wide)
    elif kind is ToolKind.DRILL:
        angle = _quantity(values, "TipAngle", "angle")
        if angle:
            keys["point_angle"] = angle
        else:
            said.take("point_angle", 118.0)
    elif kind is ToolKind.CHAMFER:
        _cone(said, values)
    elif kind is ToolKind.THREAD_MILL and (neck := _quantity(values, "NeckDiameter")):
        keys["neck_diameter"] = neck
    if flutes := number(values.get("Flutes")):
        keys["flutes"] = flutes
    else:
        said.take("flutes", 2)
    material = str(values.get("Material", "")).lower()
    if material in {"hss", "carbide"}:
        keys["substrate"] = material
    else:
        said.take("substrate", "hss")
    chip = values.get("Chipload")
    if isinstance(chip, str) and re.search("[1-9]", chip):
        said.dropped.append(
            f"Chipload {chip!r:.40}: it says no cutting speed and no material; write [cam.cutting]"
        )


def _corner(values: Mapping[str, Any], wide: float) -> float:
    for name in ("CornerRadius", "TorusRadius"):
        if found := _quantity(values, name):
            return found
    flat = _quantity(values, "FlatRadius")
    if not flat:
        raise OmittedToolError("a bull nose without a corner radius (CornerRadius); give it one")
    if abs(wide / 2 - 2 * flat) > 1e-3:
        raise OmittedToolError(
            f"FlatRadius {flat:g} mm may be the corner's or the flat's; give it a CornerRadius"
        )
    return flat  # both are the same


def _cone(said: ToolRecord, values: Mapping[str, Any]) -> None:
    """The angle of a chamfer mill, from its sizes; the stated one has to agree."""
    wide, high = said.keys["diameter"], said.keys.get("flute_length")
    tip = _quantity(values, "TipDiameter") or 0.0
    if not high:
        raise OmittedToolError("has no height of its cutting edge (CuttingEdgeHeight); give it one")
    if tip >= wide:
        raise OmittedToolError(
            f"its tip of {tip:g} mm (TipDiameter) is no narrower than its diameter of {wide:g} mm"
        )
    angle = 2 * math.degrees(math.atan((wide - tip) / 2 / high))
    stated = _quantity(values, "CuttingEdgeAngle", "angle")
    if stated is not None and abs(stated - angle) > SAME_ANGLE:
        raise OmittedToolError(
            f"CuttingEdgeAngle says {stated:g} degrees, and diameter {wide:g}, tip {tip:g} and height "
            f"{high:g} mm make {angle:.1f}; mend one"
        )
    said.keys["point_angle"] = angle if stated is None else stated
    if tip:
        said.keys["tip_diameter"] = tip


def _quantity(values: Mapping[str, Any], name: str, kind: str = "length") -> float | None:
    """A value in mm or degrees; None where it is not there; raises OmittedToolError."""
    if name not in values:
        return None
    match = _QUANTITY.fullmatch(str(values[name]))
    if match is None or match[2] not in UNITS[kind]:
        known = ", ".join(UNITS[kind])
        raise OmittedToolError(f"{name} is {values[name]!r:.40}; write a number and a unit, one of: {known}")
    return float(match[1].replace(",", ".")) * UNITS[kind][match[2]]


def _content(tool: Tool) -> dict[str, Any]:
    """A bit of ours, lengths in millimetres to their last digit."""
    lengths = {"Diameter": tool.diameter}
    if tool.kind is ToolKind.CHAMFER:
        slope = math.tan(math.radians(tool.point_angle / 2))
        lengths["CuttingEdgeHeight"] = (tool.diameter - tool.tip_diameter) / 2 / slope
        lengths["TipDiameter"] = tool.tip_diameter
    else:
        lengths[REACHES.get(tool.kind, "CuttingEdgeHeight")] = tool.flute_length
    if tool.pitch is not None:
        lengths["Pitch"] = tool.pitch
    if tool.kind is ToolKind.BULL_NOSE:
        lengths["CornerRadius"] = tool.corner_radius
    if tool.neck_diameter is not None:
        lengths["NeckDiameter"] = tool.neck_diameter
    if tool.shank_diameter is not None:
        lengths["ShankDiameter"] = tool.shank_diameter
    parameter = {name: f"{value:.9f} mm" for name, value in lengths.items()}
    angle = {ToolKind.DRILL: "TipAngle", ToolKind.CHAMFER: "CuttingEdgeAngle"}.get(tool.kind)
    if angle is not None:
        parameter[angle] = f"{tool.point_angle:.9f} °"
    parameter["Flutes"] = str(tool.flutes)
    if tool.kind is ToolKind.TAP:
        parameter["SpindleDirection"] = "Reverse" if tool.left_hand else "Forward"
    shape, file = SHAPES[tool.kind]
    material = {"hss": "HSS", "carbide": "Carbide"}[tool.substrate]
    return {
        "version": BIT_VERSION,
        "name": tool.name,
        "shape": file,
        "shape-type": shape,
        "parameter": parameter,
        "attribute": {"Material": material},
    }
