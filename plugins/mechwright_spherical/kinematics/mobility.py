"""How far the links of a spherical four-bar can turn.

The planar rule of Grashof is wrong on the sphere for half of all linkages. What counts are the signs of

    T1 = α1 - α2 + α3 - α4,   T2 = α1 - α2 - α3 + α4,   T3 = α3 + α4 - α1 - α2,   T4 = 2π - α1 - α2 - α3 - α4.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechwright import Array
from mechwright.contracts.design_table import Rowwise
from mechwright.mechanics.planar.swing import TURN_BACK

BALANCE = 1e-9
"""rad. Sums of arcs that differ by less are equal: the linkage folds flat there, and no machine holds it
apart."""

_KINDS = {
    (1, 1, 1): "crank-rocker",
    (1, -1, -1): "rocker-crank",
    (-1, -1, 1): "double crank",
    (-1, 1, -1): "Grashof double rocker",
    (-1, -1, -1): "double rocker, inward and outward",
    (1, 1, -1): "double rocker, outward",
    (1, -1, 1): "double rocker, inward",
    (-1, 1, 1): "double rocker, outward and inward",
}
"""Signs of T1, T2, T3 for a linkage whose arcs add to less than 360 degrees."""


@dataclass(frozen=True, slots=True)
class Mobility:
    """Mobility of one linkage or of many.

    Parameters
    ----------
    t
        T1 to T4, (4, ...), rad.
    input_full, output_full
        Whether input and output link turn all the way around, (...) bool.
    grashof
        Whether some joint turns all the way around, (...) bool.
    """

    t: Array
    input_full: NDArray[np.bool_]
    output_full: NDArray[np.bool_]
    grashof: NDArray[np.bool_]


def mobility(ground: ArrayLike, input_: ArrayLike, coupler: ArrayLike, output: ArrayLike) -> Mobility:
    """Judge linkages by the signs of T1 to T4; arcs (...) in rad, above 0 and below π.

    >>> m = mobility(*np.radians([80, 30, 70, 60]))
    >>> bool(m.input_full), bool(m.output_full), bool(m.grashof)
    (True, False, True)
    """
    a1, a2, a3, a4 = (np.asarray(x, dtype=float) for x in (ground, input_, coupler, output))
    t = np.stack([a1 - a2 + a3 - a4, a1 - a2 - a3 + a4, a3 + a4 - a1 - a2, 2 * np.pi - a1 - a2 - a3 - a4])
    t1, t2, t3, t4 = np.where(np.abs(t) < BALANCE, 0.0, t)
    return Mobility(
        t,
        np.asarray((t1 * t2 >= 0) & (t3 * t4 >= 0)),
        np.asarray((t1 * t3 <= 0) & (t2 * t4 <= 0)),
        np.asarray(t1 * t2 * t3 * t4 >= 0),
    )


def kind(ground: float, input_: float, coupler: float, output: float) -> str:
    """What one linkage is called; arcs in rad.

    >>> kind(*np.radians([80, 30, 70, 60])), kind(*np.radians([100, 150, 110, 120]))
    ('crank-rocker', 'crank-rocker')
    >>> kind(*np.radians([60, 60, 60, 60]))
    'change-point linkage'
    """
    found = mobility(ground, input_, coupler, output)
    if (np.abs(found.t) < BALANCE).any():
        return "change-point linkage"
    if found.t[3] < 0:
        # All rules are products of two signs, so that changing all four of them changes none.
        return _KINDS[_signs(-found.t[:3])]
    return _KINDS[_signs(found.t[:3])]


def _signs(values: Array) -> tuple[int, int, int]:
    one, two, three = (1 if value > 0 else -1 for value in values)
    return one, two, three


def input_ways(
    ground: float, input_: float, coupler: float, output: float, least: float = 0.0
) -> list[tuple[float, float]]:
    """The connected ranges of the input, rad: those of :func:`input_range`, joined across 0.

    >>> arcs = np.radians([110, 60, 70, 60])
    >>> [(round(math.degrees(low), 3), round(math.degrees(high), 3)) for low, high in input_ways(*arcs)]
    [(-125.431, 125.431)]
    """
    ranges = input_range(ground, input_, coupler, output, least)
    if len(ranges) == 2 and ranges[0][0] == 0.0:
        return [(ranges[1][0] - math.tau, ranges[0][1])]
    return list(ranges)


def input_range(
    ground: float, input_: float, coupler: float, output: float, least: float = 0.0
) -> tuple[tuple[float, float], ...]:
    """Input angles, rad, at which the linkage can be assembled: intervals inside 0 to 2π, in order.

    Its transmission angle μ is at least ``least`` there, rad, and at most π less that. No interval: it cannot
    be assembled at all.

    >>> arcs = np.radians([80, 30, 70, 60])
    >>> [(round(math.degrees(low), 6), round(math.degrees(high), 6)) for low, high in input_range(*arcs)]
    [(0.0, 360.0)]
    """
    highest, lowest, _, _ = _limits(ground, input_, coupler, output, least)
    if highest < -1 or lowest > 1 or lowest >= highest:
        return ()
    near = math.acos(highest) if highest < 1 else 0.0
    far = math.acos(lowest) if lowest > -1 else math.pi
    if near == 0.0 and far == math.pi:
        return ((0.0, math.tau),)
    if near == 0.0:
        return ((0.0, far), (math.tau - far, math.tau))
    if far == math.pi:
        return ((near, math.tau - near),)
    return ((near, far), (math.tau - far, math.tau - near))


def _limits(ground: Any, input_: Any, coupler: Any, output: Any, least: float) -> tuple[Any, Any, Any, Any]:
    """Highest and lowest cos θ with a transmission angle μ of ``least``, rad; k and m of cos μ = k + m cos θ.

    The diagonal D from a to c has cos D = cos α1 cos α2 + sin α1 sin α2 cos θ = cos α3 cos α4 + sin α3 sin α4
    cos μ.
    """
    level, swing = np.cos(ground) * np.cos(input_), np.sin(ground) * np.sin(input_)
    # cos α3 cos α4 ± sin α3 sin α4 cos μ, in a form that does not cancel.
    sines = np.sin(coupler) * np.sin(output)
    less = 2 * sines * np.sin(least / 2) ** 2
    highest = (np.cos(coupler - output) - less - level) / swing
    lowest = (np.cos(coupler + output) + less - level) / swing
    return highest, lowest, (level - np.cos(coupler) * np.cos(output)) / sines, swing / sines


@dataclass(frozen=True)
class Courses(Rowwise):
    """How far the inputs of four-bars go that go as far as they can, columns (n, 1), rad.

    Parameters
    ----------
    apart
        Whether links cannot be joined, or stay within a degree of their dead centre.
    unsure
        Whether rounding decides that, or whether the input turns fully.
    start, travel, rocks
        Where an input begins, how far it goes, and whether it is a lever that comes back.
    transmission
        Least and greatest transmission angle (n, 2).
    """

    apart: Array
    unsure: Array
    start: Array
    travel: Array
    rocks: Array
    transmission: Array


def courses(ground: Array, input_: Array, coupler: Array, output: Array) -> Courses:
    """Give the courses of inputs: :func:`input_ways` and its first way, of arcs (n, 1) in rad."""
    highest, lowest, level, swing = _limits(ground, input_, coupler, output, TURN_BACK)
    gaps = [highest - lowest, *(one - edge for one in (highest, lowest) for edge in (-1.0, 1.0))]
    ends = [np.clip(one, -1.0, 1.0) for one in (highest, lowest)]
    (near, far), inward, outward = (np.arccos(one) for one in ends), highest >= 1, lowest <= -1
    start = np.where(inward, np.where(outward, 0.0, -far), near)
    stop = np.where(outward, math.tau - near, far)
    cosines = np.concatenate([level + swing * one for one in ends], axis=1)
    return Courses(
        (highest < -1) | (lowest > 1) | (lowest >= highest),
        np.any([np.abs(gap) < BALANCE for gap in gaps], axis=0),
        start,
        stop - start,
        ~(inward & outward),
        np.arccos(np.clip(cosines, -1, 1)),
    )
