"""The longest stretch of a period on which a speed stays within a band."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.motion import Array

_SAMPLES = 8192
"""Grid over a period; it decides only which stretch is the longest."""

_STARTS = 65
"""Starts tried on each of the finer grids around the best one."""

_ZOOMS = 3
"""Finer grids; the last one has 3e-5 of the step of the search grid."""

_BISECTIONS = 40
"""Halvings of two grid steps: rounding."""


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
    length = _longest_runs(values, band)
    first = int(np.argmax(length))
    last = first + int(length[first]) - 1
    inside = values[np.arange(first + 1, last) % samples]
    start, end = _refine(speed, band, step * first, step * last, step, inside)
    least = min(float(inside.min(initial=np.inf)), *speed(np.array([start, end])).tolist())
    return Window(start % period, min(end - start, period), least)


def _refine(
    speed: Callable[[Array], Array], band: float, start: float, end: float, step: float, inside: Array
) -> tuple[float, float]:
    """Move both ends of a window by up to a step so that it becomes longest.

    Where the speed rises or falls through the whole window, a later start is paid back by a later end, so the
    start is sought on ever finer grids, each with the last end that the band allows.
    """
    centre, half = start, step
    best = start, end
    for _ in range(_ZOOMS):
        starts = centre + half * np.linspace(-1, 1, _STARTS)
        at_start = speed(starts)
        least = np.minimum(inside.min(initial=np.inf), at_start)
        most = np.maximum(inside.max(initial=-np.inf), at_start)
        good, bad = np.maximum(end - step, starts), np.maximum(end, starts) + step
        for _ in range(_BISECTIONS):
            middle = (good + bad) / 2
            values = speed(middle)
            fits = (values <= least + band) & (values >= most - band)
            good, bad = np.where(fits, middle, good), np.where(fits, bad, middle)
        length = np.where(most - least <= band, good - starts, -np.inf)
        top = int(np.argmax(length))
        if length[top] > best[1] - best[0]:
            best = float(starts[top]), float(good[top])
        centre, half = best[0], half * 2 / (_STARTS - 1)
    return best


def _longest_runs(values: Array, band: float) -> NDArray[np.int64]:
    """For every start the number of samples whose range is within the band.

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
    return length
