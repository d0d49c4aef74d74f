"""Findings on stresses: note, warning or error by how safe a part is, and values that have been tried."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import Field

from mechwright.contracts.finding import Severity
from mechwright.contracts.parameters import Parameters
from mechwright.mechanics.strength.fastening import stud_bending, stud_pressure
from mechwright.mechanics.strength.judging import STUD_SHARE, Stress, Way, judged, worst
from mechwright.mechanics.strength.turning_pair import (
    TurningPair,
    bush_stresses,
    eye_stresses,
    pin_stresses,
)


class Stud(Parameters):
    """A stud of 10 mm under a force."""

    d: float = Field(8.0, ge=1, le=20)
    force: float = Field(180.0, ge=-1e6, le=1e6)
    left_out: float | None = None


def stresses(params):
    bending = stud_bending(abs(params.force), 10.0, params.d)
    return [Stress("the stud is bent with", bending, 120.0, 355.0)]


def found(params):
    ways = [Way("d", params.d), Way("force", params.force, up=False), Way("left_out", 0.0)]
    return list(judged("a.stud", params, stresses, ways, f"{params.force:g} N"))


def test_a_safe_stress_is_a_note():
    (one,) = found(Stud())
    assert (one.severity, one.code, one.unit) == (Severity.NOTE, "a.stud", "MPa")
    assert one.value == pytest.approx(32 * 180 * 10 / (math.pi * 512))
    assert one.message == "180 N: the stud is bent with 35.81 MPa, 120 allowed"
    assert found(Stud(force=0.0)) == []


@given(st.floats(1.5, 20), st.floats(-1e5, 1e5).filter(lambda force: abs(force) > 1))
def test_what_is_named_works_and_is_the_nearest_that_does(d, force):
    params = Stud(d=d, force=force)
    value = stresses(params)[0].value
    (one,) = found(params)
    assert one.severity is (
        Severity.NOTE if value <= 120.0001 else Severity.WARNING if value <= 355 else Severity.ERROR
    )
    for change in one.proposed:
        ((key, new),) = change.items()
        name = key.removeprefix("parameters.")
        better = params.model_dump() | {name: new}
        assert found(Stud(**better))[0].severity is Severity.NOTE
        bound = "least" if name == "d" or new < 0 else "most"
        assert f"{name} at {bound} {new:g}" in one.remedy
        # A tenth back, and it is too much again.
        again = params.model_dump() | {name: new / 1.12 if name == "d" else new * 1.12}
        assert found(Stud.model_construct(**again))[0].severity is not Severity.NOTE
    if not one.proposed and one.severity is not Severity.NOTE:
        assert stud_bending(abs(force), 10.0, 19.0) > 120
        assert abs(force) / 500 > 120 / stud_bending(1.0, 10.0, d)


def test_an_error_says_from_where_it_fails():
    (one,) = found(Stud(force=-5000))
    assert one.severity is Severity.ERROR
    assert "and it fails from 355" in one.message
    assert one.proposed[1]["parameters.force"] < 0


def test_what_fails_comes_before_what_only_wears():
    wears = Stress("a", 500.0, 100.0)
    fails = Stress("b", 210.0, 120.0, 200.0)
    assert worst([wears, fails]) is fails
    assert worst([wears, Stress("c", 150.0, 120.0, 200.0)]) is wears


def test_a_stud_tilts_in_its_hole():
    """Even pressure without an arm is four times the mean at the mouth, as the moment of half the depth."""
    assert stud_pressure(100, 0, 5, 10) == pytest.approx(4 * 100 / 50)
    # A couple F arm about the middle, 6 M/(d s²), and the force itself, F/(d s).
    arm, depth = 7.0, 12.0
    couple = 6 * 100 * (arm + depth / 2) / (5 * depth**2)
    assert stud_pressure(100, arm, 5, depth) == pytest.approx(couple + 100 / (5 * depth))


PAIR = TurningPair(
    "pin A",
    np.array([400.0, -120.0]),
    np.array([20.0, -10.0]),
    6.0,
    5.0,
    8.0,
    8.0,
    4.0,
    "aluminium",
    bushed=True,
)


def test_the_stresses_of_a_turning_pair():
    shear, bending = pin_stresses([PAIR])
    assert shear.value == pytest.approx(2 * 7.07355302630646)  # one plane, of the reference's two
    assert bending.value == pytest.approx(32 * 400 * 5 / (math.pi * 216))
    (eye,) = eye_stresses([PAIR])
    assert (eye.value, eye.limit) == (400 / 64, STUD_SHARE * 95)
    heat, slip = bush_stresses([PAIR])
    # 400 N at 20 rad/s and 120 N at 10, on 6 by 8 mm: 0.06 and 0.03 m/s.
    assert heat.value == pytest.approx((400 * 0.06 + 120 * 0.03) / 2 / 48)
    assert (slip.value, slip.unit) == (0.06, "m/s")


def test_a_bush_is_that_of_the_reference():
    turning = 200 * math.tau / 60
    pair = TurningPair("b", np.array([120.0]), np.array([turning]), 8, 5, 10, 10, 4, "steel", bushed=True)
    heat, slip = bush_stresses([pair])
    assert heat.value == pytest.approx(0.12566370614359174)
    assert slip.value == pytest.approx(0.08377580409572782)


def test_bare_metal_has_no_figure_and_bare_pom_has_a_low_one():
    bare = [TurningPair(**(vars(PAIR) | {"bushed": False, "plate": name})) for name in ("steel", "pom")]
    assert [one.limit for one in bush_stresses(bare)] == [0.1, 1.0]


@given(st.floats(1e-3, 1e3))
def test_twice_the_force_is_twice_the_stress(force):
    one, two = (TurningPair(**(vars(PAIR) | {"force": np.array([times * force])})) for times in (1.0, 2.0))
    for group in (pin_stresses, eye_stresses):
        for low, high in zip(group([one]), group([two]), strict=True):
            assert high.value == pytest.approx(2 * low.value)
