"""Slider-cranks whose coupler has its acceleration pole in given places (seed document 000).

Each pole is two equations. With the crank's rotation between two poles given, a, c, e and the first angle are
four unknowns for four equations; with free angles three poles give six equations for six unknowns. Very many
random starts go through Levenberg and Marquardt's method at once, for each assembly by itself, so that no
solution changes its assembly between poles. A solution is certified: its residual is bounded in interval
arithmetic.
"""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from flint import acb, arb, ctx

from mechwright import Array
from mechwright.mechanics.multistart import distinct, least_squares
from mechwright.mechanics.planar import Plane
from mechwright_slider_crank.kinematics.limits import least_transmission_angle
from mechwright_slider_crank.synthesis.poles.all_poles import Linkage
from mechwright_slider_crank.synthesis.poles.equations import PoleProblem

ACCURACY = 1e-10
"""mm, largest certified distance of a pole from its place. What misses it turns so barely that lengths
rounded to a double move the pole that far."""

_ROUGHLY_SAME, _SAME = 1e-6, 1e-8
"""Solutions whose lengths (in shares) and angles (in radians) agree so far are one, before and after the last
steps."""

_STEPS = 100
"""Most steps of a start: one in a thousand of those that arrive takes more."""

_ARRIVED = 1e-26
"""Sum of squares, over the farthest pole's distance, at which a start is done."""

_NEAR, _LAST_STEPS = 1e-20, 8
"""Sum of squares from which a start is a solution, and the steps that it then gets, to rounding."""

_DIGITS = 40
"""Digits of the certificate: enough to leave no doubt about a residual of 1e-10."""


@dataclass(frozen=True, slots=True)
class Found:
    """A slider-crank through the poles.

    Parameters
    ----------
    crank, rod, offset
        a, c, e, mm.
    branch
        +1 with the slider ahead of the crank pin, -1 behind.
    angles, ratios
        Crank angles at the poles from the slide's direction, rad, and its acceleration ratios there.
    residual
        Certified bound of the distance of any pole from its place, mm.
    """

    crank: float
    rod: float
    offset: float
    branch: int
    angles: tuple[float, ...]
    ratios: tuple[float, ...]
    residual: float

    @property
    def transmission(self) -> float:
        """Least transmission angle, rad."""
        return float(least_transmission_angle(self.crank, self.rod, self.offset))


def through_poles(
    poles: Plane,
    rotations: Array,
    starts: int,
    seed: int,
    heard: Callable[[float, str], None],
    ratios: Array | float = 0.0,
) -> tuple[list[Found], float]:
    """Find slider-cranks through two poles with a rotation between them, or three with free angles.

    Parameters
    ----------
    poles
        Places (2,) or (3,) in the slide frame, mm.
    rotations
        (1,) rad from the first pole to the second, or (0,) for free angles.
    starts, seed
        Random starts for each assembly.
    heard
        Told of the progress.
    ratios
        Acceleration ratios of the crank at the poles, (2,) or (3,), or one for all, per radian.

    Returns
    -------
    found, best
        Solutions whose crank turns fully, by transmission angle, best first; and the least residual of any
        start that ended with a crank that turns, mm.
    """
    scale = float(np.abs(poles).max())
    turns = np.concatenate(([0.0], rotations)) if rotations.size else None
    found: list[Found] = []
    best = math.inf
    for number, branch in enumerate((1, -1)):
        what = f"{starts} starts, slider {'ahead of' if branch > 0 else 'behind'} the crank pin"

        def alive(part: float, number: int = number, what: str = what) -> None:
            heard((number + part) / 2, what)

        problem = PoleProblem(poles / scale, turns, branch, ratios)
        rng = np.random.default_rng([seed, number])
        x, costs = least_squares(
            problem.residual, problem.starts(starts, rng), _STEPS, _ARRIVED, alive, problem.slopes
        )
        if costs.size:
            best = min(best, scale * float(np.abs(problem.residual(x[np.argmin(costs)])).max()))
        near = x[np.argsort(costs, kind="stable")][: np.count_nonzero(costs < _NEAR)]
        near = near[distinct(_features(problem, near), _ROUGHLY_SAME)]
        good, _ = least_squares(problem.residual, near, _LAST_STEPS, 0.0, slopes=problem.slopes)
        for row in good[distinct(_features(problem, good), _SAME)]:
            solution = _certified(problem, row, scale)
            if solution.residual <= ACCURACY:
                found.append(solution)
    heard(1.0, f"{len(found)} solutions")
    return _in_order(found), best


def _in_order(found: Iterable[Found]) -> list[Found]:
    return sorted(found, key=lambda one: (-one.transmission, one.crank))


def completed(
    found: list[Found], all_of_them: Iterable[Linkage], poles: Plane, rotations: Array
) -> list[Found]:
    """Linkages that starts led to, with those of a complete solution that they missed.

    Parameters
    ----------
    found
        Through poles (2,), mm, with a rotation (1,), rad, at constant speed.
    all_of_them
        Linkages whose crank turns.
    """
    scale = float(np.abs(poles).max())
    turns = np.concatenate(([0.0], rotations))
    answer = list(found)
    for one in all_of_them:
        problem = PoleProblem(poles / scale, turns, one.branch)
        row = _unknowns(one.crank, one.rod, one.offset, one.angle, scale)
        known = [
            _unknowns(other.crank, other.rod, other.offset, other.angles[0], scale)
            for other in found
            if other.branch == one.branch
        ]
        features = _features(problem, np.array([*known, row]))
        if distinct(features, _SAME)[-1] == len(known):
            solution = _certified(problem, row, scale)
            if solution.residual <= ACCURACY:
                answer.append(solution)
    return _in_order(answer)


def _unknowns(crank: float, rod: float, offset: float, angle: float, scale: float) -> Array:
    """The unknowns of :class:`PoleProblem` of a linkage in mm."""
    room = (crank, rod - offset - crank, rod + offset - crank)
    return np.array([*(math.log(length / scale) for length in room), angle])


def _features(problem: PoleProblem, x: Array) -> Array:
    """Numbers in which equal solutions agree, whatever their angles' full turns."""
    a, c, e = problem.lengths(x)
    phi = problem.angles(x)
    return np.column_stack((np.log(a), np.log(c), e / c, np.cos(phi), np.sin(phi)))


def _certified(problem: PoleProblem, row: Array, scale: float) -> Found:
    """The solution in mm, with the bound of its residual."""
    a, c, e = (scale * float(length) for length in problem.lengths(row))
    first = row[3:] if problem.turns is None else np.repeat(row[3:], len(problem.turns))
    turns = np.zeros(len(first)) if problem.turns is None else problem.turns
    first = np.angle(np.exp(1j * first))
    with ctx.workdps(_DIGITS):
        worst = max(
            _distance(
                (a, c, e),
                problem.branch,
                arb(float(phi)) + arb(float(turn)),
                float(ratio),
                complex(place) * scale,
            )
            for phi, turn, ratio, place in zip(first, turns, problem.each_ratio, problem.targets, strict=True)
        )
    angles = tuple(float(phi) for phi in first + turns)
    return Found(a, c, e, problem.branch, angles, tuple(problem.each_ratio.tolist()), worst)


def _distance(
    lengths: tuple[float, float, float], branch: int, angle: arb, ratio: float, place: complex
) -> float:
    """Upper bound of the pole's distance from its place, in interval arithmetic."""
    a, c, e = lengths
    x, y = arb(a) * angle.cos(), arb(a) * angle.sin()
    t = arb(e) - y
    w = branch * (arb(c) ** 2 - t * t).sqrt()
    omega = -x / w
    alpha = (y + t * omega * omega) / w + ratio * omega
    found = acb(x, y) * (1 + acb(1, -ratio) / acb(-omega * omega, alpha))
    return float(abs(found - acb(place.real, place.imag)).abs_upper())
