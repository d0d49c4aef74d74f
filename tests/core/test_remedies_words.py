"""How far values are apart, what is said of a change, and a search that is done again where that is sure."""

import importlib
import math

import pytest
from beam_family import bench, design

from mechwright.remedies.keys import Key
from mechwright.remedies.values import distance
from mechwright.remedies.words import said


def test_how_far_a_value_is_from_another():
    """The logarithm of a ratio; of angles 45 degrees are one; another choice is as far as a double, about."""
    length, angle = (
        Key("parameters.x", "number", -100, 100),
        Key("parameters.a", "number", -180, 180, unit="deg"),
    )
    choice = Key("parameters.c", "choice", choices=("a", "b"))
    for old, new in ((4, 8), (8, 4), (-4, -8)):
        assert distance(length, old, new) == pytest.approx(math.log(2))
    assert distance(length, -4, 8) == pytest.approx(0.7 + math.log(2) / 10)
    assert distance(length, 0, 1e-6) == pytest.approx(0.7)
    assert distance(angle, -10, 35) == distance(angle, 35, -10) == 1.0
    assert [distance(choice, "a", "b"), distance(length, None, 4), distance(length, 4, None)] == [
        0.7,
        1.4,
        0.7,
    ]
    for key, same in ((length, 4), (length, -4), (length, 0), (angle, -10), (choice, "a"), (length, None)):
        assert distance(key, same, same) == 0.0


def test_every_key_of_a_change_is_said_with_what_it_is_now():
    one = bench(design(length=400))
    change = {"parameters.length": 100, "parameters.width": 44, "parameters.collar": None}
    assert (
        said(one, change)
        == "set length = 100 (now 400), width = 44 (now 20.0, by default), leave out collar (now left out)"
    )
    assert said(one, {"parameters.width": 44}) == "set width = 44 (now 20.0, by default)"
    assert said(one, {}) == ""


@pytest.mark.parametrize(("good", "found"), [("rough", "rough"), ("sure", "sure"), ("none", None)])
def test_what_only_looks_as_if_it_builds_is_searched_once_more_where_that_is_sure(good, found, monkeypatch):
    """Of two benches the rough one finds ``rough`` and the sure one ``sure``."""

    class Try:
        def __init__(self, name, sure=None):
            self.name, self.sure = name, sure or self

        def builds(self, change):
            return change["x"] == good

    module = importlib.import_module("mechwright.remedies.nearest")
    monkeypatch.setattr(module, "candidates", lambda of, enough: iter([{"x": of.name}]))
    change = module.nearest(Try("rough", Try("sure")))
    assert change == (None if found is None else {"x": found})
