"""Bushes of a train: what they are pressed into, what stands still, and what is refused."""

import tomllib
from pathlib import Path

import pytest

from mechwright import host
from mechwright.contracts.finding import Severity, errors
from mechwright.contracts.fits import hole_fit
from mechwright.designs.design import design_of
from mechwright.remedies import tried

EXAMPLE = Path(__file__).parents[2] / "examples" / "figure-eight-machine.toml"


def design(**parameters):
    table = tomllib.loads(EXAMPLE.read_text())
    table["parameters"] |= parameters
    table["parameters"] = {key: value for key, value in table["parameters"].items() if value is not None}
    del table["machine"]
    return design_of(table, Path("bushes.toml"), "", host())


def bores(part):
    return {bore.name: bore for bore in part.features if hasattr(bore, "centre")}


@pytest.mark.parametrize(
    ("changes", "bushed", "on_shaft"),
    [
        ({}, {"gear-3", "gear-4", "gear-5", "axis-2"}, {"shaft-4", "shaft-5"}),
        ({"phase_joint": "clamp"}, {"gear-3", "gear-5", "axis-2"}, {"shaft-4", "shaft-5"}),
        ({"phase_joint": None, "phases": None}, {"gear-5", "axis-2", "base"}, {"shaft-5"}),
    ],
)
def test_bushes_are_where_something_turns_and_shafts_that_stand_still_are_pressed_in(
    changes, bushed, on_shaft
):
    found = design(**changes)
    parts = {part.name: part for part in found.parts()}
    here = [at for part in parts.values() if part.name.startswith("bush-") for at in part.instances]
    assert {at.body for at in here} == bushed
    assert len(here) == len(bushed)
    press = hole_fit(16, "H7")
    for body in bushed & set(parts):
        if body.startswith("gear"):
            assert bores(parts[body])["bore"].fit == press
    base = bores(parts["base"])
    assert base["shaft-2"].fit == press
    assert (base["shaft-4"].fit == press) == ("base" in bushed)
    assert (base["shaft-5"].fit.name, base["shaft-5"].fit.size) == ("H7", 12)
    for name in ("shaft-4", "shaft-5"):
        (first, *_) = parts[name].turned.steps
        assert (first.fit.name == "r6", first.length == 20) == ((name in on_shaft,) * 2)


@pytest.mark.parametrize(
    ("changes", "fix"),
    [
        ({"bore": 13, "keyway_width": 5}, {"parameters.bore": 12}),
        ({"base_thickness": 6}, {"parameters.base_thickness": 8}),
        ({"thickness": 7}, {"parameters.thickness": 8}),
        (
            {"bore": 5, "keyway_width": None, "keyway_relief": None, "stub_diameter": None, "phases": (90,)},
            {"parameters.bushes": None},
        ),
    ],
)
def test_what_no_bush_fits_is_refused_with_a_change_that_was_tried(changes, fix):
    found = design(**changes)
    (one,) = [told for told in tried(found, found.check()) if told.severity is Severity.ERROR]
    assert (one.code, one.fix) == ("train.bush", fix)
    assert errors(found.changed(fix).check()) == []
