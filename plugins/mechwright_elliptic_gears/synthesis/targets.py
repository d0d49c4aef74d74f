"""How long a figure of eight shall be, as a place on the line of the gears' axes."""

from functools import partial

from mechwright import Target
from mechwright_elliptic_gears.requirements import TrainRequirement

SHORTEST = 1.0
"""mm, the least length that can be asked for."""


def targets_of(wanted: TrainRequirement) -> tuple[Target, ...]:
    """The outer end of the figure of eight, of a train in the middle of the bounds.

    A figure of the length L = 4 a e has its middle at x = a and its end at a + L/2, so at L (1 + 1/(2 e))/2.
    Without a length it is that of the bounds; dragged, it is asked for.

    >>> end = targets_of(TrainRequirement(length=100, eccentricity_min=0.4, eccentricity_max=0.6))[0]
    >>> end.place, end.moved((120.0, 7.0))
    ((100.0, 0.0), {'length': 120.0})
    """
    eccentricity = sum(wanted.bounds("eccentricity")) / 2
    length = wanted.length or 2 * eccentricity * sum(wanted.bounds("semi_major"))
    share = (1 + 1 / (2 * eccentricity)) / 2
    return (Target("end of the figure of eight", (share * length, 0.0), partial(_moved, share)),)


def _moved(share: float, place: tuple[float, ...]) -> dict[str, float]:
    return {"length": round(max(place[0] / share, SHORTEST), 3)}
