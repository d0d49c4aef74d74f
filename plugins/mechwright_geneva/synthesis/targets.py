"""What a requirement of a Geneva mechanism says of sizes and times, as places beside the wheel's axis.

The wheel turns about the origin and the driver about a point of the x axis, as in every design. Sizes that
are not given are those of straight slots, in which the roller enters along the slot: with n slots and axes C
apart the wheel has the radius C cos(π/n) and the crank C sin(π/n).
"""

import cmath
import math
from functools import partial

from mechwright import Target
from mechwright_geneva.requirements import IndexingRequirement

SHORTEST = 0.01
"""Least part of the size, and of half a turn, to which a target can be dragged."""

PLACES = 4
"""Digits behind the point of what a drag writes, mm and s."""


def targets_of(requirement: IndexingRequirement) -> tuple[Target, ...]:
    """The size that is given, and how far the driver turns while the wheel moves.

    >>> size, turn = targets_of(IndexingRequirement(slots=4, centre_distance=100, speed=60, index_time=0.25))
    >>> size.place, [round(part, 3) for part in turn.place]
    ((100.0, 0.0), [50.0, 50.0])
    >>> size.moved((120.0, 3.0)), turn.moved((100.0, 50.0))
    ({'centre_distance': 120.0}, {'index_time': 0.5})
    """
    half = math.pi / requirement.slots
    wheel, crank = math.cos(half), math.sin(half)  # per mm of the distance of the axes
    if requirement.wheel_diameter is not None:
        key, name, share, distance = (
            "wheel_diameter",
            "rim of the wheel",
            -0.5,
            requirement.wheel_diameter / 2 / wheel,
        )
    elif requirement.centre_distance is not None:
        key, name, share, distance = "centre_distance", "axis of the driver", 1.0, requirement.centre_distance
    else:
        key, name = "overall_length", "end of the driver"
        distance = requirement.longest / (1 + wheel + crank)
        share = (1 + crank) / (1 + wheel + crank)
    size = share * (getattr(requirement, key) or requirement.longest)
    turned = min(math.pi, math.pi * requirement.speed / 60 * requirement.index_time)
    enters = distance + distance * crank * cmath.exp(1j * (math.pi - turned))
    return (
        Target(name, (size, 0.0), partial(_sized, key, share)),
        Target(
            "driver where a move ends", (enters.real, enters.imag), partial(_timed, requirement, distance)
        ),
    )


def _sized(key: str, share: float, place: tuple[float, ...]) -> dict[str, float]:
    return {key: round(max(place[0] / share, SHORTEST), PLACES)}


def _timed(requirement: IndexingRequirement, distance: float, place: tuple[float, ...]) -> dict[str, float]:
    turned = abs(cmath.phase(distance - complex(*place)))
    return {"index_time": round(max(turned, SHORTEST) / math.pi * 60 / requirement.speed, PLACES)}
