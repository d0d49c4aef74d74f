"""What holds each body at a step: fastened, captive, resting, or nothing.

Glossary
--------
unit
    Bodies that fastenings make one.
ground
    The unit of the body that all goes onto.
held
    A unit is held if it is the ground, or if others stop it whichever way it is moved.
resting
    A unit that is not held rests if others carry it: it cannot sink, and its centre of volume stands over the
    area that it touches, or others stop it on all sides.
falling
    A unit that neither is held nor rests, not even on one that a hand holds: a fitter has to hold it by hand.
"""

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import cached_property

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.mechanics.mating.rounds import PARALLEL
from mechwright.standards import dowels
from mechwright_cad.assembly_order.blocking import Blocking
from mechwright_cad.assembly_order.fastenings import Fastening
from mechwright_cad.assembly_order.groups import TOUCHING
from mechwright_cad.assembly_order.layers import frame_of
from mechwright_cad.bodies import is_spring

Unit = frozenset[int]
Way = tuple[float, float, float]

UPRIGHT: tuple[Way, ...] = ((0.0, 0.0, -1.0), (0.0, 0.0, 1.0))

LEVEL_WAYS: tuple[Way, ...] = ((1.0, 0.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, -1.0, 0.0))
"""Ways that look to the floor where an assembly lies on its side: it does if else two units fall."""

STRAIGHT = 0.999
"""Greatest coordinate of a way from which on an assembly is turned to have it downwards."""

FOOTING = 0.25
"""Share of the box round the ground that the feet under it span at least: on less it topples."""

_SIDES: tuple[Way, ...] = tuple(
    (float(np.cos(turn)), float(np.sin(turn)), 0.0) for turn in np.linspace(0.0, 2 * np.pi, 8, endpoint=False)
)


class Holding:
    """What holds the bodies of an assembly, for any of them that are there already.

    ``ways`` are those along which bodies are put on; each is also tried as a way to leave.
    """

    def __init__(
        self, blocking: Blocking, fastenings: Sequence[Fastening], ways: Mapping[int, Sequence[Way]]
    ) -> None:
        self.blocking, self.fastenings, self.ways = blocking, tuple(fastenings), ways
        self.fastened = frozenset[int]().union(*(one.needs for one in self.fastenings))
        self._units: dict[frozenset[int], dict[int, Unit]] = {}
        self._balanced: dict[tuple[Unit, frozenset[int], float], bool] = {}
        self._areas: dict[tuple[int, int], shapely.Geometry] = {}
        self._falling: dict[tuple[frozenset[int], int, Way], tuple[Unit, ...]] = {}

    def units(self, there: frozenset[int]) -> dict[int, Unit]:
        """Each body that is there to the unit that it belongs to."""
        if there not in self._units:
            head = {k: k for k in there}

            def find(k: int) -> int:
                while head[k] != k:
                    head[k] = k = head[head[k]]
                return k

            for one in self.fastenings:
                if one.needs <= there:
                    first, *rest = (find(k) for k in one.joins & there)
                    for other in rest:
                        head[find(other)] = find(first)
            made: dict[int, set[int]] = {}
            for k in there:
                made.setdefault(find(k), set()).add(k)
            self._units[there] = {k: frozenset(unit) for unit in made.values() for k in unit}
        return self._units[there]

    def falling(self, there: frozenset[int], root: int, down: Way) -> tuple[Unit, ...]:
        """Units that neither are held nor rest, where ``down`` looks to the floor."""
        key = (there, root, down)
        if key not in self._falling:
            units, way = self.units(there), np.array(down)
            ground = units[root]
            others = [
                unit
                for unit in sorted(set(units.values()), key=min)
                if unit != ground and not self._is_spring(unit)
            ]
            lying = [unit for unit in others if self._carries(unit, there, ground, way)]
            bearing = frozenset((ground, *lying))
            falls = [
                unit for unit in others if unit not in bearing and not self._rests(unit, units, bearing, way)
            ]
            self._falling[key] = tuple(sorted(self._by_hand(falls, units, bearing, way), key=min))
        return self._falling[key]

    def _by_hand(
        self, falls: Sequence[Unit], units: Mapping[int, Unit], bearing: frozenset[Unit], down: Array
    ) -> Iterator[Unit]:
        """Of units that fall those to hold, so that the others rest on them: each as good as the next."""
        left = list(falls)
        while left:
            tried = {unit: self._left(left, unit, units, bearing, down) for unit in left}
            best = min(left, key=lambda unit: (len(tried[unit]), min(unit)))
            yield best
            left, bearing = tried[best], bearing | {best}

    def _left(
        self,
        falls: Sequence[Unit],
        held: Unit,
        units: Mapping[int, Unit],
        bearing: frozenset[Unit],
        down: Array,
    ) -> list[Unit]:
        """Units that fall though a hand holds one of them."""
        if len(falls) == 1:
            return []
        bearing = bearing | {held}
        return [unit for unit in falls if unit != held and not self._rests(unit, units, bearing, down)]

    def down(self, there: frozenset[int], root: int, down: Way, way: Way) -> tuple[Way, tuple[Unit, ...]]:
        """Which way is down for a step along ``way``, and what falls then.

        The assembly stays as it lies if nothing falls. Else it is turned so that what comes goes downwards if
        no more falls then, or upright if nothing does. What falls is held by hand.
        """
        falling = self.falling(there, root, down)
        if not falling:
            return down, ()
        straight = max(abs(x) for x in way) > STRAIGHT
        for tried in dict.fromkeys((*((way,) if straight else ()), *UPRIGHT)):
            found = self.falling(there, root, tried)
            upright = tried == way and abs(way[2]) > STRAIGHT
            if not found or (upright and len(found) <= len(falling)):
                down, falling = tried, found
                break
        return down, falling

    def on_its_side(self, there: frozenset[int], root: int) -> tuple[Way, tuple[Unit, ...]]:
        """The side on which an assembly can lie so that the least falls, and what does."""
        sides = {side: self.falling(there, root, side) for side in LEVEL_WAYS}
        best = min(LEVEL_WAYS, key=lambda side: len(sides[side]))
        return best, sides[best]

    def unretained(self, there: frozenset[int], root: int) -> list[Unit]:
        """Units that are not held: some way is free to each of them."""
        return [unit for unit, _ in self.free(there, root)]

    def free(self, there: frozenset[int], root: int) -> Iterator[tuple[Unit, Way]]:
        """Units that are not held, each with the first way that is free to it."""
        units = self.units(there)
        ground = units[root]
        for unit in sorted(set(units.values()), key=min):
            if unit != ground and not self._hooked(unit):
                ways = (way for way in self._tried(unit) if not self._stopped(unit, units, {ground}, way))
                way = next(ways, None)
                if way is not None:
                    x, y, z = way.tolist()
                    yield unit, (x, y, z)

    def is_dowel(self, unit: Sequence[int]) -> bool:
        """Whether it is a dowel pin: one comes as soon as the parts that it sets to each other are there."""
        bought = [self.blocking.bodies[k].part.bought for k in unit]
        return all(one is not None and one.standard in dowels.STANDARDS for one in bought)

    def _hooked(self, unit: Unit) -> bool:
        """Whether it is a spring between two bodies: its pull keeps both hooks on their pins."""
        beside = {other for k in unit for other in self.blocking.neighbours[k]} - set(unit)
        return self._is_spring(unit) and len(beside) > 1

    def _is_spring(self, unit: Unit) -> bool:
        """Whether it is a spring, which hangs by a hook until the other one is on its pin."""
        return all(is_spring(self.blocking.bodies[k].part) for k in unit)

    def _tried(self, unit: Unit) -> Iterator[Array]:
        seen = dict.fromkeys((*UPRIGHT, *_SIDES))
        for k in unit:
            for way in self.ways.get(k, ()):
                seen |= dict.fromkeys((way, (-way[0], -way[1], -way[2])))
        return (np.array(way) for way in seen)

    def _stopped(self, unit: Unit, units: Mapping[int, Unit], bearing: Collection[Unit], way: Array) -> bool:
        """Whether a unit that moves along a way meets one that bears it, or pushes others against one."""
        waiting, seen = [unit], {unit}
        while waiting:
            for k in waiting.pop():
                for other in self.blocking.neighbours[k]:
                    met = units.get(other)
                    if met is None or met in seen or not self.blocking.blocks(k, other, way):
                        continue
                    if met in bearing:
                        return True
                    seen.add(met)
                    waiting.append(met)
        return False

    def _rests(self, unit: Unit, units: Mapping[int, Unit], bearing: Collection[Unit], down: Array) -> bool:
        if not self._stopped(unit, units, bearing, down):
            return False
        u, v, _ = frame_of(down)
        if all(self._stopped(unit, units, bearing, way) for way in (u, -u, v, -v)):
            return True
        under = frozenset(
            other for k in unit for other in self.blocking.neighbours[k] if units.get(other, unit) != unit
        )
        key = (unit, under, float(down[2]))
        if key not in self._balanced:
            area = self._touched(unit, under, down)
            balanced = area is None or shapely.covers(shapely.convex_hull(area), self._centre(unit))
            self._balanced[key] = bool(balanced)
        return self._balanced[key]

    def carries(self, there: frozenset[int], root: int, some: Iterable[int]) -> bool:
        """Whether some bodies are units of their own that lie on the bench, upright, under all others."""
        units, those = self.units(there), frozenset(some)
        ground, down = units[root], np.array(UPRIGHT[0])
        own = {units[k] for k in those if units[k] <= those}
        return any(unit != ground and self._carries(unit, there, ground, down) for unit in own)

    def _carries(self, unit: Unit, there: frozenset[int], ground: Unit, down: Array) -> bool:
        """Whether a unit lies on the bench under all others, with the middle of the ground over its feet."""
        standing = self.blocking.standing
        if abs(down[2]) < 1 - PARALLEL or not all(standing.layered(k) for k in unit):
            return False
        at = 0 if down[2] < 0 else 1
        ends = {k: float(down[2] * standing.box(k)[at, 2]) for k in there}
        lowest = max(ends.values())
        feet = [k for k in unit if ends[k] > lowest - TOUCHING]
        if not feet or max(ends[k] for k in there - unit) > lowest - TOUCHING:
            return False
        corners = np.array([standing.box(k)[:, :2] for k in ground])
        area = shapely.union_all([shapely.box(*standing.box(k)[:, :2].ravel()) for k in feet])
        hull = shapely.convex_hull(area)
        whole = shapely.box(*np.concatenate((corners[:, 0].min(axis=0), corners[:, 1].max(axis=0))))
        return bool(hull.area >= FOOTING * whole.area and shapely.covers(hull, self._centre(ground)))

    def _touched(self, unit: Unit, under: frozenset[int], down: Array) -> shapely.Geometry | None:
        """The area on which a unit lies on others, seen from above; None where it is not known."""
        standing = self.blocking.standing
        if abs(down[2]) < 1 - PARALLEL or not all(standing.layered(k) for k in unit | under):
            return None
        pairs = [(k, other) for k in unit for other in under & set(self.blocking.neighbours[k])]
        lying = [self._lies_on(*(pair if down[2] < 0 else pair[::-1])) for pair in pairs]
        return shapely.union_all(lying)

    def _lies_on(self, one: int, two: int) -> shapely.Geometry:
        """The area of two layered bodies on which the first lies on the second."""
        if (one, two) not in self._areas:
            standing = self.blocking.standing
            self._areas[one, two] = shapely.union_all(
                [
                    shapely.intersection(a.shape, b.shape)
                    for a in standing.layers(one)
                    for b in standing.layers(two)
                    if abs(a.low - b.high) < TOUCHING
                ]
            )
        return self._areas[one, two]

    def _centre(self, unit: Unit) -> shapely.Point:
        centres = np.array([self._centres[k] for k in unit])
        x, y = (centres[:, :2] * centres[:, 2:]).sum(axis=0) / centres[:, 2].sum()
        return shapely.Point(x, y)

    @cached_property
    def _centres(self) -> list[tuple[float, float, float]]:
        """Centre of each body seen from above, mm, and its volume, mm³."""
        found = []
        for k in range(len(self.blocking.bodies)):
            layers = self.blocking.standing.layers(k)
            volumes = np.array([one.shape.area * (one.high - one.low) for one in layers])
            centres = np.array([(one.shape.centroid.x, one.shape.centroid.y) for one in layers])
            x, y = (centres * volumes[:, None]).sum(axis=0) / volumes.sum()
            found.append((float(x), float(y), float(volumes.sum())))
        return found
