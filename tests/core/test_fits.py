"""Limits of holes after ISO 286-2, against values printed in handbooks."""

from typing import get_args

import pytest

from mechwright.contracts.fits import HoleClass, hole_fit
from mechwright.errors import GeometryError


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


@pytest.mark.parametrize("size", [0, -1, 180.1])
def test_a_size_outside_the_table_is_named(size):
    with pytest.raises(GeometryError, match="no fit for a hole"):
        hole_fit(size, "H7")
