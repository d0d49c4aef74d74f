"""What a program is made of, independent of the control: contours in order.

Glossary
--------
stroke
    A path that is cut without a stop of the beam.
role
    What a contour does: mark the surface, open an inside, cut an edge that two parts share, or free an
    outside.
"""

from dataclasses import dataclass
from typing import Literal

from mechwright.geometry.segments import Point
from mechwright_plane.path import Path

Role = Literal["engrave", "inside", "common", "outside"]
WORKING = frozenset({"flank", "slot", "lobe", "dwell", "cam", "side"})
"""Names of segments on which the mark of a lead would be felt."""


@dataclass(frozen=True)
class Contour:
    """One contour.

    Parameters
    ----------
    name
        What it is, for comments and messages.
    role
        What it does.
    strokes
        Cut one after the other; between two of them the beam is off over a micro-joint or a common line.
    opened
        Whether each stroke begins in a cut that is there, so that nothing is pierced.
    """

    name: str
    role: Role
    strokes: tuple[Path, ...]
    opened: bool = False

    @property
    def start(self) -> Point:
        """Where the beam goes on first."""
        return self.strokes[0].start

    @property
    def pierces(self) -> int:
        """How often the beam goes through the sheet."""
        return 0 if self.opened or self.role == "engrave" else len(self.strokes)

    @property
    def length(self) -> float:
        """Way of the beam that is on, mm."""
        return sum(stroke.length for stroke in self.strokes)


@dataclass(frozen=True)
class WirePass:
    """One pass of a wire along the net contour.

    ``side`` is 41 with the wire on the left of the way, 42 on its right; ``register`` numbers its D. ``path``
    starts where the offset is put on, and ends where it is taken off.
    """

    side: int
    register: int
    path: Path


@dataclass(frozen=True)
class WireContour:
    """One contour of a wire: threaded at ``hole``, run in ``passes``, cut off by the ``last`` one."""

    name: str
    role: Role
    hole: Point
    passes: tuple[WirePass, ...]
    """Around all but the tab."""
    last: WirePass
    """The tab, by which the slug or the part falls."""

    @property
    def start(self) -> Point:
        """The start hole."""
        return self.hole

    @property
    def strokes(self) -> tuple[Path, ...]:
        """Ways of all passes, and along the tab."""
        return (*(one.path for one in self.passes), self.last.path)

    @property
    def length(self) -> float:
        """Way of the wire, mm."""
        return sum(stroke.length for stroke in self.strokes)
