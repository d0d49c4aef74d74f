"""Cutting data of Fusion, its presets, and ours.

A preset has a name that people write and, hardly ever filled in, a material; one whose name or material is a
material of ours is taken over. Two statements of one figure that contradict each other are told, and the
preset is not taken over.
"""

import math
import re
from collections.abc import Mapping
from typing import Any

from pydantic import ValidationError

from mechwright.contracts.materials import GROUPS
from mechwright_cam.shop.formats.contract import LONGEST, ToolRecord, number
from mechwright_cam.shop.tool import CuttingData, Tool, ToolKind

WORDS = {name: name for name in GROUPS} | {
    "aluminum": "aluminium",
    "acetal": "pom",
    "delrin": "pom",
}
"""Words for our materials."""
FOOT = 0.3048
"""Metres; cutting speeds of a tool in inches are in feet a minute."""
MOST_OFF = 0.02
"""By this share figures that say the same may differ: files round them."""
DRILLS = {ToolKind.DRILL.value, ToolKind.SPOT_DRILL.value}


def read_presets(said: ToolRecord, row: Mapping[str, Any], scale: float) -> None:
    """Take over the presets of a tool that are for a material of ours."""
    values = row.get("start-values")
    presets = values.get("presets") if isinstance(values, Mapping) else None
    cutting: dict[str, Any] = {}
    ramps: set[float] = set()
    for preset in presets if isinstance(presets, list) else []:
        if not isinstance(preset, Mapping):
            continue
        name = str(preset.get("name", "")).strip()[:LONGEST] or "without a name"
        materials = _materials(preset)
        if len(materials) != 1:
            said.dropped.append(f"preset {name!r}: {_unclear(materials)}")
            continue
        (material,) = materials
        if material in cutting:
            said.dropped.append(f"preset {name!r}: a second one for {material}; delete one")
            continue
        data, fault = _cutting(said, preset, scale)
        if fault:
            said.dropped.append(f"preset {name!r}: {fault}")
            continue
        cutting[material] = data
        if ramp := number(preset.get("ramp-angle")):
            ramps.add(ramp)
    if cutting:
        said.keys["cutting"] = cutting
    if ramps:
        said.keys["ramp_angle"] = min(ramps)


def _materials(preset: Mapping[str, Any]) -> set[str]:
    material = preset.get("material")
    query = material.get("query", "") if isinstance(material, Mapping) else ""
    words = re.findall(r"[a-z]+", f"{preset.get('name', '')} {query}".lower())
    return {WORDS[word] for word in words if word in WORDS}


def _unclear(materials: set[str]) -> str:
    if materials:
        return f"names {' and '.join(sorted(materials))}; make a preset for each"
    return f"names no material; put one of {', '.join(GROUPS)} into its name"


def _cutting(said: ToolRecord, preset: Mapping[str, Any], scale: float) -> tuple[dict[str, float], str]:
    """Cutting data of a preset; or what is wrong with it."""

    def positive(name: str) -> float:
        return max(number(preset.get(name)) or 0.0, 0.0)

    wide, teeth = said.keys["diameter"], float(said.keys["flutes"])
    drills = said.keys["kind"] in DRILLS
    turns = positive("n")
    metres = positive("v_c") * (1.0 if scale == 1.0 else FOOT)
    rim = math.pi * wide * turns / 1000
    plunge = positive("v_f_plunge") * scale
    feed = (positive("v_f") or (plunge / scale if drills else 0.0)) * scale
    bite = (positive("f_n") / teeth if drills else positive("f_z")) * scale
    if metres and rim and abs(metres / rim - 1) > MOST_OFF:
        return {}, f"v_c is {metres:.4g} m/min, and n {turns:g} on {wide:g} mm makes {rim:.4g}; mend one"
    by_feed = feed / (turns * teeth) if turns else 0.0
    if bite and by_feed and abs(bite / by_feed - 1) > MOST_OFF:
        return {}, f"a tooth takes {bite:.4g} mm, and its feed with n makes {by_feed:.4g}; mend one"
    speed, load = metres or rim, bite or by_feed
    if not speed or not load:
        return {}, "says no cutting speed (v_c or n) or no feed (f_z, f_n or v_f); give both"
    data = {"cutting_speed": speed, "chip_load": load}
    if preset.get("use-stepdown") and positive("stepdown"):
        data["step_down"] = positive("stepdown") * scale / wide
    if preset.get("use-stepover") and positive("stepover"):
        data["step_over"] = positive("stepover") * scale / wide
    if plunge and feed and not drills:
        data["plunge"] = plunge / feed
    try:
        return CuttingData.model_validate(data).model_dump(), ""
    except ValidationError as error:
        first = error.errors(include_url=False)[0]
        return {}, f"{first['loc'][0]} {first['input']:.4g}: {first['msg'].removeprefix('Input ')}; mend it"


def presets_of(tool: Tool) -> list[dict[str, Any]]:
    """Our cutting data as presets in millimetres, each with the name of its material."""
    presets = []
    for material, data in tool.cutting.items():
        turns = data.cutting_speed * 1000 / (math.pi * tool.diameter)
        feed = turns * tool.flutes * data.chip_load
        drills = tool.kind.value in DRILLS
        plunge = feed if drills else feed * data.plunge
        preset = {
            "name": material,
            "material": {"category": "all", "query": material, "use-hardness": False},
            "n": turns,
            "n_ramp": turns,
            "v_c": data.cutting_speed,
            "f_z": data.chip_load,
            "f_n": plunge / turns,
            "v_f": feed,
            "v_f_plunge": plunge,
            "v_f_ramp": feed,
            "use-stepdown": True,
            "stepdown": data.step_down * tool.diameter,
            "use-stepover": True,
            "stepover": data.step_over * tool.diameter,
            "tool-coolant": "flood",
        }
        if tool.ramp_angle is not None:
            preset["ramp-angle"] = tool.ramp_angle
        presets.append(preset)
    return presets
