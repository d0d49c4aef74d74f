"""The rules of a linkage, in the order in which they are asked."""

from mechwright.contracts.rule_list import in_turn
from mechwright_linkage.rules.motion_rules import MOTION, TRANSMISSIONS
from mechwright_linkage.rules.notes import NOTES
from mechwright_linkage.rules.part_rules import PARTS
from mechwright_linkage.rules.strength import STRENGTH

RULES = in_turn(MOTION, TRANSMISSIONS, PARTS, STRENGTH, NOTES)
