"""Tabs of a part with deep corners stand where they lead to the frame, and elsewhere where they always did."""

import math

import numpy as np
import pytest
import shapely
from planning_parts import job, lobes, part, rounded_box
from test_many_corners import star

from mechwright_cam.setup.tab_places import led_out
from mechwright_cam.shop.tool import widest_mill

MILLS = ("mill-10", "mill-6", "mill-3", "mill-1")
SHAPES = {
    "star of 30": star(30, 100.0, 80.0),
    "small star": star(30, 50.0, 40.0),
    "star of 17": star(17, 60.0, 40.0),
    "twelve lobes": lobes(12, 60.0, 30.0, points=600),
}


@pytest.mark.parametrize("name", SHAPES)
def test_every_tab_ends_behind_the_widest_cut(name: str) -> None:
    made = job(part(SHAPES[name]), *MILLS)
    assert len(made.tabs) == made.settings.hold.tabs
    for tab in made.tabs:
        (x, y), (tx, ty), out = tab.at, tab.along, tab.ends[1]
        end = shapely.Point(x + out * ty, y - out * tx)
        assert shapely.distance(end, made.target) >= widest_mill(made.tools) - 1e-9


@pytest.mark.parametrize("name", SHAPES)
def test_they_stay_all_around(name: str) -> None:
    """None is moved past the middle to the next one: the part is held on every side."""
    made = job(part(SHAPES[name]), *MILLS)
    turns = np.sort([math.atan2(tab.at[1], tab.at[0]) for tab in made.tabs])
    gaps = np.diff(np.append(turns, turns[0] + math.tau))
    assert gaps.max() < math.tau / len(turns) * 1.75 + 0.1


def test_where_all_lead_out_none_is_moved() -> None:
    ring = shapely.LinearRing(rounded_box(60, 40, 6).flatten())
    row = [ring.length * n / 4 for n in range(4)]
    assert led_out(ring, row, 2.0, 13.0, 10.0) == row


def test_where_none_leads_out_all_stay() -> None:
    ring = shapely.LinearRing(rounded_box(60, 40, 6).flatten())
    row = [ring.length * n / 4 for n in range(4)]
    assert led_out(ring, row, 2.0, 5.0, 10.0) == row
