"""Greatest value of a periodic function, refined, not sampled."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache

import numpy as np

from mechwright import Array

_SAMPLES = 4096
"""Grid that finds the hill: two steps on the narrowest one, that of a train with γ = 0 and e = 0.9."""

_NARROWEST = 0.9
"""Eccentricity of that hill: it is as wide as the ratio of the speeds is small, ((1 - e)/(1 + e))²."""

_FEWEST = 512
"""Samples at least: forces and stresses bend within a hundredth of a turn at any eccentricity."""

_FINE, _ROUNDS = 48, 3
"""Finer grids around the best point: the last has 2e-9 of a turn, and the height is flat there."""

_NEAR = 0.9
"""Share of the highest sample below which a hill cannot be the highest: samples miss less of it."""

_ROUNDING = 1e-7
"""rad. A hill is flat to the last digit within this of its top."""

_EQUAL = 1e-12
"""Hills that differ by less than this share are equally high: mirror images, whose rounding differs."""


@dataclass(frozen=True, slots=True)
class Peak:
    """A greatest value and the angle, rad in [0, 2π), where it is reached first."""

    value: float
    angle: float


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
    """Greatest value of a smooth function of period 2π.

    ``at`` are the angles that find its hills, by default the finest grid; ``values`` are its values there,
    where they are known already.

    >>> found = peak(lambda t: 3 + np.sin(t - 1))
    >>> round(found.value, 12), round(found.angle, 6)
    (4.0, 2.570796)
    """
    at = grid_of() if at is None else at
    values = function(at) if values is None else values
    hills = np.flatnonzero((values >= np.roll(values, 1)) & (values > np.roll(values, -1)))
    hills = hills[values[hills] >= values.max() - (1 - _NEAR) * abs(values.max())]
    # A mirror image of the highest hill may lie anywhere between its samples.
    hills = hills[np.argsort(-values[hills], kind="stable")[:2]] if hills.size else np.array([0])
    found = _climb(function, at[np.sort(hills)], math.tau / at.size)
    top = max(one.value for one in found)
    return next(one for one in found if one.value >= top - _EQUAL * abs(top))


def _climb(function: Callable[[Array], Array], centres: Array, half: float) -> list[Peak]:
    """The tops of the hills at these samples (n,), ``half`` to both sides; all are asked for at once."""
    best = np.full(centres.size, -math.inf)
    for _ in range(_ROUNDS):
        at = centres[:, None] + half * np.linspace(-1, 1, 2 * _FINE + 1)
        values = function(at.ravel()).reshape(at.shape)
        best = np.maximum(best, values.max(axis=1))
        centres, half = at[np.arange(centres.size), values.argmax(axis=1)], half / _FINE
    # Rounding must not make a full turn of a peak at 0.
    angles = np.where(math.tau - centres < _ROUNDING, 0.0, np.maximum(centres, 0.0))
    return [Peak(float(value), float(angle)) for value, angle in zip(best, angles, strict=True)]
