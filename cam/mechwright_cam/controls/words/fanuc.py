"""The words of Fanuc's mills (0i, 30i and their kin): manuals and custom of the trade."""

from dataclasses import replace

from mechwright_cam.controls.words.common import MILLING, NOT_SIMULATED, RS274, cycles, lengths
from mechwright_cam.controls.words.groups import CYCLES, spell
from mechwright_cam.controls.words.kept import Then, everywhere, feed_mode, shown_by_none
from mechwright_cam.controls.words.table import Address, Code, Use, Words, g, m


def fanuc_like(repeats: str) -> Words:
    """What Fanuc and Haas share: numbers with a point, one M code, and G80 beside any motion."""
    changed: list[Code] = [
        *g("G80", group="", excludes=tuple(sorted(map(spell, CYCLES)))),
        *g("G74", f"XYZRP{repeats}", pointless=(repeats,)),
        *g("G4", first_of=("P", "X"), pointless=("X",), alone=True),
        *g("G41 G42", "D", needs="D"),
        *g("G43", "H", needs="H"),
        *g("G28 G30", "XYZ", in_cycles=False),
        *m("M3", spindle=1, before_feed=False),
        *m("M4", spindle=-1, before_feed=False),
        *m("M19", spindle=0),
    ]
    rows = (*MILLING, *cycles(repeats), *NOT_SIMULATED, *changed)
    return RS274.but(*rows, one_m=True).bounded(*lengths("needed"))


WORDS = (
    fanuc_like("K")
    .but(
        *g("G54.1", "P", one_of=("P",)),
        *g("G54", "P"),
        *g("G28 G30", "XYZ", one_of=tuple("XYZ"), in_cycles=False),
        *g("G9 G97 G15 G50 G69", use=Use.IDLE),
        *g("G5.1", "QR", use=Use.IDLE, one_of=("Q",)),
        *g("G8", "P", use=Use.IDLE, one_of=("P",)),
        *m("M29", spindle=0),
    )
    .bounded(
        Address("F", 0, point="inches"),
        Address("P", point="never"),
        *(replace(RS274.of(letter), letter=letter, point="never") for letter in "STHDLM"),
    )
)

SHIFTS = {"an_origin_shift": "G92, G52", "scale": "G51"}
KEPT = (
    *everywhere(),
    feed_mode(Then.REFUSED),
    *shown_by_none(
        **SHIFTS, mirror="G51.1", a_turn="G68", polar_coordinates="G16", a_macro_in_each_block="G66"
    ),
)
