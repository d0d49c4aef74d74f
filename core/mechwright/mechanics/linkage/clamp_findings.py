"""What there is to say of joints that are clamped in slots."""

import math
from collections.abc import Iterator

from mechwright.contracts.finding import Finding
from mechwright.mechanics.linkage.clamp import Clamp, least_stud
from mechwright.mechanics.linkage.slots import Gap
from mechwright.mechanics.strength.bolts import CLAMP_SAFETY
from mechwright.tolerances import exceeds

PLATE = 6.0
"""Thickness of a plate that every screw of the table has a length for, mm."""


def no_clamp(code: str, pin: float, thickness: float) -> Finding:
    """Places too near to each other for holes, and pins too thin for a clamp, mm."""
    least = least_stud()
    return Finding.error(
        code,
        "pin_diameter",
        "the phases need pivots in one place, so they are set in slots, and no screw clamps a stud of "
        f"{pin:g} mm "
        f"in plates of {thickness:g} mm",
        pin,
        least,
        "mm",
        f"take pins of {least:g} mm or more and plates of {PLATE:g} mm, or pins so thin that each phase "
        "has its "
        "holes",
        proposed=({"parameters.pin_diameter": least, "parameters.thickness": PLATE},),
    )


def too_near(code: str, gap: Gap, rim: float, pin: float) -> Finding:
    """Openings of phases that leave less than a rim between them, mm."""
    smaller = tuple(
        {"parameters.pin_diameter": size, "parameters.rim": min(rim, size / 2)}
        for size in (8.0, 6.0, 5.0, 4.0, 3.0, 2.0)
        if size < pin
    )
    return Finding.error(
        code,
        "phases",
        f"the phases need pivots in one place: {gap.what} are {gap.distance:.4g} mm apart in the coupler, "
        "and "
        f"openings and rim need {gap.walls + rim:.4g} mm",
        gap.distance,
        gap.walls + rim,
        "mm",
        "set the machine in another pose, or take smaller pins, bushings or rims",
        proposed=smaller,
    )


def clamped(code: str, name: str, clamp: Clamp, force: float) -> Iterator[Finding]:
    """Whether the clamp of a joint holds a force, N, with safety; and what it is."""
    pulled = CLAMP_SAFETY * force
    if exceeds(pulled, clamp.holds):
        least = least_stud(pulled)
        yield Finding.warning(
            code,
            "pin_diameter",
            f"the clamp of {name} holds {clamp.holds:.4g} N by friction, and {CLAMP_SAFETY:g} times the "
            "load is "
            f"{pulled:.4g} N",
            pulled,
            clamp.holds,
            "N",
            "take thicker pins, whose screws are larger, a smaller load or a lower speed",
            proposed=({"parameters.pin_diameter": least},) if math.isfinite(least) else (),
        )
    yield Finding.note(
        code,
        f"{name} is set in a slot {clamp.width:g} mm wide and clamped by an M{clamp.size.size:g}, "
        "tightened with "
        f"{clamp.tightening:.3g} N m; it holds {clamp.holds:.4g} N, and carries up to {force:.4g} N",
        clamp.holds,
        "N",
    )
