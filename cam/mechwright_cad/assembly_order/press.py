"""What bears the force of a press fit at its step: a tube under the hole, a packing, or what lies there."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
from manifold3d import Manifold

from mechwright.mechanics.mating.rounds import Match
from mechwright_cad.assembly_order.layers import LEVEL, frame_of
from mechwright_cad.assembly_order.levels import Step
from mechwright_cad.assembly_order.order import Order

WALL = 3.0
"""Thickness of a tube that supports a part round a hole, mm."""

ROOM = 0.5
"""Between the hole and that tube, on each side, mm."""

FREE = 40.0
"""Length over which the tube is looked at, mm: a clamp or the anvil of a press gets in."""


@dataclass(frozen=True)
class Support:
    """What bears a press.

    Parameters
    ----------
    bears
        ``tube``: a support under the hole; ``stack``: what lies there; ``end``: the shaft's other end.
    packings
        What has to be put between: above which body, by number, and how thick, mm.
    holds
        Whether it does not give way.
    """

    bears: Literal["tube", "stack", "end"]
    packings: tuple[tuple[int, float], ...]
    holds: bool


_CORNERS = 48


def presses(order: Order, step: Step) -> Iterator[Match]:
    """What a step presses: tight seats between what comes and what is there."""
    moved, onto = set(step.moved), set(step.onto)
    for match in order.seats.matches:
        between = {match.pin, match.hole}
        if between & moved and between & onto and order.seats.kind(match) == "pressed":
            yield match


def support(order: Order, step: Step, match: Match) -> Support:
    """What bears a press at a step."""
    held = _retained(order, step)
    if match.hole in step.moved:
        return Support("end", (), match.pin in held or _end_is_free(order, step, match))
    below = _below(order, step, match)
    packings, end = [], 0.0
    for low, high, k in below:
        if low - end > LEVEL:
            packings.append((k, low - end))
        if k in held:
            break
        end = max(end, high)
    return Support("stack" if below else "tube", tuple(packings), holds=True)


def _below(order: Order, step: Step, match: Match) -> list[tuple[float, float, int]]:
    """Bodies under the rim of a hole: where along the way each begins and ends, from the hole's end, mm."""
    way, inside = np.array(step.way), match.inside
    far = inside.high if float(inside.axis @ way) > 0 else inside.low
    frame, start = frame_of(way), inside.at + far * inside.axis
    inner = inside.diameter / 2 + ROOM
    tube = Manifold.cylinder(FREE, inner + WALL, circular_segments=_CORNERS)
    tube -= Manifold.cylinder(FREE, inner, circular_segments=_CORNERS)
    placed = tube.transform(np.column_stack((frame.T, start)))
    found = []
    for k in set(step.onto) - {match.hole, match.pin}:
        met = placed ^ order.standing.solid(k)
        if not met.is_empty():
            along = np.asarray(met.to_mesh64().vert_properties)[:, :3] @ way - start @ way
            found.append((round(float(along.min()), 3), round(float(along.max()), 3), k))
    return sorted(found)


def _end_is_free(order: Order, step: Step, match: Match) -> bool:
    """Whether a rod of half the seat's diameter can be put under the far end of a pin that stands there."""
    way = np.array(step.way)
    ends = np.asarray(order.standing.solid(match.pin).to_mesh64().vert_properties)[:, :3] @ way
    seat = match.outside.at
    start = seat + (ends.max() - seat @ way) * way
    rod = Manifold.cylinder(FREE, match.outside.diameter / 4, circular_segments=_CORNERS)
    placed = rod.transform(np.column_stack((frame_of(way).T, start)))
    return all((placed ^ order.standing.solid(k)).is_empty() for k in set(step.onto) - {match.pin})


def filled(order: Order, step: Step) -> Iterator[tuple[int, int]]:
    """Bushes that a step presses in while a pin is in their bore already: no mandrel passes."""
    for match in presses(order, step):
        bush = match.pin
        if bush in step.moved and order.seats.is_bush(bush):
            inside = (one.pin for one in order.seats.matches if one.hole == bush and one.pin in step.onto)
            yield from ((bush, pin) for pin in inside)


def _retained(order: Order, step: Step) -> frozenset[int]:
    """What a press may push: the ground, and what is held before the step."""
    there = frozenset(step.onto)
    loose = order.holding.unretained(there, step.root)
    return there - frozenset[int]().union(*loose)
