"""What an entry of the catalogue is: dimensions, and the linkage that they make."""

from abc import abstractmethod
from collections.abc import Mapping, Sequence
from math import radians
from typing import Annotated, Any, ClassVar

import numpy as np
from pydantic import Field

from mechwright import Parameters
from mechwright.mechanics.linkage.linkage import Linkage, Place
from mechwright.mechanics.planar.dynamics import GROUND
from mechwright.mechanics.planar.machine import Drive, Joint, Machine, Pose, Prismatic, Revolute
from mechwright.units import Degrees, Millimetres

Length = Annotated[Millimetres, Field(ge=0.5, le=5000)]
"""A distance of two joints."""

Coordinate = Annotated[Millimetres, Field(ge=-5000, le=5000)]
"""A coordinate of a joint in a link."""

Angle = Annotated[Degrees, Field(ge=-360, le=360)]
"""A direction, counter-clockwise."""

Points = Mapping[str, Mapping[str, Place]]
"""Link to its points by name."""


class Entry(Parameters):
    """A linkage that has a name; every dimension has a default, with which it runs.

    Frames: the ground has its first pivot at the origin. A link of two pins has the first one at its origin
    and the second one on its x axis. A pin of a link with three has coordinates in that frame.

    A number may be replaced by a column (n, 1) over n designs with ``model_copy(update=...)``; places, poses
    and the motion then have the same rows.
    """

    title: ClassVar[str]
    """A few words, as a heading."""
    source: ClassVar[str] = ""
    """Where its dimensions are from."""
    output: ClassVar[str]
    """The link whose motion it is for."""
    traces: ClassVar[Mapping[str, tuple[str, str]]] = {}
    """Name of a path to the link and the point that draws it."""
    straight: ClassVar[tuple[float, float] | None] = None
    """Angles of the driven link, degrees, between which its first path is meant to be straight."""
    walks: ClassVar[bool] = False
    """Whether its first path is that of a foot."""
    start: ClassVar[float] = 0.0
    """Angle of the driven link from X, degrees, at which the linkage is drawn; within its range."""
    swing: ClassVar[tuple[float, float] | None] = None
    """Angles of the driven link, degrees, between which it swings in a design that begins with it."""
    pin_links: ClassVar[Mapping[str, Sequence[str]]]
    """Pin to the links on it; the first is joined to each of the others."""
    signs: ClassVar[Mapping[str, int]] = {}
    """Inner joint of a dyad to its branch: see :class:`Machine`."""

    @abstractmethod
    def points(self) -> Points:
        """Give the points of every link in its own frame, x + i y, mm."""

    def slides(self) -> Sequence[Prismatic]:
        """Give the slides; none by default."""
        return ()

    def joints(self) -> Sequence[Joint]:
        """Give the pins, in the order of ``pin_links``, then the slides."""
        return [*pins(self.points(), **self.pin_links), *self.slides()]

    def branches(self) -> Mapping[str, Any]:
        """Give the branch of every dyad: see :class:`Machine`."""
        return self.signs

    def drawn(self) -> Mapping[str, Pose]:
        """Give the poses at ``start``, of linkages that are no chain of dyads."""
        return {}

    def drive(self) -> Drive:
        """Give the input."""
        return Drive("crank")

    def linkage(self, output: str = "") -> Linkage:
        """Give the linkage with these dimensions, for the motion of ``output``. Default: of its own.

        Raises
        ------
        KinematicsError
            A linkage that is no chain of dyads cannot be put together at ``start``.
        """
        machine = Machine(
            tuple(self.joints()), (self.drive(),), self.branches(), self.drawn(), (radians(self.start),)
        )
        return Linkage(machine, self.points(), output or self.output, self.traces, self.straight, self.walks)


def pins(points: Points, **links: Sequence[str]) -> list[Joint]:
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


def bar(first: str, second: str, length: Any) -> Mapping[str, Place]:
    """The points of a link of two pins.

    >>> bar("A", "B", 30.0)
    {'A': 0j, 'B': (30+0j)}
    """
    return {first: 0j, second: length + 0j}


def apex(base: Any, from_origin: Any, from_end: Any) -> Place:
    """The third corner of a triangle over a base from 0 to ``base`` on X, to the left of it, mm.

    Distances are those of the corner from both ends of the base, by the law of cosines; NaN where they do
    not reach.

    >>> apex(5.0, 3.0, 4.0)
    (1.8+2.4j)
    """
    x = (base**2 + from_origin**2 - from_end**2) / (2 * base)
    with np.errstate(invalid="ignore"):
        y = np.sqrt(np.asarray(from_origin**2 - x**2, float))
    corner = x + 1j * y
    return corner if np.ndim(corner) else complex(corner)


def reject_open_triangle(**lengths: float) -> None:
    """Refuse three lengths, by the names of their fields, that are no triangle; raises ValueError."""
    name, longest = max(lengths.items(), key=lambda one: one[1])
    others = [one for one in lengths if one != name]
    reach = sum(lengths[one] for one in others)
    if longest >= reach:
        raise ValueError(
            f"{name} = {longest:g} mm has to be less than {' + '.join(others)} = {reach:g} mm: "
            "the three are the sides of a triangle"
        )


__all__ = [
    "GROUND",
    "Angle",
    "Coordinate",
    "Entry",
    "Length",
    "Points",
    "Prismatic",
    "apex",
    "bar",
    "pins",
    "reject_open_triangle",
]
