"""What fastens bodies to each other: screws, seats without play, keys, rings, clamps.

A seat of plain cylinders with play holds nothing along its axis (H7/h6, H7/g6).
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Literal

import numpy as np

from mechwright.contracts.bodies import rigid
from mechwright.contracts.fits import EXACT
from mechwright.contracts.motion import Motion
from mechwright.mechanics.mating.rounds import NEAR, PARALLEL, ROOM, Match, matches, rounds_of
from mechwright.standards import bushes, circlips, dowels, keys, springs
from mechwright_cad.assembly_order.groups import BodyLayers, is_bearing
from mechwright_cad.bodies import Body, is_coupling
from mechwright_cad.contacts.screw_joints import ScrewJoint

Kind = Literal["screwed", "pressed", "bonded", "keyed", "ring", "clamped"]

LEAST_TIGHT = 0.003
"""Interference of a press, mm, below which it may be drawn in by hand."""

UNDER_RING = 1.5
"""From a hub to the circlip that keeps it, mm, at most: shim rings and the play under them."""


@dataclass(frozen=True)
class Fastening:
    """Bodies that are one as soon as some of them are there.

    Parameters
    ----------
    kind
        What does it.
    needs
        Numbers of the bodies without which it holds nothing.
    joins
        Numbers of those that it holds together, as far as they are there.
    lasts
        Whether it holds at the worst of all limits: a push fit that may have play falls apart in use.
    """

    kind: Kind
    needs: frozenset[int]
    joins: frozenset[int]
    lasts: bool = True


class Seats:
    """How pins and holes go together: matches of all bodies that touch, and what each does."""

    def __init__(
        self,
        bodies: Sequence[Body],
        motion: Motion,
        sample: int,
        standing: BodyLayers,
        joints: Sequence[ScrewJoint] = (),
    ) -> None:
        self.bodies, self.sample, self.standing = tuple(bodies), sample, standing
        self._joints = tuple(joints)
        self._heads = rigid(motion)
        self.touching = [pair for pair in combinations(range(len(self.bodies)), 2) if standing.touch(*pair)]
        self.matches: list[Match] = [
            match for one, two in self.touching for match in matches(bodies, sample, (one,), (two,))
        ]

    def head(self, number: int) -> str:
        """The body of the motion that a body is fixed to."""
        return self._heads[self.bodies[number].instance.body]

    def is_bush(self, number: int) -> bool:
        """Whether a body is a bush: bought as one, or turned with a bore."""
        part = self.bodies[number].part
        bought = part.bought is not None and part.bought.standard == bushes.STANDARD
        return bought or (part.turned is not None and part.turned.bore > 0)

    def is_fast(self, match: Match) -> bool:
        """Whether a pin does not turn in its hole: no bearing does in its seat, no shaft in its coupling."""
        one, two = (self.bodies[k] for k in (match.pin, match.hole))
        alike = self.head(match.pin) == self.head(match.hole)
        return alike or any(is_bearing(body) or is_coupling(body.part) for body in (one, two))

    def kind(self, match: Match) -> Kind | None:
        """What fastens a pin in its hole; None where it slides or turns."""
        least, most = match.play
        if match.inside.threaded:
            return "screwed"
        if is_coupling(self.bodies[match.hole].part):
            return "clamped"
        if not self.is_fast(match):
            return None
        if match.missing_fits:
            return "bonded" if least <= ROOM else None
        if least < 0:
            return "bonded" if most > EXACT and self._is_own_seat_of_dowel(match) else "pressed"
        return "bonded" if self._needs_compound(match) else None

    def _needs_compound(self, match: Match) -> bool:
        """Whether nothing but retaining compound holds a pin in a hole that it slides in.

        A pin that goes into one of several holes by turns is not bonded.
        """
        pin, hole = (self.bodies[k].part for k in (match.pin, match.hole))
        if match.inside.face in hole.vacant:
            return False
        ring = any(part.turned is not None and part.turned.bore for part in (pin, hole))
        screwed_down = pin.turned is not None and pin.turned.threads
        if ring or screwed_down or pin.bought is not None or hole.bought is not None:
            return False
        if self._is_clamped_to_hub(match):
            return False
        return not (pin.turned is not None and pin.turned.seats and self._is_under_ring(match))

    def _is_clamped_to_hub(self, match: Match) -> bool:
        """Whether screws in a hub clamp it to another one on its shaft, by which it is set and then held."""
        on_shaft = {one.hole for one in self.matches if one.pin == match.pin and self.is_fast(one)}
        return any(
            one.holder == match.hole and on_shaft & {k for k, _ in one.clamped} - {match.hole}
            for one in self._joints
        )

    def may_lack_interference(self, match: Match) -> bool:
        """Whether a press has next to no interference where both are at their loosest limits."""
        return -LEAST_TIGHT < match.play[1] <= EXACT and self.kind(match) == "pressed"

    def _is_under_ring(self, match: Match) -> bool:
        """Whether a circlip on the shaft keeps a hub there."""
        return any(
            part.bought is not None
            and part.bought.standard in circlips.STANDARDS
            and self.standing.touch(k, match.pin)
            and self.standing.within(k, match.hole, UNDER_RING)
            for k, part in enumerate(body.part for body in self.bodies)
        )

    def _is_own_seat_of_dowel(self, match: Match) -> bool:
        """Whether it is the tightest hole of a dowel pin, which the pin stays in."""
        bought = self.bodies[match.pin].part.bought
        if bought is None or bought.standard not in dowels.STANDARDS:
            return False
        return match.play <= min(other.play for other in self.matches if other.pin == match.pin)


def fastenings(seats: Seats, joints: Sequence[ScrewJoint]) -> list[Fastening]:
    """All fastenings of an assembly."""
    found = [_screwed(seats, joint) for joint in joints]
    known: set[tuple[int, int]] = set()
    for match in seats.matches:
        pair = frozenset((match.pin, match.hole))
        kind = seats.kind(match)
        known.add((min(pair), max(pair)))
        if kind is not None:
            found.append(Fastening(kind, pair, pair, kind != "pressed" or match.play[1] <= EXACT))
    return [*found, *_others(seats, known)]


def _others(seats: Seats, known: set[tuple[int, int]]) -> Iterator[Fastening]:
    """Keys and rings on their shafts, springs on pins; pins and bushes of solids with undeclared holes."""
    for one, two in seats.touching:
        pair = frozenset((one, two))
        parts = [seats.bodies[k].part for k in (one, two)]
        standards = {part.bought.standard for part in parts if part.bought is not None}
        shaft = any(part.turned is not None for part in parts)
        if seats.head(one) != seats.head(two):
            continue
        if standards & {*circlips.STANDARDS, springs.STANDARD} and shaft:
            yield Fastening("ring", pair, pair)
        elif keys.STANDARD in standards and shaft:
            yield Fastening("keyed", pair, pair)
        elif (one, two) not in known and any(part.kind == "solid" for part in parts):
            pin = any(
                (part.turned is not None and not part.turned.threads and not part.turned.bore)
                or (part.bought is not None and part.bought.standard == bushes.STANDARD)
                for part in parts
            )
            if pin:
                yield Fastening("pressed", pair, pair)


def _screwed(seats: Seats, joint: ScrewJoint) -> Fastening:
    """A screw with the holder of its thread, and all that it passes through between head and thread."""
    needs = frozenset((joint.screw, joint.holder))
    if not joint.what.head:
        held = {k for pair in seats.touching if joint.screw in pair for k in pair}
        alike = {k for k in held if seats.head(k) == seats.head(joint.holder)}
        return Fastening("screwed", needs, needs | alike)
    body = seats.bodies[joint.screw]
    turn, place = body.poses.rotation[seats.sample], body.poses.position[seats.sample]
    seat, axis = place + body.instance.z * turn[:, 2], joint.what.tip * turn[:, 2]
    stack = {k for k, _ in joint.clamped}
    for k, other in enumerate(seats.bodies):
        for one in rounds_of(other, seats.sample) if k not in needs else ():
            away = seat - one.at
            along = float(away @ one.axis)
            if not one.inside or abs(one.axis @ axis) < 1 - PARALLEL:
                continue
            if np.linalg.norm(away - along * one.axis) > NEAR or one.diameter > joint.what.head:
                continue
            ends = sorted(float((one.at + at * one.axis - seat) @ axis) for at in (one.low, one.high))
            if ends[0] < joint.what.length and ends[1] > 0:
                stack.add(k)
    return Fastening("screwed", needs, needs | stack)
