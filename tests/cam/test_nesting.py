"""Nests: several parts on one plate, placed, planned and proven as one job."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import shapely
from by_control import asked, prove
from by_night import by_night, examples
from hypothesis import given, settings
from hypothesis import strategies as st
from planning_parts import LIBRARY, bore, lobes, rounded_box
from rs274 import needs_rs274, run_rs274
from typer.testing import CliRunner

from mechwright.cli.app import make_app
from mechwright.contracts.details import Chamfer, Engraving, Thread, moved
from mechwright.contracts.part import Bore, Instance, Part, Pocket, Profile
from mechwright.designs.design import load
from mechwright.errors import DesignError, MechwrightError
from mechwright.geometry import Loop, Outline
from mechwright.pipeline.process import plates_of
from mechwright.plugins.host import host
from mechwright.tolerances import TOLERANCES
from mechwright_cam.controls.contract import Control
from mechwright_cam.machining import machine
from mechwright_cam.planning import choose_tools
from mechwright_cam.planning.nesting import arranged, channel_of, nest_of
from mechwright_cam.planning.prepare import cut_outlines, parts_as_cut, prepare
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.setup.nest import Nest, Placed, make_nest, moved_feature
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.table import settings_of

EXAMPLES = Path(__file__).parents[2] / "examples"
PAIR = 'format = 1\nfamily = "elliptic-gears"\nname = "pair"\n[parameters]\nteeth = 21\n'
POST = host().get(Control, "linuxcnc")


def box(name, width, height, count=1):
    outline = Outline(Loop.polygon([(0, 0), (width, 0), (width, height), (0, height)]))
    return Part(name, outline, 3.0, "aluminium", tuple(Instance(f"b{i}") for i in range(count)))


sizes = st.tuples(st.floats(5, 80), st.floats(5, 80), st.integers(1, 4))


@settings(max_examples=examples(15, 60), deadline=None)
@given(boxes=st.lists(sizes, min_size=1, max_size=7), gap=st.floats(1, 30), turn=st.booleans())
def test_every_copy_lies_once_and_keeps_its_distance(boxes, gap, turn):
    parts = [box(f"part-{i}", *size) for i, size in enumerate(boxes)]
    nest = nest_of("nest", parts, CamSettings(), gap, turn=turn)
    placed = [one.outline.polygon() for one in nest.placed]
    assert sorted(one.part.name for one in nest.placed) == sorted(p.name for p in parts for _ in p.instances)
    assert len({one.label for one in nest.placed}) == len(placed)
    for number, one in enumerate(placed):
        rest = [other for other in placed if other is not one]
        assert min(shapely.distance(one, rest), default=math.inf) >= gap - 1e-5, number
    assert nest.placed[0].x == nest.placed[0].y == 0
    assert turn or all(one.angle == 0 for one in nest.placed)


@settings(max_examples=examples(10, 40), deadline=None)
@given(boxes=st.lists(sizes, min_size=1, max_size=6), length=st.floats(60, 400), width=st.floats(60, 400))
def test_on_a_given_plate_all_lie_inside_or_the_plate_that_would_do_is_named(boxes, length, width):
    parts = [box(f"part-{i}", *size) for i, size in enumerate(boxes)]
    given_plate = CamSettings.model_validate({"stock": {"length": length, "width": width}})
    try:
        nest = nest_of("nest", parts, given_plate, 10.0)
    except DesignError as error:
        l, w = (int(part) for part in str(error).split("they do on ")[1].split(" mm")[0].split(" x "))
        nest_of("nest", parts, CamSettings.model_validate({"stock": {"length": l, "width": w}}), 10.0)
        return
    x0, y0, x1, y1 = nest.outline.bounds
    assert x1 - x0 <= length - 13 + 1e-5
    assert y1 - y0 <= width - 13 + 1e-5


def random_plate(rng, name):
    shape = rng.integers(3)
    w, h = rng.uniform(22, 45, 2)
    if shape == 0:
        outer = rounded_box(w, h, rng.uniform(2, 6))
    elif shape == 1:
        outer = lobes(int(rng.integers(3, 6)), w / 2, rng.uniform(1, 3), points=240)
    else:  # an angle: its inner corner is never sharp after milling
        a = rng.uniform(14, 18)
        outer = Loop.polygon([(-9, -9), (w, -9), (w, a - 9), (a - 9, a - 9), (a - 9, h), (-9, h)])
    count = int(rng.integers(1, 3))
    hole = bore(float(rng.uniform(5, 9)))
    machined = ()
    if rng.random() < 0.5:
        size = float(rng.uniform(8.0, 9.0))
        circle = hole.segments[0]
        slot = Loop.polygon([(-4, -40), (4, -40), (4, -size + 3), (-4, -size + 3)])
        machined = (
            Bore("bore", circle.centre, 2 * circle.radius, 0, 3.0),
            Pocket("slot", slot, (), 0, 1.0),
            Profile("outside", outer, "outside", 0, 3.0),
        )
    instances = tuple(Instance(f"{name}-{i}") for i in range(count))
    return Part(name, Outline(outer, (hole,)), 3.0, "aluminium", instances, machined=machined)


@pytest.mark.parametrize("seed", range(examples(1, 8)))
def test_random_nests_are_planned_and_proven(seed):
    rng = np.random.default_rng(seed)
    parts = [random_plate(rng, f"p{i}") for i in range(int(rng.integers(2, 4)))]
    wanted = CamSettings()
    gap = 2 * channel_of(parts, wanted, LIBRARY) + 3.0
    nest = nest_of("nest", parts, wanted, gap)
    job = make_job(nest, wanted, choose_tools(nest, wanted, LIBRARY))
    made = machine(job, POST)
    assert made.proof.gouge_max_mm <= TOLERANCES.gouge
    assert made.proof.leftover_reachable_max_mm <= TOLERANCES.leftover
    assert len(job.tabs) == 4 * len(nest.placed)
    # The proof is about all of them: without the cuts around one, it fails.
    last = nest.placed[-1].label
    text, keep = [], True
    for line in made.text.splitlines(keepends=True):
        if line.startswith("(operation: "):
            keep = not line.startswith(f"(operation: {last} outside")
        if keep or line.startswith(("T", "G43", "G53", "M")):
            text.append(line)
    failed = {check.name for check in prove("".join(text), job).failures}
    assert {"leftover", "depth"} <= failed


def test_the_program_of_a_nest_is_none_for_one_of_its_parts():
    wanted = CamSettings()
    plates = [box("a", 60, 40), box("b", 60, 40), box("c", 60, 40)]
    nest = nest_of("nest", plates, wanted, 2 * channel_of(plates, wanted, LIBRARY) + 3.0)
    job = make_job(nest, wanted, choose_tools(nest, wanted, LIBRARY))
    text = machine(job, POST).text
    assert asked("beside", text, job).passed
    # The first of them lies at the nest's origin, where the part alone would lie.
    alone = make_job(plates[0], wanted, job.tools)
    found = asked("beside", text, alone)
    assert not found.passed
    assert found.line is not None
    assert "mm outside of the stock" in found.message
    assert "another part" in found.message


def test_what_the_cutters_leave_comes_back_in_each_parts_own_coordinates():
    outer = Loop.polygon([(-9, -9), (40, -9), (40, 9), (9, 9), (9, 25), (-9, 25)])
    angle = Part("angle", Outline(outer, (bore(6.0),)), 3.0, "aluminium", (Instance("a"), Instance("b")))
    strip = box("strip", 12, 90)
    placed = (
        Placed(angle, "one", 0.0, 0.0, math.pi / 2),
        Placed(angle, "two", 60.0, 0.0),
        Placed(strip, "s", 140.0, 0.0),
    )
    nest = make_nest("nest", placed, 20.0)
    job = make_job(nest, CamSettings(), choose_tools(nest, CamSettings(), LIBRARY))
    found = parts_as_cut(job)
    assert sorted(name for name, _ in found) == ["angle", "angle", "strip"]
    assert len(cut_outlines(job)) == 3
    for name, left in found:
        if name == "angle":
            radius = min(tool.radius for tool in job.end_mills)
            assert left.area - angle.outline.polygon().area == pytest.approx(
                (1 - math.pi / 4) * radius**2, abs=0.02
            )
            assert angle.outline.polygon().difference(left).area < 0.01


def test_features_and_details_turn_with_their_part():
    quarter = math.pi / 2
    loop = Loop.polygon([(0, 0), (4, 0), (0, 2)])
    hole = moved_feature(Bore("b", (3.0, 1.0), 2.0, 0.0, 3.0), 10, 20, quarter)
    assert hole.centre == pytest.approx((9, 23))
    wall = moved_feature(Profile("w", loop, "outside", 0, 3, (((4.0, 0.0), 5.0),)), 10, 20, quarter)
    assert wall.tab_sites[0][0] == pytest.approx((10, 24))
    recess = moved_feature(Pocket("p", loop, (loop,), 0, 1), 10, 20, quarter)
    for one in (wall.loop, recess.boundary, recess.islands[0]):
        np.testing.assert_allclose(one.flatten(), [(10, 20), (10, 24), (8, 20)], atol=1e-12)
    assert moved(Thread("t", (3.0, 1.0), 6.0, 1.0, 3.0), 10, 20, quarter).centre == pytest.approx((9, 23))
    stroke = moved(Engraving("e", (((3.0, 1.0), (4.0, 0.0)),), 0.2), 10, 20, quarter).strokes[0]
    np.testing.assert_allclose(stroke, [(9, 23), (10, 24)])
    edge = moved(Chamfer("c", loop, "outside", 0.3), 10, 20, quarter)
    np.testing.assert_allclose(edge.loop.flatten(), [(10, 20), (10, 24), (8, 20)], atol=1e-12)


def nested(tmp_path, text, head=PAIR):
    file = tmp_path / "pair.toml"
    file.write_text(head + text)
    return prepare(design := load(file, host()), plates_of(design.family.parts(design.params)))[1]


@by_night
def test_name_and_gap_change_the_result_and_a_nest_may_have_settings(tmp_path):
    base = nested(tmp_path, "[cam.nest]\n")
    assert [job.part.name for job in base] == ["nest"]
    assert [one.label for one in base[0].part.placed] == ["gear no 1", "gear no 2"]
    assert [job.part.name for job in nested(tmp_path, "")] == ["gear"]
    assert nested(tmp_path, '[cam.nest]\nname = "both"\n')[0].part.name == "both"
    wide = nested(tmp_path, "[cam.nest]\ngap = 40\n")[0]
    apart = [shapely.distance(*(o.outline.polygon() for o in job.part.placed)) for job in (*base, wide)]
    assert apart[1] == pytest.approx(40, abs=0.01)
    assert apart[0] < 30
    with pytest.raises(DesignError, match="no two plates are alike"):
        nested(tmp_path, '[cam.nest]\n[cam.part.gear]\norigin = "corner"\n')
    (nest,) = nested(tmp_path, '[cam.nest]\n[cam.part.nest]\nwork_offset = "G57"\n')
    assert nest.settings.work_offset == "G57"


def laid(file, parts):
    return arranged(file, settings_of(load(file, host())), parts, LIBRARY)


def names_of(tmp_path, table, *parts):
    file = tmp_path / "pair.toml"
    file.write_text(PAIR + table)
    return [
        [one.label for one in part.placed] if isinstance(part, Nest) else part.name
        for part in laid(file, parts)
    ]


def test_the_named_parts_are_nested_or_all_that_go_together(tmp_path):
    a, b, c = box("a", 30, 20), box("b", 30, 20, 2), box("c", 20, 20)
    thick, other = replace(c, name="thick", thickness=5.0), replace(c, name="other", thickness=5.0)
    steel = replace(c, name="steel", material="steel")
    assert names_of(tmp_path, "", a, b) == ["a", "b"]
    labels = ["a", "b no 1", "b no 2"]
    assert names_of(tmp_path, "[cam.nest]\n", a, steel, b, thick) == [labels, "steel", "thick"]
    found = names_of(tmp_path, "[cam.nest]\n", a, thick, b, other)
    assert found == [labels, ["thick", "other"]]
    assert names_of(tmp_path, '[cam.nest]\nparts = ["a", "c"]\n', a, b, c) == [["a", "c"], "b"]
    with pytest.raises(DesignError, match=r"cam\.nest\.parts: steel is 3 mm steel, a is 3 mm aluminium"):
        names_of(tmp_path, '[cam.nest]\nparts = ["a", "steel"]\n', a, steel)
    deep = replace(a, name="deep", machined=(*a.features, Bore("under", (9.0, 9.0), 4.0, 2.0, 1.0)))
    with pytest.raises(DesignError, match="deep is cut from both sides"):
        names_of(tmp_path, '[cam.nest]\nparts = ["a", "deep"]\n', a, deep)
    with pytest.raises(DesignError, match="201 copies on one plate, at most 200"):
        names_of(tmp_path, "[cam.nest]\n", box("a", 5, 5, 201))


def test_turn_is_asked_for_in_the_table(tmp_path):
    file = tmp_path / "pair.toml"
    angles = []
    for turn in ("true", "false"):
        file.write_text(PAIR + f"[cam.nest]\nturn = {turn}\n")
        parts = [box("long", 100, 20), box("tall", 20, 100)]
        (nest,) = laid(file, parts)
        angles.append([one.angle for one in nest.placed])
    assert any(angles[0])
    assert not any(angles[1])


def test_between_two_channels_a_frame_of_3_mm_stays(tmp_path):
    file = tmp_path / "pair.toml"
    file.write_text(PAIR + "[cam.nest]\n")
    parts = [box("one", 30, 20), box("other", 30, 20)]
    (nest,) = laid(file, parts)
    channel = channel_of(parts, CamSettings(), LIBRARY)
    assert channel > 1
    one, other = (placed.outline.polygon() for placed in nest.placed)
    assert shapely.distance(one, other) == pytest.approx(2 * channel + 3.0, abs=1e-5)


def test_turning_saves_stock():
    parts = [box("long", 100, 20), box("tall", 20, 100)]
    areas = [nest_of("nest", parts, CamSettings(), 10.0, turn=turn).outline.area for turn in (True, False)]
    assert areas[0] < 0.6 * areas[1]


@pytest.mark.parametrize("stock", [{}, {"length": 3000, "width": 1000}])
@pytest.mark.parametrize("travel", [(500, 400), pytest.param((250, 1000), marks=by_night)])
def test_many_parts_are_laid_out_within_the_travel_of_the_machine(stock, travel):
    machine = {"travel_x": travel[0], "travel_y": travel[1]}
    nest = nest_of("nest", [box("link", 60, 24, 30)], CamSettings(machine=machine, stock=stock), 16.0)
    x0, y0, x1, y1 = nest.outline.bounds
    assert x1 - x0 + 16 <= travel[0]
    assert y1 - y0 + 16 <= travel[1]
    # None fits: it is no strip of stock a mile long that is refused.
    many = nest_of("nest", [box("link", 60, 24, 200)], CamSettings(machine=machine, stock={}), 16.0)
    x0, y0, x1, y1 = many.outline.bounds
    assert max(x1 - x0, y1 - y0) < 2 * max(travel)


def test_a_nest_of_parts_that_cannot_be_cut_says_why(tmp_path):
    file = tmp_path / "pair.toml"
    file.write_text(PAIR + "[cam.nest]\n")
    design = load(file, host())
    over = Engraving("mark", (((-8.0, 0.0), (8.0, 0.0)),), 0.2)
    recess = Pocket("recess", rounded_box(10, 8, 3), (), 0.0, 1.5)
    rim = Profile("outside", rounded_box(40, 30, 4), "outside", 0.0, 3.0)
    one = Part(
        "plate",
        Outline(rounded_box(40, 30, 4)),
        3.0,
        "aluminium",
        (Instance("a"), Instance("b")),
        machined=(recess, rim),
        details=(over,),
    )
    found = prepare(design, [one])[0]
    (refusal,) = [f for f in found if f.severity == "error"]
    assert "mark" in refusal.message, refusal
    assert "gap" not in refusal.parameter


PLATE = "[cam.stock]\nlength = 120\nwidth = 90\n"
OWN = '[cam.part.gear]\norigin = "corner"\n'
BAD = {
    '[cam.nest]\nparts = ["gear-9"]\n': "cam.nest.parts: no plate part is named 'gear-9'; there is: gear",
    '[cam.nest]\nparts = ["gear", "gear"]\n': "cam.nest.parts: 'gear' is listed twice",
    '[cam.nest]\nname = "gear"\n': "cam.nest.name: 'gear' is a part",
    '[cam.nest]\nname = "A b"\n': "cam.nest.name: name 'A b' cannot be a file name",
    "[cam.nest]\ngap = -1\n": "cam.nest.gap: -1 should be greater than 0",
    "[cam.nest]\nspace = 1\n": "cam.nest: unknown key 'space'",
    "[cam.nest]\n" + PLATE: "cam.stock: the 2 parts of nest do not fit on 120 x 90 mm",
    "[cam.nest]\ngap = 2\n": "cam.nest.gap: 2.00 mm between the parts of nest leave no frame",
    '[cam.nest]\n[cam.stock]\nfinished = ["left"]\n': "cam.stock.finished: the parts of nest hang by tabs",
    '[cam.nest]\n[cam.hold]\nmethod = "bore"\n': "cam.hold.method: the 2 parts of nest",
    '[cam.nest]\nparts = ["gear"]\n' + OWN: "cam.part.gear: the part is cut in the nest",
    "[cam.part.gear]\nnest = { gap = 3 }\n": "cam.part.gear.nest: holds for the whole job",
}


def told(done):
    """Every line of what the command says, the error that its frame would print included."""
    if isinstance(done.exception, MechwrightError):
        return [*done.stderr.splitlines(), *str(done.exception).splitlines()]
    assert isinstance(done.exception, SystemExit), done.exception
    return done.stderr.splitlines()


@pytest.mark.parametrize("text", BAD)
def test_bad_input_is_one_line(tmp_path, text):
    file = tmp_path / "pair.toml"
    file.write_text(PAIR + text)
    done = CliRunner().invoke(make_app(), ["cam", str(file), "-o", str(tmp_path / "out")])
    assert done.exit_code != 0
    said = told(done)
    assert len([line for line in said if BAD[text] in line]) == 1, said
    assert "Traceback" not in done.output
    assert not (tmp_path / "out").exists()


def test_parts_of_different_thickness_are_refused(tmp_path):
    text = (EXAMPLES / "figure-eight-best.toml").read_text()
    file = tmp_path / "best.toml"
    file.write_text(text + '\n[cam.nest]\nparts = ["gear-2", "coupler"]\n')
    done = CliRunner().invoke(make_app(), ["cam", str(file), "-o", str(tmp_path / "out")])
    assert done.exit_code != 0
    assert "cam.nest.parts: coupler is 6 mm aluminium, gear-2 is 10 mm aluminium" in told(done)[-1]


@needs_rs274
@by_night
def test_the_four_gears_of_the_best_train_on_one_plate(tmp_path):
    text = (EXAMPLES / "figure-eight-best.toml").read_text()
    file = tmp_path / "best.toml"
    file.write_text(text + '\n[cam.nest]\nname = "gears"\nparts = ["gear-2", "gear-3", "gear-4", "gear-5"]\n')
    design = load(file, host())
    findings, jobs = prepare(design, plates_of(design.family.parts(design.params)))
    assert [job.part.name for job in jobs] == ["gears", "coupler", "base"]
    assert [finding.code for finding in findings].count("gear.cut-mesh") == 2  # the family saw all four
    made = machine(jobs[0], POST)
    assert made.proof.ok
    assert made.proof.gouge_max_mm <= TOLERANCES.gouge
    assert made.proof.leftover_reachable_max_mm <= TOLERANCES.leftover
    canon = run_rs274(made.text, tmp_path, POST.tool_table(made.program.tools)[1])
    assert canon.ok, canon.error


def test_the_command_writes_one_program_drawing_and_sheet_and_verifies_them(tmp_path):
    file = tmp_path / "pair.toml"
    file.write_text(PAIR + "[cam.nest]\n")
    out = tmp_path / "out"
    done = CliRunner().invoke(make_app(), ["cam", str(file), "-o", str(out)])
    assert done.exit_code == 0, done.output
    names = {path.name for path in out.iterdir()}
    assert {"nest.nc", "nest.dxf", "nest.setup.html", "setup.html", "gear.dxf"} <= names
    assert not {"gear.nc", "gear.setup.html"} & names
    assert set(json.loads((out / "proof.json").read_text())) == {"nest"}
    sheet = (out / "nest.setup.html").read_text()
    assert "8 tabs of 2 × 1 mm hold the parts to the end" in sheet
    drawing = sheet[sheet.index("Plan view of nest") :].partition("</svg>")[0]
    assert "tab 1" not in drawing, "the names of tabs would hide those of the parts"
    assert drawing.rindex("<path") < drawing.index(">gear no 1<"), "nothing is drawn over the names"
    assert "Nest of 2: gear no 1, gear no 2" in sheet
    assert "the axis of gear no 1" in sheet
    again = CliRunner().invoke(
        make_app(), ["verify", str(out / "nest.nc"), "--design", str(file), "--part", "nest"]
    )
    assert again.exit_code == 0, again.output
    from ezdxf.filemanagement import readfile

    drawn = readfile(out / "nest.dxf").modelspace()
    single = readfile(out / "gear.dxf").modelspace()
    for layer in ("OUTLINE", "BORE", "CENTRE"):
        found = [sum(one.dxf.layer.startswith(layer) for one in space) for space in (drawn, single)]
        assert found[0] == 2 * found[1] > 0, layer
