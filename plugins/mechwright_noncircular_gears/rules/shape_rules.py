"""Whether a cutter can make the teeth: pitch curves that it follows, roots that fit in, no undercut."""

import math

import numpy as np

from mechwright import Array
from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.rule_list import in_turn
from mechwright.mechanics.gearing.usual import LEAST_REGULARITY, MOST_TEETH
from mechwright_noncircular_gears.kinematics.law import extremes_of
from mechwright_noncircular_gears.parameters import NoncircularParams
from mechwright_noncircular_gears.parts.cutter import FLATTEST, profile_of
from mechwright_noncircular_gears.table import GearTable, table_of

Rule = DesignRule[GearTable]
Fails = Failure[GearTable]


def _hollow_words(f: Fails) -> str:
    least, radius = f.m.extremes.curvatures[f.item], f.m.profile.shaper_radius
    return (
        f"the pitch curve of gear {f.item + 1} is hollow at {math.degrees(least.angle):.1f} "
        f"degrees of gear 1: its curvature there is {least.value / f.m.pair.distance:.5f} per mm, and "
        + (
            "a rack digs into the teeth of a hollow curve"
            if radius is None
            else f"a cutter of {radius:g} modules does not fit into it"
        )
    )


def _slower(f: Fails) -> str:
    first = 'set cutter = "shaper", or ' if f.m.profile.shaper_radius is None else ""
    if f.m.given.law == "slider":
        return f"{first}make window larger, or the stroke shorter: the ratio changes too fast"
    return f"{first}let the ratio change more slowly"


HOLLOW = Rule(
    "gear.convexity",
    "law",
    _hollow_words,
    value=lambda m: np.array([one.value for one in m.extremes.curvatures]),
    limit=lambda m: flattest(m.given),
    unit="1/mm",
    remedy=_slower,
    reported=lambda f: (f.value / f.m.pair.distance, f.limit / f.m.pair.distance),
    each=False,
)


def _sharpest(m: GearTable) -> Array:
    """Least radii of curvature, mm; infinite of a gear that is hollow all round."""
    sharp = np.array([one.value for one in m.extremes.sharpest])
    return np.where(sharp > 0, m.pair.distance / np.where(sharp > 0, sharp, 1.0), np.inf)


def _for_roots(f: Fails) -> int:
    return whole(f.m.given, math.ceil(f.m.given.teeth * f.value / f.limit * 1.05))


DEEP = Rule(
    "gear.convexity",
    "teeth",
    lambda f: (
        f"the root lies {f.value:.3f} mm inside the pitch curve of gear {f.item + 1}, which is "
        f"curved by {f.limit:.3f} mm at {math.degrees(f.m.extremes.sharpest[f.item].angle):.1f} degrees of "
        "gear 1"
    ),
    value=lambda m: m.rack.dedendum,
    limit=_sharpest,
    unit="mm",
    remedy=lambda f: f"use {_for_roots(f)} teeth",
    must_be="below",
    proposed=lambda f: ({"parameters.teeth": _for_roots(f)},),
    each=False,
)
CONVEXITY = in_turn(HOLLOW, DEEP)
"""Pitch curves that are too hollow, or curved more tightly than the roots are deep."""


def finer(params: NoncircularParams) -> int | None:
    """The teeth with which a shaper of so many modules is small enough for the hollows; None up to 300."""
    least = min(one.value for one in extremes_of(params).curvatures)
    # The radius of the cutter is to the centre distance as one is to the number of teeth.
    share = (FLATTEST - least) / (FLATTEST - flattest(params))
    more = whole(params, math.ceil(params.teeth * share * (1 + _SPARE)))
    return more if more <= MOST_TEETH else None


_SPARE = 0.01
"""Share of teeth beyond those with which a cutter just fits: as made, it has room."""


def whole(params: NoncircularParams, teeth: int) -> int:
    """So many teeth of the driver, or the next greater number of which the driven gear has whole ones too."""
    step = params.lobes // math.gcd(params.lobes, params.mate_lobes)
    return -(-teeth // step) * step


def flattest(params: NoncircularParams) -> float:
    """Least curvature, for a centre distance of 1, that the cutter can follow: κ + 1/R_c above 0."""
    radius = profile_of(params).shaper_radius
    if radius is None:
        return FLATTEST
    m = table_of(params)
    return FLATTEST - m.pair.distance / (radius * m.module)


def _undercut_words(f: Fails) -> str:
    factor = f.m.teeth[f.item].least_regularity
    space, side = np.unravel_index(int(np.argmin(factor)), factor.shape)
    return (
        f"{int((factor < LEAST_REGULARITY).sum())} of {factor.size} flanks of "
        f"gear {f.item + 1} are undercut, most of all that on side {int(side) * 2 - 1:+d} of "
        f"space {int(space)}: its regularity falls to {f.value:.3f} of that on the pitch curve"
    )


UNDERCUT = Rule(
    "gear.undercut",
    "teeth",
    _undercut_words,
    value=lambda m: np.array([float(one.least_regularity.min()) for one in m.teeth]),
    limit=LEAST_REGULARITY,
    remedy="use a smaller dedendum or a larger pressure_angle",
    reported=lambda f: (f.m.given.teeth, None),
    each=False,
)
"""Flanks of either gear that are undercut."""


def least_teeth(params: NoncircularParams) -> int | None:
    """The least greater number of teeth of the driver that is free of undercut; None up to 300."""
    step = params.lobes // math.gcd(params.lobes, params.mate_lobes)

    def works(count: int) -> bool:
        found = table_of(params).changed(teeth=count)
        sharpest = max(one.value for one in found.extremes.sharpest)
        return found.rack.dedendum * sharpest < found.pair.distance and UNDERCUT.allows(found)

    # Finer teeth reach less deeply into the same curve: the limit is found by halving, then looked at.
    low, high = params.teeth // step, MOST_TEETH // step
    if high <= low or not works(high * step):
        return None
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if works(middle * step) else (middle, high)
    return high * step
