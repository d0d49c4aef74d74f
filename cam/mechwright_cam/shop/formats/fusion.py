"""Tool libraries of Fusion 360 and HSMWorks: JSON, or ``.tools``, a ZIP of it.

``geometry`` is read and ``expressions``, which may be written in the language of a country, are not. Every
tool has its own unit.
"""

import io
import json
import lzma
import zipfile
import zlib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any
from uuid import NAMESPACE_URL, uuid5

from mechwright.designs.files import INPUT_LIMIT, read_bytes, text_of
from mechwright.errors import DesignError
from mechwright_cam.shop.formats.contract import Format, OmittedToolError, ToolRecord, number, tool_number
from mechwright_cam.shop.formats.fusion_presets import presets_of, read_presets
from mechwright_cam.shop.formats.jsons import parsed
from mechwright_cam.shop.tool import MILLS, Tool, ToolKind

VERSION = 36
"""Newest version of the file that is known."""
MEMBER = "tools.json"
"""Name of the file in a ``.tools``."""
UNITS = {"millimeters": 1.0, "inches": 25.4}
LEFT = "tap left hand"
"""The one kind that turns backwards."""
KINDS = {
    "flat end mill": ToolKind.END_MILL,
    "bull nose end mill": ToolKind.BULL_NOSE,
    "ball end mill": ToolKind.BALL,
    "chamfer mill": ToolKind.CHAMFER,
    "drill": ToolKind.DRILL,
    "spot drill": ToolKind.SPOT_DRILL,
    "thread mill": ToolKind.THREAD_MILL,
    "reamer": ToolKind.REAMER,
    "tap right hand": ToolKind.TAP,
    LEFT: ToolKind.TAP,
}
NOSE = 20.0
"""Segments of a holder that begin within this height above its lower end count, mm: higher up nothing of a
plate and its clamps stands."""
MOST_OFF = 0.01
"""By this share two statements of one size may differ."""
BROKEN = (zipfile.BadZipFile, zlib.error, lzma.LZMAError, EOFError, OSError, RuntimeError, ValueError)
"""What a ZIP that is broken, locked or packed in a strange way makes the library raise."""
DRILLS = (ToolKind.DRILL, ToolKind.SPOT_DRILL)


class FusionLibrary(Format):
    """``.json`` and ``.tools``."""

    title = "a Fusion tool library"
    suffixes = (".json", ".tools")
    fields = {  # noqa: RUF012 - as the contract has it
        "number": "post-process.number",
        "diameter": "DC",
        "flute_length": "LCF",
        "stick_out": "LB",
        "shank_diameter": "SFDM",
        "flutes": "NOF",
        "corner_radius": "RE",
        "point_angle": "SIG or TA",
        "tip_diameter": "tip-diameter",
        "neck_diameter": "shoulder-diameter",
        "pitch": "TP",
        "left_hand": "type",
        "holder_diameter": "holder.segments",
    }

    def read(self, path: Path) -> list[ToolRecord]:
        """A tool for each entry of ``data`` that is no holder."""
        data = parsed(_text(path), path, VERSION, "export it from an older Fusion, or tell us")
        rows = data.get("data")
        if not isinstance(rows, list):
            raise DesignError(
                f"{path}: is no Fusion tool library: it has no list 'data'; is it the right file?"
            )
        tools = [row for row in rows if not (isinstance(row, Mapping) and row.get("type") == "holder")]
        return [_said(row, place) for place, row in enumerate(tools, start=1)]

    def files(self, tools: Sequence[Tool], path: Path) -> dict[Path, bytes]:
        """One file; the same tools give the same bytes."""
        text = json.dumps({"data": [_row(tool) for tool in tools], "version": VERSION}, indent=1)
        if path.suffix.lower() != ".tools":
            return {path: (text + "\n").encode()}
        packed = io.BytesIO()
        with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
            archive.writestr(zipfile.ZipInfo(MEMBER), text, zipfile.ZIP_DEFLATED)
        return {path: packed.getvalue()}


def _text(path: Path) -> str:
    """The JSON of a file, packed or not, whatever it is called."""
    packed = read_bytes(path)
    if not packed.startswith(b"PK"):
        return text_of(packed, path)
    try:
        with zipfile.ZipFile(io.BytesIO(packed)) as archive, archive.open(MEMBER) as member:
            data = member.read(INPUT_LIMIT + 1)
    except KeyError as error:
        raise DesignError(
            f"{path}: is a ZIP without {MEMBER}; export the library from Fusion anew"
        ) from error
    except BROKEN as error:
        raise DesignError(f"{path}: is no ZIP that can be read ({error}); export it anew") from error
    if len(data) > INPUT_LIMIT:
        raise DesignError(
            f"{path}: {MEMBER} in it is larger than {INPUT_LIMIT:,} bytes; is it the right file?"
        )
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise DesignError(f"{path}: {MEMBER} in it is no UTF-8 text (byte {error.start})") from error


def _said(row: object, place: int) -> ToolRecord:
    said = ToolRecord(f"entry {place}")
    try:
        if not isinstance(row, Mapping):
            raise OmittedToolError(f"is {row!r:.40} and no tool; delete it")
        said.label = str(row.get("description") or row.get("product-id") or said.label)
        post = _table(row, "post-process")
        said.keys["number"] = tool_number(post.get("number"))
        _offsets(said, post)
        scale = _scale(row)
        _shape(said, row, scale)
        read_presets(said, row, scale)
    except OmittedToolError as error:
        said.fault = str(error)
    return said


def _table(row: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    value = row.get(key)
    return value if isinstance(value, Mapping) else {}


def _scale(row: Mapping[str, Any]) -> float:
    """Millimetres in a unit of the tool; old exports say it with quotes in ``expressions``."""
    unit = str(row.get("unit") or _table(row, "expressions").get("tool_unit", "")).strip("'\" ")
    if unit not in UNITS:
        raise OmittedToolError(f"its unit is {unit!r:.40}; set it to millimeters or inches")
    return UNITS[unit]


def _offsets(said: ToolRecord, post: Mapping[str, Any]) -> None:
    t = said.keys["number"]
    h, d = number(post.get("length-offset")), number(post.get("diameter-offset"))
    if h is not None and h != t:
        raise OmittedToolError(f"its length offset is H{h:g}, and programs call H{t}; set it to {t}")
    if d is not None and d != t:
        said.keys["diameter_offset"] = tool_number(d)


def _shape(said: ToolRecord, row: Mapping[str, Any], scale: float) -> None:
    geometry, keys, kind = _table(row, "geometry"), said.keys, KINDS.get(str(row.get("type")))
    if kind is None:
        raise OmittedToolError(
            f"there is no {row.get('type')!r:.40} among our kinds of tools; leave it to other programs"
        )
    if kind is ToolKind.TAP:
        keys["left_hand"] = row.get("type") == LEFT
    elif geometry.get("HAND") is False:
        raise OmittedToolError("it turns left (HAND false), and programs start the spindle with M3")
    keys["kind"] = kind.value

    def length(name: str) -> float | None:
        found = number(geometry.get(name))
        return None if found is None or found == 0 else found * scale

    wide = length("DC")
    if wide is None or wide < 0:
        if isinstance(said_of := geometry.get("DC"), str) and said_of:
            raise OmittedToolError(
                f"its diameter (DC) is the text {said_of!r:.40} and no number; save it anew"
            )
        raise OmittedToolError("has no diameter (DC); give it one")
    keys["diameter"] = wide
    for key, name in (("flute_length", "LCF"), ("stick_out", "LB"), ("shank_diameter", "SFDM")):
        if (value := length(name)) is not None:
            keys[key] = value
    if kind is ToolKind.TAP:
        if not (pitch := length("TP")):
            raise OmittedToolError("a tap without a pitch (TP); give it one")
        keys["pitch"] = pitch
    if kind is ToolKind.BULL_NOSE and (corner := length("RE")) is not None:
        keys["corner_radius"] = corner
    _ends(said, geometry, kind, length("RE"), length("tip-diameter"))
    if kind is ToolKind.THREAD_MILL and (neck := length("shoulder-diameter")) is not None and neck < wide:
        keys["neck_diameter"] = neck
    teeth = number(geometry.get("NOF"))
    if teeth:
        keys["flutes"] = teeth
    else:
        said.take("flutes", 2)
    material = str(row.get("BMC"))
    if material in {"hss", "carbide"}:
        keys["substrate"] = material
    else:
        said.take("substrate", "hss")
    _holder(said, row, scale)


def _ends(
    said: ToolRecord, geometry: Mapping[str, Any], kind: ToolKind, corner: float | None, tip: float | None
) -> None:
    """Angle and flat of a pointed tool; what contradicts itself is refused."""
    keys, wide = said.keys, said.keys["diameter"]
    round_end = {ToolKind.BALL: wide / 2, ToolKind.END_MILL: 0.0}.get(kind)
    if corner is not None and round_end is not None and abs(corner - round_end) > MOST_OFF * wide:
        raise OmittedToolError(
            f"RE is {corner:g} mm, and that of a corner of {kind} {wide:g} mm is {round_end:g}; mend type or "
            "RE"
        )
    if kind in DRILLS:
        angle = number(geometry.get("SIG"))
        if angle:
            keys["point_angle"] = angle
        else:
            said.take("point_angle", 118.0 if kind is ToolKind.DRILL else 90.0)
    elif kind is ToolKind.CHAMFER:
        half = number(geometry.get("TA"))
        if not half:
            raise OmittedToolError("a chamfer mill without an angle (TA); give it one")
        keys["point_angle"] = 2 * half
        if tip is not None:
            keys["tip_diameter"] = tip


def _holder(said: ToolRecord, row: Mapping[str, Any], scale: float) -> None:
    """The widest of the holder's lowest segments; they stand in the holder's own unit."""
    holder = _table(row, "holder")
    own = UNITS.get(str(holder.get("unit")), scale)
    widest = height = 0.0
    segments = holder.get("segments")
    for segment in segments if isinstance(segments, list) else []:
        if not isinstance(segment, Mapping) or height > NOSE:
            break
        ends = (number(segment.get(name)) or 0.0 for name in ("lower-diameter", "upper-diameter"))
        widest = max(widest, *(end * own for end in ends))
        height += (number(segment.get("height")) or 0.0) * own
    if widest > 0:
        said.keys["holder_diameter"] = widest
    else:
        said.take("holder_diameter", Tool.model_fields["holder_diameter"].default)


def _row(tool: Tool) -> dict[str, Any]:
    """One tool in millimetres."""
    geometry: dict[str, Any] = {
        "DC": tool.diameter,
        "LCF": tool.flute_length,
        "NOF": tool.flutes,
        "shoulder-length": tool.flute_length,
        "shoulder-diameter": tool.neck_diameter or tool.diameter,
        "HAND": not tool.left_hand,
        "CSP": False,
    }
    if tool.stick_out is not None:
        geometry["LB"] = tool.stick_out
    if tool.shank_diameter is not None:
        geometry["SFDM"] = tool.shank_diameter
    if tool.pitch is not None:
        geometry["TP"] = tool.pitch
    if tool.kind in MILLS:
        geometry["RE"] = tool.nose
    elif tool.kind in DRILLS:
        geometry["SIG"] = tool.point_angle
    elif tool.kind is ToolKind.CHAMFER:
        geometry |= {"TA": tool.point_angle / 2, "tip-diameter": tool.tip_diameter}
    segment = {"height": NOSE, "lower-diameter": tool.holder_diameter, "upper-diameter": tool.holder_diameter}
    holder = {"description": "holder", "type": "holder", "unit": "millimeters", "segments": [segment]}
    return {
        "type": LEFT if tool.left_hand else next(name for name, kind in KINDS.items() if kind is tool.kind),
        "unit": "millimeters",
        "BMC": tool.substrate,
        "description": tool.name,
        "guid": str(uuid5(NAMESPACE_URL, f"mechwright:{tool.name}:{tool.number}")),
        "vendor": "",
        "product-id": "",
        "geometry": geometry,
        "holder": holder,
        "post-process": {
            "number": tool.number,
            "length-offset": tool.number,
            "diameter-offset": tool.d_number,
            "turret": 0,
            "comment": "",
            "live": True,
            "break-control": False,
            "manual-tool-change": False,
        },
        "start-values": {"presets": presets_of(tool)},
    }
