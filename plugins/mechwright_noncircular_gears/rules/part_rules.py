"""Rules of the parts of a pair: size, cutter, pitch curves, openings, teeth, tips and rims, in order."""

import math

from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.finding import Severity
from mechwright.contracts.rule_list import all_of, in_turn
from mechwright.mechanics.gearing.checks import SHAFT_PRESSURE_ANGLE
from mechwright.mechanics.gearing.ring_plate import RING_RULES
from mechwright.mechanics.gearing.tooth_rules import CLEARANCE, LAND, NO_CLEARANCE, RACK, RIM, TIP
from mechwright.mechanics.opening_rules import keyed_rules, size_rules
from mechwright_noncircular_gears.fields import LEAST_MODULE
from mechwright_noncircular_gears.rules.ring_rules import ROOM
from mechwright_noncircular_gears.rules.sector_rules import SECTORS
from mechwright_noncircular_gears.rules.shape_rules import CONVEXITY, UNDERCUT
from mechwright_noncircular_gears.rules.tip_rules import CUSP, TIP_FILLET
from mechwright_noncircular_gears.table import GearTable

LOCKED_ANGLE = 85.0
"""Degrees of pressure angle: at 90 the force of a tooth has no lever left about the shaft."""

Rule = DesignRule[GearTable]


def _angle(m: GearTable) -> float:
    return m.given.pressure_angle + math.degrees(m.extremes.steepest.value)


def _does(f: Failure[GearTable], does: str) -> str:
    place = math.degrees(f.m.extremes.steepest.angle)
    return (
        f"the pressure angle that the shaft sees reaches {f.value:.1f} degrees at {place:.1f} degrees of "
        f"gear 1, above {f.limit:g}: the teeth {does}"
    )


STEEP = Rule(
    "gear.pressure-angle",
    "law",
    lambda f: _does(f, "push more than they turn"),
    value=_angle,
    limit=SHAFT_PRESSURE_ANGLE,
    unit="deg",
    remedy="let the ratio change over a longer angle of the driver",
    must_be="at most",
    severity=Severity.WARNING,
    when=lambda m: _angle(m) < LOCKED_ANGLE,
)
LOCKED = STEEP.but(
    message=lambda f: _does(f, "lock"),
    limit=LOCKED_ANGLE,
    must_be="below",
    severity=Severity.ERROR,
    when=None,
)

SIZE = Rule(
    "gear.module",
    "teeth",
    lambda f: (
        f"{f.m.given.teeth} teeth at this centre distance make a module of {f.value:.3g} mm, "
        f"below {LEAST_MODULE:g} mm"
    ),
    value=lambda m: m.rack.module,
    limit=LEAST_MODULE,
    unit="mm",
    remedy=lambda f: (
        f"use at most {math.floor(f.m.given.teeth * f.value / LEAST_MODULE)} teeth, or a larger "
        "centre_distance"
    ),
)

PARTS = in_turn(
    SIZE,
    all_of(RACK, NO_CLEARANCE, CLEARANCE),
    CONVEXITY,
    ROOM,
    in_turn(all_of(*size_rules("bore", "keyway_width", "keyway_relief")), keyed_rules()),
    SECTORS,
    LAND,
    UNDERCUT,
    CUSP,
    TIP,
    TIP_FILLET,
    RIM,
    in_turn(RING_RULES, when=lambda m: m.given.internal),
    all_of(LOCKED, STEEP),
)
