"""What stands beside a narrow channel: strips of stock in slots, and tabs in recesses of nested parts."""

import pytest
import shapely
from planning_parts import LIBRARY, job, part

from mechwright.geometry import Loop
from mechwright_cam.operations.channel import STRIP, channel_of, channel_width
from mechwright_cam.setup.tabs import lay_tabs
from mechwright_plane.nest import Nest, Placed, make_nest

HALF = 20.0
GAP = 6.0


def fork(slot: float) -> list[tuple[float, float]]:
    """A square with a slot so wide, mm, 25 deep from its upper edge."""
    w = slot / 2
    return [
        (-HALF, -HALF),
        (HALF, -HALF),
        (HALF, HALF),
        (w, HALF),
        (w, -5),
        (-w, -5),
        (-w, HALF),
        (-HALF, HALF),
    ]


def standing(slot: float) -> tuple[float, float]:
    """Width of the strip that two passes of a mill leave in a slot, and stock of it that the channel leaves, mm²."""
    mill = LIBRARY.get("mill-2")
    one = job(part(Loop.polygon(fork(slot))), "mill-2")
    shape = shapely.Polygon(fork(slot))
    _, channel = channel_of(one, shape, mill)
    inside = shapely.box(-slot / 2, -3, slot / 2, HALF - 6)
    return slot - 2 * channel_width(one, mill), float(inside.difference(channel).area)


@pytest.mark.parametrize("slot", [5.0, 5.5, 6.0, 6.3])
def test_a_strip_narrower_than_two_mm_goes_with_the_channel(slot: float) -> None:
    wide, left = standing(slot)
    assert 0 < wide < STRIP
    assert left == pytest.approx(0.0, abs=0.1)


def test_a_wider_one_stands_by_itself() -> None:
    wide, left = standing(8.0)
    assert wide > STRIP
    assert left > 17 * STRIP


@pytest.mark.parametrize("slot", [10.0, 16.0])
def test_a_tab_in_a_recess_of_a_nested_part_ends_beside_its_own_wall(slot: float) -> None:
    plate = part(Loop.polygon(fork(slot)))
    nest = make_nest("nest", (Placed(plate, "a", 0, 0), Placed(plate, "b", 60, 0)), GAP)
    assert isinstance(nest, Nest)
    tabs = lay_tabs(job(nest, "mill-2", hold={"tabs": 14}), 99.0)
    inside = [tab for tab in tabs if abs(tab.at[0]) <= slot / 2 + 0.1 and -4 < tab.at[1] < HALF - 3]
    assert len(inside) >= 2
    assert all(GAP / 2 - 0.1 < tab.ends[1] < slot / 2 for tab in inside)
