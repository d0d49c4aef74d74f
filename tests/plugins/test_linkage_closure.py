"""A linkage that closes nowhere names its dyad, where it comes nearest, and lengths that close it."""

import math

import numpy as np
import pytest

from mechwright import Severity
from mechwright_linkage.family import Linkages
from mechwright_linkage.parameters import LinkageParams
from mechwright_linkage.rules.closure import closing_lengths, open_dyad
from mechwright_linkage.table import LinkageTable

SHORT_ROD = {"linkage": "wiper", "wiper": {"rod1": 20.0}}
SHORT_RAM = {"linkage": "crank-shaper", "crank_shaper": {"rod": 5.0}}


def closure(table):
    params = LinkageParams.model_validate(table)
    (found,) = [one for one in Linkages().check(params) if one.severity is Severity.ERROR]
    return found


def changed(table, change):
    found = {key: dict(value) if isinstance(value, dict) else value for key, value in table.items()}
    for key, value in change.items():
        _, inner, name = key.split(".")
        found.setdefault(inner, {})[name] = value
    return LinkageParams.model_validate(found)


def test_a_rod_that_is_too_short_says_where_and_by_how_much():
    found = closure(SHORT_ROD)
    assert found.code == "linkage.closure"
    assert "rod1 and lever1 cannot be put together at B" in found.message
    dyad = open_dyad(LinkageTable.of(LinkageParams.model_validate(SHORT_ROD)))
    entry = LinkageParams.model_validate(SHORT_ROD).entry
    pivot = complex(entry.b0_x, entry.b0_y)
    lever = abs(entry.points()["lever1"]["B"])
    # Nearest where the crank points to the lever's pivot.
    assert math.remainder(dyad.at - np.angle(pivot), math.tau) == pytest.approx(0, abs=math.radians(1))
    assert dyad.missing == pytest.approx(abs(pivot) - entry.crank - lever - 20.0, abs=0.01)
    assert f"{dyad.missing:.4g} mm too short" in found.message


@pytest.mark.parametrize("table", [SHORT_ROD, SHORT_RAM])
def test_every_length_that_is_named_closes_and_half_of_the_change_does_not(table):
    params = LinkageParams.model_validate(table)
    lengths = list(closing_lengths(LinkageTable.of(params)))
    assert lengths
    found = closure(table)
    assert [next(iter(change.values())) for change in found.proposed] == [value for _, value in lengths]
    assert found.remedy.startswith(f"set {params.table_name}.{lengths[0][0]} = ")
    for name, value in lengths:
        before = getattr(params.entry, name)
        key = f"parameters.{params.table_name}.{name}"
        codes = {one.code for one in Linkages().check(changed(table, {key: value}))}
        assert "linkage.closure" not in codes
        half = (before + value) / 2
        assert "linkage.closure" in {one.code for one in Linkages().check(changed(table, {key: half}))}


def test_a_dyad_with_a_slide_is_named_without_a_length():
    found = closure(SHORT_RAM)
    assert "rod and ram cannot be put together at E" in found.message
    assert "mm too" not in found.message
