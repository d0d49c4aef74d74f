"""In which order the units of an assembly come, where geometry leaves a choice.

Which unit bars whose way is a partial order: every order that keeps to it can be followed. Of these is taken,
step by step, the unit after which nothing falls, then the one that fastens what is loose, then the first of
the disassembly. What can be held by hand until the next step fastens it may fall.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright_cad.assembly_order.holding import UPRIGHT, Holding, Way


@dataclass(frozen=True)
class Coming:
    """A unit that comes: numbers of its bodies, the way along which it goes, and what copies it has."""

    bodies: tuple[int, ...]
    way: Way
    alike: str


@dataclass(frozen=True)
class Placed:
    """A unit in its turn: which way is down then, and what has to be held by hand after it."""

    of: Coming
    down: Way
    hand: tuple[int, ...]


def precedence(count: int, barred: NDArray[np.bool_], wishes: Sequence[tuple[int, int]]) -> NDArray[np.bool_]:
    """A table (n, n), closed under transitivity: whether unit i has to come before unit j.

    Parameters
    ----------
    barred
        Whether i would be barred by j, had j come first.
    wishes
        Pairs (i, j): i should come before j. A wish against the table is dropped.
    """
    before = barred.copy()
    for k in range(count):
        before |= np.outer(before[:, k], before[k])
    for one, two in wishes:
        if one != two and not before[two, one] and not before[one, two]:
            earlier = before[:, one].copy()
            earlier[one] = True
            later = before[two].copy()
            later[two] = True
            before |= np.outer(earlier, later)
    return before


def scheduled(
    units: Sequence[Coming], start: Sequence[int], root: int, before: NDArray[np.bool_], holding: Holding
) -> Iterator[Placed]:
    """The units in their order, onto bodies that are there, of which ``root`` lies on the bench."""
    there, left, down = frozenset(start), list(range(len(units))), UPRIGHT[0]
    last: Coming | None = None
    hand: tuple[int, ...] = ()
    while left:
        loose = len(holding.loose(there, root))

        def worth(k: int) -> tuple[object, ...]:
            unit = units[k]
            after = there.union(unit.bodies)
            lies, falling = holding.down(after, root, down, unit.way)
            steps = 0
            if falling:
                others = [m for m in left if m != k]
                steps = _steps_until_held(units, others, before, holding, (after, root, lies))
            copy = not falling and last is not None and (last.alike, last.way) == (unit.alike, unit.way)
            fastens = not copy and len(unit.bodies) == 1 and unit.bodies[0] in holding.fastened
            helps = fastens and len(holding.loose(after, root)) < loose
            return len(falling) > 1, steps if hand else max(steps - 1, 0), not copy, not helps, k

        unit = units[min((k for k in left if not before[left, k].any()), key=worth)]
        there = there.union(unit.bodies)
        down, falling = holding.down(there, root, down, unit.way)
        hand = tuple(sorted(k for one in falling for k in one))
        left = [k for k in left if units[k] is not unit]
        last = unit
        yield Placed(unit, down, hand)


def _steps_until_held(
    units: Sequence[Coming],
    left: Sequence[int],
    before: NDArray[np.bool_],
    holding: Holding,
    state: tuple[frozenset[int], int, Way],
) -> int:
    """After how many more units nothing falls any more, at best; one more than there are if never."""
    there, root, down = state
    least = len(left) + 1
    for k in left:
        needed = [m for m in left if m == k or before[m, k]]
        if len(needed) < least:
            after = there.union(*(units[m].bodies for m in needed))
            if not holding.falling(after, root, down):
                least = len(needed)
    return least
