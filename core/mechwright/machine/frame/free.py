"""Whether a shaft can go from plate to plate: what other bodies sweep beside its axis."""

import math

import shapely

from mechwright.contracts.finding import Change, Finding, Stage
from mechwright.contracts.mounting import Mounting
from mechwright.machine.frame.seats import Seat
from mechwright.machine.frame.shafts import Levels, collar
from mechwright.machine.frame.sweep import Space, Swept
from mechwright.standards.circlips import shaft_circlips

CLEARANCE = 1.0
"""Between a shaft with what is on it and what another body sweeps at its height, mm."""

STEP = 0.1
"""In which a gap along the axes is given, mm."""


def in_the_way(seat: Seat, levels: Levels, space: Space, mounting: Mounting) -> list[Finding]:
    """The first thing that is in a shaft's way; empty if it is free."""
    spindle, hub, ring = seat.spindle, seat.spindle.hub, seat.circlip
    axis = shapely.Point(spindle.point)
    over = hub.high + ring.width
    for what, low, high, radius in (
        ("collar", levels.lower, hub.low, collar(hub) / 2),
        ("circlip", hub.high, over, ring.room / 2),
        ("shaft", over, levels.upper, ring.size / 2),
    ):
        for piece in space.between(low, high, without=spindle.body):
            room = float(shapely.distance(axis, piece.region))
            if room < radius + CLEARANCE:
                return [_fault(seat, what, piece, room, radius, mounting)]
    return []


def _fault(seat: Seat, what: str, piece: Swept, room: float, radius: float, mounting: Mounting) -> Finding:
    """With what may help: more of a gap, if it is the circlip that does not pass, or a thinner shaft."""
    spindle, hub = seat.spindle, seat.spindle.hub
    proposed: list[Change] = []
    words = []
    if what == "circlip" and mounting.gap is not None:
        key, now = mounting.gap
        wide = math.ceil((now + hub.high + seat.circlip.width - piece.low) / STEP) * STEP
        words.append("leave it more room along the axis")
        proposed.append({key: round(wide, 6)})
    if spindle.bore_key:
        words.append("take a thinner bore there")
        proposed += [{spindle.bore_key: one.size} for one in shaft_circlips()[::-1] if one.size < hub.bore]
    if mounting.turning_keys:
        words.append("turn a stage out of the way")
        proposed += mounting.turned_away
    return Finding.error(
        "frame.in-the-way",
        "machine.frame",
        f"{piece.part} passes the axis of spindle {spindle.name} at {room:.2f} mm, and its {what} of "
        f"{2 * radius:g} mm has to go on there to the other plate",
        room,
        radius + CLEARANCE,
        "mm",
        ", or ".join(words) or "a frame of two plates is not for this mechanism",
        Stage.PARTS,
        tuple(proposed),
    )
