"""The dimensions of a four-bar linkage, and what follows from them alone.

Glossary
--------
crank a, coupler c, follower b, ground f
    A0-A, A-B, B0-B and A0-B0, mm. The crank drives.
ground angle θ
    Direction from A0 to B0.
branch
    +1 (open) where B is to the left of the line from A to B0, -1 (crossed) where it is to the right.
Grashof's condition
    Shortest + longest ≤ sum of the others: then some link turns fully.
limit position
    Crank and coupler in one line, extended or folded: the follower turns back.
transmission angle μ
    Acute angle between coupler and follower, 0 at a toggle.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import reduce
from typing import Any

import numpy as np

from mechwright.contracts.design_table import number

CHANGE_POINT = 1e-9
"""Part of the sum of all links by which Grashof's condition may miss equality and still be taken for it: the
links then line up, and which branch follows is not decided by their lengths."""


class Kind(StrEnum):
    """What the links can do, by Grashof's condition and by which link is shortest."""

    CRANK_ROCKER = "crank-rocker"
    DOUBLE_CRANK = "double crank"
    ROCKER_CRANK = "rocker-crank"
    DOUBLE_ROCKER = "Grashof double rocker"
    TRIPLE_ROCKER = "triple rocker"
    CHANGE_POINT = "change point"
    NOT_CLOSED = "not closed"

    @property
    def full_turn(self) -> bool:
        """Whether the crank turns fully without a doubt about the branch."""
        return self in (Kind.CRANK_ROCKER, Kind.DOUBLE_CRANK)


def _single(lengths: Sequence[float]) -> bool:
    """Whether these are numbers, no arrays over many linkages."""
    return not any(isinstance(length, np.ndarray) for length in lengths)


@dataclass(frozen=True, slots=True)
class Limits:
    """Crank angles from the ground line, rad, at which the follower turns back; time ratio and swing.

    Parameters
    ----------
    extended, folded
        Crank angles from the ground's direction, rad: crank and coupler in line, one after or over the other.
    swing
        Angle of the follower between both, rad.
    time_ratio
        Slower over faster stroke of the follower at constant crank speed, 1 or more.
    """

    extended: float
    folded: float
    swing: float
    time_ratio: float


@dataclass(frozen=True, slots=True)
class FourBar:
    """Link lengths in mm, ground angle in rad, branch +1 (open) or -1 (crossed).

    The lengths and the angle may be arrays that broadcast with the crank angles: a design axis of a sweep.

    Examples
    --------
    >>> bar = FourBar(40, 120, 80, 100)
    >>> bar.kind.value, round(bar.limits().time_ratio, 8)
    ('crank-rocker', 1.35557333)
    """

    crank: float
    coupler: float
    follower: float
    ground: float
    ground_angle: float = 0.0
    branch: int = 1

    @property
    def lengths(self) -> tuple[float, float, float, float]:
        """Crank, coupler, follower, ground, mm."""
        return self.crank, self.coupler, self.follower, self.ground

    @property
    def grashof_excess(self) -> float:
        """Sum of the two middle links less that of shortest and longest, mm; 0 or more: some link turns."""
        if _single(self.lengths):
            shortest, *middle, longest = sorted(self.lengths)
            return sum(middle) - shortest - longest
        ordered = np.sort(np.stack(np.broadcast_arrays(*self.lengths)), axis=0)
        excess: float = ordered[1] + ordered[2] - ordered[0] - ordered[3]
        return excess

    @property
    def closes(self) -> bool:
        """Whether the links can be assembled in some position: none is longer than the others together."""
        return 2 * self.longest <= sum(self.lengths)

    @property
    def longest(self) -> float:
        """The longest link, mm."""
        return max(self.lengths) if _single(self.lengths) else reduce(np.maximum, self.lengths)

    @property
    def kind(self) -> Kind:
        """Barker's and Grashof's class."""
        if not self.closes:
            return Kind.NOT_CLOSED
        if abs(self.grashof_excess) <= CHANGE_POINT * sum(self.lengths):
            return Kind.CHANGE_POINT
        if self.grashof_excess < 0:
            return Kind.TRIPLE_ROCKER
        return {
            self.crank: Kind.CRANK_ROCKER,
            self.follower: Kind.ROCKER_CRANK,
            self.coupler: Kind.DOUBLE_ROCKER,
            self.ground: Kind.DOUBLE_CRANK,  # last: of equal links the ground decides
        }[min(self.lengths)]

    @property
    def crank_room(self) -> float:
        """By how much, mm, the dyad clears both ends of the diagonal; 0 or more: the crank turns fully.

        The diagonal A-B0 runs from abs(f - a) to f + a, and the dyad of c and b spans abs(c - b) to c + b.
        """
        a, c, b, f = self.lengths
        far, near = b + c - a - f, abs(f - a) - abs(b - c)
        return min(far, near) if _single(self.lengths) else np.minimum(far, near)

    @property
    def lines_up(self) -> bool:
        """Whether all links line up in some position that the crank can reach from either side."""
        return abs(self.crank_room) <= CHANGE_POINT * sum(self.lengths)

    @property
    def rocks(self) -> bool:
        """Whether the crank cannot turn fully: it is a lever."""
        if _single(self.lengths):
            return self.crank_room < 0 and not self.lines_up
        back: bool = np.asarray(self.crank_room < 0) & ~np.asarray(self.lines_up)
        return back

    def limits(self) -> Limits | None:
        """Limit positions of the follower; None where it turns fully or the crank does not.

        cos φ = (f² + (c ± a)² - b²) / (2 f (c ± a)), crank and coupler in one line.
        """
        return self.folding() if self.kind is Kind.CRANK_ROCKER else None

    def folding(self) -> Limits:
        """The same of a crank-rocker, or of many at once."""
        a, c, b, f = self.lengths
        extended = self.branch * np.arccos((f * f + (c + a) ** 2 - b * b) / (2 * f * (c + a)))
        folded = math.pi + self.branch * np.arccos((f * f + (c - a) ** 2 - b * b) / (2 * f * (c - a)))
        # At the limits B is in line with the crank: at (c + a) and, folded, at (c - a) against the crank.
        far = (c + a) * np.exp(1j * extended) - f
        near = -(c - a) * np.exp(1j * folded) - f
        swing = abs(np.angle(far / near))
        between = (folded - extended) % math.tau
        longer = np.maximum(between, math.tau - between)
        figures = (
            extended % math.tau,
            folded % math.tau,
            swing,
            longer / np.minimum(between, math.tau - between),
        )
        return Limits(*(map(float, figures) if _single(self.lengths) else figures))

    def transmission_cosines(self) -> tuple[float, float]:
        """Cosines of the angle at B with the crank over the ground line, and against it."""
        a, c, b, f = self.lengths
        near = (b * b + c * c - (f - a) ** 2) / (2 * b * c)
        far = (b * b + c * c - (f + a) ** 2) / (2 * b * c)
        return near, far

    def cosine_over(self, square: float) -> float:
        """Cosine of the angle at B over a squared diagonal from A to B0, mm²."""
        return (self.follower**2 + self.coupler**2 - square) / (2 * self.follower * self.coupler)

    def least_transmission_angle(self) -> float:
        """Smallest transmission angle of a turn, rad; the crank must turn fully."""
        return self.transmission_range()[0]

    def greatest_transmission_angle(self) -> float:
        """Largest acute transmission angle of a turn, rad: a right angle where the turn goes through one."""
        return self.transmission_range()[1]

    def transmission_range(self, one: Any = 0.0, two: Any = math.tau) -> tuple[float, float]:
        """Smallest and largest acute transmission angle, rad, while the crank goes from one angle to another.

        Both are counted from the ground line; the angle at B changes one way between crank in line and
        crank against it.
        """
        a, f = self.crank, self.ground
        low, high = np.minimum(one, two), np.maximum(one, two)
        cosines = [np.asarray(self.cosine_over(a * a + f * f - 2 * a * f * np.cos(x))) for x in (low, high)]
        for off, square in ((0.0, (f - a) ** 2), (math.pi, (f + a) ** 2)):
            passed = np.ceil((low - off) / math.tau) <= np.floor((high - off) / math.tau)
            cosines.append(np.where(passed, self.cosine_over(square), cosines[0]))
        angles = [np.arccos(np.minimum(1.0, np.abs(value))) for value in cosines]
        square = reduce(np.minimum, cosines) * reduce(np.maximum, cosines) <= 0
        greatest = np.where(square, math.pi / 2, reduce(np.maximum, angles))
        return number(reduce(np.minimum, angles)), number(greatest)
