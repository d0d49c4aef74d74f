"""Whether a rack can cut the teeth: convex pitch curves, roots that fit into them, and no undercut."""

import math
from collections.abc import Iterator

import numpy as np

from mechwright import Finding
from mechwright.contracts.finding import Change
from mechwright.mechanics.gearing.usual import LEAST_REGULARITY, MOST_TEETH
from mechwright_noncircular_gears.gear import NAMES, pair_of, rack_of, teeth_of
from mechwright_noncircular_gears.law import extremes_of
from mechwright_noncircular_gears.params import NoncircularParams
from mechwright_noncircular_gears.profile import FLATTEST, profile_of
from mechwright_noncircular_gears.softer import nearest, said


def convexity_findings(params: NoncircularParams, *, advise: bool = True) -> Iterator[Finding]:
    """Errors where a pitch curve is hollow, or curved more tightly than the roots are deep.

    A softer law is sought only to ``advise``.
    """
    found, a, cutter = extremes_of(params), pair_of(params).distance, profile_of(params)
    flattest = _hollowest(params)
    for name, least in zip(NAMES, found.curvatures, strict=True):
        if least.value < flattest:
            softer = nearest(params, lambda one: not hollow(one)) if advise else None
            words, changes = said(softer, _slower(params))
            if cutter.shaper_radius is None:
                words, changes = (
                    f'set cutter = "shaper", or {words}',
                    ({"parameters.cutter": "shaper"}, *changes),
                )
            elif not changes and (more := _finer(params)) is not None:
                words, changes = f"use {more} teeth, or {words}", ({"parameters.teeth": more},)
            yield Finding.error(
                "gear.convexity",
                "law",
                f"the pitch curve of {name.replace('-', ' ')} is hollow at {math.degrees(least.angle):.1f} "
                f"degrees of gear 1: its curvature there is {least.value / a:.5f} per mm, and "
                + (
                    "a rack digs into the teeth of a hollow curve"
                    if cutter.shaper_radius is None
                    else f"a cutter of {cutter.shaper_radius:g} modules does not fit into it"
                ),
                least.value / a,
                flattest / a,
                "1/mm",
                words,
                proposed=changes,
            )
            return
    deep = rack_of(params).dedendum
    for name, sharp in zip(NAMES, found.sharpest, strict=True):
        if deep * sharp.value >= a:
            radius = a / sharp.value
            more = whole(params, math.ceil(params.teeth * deep / radius * 1.05))
            yield Finding.error(
                "gear.convexity",
                "teeth",
                f"the root lies {deep:.3f} mm inside the pitch curve of {name.replace('-', ' ')}, which is "
                f"curved by {radius:.3f} mm at {math.degrees(sharp.angle):.1f} degrees of gear 1",
                deep,
                radius,
                "mm",
                f"use {more} teeth",
                proposed=({"parameters.teeth": more},),
            )
            return


def _finer(params: NoncircularParams) -> int | None:
    """The teeth with which a shaper of so many modules is small enough for the hollows; None up to 300."""
    least = min(one.value for one in extremes_of(params).curvatures)
    # The radius of the cutter is to the centre distance as one is to the number of teeth.
    share = (FLATTEST - least) / (FLATTEST - _hollowest(params))
    more = whole(params, math.ceil(params.teeth * share * (1 + _SPARE)))
    return more if more <= MOST_TEETH else None


_SPARE = 0.01
"""Share of teeth beyond those with which a cutter just fits: as made, it has room."""


def hollow(params: NoncircularParams) -> bool:
    """Whether a pitch curve is more hollow than the cutter can follow."""
    flattest = _hollowest(params)
    return any(least.value < flattest for least in extremes_of(params).curvatures)


def whole(params: NoncircularParams, teeth: int) -> int:
    """So many teeth of the driver, or the next greater number of which the driven gear has whole ones too."""
    step = params.lobes // math.gcd(params.lobes, params.mate_lobes)
    return -(-teeth // step) * step


def _hollowest(params: NoncircularParams) -> float:
    """Least curvature, for a centre distance of 1, that the cutter can follow: κ + 1/R_c above 0."""
    radius = profile_of(params).shaper_radius
    if radius is None:
        return FLATTEST
    return FLATTEST - pair_of(params).distance / (radius * rack_of(params).module)


def _slower(params: NoncircularParams) -> str:
    if params.law == "slider":
        return "make window larger, or the stroke shorter: the ratio changes too fast"
    return "let the ratio change more slowly"


def undercut_findings(params: NoncircularParams, *, advise: bool = True) -> Iterator[Finding]:
    """An error if any flank is undercut, with what would not be to ``advise``."""
    for name, teeth in zip(NAMES, teeth_of(params), strict=True):
        factor = teeth.least_regularity
        bad = factor < LEAST_REGULARITY
        if not bad.any():
            continue
        space, side = np.unravel_index(int(np.argmin(factor)), factor.shape)
        more = least_teeth(params) if advise else None
        remedy = "use a smaller dedendum or a larger pressure_angle"
        changes: tuple[Change, ...] = ()
        if more is not None:
            remedy, changes = f"use {more} teeth, the least number that works", ({"parameters.teeth": more},)
        elif advise:
            fields = nearest(params, lambda one: not is_undercut(one))
            if fields:
                remedy, changes = said(fields, "")
        yield Finding.error(
            "gear.undercut",
            "teeth",
            f"{int(bad.sum())} of {bad.size} flanks of {name.replace('-', ' ')} are undercut, most of all "
            f"that on side {int(side) * 2 - 1:+d} of space {int(space)}: its regularity falls to "
            f"{float(factor.min()):.3f} of that on the pitch curve",
            params.teeth,
            more,
            remedy=remedy,
            proposed=changes,
        )
        return


def is_undercut(params: NoncircularParams) -> bool:
    """Whether any flank of either gear is undercut."""
    return any(bool((teeth.least_regularity < LEAST_REGULARITY).any()) for teeth in teeth_of(params))


def least_teeth(params: NoncircularParams) -> int | None:
    """The least greater number of teeth of the driver that is free of undercut; None up to 300."""
    step = params.lobes // math.gcd(params.lobes, params.mate_lobes)

    def works(count: int) -> bool:
        found = params.model_copy(update={"teeth": count})
        sharpest = max(one.value for one in extremes_of(found).sharpest)
        return rack_of(found).dedendum * sharpest < pair_of(found).distance and not is_undercut(found)

    # Finer teeth reach less deeply into the same curve: the limit is found by halving, then looked at.
    low, high = params.teeth // step, MOST_TEETH // step
    if high <= low or not works(high * step):
        return None
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if works(middle * step) else (middle, high)
    return high * step
