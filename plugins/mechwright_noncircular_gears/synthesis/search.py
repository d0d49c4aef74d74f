"""The law that makes a goal least within the limits of its pitch curves: sequential quadratic programming."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import minimize

from mechwright import Array
from mechwright_noncircular_gears.parts.cutter import FLATTEST, SHAPER_RADIUS
from mechwright_noncircular_gears.requirements import FitRequirement
from mechwright_noncircular_gears.synthesis.goals import Goal
from mechwright_noncircular_gears.synthesis.waves import Asked, Pointwise, Waves

A_WAVE = 10
"""Places for each harmonic: extremes between them are lower by less than a part in a thousand."""

STEPS = 300
"""Of one search."""

ROUNDS = 4
"""Searches with narrower limits: each leaves a small share of what was passed."""

DENSE = 4001
"""Places of a turn at which limits are judged."""

_CONVEX = FLATTEST + 2e-3
"""Least curvature of convex pitch curves, for a centre distance of 1: with amplitudes rounded for a design
file it is less by up to a thousandth."""

STARTS = (1.0, 0.5, 0.0)
"""Shares of the smooth law where the search begins, until one leads to a law; 0 is the constant ratio."""

MOST = 3.0
"""Greatest A_j j²: laws of steeper harmonics turn back."""

HELD = 1e-7
"""By how much a limit may be passed: rounding of the search."""

_SPARE = 0.94
"""Share of the limits of curvature that a law uses: the centre distance is a little more than module times
teeth, and teeth stand beside the places that are looked at."""


@dataclass(frozen=True)
class Fitted:
    """A law that was found.

    Parameters
    ----------
    sines, cosines
        Amplitudes, rad.
    unknowns
        The bound that was made least, then the goal's own.
    holds
        Whether all limits are kept.
    """

    sines: tuple[float, ...]
    cosines: tuple[float, ...]
    unknowns: tuple[float, ...]
    holds: bool


def fitted(goal: Goal, wanted: FitRequirement, hollow: bool) -> Fitted:
    """Amplitudes of the best law that the search finds from a few smooth ones.

    Between the places of the search a limit may be passed by a little; it is then narrowed by that.
    """
    wished = _limits(wanted, hollow)
    narrowed = np.zeros(len(wished))
    waves = Waves(np.linspace(0.0, math.tau, DENSE), np.arange(1.0, wanted.harmonics + 1), goal.even)
    dense = [Asked(waves, one) for one in wished]
    for _ in range(ROUNDS):
        best = _within(goal, wanted, [_less(*one) for one in zip(wished, narrowed, strict=True)])
        if not best.holds:
            break
        z = np.array((*best.sines, *best.cosines, *best.unknowns))
        lacking = np.array([-float(one.values(z).min()) for one in dense])
        if lacking.max() <= HELD:
            return best
        narrowed += 1.5 * np.maximum(lacking, 0.0)
    return Fitted((), (), (), False)


def _less(function: Pointwise, by: float) -> Pointwise:
    return lambda at: function(at) - by


def _within(goal: Goal, wanted: FitRequirement, functions: list[Pointwise]) -> Fitted:
    orders = np.arange(1.0, wanted.harmonics + 1)
    reach = math.pi if goal.even else math.tau
    around = np.linspace(0.0, reach, A_WAVE * wanted.harmonics * (1 if goal.even else 2) + 1)
    half = goal.window / 2
    inside = np.linspace(0.0 if goal.even else -half, half, max(61, A_WAVE * wanted.harmonics) + 1)
    limits = [Asked(Waves(around, orders, goal.even), one) for one in functions]
    limits += [Asked(Waves(inside, orders, goal.even), one) for one in goal.bounded()]
    equations = [
        Asked(Waves(np.array([phi]), orders, goal.even), function) for phi, function in goal.places()
    ]
    smooth = _smooth(goal, equations, orders)
    best = Fitted((), (), (), False)
    for share in STARTS:
        best = _from(goal, limits, equations, share * smooth, orders)
        if best.holds:
            break
    return best


def _from(
    goal: Goal, limits: list[Asked], equations: list[Asked], amplitudes: Array, orders: Array
) -> Fitted:
    """From one law; the search's unknowns are A_j j², of one size for laws that teeth can follow."""
    count, own = amplitudes.size, len(goal.start)
    weight = np.append(np.tile(orders**-2.0, count // orders.size), np.ones(own))
    begin = np.concatenate((amplitudes, goal.start)) / weight

    def rule(kind: str, asked: list[Asked]) -> dict[str, Any]:
        return {
            "type": kind,
            "fun": lambda u: np.concatenate([one.values(weight * u) for one in asked]),
            "jac": lambda u: np.concatenate([one.slopes(weight * u) for one in asked]) * weight,
        }

    with np.errstate(all="ignore"):
        result = minimize(
            lambda u: u[count],
            begin,
            jac=lambda u: np.eye(u.size)[count],
            method="SLSQP",
            bounds=[(-MOST, MOST)] * count + [(0.0, None)] + [(None, None)] * (own - 1),
            constraints=[rule(kind, asked) for kind, asked in (("ineq", limits), ("eq", equations)) if asked],
            options={"maxiter": STEPS, "ftol": 1e-10},
        )
        z = weight * result.x
        holds = bool(
            np.all(np.isfinite(z))
            and min(float(one.values(z).min()) for one in limits) > -HELD
            and all(float(np.abs(one.values(z)).max()) < HELD for one in equations)
        )
    sines, cosines = z[: orders.size], z[orders.size : count]
    return Fitted(tuple(sines.tolist()), tuple(cosines.tolist()), tuple(z[count:].tolist()), holds)


def _limits(wanted: FitRequirement, hollow: bool) -> list[Pointwise]:
    """Functions that are at least 0 where the pitch curves keep their limits."""
    steepest = math.tan(math.radians(wanted.pressure_limit - wanted.pressure_angle))
    flattest = -_SPARE * wanted.teeth / SHAPER_RADIUS if hollow else _CONVEX
    # Undercut: the teeth's depth of about a module times the curvature stays below sin² α.
    sharpest = _SPARE * wanted.teeth * math.sin(math.radians(wanted.pressure_angle)) ** 2
    return [
        lambda at: steepest - at.slope,
        lambda at: steepest + at.slope,
        lambda at: at.i - wanted.least_ratio,
        lambda at: at.curvatures[0] - flattest,
        lambda at: at.curvatures[1] - flattest,
        lambda at: sharpest - at.curvatures[0],
        lambda at: sharpest - at.curvatures[1],
    ]


def _smooth(goal: Goal, equations: list[Asked], orders: Array) -> Array:
    """Amplitudes of the least ∫ i''² that keep the equations, which are linear in them."""
    copies = 1 if goal.even else 2
    count = orders.size * copies
    if not equations:
        return np.zeros(count)
    z = np.concatenate((np.zeros(count), goal.start))
    weight = np.tile(orders**-3.0, copies)
    rows = np.vstack([one.slopes(z)[:, :count] for one in equations])
    lacking = -np.concatenate([one.values(z) for one in equations])
    found: Array = weight * np.linalg.lstsq(rows * weight, lacking, rcond=None)[0]
    return found
