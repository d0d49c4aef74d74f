"""Tools that a workshop would not change for nothing, and cutters that fit their holes."""

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from planning_parts import LIBRARY, bore, job, keyed_bore, plate, rounded_box

from mechwright.contracts.fits import hole_fit
from mechwright.contracts.part import Bore
from mechwright_cam.controls.linuxcnc import LinuxCnc
from mechwright_cam.operations.bore import widening
from mechwright_cam.operations.finishing import cut_width
from mechwright_cam.operations.pen import STEEP, Pen
from mechwright_cam.operations.rates import Rates
from mechwright_cam.planning import choose_tools, plan
from mechwright_cam.program.moves import Feed, FeedArc
from mechwright_cam.shop.library import Library
from mechwright_cam.shop.settings import CamSettings

SLOT = rounded_box(40, 8.05, 4.02, clockwise=True)


FEW = Library(tuple(tool for tool in LIBRARY if tool.number <= 100))
"""A crib with drills of few sizes, and no reamers."""


def names(of, library=FEW, **settings):
    return [tool.name for tool in choose_tools(of, CamSettings.model_validate(settings), library)]


def test_a_slot_is_not_cut_by_a_mill_as_wide_as_it():
    program = plan(job(plate(SLOT), "mill-8", "mill-5"))
    tools = {o.name: s.tool.name for s in program.sections for o in s.operations}
    assert tools["opening-1: finish"] == "mill-5"
    assert tools["outside: finish"] == "mill-8"


def test_a_lone_mill_as_wide_as_the_slot_still_cuts_it():
    program = plan(job(plate(SLOT), "mill-8"))
    assert any(o.name.startswith("opening-1") for s in program.sections for o in s.operations)


def test_one_mill_and_one_drill_serve_bores_of_like_size():
    found = names(plate(bore(10, (-15, 0)), bore(8, (15, 0)), material="steel"))
    assert found == ["spot-6", "drill-6", "mill-6", "mill-5"] or found == ["spot-6", "drill-6", "mill-5"]


def test_bores_of_very_different_size_have_their_own_drills():
    found = names(plate(bore(16, (-15, 0)), bore(5, (15, 0)), material="steel"))
    assert [name for name in found if name.startswith("drill")] == ["drill-12", "drill-4"]


@pytest.mark.parametrize(
    ("material", "change", "drilled"), [("aluminium", 12, False), ("steel", 12, True), ("steel", 100, False)]
)
def test_a_hole_is_drilled_if_that_saves_more_than_its_changes(material, change, drilled):
    """In aluminium a helix of 6 in 12 mm takes seconds, and spot drill and drill two changes."""
    found = names(plate(bore(12), material=material), machine={"tool_change": change})
    assert ("drill-10" in found) == ("spot-6" in found) == drilled


def test_where_all_is_drilled_no_mill_is_chosen():
    assert names(plate(machined=(Bore("hole", (0.0, 0.0), 2.0, 0.0, 6.0),))) == ["spot-6", "drill-2"]


def test_holes_that_only_drills_make_keep_their_drills():
    assert {"spot-6", "drill-2"} <= set(names(plate(bore(2, (-15, 0)))))


def test_a_bore_with_a_keyway_is_cleared_by_a_wide_mill_before_the_fine_one():
    """The mill of the keyway alone took half an hour for a bore of 14 mm in 10 mm of steel."""
    of = plate(keyed_bore(14, 5, 16.3), thickness=10.0, material="steel")
    found = [name for name in names(of) if name.startswith("mill")]
    assert found[-1] == "mill-2"
    widest = max(LIBRARY.get(name).diameter for name in found if LIBRARY.get(name).diameter <= 0.7 * 14)
    assert widest >= 5
    program = plan(job(of, *names(of)))
    cleared = next(s.tool for s in program.sections for o in s.operations if o.name == "opening-1: rough")
    assert cleared.diameter == widest


def test_the_spindle_stays_off_between_the_stop_for_the_clamp_and_the_next_tool():
    held = job(
        plate(bore(12)),
        *("spot-6", "drill-5", "mill-10", "mill-6"),
        hold={"method": "bore", "clamp_diameter": 16},
    )
    lines = LinuxCnc().write(plan(held)).splitlines()
    after = lines[lines.index("M0") + 1 :]
    change = next(number for number, line in enumerate(after) if "M6" in line)
    assert not any("M3" in line or "M8" in line for line in after[:change])


def test_the_spindle_starts_again_if_the_tool_stays():
    held = job(plate(bore(12)), "mill-6", hold={"method": "bore", "clamp_diameter": 16})
    lines = LinuxCnc().write(plan(held)).splitlines()
    after = lines[lines.index("M0") + 1 :]
    start = next(number for number, line in enumerate(after) if "M3" in line)
    assert start < next(number for number, line in enumerate(after) if line.startswith("G1"))


def test_wide_bores_are_not_left_to_the_mill_of_a_narrow_one():
    of = plate(bore(3, (-15, 0)), bore(8, (15, 0)), bore(8, (0, 0)), thickness=6)
    program = plan(job(of, *names(of)))
    bored = {o.name: s.tool.name for s in program.sections for o in s.operations}
    assert bored["bore-1: finish"] == "mill-2"
    assert bored["bore-2: finish"] == bored["bore-3: finish"] == "mill-5"


@pytest.mark.parametrize(
    ("count", "change", "pays"), [(1, 0, False), (3, 0, False), (4, 0, True), (4, 90, False), (8, 30, True)]
)
def test_one_more_mill_for_bores_has_to_save_more_than_its_change(count, change, pays):
    """Each of 5 mm takes a third of a minute longer with the mill that another bore asks for anyway."""
    wide = [bore(5, (7 * i - 22, -11)) for i in range(count)]
    found = names(plate(bore(3, (-15, 0)), *wide), machine={"tool_change": change})
    assert "mill-2" in found
    assert ("mill-3" in found) == pays


def test_small_holes_of_a_drills_size_are_drilled_and_those_with_a_fit_are_milled():
    """A mill of 1.2 mm took more than two minutes for each hole of a dowel."""
    of = plate(bore(2, (-15, 0)), bore(2.5, (0, 0)), bore(10, (15, 0)))
    found = names(of)
    assert {"drill-2", "drill-2.5"} <= set(found)
    assert all(LIBRARY.get(name).diameter >= 2 for name in found)
    done = [o.name for s in plan(job(of, *found)).sections for o in s.operations]
    assert {"drill 2", "drill 2.5", "bore-3: bore"} <= set(done)
    assert not {"bore-1: bore", "bore-2: bore"} & set(done)
    plain = plate(bore(2, (-15, 0)))
    fitted = [replace(f, fit=hole_fit(2, "H7")) if isinstance(f, Bore) else f for f in plain.features]
    assert "mill-1.2" in names(replace(plain, machined=tuple(fitted)))
    assert "mill-2" in names(plate(bore(3, (-15, 0))))  # a wide one is milled to size


def test_a_hole_that_a_drill_has_opened_is_widened_in_rings_and_not_on_a_helix():
    """Down in the clear, out on a half circle, once round: 1 mm all round took sixteen turns of a helix."""
    of = plate(bore(12))
    program = plan(job(of, "spot-6", "drill-10", "mill-6"))
    moves = next(o.moves for s in program.sections for o in s.operations if o.name == "bore-1: bore")
    arcs = [move for move in moves if isinstance(move, FeedArc)]
    assert len(arcs) == 3
    assert all(arc.z is None for arc in arcs)
    assert min(move.z for move in moves if isinstance(move, Feed) and move.z is not None) == -6.3


@given(free=st.floats(0.05, 3), more=st.floats(0.01, 8), step=st.floats(0.2, 2))
def test_rings_widen_by_no_more_than_a_step_nor_to_more_than_twice(free, more, step):
    radii = [free, *widening(free, free + more, step)]
    assert radii[-1] == free + more
    for inner, outer in pairwise(radii):
        assert 0 < outer - inner <= min(step, inner) + 1e-3


@given(mill=st.floats(0.5, 8), free=st.floats(0.05, 1), share=st.floats(0.01, 1))
def test_the_width_of_a_ring_is_that_of_the_crescent_it_takes(mill, free, share):
    """The edge of the mill from its outermost point on, looked at point by point."""
    radius = free * (1 + share)
    angle = np.linspace(0, np.pi, 20_001)
    outside = np.abs(radius + mill * np.exp(1j * angle)) >= mill + free
    assert cut_width(radius, mill, mill + free) == pytest.approx(
        mill * (1 - np.cos(angle[outside].max())), abs=1e-3 * mill
    )


@pytest.mark.parametrize("angle", [1.0, 3.0, 20.0])
def test_a_ramp_is_fed_the_faster_the_less_steep_it_is_and_a_steep_one_at_half(angle):
    rates = Rates(10_000, 1000, 500, 250, 5000, 0.03, 1000)
    pen = Pen(LIBRARY.get("mill-6"), rates, 5.0, math.tan(math.radians(angle)))
    steep = min(pen.slope, STEEP)
    assert [pen.ramp_feed(share * steep * 80, 80) for share in (0, 0.2, 0.5, 1, 2)] == [
        1000,
        900,
        750,
        500,
        500,
    ]


def test_a_channel_is_sunk_into_at_the_feed_of_a_cut_but_for_its_share_of_slope():
    """Two of 3 degrees, which takes a third off the feed and not a half; and then around, level."""
    program = plan(job(plate(thickness=6), "mill-6"))
    moves = next(o.moves for s in program.sections for o in s.operations if o.name == "outside: rough")
    feeds = [m.feed for m in moves if isinstance(m, Feed | FeedArc) and m.z is not None and m.x is not None]
    full = next(m.feed for m in moves if isinstance(m, Feed) and m.z is None)
    assert feeds
    assert all(0.6 * full < feed < full for feed in feeds)
