"""Adaptive clearing: the cutter's engagement stays below an angle, however the stock is shaped.

Glossary
--------
engagement
    Angle of the cutter's leading half that stands in stock: 90 degrees against a wall as high as the cutter
    is wide, 180 in a slot.
cleared
    What is cut so far, all of it wide enough for a disc of the bend radius.
bend radius
    No edge of what is cleared bends more tightly, so that a thin layer on it never lies around half of the
    cutter. The tighter the bend, the thinner the layers: wide areas are cleared with a large bend radius,
    then their corners with smaller ones. What is tighter than the last stays for the contour passes that
    follow.
front
    The edge of what is cleared, where stock stands behind it.

A helix opens a hole, a spiral widens it to the largest disc at that place. Then each front is moved on by a
layer at a time: the cleared region is grown by the layer, cut to the area, and opened with the bend radius.
The cutter runs along the new front from wall to wall, always in one direction, and returns through what is
cleared. How thick a layer may be depends on the bend of the front: the straight-front value R (1 - cos φ) is
tried first, the engagement is measured along the whole pass against what is cleared, and the layer is thinned
until it holds.
"""

import math

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.geometry.prepared import prepared
from mechwright.geometry.segments import Point
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.cavity import Cavity, Pass
from mechwright_cam.operations.choice import entry_place
from mechwright_cam.shop.tool import Tool
from mechwright_plane.arcfit import fit
from mechwright_plane.offsets import ROUGH, densified, grow, polygons, simplified

BENDS = (2.2, 1.5, 1.2)
"""Bend radii in cutter radii, in the order of work: below the last, layers are too thin to pay."""
HELIX = 1.7
"""Radius of the hole that the helix opens, in cutter radii, or less: below 2 no core stays."""
THINNEST = 0.03
"""Thinnest layer in cutter radii: what asks for thinner ones is left to the contour passes."""
THINNER = 0.7
"""A layer that engages too much is thinned by this factor, or its square, at most."""
SURE = 0.95
"""It is thinned at least by this, and by this more than its engagement asks for."""
THICKER = 1.1
"""Where it may be thicker, the next one is, by this factor at most: a guess too many is a trial lost."""
MARGIN = math.radians(2.0)
"""A pass is planned to engage this much less than asked, rad: arcs and flakes on walls add as much."""
FRONT_ANGLES = np.radians(np.arange(-90.0, 91.0, 2.0))
"""Directions from that of motion in which the cutter's edge is looked at, rad."""
EDGE = 0.998
"""The edge is looked at this little inside the cutter, in radii: a wall it only touches is no stock."""
COARSE = 2 * ROUGH
"""Chord error of what is cleared, mm; with the fit it is less than the allowance that keeps it off walls."""
FITTING = 2 * ROUGH
"""How far the arcs of a pass may stand off its points, mm: it keeps the roughing allowance off the walls."""
SAMPLE = 0.12
"""Distance at which engagement is measured along a pass, in cutter radii."""
CRUMB = 0.02
"""Stock of less area than this, in cutter radii squared, is no front of its own."""
MOST_LAYERS = 4000
"""Bounds the work in one cavity; no plate has a hundredth of it."""
RUN_UP = 0.4
"""How far, in cutter radii, a pass starts and ends in the clear."""


def straight_layer(radius: float, engagement: float) -> float:
    """Thickness of a layer on a straight front that engages a cutter by ``engagement``, rad.

    >>> round(straight_layer(3.0, math.pi / 3), 9)
    1.5
    """
    return radius * (1 - math.cos(engagement))


def engagements(points: Array, cleared: shapely.Geometry, radius: float) -> Array:
    """Engagement (n - 1,), rad, of a cutter in the middle of each edge of a path (n, 2), mm.

    Only the leading half of the cutter counts: what is behind has been cut by the pass itself.
    """
    step = np.diff(points, axis=0)
    heading = np.arctan2(step[:, 1], step[:, 0])
    middle = (points[:-1] + points[1:]) / 2
    angle = heading[:, None] + FRONT_ANGLES
    edge = middle[:, None] + EDGE * radius * np.stack((np.cos(angle), np.sin(angle)), axis=2)
    cleared = prepared(cleared)
    x, y = edge.reshape(-1, 2).T
    stock = ~shapely.contains_xy(cleared, x, y).reshape(angle.shape)
    return np.asarray(stock.sum(axis=1) * (FRONT_ANGLES[1] - FRONT_ANGLES[0]))


def clear(area: shapely.Geometry, tool: Tool, engagement: float, climb: bool) -> list[Cavity]:
    """Plan the clearing of an area in which the cutter's edge may be, with a greatest engagement, rad.

    To ``climb`` stock is on the right of the path. There is a cavity for each part of the area that is wide
    enough, none if the cutter has no room to turn.
    """
    radius = tool.radius
    bend = BENDS[-1] * radius
    roomy = grow(grow(area, -bend, COARSE), bend - COARSE, COARSE)
    found = (_Clearing(part, radius, engagement, climb).cavity() for part in polygons(roomy))
    return [cavity for cavity in found if cavity is not None]


class _Clearing:
    """The clearing of one connected area.

    What is not cleared yet is kept in pieces, ``rest``: a layer changes one of them, and all that a layer
    depends on is looked at in a window around the front.
    """

    def __init__(self, area: shapely.Polygon, radius: float, engagement: float, climb: bool) -> None:
        self.area, self.radius, self.engagement, self.climb = area, radius, engagement, climb
        self.bend = BENDS[-1] * radius
        self.thickest = self.thickness = straight_layer(radius, engagement)
        self.passes: list[Pass] = []
        self.rest: list[shapely.Polygon] = []
        self.walls = prepared(shapely.boundary(area))

    def cavity(self) -> Cavity | None:
        centre, widest = entry_place(self.area)
        if widest < self.bend - 2 * COARSE:
            return None
        hole = min(HELIX * self.radius, widest)
        self.end = begin = (centre[0] + hole - self.radius, centre[1])
        self.rest = self._without(self.area, _disc(centre, hole))
        self._spiral(centre, hole, widest)
        for bend in BENDS:
            self.bend = bend * self.radius
            wide = grow(grow(self.area, -self.bend, COARSE), self.bend - COARSE / 2, COARSE)
            if self.bend <= widest + COARSE:
                self._fronts(shapely.intersection(wide, self.area))
        return Cavity(centre, hole - self.radius, begin, tuple(self.passes), self._cleared())

    def _cleared(self) -> shapely.Geometry:
        return shapely.difference(self.area, shapely.union_all(self.rest))

    def _without(self, piece: shapely.Polygon, gone: shapely.Geometry) -> list[shapely.Polygon]:
        """What stays of a piece; flakes on the walls are for finishing, and walls keep their few corners."""
        rest = shapely.difference(piece, gone)
        body = shapely.buffer(rest, -COARSE, quad_segs=2)
        rest = shapely.intersection(rest, shapely.buffer(body, 2 * COARSE, quad_segs=2))
        return polygons(simplified(rest, COARSE / 5))

    def _spiral(self, centre: Point, hole: float, widest: float) -> None:
        """Widen the helix's hole to the largest disc there, a layer per turn."""
        if widest - hole < THINNEST * self.radius:
            return
        points = [np.array([[centre[0] + hole - self.radius, centre[1]]])]
        side, reached = (1 if self.climb else -1), hole
        while widest - reached > TOLERANCES.noise:
            layer = min(self._ring_layer(reached), widest - reached)
            t = np.linspace(0, 1, 97)[1:]
            way = reached + layer * t - self.radius
            turn = side * math.tau * t
            points.append(np.column_stack((centre[0] + way * np.cos(turn), centre[1] + way * np.sin(turn))))
            reached += layer
        turn = side * np.linspace(0, math.tau, 97)[1:]
        last = reached - self.radius
        points.append(np.column_stack((centre[0] + last * np.cos(turn), centre[1] + last * np.sin(turn))))
        self._add(np.concatenate(points))
        self.rest = self._without(self.area, _disc(centre, reached))

    def _ring_layer(self, hole: float) -> float:
        """Layer that engages a cutter in a round hole by the angle asked for: the cosine rule."""
        radius, angle = self.radius, self.engagement
        # The centre stands d off the middle, where circles of radius hole and cutter cross at that angle from
        # the outward direction: hole² = d² + radius² + 2 d radius cos(angle).
        d = -radius * math.cos(angle) + math.sqrt(hole**2 - (radius * math.sin(angle)) ** 2)
        # Along a spiral the heading leans outwards, by about layer / (2 π d).
        return max(THINNEST * radius, 0.85 * (d + radius - hole))

    def _fronts(self, within: shapely.Geometry) -> None:
        """Move all fronts of an area on; each as far as it goes before the next."""
        waiting = self._nearest_last(_apart(within, self._cleared()))
        layers = 0
        while waiting and layers < MOST_LAYERS:
            stock = waiting.pop()
            layers += 1
            taken = self._layer(stock)
            if taken is not None:
                waiting += self._nearest_last(_apart(stock, taken))

    def _nearest_last(self, parts: list[shapely.Polygon]) -> list[shapely.Polygon]:
        """The parts worth a pass, that nearest to the cutter last."""
        worth = [part for part in parts if part.area > CRUMB * self.radius**2]
        here = shapely.Point(self.end)
        return sorted(worth, key=lambda part: -float(shapely.distance(part, here)))

    def _layer(self, stock: shapely.Polygon) -> shapely.Geometry | None:
        """Take one layer off a piece of stock; what is cleared around it then, None if it cannot be done."""
        box = self._window(stock)
        cleared, stock = self._cleared_in(box), shapely.intersection(stock, box)
        ahead = _Ahead(cleared, stock, self.radius)
        thickness = min(self.thickest, self.thickness)
        while thickness >= THINNEST * self.radius:
            layer = shapely.intersection(grow(cleared, thickness, COARSE), ahead.fat)
            if shapely.is_empty(layer):
                return None
            grown = simplified(shapely.union(cleared, layer), COARSE / 5)
            wider = grow(grow(grown, -self.bend, COARSE), self.bend, COARSE)
            wider = shapely.union(shapely.intersection(wider, ahead.fat), cleared)
            if wider.area - cleared.area < CRUMB * self.radius**2 / 4:
                break
            ways = self._ways(wider, layer, ahead)
            if not ways:
                thickness *= THINNER
                continue
            found = max(self._engaged(way, cleared) for way in ways)
            share = (1 - math.cos(self.engagement - MARGIN)) / (1 - math.cos(max(found, MARGIN)))
            if share >= 1:
                for way in ways:
                    self._add(way)
                self.rest = [
                    part
                    for piece in self.rest
                    for part in (self._without(piece, wider) if shapely.intersects(piece, wider) else [piece])
                ]
                # Fronts bend alike from one layer to the next: what this one could have been, that one is.
                self.thickness = thickness * min(SURE * share, THICKER)
                return wider
            thickness *= min(max(SURE * share, THINNER**2), SURE)
        self.thickness = self.thickest
        return None

    def _window(self, stock: shapely.Polygon) -> shapely.Polygon:
        """A box around the front of a piece of stock with all that its next layer depends on."""
        step = self.radius / 4
        points = shapely.get_coordinates(shapely.segmentize(stock, step))
        places = shapely.points(points)
        around = [shapely.boundary(piece) for piece in self.rest if shapely.intersects(piece, stock)]
        edge = prepared(shapely.union_all(around))
        # The front is where the rest ends and no wall stands.
        front = shapely.dwithin(edge, places, COARSE) & ~shapely.dwithin(self.walls, places, COARSE)
        points = points[front] if front.any() else points
        # A disc that covers a point of the layer is within two bend radii; edges that the window makes lie in
        # what was clear before, so they are no cuts.
        margin = step + self.thickest + max(2.1 * self.bend, 4 * self.radius)
        (x0, y0), (x1, y1) = points.min(axis=0) - margin, points.max(axis=0) + margin
        return shapely.box(x0, y0, x1, y1)

    def _cleared_in(self, box: shapely.Polygon) -> shapely.Geometry:
        """What is cleared within a box, prepared."""
        rest = shapely.union_all([shapely.intersection(piece, box) for piece in self.rest])
        return prepared(shapely.difference(shapely.intersection(self.area, box), rest))

    def _engaged(self, way: Array, cleared: shapely.Geometry) -> float:
        dense = densified(way, SAMPLE * self.radius)
        return float(engagements(dense, cleared, self.radius).max())

    def _ways(self, wider: shapely.Geometry, layer: shapely.Geometry, ahead: "_Ahead") -> list[Array]:
        """The centre's ways along the new front of a piece of stock, in cutting direction."""
        radius = self.radius
        x0, y0, x1, y1 = layer.bounds
        far = 2.5 * radius
        around = shapely.intersection(wider, shapely.box(x0 - far, y0 - far, x1 + far, y1 + far))
        found = []
        for part in polygons(grow(around, COARSE - radius, COARSE)):
            for loop in (part.exterior, *part.interiors):
                ring = densified(shapely.get_coordinates(loop), SAMPLE * radius)
                # Along the edge of what is cleared, stock on the right for climb.
                if (shapely.is_ccw(loop) == self.climb) != (loop is part.exterior):
                    ring = ring[::-1]
                x, y = ring.T
                cuts = ~shapely.contains_xy(ahead.old, x, y) & shapely.contains_xy(ahead.near, x, y)
                found += self._runs(ring, cuts[:-1])
        return found

    def _runs(self, ring: Array, cuts: NDArray[np.bool_]) -> list[Array]:
        """The stretches of a ring that cut, with a run-up at both ends."""
        if not cuts.any():
            return []
        count = len(cuts)
        more = max(1, math.ceil(RUN_UP / SAMPLE))
        if cuts.all():
            return [np.concatenate((ring, ring[1 : more + 1]))]
        shift = int(np.flatnonzero(~cuts)[0])
        turned, flags = np.roll(ring[:-1], -shift, axis=0), np.roll(cuts, -shift)
        edges = np.diff(np.concatenate(([False], flags, [False])).astype(int))
        runs = []
        for first, last in zip(np.flatnonzero(edges == 1), np.flatnonzero(edges == -1), strict=True):
            index = np.arange(first - more, min(last + more, first - more + count)) % count
            runs.append(turned[index])
        return runs

    def _add(self, points: Array) -> None:
        path = fit(points, FITTING)
        if not path.cuts:
            return
        way, apart = shapely.LineString([self.end, path.start]), self.radius - 3 * COARSE
        near = (shapely.dwithin(piece, way, apart) for piece in (self.walls, *self.rest))
        linked = way.length == 0 or not any(near)
        self.passes.append(Pass(path, linked))
        self.end = path.end


class _Ahead:
    """What the layers in front of a piece of stock are compared with, whatever their thickness."""

    def __init__(self, cleared: shapely.Geometry, stock: shapely.Geometry, radius: float) -> None:
        self.fat = grow(stock, COARSE, COARSE)
        self.old = prepared(grow(cleared, 2 * COARSE - radius, COARSE))
        self.near = prepared(grow(stock, radius + COARSE, COARSE))


def _apart(stock: shapely.Geometry, cleared: shapely.Geometry) -> list[shapely.Polygon]:
    """The parts of stock that are not cleared, a little off the front, which so leaves no flakes."""
    rest = shapely.difference(stock, grow(cleared, COARSE / 2, COARSE))
    return polygons(simplified(rest, COARSE / 5))


def _disc(centre: Point, radius: float) -> shapely.Polygon:
    return grow(shapely.Point(centre), radius, COARSE / 5)
