"""Pins in tooth spaces: closed forms, reference numbers, and the outlines of all kinds of gears."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
import shapely
from hypothesis import given
from hypothesis import strategies as st

from mechwright import Measure
from mechwright.errors import GeometryError
from mechwright.mechanics.gearing import Rack, Round, Teeth, gear_loop, gear_measures
from mechwright.mechanics.gearing.over_pins import gauge_pin, pins_in
from mechwright_elliptic_gears.kinematics.ellipse import Ellipse

DATA = json.loads((Path(__file__).parents[1] / "data" / "gear-sizes.json").read_text())


def involute(angle):
    return math.tan(angle) - angle


def angle_of(value):
    """The angle whose involute is the value."""
    low, high = 0.0, math.pi / 2 - 1e-12
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if involute(middle) < value else (low, middle)
    return (low + high) / 2


def spur(z, module, degrees, shift=0.0, backlash=0.0):
    """A gear with profile shift: the same rack, farther out."""
    alpha = math.radians(degrees)
    thinner = backlash - 4 * shift * module * math.tan(alpha)
    rack = Rack(module, alpha, (1 + shift) * module, (1.25 - shift) * module, 0.2 * module, thinner)
    return Teeth(Round(module * z / 2), rack, z, 0.0)


@pytest.mark.parametrize("case", DATA["involute"], ids=lambda case: f"z{case['z']}")
def test_over_pins_of_spur_gears_is_that_of_the_reference(case):
    teeth = spur(case["z"], case["module"], case["alpha"], case["x"], case["pair_backlash"])
    pins = pins_in(teeth, case["pin"])
    assert pins.over(0, int(pins.opposite()[0])) == pytest.approx(case["over_pins"], abs=2e-9)
    assert np.ptp(pins.outside) < 1e-9
    h = 1e-4
    thick, thin = (
        pins_in(
            spur(case["z"], case["module"], case["alpha"], case["x"], case["pair_backlash"] + more),
            case["pin"],
        )
        for more in (-2 * h, 2 * h)
    )
    mate = int(pins.opposite()[0])
    assert (thick.over(0, mate) - thin.over(0, mate)) / (2 * h) == pytest.approx(
        case["dM_per_dthickness"], abs=1e-5
    )


@given(
    z=st.integers(9, 120),
    module=st.floats(0.4, 6),
    degrees=st.floats(14.5, 30),
    shift=st.floats(-0.3, 0.6),
    share=st.floats(0.0, 0.04),
)
def test_pins_of_spur_gears_have_their_closed_form(z, module, degrees, shift, share):
    alpha, backlash, diameter = math.radians(degrees), share * module, 1.728 * module
    pins = pins_in(spur(z, module, degrees, shift, backlash), diameter)
    radius = module * z / 2
    thickness = math.pi * module / 2 + 2 * shift * module * math.tan(alpha) - backlash / 2
    phi = angle_of(
        involute(alpha) + diameter / (2 * radius * math.cos(alpha)) + thickness / (2 * radius) - math.pi / z
    )
    found = np.hypot(*pins.centres.T)
    if np.isfinite(found).all():
        assert found == pytest.approx(radius * math.cos(alpha) / math.cos(phi), rel=1e-9)


@pytest.mark.parametrize("case", DATA["elliptic"], ids=lambda case: f"e{case['eccentricity']}")
def test_pins_of_elliptic_gears_are_those_of_the_reference(case):
    module = case["module"]
    rack = Rack(
        module,
        math.radians(case["alpha"]),
        module,
        1.25 * module,
        0.2 * module,
        case["pair_backlash"],
    )
    ellipse = Ellipse(case["semi_major"], case["eccentricity"])
    pins = pins_in(Teeth(ellipse, rack, case["z"], case["tooth_offset"]), case["pin"])
    for one in case["pins"]:
        x, y = pins.centres[one["space"]]
        assert (x - case["focus_from_middle"], y) == pytest.approx((one["x"], one["y"]), abs=1e-7)
        assert pins.outside[one["space"]] == pytest.approx(one["axis_to_outside_of_pin"], abs=1e-7)
        heights = sorted(pins.heights[one["space"]])
        assert heights == pytest.approx(sorted(one["rack_height_of_contacts"]), abs=1e-6)


@pytest.mark.parametrize("inside", [False, True])
def test_pins_touch_both_flanks_of_the_outline(inside):
    teeth = spur(24, 2.0, 20.0, 0.2, 0.05)
    loop, _ = gear_loop(teeth)
    pins = pins_in(teeth, 3.5, inside=inside)
    gear = shapely.Polygon(loop.flatten())
    centres = shapely.points(pins.centres)
    assert np.abs(shapely.distance(gear, centres) - 1.75).max() < 2e-4
    assert pins.over(0, 12) == pytest.approx(
        2 * np.hypot(*pins.centres[0]) + (-3.5 if inside else 3.5), abs=1e-9
    )


def test_a_pin_that_is_too_large_or_too_small_has_no_place():
    teeth = spur(24, 2.0, 20.0)
    assert np.isnan(pins_in(teeth, 8.0).centres).all()
    assert np.isnan(pins_in(teeth, 1.5).centres).all()
    assert np.isfinite(pins_in(teeth, gauge_pin(2.0)).centres).all()


def test_a_round_gear_is_measured_once_and_its_limits_leave_half_of_the_play():
    teeth = spur(25, 2.0, 20.0, 0.0, 0.08)
    (one,) = gear_measures(teeth)
    assert "over pins ⌀3.5" in one.what
    for sign, size in ((1, one.least), (-1, one.greatest)):
        other = pins_in(spur(25, 2.0, 20.0, 0.0, 0.08 + sign * 2 * 0.02), 3.5)
        assert other.over(0, int(other.opposite()[0])) == pytest.approx(size, abs=1e-6)
    (without,) = gear_measures(spur(25, 2.0, 20.0))
    assert (without.least, without.greatest, without.by) == (None, None, "")


def test_an_elliptic_gear_is_measured_along_and_across_and_from_its_axis():
    ellipse = Ellipse(40.0, 0.4)
    count = 40
    module = ellipse.perimeter / (math.pi * count)
    rack = Rack(module, math.radians(20), module, 1.25 * module, 0.2 * module, 0.05)
    rows = gear_measures(Teeth(ellipse, rack, count, 0.25), (ellipse.focal_distance, 0.0))
    long, short, *axis = rows
    assert long.nominal - short.nominal == pytest.approx(2 * (40 - 40 * math.sqrt(1 - 0.16)), abs=0.1)
    assert len(axis) == 4
    assert all(one.least < one.nominal < one.greatest for one in rows)
    assert all("axis to the far side of a pin" in one.what for one in axis)


def test_the_frame_of_the_part_turns_what_is_told_alone():
    teeth = spur(24, 2.0, 20.0, 0.0, 0.05)
    one, two = (gear_measures(teeth, turn=turn)[0] for turn in (0.0, math.pi / 2))
    assert (one.nominal, one.least) == (two.nominal, two.least)
    assert "97.5°" in two.what
    assert "7.5°" in one.what


def test_a_measure_is_within_its_limits():
    with pytest.raises(GeometryError, match=r"is not within 10\.1 to 10\.2 mm"):
        Measure("width", 10.0, 10.1, 10.2)
