"""Slides: straight slots, and what runs in them.

The pin of a roller block runs in a slot of the guide. Another block is a plate with two pins, which run in a
slot of the guide. A slot is as long as the way of its pins over the motion, and by the clearance longer at
each end.
"""

import cmath
import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.errors import GeometryError
from mechwright.geometry import Arc, Line, Loop
from mechwright.mechanics.linkage.linkage import Linkage
from mechwright.mechanics.linkage.parts.axes import Axis, number
from mechwright.mechanics.linkage.parts.sizes import Sizes
from mechwright.mechanics.planar.machine import Prismatic
from mechwright.mechanics.planar.rigid import BodyMotion


@dataclass(frozen=True)
class Slot:
    """A straight slot with round ends.

    Parameters
    ----------
    slide
        Name of the slide; the slot is the eye of that name.
    link
        The link that has it.
    first, last
        Ends of its centre line in the link, x + i y, mm.
    width
        mm.
    """

    slide: str
    link: str
    first: complex
    last: complex
    width: float

    def loop(self) -> Loop:
        """The wall, clockwise as that of every opening.

        >>> round(-Slot("s", "a", 0j, 10 + 0j, 4.0).loop().area - (40 + 4 * math.pi), 9)
        0.0
        """
        along = (self.last - self.first) / abs(self.last - self.first)
        side, angle = 1j * along * self.width / 2, cmath.phase(along)
        corners = [self.first + side, self.last + side, self.last - side, self.first - side]
        a, b, c, d = ((z.real, z.imag) for z in corners)
        end = self.last.real, self.last.imag
        start = self.first.real, self.first.imag
        quarter, half = math.pi / 2, self.width / 2
        return Loop(
            (
                Line(a, b, self.slide),
                Arc(end, half, angle + quarter, -math.pi, self.slide),
                Line(c, d, self.slide),
                Arc(start, half, angle - quarter, -math.pi, self.slide),
            )
        )

    def distance(self, place: complex) -> float:
        """From a point of the link to the centre line, mm."""
        way = self.last - self.first
        share = ((place - self.first) * way.conjugate()).real / abs(way) ** 2
        return abs(place - self.first - way * min(max(share, 0.0), 1.0))

    def apart(self, other: "Slot") -> float:
        """Between the centre lines of two slots, mm; 0 where they cross."""
        ways = (self.last - self.first).conjugate() * (other.last - other.first)
        if ways.imag:
            at = other.first - self.first
            one = (at.conjugate() * (other.last - other.first)).imag / ways.imag
            two = (at.conjugate() * (self.last - self.first)).imag / ways.imag
            if 0 <= one <= 1 and 0 <= two <= 1:
                return 0.0
        near = (self.distance(other.first), self.distance(other.last))
        return min(*near, other.distance(self.first), other.distance(self.last))


@dataclass(frozen=True)
class Guided:
    """A block that is a plate: its slide, and the places of its two guide pins in it, mm."""

    slide: Prismatic
    pins: tuple[complex, complex]


def guided_blocks(linkage: Linkage, axes: tuple[Axis, ...], sizes: Sizes) -> tuple[Guided, ...]:
    """The slides whose block has guide pins."""
    rolling = {slide.name for axis in axes for slide in axis.rollers.values()}
    found = []
    for joint in linkage.machine.joints:
        if isinstance(joint, Prismatic) and joint.name not in rolling:
            reach = cmath.rect(sizes.guide_length / 2, number(joint.block_angle).real)
            at = number(joint.point)
            found.append(Guided(joint, (at - reach, at + reach)))
    return tuple(found)


def slots_of(
    axes: tuple[Axis, ...], guided: tuple[Guided, ...], sizes: Sizes, bodies: Mapping[str, BodyMotion]
) -> tuple[Slot, ...]:
    """All slots; raises GeometryError where a pin leaves the line of its slot."""
    found = []
    for axis in axes:
        for block, slide in axis.rollers.items():
            guide = slide.guide if block == slide.block else slide.block
            holder = next(iter(axis.places))
            found.append(_slot(slide, guide, sizes, [_seen(bodies, holder, axis.places[holder], guide)]))
    for one in guided:
        ways = [_seen(bodies, one.slide.block, at, one.slide.guide) for at in one.pins]
        found.append(_slot(one.slide, one.slide.guide, sizes, ways))
    return tuple(found)


def position(body: BodyMotion, place: complex) -> Array:
    """Where a point of a link is (n,), mm; at a dead point, where it has no rates, too."""
    return np.asarray(body.origin.position + place * body.turning.direction)


def _seen(bodies: Mapping[str, BodyMotion], link: str, place: complex, frame: str) -> Array:
    """A point of a link as another one sees it (n,), mm."""
    own = bodies[frame]
    return np.asarray((position(bodies[link], place) - own.origin.position) / own.turning.direction)


OFF_LINE = 1e-3
"""mm. A pin farther from the line of its slot is no longer that of the slide."""


def _slot(slide: Prismatic, guide: str, sizes: Sizes, ways: list[Array]) -> Slot:
    along = cmath.rect(1.0, number(slide.direction(guide)).real)
    places = np.concatenate(ways) / along
    if (off := float(np.ptp(places.imag))) > OFF_LINE:
        raise GeometryError(
            f"slide {slide.name}: its pins leave the line in {guide} by {off:.3g} mm, the limit is "
            f"{OFF_LINE:g} mm; give the motion of this linkage"
        )
    # Between two samples a way goes at most an eighth of the second difference beyond them.
    beyond = max((float(np.abs(np.diff(way, 2)).max(initial=0.0)) for way in ways), default=0.0) / 8
    more = sizes.clearance + beyond
    low, high, off_axis = places.real.min() - more, places.real.max() + more, places.imag.mean()
    first, last = (complex(end, off_axis) * along for end in (low, high))
    return Slot(slide.name, guide, first, last, sizes.slot_width)
