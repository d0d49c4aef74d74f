"""Dowels that no body shows: holes named ``dowel`` of several parts in one line, in which no pin stands."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mechwright.contracts.bodies import Placed
from mechwright.contracts.part import Bore
from mechwright.mechanics.mating.rounds import NEAR, rounds_of

HOLE = "dowel"
"""How the name of a dowel's hole begins."""


@dataclass(frozen=True)
class Seat:
    """The hole of a dowel: number of its body, name of the hole, heights of its ends, mm."""

    body: int
    hole: str
    low: float
    high: float


@dataclass(frozen=True)
class UndrawnDowel:
    """A dowel that is no body: diameter, mm, and its seats, of which the first holds it."""

    diameter: float
    seats: tuple[Seat, ...]

    @property
    def room(self) -> float:
        """Length over all of its holes, mm."""
        return round(max(one.high for one in self.seats) - min(one.low for one in self.seats), 3)


def undrawn_dowels(bodies: Sequence[Placed], sample: int) -> list[UndrawnDowel]:
    """Through all parts that have its hole in one line; the largest part, by its plan, holds it."""
    lines: dict[tuple[int, int, float], list[Seat]] = {}
    for k, body in enumerate(bodies):
        turn, place = body.poses.rotation[sample], body.poses.position[sample]
        for bore in body.part.features:
            if isinstance(bore, Bore) and bore.name.startswith(HOLE):
                top = body.part.thickness - bore.top
                ends = [
                    turn @ np.array((*bore.centre, z + body.instance.z)) + place
                    for z in (top - bore.depth, top)
                ]
                low, high = sorted(float(one[2]) for one in ends)
                size = bore.diameter if bore.fit is None else bore.fit.size
                key = (round(float(ends[0][0]) / NEAR), round(float(ends[0][1]) / NEAR), size)
                lines.setdefault(key, []).append(Seat(k, bore.name, low, high))
    return [
        UndrawnDowel(size, tuple(sorted(seats, key=lambda one: (-_plan(bodies[one.body]), one.body))))
        for (x, y, size), seats in lines.items()
        if len(seats) > 1 and not _occupied(bodies, (x * NEAR, y * NEAR), size, sample)
    ]


def _plan(body: Placed) -> float:
    return 0.0 if body.part.outline is None else body.part.outline.outer.area


def _occupied(bodies: Sequence[Placed], at: tuple[float, float], diameter: float, sample: int) -> bool:
    """Whether a pin of about this diameter stands at a place, mm."""
    return any(
        not one.inside
        and abs(one.diameter - diameter) < 0.1 * diameter
        and math.dist(at, (float(one.at[0]), float(one.at[1]))) < 2 * NEAR
        for body in bodies
        if body.part.outline is None
        for one in rounds_of(body, sample)
    )
