"""The cam's opening for its shaft: how far it reaches, and its area."""

import math
from typing import Any

import numpy as np

from mechwright.contracts.design_table import by_row, number
from mechwright.geometry.keyway import key_of_width
from mechwright.mechanics.openings import opening_of
from mechwright_cam_follower.kinematics.mechanism import Mechanism


def opening_reach(m: Mechanism, bore: Any = None) -> Any:
    """Give how far the opening reaches from the cam's axis, mm: of another bore if one is given."""
    across, width, relief = (
        m.given.bore if bore is None else bore,
        m.given.keyway_width,
        m.given.keyway_relief,
    )
    if np.all(np.asarray(width) == 0):
        return across / 2
    key, depth = key_of_width(float(np.ravel(width)[0])), m.given.keyway_depth
    if depth is None:
        depth = 0.0 if key is None else key.hub_depth
    # A relief is a semicircle over the corner; its farthest point is behind its middle.
    bite = relief / math.sqrt(2) / 2
    middle = np.hypot(across / 2 + depth - bite, width / 2 - bite)
    return number(middle + relief / 2)


def opening_area(m: Mechanism) -> Any:
    """Give the area of the opening, mm²."""
    if np.all(np.asarray(m.given.keyway_width) == 0):
        return math.pi / 4 * m.given.bore**2

    def area(one: Mechanism) -> float:
        opening = opening_of(one.given)
        return 0.0 if opening is None else abs(opening.loop().area)

    names = ("bore", "keyway_width", "keyway_depth", "keyway_relief")
    varied = any(np.ndim(getattr(m.given, name)) for name in names)
    return by_row(area)(m) if varied else area(m.row(0))
