"""Rules of the teeth before the mesh: module, phase, rack, roots, undercut, tips, shaft opening, drive."""

import math

import numpy as np

from mechwright import Severity
from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.rule_list import all_of, in_turn
from mechwright.mechanics.gearing.checks import SHAFT_PRESSURE_ANGLE
from mechwright.mechanics.gearing.tooth_rules import CLEARANCE, LAND, NO_CLEARANCE, RACK, RIM, TIP
from mechwright.mechanics.opening_rules import keyed_rules, size_rules
from mechwright_elliptic_gears.kinematics.figures import steepest_pressure_angle
from mechwright_elliptic_gears.parameters import LEAST_MODULE
from mechwright_elliptic_gears.parts.tooth_offset import offset_miss, offsets_that_mesh
from mechwright_elliptic_gears.rules.undercut import CONVEX, UNDERCUT
from mechwright_elliptic_gears.table import GearTable

Rule = DesignRule[GearTable]
Fails = Failure[GearTable]

MODULE = Rule(
    "gear.module",
    "teeth",
    "{m.given.teeth} teeth on this ellipse make a module of {value:.3g} mm, below {limit:g} mm",
    value=lambda m: m.module,
    limit=LEAST_MODULE,
    unit="mm",
    remedy=lambda f: (
        f"use at most {math.floor(f.m.given.teeth * f.value / LEAST_MODULE)} teeth, or a larger semi_major"
    ),
)


def _nearest_offset(f: Fails) -> float:
    given = f.m.given.tooth_offset or 0.0
    return float(min(offsets_that_mesh(f.m.given.teeth), key=lambda value: abs(given - value)))


def _offsets(f: Fails) -> str:
    one, two = offsets_that_mesh(f.m.given.teeth)
    return f"{'odd' if f.m.given.teeth % 2 else 'even'} numbers of teeth need {one:g} or {two:g}"


PHASE = Rule(
    "gear.phase",
    "tooth_offset",
    "wrong phase: with a tooth {m.given.tooth_offset:g} pitches from the far vertex, two gears of "
    "{m.given.teeth} teeth collide",
    value=lambda m: offset_miss(m.given.tooth_offset, m.given.teeth),
    limit=0.0,
    must_be="at most",
    remedy=_offsets,
    when=lambda m: m.given.tooth_offset is not None,
    reported=lambda f: (f.m.given.tooth_offset, _nearest_offset(f)),
    proposed=lambda f: ({"parameters.tooth_offset": _nearest_offset(f)},),
)
DRIVE = Rule(
    "gear.pressure-angle",
    "eccentricity",
    "the pressure angle that the shaft sees reaches {value:.1f} degrees at e = {m.given.eccentricity:g}, "
    "above {limit:g}: the teeth push more than they turn",
    value=lambda m: np.degrees(steepest_pressure_angle(m)),
    limit=SHAFT_PRESSURE_ANGLE,
    unit="deg",
    must_be="at most",
    severity=Severity.WARNING,
    remedy=lambda f: (
        f"make eccentricity at most {_least_steep(f):g}, or let a coupler between the free foci carry the "
        "steep part"
    ),
)


def _least_steep(f: Fails) -> float:
    """The greatest eccentricity that is not too steep."""
    most = math.sin(math.radians(SHAFT_PRESSURE_ANGLE - f.m.given.pressure_angle))
    return math.floor(round(most * 1e3, 6)) / 1e3


OUTLINE = in_turn(
    # What must hold before any curve is drawn.
    all_of(MODULE, PHASE, RACK, NO_CLEARANCE, CLEARANCE, CONVEX, LAND),
    UNDERCUT,
    TIP,
)
TEETH = in_turn(
    OUTLINE,
    all_of(*size_rules("bore", "keyway_width", "keyway_relief", "tracer_diameter")),
    keyed_rules(),
    RIM,
)
