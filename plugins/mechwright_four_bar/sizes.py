"""Sizes that plates, pins and phases share."""

from mechwright_four_bar.params import FourBarParams

HEAD, HEAD_HEIGHT = 1.6, 0.3
"""Diameter and height of a pin's head, in pin diameters: those of small rivets and clevis pins."""


def turning_bore(params: FourBarParams) -> float:
    """Diameter of a plate's bore in which a pin turns, with or without a bushing, mm."""
    if params.bushing_wall > 0:
        return params.pin_diameter + 2 * params.bushing_wall
    return params.pin_diameter + params.running_fit
