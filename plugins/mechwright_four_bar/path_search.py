"""Four-bars whose coupler point runs near prescribed points, from very many random shapes."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

import numpy as np

from mechwright import Array
from mechwright.mechanics.planar import Plane
from mechwright_four_bar.dimensions import FourBar
from mechwright_four_bar.loop import close
from mechwright_four_bar.path_kernels import lengths, linear, polish, screen
from mechwright_four_bar.pole_equations import random_shapes

POLISHED, ONE_IN = 400, 50
"""Best starts of each branch and sense that are followed to the end, and at most one in so many: the global
optimum of the benchmarks is reached by every third of them."""

PATH_STEPS = 300
"""Most steps of a start."""

PATH_ARRIVED = 1e-27
"""Sum of squares over that of the path's size at which a start is done: rounding."""

LEAST_SPAN, MOST_SPAN = math.radians(20), math.radians(355)
"""Crank turn over all points in the starts, where the crank is free."""


@dataclass(frozen=True)
class PathSolution:
    """A linkage with a coupler point.

    Parameters
    ----------
    bar
        Its dimensions; the crank turns fully.
    pivot, point
        A0, mm, and the coupler point in the coupler's frame, mm, as x + i y.
    phi
        (n,) crank angles from X, rad, in the order of the points; they go one way, within one turn.
    squares
        Sum of squared distances of the coupler point from the points, mm².
    """

    bar: FourBar
    pivot: complex
    point: complex
    phi: Array
    squares: float

    @property
    def sense(self) -> int:
        """+1 where the crank turns counter-clockwise."""
        return 1 if self.phi[-1] > self.phi[0] else -1

    @property
    def longest(self) -> float:
        """Longest distance of two joints or of the coupler point from a joint of the coupler, mm."""
        return max(*self.bar.lengths, abs(self.point), abs(self.point - self.bar.coupler))


def path(bar: FourBar, pivot: complex, point: complex, phi: Array) -> Plane:
    """Coupler points (n,), mm, at crank angles (n,), rad."""
    loop = close(bar, phi)
    points: Plane = pivot + loop.joint_a + point * loop.coupler.direction
    return points


def search(
    targets: Plane,
    turns: Array | None,
    sense: Literal["ccw", "cw", "any"],
    count: int,
    seed: int,
    least_angle: float,
    progress: Callable[[float], None],
) -> list[PathSolution]:
    """Linkages near the points, the nearest first; several are the same up to rounding.

    Parameters
    ----------
    targets
        (n,) points, mm.
    turns
        (n,) crank angles from that at the first point, rad; None where they are free.
    sense
        Of the free crank.
    count
        Random shapes on each branch, and in each sense where both are searched.
    seed
        Of the random numbers.
    least_angle
        Least transmission angle of the shapes to start from, rad: the search keeps near to it.
    progress
        Told the part that is done, 0 to 1.
    """
    centre = complex(targets.mean())
    size = float(np.abs(targets - centre).max())
    unit = (targets - centre) / size
    senses = (0,) if turns is not None else {"ccw": (1,), "cw": (-1,), "any": (1, -1)}[sense]
    rooms = [(branch, way) for branch in (1, -1) for way in senses]
    found: list[PathSolution] = []
    for number, (branch, way) in enumerate(rooms):
        rng = np.random.default_rng([seed, number])
        shapes, angles = _starts(unit, turns, way, count, rng)
        costs = screen(unit, shapes, angles, branch)
        costs[_worst_cosine(shapes) > math.cos(least_angle)] = np.inf
        most = min(POLISHED, count // ONE_IN)
        best = np.argsort(costs, kind="stable")[:most]
        for step, index in enumerate(best[np.isfinite(costs[best])]):
            phi = angles[index].copy()
            solution = linear(unit, shapes[index], phi, branch)
            polish(unit, solution, phi, branch, turns is not None, PATH_STEPS, PATH_ARRIVED)
            one = _solution(solution, phi, branch, centre, size, targets)
            if one is not None:
                found.append(one)
            if step % 20 == 0:
                progress((number + step / most) / len(rooms))
    return sorted(found, key=lambda one: one.squares)


def _starts(
    unit: Plane, turns: Array | None, way: int, count: int, rng: np.random.Generator
) -> tuple[Array, Array]:
    """Random shapes (count, 3) and crank angles (count, n)."""
    shapes = random_shapes(count, rng)
    first = rng.uniform(0, math.tau, (count, 1))
    if turns is not None:
        return shapes, first + turns
    # Between even steps of the crank and steps in the ratio of the chords.
    even = np.linspace(0, 1, unit.size)
    chords = np.concatenate(([0.0], np.cumsum(np.abs(np.diff(unit)))))
    mix = rng.uniform(0, 1, (count, 1))
    span = rng.uniform(LEAST_SPAN, MOST_SPAN, (count, 1))
    return shapes, first + way * span * (mix * even + (1 - mix) * chords / chords[-1])


def _worst_cosine(shapes: Array) -> Array:
    """Cosines (m,) of the least transmission angles of shapes (m, 3); see the kernels for the shape."""
    a = np.exp(shapes[:, 0])
    total = (1 + a) * (1 + np.exp(shapes[:, 1]))
    difference = np.abs(1 - a) * np.tanh(shapes[:, 2])
    b, c = (total + difference) / 2, (total - difference) / 2
    ends = [(b * b + c * c - diagonal**2) / (2 * b * c) for diagonal in (1 - a, 1 + a)]
    worst: Array = np.abs(ends).max(axis=0)
    return worst


def _solution(
    solution: Array, phi: Array, branch: int, centre: complex, size: float, targets: Plane
) -> PathSolution | None:
    """In millimetres; None where the order of the points is not that of the crank, or numbers ran away."""
    steps = np.diff(phi)
    ordered = bool((steps > 0).all() or (steps < 0).all()) and abs(phi[-1] - phi[0]) < math.tau
    if not (ordered and np.isfinite(solution).all()):
        return None
    a, b, c, _ = lengths(solution)
    x, s, q = (complex(solution[i], solution[i + 1]) for i in (3, 5, 7))
    f = abs(s) * size
    if not f > 0 or not math.isfinite(max(a, b, c) * f):
        return None
    theta = float(np.angle(s))
    bar = FourBar(a * f, c * f, b * f, f, theta, branch)
    pivot, point, angles = centre + x * size, q / s * f, phi + theta
    if not bar.kind.full_turn:
        return None
    squares = float(np.sum(np.abs(path(bar, pivot, point, angles) - targets) ** 2))
    return PathSolution(bar, pivot, point, angles, squares) if math.isfinite(squares) else None
