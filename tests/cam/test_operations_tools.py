"""Cutting data, feeds, deflection, and what each field of a tool changes."""

import math

import pytest
from planning_parts import LIBRARY, job, part, plate, rounded_box
from pydantic import ValidationError

from mechwright.contracts.materials import MATERIALS
from mechwright.contracts.part import Pocket, Profile
from mechwright_cam.operations.bending import MOST, deflection, most_bent, pass_depth
from mechwright_cam.operations.rates import rates
from mechwright_cam.pages.setup_sheet.facts import describe
from mechwright_cam.planning import lay_out, plan
from mechwright_cam.program.moves import FeedArc
from mechwright_cam.shop.library import Library
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool, ToolKind

MILL = LIBRARY.get("mill-2")
DEEP = 5 * MILL.diameter


def codes(tool, thickness=10.0, **of):
    found = lay_out(plate(thickness=thickness, **of), CamSettings(tools=(tool.name,)), Library((tool,)))[1]
    return {finding.code for finding in found}


def changed(tool, **fields):
    return Tool.model_validate({**tool.model_dump(), **fields})


def test_deflection_of_a_plain_rod_is_the_closed_form():
    length, diameter = 30.0, 6.0
    rod = changed(LIBRARY.get("mill-6"), stick_out=length, flute_length=1e-3)
    data, stuff = rod.cutting["steel"], MATERIALS["steel"]
    chip = data.chip_load * math.sqrt(data.step_over)
    teeth = max(1.0, rod.flutes * math.acos(1 - 2 * data.step_over) / math.tau)
    depth = data.step_down * diameter
    force = stuff.force * chip**-stuff.force_exponent * depth * chip * teeth
    inertia = math.pi * diameter**4 / 64
    assert deflection(rod, "steel", 4 * depth, depth) == pytest.approx(
        force * length**3 / (3 * 6.0e5 * inertia), rel=1e-6
    )


def test_passes_of_a_slender_cutter_bend_it_no_more_than_the_rule_allows():
    pocket = Pocket("deep", rounded_box(8, 6, 1.5), (), 0.0, 10.8)
    of = job(
        part(rounded_box(20, 16, 3), thickness=12.0, material="steel", machined=(pocket,)),
        "mill-2",
        stock_to_leave=0.1,
    )
    usual = MILL.cutting["steel"].step_down * MILL.diameter
    assert pass_depth(of, MILL, DEEP) == usual
    step = pass_depth(of, MILL, pocket.depth)
    assert step < usual
    assert deflection(MILL, "steel", pocket.depth, step) == pytest.approx(most_bent(of)) == 0.025
    assert pass_depth(of, MILL, pocket.depth, to_size=True) == pytest.approx(step * MOST / 0.025)
    rough = next(one for section in plan(of).sections for one in section.operations if "rough" in one.name)
    heights = [move.z for move in rough.moves if getattr(move, "z", None) is not None]
    deep = pocket.depth - of.settings.floor_to_leave
    passes = math.ceil(deep / step)
    assert passes > math.ceil(deep / usual)
    wanted = [-deep * (number + 1) / passes for number in range(passes)]
    assert all(min(abs(z - height) for z in heights) < 1e-3 for height in wanted)
    found = lay_out(of.part, CamSettings(tools=("mill-2",), stock_to_leave=0.1), LIBRARY)[1]
    assert [f.code for f in found if f.code.startswith("cam.s") or "def" in f.code] == ["cam.slender"]
    assert "in passes of 0.33 mm instead of 0.5 mm" in found[0].message


def test_a_step_down_that_the_design_says_stays_and_is_warned_of():
    said = CamSettings.model_validate({"tools": ["mill-2"], "cutting": {"mill-2": {"step_down": 0.5}}})
    found = lay_out(plate(thickness=11.0, material="steel"), said, LIBRARY.cutting(said.cutting))[1]
    (warning,) = [f for f in found if f.code == "cam.deflection"]
    assert (warning.parameter, warning.value > warning.limit) == ("cam.cutting.mill-2.step_down", True)
    assert warning.proposed == ({"cam.cutting.mill-2.step_down": None},)


def test_a_cutter_that_bends_whatever_its_passes_is_a_warning():
    weak = changed(MILL, stick_out=60, substrate="hss", flute_length=12)
    assert "cam.deflection" in codes(weak, 11.0, material="steel")
    assert "cam.deflection" not in codes(MILL, 11.0, material="steel")


def test_a_fine_cutter_is_slender_only_where_it_cuts():
    outside = Profile("outside", rounded_box(60, 40, 6), "outside", 0.0, 12.0)

    def said(depth):
        recess = Pocket("mark", rounded_box(14, 10, 1.05), (), 0.0, depth)
        of = part(rounded_box(60, 40, 6), thickness=12.0, machined=(recess, outside))
        chosen = lay_out(of, CamSettings(tools=("mill-6", "mill-2")), LIBRARY)[1]
        return [f.message for f in chosen if f.code in {"cam.slender", "cam.deflection"}]

    assert said(1.0) == [], "it marks the top face, and does not cut through 12 mm of plate"
    assert said(11.0)[0].startswith("mill-2 cuts 11 mm deep, 5.5 diameters")


@pytest.mark.parametrize(
    ("fields", "more"),
    [
        ({"stick_out": 30}, True),
        ({"substrate": "hss"}, True),
        ({"shank_diameter": 6}, False),
        ({"flute_length": 3}, False),
    ],
)
def test_what_stiffens_a_cutter(fields, more):
    base = changed(MILL, stick_out=20)
    bent, usual = (deflection(tool, "steel", DEEP, 0.5) for tool in (changed(base, **fields), base))
    assert bent != pytest.approx(usual)
    assert (bent > usual) == more


@pytest.mark.parametrize(("key", "factor"), [("chip_load", 10), ("chip_load", 0.1), ("cutting_speed", 10)])
def test_a_slip_of_the_decimal_point_is_a_warning(key, factor):
    tool = LIBRARY.get("mill-6")
    data = tool.cutting["steel"]
    wrong = data.model_copy(update={key: getattr(data, key) * factor})
    slipped = tool.model_copy(update={"cutting": {"steel": wrong}})
    assert "cam.cutting-data" in codes(slipped, 6.0, material="steel")
    assert "cam.cutting-data" not in codes(tool, 6.0, material="steel")


def test_high_speed_steel_is_slower():
    assert "cam.cutting-data" in codes(changed(LIBRARY.get("mill-6"), substrate="hss"), 6.0)


def test_the_library_is_within_the_usual_ranges():
    for tool in LIBRARY:
        if tool.kind in (ToolKind.END_MILL, ToolKind.BULL_NOSE, ToolKind.BALL):
            for name, data in tool.cutting.items():
                low, high = MATERIALS[name].speed
                assert low <= data.cutting_speed <= high
                low, high = (share * tool.diameter for share in MATERIALS[name].chip_share)
                assert low <= data.chip_load <= high, (tool.name, name)


def test_chip_thinning_raises_the_feed_but_not_over_the_machine():
    tool, machine = LIBRARY.get("mill-6"), Machine(max_feed=100000)
    plain = rates(tool, "steel", machine)
    thin = rates(tool, "steel", machine, math.radians(30))
    assert thin.feed == pytest.approx(2 * plain.feed, abs=2)
    assert (thin.ramp, thin.plunge, thin.spindle) == (plain.ramp, plain.plunge, plain.spindle)
    assert rates(tool, "steel", Machine(max_feed=300), math.radians(30)).feed == 300


def test_feed_is_reduced_in_tight_inside_corners():
    of = job(plate(rounded_box(30, 20, 4, clockwise=True)), "mill-6")
    (moves,) = [o.moves for s in plan(of).sections for o in s.operations if o.name == "opening-1: finish"]
    full = max(m.feed for m in moves if hasattr(m, "feed"))
    corners = [m for m in moves if isinstance(m, FeedArc) and m.ccw and math.hypot(m.i, m.j) < 1.2]
    assert corners
    for move in corners:  # the edge runs on a larger circle than the centre, at the planned feed
        centre = math.hypot(move.i, move.j)
        # Finishing is fed twice as fast as a full cut, of which a plunge has 0.3.
        assert move.feed == pytest.approx(max(0.3 * full / 2, full * centre / (centre + 3)), abs=1)
    assert max(m.feed for m in corners) < 0.5 * full


@pytest.mark.parametrize(
    ("fields", "message"),
    [
        ({"kind": "bull-nose"}, "corner_radius"),
        ({"corner_radius": 0.5}, "no other tool has one"),
        ({"kind": "bull-nose", "corner_radius": 1.5}, "at most half"),
        ({"kind": "chamfer-mill", "tip_diameter": 2}, "below the diameter"),
        ({"stick_out": 5}, "at least flute_length"),
    ],
)
def test_tools_that_cannot_be(fields, message):
    with pytest.raises(ValidationError, match=message):
        changed(MILL, **fields)


def test_the_setup_sheet_names_kind_and_coating():
    assert describe(changed(LIBRARY.get("mill-6"), coating="TiAlN")) == "end mill ⌀6, TiAlN, 3 flutes"
    assert describe(LIBRARY.get("bull-6-r1")).startswith("bull nose ⌀6")
    assert describe(LIBRARY.get("chamfer-6")) == "chamfer mill ⌀6, 90° point"


def test_the_spindle_slows_down_where_the_machine_feeds_too_slowly():
    mill = LIBRARY.get("mill-12")
    data = mill.cutting["aluminium"]
    full = rates(mill, "aluminium", Machine())
    assert full.chip == data.chip_load
    for share, speed in ((0.8, 0.8), (0.5, 0.5), (0.3, 0.5)):
        slow = rates(mill, "aluminium", Machine(max_feed=share * full.feed))
        assert slow.spindle == pytest.approx(speed * full.spindle, rel=1e-3)
        assert slow.feed == pytest.approx(share * full.feed, abs=1)
        assert slow.chip == pytest.approx(data.chip_load * share / speed, rel=2e-3)
        assert slow.feed == pytest.approx(slow.chip * mill.flutes * slow.spindle, abs=1.1)
