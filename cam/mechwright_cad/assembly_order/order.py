"""The order of assembly: the mechanism is taken apart in thought, and put together the other way round.

Sought is always the least set of bodies that can leave, as one and in a straight line, what else is there.
In the graph of who bars whom along a way, those are the strongly connected sets that no other set bars
(Wilson and Latombe, Geometric reasoning about mechanical assembly, 1994). Groups that move as one are tried
first, then single bodies; a group that has left is taken apart by itself.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.csgraph import connected_components, dijkstra

from mechwright.arrays import Array
from mechwright.contracts.bodies import rigid
from mechwright.contracts.joint import GROUND
from mechwright.contracts.motion import Motion
from mechwright.mechanics.mating.rounds import PARALLEL
from mechwright.pipeline.result_store import recalled
from mechwright.standards import circlips
from mechwright_cad.assembly_order.barred import Ways
from mechwright_cad.assembly_order.blocking import Blocking
from mechwright_cad.assembly_order.fastenings import Seats, fastenings
from mechwright_cad.assembly_order.groups import BodyLayers, bonds, connected
from mechwright_cad.assembly_order.holding import Holding, Way
from mechwright_cad.assembly_order.layers import LEVEL, UP, axis_of, own_layers
from mechwright_cad.assembly_order.levels import Constraints, Level, Step, steps_of
from mechwright_cad.assembly_order.reach import Reach
from mechwright_cad.assembly_order.schedule import Coming
from mechwright_cad.bodies import Body, is_coupling, is_motor
from mechwright_cad.contacts.screw_joints import ScrewJoint, joints_of

CLAMPS = frozenset({"ISO 4762", "ISO 10642"})
"""Standards of screws with a head: what one touches leaves after it, or with it."""

HOLDERS = CLAMPS | {"ISO 4026", "ISO 7089"} | circlips.STANDARDS
"""Standards of what holds others: it comes off before them if it can, and is put on right after."""

SHARE = 0.1
"""Of the size of the largest plate that stands still: a smaller one is not what all goes onto."""

Units = Sequence[tuple[int, ...]]
"""Sets of bodies, by number."""


@dataclass(frozen=True)
class _Leaving:
    """A set that can leave, along which way, and the groups that it is made of."""

    bodies: tuple[int, ...]
    way: Array
    units: Units


class Order:
    """The order for bodies at a sample of a motion."""

    def __init__(self, bodies: Sequence[Body], motion: Motion, sample: int) -> None:
        self.bodies, self.motion, self.sample = tuple(bodies), motion, sample
        self.standing = BodyLayers(bodies, sample)
        self.table = Ways(bodies, sample)
        self.heads = rigid(motion)

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        """All steps; those of a group stand before the step in which it goes to its place."""
        if not self.bodies:
            return ()
        return recalled(steps_of, self._given, self._made_steps)

    def _made_steps(self) -> tuple[Step, ...]:
        given = Constraints(
            self.table,
            self.holding,
            self.seats,
            self.reach,
            self.joints,
            self._clamped,
            self._root,
            self.last,
        )
        return tuple(steps_of(given, self._whole))

    @cached_property
    def _whole(self) -> Level:
        return recalled(Level, self._given, lambda: self._together(tuple(range(len(self.bodies)))))

    @property
    def _given(self) -> tuple[object, ...]:
        return self.bodies, self.motion, self.sample

    @property
    def has_ways(self) -> bool:
        """Whether a straight way leads each body to its seat."""
        return self._whole.has_ways

    @property
    def stuck(self) -> tuple[int, ...]:
        """Bodies that hold each other fast, as no straight way leads one off; none where all come off."""
        return self._whole.start if len(self._whole.start) > 1 else ()

    @cached_property
    def joints(self) -> tuple[ScrewJoint, ...]:
        """All screwed joints."""
        return tuple(joints_of(self.bodies, self.sample, self.standing.touch))

    @cached_property
    def seats(self) -> Seats:
        """How pins and holes go together."""
        return Seats(self.bodies, self.motion, self.sample, self.standing, self.joints)

    @cached_property
    def reach(self) -> Reach:
        """Which tool gets to what."""
        return Reach(self.bodies, self.sample, self.standing)

    @cached_property
    def holding(self) -> Holding:
        """What holds each body at a step."""
        ways: dict[int, list[Way]] = {}
        for k, way in self._whole.ways:
            ways.setdefault(k, []).append(way)
        blocking = Blocking(self.bodies, self.standing)
        return Holding(blocking, fastenings(self.seats, self.joints), ways)

    @cached_property
    def retention(self) -> Holding:
        """What holds each body of the finished assembly for good, at the worst of all limits."""
        holding = self.holding
        lasting = [one for one in holding.fastenings if one.lasts]
        return Holding(holding.blocking, lasting, holding.ways)

    @property
    def root(self) -> int | None:
        """What all goes onto; None without bodies."""
        return self._root(tuple(range(len(self.bodies)))) if self.bodies else None

    @cached_property
    def ways(self) -> tuple[Array, ...]:
        """Ways that are tried, the best first: up and down, along axes of joints and of what is round."""
        found: list[Array] = []
        for axis in self._axes():
            for way in (axis, -axis):
                if not any(way @ other > 1 - PARALLEL for other in found):
                    found.append(way)
        return tuple(found)

    def _axes(self) -> Iterator[Array]:
        plates = [body for body in self.bodies if body.is_plate]
        upright = [b for b in plates if abs(b.poses.rotation[self.sample][2, 2]) > 1 - PARALLEL]
        if upright or not plates:
            yield UP
        for joint in self.motion.joints.values():
            if joint.kind in {"revolute", "prismatic"}:
                axis = np.array(joint.axis)
                if joint.one != GROUND:
                    axis = self.motion.poses[joint.one].rotation[self.sample] @ axis
                yield axis if axis @ UP >= -PARALLEL else -axis
        for body in self.bodies:
            if body.is_plate or own_layers(body.part) is not None:
                yield body.poses.rotation[self.sample][:, 2]
            elif body.part.turned is not None:
                yield body.poses.rotation[self.sample] @ axis_of(body.part)

    @cached_property
    def _bonds(self) -> list[tuple[int, int]]:
        return bonds(self.bodies, self.motion, self.standing)

    @cached_property
    def _sizes(self) -> Array:
        """Volume of a box round each body, mm³."""
        return np.array(
            [float(np.prod(np.ptp(self.standing.box(k), axis=0))) for k in range(len(self.bodies))]
        )

    def size(self, number: int) -> float:
        """Volume of the box round a body, mm³."""
        return float(self._sizes[number])

    def ahead(self, number: int, way: Array, *, low: bool) -> float:
        """How far along a way a body begins, or ends, mm; by the box round it."""
        corners = np.array(np.meshgrid(*self.standing.box(number).T)).reshape(3, -1)
        along = way @ corners
        return float(along.min() if low else along.max())

    @cached_property
    def _base(self) -> int:
        """What all goes onto: of plates and solids at rest the one in the middle; -1 if nothing does.

        In the middle is the one that is fewest contacts away from what the input turns, then from all that
        moves, then from the rest: of a machine on legs it is the plate that carries the shafts, not the one
        on the floor nor that of the motor. Without such it is the largest body.
        """
        heads = [self.heads[body.instance.body] for body in self.bodies]
        still = [k for k, head in enumerate(heads) if head == GROUND]
        made = [k for k in still if self.bodies[k].part.kind in {"plate", "solid"}]
        most = max((self._sizes[k] for k in made), default=0.0)
        large = [k for k in made if self._sizes[k] >= SHARE * most]
        if len(large) < 2:
            return max(large or still, key=lambda k: (self._sizes[k], -k), default=-1)
        count = len(self.bodies)
        touching = np.zeros((count, count))
        for one, two in combinations(range(count), 2):
            touching[one, two] = self.standing.touch(one, two)
        away = dijkstra(touching, directed=False, unweighted=True, indices=large)
        away[np.isinf(away)] = count
        driven = {self.heads[j.two] for j in self.motion.joints.values() if j.drives}
        turned = away[:, [k for k, head in enumerate(heads) if head in driven]]
        moving = away[:, [k for k, head in enumerate(heads) if head != GROUND]]
        near = turned.min(axis=1, initial=count)
        return min(zip(near, moving.sum(axis=1), away.sum(axis=1), -self._sizes[large], large, strict=True))[
            -1
        ]

    @cached_property
    def _below(self) -> frozenset[int]:
        """What hangs below the base of a machine that stands on another plate: it comes last, from below."""
        if self._base < 0:
            return frozenset()
        floor = self.standing.box(self._base)[0, 2] + LEVEL
        under = [k for k in range(len(self.bodies)) if self.standing.box(k)[1, 2] <= floor]
        stands = any(
            self.bodies[k].is_plate and self.heads[self.bodies[k].instance.body] == GROUND for k in under
        )
        return frozenset(under if stands else ())

    @cached_property
    def last(self) -> frozenset[int]:
        """What comes last of what hangs below the base: plates at rest, motor and coupling."""
        return frozenset(
            k
            for k in self._below
            for body in (self.bodies[k],)
            if (body.is_plate and self.heads[body.instance.body] == GROUND)
            or is_motor(body.part)
            or is_coupling(body.part)
        )

    @cached_property
    def _clamped(self) -> NDArray[np.bool_]:
        """A table (n, n): whether body i is held by screw j."""
        count = len(self.bodies)
        table = np.zeros((count, count), dtype=bool)
        for j, body in enumerate(self.bodies):
            if body.part.bought is not None and body.part.bought.standard in CLAMPS:
                table[:, j] = [i != j and self.standing.touch(i, j) for i in range(count)]
        return table

    def _root(self, members: tuple[int, ...]) -> int:
        """What members are put on: the base, or of the lowest group the one that touches most."""
        if self._base in members:
            return self._base
        groups = connected(members, self._bonds)
        boxes = [np.array([self.standing.box(k)[:, 2] for k in group]) for group in groups]
        lowest = min(zip(groups, boxes, strict=True), key=lambda one: (one[1].min() + one[1].max(), one[0]))[
            0
        ]
        touched = {k: sum(k in bond and set(bond) <= set(lowest) for bond in self._bonds) for k in lowest}
        return max(lowest, key=lambda k: (touched[k], self._sizes[k], -k))

    def _together(self, members: tuple[int, ...]) -> Level:
        """What members are put together from: taken apart as far as it goes, then the other way round."""
        units: list[tuple[Coming, Level]] = []
        rest = members
        while len(rest) > 1:
            leaving = self._leaving(rest)
            if leaving is None:
                break
            rest = tuple(k for k in rest if k not in leaving.bodies)
            x, y, z = (-leaving.way + 0.0).round(9).tolist()
            alike = self.bodies[leaving.bodies[0]].part.name if len(leaving.bodies) == 1 else ""
            units.append((Coming(leaving.bodies, (x, y, z), alike), self._together(leaving.bodies)))
        return Level(rest, tuple(reversed(units)))

    def _leaving(self, members: tuple[int, ...]) -> _Leaving | None:
        """What leaves first: a shaft as one with the rings that it holds, a link by itself, if it can."""
        groups, singles = connected(members, self._bonds), [(k,) for k in members]
        root = self._root(members)
        found = (
            self._downwards(singles, groups, root)
            or self._first(groups, root, self._shaft)
            or self._first(singles, root, lambda units: len(units) == 1)
            or self._first(groups, root, lambda _: True)
            or self._first(singles, root, lambda _: True)
            or self._sideways(members, root)
        )
        return found and (self._holder(members, found) or found)

    def _downwards(self, units: Units, groups: Units, root: int) -> _Leaving | None:
        """The lowest of what hangs below the base and can leave downwards, as a group where all of it can."""
        if root != self._base or not self._below:
            return None
        sets = [one for one in self._free(units, -UP) if self._below.issuperset(one.bodies)]
        found = min(sets, key=lambda one: (len(one.bodies), *self._worth(one)[1:]), default=None)
        if found is None:
            return None
        whole = next(group for group in groups if found.bodies[0] in group)
        if len(whole) == 1 or not self._below.issuperset(whole):
            return found
        return next((one for one in self._free(groups, -UP) if set(one.bodies) == set(whole)), found)

    def _first(
        self, units: Sequence[tuple[int, ...]], root: int, fit: Callable[[Units], bool]
    ) -> _Leaving | None:
        """The best set along the best way along which one that fits can leave."""
        for way in self.ways:
            sets = [one for one in self._free(units, way) if fit(one.units) and root not in one.bodies]
            if sets:
                return min(sets, key=self._worth)
        return None

    def _holder(self, members: tuple[int, ...], leaving: _Leaving) -> _Leaving | None:
        """A screw or a circlip that holds what is to leave, and can leave before it."""
        for k in members:
            bought = self.bodies[k].part.bought
            if k in leaving.bodies or bought is None or bought.standard not in HOLDERS:
                continue
            if any(self.standing.touch(k, other) for other in leaving.bodies):
                others = [other for other in members if other != k]
                for way in self.ways:
                    if not self.table.barred(way)[k, others].any():
                        return _Leaving((k,), way, ((k,),))
        return None

    def _shaft(self, units: Units) -> bool:
        """Whether a set is one group, or one with rings that it holds."""
        *rings, _ = sorted(units, key=len)
        return all(len(ring) == 1 and not self.bodies[ring[0]].is_plate for ring in rings)

    def _worth(self, one: _Leaving) -> tuple[object, ...]:
        """Few bodies first, then what stands highest, then the last."""
        top = max(self.standing.box(k)[1, 2] for k in one.bodies)
        return len(one.bodies), -round(top, 3), [-k for k in one.bodies]

    def _free(self, units: Units, way: Array) -> Iterator[_Leaving]:
        """The least sets that can leave the others along a way."""
        if len(units) < 2:
            return
        barred = self.table.barred(way) | self._clamped
        inside_of = np.zeros((len(units), len(self.bodies)), dtype=np.int64)
        for which, unit in enumerate(units):
            inside_of[which, unit] = 1
        graph = inside_of @ barred @ inside_of.T > 0
        np.fill_diagonal(graph, val=False)
        count, of = connected_components(graph, directed=True, connection="strong")
        for which in range(count if count > 1 else 0):
            inside = of == which
            if not graph[np.ix_(inside, ~inside)].any():
                those = tuple(unit for unit, is_in in zip(units, inside, strict=True) if is_in)
                yield _Leaving(tuple(sorted(k for unit in those for k in unit)), way, those)

    def _sideways(self, members: tuple[int, ...], root: int) -> _Leaving | None:
        """A single body that can leave along an axis of its own: a key out of its seat."""
        for k in members:
            if k == root:
                continue
            turn = self.bodies[k].poses.rotation[self.sample]
            others = [other for other in members if other != k]
            for way in (turn[:, 0], -turn[:, 0], turn[:, 1], -turn[:, 1]):
                if not self.table.row(k, way)[others].any():
                    return _Leaving((k,), way, ((k,),))
        return None
