"""Pins, eyes and bushings of planar linkages: forces of the dynamics on the sizes of the parts, and what helps."""

import math
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mechwright.contracts.finding import Severity
from mechwright.mechanics.strength.turning_pair import eye_stresses, pin_stresses
from mechwright_four_bar.family import FourBars
from mechwright_four_bar.rules import strength as four
from mechwright_slider_crank.family import SliderCrankFamily
from mechwright_slider_crank.rules.loads import pairs_of

BAR, SLIDE = FourBars(), SliderCrankFamily()
CODES = {
    BAR: ("four-bar.pin", "four-bar.eye", "four-bar.bushing"),
    SLIDE: ("slider-crank.pin", "slider-crank.eye", "slider-crank.bushing"),
}

SLIDER_STRESSES = SimpleNamespace(
    pins=lambda table: pin_stresses(pairs_of(table)),
    eyes=lambda table: eye_stresses(pairs_of(table)),
)


def of(family, **table):
    return family.Params(**table)


def found(family, **table):
    return {one.code: one for one in family.check(of(family, **table)) if one.code in CODES[family]}


def test_a_slow_slider_crank_carries_its_load():
    """Without inertia the rod carries load over cosine, and the pins what the rod does."""
    params = of(SLIDE, load=-500.0, speed=0.01, pin=4.0)
    pairs = {pair.name: pair for pair in pairs_of(SLIDE.table(params))}
    motion = SLIDE.solve(params, 3601)
    lean = np.abs(np.arcsin((10 - 30 * np.sin(motion.channels["phi"].values)) / 100))
    for name in ("the crank pin", "the wrist pin", "the shaft"):
        assert pairs[name].greatest == pytest.approx(500 / math.cos(lean.max()), rel=1e-4)
    pin = pairs["the wrist pin"]
    assert (pin.pin, pin.width, pin.bore, pin.rim) == (4.0, 6.0, 6.0, 2.0)
    assert pin.arm == pytest.approx(0.3 + 3)
    speed = 0.01 * math.tau / 60
    # The crank pin turns in the rod at crank speed less that of the rod, a third of it at the most.
    assert pairs["the crank pin"].sliding.max() / (speed * 4 / 2000) == pytest.approx(1.3, rel=0.02)
    assert pairs["the shaft"].sliding == pytest.approx(speed * pairs["the shaft"].pin / 2000)


def test_a_slow_four_bar_carries_its_load():
    """Without inertia the coupler pushes the follower with T/(b sin μ)."""
    params = of(BAR, load_torque=5.0, speed=0.01)
    pairs = {pair.name: pair for pair in four.pairs_of(BAR.table(params)).values()}
    places = {name: channel.values for name, channel in BAR.solve(params, 3601).channels.items()}
    a = params.crank * np.exp(1j * places["phi"])
    b = params.ground + params.follower * np.exp(1j * places["psi"])
    # The lever of the coupler's force about B0.
    lever = np.abs(((b - a).conj() * (b - params.ground)).imag) / params.coupler
    most = 5000 / lever.min()
    assert [pairs[name].greatest for name in ("pin A", "pin B")] == pytest.approx([most, most], rel=1e-4)
    assert pairs["shaft A0"].sliding == pytest.approx(0.01 * math.tau / 60 * params.pin_diameter / 2000)
    assert pairs["pin A"].rim == params.rim


@settings(deadline=None, max_examples=8)
@given(st.floats(0.1, 100))
def test_twice_the_load_is_twice_the_stress(load):
    for family, module, key in ((BAR, four, "load_torque"), (SLIDE, SLIDER_STRESSES, "load")):
        one, two = (of(family, **{key: times * load}, speed=0.001) for times in (1, 2))
        for group in (module.pins, module.eyes):
            of_one, of_two = (group(family.table(params)) for params in (one, two))
            assert [stress.value for stress in of_two] == pytest.approx(
                [2 * stress.value for stress in of_one], rel=1e-6
            )


@pytest.mark.parametrize("family", [BAR, SLIDE])
def test_what_a_person_designs_first_bears_its_own_inertia(family):
    notes = found(family)
    assert set(notes) == set(CODES[family])
    assert {one.severity for one in notes.values()} == {Severity.NOTE}


@pytest.mark.parametrize(
    ("family", "table", "code"),
    [
        (BAR, {"load_torque": 100.0}, "four-bar.pin"),
        (BAR, {"load_torque": -150.0}, "four-bar.eye"),
        (BAR, {"load_torque": 40.0, "speed": 600}, "four-bar.bushing"),
        (BAR, {"bushing_wall": 0, "material": "pom", "load_torque": 20.0}, "four-bar.bushing"),
        (SLIDE, {"load": 2000.0, "pin": 4.0}, "slider-crank.pin"),
        (SLIDE, {"load": -2000.0, "pin": 4.0}, "slider-crank.eye"),
        (SLIDE, {"load": 400.0, "speed": 1500}, "slider-crank.bushing"),
    ],
)
def test_too_much_load_is_told_with_values_that_work(family, table, code):
    one = found(family, **table)[code]
    assert one.severity is not Severity.NOTE
    assert one.value > one.limit
    assert one.proposed
    for change in one.proposed:
        values = {key.removeprefix("parameters."): value for key, value in change.items()}
        better = found(family, **table | values)
        assert code not in better or better[code].severity is Severity.NOTE


def test_bare_metal_is_not_judged_by_a_figure_that_nobody_has():
    assert "four-bar.bushing" not in found(BAR, bushing_wall=0)
    assert "slider-crank.bushing" not in found(SLIDE, bushing=0)
