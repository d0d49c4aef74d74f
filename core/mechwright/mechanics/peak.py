"""Greatest value of a periodic function, refined, not sampled."""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array

_FINE, _ROUNDS = 48, 3
"""Finer grids around the best point: the last has 2e-9 of a turn, and the height is flat there."""

PEAK_SAMPLES = 1441
"""Positions of a crank per turn at which peaks of loads are sought first: four a degree."""

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


def peak(function: Callable[[Array], Array], at: Array, values: Array | None = None) -> Peak:
    """Greatest value of a smooth function of period 2π.

    ``at`` are angles (n,) in equal steps from 0 that find its hills; ``values`` are its values there, where
    they are known already.

    >>> found = peak(lambda t: 3 + np.sin(t - 1), np.linspace(0, math.tau, 64, endpoint=False))
    >>> round(found.value, 12), round(found.angle, 6)
    (4.0, 2.570796)
    """
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
