"""The blocks of Klartext (TNC 640, iTNC 530, TNC 620, TNC 320): HEIDENHAIN's manuals.

Here a block is a code with the words that it takes; R0 stands for no compensation.
"""

from mechwright_cam.controls.words.common import SPINDLE
from mechwright_cam.controls.words.kept import Kept, Then, everywhere, shown_by_none
from mechwright_cam.controls.words.table import Address, Code, Use, Words, addresses, g, m

NO_CYCLE = "cycles are not read; post the moves"
SHIFT = "shifts or turns the work; set a preset with CYCL DEF 247"
NO_JUMP = "parameters, jumps and calls are not read; post the program without them"
ROUNDED = "write L, C with CC, CR or CP"
LONGEST = 128
"""Characters of a block."""
MOST_M = 2
"""M functions of a block."""


def block(word: str, takes: str = "", *, needs: str = "", use: Use = Use.ONCE) -> Code:
    """The row of a block: what it takes, and what of that has to stand there."""
    return Code(word, use, takes=addresses(takes) if takes else (), one_of=addresses(needs) if needs else ())


def named(words: str, remedy: str) -> tuple[Code, ...]:
    """Rows of words that are not read, with what to do instead."""
    return tuple(Code(word, Use.REFUSED, remedy=remedy) for word in words.split())


WORDS = Words(
    (
        block("L", "X Y Z R F M"),
        block("CC", "X Y", needs="X Y"),
        block("C", "X Y DR R F M", needs="X Y DR"),
        block("CR", "X Y RADIUS DR R F M", needs="X Y RADIUS DR"),
        block("CP", "IPA IZ DR R F M", needs="IPA DR"),
        block("M", "M ", needs="M "),
        block("TOOL CALL", "T Z S F DL DR"),
        block("TOOL DEF", "T ", needs="T "),
        block("CYCL DEF 247", "Q339 ", needs="Q339 "),
        block("CYCL DEF 9", "DWELL ", needs="DWELL "),
        block("CYCL DEF 32", "T "),
        block("STOP"),
        block("BLK FORM", "X Y Z", use=Use.IDLE),
        Code("LBL", Use.ONCE, remedy=NO_JUMP),
        block("CALL LBL"),
        *m("M0 M1 M2 M30 M3 M4 M5 M8 M9"),
        *m("M7"),
        *m("M13", becomes="M3 M8"),
        *m("M14", becomes="M4 M8"),
        *m("M91", group="machine place", becomes="G53"),
        *named("CYCL7 CYCL8 CYCL10 CYCL11 CYCL19 CYCL26", SHIFT),
        *named("CYCL12", NO_JUMP),
        *named("CYCL13", "it turns the spindle; post the program without it"),
        *named("CALL FN Q QL QR QS SEL PGM REP DECLARE", NO_JUMP),
        *named("RND CHF CT CTP LP APPR DEP LN SPL FL FC FLT FCT FPOL", ROUNDED),
        *named("PLANE TRANS FUNCTION", SHIFT),
        *named("TCH PATTERN", NO_CYCLE),
        *named("RL RR", "cutter compensation is not read; post the path of the tool's centre, R0"),
        *named("IX IY IPR", "write places as absolute coordinates"),
        *named("IZ", "write heights as absolute coordinates; IZ is read with CP"),
        *named("PA", "write IPA, the angle from where the tool stands"),
        *named("FAUTO", "write the feed"),
        *named("FT FZ FU", "write feeds in mm/min, or in tenths of an inch a minute"),
        *named("A B U V W", "this is a three-axis interpreter"),
        *named("M6", "write TOOL CALL, which changes the tool"),
        *named("M89 M99", NO_CYCLE),
        *named("M92", "its datum is the machine builder's own; write M91"),
        *named("M140", "it goes as far as the machine can; write L Z R0 FMAX M91"),
        *named("M90 M103 M112 M124 M136", "it changes path or feed as it likes; take it out"),
    ),
    (
        Address("IPA", -99_999.9999, 99_999.9999),
        Address("F", 0),
        Address("S", 0),
        Address("T", 0, 32_767, parts=False),
        Address("Q339", 1, 6, parts=False),
    ),
)

INTERPRETED = Words(
    (
        *g("G0 G1", "XYZ"),
        *g("G2 G3", "XYZIJRP"),
        *g("G4", "P"),
        *g("G53", "XYZ"),
        *g("G64", "PQ"),
        *g("G43 G49 G17 G20 G21 G40 G54 G55 G56 G57 G58 G59 G90 G90.1 G94"),
        *m("M0 M1 M2 M30 M6 M7 M8"),
        *SPINDLE,
        *m("M9", excludes=("M7", "M8")),
    ),
    (Address("F", 0), Address("S", 0), Address("T", 0, 32_767, parts=False)),
)
"""The codes of the interpreter that blocks come to."""

KEPT = (
    *everywhere(cycles=False),
    Kept("feed mode", "M136", Then.RESET),
    Kept("path tolerance", "cycle 32", Then.RESET),
    *shown_by_none(
        **{
            "a datum shift, mirror, rotation, scaling or tilted plane": "cycles 7, 8, 10, 11, 19, 26, PLANE",
            "moves of the handwheel, look-ahead": "M118, M120",
        }
    ),
)
