"""Marks on gears: which tooth meets which space as the driver's far vertex is on the line of centres."""

import math
from collections.abc import Collection

import numpy as np

from mechwright import FittingMark, Point
from mechwright.arrays import Array
from mechwright.mechanics.gearing.usual import DOT
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import ellipse_of, outline_of, rack_of


def gear_marks(
    params: EllipticGearParams, name: str, bodies: Collection[str], key: float | None
) -> tuple[FittingMark, ...]:
    """One dot under the tooth with which a gear drives, two about the space in which it is driven.

    A part whose copies do both has both. ``key`` is the direction of the keyway, rad.
    """
    tooth, space = meeting_teeth(params)
    drivers = {"gear-2"} if params.stages == 1 else {"gear-2", "gear-4"}
    marks = []
    if drivers & set(bodies):
        marks.append(
            FittingMark(
                f"Where {name} drives, its one dot goes between the two dots of the gear that it drives, "
                "once a turn.",
                (tooth,),
            )
        )
    if set(bodies) - drivers:
        marks.append(
            FittingMark(
                f"Where {name} is driven, the one dot of its driver goes between its two dots.", space
            )
        )
    if key is not None:
        angle = math.degrees(key) % 360
        marks.append(
            FittingMark(
                f"The keyway of {name} stands at {angle:.1f}° to its long axis, counted from its far vertex."
            )
        )
    return tuple(marks)


def meeting_teeth(params: EllipticGearParams) -> tuple[Point, tuple[Point, Point]]:
    """The dot of a driving gear, and those of the driven one, in the frame that all gears share, mm.

    With the far vertex of the driver on the line of centres, its tooth nearest to that line stands in the
    space of its mate between the two teeth nearest to it.
    """
    tips = _tips(params)
    apart = 2 * ellipse_of(params).semi_major
    driver = int(np.argmin(np.abs(np.angle(tips))))
    there = tips[driver] - apart  # the same place, seen from the mate, which stands unturned
    away = np.abs(np.angle(tips / there))
    one, two = np.argsort(away)[:2]
    dots = _below(tips, params)
    first, second = sorted((int(one), int(two)))
    return dots[driver], (dots[first], dots[second])


def _tips(params: EllipticGearParams) -> Array:
    """Middles of all tips (z,), x + i y, mm."""
    places = [segment.at(0.5)[0] for segment in outline_of(params).outer.segments if segment.tag == "tip"]
    return np.array([complex(x, y) for x, y in places])


def _below(tips: Array, params: EllipticGearParams) -> list[Point]:
    """A place under each tooth."""
    rack = rack_of(params)
    deep = rack.addendum + rack.dedendum + DOT
    inwards = tips * (1 - deep / np.abs(tips))
    return [(round(float(at.real), 4), round(float(at.imag), 4)) for at in inwards]
