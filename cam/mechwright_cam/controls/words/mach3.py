"""The words of Mach3: its manual, and common practice."""

from dataclasses import replace

from mechwright_cam.controls.words.common import NOT_SIMULATED, RS274
from mechwright_cam.controls.words.kept import Then, centres, everywhere, feed_mode, shown_by_none
from mechwright_cam.controls.words.table import OffsetTable, Use, g, m

OFFSETS = 255
"""The highest H and D: tools of the tool table."""

WORDS = RS274.but(
    *NOT_SIMULATED,
    *g("G90.1 G91.1 G92.1"),
    *g("G43", "H", needs="H"),
    *g("G84", "XYZRL", pointless=("L",)),
    *g("G50 G69 G97", use=Use.IDLE),
    *m("M48 M49", use=Use.IDLE),
    tables=(OffsetTable(1, "XZ", 0, OFFSETS), OffsetTable(2, "XYZ", 1, OFFSETS)),
).bounded(*(replace(RS274.of(letter), most=OFFSETS) for letter in "HD"))

KEPT = (
    *everywhere(),
    feed_mode(Then.REFUSED),
    centres(Then.REFUSED),
    *shown_by_none(an_origin_shift="G92, G52", scale="G51", a_turn="G68", polar_coordinates="G16"),
)
