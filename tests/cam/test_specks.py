"""What rounding leaves where cuts overlap is no stock, however far from a wall it lies."""

import pytest
import random_outcomes
import shapely
from by_control import prove
from by_night import by_night
from golden_operations import made

from mechwright_cam.proof.plane import SNAP, without_specks


@pytest.mark.parametrize("wide", [SNAP / 4, SNAP * 4])
def test_a_speck_is_thinner_than_numbers_tell(wide: float) -> None:
    strip = shapely.box(0, 0, 3, wide)
    assert without_specks(strip).is_empty == (wide < SNAP)
    both = without_specks(shapely.union_all([strip, shapely.box(5, 5, 6, 6)]))
    assert both.bounds[2:] == (6, 6)
    assert both.bounds[0] == (5 if wide < SNAP else 0)


def test_a_ridge_on_a_floor_is_stock() -> None:
    """The second ring of a recess, left out, leaves one that is 0.05 mm wide and more."""
    one = made("pocket-contour", "linuxcnc")[0]
    text = one.text.replace("X-6.5985 Y-2.6 F2346\nX6.6\nY2.5997\nX-6.5995 Y2.5983\n", "")
    assert text != one.text
    assert not prove(text, one.job).checks["leftover"].passed


@by_night
def test_a_recess_of_the_underside_with_a_speck_in_its_middle() -> None:
    assert random_outcomes.run("underside-rim", 7015).failures == []
