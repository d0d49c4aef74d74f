"""Slots along an arc, and the holes or the slot in which a joint of a plate is set.

Glossary
--------
place
    Where a joint of the plate stands in one phase of the machine.
land
    Material between an opening and the next one, or the edge of the plate.
"""

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass

from mechwright.geometry import Arc, Loop, Segment
from mechwright.geometry.segments import Point
from mechwright.mechanics.linkage.outlines import Boss

SAME_PLACE = 0.01
"""mm. Places nearer to each other are one: no drill tells them apart."""

STEP = math.radians(10)
"""Between the bosses that carry the rim of a slot: their hull stands off the arc by 0.4 % of its radius."""

ROUND = 1e-6
"""Part of a step that a slot may be longer than whole steps: rounding, the same in every phase."""


@dataclass(frozen=True)
class ArcSlot:
    """A slot whose centre line is an arc, with round ends.

    Parameters
    ----------
    centre, radius
        Of the centre line, x + i y and mm.
    start, sweep
        Direction of its first end from the centre, and how far it goes on from there counter-clockwise, rad.
    width
        mm.
    """

    centre: complex
    radius: float
    start: float
    sweep: float
    width: float

    def at(self, along: float) -> complex:
        """The point of the centre line so far from its first end, rad."""
        return self.centre + cmath.rect(self.radius, self.start + along)

    @property
    def ends(self) -> tuple[complex, complex]:
        """Both ends of the centre line."""
        return self.at(0.0), self.at(self.sweep)

    def loop(self, tag: str = "slot") -> Loop:
        """The wall, clockwise as that of every opening.

        >>> slot = ArcSlot(0j, 30.0, 0.0, 0.5, 4.0)
        >>> round(-slot.loop().area - (30 * 0.5 * 4 + 4 * math.pi), 9)
        0.0
        """
        half, end = self.width / 2, self.start + self.sweep
        first, last = (_point(one) for one in self.ends)
        walls: tuple[Segment, ...] = (
            Arc(_point(self.centre), self.radius + half, end, -self.sweep, tag),
            Arc(first, half, self.start, -math.pi, tag),
            Arc(_point(self.centre), self.radius - half, self.start, self.sweep, tag),
            Arc(last, half, end + math.pi, -math.pi, tag),
        )
        return Loop(walls)

    def bosses(self, radius: float) -> tuple[Boss, ...]:
        """Discs without bores along the slot, so that a hull around them leaves its land all along, mm."""
        steps = max(1, math.ceil(self.sweep / STEP - ROUND))
        more = self.radius * (1 - math.cos(self.sweep / steps / 2))
        return tuple(Boss(self.at(self.sweep * k / steps), radius + more) for k in range(steps + 1))

    def distance(self, place: complex) -> float:
        """From a point to the centre line, mm."""
        arm = place - self.centre
        along = (cmath.phase(arm) - self.start) % math.tau
        if along <= self.sweep:
            return abs(abs(arm) - self.radius)
        return min(abs(place - one) for one in self.ends)

    def apart(self, other: "ArcSlot") -> float:
        """Between the centre lines of two slots, mm, looked at in steps of a fiftieth."""
        return min(self.distance(other.at(other.sweep * k / 50)) for k in range(51))


@dataclass(frozen=True)
class Setting:
    """A joint that is set.

    Parameters
    ----------
    name
        Of the joint.
    places
        In the plate, the one that is shown first; those of equal phases once.
    slot
        Where the places are too near to each other for a hole each; None for holes.
    """

    name: str
    places: tuple[complex, ...]
    slot: ArcSlot | None = None


def setting(
    name: str, places: Sequence[complex], centre: complex, bore: float, land: float, width: float
) -> Setting:
    """Holes where the land between them allows it, else a slot about the centre on which they lie.

    Parameters
    ----------
    places
        All of one distance from the centre, the one that is shown first.
    bore, land, width
        Diameter of a hole, land between two, and the width of a slot, mm.

    Examples
    --------
    >>> setting("A", [30 + 0j, 30j], 0j, 8.0, 4.0, 4.5).slot is None
    True
    >>> slot = setting("A", [30 + 0j, cmath.rect(30, 0.2)], 0j, 8.0, 4.0, 4.5).slot
    >>> round(slot.sweep, 9), slot.width
    (0.2, 4.5)
    """
    kept: list[complex] = []
    for place in places:
        if all(abs(place - other) > SAME_PLACE for other in kept):
            kept.append(place)
    chords = [abs(one - two) for number, one in enumerate(kept) for two in kept[:number]]
    if min(chords, default=math.inf) >= bore + land:
        return Setting(name, tuple(kept))
    angles = sorted(cmath.phase(place - centre) for place in kept)
    gaps = [(two - one) % math.tau for one, two in zip(angles, angles[1:] + angles[:1], strict=True)]
    widest = max(range(len(gaps)), key=lambda k: gaps[k])
    start = angles[(widest + 1) % len(angles)]
    return Setting(
        name, tuple(kept), ArcSlot(centre, abs(kept[0] - centre), start, math.tau - gaps[widest], width)
    )


@dataclass(frozen=True)
class Gap:
    """Two openings of a plate: how far their middles are apart, and what their walls take of that, mm."""

    what: str
    distance: float
    walls: float

    @property
    def land(self) -> float:
        """What is left between both, mm."""
        return self.distance - self.walls


def gaps(one: Setting, two: Setting, bore: float) -> list[Gap]:
    """Between the openings of two joints; holes have a diameter of ``bore``, mm."""
    if one.slot is not None and two.slot is not None:
        walls = (one.slot.width + two.slot.width) / 2
        return [Gap(f"the slots of {one.name} and {two.name}", one.slot.apart(two.slot), walls)]
    if one.slot is None and two.slot is not None:
        one, two = two, one
    if one.slot is not None:
        walls = (one.slot.width + bore) / 2
        what = f"the slot of {one.name} and a hole of {two.name}"
        return [Gap(what, one.slot.distance(at), walls) for at in two.places]
    what = f"holes of {one.name} and {two.name}"
    return [Gap(what, abs(x - y), bore) for x in one.places for y in two.places]


def point_gaps(one: Setting, point: complex, bore: float, point_bore: float) -> list[Gap]:
    """Between the openings of a joint and a bore at a point, mm."""
    if one.slot is not None:
        walls = (one.slot.width + point_bore) / 2
        return [Gap(f"the slot of {one.name} and the point", one.slot.distance(point), walls)]
    what = f"a hole of {one.name} and the point"
    return [Gap(what, abs(at - point), (bore + point_bore) / 2) for at in one.places]


def _point(z: complex) -> Point:
    return z.real, z.imag
