"""What is special about nine points: why fewer four-bars pass through them than in general."""

from itertools import combinations

import numpy as np

from mechwright import Array
from mechwright.mechanics.planar import Plane

NEAR = 1e-9
"""Distance from a line or a circle, in sizes of the points, within which a point lies on it."""

FEW = 4
"""Points in one line, or on one circle with one more, that are worth a word: any three lie on a circle."""


CIRCLE = "all points lie on one circle, which a crank's pin draws with any coupler and follower"
"""Then infinitely many linkages pass through the points, whatever isolated ones there are."""


def infinite(points: Plane) -> bool:
    """Whether infinitely many four-bars certainly pass through points (9,): one circle holds them all."""
    return special(points).startswith(CIRCLE)


def special(points: Plane) -> str:
    """What is special about points (9,), x + i y; empty where nothing is.

    >>> special(np.array([k + 0.1j * k for k in range(9)]))
    'all points lie in one line'
    """
    unit = (points - points.mean()) / np.abs(points - points.mean()).max()
    lined = _most(unit, 2)
    if len(lined) == unit.size:
        return "all points lie in one line"
    said = []
    round_ = _most(unit, 3)
    if len(round_) == unit.size:
        said.append(CIRCLE)
    if len(lined) >= FEW:
        said.append(f"points {_listed(lined)} lie in one line")
    if len(round_) > FEW and len(round_) < unit.size:
        said.append(f"points {_listed(round_)} lie on one circle")
    said += [f"the points are their own image under a {what}" for what in _images(unit)]
    return " and ".join(said)


def _listed(numbers: list[int]) -> str:
    first, last = [str(number + 1) for number in numbers[:-1]], numbers[-1] + 1
    return f"{', '.join(first)} and {last}"


def _most(unit: Plane, through: int) -> list[int]:
    """Numbers of the most points on one line through two of them, or on one circle through three."""
    best: list[int] = []
    for some in combinations(range(unit.size), through):
        on = np.flatnonzero(_away(unit, unit[list(some)]) < NEAR).tolist()
        if len(on) > len(best):
            best = on
    return best


def _images(unit: Plane) -> list[str]:
    """Under what points about their mean are the same set."""
    far = unit[np.abs(unit).argmax()]
    found = []
    for what, from_, other in (("reflection", np.conj(far), np.conj(unit)), ("turn", far, unit)):
        for turn in unit / from_:
            same = abs(turn - 1) < NEAR and what == "turn"
            if not same and abs(abs(turn) - 1) < NEAR and _one_set(turn * other, unit):
                found.append(what)
                break
    return found


def _one_set(one: Plane, two: Plane) -> bool:
    return bool(np.abs(one[:, None] - two).min(axis=1).max() < NEAR)


def _away(unit: Plane, few: Plane) -> Array:
    """Distance (9,) from the line through two points, or roughly from the circle through three."""
    along = few[1] - few[0]
    if few.size == 2:
        return np.asarray(np.abs(((unit - few[0]) * np.conj(along)).imag) / abs(along))
    # The cross ratio of four points on a circle is real.
    ratio = (unit - few[0]) * (few[2] - few[1])
    other = (unit - few[1]) * (few[2] - few[0])
    flat = abs((along * np.conj(few[2] - few[0])).imag) < NEAR
    return np.asarray(np.full(unit.size, np.inf) if flat else np.abs((ratio * np.conj(other)).imag))
