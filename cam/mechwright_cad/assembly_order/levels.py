"""The levels of an assembly: what a group begins with, and the units that come onto it.

A level is put in order by :mod:`.schedule`; what bars whom, what fastens what and which tool gets where say
which unit comes before which.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright_cad.assembly_order.barred import Ways
from mechwright_cad.assembly_order.fastenings import Seats
from mechwright_cad.assembly_order.holding import UPRIGHT, Holding, Way
from mechwright_cad.assembly_order.reach import Reach
from mechwright_cad.assembly_order.schedule import Coming, precedence, scheduled
from mechwright_cad.contacts.screw_joints import ScrewJoint


@dataclass(frozen=True)
class Step:
    """What is done at once.

    Parameters
    ----------
    moved
        Numbers of the bodies that go to their seats; with no ``way``, all that have to be brought together
        otherwise.
    onto
        Numbers of those that stand there already, in the same group.
    way
        Unit vector along which they go, from outside to the seat.
    down
        Unit vector that looks to the floor meanwhile: an assembly is turned over where that holds its bodies.
    hand
        Numbers of bodies that have to be held by hand after the step.
    root
        What the group goes onto; -1 where there is no way.
    """

    moved: tuple[int, ...]
    onto: tuple[int, ...]
    way: Way | None
    down: Way = UPRIGHT[0]
    hand: tuple[int, ...] = ()
    root: int = -1


@dataclass(frozen=True)
class Level:
    """What a group begins with, and what comes onto that, each with what it is made of.

    More than one body at the start have no straight way to each other.
    """

    start: tuple[int, ...]
    units: "tuple[tuple[Coming, Level], ...]"

    @property
    def has_ways(self) -> bool:
        """Whether a straight way leads each body to its seat."""
        return len(self.start) < 2 and all(inner.has_ways for _, inner in self.units)

    @property
    def ways(self) -> "Iterator[tuple[int, Way]]":
        """Each body with each way along which it goes."""
        for unit, inner in self.units:
            yield from ((k, unit.way) for k in unit.bodies)
            yield from inner.ways


@dataclass(frozen=True)
class Constraints:
    """What an order has to respect: who bars whom, what holds what, which tool gets where.

    ``clamped`` (n, n) says whether body i lies under the head of screw j; ``root_of`` what bodies are put on.
    ``last`` are bodies that come after all that stand above them: the motor, and what carries it.
    """

    table: Ways
    holding: Holding
    seats: Seats
    reach: Reach
    joints: tuple[ScrewJoint, ...]
    clamped: NDArray[np.bool_]
    root_of: Callable[[tuple[int, ...]], int]
    last: frozenset[int] = frozenset()


def steps_of(given: Constraints, level: Level) -> Iterator[Step]:
    """The steps of a level, each unit after those that make it."""
    if len(level.start) > 1:
        yield Step(level.start, (), None)
    units = [unit for unit, _ in level.units]
    inner = {unit.bodies: one for unit, one in level.units}
    there: list[int] = list(level.start)
    root = given.root_of(level.start)
    for placed in scheduled(units, level.start, root, _before(given, units), given.holding):
        unit = placed.of
        yield from steps_of(given, inner[unit.bodies])
        yield Step(unit.bodies, tuple(sorted(there)), unit.way, placed.down, placed.hand, root)
        there += unit.bodies


def _before(given: Constraints, units: Sequence[Coming]) -> NDArray[np.bool_]:
    """Which unit comes before which: by what bars its way, then by what fastens it and by its tool."""
    count = len(units)
    barred = np.zeros((count, count), dtype=bool)
    for i, one in enumerate(units):
        met = np.any([given.table.row(k, -np.array(one.way)) for k in one.bodies], axis=0)
        barred[i] = [i != j and bool(met[list(two.bodies)].any()) for j, two in enumerate(units)]
    of = {k: i for i, unit in enumerate(units) for k in unit.bodies}
    wishes = [(of[one], of[two]) for one, two in _wishes(given, units) if one in of and two in of]
    return precedence(count, barred, wishes)


def _late(given: Constraints, units: Sequence[Coming]) -> Iterator[tuple[int, int]]:
    """Coupling, motor and base plate after the rest: a shaft is aligned as it stands in both bearings."""
    late = [unit for unit in units if given.last.intersection(unit.bodies)]
    early = [unit for unit in units if unit not in late]
    yield from ((one.bodies[0], two.bodies[0]) for two in late for one in early)


def _wishes(given: Constraints, units: Sequence[Coming]) -> Iterator[tuple[int, int]]:
    """Pairs of bodies: the first should be there before the second comes."""
    for joint in given.joints:
        if joint.what.head:
            held = (joint.holder, *(k for k, _ in joint.clamped))
            yield from ((k, joint.screw) for k in held)
    yield from ((int(i), int(j)) for i, j in np.argwhere(given.clamped))
    yield from _late(given, units)
    alone = {unit.bodies[0] for unit in units if len(unit.bodies) == 1}
    tight = [one.joins for one in given.holding.fastenings if one.kind in {"pressed", "bonded"}]
    fixed = alone & frozenset[int]().union(*tight)
    bushes = {k for k in fixed if given.seats.is_bush(k)}
    running = [one for one in given.seats.matches if given.seats.kind(one) is None]
    # A mandrel goes through a bush that is pressed in; a pin is pressed in before anything runs on it.
    yield from ((one.hole, one.pin) for one in running if one.hole in bushes)
    yield from ((one.pin, one.hole) for one in running if one.pin in fixed)
    for unit in units:
        if len(unit.bodies) == 1 and given.reach.needs_tool(unit.bodies[0]):
            (k,) = unit.bodies
            yield from ((k, other) for other in given.reach.always_in_the_way(k, np.array(unit.way)))
