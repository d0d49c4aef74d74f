"""The shaft of a spindle from the stack of what it carries, with key and circlip.

From below: the stub for the drive, the seat of the lower bearing, a shoulder against its inner ring, the
collar that the hub stands on, the hub's seat, the circlip's groove, a shoulder against the upper bearing's
inner ring, and its seat. The shaft floats between the shoulders of both plates: shim rings behind the upper
bearing take up what the tolerances leave beyond the play that is meant. Shim rings under the circlip do the
same for the hub.
"""

from dataclasses import dataclass

from mechwright.contracts.fits import shaft_fit
from mechwright.contracts.general_tolerances import general_length
from mechwright.contracts.mounting import Hub
from mechwright.contracts.surroundings import Place, turned
from mechwright.contracts.turned import Groove, KeySeat, Length, Step, Turned
from mechwright.geometry.keyway import key_of_width
from mechwright.machine.frame.kit import Kit
from mechwright.machine.frame.located import (
    FREE,
    RETAINER,
    WALL,
    drawn_ring,
    overhang,
    proud,
    with_bearing_circlips,
)
from mechwright.machine.frame.seats import Seat
from mechwright.machine.frame.shim_rings import add_shim
from mechwright.standards.keys import LENGTHS, RANGES, Key
from mechwright.standards.shims import Shim, shim_behind, shim_on

PLAY = 0.15
"""Nominal play of a shaft between its bearings with their shim ring, mm: tolerances take half of it."""

RING = 0.2
"""Thickness of the shim ring behind the upper bearing for which a frame is drawn, mm."""

SHOULDERS = (-0.05, 0.0)
"""Limit deviations of the length between the shoulders, mm."""

COLLAR_EDGE, LOADED_WALL = "shoulder to shoulder", "collar to the loaded wall of the groove"
"""Names of these lengths."""

RELIEF = 1.0
"""Length of a shoulder that touches an inner ring alone, mm."""

COLLAR = 4.0
"""By how much the collar is larger than the hub's bore, mm: a step of 2 mm all round, more than 1.5."""

LEAST_COLLAR = 1.5
"""Length of the collar, mm."""

SHORT = 0.3
"""By how much the hub's seat is shorter than the hub, mm: the circlip holds the hub, not the step."""

BREAK = 0.5
"""Chamfer of both ends, mm."""


@dataclass(frozen=True)
class Levels:
    """Inner faces of both bearing plates, mm."""

    lower: float
    upper: float

    @property
    def height(self) -> float:
        """Between them."""
        return self.upper - self.lower


@dataclass(frozen=True)
class AxialLocation:
    """Where a shaft is held along its axis, mm.

    Parameters
    ----------
    lower, upper
        Heights of the undersides of both bearings.
    shoulders
        Heights of both shoulders of the shaft.
    ends
        By how much the shaft goes on below its lower bearing and above its upper one for circlips.
    """

    lower: float
    upper: float
    shoulders: tuple[float, float]
    ends: tuple[float, float] = (0.0, 0.0)

    @classmethod
    def of(cls, seat: Seat, levels: Levels) -> "AxialLocation":
        """By the arrangement of the bearings of a seat."""
        bearing = seat.bearing
        if not seat.located:
            upper = levels.upper - ring_room(seat)
            return cls(levels.lower - bearing.width, upper, (levels.lower, upper - PLAY))
        low, upper = levels.lower + proud(bearing), levels.upper + FREE
        ends = (overhang(bearing, drawn_ring(bearing)), overhang(bearing, 0.0))
        return cls(low - bearing.width, upper, (low, upper), ends)

    def foot(self, stub: tuple[float, float] | None) -> float:
        """Height of the lower end of a shaft with a stub below its lower bearing, mm."""
        return self.lower - (stub[1] if stub else self.ends[0])


def ring_of(seat: Seat) -> Shim | None:
    """The shim ring behind the upper bearing of a shaft; None where none is sold."""
    return shim_behind(seat.bearing.bore, seat.bearing.outside)


def ring_room(seat: Seat) -> float:
    """What the bearing stands out of the upper plate for its shim ring, mm."""
    return RING if ring_of(seat) is not None else 0.0


def hub_ring(seat: Seat) -> Shim | None:
    """The shim ring between a hub and its circlip; None where none is sold, or a recess is too narrow."""
    hub, size = seat.spindle.hub, seat.circlip.size
    return shim_on(size, hub.recess - 1.0, max(hub.bore, size))


def hub_room(seat: Seat) -> float:
    """By how much a hub may be thicker than drawn, mm: the groove lies so much higher.

    It is the sum of the general tolerances of its parts, and the thickness of the shim ring that is drawn.
    """
    return round(sum(general_length(one, "medium") for one in seat.spindle.hub.stacked), 6)


def relief(seat: Seat) -> float:
    """Length of the shoulder under the collar, mm: the collar keeps clear of a retainer."""
    return RELIEF + RETAINER if seat.located else RELIEF


def lowest(seat: Seat) -> float:
    """Greatest height of the lower plate's inner face, mm, that the hub's collar leaves."""
    stands = proud(seat.bearing) if seat.located else 0.0
    return seat.spindle.hub.low - stands - relief(seat) - LEAST_COLLAR


def highest(seat: Seat) -> float:
    """Least height of the upper plate's inner face, mm, that the circlip leaves."""
    ring = seat.circlip
    over = hub_room(seat) + ring.width + ring.edge + RELIEF
    return seat.spindle.hub.high + over + (0.0 if seat.located else PLAY + ring_room(seat))


def collar(hub: Hub) -> float:
    """Diameter of the collar under a hub, mm: no larger than the hub's counterbore."""
    return min(hub.bore + COLLAR, hub.recess - 1.0)


def sections(seat: Seat, levels: Levels, stub: tuple[float, float] | None = None) -> list[Step]:
    """The steps from below; ``stub``: diameter and length, mm, below the lower bearing."""
    hub, bearing, ring, held = seat.spindle.hub, seat.bearing, seat.circlip, AxialLocation.of(seat, levels)
    (low, high), (below, above), fit = held.shoulders, held.ends, shaft_fit(bearing.bore, "j6")
    steps = [Step(stub[0], stub[1] - below, shaft_fit(stub[0], "h6"))] if stub else []
    steps += [
        Step(bearing.bore, bearing.width + below, fit),
        Step(bearing.shoulder, relief(seat)),
        Step(collar(hub), hub.low - low - relief(seat)),
        Step(hub.bore, hub.length - SHORT, shaft_fit(hub.bore, "h6")),
    ]
    rest = high - (hub.high - SHORT)
    steps += [Step(ring.size, rest - RELIEF), Step(min(bearing.shoulder, ring.size), RELIEF)]
    return [*steps, Step(bearing.bore, bearing.width + (above if seat.located else PLAY), fit)]


def add_shaft(kit: Kit, seat: Seat, levels: Levels, stub: tuple[float, float] | None) -> Turned:
    """The shaft of a spindle with its key, circlip and bearings; gives the shaft."""
    spindle, hub, bearing, ring = seat.spindle, seat.spindle.hub, seat.bearing, seat.circlip
    body, axis = f"spindle-{spindle.name}", f"axis-{spindle.name}"
    kit.places[body] = Place((0.0, 0.0, -spindle.origin), turned(hub.key_angle), spindle.body)
    kit.places[axis] = Place((*spindle.point, 0.0))
    held = AxialLocation.of(seat, levels)
    foot = held.foot(stub)
    over = hub.high + hub_room(seat)
    groove = Groove(over - foot, ring.width, ring.groove, ring.tolerance)
    low, high = held.shoulders
    key = key_of(hub)
    seats: tuple[KeySeat, ...] = ()
    if key is not None:
        at = hub.low + (hub.length - key.length) / 2
        seats = (KeySeat(at - foot, key.seat_length, hub.key, hub.bore / 2 - key.size.shaft_depth),)
        name = f"key-{hub.key:g}x{key.size.height:g}x{key.length:g}".replace(".", "_")
        kit.bought(name, key.bought(hub.bore), body, at)
    lengths = (
        Length(COLLAR_EDGE, low - foot, high - foot, *SHOULDERS),
        Length(LOADED_WALL, hub.low - foot, over + ring.width - foot, *WALL),
    )
    shaft = Turned(
        _merged(sections(seat, levels, stub)), chamfer=BREAK, grooves=(groove,), seats=seats, lengths=lengths
    )
    if seat.located:
        shaft = with_bearing_circlips(kit, shaft, seat.bearing, body, (low, high), foot)
    # Above its seat the shaft is as thick as the circlip's size, and does not fill a larger bore.
    empty = SHORT if ring.size < hub.bore else 0.0
    kit.turned(f"shaft-{spindle.name}", shaft, body, foot, play=empty)
    under = hub_ring(seat)
    kit.bought(ring.part_name, ring.bought, body, over, play=0.0 if under else hub_room(seat))
    if under is not None:
        add_shim(kit, under, hub_room(seat), body, hub.high, on_shaft=True)
    name = f"bearing-{bearing.name.replace('/', '_')}"
    for z in (held.lower, held.upper):
        kit.bought(name, bearing.bought, axis, z, play=2 * FREE if seat.located else 0.0)
    behind = None if seat.located else ring_of(seat)
    if behind is not None:
        add_shim(kit, behind, RING, axis, held.upper + bearing.width, on_shaft=False)
    return shaft


def key_of(hub: Hub) -> Key | None:
    """The longest key that is sold for a hub's keyway and no longer than the hub; None without a keyway."""
    size = key_of_width(hub.key) if hub.key else None
    if size is None:
        return None
    least, most = RANGES.get(round(hub.key), (0, 0))
    fitting = [one for one in LENGTHS if least <= one <= min(most, hub.length - 2 * SHORT)]
    return Key(size, fitting[-1]) if fitting else None


def _merged(steps: list[Step]) -> tuple[Step, ...]:
    """Neighbours of one diameter and without a fit as one."""
    found: list[Step] = []
    for step in steps:
        last = found[-1] if found else None
        if last is not None and last.fit is None and step.fit is None and last.diameter == step.diameter:
            found[-1] = Step(step.diameter, last.length + step.length)
        else:
            found.append(step)
    return tuple(found)
