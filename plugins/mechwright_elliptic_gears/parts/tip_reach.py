"""How far tips reach into their mates, in closed form: what keeps them from colliding.

A tooth's tip meets the mate's flank when the pitch point has gone the arc u from where that flank crosses the
pitch curve, and the contact lies u sin α cos α below the pitch line of the rack. The rack's straight flank
ends in its tip arc at a depth of h_f - r_f (1 - sin α). What reaches below that meets no flank but a fillet,
and with too little room at the root it meets that as well.
"""

import math
from collections.abc import Iterator

from mechwright.contracts.finding import Change
from mechwright.mechanics.gearing.checks import LEAST_CLEARANCE
from mechwright_elliptic_gears.parameters import EllipticGearParams

_SPARE = 0.005
"""Modules of flank that a cure leaves below the tips."""

_STEP = 1e-3
"""Modules: of a value that is named."""


def that_clear(params: EllipticGearParams, depth: float) -> Iterator[Change]:
    """Changes that end the flanks below the tips and leave room at the roots, those of one key first.

    ``depth``, modules below the mate's pitch curve, is where the deepest tip ends its contact.
    """
    needed = depth + _SPARE
    blunt = 1 - math.sin(math.radians(params.pressure_angle))
    radius = _down((params.dedendum - needed) / blunt)
    deep = _up(max(needed + params.tip_radius * blunt, params.addendum + LEAST_CLEARANCE))
    clears = params.dedendum - params.addendum >= LEAST_CLEARANCE
    if clears and 0 <= radius < params.tip_radius:
        yield {"parameters.tip_radius": radius}
    yield {"parameters.dedendum": deep}
    flank = params.dedendum - params.tip_radius * blunt
    low = min(params.addendum * flank / needed, params.dedendum - LEAST_CLEARANCE)
    yield {"parameters.addendum": _down(low)}
    root = _up(params.addendum + LEAST_CLEARANCE)
    sharp = _down((root - needed) / blunt)
    if not clears and 0 <= sharp < params.tip_radius:
        yield {"parameters.dedendum": root, "parameters.tip_radius": sharp}


def _up(value: float) -> float:
    return round(math.ceil(value / _STEP) * _STEP, 6)


def _down(value: float) -> float:
    return round(math.floor(value / _STEP) * _STEP, 6)
