"""How near outlines come to the exact flanks, so that every pair turns as exactly as it was asked to.

An error ε of a flank, normal to it, turns the driven gear by ε over the lever of the line of action. Each of
two flanks in contact is at most the deviation f of its outline off, either way: peak to peak the driven gear
strays by at most 4 f over the shortest lever.
"""

from mechwright.mechanics.gearing.pair import Pair
from mechwright.mechanics.gearing.teeth import FIT

EXACT = 5e-6
"""Peak to peak, rad, by which outlines may turn the driven gear against the exact motion."""

_FLANKS = 4
"""Deviations that add up from peak to peak: of two flanks, either way."""

_FINEST = 1e-6
"""mm. Where teeth all but lock there is next to no lever, and no outline makes such a pair exact."""


def exact_fit(pair: Pair, teeth: int, pressure_angle: float) -> float:
    """Deviation, mm, of both outlines from the exact flanks with which a pair keeps to :data:`EXACT`.

    ``teeth`` are those of the driver, the angle is in rad. It is at most :data:`FIT`.

    >>> from mechwright.mechanics.gearing.round import RoundPair
    >>> [round(exact_fit(RoundPair.of(radius, 2 * radius), 20, 0.35), 7) for radius in (5.0, 50.0)]
    [1.17e-05, 0.0001]
    """
    return lever_fit(min(float(one.min()) for one in pair.levers(pair.run(teeth), pressure_angle)))


def lever_fit(lever: float) -> float:
    """The same for the shortest lever, mm, of the gears of a pair or train."""
    return min(FIT, max(EXACT * lever / _FLANKS, _FINEST))
