"""Bodies of an assembly that touch nothing, and seats and columns with gaps that nobody has declared.

Glossary
--------
seat
    A hole and the pins in it: they fill its length.
column
    What stands on each other round one pin or one screw, without a gap.
play
    A clearance that a part declares (:attr:`Part.play`): within it a body counts as touching.
"""

import math
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.contracts.bodies import rigid
from mechwright.contracts.motion import Motion
from mechwright.mechanics.mating.rounds import ALIKE, CONTACT, NEAR, PARALLEL, Round, rounds_of
from mechwright.mechanics.mating.undrawn_dowels import undrawn_dowels
from mechwright_cad.assembly_order.groups import BodyLayers
from mechwright_cad.assembly_order.layers import UP, Layer
from mechwright_cad.bodies import Body, is_coupling
from mechwright_cad.contacts.screw_joints import ScrewJoint

ROOM = 0.1
"""A hole that is wider than its pin by more than this, mm, is room for it and no seat: a motor's pilot."""

PROUD = 2.0
"""A pin that stands further out of a hole, mm, is meant to: it carries something there, or is held there."""

AROUND = 12
"""Directions about a pin in which a column is looked at: one of them is clear of keyways and of slots."""

BESIDE = 0.3
"""How far outside of a pin or a screw its column is looked at, mm: outside of its chamfer and clearance."""


@dataclass(frozen=True)
class Gap:
    """What is wrong: the kind, names of the body and of its neighbour, the gap and the play declared, mm."""

    kind: str
    body: str
    other: str
    gap: float
    play: float


class Touching:
    """What touches what, at a sample of a motion."""

    def __init__(self, bodies: Sequence[Body], motion: Motion, sample: int) -> None:
        self.bodies, self.motion, self.sample = tuple(bodies), motion, sample
        self.standing = BodyLayers(bodies, sample)
        self.groups = rigid(motion)
        self.heads = [self.groups[body.instance.body] for body in self.bodies]

    def gaps(self, joints: Sequence[ScrewJoint]) -> Iterator[Gap]:
        """All of them."""
        yield from self._floating()
        yield from self._seats()
        yield from self._ends()
        yield from self._columns()
        yield from self._screwed(joints)

    def _floating(self) -> Iterator[Gap]:
        """Bodies that touch no other."""
        count = len(self.bodies)
        touched: set[int] = set()
        for k in range(count):
            if k in touched:
                continue
            order = sorted((m for m in range(count) if m != k), key=lambda m: self._far(k, m))
            for m in order:
                if self.standing.within(k, m, CONTACT + self._play(k, m)):
                    touched |= {k, m}
                    break
            else:
                gap, m = self._nearest(k, order)
                yield Gap("floating", self.bodies[k].name, self.bodies[m].name, gap, self._play(k, m))

    def _nearest(self, k: int, order: Sequence[int]) -> tuple[float, int]:
        """Distance, mm, and number of the body nearest to one; ``order`` is by the distance of the boxes."""
        nearest = math.inf, order[0]
        for m in order:
            if self._far(k, m) >= nearest[0]:
                break
            nearest = min(nearest, (self.standing.distance(k, m), m))
        return nearest

    def _far(self, one: int, two: int) -> float:
        """Distance of the boxes of two bodies, mm."""
        a, b = self._boxes[one], self._boxes[two]
        return float(np.linalg.norm(np.maximum(np.maximum(a[0] - b[1], b[0] - a[1]), 0.0)))

    @cached_property
    def _boxes(self) -> list[Array]:
        return [self.standing.box(k) for k in range(len(self.bodies))]

    def heights(self, number: int) -> tuple[float, float]:
        """The lowest and the highest point of a body, by number, mm."""
        low, high = self._boxes[number][:, 2]
        return float(low), float(high)

    def _play(self, *numbers: int) -> float:
        return max(self.bodies[k].part.play for k in numbers)

    @cached_property
    def rounds(self) -> list[tuple[int, Round]]:
        """All round faces, each with the number of its body."""
        return [(k, one) for k, body in enumerate(self.bodies) for one in rounds_of(body, self.sample)]

    @cached_property
    def mates(self) -> list[tuple[int, Round, list[tuple[int, float, float]]]]:
        """Holes that are no threads, each with the pins in it and the heights that these fill."""
        pins = [(k, one) for k, one in self.rounds if not one.inside]
        return [
            (k, hole, [found for m, pin in pins if m != k and (found := _filled(m, pin, hole)) is not None])
            for k, hole in self.rounds
            if hole.inside and not hole.threaded
        ]

    def _seats(self) -> Iterator[Gap]:
        """Holes that their pins do not fill, and holes with a fit in which there is none."""
        for k, hole, around in self.mates:
            pins = around
            name = self.bodies[k].name
            if not pins:
                if hole.fit is not None and not self._vacant(k, hole):
                    yield Gap("empty", name, "", hole.high - hole.low, 0.0)
                continue
            among = {m for m, _, _ in pins}
            pins = [
                found
                for m, pin in self.rounds
                if m in among and not pin.inside and hole.diameter - pin.diameter <= ROOM
                if (found := _filled(m, pin, hole)) is not None
            ]
            if not pins:
                continue
            filled = sum(high - low for low, high in _joined([(low, high) for _, low, high in pins]))
            left, play = hole.high - hole.low - filled, self._play(k, *(m for m, _, _ in pins))
            if left > CONTACT + play:
                yield Gap("seat", name, self.bodies[pins[0][0]].name, left, play)

    def _vacant(self, k: int, hole: Round) -> bool:
        """Whether a part says that a hole of its own may stay empty, or a dowel that is no body goes in."""
        return hole.face in self.bodies[k].part.vacant or (k, hole.face) in self._dowelled

    @cached_property
    def _dowelled(self) -> set[tuple[int, str]]:
        """Bodies and holes of dowels that no body shows."""
        dowels = undrawn_dowels(self.bodies, self.sample)
        return {(seat.body, seat.hole) for one in dowels for seat in one.seats}

    def _ends(self) -> Iterator[Gap]:
        """Ends of upright turned pins that stand a little out of the outermost hole that turns with them."""
        ends: dict[int, list[tuple[float, float, int, float]]] = {}
        for k, hole, pins in self.mates:
            if abs(hole.axis @ UP) > 1 - PARALLEL:
                for m, _, _ in pins:
                    if self.heads[m] == self.heads[k]:
                        ends.setdefault(m, []).append((*_heights(hole), k, hole.diameter))
        for m, holes in ends.items():
            turned = self.bodies[m].part.turned
            if turned is None:
                continue
            first, last = turned.steps[0].foot, turned.steps[-1].diameter
            if self.bodies[m].poses.rotation[self.sample][2, 2] < 0:
                first, last = last, first
            (low, high), others = self._boxes[m][:, 2], [k for _, _, k, _ in holes]
            under, over = min(holes, key=lambda one: one[0]), max(holes, key=lambda one: one[1])
            for out, size, (_, _, k, bore) in ((under[0] - low, first, under), (high - over[1], last, over)):
                play = self._play(m, *others)
                if CONTACT + play < out <= PROUD and size < bore + ALIKE:  # else it is a head
                    yield Gap("end", self.bodies[m].name, self.bodies[k].name, float(out), play)

    def _columns(self) -> Iterator[Gap]:
        """Bodies of one group on one upright pin with nothing between them."""
        on: dict[int, list[tuple[float, float, int, Round]]] = {}
        pins_in: dict[int, set[int]] = {}
        for k, hole, pins in self.mates:
            pins_in.setdefault(k, set()).update(m for m, _, _ in pins)
            if abs(hole.axis @ UP) > 1 - PARALLEL and not is_coupling(self.bodies[k].part):
                for m, _, _ in pins:
                    on.setdefault(m, []).append((*_heights(hole), k, hole))
        told: set[frozenset[int]] = set()
        for seats in on.values():
            for (_, top, one, hole), (bottom, _, two, other) in pairwise(
                sorted(seats, key=lambda seat: seat[:2])
            ):
                pair = frozenset((one, two))
                if self.heads[one] != self.heads[two] or bottom - top <= CONTACT or pair in told:
                    continue
                told.add(pair)
                play = self._play(one, two)
                left = self._open(hole.at, max(hole.diameter, other.diameter) / 2 + BESIDE, top, bottom)
                if left > CONTACT + play and not self._spaced(one, two, pins_in[one] | pins_in[two]):
                    yield Gap("column", self.bodies[one].name, self.bodies[two].name, left, play)

    def _spaced(self, one: int, two: int, pins: Collection[int]) -> bool:
        """Whether a body that is no pin of theirs lies on both of two."""
        return any(
            m not in pins
            and m not in (one, two)
            and all(self.standing.within(m, k, CONTACT + self._play(m, k)) for k in (one, two))
            for m in range(len(self.bodies))
        )

    def _screwed(self, joints: Sequence[ScrewJoint]) -> Iterator[Gap]:
        """Upright screws between whose head and thread is a gap."""
        for joint in joints:
            if not joint.what.head or abs(joint.hole.way @ UP) < 1 - PARALLEL:
                continue
            body = self.bodies[joint.screw]
            seat = float(body.poses.position[self.sample][2])
            seat += body.instance.z * float(body.poses.rotation[self.sample][2, 2])
            low, high = sorted((seat, float(joint.hole.mouth[2])))
            radius = (joint.what.of.clearance("coarse") + joint.what.head) / 4
            left = self._open(joint.hole.mouth, radius, low, high)
            play = self._play(joint.screw, joint.holder)
            # A retainer lies on what it clamps, and not on what its screws go into.
            play += sum(self.bodies[k].part.play for k, _ in joint.clamped)
            if left > CONTACT + play:
                yield Gap("screw", body.name, self.bodies[joint.holder].name, left, play)

    def _open(self, at: Array, radius: float, low: float, high: float) -> float:
        """How much of a height beside an axis nothing fills, mm, in the direction in which it is least.

        0 where a body stands there that has no layers.
        """
        corners = (np.array((*at[:2] - radius, low)), np.array((*at[:2] + radius, high)))
        layers: list[Layer] = []
        for k, box in enumerate(self._boxes):
            if (box[0] > corners[1] + CONTACT).any() or (corners[0] > box[1] + CONTACT).any():
                continue
            if not self.standing.layered(k):
                return 0.0
            layers += self.standing.layers(k)
        least = high - low
        for turn in np.arange(AROUND) * math.tau / AROUND:
            point = shapely.Point(at[0] + radius * math.cos(turn), at[1] + radius * math.sin(turn))
            spans = [
                (max(one.low, low), min(one.high, high))
                for one in layers
                if one.low < high and low < one.high and shapely.intersects(one.shape, point)
            ]
            least = min(least, high - low - sum(b - a for a, b in _joined(spans)))
        return least


def _filled(number: int, pin: Round, hole: Round) -> tuple[int, float, float] | None:
    """The heights of a hole, along its own axis, that a pin is in; None where it is not."""
    if abs(hole.diameter - pin.diameter) >= ALIKE or abs(pin.axis @ hole.axis) < 1 - PARALLEL:
        return None
    away = pin.at - hole.at
    along = float(away @ hole.axis)
    if np.linalg.norm(away - along * hole.axis) > NEAR:
        return None
    sign = 1.0 if pin.axis @ hole.axis > 0 else -1.0
    low, high = sorted((along + sign * pin.low, along + sign * pin.high))
    low, high = max(low, hole.low), min(high, hole.high)
    return (number, low, high) if high - low > CONTACT else None


def _joined(spans: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    """Spans without overlaps, from below.

    >>> _joined([(3, 4), (0, 2), (1, 2.5)])
    [(0, 2.5), (3, 4)]
    """
    found: list[tuple[float, float]] = []
    for low, high in sorted(spans):
        if found and low <= found[-1][1]:
            found[-1] = (found[-1][0], max(found[-1][1], high))
        else:
            found.append((low, high))
    return found


def _heights(one: Round) -> tuple[float, float]:
    """Of an upright round in the assembly, mm."""
    sign = float(np.sign(one.axis[2]))
    low, high = sorted((float(one.at[2]) + sign * one.low, float(one.at[2]) + sign * one.high))
    return low, high
