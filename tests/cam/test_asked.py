"""What [cam] asks of the parts: solid, drawing, program and proof show the same, and refusals name the key."""

import json
import math
import re
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest
from by_night import by_night, examples
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from typer.testing import CliRunner

from mechwright.cli.app import make_app
from mechwright.contracts.details import Chamfer, Engraving, Thread
from mechwright.contracts.finding import errors
from mechwright.contracts.fit_settings import Fits
from mechwright.contracts.moments import volume
from mechwright.designs.design import load
from mechwright.designs.requirement import load_requirement
from mechwright.errors import DesignError, GeometryError
from mechwright.mechanics.mating.fitted import with_fits
from mechwright.pipeline import Build
from mechwright.plugins.host import host
from mechwright_cad.exporters import dxf
from mechwright_cad.solids.solid import part_solid
from mechwright_cam.machining import Machining, machine
from mechwright_cam.planning.prepare import prepare
from mechwright_cam.proof import prove

EXAMPLES = Path(__file__).parents[2] / "examples"
FINISHED = EXAMPLES / "crank-rocker-finished.toml"
PLAIN = (
    'format = 1\nfamily = "four-bar"\nname = "plain"\n[parameters]\n'
    "crank = 30\ncoupler = 80\nfollower = 70\nground = 90\n"
)
LAYERS = {Chamfer: "CHAMFER", Engraving: "ENGRAVE", Thread: "THREAD"}
OPERATIONS = {Chamfer: "chamfer", Engraving: "engrave", Thread: "tap"}


def design(tmp_path, text, head=PLAIN):
    file = tmp_path / "plain.toml"
    file.write_text(head + text, encoding="utf-8")
    return load(file, host())


def part_of(found, name):
    return next(part for part in found.parts() if part.name == name)


def made(found, name):
    """Program and proof of one part of a design."""
    jobs = Machining(Build(found, host())).jobs
    job = next(job for job in jobs if job.part.name == name)
    return machine(job, Machining(Build(found, host())).control)


@by_night
def test_the_example_is_built_and_everything_shows_what_it_asks(tmp_path):
    done = CliRunner().invoke(
        make_app(), ["build", str(FINISHED), "-o", str(tmp_path / "out"), "--also", "dxf"]
    )
    assert done.exit_code == 0, done.output
    proofs = json.loads((tmp_path / "out" / "proof.json").read_text(encoding="utf-8"))
    assert "false" not in json.dumps(proofs)
    for part in load(FINISHED, host()).parts():
        if part.outline is None:
            continue
        kinds = {type(detail) for detail in part.details}
        assert kinds == ({Chamfer, Engraving, Thread} if part.name == "ground" else {Chamfer, Engraving})
        drawing = (tmp_path / "out" / f"{part.name}.dxf").read_text(encoding="utf-8")
        program = (tmp_path / "out" / f"{part.name}.nc").read_text(encoding="utf-8")
        sheet = (tmp_path / "out" / f"{part.name}.setup.html").read_text(encoding="utf-8")
        for detail in part.details:
            assert f"operation: {detail.name}: {OPERATIONS[type(detail)]}" in program
        for kind, layer in LAYERS.items():
            assert (layer in drawing) == (kind in kinds)
        assert (" N7 " in sheet) == ("N7" in program) == ("N7" in drawing) == (part.name == "ground")
        assert part_solid(part).Volume() == pytest.approx(volume(part), rel=1e-6)


def test_without_these_keys_a_part_is_the_one_of_the_family(tmp_path):
    found = design(tmp_path, "[cam]\ndeburr = 0\nmark = ''\n[cam.part.crank]\norigin = 'corner'\n")
    alone = with_fits(found.family.parts(found.params), found.solve(2), Fits())
    for ours, theirs in zip(found.parts(), alone, strict=True):
        assert replace(ours, measures=theirs.measures) == theirs or ours.build is not None


def test_a_threaded_hole_is_one_hole_and_the_part_loses_what_the_thread_leaves(tmp_path):
    plain, found = design(tmp_path, ""), design(tmp_path, "[cam.part.ground.holes]\nbore-3.thread = 'M6'\n")
    before, after = part_of(plain, "ground"), part_of(found, "ground")
    core = after.details[0].core
    gained = math.pi / 4 * (6.0**2 - core**2) * before.thickness
    assert part_solid(after).Volume() - part_solid(before).Volume() == pytest.approx(gained, rel=1e-6)
    assert "M6x1 through" in dxf.part(after).decode()
    text = made(found, "ground").text
    assert "thread-bore-3: tap" in text
    assert "D6" not in re.findall(r"\(bore-3.*\)", text)


def test_a_part_has_its_own_words_over_those_of_the_job(tmp_path):
    text = (
        "[cam]\ndeburr = 0.2\nmark = '{part}'\n[cam.part.crank]\ndeburr = 0\n[cam.part.ground]\nmark = ''\n"
    )
    parts = {part.name: part for part in design(tmp_path, text).parts()}
    assert [type(detail) for detail in parts["crank"].details] == [Engraving]
    assert {type(detail) for detail in parts["ground"].details} == {Chamfer}
    widths = {d.width for d in parts["follower"].details if isinstance(d, Chamfer)}
    assert widths == {0.2}
    strokes = {len(parts[name].details[-1].strokes) for name in ("crank", "follower")}
    assert len(strokes) == 2, "each bears its own name"


def test_the_parts_of_a_nest_have_what_each_asks_for(tmp_path):
    text = "[cam]\ndeburr = 0.2\n[cam.nest]\nparts = ['crank', 'follower']\n[cam.part.crank]\nmark = 'A'\n"
    found = design(tmp_path, text)
    findings, jobs = prepare(found, [part for part in found.parts() if part.outline is not None])
    assert not errors(findings)
    (nest,) = [job.part for job in jobs if job.part.name == "nest"]
    assert [detail.name for detail in nest.details if isinstance(detail, Engraving)] == ["crank mark"]
    assert sum(isinstance(detail, Chamfer) for detail in nest.details) == 6


def test_a_part_that_is_only_marked_stays_in_the_nest_of_its_kind(tmp_path):
    text = "[cam.nest]\n[cam.part.crank]\nmark = 'A'\nholes.bore-2.fit = 'H7'\n"
    found = design(tmp_path, text)
    findings, jobs = prepare(found, [part for part in found.parts() if part.outline is not None])
    assert not errors(findings)
    nest = next(job.part for job in jobs if job.part.name == "nest")
    assert "crank" in {placed.part.name for placed in nest.placed}
    assert "crank mark" in {detail.name for detail in nest.details}


def test_designs_that_are_found_take_what_is_asked_of_all_parts_and_of_no_single_one(tmp_path):
    head = (
        'format = 1\nfamily = "four-bar"\n[requirement]\nkind = "path"\npoints = [[0, 0], [10, 5], [20, 0]]\n'
    )
    file = tmp_path / "asked.toml"
    file.write_text(head + "[cam]\ndeburr = 0.4\n", encoding="utf-8")
    asked = load_requirement(file, host())
    assert [value.cam.deburr for table, value in asked.tables if table.name == "cam"] == [0.4]
    file.write_text(head + "[cam.part.crank]\nmark = 'A'\n", encoding="utf-8")
    with pytest.raises(DesignError, match=r"write cam\.part\.crank into the one that you take"):
        load_requirement(file, host())


REFUSED = {
    "[cam.holes.bore-1]\nfit = 'H7'": "cam.holes: holes are those of one part; write [cam.part.NAME.holes.HOLE]",
    "[cam.part.ground.holes.bore-1]\nfit = 'H8'": "cam.part.ground.holes.bore-1.fit: 'H8' should be",
    "[cam.part.ground.holes.bore-1]": "cam.part.ground.holes.bore-1: give it a fit or a thread",
    "[cam.part.ground.holes.bore-1]\nfit = 'H7'\nthread = 'M6'": "give it a fit or a thread, one of the two",
    "[cam.part.ground.holes.bore-1]\nfit = 'H7'\ndepth = 3": "depth is that of a thread",
    "[cam.part.ground.holes.bore-9]\nfit = 'H7'": "holes.bore-9: part ground has no round hole 'bore-9'; it has: bore-1 (",
    "[cam.part.ground.holes.bore-3]\nthread = 'M20'": "holes.bore-3: M20x2.5 is no thread for bore-3",
    "[cam.part.ground.holes.bore-3]\nthread = 'x'": "holes.bore-3: 'x' is no metric thread",
    "[cam.part.rocker]\ndeburr = 0.3": "cam.part.rocker.deburr: no plate part has this name; there is: coupler",
    "[cam.part.pin-a]\nmark = 'A'": "cam.part.pin-a.mark: no plate part has this name",
    "[cam.part.nest]\nmark = 'A'\n[cam.nest]": "cam.part.nest.mark: no plate part has this name",
    "[cam]\nmark = 'Ä'": "cam.part.ground.mark: no letter 'Ä' to engrave",
    "[cam]\nmark = 'TOO LONG FOR SUCH PARTS'": "mark: no free place on part crank",
    "[cam.part.crank]\ndeburr = 5": "cam.part.crank.deburr",
}


@pytest.mark.parametrize(("text", "said"), REFUSED.items(), ids=range(len(REFUSED)))
def test_what_cannot_be_done_is_refused_by_the_name_of_its_key(text, said, tmp_path):
    def parts_and_solids():
        for part in design(tmp_path, text + "\n").parts():
            if part.outline is not None and part.details:
                part_solid(part)

    if "deburr = 5" in text:  # of a plate of 6 mm: its web is narrower than two chamfers
        with pytest.raises(GeometryError, match="part crank"):
            parts_and_solids()
        return
    with pytest.raises(DesignError) as told:
        parts_and_solids()
    assert said in str(told.value)
    assert str(told.value).startswith(str(tmp_path))
    assert "\n" not in str(told.value)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (
            "[cam]\ntools = ['spot-6', 'drill-5', 'mill-4']\ndeburr = 0.3",
            "no chamfer mill of 90 degrees cuts edge-",
        ),
        ("[cam]\nmark = 'A'\nmark_depth = 1.5", "no pointed cutter engraves mark of part"),
        (
            "[parameters]\nground_thickness = 14\n[cam]\n"
            "tools = ['spot-6', 'drill-5', 'mill-6', 'mill-4', 'thread-m6']\n"
            "[cam.part.ground.holes.bore-3]\nthread = 'M6'",
            "no thread mill",
        ),
    ],
)
def test_tools_that_are_not_there_are_named(text, said, tmp_path):
    head = PLAIN.replace("[parameters]\n", "") if "[parameters]" in text else PLAIN
    if "[parameters]" in text:
        table, rest = text.split("\n[cam", 1)
        head, text = PLAIN + table.removeprefix("[parameters]\n") + "\n", "[cam" + rest
    machining = Machining(Build(design(tmp_path, text + "\n", head), host()))
    found = errors(machining.findings)
    assert any(said in str(finding) for finding in found), [str(finding) for finding in found]


def test_edges_of_holes_narrower_than_the_chamfer_mill_are_proven(tmp_path):
    # Without a mark chamfer-6 is the only pointed tool; the holes are 4.9 and 6 mm wide.
    text = (
        "[cam]\ndeburr = 0.2\ntools = ['chamfer-6', 'spot-6', 'drill-4', 'mill-3', 'mill-6', 'thread-m6']\n"
    )
    found = design(tmp_path, text + "[cam.part.ground.holes]\nbore-3.thread = 'M6'\n")
    result = made(found, "ground")
    assert result.proof.ok
    lines = result.text.splitlines()
    start = next(k for k, line in enumerate(lines) if "operation: edge-bore-3" in line)
    end = next(k for k, line in enumerate(lines[start + 1 :], start + 1) if "operation: " in line)
    gone = lines[:start] + lines[end:]
    control = Machining(Build(found, host())).control
    without = prove("\n".join(gone) + "\n", result.job, control)
    assert [check.name for check in without.failures] == ["details"]


@cache
def example(name):
    return load(EXAMPLES / f"{name}.toml", host())


@settings(deadline=None, max_examples=examples(1, 16), suppress_health_check=[HealthCheck.too_slow])
@given(
    place=st.sampled_from(
        [
            ("crank-rocker-three-poles", "coupler"),
            ("crank-rocker-three-poles", "ground"),
            ("geneva-straight", "crank"),
            ("geneva-straight", "wheel"),
            ("slider-crank-quick-return", "rod"),
        ]
    ),
    width=st.floats(0.1, 0.8).map(lambda w: round(w, 2)),
    text=st.text("AKM358-/", min_size=1, max_size=4),
    height=st.floats(1.5, 4.0).map(lambda h: round(h, 1)),
    depth=st.sampled_from([0.1, 0.2, 0.25]),
)
def test_random_edges_and_marks_on_parts_of_the_examples_are_proven(place, width, text, height, depth):
    base = example(place[0])
    job = base.tables["cam"]
    keys = {"deburr": width, "mark": text, "mark_height": height, "mark_depth": depth}
    cam = replace(job, cam=job.cam.model_copy(update=keys))
    found = replace(base, tables={**base.tables, "cam": cam})
    plain = next(part for part in base.parts() if part.name == place[1])
    part = part_of(found, place[1])
    solid = part_solid(part)
    assert solid.Volume() == pytest.approx(volume(part), rel=1e-5)
    assert solid.Volume() < volume(plain)
    result = made(found, place[1])
    assert result.proof.ok
    for detail in part.details:
        assert f"{detail.name}: {OPERATIONS[type(detail)]}" in result.text
