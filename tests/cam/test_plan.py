import pytest
from by_night import by_night
from planning_parts import LIBRARY, bore, job, keyed_bore, lobes, part, plate, rounded_box
from planning_simulation import check_rules, gouge, leftover, motions

from mechwright.contracts.part import Bore, Pocket, Profile
from mechwright.errors import DesignError, GeometryError, MechwrightError, ToolError
from mechwright.geometry import Loop
from mechwright_cam.planning import plan
from mechwright_cam.planning.prepare import cut_outlines
from mechwright_cam.program.moves import Drill, Feed, FeedArc, Pause, Rapid
from mechwright_cam.setup.lay_out import make_job

TOOLS = ("spot-6", "drill-5", "mill-10", "mill-6")
GEARED = lobes(9, 18.0, 4.0, 900, 1.5)
SMALL = {"method": "bore", "clamp_diameter": 12}
WIDE = {"method": "bore", "clamp_diameter": 60}
NARROW = rounded_box(9, 5, 2, clockwise=True)
HELD = {"hold": {"method": "bore", "clamp_diameter": 16}}


def proven(of):
    program = plan(of)
    assert gouge(of, program) <= 0.001
    assert leftover(of, program) == 0
    check_rules(of, program)
    return program


def moves(program, kind):
    return [m for s in program.sections for o in s.operations for m in o.moves if isinstance(m, kind)]


def heights(program, operation):
    return sorted(
        {
            round(float(m.points[-1, 2]), 3)
            for m in motions(program)
            if operation in m.operation and m.kind != "rapid"
        }
    )


@pytest.mark.parametrize(
    "of",
    [
        job(plate(bore(12)), *TOOLS),
        job(plate(bore(12)), *TOOLS, **HELD),
        job(plate(), "mill-6"),
        job(plate(), "mill-6", climb=False, origin="corner"),
        job(plate(rounded_box(24, 14, 4, clockwise=True)), *TOOLS),
        job(plate(rounded_box(24, 14, 4, clockwise=True)), "mill-10", "mill-3", climb=False),
        job(plate(keyed_bore(14, 5, 16.3)), *TOOLS, "mill-2"),
        pytest.param(job(part(GEARED, bore(8)), *TOOLS, "mill-2"), marks=by_night),
        job(part(GEARED, bore(8)), "mill-6", "mill-2", stock_to_leave=0, hold=SMALL),
        job(part(GEARED, bore(8)), "mill-3", hold=SMALL, stock={"margin": 1}),
        job(plate(bore(3, (10, 5)), bore(3, (-10, 5)), bore(20, (0, -4))), "drill-2.5", *TOOLS, "mill-2"),
    ],
    ids=lambda of: f"{len(of.part.outline.inner)}-{'-'.join(t.name for t in of.end_mills)}",
)
def test_programs_cut_all_and_nothing_else(of):
    proven(of)


def test_inner_features_come_before_the_outside_and_the_clamp_between():
    program = plan(job(plate(bore(12), rounded_box(10, 8, 3, clockwise=True).moved(20, 0)), *TOOLS, **HELD))
    names = [o.name for s in program.sections for o in s.operations]
    clamp = names.index("clamp")
    assert all("outside" not in name for name in names[:clamp])
    assert all("outside" in name for name in names[clamp + 1 :])
    assert len(moves(program, Pause)) == 1
    assert program.clearance == 20
    assert all(m.z in (None, 20, 1) for m in moves(program, Rapid))


def test_one_mill_for_all_needs_no_tool_change():
    program = plan(job(plate(bore(12)), "mill-6"))
    assert len(program.sections) == 1


def test_fewest_tool_changes():
    program = plan(job(plate(bore(12)), *TOOLS))
    assert [s.tool.name for s in program.sections] == ["spot-6", "drill-5", "mill-6", "mill-10"]


def test_bore_is_a_helix_of_real_arcs():
    program = plan(job(plate(bore(12)), "mill-6"))
    helices = [m for m in moves(program, FeedArc) if m.z is not None]
    assert helices
    assert all((m.i**2 + m.j**2) ** 0.5 < 3 for m in helices[:10])


def test_pocket_and_step():
    machined = (
        Pocket("recess", rounded_box(30, 20, 5), (rounded_box(8, 8, 3),), 0.0, 2.0),
        Bore("seat", (0.0, 0.0), 5.0, 0.0, 2.5),
        Profile("outside", rounded_box(60, 40, 6), "outside", 0.0, 6.0),
    )
    of = job(plate(machined=machined), "mill-6", "mill-3")
    program = proven(of)
    assert min(heights(program, "recess")) == -2
    assert min(heights(program, "seat")) == -2.5


@pytest.mark.parametrize(
    ("change", "seen"),
    [
        ({"coolant": "mist"}, lambda p: [s.coolant for s in p.sections]),
        ({"clearance": 9}, lambda p: p.clearance),
        ({"work_offset": "G55"}, lambda p: p.work_offset),
        ({"climb": False}, lambda p: [m.ccw for m in moves(p, FeedArc)][-20:]),
        ({"breakthrough": 0.8}, lambda p: min(heights(p, "outside"))),
        ({"stock_to_leave": 0.4}, lambda p: [m.x for m in moves(p, FeedArc)]),
        ({"spring_passes": 3}, lambda p: len(moves(p, FeedArc))),
        ({"finish_step": 0.3}, lambda p: heights(p, "finish")),
        ({"ramp_angle": 1.0}, lambda p: len(moves(p, FeedArc))),
        ({"origin": "corner"}, lambda p: [m.x for m in moves(p, Rapid)]),
        ({"hold": {"tabs": 3}}, lambda p: len(moves(p, Feed))),
        ({"hold": {"tab_width": 6}}, lambda p: [m.x for m in moves(p, Feed)]),
        ({"hold": {"tab_height": 2}}, lambda p: heights(p, "outside")),
        ({"machine": {"spindle_max": 5000}}, lambda p: max(s.spindle for s in p.sections)),
        ({"machine": {"spindle_min": 11000}}, lambda p: min(s.spindle for s in p.sections)),
        ({"machine": {"max_feed": 300}}, lambda p: max(m.feed for m in moves(p, Feed))),
        ({"stock": {"margin": 30}}, lambda p: p.notes),
        ({"stock": {"length": 110, "width": 90}}, lambda p: p.notes),
    ],
)
def test_every_setting_changes_the_program(change, seen):
    of = plate(bore(12))
    assert seen(plan(job(of, *TOOLS))) != seen(plan(job(of, *TOOLS, **change)))


@pytest.mark.parametrize("change", [{"clamp_diameter": 10}, {"clamp_height": 30}])
def test_clamp_settings_change_the_program(change):
    of = plate(bore(12))
    other = {"hold": HELD["hold"] | change}
    assert plan(job(of, *TOOLS, **HELD)) != plan(job(of, *TOOLS, **other))


@pytest.mark.parametrize(
    ("tool", "change"),
    [
        ("mill-6", {"step_down": 0.2}),
        ("mill-6", {"step_over": 0.1}),
        ("mill-6", {"cutting_speed": 50}),
        ("mill-6", {"chip_load": 0.01}),
        ("drill-5", {"step_down": 0.3}),
        ("drill-5", {"chip_load": 0.01}),
    ],
)
def test_cutting_data_change_the_program(tool, change):
    of = plate(rounded_box(30, 20, 4, clockwise=True), thickness=16)
    tools = [LIBRARY.get(name) for name in TOOLS]
    changed = [
        t.model_copy(
            update={"cutting": t.cutting | {"aluminium": t.cutting["aluminium"].model_copy(update=change)}}
        )
        if t.name == tool
        else t
        for t in tools
    ]
    base = job(of, *TOOLS)
    assert plan(base).sections != plan(make_job(of, base.settings, changed)).sections


def test_deep_holes_are_pecked():
    shallow = moves(plan(job(plate(bore(12)), *TOOLS)), Drill)
    deep = moves(plan(job(plate(bore(12), thickness=18), *TOOLS)), Drill)
    assert [m.peck is None for m in shallow] == [True, True]
    assert [m.peck is None for m in deep] == [True, False]
    assert deep[1].bottom < -18.3
    # Long chips are broken first, and carried out where they would jam; brass breaks its chips by itself.
    mills = ("mill-10", "mill-16", "mill-12")
    deeper = moves(plan(job(plate(bore(12), thickness=30), *TOOLS, *mills[1:])), Drill)
    brass = moves(plan(job(plate(bore(12), thickness=18, material="brass"), *TOOLS)), Drill)
    assert [m.breaking for m in (deep[1], deeper[1])] == [True, False]
    assert deeper[1].peck is not None
    assert brass[1].peck is None


def test_a_mill_that_may_not_plunge_does_not():
    of = plate(bore(12), rounded_box(16, 10, 3, clockwise=True).moved(18, 0))
    base = job(of, "mill-6")
    mill = base.tools[0].model_copy(update={"centre_cutting": False})
    same = make_job(of, base.settings, [mill])
    proven(same)


@pytest.mark.parametrize(
    ("make", "error", "message"),
    [
        (lambda: plan(job(plate(thickness=60), *TOOLS)), ToolError, "cam.tools: no end mill .* flute length"),
        (lambda: plan(job(plate(), "spot-6", "drill-5")), ToolError, "needs an end mill"),
        (lambda: plan(job(plate(bore(3)), "mill-6")), ToolError, "nothing makes bore-1 of 3 mm"),
        (lambda: plan(job(plate(NARROW), "mill-6")), ToolError, "no listed end mill enters opening-1"),
        (
            lambda: plan(job(plate(), "mill-6", stock={"margin": 3})),
            DesignError,
            "cam.stock: a margin of 3.00 mm",
        ),
        (lambda: plan(job(plate(bore(12)), "mill-6", hold=WIDE)), DesignError, "cam.hold.clamp_diameter"),
        (lambda: job(plate(), "mill-6", hold={"method": "bore"}), DesignError, "cam.hold.method"),
        (lambda: job(plate(), "mill-6", stock={"length": 50, "width": 50}), DesignError, "cam.stock"),
        (lambda: job(plate(), "mill-6", hold={"tab_height": 6}), DesignError, "cam.hold.tab_height"),
    ],
)
def test_what_cannot_be_cut_is_one_clear_line(make, error, message):
    with pytest.raises(error, match=message) as caught:
        make()
    assert isinstance(caught.value, MechwrightError)
    assert "\n" not in str(caught.value)


def test_cut_outline_keeps_the_corners_that_no_mill_reaches():
    square = Loop.polygon([(-10, -6), (-10, 6), (10, 6), (10, -6)])
    of = job(plate(square), "mill-10", "mill-6")
    filled = cut_outlines(of)[0].area - of.target.area
    assert filled == pytest.approx((4 - 3.14159265) * 9, rel=1e-3)
    assert cut_outlines(job(plate(bore(12)), *TOOLS))[0].area == pytest.approx(
        of.part.outline.outer.area - 36 * 3.14159265, abs=0.02
    )


def test_a_solid_part_is_refused():
    from mechwright.contracts.part import Part

    with pytest.raises(GeometryError, match="no plate"):
        job(Part("ball", None, 0, "steel", build=lambda: None), "mill-6")


def test_roughing_runs_on_arcs_not_on_their_chords():
    program = plan(job(part(GEARED, bore(8)), *TOOLS, "mill-2"))
    (rough,) = [o for s in program.sections for o in s.operations if o.name == "outside: rough"]
    arcs = sum(isinstance(move, FeedArc) for move in rough.moves)
    assert arcs > len(rough.moves) / 2
