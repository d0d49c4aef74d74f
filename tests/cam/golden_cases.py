"""One small part for each operation, with its cutters and the settings that bring the operation about."""

import math

from golden_case import BORED, CORE, FLUSH, PLATE, QUARTER, Case, box, hole
from golden_threads import THREADED
from planning_parts import rounded_box

from mechwright.contracts.details import Chamfer, Engraving, Thread
from mechwright.contracts.fits import hole_fit
from mechwright.contracts.part import Bore, OpenProfile, Pocket, Profile
from mechwright.geometry import Arc, Line, Loop, circle
from mechwright.geometry.lettering import lettering

__all__ = ["CASES"]
CASES: dict[str, Case] = {
    **THREADED,
    "face": Case(
        (Pocket("face", box(-30, -25, 30, 25), (), 0, 0.5),), ("mill-16",), ("face: face",), settings=FLUSH
    ),
    "profile-outside": Case(
        (hole("bore", 0, 0, 12, 4), Profile("outside", PLATE, "outside", 0, 4)),
        ("mill-8",),
        ("bore: bore", "bore: finish", "clamp", "outside: rough", "outside: finish"),
        settings={"hold": BORED},
        says="clamp the part",
    ),
    "profile-inside": Case(
        (Profile("window", rounded_box(24, 16, 5), "inside", 0, 4),),
        ("mill-8",),
        ("window: rough", "window: finish"),
        settings=FLUSH,
    ),
    "pocket-contour": Case(
        (Pocket("recess", rounded_box(28, 20, 5), (), 0, 2),),
        ("mill-8",),
        ("recess: rough", "recess: finish"),
        settings=FLUSH,
    ),
    "pocket-island": Case(
        (Pocket("recess", rounded_box(34, 24, 5), (Loop((circle((0, 0), 4.0),)),), 0, 1),),
        ("mill-6",),
        ("recess: rough", "recess: finish"),
        settings=FLUSH,
    ),
    "pocket-adaptive": Case(
        (Pocket("recess", Loop((circle((0, 0), 9.0),)), (), 0, 3),),
        ("mill-8",),
        ("recess: clear", "recess: rough the rest", "recess: finish"),
        settings={**FLUSH, "clearing": "adaptive", "engagement": 90},
    ),
    "slot": Case(
        (Pocket("slot", rounded_box(30, 8.0, 4.0), (), 0, 2),),
        ("mill-6",),
        ("slot: rough", "slot: finish"),
        settings=FLUSH,
    ),
    "groove": Case(
        (Pocket("groove", box(-30, -5, 30, 5), (), 0, 2),),
        ("mill-6",),
        ("groove: rough", "groove: finish"),
        settings=FLUSH,
    ),
    "rest": Case(
        (Pocket("recess", rounded_box(26, 18, 2.5), (), 0, 2),),
        ("mill-12", "mill-4"),
        (
            "recess: rough",
            "recess: rough the rest",
            "recess: finish",
        ),
        settings=FLUSH,
    ),
    "spot": Case(
        (hole("one", -10, 5, 5, 4), hole("two", 10, -5, 5, 4)),
        ("spot-6", "drill-5", "mill-8"),
        ("spot drill", "drill 5"),
        settings=FLUSH,
        says="G82",
    ),
    "drill": Case(
        (hole("one", -10, 5, 5, 4), hole("two", 10, -5, 5, 4), hole("three", 10, 8, 8, 4)),
        ("drill-5", "drill-8", "mill-8"),
        ("drill 5", "drill 8"),
        settings=FLUSH,
        says="G81",
    ),
    "chip-break": Case(
        (hole("one", -10, 5, 5, 18), hole("two", 10, -5, 5, 18)),
        ("drill-5", "mill-8"),
        ("drill 5",),
        thickness=18,
        settings=FLUSH,
        says="G73",
    ),
    "peck": Case(
        (hole("one", -10, 5, 3, 18), hole("two", 10, -5, 3, 18)),
        ("drill-3", "mill-8"),
        ("drill 3",),
        thickness=18,
        settings=FLUSH,
        says="G83",
    ),
    "bore-helix": Case(
        (hole("bore", 0, 0, 14, 4), hole("seat", 0, 0, 20, 2)),
        ("mill-8",),
        ("bore: bore", "bore: finish", "seat: bore", "seat: finish"),
        settings=FLUSH,
    ),
    "thread": Case(
        (hole("core", 0, 0, CORE, 4),),
        ("mill-3", "thread-m6"),
        ("core: bore", "core: finish", "m6: thread"),
        settings=FLUSH,
        details=(Thread("m6", (0.0, 0.0), 6.0, 1.0, 3.0),),
    ),
    "thread-left": Case(
        (hole("core", 0, 0, CORE, 4),),
        ("mill-3", "thread-m6"),
        ("core: bore", "core: finish", "m6: thread"),
        settings=FLUSH,
        details=(Thread("m6", (0.0, 0.0), 6.0, 1.0, 3.0, left=True),),
    ),
    "thread-inch": Case(
        (hole("core", 0, 0, QUARTER.core, 4),),
        ("mill-3", "thread-m6", "thread-unc"),
        ("core: bore", "core: finish", "quarter: thread"),
        settings={**FLUSH, "climb": False},
        details=(QUARTER,),
    ),
    "chamfer": Case(
        (Profile("window", rounded_box(20, 14, 5), "inside", 0, 3),),
        ("mill-8", "chamfer-6"),
        ("window: rough", "window: finish", "edge: chamfer"),
        thickness=3,
        settings=FLUSH,
        details=(Chamfer("edge", rounded_box(20, 14, 5), "inside", 0.4),),
    ),
    "engrave": Case(
        (hole("pin", -14, 0, 5, 4),),
        ("drill-5", "engrave-3", "mill-8"),
        ("drill 5", "number: engrave"),
        settings=FLUSH,
        details=(Engraving("number", lettering("MW-25", 5.0, (2.0, 0.0)), 0.2),),
    ),
    "ramp": Case(
        (Pocket("keyway", rounded_box(24, 6.0, 3.0), (), 0, 1.5),),
        ("mill-5",),
        ("keyway: rough", "keyway: finish"),
        settings={**FLUSH, "ramp_angle": 2},
    ),
    "helix": Case(
        (Pocket("seat", Loop((circle((0, 0), 8.0),)), (), 0, 2),),
        ("mill-8",),
        ("seat: rough", "seat: finish"),
        settings={**FLUSH, "ramp_angle": 5},
    ),
    "tabs-ramped": Case(
        (Profile("outside", PLATE, "outside", 0, 4),),
        ("mill-6",),
        (
            "outside: rough",
            "outside: finish",
            "outside over the tabs: rough",
            "outside over the tabs: finish",
        ),
        settings={"hold": {"tabs": 2, "tab_shape": "ramped"}},
    ),
    "open-ends": Case(
        (Profile("outside", PLATE, "outside", 0, 4),),
        ("mill-3",),
        ("outside: rough", "outside: finish"),
        settings={
            "stock": {"finished": ["front", "rear"], "margin": 3},
            "hold": {"method": "vice", "grip": 2},
            "spring_passes": 0,
        },
    ),
    "groove-on-a-line": Case(
        (
            OpenProfile(
                "groove",
                0,
                2,
                path=(Line((-30, -5), (0, -5)), Arc((0, 5), 10, -math.pi / 2, 1.2)),
                side="on",
                width=6,
            ),
        ),
        ("mill-6",),
        ("groove: slot",),
        settings=FLUSH,
    ),
    "tabs": Case(
        (Profile("outside", PLATE, "outside", 0, 3),),
        ("mill-8",),
        (
            "outside: rough",
            "outside below the tabs: rough",
            "outside: finish",
        ),
        thickness=3,
        settings={"hold": {"method": "tabs", "tabs": 2, "tab_width": 4}},
    ),
    "peel": Case(
        (Profile("outside", PLATE, "outside", 0, 6),),
        ("mill-8",),
        (
            "outside: peel",
            "outside below the tabs: rough",
            "outside: finish",
        ),
        thickness=6,
        settings={
            "outsides": "adaptive",
            "engagement": 90,
            "hold": {"method": "tabs", "tabs": 2, "tab_width": 4},
        },
    ),
    "offsets": Case(
        (Profile("outside", PLATE, "outside", 0, 3), hole("hole", 0, 0, 5, 3)),
        ("mill-8", "spot-6", "drill-5"),
        (
            "spot drill",
            "drill 5",
            "outside: rough",
            "outside below the tabs: rough",
            "outside: finish",
        ),
        thickness=3,
        settings={"more_offsets": ["G55"], "hold": {"method": "tabs", "tabs": 2, "tab_width": 4}},
        says="o101 call",
    ),
    "floor": Case(
        (Pocket("recess", rounded_box(22, 12, 5), (), 0, 2), hole("seat", 15, 0, 6, 1)),
        ("mill-8", "mill-4"),
        (
            "seat: bore",
            "seat: finish",
            "recess: rough",
            "recess: finish the floor",
            "recess: finish",
        ),
        settings={**FLUSH, "floor_to_leave": 0.3},
    ),
    "bull-nose": Case(
        (Pocket("dish", rounded_box(22, 14, 5), (), 0, 2, floor_radius=1.0),),
        ("mill-6", "bull-6-r1"),
        ("dish: rough", "dish: finish"),
        settings=FLUSH,
    ),
    "ball": Case(
        (Pocket("dish", Loop((circle((0, 0), 5.0),)), (), 0, 3, floor_radius=3.0),),
        ("ball-6",),
        ("dish: rough", "dish: level the floor", "dish: finish"),
        settings=FLUSH,
    ),
    "conventional": Case(
        (Pocket("recess", rounded_box(24, 16, 5), (), 0, 2),),
        ("mill-8",),
        ("recess: rough", "recess: finish"),
        settings={**FLUSH, "climb": False, "spring_passes": 0, "stock_to_leave": 0.5},
    ),
    "ream": Case(
        (
            Bore("pin", (-10.0, 0.0), 6.006, 0, 4, fit=hole_fit(6, "H7")),
            Bore("dowel", (10.0, 0.0), 6.006, 0, 4, fit=hole_fit(6, "H7")),
        ),
        ("spot-6", "drill-5.8", "reamer-6"),
        ("spot drill", "drill 5.8", "pin: ream", "dowel: ream"),
        settings=FLUSH,
    ),
    "ream-milled": Case(
        (Bore("pin", (0.0, 0.0), 6.006, 0, 4, fit=hole_fit(6, "H7")),),
        ("mill-4", "reamer-6"),
        ("pin: bore for the reamer", "pin: ream"),
        settings=FLUSH,
    ),
    "inches": Case(
        (hole("bore", -12, 0, 8, 4), Profile("window", rounded_box(16, 14, 4), "inside", 0, 4)),
        ("spot-6", "drill-5", "mill-6"),
        (
            "spot drill",
            "drill 5",
            "bore: bore",
            "bore: finish",
            "window: rough",
            "window: finish",
        ),
        settings={**FLUSH, "post": {"units": "inch"}},
        says="G17 G20 G40",
    ),
    "second-side": Case(
        (hole("bore", 0, 0, 10, 6), hole("counterbore", 0, 0, 16, 3, top=3)),
        ("mill-6",),
        ("bore: bore", "bore: finish", "counterbore: bore", "counterbore: finish"),
        thickness=6,
        settings=FLUSH,
        says="G55",
    ),
}
"""Operation to its case. Every one is as small as shows the operation in both of its passes."""
