"""Entries of cutter compensation at recesses that are open at the plate's edge: there is air to begin in."""

import math

import pytest
from golden_compensation import WAYS
from planning_parts import job, plate, rounded_box

from mechwright.geometry import Loop, circle
from mechwright.part import Pocket, Profile
from mechwright_cam.planning import plan
from mechwright_cam.posts import LinuxCncPost
from mechwright_cam.proof import prove

OUTSIDE = Profile("outside", rounded_box(60, 40, 6), "outside", 0, 6.0)
ROUND = Loop((circle((0.0, 0.0), 10.0),))
"""Around (0, 0); the plate ends 20 mm above it."""
SQUARE = rounded_box(16, 16, 3)


@pytest.mark.parametrize(("mill", "leave"), [("mill-4", 0.05), ("mill-8", 0.2)])
@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize(
    "loop",
    [
        ROUND.moved(0.0, 10.5, 0.0),  # just through the edge
        ROUND.moved(0.0, 14.0, 0.0),
        ROUND.moved(0.0, 20.0, 0.0),  # half of it
        ROUND.moved(26.0, 16.0, 0.0),  # over a corner
        SQUARE.moved(0.0, 16.0, 0.0),
        SQUARE.moved(0.0, 16.0, math.pi / 5),
    ],
    ids=["notch", "most", "half", "corner", "square", "turned"],
)
def test_an_open_recess_is_entered_from_the_air(loop: Loop, way: str, mill: str, leave: float) -> None:
    recess = Pocket("recess", loop, (), 0.0, 2.0)
    one = job(plate(machined=(recess, OUTSIDE)), mill, compensation=way, stock_to_leave=leave)
    program = plan(one)
    prove(LinuxCncPost().write(program), one).require()
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
    prove(LinuxCncPost().write(program), one).require()
    last = {o.name: s.tool.name for s in program.sections for o in s.operations if "finish" in o.name}
    assert last["r0.62: finish"] == last["r0.56: finish"] == "mill-0.8"
