"""Outlines of plates: eyes about pins, walls about slots, and the ground plates."""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

from mechwright.errors import GeometryError
from mechwright.geometry import Outline
from mechwright.mechanics.linkage import Boss, hull_link, straight_link
from mechwright.mechanics.linkage.linkage import Linkage
from mechwright.mechanics.linkage.parts.axes import number
from mechwright.mechanics.linkage.parts.pins import Pin
from mechwright.mechanics.linkage.parts.scheme import Scheme
from mechwright.mechanics.linkage.parts.sizes import Sizes
from mechwright.mechanics.linkage.parts.slides import Slot
from mechwright.mechanics.linkage.slots import SAME_PLACE
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.tolerances import falls_short


@dataclass(frozen=True)
class Eyes:
    """What a plate has: bosses with bores, and slots."""

    bosses: tuple[Boss, ...]
    slots: tuple[Slot, ...]

    def discs(self, rim: float) -> tuple[Boss, ...]:
        """The bosses, and one without a bore about each end of a slot."""
        ends = [Boss(at, slot.width / 2 + rim) for slot in self.slots for at in (slot.first, slot.last)]
        return (*self.bosses, *ends)


def path_eye(name: str) -> str:
    """The eye of a traced point."""
    return f"path {name}"


def eyes_of(
    linkage: Linkage, sizes: Sizes, scheme: Scheme, pins: Sequence[Pin], slots: Sequence[Slot], plate: str
) -> Eyes:
    """The eyes of one plate, in the frame of its link."""
    link = scheme.link(plate)
    found: list[Boss] = []

    def add(place: complex, bore: float, tag: str) -> None:
        if all(abs(place - one.centre) > SAME_PLACE for one in found):
            found.append(Boss(place, bore / 2 + sizes.rim, bore, tag))

    for pin in pins:
        if plate in pin.pressed and pin.clamp is None:
            add(pin.place, sizes.pin_diameter, pin.eye)
        if plate in (one for one, _ in pin.turning):
            add(pin.places[link], sizes.turning_bore, pin.eye)
    for name, (drawn_by, point) in linkage.traces.items():
        if drawn_by == link and plate in scheme.plates(link, path_eye(name)) and link != GROUND:
            add(number(linkage.points[link][point]), sizes.pin_diameter, point)
    own = (one for one in slots if one.link == link and plate in scheme.plates(link, one.slide))
    return Eyes(tuple(found), tuple(own))


def check_room(plate: str, eyes: Eyes, rim: float) -> None:
    """Raise GeometryError where two openings of a plate leave less than a rim between them."""
    for what, distance, walls in _gaps(eyes):
        if falls_short(distance, walls + rim):
            raise GeometryError(
                f"{plate}: {what} are {distance:.4g} mm apart, and the limit is {walls + rim:.4g} mm, which "
                "leaves the rim between them; move one of them, or make pin_diameter, bushing_wall or rim "
                "smaller"
            )


def _gaps(eyes: Eyes) -> Iterator[tuple[str, float, float]]:
    """Pairs of openings, the distance of their middles, and what their walls take of it, mm."""
    for one, two in combinations(eyes.bosses, 2):
        yield f"the bores of {one.tag} and {two.tag}", abs(one.centre - two.centre), (one.bore + two.bore) / 2
    for slot in eyes.slots:
        for boss in eyes.bosses:
            what = f"the slot of {slot.slide} and the bore of {boss.tag}"
            yield what, slot.distance(boss.centre), (slot.width + boss.bore) / 2
    for first, second in combinations(eyes.slots, 2):
        what = f"the slots of {first.slide} and {second.slide}"
        yield what, first.apart(second), (first.width + second.width) / 2


def link_outline(eyes: Eyes, sizes: Sizes) -> Outline:
    """A link: a web between two eyes where there is room, else the hull of all eyes and slots."""
    if len(eyes.bosses) == 2 and not eyes.slots:
        return straight_link(*eyes.bosses, sizes.web_width)
    hull = hull_link(eyes.discs(sizes.rim))
    return Outline(hull.outer, (*hull.inner, *(slot.loop() for slot in eyes.slots)))


@dataclass(frozen=True)
class Rectangle:
    """Corners of a ground plate, x + i y, and the radius about the screws there, mm."""

    low: complex
    high: complex
    corner: float

    @property
    def screws(self) -> tuple[complex, ...]:
        """Axes of the screws: lower left, upper left, lower right, upper right."""
        c = self.corner
        return tuple(
            complex(x, y)
            for x in (self.low.real + c, self.high.real - c)
            for y in (self.low.imag + c, self.high.imag - c)
        )

    def around(self, y0: float, y1: float) -> "Rectangle":
        """A higher one with the same middle, whose posts stand outside of y0 to y1, on whole millimetres."""
        middle, c = (self.low.imag + self.high.imag) / 2, self.corner
        own = (self.high.imag - self.low.imag) / 2 - c
        aside = max(own, math.ceil(max(middle - y0, y1 - middle) + c))
        end = 1j * (aside + c)
        return Rectangle(self.low.real + 1j * middle - end, self.high.real + 1j * middle + end, c)


def ground_rectangle(discs: Sequence[Boss], sizes: Sizes) -> Rectangle:
    """A plate around the eyes of the ground, with a screw in each corner."""
    reach = max(disc.radius for disc in discs)
    x = [disc.centre.real for disc in discs]
    y = [disc.centre.imag for disc in discs]
    corner, middle = sizes.corner, (min(y) + max(y)) / 2
    # With a rim between the two holes of one end, which may be large.
    aside = max((max(y) - min(y)) / 2 + reach, sizes.screw_offset or 0.0, corner - sizes.rim / 2)
    end = reach + 2 * corner
    low = complex(min(x) - end, middle - aside - corner)
    return Rectangle(low, complex(max(x) + end, middle + aside + corner), corner)
