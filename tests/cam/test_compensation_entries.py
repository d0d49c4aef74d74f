"""Entries of cutter compensation at recesses that are open at the plate's edge: there is air to begin in."""

import math
from dataclasses import replace

import pytest
from by_control import posted, prove
from by_night import thinned
from golden_compensation import WAYS
from planning_parts import LIBRARY, bore, job, plate, rounded_box

from mechwright.contracts.part import Bore, Pocket, Profile
from mechwright.errors import ToolError
from mechwright.geometry import Loop, circle
from mechwright_cam.planning import choose_tools, plan
from mechwright_cam.setup.lay_out import make_job
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import ToolKind

OUTSIDE = Profile("outside", rounded_box(60, 40, 6), "outside", 0, 6.0)
ROUND = Loop((circle((0.0, 0.0), 10.0),))
"""Around (0, 0); the plate ends 20 mm above it."""
SQUARE = rounded_box(16, 16, 3)


RECESSES = {
    "notch": ROUND.moved(0.0, 10.5, 0.0),  # just through the edge
    "most": ROUND.moved(0.0, 14.0, 0.0),
    "half": ROUND.moved(0.0, 20.0, 0.0),  # half of it
    "corner": ROUND.moved(26.0, 16.0, 0.0),  # over a corner
    "square": SQUARE.moved(0.0, 16.0, 0.0),
    "turned": SQUARE.moved(0.0, 16.0, math.pi / 5),
}


@pytest.mark.parametrize(
    ("name", "way", "mill"), thinned(3, [*RECESSES], WAYS, [("mill-4", 0.05), ("mill-8", 0.2)])
)
def test_an_open_recess_is_entered_from_the_air(name: str, way: str, mill: tuple[str, float]) -> None:
    recess = Pocket("recess", RECESSES[name], (), 0.0, 2.0)
    one = job(plate(machined=(recess, OUTSIDE)), mill[0], compensation=way, stock_to_leave=mill[1])
    program = plan(one)
    prove(posted(one, program), one).require()
    assert "recess: finish" in {o.name for section in program.sections for o in section.operations}


def test_the_mill_that_finishes_reaches_into_corners_with_the_largest_d() -> None:
    """By its radius alone mill-1.2 would do for corners of 0.62 mm, but not with 0.1 mm of wear."""
    boxes = {
        0.62: rounded_box(10, 10, 0.62).moved(-12, 0, 0),
        0.56: rounded_box(10, 10, 0.56).moved(12, 0, 0),
    }
    recesses = [Pocket(f"r{radius:g}", loop, (), 0.0, 1.4) for radius, loop in boxes.items()]
    one = job(plate(machined=(*recesses, OUTSIDE)), "mill-6", "mill-1.2", "mill-0.8", compensation="control")
    program = plan(one)
    prove(posted(one, program), one).require()
    last = {o.name: s.tool.name for s in program.sections for o in s.operations if "finish" in o.name}
    assert last["r0.62: finish"] == last["r0.56: finish"] == "mill-0.8"


SMALL = plate(machined=(Pocket("recess", rounded_box(10, 9, 3.2), (), 0.0, 3.0), OUTSIDE))
"""Its corners are clean with a mill of 6 mm, which has no room in it for a straight entry longer than D."""


@pytest.mark.parametrize(("way", "mill"), [("computer", "mill-6"), ("wear", "mill-6"), ("control", "mill-4")])
def test_the_mill_that_is_chosen_has_room_for_its_entry(way: str, mill: str) -> None:
    """No other is added on the way to it: mill-5 has no room either."""
    settings = CamSettings(compensation=way)
    chosen = choose_tools(SMALL, settings, LIBRARY)
    mills = [tool.name for tool in chosen if tool.kind is ToolKind.END_MILL]
    assert mills == list(dict.fromkeys(["mill-6", mill]))
    one = make_job(SMALL, settings, chosen)
    program = plan(one)
    prove(posted(one, program), one).require()
    assert {s.tool.name for s in program.sections for o in s.operations if o.name == "recess: finish"} == {
        mill
    }


def test_of_the_listed_mills_one_with_room_finishes() -> None:
    """The outside stays with the larger one; and where none has room it is refused."""
    one = job(SMALL, "mill-6", "mill-4", compensation="control")
    program = plan(one)
    prove(posted(one, program), one).require()
    mills = {o.name: s.tool.name for s in program.sections for o in s.operations}
    assert mills["recess: rough"] == "mill-6"
    assert mills["recess: finish"] == "mill-4"
    assert mills["outside: finish"] == "mill-6"
    with pytest.raises(ToolError, match="mill-6 has no room for a straight entry"):
        plan(job(SMALL, "mill-6", compensation="control"))


def test_a_wall_that_ends_where_a_bore_begins_is_followed_forwards() -> None:
    """The corner of both lies a hundredth before the start of the wall's last arc, which would go all round."""
    recess = Pocket("recess", rounded_box(8.0168, 8.5694, 3.7307).moved(3.3746, 3.84901, 0), (), 0.0, 5.1)
    of = plate(
        bore(6.5), machined=(Bore("bore", (0.0, 0.0), 6.5, 0.0, 8.0), recess, replace(OUTSIDE, depth=8.0))
    )
    one = job(replace(of, thickness=8.0), "mill-5", "mill-4", "mill-3", compensation="control")
    prove(posted(one), one).require()
