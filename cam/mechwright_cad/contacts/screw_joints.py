"""Screwed joints of an assembly: which thread a screw is in, how deep, and to what torque it is tightened."""

import math
import re
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.details import Thread
from mechwright.contracts.part import Part
from mechwright.contracts.shape import Revolve
from mechwright.errors import DesignError
from mechwright.mechanics.mating.rounds import NEAR, PARALLEL, Round, rounds_of
from mechwright.mechanics.strength.allowed import ALLOWED
from mechwright.mechanics.strength.bolts import PROOF
from mechwright.mechanics.strength.tightening import (
    LEAST_ENGAGED,
    Clamped,
    Tightening,
    strip_force,
    tightening,
)
from mechwright.standards.screws import ScrewSize, screw_size
from mechwright.tolerances import TOLERANCES
from mechwright_cad.bodies import Body

_SCREW = re.compile(r"ISO (4762|10642|4026) - M([\d.]+) x ([\d.]+) - (\S+)")

BELOW = 0.1
"""How far under a screw's head the hole is looked at that its head lies on, mm."""

SHALLOW = 0.3
"""A thread is entered where a screw goes so far into it, mm: one that ends at its mouth is not in it."""


@dataclass(frozen=True)
class Screwed:
    """A standard screw by its designation: number of its standard, size, length, mm, strength class.

    ``tip`` is 1 where its point looks along its own z, -1 where it looks against it.
    """

    standard: str
    of: ScrewSize
    length: float
    grade: str
    tip: int

    @property
    def head(self) -> float:
        """Diameter of its head, mm; 0 of a set screw."""
        return {"4762": self.of.head, "10642": self.of.sunk_head}.get(self.standard, 0.0)

    @property
    def key(self) -> float:
        """Width of the hexagon across flats, mm."""
        of = self.of
        return {"4762": of.hexagon, "10642": of.sunk_hexagon}.get(self.standard, of.set_hexagon)


def screw_of(part: Part) -> Screwed | None:
    """What a part is as a screw; None for what is none that is known."""
    found = _SCREW.fullmatch(part.bought.designation) if part.bought is not None else None
    if found is None:
        return None
    length, shape = float(found[3]), part.bought.shape if part.bought is not None else None
    pieces = [one for one in shape.pieces if isinstance(one, Revolve)] if shape is not None else []
    top = max((z for one in pieces for _, z in one.profile), default=0.0)
    tip = 1 if top >= length - TOLERANCES.closure else -1
    try:
        return Screwed(found[1], screw_size(float(found[2])), length, found[4], tip)
    except DesignError:
        return None


@dataclass(frozen=True)
class Hole:
    """A threaded hole where it stands: its mouth (3,), mm, and the unit vector (3,) into it."""

    body: int
    mouth: Array
    way: Array
    diameter: float
    depth: float
    through: bool
    shear: float
    torque: float = math.inf


@dataclass(frozen=True)
class ScrewJoint:
    """A screw in a thread.

    Parameters
    ----------
    screw, holder
        Numbers of the bodies.
    engaged
        Length of thread in which both are, mm.
    spare
        From the screw's end to the end of the thread, mm; below 0 it goes deeper than it can; infinite where
        the thread goes through.
    clamped
        What lies under the head, by number of body.
    """

    screw: int
    holder: int
    what: Screwed
    hole: Hole
    engaged: float
    spare: float
    clamped: tuple[tuple[int, Clamped], ...]

    @property
    def least(self) -> float:
        """Length that has to be engaged, mm."""
        return LEAST_ENGAGED * self.what.of.size

    @cached_property
    def tightening(self) -> Tightening | None:
        """Its torque; None for a set screw, whose key is its limit."""
        of, what = self.what.of, self.what
        if not what.head or what.grade not in PROOF:
            return None
        strips = strip_force(of.size, of.pitch, self.engaged, self.hole.shear, what.grade)
        hole = self.clamped[0][1].hole if self.clamped else of.clearance()
        flat = [one for _, one in self.clamped] if what.standard == "4762" else []
        return tightening((of.size, of.pitch, what.head, hole), what.grade, strips, flat, self.hole.torque)

    @property
    def is_locked(self) -> bool:
        """Whether thread locker secures it: a set screw, and one that no preload holds, as in rubber."""
        found = self.tightening
        return not self.what.head or (found is not None and found.limit == "holder")

    @property
    def weakest(self) -> int | None:
        """The body that limits the torque; None where the screw does."""
        found = self.tightening
        if found is None or found.limit == "screw":
            return None
        if found.limit == "head":
            return min(self.clamped, key=lambda one: one[1].force)[0]
        return self.holder


def joints_of(
    bodies: Sequence[Body], sample: int, touch: Callable[[int, int], bool] | None = None
) -> list[ScrewJoint]:
    """All of them; a set screw may have two, a screw that is in no thread has none.

    ``touch`` says whether two bodies, by number, touch: it finds what a head clamps that has no round hole.
    """
    screws = {k: what for k, body in enumerate(bodies) if (what := screw_of(body.part)) is not None}
    if not screws:
        return []
    holes = [hole for k, body in enumerate(bodies) for hole in holes_of(k, body, sample)]
    rounds = [
        (k, one)
        for k, body in enumerate(bodies)
        if k not in screws
        for one in rounds_of(body, sample)
        if one.inside and not one.threaded
    ]
    found = []
    for k, what in screws.items():
        turn, place = bodies[k].poses.rotation[sample], bodies[k].poses.position[sample]
        seat = place + bodies[k].instance.z * turn[:, 2]
        axis = what.tip * turn[:, 2]
        entered = [*_entered(what, seat, axis, holes)]
        holders = {hole.body for hole, _, _ in entered}
        for hole, engaged, spare in entered:
            clamped = _under(what, seat, axis, rounds, bodies) if what.head else ()
            if what.head and touch is not None:
                clamped += _touched(k, what, clamped, holders, bodies, touch)
            found.append(ScrewJoint(k, hole.body, what, hole, engaged, spare, clamped))
    return found


def holes_of(k: int, body: Body, sample: int) -> Iterator[Hole]:
    """The threaded holes of a body, by its number; of a thread that goes through, both mouths."""
    turn, place = body.poses.rotation[sample], body.poses.position[sample]
    part, up = body.part, turn[:, 2]
    shear = ALLOWED[part.material].shear if part.material in ALLOWED else 0.0

    def at(x: float, y: float, z: float) -> Array:
        found: Array = turn @ np.array((x, y, z + body.instance.z)) + place
        return found

    for detail in part.details:
        if isinstance(detail, Thread):
            through = detail.depth >= part.thickness - TOLERANCES.closure
            mouth = at(*detail.centre, part.thickness)
            yield Hole(k, mouth, -up, detail.diameter, detail.depth, through, shear)
            if through:
                yield Hole(k, at(*detail.centre, 0.0), up, detail.diameter, detail.depth, through, shear)
    if part.turned is not None:
        for end in part.turned.threads:
            low = end.end == "lower"
            mouth = at(0.0, 0.0, 0.0 if low else part.turned.length)
            yield Hole(k, mouth, up if low else -up, end.diameter, end.depth, False, shear)
        if part.turned.tapped:
            deep = part.turned.length
            for mouth, way in ((at(0.0, 0.0, 0.0), up), (at(0.0, 0.0, deep), -up)):
                yield Hole(k, mouth, way, part.turned.bore, deep, True, shear)
    if part.bought is not None:
        for one in part.bought.threads:
            mouth = at(*one.place, one.mouth)
            most = math.inf if one.torque is None else one.torque
            yield Hole(k, mouth, -up, one.diameter, one.depth, False, one.shear, most)


def _entered(
    what: Screwed, seat: Array, axis: Array, holes: Sequence[Hole]
) -> Iterator[tuple[Hole, float, float]]:
    """Holes that a screw is in whose point looks along ``axis``, with length engaged and spare, mm."""
    for hole in holes:
        if abs(hole.diameter - what.of.size) > TOLERANCES.closure or abs(hole.way @ axis) < 1 - PARALLEL:
            continue
        leads = float(hole.way @ axis) > 0
        if what.head and not leads:
            continue
        away = seat - hole.mouth
        along = float(away @ hole.way)
        if np.linalg.norm(away - along * hole.way) > NEAR:
            continue
        start, end = (along, along + what.length) if leads else (along - what.length, along)
        engaged = min(end, hole.depth) - max(start, 0.0)
        if engaged > SHALLOW:
            yield hole, engaged, math.inf if hole.through else hole.depth - end


def _under(
    what: Screwed, seat: Array, axis: Array, rounds: Sequence[tuple[int, Round]], bodies: Sequence[Body]
) -> tuple[tuple[int, Clamped], ...]:
    """What lies under a head: a part, or washers and the part under the last of them."""
    found: list[tuple[int, Clamped]] = []
    outside, below = what.head, 0.0
    while True:
        hit = _hole_at(seat + (below + BELOW) * axis, axis, rounds, outside)
        if hit is None:
            return tuple(found)
        k, hole = hit
        part = bodies[k].part
        if part.material in ALLOWED:
            found.append((k, Clamped(outside, hole, ALLOWED[part.material].head)))
        if not _is_washer(part):
            return tuple(found)
        _, outside, height = what.of.washer
        below += height


def _touched(
    k: int,
    what: Screwed,
    clamped: Sequence[tuple[int, Clamped]],
    holders: Collection[int],
    bodies: Sequence[Body],
    touch: Callable[[int, int], bool],
) -> tuple[tuple[int, Clamped], ...]:
    """What a head, or the last washer under it, lies on where that has no round hole: a slot, a solid."""
    last = clamped[-1][0] if clamped else k
    if clamped and not _is_washer(bodies[last].part):
        return ()
    known = {k, *holders, *(m for m, _ in clamped)}
    outside = what.of.washer[1] if clamped else what.head
    return tuple(
        (m, Clamped(outside, what.of.clearance(), ALLOWED[body.part.material].head))
        for m, body in enumerate(bodies)
        if m not in known and body.part.material in ALLOWED and touch(last, m)
    )


def _is_washer(part: Part) -> bool:
    return part.bought is not None and part.bought.standard == "ISO 7089"


def _hole_at(
    point: Array, axis: Array, rounds: Sequence[tuple[int, Round]], less_than: float
) -> tuple[int, float] | None:
    """The narrowest coaxial hole at a point: its body and diameter, mm."""
    found = []
    for k, one in rounds:
        if one.diameter >= less_than or abs(one.axis @ axis) < 1 - PARALLEL:
            continue
        away = point - one.at
        along = float(away @ one.axis)
        if one.low <= along <= one.high and np.linalg.norm(away - along * one.axis) <= NEAR:
            found.append((one.diameter, k))
    if not found:
        return None
    diameter, k = min(found)
    return k, diameter
