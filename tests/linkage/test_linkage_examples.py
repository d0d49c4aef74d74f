"""The examples of linkages: what they are warned of, their plates, one proven whole; by night all of them."""

from pathlib import Path

import numpy as np
import pytest
from by_night import by_night

from mechwright.contracts.family import Family
from mechwright.contracts.finding import Severity
from mechwright.designs.design import load
from mechwright.pipeline import Build, Wanted
from mechwright.plugins.host import host
from mechwright_cam.machining import Machining
from mechwright_linkage.parameters import LinkageParams

FOLDER = Path(__file__).parents[2] / "examples" / "linkages"
FILES = sorted(FOLDER.glob("*.toml"))
PUBLISHED = {"hoecken", "jansen", "klann"}
"""Their published proportions bring a transmission angle below 30 degrees."""


def warnings(found):
    return {one.code for one in found if one.severity is not Severity.NOTE}


def only_published(path, codes):
    return codes == ({"linkage.transmission"} if path.stem in PUBLISHED else set())


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_its_plates_are_made_and_each_link_has_its_colour(path):
    text = path.read_text(encoding="utf-8")
    assert text.startswith("# ")
    assert "Look at" in text.replace("\n# ", " ") or "live" in text, "it says what is worth looking at"
    design = load(path, host())
    assert design.name == path.stem
    assert only_published(path, warnings(design.family.check(design.params)))
    parts = design.family.parts(design.params)
    colours = {}
    for part in parts:
        if part.outline is not None:
            colours.setdefault(part.instances[0].body, part.colour)
    assert len(set(colours.values())) == len(colours)


def test_most_are_machines():
    machines = [path for path in FILES if "[machine]" in path.read_text(encoding="utf-8")]
    assert (len(machines), len(FILES)) == (11, 14)


def test_the_table_of_points_is_the_drawing():
    drawn = load(FOLDER / "drawn-ram.toml", host()).params
    table = FOLDER / "drawn-ram.csv"
    family = host().of(Family)["linkage"].item
    read = family.draft(str(table), table.read_text(encoding="utf-8"))
    assert isinstance(read, LinkageParams)
    assert read.points == drawn.points
    assert {name: set(points) for name, points in read.links.items()} == {
        name: set(points) for name, points in drawn.links.items()
    }
    one, two = (family.solve(params.model_copy(update={"output": "ram"}), 73) for params in (drawn, read))
    assert np.allclose(one["s_slide-1"], two["s_slide-1"], atol=1e-9)


@pytest.mark.parametrize(
    "path", [pytest.param(one, marks=() if one.stem == "parallel-guide" else by_night) for one in FILES],
    ids=lambda path: path.stem,
)  # fmt: skip
def test_its_programs_are_proven(path):
    design = load(path, host())
    with Build(design, host(), Wanted("verify")) as build:
        found = [*design.check(), *build.made(Machining).findings]
    assert only_published(path, warnings(found))


def test_a_link_that_is_named_as_a_part_of_frames_has_another_file_name():
    names = [part.name for part in load(FOLDER / "jansen.toml", host()).parts()]
    assert {"foot", "foot-link"} <= set(names)
    assert len(set(names)) == len(names)


def test_what_rolls_in_a_slot_has_the_play_of_a_washer():
    drawn, jansen = (load(FOLDER / f"{name}.toml", host()) for name in ("drawn-ram", "jansen"))
    for design, play in ((drawn, drawn.params.washer), (jansen, 0.0)):
        bushings = [part for part in design.family.parts(design.params) if part.name.startswith("bushing")]
        assert [part.play for part in bushings] == [play] * len(bushings)
