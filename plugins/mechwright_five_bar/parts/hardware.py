"""Sizes that plates and joints share: bores, heads, and the clamp that belongs to the pins."""

import numpy as np

from mechwright.contracts.design_table import number
from mechwright.mechanics.linkage.clamp import Clamp, clamps
from mechwright.mechanics.linkage.turned import HEAD, HEAD_HEIGHT
from mechwright_five_bar.parameters import FiveBarParams


def turning_bore(params: FiveBarParams) -> float:
    """Diameter of a plate's bore in which a pin turns, with or without a bushing, mm."""
    pin, wall = params.pin_diameter, params.bushing_wall
    bore: float = number(np.where(np.asarray(wall) > 0, pin + 2 * wall, pin + params.running_fit))
    return bore


def running_bore(params: FiveBarParams) -> float:
    """Diameter of what a pin turns in, mm."""
    return params.pin_diameter + params.running_fit


def head_of(params: FiveBarParams) -> tuple[float, float]:
    """Diameter and height of a head, mm."""
    return HEAD * params.pin_diameter, HEAD_HEIGHT * params.pin_diameter


def clamp_of_design(params: FiveBarParams) -> Clamp | None:
    """The largest clamp for studs that reach from their heads through a link to the coupler, or None."""
    length = params.thickness + params.washer + head_of(params)[1]
    return next(iter(clamps(params.pin_diameter, params.thickness, length)), None)
