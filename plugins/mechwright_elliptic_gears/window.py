"""The longest stretch of a period on which a speed stays within a band."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from mechwright.motion import Array

_SAMPLES = 8192
"""Grid over a period; it decides only which stretch is the longest, bisection finds its ends."""

_BISECTIONS = 50
"""Halvings of one grid step: rounding."""


@dataclass(frozen=True, slots=True)
class Window:
    """A stretch of near-constant speed.

    Parameters
    ----------
    start, length
        rad, ``start`` in [0, period).
    low
        Least speed on it.
    """

    start: float
    length: float
    low: float


def near_constant(
    speed: Callable[[Array], Array], band: float, period: float = 2 * np.pi, samples: int = _SAMPLES
) -> Window:
    """Find the longest interval, taken cyclically, on which max - min of ``speed`` is at most ``band``.

    Parameters
    ----------
    speed
        Values (n,) at arguments (n,); continuous, of the given period.
    band
        Above 0, in the unit of ``speed``.
    period
        The whole period is the answer where the band holds everywhere.
    samples
        Grid points per period.

    Examples
    --------
    >>> round(near_constant(np.cos, 1.0).length, 9)
    3.141592654
    """
    step = period / samples
    values = np.asarray(speed(step * np.arange(samples, dtype=np.float64)), dtype=np.float64)
    if values.max() - values.min() <= band:
        return Window(0.0, period, float(values.min()))
    length, low, high = _longest_runs(values, band)
    first = int(np.argmax(length))
    start, end = step * first, step * (first + int(length[first]) - 1)
    least, most = float(low[first]), float(high[first])
    end = _extend(speed, end, step, most - band, least + band)
    edge = float(speed(np.array([end]))[0])
    least, most = min(least, edge), max(most, edge)
    start = _extend(speed, start, -step, most - band, least + band)
    least = min(least, float(speed(np.array([start]))[0]))
    return Window(start % period, min(end - start, period), least)


def _longest_runs(values: Array, band: float) -> tuple[Array, Array, Array]:
    """For every start the number of samples whose range is within the band, their least and greatest.

    Tables of minima and maxima over 2^k samples, then steps of falling size: n log n, no loop over samples.
    """
    n = values.size
    lows, highs = [values], [values]
    while 2 ** len(lows) <= n:
        reach = 2 ** (len(lows) - 1)
        lows.append(np.minimum(lows[-1], np.roll(lows[-1], -reach)))
        highs.append(np.maximum(highs[-1], np.roll(highs[-1], -reach)))
    at = np.arange(n)
    length = np.zeros(n, dtype=np.int64)
    low, high = values, values
    for k in range(len(lows) - 1, -1, -1):
        there = (at + length) % n
        new_low, new_high = np.minimum(low, lows[k][there]), np.maximum(high, highs[k][there])
        fits = (new_high - new_low <= band) & (length + 2**k <= n)
        length = np.where(fits, length + 2**k, length)
        low, high = np.where(fits, new_low, low), np.where(fits, new_high, high)
    return length.astype(float), low, high


def _extend(speed: Callable[[Array], Array], inside: float, step: float, least: float, most: float) -> float:
    """Move an end of the window outwards by up to a step, as far as the speed stays in [least, most]."""
    good, bad = 0.0, 1.0
    for _ in range(_BISECTIONS):
        middle = (good + bad) / 2
        value = float(speed(np.array([inside + middle * step]))[0])
        good, bad = (middle, bad) if least <= value <= most else (good, middle)
    return inside + good * step
