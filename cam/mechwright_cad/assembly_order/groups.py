"""Bodies that belong together: those that move as one and touch."""

import math
from collections.abc import Iterable, Sequence
from itertools import combinations

import numpy as np
import shapely
from manifold3d import Manifold

from mechwright.arrays import Array
from mechwright.contracts.bodies import rigid
from mechwright.contracts.joint import GROUND
from mechwright.contracts.motion import Motion
from mechwright.standards import bearings
from mechwright_cad.assembly_order.layers import UP, Layer, layers_of, mesh_points
from mechwright_cad.bodies import Body, is_carriage
from mechwright_cad.interference.surface import Surface

TOUCHING = 0.1
"""Bodies nearer to each other than this, mm, touch: less than any clearance that is meant to be one."""


class BodyLayers:
    """The layers of all bodies where they stand at a sample, seen from above; and which of them touch."""

    def __init__(self, bodies: Sequence[Body], sample: int) -> None:
        found = [layers_of(body, sample, UP) for body in bodies]
        self._layers = [layers or (_box(body, sample),) for body, layers in zip(bodies, found, strict=True)]
        self._bodies, self._sample = bodies, sample
        self._meshes = frozenset(k for k, one in enumerate(found) if one is None)
        self._solids: dict[int, Manifold] = {}
        self._boxes = [_box_of(layers) for layers in self._layers]
        self._known: dict[tuple[int, int], bool] = {}

    def box(self, number: int) -> Array:
        """The least and the greatest corner (2, 3) of the box round a body, mm."""
        return self._boxes[number]

    def touch(self, one: int, two: int) -> bool:
        """Whether two bodies, by number, are nearer than ``TOUCHING``; each pair is looked at once."""
        pair = (min(one, two), max(one, two))
        if pair not in self._known:
            self._known[pair] = self._look(*pair, TOUCHING)
        return self._known[pair]

    def layered(self, number: int) -> bool:
        """Whether a body has layers of its own; else its only one is its box."""
        return number not in self._meshes

    def layers(self, number: int) -> Sequence[Layer]:
        """Of a body, by number."""
        return self._layers[number]

    def within(self, one: int, two: int, gap: float) -> bool:
        """Whether bodies are nearer than a gap, mm; of meshes ``TOUCHING`` at least, by their chords."""
        return self._look(one, two, gap)

    def distance(self, one: int, two: int) -> float:
        """Of two bodies, mm, by their meshes where one has no layers."""
        if one in self._meshes or two in self._meshes:
            corners = np.concatenate([self.box(one), self.box(two)])
            reach = float(np.linalg.norm(np.ptp(corners, axis=0)))
            return float(self.solid(one).min_gap(self.solid(two), reach))
        return min(
            math.hypot(max(a.low - b.high, b.low - a.high, 0.0), shapely.distance(a.shape, b.shape))
            for a in self._layers[one]
            for b in self._layers[two]
        )

    def solid(self, number: int) -> Manifold:
        """A body where it stands, as the library for booleans has it."""
        if number not in self._solids:
            self._solids[number] = Surface(*mesh_points(self._bodies[number], self._sample)).manifold
        return self._solids[number]

    def _look(self, one: int, two: int, gap: float) -> bool:
        a, b = self.box(one), self.box(two)
        if one in self._meshes or two in self._meshes:
            gap = max(gap, TOUCHING)
        if (a[0] > b[1] + gap).any() or (b[0] > a[1] + gap).any():
            return False
        if one in self._meshes or two in self._meshes:
            first, second = self.solid(one), self.solid(two)
            return bool(first.min_gap(second, 2 * gap) < gap)
        return any(
            first.low <= second.high + gap
            and second.low <= first.high + gap
            and shapely.dwithin(first.shape, second.shape, gap)
            for first in self._layers[one]
            for second in self._layers[two]
        )


def _box_of(layers: Sequence[Layer]) -> Array:
    x0, y0, x1, y1 = shapely.total_bounds([layer.shape for layer in layers])
    return np.array(((x0, y0, layers[0].low), (x1, y1, max(layer.high for layer in layers))))


def _box(body: Body, sample: int) -> Layer:
    """A body of any form: all that its box holds."""
    points, _ = mesh_points(body, sample)
    (x0, y0, low), (x1, y1, high) = points.min(axis=0), points.max(axis=0)
    return Layer(shapely.box(x0, y0, x1, y1), float(low), float(high))


def connected(members: Iterable[int], bond: "Sequence[tuple[int, int]]") -> list[tuple[int, ...]]:
    """The members in sets that bonds hold together, each in order.

    >>> connected((1, 2, 3), [(1, 3)])
    [(1, 3), (2,)]
    """
    head = {member: member for member in members}
    for one, two in bond:
        if one in head and two in head:
            first, second = head[one], head[two]
            low, high = min(first, second), max(first, second)
            head = {member: low if of == high else of for member, of in head.items()}
    found: dict[int, list[int]] = {}
    for member, of in head.items():
        found.setdefault(of, []).append(member)
    return [tuple(sorted(those)) for those in found.values()]


def bonds(bodies: Sequence[Body], motion: Motion, standing: BodyLayers) -> list[tuple[int, int]]:
    """Pairs of bodies that move as one and touch.

    A ball bearing counts with the shaft that it is put on. The carriage of a linear guide counts with its
    rail, and the screws in its threads by themselves: what it carries comes onto it before they do.
    """
    rigidly = rigid(motion)
    heads = [rigidly[body.instance.body] for body in bodies]
    moving = [k for k, head in enumerate(heads) if head != GROUND]
    for k in [k for k, body in enumerate(bodies) if is_bearing(body)]:
        heads[k] = next((heads[m] for m in moving if m != k and standing.touch(k, m)), heads[k])
    for k in [k for k, body in enumerate(bodies) if is_carriage(body.part)]:
        screws = [m for m in moving if heads[m] == heads[k] and _is_screw(bodies[m]) and standing.touch(k, m)]
        heads[k] = GROUND
        for m in screws:
            heads[m] = bodies[m].name
    return [
        (one, two)
        for one, two in combinations(range(len(bodies)), 2)
        if heads[one] == heads[two] and standing.touch(one, two)
    ]


def _is_screw(body: Body) -> bool:
    """Whether it is a screw with a head."""
    return body.part.bought is not None and body.part.bought.standard == "ISO 4762"


def is_bearing(body: Body) -> bool:
    """Whether it is a ball bearing: its inner ring sits tight on a shaft."""
    return body.part.bought is not None and body.part.bought.standard == bearings.STANDARD
