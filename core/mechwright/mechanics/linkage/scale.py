"""The scale of a slot along an arc: a mark for each place, and its angle in degrees beside it."""

import cmath
import math
from collections.abc import Sequence

from mechwright.contracts.details import Engraving
from mechwright.geometry.lettering import lettering
from mechwright.geometry.segments import Point
from mechwright.mechanics.linkage.slots import ArcSlot

MARK, LETTER, GAP = 2.0, 2.5, 0.5
"""Length of a mark, height of its number, and air between them, mm."""

WIDTH = MARK + LETTER + 2 * GAP
"""What a scale takes beside the slot, mm."""

LINE, DEEP = 0.6, 0.2
"""Greatest width and depth of engraved lines, mm."""


def scale(
    name: str, slot: ArcSlot, places: Sequence[complex], angles: Sequence[float], beside: float
) -> Engraving:
    """Marks outside of a slot, from the distance ``beside`` of its centre line on, mm.

    ``angles`` are what is written at the places, degrees; a number that would meet another is left out.
    """
    strokes: list[tuple[Point, ...]] = []
    written: list[float] = []
    start = slot.radius + beside
    middle = start + MARK + GAP + LETTER / 2
    for place, angle in sorted(zip(places, angles, strict=True), key=lambda pair: pair[1]):
        along = cmath.phase(place - slot.centre)
        strokes.append(tuple(_at(slot.centre, radius, along) for radius in (start, start + MARK)))
        text = f"{round(angle, 1):g}"
        # A letter is as wide as high, with what parts it from the next.
        if all(abs(math.remainder(along - one, math.tau)) * middle >= LETTER * len(text) for one in written):
            written.append(along)
            strokes += lettering(text, LETTER, _at(slot.centre, middle, along), along - math.pi / 2)
    return Engraving(name, tuple(strokes), DEEP, LINE)


def _at(centre: complex, radius: float, angle: float) -> Point:
    at = centre + cmath.rect(radius, angle)
    return at.real, at.imag
