"""Links as made: how far their bores stand apart, and how much room their pins have.

A pin that turns may stand anywhere in its bore: half the difference of the diameters off its middle. Where a
bushing is pressed in, its own fit is that room, and the bore only says where it sits.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from mechwright.contracts.finding import Finding, Severity, Stage
from mechwright.contracts.made_part import MadePart

STEP = 1e-3
"""mm: clearances that are proposed are whole micrometres, upwards."""


@dataclass(frozen=True)
class Hole:
    """A bore to look for: centre in the part's coordinates and drawn diameter, mm."""

    centre: complex
    diameter: float


@dataclass(frozen=True)
class MadeLink:
    """Two bores of a plate as made.

    Parameters
    ----------
    off
        By how much the bores stand too far apart, mm.
    spread
        By how much more that may be, either way, with the path anywhere in its corridor, mm.
    """

    off: float
    spread: float


@dataclass(frozen=True)
class Joint:
    """A pin in the bore in which it turns.

    Parameters
    ----------
    name
        What it is called.
    room
        How far the pin may stand off the middle of its bore, mm; below 0 it does not go in.
    spread
        By how much more or less that may be, mm.
    """

    name: str
    room: float
    spread: float


def link(part: MadePart, one: Hole, two: Hole) -> MadeLink | None:
    """The distance of two bores; None if one of them is not there."""
    holes = [part.hole_at(h.centre.real, h.centre.imag, h.diameter) for h in (one, two)]
    if holes[0] is None or holes[1] is None:
        return None
    apart = math.hypot(holes[1].x - holes[0].x, holes[1].y - holes[0].y)
    return MadeLink(apart - abs(two.centre - one.centre), 2 * part.corridor)


def offset(part: MadePart, hole: Hole, others: Sequence[Hole], along: complex) -> MadeLink | None:
    """How far along a direction a bore stands from the middle of others; None if one is not there."""
    made = [part.hole_at(h.centre.real, h.centre.imag, h.diameter) for h in (hole, *others)]
    off = []
    for drawn, found in zip((hole, *others), made, strict=True):
        if found is None:
            return None
        off.append(((complex(found.x, found.y) - drawn.centre) * along.conjugate()).real / abs(along))
    return MadeLink(off[0] - sum(off[1:]) / len(others), 2 * part.corridor)


def joint(name: str, part: MadePart, hole: Hole, pin: float, bushed: float | None = None) -> Joint | None:
    """The room of a pin of that diameter, mm; ``bushed`` is the fit of its bushing, mm, if it has one."""
    if bushed is not None:
        return Joint(name, bushed / 2, 0.0)
    made = part.hole_at(hole.centre.real, hole.centre.imag, hole.diameter)
    return None if made is None else Joint(name, (made.least - pin) / 2, part.corridor)


def stuck(code: str, joints: Sequence[Joint], parameter: str, given: float) -> list[Finding]:
    """An error for pins that do not go into their bores, with the clearance that lets all of them in."""
    tight = [one for one in joints if one.room - one.spread <= 0]
    if not tight:
        return []
    worst = min(tight, key=lambda one: one.room - one.spread)
    left = worst.room - worst.spread
    better = math.ceil((given - 2 * left) / STEP + 1) * STEP
    return [
        Finding(
            code,
            Severity.ERROR,
            parameter,
            f"as made the pin of joint {worst.name} does not turn in its bore, which is "
            f"{-2 * left:.4f} mm too small",
            2 * left,
            0.0,
            "mm",
            f"make {parameter} {better:g}: on this wall that leaves {2 * left + better - given:.4f} mm",
            Stage.MACHINING,
        )
    ]
