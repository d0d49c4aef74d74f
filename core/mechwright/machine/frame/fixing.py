"""The screw for a blind thread of a bought part: long enough to bear, and short enough not to bottom out."""

from dataclasses import dataclass

from mechwright.errors import DesignError
from mechwright.machine.frame.kit import Kit
from mechwright.machine.frame.pillars import SPARE, put_screw
from mechwright.mechanics.strength.tightening import LEAST_ENGAGED
from mechwright.standards.screws import Screw, lengths, screw, washer

WASHERS = 2
"""So many washers may lie under a head that would go too deep without them."""

_SAME = 1e-9
"""Lengths that differ by less, mm, are the same."""


@dataclass(frozen=True)
class Fixing:
    """A cap screw, the washers under its head, and how deep the head is sunk, mm."""

    screw: Screw
    washers: int = 0
    sunk: float = 0.0


def fixing(size: float, grip: float, depth: float, sink: float = 0.0, washers: int = 0) -> Fixing:
    """The screw that goes as deep as it may through a grip into a blind thread, mm.

    Its end stays clear of the thread's by ``SPARE``, and it engages ``LEAST_ENGAGED`` diameters at least.
    Where no length does, more than ``washers`` are put under the head, or the head is sunk, by up to
    ``sink``.

    Raises DesignError where all that does not help.

    >>> fixing(5, 15, 6).screw.length, fixing(5, 10, 6).washers, fixing(3, 6, 3, 2).sunk
    (20, 1, 0.5)
    """
    most, least = depth - SPARE, LEAST_ENGAGED * size
    for count in range(washers, WASHERS + 1):
        thick = grip + count * (washer(size).height if count else 0.0)
        fitting = [
            one for one in lengths(size) if thick + least <= one + _SAME and one <= thick + most + _SAME
        ]
        if fitting:
            return Fixing(screw(size, fitting[-1]), count)
    shorter = [one for one in lengths(size) if grip + most - sink <= one + _SAME and one <= grip + most]
    if shorter and most >= least:
        return Fixing(screw(size, shorter[-1]), 0, round(grip + most - shorter[-1], 6))
    raise DesignError(
        f"no screw M{size:g} that is sold goes {least:g} to {most:g} mm into a thread {depth:g} mm deep "
        f"through a plate of {grip:g} mm and up to {WASHERS} washers"
    )


def put_fixing(kit: Kit, found: Fixing, body: str, top: float) -> None:
    """The screw and its washers on a plate whose upper face is at a height of a body, mm."""
    seat = top - found.sunk
    for _ in range(found.washers):
        ring = washer(found.screw.of.size)
        kit.bought(f"washer-m{found.screw.of.size:g}", ring.bought, body, seat)
        seat += ring.height
    put_screw(kit, found.screw, body, seat)
