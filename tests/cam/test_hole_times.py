"""Times of holes by which drills are chosen: down a ramp with the largest mill that has room, or drilled."""

import math

import pytest
from planning_parts import LIBRARY, bore, job, part, rounded_box

from mechwright_cam.operations.drilling import starting_drill
from mechwright_cam.operations.hole_times import holes_time
from mechwright_cam.operations.ladder import COME
from mechwright_cam.operations.rates import rates

OUTSIDE = rounded_box(80, 60, 6)
MILLS = ("mill-10", "mill-6", "mill-3")


def opened(width: float, *tools: str) -> float:
    """Time for an opening of this width, s."""
    return holes_time(job(part(OUTSIDE, rounded_box(30.0, width, 0.45 * width, clockwise=True)), *tools))


def ramped(name: str) -> float:
    """Down to below a plate of 6 mm on ramps of 3 degrees, s."""
    of = job(part(OUTSIDE), *MILLS, ramp_angle=3.0)
    mill = LIBRARY.get(name)
    ramp = rates(mill, "aluminium", of.settings.machine).ramp
    return 60 * -of.floor / math.sin(math.radians(min(3.0, mill.ramp_angle or 3.0))) / ramp


@pytest.mark.parametrize(
    ("width", "name"), [(15.0, "mill-10"), (9.0, "mill-6"), (4.5, "mill-3"), (4.0, "mill-3")]
)
def test_an_opening_takes_a_ramp_of_the_largest_mill_with_room_or_of_the_finest(
    width: float, name: str
) -> None:
    assert opened(width, *MILLS) == pytest.approx(ramped(name), rel=1e-6)


def test_a_hole_is_drilled_through_with_its_point() -> None:
    drill = LIBRARY.get("drill-8")
    of = job(part(OUTSIDE, bore(8.0, (15.0, 0.0)), bore(8.0, (-15.0, 0.0))), "spot-6", "drill-8", *MILLS)
    down = -of.floor + drill.diameter / 2 / math.tan(math.radians(drill.point_angle / 2))
    each = 2.0 + COME + 60 * down / rates(drill, "aluminium", of.settings.machine).feed
    assert holes_time(of) >= 2 * each
    # An opening that is wider than the drill and what it leaves to finishing begins with its hole.
    assert opened(12.0, "spot-6", "drill-8", *MILLS) == pytest.approx(each, rel=1e-6)


@pytest.mark.parametrize(
    ("diameter", "name"), [(9.0, "drill-8"), (8.99, "drill-6"), (7.0, "drill-6"), (6.9, "")]
)
def test_a_drill_starts_a_hole_if_it_leaves_its_allowance(diameter: float, name: str) -> None:
    """Half a millimetre on either side: what is asked for is left, to the last digit, and no less."""
    of = job(part(OUTSIDE), "spot-6", "drill-8", "drill-6", *MILLS, stock_to_leave=0.5)
    drill = starting_drill(of, diameter, 6.0)
    assert (drill.name if drill else "") == name
