"""The page of a whole job, and the sheets it leads to."""

import json
import re

import pytest
from typer.testing import CliRunner

from mechwright.cli.app import make_app


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("job")
    file = folder / "train.toml"
    file.write_text(
        'format = 1\nfamily = "elliptic-gears"\nname = "pair"\n[parameters]\nteeth = 21\n'
        '[cam.part.gear]\nwork_offset = "G55"\n'
    )
    done = CliRunner().invoke(make_app(), ["cam", str(file), "-o", str(folder / "out")])
    assert done.exit_code == 0, done.output
    return folder / "out"


def text(page):
    return re.sub(r"\s+", " ", re.sub(r"<style>.*?</style>|<[^>]+>", " ", page, flags=re.S))


def test_the_summary_names_programs_quantity_offset_and_proof(made):
    page = (made / "setup.html").read_text(encoding="utf-8")
    said = text(page)
    assert "The whole job, from train.toml: 1 program," in said
    assert re.search(r"gear watch the cut gear\.nc 2 \d+\.\d × \d+\.\d × 10 aluminium G55", said)
    assert "ALL PROVEN" in said
    proof = json.loads((made / "proof.json").read_text())["gear"]
    assert f"{proof['gouge_max_mm']:.4f}" in said


def test_two_pieces_take_twice_the_time(made):
    proof = json.loads((made / "proof.json").read_text())["gear"]
    minutes = round(2 * proof["time_estimate_s"]) // 60
    assert f"{minutes} min" in text((made / "setup.html").read_text(encoding="utf-8"))


def test_every_tool_of_every_program_is_listed_once_with_its_offsets(made):
    page = (made / "setup.html").read_text(encoding="utf-8")
    called = {
        int(number) for number in re.findall(r"^(?:N\d+ )?T(\d+)", (made / "gear.nc").read_text(), re.M)
    }
    assert called
    listed = {
        letter: [int(n) for n in re.findall(rf'<td class="big">{letter}(\d+)</td>', page)] for letter in "THD"
    }
    assert listed == {"T": sorted(called), "H": sorted(called), "D": []}  # nothing is compensated here


def test_every_link_leads_to_a_file_that_is_there(made):
    for page in made.glob("*.html"):
        for target in re.findall(r'<a href="([^#"]+)"', page.read_text(encoding="utf-8")):
            assert (made / target).is_file(), f"{page.name} leads to {target}"
    assert 'href="setup.html"' in (made / "gear.setup.html").read_text(encoding="utf-8")


def test_a_sheet_holds_one_program(made):
    page = (made / "gear.setup.html").read_text(encoding="utf-8")
    assert page.count("<article") == 1
    assert "<nav>" not in page
