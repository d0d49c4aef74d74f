"""The words of LinuxCNC, from its documents and the source of its interpreter."""

from mechwright_cam.controls.words.common import (
    ARC,
    COOLANT_APART,
    FEEDS,
    RS274,
    refused,
)
from mechwright_cam.controls.words.kept import Kept, Then, centres, everywhere, feed_mode, shown_by_none
from mechwright_cam.controls.words.table import Address, OffsetTable, Use, g

POLAR = "@^"

WORDS = RS274.but(
    *g("G0 G1", f"XYZ{POLAR}", axes=True),
    *g("G2 G3", f"{ARC}P{POLAR}", axes=True),
    *g("G33.1", "XYZK", axes=True),
    *g("G81 G85", f"XYZRL{POLAR}", axes=True, pointless=("L",)),
    *g("G82 G84 G89 G74", f"XYZRPL{POLAR}", axes=True, pointless=("L",)),
    *g("G73 G83", f"XYZRQL{POLAR}", axes=True, pointless=("L",)),
    *g("G10", "LPXYZR", axes=True),
    *g("G28", "XYZ", axes=True),
    *g("G43.1", "XYZ", axes=True),
    *g("G41.1 G42.1", "D"),
    *g("G64", "PQ"),
    *g("G59.1 G59.2 G59.3 G61.1 G90.1 G91.1 G92.1 G92.2"),
    *g("G97", use=Use.IDLE),
    *refused("G30", "retract with G53 G0 Z0 or G28"),
    *refused("G92", "shift the origin with the work offset, G54 to G59.3"),
    *refused("G93 G95", FEEDS),
    *COOLANT_APART,
    one_takes_axes=True,
    polar=True,
    tables=(
        *(OffsetTable(number, "XYZR") for number in (1, 10, 11)),
        OffsetTable(2, "XYZ", 0, 9),  # R would turn the axes, which is not simulated
        OffsetTable(20, "XYZ", 0, 9),
    ),
).bounded(Address("N", 0, 99_999_999))

KEPT = (
    *everywhere(),
    feed_mode(Then.TOLD),  # M2 brings G94 back, a program that was broken off does not
    centres(Then.TOLD),
    Kept("path mode", "G61, G64", Then.REFUSED, "path-tolerance"),
    Kept("parameters", "#1 to #5000, names", Then.REFUSED),
    *shown_by_none(an_origin_shift="G92, G52", a_turned_work_offset="R of G10 L2", diameters_for_X="G7"),
)
