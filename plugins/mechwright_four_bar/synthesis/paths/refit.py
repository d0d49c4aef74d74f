"""A linkage found is fitted again: to all points of a dense path, or with its lengths rounded."""

import math
from collections.abc import Iterable
from dataclasses import replace
from itertools import product

import numpy as np

from mechwright import Array
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.synthesis.paths.asked import PathProblem
from mechwright_four_bar.synthesis.paths.search import PathSolution, path, settled, unknowns


def fitted(
    one: PathSolution, problem: PathProblem, phi: Array, fixed: tuple[float, ...] = ()
) -> PathSolution | None:
    """A linkage fitted to a problem from crank angles (n,), rad from X; None where no limit lets it.

    ``fixed`` holds crank, follower, coupler and ground where they stay, and the coupler point's coordinates.
    """
    way = 0 if problem.turns is not None else (1 if phi[-1] > phi[0] else -1)
    limits = problem.limits.array(problem.centre, problem.size, fixed)
    start, angles = unknowns(one, problem), phi - one.bar.ground_angle
    result = settled(problem, problem.unit, limits, start, angles, one.bar.branch, way)
    return result if isinstance(result, PathSolution) else None


def rounded(one: PathSolution, problem: PathProblem, step: float) -> PathSolution | None:
    """The design with links and coupler point in multiples of ``step``, mm, all else fitted; or None.

    All sixteen ways of rounding the four links up or down are tried, then the four of the coupler point's
    coordinates; the nearest to the points that keeps all limits stays.
    """
    a, c, b, f = one.bar.lengths
    links = _nearest(one, problem, product(*(_either(value, step) for value in (a, b, c, f))))
    if links is None:
        return None
    lengths = tuple(round(value / step) * step for value in _order(links.bar))
    places = product(*(_either(value, step) for value in (links.point.real, links.point.imag)))
    return _nearest(links, problem, (lengths + place for place in places))


def _order(bar: FourBar) -> tuple[float, float, float, float]:
    return bar.crank, bar.follower, bar.coupler, bar.ground


def _either(value: float, step: float) -> tuple[float, ...]:
    low = math.floor(value / step) * step
    return tuple(dict.fromkeys((_clean(low, step), _clean(low + step, step))))


def _clean(value: float, step: float) -> float:
    """A multiple of the step without the tail of a double."""
    return round(round(value / step) * step, 9)


def _nearest(
    one: PathSolution, problem: PathProblem, choices: Iterable[tuple[float, ...]]
) -> PathSolution | None:
    best: PathSolution | None = None
    for choice in choices:
        if not _keeps(choice, problem):
            continue
        result = fitted(one, problem, one.phi, choice)
        exact = None if result is None else _exactly(result, choice, problem)
        if exact is not None and (best is None or exact.squares < best.squares):
            best = exact
    return best


def _keeps(choice: tuple[float, ...], problem: PathProblem) -> bool:
    a, b, c, f = choice[:4]
    if min(choice[:4]) <= 0:
        return False
    bar = FourBar(a, c, b, f)
    if not bar.kind.full_turn or bar.least_transmission_angle() < problem.limits.least_angle:
        return False
    return min(bar.lengths) >= problem.limits.shortest and max(bar.lengths) <= problem.limits.longest


def _exactly(one: PathSolution, choice: tuple[float, ...], problem: PathProblem) -> PathSolution | None:
    """The design with these very numbers: the search keeps them but for its rounding."""
    a, b, c, f = choice[:4]
    point = complex(*choice[4:]) if len(choice) > 4 else one.point
    bar = FourBar(a, c, b, f, one.bar.ground_angle, one.bar.branch)
    if problem.limits.broken(bar, one.pivot, point)[0]:
        return None
    squares = float(np.sum(np.abs(path(bar, one.pivot, point, one.phi) - problem.targets) ** 2))
    return replace(one, bar=bar, point=point, squares=squares)
