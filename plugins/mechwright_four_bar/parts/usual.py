"""Sizes of the joints where a design leaves them out."""

from collections.abc import Callable
from typing import Any

import numpy as np

from mechwright.contracts.design_table import number
from mechwright.mechanics.linkage.usual import Fits, JointSizes
from mechwright.tolerances import falls_short

USUAL = JointSizes(6.0, 4.0, 1.0, 10.0)
"""mm: the defaults of the table."""


def bore_about(pin: Any, wall: Any, fit: Any) -> Any:
    """Diameter of a bore in which a pin turns, mm, with or without a bushing, of many designs too."""
    wall = np.asarray(wall)
    return np.asarray(pin + np.where(wall > 0, 2 * wall, fit))


def fits(table: Callable[[str], Any]) -> Fits:
    """Whether sizes leave a rim between the bores of crank, coupler and follower, of parameters by names."""

    def answer(one: JointSizes) -> Any:
        pin, rim = one.pin_diameter, one.rim
        turning = bore_about(pin, one.bushing_wall, table("running_fit"))
        short = falls_short(table("crank"), pin + rim) | falls_short(table("follower"), pin + rim)
        short = short | falls_short(table("coupler"), turning + rim)
        x, y = table("coupler_point_x"), table("coupler_point_y")
        if x is not None and y is not None:
            for along in (x, x - table("coupler")):
                short = short | falls_short(np.hypot(along, y), (turning + pin) / 2 + rim)
        return ~np.asarray(short)

    return answer


def turning_bore(params: Any) -> Any:
    """Diameter of a plate's bore in which a pin turns, mm; a number, or a column of a table."""
    return number(bore_about(params.pin_diameter, params.bushing_wall, params.running_fit))
