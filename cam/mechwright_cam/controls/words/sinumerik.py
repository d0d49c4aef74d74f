"""The words of SINUMERIK 840D sl, 828D and ONE: the programming manual of Siemens.

The codes come to RS274 words, which the interpreter reads: ``becomes``.
"""

from dataclasses import replace

from mechwright_cam.controls.words.common import SPINDLE
from mechwright_cam.controls.words.kept import Kept, Then, everywhere, feed_mode, shown_by_none
from mechwright_cam.controls.words.table import Address, Code, OffsetTable, Use, Words, addresses, g, m

UNITS = "it leaves feeds and offsets in other units; write G710, or G700 in inches"
SUPA = "it leaves some frames in force; write SUPA"
NO_SIDE = "cutter compensation is not read; post the path of the tool's centre"
ROUNDING = "it rounds corners as far as its settings let it; write G64, or G60 for exact stops"
FRAME = "it shifts or turns the work; write G54 to G57"
CYCLE = "cycles are not read; post the moves of the holes"
JUMP = "parameters, jumps and calls are not read; post the program without them"
PLAIN = "write places and centres as plain numbers"
AXES = "X Y Z"
RENAMED = {"CR": "R", "F": "F"}
"""Addresses that are others to the interpreter."""


def named(words: str, remedy: str) -> tuple[Code, ...]:
    """Rows of words that are not read, with what to do instead."""
    return tuple(Code(word, Use.REFUSED, remedy=remedy) for word in words.split())


WORDS = Words(
    (
        *g("G0 G1", AXES),
        *g("G2 G3", f"{AXES} I J CR"),
        *g("G4", "F", alone=True),
        *g("G17 G40 G54 G55 G56 G57 G64 G90 G91 G94"),
        *g("G60", group="path", becomes="G61"),
        *g("G700", group="units", becomes="G20"),
        *g("G710", group="units", becomes="G21"),
        Code("SUPA", Use.ONCE, "non-modal", addresses(AXES), becomes="G53"),
        Code("D0", Use.HOLDS, "length offset", becomes="G49"),
        Code("D1", Use.HOLDS, "length offset", becomes="G43"),
        Code("COMPOF", Use.IDLE),
        *m("M0 M1 M2 M30 M3 M4 M5 M7 M8"),
        *m("M9", excludes=("M7", "M8")),
        *m("M6", becomes="M6 G49"),  # which edge holds after a change, a setting of the machine says
        Code("$P_UIFR", Use.ONCE, takes=addresses(AXES), becomes="G10"),
        *named("G70 G71", UNITS),
        *named("G53 G153", SUPA),
        *named("G41 G42", NO_SIDE),
        *named("G641 G642 G643 G644 G645 CYCLE832 CTOL OTOL ADIS", ROUNDING),
        *named("COMPON COMPCURV COMPCAD COMPSURF", "it puts curves through lines; write COMPOF"),
        *named("G58 G59 TRANS ATRANS ROT AROT SCALE ASCALE MIRROR AMIRROR G500 CYCLE800", FRAME),
        *named("MCALL CYCLE", CYCLE),
        *named("R IF GOTOF GOTOB WHILE FOR CALL DEF PROC M17 RET", JUMP),
        *named("T", "call tools by number, such as T3"),
        *named("(", "comments stand behind ;"),
        *named("TURN", "write a block for each turn"),
        *named("AC IC", PLAIN),
    ),
    (
        Address("N", 0, 99_999_999, parts=False),
        Address("F", 0),
        Address("S", 0),
        Address("T", 0, 32_000, parts=False),
        Address("D", 0, 1, parts=False),
    ),
    (OffsetTable(2, "XYZ"),),
)

INTERPRETED = Words(
    (
        *g("G0 G1", "XYZ"),
        *g("G2 G3", "XYZIJR"),
        *g("G4", "P"),
        *g("G10", "LPXYZ"),
        *g("G53", "XYZ"),
        *g("G43 G49 G17 G20 G21 G40 G54 G55 G56 G57 G61 G64 G90 G91 G94"),
        *m("M0 M1 M2 M30 M6 M7 M8"),
        *SPINDLE,
        *m("M9", excludes=("M7", "M8")),
    ),
    tuple(replace(one) for one in WORDS.numbers if one.letter != "D"),
    WORDS.tables,
)
"""What they come to."""

KEPT = (
    *everywhere(cycles=False),
    feed_mode(Then.REFUSED),
    Kept("edge", "D", Then.REFUSED),
    *shown_by_none(a_frame="TRANS, ROT, SCALE, MIRROR, a basic or an external one"),
)
