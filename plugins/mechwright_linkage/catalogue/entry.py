"""What an entry of the catalogue is: dimensions, and the linkage that they make."""

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, ClassVar

from pydantic import Field

from mechwright import Parameters
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.machine import Drive, Joint, Machine, Pose, Prismatic, Revolute
from mechwright.units import Degrees, Millimetres
from mechwright_linkage.linkage import Linkage, Place

Length = Annotated[Millimetres, Field(ge=0.5, le=5000)]
"""A distance of two joints."""

Coordinate = Annotated[Millimetres, Field(ge=-5000, le=5000)]
"""A coordinate of a joint in a link."""

Angle = Annotated[Degrees, Field(ge=-360, le=360)]
"""A direction, counter-clockwise."""


class Entry(Parameters):
    """A linkage that has a name; every dimension has a default, with which it runs."""

    title: ClassVar[str]
    """A few words, as a heading."""
    source: ClassVar[str] = ""
    """Where its dimensions are from."""
    output: ClassVar[str]
    """The link whose motion it is for."""
    traces: ClassVar[Mapping[str, tuple[str, str]]] = {}
    """Name of a path to the link and the point that draws it."""
    start: ClassVar[float] = 0.0
    """Angle of the driven link from X, degrees, at which the linkage is drawn; within its range."""

    @abstractmethod
    def points(self) -> Mapping[str, Mapping[str, Place]]:
        """Link to its points by name, in the frame of the link, mm."""

    @abstractmethod
    def joints(self) -> Sequence[Joint]:
        """Pins and slides."""

    def branches(self) -> Mapping[str, Any]:
        """How dyads are put together: see :class:`Machine`."""
        return {}

    def drawn(self) -> Mapping[str, Pose]:
        """Poses at ``start``, of linkages that are no chain of dyads."""
        return {}

    def drive(self) -> Drive:
        """The input."""
        return Drive("crank")

    def linkage(self) -> Linkage:
        """The linkage with these dimensions."""
        from math import radians

        machine = Machine(
            tuple(self.joints()), (self.drive(),), self.branches(), self.drawn(), (radians(self.start),)
        )
        return Linkage(machine, self.points(), self.output, self.traces)


def pins(points: Mapping[str, Mapping[str, Place]], **links: Sequence[str]) -> list[Joint]:
    """Pins by the name of their point and the links on it, in this order: the first with each of the others.

    >>> one, two = pins({"ground": {"A": 0j}, "a": {"A": 1j}, "b": {"A": 2j}}, A=("ground", "a", "b"))
    >>> one.name, one.links, two.name, two.links
    ('A', ('ground', 'a'), 'A-2', ('ground', 'b'))
    """
    found: list[Joint] = []
    for point, (first, *others) in links.items():
        for number, other in enumerate(others, start=1):
            name = point if number == 1 else f"{point}-{number}"
            found.append(Revolute(name, first, other, points[first][point], points[other][point]))
    return found


__all__ = ["GROUND", "Angle", "Coordinate", "Entry", "Length", "Prismatic", "pins"]
