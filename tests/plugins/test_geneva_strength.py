"""Studs and keys of Geneva drives: the figures of a stud clamped at one end, linearity, and what helps."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.contracts.finding import Severity
from mechwright_geneva.defaults.dimensions import complete, mechanism_of
from mechwright_geneva.family import Geneva
from mechwright_geneva.kinematics.contact_forces import loads
from mechwright_geneva.rules.strength import arm, key_stresses, stud_slopes, stud_stresses

FACTS = {
    fact["name"]: fact["expected"]
    for fact in json.loads((Path(__file__).parents[1] / "data" / "machine.json").read_text())["facts"]
}
Params = Geneva.Params
STRAIGHT = {"law": "straight", "entry_radius": 100.0}
CODES = ("geneva.stud", "geneva.stud-slope", "geneva.key")


def sizes_of(**table):
    return complete(Params(**STRAIGHT | table))


def test_the_stud_is_that_of_the_reference():
    """180 N, 9 mm off, 8 mm thick: scaled to the force that the family finds."""
    sizes = sizes_of(thickness=17.0, axial_gap=0.5, pin_diameter=8.0, construction="through")
    assert arm(sizes) == 9.0
    scale = loads(mechanism_of(sizes)).force / 180
    bending, shear, pressure = stud_stresses(mechanism_of(sizes))
    assert bending.value == pytest.approx(scale * FACTS["stud.bending"], rel=1e-9)
    assert shear.value == pytest.approx(scale * FACTS["stud.shear"], rel=1e-9)
    assert pressure.value == pytest.approx(scale * 180 * (6 * 9 + 4 * 8) / (8 * 64))
    (slope,) = stud_slopes(mechanism_of(sizes))
    # The slope under the load is 3/(2 l) of the deflection.
    assert slope.value == pytest.approx(scale * FACTS["stud.deflection"] * 1.5 / 9 * 1000, rel=1e-9)
    assert (bending.limit, shear.limit) == (120.0, 60.0)


def test_the_contact_gives_the_wheel_the_torque_that_it_takes():
    """At constant speed J θw'' ω² at its greatest, and the load where that is all there is."""
    for table in ({"law": "cycloidal", "entry_radius": 100.0}, STRAIGHT):
        sizes = complete(Params(**table, load_torque=0.0))
        mechanism = mechanism_of(sizes)
        motion = Geneva().solve(Params(**table, load_torque=0.0), 7201)
        alpha = np.abs(motion.channels["alpha_w"].values).max()
        assert loads(mechanism).wheel_torque == pytest.approx(sizes.load_inertia * alpha, rel=2e-3)
    slow = sizes_of(load_torque=3.0, load_inertia=0.0)
    assert loads(mechanism_of(slow)).wheel_torque == pytest.approx(3.0)


@settings(deadline=None, max_examples=15)
@given(st.floats(1e-3, 10), st.sampled_from(["straight", "cycloidal"]))
def test_twice_the_inertia_is_twice_the_stress(inertia, law):
    def at(times):
        sizes = sizes_of(law=law, load_inertia=times * inertia, keyway_width=4.0, bore=12.0, slots=6)
        groups = (stud_stresses, stud_slopes, key_stresses)
        return [stress.value for group in groups for stress in group(mechanism_of(sizes))]

    one, two = at(1), at(2)
    assert len(one) == 6
    assert two == pytest.approx([2 * value for value in one])


def test_keys_of_wheel_and_driver_carry_their_torques():
    sizes = sizes_of(
        load_torque=2.0,
        load_inertia=0.0,
        keyway_width=4.0,
        bore=12.0,
        driver_bore=12.0,
        driver_keyway_width=4.0,
    )
    found = {one.what: one for one in key_stresses(mechanism_of(sizes))}
    # 12 mm, a key of 4 x 4 that stands 1.5 mm out of the shaft, as long as the wheel is thick.
    wheel = found["the wheel's key presses on its hub with"]
    assert wheel.value == pytest.approx(FACTS["key.pressure_hub"] * 2 / 5 * 10 / min(10.0, 1.3 * 12))
    assert wheel.limit == 60.0
    assert "the driver's key is sheared with" in found
    assert key_stresses(mechanism_of(sizes_of())) == []


@pytest.mark.parametrize(
    ("table", "code"),
    [
        ({"load_torque": 200.0}, "geneva.stud"),
        ({"load_torque": 400.0}, "geneva.stud-slope"),
        ({"load_torque": 60.0, "keyway_width": 4.0, "bore": 12.0}, "geneva.key"),
    ],
)
def test_too_much_load_is_told_with_values_that_work(table, code):
    table = STRAIGHT | {"load_inertia": 0.0} | table
    (one,) = [one for one in Geneva().check(Params(**table)) if one.code == code]
    assert one.severity is not Severity.NOTE
    assert one.value > one.limit
    assert one.proposed
    for change in one.proposed:
        better = table | {key.removeprefix("parameters."): value for key, value in change.items()}
        found = Geneva().check(Params(**better))
        assert all(after.severity is Severity.NOTE for after in found if after.code == code)


@pytest.mark.parametrize("law", ["straight", "cycloidal", "modified-sine"])
@pytest.mark.parametrize("slots", [3, 4, 6, 12])
def test_what_a_person_designs_first_bears_its_load(law, slots):
    found = [one for one in Geneva().check(Params(law=law, slots=slots)) if one.code in CODES]
    assert {one.code for one in found} == {"geneva.stud", "geneva.stud-slope"}
    assert {one.severity for one in found} == {Severity.NOTE}
    assert math.isfinite(sum(one.value for one in found))


@pytest.mark.parametrize("changes", [{}, {"speed": 900.0, "pin_diameter": 4.0}])
def test_a_judge_finds_what_a_check_finds_without_what_would_bear_more(changes):
    params = Params(**changes)
    check, judge = Geneva().check(params), Geneva().judge(params)
    said = [(one.code, one.severity, one.message) for one in check if one.severity is not Severity.NOTE]
    assert [
        (one.code, one.severity, one.message) for one in judge if one.severity is not Severity.NOTE
    ] == said
    codes = {"geneva.stud", "geneva.stud-slope", "geneva.key"} & {code for code, _, _ in said}
    assert bool(codes) == bool(changes)
    assert all(any(one.proposed for one in check if one.code == code) for code in codes)
    assert not any(one.proposed for one in judge if one.code in codes)
