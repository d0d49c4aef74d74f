"""The parts, cutters and settings of which the kept programs of operations are made."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from by_control import EVERY
from planning_parts import LIBRARY, rounded_box

from mechwright.contracts.details import Detail, Thread
from mechwright.contracts.part import Bore, Feature, Part, Profile
from mechwright.geometry import Loop, Outline, circle
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
    controls: tuple[str, ...] = EVERY
    """Those that can do it."""
    whole: Part | None = None
    """The part itself, where more is done to it than its features show."""

    def part(self, name: str) -> Part:
        """The plate; what goes through it is in its outline."""
        if self.whole is not None:
            return replace(self.whole, name=name)
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
