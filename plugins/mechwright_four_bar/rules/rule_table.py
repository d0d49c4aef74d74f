"""The rules of a four-bar, in the order in which they are asked."""

import numpy as np

from mechwright import Finding
from mechwright.contracts.rule_list import OneByOne, all_of, in_turn
from mechwright_four_bar.rules.motion_rules import MOTION, NOTE
from mechwright_four_bar.rules.part_rules import PARTS
from mechwright_four_bar.rules.setting_rules import CAN_BE_SET, STEPS
from mechwright_four_bar.rules.strength import BEARINGS, CLAMPS, STRENGTH
from mechwright_four_bar.table import FourBarTable

RULES = in_turn(
    OneByOne(lambda t: bool(t.given.phases)),
    CAN_BE_SET,
    all_of(in_turn(MOTION, PARTS, NOTE, BEARINGS, STRENGTH, CLAMPS), STEPS),
)


def findings_of(table: FourBarTable, *, quick: bool = False) -> list[Finding]:
    """Everything that is to be said about a design; ``quick`` without the sizes that would bear a load."""

    def found() -> list[Finding]:
        with np.errstate(all="ignore"):
            return RULES.findings(table, quick=quick)

    return table.once(("findings", quick), found)
