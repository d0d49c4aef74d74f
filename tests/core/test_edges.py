"""Broken edges: which there are, and what they take, by closed form."""

import math

import pytest
import shapely
from by_night import examples
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.contracts.details import Chamfer
from mechwright.contracts.edges import deburred
from mechwright.contracts.moments import volume
from mechwright.contracts.part import Bore, Part, Pocket, Profile
from mechwright.errors import GeometryError
from mechwright.geometry import Loop, Outline, circle
from mechwright.mechanics.linkage import Boss, hull_link

SQUARE = Loop.polygon([(0, 0), (40, 0), (40, 30), (0, 30)])


def ring(x, y, radius):
    return Loop((circle((x, y), radius),))


def round_bore(x, y, radius):
    return Loop((circle((x, y), radius, clockwise=True),))


def names(part):
    return [detail.name for detail in part.details]


@settings(deadline=None, max_examples=examples(15, 40))
@given(
    length=st.floats(30, 120),
    one=st.floats(5, 12),
    two=st.floats(5, 12),
    width=st.floats(0.05, 1.0),
)
def test_a_link_loses_what_the_formulas_say(length, one, two, width):
    # Smooth rim of length L: a band of L h - pi h^2 at h above the chamfer's foot; a hole: 2 pi r h + pi h^2.
    outline = hull_link([Boss(0j, one, 4.0), Boss(complex(length), two, 5.0)])
    plain = Part("link", outline, 6.0, "steel")
    around = shapely.LinearRing(outline.outer.flatten(1e-7)).length
    rim = around * width**2 / 2 - math.pi * width**3 / 3
    holes = sum(math.pi * (radius * width**2 + width**3 / 3) for radius in (2.0, 2.5))
    taken = volume(plain) - volume(deburred(plain, width))
    assert taken == pytest.approx(rim + holes, rel=2e-4, abs=1e-4)


def test_edges_go_by_the_names_of_their_features_and_an_edge_that_is_broken_keeps_its_own():
    bore = round_bore(30, 10, 4)
    outline = Outline(SQUARE, (round_bore(10, 10, 4), bore))
    machined = (
        Bore("dowel", (10.0, 10.0), 8.0, 0, 5),
        Profile("window", bore, "inside", 0, 5),
        Profile("outside", SQUARE, "outside", 0, 5),
    )
    had = (Chamfer("wide", bore, "inside", 1.0),)
    part = Part("plate", outline, 5.0, "steel", machined=machined, details=had)
    found = deburred(part, 0.3)
    assert names(found) == ["wide", "edge-outside", "edge-dowel"]
    assert deburred(found, 0.3) == found


def test_what_begins_in_a_recess_or_below_the_top_has_no_edge_there():
    outline = Outline(SQUARE, (round_bore(20, 15, 3),))
    island = ring(20, 21, 1.5)
    machined = (
        Bore("bore", (20.0, 15.0), 6.0, 0, 5),
        Pocket("counterbore", ring(20, 15, 9), (island,), 0, 2),
        Pocket("below", ring(35, 25, 3), (), 3, 2),
        Profile("outside", SQUARE, "outside", 0, 5),
    )
    part = Part("plate", outline, 5.0, "steel", machined=machined)
    assert names(deburred(part, 0.3)) == ["edge-outside", "edge-counterbore", "edge-counterbore-island-1"]


def test_an_opening_that_is_no_feature_of_its_own_has_its_edge():
    outline = Outline(SQUARE, (Loop.polygon([(5, 5), (5, 10), (12, 10), (12, 5)]),))
    machined = (Bore("bore", (20.0, 15.0), 6.0, 0, 5), Profile("outside", SQUARE, "outside", 0, 5))
    part = Part("plate", outline, 5.0, "steel", machined=machined)
    assert names(deburred(part, 0.3)) == ["edge-outside", "edge-opening-1"]


@pytest.mark.parametrize(("width", "what"), [(2.0, "counterbore"), (5.0, "outside")])
def test_a_chamfer_that_takes_a_whole_wall_is_refused(width, what):
    machined = (
        Pocket("counterbore", ring(20, 15, 9), (), 0, 2),
        Profile("outside", SQUARE, "outside", 0, 5),
    )
    part = Part("plate", Outline(SQUARE), 5.0, "steel", machined=machined)
    with pytest.raises(GeometryError, match=f"takes all of {what} of part plate"):
        deburred(part, width)
