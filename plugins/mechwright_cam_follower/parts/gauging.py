"""Sizes by which a cam is measured on a dividing head: from its axis to its edge, angle by angle."""

import math

import numpy as np

from mechwright import TOLERANCES, Array, Loop
from mechwright.contracts.measure import Measure

STEP = 30
"""Degrees from one size to the next."""

_TURN = 1e-3
"""Half the turn over which the slope of the edge is taken, rad."""


def edge_measures(outside: Loop) -> tuple[Measure, ...]:
    """Distances from the axis to the outside of a cam, with limits of what a proof lets pass.

    A wall that is t too high across itself is t/cos(ψ) too far from the axis, where the edge leans by ψ from
    a circle about it: tan(ψ) = r'/r.
    """
    points = outside.flatten(TOLERANCES.flatten / 10)
    edge = np.vstack((points, points[:1]))
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


def _radius(edge: Array, angle: float) -> float:
    """Distance of the edge along a ray from the origin, mm: the farthest place that it meets."""
    along, across = (
        np.array([math.cos(angle), math.sin(angle)]),
        np.array([-math.sin(angle), math.cos(angle)]),
    )
    out, beside = edge @ along, edge @ across
    met = np.flatnonzero((beside[:-1] <= 0) != (beside[1:] <= 0))
    share = beside[met] / (beside[met] - beside[met + 1])
    return float((out[met] + share * (out[met + 1] - out[met])).max())
