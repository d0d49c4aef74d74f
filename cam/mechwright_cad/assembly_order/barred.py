"""Which body bars the way of which."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import permutations

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.standards.circlips import IN_BORES, ON_SHAFTS, bore_circlips, shaft_circlips
from mechwright_cad.assembly_order.heights import Heights
from mechwright_cad.assembly_order.layers import LEVEL, ROUND, Layer, frame_of, layers_of, mesh_points
from mechwright_cad.bodies import Body

SKIN = 0.03
"""What passes, mm: a fit without clearance, and the chords of both."""

SPRUNG = {ON_SHAFTS: shaft_circlips, IN_BORES: bore_circlips}
"""Standards of rings that are spread or squeezed on their way."""


class Ways:
    """Who bars whom, for all bodies of an assembly at one sample; each way is looked at once."""

    def __init__(self, bodies: Sequence[Body], sample: int) -> None:
        self.bodies, self.sample = tuple(bodies), sample
        self._known: dict[tuple[float, ...], NDArray[np.bool_]] = {}
        self._rows: dict[tuple[int, tuple[float, ...]], NDArray[np.bool_]] = {}
        self._boxes: tuple[tuple[float, ...], list[Array]] = ((), [])
        self._seen: dict[int, Heights] = {}

    def row(self, number: int, way: Array) -> NDArray[np.bool_]:
        """Row (n,) of :meth:`barred` for one body, without the others where they have not been asked."""
        key = tuple(way.round(9).tolist())
        if key in self._known:
            row: NDArray[np.bool_] = self._known[key][number]
            return row
        if (number, key) not in self._rows:
            self._rows[number, key] = self._row(number, way)
        return self._rows[number, key]

    def _row(self, number: int, way: Array) -> NDArray[np.bool_]:
        mine = layers_of(self.bodies[number], self.sample, way)
        goes = self._passing(self.bodies[number], mine)
        boxes = self._across(way)
        row = np.zeros(len(self.bodies), dtype=bool)
        for j, other in enumerate(self.bodies):
            beside = (boxes[j][1, :2] <= boxes[number][0, :2]) | (boxes[number][1, :2] <= boxes[j][0, :2])
            if j == number or beside.any() or boxes[j][1, 2] < boxes[number][0, 2]:
                continue
            theirs = layers_of(other, self.sample, way)
            if mine is not None and theirs is not None:
                row[j] = _bars(theirs, goes)
            else:
                for k in {number, j} - self._seen.keys():
                    self._seen[k] = self._heights(self.bodies[k], way)
                row[j] = self._seen[j].bars(self._seen[number].slim())
        return row

    def _across(self, way: Array) -> list[Array]:
        """Boxes (2, 3) of all bodies in the frame of a way; what is known of another way is forgotten."""
        key = tuple(way.round(9).tolist())
        if self._boxes[0] != key:
            self._seen = {}
            points = [mesh_points(body, self.sample)[0] @ frame_of(way).T for body in self.bodies]
            self._boxes = (key, [np.array((one.min(axis=0), one.max(axis=0))) for one in points])
        return self._boxes[1]

    def barred(self, way: Array) -> NDArray[np.bool_]:
        """A table (n, n): whether body i, going along a way, would meet body j."""
        key = tuple(way.round(9).tolist())
        if key not in self._known:
            self._known[key] = self._look(way)
        return self._known[key]

    def _look(self, way: Array) -> NDArray[np.bool_]:
        layers = [layers_of(body, self.sample, way) for body in self.bodies]
        goes = [self._passing(body, found) for body, found in zip(self.bodies, layers, strict=True)]
        count = len(self.bodies)
        table = np.zeros((count, count), dtype=bool)
        for i, j in permutations(range(count), 2):
            one, two = layers[i], layers[j]
            if one is not None and two is not None:
                table[i, j] = _bars(two, goes[i])
        unlike = [k for k in range(count) if layers[k] is None]
        heights = [self._heights(body, way) for body in self.bodies] if unlike else []
        slim = [one.slim() for one in heights]
        for i, j in permutations(range(count), 2):
            if i in unlike or j in unlike:
                table[i, j] = heights[j].bars(slim[i])
        return table

    def _heights(self, body: Body, way: Array) -> Heights:
        points, triangles = mesh_points(body, self.sample)
        return Heights.of(points @ frame_of(way).T, triangles)

    @staticmethod
    def _passing(body: Body, layers: Sequence[Layer] | None) -> list[Layer]:
        return [replace(layer, shape=_slim(_sprung(body, layer.shape))) for layer in layers or ()]


def _bars(stands: Sequence[Layer], goes: Sequence[Layer]) -> bool:
    return any(
        other.high > one.low + LEVEL and shapely.intersects(one.shape, other.shape)
        for one in goes
        for other in stands
    )


def _slim(shape: shapely.Geometry) -> shapely.Geometry:
    return shapely.buffer(shape, -SKIN, join_style="mitre")


def _sprung(body: Body, shape: shapely.Geometry) -> shapely.Geometry:
    """A circlip as wide as it is on its way to the groove; anything else as it is."""
    bought = body.part.bought
    if bought is None or bought.standard not in SPRUNG or shape.is_empty:
        return shape
    size = float(bought.designation.split(" - ")[1].split(" x ")[0])
    disc = shapely.centroid(shape).buffer(size / 2, quad_segs=ROUND)
    outside = bought.standard == ON_SHAFTS
    return shapely.difference(shape, disc) if outside else shapely.intersection(shape, disc)
