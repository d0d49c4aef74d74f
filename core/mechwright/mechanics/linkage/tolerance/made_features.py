"""Bores and slots of plates as made: how far they stand off, and how wide slots are.

The bores of a link's plates are seen from its first plate. The posts bring two ground plates in line, a
shared pin the two plates of a split link. How far such a plate is turned about that pin is set in assembly.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mechwright.contracts.made_part import MadePart
from mechwright.mechanics.linkage.made import Hole
from mechwright.mechanics.linkage.parts.axes import Axis
from mechwright.mechanics.linkage.parts.layout import Layout
from mechwright.mechanics.linkage.parts.parts import part_name
from mechwright.mechanics.linkage.parts.slides import Slot
from mechwright.mechanics.linkage.tolerance.plates import Plates
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.machine import Prismatic

AROUND = 0.1
"""Share of a slot's width by which its wall may be off."""


@dataclass(frozen=True)
class MadeFeature:
    """A bore, or the middle of a slide's line: its place as drawn and as made, mm, in the frame of the link.

    ``plate`` is where it is.
    """

    drawn: complex
    made: complex
    plate: str


@dataclass(frozen=True)
class MadeSlot:
    """A slot: the diameter of what goes through all of it, and how far its middle is to the left, mm."""

    least: float
    across: float


class MissingFeatureError(Exception):
    """A plate has not the bore or slot that the design gives it."""


@dataclass(frozen=True)
class MadePlates:
    """The features of a design with the plates as made; methods raise MissingFeatureError."""

    plates: Plates
    layout: Layout
    made: Mapping[str, Sequence[MadePart]]

    def part(self, plate: str) -> MadePart:
        """The first copy of a plate."""
        return self.made[part_name(plate)][0]

    def bore(self, link: str, axis: Axis) -> MadeFeature:
        """The bore of an axis in a link."""
        plate, place = self.plates.plate(link, axis.point), axis.places[link]
        return MadeFeature(place, place + self._off(plate, self.hole(plate, axis, link)), plate)

    def hole(self, plate: str, axis: Axis, link: str) -> Hole:
        """The bore as drawn."""
        sizes = self.layout.sizes
        pin = next(one for one in self.layout.pins if one.eye == axis.point and not one.number)
        return Hole(axis.places[link], sizes.pin_diameter if plate in pin.pressed else sizes.turning_bore)

    def line(self, link: str, slide: Prismatic) -> MadeFeature:
        """The middle of a slot, or of the bores of both guide pins."""
        plate = self.plates.plate(link, slide.name)
        slot = self._slot(link, slide)
        if slot is not None:
            middle, way = (slot.first + slot.last) / 2, slot.last - slot.first
            off = 1j * way / abs(way) * self.slot(slot, plate).across + self._plate_off(plate)
            return MadeFeature(middle, middle + off, plate)
        pins = [one for one in self.layout.pins if one.eye == slide.name and one.number]
        holes = [Hole(one.place, self.layout.sizes.pin_diameter) for one in pins]
        middle = sum(one.centre for one in holes) / len(holes)
        return MadeFeature(middle, middle + sum(self._off(plate, one) for one in holes) / len(holes), plate)

    def slots(self) -> dict[str, tuple[Slot, MadeSlot, MadePart]]:
        """Slide to its slot, as drawn and as made, and the plate that has it."""
        found = {}
        for slot in self.layout.slots:
            plate = self.plates.plate(slot.link, slot.slide)
            found[slot.slide] = slot, self.slot(slot, plate), self.part(plate)
        return found

    def slot(self, slot: Slot, plate: str) -> MadeSlot:
        """A slot as its walls stand, corners apart."""
        way = slot.last - slot.first
        reach = slot.width * (0.5 + AROUND)
        for ring in self.part(plate).outline.rings:
            seen = (ring.points @ np.array([1, 1j]) - slot.first) * abs(way) / way
            x, y = seen.real, seen.imag
            if ring.area >= 0 or np.abs(y).max() > reach or x.min() < -reach or x.max() > abs(way) + reach:
                continue
            straight = (x >= 0) & (x <= abs(way)) & ~ring.corner
            left, right = y[straight & (y > 0)], y[straight & (y < 0)]
            if left.size and right.size:
                return MadeSlot(float(left.min() - right.max()), float(left.mean() + right.mean()) / 2)
        raise MissingFeatureError(slot.slide)

    def _slot(self, link: str, slide: Prismatic) -> Slot | None:
        own = (one for one in self.layout.slots if one.slide == slide.name and one.link == link)
        return next(own, None)

    def _off(self, plate: str, hole: Hole) -> complex:
        """How far a bore stands off in the frame of the link, mm."""
        return self._hole_off(plate, hole) + self._plate_off(plate)

    def _hole_off(self, plate: str, hole: Hole) -> complex:
        found = self.part(plate).hole_at(hole.centre.real, hole.centre.imag, hole.diameter)
        if found is None:
            raise MissingFeatureError(plate)
        return complex(found.x, found.y) - hole.centre

    def _plate_off(self, plate: str) -> complex:
        """How far a plate stands off as what it shares with others brings it in line, mm."""
        if self.layout.link(plate) == GROUND:
            posts = [Hole(at, self.layout.sizes.hole) for at in self.layout.posts]
            return -sum(self._hole_off(plate, one) for one in posts) / len(posts) if posts else 0j
        split = self.layout.scheme.split
        if split is None or plate != split.second:
            return 0j
        axis = next(one for one in self.plates.axes if one.point == split.shared)
        first, second = (self._hole_off(one, self.hole(one, axis, split.link)) for one in (split.link, plate))
        return first - second
