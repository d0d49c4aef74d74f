"""The words of Haas mills: the operator's manual, and custom of the trade."""

from dataclasses import replace

from mechwright_cam.controls.words.common import RS274
from mechwright_cam.controls.words.fanuc import SHIFTS, fanuc_like
from mechwright_cam.controls.words.kept import Kept, Then, everywhere, feed_mode, shown_by_none
from mechwright_cam.controls.words.table import Address, OffsetTable, Use, g, m

OFFSETS = 200
"""The highest H and D."""

WORDS = (
    fanuc_like("L")
    .without("G30")
    .but(
        *g("G154", "P", one_of=("P",)),
        *g("G50 G69", use=Use.IDLE),
        *g("G103 G187", "P", use=Use.IDLE),
        *g("G4", first_of=("P",), alone=True),
        *g("G74 G84", "XYZRL", pointless=("L",)),
        *m("M31 M33 M88", use=Use.IDLE),
        *m("M89", group="spindle", spindle=0),  # it ends coolant through the spindle, and stops that before
        tables=(
            OffsetTable(2, "XYZ", 0, 6),
            *(OffsetTable(number, "R", 1, OFFSETS) for number in (10, 11, 12, 13)),
            OffsetTable(20, "XYZ", 1, 99),
        ),
    )
    .bounded(
        Address("F", 0, point="needed"),  # setting 77, as it comes
        *(replace(RS274.of(letter), most=OFFSETS) for letter in "HD"),
    )
)

KEPT = (
    *everywhere(),
    feed_mode(Then.RESET),  # M30 and RESET bring G94 back
    Kept("smoothness", "G187", Then.RESET),
    *shown_by_none(**SHIFTS, mirror="G101", a_turn="G68"),
)
