"""Sizes that plates, pins and phases share."""

import numpy as np
from numpy.typing import ArrayLike

from mechwright import Array
from mechwright_four_bar.params import FourBarParams

HEAD, HEAD_HEIGHT = 1.6, 0.3
"""Diameter and height of a pin's head, in pin diameters: those of small rivets and clevis pins."""


OF_BORE = ("pin_diameter", "bushing_wall", "running_fit")
"""Parameters of which :func:`bore_about` makes a turning bore."""


def turning_bore(params: FourBarParams) -> float:
    """Diameter of a plate's bore in which a pin turns, with or without a bushing, mm."""
    return float(bore_about(params.pin_diameter, params.bushing_wall, params.running_fit))


def bore_about(pin: ArrayLike, wall: ArrayLike, fit: ArrayLike) -> Array:
    """The same from the pin's diameter, the bushing's wall and the running fit, of many designs too."""
    wall = np.asarray(wall)
    return np.asarray(pin + np.where(wall > 0, 2 * wall, fit))
