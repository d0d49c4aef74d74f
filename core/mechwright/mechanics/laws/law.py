"""What a motion law is.

Glossary
--------
u
    Share of the time of the movement, 0 to 1.
s
    Share of the way, 0 at u = 0 and 1 at u = 1.
rates
    s and its derivatives ds/du, d²s/du², d³s/du³.
rest
    ds/du = 0 at both ends: the output stands still before and after.
break
    A place where the jerk jumps; all rates are smooth between breaks.
"""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mechwright.arrays import Array

_TURNS = 129
"""Points at which a law is compared with its own mirror image."""

_MIRRORED = 1e-9
"""Difference of a law from its mirror image that is rounding, in shares of the way."""


@dataclass(frozen=True, slots=True)
class Rates:
    """s, s', s'', s''' at some u, each of the shape of u; pure numbers."""

    s: Array
    v: Array
    a: Array
    j: Array


@dataclass(frozen=True, slots=True)
class Peaks:
    """Largest magnitudes of s', s'', s''' between the ends (Cv, Ca, Cj), exact to rounding.

    Where the acceleration starts with a jump, ``j`` is the largest finite one.
    """

    v: float
    a: float
    j: float


class Law(ABC):
    """A motion from rest to rest in closed form.

    Parameters
    ----------
    name
        As a design file says it.
    """

    name: str

    @abstractmethod
    def at(self, u: ArrayLike) -> Rates:
        """The rates at u (...), 0 to 1; outside, the law is continued as it ends."""

    @property
    @abstractmethod
    def breaks(self) -> tuple[float, ...]:
        """The breaks strictly between 0 and 1, ascending."""

    @property
    @abstractmethod
    def peaks(self) -> Peaks:
        """Largest velocity, acceleration and jerk."""

    @property
    @abstractmethod
    def least_velocity(self) -> float:
        """The least ds/du; below 0 the output runs backwards."""

    @cached_property
    def jumps(self) -> tuple[float, float]:
        """Acceleration d²s/du² right after the start and right before the end; other than 0 is a jump."""
        ends = self.at(np.array([0.0, 1.0])).a
        return float(ends[0]), float(ends[1])

    @cached_property
    def symmetric(self) -> bool:
        """Whether s(1 - u) = 1 - s(u): the way out is the way in, backwards."""
        u = np.linspace(0, 1, _TURNS)
        s = self.at(u).s
        return bool(np.abs(s + s[::-1] - 1).max() <= _MIRRORED)


class UnbrokenLaw(Law):
    """A law without breaks, given as s and its derivatives up to the fourth; see :meth:`_turning`."""

    _orders: Sequence[Any]
    """s and its first four derivatives, functions of u."""

    @property
    def breaks(self) -> tuple[float, ...]:
        """None: the jerk goes on smoothly throughout."""
        return ()

    def at(self, u: ArrayLike) -> Rates:
        """The rates at u (...)."""
        u = np.asarray(u, dtype=float)
        return Rates(*(order(u) for order in self._orders[:4]))

    @abstractmethod
    def _turning(self, order: int) -> Array:
        """Values of a derivative at the ends of the law's pieces and where it turns."""

    @cached_property
    def peaks(self) -> Peaks:
        """Largest velocity, acceleration and jerk, from the roots of the next derivative."""
        return Peaks(*(largest(self._turning(order)) for order in (1, 2, 3)))

    @cached_property
    def least_velocity(self) -> float:
        """The least ds/du."""
        return float(self._turning(1).min())


def largest(values: Array) -> float:
    """The largest magnitude.

    >>> largest(np.array([1.0, -3.0]))
    3.0
    """
    return float(np.abs(values).max())
