"""The words of Grbl 1.1, from the source of its parser."""

from mechwright_cam.controls.words.common import CENTRE, COOLANT_APART, FEEDS, RS274, SPINDLE, STOPS, refused
from mechwright_cam.controls.words.kept import Then, everywhere, feed_mode, shown_by_none
from mechwright_cam.controls.words.table import Address, OffsetTable, Words, g

NO_D = "there is G40 only; post the path of the tool's centre"

WORDS = Words(
    (
        *g("G0 G1", "XYZ", axes=True),
        *g("G2 G3", "XYZIJKR", axes=True, ends_in_plane=True, across=True),
        *g("G80"),
        *g("G4", "P"),
        *g("G10", "LPXYZ", axes=True),
        *g("G28 G30", "XYZ", axes=True),
        *g("G43.1", "XYZ", axes=True),
        *g("G49", drops="XYZ", axes=True),
        *g("G53", "XYZ"),
        *g("G17 G18 G19 G20 G21 G40 G54 G55 G56 G57 G58 G59 G61 G90 G91 G91.1 G92.1 G94"),
        *refused("G41 G42", NO_D),
        *refused("G43", "there is no table of lengths; write G43.1 Z"),
        *refused("G38.2 G38.3 G38.4 G38.5", "probing is not simulated"),
        *refused("G92", CENTRE),
        *refused("G93", FEEDS),
        *STOPS,
        *SPINDLE,
        *COOLANT_APART,
    ),
    RS274.numbers,
    tuple(OffsetTable(number, "XYZ", 0, 6) for number in (2, 20)),
    one_takes_axes=True,
    axes_need_motion=True,
).bounded(Address("N", 0, 10_000_000, parts=False))

KEPT = (
    *everywhere(compensation=False, lengths=False, cycles=False),
    feed_mode(Then.RESET),  # M2, M30 and a reset bring G94 back
    *shown_by_none(an_origin_shift="G92"),
)
