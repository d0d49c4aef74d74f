import math
from typing import ClassVar

import numpy as np
import pytest
from mechwright_scotch_yoke.family import ScotchYoke, ScotchYokeParams, StrokeRequirement

from mechwright.contracts.finding import errors
from mechwright.testing import FamilyContract, assert_points_close


class TestScotchYoke(FamilyContract):
    family = ScotchYoke
    examples = ({}, {"crank_radius": "2 in", "speed": "10 rad/s", "stem_width": 30, "pin_diameter": 12})
    refused = (
        ({"crank_radius": 9.0, "stem_width": 4}, "crank_radius"),
        ({"stem_width": 40.0}, "stem_width"),
        ({"load": 5000.0}, "pin_diameter"),
        ({"clearance": 0.0}, "clearance"),
        ({"colour": "red"}, "colour"),
    )
    derivatives = (
        ("theta", "omega"),
        ("x", "velocity"),
        ("velocity", "acceleration"),
        ("acceleration", "jerk"),
    )
    input_rate = "omega"
    requirements: ClassVar = {"stroke": ({}, {"stroke": "3 in", "peak_velocity": "1 m/s"})}


def codes(**table: float) -> set[str]:
    return {finding.code for finding in ScotchYoke().check(ScotchYokeParams(**table))}


def test_the_dead_centres_are_a_stroke_apart():
    x = ScotchYoke().solve(ScotchYokeParams(crank_radius=35), 3).channels["x"].values
    np.testing.assert_allclose(x, [35, -35, 35])


def test_the_wanted_stroke_and_velocity_are_what_the_motion_has():
    family, wanted = ScotchYoke(), StrokeRequirement(stroke=60, peak_velocity=12)
    (found,) = family.synthesise("stroke", wanted, print).candidates
    motion = family.solve(found.params, 721)
    assert np.ptp(motion.channels["x"].values) == pytest.approx(60)
    assert np.abs(motion.channels["velocity"].values).max() == pytest.approx(12 / 60 * 1000)


@pytest.mark.parametrize(
    ("wanted", "parameter"),
    [({"stroke": 4, "peak_velocity": 1}, "crank_radius"), ({"peak_velocity": 300}, "speed")],
)
def test_a_stroke_that_cannot_be_had_is_refused_with_the_limit(wanted, parameter):
    result = ScotchYoke().synthesise("stroke", StrokeRequirement(**wanted), print)
    assert result.candidates == ()
    assert parameter in {finding.parameter for finding in errors(result.findings)}


def test_the_pin_touches_nothing_but_the_flanks_of_the_slot():
    import shapely

    params = ScotchYokeParams()
    _, yoke = ScotchYoke().parts(params)
    motion = ScotchYoke().solve(params, 25)
    pin = np.array([[params.crank_radius, 0.0, 0.0]])
    seen = motion.poses["crank"].transform(pin)[:, 0] - motion.poses["yoke"].position
    assert_points_close(seen[:, 0], np.zeros(25), 1e-12, "the pin is always in the middle of the slot")
    slot = yoke.outline.polygon().interiors[0]
    room = shapely.distance(shapely.points(seen[:, :2]), slot) - params.pin_diameter / 2
    np.testing.assert_allclose(room, params.clearance / 2, atol=2e-3)


@pytest.mark.parametrize("table", [{}, {"rim": 5, "stem_width": 30, "clearance": 0.5}])
def test_the_formula_of_the_yokes_mass_is_that_of_its_outline(table):
    params = ScotchYokeParams(**table)
    _, yoke = ScotchYoke().parts(params)
    kilograms = yoke.outline.area * params.yoke_thickness * 8.5e-6
    scalars = ScotchYoke().solve(params, 3).scalars
    assert scalars["yoke_mass"].value == pytest.approx(kilograms, rel=1e-9)
    force = params.load + kilograms * params.crank_radius / 1000 * (4 * math.pi) ** 2
    assert scalars["peak_force"].value == pytest.approx(force, rel=1e-9)


@pytest.mark.parametrize(
    ("table", "code"),
    [
        ({"crank_radius": 10.99, "stem_width": 4}, "scotch-yoke.crank-web"),
        ({"stem_width": 32.01}, "scotch-yoke.stem-width"),
        ({"load": 3700.0}, "scotch-yoke.pin-bending"),
        ({"load": 500.0}, "scotch-yoke.slot-pressure"),
    ],
)
def test_each_limit_is_found_and_only_where_it_is_passed(table, code):
    assert code in codes(**table)
    assert code not in codes()


def test_remedies_help():
    params = ScotchYokeParams(load=5000, rim=20)
    (bending,) = (f for f in ScotchYoke().check(params) if f.code == "scotch-yoke.pin-bending")
    assert bending.value == pytest.approx(32 * 5000 * 3.5 / (math.pi * 8**3), rel=1e-2)
    assert "scotch-yoke.pin-bending" not in codes(load=5000, pin_diameter=9.2)
