"""Screws, washers, and the holes for them: ISO 4762, 10642, 4026, 7089, 273, DIN 974-1, ISO 2306."""

import math
from dataclasses import dataclass
from functools import cache
from typing import Literal

from mechwright.contracts.bought import Bought
from mechwright.contracts.materials import entry, material
from mechwright.contracts.shape import Revolve, Shape, hexagon, ring
from mechwright.contracts.threads import COARSE
from mechwright.errors import DesignError
from mechwright.geometry.segments import Point
from mechwright.standards.table import table

Head = Literal["cap", "countersunk", "set"]
Clearance = Literal["fine", "medium", "coarse"]

LENGTHS = (5, 6, 8, 10, 12, 16, 20, 25, 30, 35, 40, 45, 50)
"""In which screws are kept, mm."""

GRADE = "8.8"
"""Strength class of cap and countersunk screws."""

SET_GRADE = "45H"
"""Hardness class of set screws."""

ENGAGEMENT = {
    "steel": 1.0, "brass": 1.3, "aluminium": 1.5, "5754": 2.0, "5083": 2.0, "pom": 2.5, "polycarbonate": 2.5,
    "acrylic": 2.5, "hdpe": 3.0, "plywood": 4.0, "mdf": 5.0,
}  # fmt: skip
"""Least length of thread in a material, in diameters; handbook, unchecked. Soft ones want an insert."""


def least_engaged(name: str) -> float:
    """Least length of thread in a material, in diameters.

    >>> least_engaged("7075"), least_engaged("5754")
    (1.5, 2.0)
    """
    found = entry(ENGAGEMENT, name)
    assert found is not None  # noqa: S101 - every group has one
    return found


@dataclass(frozen=True)
class ScrewSize:
    """What belongs to one thread, mm; 0 and () where the table has nothing. See the table's own words."""

    size: float
    head: float
    head_height: float
    hexagon: float
    socket: float
    lengths: tuple[float, ...]
    sunk_head: float
    sunk_hexagon: float
    sunk_socket: float
    set_hexagon: float
    set_socket: float
    washer: tuple[float, ...]
    fine: float
    medium: float
    coarse: float
    counterbore: float

    @property
    def pitch(self) -> float:
        """Of the coarse thread, mm (ISO 261)."""
        return COARSE[self.size]

    @property
    def tap_drill(self) -> float:
        """Diameter of the drill before tapping, mm: size less pitch, to a tenth (ISO 2306)."""
        return round(self.size - self.pitch, 1)

    @property
    def counterbore_depth(self) -> float:
        """Of a cap screw's head, mm, so that it lies below the face (DIN 974-1)."""
        return round(self.head_height + (0.4 if self.size <= 6 else 0.6), 6)

    @property
    def countersink(self) -> float:
        """Diameter of the 90° countersink, mm: the theoretical head and 0.2."""
        return round(self.sunk_head + 0.2, 6)

    def clearance(self, series: Clearance = "medium") -> float:
        """Diameter of the clearance hole, mm (ISO 273)."""
        return {"fine": self.fine, "medium": self.medium, "coarse": self.coarse}[series]


@dataclass(frozen=True)
class Screw:
    """A screw with a hexagon socket, mm. Its length lies below z = 0, of a cap screw that under its head."""

    head: Head
    of: ScrewSize
    length: float

    @property
    def standard(self) -> str:
        """Its number."""
        return {"cap": "ISO 4762", "countersunk": "ISO 10642", "set": "ISO 4026"}[self.head]

    @property
    def key(self) -> float:
        """Width of the hexagon across flats, mm."""
        of = self.of
        return {"cap": of.hexagon, "countersunk": of.sunk_hexagon, "set": of.set_hexagon}[self.head]

    @property
    def bought(self) -> Bought:
        """How it is ordered; its shank has the nominal diameter, so that it is seen where it meets a wall."""
        of, r, grade = self.of, self.of.size / 2, SET_GRADE if self.head == "set" else GRADE
        above: tuple[Point, ...]
        if self.head == "cap":
            top, deep, big = of.head_height, of.socket, of.head / 2
            above = ((r, 0.0), (big, 0.0), (big, top), (0.0, top))
        elif self.head == "countersunk":
            top, deep, big = 0.0, of.sunk_socket, of.sunk_head / 2
            above = ((r, r - big), (big, 0.0), (0.0, 0.0))
        else:
            top, deep = 0.0, of.set_socket
            above = ((r, 0.0), (0.0, 0.0))
        profile = ((0.0, -self.length), (r, -self.length), *above)
        shape = Shape((Revolve(profile),), (hexagon(self.key, top - deep, top),))
        return Bought(
            f"{self.standard} - M{of.size:g} x {self.length:g} - {grade}", self.standard, None, shape
        )


@dataclass(frozen=True)
class Washer:
    """A plain washer, mm."""

    of: ScrewSize

    @property
    def height(self) -> float:
        """Thickness."""
        return self.of.washer[2]

    @property
    def bought(self) -> Bought:
        """How it is ordered; it lies on z = 0."""
        inside, outside, height = self.of.washer
        return Bought(
            f"ISO 7089 - {self.of.size:g} - 200 HV", "ISO 7089", None, Shape((ring(inside, outside, height),))
        )


def needs_washer(size: float, hole: float, plate: str = "") -> bool:
    """Whether the head of a screw M ``size`` lies on a washer: over a coarse hole, mm, and on soft plates.

    Without a material the hole alone decides.

    >>> needs_washer(5, 5.5, "aluminium"), needs_washer(5, 6.0, "aluminium"), needs_washer(5, 5.5, "pom")
    (False, True, True)
    """
    return bool(plate and material(plate).soft) or hole >= screw_size(size).clearance("coarse")


FRAME = 5.0
"""Thread of a frame's screws, mm."""

DEEP = 12.0
"""Through thicker plates, mm, mills of the size of a clearance hole do not reach: a wider one is drilled."""


def through_hole(size: float, thickness: float) -> float:
    """Diameter of a screw's hole through a plate, mm: the medium one, or the next whole one for a drill.

    >>> through_hole(5, 8), through_hole(5, 20)
    (5.5, 6.0)
    """
    clear = screw_size(size).clearance()
    return clear if thickness <= DEEP else float(math.ceil(clear))


@cache
def screw_sizes() -> tuple[ScrewSize, ...]:
    """All of them, by thread."""
    return table("screws").of(ScrewSize)


def screw_size(size: float) -> ScrewSize:
    """What belongs to a thread M ``size``; raises DesignError that lists the sizes.

    >>> screw_size(4).tap_drill, screw_size(4).clearance()
    (3.3, 4.5)
    """
    for one in screw_sizes():
        if one.size == size:
            return one
    raise DesignError(f"no screws M{size:g}; one of: {', '.join(f'M{s.size:g}' for s in screw_sizes())}")


def lengths(size: float, head: Head = "cap") -> list[int]:
    """In which a screw is kept, mm; none where the table does not have its head."""
    of = screw_size(size)
    sized = {"cap": of.head, "countersunk": of.sunk_head, "set": of.set_hexagon}[head]
    if not sized:
        return []
    least = {"cap": of.lengths[0], "countersunk": (of.sunk_head - size) / 2 + of.pitch}.get(
        head, of.set_socket + of.pitch
    )
    return [one for one in LENGTHS if least <= one <= of.lengths[1]]


def screw(size: float, length: float, head: Head = "cap") -> Screw:
    """The shortest screw that is at least ``length`` long, mm.

    Raises DesignError for a size that the table does not have, and for a length above its longest.

    >>> screw(4, 11).bought.designation
    'ISO 4762 - M4 x 12 - 8.8'
    """
    kept = lengths(size, head)
    if not kept:
        having = [f"M{s.size:g}" for s in screw_sizes() if lengths(s.size, head)]
        raise DesignError(f"no {head} screws M{size:g}; one of: {', '.join(having)}")
    fitting = [one for one in kept if one >= length]
    if not fitting:
        raise DesignError(
            f"the longest {head} screw M{size:g} is {kept[-1]} mm long; {length:g} mm are needed"
        )
    return Screw(head, screw_size(size), fitting[0])


def washer(size: float) -> Washer:
    """The washer of a screw; raises DesignError for a size that the table does not have."""
    of = screw_size(size)
    if not of.washer:
        having = [f"M{s.size:g}" for s in screw_sizes() if s.washer]
        raise DesignError(f"no washer for M{size:g}; one of: {', '.join(having)}")
    return Washer(of)
