"""A mechanism as a stage of a chain: what turns it, what it turns, and how.

Glossary
--------
port
    A shaft by which a stage is driven, or drives the next one.
angle of a port
    What the stage's own channels count: about +z where the sense of the port is +1, about -z where it is -1.
period
    Turns of the input after which a stage stands and moves as before.
advance
    Turns of the output over a period, in the sense of its port; 0 for one that comes back.
"""

import math
from abc import ABC, abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.turning import Turning
from mechwright.geometry.segments import Point

if TYPE_CHECKING:
    from mechwright.contracts.finding import Change
    from mechwright.contracts.motion import Motion
    from mechwright.contracts.mounting import Mounting


@dataclass(frozen=True, slots=True)
class Port:
    """A shaft of a stage.

    Parameters
    ----------
    body
        Of the motion; it turns about its own origin.
    point
        Where the axis stands in the stage's coordinates, mm.
    sense
        +1 where the port's angle is counted about +z, -1 about -z.
    """

    body: str
    point: Point
    sense: int = 1


@dataclass(frozen=True, slots=True)
class Index:
    """A move of the output from rest to rest.

    Parameters
    ----------
    begin, end
        Angles of the input within the first period, rad.
    way
        How far the output goes, rad.
    """

    begin: float
    end: float
    way: float


class Transmission(ABC):
    """A stage: the motion of its output, and of all its bodies, for any motion of its input.

    Everything is in closed form at the angles that are asked for; nothing is interpolated.
    """

    input: Port
    output: Port | None = None
    """None where the last thing that moves is no shaft: then nothing can stand behind this stage."""
    period: Fraction = Fraction(1)
    advance: Fraction = Fraction(0)
    speed: float = 0.0
    """Of the input where nothing stands before it, rad/s, signed as the port's angle."""
    start: float = 0.0
    """Angle of the input, rad, at which its own motion begins."""
    own_drive: ClassVar[tuple[str, ...]] = ()
    """Fields of the table that say how the input turns by itself: none of them belongs to a stage that
    another one drives; the first of them is its speed."""
    turns_on: ClassVar[bool] = False
    """Whether its input has to turn on all the way: what swings there and back would undo what it does."""
    travel: "tuple[float, float] | None" = None
    """Angles of the input, rad, between which it swings; None where it may turn all the way."""
    travel_field: ClassVar[str] = ""
    """Field of the table that is the width of the travel, degrees."""
    whole: "Sequence[Change]" = ()
    """Changes of the table with which a stage that swings turns all the way."""
    mounting: "Mounting | None" = None
    """Where its shafts stand in a chain; None where that is the family's own mounting for a frame."""
    load_field: ClassVar[str] = ""
    """Field of the table that is the torque against the output, N·m; empty where there is none."""

    @abstractmethod
    def move(self, drive: Turning) -> Turning:
        """The output for a motion of the input, both by the angles of their ports: angle and three rates.

        Raises KinematicsError where there is no output, or the input cannot stand at an angle.
        """

    @abstractmethod
    def motion(self, drive: Turning, time: Array) -> "Motion":
        """All that the stage's motion has, at samples of the input (n,) and their times, s.

        Poses are in the stage's coordinates. Raises KinematicsError where the input cannot stand at an angle.
        """

    def power(self, drive: Turning, motion: "Motion") -> Array:  # noqa: ARG002 - used by those with loads
        """What the stage's own loads take from its input (n,), W; nothing by default."""
        return np.zeros_like(drive.theta)

    def driven_fields(self, drive: Turning) -> dict[str, float]:
        """Fields of its own drive that ask as much of its parts as a motion (n,) of the input does.

        By default the first of them is the greatest speed, rev/min.
        """
        most = float(np.abs(drive.omega).max()) * 60 / math.tau
        return {self.own_drive[0]: most} if self.own_drive else {}

    def at(self, angle: Array) -> tuple[Array, Turning]:
        """Times (n,), s, from its start on, and the input at angles (n,) where nothing stands before it.

        By default it turns at constant speed. Raises DesignError where its own law repeats no turn.
        """
        return (angle - self.start) / self.speed, Turning.of(angle, self.speed)

    def indexes(self) -> Sequence[Index]:
        """Moves of the output from rest to rest within a period; none by default."""
        return ()
