"""From a wish to pairs of gears: the best law with hollow pitch curves, and the best with convex ones."""

import math
from typing import Any

import numpy as np
from pydantic import ValidationError

from mechwright import Candidate, Finding, Progress, Rejected, Scalar, Synthesis, kept
from mechwright_noncircular_gears.kinematics.law import extremes_of
from mechwright_noncircular_gears.parameters import NoncircularParams
from mechwright_noncircular_gears.requirements import FitRequirement
from mechwright_noncircular_gears.rules.remedies import with_remedy
from mechwright_noncircular_gears.rules.rule_table import RULES
from mechwright_noncircular_gears.sized import SizedParams
from mechwright_noncircular_gears.synthesis.goals import Goal, goal_of
from mechwright_noncircular_gears.synthesis.search import DENSE, STARTS, Fitted, fitted
from mechwright_noncircular_gears.synthesis.waves import Asked, Waves
from mechwright_noncircular_gears.table import table_of

DIGITS = 5
"""Decimals of amplitudes, degrees: 0.2 µrad."""

ALIKE = 1e-3
"""Share by which two laws of one wish differ at least."""

TIPS = ("gear.tip-cusp", "gear.tip-fillet")
"""Findings that say how high the teeth may be, in the order in which they are asked for."""

HALVINGS = 8
"""Of the way from what is asked to what a constant ratio meets, where no law is found."""


def from_wish(wanted: FitRequirement, progress: Progress) -> Synthesis[NoncircularParams]:
    """The laws that were found, the one that follows the wish best first."""
    goal, rejected = goal_of(wanted), Rejected()
    found: list[Candidate[NoncircularParams]] = []
    kinds = (True, False) if wanted.hollow else (False,)
    for number, hollow in enumerate(kinds):
        progress(number / len(kinds), "hollow pitch curves" if hollow else "convex pitch curves")
        law = fitted(goal, wanted, hollow)
        if not law.holds:
            continue
        params = _with_room(_params(wanted, law))
        if rejected.by(_findings(params)):
            continue
        least = goal.residual(reached(goal, params, law))
        candidate = Candidate(params, least, _figures(goal, params, law), goal.measure)
        if not any(_alike(candidate, one) for one in found):
            found.append(candidate)
    progress(1.0, "done")
    if found:
        found.sort(key=lambda one: one.residual.value)
        return Synthesis(tuple(found), (), rejected.reasons)
    return Synthesis((), (_none(wanted, goal, rejected),), rejected.reasons)


@kept
def _findings(params: NoncircularParams) -> tuple[Finding, ...]:
    """What a check of the pair finds."""
    with np.errstate(all="ignore"):
        return tuple(with_remedy(params, one) for one in RULES.findings(table_of(params)))


def _params(wanted: FitRequirement, law: Fitted) -> NoncircularParams:
    """A pair with all that the wish says of it."""
    same = {"teeth", "module", "pressure_angle", "thickness", "bore", "material", "speed"}
    amplitudes: dict[str, Any] = {
        name: tuple(round(math.degrees(one), DIGITS) for one in getattr(law, name))
        for name in ("sines", "cosines")
        if getattr(law, name)
    }
    return SizedParams.model_validate({**wanted.model_dump(include=same), "law": "fourier", **amplitudes})


def _with_room(params: NoncircularParams) -> NoncircularParams:
    """The pair with teeth as high as usual, or lower where the tips of hollow arcs ask for that."""
    for _ in TIPS:
        heights = [one.limit for one in _findings(params) if one.code in TIPS and one.proposed]
        if not heights:
            break
        params = params.model_copy(update={"addendum": heights[0]})
    return params


def reached(goal: Goal, params: NoncircularParams, law: Fitted) -> float:
    """The bound that the design, with its rounded amplitudes, keeps at many places."""
    sines, cosines = (np.radians(params.value(name)) for name in ("sines", "cosines"))
    z = np.concatenate((sines, cosines, law.unknowns))
    half = goal.window / 2
    waves = Waves(np.linspace(-half, half, DENSE), np.arange(1.0, sines.size + 1), goal.even)
    # A function y - f at least 0 says that f is at most y: the greatest f is y less the least of it.
    bound = len(z) - len(law.unknowns)
    return max(float(z[bound] - Asked(waves, one).values(z).min()) for one in goal.bounded())


def _figures(goal: Goal, params: NoncircularParams, law: Fitted) -> dict[str, Scalar]:
    found = extremes_of(params)
    return {
        "pressure_angle_max": Scalar(found.steepest.value + math.radians(params.pressure_angle), "rad"),
        "ratio_min": Scalar(found.slowest.value, ""),
        "ratio_max": Scalar(found.fastest.value, ""),
        "curvature_min": Scalar(min(one.value for one in found.curvatures), ""),
        **{name: Scalar(one, "rad") for name, one in zip(goal.told, law.unknowns[1:], strict=True)},
    }


def _alike(one: Candidate[NoncircularParams], two: Candidate[NoncircularParams]) -> bool:
    return abs(one.residual.value - two.residual.value) <= ALIKE * abs(two.residual.value)


def _none(wanted: FitRequirement, goal: Goal, rejected: Rejected) -> Finding:
    """Which law comes nearest, from what is asked to what a constant ratio meets."""
    if rejected.reasons:
        first = rejected.reasons[0]
        return Finding.error(
            "gear.requirement",
            "teeth",
            f"laws were found, but no pair that can be built with them: {first.message}",
            remedy="give more teeth, a lower pressure_limit, a smaller bore, or hollow = false",
        )
    starts = len(STARTS) * (2 if wanted.hollow else 1)
    end = goal.neutral()
    if end is None:
        return Finding.error(
            "gear.requirement",
            "harmonics",
            f"no law within the limits was found from {starts} starts",
            remedy="give more harmonics, or a higher pressure_limit",
        )
    key, easy = end
    asked = getattr(wanted, key)
    hard, good = asked, None
    for _ in range(HALVINGS):
        middle = round((hard + easy) / 2, 3)
        if _holds(_asking(wanted, key, middle)):
            easy = good = middle
        else:
            hard = middle
    nearest = (
        f"the nearest {key} with a law is {good:g}" if good is not None else "none was found nearer to it"
    )
    return Finding.error(
        "gear.requirement",
        key,
        f"no law for {key} = {asked:g} within the limits was found from {starts} starts",
        asked,
        good,
        "" if key == "time_ratio" else "deg",
        f"{nearest}; a higher pressure_limit, a lower least_ratio, more teeth or harmonics reach farther",
        proposed=({f"requirement.{key}": good},) if good is not None else (),
    )


def _asking(wanted: FitRequirement, key: str, value: float) -> FitRequirement | None:
    """The same wish with another value; None where the table refuses it."""
    try:
        return type(wanted).model_validate({**wanted.model_dump(), key: value})
    except ValidationError:
        return None


def _holds(wanted: FitRequirement | None) -> bool:
    return wanted is not None and fitted(goal_of(wanted), wanted, wanted.hollow).holds
