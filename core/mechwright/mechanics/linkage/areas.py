"""Areas of the outlines of :mod:`mechwright.mechanics.linkage.outlines`, of many designs at once.

Sizes are numbers or arrays (n,), places x + i y, mm; areas mm². By Green's theorem, 2 A is the integral of
x dy - y dx along an outline. Bores are left in.
"""

import math
from collections.abc import Sequence
from itertools import permutations
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.linkage.outlines import SAME_DIRECTION
from mechwright.tolerances import TOLERANCES


def circle_area(diameter: Any) -> Any:
    """Of a bore or a round plate."""
    return math.pi / 4 * diameter * diameter


def rectangle_area(width: Any, height: Any, corner: Any) -> Any:
    """With rounded corners."""
    return width * height - (4 - math.pi) * corner * corner


def strip_area(length: Any, radius: Any) -> Any:
    """Of a strip ``length`` long on its middle, straight or an arc, with round ends."""
    return 2 * radius * length + math.pi * radius * radius


def two_discs_area(apart: Any, one: Any, two: Any) -> Any:
    """Around two discs, neither within the other."""
    lean = np.arcsin((one - two) / apart)
    tangent = np.sqrt(apart**2 - (one - two) ** 2)
    turned = math.pi / 2 * (one * one + two * two) + lean * (one * one - two * two)
    return turned + tangent * (one + two)


def web_area(apart: Any, one: Any, two: Any, width: Any, fillet: float) -> Any:
    """Of two bosses of these radii, a web between them and its four fillets."""
    half = width / 2

    def end(radius: Any) -> tuple[Any, Any]:
        """Half of what lies between a boss's middle and where its fillet ends, without the boss; how far."""
        reach = np.sqrt((radius + fillet) ** 2 - (half + fillet) ** 2)
        out = np.arctan2(half + fillet, reach)
        triangle = reach * (half + fillet) / 2
        return triangle - (radius**2 * out + fillet**2 * (math.pi / 2 - out)) / 2, reach

    (first, near), (last, far) = end(one), end(two)
    bosses = math.pi * (one * one + two * two)
    return bosses + 2 * (first + last) + width * (apart - near - far)


def straight_area(apart: Any, one: Any, two: Any, width: Any, fillet: float) -> Any:
    """Of a link with a web where that is narrower than both bosses and its fillets have room, else a hull."""
    half = width / 2
    taken = sum(np.sqrt((radius + fillet) ** 2 - (half + fillet) ** 2) for radius in (one, two))
    webbed = (half < np.minimum(one, two)) & (taken < apart)
    return np.where(webbed, web_area(apart, one, two, width, fillet), two_discs_area(apart, one, two))


def hull_area(centres: Sequence[Any], radii: Sequence[Any], count: int) -> Array:
    """Around discs (k), each with centre and radius of every design: (count,).

    A tangent of two discs is a side of the hull where no third disc reaches beyond it, and none on it lies
    before or behind them.

    >>> hull_area([0j, 20.0 + 0j, 10.0 + 0j], [5.0, 5.0, 5.0], 1).round(9) == round(200 + 25 * math.pi, 9)
    array([ True])
    """
    at = np.array([np.broadcast_to(np.asarray(one, dtype=complex), count) for one in centres])
    size = np.array([np.broadcast_to(np.asarray(one, dtype=float), count) for one in radii])
    shown = _shown(at, size)
    doubled, sweep = np.zeros(count), np.zeros_like(size)
    for one, two in permutations(range(len(at)), 2):
        between = at[two] - at[one]
        lean = np.arccos(np.clip((size[one] - size[two]) / np.maximum(np.abs(between), 1e-300), -1, 1))
        normal = np.angle(between) - lean
        out = np.exp(1j * normal)
        reach = (at[one] * np.conj(out)).real + size[one]
        begin, end = (at[one] * np.conj(out)).imag, (at[two] * np.conj(out)).imag
        side = shown[one] & shown[two]
        for other in range(len(at)):
            if other in (one, two):
                continue
            seen = at[other] * np.conj(out)
            short = reach - seen.real - size[other]
            near = SAME_DIRECTION * np.abs(between)
            on = (np.abs(short) <= near) & (seen.imag >= begin) & (seen.imag <= end)
            side &= (short > near) | on | ~shown[other]
        corner, last = at[one] + size[one] * out, at[two] + size[two] * out
        along = (np.conj(corner) * last).imag
        along += size[one] * (np.conj(at[one]) * out).imag - size[two] * (np.conj(at[two]) * out).imag
        doubled += np.where(side, along, 0.0)
        sweep[one] += np.where(side, normal, 0.0)
        sweep[two] -= np.where(side, normal, 0.0)
    alone = shown.sum(axis=0) == 1
    turned = np.where(alone & shown, math.tau, sweep % math.tau)
    return np.asarray((doubled + (size**2 * turned).sum(axis=0)) / 2)


def _shown(at: Any, size: Array) -> Any:
    """Which discs (k, n) no other one holds; of two equal ones the first."""
    shown = np.ones(size.shape, dtype=bool)
    for one, two in permutations(range(len(at)), 2):
        spare = size[two] - size[one] - np.abs(at[two] - at[one]) + TOLERANCES.closure
        equal = np.abs(size[two] - size[one]) <= 2 * TOLERANCES.closure
        shown[one] &= ~((spare >= 0) & (~equal | (two < one)))
    return shown
