"""The turn of a cam as segments, each with its law: lift and derivatives over the angle of the cam.

Glossary
--------
segment
    A rise, a dwell or a return.
lift
    How far the follower is from its lowest place: mm, of a lever rad.
share
    u of a segment, 0 to 1. By segment and share, both ends of a segment have its own acceleration,
    though it jumps to that of the neighbour.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mechwright import Array
from mechwright.mechanics.laws import LAWS, Law, Polynomial, Rates
from mechwright_cam_follower.parameters import CamParams


@dataclass(frozen=True)
class Segment:
    """Of a turn.

    Parameters
    ----------
    start, width
        Angles of the cam, rad.
    low, rise
        Lift at its start, and what it gains; below 0 in a return.
    law
        None for a dwell.
    """

    start: float
    width: float
    low: float
    rise: float
    law: Law | None

    def at(self, u: Array) -> Rates:
        """Lift and its derivatives over the cam's angle, per radian, at shares u."""
        u = np.asarray(u, dtype=float)
        if self.law is None:
            zero = np.zeros_like(u)
            return Rates(zero + self.low, zero, zero, zero)
        rates, w = self.law.at(u), self.width
        return Rates(
            self.low + self.rise * rates.s,
            self.rise / w * rates.v,
            self.rise / w**2 * rates.a,
            self.rise / w**3 * rates.j,
        )

    @property
    def cuts(self) -> tuple[float, ...]:
        """Shares, ends included, between which all rates are smooth."""
        return (0.0, *(self.law.breaks if self.law else ()), 1.0)


@dataclass(frozen=True)
class Cycle:
    """All segments of a turn, in their order."""

    segments: tuple[Segment, ...]

    @cached_property
    def starts(self) -> Array:
        """Angles of the cam where segments begin, rad."""
        return np.array([one.start for one in self.segments])

    @property
    def breaks(self) -> tuple[float, ...]:
        """Angles of the cam, rad, between which all rates are smooth, both ends of the turn included."""
        return tuple(one.start + one.width * cut for one in self.segments for cut in one.cuts)

    def at(self, theta: Array) -> Rates:
        """Lift and its derivatives at angles (n,), rad, in [0, 2π]; where segments meet, of the later one."""
        theta = np.asarray(theta, dtype=float)
        which = np.maximum(np.searchsorted(self.starts, theta, side="right") - 1, 0)
        found = np.zeros((4, theta.size))
        for number, segment in enumerate(self.segments):
            mine = which == number
            rates = segment.at(np.clip((theta[mine] - segment.start) / segment.width, 0.0, 1.0))
            found[:, mine] = rates.s, rates.v, rates.a, rates.j
        return Rates(*found)


def _law(name: str, params: CamParams) -> Law:
    """Give a law by its name; a table or polynomial has been found free of faults before."""
    if name == "polynomial":
        return Polynomial(params.polynomial or ())
    if name == "table":
        from mechwright.mechanics.laws.table import Table

        return Table(params.table or ())
    return LAWS[name]()


def cycle_of(params: CamParams) -> Cycle:
    """Give the turn of a design, or of designs of one table.

    >>> cycle = cycle_of(CamParams(angles=(180.0, 180.0), lifts=(10.0, 0.0)))
    >>> cycle.at(np.array([0.0, np.pi / 2, np.pi])).s.round(9).tolist()
    [0.0, 5.0, 10.0]
    """
    ends = np.array(params.ends) if params.translating else np.radians(params.ends)
    widths = np.radians(params.angles)
    starts = np.concatenate(([0.0], np.cumsum(widths)[:-1]))
    names = list(params.laws) * (params.moves if len(params.laws) == 1 else 1)
    segments, low = [], float(ends[-1])
    for start, width, end in zip(starts.tolist(), widths.tolist(), ends.tolist(), strict=True):
        law = _law(names.pop(0), params) if end != low else None
        segments.append(Segment(start, width, low, end - low, law))
        low = end
    return Cycle(tuple(segments))
