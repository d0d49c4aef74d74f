"""Proof that two finished gears run together: overlap, play, transmission error, from outlines alone.

Nothing here knows how the teeth were made: the input is two polygons, from the outline, from a STEP file read
back, or as the cutters leave the parts.

Glossary
--------
position
    An angle θ2 of gear 2 with gear 4 at the exact angle of the rolling ellipses.
play
    How far gear 4 may turn from there, rad, until a flank meets: ``ahead`` counter-clockwise, ``behind``
    clockwise. Negative where the outlines overlap.
transmission error
    Peak to peak of the play of one flank over the turn, rad: how far the driven gear strays from the exact
    motion while that flank drives.
depth
    How deep one outline stands in the other in position, mm: the greatest distance of a corner of one from
    the other's nearest edge; 0 where none stands in it.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright import Array
from mechwright_elliptic_gears.crossings import turns_to_edges
from mechwright_elliptic_gears.ellipse import Ellipse
from mechwright_elliptic_gears.kinematics import Turning, driven
from mechwright_elliptic_gears.penetration import depths
from mechwright_elliptic_gears.zone import Near, Rim, half_span, level, turned

POSITIONS_PER_TOOTH = 4
"""Positions per tooth. One more over the whole turn makes the step unrelated to the pitch, so that every part
of the mesh cycle is met."""

EDGES_PER_PITCH = 16
"""Longer edges are cut, so that an edge is a short piece of one flank."""

_CHUNK = 32
"""Positions at a time: bounds the memory, a few ten MB."""

_REACH = 0.1
"""Pitches by which a gear's envelope is widened: what lies within it is looked at."""

_SIGHT = 0.5
"""Pitches: half the least arc on both sides of a point in which it looks for edges."""

_AREAS = 64
"""Most positions whose overlap area is measured: those with the greatest depths."""


@dataclass(frozen=True)
class Mesh:
    """What the proof found.

    Parameters
    ----------
    theta2
        Positions (n,), rad.
    ahead, behind
        Play (n,), rad.
    depth
        Depth (n,), mm.
    gap
        Least normal distance (n,), mm, of the outlines in position; 0 where they overlap.
    overlap
        Largest overlap area over the positions, mm²; 0 where no depth is above the allowance.
    """

    theta2: Array
    ahead: Array
    behind: Array
    depth: Array
    gap: Array
    overlap: float

    @property
    def transmission_error(self) -> float:
        """Peak to peak, rad: the larger one of the two flanks; inf if a flank finds nothing to drive."""
        return max(swing(self.ahead), swing(self.behind))

    @property
    def free_play(self) -> Array:
        """Turn (n,), rad, of gear 4 from flank to flank."""
        play: Array = self.ahead + self.behind
        return play


def swing(values: Array) -> float:
    """Peak to peak of values (n,); inf if one of them is not finite."""
    return float(np.ptp(values)) if np.isfinite(values).all() else math.inf


def mesh(
    gear2: Array,
    gear4: Array,
    ellipse: Ellipse,
    teeth: int,
    *,
    positions: int | None = None,
    allowance: float,
) -> Mesh:
    """Run two outlines against each other over a whole turn of gear 2.

    Parameters
    ----------
    gear2, gear4
        Corners (n, 2), mm, counter-clockwise, each in its part frame; not repeated at the end.
    ellipse
        The pitch ellipse of both; their axes are 2a apart.
    teeth
        Number of teeth.
    positions
        Number of positions, equal steps of arc; by default four per tooth and one.
    allowance
        Depth that counts as contact, mm: what fitting and flattening may put on both outlines.
    """
    if positions is None:
        positions = POSITIONS_PER_TOOTH * teeth + 1
    pitch = ellipse.perimeter / teeth
    two, four = (_cut_edges(points, pitch / EDGES_PER_PITCH) for points in (gear2, gear4))
    rims = Rim.of(two, ellipse), Rim.of(four, ellipse)
    # The pitch point of gear 2 moves along its ellipse by equal arcs; it lies at -θ2 in the part frame.
    arc = ellipse.perimeter * np.arange(positions) / positions
    on_ellipse = ellipse.frame_at(arc).point
    theta2 = -np.unwrap(np.arctan2(on_ellipse[:, 1], on_ellipse[:, 0]))
    theta4 = driven(Turning.of(theta2, 1.0), ellipse.eccentricity).theta
    # Gear 4 rolls backwards from its near vertex.
    u2, u4 = ellipse.angle(arc), ellipse.angle(ellipse.perimeter / 2 - arc)
    scale = max(float(level(points, ellipse).max()) for points in (two, four))
    scale += _REACH * pitch / ellipse.semi_major
    parts = []
    for i in range(0, positions, _CHUNK):
        now = slice(i, i + _CHUNK)
        near = _near(rims, ellipse, scale, theta2[now], theta4[now], u2[now], u4[now])
        parts.append(_contact(*near, theta2[now].size, pitch, allowance))
    ahead, behind, depth, gap = (np.concatenate(column) for column in zip(*parts, strict=True))
    overlap = 0.0
    deepest = np.argsort(-depth, kind="stable")[:_AREAS]
    some = deepest[depth[deepest] > allowance]
    if some.size:
        overlap = _overlap(gear2, gear4, theta2[some], theta4[some], 2 * ellipse.semi_major)
    return Mesh(theta2, ahead, behind, depth, gap, overlap)


def _cut_edges(points: Array, longest: float) -> Array:
    """Corners (n, 2) with every edge at most so long, and none of no length."""
    points = points[(points != np.roll(points, 1, axis=0)).any(axis=1)]
    edge = np.roll(points, -1, axis=0) - points
    counts = np.maximum(1, np.ceil(np.hypot(*edge.T) / longest)).astype(np.int64)
    at = np.repeat(np.arange(len(points)), counts)
    step = np.arange(at.size) - np.repeat(np.cumsum(counts) - counts, counts)
    cut: Array = points[at] + (step / counts[at])[:, None] * edge[at]
    return cut


def _near(
    rims: tuple[Rim, Rim], ellipse: Ellipse, scale: float, theta2: Array, theta4: Array, u2: Array, u4: Array
) -> tuple[Near, Near]:
    """What of both gears is near contact in some positions, seen from gear 4."""
    half = half_span(ellipse, scale)
    distance = 2 * ellipse.semi_major
    cos, sin = np.cos(theta2 - theta4), np.sin(theta2 - theta4)
    axis2 = -distance * np.column_stack((np.cos(theta4), -np.sin(theta4)))
    axis4 = distance * np.column_stack((np.cos(theta2), -np.sin(theta2)))
    position, index = rims[0].span(u2, half)
    placed = turned(rims[0].points[index], cos[position], sin[position]) + axis2[position]
    near2 = Near.of(placed, position, level(placed, ellipse) < scale)
    position, index = rims[1].span(u4, half)
    placed = rims[1].points[index]
    seen = turned(placed, cos[position], -sin[position]) + axis4[position]
    return near2, Near.of(placed, position, level(seen, ellipse) < scale)


def _contact(
    gear2: Near, gear4: Near, count: int, pitch: float, allowance: float
) -> tuple[Array, Array, Array, Array]:
    """Play ahead and behind, depth and gap (count,) of some positions."""
    edge = np.hypot(*(gear4.ends - gear4.starts).T)
    ring = float(edge.mean()) if edge.size else math.inf
    ahead, behind = np.full(count, np.inf), np.full(count, np.inf)
    depth, gap = np.zeros(count), np.full(count, np.inf)
    groups, turns, distances, blind = [], [], [], []
    for own, other, moving in ((gear2, gear4, False), (gear4, gear2, True)):
        group = own.position
        free = turns_to_edges(
            own.points, group, other.starts, other.ends, other.edge_position, ring, _SIGHT * pitch
        )
        # Gear 4 turning ahead brings its leaving edges to points of gear 2 that lie ahead of them, and its
        # own points to entering edges of gear 2.
        forward = free.entering_ahead if moving else free.leaving_behind
        backward = free.leaving_behind if moving else free.entering_ahead
        # A point stands in material if the edges on both sides say so; one side may have none in sight.
        # It is freed over the nearer edge, gear 4 turning one way for its own points and the other way for
        # points of gear 2.
        over, under = free.leaving_ahead, free.entering_behind
        nearer = np.minimum(over, under)
        inside = (over <= free.entering_ahead) & (under <= free.leaving_behind)
        way = nearer * np.hypot(*own.points.T)
        inside &= np.isfinite(way)
        blind.append(~np.isfinite(np.minimum(way, free.distance)))
        # The way to the outline along the circle is no depth where the circle hardly cuts it.
        deep = np.flatnonzero(inside & (way > allowance))
        distance = np.where(inside, np.minimum(free.distance, way), free.distance)
        distance[deep] = depths(own.points[deep], group[deep], other.starts, other.ends, other.edge_position)
        inside[deep] = distance[deep] > 0
        retreats = inside & ((under <= over) if moving else (over <= under))
        advances = inside & ~retreats
        forward = np.where(retreats, -nearer, np.where(advances, np.inf, forward))
        backward = np.where(advances, -nearer, np.where(retreats, np.inf, backward))
        np.minimum.at(ahead, group, forward)
        np.minimum.at(behind, group, backward)
        np.maximum.at(depth, group[inside], distance[inside])
        groups.append(group)
        turns.append(np.minimum(forward, backward))
        distances.append(np.where(inside, 0.0, np.abs(distance)))
    # Of a tooth that reaches below the other's roots, the end sees no edge to be freed over.
    for own, other, unseen in ((gear2, gear4, blind[0]), (gear4, gear2, blind[1])):
        points = np.flatnonzero(unseen & (depth > allowance)[own.position])
        group = own.position[points]
        np.maximum.at(
            depth, group, depths(own.points[points], group, other.starts, other.ends, other.edge_position)
        )
    # The gap is where the least turn is: elsewhere the arcs are too long to be measured along a normal.
    group, turn = np.concatenate(groups), np.concatenate(turns)
    closest = turn <= np.minimum(ahead, behind)[group]
    np.minimum.at(gap, group[closest], np.concatenate(distances)[closest])
    return ahead, behind, depth, gap


def _overlap(gear2: Array, gear4: Array, theta2: Array, theta4: Array, distance: float) -> float:
    """Largest common area, mm², over some positions."""
    import shapely

    areas = []
    for angle2, angle4 in zip(theta2, theta4, strict=True):
        one = turned(gear2, np.cos(angle2), np.sin(angle2))
        other = turned(gear4, np.cos(angle4), np.sin(angle4)) + np.array([distance, 0.0])
        low, high = np.maximum(one.min(0), other.min(0)), np.minimum(one.max(0), other.max(0))
        if (low < high).all():
            shapes = (shapely.clip_by_rect(shapely.Polygon(gear), *low, *high) for gear in (one, other))
            areas.append(float(shapely.intersection(*shapes).area))
    return max(areas, default=0.0)
