"""``mechwright cut`` and ``build``: files, names, sheets, and what the page says."""

import json

import pytest
from by_night import by_night
from typer.testing import CliRunner

from mechwright.cli.app import make_app
from mechwright.pipeline import Build, Wanted
from mechwright.plugins.host import host
from mechwright_cad.bill.page import drawings_of
from mechwright_cut.pages.blanks import CutBlanks
from mechwright_cut.pages.registered import CutPrograms, CutSheets
from mechwright_cut.settings.cut_table import CutTable, cut_settings

WHEEL = """format = 1
family = "geneva"
name = "wheel"
process = {process}

[parameters]
slots = 6
law = "straight"
entry_radius = 80
roller_radius = 4
pin_diameter = 5
thickness = 5
crank_thickness = 5
bore = 10
driver_bore = 6
fixing = 3
material = "{material}"
roller_material = "steel"
speed = 60

[cut]
small_holes = "spot"
{table}
"""


def design(folder, process='"laser"', material="acrylic", table=""):
    file = folder / "wheel.toml"
    file.write_text(WHEEL.format(process=process, material=material, table=table), encoding="utf-8")
    return file


def run(*words):
    return CliRunner().invoke(make_app(), [str(word) for word in words])


def test_the_command_writes_proven_programs_and_their_page(tmp_path):
    done = run("cut", design(tmp_path), "-o", tmp_path / "out")
    assert done.exit_code == 0, done.output
    written = sorted(path.name for path in (tmp_path / "out").iterdir())
    assert written == [
        "cut-proof.json",
        "cut.html",
        "laser-acrylic-5.nc",
        "laser-acrylic-6.nc",
        "manifest.json",
    ]
    proofs = json.loads((tmp_path / "out" / "cut-proof.json").read_text())
    assert all(one["ok"] for one in proofs.values())
    page = (tmp_path / "out" / "cut.html").read_text()
    for said in (
        "laser-acrylic-5.nc",
        "PMMA, cast",
        "$32=1",
        "ream to 10 H7",
        "drill dowel-1",
        "wheel outside",
    ):
        assert said in page, said
    assert page.count('<path class="kept"') == 3


def test_the_same_design_gives_the_same_bytes(tmp_path):
    files = []
    for _ in range(2):
        with Build(design(tmp_path), host(), Wanted("cut")) as build:
            files.append({**CutPrograms().files(build), **CutSheets().files(build)})
    assert files[0] == files[1]


@pytest.mark.parametrize(
    ("process", "material", "table", "names"),
    [
        ('"laser"', "acrylic", "", {"laser-acrylic-5.nc", "laser-acrylic-6.nc"}),
        pytest.param(
            '"laser"',
            "acrylic",
            'control = "linuxcnc-beam"',
            {"laser-acrylic-5.ngc", "laser-acrylic-6.ngc"},
            marks=by_night,
        ),
        pytest.param(
            '"laser"', "steel", 'laser = "fibre"', {"laser-steel-5.ngc", "laser-steel-6.ngc"}, marks=by_night
        ),
        ('"wire"', "steel", "passes = 3", {"wire-steel-5.iso", "wire-steel-6.iso"}),
        ('"service"', "steel", "", {"wheel-cut.dxf", "locking-disc-cut.dxf", "crank-cut.dxf"}),
        ('{ parts.wheel = "laser" }', "acrylic", "", {"laser-acrylic-5.nc"}),
        (
            '{ default = "laser", parts.crank = "service" }',
            "acrylic",
            "",
            {"laser-acrylic-5.nc", "laser-acrylic-6.nc", "crank-cut.dxf"},
        ),
        ('"mill"', "acrylic", "", set()),
    ],
)
def test_each_process_has_its_files_and_names_them_before(tmp_path, process, material, table, names):
    with Build(design(tmp_path, process, material, table), host(), Wanted("cut")) as build:
        files = {**CutPrograms().files(build), **CutSheets().files(build)}
        told = {one.name for page in (CutPrograms(), CutSheets()) for one in page.names(build, build.wanted)}
        assert told == files.keys()
        assert {name for name in files if not name.startswith("cut")} == names


def test_sheets_are_in_the_bill_of_materials(tmp_path):
    with Build(design(tmp_path), host(), Wanted("build")) as build:
        blanks = CutBlanks().blanks(build)
        assert [(one.parts, one.size) for one in blanks] == [
            (("wheel", "crank"), (600.0, 400.0, 5.0)),
            (("locking-disc",), (600.0, 400.0, 6.0)),
        ]


def test_the_bill_names_no_drawing_of_a_mill(tmp_path):
    """Only what is milled has an outline beside its program."""
    with Build(design(tmp_path, '{ parts.wheel = "laser" }'), host(), Wanted("build")) as build:
        named = drawings_of(build)
    assert "wheel.dxf" not in named.get("wheel", [])
    assert "crank.dxf" in named["crank"]


def test_a_design_without_process_says_how_to_choose_one(tmp_path):
    done = run("cut", design(tmp_path, '"mill"'), "-o", tmp_path / "out")
    assert done.exit_code == 1
    assert 'write process = "laser" at the head' in str(done.exception)
    assert not (tmp_path / "out").exists()


def test_a_slot_narrower_than_the_kerf_writes_nothing(tmp_path):
    done = run("cut", design(tmp_path, table="kerf = 9.0"), "-o", tmp_path / "out")
    assert done.exit_code == 1
    assert "cut.path" in done.output
    assert not (tmp_path / "out").exists()


def test_the_table_is_written_as_it_was_read(tmp_path):
    with Build(design(tmp_path, table="passes = 2\nkerf = 0.21"), host()) as build:
        settings = cut_settings(build.design)
        assert (settings.passes, settings.kerf, settings.small_holes) == (2, 0.21, "spot")
        again = tmp_path / "again.toml"
        again.write_text(build.design.text, encoding="utf-8")
    with Build(again, host()) as build:
        assert cut_settings(build.design) == settings
    assert CutTable().text() == []


def test_the_shop_keeps_measured_kerfs(tmp_path):
    (tmp_path / "shop.toml").write_text(
        'name = "den"\n[[tool]]\nname = "mill-6"\nnumber = 1\nkind = "end-mill"\ndiameter = 6\nflutes = 2\n'
        "flute_length = 20\n[prefer.cut]\nfeed = 450\n"
        'kerfs = [ { process = "co2-laser", material = "acrylic", thickness = 5, kerf = 0.231 } ]\n',
        encoding="utf-8",
    )
    file = design(tmp_path)
    file.write_text('shop = "shop.toml"\n' + file.read_text(encoding="utf-8"), encoding="utf-8")
    with Build(file, host(), Wanted("cut")) as build:
        text = CutPrograms().files(build)["laser-acrylic-5.nc"]
    assert "kerf 0.231 mm" in text
    assert "F450" in text
