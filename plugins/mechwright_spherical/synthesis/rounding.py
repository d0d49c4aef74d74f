"""Linkages on points whose arcs are rounded to steps, all else fitted again."""

from dataclasses import replace
from typing import Protocol

import numpy as np

from mechwright import Array, Finding, Rejected
from mechwright.mechanics.tracing.search import Room, Trace, followed
from mechwright.mechanics.tracing.stepped import Dimensioned, Held, stepped

NO_STEP = "spherical.arc-step", "no multiples of arc_step keep the limits"
"""Code and message of linkages that no rounding leaves within their limits."""


def no_step(rejected: Rejected, step: float) -> list[Finding]:
    """That the step alone stands in the way, where it has been in that of some linkage."""
    if NO_STEP[0] not in [reason.code for reason in rejected.reasons]:
        return []
    said = f"linkages keep the limits, but none with arcs in multiples of {step:g} degrees"
    return [Finding.error(NO_STEP[0], "arc_step", said, step, remedy="make arc_step smaller")]


class SteppedRoom(Room, Dimensioned, Protocol):
    """A room that says which of its unknowns are dimensions."""

    @property
    def columns(self) -> tuple[int, ...]:
        """Their numbers: the arcs, then azimuth and elevation of the path point."""


def rounded(one: Trace, room: SteppedRoom, step: float) -> Trace | None:
    """The linkage with arcs and path point in multiples of ``step``, degrees; None where no limit lets it."""
    columns = list(room.columns)

    def fitted(values: tuple[float, ...], before: Trace | None) -> tuple[Trace, float, Array] | None:
        begin = before or one
        held = Held(room, values, float(np.degrees(1.0)))
        for end in followed(held, begin.room, begin.x[None], begin.theta[None]):
            if end.kept:
                return end, end.mean, room.dimensions(room.made(end.x))
        return None

    found = stepped(room.dimensions(room.made(one.x)), (len(columns) - 2, 2), step, fitted)
    if found is None:
        return None
    values, end = found
    x = end.x.copy()
    x[columns] = np.radians(values)
    missed = room.missed(room.made(x[None]), end.theta[None])
    return replace(end, x=x, mean=float(np.sqrt((missed**2).sum() / end.theta.size)))
