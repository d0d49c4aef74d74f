"""``mechwright tools``: the list, what tools do in a design, and libraries that are written and read again."""

import hashlib
import json
import math

import pytest
from cribs import bit, freecad, fusion, fusion_tool, preset
from hypothesis import given, settings
from hypothesis import strategies as st
from rs274 import needs_rs274, run_rs274

from mechwright.contracts.materials import GROUPS
from mechwright.designs.design import load
from mechwright.errors import DesignError, OutputError
from mechwright.pipeline import Build, Wanted
from mechwright.plugins.host import host
from mechwright.scripting.provenance import facts
from mechwright_cam.commands import tool_files
from mechwright_cam.commands.tools_table import WIDTH, doing, listing, unneeded_lines
from mechwright_cam.machining import Machining
from mechwright_cam.planning import plan
from mechwright_cam.planning.uses import Use, uses
from mechwright_cam.shop.exporting import export, lost
from mechwright_cam.shop.library import built_in, load_library
from mechwright_cam.shop.table import CamTable
from mechwright_cam.shop.tool import CuttingData, Tool, ToolKind

OURS = {"holder", "purpose", "wear_length", "wear_diameter"}
"""Keys that no other program has a field for."""
NO_BIT = {ToolKind.SPOT_DRILL, ToolKind.REAMER}
"""Kinds that FreeCAD's bits are not written for."""
OF_TAPS = {"chamfer_length", "floating"}
"""What only our own libraries say of taps."""
LACKS = {
    "crib.toml": set(),
    "crib.tbl": {"cutting", "coating", "life", "holder"},  # the last keys of a line that is too long
    "crib.json": {*OURS, *OF_TAPS, "centre_cutting", "coating", "length", "life", "ramp_angle"},
    "crib.tools": {*OURS, *OF_TAPS, "centre_cutting", "coating", "length", "life", "ramp_angle"},
    "Library/crib.fctl": {
        *OURS,
        *OF_TAPS,
        "centre_cutting",
        "coating",
        "cutting",
        "diameter_offset",
        "flute_length",
        "holder_diameter",
        "length",
        "life",
        "ramp_angle",
        "stick_out",
        "tool",
    },
}
"""What each format has no place for, as docs/machining/cutters.md says; ``tool`` is a whole tool."""
sizes = st.floats(0.5, 20).map(lambda value: round(value, 4))


@st.composite
def some_tool(draw, number):
    """A tool of any kind and any sizes that fit each other."""
    kind = draw(st.sampled_from(ToolKind))
    wide, long = draw(sizes), draw(sizes)
    said = {
        "name": f"tool-{number}",
        "number": number,
        "kind": kind,
        "diameter": wide,
        "flute_length": long,
        "flutes": draw(st.integers(1, 12)),
        "substrate": draw(st.sampled_from(["hss", "carbide"])),
        "holder_diameter": draw(st.floats(1, 200)),
    }
    share = st.floats(0.1, 0.5)
    if kind is ToolKind.BULL_NOSE:
        said["corner_radius"] = wide * draw(share)
    elif kind is ToolKind.CHAMFER:
        said |= {"tip_diameter": wide * draw(share), "point_angle": draw(st.floats(31, 170))}
    elif kind is ToolKind.THREAD_MILL and draw(st.booleans()):
        said["neck_diameter"] = wide * draw(share)
    elif kind is ToolKind.TAP:
        said |= {
            "pitch": min(wide, long) * draw(st.floats(0.05, 0.2)),
            "left_hand": draw(st.booleans()),
            "floating": draw(st.booleans()),
            "chamfer_length": draw(st.floats(1, 4)),
        }
    elif kind in {ToolKind.DRILL, ToolKind.SPOT_DRILL}:
        said["point_angle"] = draw(st.floats(31, 180))
    optional = {
        "stick_out": st.just(long + draw(sizes)),
        "shank_diameter": sizes,
        "ramp_angle": st.floats(1, 90),
        "life": st.floats(1, 1000),
        "length": st.floats(1, 300),
        "diameter_offset": st.just(number + 100),
        "coating": st.text("TiAlN ä\"\\'", max_size=20),
        "holder": st.text("ER 16=;", max_size=8),
        "wear_length": st.floats(-1, 1),
        "wear_diameter": st.floats(-1, 1),
    }
    if kind is ToolKind.TAP:  # with all of them its line of a table is too long
        for key in ("ramp_angle", "life", "holder", "wear_length", "wear_diameter"):
            del optional[key]
    said |= {key: draw(value) for key, value in optional.items() if draw(st.booleans())}
    lead = said["pitch"] / said["flutes"] if kind is ToolKind.TAP else None
    data = st.builds(
        CuttingData,
        cutting_speed=st.floats(1, 1000),
        chip_load=st.floats(0.001, 1) if lead is None else st.just(lead),
        step_down=st.floats(0.1, 3),
        step_over=st.floats(0.1, 1),
        plunge=st.floats(0.1, 1) if kind not in {ToolKind.DRILL, ToolKind.SPOT_DRILL} else st.just(0.3),
    )
    said["cutting"] = draw(st.dictionaries(st.sampled_from(sorted(GROUPS)), data, max_size=2))
    return Tool.model_validate(said)


@pytest.mark.parametrize("name", LACKS)
@settings(max_examples=25)
@given(data=st.data())
def test_what_is_written_and_read_again_is_the_same_but_for_what_the_format_lacks(
    tmp_path_factory, name, data
):
    tools = [data.draw(some_tool(number)) for number in (3, 7)]
    path = tmp_path_factory.mktemp("crib") / name
    path.parent.mkdir(exist_ok=True)
    if "fctl" in name and all(tool.kind in NO_BIT for tool in tools):
        with pytest.raises(DesignError, match="holds no tool"):
            export(tools, path)
        return
    _, told = export(tools, path)
    keys = {line.removeprefix("holds no ").partition(" of ")[0] for line in told}
    assert keys <= LACKS[name]
    back = {tool.number: tool for tool in load_library(path)}
    for tool in tools:
        if tool.kind not in NO_BIT or "fctl" not in name:
            assert back[tool.number].name == tool.name
        if "cutting" not in LACKS[name]:
            assert back[tool.number].cutting.keys() == tool.cutting.keys()


def test_the_built_in_library_goes_through_every_format(tmp_path):
    (tmp_path / "Library").mkdir()
    tools = built_in().tools
    told = {name: export(tools, tmp_path / name)[1] for name in LACKS}
    assert told["crib.toml"] == []
    meant, taps = (
        [tool for tool in tools if test(tool)] for test in (lambda t: t.purpose, lambda t: t.pitch)
    )
    assert (
        told["crib.json"]
        == told["crib.tools"]
        == [
            "holds no centre_cutting of engrave-3",
            f"holds no purpose of drill-2.8, drill-3.4, drill-3.8 and {len(meant) - 3} more",
            f"holds no chamfer_length of tap-m3, tap-m4, tap-m5 and {len(taps) - 3} more",
        ]
    )
    assert told["crib.tbl"] == [f"holds no cutting of spot-6, drill-2, drill-2.5 and {len(tools) - 3} more"]
    assert told["Library/crib.fctl"][0] == "holds no tool of spot-6"
    assert (tmp_path / "Bit" / "mill-6.fctb").exists()


def test_a_missing_tool_and_another_size_are_told():
    one, two = built_in().tools[:2]
    wider = one.model_copy(update={"diameter": one.diameter + 1e-4})
    assert lost([one, two], [wider]) == [f"holds no diameter of {one.name}", f"holds no tool of {two.name}"]
    assert lost([one], [one]) == []


def test_what_cannot_be_written_is_refused(tmp_path):
    tools = built_in().tools
    with pytest.raises(DesignError, match=r"of no known format; end its name in one of: \.toml, \.tbl"):
        export(tools, tmp_path / "a.txt")
    with pytest.raises(DesignError, match=r"export to Library/a\.fctl"):
        export(tools, tmp_path / "a.fctl")
    (tmp_path / "a.json").write_text("mine")
    with pytest.raises(OutputError, match="is there already; give another name, or --force"):
        export(tools, tmp_path / "a.json")
    assert (tmp_path / "a.json").read_text() == "mine"
    export(tools, tmp_path / "a.json", replace=True)
    assert len(load_library(tmp_path / "a.json").tools) == len(tools)


@needs_rs274
def test_linuxcnc_reads_the_table(tmp_path):
    tools = built_in().tools
    export(tools, tmp_path / "crib.tbl")
    table = (tmp_path / "crib.tbl").read_text()
    assert max(map(len, table.splitlines())) < 255
    lines = [f"T{tool.number} M6 G43 H{tool.number}\nG0 X{tool.number}" for tool in tools]
    done = run_rs274("\n".join(["G21", *lines, "M2", ""]), tmp_path, table)
    assert done.ok, done.error
    assert len(done.ends) == len(tools)
    assert not run_rs274("T999 M6\nM2\n", tmp_path, table).ok, "a tool that the table lacks"


def test_the_list_fits_80_columns_and_cuts_nothing_off():
    long = built_in().get("mill-6").model_copy(update={"name": "m" * 40, "number": 9999, "cutting": {}})
    lines = listing([*built_in(), long])
    assert max(map(len, lines)) <= WIDTH
    text = "\n".join(lines)
    assert all(f"  {tool.name}" in text for tool in (*built_in(), long))
    assert "no cutting data: T9999" in text
    assert "[cam.cutting.NAME]" in text
    row = next(line for line in lines if line.split()[1:2] == ["engrave-3"])
    assert row.split() == ["41", "engrave-3", "chamfer-mill", "3", "60°/0.2", "1", "3", "-", "40", "carbide"]


def test_many_features_and_spare_tools_are_wrapped():
    mill = built_in().get("mill-6")
    lines = doing("gear", [Use(mill, f"gap-{number}", "recess") for number in range(60)])
    assert max(map(len, lines)) <= WIDTH
    assert "gap-59" in lines[-1]
    spare = unneeded_lines(list(built_in()))
    assert max(map(len, spare)) <= WIDTH
    assert not any(line.endswith(("T21", "T22", "T23")) for line in spare), "T and name stay together"
    assert unneeded_lines([]) == ["not needed: none"]


def test_the_command_lists_and_exports(command_line, tmp_path):
    path = fusion(tmp_path / "mine.tools", fusion_tool(5), fusion_tool(6, type="lollipop mill"))
    code, out, err = command_line("tools", "--library", path, "--export", tmp_path / "mine.tbl")
    assert (code, err) == (0, "")
    assert "6-mm-fraser-5" in out
    assert "note '6 mm \"Fräser\" 6' (T6) is left out: there is no 'lollipop mill'" in out
    assert f"{tmp_path / 'mine.tbl'}: written" in out
    assert "mine.tbl holds no cutting of 6-mm-fraser-5" in out
    said = json.loads(command_line("tools", "--library", tmp_path / "mine.tbl", "--json")[1])
    (tool,) = said["tools"]
    assert math.isclose(tool["holder_diameter"], 38.1)
    assert command_line("tools", "--force")[0] == 2


def test_a_design_says_which_tool_does_what_and_which_are_spare(command_line, tmp_path):
    fine = [preset(name, n=0, v_f=0, f_z=0.02) for name in ("steel", "aluminium")]
    rows = [
        fusion_tool(1, **{"start-values": {"presets": [preset("steel"), preset("aluminium")]}}),
        fusion_tool(2, description="drill 40", type="drill", geometry={"DC": 40, "SIG": 118}),
        fusion_tool(3, geometry={"DC": 4}, **{"start-values": {"presets": fine}}),
    ]
    fusion(tmp_path / "crib.json", *rows)
    code, new, _ = command_line("new", "four-bar")
    assert code == 0
    design = tmp_path / "bar.toml"
    design.write_text(new)
    code, out, err = command_line("tools", design, "--json")
    assert (code, err) == (0, "")
    said = json.loads(out)
    used = {use["tool"] for found in said["uses"].values() for use in found}
    names = {tool["name"] for tool in said["tools"]}
    assert used
    assert used.isdisjoint(said["unneeded"])
    assert used | set(said["unneeded"]) == names == {tool.name for tool in built_in()}
    for found in said["uses"].values():
        assert {"outside"} <= {use["feature"] for use in found}
    code, out, err = command_line("tools", design, "--library", tmp_path / "crib.json")
    assert (code, err) == (0, "")
    assert "T1 6-mm-fraser-1: contour outside" in out
    assert "T3 6-mm-fraser-3: bore bore-1, bore-2" in out
    assert out.splitlines()[-1] == "not needed: T2 drill-40"
    fusion(tmp_path / "crib.json", rows[1])
    code, out, err = command_line("tools", design, "--library", tmp_path / "crib.json")
    assert (code, out) == (1, "")
    assert "cam.tools" in err


def test_what_tools_do_is_what_the_programs_have(tmp_path, command_line):
    design = tmp_path / "bar.toml"
    design.write_text(command_line("new", "four-bar")[1])
    with Build(design, host(), Wanted("tools")) as build:
        machining = build.made(Machining)
        for job in machining.jobs:
            told = {use.tool.name for use in uses(job, machining.assignments.of(job))}
            assert told == {tool.name for tool in plan(job, machining.assignments).tools}


def test_a_design_with_a_packed_library_is_built_and_tells_what_was_left_out(tmp_path, command_line):
    fine = [preset("aluminium", n=0, v_f=0, f_z=0.02)]
    rows = [
        fusion_tool(1),
        fusion_tool(3, geometry={"DC": 4}, **{"start-values": {"presets": fine}}),
        fusion_tool(4, type="face mill"),
    ]
    path = fusion(tmp_path / "crib.tools", *rows)
    design = tmp_path / "bar.toml"
    text = command_line("new", "four-bar")[1]
    assert "\n[cam]\n" in text
    design.write_text(text.replace("\n[cam]\n", '\n[cam]\ntool_library = "crib.tools"\n'))
    code, out, _ = command_line("check", design, "--figures")
    assert code == 0, out
    assert "cam.tool-library" in out
    assert f"mechwright tools {design} lists them" in out
    made = facts(load(design, host()), host())
    assert made["inputs_sha256"]["crib.tools"] == hashlib.sha256(path.read_bytes()).hexdigest()


def test_the_bits_of_a_freecad_library_go_along_with_it(tmp_path):
    path = freecad(tmp_path, bit("Endmill", Diameter="6 mm", CuttingEdgeHeight="9 mm"))
    table = CamTable()
    said = table.read({"tool_library": "Library/crib.fctl"}, tmp_path / "a.toml")
    assert set(table.inputs(said, tmp_path / "a.toml")) == {"Library/crib.fctl", "bit1.fctb"}
    carried, files = table.carried(said, tmp_path / "a.toml")
    assert set(files) == {"crib.fctl", "bit1.fctb"}
    (tmp_path / "out").mkdir()
    for name, file in files.items():
        (tmp_path / "out" / name).write_bytes(file.read_bytes())
    there = load_library(tmp_path / "out" / carried.cam.tool_library)
    assert there.tools == load_library(path).tools


def test_shells_complete_libraries_by_their_ends(tmp_path, monkeypatch):
    for name in ("a.toml", "a.tools", "a.txt"):
        (tmp_path / name).write_text("")
    monkeypatch.chdir(tmp_path)
    assert tool_files("a") == ["a.toml", "a.tools"]
