"""Greatest values of many functions at once, over a stretch: a grid, then parabolas about its best sample.

Where :func:`~mechwright.mechanics.peak.peak` draws grids together for one function, here a parabola through
three samples tells where the next three stand: of a smooth hill two of them come to its top within rounding.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array

NEARER = (1 / 16, 1 / 16, 1 / 16, 1 / 256)
"""Steps, in those of the grid, of the samples through which parabolas are put one after the other: a top
that lies beyond the samples is followed by the next ones."""

SETTLED = 5e-6
"""Share by which the last parabola may have raised a value: what is left is 1/256² of that."""

Places = NDArray[np.intp]
"""Which functions (m,) are asked."""

Asked = Callable[[Places, Array], Array]
"""Values (m, k) of some functions at places (m, k); ``nan`` where there is nothing."""


@dataclass(frozen=True)
class Tops:
    """The greatest samples (n,) of a grid, where parabolas have tops, in steps, and how far they rise."""

    value: Array
    place: Array
    rise: Array

    @classmethod
    def of(cls, values: Array, size: int) -> "Tops":
        """Of samples (n, k), or (1, k) that all have in common.

        >>> found = Tops.of(np.array([[0.0, 3.0, 4.0, 1.0]]), 1)
        >>> found.value.tolist(), found.place.tolist(), found.rise.round(3).tolist()
        ([4.0], [1.75], [0.125])
        """
        values = _told(values)
        row, place = np.arange(len(values)), np.argmax(values, axis=1)
        most = values[row, place]
        if values.shape[1] < 3:
            return cls(*(np.broadcast_to(one, size) for one in (most, place + 0.0, 0 * most)))
        middle = np.clip(place, 1, values.shape[1] - 2)
        shift, top = _vertex(*(values[row, middle + one] for one in (-1, 0, 1)))
        rise = np.maximum(top - most, 0.0)
        return cls(*(np.broadcast_to(one, size) for one in (most, middle + shift, rise)))


def _told(values: Array) -> Array:
    return np.where(np.isnan(values), -np.inf, values)


def _vertex(left: Array, centre: Array, right: Array) -> tuple[Array, Array]:
    """Where a parabola through three values is greatest, at most a step off its middle, and how great."""
    bend, slope = left - 2 * centre + right, (right - left) / 2
    inside = np.abs(slope) <= -bend
    shift = np.where(inside, -slope / np.where(inside & (bend < 0), bend, -1.0), np.sign(slope))
    shift = np.where(np.isfinite(slope), shift, 0.0)
    top: Array = np.where(inside, centre + slope * shift / 2, np.maximum(left, right))
    return shift, np.where(np.isfinite(top), top, centre)


def climbed(
    asked: Asked, tops: Tops, which: Places, low: float, high: float, count: int
) -> tuple[Array, NDArray[np.bool_]]:
    """The greatest values (m,) of some functions about their best samples, and whether each stands.

    Parameters
    ----------
    asked
        Values of functions.
    tops
        Of a grid of ``count`` samples from ``low`` to ``high``.
    which
        The functions (m,).
    """
    step = (high - low) / (count - 1)
    middle, best = low + step * tops.place[which], tops.value[which].copy()
    settled = np.zeros(which.size, dtype=bool)
    for wide in NEARER:
        left = np.flatnonzero(~settled)
        around = np.clip(middle[left], low + wide * step, high - wide * step)
        values = _told(asked(which[left], around[:, None] + wide * step * np.array([-1.0, 0.0, 1.0])))
        known = values.max(axis=1) <= best[left]
        last = np.maximum(best[left], values.max(axis=1))
        shift = _vertex(*values.T)[0]
        middle[left] = np.clip(around + wide * step * shift, low, high)
        best[left] = np.maximum(last, _told(asked(which[left], middle[left, None]))[:, 0])
        # A top beyond the samples is followed, unless they only lead to what is known.
        settled[left] = (known | (np.abs(shift) < 1)) & (best[left] - last <= SETTLED * np.abs(last))
        if settled.all():
            break
    return best, settled


def greatest(asked: Asked, size: int, low: float, high: float, count: int) -> tuple[Array, NDArray[np.bool_]]:
    """The greatest values (n,) of ``size`` functions between two places, and whether each is one for sure.

    >>> shift = np.array([0.1, 1.0])
    >>> value, sure = greatest(lambda which, t: np.sin(t + shift[which, None]), 2, 0.0, 3.0, 33)
    >>> value.round(9).tolist(), sure.tolist()
    ([1.0, 1.0], [True, True])
    """
    every = np.arange(size)
    tops = Tops.of(asked(every, np.linspace(low, high, count)[None]), size)
    value, settled = climbed(asked, tops, every, low, high, count)
    return value, settled & np.isfinite(value)
