"""Limits of holes and shafts after ISO 286-2, against values printed in handbooks."""

from typing import get_args

import pytest

from mechwright.contracts.fits import HoleClass, hole_fit, shaft_fit
from mechwright.contracts.limits import grade, limits
from mechwright.errors import DesignError, GeometryError


@pytest.mark.parametrize(
    ("size", "name", "lower", "upper"),
    [
        (3, "H7", 0, 10),
        (6, "H7", 0, 12),
        (6.01, "H7", 0, 15),
        (10, "P7", -24, -9),
        (16, "N7", -23, -5),
        (25, "F7", 20, 41),
        (40, "P7", -42, -17),
        (50, "H7", 0, 25),
        (80, "N7", -39, -9),
        (100, "P7", -59, -24),
        (180, "F7", 43, 83),
    ],
)
def test_limits_are_those_of_the_standard(size, name, lower, upper):
    fit = hole_fit(size, name)
    assert (1000 * fit.lower, 1000 * fit.upper) == pytest.approx((lower, upper), abs=1e-9)
    assert fit.middle == pytest.approx(size + (lower + upper) / 2000, abs=1e-9)


@pytest.mark.parametrize("size", [1, 3, 5, 8, 12, 25, 45, 70, 100, 150])
def test_classes_go_from_loose_to_tight_with_one_width(size):
    fits = [hole_fit(size, name) for name in get_args(HoleClass)]
    assert [fit.middle for fit in fits] == sorted((fit.middle for fit in fits), reverse=True)
    widths = [fit.upper - fit.lower for fit in fits]
    assert widths == pytest.approx([widths[0]] * len(fits), abs=1e-9)


@pytest.mark.parametrize("size", [0, -1, 400.1])
def test_a_size_outside_the_table_is_named(size):
    with pytest.raises(GeometryError, match="no fit for a diameter"):
        hole_fit(size, "H7")


RANGES = (5, 8, 12, 25, 40)
"""Over 3 to 6, 6 to 10, 10 to 18, 18 to 30 and 30 to 50 mm."""


@pytest.mark.parametrize(
    ("name", "printed"),
    {
        "g6": [(-12, -4), (-14, -5), (-17, -6), (-20, -7), (-25, -9)],
        "f7": [(-22, -10), (-28, -13), (-34, -16), (-41, -20), (-50, -25)],
        "h6": [(-8, 0), (-9, 0), (-11, 0), (-13, 0), (-16, 0)],
        "e8": [(-38, -20), (-47, -25), (-59, -32), (-73, -40), (-89, -50)],
        "j6": [(-2, 6), (-2, 7), (-3, 8), (-4, 9), (-5, 11)],
        "k6": [(1, 9), (1, 10), (1, 12), (2, 15), (2, 18)],
        "m6": [(4, 12), (6, 15), (7, 18), (8, 21), (9, 25)],
        "n6": [(8, 16), (10, 19), (12, 23), (15, 28), (17, 33)],
        "p6": [(12, 20), (15, 24), (18, 29), (22, 35), (26, 42)],
        "H7": [(0, 12), (0, 15), (0, 18), (0, 21), (0, 25)],
        "H8": [(0, 18), (0, 22), (0, 27), (0, 33), (0, 39)],
        "J7": [(-6, 6), (-7, 8), (-8, 10), (-9, 12), (-11, 14)],
        "K7": [(-9, 3), (-10, 5), (-12, 6), (-15, 6), (-18, 7)],
        "M7": [(-12, 0), (-15, 0), (-18, 0), (-21, 0), (-25, 0)],
        "N7": [(-16, -4), (-19, -4), (-23, -5), (-28, -7), (-33, -8)],
    }.items(),
)
def test_classes_of_shafts_and_holes_are_those_of_the_standard(name, printed):
    assert [limits(size, name) for size in RANGES] == printed


@pytest.mark.parametrize("size", [1, 3, 5, 8, 12, 25, 45, 70, 100, 150, 200, 300, 400])
def test_shafts_go_from_loose_to_tight_and_grades_from_fine_to_coarse(size):
    shafts = ("d6", "e6", "f6", "g6", "h6", "js6", "k6", "m6", "n6", "p6", "r6", "s6")
    lower = [shaft_fit(size, name).lower for name in shafts]
    assert lower == sorted(lower)
    assert sorted({grade(size, number) for number in range(4, 14)}) == [grade(size, n) for n in range(4, 14)]


@pytest.mark.parametrize("letter", "KMNPRS")
@pytest.mark.parametrize("size", [4, 9, 16, 28, 48])
def test_a_hole_of_grade_7_holds_a_shaft_of_the_next_finer_grade_as_its_like_in_basic_hole_does(size, letter):
    # ISO 286-1: N7/h6 has the same least and greatest interference as H7/n6.
    (hole_low, hole_high), (shaft_low, shaft_high) = limits(size, f"{letter}7"), limits(size, "h6")
    (basic_low, basic_high), (own_low, own_high) = limits(size, "H7"), limits(size, f"{letter.lower()}6")
    assert hole_low - shaft_high == basic_low - own_high
    assert hole_high - shaft_low == basic_high - own_low


@pytest.mark.parametrize("name", ["H3", "x6", "j7", "k8", "JS4", "P10", "R8", "K9", "7H", ""])
def test_a_class_that_the_table_lacks_is_named(name):
    with pytest.raises(DesignError, match="no tolerance class that is known"):
        limits(10, name)
