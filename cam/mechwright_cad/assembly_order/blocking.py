"""Which body stops which after a small move: what a pin in its bore, or a plate on a shoulder, does."""

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np
import shapely
from manifold3d import Manifold
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.mechanics.mating.rounds import PARALLEL
from mechwright_cad.assembly_order.barred import SKIN
from mechwright_cad.assembly_order.groups import BodyLayers
from mechwright_cad.assembly_order.layers import LEVEL, Layer
from mechwright_cad.bodies import Body

MOVE = 1.0
"""How far a body is moved in thought, mm: more than any axial play of a seat."""

BITE = 0.5
"""Volume, mm³, by which two meshes have to overlap more after the move: less is the noise of facets."""


class Blocking:
    """Which body blocks which, for all bodies of an assembly where they stand; each pair is asked once."""

    def __init__(self, bodies: Sequence[Body], standing: BodyLayers) -> None:
        self.bodies, self.standing = tuple(bodies), standing
        self._known: dict[tuple[int, int, tuple[float, ...]], bool] = {}
        self._slim: dict[int, list[Layer]] = {}

    @cached_property
    def neighbours(self) -> list[list[int]]:
        """For each body those whose boxes are not farther away than the move."""
        boxes = np.array([self.standing.box(k) for k in range(len(self.bodies))])
        low, high = boxes[:, 0], boxes[:, 1]
        near: NDArray[np.bool_] = np.logical_and(
            (low[:, None] <= high[None] + MOVE).all(axis=2), (low[None] <= high[:, None] + MOVE).all(axis=2)
        )
        np.fill_diagonal(near, val=False)
        return [np.flatnonzero(row).tolist() for row in near]

    def blocks(self, one: int, two: int, way: Array) -> bool:
        """Whether body ``one`` would meet body ``two`` if it moved along a unit vector (3,)."""
        key = (one, two, tuple(way.round(6).tolist()))
        if key not in self._known:
            self._known[key] = self._look(one, two, way)
        return self._known[key]

    def _look(self, one: int, two: int, way: Array) -> bool:
        a, b = self.standing.box(one), self.standing.box(two)
        shift = MOVE * way
        if ((np.maximum(a[0], a[0] + shift) > b[1]) | (b[0] > np.maximum(a[1], a[1] + shift))).any():
            low, high = np.minimum(a[0], a[0] + shift), np.maximum(a[1], a[1] + shift)
            if (low > b[1]).any() or (b[0] > high).any():
                return False
        level = abs(way[2]) < PARALLEL or abs(way[2]) > 1 - PARALLEL
        if level and self.standing.layered(one) and self.standing.layered(two):
            return self._layers_meet(one, two, shift)
        return self._meshes_meet(one, two, shift)

    def _layers_meet(self, one: int, two: int, shift: Array) -> bool:
        upright = abs(shift[2]) > 0
        for a in self._passing(one):
            shape = a.shape if upright else shapely.transform(a.shape, lambda p: p + shift[:2])
            low, high = (
                (min(a.low, a.low + shift[2]), max(a.high, a.high + shift[2])) if upright else (a.low, a.high)
            )
            for b in self.standing.layers(two):
                if b.low < high - LEVEL and low + LEVEL < b.high and shapely.intersects(shape, b.shape):
                    if upright and a.low < b.high - LEVEL and b.low + LEVEL < a.high:
                        continue  # they overlap where they stand: teeth, or chords of one thread
                    return True
        return False

    def _passing(self, number: int) -> list[Layer]:
        if number not in self._slim:
            self._slim[number] = [
                replace(one, shape=shapely.buffer(one.shape, -SKIN, join_style="mitre"))
                for one in self.standing.layers(number)
            ]
        return self._slim[number]

    def _meshes_meet(self, one: int, two: int, shift: Array) -> bool:
        mine, theirs = self.standing.solid(one), self.standing.solid(two)
        moved: Manifold = mine.translate(shift.tolist()) ^ theirs
        overlap = float(moved.volume())
        return overlap > BITE and overlap > float((mine ^ theirs).volume()) + BITE
