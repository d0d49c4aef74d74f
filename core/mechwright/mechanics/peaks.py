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

SETTLED = 1e-7
"""Share by which the last parabola may have raised a value: what is left is 1/256² of that."""

MISSED = 1e-10
"""Share by which the last samples may stay below the greatest value that is known."""

ROUNDING = 1e-13
"""Share by which two samples of one value differ."""

Places = NDArray[np.intp]
"""Which functions (m,) are asked."""

Asked = Callable[[Places, Array], Array]
"""Values (m, k) of some functions at places (m, k); ``nan`` where there is nothing."""


@dataclass(frozen=True)
class Tops:
    """Of a grid the greatest samples (n,) and where they are, in steps; tops of parabolas, and their rise."""

    value: Array
    sample: Array
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
            found = most, place, place + 0.0, 0 * most
        else:
            middle = np.clip(place, 1, values.shape[1] - 2)
            shift, top = _vertex(*(values[row, middle + one] for one in (-1, 0, 1)))
            found = most, place, middle + shift, np.maximum(top - most, 0.0)
        return cls(*(found if len(values) == size else (np.broadcast_to(one, size) for one in found)))


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
    asked: Asked, tops: Tops, which: Places, low: "Array | float", high: "Array | float", count: int
) -> tuple[Array, Array, NDArray[np.bool_]]:
    """The greatest values (m,) of some functions about their best samples, where, and whether each stands.

    Parameters
    ----------
    asked
        Values of functions.
    tops
        Of a grid of ``count`` samples from ``low`` to ``high``, which may differ (m,).
    which
        The functions (m,).
    """
    low, high = (np.broadcast_to(np.asarray(end, dtype=float), which.size) for end in (low, high))
    step = (high - low) / (count - 1)
    middle, best = low + step * tops.place[which], tops.value[which].copy()
    place = low + step * tops.sample[which]
    settled = np.zeros(which.size, dtype=bool)
    for wide in NEARER:
        left = np.flatnonzero(~settled)
        some, reach = which[left], wide * step[left]
        around = np.clip(middle[left], low[left] + reach, high[left] - reach)
        values = _told(asked(some, around[:, None] + reach[:, None] * np.array([-1.0, 0.0, 1.0])))
        known = values.max(axis=1) <= best[left]
        last = np.maximum(best[left], values.max(axis=1))
        shift = _vertex(*values.T)[0]
        middle[left] = np.clip(around + reach * shift, low[left], high[left])
        found = np.column_stack((_told(asked(some, middle[left, None])), values))
        top = np.argmax(found, axis=1)
        at = np.where(top == 0, middle[left], around + reach * (top - 2.0))
        value = found[np.arange(left.size), top]
        place[left] = np.where(value > best[left] + ROUNDING * np.abs(best[left]), at, place[left])
        best[left] = np.maximum(last, value)
        # A top beyond the samples is followed, unless they only lead to what is known; one that they miss is
        # where the function is no parabola.
        settled[left] = (known | (np.abs(shift) < 1)) & (best[left] - last <= SETTLED * np.abs(last))
        settled[left] &= best[left] - value <= MISSED * np.abs(best[left])
        if settled.all():
            break
    return best, place, settled


def greatest(asked: Asked, size: int, low: float, high: float, count: int) -> tuple[Array, NDArray[np.bool_]]:
    """The greatest values (n,) of ``size`` functions between two places, and whether each is one for sure.

    >>> shift = np.array([0.1, 1.0])
    >>> value, sure = greatest(lambda which, t: np.sin(t + shift[which, None]), 2, 0.0, 3.0, 33)
    >>> value.round(9).tolist(), sure.tolist()
    ([1.0, 1.0], [True, True])
    """
    every = np.arange(size)
    tops = Tops.of(asked(every, np.linspace(low, high, count)[None]), size)
    value, _, settled = climbed(asked, tops, every, low, high, count)
    return value, settled & np.isfinite(value)
