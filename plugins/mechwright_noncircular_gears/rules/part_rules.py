"""Rules of the parts of a pair: size, cutter, pitch curves, openings, teeth, tips and rims, in order.

Whether the driver has room in a ring.
"""

import math

import numpy as np

from mechwright.contracts.design_rule import DesignRule, Failure
from mechwright.contracts.finding import Severity
from mechwright.contracts.rule_list import all_of, in_turn
from mechwright.mechanics.gearing.checks import SHAFT_PRESSURE_ANGLE
from mechwright.mechanics.gearing.ring_plate import RING_RULES
from mechwright.mechanics.gearing.tooth_rules import CLEARANCE, LAND, NO_CLEARANCE, RACK, RIM, TIP
from mechwright.mechanics.gearing.zone import Envelope, turned
from mechwright.mechanics.opening_rules import keyed_rules, size_rules
from mechwright_noncircular_gears.fields import LEAST_MODULE
from mechwright_noncircular_gears.rules.sector_rules import SECTORS
from mechwright_noncircular_gears.rules.shape_rules import CONVEXITY, UNDERCUT
from mechwright_noncircular_gears.rules.tip_rules import CUSP, TIP_FILLET
from mechwright_noncircular_gears.table import GearTable

_TURNED = 180
"""Positions of a turn of the ring in which the driver is looked at."""

_CORNERS = 8
"""Of the points of its pitch curve, every so many is looked at: one a degree."""

CROSSING = 0.1
"""Modules by which pitch curves may stand in each other: teeth that cross so deep collide whatever their
phase, and chords between corners of the curves are off by less."""


def _beyond(m: GearTable) -> tuple[float, float]:
    """How far, mm, the driver's pitch curve leaves the ring's, and the driver's angle there, rad."""
    pair = m.pair
    arc = pair.driver.perimeter * pair.turns(m.given.teeth) * np.arange(_TURNED) / _TURNED
    theta1, theta2 = pair.angles(arc)
    ring = Envelope.of(m.pitch_points[1], pair.driven, 0.0)
    own = turned(m.pitch_points[0][::_CORNERS], theta1[:, None]) - np.array([pair.axis, 0.0])
    height = ring.height(turned(own, -theta2[:, None])).max(axis=1)
    worst = int(height.argmax())
    return float(height[worst]), float(theta1[worst] % math.tau)


ROOM = DesignRule[GearTable](
    "gear.ring-room",
    "law",
    lambda f: (
        f"gear 1 has no room in the ring: at {math.degrees(_beyond(f.m)[1]):.1f} degrees its pitch "
        f"curve stands {f.value:.3f} mm outside of the ring's, away from where they touch"
    ),
    value=lambda m: _beyond(m)[0],
    limit=lambda m: CROSSING * m.rack.module,
    unit="mm",
    remedy="let the ratio change less, or make mate_lobes larger",
    must_be="at most",
    when=lambda m: m.given.internal,
)


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
