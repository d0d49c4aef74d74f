"""The rules of spur gears, in the order in which they are asked."""

from typing import cast

from mechwright.contracts.rule_list import Rules, all_of, in_turn
from mechwright.mechanics.gearing.rack_plate import RACK_RULES
from mechwright.mechanics.gearing.ring_plate import RING_RULES
from mechwright.mechanics.gearing.tooth_rules import CLEARANCE, NO_CLEARANCE
from mechwright_spur_gears.gear_table import GearTable
from mechwright_spur_gears.rules.mesh_rules import MESH, OUTLINES
from mechwright_spur_gears.rules.planet_rules import APART, CARRIER, COAXIAL, EQUAL, PLACES
from mechwright_spur_gears.rules.rack_rules import FILLET, TRAVEL
from mechwright_spur_gears.rules.rack_rules import SIZE as RACK_SIZE
from mechwright_spur_gears.rules.ring_rules import AXIAL, CUTTER_LAND, FOULING, RING_TEETH, RING_TIP
from mechwright_spur_gears.rules.strength import STRENGTH
from mechwright_spur_gears.rules.teeth_rules import (
    ARC,
    BACKLASH,
    CONTACT,
    DISTANCE,
    INTERFERENCE,
    JAMS,
    LAND,
    OPENING,
    RIM,
    ROUGH,
    SHIFT,
    SIZE,
    THIN_RIM,
    TIP,
    TOO_NEAR,
    UNDERCUT,
)


def of_rings(*rules: object) -> Rules[GearTable]:
    """Rules in turn that are asked of gears with a ring."""
    return in_turn(*rules, when=lambda m: m.ring)  # type: ignore[arg-type]


def of_planets(*rules: object) -> Rules[GearTable]:
    """Rules in turn that are asked of planetary sets."""
    return in_turn(*rules, when=lambda m: m.planetary)  # type: ignore[arg-type]


def of_racks(*rules: object) -> Rules[GearTable]:
    """Rules in turn that are asked of racks."""
    return in_turn(*rules, when=lambda m: m.straight)  # type: ignore[arg-type]


def of_gears(*rules: object) -> Rules[GearTable]:
    """Rules in turn that are asked of all but racks."""
    return in_turn(*rules, when=lambda m: not m.straight)  # type: ignore[arg-type]


MOTION = in_turn(of_rings(RING_TEETH), of_gears(DISTANCE, TOO_NEAR), of_planets(COAXIAL))
"""What a motion needs."""

CLEARANCES = cast("Rules[GearTable]", all_of(NO_CLEARANCE, CLEARANCE))
"""Of any table with a ``profile``."""

PROFILE = in_turn(
    all_of(SHIFT, ARC, LAND, CLEARANCES, of_rings(RING_TIP)),
    all_of(of_rings(CUTTER_LAND), UNDERCUT, TIP),
    all_of(CONTACT, ROUGH, INTERFERENCE),
    of_rings(FOULING),
    of_racks(FILLET, TRAVEL),
)
RULES = in_turn(
    MOTION,
    of_planets(EQUAL, APART),
    PROFILE,
    OPENING,
    all_of(RIM, THIN_RIM, of_rings(RING_RULES), of_racks(RACK_RULES), of_planets(CARRIER)),
    OUTLINES,
    MESH,
    all_of(STRENGTH, of_gears(SIZE, AXIAL), of_racks(RACK_SIZE), of_planets(PLACES)),
    all_of(JAMS, BACKLASH),
)
