"""Loci of the acceleration pole for a constant ratio: algebraic curves of the degrees of the reference."""

from functools import partial

import pytest
from accelerating_locus import circularity, curve, four_bar, number, slider

THIRD = number(1) / 3


@pytest.mark.parametrize("k", [number(0), THIRD, number(2)], ids=("0", "1/3", "2"))
@pytest.mark.parametrize(
    ("points", "lengths", "plane", "steady", "degree", "fold"),
    [
        (slider, (7, 23, 5), "fixed", (24, 12), 26, 13),
        (slider, (7, 23, 5), "coupler", (28, 14), 28, 14),
        (slider, (7, 23, 0), "coupler", (14, 7), 14, 7),
        (slider, (7, 12, 5), "fixed", (12, 6), 14, 7),
        (slider, (7, 12, 5), "coupler", (16, 8), 16, 8),
        (four_bar, (3, 8, 5, 9), "fixed", (30, 15), 30, 15),
        (four_bar, (3, 7, 5, 9), "fixed", (18, 9), 18, 9),
        (four_bar, (5, 7, 7, 5), "fixed", (12, 6), 12, 6),
    ],
    ids=lambda one: str(one) if isinstance(one, tuple | str) else "",
)
def test_degree_and_circular_points(points, lengths, plane, steady, degree, fold, k):
    wanted = steady if k == 0 else (degree, fold)
    some = partial(points, lengths, k, plane, 1)
    assert curve(some, wanted[0] - 1) is None
    found = curve(some, wanted[0])
    assert found is not None
    assert circularity(found) == wanted[1]
