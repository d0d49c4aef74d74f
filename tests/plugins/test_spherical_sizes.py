"""Pins, bosses and links that a design leaves out have room; what it gives stays."""

import pytest

from mechwright import Stage
from mechwright.contracts.finding import errors
from mechwright_spherical.defaults.complete_parameters import CompleteParams
from mechwright_spherical.defaults.preferred_sizes import NAMES, USUAL, least_boss
from mechwright_spherical.family import Spherical

FAMILY = Spherical()


def sizes(params):
    return tuple(getattr(params.hardware, name) for name in NAMES)


def test_the_usual_sizes_are_the_defaults():
    assert sizes(CompleteParams()) == tuple(getattr(USUAL, name) for name in NAMES)
    assert sizes(CompleteParams(kind="four-bar")) == sizes(CompleteParams())


@pytest.mark.parametrize(
    ("table", "pin"),
    [
        ({"radius": 62}, 6.0),
        ({"radius": 60}, 5.0),
        ({"radius": 40}, 4.0),
        ({"radius": 30}, 3.0),
        ({"radius": 25}, 2.5),
        ({"five_bar": {"projection_length": 8}}, 5.0),
        ({"five_bar": {"projection_length": 12.5}}, 3.0),
    ],
)
def test_a_small_machine_has_the_largest_pins_that_have_room(table, pin):
    params = CompleteParams(**table)
    assert params.hardware.pin_diameter == pin
    assert not errors(FAMILY.check(params), Stage.PARTS)
    noted = [one.message for one in FAMILY.check(params) if one.code == "spherical.sizes"]
    assert [f"pin_diameter = {pin:g}" in one for one in noted] == [True] * (pin != 6.0)
    larger = next((x for x in (6.0, 5.0, 4.0, 3.0) if x > pin and x - pin <= 1), None)
    if larger:
        thick = CompleteParams(**table, hardware={"pin_diameter": larger, "boss_diameter": 2 * larger})
        assert errors(FAMILY.check(thick), Stage.PARTS)


def test_what_is_given_stays():
    given = CompleteParams(radius=60, hardware={"boss_diameter": 8})
    assert given.hardware.boss_diameter == 8
    assert given.hardware.pin_diameter <= 6
    thick = CompleteParams(kind="four-bar", hardware={"pin_diameter": 11})
    assert thick.hardware.pin_diameter == 11
    assert thick.hardware.boss_diameter >= least_boss(11, thick.hardware.fit)
    assert not errors(FAMILY.check(thick), Stage.PARTS)
    refused = CompleteParams(radius=40, hardware={"pin_diameter": 6, "boss_diameter": 12, "link_width": 8})
    assert sizes(refused) == (6, 12, 8)
    assert errors(FAMILY.check(refused), Stage.PARTS)


def test_where_no_sizes_have_room_they_are_the_usual_ones():
    assert sizes(CompleteParams(radius=10)) == sizes(CompleteParams())


def test_sizes_that_were_chosen_count_as_left_out():
    params = CompleteParams(radius=40)
    assert not params.hardware.model_fields_set
    assert CompleteParams(**params.model_dump(exclude_unset=True)) == params
