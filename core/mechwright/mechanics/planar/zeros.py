"""All zeros of smooth functions on an interval, from values and slopes: crossings, and points of touch.

Between two nodes a function is its cubic, whose Bernstein coefficients bound it. A cell is settled where
these say that the cubic has no zero, or is monotone, or is convex or concave; others are halved. The extreme
of a convex cell is found by its slope: a gap between two nodes, however thin, is seen there.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.errors import KinematicsError

Mask = NDArray[np.bool_]

Function = Callable[[Array], tuple[Array, Array]]
"""Values and slopes (m,) at places (m,)."""

CLEAR = 0.05
"""A cubic keeps from 0 by this share of its variation in the cell, which is more than its error."""

MOST_CELLS = 20000
"""A function with more open cells is 0 on an interval."""

HALVINGS = 40
ROUNDS = 80


@dataclass(frozen=True)
class Zeros:
    """Places of zeros: where the sign changes, and where the function only touches 0."""

    crossings: Array
    touches: Array


@dataclass(frozen=True)
class _Cells:
    """Cells (m,) by both ends: places, values, slopes."""

    a: Array
    b: Array
    va: Array
    vb: Array
    sa: Array
    sb: Array

    def __getitem__(self, some: Mask) -> "_Cells":
        return _Cells(*(one[some] for one in self._all()))

    def _all(self) -> tuple[Array, ...]:
        return self.a, self.b, self.va, self.vb, self.sa, self.sb

    def split(self, at: Array, value: Array, slope: Array) -> "_Cells":
        """The cells to the left of a place in each, then those to the right."""
        left = self.a, at, self.va, value, self.sa, slope
        right = at, self.b, value, self.vb, slope, self.sb
        return _Cells(*(np.concatenate(pair) for pair in zip(left, right, strict=True)))


def zeros(function: Function, nodes: Array, touch: float) -> Zeros:
    """Find all zeros between the first and the last of the nodes (n,), which are in order.

    An extreme whose value is within ``touch`` of 0 counts as a point of touch. Cells whose ends are no
    numbers are passed over.

    Raises
    ------
    KinematicsError
        The function is 0 on an interval.

    Examples
    --------
    Two zeros at a distance of 2e-6 between nodes that are 0.5 apart, and one point of touch:

    >>> def function(x):
    ...     return ((x - 1.1) ** 2 - 1e-12) * (x - 2.1) ** 2, 2 * (x - 2.1) * (
    ...         (x - 1.1) * (x - 2.1) + (x - 1.1) ** 2 - 1e-12)
    >>> found = zeros(function, np.linspace(0, 3, 7), 1e-15)
    >>> [f"{float(x):.7f}" for x in (*found.crossings, *found.touches)]
    ['1.0999990', '1.1000010', '2.1000000']
    """
    value, slope = function(nodes)
    cells = _Cells(nodes[:-1], nodes[1:], value[:-1], value[1:], slope[:-1], slope[1:])
    steps: list[_Cells] = []
    extremes: list[_Cells] = []
    for _ in range(HALVINGS):
        crossing, extreme, open_ = _settled(cells)
        steps.append(cells[crossing])
        extremes.append(cells[extreme])
        cells = cells[open_]
        if not cells.a.size:
            break
        if cells.a.size > MOST_CELLS:
            raise KinematicsError("a group of links stays at its dead point while the input moves")
        middle = (cells.a + cells.b) / 2
        cells = cells.split(middle, *function(middle))
    steps.append(cells[cells.va * cells.vb < 0])
    touches = []
    for one in extremes:
        if one.a.size:
            at, value, slope = _extreme(function, one)
            flat = np.abs(value) <= touch
            touches.append(at[flat])
            through = one[~flat].split(at[~flat], value[~flat], slope[~flat])
            steps.append(through[through.va * through.vb < 0])
    roots = [_root(function, one) for one in steps if one.a.size]
    empty = np.zeros(0)
    return Zeros(np.sort(np.concatenate([empty, *roots])), np.sort(np.concatenate([empty, *touches])))


def _settled(cells: _Cells) -> tuple[Mask, Mask, Mask]:
    """Which cells have one crossing, which an extreme towards 0, and which are to be halved."""
    h = cells.b - cells.a
    cubic = np.stack([cells.va, cells.va + h * cells.sa / 3, cells.vb - h * cells.sb / 3, cells.vb])
    first = np.diff(cubic, axis=0)
    second = np.diff(first, axis=0)
    low, high = cubic.min(axis=0), cubic.max(axis=0)
    margin = CLEAR * (high - low)
    number: Mask = np.asarray(np.isfinite(cubic).all(axis=0))
    crosses = cells.va * cells.vb < 0
    bent = _one_sign(second)
    free = (low > margin) | (high < -margin) | ~number
    # Of a curve that bends one way the chord is on one side, and the extreme on the other.
    towards = bent & (cells.sa * cells.sb < 0) & (cells.va * second[0] > 0)
    one = crosses & (_one_sign(first) | bent)
    none = free | (~crosses & (_one_sign(first) | (bent & ~towards)))
    extreme = ~one & ~none & towards
    return one, extreme, ~one & ~none & ~extreme


def _one_sign(values: Array) -> Mask:
    return np.asarray((values > 0).all(axis=0) | (values < 0).all(axis=0), dtype=np.bool_)


def _extreme(function: Function, cells: _Cells) -> tuple[Array, Array, Array]:
    """Where the slope changes its sign in each cell, with value and slope there."""
    a, b, sa, sb = cells.a.copy(), cells.b.copy(), cells.sa.copy(), cells.sb.copy()
    at, value, slope = a, cells.va, sa
    for number in range(ROUNDS):
        with np.errstate(invalid="ignore", divide="ignore"):
            at = b - sb * (b - a) / (sb - sa)
        at = np.where((at > np.minimum(a, b)) & (at < np.maximum(a, b)) & (number % 4 != 3), at, (a + b) / 2)
        value, slope = function(at)
        left = slope * sa > 0
        a, sa = np.where(left, at, a), np.where(left, slope, sa)
        b, sb = np.where(left, b, at), np.where(left, sb, slope)
        if np.all((np.abs(b - a) <= _resolution(a)) | (slope == 0)):
            break
    return at, value, slope


def _root(function: Function, cells: _Cells) -> Array:
    """The crossing in each cell: Newton's method, by halves where it leaves the cell or is slow."""
    a, b, va = cells.a.copy(), cells.b.copy(), cells.va.copy()
    at, step = (a + b) / 2, np.abs(b - a)
    for _ in range(ROUNDS):
        value, slope = function(at)
        left = value * va > 0
        a, va = np.where(left, at, a), np.where(left, value, va)
        b = np.where(left, b, at)
        with np.errstate(invalid="ignore", divide="ignore"):
            ahead = at - value / slope
        inside = (ahead >= a) & (ahead <= b) & (np.abs(ahead - at) < step / 2)
        ahead = np.where(value == 0, at, np.where(inside, ahead, (a + b) / 2))
        step = np.where(inside, np.abs(ahead - at), (b - a) / 2)
        at = ahead
        if np.all(step <= _resolution(at)):
            break
    return at


def _resolution(at: Array) -> Array:
    return 4 * np.spacing(np.abs(at) + 1.0)
