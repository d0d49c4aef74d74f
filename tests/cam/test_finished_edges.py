"""Bar stock with finished edges, in a vice: the outside is milled along its open stretches only."""

import math
from dataclasses import replace

import numpy as np
import pytest
import shapely
from by_control import posted, prove, steps
from by_night import examples
from height_map import Simulation, cutters, read
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from planning_parts import LIBRARY, bore, part, plate, rounded_box
from proving import proven
from rs274 import needs_rs274, run_rs274

from mechwright.contracts.part import Bore, Pocket, Profile
from mechwright.errors import DesignError, MechwrightError
from mechwright.geometry import Arc, Line, Loop
from mechwright_cam.pages.picture import plan_view
from mechwright_cam.planning import choose_tools, plan
from mechwright_cam.planning.setups import lay_out_setups
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.settings import CamSettings
from mechwright_plane.nest import Placed, make_nest

BAR = {"finished": ["front", "rear"]}
VICE = {"method": "vice"}


def link(length=80.0, width=20.0):
    x, y = length / 2, width / 2
    quarter = math.pi / 2
    outer = Loop(
        (
            Line((-x, -y), (x, -y)),
            Arc((x, 0), y, -quarter, math.pi),
            Line((x, y), (-x, y)),
            Arc((-x, 0), y, quarter, math.pi),
        )
    )
    return part(outer, bore(8, (-x, 0)), bore(8, (x, 0)))


def laid(of, *names, **more):
    wanted = CamSettings.model_validate({"stock": BAR, "hold": VICE, **more})
    tools = [LIBRARY.get(name) for name in names] if names else choose_tools(of, wanted, LIBRARY)
    return make_job(of, wanted, tools)


@pytest.mark.parametrize("climb", [True, False])
@pytest.mark.parametrize("names", [("mill-6",), ("mill-8", "mill-4")])
def test_only_the_ends_of_a_link_are_milled(climb, names):
    of = laid(link(), *names, climb=climb)
    assert of.stock[1::2] == pytest.approx((-10, 10), abs=1e-6)
    _, text, _ = proven(of)
    seen = Simulation(of.stock, of.thickness, pitch=0.2)
    moves = [move for move in read(text) if move.operation.startswith("outside")]
    seen.run(moves, cutters(of))
    part_shape = shapely.Polygon(of.target.exterior)
    assert seen.gouge(part_shape, -of.thickness + 0.01) < 0.15  # half of the diagonal of a cell
    away = shapely.box(*of.stock).difference(part_shape.buffer(0.15))
    assert len(seen.left(away, -of.thickness + 0.01)) == 0
    table = seen.table()
    assert not table[table[:, 9] == 1][:, 6].any()  # nothing stands where a cutter is sunk
    assert not seen.complaints
    # No cutter of the outside comes to where the jaws are.
    low = np.concatenate([move.points for move in moves if move.points[:, 2].min() < 0])
    widest = max(tool.radius for tool in of.end_mills)
    (jaw, _) = of.jaws
    assert np.abs(low[:, 0]).min() > jaw.face.bounds[2] + widest * 0.5


def test_finishing_comes_from_the_air_and_leaves_into_it():
    of = laid(link(), "mill-6")
    _, text, _ = proven(of)
    finish = [
        move for move in read(text) if move.operation == "outside: finish" and move.points[:, 2].max() < 0
    ]
    stock, radius = shapely.box(*of.stock), 3.0
    ends = [finish[0].points[0], finish[-1].points[-1]]
    assert all(stock.distance(shapely.Point(end[:2])) > radius + 0.1 for end in ends)


@needs_rs274
def test_linuxcnc_accepts_it(tmp_path):
    of = laid(link(), "mill-6")
    table = "".join(f"T{tool.number} P{tool.number}\n" for tool in of.tools)
    found = run_rs274(posted(of), tmp_path, table)
    assert found.ok, found.error


def test_a_plate_with_three_finished_edges():
    plain = part(Loop.polygon([(0, 0), (60, 0), (60, 30), (0, 30)]))
    of = laid(plain, "mill-4", stock={"finished": ["front", "rear", "left"], "margin": 5})
    assert of.stock == pytest.approx((0, 0, 65, 30))
    program, _, _ = proven(of)
    assert {o.name for s in program.sections for o in s.operations} == {"outside: rough", "outside: finish"}


def test_with_all_edges_finished_no_outside_is_milled():
    square = part(Loop.polygon([(-30, -15), (30, -15), (30, 15), (-30, 15)]), bore(8))
    of = laid(square, "mill-4", stock={"finished": ["front", "rear", "left", "right"]})
    program, text, _ = proven(of)
    assert not any(o.name.startswith("outside") for s in program.sections for o in s.operations)
    assert "(vice: front and rear edges, jaws X-30.00 to X30.00, top Z-3)" in text


def test_the_rest_of_a_given_length_is_at_the_open_end():
    given_length = {"finished": ["left", "front", "rear"], "length": 70, "width": 40}
    assert laid(plate(), "mill-3", stock=given_length).stock == pytest.approx((-30, -20, 40, 20), abs=1e-3)
    on_the_other = {**given_length, "finished": ["right", "front", "rear"]}
    assert laid(plate(), "mill-3", stock=on_the_other).stock == pytest.approx((-40, -20, 30, 20), abs=1e-3)


def test_a_bore_clamp_holds_bar_stock_as_well():
    hold = {"method": "bore", "clamp_diameter": 10}
    of = laid(plate(bore(12)), "mill-6", hold=hold, stock={"finished": ["left", "right"]})
    assert not of.jaws
    proven(of)


def test_every_parameter_changes_the_job_and_the_program_says_so():
    heads = set()
    for hold in (VICE, {**VICE, "grip": 2}, {**VICE, "jaw_width": 40}):
        of = laid(link(), "mill-6", hold=hold)
        heads.add((of.jaws[0].top, round(of.jaws[0].face.length, 3)))
        assert f", top Z{of.jaws[0].top:g})" in proven(of)[1]
    assert len(heads) == 3
    assert {top for top, _ in heads} == {-3.0, -4.0}
    assert 40 in {length for _, length in heads}


def refusal(of, *names, **more):
    with pytest.raises(DesignError) as caught:
        laid(of, *names, **more)
    return str(caught.value)


@pytest.mark.parametrize(
    ("more", "says"),
    [
        ({"hold": {"method": "tabs"}}, "cam.stock.finished: tabs hold part plate in a frame"),
        ({"stock": {}}, "cam.hold.method: a vice grips two opposite finished edges"),
        ({"stock": {"finished": ["front", "left"]}}, "cam.hold.method: a vice grips two opposite"),
        ({"hold": {**VICE, "grip": 7}}, "cam.hold.grip: jaws of 7 mm stand above"),
        ({"hold": {**VICE, "jaw_width": 70}}, "cam.hold.jaw_width: beside what is milled there is room for"),
        (
            {"stock": {**BAR, "length": 120, "width": 21}},
            "cam.stock.width: the front and rear edges are finished",
        ),
        ({"stock": {**BAR, "length": 90, "width": 20}}, "does not fit into"),
    ],
)
def test_what_is_unsafe_is_refused(more, says):
    assert says in refusal(link(), "mill-6", **more)


def test_jaws_that_would_hold_too_little_are_refused():
    assert "the jaws of a vice get" in refusal(link(20.0, 20.0), "mill-6")
    assert "the jaws of a vice get" in refusal(plate(), "mill-16")


def test_advice_to_what_a_vice_cannot_hold_fits_the_part():
    solid, bored = rounded_box(50, 25, 11), bore(12)
    for of, mill, cures in (
        (
            part(solid),
            "mill-6",
            'need 18.7 mm; use a smaller cutter, or leave finished out and use method = "tabs"',
        ),
        (
            part(solid),
            "mill-16",
            "get 0.0 mm on the front and rear edges of part plate and need 18.7 mm",
        ),
        (part(solid, bored), "mill-6", 'use a smaller cutter, or use method = "bore", or leave finished out'),
        (
            part(rounded_box(40, 30, 14), bored),
            "mill-2",
            'need 15.3 mm; use method = "bore", or leave finished',
        ),
    ):
        assert cures in refusal(of, mill, stock={**BAR, "margin": 3})
    narrow = refusal(link(), "mill-6", hold={**VICE, "jaw_width": 20})
    assert narrow.endswith("need 39.3 mm; let jaw_width be at least 39.3 mm"), narrow
    framed = {"stock": {"margin": 1}, "hold": {"method": "tabs"}}
    for of, words in ((part(solid), "use at least 8 mm"), (part(solid, bored), "8 mm, or hold by the bore")):
        with pytest.raises(DesignError) as caught:
            plan(laid(of, "mill-6", **framed))
        assert str(caught.value).endswith(words)


def test_parts_of_a_nest_have_no_finished_edges():
    nest = make_nest("nest", (Placed(plate(), "a", 0, 0), Placed(plate(), "b", 80, 0)), 20.0)
    assert "cannot be clamped one by one" in refusal(nest, "mill-6")


def test_a_part_in_a_vice_has_no_second_side():
    seat = Bore("seat", (0.0, 0.0), 8.0, 4.0, 2.0)
    of = plate(machined=(seat, Profile("outside", rounded_box(60, 40, 6), "outside", 0, 6.0)))
    wanted = CamSettings.model_validate({"stock": BAR, "hold": VICE, "second_side": {"locate": "edges"}})
    _, findings = lay_out_setups(of, wanted, LIBRARY)
    assert any("would be loose by then" in finding.message for finding in findings)


def test_a_groove_across_the_edge_pushes_the_jaws_aside():
    across = Loop.polygon([(-40, -30), (-34, -30), (-34, 30), (-40, 30)])
    outer = link(120.0).outline.outer
    deep, flat = (
        replace(
            part(outer),
            machined=(Pocket("groove", across, (), 0, depth), Profile("outside", outer, "outside", 0, 6)),
        )
        for depth in (5.0, 2.0)
    )
    wide, narrow = laid(flat, "mill-4").jaws[0].face, laid(deep, "mill-4").jaws[0].face
    assert wide.length > narrow.length + 5
    assert narrow.bounds[0] > -34 + 4
    proven(laid(deep, "mill-4"))


def test_a_cutter_or_a_holder_in_a_jaw_is_found():
    of = laid(link(), "mill-6")
    text = posted(of)
    wide = tuple(
        replace(jaw, shape=shapely.box(*np.add(jaw.shape.bounds, (-30, 0, 30, 0)))) for jaw in of.jaws
    )
    (failed,) = [c for c in prove(text, replace(of, jaws=wide)).failures if c.name == "clamp"]
    assert "mm into the rear jaw of the vice" in failed.message or "mm into the front jaw" in failed.message
    stubby = tuple(tool.model_copy(update={"stick_out": 2.0, "flute_length": 2.0}) for tool in of.tools)
    (failed,) = [c for c in prove(text, replace(of, tools=stubby)).failures if c.name == "clamp"]
    assert "the holder of T" in failed.message


def test_jaws_beside_the_part_do_not_hold_it():
    of = laid(link(), "mill-6")
    text = posted(of)
    moved = tuple(
        replace(jaw, face=shapely.transform(jaw.face, lambda p: np.add(p, (30, 0)))) for jaw in of.jaws
    )
    assert "holding" in {check.name for check in prove(text, replace(of, jaws=moved)).failures}


def test_the_sheet_says_where_the_jaws_are():
    of = laid(link(), "mill-6")
    _, first, *_ = steps(of, [24], file_names=["plate.nc"], deepest=-6.3, reach=(-60, -20, 60, 20))
    assert first.title == "Clamp the bar in a vice"
    words = " ".join(first.lines)
    assert "The jaws may reach from X −30.7 to +30.7" in words
    assert "no clamp in there" not in words
    assert plan_view(of).count(">jaw<") == 2


@settings(
    max_examples=examples(3, 12),
    deadline=None,
    suppress_health_check=list(HealthCheck),
    phases=[Phase.explicit, Phase.reuse, Phase.generate],
)
@given(
    ends=st.lists(st.lists(st.floats(0.5, 14), min_size=1, max_size=4), min_size=2, max_size=2),
    width=st.floats(8, 40),
    corner=st.booleans(),
    margin=st.floats(0, 10),
    climb=st.booleans(),
    names=st.sampled_from([(), ("mill-6",), ("mill-4", "mill-2"), ("mill-10", "mill-3")]),
    turned=st.booleans(),
)
def test_any_bar_is_cut_or_refused(ends, width, corner, margin, climb, names, turned):
    """Ends of any form between two straight edges; with a corner or without where they meet these."""
    points = []
    for side, reaches in zip((1, -1), ends, strict=True):
        rows = [0.0, *reaches, 0.0] if corner else reaches
        steps_up = (
            np.linspace(-width / 2, width / 2, len(rows) + 2)[1:-1]
            if not corner
            else np.linspace(-width / 2, width / 2, len(rows))
        )
        row = [(side * (35 + reach), side * y) for reach, y in zip(rows, steps_up.tolist(), strict=True)]
        if not corner:
            row = [(side * 35, -side * width / 2), *row, (side * 35, side * width / 2)]
        points += row
    outer = Loop.polygon([(y, -x) for x, y in points] if turned else points)
    of = part(outer)
    edges = ["left", "right"] if turned else ["front", "rear"]
    try:
        made = laid(of, *names, stock={"finished": edges, "margin": margin}, climb=climb)
        text = posted(made)
    except MechwrightError as error:
        assert str(error).startswith("cam.")  # noqa: PT017
        return
    proof = prove(text, made)
    assert proof.ok, [check.message for check in proof.failures]
