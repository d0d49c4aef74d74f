"""Four-bars whose coupler point runs near prescribed points, within limits, from many random shapes.

The search goes in rounds. In each, for every room (kind, branch, sense of the crank), many random linkages
are compared with the path by linear least squares; the best take some steps, of these the best more, and the
best of these are brought to rest with all limits kept. It ends when the same best has come back in several
rounds, or when enough designs meet the points, or when all starts have been used.
"""

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import product

import numpy as np

from mechwright import Array
from mechwright.mechanics.multistart import distinct
from mechwright.mechanics.planar import Plane
from mechwright.mechanics.tracing.descent import WEIGHT
from mechwright.mechanics.tracing.points import in_plane, random_angles
from mechwright.mechanics.tracing.search import STAGES
from mechwright_four_bar.kinematics.dimensions import FourBar
from mechwright_four_bar.kinematics.loop import close
from mechwright_four_bar.synthesis.paths.asked import PathProblem
from mechwright_four_bar.synthesis.paths.descent import STILL, polish, screen, settle
from mechwright_four_bar.synthesis.paths.kernels import lengths, linear
from mechwright_four_bar.synthesis.paths.limits import COUNT, NAMES, broken
from mechwright_four_bar.synthesis.paths.starts import random_shapes

ROUND = 12_000
"""Random linkages of a room in one round."""

REACHED = 1e-6
"""A limit that a design comes so near to, in its own unit, holds it."""

SETTLED = 60
"""Most steps between two changes of the multipliers."""

CLOSE, FINISHED, LAST_STEPS = 1e-3, 6, 3000
"""Mean distance over the path's size from which points may be met exactly in the end, how many designs of a
round are followed there, and for how many steps: where the points hardly tell linkages apart, the way is
long and
flat."""

ARRIVED = 1e-28
"""Sum of squares over that of the path's size at which a start is done: rounding."""

AGAIN = 3
"""Rounds that have to bring the best design back before it is taken for the best."""

SAME_SQUARES = 1e-3
"""Share of the sum of squares within which two rounds have found the same."""

SAME_START = 1e-3
"""Unknowns that agree so far are one start: only one of them goes on."""

MET = 1e-9
"""Mean distance over the path's size at which points are met exactly, for the search."""


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
    held
        Keys of the limits that hold it back: without them it would come nearer.
    """

    bar: FourBar
    pivot: complex
    point: complex
    phi: Array
    squares: float
    held: tuple[str, ...] = ()

    @property
    def sense(self) -> int:
        """+1 where the crank turns counter-clockwise."""
        return 1 if self.phi[-1] > self.phi[0] else -1

    @property
    def longest(self) -> float:
        """Longest distance of two joints or of the coupler point from a joint of the coupler, mm."""
        return max(*self.bar.lengths, abs(self.point), abs(self.point - self.bar.coupler))

    @property
    def mean(self) -> float:
        """Root mean square distance from the points, mm."""
        return math.sqrt(self.squares / self.phi.size)


@dataclass(frozen=True)
class Unsettled:
    """A design that came to rest beyond a limit.

    Parameters
    ----------
    key, said
        The limit that it breaks, and by what.
    mean
        Root mean square distance from the points, mm.
    """

    key: str
    said: str
    mean: float


@dataclass(frozen=True)
class PathSearch:
    """What a search has found.

    Parameters
    ----------
    solutions
        The nearest first; several are the same up to rounding.
    starts
        Random linkages that were tried.
    unsettled
        Designs that came to rest beyond a limit.
    nearest
        The one of these that is nearest to the points: the key of the limit that it breaks, by what, and its
        mean distance, mm; None where there is none.
    """

    solutions: tuple[PathSolution, ...]
    starts: int
    unsettled: int
    nearest: Unsettled | None = None


def path(bar: FourBar, pivot: complex, point: complex, phi: Array) -> Plane:
    """Coupler points (n,), mm, at crank angles (n,), rad."""
    loop = close(bar, phi)
    points: Plane = pivot + loop.joint_a + point * loop.coupler.direction
    return points


def search(
    problem: PathProblem,
    starts: int,
    wanted: int,
    seed: int,
    progress: Callable[[float], None],
    met: float = 0.0,
) -> PathSearch:
    """Linkages that keep the limits, near the points.

    Parameters
    ----------
    problem
        The points and the limits, which do not contradict each other.
    starts
        Most random linkages to try for each branch and sense.
    wanted
        How many distinct designs that meet the points are enough.
    seed
        Of the random numbers.
    progress
        Told the part that is done, 0 to 1.
    met
        Mean distance, mm, that counts as met.
    """
    senses = (0,) if problem.turns is not None else problem.senses
    rooms = list(product((False, True), (1, -1), senses))
    rounds = max(1, math.ceil(starts / (2 * ROUND)))
    limits, unit = problem.limits.array(problem.centre, problem.size), problem.unit
    met = max(met, MET * problem.size)
    found: list[PathSolution] = []
    best: list[float] = []
    unsettled: list[Unsettled] = []
    tried = 0
    for turn in range(rounds):
        fresh: list[PathSolution] = []
        for number, (double, branch, way) in enumerate(rooms):
            rng = np.random.default_rng([seed, turn, number])
            count = min(ROUND, max(1, starts // 2 - turn * ROUND))
            shapes = random_shapes(count, double, problem.limits.ratio, problem.limits.least_angle, rng)
            angles = random_angles(len(shapes), in_plane(unit), problem.turns, way, problem.closed, rng)
            tried += len(shapes)
            for solution, phi in _best(problem, unit, limits, shapes, angles, branch, way):
                one = settled(problem, unit, limits, solution, phi, branch, way)
                if isinstance(one, PathSolution):
                    fresh.append(one)
                elif one is not None:
                    unsettled.append(one)
            progress((turn + (number + 1) / len(rooms)) / rounds)
        fresh.sort(key=lambda one: one.squares)
        fresh = [_finished(one, problem) for one in fresh[:FINISHED]] + fresh[FINISHED:]
        found += fresh
        best.append(min((one.squares for one in fresh), default=math.inf))
        if _enough(found, best, wanted, met, problem):
            break
    nearest = min(unsettled, key=lambda one: one.mean, default=None)
    return PathSearch(tuple(sorted(found, key=lambda one: one.squares)), tried, len(unsettled), nearest)


def _enough(
    found: list[PathSolution], best: list[float], wanted: int, met: float, problem: PathProblem
) -> bool:
    """Whether enough designs meet the points, or the best one has come back often enough."""
    exact = [one for one in found if one.mean <= met]
    if exact:
        rows = np.log([[*one.bar.lengths, abs(one.point)] for one in exact])
        if len(distinct(rows, 0.02)) >= wanted:
            return True
    least = min(best)
    same = max(least * (1 + SAME_SQUARES), problem.targets.size * met * met)
    return math.isfinite(least) and sum(one <= same for one in best) >= AGAIN


def _best(
    problem: PathProblem, unit: Plane, limits: Array, shapes: Array, angles: Array, branch: int, way: int
) -> list[tuple[Array, Array]]:
    """Of random shapes and angles those that lead nearest to the points, after some steps."""
    costs = screen(unit, shapes, angles, branch, limits)
    order = np.argsort(costs, kind="stable")[: STAGES[0][0]]
    going = []
    for index in order[np.isfinite(costs[order])]:
        solution, _ = linear(unit, shapes[index], angles[index], branch)
        going.append((solution, angles[index].copy()))
    none = np.zeros(COUNT)
    for most, steps, weight in STAGES:
        ranked: list[tuple[float, int, Array, Array]] = []
        for solution, phi in going[:most]:
            cost = polish(
                unit, solution, phi, branch, way, problem.slack, limits, weight, none, steps, ARRIVED, STILL
            )
            if math.isfinite(cost) and np.isfinite(solution).all():
                ranked.append((cost, len(ranked), solution, phi))
        ranked.sort(key=lambda one: one[:2])
        going = [(solution, phi) for _, _, solution, phi in ranked]
        if going:
            kept = distinct(np.array([solution for solution, _ in going]), SAME_START)
            going = [going[index] for index in kept]
    return going


def unknowns(one: PathSolution, problem: PathProblem) -> Array:
    """The solution (9,) of the kernels: shape, X, s and q over the path's size."""
    a, c, b, f = one.bar.lengths
    shape = math.log(a / f), math.log((b + c) / (a + f) - 1), math.atanh((b - c) / abs(a - f))
    s = cmath.rect(f, one.bar.ground_angle) / problem.size
    x, q = (one.pivot - problem.centre) / problem.size, one.point * s / f
    return np.array([*shape, x.real, x.imag, s.real, s.imag, q.real, q.imag])


def _finished(one: PathSolution, problem: PathProblem) -> PathSolution:
    """A design that comes close, followed to where it ends; the better of both."""
    if not MET < one.mean / problem.size < CLOSE:
        return one
    limits = problem.limits.array(problem.centre, problem.size)
    way = 0 if problem.turns is not None else one.sense
    start, phi = unknowns(one, problem), one.phi - one.bar.ground_angle
    polish(
        problem.unit, start, phi, one.bar.branch, way, problem.slack, limits, WEIGHT, np.zeros(COUNT),
        LAST_STEPS, ARRIVED, 0.0,
    )  # fmt: skip
    other = settled(problem, problem.unit, limits, start, phi, one.bar.branch, way)
    return other if isinstance(other, PathSolution) and other.squares < one.squares else one


def settled(
    problem: PathProblem, unit: Plane, limits: Array, solution: Array, phi: Array, branch: int, way: int
) -> PathSolution | Unsettled | None:
    """A linkage brought to rest within its limits, in millimetres; None where numbers ran away.

    ``solution`` (9,) and ``phi`` (n,) are changed.
    """
    multipliers = np.zeros(COUNT)
    settle(unit, solution, phi, branch, way, problem.slack, limits, WEIGHT, multipliers, SETTLED, ARRIVED)
    values, none = np.empty(COUNT), np.empty((COUNT, solution.size))
    broken(solution, limits, values, none, False)
    held = tuple(dict.fromkeys(name for name, one in zip(NAMES, values, strict=True) if one > -REACHED))
    return in_millimetres(problem, solution, phi, branch, held)


def in_millimetres(
    problem: PathProblem, solution: Array, phi: Array, branch: int, held: tuple[str, ...]
) -> PathSolution | Unsettled | None:
    """The linkage of a solution; None where numbers ran away."""
    if not (np.isfinite(solution).all() and np.isfinite(phi).all()):
        return None
    a, b, c, _ = lengths(solution)
    x, s, q = (complex(solution[i], solution[i + 1]) for i in (3, 5, 7))
    f = abs(s) * problem.size
    if not f > 0 or not math.isfinite(max(a, b, c) * f):
        return None
    theta = float(np.angle(s))
    bar = FourBar(a * f, c * f, b * f, f, theta, branch)
    pivot, point, angles = problem.centre + x * problem.size, q / s * f, phi + theta
    if not bar.kind.full_turn:
        return None
    squares = float(np.sum(np.abs(path(bar, pivot, point, angles) - problem.targets) ** 2))
    if not math.isfinite(squares):
        return None
    found = PathSolution(bar, pivot, point, angles, squares, held)
    key, said = problem.limits.broken(bar, pivot, point)
    return Unsettled(key, said, found.mean) if key else found
