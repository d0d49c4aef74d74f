"""The rules of a linkage, in the order in which they are asked."""

from mechwright.contracts.rule_list import in_turn
from mechwright.mechanics.linkage.rules.part_rules import part_rules
from mechwright.mechanics.linkage.rules.strength import strength_rules
from mechwright_linkage.rules.motion_rules import MOTION, TRANSMISSIONS
from mechwright_linkage.rules.notes import NOTES
from mechwright_linkage.table import LinkageTable

RULES = in_turn(MOTION, TRANSMISSIONS, part_rules(LinkageTable.code), strength_rules(LinkageTable), NOTES)
