"""The parts that show tapped holes, and holes for screws."""

from golden_case import CORE, FLUSH, QUARTER, SHARP, TAPPING, Case, hole

from mechwright.contracts.details import Thread
from mechwright.contracts.part import Part
from mechwright.geometry import Loop, Outline, circle
from mechwright.standards.screw_holes import seated

_ROUND = (hole("shank", -9, 0, 5, 8), hole("sunk", 9, 0, 3, 8))
_RAW = Part(
    "raw",
    Outline(SHARP, tuple(Loop((circle(h.centre, h.diameter / 2, clockwise=True),)) for h in _ROUND)),
    8,
    "aluminium",
    machined=_ROUND,
)
SEATED = seated(seated(_RAW, "shank", "ISO 4762 M5"), "sunk", "ISO 10642 M3")
THREADED: dict[str, Case] = {
    "screws": Case(
        SEATED.features,
        ("spot-6", "drill-4", "mill-3", "mill-6", "chamfer-6"),
        (
            *(
                "spot drill",
                "drill 4",
                "head-shank: bore",
                "head-shank: finish",
                "sunk: bore",
                "sunk: finish",
            ),
            *("shank: bore", "shank: finish", "sink-sunk: chamfer"),
        ),
        thickness=8,
        settings=FLUSH,
        details=SEATED.details,
        whole=SEATED,
        says="(operation: sink-sunk: chamfer)",
    ),
    "tap": Case(
        (hole("core", -8, 0, CORE, 16), hole("blind", 8, 0, CORE, 14)),
        ("spot-6", "drill-5", "tap-m6"),
        ("spot drill", "drill 5", "drill 5 to 12.5", "m6: tap", "blind-m6: tap"),
        thickness=16,
        settings=FLUSH,
        details=(Thread("m6", (-8.0, 0.0), 6.0, 1.0, 16.0), Thread("blind-m6", (8.0, 0.0), 6.0, 1.0, 8.0)),
        says="G33.1 Z-20 K1\n",
        controls=TAPPING,
    ),
    "tap-left": Case(
        (hole("core", 0, 0, CORE, 4),),
        ("drill-5", "tap-m6-left"),
        ("drill 5", "m6: tap"),
        settings=FLUSH,
        details=(Thread("m6", (0.0, 0.0), 6.0, 1.0, 4.0, left=True),),
        says="M4\n",
        controls=TAPPING,
    ),
    "tap-floating": Case(
        (hole("core", -8, 0, CORE, 4), hole("core-2", 8, 0, CORE, 4)),
        ("drill-5", "tap-m6-floating"),
        ("drill 5", "m6: tap", "m6-2: tap"),
        settings=FLUSH,
        details=(Thread("m6", (-8.0, 0.0), 6.0, 1.0, 4.0), Thread("m6-2", (8.0, 0.0), 6.0, 1.0, 4.0)),
        says="G98 G84",
        controls=(*TAPPING, "mach3"),
    ),
    "tap-inch": Case(
        (hole("core", 0, 0, QUARTER.core, 4),),
        ("drill-5.1", "tap-quarter"),
        ("drill 5.1", "quarter: tap"),
        settings={**FLUSH, "post": {"units": "inch"}},
        details=(QUARTER,),
        says="K0.05\n",
        controls=TAPPING,
    ),
}
