import math
from enum import StrEnum
from typing import Annotated, Literal

import numpy as np
import pytest
from hypothesis import Phase, find, given, settings
from hypothesis import strategies as st
from pydantic import ConfigDict, Field, ValidationError

from mechwright.contracts.parameters import Parameters
from mechwright.testing import assert_derivative, assert_monotone, assert_points_close, parameters, tables
from mechwright.testing.strategies import rules
from mechwright.testing.variations import variations
from mechwright.units import Millimetres, Ratio
from mechwright_cam.shop.holding import Stock
from mechwright_cam.shop.machine import Machine
from mechwright_cam.shop.settings import CamSettings
from mechwright_cam.shop.tool import Tool

patient = settings(deadline=None)


class Colour(StrEnum):
    RED = "red"
    BLUE = "blue"


class Everything(Parameters):
    width: Millimetres = Field(gt=0, lt=10, description="Open at both ends.")
    depth: Millimetres | None = Field(None, ge=1, le=2, description="May be left out.")
    nested: Annotated[Ratio, Field(ge=-1, le=1)] = Field(0.0, description="Bounds in the type.")
    even: int = Field(4, gt=0, lt=20, multiple_of=2, description="Every other one.")
    mode: Literal["fine", "coarse"] = Field("fine", description="Words.")
    colour: Colour = Field(Colour.RED, description="A choice.")
    climb: bool = Field(True, description="Yes or no.")
    name: str = Field("a", min_length=1, max_length=4, pattern=r"^[a-c]+$", description="Letters.")
    sizes: tuple[Annotated[int, Field(ge=1, le=3)], ...] = Field((1,), min_length=1, description="Some.")
    pair: tuple[bool, Literal["x"]] = Field((True, "x"), description="Two.")
    table: dict[Literal["p", "q"], Annotated[int, Field(ge=0, le=1)]] = Field({}, description="Names.")
    stock: Stock = Field(Stock(), description="A table.")


@patient
@given(tables(Everything))
def test_every_value_is_inside_its_own_bounds(table):
    table.pop("stock", None)  # its own rule ties several of its fields
    Everything.model_validate(table)


@patient
@given(parameters(CamSettings), parameters(Tool), parameters(Machine))
def test_parameters_are_valid_objects(settings_table, tool, machine):
    assert CamSettings.model_validate(settings_table.model_dump()) == settings_table
    assert tool.diameter > 0
    assert machine.spindle_min < machine.spindle_max


@pytest.mark.parametrize(
    "wanted",
    [
        lambda t: t["width"] > 9.9,
        lambda t: t.get("depth", 1) is None,
        lambda t: t.get("depth") == 2,
        lambda t: t.get("even") == 18,
        lambda t: t.get("mode") == "coarse",
        lambda t: t.get("colour") == "blue",
        lambda t: t.get("climb") is False,
        lambda t: t.get("nested", 0) < -0.9,
        lambda t: len(t.get("name", "")) == 4,
        lambda t: t.get("sizes") == [3, 3],
        lambda t: set(t.get("table", ())) == {"p", "q"},
    ],
)
def test_the_whole_range_is_reached(wanted):
    find(
        tables(Everything),
        wanted,
        settings=settings(max_examples=20_000, deadline=None, phases=[Phase.generate]),
    )


def test_the_simplest_design_is_that_of_the_defaults():
    assert find(tables(Stock), lambda _: True) == {}


@pytest.mark.parametrize(
    ("annotation", "words"),
    [
        (int, "Odd.odd has no bounds"),
        (complex, "no strategy for <class 'complex'>"),
        (st.SearchStrategy, "no strategy"),
    ],
)
def test_fields_without_a_strategy_are_named(annotation, words):
    class Odd(Parameters):
        model_config = ConfigDict(arbitrary_types_allowed=True)
        odd: annotation = Field(description="X.")

    with pytest.raises(TypeError, match=words):
        tables(Odd)


def test_rules_of_a_field_in_a_type():
    assert rules(Everything.model_fields["nested"].metadata) == {"ge": -1, "le": 1}


@pytest.mark.parametrize("name", sorted(set(Everything.model_fields) - {"name", "sizes", "pair", "table"}))
def test_variations_are_other_values_that_validation_takes(name):
    start = Everything(width=5)
    good = []
    for value in variations(start, name):
        try:
            good.append(Everything.model_validate({"width": 5, name: value}))
        except ValidationError:
            continue
    assert [other for other in good if other != start]


def test_points_that_are_close():
    assert_points_close([(0, 0)], [(0, 1e-8)])
    assert_points_close(np.empty((0, 2)), np.empty((0, 2)))
    for wrong in ([(0, 1e-6)], [(math.nan, 0)], [(0, 0), (1, 1)]):
        with pytest.raises(AssertionError, match="corners: "):
            assert_points_close(wrong, [(0, 0)], what="corners")


def test_monotone_either_way():
    assert_monotone([1, 2, 5])
    assert_monotone([5, 2, 1])
    for wrong in ([1, 2, 2, 3], [1, 3, 2, 4], [0, math.nan, 1], [1, 1]):
        with pytest.raises(AssertionError, match="neither rising nor falling"):
            assert_monotone(wrong)


@patient
@given(st.integers(20, 400), st.floats(0.1, 3), st.floats(-1e3, 1e3))
def test_a_right_derivative_passes_however_coarse_and_uneven_the_samples(count, rate, offset):
    t = np.linspace(1, 2, count) ** 1.5
    assert_derivative(rate * np.cos(rate * t), np.sin(rate * t) + offset, t)
    assert_derivative(7 * rate * np.cos(rate * t), np.sin(rate * t), t, np.full(count, 7.0))


@patient
@given(st.floats(1e-4, 10) | st.floats(-10, -1e-4))
def test_a_wrong_derivative_fails(error):
    t = np.linspace(0, 2, 201)
    wrong = np.cos(t) + error * np.exp(-(((t - 1) / 0.1) ** 2))
    with pytest.raises(AssertionError, match="the difference quotient says"):
        assert_derivative(wrong, np.sin(t), t)


def test_too_few_samples_for_a_derivative():
    with pytest.raises(AssertionError, match="8 samples are too few"):
        assert_derivative(np.ones(8), np.arange(8.0), np.arange(8.0))
