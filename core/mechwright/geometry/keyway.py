"""The bore with its keyway: standard sizes, the opening's outline, and the key that must go in.

Glossary
--------
crest
    The point of the bore in the middle of the keyway, had the keyway not been cut.
hub depth t2
    From the crest to the keyway's floor, as DIN 6885-1 dimensions it (bore + t2 across).
relief
    A semicircle through a floor corner, its centre on the corner's bisector, that lets a round cutter leave
    the corner free.

The keyway points along +x.
"""

import math
from dataclasses import dataclass

from mechwright.geometry import Arc, Line, Loop, circle
from mechwright.geometry.segments import Point, Segment


@dataclass(frozen=True, slots=True)
class KeySize:
    """A parallel key of DIN 6885-1 (ISO 773) and its seats, mm.

    Parameters
    ----------
    bore_over, bore_to
        Shafts it is meant for.
    width, height
        Section of the key.
    shaft_depth, hub_depth
        t1 and t2.
    chamfer
        Least chamfer of the key's edges.
    """

    bore_over: float
    bore_to: float
    width: float
    height: float
    shaft_depth: float
    hub_depth: float
    chamfer: float


KEYS = tuple(
    KeySize(*row)
    for row in (
        (6.0, 8.0, 2.0, 2.0, 1.2, 1.0, 0.16),
        (8.0, 10.0, 3.0, 3.0, 1.8, 1.4, 0.16),
        (10.0, 12.0, 4.0, 4.0, 2.5, 1.8, 0.16),
        (12.0, 17.0, 5.0, 5.0, 3.0, 2.3, 0.25),
        (17.0, 22.0, 6.0, 6.0, 3.5, 2.8, 0.25),
        (22.0, 30.0, 8.0, 7.0, 4.0, 3.3, 0.25),
        (30.0, 38.0, 10.0, 8.0, 5.0, 3.3, 0.4),
        (38.0, 44.0, 12.0, 8.0, 5.0, 3.3, 0.4),
        (44.0, 50.0, 14.0, 9.0, 5.5, 3.8, 0.4),
        (50.0, 58.0, 16.0, 10.0, 6.0, 4.3, 0.4),
        (58.0, 65.0, 18.0, 11.0, 7.0, 4.4, 0.4),
        (65.0, 75.0, 20.0, 12.0, 7.5, 4.9, 0.6),
        (75.0, 85.0, 22.0, 14.0, 9.0, 5.4, 0.6),
        (85.0, 95.0, 25.0, 14.0, 9.0, 5.4, 0.6),
        (95.0, 110.0, 28.0, 16.0, 10.0, 6.4, 0.6),
        (110.0, 130.0, 32.0, 18.0, 11.0, 7.4, 0.6),
        (130.0, 150.0, 36.0, 20.0, 12.0, 8.4, 1.0),
        (150.0, 170.0, 40.0, 22.0, 13.0, 9.4, 1.0),
        (170.0, 200.0, 45.0, 25.0, 15.0, 10.4, 1.0),
        (200.0, 230.0, 50.0, 28.0, 17.0, 11.4, 1.0),
    )
)
"""Parallel keys, high form, after DIN 6885-1:1968."""

LEAST_WIDTH = 0.3
"""Smallest bore, keyway or relief, mm: there are no end mills for smaller ones."""

SMALLEST_EDGE = 0.01
"""Straight length, mm, that must stay between reliefs, and between relief and bore."""

TOP_CLEARANCE = 0.2
"""Gap over a key of no standard width, mm: t1 + t2 - h of the smallest standard sizes."""

LEAST_CHAMFER = 0.16
"""Chamfer of a key of no standard width, mm: the least one of the smallest standard sizes."""


def key_for_bore(bore: float) -> KeySize | None:
    """The standard key of a shaft diameter, mm.

    >>> key_for_bore(12.0).width, key_for_bore(5.0)
    (4.0, None)
    """
    return next((key for key in KEYS if key.bore_over < bore <= key.bore_to), None)


def key_of_width(width: float) -> KeySize | None:
    """The standard key of this width, mm."""
    return next((key for key in KEYS if key.width == width), None)


@dataclass(frozen=True)
class Opening:
    """The shaft opening, mm.

    Parameters
    ----------
    bore
        Diameter, above 0.
    width, depth
        Width of the keyway and hub depth t2; 0 for a plain bore.
    relief
        Diameter of the corner reliefs; 0 for sharp corners.
    """

    bore: float
    width: float = 0.0
    depth: float = 0.0
    relief: float = 0.0

    @property
    def has_keyway(self) -> bool:
        """Whether there is a keyway."""
        return self.width > 0

    @property
    def floor(self) -> float:
        """X of the keyway's floor, mm."""
        return self.bore / 2 + self.depth

    @property
    def mouth(self) -> float:
        """X where the keyway's sides meet the bore, mm."""
        return math.sqrt((self.bore / 2) ** 2 - (self.width / 2) ** 2)

    @property
    def bite(self) -> float:
        """How far a relief reaches along floor and side from the corner, mm."""
        return self.relief / math.sqrt(2)

    @property
    def greatest_relief(self) -> float:
        """Largest relief diameter that leaves floor and sides, mm: exclusive."""
        return math.sqrt(2) * min(self.width / 2, self.floor - self.mouth)

    def loop(self) -> Loop:
        """The opening, clockwise. The caller has checked that the keyway fits the bore."""
        if not self.has_keyway:
            return Loop((circle((0.0, 0.0), self.bore / 2, clockwise=True, tag="bore"),))
        half, bite = self.width / 2, self.bite
        start = math.atan2(half, self.mouth)
        low = (self.mouth, -half)
        corners: list[Segment] = []
        if self.relief == 0:
            corners = [
                Line((self.mouth, half), (self.floor, half), "keyway"),
                Line((self.floor, half), (self.floor, -half), "keyway"),
                Line((self.floor, -half), low, "keyway"),
            ]
        else:
            corners = [
                Line((self.mouth, half), (self.floor - bite, half), "keyway"),
                self._relief((self.floor - bite / 2, half - bite / 2), 3 * math.pi / 4),
                Line((self.floor, half - bite), (self.floor, bite - half), "keyway"),
                self._relief((self.floor - bite / 2, bite / 2 - half), math.pi / 4),
                Line((self.floor - bite, -half), low, "keyway"),
            ]
        bore = Arc((0.0, 0.0), self.bore / 2, -start, 2 * start - math.tau, "bore")
        return Loop((*corners, bore))

    def _relief(self, centre: Point, start: float) -> Arc:
        return Arc(centre, self.relief / 2, start, -math.pi, "relief")

    @property
    def key_top(self) -> float:
        """X of the upper side of the key, mm."""
        key = key_of_width(self.width)
        if key:
            return self.bore / 2 + key.height - key.shaft_depth
        return self.floor - min(TOP_CLEARANCE, self.depth / 2)

    @property
    def seat_depth(self) -> float:
        """Depth t1 of the seat in the shaft, mm; that of the hub where the key is of no standard width."""
        key = key_of_width(self.width)
        return key.shaft_depth if key else self.depth

    def key_section(self) -> list[Point]:
        """Corners, mm, of the part of the key in the hub, its edges with the standard's least chamfer."""
        key, top = key_of_width(self.width), self.key_top
        chamfer = key.chamfer if key else min(LEAST_CHAMFER, self.width / 4)
        half = self.width / 2
        return [
            (self.mouth, -half),
            (top - chamfer, -half),
            (top, chamfer - half),
            (top, half - chamfer),
            (top - chamfer, half),
            (self.mouth, half),
        ]
