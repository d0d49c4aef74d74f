"""Where tabs stand beside recesses that reach the rim."""

import math

import pytest
import shapely
from by_control import asked, posted, prove
from planning_parts import job, part, rounded_box

from mechwright.contracts.part import Part, Pocket, Profile
from mechwright.contracts.sections import plan_view
from mechwright.errors import DesignError
from mechwright.geometry import Loop, Outline, circle

RIM = rounded_box(60, 40, 4)


def stepped(deep, **hold):
    """A plate of 6 mm with a step at the place of its rim where the first tab would stand."""
    step = Pocket("step", Loop.polygon([(16, -30), (36, -30), (36, -14), (16, -14)]), (), 0.0, deep)
    whole = part(RIM, machined=(step, Profile("outside", RIM, "outside", 0.0, 6.0)))
    return step, job(whole, "mill-6", hold=hold)


@pytest.mark.parametrize("shape", ["rectangular", "ramped"])
def test_tabs_move_on_where_they_would_stand_up_in_a_recess(shape):
    hold = {"tabs": 2, "tab_shape": shape}
    _, shallow = stepped(4.0, tab_height=1.0, **hold)
    step, deep = stepped(5.5, tab_height=1.0, **hold)
    assert shapely.intersects(plan_view(step), shallow.tabs[0].shape) or shape == "ramped"
    assert not any(shapely.intersects(plan_view(step), tab.shape) for tab in deep.tabs)
    for of in (shallow, deep):
        proof = prove(posted(of), of)
        assert proof.ok, [check.message for check in proof.failures]


def test_where_all_of_the_rim_is_low_the_height_is_named():
    face = Pocket("face", rounded_box(80, 60, 1), (), 0.0, 5.2)
    whole = part(RIM, machined=(face, Profile("outside", RIM, "outside", 0.0, 6.0)))
    with pytest.raises(
        DesignError, match=r"cam\.hold\.tab_height: .* would stand up in face, .* use at most 0\.8 mm"
    ):
        job(whole, "mill-6", hold={"tab_height": 1.0})
    low = job(whole, "mill-6", hold={"tab_height": 0.8})
    assert prove(posted(low), low).ok


@pytest.mark.parametrize(("deep", "height"), [(4.5, 1.0), (5.2, 0.8), (5.6, 0.4)])
def test_tabs_whose_height_is_left_out_are_as_low_as_the_rim(deep, height):
    face = Pocket("face", rounded_box(80, 60, 1), (), 0.0, deep)
    low = job(part(RIM, machined=(face, Profile("outside", RIM, "outside", 0.0, 6.0))), "mill-6")
    assert low.settings.hold.tab_height == pytest.approx(height)
    assert {round(tab.top, 6) for tab in low.tabs} == {height - 6}
    assert prove(posted(low), low).ok


def test_no_tab_is_chosen_that_would_break():
    face = Pocket("face", rounded_box(80, 60, 1), (), 0.0, 5.7)
    with pytest.raises(DesignError, match=r"would stand up in face, which leaves 0\.3 mm"):
        job(part(RIM, machined=(face, Profile("outside", RIM, "outside", 0.0, 6.0))), "mill-6")


@pytest.mark.parametrize("wall", [0.2, 0.6, 2.0])
def test_behind_a_thin_wall_tabs_end_at_its_opening(wall):
    """They reach 1 mm under the rim elsewhere; in the opening of a ring the program cuts them off rightly."""
    rim, hole = circle((0, 0), 20.0), circle((0, 0), 20.0 - wall, clockwise=True)
    ring = Part("ring", Outline(Loop((rim,)), (Loop((hole,)),)), 4.0, "aluminium")
    of = job(ring, "mill-6", hold={"tabs": 4})
    for tab in of.tabs:
        inner = 20.0 - shapely.distance(tab.shape, shapely.Point(0, 0))
        assert inner == pytest.approx(min(wall, 1.0), abs=0.03)
    assert asked("tabs", posted(of), of).passed


@pytest.mark.parametrize(("through", "angle"), [(0.1, 20), (0.6, 20), (1.2, 12)])
def test_a_ramped_tab_begins_where_no_cutter_gets_around_it_as_low_as_it_goes(through, angle):
    """In a disc the chord of its base, drawn out to where the cutters are below the underside, is in the part."""
    radius, width, high, slope = 40.0, 3.0, 1.0, math.tan(math.radians(angle))
    disc = part(Loop((circle((0, 0), radius),)))
    hold = {"tabs": 3, "tab_shape": "ramped", "tab_angle": angle, "tab_width": width, "tab_height": high}
    of = job(disc, "mill-6", hold=hold, breakthrough=through, ramp_angle=20)
    half = width / 2 + (high + through) / slope
    deep = radius - math.sqrt(radius**2 - half**2)
    steps = math.ceil(math.log(deep, 1.25) - 1e-9)
    for tab in of.tabs:
        assert tab.width == width
        assert -tab.ends[0] == pytest.approx(1.25 ** max(steps, 0))
        assert -tab.ends[0] >= deep


@pytest.mark.parametrize(
    ("tabs", "width", "height", "radius"), [(4, 60, 60, 20.0), (2, 80, 50, 24.9), (2, 100, 40, 19.9)]
)
def test_long_tabs_stand_on_straight_walls_where_they_begin_farthest_out(tabs, width, height, radius):
    """At a corner they would have to begin 1.5 to 2 mm inside of the part; on a straight wall it is 1 mm."""
    hold = {"tabs": tabs, "tab_shape": "ramped", "tab_angle": 10}
    of = job(part(rounded_box(width, height, radius)), "mill-6", hold=hold)
    assert [tab.ends[0] for tab in of.tabs] == [-1.0] * tabs
