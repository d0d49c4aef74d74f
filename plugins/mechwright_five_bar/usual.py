"""Sizes of the joints where a design leaves them out."""

from collections.abc import Callable
from typing import Any

import numpy as np

from mechwright.contracts.by_arrays import Designs
from mechwright.mechanics.linkage.usual import Fits, JointSizes, sized
from mechwright.tolerances import falls_short

USUAL = JointSizes(8.0, 4.0, 1.0, 12.0)
"""mm: the defaults of the table."""

DEDENDUM = 1.25
"""Depth of the teeth below the pitch circle, in modules: the basic rack of ISO 53, profile A."""

TEETH = ("crank_teeth", "idler_teeth", "arm_teeth")

BY = (
    *("crank", "arm", "coupler", "rocker", "ground", "module", *TEETH),
    *("coupler_point_x", "coupler_point_y", "running_fit"),
)


def fits(table: Callable[[str], Any]) -> Fits:
    """Whether sizes leave a rim about the bores of links and gears, of parameters by their names."""

    def answer(one: JointSizes) -> Any:
        pin, rim, wall = one.pin_diameter, one.rim, np.asarray(one.bushing_wall)
        turning = pin + np.where(wall > 0, 2 * wall, table("running_fit"))
        short: Any = falls_short(table("crank"), pin + rim) | falls_short(table("arm"), pin + rim)
        short = short | falls_short(table("rocker"), (turning + pin) / 2 + rim)
        short = short | falls_short(table("coupler"), turning + rim)
        for along in (table("coupler_point_x"), table("coupler_point_x") - table("coupler")):
            short = short | falls_short(np.hypot(along, table("coupler_point_y")), (turning + pin) / 2 + rim)
        crank, idler, arm = (np.asarray(table(name)) for name in TEETH)
        module = table("module")
        if module is None:
            module = 2 * table("ground") / (crank + 2 * idler + arm)
        for teeth, bore in ((crank, pin), (idler, turning), (arm, pin)):
            wanting = falls_short(module * (teeth / 2 - DEDENDUM), bore / 2 + rim)
            short = short | wanting & (teeth > 0)
        return ~np.asarray(short)

    return answer


def with_sizes(designs: Designs) -> Designs:
    """Designs with the sizes that each has by itself where they are left out."""
    return sized(designs, USUAL, lambda some: fits(some.__getitem__), BY)
