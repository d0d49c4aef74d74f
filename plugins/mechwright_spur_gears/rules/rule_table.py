"""The rules of a pair of spur gears, in the order in which they are asked."""

from mechwright.contracts.rule_list import all_of, in_turn
from mechwright_spur_gears.rules.strength import STRENGTH
from mechwright_spur_gears.rules.teeth_rules import (
    BACKLASH,
    JAMS,
    MESH,
    MOTION,
    OPENING,
    PROFILE,
    RIM,
    SIZE,
    THIN_RIM,
)

RULES = in_turn(
    MOTION, PROFILE, OPENING, all_of(RIM, THIN_RIM), MESH, all_of(STRENGTH, SIZE), all_of(JAMS, BACKLASH)
)
