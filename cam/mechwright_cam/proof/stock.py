"""Is there material where the tool goes now? Computed only for the few moves that need the answer."""

from functools import cached_property
from itertools import islice

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.geometry.prepared import prepared
from mechwright_cam.controls.reading.run import Ints, Kind
from mechwright_cam.proof.bands import stock_shape
from mechwright_cam.proof.paths import NEAR, Geometries, Paths
from mechwright_cam.proof.plane import Shape, grow
from mechwright_cam.setup.job import Job

TOUCH = 0.01
"""Material thinner than this in a tool's way is not met, mm: the leftover limit."""
MOST_TOLD = 100
"""So many rapids that meet material are enough to know of."""
TOGETHER = 32
"""Cuts that follow on each other and are looked for together."""
ACCURACY = 0.001
"""Accuracy of the shapes compared, mm: a tenth of ``TOUCH``."""


class Stock:
    """The plate while the program runs."""

    def __init__(self, paths: Paths, job: Job) -> None:
        self.paths = paths
        self.plate = shapely.difference(stock_shape(job), job.air_below(0.0))
        self.air = [air for air in job.gone if air.top < -NEAR]
        self.cuts: Ints = paths.cuts[paths.low[paths.cuts] < 0]

    @cached_property
    def extents(self) -> tuple[Array, Array]:
        """Least and greatest x and y (n, 2) of each of the cuts, mm."""
        return self.paths.extent(self.cuts)

    @cached_property
    def _tree(self) -> shapely.STRtree:
        """Rectangles around so many cuts at a time."""
        least, most = self.extents
        first = np.arange(0, self.cuts.size, TOGETHER)
        low, high = np.minimum.reduceat(least, first), np.maximum.reduceat(most, first)
        return shapely.STRtree(shapely.box(*low.T, *high.T))

    def _cuts_near(self, body: Shape, reach: float, before: int) -> Ints:
        """The steps that cut before a step, within ``reach`` of a shape."""
        least, most = self.extents
        group = np.sort(self._tree.query(body, predicate="dwithin", distance=reach + NEAR))
        index = (group[:, None] * TOGETHER + np.arange(TOGETHER)).ravel()
        index = index[index < np.searchsorted(self.cuts, before)]
        x0, y0, x1, y1 = shapely.bounds(body)
        apart = (least[index] > (x1 + reach, y1 + reach)) | (most[index] < (x0 - reach, y0 - reach))
        steps = self.cuts[index[~apart.any(axis=1)]]
        lines: Geometries = self.paths.lines(self.paths.whole(steps))
        body = prepared(body)
        near: Ints = steps[shapely.dwithin(body, lines, reach)]
        return near

    @cached_property
    def rapids(self) -> list[int]:
        """The first rapids that meet material; straight up follows the tool's own hole."""
        paths, rapid = self.paths, self.paths.rapids
        way = (paths.end - paths.start)[rapid]
        low = rapid[(paths.low[rapid] < -NEAR) & ((np.hypot(*way[:, :2].T) > NEAR) | (way[:, 2] < 0))]
        return list(islice((step for step in low.tolist() if self.meets(step)), MOST_TOLD))

    @cached_property
    def _cut_lines(self) -> tuple[Ints, shapely.STRtree]:
        """The step of each piece of the cuts, and where they are."""
        pieces = self.paths.whole(self.cuts)
        return pieces.step, shapely.STRtree(self.paths.lines(pieces))

    def bored(self, steps: Ints, *, lift: float, radius: float) -> NDArray[np.bool_]:
        """Which of the steps (k,) go straight down in what one earlier step has cut, and meet nothing there.

        What is asked about is a cylinder as in :meth:`meets`, and much sooner answered here.
        """
        paths, found = self.paths, np.zeros(steps.size, dtype=np.bool_)
        flat = np.hypot(*(paths.end - paths.start)[steps, :2].T) < NEAR
        at = np.flatnonzero(flat & (paths.run.kind[steps] != Kind.ARC))
        if not at.size or not self.cuts.size:
            return found
        of, tree = self._cut_lines
        widest = max(float(np.nanmax(paths.radius)) - radius, 0.0)
        middles = shapely.points(paths.end[steps[at], :2])
        place, line = tree.query(middles, predicate="dwithin", distance=widest)
        step, cut = steps[at[place]], of[line]
        above = paths.low[step] + lift - np.maximum(paths.start[cut, 2], paths.end[cut, 2])
        spare = paths.cutters(cut).radius_at(above + NEAR) - radius
        sure = np.flatnonzero((cut < step) & (above > -NEAR) & (spare > 0))
        place, line, spare = place[sure], line[sure], spare[sure]
        found[at[place[shapely.dwithin(tree.geometries[line], middles[place], spare)]]] = True
        return found

    def meets(self, step: int, *, lift: float = 0.0, radius: float | None = None) -> bool:
        """Whether the tool, moving as this step does, meets material that earlier steps left.

        With ``lift`` and ``radius`` it is not the cutter that is asked about, but a cylinder of that radius
        which begins so far above the cutter's tip: shank or holder.
        """
        paths = self.paths
        z = float(paths.low[step]) + lift
        if z >= -NEAR:
            return False
        pieces = paths.below(-NEAR - lift, steps=np.array([step]))
        reach = float(paths.radius_at(pieces, 0.0)[0]) if radius is None else radius
        shape = grow(paths.room(pieces)[0], reach, ACCURACY)
        body = shapely.intersection(shape, self.plate)
        if body.is_empty:
            return False
        rest = shapely.difference(body, self._gone(step, z, body))
        for air in self.air:  # over a recess of the other side it is enough to have cut down to that
            if air.top > z + NEAR and shapely.intersects(rest, air.shape):
                opened = shapely.intersection(air.shape, self._gone(step, air.top, body))
                rest = shapely.difference(rest, opened)
        return not shapely.is_empty(shapely.buffer(rest, -TOUCH / 2, quad_segs=2))

    def _gone(self, step: int, z: float, body: Shape) -> Shape:
        """What earlier steps have cut down to z, near ``body``."""
        paths = self.paths
        if self.cuts.size == 0:
            return shapely.Polygon()
        reach = float(np.nanmax(paths.radius))
        pieces = paths.below(z + NEAR, steps=self._cuts_near(body, reach, step))
        radius = paths.radius_at(pieces, z)
        # A drill that stops at z exactly is pointed there, but its own hole is no material for it again.
        own = paths.run.tool[pieces.step] == paths.run.tool[step]
        radius = np.where(own, paths.radius[pieces.step], radius)
        shapes = [
            grow(line, r, ACCURACY) for line, r in zip(paths.lines(pieces), radius, strict=True) if r > 0
        ]
        return shapely.union_all(shapes)
