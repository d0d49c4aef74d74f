"""Is there material where the tool goes now? Computed only for the few moves that need the answer."""

import math
from functools import cached_property
from itertools import islice
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array, first_of_each
from mechwright.errors import ProgramError
from mechwright.geometry.prepared import prepared
from mechwright_cam.controls.reading.run import Ints, SpindleChange
from mechwright_cam.proof.bands import stock_shape
from mechwright_cam.proof.paths import NEAR, Geometries, Paths, Pieces
from mechwright_cam.proof.plane import Shape, grow, overlay
from mechwright_cam.proof.swept_area import left
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.views import quarter
from mechwright_cam.shop.cutter import cutter
from mechwright_plane.buffers import buffered

TOUCH = 0.01
"""Material thinner than this in a tool's way is not met, mm: the leftover limit."""
MOST_TOLD = 20
"""So many rapids that meet material are enough to know of."""
FIRST = 2000
"""So many rapids are asked about first; if those meet enough, no others are."""
UNEVEN = 0.2
"""Plates are uneven and are set up to tenths, mm: a rapid keeps so far off a side or a face not yet cut."""
ENDS = (0.25, 0.5, 0.75, 0.95)
"""A round or pointed end is asked about at the heights where it has these shares of its radius."""
TOGETHER = 32
"""Cuts that follow on each other and are looked for together."""
LAST = 250
"""So many of the last cuts are asked first whether they have cleared the way, and then four times as many
each time: what is near was mostly cut shortly before."""
FEW = 16
"""So many cuts are taken off at first, and then twice as many each time, until nothing is left."""
ASKED, COMPARED, GROWN = 500, 20, 150
"""What a question takes, µs; cuts that are compared in one; and what one that is grown takes, µs, besides one
for each of its corners."""
MOST_WORK = 4_000_000
"""What all questions may take, µs; a program that asks for more is refused. None of ours takes a tenth."""
MOST_CORNERS = 2000
"""A shape with more corners is not worth remembering."""
AREA = 2
"""Dimensions of a shape that has an area."""
ACCURACY = 0.001
"""Accuracy of the shapes compared, mm: a tenth of ``TOUCH``."""


class Stock:
    """The plate while the program runs."""

    def __init__(self, paths: Paths, job: Job) -> None:
        self.paths, self.thickness = paths, job.thickness
        self.plate = shapely.difference(stock_shape(job), job.air_below(0.0))
        edge = stock_shape(job)
        around = shapely.buffer(edge, UNEVEN, join_style="mitre")
        self.rough = shapely.union(self.plate, shapely.difference(around, edge))
        """The plate, and the margin that its outside may be larger by."""
        self.air = [air for air in job.gone if air.top < -NEAR]
        self._work = self._asked = 0
        self._free: dict[tuple[Any, ...], int] = {}
        """Ways that have met nothing, and when: material does not come back."""
        self._where: dict[tuple[int, float, float], Shape] = {}
        """By step, lift and radius, the lines along which alone material may be met."""
        self._cleared: dict[tuple[int, float], tuple[int, Shape]] = {}
        """By tool and height, where a question has found nothing of the plate above that height, and when."""
        self.cuts: Ints = paths.cuts[paths.low[paths.cuts] < 0]

    @cached_property
    def extents(self) -> tuple[Array, Array]:
        """Least and greatest x and y (n, 2) of each of the cuts, mm."""
        return self.paths.extent(self.cuts)

    @cached_property
    def _way(self) -> Ints:
        """(n,) a number for each way: steps of one number have tool, ends and centre in common."""
        paths, run = self.paths, self.paths.run
        ways = np.column_stack((run.tool, paths.start, paths.end, run.centre, run.sweep))
        return first_of_each(ways.view(np.int64))[1]

    @cached_property
    def _tree(self) -> shapely.STRtree:
        """Rectangles around so many cuts at a time."""
        least, most = self.extents
        first = np.arange(0, self.cuts.size, TOGETHER)
        low, high = np.minimum.reduceat(least, first), np.maximum.reduceat(most, first)
        return shapely.STRtree(shapely.box(*low.T, *high.T))

    def _cuts_near(self, body: Shape, reach: float, before: int, since: int = 0) -> Ints:
        """The steps that cut before a step, and not before another, within ``reach`` of a shape."""
        least, most = self.extents
        self._count(before, ASKED)
        x0, y0, x1, y1 = shapely.bounds(body)
        group = np.sort(self._tree.query(shapely.box(x0 - reach, y0 - reach, x1 + reach, y1 + reach)))
        index = (group[:, None] * TOGETHER + np.arange(TOGETHER)).ravel()
        index = index[slice(*np.searchsorted(index, np.searchsorted(self.cuts, (since, before))))]
        apart = (least[index] > (x1 + reach, y1 + reach)) | (most[index] < (x0 - reach, y0 - reach))
        steps = self.cuts[index[~apart.any(axis=1)]]
        self._count(before, index.size // COMPARED + steps.size)
        lines: Geometries = self.paths.lines(self.paths.whole(steps), ACCURACY)
        body = prepared(body)
        near: Ints = steps[shapely.dwithin(body, lines, reach + ACCURACY)]
        return near

    def _count(self, step: int, more: int) -> None:
        """Raise ProgramError if all that has been asked takes longer than any proof should."""
        self._work += more
        if self._work > MOST_WORK:
            raise ProgramError(
                f"line {int(self.paths.run.line[step])}: {self._asked} moves go where earlier cuts may have "
                "left something, and that takes too long to work out; split the program before this line"
            )

    @cached_property
    def rapids(self) -> list[int]:
        """The first rapids that meet material; straight up follows the tool's own hole."""
        paths, rapid = self.paths, self.paths.rapids
        way = (paths.end - paths.start)[rapid]
        low = rapid[(paths.low[rapid] < -NEAR) & ((np.hypot(*way[:, :2].T) > NEAR) | (way[:, 2] < 0))]
        low = low[~self.in_own_hole(low, paths.low[low])]
        lots = (self.suspects(lot) for lot in (low[:FIRST], low[FIRST:]))
        met = (step for lot in lots for step in lot.tolist() if self.meets(step) or self._end_meets(step))
        return list(islice(met, MOST_TOLD))

    def _end_meets(self, step: int) -> bool:
        """Whether a round or pointed end meets what its tool has left beside where it was as deep before."""
        tool = self.paths.tools[int(self.paths.run.tool[step])]
        for share in ENDS:
            lift = float(cutter(tool).height_at(np.array(share * tool.radius)))
            if lift > TOUCH and self.meets(step, lift=lift, radius=share * tool.radius, own=False):
                return True
        return False

    def in_own_hole(self, rapids: Ints, z: Array) -> NDArray[np.bool_]:
        """(n,) whether a rapid is straight down, where the same tool was fed to ``z`` (n,), as pecks do."""
        paths, steps = self.paths, np.concatenate((self.cuts, rapids))
        fed = np.arange(steps.size) < self.cuts.size
        upright = np.hypot(*(paths.end - paths.start)[steps, :2].T) <= NEAR
        steps, fed, wanted = steps[upright], fed[upright], np.flatnonzero(upright & ~fed) - self.cuts.size
        place = np.column_stack((paths.run.tool[steps], np.round(paths.end[steps, :2] / NEAR)))
        hole = first_of_each(place.astype(np.int64))[1]
        order = np.lexsort((steps, hole))
        low, hole = np.concatenate((paths.low[self.cuts], z))[upright][order], hole[order]
        drop = float(np.ptp(low)) + 1.0 if low.size else 0.0
        deepest = np.minimum.accumulate(np.where(fed[order], low, np.inf) - drop * hole)
        free = np.zeros(steps.size, dtype=np.bool_)
        free[order] = deepest <= low - drop * hole + NEAR
        found = np.zeros(rapids.size, dtype=np.bool_)
        found[wanted] = free[~fed]
        return found

    @cached_property
    def rapid_at_side(self) -> int | None:
        """The first rapid that goes so near to a side of the plate that it may meet it; None if none does."""
        paths, rapid = self.paths, self.paths.rapids
        low = rapid[(paths.low[rapid] < -NEAR) & (paths.end[rapid, 2] <= paths.start[rapid, 2])]
        low = low[~self.in_own_hole(low, paths.low[low])]
        sides = shapely.boundary(shapely.convex_hull(self.rough))
        low = self.suspects(low[shapely.dwithin(sides, paths.room(paths.whole(low)), paths.radius[low])])
        return next((step for step in low.tolist() if self.meets(step, rough=True)), None)

    def suspects(
        self, steps: Ints, *, lift: Array | float = 0.0, radius: Array | float | None = None
    ) -> Ints:
        """Those of the steps of which :meth:`meets` has to be asked: of the others it would say no.

        ``lift`` and ``radius`` are one each or of every step (n,); a radius of NaN stands for None.
        """
        paths = self.paths
        lifts = np.broadcast_to(lift, steps.shape)
        widest = paths.cutters(steps).radius_at(-paths.low[steps])
        reach = np.broadcast_to(np.nan if radius is None else radius, steps.shape)
        reach = np.where(np.isnan(reach), widest, reach)
        low = (paths.low[steps] + lifts < -NEAR) & (reach > 0)
        steps, lifts, reach = steps[low], lifts[low], reach[low]
        suspect, where = left(paths, self.cuts, self._around, steps, lifts, reach)
        for index, lines in where.items():
            self._where[int(steps[index]), float(lifts[index]), float(reach[index])] = lines
        return steps[suspect]

    @cached_property
    def _around(self) -> Array:
        """Least and greatest x and y of the plate and its margin."""
        return np.array(shapely.bounds(self.rough)).reshape(2, 2)

    def meets(
        self,
        step: int,
        *,
        lift: float = 0.0,
        radius: float | None = None,
        rough: bool = False,
        own: bool = True,
    ) -> bool:
        """Whether the tool, moving as this step does, meets material that earlier steps left.

        With ``lift`` and ``radius`` it is not the cutter that is asked about, but a cylinder of that radius
        which begins so far above the cutter's tip: shank, holder or middle. One without a radius meets
        nothing. A ``rough`` plate has its margin. With ``own`` the whole width of the same tool counts as cut
        wherever its tip has been as deep.
        """
        paths = self.paths
        z = float(paths.low[step]) + lift
        if z >= -NEAR or (radius is not None and radius <= 0):
            return False
        key = (int(self._way[step]), lift, radius, rough, own)
        if self._free.get(key, step) < step:
            return False
        self._asked += 1
        pieces = paths.below(-NEAR - lift, steps=np.array([step]))
        reach = float(paths.radius_at(pieces, 0.0)[0]) if radius is None else radius
        plate = self.rough if rough else self.plate
        room = self._where.get((step, lift, reach)) or paths.room(pieces)[0]
        body = shapely.intersection(grow(room, reach, ACCURACY), plate)
        if self._meets(step, z, body, own=own):
            return True
        self._free[key] = step
        return False

    def touches(self, change: SpindleChange) -> bool:
        """Whether the tool stands less than ``UNEVEN`` off the stock that is left, where the spindle changes.

        A tool of another job, or in a place that the text does not say, touches nothing.
        """
        x, y, z = change.place
        tool = self.paths.tools.get(change.tool)
        if tool is None or not math.isfinite(x + y) or not z < UNEVEN - NEAR:
            return False
        key = (change.tool, *change.place)
        if key in self._free:
            return False
        self._asked += 1
        tip = z - UNEVEN
        reach = float(cutter(tool).radius_at(-tip)) + UNEVEN
        body = shapely.intersection(grow(shapely.Point(x, y), reach, ACCURACY), self.plate)
        step = min(change.step, len(self.paths.run) - 1)
        if self._meets(step, max(tip, -self.thickness), body):
            return True
        self._free[key] = step
        return False

    def _meets(self, step: int, z: float, body: Shape, *, own: bool = True) -> bool:
        """Whether material is left in some of the plate, above a height, when a step begins."""
        key = int(self.paths.run.tool[step]) if own else 0, z
        since, cleared = self._cleared.get(key, (step, shapely.Point()))
        if since > step:
            cleared = shapely.Point()
        self._count(step, ASKED + int(shapely.get_num_coordinates(cleared)))
        body = overlay(shapely.difference, body, cleared)
        if body.is_empty:
            return False
        rest = self._left(step, z, body, own=own)
        for air in self.air:  # over a recess of the other side it is enough to have cut down to that
            if air.top > z + NEAR and shapely.intersects(rest, air.shape):
                over = self._left(step, air.top, overlay(shapely.intersection, rest, air.shape), own=own)
                rest = overlay(shapely.union, overlay(shapely.difference, rest, air.shape), over)
        cleared = overlay(shapely.union, cleared, overlay(shapely.difference, body, rest))
        if shapely.get_num_coordinates(cleared) < MOST_CORNERS:
            self._cleared[key] = step, cleared
        return not _is_nothing(rest)

    def _left(self, step: int, z: float, body: Shape, *, own: bool = True) -> Shape:
        """What earlier steps have left of a shape, not having cut it down to z; the last cuts come first."""
        paths, last = self.paths, step
        reach = float(np.nanmax(paths.radius)) if self.cuts.size else 0.0
        first, count = int(np.searchsorted(self.cuts, step)), LAST
        while first > 0 and not _is_nothing(body):
            first, count = max(first - count, 0), 4 * count
            since = int(self.cuts[first])
            pieces = paths.below(z + NEAR, steps=self._cuts_near(body, reach, last, since)[::-1])
            body = self._without(body, pieces, step if own else None, z)
            last = since
        return body

    def _without(self, body: Shape, pieces: Pieces, step: int | None, z: float) -> Shape:
        """What some pieces leave of a shape at a height; the tool of a step counts as wide as it is."""
        paths = self.paths
        # A drill that stops at z exactly is pointed there, but its own hole is no material for it again.
        own = (paths.run.tool[pieces.step] == paths.run.tool[step]) if step is not None else False
        radius = np.where(own, paths.radius[pieces.step], paths.radius_at(pieces, z))
        pieces, radius = pieces.only(radius > 0), radius[radius > 0]
        lines, count = paths.lines(pieces, ACCURACY), FEW
        while lines.size and not _is_nothing(body):
            # Those that reach furthest beyond a place in what is left, and some of all: cuts come in crowds.
            away = shapely.distance(lines, shapely.point_on_surface(body)) - radius
            now = np.zeros(lines.size, dtype=np.bool_)
            now[np.argsort(away, kind="stable")[:count]] = True
            now[:: -(-lines.size // count)] = True
            self._count(
                0 if step is None else step,
                int(GROWN * now.sum() + shapely.get_num_coordinates(lines[now]).sum()),
            )
            gone = shapely.union_all(_around(body, _discs(lines[now], radius[now])))
            body = overlay(shapely.difference, body, gone)
            lines, radius, count = lines[~now], radius[~now], 2 * count
            if lines.size > count:
                near = shapely.dwithin(prepared(body), lines, float(radius.max()))
                lines, radius = lines[near], radius[near]
        return body


def _is_nothing(body: Shape) -> bool:
    """Whether a shape is nowhere as wide as what is met."""
    return body.is_empty or bool(shapely.is_empty(shapely.buffer(body, -TOUCH / 2, quad_segs=2)))


def _around(body: Shape, shapes: Geometries) -> Geometries:
    """What there is of some shapes in the rectangle around a body: few corners of long ones."""
    x0, y0, x1, y1 = shapely.bounds(body)
    near = shapely.clip_by_rect(shapes, x0 - TOUCH, y0 - TOUCH, x1 + TOUCH, y1 + TOUCH)
    areas: Geometries = near[shapely.get_dimensions(near) == AREA]
    return areas


def _discs(lines: Geometries, radius: Array) -> Geometries:
    """What discs of radii (m,) sweep along lines (m,)."""
    grown = np.empty_like(lines)
    for one in np.unique(radius).tolist():
        mine = radius == one
        grown[mine] = buffered(lines[mine], one, quarter(one, ACCURACY))
    return grown
