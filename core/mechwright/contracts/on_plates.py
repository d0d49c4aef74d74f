"""What stands on the bearing plates of a frame besides shafts: pins, and linear guides.

Glossary
--------
post
    An upright pin of the mechanism in a bearing plate.
slideway
    A linear guide on the lower bearing plate, which carries a body that slides.
"""

import math
from dataclasses import dataclass

from mechwright.contracts.bought import Bought
from mechwright.contracts.turned import Step
from mechwright.geometry.segments import Point


@dataclass(frozen=True)
class Post:
    """An upright pin of the mechanism that stands in a bearing plate, as of a spring.

    Parameters
    ----------
    name
        Of its part.
    point
        Where it stands in the ground, mm.
    diameter
        Of its shank, mm, from the plate to ``low``.
    low, head
        Height, mm, at which its other end begins, and the steps of that.
    holds
        Bodies of the motion that go around that end.
    key
        The design-file key without which there is no such pin.
    hangs
        Whether it hangs from the upper plate, else it stands in the lower one.
    note
        A sentence for whoever puts it in; empty for none.
    """

    name: str
    point: Point
    diameter: float
    low: float
    head: tuple[Step, ...]
    holds: frozenset[str] = frozenset()
    key: str = ""
    hangs: bool = False
    note: str = ""

    @property
    def tip(self) -> float:
        """Height of its free end, mm."""
        length = sum(step.length for step in self.head)
        return self.low - length if self.hangs else self.low + length


@dataclass(frozen=True)
class GuideSize:
    """A rail of some length with its carriage, both drawn along x with the rail's base at z = 0.

    Parameters
    ----------
    name
        Of the guide, as a design file has it.
    rail, carriage
        How they are ordered. The origin of the rail is the middle of its first end, that of the carriage its
        own middle.
    length, width
        Of the rail, and of the carriage, which is the wider one, mm.
    high
        Height of the carriage's upper face, mm.
    holes, seat
        Places of the rail's holes along it, and the height on which the heads of its screws lie, mm.
    carriage_holes
        Places of the carriage's threads, mm.
    thread, depth
        Of all screws, and of the carriage's threads, mm.
    """

    name: str
    rail: Bought
    carriage: Bought
    length: float
    width: float
    high: float
    holes: tuple[float, ...]
    seat: float
    carriage_holes: tuple[Point, ...]
    thread: float
    depth: float


@dataclass(frozen=True)
class Slideway:
    """A linear guide whose rail lies on the lower bearing plate, and whose carriage carries a body.

    Parameters
    ----------
    guide
        What lies there.
    body
        Of the motion, on the carriage; it does not turn.
    start, angle
        Middle of the rail's first end, mm, and the direction of the way, rad.
    low
        Height of the rail's base, mm: the carriage's upper face carries the body.
    carriage
        Middle of the carriage in the body's coordinates, mm.
    grip
        Thickness of what the screws of the carriage go through, mm.
    key
        The design-file key of the guide.
    """

    guide: GuideSize
    body: str
    start: Point
    angle: float
    low: float
    carriage: Point
    grip: float
    key: str

    def at(self, along: float, across: float = 0.0) -> Point:
        """A place of the rail in the ground, mm."""
        c, s = math.cos(self.angle), math.sin(self.angle)
        return self.start[0] + c * along - s * across, self.start[1] + s * along + c * across
