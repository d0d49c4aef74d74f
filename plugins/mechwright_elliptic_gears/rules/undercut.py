"""Undercut, flank by flank, and the least number of teeth that is free of it.

A flank keeps its regularity if it would where the pitch curve is bent most; others are followed.
"""

import math

import numpy as np
from numpy.typing import NDArray

from mechwright import Stage
from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.design_table import with_columns
from mechwright.contracts.rule_list import all_of
from mechwright.mechanics.gearing.usual import LEAST_REGULARITY, MOST_TEETH
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import ellipse_of, teeth_of
from mechwright_elliptic_gears.parts.teeth import ENDS, least_regularity
from mechwright_elliptic_gears.parts.tooth_offset import offset_miss
from mechwright_elliptic_gears.table import GearTable, table_of

_SURE = 1e-9
"""Share by which a bound is off a limit beyond rounding."""


def _doubtful(m: GearTable) -> NDArray[np.bool_]:
    """Where a flank would be undercut at the tightest place (n, 1)."""
    gears = m.gears
    deepest = gears.straight_depth * gears.module / (gears.least_radius * np.sin(gears.angle) ** 2)
    return np.asarray(1 - deepest <= LEAST_REGULARITY + _SURE)


def _message(f: Failure[GearTable]) -> str:
    factor = teeth_of(f.m.given).least_regularity
    space, side = np.unravel_index(int(np.argmin(factor)), factor.shape)
    return (
        f"{int((factor < LEAST_REGULARITY).sum())} of {factor.size} flanks are undercut, most of all that on "
        f"side {int(side) * 2 - 1:+d} of space {int(space)}: its regularity falls to "
        f"{float(factor.min()):.3f} of that on the pitch curve"
    )


def _remedy(f: Failure[GearTable]) -> str:
    params = f.m.given
    better = least_teeth(params)
    if better is None:
        remedy = "use a smaller dedendum or a larger pressure_angle"
        most = greatest_eccentricity(params)
        if most is None:
            return remedy
        return f"make eccentricity at most {most:g}, with {_finest(params)} teeth, or {remedy}"
    remedy = f"use {better} teeth, the least number that works"
    if params.semi_major is None:
        return remedy
    return f"{remedy} (a module of at most {ellipse_of(params).perimeter / (math.pi * better):.4f} mm)"


UNDERCUT = DesignRule[GearTable](
    "gear.undercut",
    "teeth",
    _message,
    value=lambda m: least_regularity(m.gears),
    limit=LEAST_REGULARITY,
    remedy=_remedy,
    when=_doubtful,
    # mostly the end of a flank tells
    best=lambda m: least_regularity(m.gears, ENDS),
    reported=lambda f: (f.m.given.teeth, least_teeth(f.m.given)),
)


CONVEX = DesignRule[GearTable](
    "gear.convexity",
    "dedendum",
    lambda f: (
        f"the root lies {f.m.rack.dedendum:.3f} mm inside an ellipse that is curved by "
        f"{ellipse_of(f.m.given).least_radius:.3f} mm at the ends of its major axis: its offset curve "
        "crosses itself"
    ),
    value=lambda m: m.given.dedendum,
    limit=lambda m: m.gears.least_radius / m.gears.module,
    remedy="use more teeth, a smaller eccentricity or a smaller dedendum",
    must_be="below",
)


def without_undercut(m: GearTable) -> NDArray[np.intp]:
    """The places of the designs whose roots and flanks are regular."""
    return all_of(CONVEX, UNDERCUT).allowed(m, Stage.PARTS, lambda *_: None)[1]


def least_teeth(params: EllipticGearParams) -> int | None:
    """The least greater number of teeth up to ``MOST_TEETH`` that is free of undercut; None without one.

    A tooth offset that the table gives is kept, so that only numbers of one parity come into question.
    """
    numbers = np.arange(params.teeth + 1, MOST_TEETH + 1)
    if params.tooth_offset is not None:
        numbers = numbers[offset_miss(params.tooth_offset, numbers) == 0]
    if not numbers.size:
        return None
    others = with_columns(params, {"teeth": numbers[:, None].astype(float)})
    found = without_undercut(table_of(others, numbers.size))
    return int(numbers[found[0]]) if found.size else None


def greatest_eccentricity(params: EllipticGearParams) -> float | None:
    """The greatest smaller eccentricity with which some number of teeth is free of undercut, to 0.001.

    Finer teeth are cut less deeply into an ellipse of the same size, so the greatest number decides.
    """
    tried = np.arange(math.ceil(params.eccentricity * 1000) - 1, -1, -1)[:, None] / 1000
    others = with_columns(params, {"teeth": _finest(params), "eccentricity": tried})
    found = without_undercut(table_of(others, len(tried)))
    return float(tried[found[0], 0]) if found.size else None


def _finest(params: EllipticGearParams) -> int:
    """The greatest number of teeth that is proposed and that the tooth offset allows."""
    most = max(MOST_TEETH, params.teeth)
    if params.tooth_offset is None or offset_miss(params.tooth_offset, most) == 0:
        return most
    return most - 1
