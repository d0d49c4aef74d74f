"""Every linkage of the catalogue is made of plates with its default dimensions."""

import time

import pytest

from mechwright import GeometryError, Severity
from mechwright.mechanics.linkage.kinematics.period import period_of
from mechwright.mechanics.linkage.parts.frames import frames_of
from mechwright.mechanics.linkage.parts.layout import layout_of
from mechwright.mechanics.linkage.parts.parts import parts_of
from mechwright.mechanics.linkage.parts.sizes import Sizes
from mechwright_linkage.catalogue.entries import ENTRIES
from mechwright_linkage.drafts import draft_of
from mechwright_linkage.family import Linkages
from mechwright_linkage.parameters import LinkageParams
from mechwright_linkage.table import LinkageTable

PUBLISHED = {"hoecken", "jansen", "klann"}
"""Their dimensions are published, or a plate on three bars has no such angle: their transmission stays."""


def moved(name, **given):
    table = LinkageTable(LinkageParams(linkage=name, **given))
    return table.linkage, period_of(table, 361).solution.bodies


def swing(name):
    """What a design that begins with an entry says of its swing."""
    return draft_of(name, "").model_dump(include={"swing_from", "swing_to"}, exclude_none=True)


@pytest.mark.parametrize("name", list(ENTRIES))
def test_a_design_that_begins_with_it_is_not_warned(name):
    found = Linkages().check(draft_of(name, ""))
    told = [one.code for one in found if one.severity is not Severity.NOTE]
    assert told == (["linkage.transmission"] if name in PUBLISHED else [])


@pytest.mark.parametrize("name", list(ENTRIES))
def test_it_is_made_of_plates_within_seconds(name):
    linkage, bodies = moved(name, **swing(name))
    start = time.perf_counter()
    layout = layout_of(linkage, Sizes(), bodies)
    assert time.perf_counter() - start < 5.0
    on = {instance.body for part in parts_of(layout) for instance in part.instances}
    assert on <= set(frames_of(layout, bodies))


def test_an_inversor_that_folds_is_refused_within_seconds():
    linkage, bodies = moved("peaucellier", peaucellier={"crank": 40.0})
    start = time.perf_counter()
    with pytest.raises(GeometryError, match=r"meet in plan.*; give the input less range"):
        layout_of(linkage, Sizes(), bodies)
    assert time.perf_counter() - start < 5.0


def test_poles_are_those_of_a_link_that_no_pin_joins_to_the_ground():
    pairs = {name: LinkageParams(linkage=name).pole_pairs for name in ENTRIES}
    assert pairs["watt-2"] == (("link5", "ground"),)
    assert pairs["jansen"] == (("foot", "ground"),)
    assert pairs["whitworth"] == (("rod", "ground"),)
    assert pairs["scotch-yoke"] == (("yoke", "ground"),)
    assert LinkageParams(linkage="watt-2", pairs=(("link6", "crank"),)).pole_pairs == (("link6", "crank"),)
