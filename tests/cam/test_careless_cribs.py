"""Forty libraries and shop files as a newcomer writes them: one line that says what is wrong, nothing guessed."""

import json
from collections.abc import Mapping
from pathlib import Path

import pytest
from cribs import fusion_tool

from mechwright.errors import MechwrightError
from mechwright_cam.shop.library import load_library
from mechwright_cam.shop.workshop_file import read_shop

HEAD = "built_in = false\n"
TOOL = '[[tool]]\nname = "a"\nnumber = 1\nkind = "end-mill"\ndiameter = 6\nflute_length = 20\n'
DATA = "[tool.cutting.aluminium]\ncutting_speed = 200\nchip_load = 0.04\n"
OTHER = TOOL.replace('"a"', '"b"')
OURS = {
    "two of one number": (TOOL + DATA + OTHER, "'a' and 'b' both have number 1"),
    "two of one name": (TOOL + TOOL.replace("number = 1", "number = 2"), "two tools are called 'a'"),
    "no diameter": (TOOL.replace("diameter = 6\n", ""), "tool 'a'.diameter: is missing"),
    "no name": (TOOL.replace('name = "a"\n', ""), "tool 1 of the file.name: is missing"),
    "no number": (TOOL.replace("number = 1\n", ""), "tool 'a'.number: is missing"),
    "T1 for 1": (TOOL.replace("= 1", '= "T1"'), "'T1' should be a whole number"),
    "number 0": (TOOL.replace("= 1", "= 0"), "0 should be greater than or equal to 1"),
    "endmill": (TOOL.replace("end-mill", "endmill"), "'endmill' should be 'end-mill'"),
    "a fraction without a unit": (TOOL.replace("= 6", '= "1/4"'), "'1/4' cannot be read in mm"),
    "a negative diameter": (TOOL.replace("= 6", "= -6"), "-6 should be greater than 0"),
    "a diameter of 0": (TOOL.replace("= 6", "= 0"), "0 should be greater than 0"),
    "a decimal comma": (TOOL.replace("= 6", "= 6,5"), "has a decimal comma"),
    "nan": (TOOL.replace("= 6", "= nan"), "should be a finite number"),
    "tools for tool": (TOOL.replace("[[tool]]", "[[tools]]"), "unknown key 'tools'"),
    "one bracket": (TOOL.replace("[[tool]]", "[tool]"), "add a [[tool]] table"),
    "aluminum": (TOOL + DATA.replace("minium", "minum"), "no such material as 'aluminum'"),
    "no chip load": (TOOL + DATA.replace("0.04", "0"), "0 should be greater than 0"),
    "a tap without its pitch": (TOOL.replace("end-mill", "tap"), "a tap needs its pitch"),
    "out of the holder": (TOOL + "stick_out = 10\n", "stick_out must be at least flute_length"),
    "a colour": (TOOL + 'color = "red"\n', "unknown key 'color'"),
    "centimetres": ('units = "cm"\n' + TOOL, 'is \'cm\'; write "mm" or "inch"'),
    "a layout": ("format = 2\n" + TOOL, "unknown key 'format'"),
    "prose": ("my tools are great\n", "is no valid TOML"),
}


def one_line(path: Path, said: str, read: object = load_library) -> None:
    with pytest.raises(MechwrightError) as caught:
        read(path)  # type: ignore[operator]
    message = str(caught.value)
    assert message.startswith(f"{path}: ")
    assert said in message
    assert "\n" not in message


@pytest.mark.parametrize("case", OURS)
def test_a_library_of_ours(case: str, tmp_path: Path) -> None:
    text, said = OURS[case]
    path = tmp_path / "tools.toml"
    path.write_text(text if text.startswith(("units", "format", "my")) else HEAD + text)
    one_line(path, said)


def test_inches_have_their_mark(tmp_path: Path) -> None:
    path = tmp_path / "tools.toml"
    path.write_text(HEAD + TOOL.replace("diameter = 6", "diameter = '1/4\"'"))
    assert load_library(path).get("a").diameter == pytest.approx(6.35)


@pytest.mark.parametrize("suffix", [".xlsx", ".dat", ".txt", ".xml", ""])
def test_files_of_other_kinds(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"tools{suffix}"
    path.write_bytes(b"PK\x03\x04 anything")
    one_line(path, "is of no known format; end its name in one of: .toml, .tbl, .json")


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"DC": "6 mm"}, "its diameter (DC) is the text '6 mm' and no number"),
        ({"DC": 0}, "has no diameter (DC)"),
    ],
)
def test_a_fusion_library(changes: Mapping[str, object], said: str, tmp_path: Path) -> None:
    tool = fusion_tool(1)
    tool["geometry"] = {**tool["geometry"], **changes}
    path = tmp_path / "crib.json"
    path.write_text(json.dumps({"data": [tool], "version": 36}))
    one_line(path, said)


SHOPS = {
    "a newer layout": ("format = 2\n" + TOOL, "format: 2 is not known"),
    "no tool": ('name = "mine"\n', "holds no tool"),
    "tools for tool": (TOOL.replace("[[tool]]", "[[tools]]"), "a shop file holds [[tool]] tables"),
    "two of one number": (TOOL + OTHER, "'a' and 'b' both have number 1"),
    "a crib that is not there": ('crib = "gone.json"\n', "crib: "),
    "a mill that is not there": ('machine = "mill.toml"\n' + TOOL, "machine: "),
    "a mill of another name": ('machine = "hass"\n' + TOOL, "unknown machine 'hass'"),
    "a crib elsewhere": ('crib = "../../x.json"\n', "leads out of the folder"),
    "a thickness without brackets": ('stock = "10 mm"\n' + TOOL, "should be a list in square brackets"),
    "a screw of inches": ('screws = ["M4", "1/4-20"]\n' + TOOL, "should be a metric thread, such as M5"),
    "a holder that is none": (TOOL + 'holder = "ER20"\n', "no holder 'ER20'"),
    "a key of [cam]": (TOOL + '[prefer.cam]\ncoolent = "off"\n', "did you mean 'coolant'?"),
    "half a setter": (TOOL + "[prefer.cam.setter]\nx = 1\n", "give x, y and over of the setter"),
}


@pytest.mark.parametrize("case", SHOPS)
def test_a_shop_file(case: str, tmp_path: Path) -> None:
    text, said = SHOPS[case]
    path = tmp_path / "shop.toml"
    path.write_text(text)
    one_line(path, said, read_shop)
