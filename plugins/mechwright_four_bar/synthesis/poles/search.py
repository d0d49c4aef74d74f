"""All four-bars whose coupler has its acceleration pole in prescribed places."""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

import numpy as np

from mechwright import Array
from mechwright.mechanics.multistart import distinct, least_squares
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.synthesis.poles.all_poles import Linkage
from mechwright_four_bar.synthesis.poles.certificate import certain_residual, polished
from mechwright_four_bar.synthesis.poles.equations import PoleProblem

RESIDUAL = 1e-10
"""Certain distance, mm, from its place of every pole of a solution. What misses it is so near to a toggle
that lengths rounded to a double move the pole that far."""

POLE_STEPS = 100
"""Steps of a start: one in a thousand of those that arrive takes more."""

POLE_ARRIVED = 1e-28
"""Sum of squares at which a start is done: a hundredth of what RESIDUAL asks for, squared."""

NEAR = 1e-14
"""Sum of squares from which Newton's steps with exact slopes go on: near a toggle, differences of doubles
stall before."""

ROUGHLY_SAME, SAME = 1e-3, 1e-6
"""Solutions whose lengths (in shares) and angles (in radians) agree so far are one, roughly and polished."""


@dataclass(frozen=True)
class PoleSolution:
    """A linkage that meets all places.

    Parameters
    ----------
    bar
        Its dimensions.
    phi
        (n,) crank angles from X, rad.
    residual
        A distance, mm, that certainly no pole exceeds from its place.
    """

    bar: FourBar
    phi: Array
    residual: float


@dataclass(frozen=True)
class PoleSearch:
    """What a search has found.

    Parameters
    ----------
    solutions
        Distinct, in no order.
    nearest
        Least root mean square distance, mm, of any start: what is left where there is no solution.
    """

    solutions: tuple[PoleSolution, ...]
    nearest: float


def search(problem: PoleProblem, count: int, seed: int, progress: Callable[[float], None]) -> PoleSearch:
    """Start from ``count`` random linkages on each branch.

    Parameters
    ----------
    problem
        Its branch is not looked at: both are searched.
    progress
        Told the part that is done, 0 to 1.
    """
    found: list[PoleSolution] = []
    nearest = np.inf
    size = float(np.abs(problem.targets).max())
    for number, branch in enumerate((1, -1)):
        one = replace(problem, branch=branch)
        rng = np.random.default_rng([seed, number, int(problem.full_turn)])

        def alive(part: float, number: int = number) -> None:
            progress((number + part) / 2)

        unknowns, costs = least_squares(one.residual, one.starts(count, rng), POLE_STEPS, POLE_ARRIVED, alive)
        if costs.size:
            nearest = min(nearest, float(np.sqrt(costs.min() / problem.targets.size)) * size)
        arrived = unknowns[costs <= NEAR][np.argsort(costs[costs <= NEAR], kind="stable")]
        found += _solutions(one, arrived)
    return PoleSearch(tuple(found), nearest)


def _solutions(problem: PoleProblem, unknowns: Array) -> list[PoleSolution]:
    """The distinct linkages among unknowns (n, m), each certified."""
    bars = [found for row in unknowns if (found := problem.bar(row)) is not None]
    if not bars:
        return []
    rows = np.array([_features(bar, phi) for bar, phi in bars])
    solutions: list[PoleSolution] = []
    for index in distinct(rows, ROUGHLY_SAME):
        bar, phi = polished(bars[index][0], bars[index][1], problem, _free(problem))
        residual = certain_residual(bar, phi, problem)
        if residual <= RESIDUAL:
            solutions.append(PoleSolution(bar, phi % math.tau, residual))
    if not solutions:
        return []
    rows = np.array([_features(found.bar, found.phi) for found in solutions])
    return [solutions[index] for index in distinct(rows, SAME)]


def completed(
    problem: PoleProblem, found: Iterable[PoleSolution], all_of_them: Iterable[Linkage]
) -> tuple[PoleSolution, ...]:
    """Solutions that starts led to, with those of a complete solution that they missed."""
    answer = list(found)
    for one in all_of_them:
        rows = [_features(other.bar, other.phi) for other in answer if other.bar.branch == one.bar.branch]
        if distinct(np.array([*rows, _features(one.bar, one.phi)]), SAME)[-1] < len(rows):
            continue
        bar, phi = polished(one.bar, one.phi, problem, _free(problem))
        residual = certain_residual(bar, phi, problem)
        if residual <= RESIDUAL:
            answer.append(PoleSolution(bar, phi % math.tau, residual))
    return tuple(answer)


def _free(problem: PoleProblem) -> list[list[int]]:
    """What may change in the last steps, as :func:`polished` numbers it."""
    angles = [5 + number for number in range(problem.targets.size)]
    free = [[0], [1], [2]]
    if problem.ground is None:
        free.append([3])
    if problem.ground_angle is None:
        free.append([4])
    return free + ([angles] if problem.turns is not None else [[i] for i in angles])


def _features(bar: FourBar, phi: Array) -> Array:
    """Numbers in which equal linkages agree, whatever their angles' full turns."""
    return np.concatenate(
        (np.log(bar.lengths), [np.cos(bar.ground_angle), np.sin(bar.ground_angle)], np.cos(phi), np.sin(phi))
    )
