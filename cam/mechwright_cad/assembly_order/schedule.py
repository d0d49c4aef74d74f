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
        ready = [k for k in left if not any(before[m, k] for m in left)]
        loose = len(holding.loose(there, root))

        def worth(k: int) -> tuple[object, ...]:
            unit = units[k]
            after = there.union(unit.bodies)
            _, falling = holding.down(after, root, down, unit.way)
            copy = last is not None and last.alike == unit.alike and last.way == unit.way
            fastens = not copy and len(unit.bodies) == 1 and unit.bodies[0] in holding.fastened
            helps = fastens and len(holding.loose(after, root)) < loose
            rescued = not falling or any(
                not holding.down(after.union(units[m].bodies), root, down, units[m].way)[1]
                for m in left
                if m != k and not any(before[n, m] for n in left if n != k)
            )
            tight = hand and len(falling) >= 1
            return len(falling) > 1, bool(tight), not rescued, not copy, not helps, k

        chosen = min(ready, key=worth)
        unit = units[chosen]
        there = there.union(unit.bodies)
        down, falling = holding.down(there, root, down, unit.way)
        hand = tuple(sorted(k for one in falling for k in one))
        left.remove(chosen)
        last = unit
        yield Placed(unit, down, hand)
