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
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

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
        shortest, *middle, longest = sorted(self.lengths)
        return sum(middle) - shortest - longest

    @property
    def closes(self) -> bool:
        """Whether the links can be assembled in some position: none is longer than the others together."""
        return 2 * max(self.lengths) <= sum(self.lengths)

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
        return min(b + c - a - f, abs(f - a) - abs(b - c))

    @property
    def lines_up(self) -> bool:
        """Whether all links line up in some position that the crank can reach from either side."""
        return abs(self.crank_room) <= CHANGE_POINT * sum(self.lengths)

    @property
    def rocks(self) -> bool:
        """Whether the crank cannot turn fully: it is a lever."""
        return self.crank_room < 0 and not self.lines_up

    def limits(self) -> Limits | None:
        """Limit positions of the follower; None where it turns fully or the crank does not.

        cos φ = (f² + (c ± a)² - b²) / (2 f (c ± a)), crank and coupler in one line.
        """
        if self.kind is not Kind.CRANK_ROCKER:
            return None
        a, c, b, f = self.lengths
        extended = self.branch * math.acos((f * f + (c + a) ** 2 - b * b) / (2 * f * (c + a)))
        folded = math.pi + self.branch * math.acos((f * f + (c - a) ** 2 - b * b) / (2 * f * (c - a)))
        # At the limits B is in line with the crank: at (c + a) and, folded, at (c - a) against the crank.
        far = (c + a) * np.exp(1j * extended) - f
        near = -(c - a) * np.exp(1j * folded) - f
        swing = abs(float(np.angle(far / near)))
        between = (folded - extended) % math.tau
        return Limits(
            extended % math.tau,
            folded % math.tau,
            swing,
            max(between, math.tau - between) / min(between, math.tau - between),
        )

    def transmission_cosines(self) -> tuple[float, float]:
        """Cosines of the angle at B with the crank over the ground line, and against it."""
        a, c, b, f = self.lengths
        near = (b * b + c * c - (f - a) ** 2) / (2 * b * c)
        far = (b * b + c * c - (f + a) ** 2) / (2 * b * c)
        return near, far

    def least_transmission_angle(self) -> float:
        """Smallest transmission angle of a turn, rad; the crank must turn fully."""
        return self.transmission_range()[0]

    def greatest_transmission_angle(self) -> float:
        """Largest acute transmission angle of a turn, rad: a right angle where the turn goes through one."""
        return self.transmission_range()[1]

    def transmission_range(self, one: float = 0.0, two: float = math.tau) -> tuple[float, float]:
        """Smallest and largest acute transmission angle, rad, while the crank goes from one angle to another.

        Both are counted from the ground line; the angle at B changes one way between crank in line and
        crank against it.
        """
        a, c, b, f = self.lengths
        low, high = min(one, two), max(one, two)
        through = range(math.ceil(low / math.pi), math.floor(high / math.pi) + 1)
        squares = [a * a + f * f - 2 * a * f * math.cos(x) for x in (low, high)]
        squares += [(f + (a if k % 2 else -a)) ** 2 for k in through]
        cosines = [(b * b + c * c - square) / (2 * b * c) for square in squares]
        angles = [math.acos(min(1.0, abs(cosine))) for cosine in cosines]
        return min(angles), math.pi / 2 if min(cosines) * max(cosines) <= 0 else max(angles)
