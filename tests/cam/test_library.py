import os
import re

import pytest

from mechwright.contracts.threads import COARSE
from mechwright.errors import DesignError, OutputError, ToolError
from mechwright.standards.screws import screw_size
from mechwright_cam.operations.ream import allowance
from mechwright_cam.shop.library import built_in, load_library
from mechwright_cam.shop.tool import ToolKind

TOOL = """
[[tool]]
name = "{name}"
number = {number}
kind = "end-mill"
diameter = {diameter}
flute_length = 12
[tool.cutting.steel]
cutting_speed = 80
chip_load = 0.01
"""


def file(tmp_path, text):
    path = tmp_path / "tools.toml"
    path.write_text(text)
    return path


def test_built_in_tools_know_every_material_and_have_sensible_data():
    library = built_in()
    assert {tool.kind for tool in library} == set(ToolKind)
    for tool in library:
        polished, metals = {"aluminium", "pom", "polycarbonate"}, {"brass", "steel"}
        some = tool.name.startswith(("alu", "single"))
        assert set(tool.cutting) == (polished if some else polished | metals), tool.name
        for data in tool.cutting.values():
            assert 0.001 < data.chip_load / tool.diameter < 0.06, tool.name
            assert (8 if tool.kind in {ToolKind.REAMER, ToolKind.TAP} else 20) <= data.cutting_speed <= 300
    # Harder materials are cut more slowly.
    mill = library.get("mill-6").cutting
    assert mill["steel"].cutting_speed < mill["brass"].cutting_speed < mill["aluminium"].cutting_speed


DRILL_FEED = {3.2: (0.025, 0.075), 6.4: (0.05, 0.15), 12.7: (0.10, 0.25)}
"""Least and most feed of drills in wrought aluminium up to a diameter, mm a turn (build-it.md, j)."""
REAMED = {"aluminium": (20, 30, 0.1, 0.3), "steel": (8, 12, 0.07, 0.2), "brass": (15, 25, 0.1, 0.3)}
"""Least and most speed of reamers, m/min, and feed, mm a turn."""


def test_the_crib_has_the_drills_taps_and_reamers_of_plates():
    """For threads M3 to M10, their clearance holes of ISO 273, and holes H7 (DIN 338, 212, 371)."""
    by_name = {tool.name: tool for tool in built_in()}
    cores = {3: 2.5, 4: 3.3, 5: 4.2, 6: 5, 8: 6.8, 10: 8.5}
    for size, core in cores.items():
        tap = by_name[f"tap-m{size}"]
        assert (tap.diameter, tap.pitch) == (size, COARSE[size])
        assert by_name[f"drill-{core:g}"].diameter == pytest.approx(size - tap.pitch, abs=0.06)
        for data in tap.cutting.values():
            assert data.chip_load * tap.flutes == pytest.approx(tap.pitch)
    for size in (3, 4, 5, 6, 8):
        assert f"drill-{screw_size(size).clearance():g}" in by_name
    for size in (3, 4, 5, 6, 8, 10, 12):
        reamer, drill = by_name[f"reamer-{size}"], by_name[f"drill-{size - 0.2:g}"]
        least, most = allowance(size)
        assert least - 1e-9 <= reamer.diameter - drill.diameter <= most + 1e-9
        for material, (slow, fast, low, high) in REAMED.items():
            data = reamer.cutting[material]
            assert slow <= data.cutting_speed <= fast
            assert low - 1e-3 <= data.chip_load * reamer.flutes <= high + 1e-3


def test_drills_are_fed_as_handbooks_have_it():
    for tool in built_in():
        if tool.kind is not ToolKind.DRILL or tool.diameter < 1.6:
            continue
        low, high = next(range_ for most, range_ in DRILL_FEED.items() if tool.diameter <= most)
        feed = 2 * tool.cutting["aluminium"].chip_load
        assert 0.9 * low * min(1, tool.diameter / 3) <= feed <= high, tool.name
        assert 60 <= tool.cutting["aluminium"].cutting_speed <= 90
        assert 24 <= tool.cutting["steel"].cutting_speed <= 30


def test_mills_for_soft_material_have_room_for_its_chips():
    flutes = {t.name: t.flutes for t in built_in() if t.name.startswith(("alu", "single"))}
    assert set(flutes.values()) == {1, 2, 3}


def test_ten_millimetre_plates_can_be_cut_with_small_mills():
    reach = {t.diameter: t.flute_length for t in built_in() if t.kind is ToolKind.END_MILL}
    assert reach[2.0] > 10.3
    assert reach[1.6] > 10.3
    assert reach[1.0] < 10


def test_own_library_extends_and_overrides(tmp_path):
    library = load_library(
        file(
            tmp_path,
            TOOL.format(name="mill-6", number=24, diameter='"0.25 in"')
            + TOOL.format(name="mine", number=500, diameter=7),
        )
    )
    assert library.get("mill-6").diameter == pytest.approx(6.35)
    assert library.get("mine").number == 500
    assert library.get("mill-10") == built_in().get("mill-10")
    assert built_in().get("mill-6").diameter == 6


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "holds no tool"),
        ("tool = 3", "holds no tool"),
        (
            "[[tool]]\nname = 'a'\nkind = 'drill'\ndiameter = 3\nflute_length = 9",
            r"tool 'a'\.number: is missing",
        ),
        ("[[drill]]\n", "unknown key 'drill'"),
        ("[[tool]\n", "is no valid TOML"),
        (TOOL.format(name="a", number=1, diameter=-3), r"tool 'a'\.diameter: -3 .*greater than 0"),
        (TOOL.format(name="a", number=1, diameter='"3 kg"'), r"tool 'a'\.diameter: .*'3 kg'"),
        (
            TOOL.format(name="a", number=1, diameter=3).replace(".steel", ".cheese"),
            r"tool 'a'\.cutting: no such material as 'cheese'",
        ),
        (TOOL.format(name="a", number=1, diameter=3) + "colour = 1", "colour"),
        (
            TOOL.format(name="a", number=900, diameter=3) + TOOL.format(name="b", number=900, diameter=3),
            "'a' and 'b' both have number 900",
        ),
        (
            TOOL.format(name="a", number=900, diameter=3) + TOOL.format(name="a", number=901, diameter=3),
            "two tools are called 'a'",
        ),
        (
            TOOL.format(name="a", number=24, diameter=3),
            "tools.toml: tools 'mill-6' and 'a' both have number 24",
        ),
    ],
)
def test_a_wrong_library_is_one_clear_line(tmp_path, text, message):
    path = file(tmp_path, text)
    with pytest.raises(DesignError, match=message) as caught:
        load_library(path)
    assert "\n" not in str(caught.value)


def test_every_wrong_key_of_a_tool_is_a_line(tmp_path):
    text = TOOL.format(name="a", number=1, diameter=0).replace("chip_load", "chipload")
    with pytest.raises(DesignError) as caught:
        load_library(file(tmp_path, text))
    lines = str(caught.value).splitlines()
    assert len(lines) == 3
    assert any(
        "tool 'a'.cutting.steel: unknown key 'chipload'; did you mean 'chip_load'?" in s for s in lines
    )
    assert any("tool 'a'.diameter: 0 should be greater than 0" in s for s in lines)
    assert all(s.startswith(f"{tmp_path}/tools.toml: ") for s in lines)


def test_a_library_is_read_with_the_limits_of_every_toml_file(tmp_path):
    path = file(tmp_path, "\ufeff" + TOOL.format(name="a", number=900, diameter=3))
    assert load_library(path).get("a").number == 900
    path.write_text("x = " + "[" * 50_000)
    with pytest.raises(DesignError, match="nested too deep"):
        load_library(path)
    path.write_bytes(b"#" * 1_000_001)
    with pytest.raises(DesignError, match="larger than"):
        load_library(path)
    path.write_bytes(b"\xff")
    with pytest.raises(DesignError, match="no UTF-8"):
        load_library(path)


def test_a_pipe_as_library_is_refused_and_not_waited_for(tmp_path):
    os.mkfifo(tmp_path / "tools.toml")
    with pytest.raises(OutputError, match="it is a pipe"):
        load_library(tmp_path / "tools.toml")


def test_a_missing_library_names_its_path(tmp_path):
    with pytest.raises(OutputError, match=re.escape(str(tmp_path / "none.toml"))):
        load_library(tmp_path / "none.toml")


def test_an_unknown_tool_lists_close_matches():
    with pytest.raises(ToolError, match=r"did you mean .*mill-16"):
        built_in().get("mil-16")
