"""The integral of a positive periodic function, to rounding, at many places at once.

The period is cut into panels, on each of which a Chebyshev series stands for the function; its terms are
integrated one by one. A panel whose last terms are not rounding is halved.

Glossary
--------
panel
    A piece of the period on which the function is smooth.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import chebyshev

from mechwright.arrays import Array
from mechwright.errors import GeometryError

_TERMS = 24
"""Of a series: smooth laws need two to eight panels of them."""

_TAIL = 3
"""Last terms of a series that have to be rounding."""

_ROUNDING = 1e-13
"""Of a series in units of its greatest value; integration divides the tail by its order, and by two."""

_NOISE = 64 * float(np.finfo(float).eps)
"""Share of the greatest value of all panels that is rounding where the function comes near to 0: what it is
made of cancels there."""

_MOST_PANELS = 4096
"""So many need only functions without a bound: one with a corner needs some fifty."""

_NARROWEST = 1e-14
"""Share of the period: a panel is halved down to it only beside a jump or a pole."""

_NODES = np.cos(np.pi * (np.arange(_TERMS) + 0.5) / _TERMS)
_TO_TERMS = np.linalg.inv(chebyshev.chebvander(_NODES, _TERMS - 1))


@dataclass(frozen=True)
class Primitive:
    """The integral from 0 of a function of a given period.

    Parameters
    ----------
    edges
        Ends (m + 1,) of the panels, from 0 to the period.
    values
        The integral (m,) at the first end of each panel.
    terms
        (m, k) Chebyshev terms of the integral on each panel, 0 at its first end.
    total
        The integral over the period.

    Examples
    --------
    >>> sine = Primitive.of(lambda x: 1 + np.sin(x), 2 * np.pi)
    >>> bool(abs(sine(np.array(9.0)) - (10 - np.cos(9.0))) < 1e-14)
    True
    """

    edges: Array
    values: Array
    terms: Array
    total: float

    @classmethod
    def of(
        cls, function: Callable[[Array], Array], period: float, breaks: Sequence[float] = ()
    ) -> "Primitive":
        """Integrate a function of arrays (...); ``breaks`` are places, in the period, where it is not smooth.

        Raises
        ------
        GeometryError
            The function jumps, has no bound, or has more waves than panels.
        """
        inner = sorted({one for one in breaks if 0 < one < period})
        bounds = np.array([0.0, *inner, period])
        low, high = bounds[:-1], bounds[1:]
        done: list[tuple[Array, Array, Array]] = []
        greatest = 0.0
        while low.size:
            half = (high - low) / 2
            terms = function(low[:, None] + half[:, None] * (1 + _NODES)) @ _TO_TERMS.T
            size = np.abs(terms).max(axis=1)
            greatest = max(greatest, float(size.max()))
            rough = np.abs(terms[:, -_TAIL:]).max(axis=1) > np.maximum(_ROUNDING * size, _NOISE * greatest)
            done.append((low[~rough], half[~rough], terms[~rough]))
            low, high = low[rough], high[rough]
            middle = (low + high) / 2
            low, high = np.concatenate((low, middle)), np.concatenate((middle, high))
            if low.size > _MOST_PANELS or (low.size and (high - low).min() < _NARROWEST * period):
                raise GeometryError("the law of a pair of gears jumps, has no bound, or swings without end")
        start, half, terms = (np.concatenate(column) for column in zip(*done, strict=True))
        order = np.argsort(start)
        start, half, terms = start[order], half[order], terms[order]
        integral = chebyshev.chebint(terms.T, lbnd=-1).T * half[:, None]
        values = np.concatenate(([0.0], np.cumsum(integral.sum(axis=1))))
        return cls(np.append(start, period), values[:-1], integral, float(values[-1]))

    def __call__(self, x: Array) -> Array:
        """The integral (...) from 0 to places (...)."""
        turns, rest = np.divmod(np.asarray(x, dtype=float), self.edges[-1])
        panel = np.clip(np.searchsorted(self.edges, rest, "right") - 1, 0, self.values.size - 1)
        low, high = self.edges[panel], self.edges[panel + 1]
        twice = 2 * (2 * rest - low - high) / (high - low)
        one, two, free = np.zeros_like(rest), np.zeros_like(rest), np.empty_like(rest)
        first, *others = np.ascontiguousarray(self.terms.T)
        for terms in others[::-1]:
            np.multiply(twice, one, out=free)
            free += terms[panel]
            free -= two
            one, two, free = free, one, two
        result: Array = self.values[panel] + first[panel] + twice / 2 * one - two + turns * self.total
        return result
