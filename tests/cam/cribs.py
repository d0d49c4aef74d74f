"""Small tool libraries of other programs, written for the tests in their schemas."""

import json
import zipfile
from pathlib import Path
from typing import Any


def fusion_tool(number: int, **changes: Any) -> dict[str, Any]:
    """A flat end mill of 6 mm with a preset for aluminium; ``geometry`` is laid over, all else replaces."""
    tool: dict[str, Any] = {
        "type": "flat end mill",
        "unit": "millimeters",
        "BMC": "carbide",
        "description": f'6 mm "Fräser" {number}',
        "geometry": {"DC": 6, "LCF": 20, "LB": 30, "NOF": 3, "SFDM": 6, "HAND": True},
        "holder": {
            "unit": "inches",
            "segments": [
                {"height": 0.5, "lower-diameter": 1, "upper-diameter": 1.5},
                {"height": 1, "lower-diameter": 1.5, "upper-diameter": 1.5},
                {"height": 1, "lower-diameter": 4, "upper-diameter": 4},
            ],
        },
        "post-process": {"number": number, "length-offset": number, "diameter-offset": number},
        "start-values": {"presets": [preset("Aluminum rough")]},
        "expressions": {"tool_diameter": "(29,5) mm"},
    }
    geometry = tool["geometry"] | changes.pop("geometry", {})
    return tool | changes | {"geometry": geometry}


def preset(name: str, **changes: Any) -> dict[str, Any]:
    """Cutting data of a 6 mm mill with three teeth: 200 m/min, 0.04 mm, half a diameter deep."""
    turns = 200_000 / 18.849556
    return {
        "name": name,
        "n": turns,
        "v_c": 200,
        "f_z": 0.04,
        "v_f": turns * 3 * 0.04,
        "v_f_plunge": turns * 3 * 0.04 * 0.25,
        "use-stepdown": True,
        "stepdown": 3,
        "use-stepover": False,
        "stepover": 1,
        "ramp-angle": 2,
        "material": {"category": "all", "query": "", "use-hardness": False},
        **changes,
    }


def fusion(path: Path, *tools: object, version: object = 36) -> Path:
    """A library of Fusion; packed where its name ends in ``.tools``."""
    text = json.dumps({"data": list(tools), "version": version})
    if path.suffix == ".tools":
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("tools.json", text)
    else:
        path.write_text(text, encoding="utf-8")
    return path


def bit(shape: str, attribute: dict[str, str] | None = None, **parameter: str) -> dict[str, Any]:
    """A bit of FreeCAD."""
    return {
        "version": 2,
        "name": f"a {shape}",
        "shape": f"{shape.lower()}.fcstd",
        "shape-type": shape,
        "parameter": parameter,
        "attribute": attribute or {},
    }


def freecad(folder: Path, *bits: dict[str, Any], version: int = 1) -> Path:
    """A library of FreeCAD with its bits in ``../Bit``."""
    for name in ("Library", "Bit"):
        (folder / name).mkdir(exist_ok=True)
    rows = []
    for number, content in enumerate(bits, start=1):
        (folder / "Bit" / f"bit{number}.fctb").write_text(json.dumps(content), encoding="utf-8")
        rows.append({"nr": number, "path": f"bit{number}.fctb"})
    path = folder / "Library" / "crib.fctl"
    path.write_text(json.dumps({"version": version, "label": "crib", "tools": rows}))
    return path
