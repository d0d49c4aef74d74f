"""Tool libraries of LinuxCNC, Fusion and FreeCAD: what is taken over, and what is told of the rest."""

import json
import zipfile

import pytest
from cribs import bit, freecad, fusion, fusion_tool, preset
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.errors import DesignError
from mechwright_cam.shop.formats.contract import ToolRecord, slug
from mechwright_cam.shop.formats.fusion import DRILLS, FusionLibrary
from mechwright_cam.shop.library import load_library
from mechwright_cam.shop.tool import MILLS, ToolKind


@pytest.mark.parametrize("name", ["crib.json", "crib.tools"])
def test_a_fusion_tool_is_taken_over_with_all_that_it_says(tmp_path, name):
    library = load_library(fusion(tmp_path / name, fusion_tool(7), {"type": "holder", "description": "BT30"}))
    (tool,) = library
    assert (tool.name, tool.number, tool.kind) == ("6-mm-fraser-7", 7, ToolKind.END_MILL)
    assert (tool.diameter, tool.flute_length, tool.stick_out, tool.shank_diameter) == (6, 20, 30, 6)
    assert (tool.flutes, tool.substrate, tool.ramp_angle, tool.d_number) == (3, "carbide", 2, 7)
    assert tool.holder_diameter == pytest.approx(38.1), "the lowest 20 mm, in inches"
    assert list(tool.cutting) == ["aluminium"]
    data = tool.cutting["aluminium"]
    assert (data.cutting_speed, data.chip_load, data.step_down) == (200, 0.04, 0.5)
    assert (data.step_over, data.plunge) == (0.4, pytest.approx(0.25)), "the step over is not used"
    assert library.told == ()


def test_a_tool_in_inches_is_converted_with_its_speeds(tmp_path):
    turns = 17000.0
    data = {"name": "steel", "n": turns, "v_c": 556.3, "f_z": 0.001, "v_f": turns * 2 * 0.001}
    data |= {"use-stepdown": True, "stepdown": 0.0625, "v_f_plunge": turns * 0.001}
    row = fusion_tool(
        1,
        unit=None,
        expressions={"tool_unit": "'inches'"},
        geometry={"DC": 0.125, "LCF": 0.5, "LB": 0.75, "NOF": 2, "SFDM": 0.125},
        **{"start-values": {"presets": [data]}},
    )
    (tool,) = load_library(fusion(tmp_path / "inch.json", row))
    assert tool.diameter == pytest.approx(3.175)
    assert tool.stick_out == pytest.approx(19.05)
    steel = tool.cutting["steel"]
    assert steel.cutting_speed == pytest.approx(169.6, abs=0.1), "π D n in m/min"
    assert steel.chip_load == pytest.approx(0.0254)
    assert steel.step_down == pytest.approx(0.5)
    assert steel.plunge == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("kind", "geometry", "expected"),
    [
        ("bull nose end mill", {"RE": 1}, {"corner_radius": 1}),
        ("ball end mill", {"RE": 3}, {"nose": 3}),
        ("chamfer mill", {"TA": 45, "tip-diameter": 0.4}, {"point_angle": 90, "tip_diameter": 0.4}),
        ("drill", {"SIG": 140}, {"point_angle": 140}),
        ("spot drill", {"SIG": 90}, {"point_angle": 90}),
        ("thread mill", {"shoulder-diameter": 4}, {"neck_diameter": 4}),
        ("tap right hand", {"TP": 1}, {"pitch": 1, "left_hand": False}),
        ("tap left hand", {"TP": 1, "HAND": False}, {"pitch": 1, "left_hand": True}),
    ],
)
def test_the_ends_of_fusion_tools(tmp_path, kind, geometry, expected):
    row = fusion_tool(1, type=kind, geometry=geometry, **{"start-values": {}})
    library = load_library(fusion(tmp_path / "a.json", row))
    (tool,) = library
    assert {key: getattr(tool, key) for key in expected} == expected
    assert library.told == ()


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"type": "face mill"}, "there is no 'face mill' among our kinds"),
        ({"type": "tap right hand"}, "a tap without a pitch (TP); give it one"),
        ({"geometry": {"HAND": False}}, "it turns left (HAND false)"),
        ({"geometry": {"DC": 0}}, "has no diameter (DC); give it one"),
        ({"geometry": {"DC": True}}, "has no diameter (DC)"),
        ({"geometry": {"LCF": 0}}, "the file does not say its flute_length (LCF)"),
        ({"geometry": {"LB": 10}}, "stick_out must be at least flute_length"),
        ({"geometry": {"RE": 1}}, "RE is 1 mm, and that of a corner of end-mill 6 mm is 0"),
        ({"type": "chamfer mill"}, "a chamfer mill without an angle (TA)"),
        ({"unit": "furlongs"}, "its unit is 'furlongs'; set it to millimeters or inches"),
        ({"post-process": {}}, "has no T number"),
        ({"post-process": {"number": 0}}, "T number 0 is not one of 1 to 9999"),
        (
            {"post-process": {"number": 1, "length-offset": 4}},
            "its length offset is H4, and programs call H1",
        ),
    ],
)
def test_a_fusion_tool_that_cannot_be_used_is_left_out_by_name(tmp_path, changes, reason):
    bad = fusion_tool(1, **changes) | {"description": "bad one"}
    library = load_library(fusion(tmp_path / "a.json", bad, fusion_tool(2)))
    assert [tool.number for tool in library] == [2]
    (line,) = library.told
    assert line.startswith("'bad one'")
    assert " is left out: " in line
    assert reason in line


def test_what_a_file_does_not_say_is_told_with_what_it_is_taken_as(tmp_path):
    row = fusion_tool(3, type="drill", BMC=17, holder={}, geometry={"NOF": 0}, **{"start-values": {}})
    (line,) = load_library(fusion(tmp_path / "a.json", row)).told
    for word in ("point_angle 118", "flutes 2", "substrate hss", "holder_diameter 40"):
        assert word in line


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (preset("Default preset"), "names no material; put one of aluminium,"),
        (preset("steel and brass"), "names brass and steel; make a preset for each"),
        (preset("steel", n=1500), "v_c is 200 m/min, and n 1500 on 6 mm makes 28.27"),
        (preset("steel", f_z=0.4), "a tooth takes 0.4 mm, and its feed with n makes 0.04"),
        (preset("steel", f_z=0, v_f=0), "says no cutting speed"),
        (preset("steel", n=0, v_c=2500), "cutting_speed 2500: should be less than or equal to 2000"),
        (preset("aluminium 2"), "a second one for aluminium"),
    ],
)
def test_a_preset_that_is_not_clear_is_told_and_no_data_are_made_up(tmp_path, data, reason):
    row = fusion_tool(1, **{"start-values": {"presets": [preset("aluminum"), data]}})
    library = load_library(fusion(tmp_path / "a.json", row))
    assert list(library.tools[0].cutting) == ["aluminium"]
    (line,) = library.told
    assert f"preset {data['name']!r}: " in line
    assert reason in line


def test_freecad_bits_lie_in_a_folder_beside_the_library(tmp_path):
    path = freecad(
        tmp_path,
        bit("Endmill", Diameter='0.25 "', CuttingEdgeHeight="20,5 mm", ShankDiameter="0.25 in", Flutes="3"),
        bit(
            "Bullnose", {"Material": "Carbide"}, Diameter="6 mm", CuttingEdgeHeight="9 mm", TorusRadius="1 mm"
        ),
        bit(
            "V-Bit", Diameter="6 mm", TipDiameter="1 mm", CuttingEdgeHeight="2.5 mm", CuttingEdgeAngle="90 °"
        ),
        bit(
            "Drill",
            {"Chipload": "25,0 \u03bcm"},
            Diameter="5000 \u03bcm",
            CuttingEdgeHeight="40 mm",
            TipAngle="119.0000 °",
        ),
        bit("ThreadMill", Diameter="4 mm", NeckLength="9 mm", NeckDiameter="3 mm", Crest="0.1 mm"),
    )
    library = load_library(path)
    (mill, bull, cone, drill, thread), told = library, library.told
    assert (mill.diameter, mill.flute_length) == (pytest.approx(6.35), 20.5)
    assert (mill.shank_diameter, mill.flutes, mill.number) == (pytest.approx(6.35), 3, 1)
    assert (bull.kind, bull.corner_radius, bull.substrate) == (ToolKind.BULL_NOSE, 1, "carbide")
    assert (cone.kind, cone.point_angle, cone.tip_diameter) == (ToolKind.CHAMFER, 90, 1)
    assert (drill.point_angle, drill.name) == (119, "a-drill")
    assert (thread.flute_length, thread.neck_diameter) == (9, 3)
    assert "(T4): not taken over: Chipload '25,0 \u03bcm': it says no cutting speed" in "\n".join(told)
    assert not any(tool.cutting for tool in (mill, bull, cone, drill, thread))


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (bit("Dovetail", Diameter="9 mm"), "there is no 'Dovetail' among our kinds"),
        (bit("Tap", Diameter="9 mm"), "a tap without a pitch (Pitch)"),
        (bit("Endmill", CuttingEdgeHeight="9 mm"), "has no diameter (Diameter)"),
        (bit("Endmill", Diameter="6"), "Diameter is '6'; write a number and a unit"),
        (bit("Drill", Diameter="6 mm", Length="90 mm"), "add a CuttingEdgeHeight to its .fctb"),
        (bit("Endmill", Diameter="6 mm"), "the file does not say its flute_length"),
        (
            bit("Endmill", {"SpindleDirection": "Reverse"}, Diameter="6 mm", CuttingEdgeHeight="9 mm"),
            "it turns left",
        ),
        (
            bit(
                "Chamfer",
                Diameter="12.33 mm",
                TipDiameter="5 mm",
                CuttingEdgeHeight="6.35 mm",
                CuttingEdgeAngle="45 °",
            ),
            "CuttingEdgeAngle says 45 degrees, and diameter 12.33, tip 5 and height 6.35 mm make 60.0",
        ),
        (
            bit("Bullnose", Diameter="6 mm", CuttingEdgeHeight="9 mm", FlatRadius="1 mm"),
            "FlatRadius 1 mm may be the corner's or the flat's",
        ),
        ({"version": 3, "shape": "endmill.fcstd"}, "is of version 3, and 2 is the newest known"),
    ],
)
def test_a_bit_that_cannot_be_used_is_left_out_by_name(tmp_path, content, reason):
    path = freecad(tmp_path, content, bit("Endmill", Diameter="6 mm", CuttingEdgeHeight="9 mm"))
    library = load_library(path)
    assert [tool.number for tool in library] == [2]
    assert reason in library.told[0]
    assert " is left out: " in library.told[0]


def test_a_bit_outside_of_its_folders_is_not_read(tmp_path):
    path = freecad(tmp_path, bit("Endmill", Diameter="6 mm", CuttingEdgeHeight="9 mm"))
    path.write_text(json.dumps({"version": 1, "tools": [{"nr": 1, "path": "../Bit/bit1.fctb"}]}))
    with pytest.raises(DesignError, match=r"'../Bit/bit1' \(T1\) is left out: its \.fctb is"):
        load_library(path)


TABLE = """;units={units}
; made by hand
T1 P0 D+{wide} Z{high} ;mill-6 end-mill flutes=3 flute_length={long} bought in May
P0 T2 D{wide}
T3 P0 Z0 ;drill flute_length=20 drill
T4 P4 D3 ;x end-mill flute_length=9 colour=red
"""


@pytest.mark.parametrize(("units", "wide", "long"), [("mm", 6.35, 25.4), ("in", 0.25, 1)])
def test_a_linuxcnc_table_says_in_its_remarks_what_tools_are(tmp_path, units, wide, long):
    path = tmp_path / "tool.tbl"
    path.write_text(TABLE.format(units=units, wide=wide, long=long, high=10 * long))
    library = load_library(path)
    (tool,) = library
    assert (tool.name, tool.number, tool.kind, tool.flutes) == ("mill-6", 1, ToolKind.END_MILL, 3)
    assert (tool.diameter, tool.flute_length) == (pytest.approx(6.35), pytest.approx(25.4))
    assert tool.length == pytest.approx(254)
    two, three, four = library.told
    assert "(T2) is left out: the table does not say its kind; write behind its semicolon" in two
    assert "(T3) is left out: has no diameter (D)" in three
    assert "unknown key 'colour'" in four


def zipped(**members):
    def write(path):
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, content in members.items():
                archive.writestr(f"{name}.json", content)

    return write


def text(content):
    return lambda path: path.write_text(content)


FILES = {
    "broken JSON": ("a.json", text("{"), "is no valid JSON: "),
    "deep JSON": ("a.json", text("[" * 100_000), "nested too deep"),
    "no numbers": ("a.json", text('{"data": [NaN]}'), "NaN is no number"),
    "another JSON": ("a.json", text("{}"), "it has no list 'data'"),
    "no object": ("a.json", text("[]"), "it holds no JSON object"),
    "empty": ("a.json", text('{"data": []}'), "holds no tool"),
    "newer": ("a.json", text('{"data": [], "version": 99}'), "is of version 99, and 36 is the newest known"),
    "strange version": ("a.json", text('{"data": [], "version": "x"}'), "version 'x' is no number"),
    "broken ZIP": ("a.tools", text("PK and no more"), "is no ZIP that can be read"),
    "another ZIP": ("a.tools", zipped(other="{}"), r"is a ZIP without tools\.json"),
    "a bomb": ("a.tools", zipped(tools="[" + " " * 21_000_000), "in it is larger than 20,000,000 bytes"),
    "no list": ("a.fctl", text("{}"), "it has no list 'tools'"),
    "newer list": ("a.fctl", text('{"tools": [], "version": 2}'), "is of version 2, and 1 is the newest"),
    "a bit alone": ("a.fctb", text("{}"), "is a single FreeCAD bit"),
    "old HSMWorks": ("a.hsmlib", text("<a/>"), "export it from Fusion"),
    "no units": ("a.tbl", text("T1 P1 D6\n"), "does not say its units"),
    "no table": ("a.tbl", text(";units=mm\nhello\n"), "line 2: 'hello' is no tool"),
}


@pytest.mark.parametrize("case", FILES)
def test_a_file_that_is_no_library_is_one_line(tmp_path, case):
    name, write, message = FILES[case]
    write(tmp_path / name)
    with pytest.raises(DesignError, match=message) as caught:
        load_library(tmp_path / name)
    assert str(caught.value).startswith(f"{tmp_path / name}: ")
    assert "\n" not in str(caught.value)


def test_two_tools_of_one_number_are_refused_by_name(tmp_path):
    path = fusion(tmp_path / "a.json", fusion_tool(1), fusion_tool(1) | {"description": "other"})
    with pytest.raises(DesignError, match="'6-mm-fraser-1' and 'other' both have number 1") as caught:
        load_library(path)
    assert str(caught.value).startswith(f"{path}: ")


def test_tools_of_one_name_are_told_apart_by_number(tmp_path):
    rows = [fusion_tool(number) | {"description": "x" * 60} for number in (1, 22)]
    assert [tool.name for tool in load_library(fusion(tmp_path / "a.json", *rows))] == [
        "x" * 40,
        "x" * 36 + "-t22",
    ]


def test_a_library_of_ours_may_stand_alone(tmp_path):
    path = tmp_path / "own.toml"
    row = "[[tool]]\nname = 'a'\nnumber = 1\nkind = 'drill'\ndiameter = 3\nflute_length = 30\n"
    path.write_text("built_in = false\n" + row)
    assert [tool.name for tool in load_library(path)] == ["a"]
    path.write_text("built_in = 3\n" + row)
    with pytest.raises(DesignError, match="built_in: is 3; write true or false"):
        load_library(path)


def test_names_are_made_of_any_text():
    assert slug("  Ø6 / 2-Flute ") == "6-2-flute"
    assert slug("***") == ""
    assert ToolRecord("a").called == "'a'"


STRANGE = st.sampled_from(
    [None, True, -1, 0, 2.5, 1e300, 10**400, "", "6", "x\ny", "\ud800", "é" * 500, [], [1], {}, {"unit": []}]
)


@settings(max_examples=150)
@given(places=st.lists(st.integers(0, 200), min_size=1, max_size=3), values=st.lists(STRANGE, min_size=3))
def test_whatever_stands_in_a_file_is_taken_over_or_told_in_one_line(tmp_path_factory, places, values):
    folder = tmp_path_factory.mktemp("strange")
    cone = bit("Chamfer", {"Chipload": "1 mm"}, Diameter="6 mm", CuttingEdgeHeight="3 mm", Flutes="3")
    rows = [fusion_tool(1, type="chamfer mill", geometry={"TA": 45}), fusion_tool(2)]
    for content in (rows[0], cone):
        for place, value in zip(places, values, strict=False):
            _replace(content, place, value)
    for path in (fusion(folder / "a.json", *rows), freecad(folder, cone, cone)):
        try:
            library = load_library(path)
        except DesignError as error:
            lines = str(error).splitlines()
            assert all(line.startswith(f"{path}: ") for line in lines)
            continue
        assert all("\n" not in line for line in library.told)
        assert len(library.tools) >= 1


def _replace(content, place, value):
    """Put a value in the place of one that lies somewhere in nested tables and lists."""
    found = []

    def seek(within):
        items = within.items() if isinstance(within, dict) else enumerate(within)
        for key, inner in list(items):
            found.append((within, key))
            if isinstance(inner, (dict, list)):
                seek(inner)

    seek(content)
    within, key = found[place % len(found)]
    within[key] = value


def test_what_is_the_same_of_many_tools_is_one_line(tmp_path):
    rows = [fusion_tool(number, **{"start-values": {"presets": [preset("Default")]}}) for number in (1, 2, 3)]
    (line,) = load_library(fusion(tmp_path / "a.json", *rows)).told
    assert all(f"(T{number})" in line for number in (1, 2, 3))
    assert line.endswith("into its name")


def test_each_kind_of_tool_is_given_to_fusion_with_its_own_geometry(tmp_path):
    tools = [tool for tool in load_library() if tool.kind in {*MILLS, *DRILLS, ToolKind.CHAMFER}]
    (text,) = FusionLibrary().files(tools, tmp_path / "crib.json").values()
    kinds = set()
    for tool, row in zip(tools, json.loads(text)["data"], strict=True):
        own = {key: row["geometry"].get(key) for key in ("RE", "SIG", "TA")}
        told = {
            "RE": tool.nose if tool.kind in MILLS else None,
            "SIG": tool.point_angle if tool.kind in DRILLS else None,
            "TA": tool.point_angle / 2 if tool.kind is ToolKind.CHAMFER else None,
        }
        assert own == told, tool.name
        kinds |= {key for key, value in own.items() if value is not None}
    assert kinds == {"RE", "SIG", "TA"}
