"""One small part for each operation, with its cutters and the settings that bring the operation about."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from by_control import CONTROLS
from planning_parts import LIBRARY, rounded_box

from mechwright.contracts.details import Chamfer, Detail, Engraving, Thread
from mechwright.contracts.fits import hole_fit
from mechwright.contracts.part import Bore, Feature, OpenProfile, Part, Pocket, Profile
from mechwright.geometry import Arc, Line, Loop, Outline, circle
from mechwright.geometry.lettering import lettering
from mechwright_cam.shop.tool import Tool

_REAMED = {"aluminium": {"cutting_speed": 20, "chip_load": 0.03}}
_TAPPED = {"aluminium": {"cutting_speed": 15}}
_DRILLED = {"aluminium": {"cutting_speed": 70, "chip_load": 0.04}}
MORE = LIBRARY.extended(
    (
        Tool(
            name="reamer-6", number=91, kind="reamer", diameter=6, flutes=6, flute_length=20, cutting=_REAMED
        ),
        Tool(
            name="thread-unc",
            number=93,
            kind="thread-mill",
            diameter=4,
            flutes=3,
            flute_length=12,
            neck_diameter=2.4,
            cutting={"aluminium": {"cutting_speed": 130, "chip_load": 0.02}},
        ),
        *(
            Tool(name=name, number=number, kind="tap", flutes=3, flute_length=25, cutting=_TAPPED, **shape)
            for name, number, shape in (
                ("tap-m6", 94, {"diameter": 6, "pitch": 1}),
                ("tap-m6-left", 95, {"diameter": 6, "pitch": 1, "left_hand": True}),
                ("tap-m6-floating", 96, {"diameter": 6, "pitch": 1, "chamfer_length": 2, "floating": True}),
                ("tap-quarter", 97, {"diameter": 6.35, "pitch": 1.27}),
            )
        ),
        Tool(name="drill-5.1", number=98, kind="drill", diameter=5.1, flute_length=40, cutting=_DRILLED),
        Tool(name="drill-5.8", number=92, kind="drill", diameter=5.8, flute_length=30, cutting=_DRILLED),
    )
)
"""The library, with what it does not have: a reamer and taps, and the drills for them."""
TAPPING = ("linuxcnc", "fanuc", "haas")
"""The controls that keep feed and spindle together."""
WIDE, HIGH = 40.0, 30.0
PLATE = rounded_box(WIDE, HIGH, 5)
SHARP = Loop.polygon(
    [(-WIDE / 2, -HIGH / 2), (WIDE / 2, -HIGH / 2), (WIDE / 2, HIGH / 2), (-WIDE / 2, HIGH / 2)]
)
BORED = {"method": "bore", "clamp_diameter": 10, "clamp_height": 8}


@dataclass(frozen=True)
class Case:
    """A part, its cutters, the settings that bring the operation about, and the operations expected."""

    features: tuple[Feature, ...]
    tools: tuple[str, ...]
    expected: tuple[str, ...]
    thickness: float = 4.0
    settings: Mapping[str, object] = field(default_factory=dict)
    details: tuple[Detail, ...] = ()
    material: str = "aluminium"
    says: str = ""
    """What the text has to hold on LinuxCNC, beside the names of the operations: the mark of the operation."""
    controls: tuple[str, ...] = CONTROLS
    """Those that can do it."""

    def part(self, name: str) -> Part:
        """The plate; what goes through it is in its outline."""
        through = [f for f in self.features if f.top == 0 and f.depth == self.thickness]
        inner = [
            Loop((circle(f.centre, f.diameter / 2, clockwise=True),)) for f in through if isinstance(f, Bore)
        ]
        inner += [f.loop.reversed() for f in through if isinstance(f, Profile) and f.side == "inside"]
        rim = PLATE if any(isinstance(f, Profile) and f.side == "outside" for f in self.features) else SHARP
        outline = Outline(rim, tuple(inner))
        return Part(
            name, outline, self.thickness, self.material, machined=self.features, details=self.details
        )


def box(x0: float, y0: float, x1: float, y1: float) -> Loop:
    return Loop.polygon([(x0, y0), (x1, y0), (x1, y1), (x0, y1)])


def hole(name: str, x: float, y: float, diameter: float, depth: float, top: float = 0.0) -> Bore:
    return Bore(name, (x, y), diameter, top, depth)


FLUSH = {"stock": {"margin": 0}}
"""The plate is as large as its stock: nothing but the feature is cut."""

CORE = Thread("m6", (0.0, 0.0), 6.0, 1.0, 5.0).core

QUARTER = Thread("quarter", (0.0, 0.0), 6.35, 1.27, 3.0, inch="1/4-20 UNC")

CASES: dict[str, Case] = {
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
            "outside: finish",
            "outside below the tabs: rough",
            "outside below the tabs: finish",
        ),
        thickness=3,
        settings={"hold": {"method": "tabs", "tabs": 2, "tab_width": 4}},
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
        ("pin: bore", "pin: bore for the reamer", "pin: ream"),
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
