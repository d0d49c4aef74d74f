"""Sizes that plates, pins and phases share."""

from mechwright_four_bar.params import FourBarParams
from mechwright_four_bar.usual import bore_about

OF_BORE = ("pin_diameter", "bushing_wall", "running_fit")
"""Parameters of which :func:`mechwright_four_bar.usual.bore_about` makes a turning bore."""


def turning_bore(params: FourBarParams) -> float:
    """Diameter of a plate's bore in which a pin turns, with or without a bushing, mm."""
    return float(bore_about(params.pin_diameter, params.bushing_wall, params.running_fit))
