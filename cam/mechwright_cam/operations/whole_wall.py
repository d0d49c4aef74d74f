"""Finishing a wall with tabs in one go: from the top of the plate to its underside, lifted over the tabs.

Roughing goes by layers, above and below the tops of the tabs. A finishing pass that goes below them runs over
each tab at the height of its top, and goes down slowly behind it, where nothing but the allowance of the wall
stands in the way.
"""

from dataclasses import replace

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.geometry.prepared import prepared
from mechwright_cam.operations.finishing import Finishing
from mechwright_cam.operations.pen import Pen
from mechwright_cam.operations.stock import Stock
from mechwright_cam.operations.zone import Zone
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool
from mechwright_plane.leads import best_start, lead_shapes
from mechwright_plane.offsets import ROUGH, grow
from mechwright_plane.path import Path

FINELY = 0.02
"""Distance of the places of a path that are asked whether they are over a tab, mm: it gets wider by that."""
BESIDE = 2.0
"""So many radii beside a tab a mill is fed as for a full cut: roughing leaves more there."""


class WholeWall(Finishing):
    """The finishing of an outside with both its layers: above and below the tops of tabs that stay whole."""

    def __init__(
        self, upper: tuple[Zone, Stock], lower: tuple[Zone, Stock], job: Job, tool: Tool, step_down: float
    ) -> None:
        (above, left), (below, more) = upper, lower
        zone = replace(above, bottom=below.bottom, below=below.below)
        stock = replace(more, left=shapely.union(left.left, more.left))
        super().__init__(zone, stock, job, tool, step_down)
        tabs, away = below.tabs or shapely.Polygon(), self.radius + zone.path.bias
        self.over = prepared(grow(tabs, away))
        self.beside = prepared(grow(tabs, away + BESIDE * self.radius, ROUGH))
        self.height = below.top
        self.free = prepared(shapely.difference(self.free, grow(tabs, away, ROUGH)))
        self._parts: dict[Path, list[tuple[Path, bool, bool]]] = {}

    def fits(self) -> bool:
        """Whether all its ways lead once round and have room for leads off the tabs."""
        shapes, climb = lead_shapes(self.tool.radius, self.settings.stock_to_leave), self.settings.climb
        found = self._pieces()
        return bool(found) and all(
            piece.closed
            and best_start(piece.points, shapes, climb, self._is_free, self._is_clear, self._may_run)
            is not None
            for piece in found
        )

    def _follow(self, pen: Pen, path: Path, z: float, *, again: bool) -> None:
        """Over the tabs at their height, and beside them at that of the pass."""
        if z >= self.height:
            super()._follow(pen, path, z, again=again)
            return
        inside = 1 if self.settings.climb else -1
        for part, over, beside in self._divided(path):
            # Behind a tab nothing stands in a way that was made before.
            if over:
                pen.sink(self.height, pen.air_down)
            else:
                pen.sink(z, pen.air_down if again else pen.rates.plunge)
            pen.follow(part, pen.rates.full if beside else self._feed(pen, again=again), inside)

    def _divided(self, path: Path) -> list[tuple[Path, bool, bool]]:
        """A path in parts, each with whether it is over a tab, and whether it is beside or over one."""
        known = self._parts.get(path)
        if known is None:
            known = self._parts[path] = self._divide(path)
        return known

    def _divide(self, path: Path) -> list[tuple[Path, bool, bool]]:
        points = path.points(FINELY)
        way = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))))
        way *= path.length / way[-1]
        over, beside = (self._touch(points, shape) for shape in (self.over, self.beside))
        changes = np.flatnonzero((np.diff(over) != 0) | (np.diff(beside) != 0))
        parts: list[tuple[Path, bool, bool]] = []
        rest, done = path, 0.0
        for index in [*changes.tolist(), len(way) - 1]:
            # A part over a tab begins at the last place before it.
            part, rest = (rest, rest) if index == len(way) - 1 else rest.split(float(way[index]) - done)
            if part.cuts:
                parts.append((part, bool(over[index]), bool(beside[index])))
                done += part.length
        return parts

    @staticmethod
    def _touch(points: Array, shape: shapely.Geometry) -> Array:
        """Whether each edge before a point meets a shape, (n,)."""
        inside = shapely.contains_xy(shape, points[:, 0], points[:, 1])
        # The last place before and the first behind a tab belong to it.
        grown = inside | np.append(inside[1:], inside[-1:]) | np.append(inside[:1], inside[:-1])
        found: Array = grown
        return found
