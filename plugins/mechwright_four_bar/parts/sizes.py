"""Sizes that plates, pins and phases share."""

from mechwright_four_bar.parameters import FourBarParams
from mechwright_four_bar.parts.usual import bore_about

OF_BORE = ("pin_diameter", "bushing_wall", "running_fit")
"""Parameters of which :func:`mechwright_four_bar.parts.usual.bore_about` makes a turning bore."""


def turning_bore(params: FourBarParams) -> float:
    """Diameter of a plate's bore in which a pin turns, with or without a bushing, mm."""
    return float(bore_about(params.pin_diameter, params.bushing_wall, params.running_fit))
