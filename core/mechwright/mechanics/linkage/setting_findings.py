"""What there is to say of a linkage whose pivots are set from phase to phase in a pose of setting."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from mechwright.contracts.finding import Finding, Severity, Stage
from mechwright.errors import KinematicsError
from mechwright.mechanics.linkage.slots import Gap, Setting, gaps, point_gaps

STILL = 1e-9
"""Degrees by which a link is turned no more than rounding turns it."""


@dataclass(frozen=True)
class Turned:
    """A link that is turned to a pivot's next place.

    Parameters
    ----------
    joint, link
        Names of the pivot that is set and of the link that carries it there.
    angle
        Of the link in the pose of setting, phase 1, degrees.
    radius
        From its axis to the pivot, mm.
    slotted
        Whether the pivot is clamped in a slot.
    """

    joint: str
    link: str
    angle: float
    radius: float
    slotted: bool

    def step(self, turn: float) -> str:
        """What is done to set it, by ``turn`` degrees from phase 1."""
        name = self.joint
        opened = f"loosen the clamp of {name}" if self.slotted else f"take {name} out of its hole"
        to = math.remainder(self.angle + turn, 360.0)
        return f"{opened}, turn the {self.link} by {turn:+.6g} degrees to {to:.6g} and fasten {name}"

    def chord(self, turn: float) -> str:
        """How far the place is from that of phase 1."""
        return f"{2 * self.radius * abs(math.sin(math.radians(turn) / 2)):.4g} mm ({self.joint})"


def setting_order(
    code: str,
    pose: Callable[[], Sequence[Turned]],
    crank: float | None,
    turns: Sequence[Sequence[float]],
    steps: Callable[[list[str]], Sequence[str]],
    *,
    table: str = "",
    hold: str = "pin the coupler to the ground",
) -> Iterator[Finding]:
    """Whether a machine can be set, and in which order, phase by phase.

    Parameters
    ----------
    pose
        What is turned, in that order; raises KinematicsError where the links cannot be joined in the pose.
    crank
        Angle of the crank in the pose, degrees, for a finding.
    turns
        For each further phase how far each of them is turned from phase 1, degrees.
    steps
        All steps of a phase from those that set its pivots, after the first.
    table
        What stands before the parameters' names.
    hold
        What is done with the coupler first.
    """
    if not turns:
        return
    try:
        links = pose()
    except KinematicsError as error:
        said, _, remedy = str(error).partition("; ")
        yield Finding.error(
            code, f"{table}setting_angle", said.partition(": ")[2], crank, unit="deg", remedy=remedy
        )
        return
    first = f"turn the crank to {links[0].angle:.6g} degrees in phase 1 and {hold}"
    for number, row in enumerate(turns, start=2):
        if max(map(abs, row)) < STILL:
            continue  # the pivots are those of phase 1, and nothing is set
        pairs = list(zip(links, row, strict=True))
        whole = [first, *steps([one.step(turn) for one, turn in pairs])]
        apart = " and ".join(one.chord(turn) for one, turn in pairs)
        yield Finding(
            code,
            Severity.NOTE,
            f"{table}phases",
            f"phase {number}: "
            + "; ".join(f"{step}. {what}" for step, what in enumerate(whole, start=1))
            + f". The places are {apart} from those of phase 1",
            stage=Stage.PARTS,
        )


@dataclass(frozen=True)
class Places:
    """What two pivots that are set, and a point, need of a coupler; ``bore`` and ``pin`` in mm."""

    ways: tuple[Setting, Setting]
    point: complex | None
    bore: float
    pin: float

    @property
    def slotted(self) -> bool:
        """Whether any of them is set in a slot."""
        return any(one.slot is not None for one in self.ways)

    @cached_property
    def to_point(self) -> list[Gap]:
        """From openings to the point."""
        if self.point is None:
            return []
        return [gap for one in self.ways for gap in point_gaps(one, self.point, self.bore, self.pin)]

    @cached_property
    def nearest(self) -> Gap:
        """The gap that leaves least between two openings."""
        return min([*gaps(*self.ways, self.bore), *self.to_point], key=lambda gap: gap.land)
