"""Greatest values over a turn of gears of any eccentricity: the grid that finds their hills."""

import math
from collections.abc import Callable
from functools import cache

import numpy as np

from mechwright import Array
from mechwright.mechanics import peak as peaks
from mechwright.mechanics.peak import Peak

_SAMPLES = 4096
"""Grid that finds the hill: two steps on the narrowest one, that of a train with γ = 0 and e = 0.9."""

_NARROWEST = 0.9
"""Eccentricity of that hill: it is as wide as the ratio of the speeds is small, ((1 - e)/(1 + e))²."""

_FEWEST = 512
"""Samples at least: forces and stresses bend within a hundredth of a turn at any eccentricity."""

_ROUNDING = 1e-7
"""Of a power of two that is met exactly."""


@cache
def grid_of(eccentricity: float = _NARROWEST) -> Array:
    """Angles (n,), rad, that find every hill of what gears of this eccentricity do; a power of two of them.

    >>> grid_of(0.4).size, grid_of(0.8).size, grid_of().size
    (512, 1024, 4096)
    """
    narrow, own = (((1 + e) / (1 - e)) ** 2 for e in (_NARROWEST, eccentricity))
    wanted = max(_FEWEST, _SAMPLES * min(1.0, own / narrow))
    samples = 2 ** math.ceil(math.log2(wanted) - _ROUNDING)
    angles: Array = math.tau * np.arange(samples) / samples
    return angles


def peak(function: Callable[[Array], Array], at: Array | None = None, values: Array | None = None) -> Peak:
    """Greatest value of a smooth function of period 2π, by default on the finest grid."""
    return peaks.peak(function, grid_of() if at is None else at, values)
