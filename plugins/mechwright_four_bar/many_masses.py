"""Masses of the links of many four-bars, as :mod:`mechwright_four_bar.parts.layout` draws them.

What no layer decides: the plates of crank and coupler, and with ``frame = "two"``, where it has a shaft of
its own, that of the follower.
"""

from collections.abc import Collection
from typing import Any

import numpy as np

from mechwright import material
from mechwright.contracts.by_arrays import Answer, Designs
from mechwright.contracts.mass import KILOGRAMS
from mechwright.contracts.masses import OF_PART
from mechwright.mechanics.linkage.areas import circle_area, hull_area, straight_area
from mechwright.mechanics.linkage.outlines import FILLET
from mechwright_four_bar.parts.sizes import OF_BORE
from mechwright_four_bar.parts.usual import bore_about


def give_masses(found: Answer, columns: Collection[str], designs: Designs) -> None:
    """Give the masses of links that are asked for and need no layers."""
    pin, turning = designs["pin_diameter"], bore_about(*(designs[name] for name in OF_BORE))
    small, large = pin / 2 + designs["rim"], turning / 2 + designs["rim"]
    sheet = (
        KILOGRAMS * designs.figures("material", lambda name: material(name).density) * designs["thickness"]
    )

    def straight(length: Any, radius: Any, bore: Any) -> Any:
        area = straight_area(length, radius, radius, designs["web_width"], FILLET)
        return area - 2 * circle_area(bore)

    def coupler() -> Any:
        if designs.common.coupler_point is None:
            return straight(designs["coupler"], large, turning)
        point = designs["coupler_point_x"] + 1j * designs["coupler_point_y"]
        area = hull_area([0j, designs["coupler"], point], [large, large, small], len(designs))
        return area - 2 * circle_area(turning) - circle_area(pin)

    made = {"crank": lambda: straight(designs["crank"], small, pin), "coupler": coupler}
    if designs.common.frame == "two":
        made["follower"] = lambda: straight(designs["follower"], small, pin)
    for name, area in made.items():
        if OF_PART + name in columns:
            found.give(OF_PART + name, np.broadcast_to(sheet * area(), found.size))
