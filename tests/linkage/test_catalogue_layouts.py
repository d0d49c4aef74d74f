"""Every linkage of the catalogue is made of plates with its default dimensions."""

import time

import pytest

from mechwright import GeometryError
from mechwright_linkage.catalogue.entries import ENTRIES
from mechwright_linkage.kinematics.linkage_table import LinkageTable
from mechwright_linkage.kinematics.period import period_of
from mechwright_linkage.parameters import LinkageParams
from mechwright_linkage.parts.frames import frames_of
from mechwright_linkage.parts.layout import layout_of
from mechwright_linkage.parts.parts import parts_of
from mechwright_linkage.parts.sizes import Sizes

SWING = {"peaucellier": {"swing_from": -75.0, "swing_to": 75.0}}
"""Its rhombus folds at the end of its range: the pins A and C then meet."""


def moved(name, **given):
    table = LinkageTable(LinkageParams(linkage=name, **given))
    return table.linkage, period_of(table, 361).solution.bodies


@pytest.mark.parametrize("name", list(ENTRIES))
def test_it_is_made_of_plates_within_seconds(name):
    linkage, bodies = moved(name, **SWING.get(name, {}))
    start = time.perf_counter()
    layout = layout_of(linkage, Sizes(), bodies)
    assert time.perf_counter() - start < 5.0
    on = {instance.body for part in parts_of(layout) for instance in part.instances}
    assert on <= set(frames_of(layout, bodies))


def test_an_inversor_that_folds_is_refused_within_seconds():
    linkage, bodies = moved("peaucellier")
    start = time.perf_counter()
    with pytest.raises(GeometryError, match=r"meet in plan.*; give the input less range"):
        layout_of(linkage, Sizes(), bodies)
    assert time.perf_counter() - start < 5.0
