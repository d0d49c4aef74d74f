"""The force with which a mill pushes the work sideways: what its workholding has to bear.

A tooth of a helical mill is cut into slices. Each meets a chip h = f_z sin ψ at its place ψ on the circle,
which takes k_c1.1 h^(1-m) N per mm of depth along its way, and a share of that towards the axis. The vectors
of all slices in the cut are added over a turn, and the greatest sum is the peak.
"""

import math
from functools import lru_cache

import numpy as np

from mechwright.contracts.materials import Material

HELIX = math.tan(math.radians(30))
"""Slope of the flutes: the usual helix."""
RADIAL = 0.4
"""Force towards the axis in that along the way of a tooth: 0.3 to 0.5 in aluminium and steel (handbook)."""
WORN = 1.3
"""What a worn edge takes in what a new one does (handbook)."""
SLICES, PLACES = 100, 720
"""Of the depth, and of a turn: with twice as many the peak changes by less than 0.1 %."""


@lru_cache(maxsize=512)
def peak_force(
    stuff: Material, diameter: float, flutes: int, tooth: float, depth: float, width: float
) -> float:
    """Greatest force, N, in the plane of the plate, of a sharp mill.

    It is fed ``tooth`` mm per tooth, and cuts ``depth`` mm deep and ``width`` mm wide.

    Examples
    --------
    A slot of a 12 mm mill with 3 teeth in aluminium, 3 mm deep:

    >>> from mechwright.contracts.materials import material
    >>> round(peak_force(material("aluminium"), 12, 3, 0.08, 3, 12))
    338
    """
    engagement = math.acos(max(1 - 2 * width / diameter, -1.0))
    height = (np.arange(SLICES) + 0.5) * depth / SLICES
    lag = 2 * HELIX * height / diameter
    teeth = np.arange(flutes) * math.tau / flutes
    turn = np.arange(PLACES) * math.tau / PLACES
    place = (turn[:, None, None] + teeth[None, :, None] - lag[None, None, :]) % math.tau
    chip = np.where(place >= math.pi - engagement, tooth * np.sin(place), 0.0).clip(0.0)
    along = stuff.force * chip ** (1 - stuff.force_exponent) * depth / SLICES
    x = (along * np.cos(place) + RADIAL * along * np.sin(place)).sum(axis=(1, 2))
    y = (along * np.sin(place) - RADIAL * along * np.cos(place)).sum(axis=(1, 2))
    return float(np.hypot(x, y).max())


def design_force(
    stuff: Material, diameter: float, flutes: int, tooth: float, depth: float, width: float
) -> float:
    """The force, N, that workholding is laid out for: the peak with a worn edge."""
    return WORN * peak_force(stuff, diameter, flutes, tooth, depth, width)
