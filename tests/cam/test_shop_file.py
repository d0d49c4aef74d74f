"""Shop files: what they lend to a design, what they replace, and mistakes in them."""

import json
import re

import pytest
from by_control import LINUXCNC, asked
from shop import DRILL, MILL, SPOT, plate_job, plate_program

from mechwright.designs.design import load
from mechwright.errors import DesignError
from mechwright.pipeline import Build, Wanted
from mechwright.plugins.host import host
from mechwright_cam.machining import Machining
from mechwright_cam.planning.prepare import library_of, worn
from mechwright_cam.shop.shop_table import shop_of
from mechwright_cam.shop.workshop_file import VARIABLE, read_shop

SHOP = """
format = 1
name = "cellar"
control = "grbl"
machine = "bench-mill"
screws = ["M4"]
pins = [4, 8]

[[stock]]
material = "aluminium"
thickness = [8, 12]

[holder.ER16]
diameter = 28

[prefer.cam]
clearance = 7
post.cycles = false

[[tool]]
name = "mine-6"
number = 1
kind = "end-mill"
diameter = 6
flute_length = 20
holder = "ER16"
purpose = "everything"
length = 80
wear_length = -0.02
wear_diameter = -0.04
[tool.cutting]
aluminium = { cutting_speed = 150, chip_load = 0.03 }
"""
DESIGN = 'format = 1\nfamily = "elliptic-gears"\nshop = "shop.toml"\n[parameters]\n[cam]\nclearance = 9\n'


@pytest.fixture
def made(tmp_path):
    def make(shop=SHOP, design=DESIGN):
        (tmp_path / "shop.toml").write_text(shop)
        path = tmp_path / "gear.toml"
        path.write_text(design)
        return load(path, host())

    return make


def test_a_shop_lends_what_the_design_leaves_out_and_replaces_the_crib(made):
    design = made()
    cam = design.tables["cam"].cam
    assert (cam.control, cam.machine.name, cam.clearance, cam.post.cycles) == (
        "grbl",
        "bench mill, tools changed by hand",
        9.0,
        False,
    )
    assert cam.second_side.dowel_diameter == 4.0  # of the pins that are kept the one next to the usual 6
    (tool,) = library_of(design).tools
    assert (tool.name, tool.holder, tool.holder_diameter, tool.purpose) == (
        "mine-6",
        "ER16",
        28,
        "everything",
    )
    assert tool.worn_length == pytest.approx(79.98)
    assert shop_of(design).thicknesses("aluminium") == [8.0, 12.0]


def test_the_machine_table_takes_plates_in_hand_and_stays_away_if_it_is_not_there(made):
    assert made().tables["machine"].plates == ()
    design = made(design=DESIGN + '[machine]\nframe = "plates"\n')
    assert design.tables["machine"].plates == (8.0, 12.0)
    kept = design.changed({"machine.frame": "none"})
    assert kept.tables["machine"].plates == (8.0, 12.0)


def test_a_design_keeps_what_it_says_and_a_change_keeps_what_is_lent(made):
    design = made(design=DESIGN + 'control = "haas"\nmachine = "haas-vf-2"\n')
    assert design.tables["cam"].cam.control == "haas"
    assert design.tables["cam"].cam.machine.name == "Haas VF-2"
    changed = made().changed({"cam.clearance": None})
    assert (changed.tables["cam"].cam.clearance, changed.tables["cam"].cam.control) == (7.0, "grbl")
    gone = made().changed({"shop": ""})
    assert gone.tables["shop"] is None
    assert gone.tables["cam"].cam.control == "linuxcnc"


def test_the_environment_names_a_shop_unless_the_design_does(made, tmp_path, monkeypatch):
    (tmp_path / "other.toml").write_text(SHOP.replace("cellar", "attic"))
    monkeypatch.setenv(VARIABLE, str(tmp_path / "other.toml"))
    assert shop_of(made()).workshop.name == "cellar"
    design = made(design=DESIGN.replace('shop = "shop.toml"\n', ""))
    assert shop_of(design).workshop.name == "attic"
    assert design.readers[0].name == "shop" or "other.toml" in {
        name for reader in design.readers for name in reader.inputs(design.tables[reader.name], design.path)
    }
    assert "shop = " not in design.text
    assert shop_of(made(design=DESIGN.replace("shop.toml", ""))) is None


def test_the_text_of_a_design_names_its_shop(made, tmp_path):
    text = made().text
    assert 'shop = "shop.toml"\n' in text.partition("[")[0]
    (tmp_path / "again.toml").write_text(text)
    again = load(tmp_path / "again.toml", host())
    assert again.tables["cam"].cam == made().tables["cam"].cam


def test_plates_that_are_not_in_hand_are_named_with_the_nearest_and_a_remedy(made, command_line, tmp_path):
    made(design=DESIGN.replace("clearance = 9", 'tools = ["mine-6"]'))
    code, out, _ = command_line("check", tmp_path / "gear.toml", "--json")
    found = json.loads(out)["findings"]
    (stock,) = [one for one in found if one["code"] == "shop.stock"]
    assert "takes a plate of aluminium 10 mm thick; in hand are 8 and 12 mm" in stock["message"]
    assert stock["parameter"] == "thickness"
    assert stock["remedy"].startswith("make it 8 mm, or add 10 to the thicknesses of aluminium in shop.toml")
    assert code in {0, 1}
    assert any(one["code"] == "shop.used" and "cellar" in one["message"] for one in found)


def test_blanks_in_hand_are_the_stock_of_a_job(made):
    blanks = SHOP.replace("thickness = [8, 12]", "thickness = [10]\nlength = 150\nwidth = 200")
    with Build(made(blanks), host(), Wanted("cam")) as build:
        job = build.made(Machining).jobs[0]
        x0, y0, x1, y1 = job.stock
        assert (x1 - x0, y1 - y0) == pytest.approx((200.0, 150.0))
    small = blanks.replace("200", "20")
    with Build(made(small), host(), Wanted("cam")) as build:
        found = [one for one in build.made(Machining).findings if one.code == "shop.stock"]
    assert "the largest blank in hand is" in found[0].message


def test_a_tool_that_any_part_uses_is_not_unused(tmp_path):
    path = tmp_path / "crank.toml"
    tools = '["spot-6", "drill-10", "drill-2", "mill-6", "mill-3", "mill-2", "mill-1.2"]'
    path.write_text(f'format = 1\nfamily = "slider-crank"\n[cam]\ntools = {tools}\n')
    design = load(path, host())
    with Build(design, host(), Wanted("check")) as build:
        machining = build.made(Machining)
        unused = [one.message for one in machining.findings if one.code == "cam.tool-unused"]
        used = {
            tool.name
            for job in machining.jobs
            for task in machining.assignments.of(job).every()
            for tool in task.tools
        }
    assert used
    assert not [name for name in used for message in unused if message.startswith(f"{name} ")]
    assert len(unused) == len({message.split()[0] for message in unused})


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("format = 1", "format = 2", "format: 2 is not known; this program reads format 1"),
        ("format = 1", "format = true", "format: True is not known"),
        ("diameter = 6\n", "", "tool 'mine-6'.diameter: is missing"),
        ("ER16]\n", "ER20]\n", "tool 'mine-6': no holder 'ER16'; add a table [holder.ER16] (known: ER20)"),
        ('name = "cellar"', "nam = 1", "unknown key 'nam'; did you mean 'name'?"),
        ("clearance = 7", "clearanc = 7", "prefer.cam: unknown key 'clearanc'; did you mean 'clearance'?"),
        ("clearance = 7", "machine = 'x'", "prefer.cam.machine: has no place there"),
        ('"bench-mill"', '"bench-mil"', "unknown machine 'bench-mil'; did you mean 'bench-mill'?"),
        ('screws = ["M4"]', 'screws = ["4"]', "screws.0: '4' should be a metric thread"),
        ("[holder.ER16]", 'units = "cm"\n[holder.ER16]', "units"),
        ("thickness = [8, 12]", "thickness = 8", "stock.0.thickness: 8 should be a list in square brackets"),
    ],
)
def test_mistakes_are_told_in_one_line(tmp_path, old, new, said):
    path = tmp_path / "shop.toml"
    assert old in SHOP
    path.write_text(SHOP.replace(old, new))
    with pytest.raises(DesignError) as caught:
        read_shop(path)
    assert said in str(caught.value)
    assert str(path) in str(caught.value)
    assert len(str(caught.value).splitlines()) == 1


def test_two_tools_of_one_number_and_no_tools_at_all(tmp_path):
    path = tmp_path / "shop.toml"
    again = SHOP[SHOP.index("[[tool]]") :].replace("mine-6", "mine-7")
    path.write_text(SHOP + again)
    with pytest.raises(DesignError, match="'mine-6' and 'mine-7' both have number 1"):
        read_shop(path)
    path.write_text(SHOP[: SHOP.index("[[tool]]")])
    with pytest.raises(DesignError, match=r"holds no tool; add a \[\[tool\]\] table, or name a library"):
        read_shop(path)


def test_a_library_of_another_program_is_a_crib_and_its_file_is_an_input(made, tmp_path):
    (tmp_path / "tool.tbl").write_text(";units=in\nT5 P5 Z3 D0.25 ;quarter end-mill flute_length=0.75\n")
    shop = SHOP[: SHOP.index("[[tool]]")].replace('name = "cellar"', 'name = "cellar"\ncrib = "tool.tbl"')
    design = made(shop.replace("[holder.ER16]\ndiameter = 28\n", ""))
    (tool,) = library_of(design).tools
    assert (tool.diameter, tool.length, tool.number) == (6.35, 76.2, 5)
    reader = next(reader for reader in design.readers if reader.name == "shop")
    assert set(reader.inputs(design.tables["shop"], design.path)) == {"shop.toml", "tool.tbl"}
    value, files = reader.carried(design.tables["shop"], design.path)
    assert set(files) == {"shop.toml", "tool.tbl"}
    assert reader.head(value) == ['shop = "shop.toml"']


def test_the_command_writes_a_file_that_is_read(tmp_path, command_line):
    for units in ("mm", "inch"):
        path = tmp_path / f"{units}.toml"
        code, out, _ = command_line("shop", "-o", path, "--units", units)
        assert code == 0
        assert "tools; take out what you do not have" in out
        shop = read_shop(path)
        assert shop.workshop.units == units
        mill = shop.library.get("mill-6")
        assert (mill.diameter, mill.cutting["aluminium"].chip_load) == (6.0, 0.05)
        assert mill.holder == "ER20"
        assert mill.holder_diameter == pytest.approx(40, abs=0.01)
    assert read_shop(tmp_path / "inch.toml").thicknesses("aluminium")[1] == 6.35
    assert command_line("shop", "-o", path)[0] == 2
    assert "--units: 'cm' is not known" in command_line("shop", "--units", "cm")[2]
    code, out, _ = command_line("schema", "shop")
    schema = json.loads(out)
    assert code == 0
    assert {"tool", "stock", "prefer", "units"} <= schema["properties"].keys()
    assert not re.search(r'"(ge|gt|le|lt)":', out)


@pytest.mark.parametrize(
    ("wear", "way", "severities"),
    [
        (-0.04, "wear", []),
        (-0.04, "computer", ["warning"]),
        (-0.01, "computer", []),
        (-0.3, "wear", ["error"]),
        (0.3, "control", ["error"]),
        (-0.3, "computer", ["warning"]),
    ],
)
def test_wear_goes_to_d_within_its_limit(wear, way, severities):
    mill = MILL.model_copy(update={"wear_diameter": wear})
    found = list(worn([plate_job(tools=(SPOT, DRILL, mill), compensation=way)]))
    assert [str(one.severity) for one in found] == severities


@pytest.mark.parametrize(
    ("number", "wear", "says"),
    [
        (3, -0.03, "T3 (mill-6) is worn by -0.015 mm as a radius and comes to walls without"),
        (3, 0.012, "they lose as much, 0.005 mm at most"),
        (3, -0.02, ""),
        (3, 0.01, ""),
        (1, -0.5, ""),  # a spot drill comes to no wall
    ],
)
def test_a_program_of_a_tool_that_is_known_to_be_worn_is_not_proven(number, wear, says):
    tools = tuple(
        tool.model_copy(update={"wear_diameter": wear} if tool.number == number else {})
        for tool in (SPOT, DRILL, MILL)
    )
    found = asked("diameter-offset", LINUXCNC.write(plate_program()), plate_job(tools=tools))
    assert found.passed == (not says)
    assert says in found.message
    assert found.passed or found.value == pytest.approx(abs(wear) / 2)
