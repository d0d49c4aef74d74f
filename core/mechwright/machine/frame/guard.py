"""Rings of polycarbonate between two bearing plates, about all that moves there.

They are threaded over the four pillars and lie on each other, so that every one is milled from a flat plate
and the upper bearing plate has to come off, with its tool, before they do (a fixed guard of ISO 14120). Above
them stays a slot into which no fingertip goes: up to 4 mm it may be 2 mm from what moves (EN ISO 13857, table
4; as handbooks print it, unchecked).
"""

import math

from mechwright.contracts.part import Bore, Colour, Part, Profile
from mechwright.contracts.surroundings import Place
from mechwright.geometry import Loop, Outline
from mechwright.machine.frame.kit import Kit
from mechwright.machine.frame.pillars import EDGE, PILLAR
from mechwright.machine.frame.plates import CORNER
from mechwright.machine.frame.shafts import Levels
from mechwright.machine.frame.standing import CLEARANCE, Standing
from mechwright.mechanics.linkage import Boss, rectangle

MATERIAL = "polycarbonate"
"""Clear, and does not splinter."""

THICKEST, THINNEST = 12, 6
"""Of a ring, mm: even sizes between are sold as sheets, and end mills of usual length go through."""

AIR = 0.2
"""Between the rings and the plate above them at least, mm: the pillars carry that plate."""

HOLE = PILLAR + 1.0
"""For a pillar, mm."""

WALL = 4.0
"""Between a pillar's hole and the inside, mm."""

INSIDE = 6.0
"""Radius of the inner corners, mm."""

_CLEAR: Colour = (0.78, 0.88, 0.93)


def heights(space: float) -> list[int]:
    """Thicknesses of the rings that fill a height, mm, as few and as alike as can be.

    >>> heights(31), heights(14.5), heights(5)
    ([10, 10, 10], [8, 6], [])
    """
    whole = 2 * math.floor((space - AIR) / 2)
    if whole < THINNEST:
        return []
    count = math.ceil(whole / THICKEST)
    each = 2 * (whole // (2 * count))
    more = (whole - count * each) // 2
    return [each + 2] * more + [each] * (count - more)


def widened(standing: Standing, bounds: tuple[float, float, float, float]) -> Standing:
    """The pillars so far out that a ring inside of them is clear of what moves within some bounds, mm."""
    out = CLEARANCE + HOLE / 2 + WALL
    return Standing(
        min(standing.left, math.floor(bounds[0] - out)),
        min(standing.below, math.floor(bounds[1] - out)),
        max(standing.right, math.ceil(bounds[2] + out)),
        max(standing.above, math.ceil(bounds[3] + out)),
    )


def add_guard(kit: Kit, standing: Standing, levels: Levels) -> None:
    """The rings, from the lower plate up."""
    low = complex(standing.left, standing.below)
    high = complex(standing.right, standing.above)
    edge, inset = complex(EDGE, EDGE), complex(HOLE / 2 + WALL, HOLE / 2 + WALL)
    pillars = [Boss(complex(*at), 0.0, HOLE, f"pillar-{k}") for k, at in enumerate(standing.corners, start=1)]
    plate = rectangle(low - edge, high + edge, CORNER, pillars)
    window = rectangle(low + inset, high - inset, INSIDE).outer.reversed()
    outline = Outline(plate.outer, (*plate.inner, window))
    kit.places["guard-carrier"] = Place()
    z = levels.lower
    for height in heights(levels.height):
        kit.put(_ring(outline, window, pillars, height), "guard-carrier", z)
        z += height


def _ring(outline: Outline, window: Loop, pillars: list[Boss], height: int) -> Part:
    bores = [Bore(one.tag, (one.centre.real, one.centre.imag), HOLE, 0, height) for one in pillars]
    cut: tuple[Bore | Profile, ...] = (
        *bores,
        Profile("window", window, "inside", 0, height),
        Profile("outside", outline.outer, "outside", 0, height),
    )
    return Part(f"guard-{height}", outline, height, MATERIAL, colour=_CLEAR, machined=cut)
