"""Which body bars the way of which."""

from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property

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


Direction = tuple[float, ...]
"""A unit vector, rounded."""


class Ways:
    """Who bars whom, for all bodies of an assembly at one sample; each way is looked at once."""

    def __init__(self, bodies: Sequence[Body], sample: int) -> None:
        self.bodies, self.sample = tuple(bodies), sample
        self._rows: dict[tuple[int, Direction], NDArray[np.bool_]] = {}
        self._tables: dict[Direction, NDArray[np.bool_]] = {}
        self._last: tuple[Direction, _Across] | None = None

    @cached_property
    def _meshes(self) -> list[tuple[Array, NDArray[np.int64]]]:
        return [mesh_points(body, self.sample) for body in self.bodies]

    def row(self, number: int, way: Array) -> NDArray[np.bool_]:
        """A row (n,): whether the body of a number, going along a way, would meet each other body."""
        key = tuple(way.round(9).tolist())
        if (number, key) not in self._rows:
            if self._last is None or self._last[0] != key:
                self._last = key, _Across(self.bodies, self.sample, way, self._meshes)
            self._rows[number, key] = self._last[1].row(number)
        return self._rows[number, key]

    def barred(self, way: Array) -> NDArray[np.bool_]:
        """A table (n, n): whether body i, going along a way, would meet body j."""
        key = tuple(way.round(9).tolist())
        if key not in self._tables:
            self._tables[key] = np.array([self.row(number, way) for number in range(len(self.bodies))])
        return self._tables[key]


class _Across:
    """Bodies at one sample as they are seen along a way; each is looked at when it is first asked for."""

    def __init__(
        self,
        bodies: Sequence[Body],
        sample: int,
        way: Array,
        meshes: Sequence[tuple[Array, NDArray[np.int64]]],
    ) -> None:
        self.bodies, self.sample, self.way = bodies, sample, way
        self._seen = [points @ frame_of(way).T for points, _ in meshes]
        self._triangles = [triangles for _, triangles in meshes]
        self._layers: dict[int, Sequence[Layer] | None] = {}
        self._passing: dict[int, list[Layer]] = {}
        self._heights: dict[int, Heights] = {}
        self._slim: dict[int, Heights] = {}

    @cached_property
    def _boxes(self) -> tuple[Array, Array]:
        """Least and greatest corners (n, 3) of the bodies, mm; the third coordinate is along the way."""
        low, high = (np.array([end(one, axis=0) for one in self._seen]) for end in (np.min, np.max))
        return low, high

    def row(self, number: int) -> NDArray[np.bool_]:
        """Whether the body of a number would meet each other body, (n,)."""
        low, high = self._boxes
        beside = ((high[:, :2] <= low[number, :2]) | (high[number, :2] <= low[:, :2])).any(axis=1)
        near = ~beside & (high[:, 2] >= low[number, 2])
        near[number] = False
        row = np.zeros(len(self.bodies), dtype=bool)
        for other in np.flatnonzero(near).tolist():
            row[other] = self._meets(number, other)
        return row

    def _meets(self, goes: int, stands: int) -> bool:
        theirs = self.layers(stands)
        if self.layers(goes) is not None and theirs is not None:
            return _bars(theirs, self.passing(goes))
        return self.heights(stands).bars(self.slim(goes))

    def layers(self, number: int) -> Sequence[Layer] | None:
        """The layers of a body; None where it has none across the way."""
        if number not in self._layers:
            self._layers[number] = layers_of(self.bodies[number], self.sample, self.way)
        return self._layers[number]

    def passing(self, number: int) -> list[Layer]:
        """The layers of a body on its way: a little narrower, a circlip as wide as it then is."""
        if number not in self._passing:
            self._passing[number] = [
                replace(layer, shape=_slim(_sprung(self.bodies[number], layer.shape)))
                for layer in self.layers(number) or ()
            ]
        return self._passing[number]

    def heights(self, number: int) -> Heights:
        """The heights of a body."""
        if number not in self._heights:
            self._heights[number] = Heights.of(self._seen[number], self._triangles[number])
        return self._heights[number]

    def slim(self, number: int) -> Heights:
        """The heights of a body as it passes others."""
        if number not in self._slim:
            self._slim[number] = self.heights(number).slim()
        return self._slim[number]


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
