"""From where parts are measured, and what is measured over pins."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mechwright.contracts.datum import datum_bore, over_pins
from mechwright.contracts.fits import hole_fit
from mechwright.contracts.part import Bore, Part
from mechwright.contracts.tolerance_settings import Tolerances, ToleranceSettings
from mechwright.geometry import Loop, Outline

PLATE = Outline(Loop.polygon([(-200, -200), (200, -200), (200, 200), (-200, 200)]))


def plate(*holes):
    return Part("link", PLATE, 6.0, "steel", machined=holes)


def hole(name, x, y, size, fit="H7"):
    return Bore(name, (x, y), size, 0.0, 6.0, hole_fit(size, fit) if fit else None)


@pytest.mark.parametrize(
    ("holes", "name"),
    [
        ([hole("far", 50, 0, 20), hole("own", 0, 0, 6)], "own"),
        ([hole("large", 50, 0, 20, ""), hole("fitted", 30, 0, 6)], "fitted"),
        ([hole("small", 50, 0, 6), hole("large", 30, 0, 8)], "large"),
        ([hole("far", 50, 0, 6), hole("near", -30, 0, 6)], "near"),
        ([hole("plain", 50, 0, 6, "")], "plain"),
    ],
)
def test_the_datum_is_the_hole_on_the_axis_else_a_fitted_one_else_the_largest(holes, name):
    assert datum_bore(plate(*holes)).name == name
    assert datum_bore(plate(*reversed(holes))).name == name


def test_a_plate_without_a_hole_has_no_datum_hole():
    assert datum_bore(plate()) is None
    assert over_pins(plate(), Tolerances()) == ()


sizes = st.sampled_from([3, 4, 5, 6, 8, 10, 12])


@given(st.floats(-150, 150), st.floats(-150, 150), sizes, sizes, st.floats(0.001, 0.2))
def test_pins_at_their_limits_read_the_limits_of_the_length(x, y, p, q, off):
    if math.hypot(x, y) < 15:
        x += 40
    holes = (hole("a", 0, 0, p), hole("b", x, y, q))
    (found,) = over_pins(plate(*holes), Tolerances(ToleranceSettings(length=off)))
    length = math.hypot(x, y)
    assert found.nominal == pytest.approx(length + (p + q) / 2, abs=1e-4)
    # The distance between the far sides of both pins, each in its hole, is what a calliper reads.
    assert found.nominal == pytest.approx(
        math.dist(
            (-x / length * p / 2, -y / length * p / 2), (x + x / length * q / 2, y + y / length * q / 2)
        ),
        abs=1e-4,
    )
    assert found.greatest - found.nominal == pytest.approx(off, abs=2e-4)
    assert found.nominal - found.least == pytest.approx(off, abs=2e-4)


def test_holes_without_a_fit_and_on_one_axis_are_not_measured_twice():
    holes = (hole("a", 0, 0, 8), hole("b", 30, 0, 6), hole("c", 30, 0, 10), hole("d", 60, 0, 6, ""))
    (found,) = over_pins(plate(*holes), Tolerances())
    assert found.what == "over pins ⌀8 in a and ⌀6 in b"


def test_a_length_beyond_the_general_tolerances_has_no_limits():
    wide = Outline(Loop.polygon([(-10, -10), (2600, -10), (2600, 10), (-10, 10)]))
    part = Part("rail", wide, 6.0, "steel", machined=(hole("a", 0, 0, 8), hole("b", 2500, 0, 8)))
    (found,) = over_pins(part, Tolerances(ToleranceSettings(general="fine")))
    assert (found.least, found.greatest) == (None, None)
