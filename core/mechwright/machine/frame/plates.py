"""The two bearing plates: bores for bearings, registers for two of the pillars, holes for screws.

A plate is drawn with its inner face up, and milled from there in one setting: bearings and pillars go into
that face. The lower plate stands as it is drawn, the upper one is turned over about x.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

from mechwright.contracts.fits import hole_fit
from mechwright.contracts.part import Bore
from mechwright.geometry.segments import Point
from mechwright.machine.frame.kit import Kit
from mechwright.machine.frame.located import (
    FREE,
    RETAINER_THREAD,
    SCREW,
    proud,
    retainer_places,
)
from mechwright.machine.frame.seats import Seat
from mechwright.machine.frame.standing import Standing
from mechwright.mechanics.linkage import Boss, rectangle
from mechwright.standards.stock import plate_for

FLOOR = 2.5
"""Least thickness behind a bearing, mm: the shoulder that it leans on."""

SEAT_DEPTH = (-0.025, 0.025)
"""Limit deviations of the depth of a bearing's seat, mm: the floats of the shafts depend on it."""

CORNER = 9.0
"""Radius of a plate's corners, mm."""

LEAST = 10.0
"""Least thickness of a bearing plate, mm: room for a counterbored screw."""


def least_thickness(seats: Sequence[Seat]) -> float:
    """Of a plate that has these bearings, mm: of a pair of plates, the one with the deeper seats."""
    return max(seat_depth(seat, upper=True) for seat in seats) + FLOOR


def thickness_for(seats: Sequence[Seat], material: str, in_hand: Sequence[float] = ()) -> float:
    """The thickness of a plate that has these bearings, mm, as it is sold or in hand."""
    return plate_for(max(LEAST, least_thickness(seats)), material, in_hand)


def seat_depth(seat: Seat, *, upper: bool) -> float:
    """Depth of the seat of one of a shaft's bearings, mm.

    A locating bearing stands out of its seat, a free one has room on both sides.
    """
    width = seat.bearing.width
    if not seat.located:
        return width
    return round(width + 2 * FREE if upper else width - proud(seat.bearing), 6)


@dataclass(frozen=True)
class Hole:
    """A hole of a plate: its bores, one within the other, each with diameter, top and depth, mm."""

    name: str
    point: Point
    steps: tuple[tuple[float, float, float], ...]
    fit: str = ""
    """Class of the first one, such as H7; empty for none."""
    depth_limits: tuple[float, float] | None = None
    """Limit deviations of the depth of the first one, mm; None for the general tolerance."""

    @classmethod
    def through(cls, name: str, point: Point, diameter: float, thickness: float) -> "Hole":
        """One diameter."""
        return cls(name, point, ((diameter, 0.0, thickness),))

    def bores(self) -> list[Bore]:
        """As features, the through one first."""
        found = []
        for number, (diameter, top, depth) in enumerate(self.steps):
            fit = hole_fit(diameter, self.fit) if self.fit and number == 0 else None
            name = self.name if number == 0 else f"{self.name}-through"
            limits = self.depth_limits if number == 0 else None
            found.append(Bore(name, self.point, fit.middle if fit else diameter, top, depth, fit, limits))
        return found[::-1]


def bearing_hole(seat: Seat, thickness: float, *, upper: bool) -> Hole:
    """The bore of a bearing with its shoulder; through the shoulder goes what the outer ring leaves free."""
    bearing = seat.bearing
    return Hole(
        f"bearing-{seat.spindle.name}",
        seat.spindle.point,
        (
            (bearing.outside, 0.0, seat_depth(seat, upper=upper)),
            (bearing.abutment, 0.0, thickness),
        ),
        fit="H7",
        depth_limits=SEAT_DEPTH,
    )


def retainer_holes(seat: Seat, thickness: float) -> list[Hole]:
    """Of the screws of a locating bearing's retainer in its plate; none for a floating one."""
    if not seat.located:
        return []
    deep, (x, y) = min(RETAINER_THREAD, thickness), seat.spindle.point
    return [
        Hole(f"retainer-{seat.spindle.name}-{k}", (x + a, y + b), ((SCREW, 0.0, deep),))
        for k, (a, b) in enumerate(retainer_places(seat.bearing), start=1)
    ]


def mirrored(hole: Hole) -> Hole:
    """The hole of a plate that is turned over about x."""
    return replace(hole, point=(hole.point[0], -hole.point[1]))


def add_plate(
    kit: Kit,
    name: str,
    standing: Standing,
    edge: float,
    thickness: float,
    material: str,
    holes: Sequence[Hole],
    body: str,
    z: float,
    *,
    over: bool = False,
) -> None:
    """A rectangular plate, ``edge`` larger all round than its pillars; ``over``: turned over about x."""
    low = complex(standing.left - edge, standing.below - edge)
    high = complex(standing.right + edge, standing.above + edge)
    if over:
        low, high = complex(low.real, -high.imag), complex(high.real, -low.imag)
        holes = [mirrored(hole) for hole in holes]
    bores = [bore for hole in holes for bore in hole.bores()]
    through = [
        Boss(complex(*bore.centre), 0.0, bore.diameter, bore.name)
        for bore in bores
        if bore.top + bore.depth >= thickness
    ]
    outline = rectangle(low, high, min(edge, CORNER), through)
    kit.plate(name, outline, thickness, material, bores, body, z)
