"""Sizes by which a cam is measured on a dividing head: from its axis to its edge, angle by angle."""

import math

import shapely

from mechwright import TOLERANCES, Loop
from mechwright.contracts.measure import Measure

STEP = 30
"""Degrees from one size to the next."""

_LONG = 1e4
"""Length of a ray, mm."""

_TURN = 1e-5
"""Half the turn over which the slope of the edge is taken, rad."""


def edge_measures(outside: Loop) -> tuple[Measure, ...]:
    """Distances from the axis to the outside of a cam, with limits of what a proof lets pass.

    A wall that is t too high across itself is t/cos(ψ) too far from the axis, where the edge leans by ψ from
    a circle about it: tan(ψ) = r'/r.
    """
    edge = shapely.LinearRing(outside.flatten(TOLERANCES.closure))
    found = []
    for angle in range(0, 360, STEP):
        turn = math.radians(angle)
        radius = _radius(edge, turn)
        rate = (_radius(edge, turn + _TURN) - _radius(edge, turn - _TURN)) / (2 * _TURN)
        lean = math.hypot(1.0, rate / radius)
        found.append(
            Measure(
                f"axis to the edge at {angle}°",
                round(radius, 4),
                round(radius - TOLERANCES.gouge * lean, 4),
                round(radius + TOLERANCES.leftover * lean, 4),
                "edge as proven",
            )
        )
    return tuple(found)


def _radius(edge: shapely.LinearRing, angle: float) -> float:
    """Distance of the edge along a ray from the origin, mm: the farthest place that it meets."""
    ray = shapely.LineString([(0.0, 0.0), (_LONG * math.cos(angle), _LONG * math.sin(angle))])
    met = shapely.get_coordinates(shapely.intersection(edge, ray))
    return float(max(math.hypot(x, y) for x, y in met))
