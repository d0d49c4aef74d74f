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
    bench = _Bench(units, root, before, holding, frozenset(start))
    while bench.left:
        yield bench.put(min(bench.ready(), key=bench.worth))


class _Bench:
    """What is there already, how it lies, what is held by hand, and what is left to come."""

    def __init__(
        self,
        units: Sequence[Coming],
        root: int,
        before: NDArray[np.bool_],
        holding: Holding,
        there: frozenset[int],
    ) -> None:
        self.units, self.root, self.before, self.holding = units, root, before, holding
        self.there, self.left = there, list(range(len(units)))
        self._down = UPRIGHT[0]
        self._last: Coming | None = None
        self._hand: tuple[int, ...] = ()
        self._unretained = 0

    def ready(self) -> list[int]:
        """Units that nothing which is left has to precede."""
        return [k for k in self.left if not self.before[self.left, k].any()]

    def put(self, k: int) -> Placed:
        """A unit is put in its place."""
        unit = self.units[k]
        self.there = self.there.union(unit.bodies)
        self._down, falling = self.holding.down(self.there, self.root, self._down, unit.way)
        self._hand = tuple(sorted(number for one in falling for number in one))
        placed = Placed(unit, self._down, self._hand)
        if len(falling) > 1:
            # Two hands are needed as it lies: it is laid on its side for this step if one is enough there.
            side, fewer = self.holding.on_its_side(self.there, self.root)
            if len(fewer) < min(len(falling), 2):
                placed = Placed(unit, side, tuple(sorted(number for one in fewer for number in one)))
        self._unretained = len(self.holding.unretained(self.there, self.root))
        self._last = unit
        self.left.remove(k)
        return placed

    def worth(self, k: int) -> tuple[object, ...]:
        """How good a unit is as the next one; the least is the best."""
        unit = self.units[k]
        after = self.there.union(unit.bodies)
        lies, falling = self.holding.down(after, self.root, self._down, unit.way)
        steps = self._steps_until_retained(k, after, lies) if falling else 0
        last = self._last
        copy = not falling and last is not None and (last.alike, last.way) == (unit.alike, unit.way)
        fastens = not copy and len(unit.bodies) == 1 and unit.bodies[0] in self.holding.fastened
        helps = fastens and len(self.holding.unretained(after, self.root)) < self._unretained
        locates = not falling and self.holding.is_dowel(unit.bodies)
        held = steps if self._hand else max(steps - 1, 0)
        return len(falling) > 1, held, not copy, not locates, not helps, k

    def _steps_until_retained(self, chosen: int, there: frozenset[int], down: Way) -> int:
        """After how many more units nothing falls any more, at best; one more than there are if never."""
        left = [k for k in self.left if k != chosen]
        least = len(left) + 1
        for k in left:
            needed = [m for m in left if m == k or self.before[m, k]]
            if len(needed) < least:
                after = there.union(*(self.units[m].bodies for m in needed))
                if not self.holding.falling(after, self.root, down):
                    least = len(needed)
        return least
