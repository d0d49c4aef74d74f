"""The shop of a small machine from a few words, and a design that is made of its sheet."""

import sys
import tomllib
from pathlib import Path

import pytest

from mechwright.designs.change import changed
from mechwright.designs.design import design_of, load
from mechwright.plugins.host import host
from mechwright.remedies.starting import fit_of, started
from mechwright_cam.commands import shop_file
from mechwright_cam.shop.machine import known_machines
from mechwright_cam.shop.shop_table import shop_of
from mechwright_cam.shop.workshop_file import read_shop

SHEET = "200x150x6 acrylic"


@pytest.fixture(autouse=True)
def _here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def run(command_line):
    return command_line


def shop(run, *words):
    done = run("shop", "-o", "shop.toml", "--mills", "3.175,2,1", "--sheet", SHEET, *words)
    assert done[0] == 0, done
    return done[1], read_shop(Path("shop.toml"))


def test_a_3018_with_three_mills_and_a_sheet(run) -> None:
    said, made = shop(run, "--machine", "3018")
    assert [(tool.diameter, tool.flutes, tool.shank_diameter) for tool in made.library] == [
        (3.175, 1, 3.175),
        (2.0, 1, 3.175),
        (1.0, 1, 3.175),
    ]
    (row,) = made.workshop.stock
    assert (row.material, row.thickness, row.length, row.width) == ("acrylic", (6.0,), 200, 150)
    machine = made.workshop.machine
    assert (machine.travel_z, machine.homing, machine.nose_to_table, machine.collet) == (45, "none", None, 7)
    assert made.workshop.control == "grbl"
    assert made.lends["cam"]["coolant"] == "off"
    assert "has no switches" in said
    assert "nose_to_table" in said


@pytest.mark.parametrize("name", [name for name, (_, preset) in known_machines().items() if preset.control])
def test_every_machine_with_a_control_gives_a_shop(run, name) -> None:
    spindle = () if "spindle" not in known_machines()[name][1].unknown else ("--spindle", "10000-30000")
    _, made = shop(run, "--machine", name, *spindle)
    assert made.workshop.machine is not None
    assert host().of  # it is read again by whoever names it


def test_what_is_said_goes_over_the_known_figures(run) -> None:
    words = ("--gap", "75", "--spoil-board", "12", "--spindle", "4000-11000", "--homing")
    machine = shop(run, "--machine", "3018", *words)[1].workshop.machine
    assert (machine.nose_to_table, machine.spoil_board, machine.homing) == (75, 12, "switches")
    assert (machine.spindle_min, machine.spindle_max, machine.travel_x) == (4000, 11000, 300)


def test_wood_is_cut_with_two_flutes_and_own_ones_are_kept(run) -> None:
    run(
        "shop",
        "--machine",
        "3018",
        "--mills",
        "3.175,1/8 in:3:20",
        "--sheet",
        "300x200x4 plywood",
        "-o",
        "a.toml",
    )
    done = run(
        "shop", "--machine", "3018", "--mills", "2,3.175:3:20", "--sheet", "300x200x4 plywood", "-o", "b.toml"
    )
    assert done[0] == 0, done
    tools = read_shop(Path("b.toml")).library.tools
    assert [(tool.flutes, tool.flute_length) for tool in tools] == [(2, 10), (3, 20)]


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--machine", "3019"), "unknown machine '3019'; did you mean '3018"),
        (("--machine", "carvera"), "reads Smoothieware branch, for which no program is written here"),
        (("--machine", "openbuilds-minimill"), "comes without a spindle"),
        ((), "--machine: is missing"),
        (
            ("--machine", "3018", "--mills", "8"),
            "the collet of Genmitsu 3018-PRO and the like holds 7 at most",
        ),
        (("--machine", "3018", "--mills", "x"), "--mills: 'x' should be a diameter"),
        (("--machine", "3018", "--mills", "2,2"), "2 stands there twice"),
        (("--machine", "3018", "--mills", "", "--gap", "70"), "--mills: is missing"),
        (("--machine", "3018", "--sheet", "200x150x6 pvc"), "hydrogen chloride"),
        (("--machine", "3018", "--sheet", "200x150 pom"), "should be length x width x thickness"),
        (("--machine", "3018", "--sheet", "0x150x6 pom"), "each size should be above 0"),
        (("--machine", "3018", "--spindle", "9000"), "--spindle: '9000' should be"),
        (("--machine", "3018", "--units", "inch"), "--units out"),
    ],
)
def test_a_mistake_names_its_option_and_writes_nothing(run, words, said) -> None:
    done = run("shop", "-o", "shop.toml", *(() if "--mills" in words else ("--mills", "2")), *words)
    assert done[0] == 2
    assert said in done[2].replace("\n", " ")
    assert not Path("shop.toml").exists()


def test_on_a_terminal_questions_are_asked(run, monkeypatch) -> None:
    answers = iter(["3018", "3.175,2", "200x150x6 pvc", SHEET, "", "75", "10", "shop.toml"])
    monkeypatch.setattr(shop_file.typer, "prompt", lambda *_, **__: _as(next(answers)))
    monkeypatch.setattr(shop_file.typer, "confirm", lambda *_, **__: False)
    monkeypatch.setattr(sys.stdin, "isatty", lambda: True)
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    shop_file.shop_file(None, None, "mm", "", "", shop_file.BenchWords(), force=False)
    machine = read_shop(Path("shop.toml")).workshop.machine
    assert (machine.nose_to_table, machine.spoil_board, machine.homing) == (75, 10, "none")


def _as(text: str) -> object:
    return float(text) if text in {"75", "10"} else text


def test_a_new_design_is_made_of_the_sheet_in_hand(run) -> None:
    shop(run, "--machine", "3018")
    content = {"format": 1, "family": "geneva", "shop": "shop.toml", "parameters": {"law": "straight"}}
    change = started(content, Path("w.toml"), host(), None)
    assert change["parameters.material"] == "acrylic"
    plates = {"parameters.thickness", "parameters.crank_thickness", "parameters.disc_thickness"}
    assert {change[key] for key in plates} == {6.0}
    assert 40 < change["parameters.entry_radius"] < 60
    assert change["cam.nest.turn"] is True


@pytest.mark.parametrize("fit", [(120.0, 80.0), (60.0, 200.0)])
def test_each_plate_fits_into_the_size_that_is_named(fit) -> None:
    content = {"format": 1, "family": "geneva", "parameters": {"law": "straight"}}
    change = started(content, Path("w.toml"), host(), fit)
    assert set(change) == {"parameters.entry_radius"}
    design = design_of(changed(content, change), Path("w.toml"), "", host())
    sizes = [
        sorted((x1 - x0, y1 - y0), reverse=True)
        for part in design.family.parts(design.params)
        if part.outline is not None
        for x0, y0, x1, y1 in [part.outline.bounds]
    ]
    long, short = sorted(fit, reverse=True)
    assert all(x <= long and y <= short for x, y in sizes)
    assert max(y for _, y in sizes) > 0.95 * short


@pytest.mark.parametrize("text", ["120", "120x", "0x80", "axb", "1x2x3"])
def test_a_size_is_length_times_width(text) -> None:
    with pytest.raises(ValueError, match="--fit"):
        fit_of(text)


def test_new_writes_a_file_that_names_the_shop_and_no_other_control(run) -> None:
    shop(run, "--machine", "3018")
    done = run("new", "spur-gears", "--shop", "shop.toml", "--fit", "60x60", "-o", "g.toml")
    assert done[0] == 0, done
    content = tomllib.loads(Path("g.toml").read_text())
    assert content["shop"] == "shop.toml"
    assert "control" not in content.get("cam", {})
    assert shop_of(load(Path("g.toml"), host())) is not None
    assert "set parameters.module = " in done[1]
    assert run("new", "geneva", "--requirement", "indexing", "--fit", "60x60")[0] == 2


def test_a_new_geneva_wheel_has_straight_slots_and_names_the_others(run) -> None:
    assert 'law = "straight"' in run("new", "geneva")[1]
    assert 'law = "cycloidal"' in run("new", "geneva", "--from", "cycloidal")[1]
    assert run("new", "geneva", "--from", "table")[0] == 2


def test_one_plate_is_not_nested(run) -> None:
    shop(run, "--machine", "3018")
    done = run("new", "plate", "--shop", "shop.toml", "-o", "p.toml")
    assert done[0] == 0, done
    assert "cam" not in tomllib.loads(Path("p.toml").read_text())
    assert "cam.nest" not in done[1]
    assert load(Path("p.toml"), host()).params.material == "acrylic"
