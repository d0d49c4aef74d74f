"""Plates, bars and the words by which things are ordered."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mechwright import DesignError
from mechwright.contracts.materials import MATERIALS
from mechwright.machine.frame.base import HAND, SAG, WEIGHT, base_stock, foot, foot_fixing, least_thickness
from mechwright.mechanics.strength.allowed import allowed
from mechwright.standards.bearings import bearing
from mechwright.standards.couplings import INCH_BORES, coupling_for
from mechwright.standards.dowels import dowel
from mechwright.standards.motors import motor
from mechwright.standards.ordering import inch_length, kinds, order_of
from mechwright.standards.screws import ENGAGEMENT, needs_washer, screw, screw_size, washer
from mechwright.standards.stock import (
    CLEAN_UP,
    InchSize,
    bar_for,
    bar_stock,
    inch_size,
    is_sold,
    plate_for,
    plate_stock,
    plate_within,
)

ALUMINIUM = (1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10, 12, 15, 20, 25, 30, 35, 40, 50)
"""Rolled plates, as a list of dealers has them."""
NAMES = sorted(MATERIALS)


@pytest.mark.parametrize("name", NAMES)
def test_sizes_rise_and_every_material_has_plates_and_bars(name):
    for sizes in (plate_stock(name).thicknesses, bar_stock(name).diameters):
        assert list(sizes) == sorted(set(sizes))
    grades = MATERIALS[name].grades
    assert all((grades.plate, grades.bar, grades.us_plate, grades.us_bar))


def test_thin_plates_are_sold_and_those_of_the_review_are_not():
    assert set(ALUMINIUM) <= set(plate_stock("aluminium").thicknesses)
    assert not any(is_sold(one, "aluminium") for one in (13.5, 14, 10.5))
    assert is_sold(12.7, "aluminium"), "half an inch"


@given(wanted=st.floats(0.5, 49.0), name=st.sampled_from(["aluminium", "steel", "pom"]))
def test_the_plates_next_to_a_thickness_have_it_between_them(wanted, name):
    above, below = plate_for(wanted, name), plate_within(wanted, name)
    assert above >= wanted - 0.005
    assert is_sold(above, name)
    assert not [one for one in plate_stock(name).thicknesses if wanted < one < above]
    if below is not None:
        assert below <= wanted + 0.005
        assert not [one for one in plate_stock(name).thicknesses if below < one < wanted]


def test_a_plate_thicker_than_any_is_refused_with_the_thickest():
    with pytest.raises(DesignError, match="the thickest is 20 mm"):
        plate_for(21, "brass")


@given(diameter=st.floats(3.0, 99.0))
def test_a_bar_leaves_a_cut_unless_its_outside_stays(diameter):
    assert bar_for(diameter, "steel") >= diameter + CLEAN_UP - 0.005
    kept = bar_for(diameter, "steel", turned=False)
    assert kept == diameter or kept >= diameter + CLEAN_UP - 0.005


def test_a_pillar_is_of_a_bar_of_its_own_diameter():
    assert bar_for(12, "steel", turned=False) == 12
    assert bar_for(12, "steel") == 14
    assert bar_for(6 * 1.6, "steel") == 10, "a rounding error of 9.6"
    assert bar_for(12, "pom", turned=False) == 15, "bars of plastics are not drawn"
    assert bar_for(104.0, "steel") == 110


def test_inches_are_the_next_size_above():
    assert inch_size(plate_stock("aluminium").inch, 10).name == "1/2"
    assert inch_size(plate_stock("aluminium").inch, 9.525).name == "3/8"
    assert inch_size(plate_stock("brass").inch, 20) is None


@given(
    width=st.floats(60, 500), length=st.floats(60, 500), name=st.sampled_from(["aluminium", "steel", "pom"])
)
def test_a_base_plate_is_as_stiff_and_as_strong_as_it_has_to_be(width, length, name):
    """Against the beam on two supports with its load in the middle."""
    thick = least_thickness((width, length), name)
    wide, long = sorted((width, length))
    load = HAND + WEIGHT * wide * long
    inertia = wide * thick**3 / 12
    sag = load * long**3 / (48 * MATERIALS[name].modulus * inertia)
    stress = load * long / 4 * (thick / 2) / inertia
    assert sag <= SAG * long * (1 + 1e-9)
    assert stress <= allowed(name).endurance * (1 + 1e-9)
    exact = math.isclose(sag, SAG * long) or math.isclose(stress, allowed(name).endurance)
    assert exact or thick == 8.0


def test_a_base_plate_is_sold_and_has_a_screw_for_its_feet():
    for name in NAMES:
        found = base_stock(8.0, name)
        assert is_sold(found, name)
        assert foot_fixing(found, name).washers >= int(MATERIALS[name].soft)
    assert base_stock(8.0, "aluminium") == 8
    assert base_stock(8.0, "pom") == 10, "no screw goes through 8 mm and a washer"
    with pytest.raises(DesignError, match='set plate_material = "aluminium"'):
        base_stock(18.0, "polycarbonate")


def test_washers_lie_on_plastics_and_over_coarse_holes():
    assert needs_washer(5, 5.8, "steel")
    assert not needs_washer(5, 5.5, "steel")
    assert needs_washer(5, 5.5, "pom")


def test_threads_engage_as_long_as_their_material_asks():
    grades = {"5754": 2.0, "5083": 2.0}
    groups = {"steel": 1.0, "brass": 1.3, "aluminium": 1.5, "pom": 2.5, "polycarbonate": 2.5}
    groups |= {"acrylic": 2.5, "hdpe": 3.0, "plywood": 4.0, "mdf": 5.0}
    assert groups | grades == ENGAGEMENT


@pytest.mark.parametrize(
    ("what", "text", "grade"),
    [
        (screw(4, 10), "hexagon socket head cap screw ISO 4762 M4 x 10, class 8.8", "class 8.8"),
        (
            screw(4, 10, "countersunk"),
            "hexagon socket countersunk screw ISO 10642 M4 x 10, class 8.8",
            "class 8.8",
        ),
        (
            screw(4, 10, "set"),
            "hexagon socket set screw with flat point ISO 4026 M4 x 10, class 45H",
            "class 45H",
        ),
        (washer(5), "plain washer ISO 7089 5 200 HV", "200 HV"),
        (dowel(4, 16), "dowel pin m6, hardened ISO 8734 4 x 16", "hardened steel"),
        (bearing("608"), "deep groove ball bearing 608-2Z", "normal clearance"),
    ],
)
def test_what_is_ordered_is_said_in_words_with_its_grade(what, text, grade):
    found = order_of(what.bought)
    assert (found.text, found.grade) == (text, grade)
    assert found.inch


def test_an_inch_screw_is_as_long_as_the_metric_one_to_half_a_step():
    for size in (3, 4, 5, 6, 8):
        for length in screw_size(size).lengths:
            whole, _, part = inch_length(length).rpartition(" ")
            top, _, bottom = part.partition("/")
            inches = float(whole or 0) + float(top) / float(bottom or 1)
            assert abs(25.4 * inches - length) <= 25.4 / 16 + 1e-9


def test_a_standard_that_is_withdrawn_is_not_ordered():
    assert not {"DIN 127", "DIN 128", "DIN 6797", "DIN 6798"} & set(kinds())


@pytest.mark.parametrize(
    ("lower", "upper", "words"),
    [
        (5, 8, "bores 5 mm and 8 mm, or 5/16 in on a stub of 7.938 mm"),
        (6.35, 10, "bores 1/4 in and 10 mm, or 3/8 in on a stub of 9.525 mm"),
        (6, 6.35, "bores 6 mm and 1/4 in"),
        (5, 6, "bores 5 mm and 6 mm, or 1/4 in on a stub of 6.35 mm"),
    ],
)
def test_a_coupling_by_the_inch_keeps_the_motors_shaft(lower, upper, words):
    found = order_of(coupling_for(lower, upper, 0.3).bought)
    assert found.inch.endswith(f" in, {words}")
    for bore, name in INCH_BORES.items():
        assert abs(InchSize(name).size - bore) < 0.5


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("NEMA 17 - 40", "the same; shaft 5 mm (0.197 in), screws M3 in its face"),
        ("NEMA 23 - 56", "the same; shaft 1/4 in, screws #10-32 through its flange"),
        ("37D 131:1", "the same motor; shaft 6 mm (0.236 in), screws M3 in its face"),
    ],
)
def test_a_motor_by_the_inch_says_its_shaft_and_its_screws(name, words):
    assert order_of(motor(name).bought).inch == words


def test_a_foot_by_the_inch_has_the_thread_of_its_screw():
    assert order_of(foot()).inch == "rubber bumper 3/4 x 5/8 in, thread #10-32 inside"
