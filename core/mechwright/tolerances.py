"""Every numerical limit of the program, each with its reason, in one frozen object."""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Tolerances:
    """Limits in millimetres unless the name says otherwise."""

    closure: float = 1e-7
    """Gap between consecutive segments of a loop: the CAD kernel's own vertex tolerance."""

    outline: float = 0.001
    """Deviation of a fitted outline from the exact curve: a tenth of what a good mill holds."""

    flatten: float = 0.0005
    """Chord error when an outline becomes a polygon: half of ``outline``, so it never dominates."""

    arc_fit: float = 0.002
    """Deviation of a toolpath arc from the exact path; also the arc consistency the proof demands.
    LinuxCNC rejects end radii 0.0283 mm apart, Grbl 0.005 mm; this stays clear of both."""

    gouge: float = 0.005
    """Deepest cut into the finished part that the proof lets pass."""

    leftover: float = 0.010
    """Thickest stock left on a wall that a chosen cutter could have reached."""

    noise: float = 1e-9
    """Depths and counts of passes that differ by less are equal: rounding in sums of lengths up to metres."""

    slack: float = 1e-9
    """Part of a limit by which a value may be past it and still be at it: the rounding of a sum of what a
    design file says, far below what anybody can make or measure."""

    angle_rad: float = 1e-9
    """Two directions closer than this are the same: a metre of lever moves a nanometre."""


TOLERANCES = Tolerances()
"""The tolerances in force."""

OFF_CENTRE = 4 * (TOLERANCES.gouge + TOLERANCES.leftover) / 2
"""mm by which two wheels on two holes of a base may be out of place. A hole that keeps the leftover limit on
one side and is cut too deep by the gouge limit on the other has its middle off by half of both; there are
four."""


def exceeds(value: float, limit: float) -> bool:
    """Whether a value is above a limit; one that reaches it exactly is not, whatever rounding made of it.

    >>> exceeds(50.00000000000001, 50.0), exceeds(50.001, 50.0)
    (False, True)
    """
    return value > limit + TOLERANCES.slack * abs(limit)


def falls_short(value: float, limit: float) -> bool:
    """Whether a value is below a limit; one that reaches it exactly is not, whatever rounding made of it.

    >>> falls_short(0.1 + 0.2 - 0.3, 0.0), falls_short(39.99999999999999, 40.0)
    (False, False)
    """
    return value < limit - TOLERANCES.slack * abs(limit)
