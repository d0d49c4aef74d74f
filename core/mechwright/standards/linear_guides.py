"""Miniature profile rail guides: a rail, and a carriage that rolls on it.

Both are drawn with the base of the rail at z = 0 and the way along x. The origin of the rail is the middle of
its first end, that of the carriage its own middle.
"""

import math
from dataclasses import dataclass

from mechwright.contracts.bought import BlindThread, Bought
from mechwright.contracts.on_plates import GuideSize
from mechwright.contracts.shape import Revolve, Shape, box, ring
from mechwright.errors import DesignError
from mechwright.geometry.segments import Point
from mechwright.standards.table import table

STRIP = 216.0
"""At which a thread of the carriage's steel strips, MPa: 0.6 of the strength of the weakest usual steel."""

CLEAR = 0.05
"""Between carriage and rail as they are drawn, mm: their balls are not."""

UNDERCUT = 1.0
"""How deep the grooves of the balls are drawn, mm: the carriage comes onto its rail from an end alone."""


@dataclass(frozen=True)
class LinearGuide:
    """A size; the table says what its numbers are."""

    size: float
    height: float
    width: float
    length: float
    under: float
    across: float
    along: float
    thread: float
    depth: float
    rail: float
    high: float
    pitch: float
    end: float
    hole: float
    head: float
    sunk: float
    roll: float
    tilt: float
    mass: float
    line: float

    @property
    def name(self) -> str:
        """As a design file names it.

        >>> linear_guide("linear-12").name
        'linear-12'
        """
        return f"linear-{self.size:g}"

    @property
    def carriage_holes(self) -> tuple[Point, ...]:
        """Places of its threads, mm."""
        x, y = self.along / 2, self.across / 2
        return ((-x, -y), (x, -y), (x, y), (-x, y))

    @property
    def _waist(self) -> float:
        """Height below which the rail is drawn narrower, mm."""
        return (self.under + self.high) / 2

    def rail_length(self, least: float) -> float:
        """The shortest rail that is cut with equal ends and is at least so long, mm.

        >>> linear_guide("linear-12").rail_length(60)
        70
        """
        gaps = max(1, math.ceil((least - 2 * self.end) / self.pitch))
        return 2 * self.end + gaps * self.pitch

    def rail_holes(self, length: float) -> tuple[float, ...]:
        """Places of its holes along a rail, mm."""
        count = round((length - 2 * self.end) / self.pitch) + 1
        return tuple(self.end + k * self.pitch for k in range(count))

    def cut(self, least: float) -> GuideSize:
        """With the shortest rail that is at least so long, mm."""
        length = self.rail_length(least)
        return GuideSize(
            self.name,
            self.rail_bought(length),
            self.carriage_bought,
            length,
            self.width,
            self.height,
            self.rail_holes(length),
            self.high - self.sunk,
            self.carriage_holes,
            self.thread,
            self.depth,
        )

    def rail_bought(self, length: float) -> Bought:
        """How a rail is ordered."""
        half, foot = self.rail / 2, self._waist
        waist = half - UNDERCUT
        less = [
            Revolve(one.profile, (x, 0.0))
            for x in self.rail_holes(length)
            for one in (
                ring(0.0, self.hole, self.high),
                ring(0.0, self.head, self.sunk, self.high - self.sunk),
            )
        ]
        return Bought(
            f"rail of a miniature linear guide, size {self.size:g}, {length:g} mm long, "
            f"holes {self.end:g} mm from both ends",
            "",
            round(self.line * length, 1),
            Shape(
                (
                    box((0.0, length), (-half, half), (foot, self.high)),
                    box((0.0, length), (-waist, waist), (0.0, foot)),
                ),
                tuple(less),
            ),
            "with its carriage, of one maker",
        )

    @property
    def carriage_bought(self) -> Bought:
        """How the carriage is ordered."""
        x, y, rail = self.length / 2, self.width / 2, self.rail / 2 + CLEAR
        whole = box((-x, x), (-y, y), (self.under, self.height))
        foot = self._waist - CLEAR
        channel = box((-x, x), (-rail, rail), (foot, self.high + CLEAR))
        waist = box((-x, x), (UNDERCUT - rail, rail - UNDERCUT), (self.under, foot))
        holes = [
            Revolve(ring(0.0, self.thread, self.depth, self.height - self.depth).profile, place)
            for place in self.carriage_holes
        ]
        threads = tuple(
            BlindThread(place, self.height, self.thread, self.depth, STRIP) for place in self.carriage_holes
        )
        return Bought(
            f"carriage of a miniature linear guide, size {self.size:g}, standard length, light preload",
            "",
            self.mass,
            Shape((whole,), (channel, waist, *holes)),
            "its balls fall out when it leaves its rail",
            threads,
        )


def linear_guides() -> tuple[LinearGuide, ...]:
    """All sizes, from the smallest."""
    return table("linear-guides").of(LinearGuide)


def linear_guide(name: str) -> LinearGuide:
    """The size of a name; raises DesignError that lists the names.

    >>> linear_guide("linear-9").height
    10
    """
    found = {one.name: one for one in linear_guides()}
    if name not in found:
        raise DesignError(f"no linear guide {name!r}; one of: {', '.join(found)}")
    return found[name]
