"""Pillars between plates, and the screws that hold them.

Two pillars at opposite corners have spigots that go into registers of both plates, as the pillars of a clock
do: they fix how the plates stand to each other, in place of dowels, which cannot reach from plate to plate.
The other two are plain. All are turned to one height in one setting.
"""

import math
from dataclasses import dataclass

from mechwright.contracts.fits import shaft_fit
from mechwright.contracts.surroundings import OVER, Place
from mechwright.contracts.turned import TAP_RUN, EndThread, Flats, Length, Step, Turned
from mechwright.errors import DesignError
from mechwright.geometry.segments import Point
from mechwright.machine.frame.kit import Kit
from mechwright.machine.frame.plates import Hole
from mechwright.standards.screws import FRAME, Screw, lengths, screw, screw_size

SCREW = FRAME
"""Thread of pillars and legs, mm."""

PILLAR, SPIGOT = 12.0, 8.0
"""Diameter of pillars: at least twice the thread; of their spigots, mm."""

REGISTER = 4.0
"""Depth of the recess that a spigot goes into, mm."""

SHORT = 0.2
"""By how much a spigot is shorter than its recess is deep, mm: the pillar's shoulder bears."""

SPARE = 0.5
"""By how much the thread of a bought part is deeper than a screw goes into it, mm."""

RUN_ON = 2.0
"""So many pitches a thread that we cut goes on beyond its screw, at least: a screw is ±0.35 mm long, a plate
±0.2 mm thick, and the screw must not meet the bottom before it clamps."""

FLATS = 10.0
"""Across the flats of pillars and legs, mm: an open spanner holds them."""

FLATS_LENGTH = 6.0
"""Of these flats, mm: as wide as a spanner of that size is thick, and some air."""

EDGE = 9.0
"""From a pillar's axis to the plate's edge, mm: one and a half pillars' radii, and as much as 1.5 threads."""

NOTE = "all pillars to one length in one setting"

HEIGHT = 0.02
"""Limit deviations of the height of a pillar between its shoulders, plus and minus, mm."""

BETWEEN = "height of the pillars"
"""Name of that length."""

PITCH = screw_size(SCREW).pitch


def cap_screw(grip: float) -> Screw:
    """The shortest screw that goes a diameter beyond its grip, mm: what steel needs of a thread."""
    return screw(SCREW, grip + SCREW)


def thread_depth(*reaches: float) -> float:
    """Of the threads in both ends of a bar whose screws go so deep, mm: one depth, in halves of a millimetre.

    >>> thread_depth(6.0), thread_depth(5.9, 6.5)
    (8.0, 8.5)
    """
    return math.ceil(round(2 * (max(reaches) + RUN_ON * PITCH), 6)) / 2


def least_bar(*reaches: float) -> float:
    """Length of a bar with screws so deep in both ends, mm."""
    return 2 * (thread_depth(*reaches) + TAP_RUN * PITCH) + 1.0


def end_threads(*reaches: float) -> tuple[EndThread, EndThread]:
    """The threads of both ends, alike: nobody has to tell them apart."""
    deep = thread_depth(*reaches)
    return EndThread("lower", SCREW, PITCH, deep), EndThread("upper", SCREW, PITCH, deep)


def spanner_flats(length: float) -> tuple[Flats, ...]:
    """In the middle of a bar of a length, mm."""
    return (Flats((length - FLATS_LENGTH) / 2, FLATS_LENGTH, FLATS),)


def least_height(thickness: float) -> float:
    """Of a pillar with a screw in each end, mm."""
    return least_bar(cap_screw(thickness).length - thickness + SPARE)


def stud(grip: float, room: float) -> Screw:
    """The set screw that joins a leg and a pillar through a plate; at most ``room`` deep in each, mm.

    Raises DesignError where none is long enough and short enough.
    """
    fitting = [one for one in lengths(SCREW, "set") if grip + 2 * SCREW <= one <= grip + 2 * room]
    if not fitting:
        raise DesignError(
            f"no set screw M{SCREW:g} joins pillars through a plate of {grip:g} mm, {room:g} mm deep in each"
        )
    return screw(SCREW, fitting[-1], "set")


def register(name: str, point: Point, thickness: float, *, spigot: bool) -> Hole:
    """The hole of a pillar in a bearing plate."""
    clear = screw_size(SCREW).clearance()
    if not spigot:
        return Hole.through(name, point, clear, thickness)
    return Hole(name, point, ((SPIGOT, 0.0, REGISTER), (clear, 0.0, thickness)), fit="H7")


@dataclass(frozen=True)
class Column:
    """The pillar in one corner: its body, which stands on the height 0, and whether it has spigots."""

    name: str
    point: Point
    spigot: bool

    def place(self, kit: Kit) -> None:
        """Its body, and the same turned over for screws from below."""
        kit.places[self.name] = Place((*self.point, 0.0))
        kit.places[f"{self.name}-below"] = Place((*self.point, 0.0), OVER)


def columns(corners: tuple[Point, ...]) -> list[Column]:
    """One in each corner; the first and the third have spigots."""
    return [Column(f"column-{k}", point, k % 2 == 1) for k, point in enumerate(corners, start=1)]


def pillar(height: float, lower: float, upper: float, *, spigot: bool) -> Turned:
    """A pillar of a height whose screws go so deep into its ends, mm."""
    more = REGISTER - SHORT if spigot else 0.0
    ends: list[Step] = [Step(SPIGOT, more, shaft_fit(SPIGOT, "h6"))] if spigot else []
    between = Length(BETWEEN, more, more + height, -HEIGHT, HEIGHT)
    return Turned(
        (*ends, Step(PILLAR, height), *ends),
        note=NOTE,
        threads=end_threads(more + lower, more + upper),
        lengths=(between,),
        flats=spanner_flats(2 * more + height),
    )


def put_screw(kit: Kit, what: Screw, body: str, z: float) -> None:
    """A screw whose bearing face, or upper end, is at the height z of a body, mm."""
    head = {"cap": "screw", "set": "stud", "countersunk": "screw-sunk"}[what.head]
    kit.bought(f"{head}-m{what.of.size:g}x{what.length:g}".replace(".", "_"), what.bought, body, z)
