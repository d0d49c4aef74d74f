"""How far tips reach into their mates, in closed form: whether they can collide, and what keeps them out.

A tooth's tip meets the mate's flank when the pitch point has gone the arc u from where that flank crosses the
pitch curve, and the contact lies u sin α cos α below the pitch line of the rack. The rack's straight flank
ends in its tip arc at a depth of h_f - r_f (1 - sin α). What reaches below that meets no flank but a fillet,
and with too little room at the root it meets that as well.
"""

import math
from collections.abc import Iterator

import numpy as np

from mechwright import GeometryError
from mechwright.contracts.finding import Change
from mechwright.mechanics.gearing.checks import LEAST_CLEARANCE
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import teeth_of

DOUBT = 0.03
"""Modules of flank left below a tip from which no tip was seen to collide, if it clears the root as well."""

_SPARE = 0.005
"""Modules of flank that a cure leaves below the tips."""

_STEP = 1e-3
"""Modules: of a value that is named."""


def tip_depth(params: EllipticGearParams) -> float:
    """Depth, modules, below the mate's pitch curve of the rack at which the deepest tip ends its contact.

    Raises
    ------
    GeometryError
        A flank does not reach its tip.
    """
    teeth = teeth_of(params)
    alpha = teeth.rack.pressure_angle
    arcs = np.abs(teeth.curve.arc(teeth.tip_trim[0]) - teeth.flank_arcs)
    return float(arcs.max()) * math.sin(alpha) * math.cos(alpha) / teeth.rack.module


def may_collide(params: EllipticGearParams) -> bool:
    """Whether only the mesh proof can tell: tips reach the fillets or roots of their mates, or nearly so."""
    rack = teeth_of(params).rack
    try:
        left = rack.straight_depth / rack.module - tip_depth(params)
    except GeometryError:
        return False
    return left < DOUBT or params.dedendum - params.addendum < LEAST_CLEARANCE


def that_clear(params: EllipticGearParams) -> Iterator[Change]:
    """Changes that end the flanks below the tips and leave room at the roots, those of one key first."""
    try:
        needed = tip_depth(params) + _SPARE
    except GeometryError:
        return
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
