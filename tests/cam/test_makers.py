"""A machine of each class makes three mechanisms of the sheet in hand: ``benchmarks/bench_makers.py`` tries them all."""

import pytest
from by_night import by_night

from mechwright.designs.text import toml
from mechwright.errors import DesignError
from mechwright_cam.shop.machine import known_machines
from mechwright_cam.shop.workshop_file import read_shop

CLASSES = {"A": "3018-pro", "B": "longmill-mk2-30x30", "C": "shapeoko-hdm", "D": "tormach-440"}
MATERIALS = ("acrylic", "plywood", "aluminium", "mdf", "pom", "hdpe")
DESIGNS = {"geneva": ("--set", "slots=6"), "elliptic-gears": (), "four-bar": ()}
BY_DAY = {("A", "plywood", "four-bar")}


def shop(run, machine: str, material: str) -> None:
    made = run(
        "shop",
        "--machine",
        machine,
        "--mills",
        "3.175,2,1",
        "--sheet",
        f"200x150x6 {material}",
        "-o",
        "shop.toml",
    )
    assert made[0] == 0, made


@pytest.mark.parametrize(
    ("kind", "material", "design"),
    [
        pytest.param(kind, material, design, marks=() if (kind, material, design) in BY_DAY else by_night)
        for kind in CLASSES
        for material in MATERIALS
        for design in DESIGNS
    ],
)
def test_a_machine_of_each_class_makes_it_of_one_sheet(
    command_line, tmp_path, monkeypatch, kind, material, design
) -> None:
    monkeypatch.chdir(tmp_path)
    assert known_machines()[CLASSES[kind]][0]["rigidity"] == kind
    shop(command_line, CLASSES[kind], material)
    code, out, err = command_line("new", design, *DESIGNS[design], "--shop", "shop.toml", "-o", "d.toml")
    assert code == 0, err
    assert "not solved yet" not in out
    assert "cam.nest.turn = true" in out
    code, out, err = command_line("cam", "d.toml", "-o", "out")
    assert code == 0, err
    assert "shop.stock" not in err
    programs = sorted((tmp_path / "out").glob("nest*.nc"))
    assert programs
    if kind in "AB":  # without switches
        assert not any("G53" in one.read_text() for one in programs)
        assert max(len(line) for one in programs for line in one.read_text().splitlines()) < 60


def test_plates_follow_the_thickness_that_was_measured(command_line, tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    shop(command_line, "3018", "plywood")
    text = (tmp_path / "shop.toml").read_text()
    (tmp_path / "shop.toml").write_text(text.replace("# measured = 6", "measured = 5.6"))
    assert read_shop(tmp_path / "shop.toml").thicknesses("plywood") == [5.6]
    code, out, _ = command_line("new", "four-bar", "--fit", "120x80", "--shop", "shop.toml", "-o", "d.toml")
    assert code == 0
    assert "set parameters.thickness = 5.6" in out
    assert "set parameters.ground_thickness = 5.6" in out


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("measured = 3", "measured is 3, and thickness 6: correct the wrong one"),
        ("measured = 5.6\nthickness = [6, 8]", "measured is of plates of one thickness"),
    ],
)
def test_a_measure_that_belongs_to_another_sheet_is_refused(tmp_path, line, said) -> None:
    path = tmp_path / "shop.toml"
    rows = 'material = "plywood"\n' + (line if "thickness" in line else f"thickness = [6]\n{line}")
    path.write_text(
        f"format = 1\n[[stock]]\n{rows}\n[[tool]]\nname = {toml('m')}\nnumber = 1\n"
        'kind = "end-mill"\ndiameter = 3\nflutes = 1\nflute_length = 9\n'
    )
    with pytest.raises(DesignError, match=said):
        read_shop(path)


def test_a_sheet_that_is_smaller_than_any_design_is_refused(command_line, tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    command_line("shop", "--machine", "3018", "--mills", "2", "--sheet", "20x10x6 acrylic", "-o", "shop.toml")
    code, _, err = command_line("new", "geneva", "--shop", "shop.toml", "-o", "d.toml")
    assert code == 2
    assert "--shop: the sheet in hand is too small for any design of geneva; give a larger one" in err


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("slots",), "--set: 'slots' should be KEY=VALUE"),
        (("slot=6",), "did you mean 'slots'"),
        (("slots=99",), "99 should be less than or equal to 12"),
    ],
)
def test_a_setting_of_a_new_design_names_its_option(command_line, words, said) -> None:
    code, _, err = command_line("new", "geneva", "--set", *words)
    assert code == 2
    assert said in err


def test_a_new_design_has_what_was_set(command_line) -> None:
    code, out, _ = command_line("new", "geneva", "--set", "slots=6", "--set", "law=cycloidal")
    assert code == 0
    assert "\nslots = 6 " in out
    assert '\nlaw = "cycloidal" ' in out


def test_editors_take_materials_of_the_shop_but_not_for_what_they_are_like(command_line) -> None:
    out = command_line("schema", "shop")[1]
    assert out.count('"pattern": "^[a-z0-9][a-z0-9_.-]{0,39}$"') >= 2  # the name of a table, and of a sheet
    assert '"others"' not in out
    assert '"pattern"' in command_line("schema", "geneva")[1]
