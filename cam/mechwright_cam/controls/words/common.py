"""Rows that several controls share: RS274 words as nearly every mill has them."""

from mechwright_cam.controls.words.table import LENGTHS, Address, Code, OffsetTable, Point, Use, Words, g, m

CENTRE = "shift the origin with a work offset"
FEEDS = "write feeds in units per minute (G94)"
MACROS = "macros and subprograms are not read; post the program without them"
ARC = "XYZIJKR"
"""What an arc takes: its end, and its centre or its radius."""


def cycles(repeats: str) -> tuple[Code, ...]:
    """Drilling and tapping cycles of a control; ``repeats`` is the address of how often they are run."""
    often = {"pointless": tuple(repeats)}
    return (
        *g("G81 G85", f"XYZR{repeats}", **often),
        *g("G82 G84 G89", f"XYZRP{repeats}", **often),
        *g("G73 G83", f"XYZRQ{repeats}", **often),
    )


MODES = g("G17 G18 G19 G20 G21 G40 G49 G54 G55 G56 G57 G58 G59 G61 G64 G90 G91 G94 G98 G99")
"""Codes that hold, and take no words."""
HOMES = g("G28 G30", "XYZ")
MILLING = (
    *g("G0 G1", "XYZ"),
    *g("G2 G3", ARC),
    *g("G80"),
    *cycles("L"),
    *MODES,
    *g("G41 G42", "D"),
    *g("G43", "H"),
    *g("G4", "P"),
    *g("G10", "LPXYZR", pointless=tuple("RXYZ")),
    *HOMES,
    *g("G53", "XYZ"),
)
"""G codes that Fanuc and those who follow it share."""


def refused(words: str, remedy: str) -> tuple[Code, ...]:
    """Rows of codes that are not read, with what to do instead."""
    return g(words, use=Use.REFUSED, remedy=remedy)


NOT_SIMULATED = (
    *refused("G65 G66", MACROS),
    *refused("G52 G92", CENTRE),
    *refused("G93 G95", FEEDS),
    *refused("G68", "rotation is not simulated"),
    *refused("G51", "scaling is not simulated"),
)
"""G codes that they share as well, and that are refused."""
SPINDLE = (*m("M3", spindle=1), *m("M4", spindle=-1), *m("M5", spindle=0))
COOLANT_TOGETHER = (*m("M7 M8"), *m("M9", excludes=("M7", "M8")))
"""Where M7 and M8 may stand in one block."""
COOLANT_APART = m("M7 M8 M9", group="coolant")
"""Where they may not."""
STOPS = m("M0 M1 M2 M30")
M_CODES = (*STOPS, *SPINDLE, *m("M6"), *COOLANT_TOGETHER)
"""M codes that mean the same on nearly every mill."""
TABLES = (
    OffsetTable(2, "XYZ", 0, 6),
    *(OffsetTable(number, "R") for number in (10, 11, 12, 13)),
    OffsetTable(20, "XYZ", 1, 300),
)
NUMBERS = (
    Address("N", 0, 99_999, parts=False),
    Address("F", 0),
    Address("S", 0),
    *(Address(letter, 0, 99_999_999, parts=False) for letter in "THDL"),
)
"""Addresses whose numbers are bounded everywhere."""
RS274 = Words((*MILLING, *M_CODES), NUMBERS, TABLES)


def lengths(point: Point) -> tuple[Address, ...]:
    """The addresses of lengths, with whether they have a point."""
    return tuple(Address(letter, point=point) for letter in LENGTHS)
