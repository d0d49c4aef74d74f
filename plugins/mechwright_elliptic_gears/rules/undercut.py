"""Undercut, flank by flank, and the least number of teeth that is free of it."""

import math
from collections.abc import Iterator

import numpy as np

from mechwright import Finding
from mechwright.mechanics.gearing.usual import LEAST_REGULARITY, MOST_TEETH
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import ellipse_of, rack_of, teeth_of
from mechwright_elliptic_gears.parts.tooth_offset import offset_miss


def undercut_findings(params: EllipticGearParams) -> Iterator[Finding]:
    """An error if any flank is undercut, with what would not be."""
    factor = teeth_of(params).least_regularity
    bad = factor < LEAST_REGULARITY
    if not bad.any():
        return
    space, side = np.unravel_index(int(np.argmin(factor)), factor.shape)
    better = least_teeth(params)
    if better is None:
        remedy = "use a smaller dedendum or a larger pressure_angle"
        most = greatest_eccentricity(params)
        if most is not None:
            remedy = f"make eccentricity at most {most:g}, with {_finest(params)} teeth, or {remedy}"
    else:
        remedy = f"use {better.teeth} teeth, the least number that works"
        if params.semi_major is not None:
            remedy += f" (a module of at most {rack_of(better).module:.4f} mm)"
    yield Finding.error(
        "gear.undercut",
        "teeth",
        f"{int(bad.sum())} of {bad.size} flanks are undercut, most of all that on side "
        f"{int(side) * 2 - 1:+d} of space {int(space)}: its regularity falls to "
        f"{float(factor.min()):.3f} of that on the pitch curve",
        params.teeth,
        None if better is None else better.teeth,
        remedy=remedy,
    )


def greatest_eccentricity(params: EllipticGearParams) -> float | None:
    """The greatest smaller eccentricity with which some number of teeth is free of undercut, to 0.001.

    Finer teeth are cut less deeply into an ellipse of the same size, so the greatest number decides.
    """
    teeth = _finest(params)

    def works(thousandths: int) -> bool:
        finest = params.model_copy(update={"teeth": teeth, "eccentricity": thousandths / 1000})
        return rack_of(finest).dedendum < ellipse_of(finest).least_radius and not is_undercut(finest)

    good, bad = 0, math.ceil(params.eccentricity * 1000)
    if not works(good):
        return None
    while bad - good > 1:
        middle = (good + bad) // 2
        good, bad = (middle, bad) if works(middle) else (good, middle)
    return good / 1000


def _finest(params: EllipticGearParams) -> int:
    """The greatest number of teeth that is proposed and that the tooth offset allows."""
    most = max(MOST_TEETH, params.teeth)
    if params.tooth_offset is None or offset_miss(params.tooth_offset, most) == 0:
        return most
    return most - 1


def is_undercut(params: EllipticGearParams) -> bool:
    """Whether any flank is undercut."""
    return bool((teeth_of(params).least_regularity < LEAST_REGULARITY).any())


def least_teeth(params: EllipticGearParams) -> EllipticGearParams | None:
    """The same design with the least greater number of teeth that is free of undercut.

    A tooth offset that the table gives is kept, so that only numbers of one parity come into question.
    None if no number up to ``MOST_TEETH`` is such.
    """
    for teeth in range(params.teeth + 1, MOST_TEETH + 1):
        if params.tooth_offset is not None and offset_miss(params.tooth_offset, teeth) > 0:
            continue
        candidate = params.model_copy(update={"teeth": teeth})
        rack, ellipse = rack_of(candidate), ellipse_of(candidate)
        # Some flank ends within half a pitch of the far vertex, where the curve is at its tightest: a cheap
        # test that nearly all numbers of teeth fail.
        radius = float(ellipse.frame_at(np.array(rack.pitch / 2)).radius)
        if rack.straight_depth > radius * math.sin(rack.pressure_angle) ** 2:
            continue
        if rack.dedendum < ellipse.least_radius and not is_undercut(candidate):
            return candidate
    return None
