"""The table of data that a gear's drawing has."""

import math

import pytest

from mechwright.mechanics.gearing import Rack, Round, Teeth, gear_data


@pytest.mark.parametrize(
    ("z", "module", "x", "thickness"),
    [(12, 2.0, 0.3, 3.578356935), (17, 1.5, 0.4, 2.792958771)],
)
def test_the_profile_shift_follows_from_the_thickness(
    z: int, module: float, x: float, thickness: float
) -> None:
    """Thicknesses on the reference circle as tables of involute gears have them, without backlash."""
    rack = Rack(module, math.radians(20), module * (1 + x), module * (1.25 - x), 0.2 * module, 0.0)
    teeth = Teeth(Round(module * z / 2), rack, z, 0.0, thickness=thickness)
    said = dict(gear_data(teeth))
    assert said["number of teeth"] == f"{z}"
    assert said["module"] == f"{module:g}"
    assert float(said["profile shift"]) == pytest.approx(x, abs=1e-4)
    assert float(said["reference diameter"]) == pytest.approx(module * z)
    assert float(said["tooth on the pitch curve"]) == pytest.approx(thickness, rel=1e-3)


def test_backlash_makes_teeth_thinner_and_no_shift() -> None:
    rack = Rack(2.0, math.radians(20), 2.0, 2.5, 0.4, 0.1)
    assert dict(gear_data(Teeth(Round(20.0), rack, 20, 0.0)))["profile shift"] == "0"
