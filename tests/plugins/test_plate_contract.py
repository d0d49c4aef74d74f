"""The built-in family under the kit that third parties use, and what its files and its commands do."""

import json
import os
from pathlib import Path
from typing import ClassVar

import pytest
from by_night import by_night, examples
from day_contract import DayContract
from hypothesis import strategies as st

import mechwright as mw
from mechwright.designs.files import INPUT_LIMIT
from mechwright.errors import DesignError
from mechwright.plugins.host import host
from mechwright.studies.study import load_study
from mechwright.testing.commands import run
from mechwright_plate.family import Plate

NEMA = {"drawing": "examples/nema-17-plate.dxf", "thickness": 6}
INCH = {
    "drawing": "examples/inch-bracket.dxf",
    "thickness": "1/4 in",
    "units": "inch",
    "origin": "corner",
    "holes": {"0.25 in": "bore H7", "0.197 in": "M6"},
}


class TestPlate(DayContract):
    family = Plate
    max_examples = examples(10, 60)
    examples = ({}, INCH, NEMA)
    night: ClassVar = {
        "test_solids": (0, 1),
        "test_programs_are_proven": (0, 2),
        "test_no_interference": (0, 1),
    }
    refused = (
        ({**INCH, "units": "drawing"}, "units"),
        ({**INCH, "holes": {"7": "bore H7"}}, "holes"),
        ({**INCH, "holes": {"0.25 in": "pocket"}}, "holes"),
        ({**INCH, "holes": {"none": "M6"}}, "holes"),
        ({**INCH, "layers": {"0": "pocket"}}, "layers"),
        ({**INCH, "layers": {"1": "through"}}, "layers"),
        ({**INCH, "layers": {"colour 9": "through"}}, "layers"),
        ({"drawing": "none.dxf"}, "drawing"),
        ({"drawing": "../none.dxf"}, "drawing"),
        ({"drawing": "examples"}, "drawing"),
        ({"drawing": "README.md"}, "drawing"),
        ({"thickness": 2}, "thickness"),
    )
    variations: ClassVar = {
        "drawing": [NEMA["drawing"]],
        "join": [0.0001],
        "layers": [{"0": "outline"}, {"POCKET_3": "pocket 4"}],
        "holes": [{"6": "bore P7"}],
        "units": ["cm"],
    }

    def strategy(self):
        return st.fixed_dictionaries(
            {},
            optional={
                "drawing": st.sampled_from(["", NEMA["drawing"], INCH["drawing"]]),
                "thickness": st.floats(0.1, 500),
                "units": st.sampled_from(["drawing", "mm", "inch", "m"]),
                "scale": st.floats(0.001, 1000),
                "join": st.floats(0.0001, 1),
                "origin": st.sampled_from(["drawing", "corner", "centre"]),
                "layers": st.dictionaries(
                    st.sampled_from(["0", "POCKET_3", "M5", "colour 7"]),
                    st.sampled_from(["pocket 1", "M5", "ignore", "x"]),
                    max_size=2,
                ),
                "holes": st.dictionaries(
                    st.sampled_from(["6", "5", "16"]),
                    st.sampled_from(["bore H7", "M6", "ignore"]),
                    max_size=2,
                ),
            },
        )


def design(tmp_path, **parameters):
    rows = [f"{key} = {json.dumps(value)}" for key, value in parameters.items()]
    file = tmp_path / "plate.toml"
    file.write_text("\n".join(['format = 1\nfamily = "plate"\n[parameters]', *rows]), encoding="utf-8")
    return file


def test_what_stands_still_has_no_motion_and_says_so_in_one_line(tmp_path):
    done = run("solve", design(tmp_path), "-o", tmp_path / "out")
    assert (done.returncode, done.stderr.count("\n")) == (2, 1)
    assert "family plate stands still: there is no motion to write" in done.stderr
    plate = mw.design("plate", thickness=8)
    with pytest.raises(mw.MechwrightError, match="stands still"):
        plate.page  # noqa: B018


def test_a_drawing_is_read_beside_the_design_and_stands_in_the_manifest(tmp_path, monkeypatch):
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "b.dxf").write_bytes(Path(NEMA["drawing"]).read_bytes())
    file = design(tmp_path, drawing="sub/b.dxf", thickness=6)
    found = mw.load(file)
    (part,) = found.parts
    assert part.name == "b"
    assert found.design.params.drawing.name == "sub/b.dxf"
    assert 'drawing = "sub/b.dxf"' in found.design.text
    monkeypatch.chdir(tmp_path)
    assert mw.design("plate", drawing="sub/b.dxf", thickness=6).parts[0] == part
    from mechwright.scripting.provenance import facts

    inputs = facts(found.design, found.host)["inputs_sha256"]
    assert inputs["sub/b.dxf"] == found.design.params.drawing.digest


@pytest.mark.parametrize("kind", ["missing", "folder", "fifo", "link", "device", "large", "outside"])
def test_what_is_no_file_beside_the_design_is_one_line(tmp_path, kind):
    place = tmp_path / "in" / "d.dxf"
    place.parent.mkdir()
    name = "d.dxf"
    match kind:
        case "folder":
            place.mkdir()
        case "fifo":
            os.mkfifo(place)
        case "link":
            place.symlink_to(place)
        case "device":
            place.symlink_to("/dev/zero")
        case "large":
            with place.open("wb") as file:
                file.truncate(INPUT_LIMIT + 1)
        case "outside":
            name = "../d.dxf"
    done = run("check", design(place.parent, drawing=name))
    assert (done.returncode, done.stderr.count("\n")) == (2, 1), done
    assert "plate.toml: parameters.drawing: " in done.stderr


def test_the_live_page_shows_what_stands_still():
    from mechwright_cad.live import answers

    design = mw.load("examples/nema-17-plate.toml").design
    answer = answers.parts(design.changed({"parameters.thickness": 8.0}))
    assert "100 x 80 x 8 mm" in answer["findings"][-1]["message"]
    assert "nema-17-plate" in json.dumps(answer["scene"], default=str)
    refused = answers.parts(design.changed({"parameters.units": "m"}))
    assert refused["findings"][0]["code"] == "plate.feature"
    with pytest.raises(mw.DesignError, match=r"parameters\.drawing: 'no\.dxf' cannot be read: No such file"):
        design.changed({"parameters.drawing": "no.dxf"})


def test_a_study_carries_no_files(tmp_path):
    (tmp_path / "b.dxf").write_bytes(Path(NEMA["drawing"]).read_bytes())
    file = design(tmp_path, drawing="b.dxf")
    file.write_text(file.read_text() + "\n[study.ranges]\nthickness = { least = 4, greatest = 9 }\n")
    with pytest.raises(DesignError, match=r"parameters\.drawing: a study carries no files") as caught:
        load_study(file, host())
    assert "\n" not in str(caught.value)


@by_night
@pytest.mark.parametrize("control", ["linuxcnc", "fanuc", "haas", "mach3", "grbl"])
@pytest.mark.parametrize("name", ["nema-17-plate", "inch-bracket"])
def test_the_examples_are_proven_on_every_control(tmp_path, control, name):
    plate = mw.load(f"examples/{name}.toml")
    for program in plate.with_(cam={"control": control}).programs:
        assert program.proof.ok
