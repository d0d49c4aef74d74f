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
    How deep one outline stands in the other in position, mm, along the flank's normal; 0 where they do not.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright.motion import Array
from mechwright_elliptic_gears.crossings import Flags, Ints, turns_to_edges
from mechwright_elliptic_gears.ellipse import Ellipse
from mechwright_elliptic_gears.kinematics import Turning, driven

POSITIONS_PER_TOOTH = 4
"""Positions per tooth. One more over the whole turn makes the step unrelated to the pitch, so that every part
of the mesh cycle is met."""

EDGES_PER_PITCH = 64
"""Longer edges are cut, so that corners stand close enough to feel every contact."""

_CHUNK = 32
"""Positions at a time: bounds the memory, a few ten MB."""

_REACH = 0.1
"""Pitches by which a gear's envelope is widened: what lies within it is looked at."""

_DEEPEST = 0.25
"""Pitches: half the thickness of a tooth. A point cannot stand deeper in material than that."""

_AREAS = 64
"""Most positions, spread over those that overlap, whose overlap area is measured."""


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
        Depth (n,), mm; at most a quarter of a pitch.
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
        """Peak to peak, rad: the larger one of the two flanks."""
        return float(max(np.ptp(self.ahead), np.ptp(self.behind)))

    @property
    def free_play(self) -> Array:
        """Turn (n,), rad, of gear 4 from flank to flank."""
        play: Array = self.ahead + self.behind
        return play


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
    # The pitch point of gear 2 moves along its ellipse by equal arcs; it lies at -θ2 in the part frame.
    on_ellipse = ellipse.frame_at(ellipse.perimeter * np.arange(positions) / positions).point
    theta2 = -np.unwrap(np.arctan2(on_ellipse[:, 1], on_ellipse[:, 0]))
    theta4 = driven(Turning.of(theta2, 1.0), ellipse.eccentricity).theta
    widest = max(float(_level(points[:, 0], points[:, 1], ellipse).max()) for points in (two, four))
    reach = (math.sqrt(widest) + _REACH * pitch / ellipse.semi_major) ** 2
    parts = [
        _positions(
            two, four, theta2[i : i + _CHUNK], theta4[i : i + _CHUNK], ellipse, reach, _DEEPEST * pitch
        )
        for i in range(0, positions, _CHUNK)
    ]
    ahead, behind, depth, gap = (np.concatenate(column) for column in zip(*parts, strict=True))
    overlap = 0.0
    deep = np.flatnonzero(depth > allowance)
    if deep.size:
        some = deep[:: math.ceil(deep.size / _AREAS)]
        overlap = _overlap(gear2, gear4, theta2[some], theta4[some], 2 * ellipse.semi_major)
    return Mesh(theta2, ahead, behind, depth, gap, overlap)


def _cut_edges(points: Array, longest: float) -> Array:
    """Corners (n, 2) with every edge at most so long."""
    edge = np.roll(points, -1, axis=0) - points
    counts = np.maximum(1, np.ceil(np.hypot(*edge.T) / longest)).astype(np.int64)
    at = np.repeat(np.arange(len(points)), counts)
    step = np.arange(at.size) - np.repeat(np.cumsum(counts) - counts, counts)
    cut: Array = points[at] + (step / counts[at])[:, None] * edge[at]
    return cut


def _level(x: Array, y: Array, ellipse: Ellipse) -> Array:
    """Square of the scale (...) at which the pitch ellipse, blown up about its centre, reaches the points."""
    level: Array = ((x - ellipse.focal_distance) / ellipse.semi_major) ** 2 + (y / ellipse.semi_minor) ** 2
    return level


def _positions(
    two: Array, four: Array, theta2: Array, theta4: Array, ellipse: Ellipse, reach: float, deepest: float
) -> tuple[Array, Array, Array, Array]:
    """Play ahead and behind, depth and gap (k,) of some positions; ``reach``: level of the envelopes."""
    k, distance = theta2.size, 2 * ellipse.semi_major
    # Everything is seen from gear 4, so that only gear 2 has to be moved.
    c, s = np.cos(theta2 - theta4)[:, None], np.sin(theta2 - theta4)[:, None]
    at = -distance * np.column_stack((np.cos(theta4), -np.sin(theta4)))
    x = c * two[:, 0] - s * two[:, 1] + at[:, :1]
    y = s * two[:, 0] + c * two[:, 1] + at[:, 1:]
    near2 = _level(x, y, ellipse) < reach
    back = distance * np.column_stack((np.cos(theta2), -np.sin(theta2)))
    near4 = (
        _level(
            c * four[:, 0] + s * four[:, 1] + back[:, :1],
            c * four[:, 1] - s * four[:, 0] + back[:, 1:],
            ellipse,
        )
        < reach
    )
    group2, _ = np.nonzero(near2)
    group4, index4 = np.nonzero(near4)
    points2, points4 = np.column_stack((x[near2], y[near2])), four[index4]
    from2, to2 = _edges(near2)
    edges2 = np.column_stack((x[from2], y[from2])), np.column_stack((x[to2], y[to2])), from2[0]
    from4, to4 = _edges(near4)
    edges4 = four[from4[1]], four[to4[1]], from4[0]
    pitch_ring = float(np.median(np.hypot(*(edges4[1] - edges4[0]).T))) if len(edges4[0]) else 1.0
    ahead, behind = np.full(k, np.inf), np.full(k, np.inf)
    depth, gap = np.zeros(k), np.full(k, np.inf)
    groups, turns, distances = [], [], []
    for points, group, edges, moving in ((points2, group2, edges4, False), (points4, group4, edges2, True)):
        free = turns_to_edges(points, group, *edges, pitch_ring)
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
        inside &= nearer * np.hypot(*points.T) < deepest
        retreats = inside & ((under <= over) if moving else (over <= under))
        advances = inside & ~retreats
        forward = np.where(retreats, -nearer, np.where(advances, np.inf, forward))
        backward = np.where(advances, -nearer, np.where(retreats, np.inf, backward))
        np.minimum.at(ahead, group, forward)
        np.minimum.at(behind, group, backward)
        np.maximum.at(depth, group[inside], free.distance[inside])
        groups.append(group)
        turns.append(np.minimum(forward, backward))
        distances.append(np.where(inside, 0.0, free.distance))
    # The gap is where the least turn is: elsewhere the arcs are too long to be measured along a normal.
    group, turn = np.concatenate(groups), np.concatenate(turns)
    closest = turn <= np.minimum(ahead, behind)[group]
    np.minimum.at(gap, group[closest], np.concatenate(distances)[closest])
    return ahead, behind, depth, gap


def _edges(near: Flags) -> tuple[tuple[Ints, Ints], tuple[Ints, Ints]]:
    """Index arrays of the first and second corners of edges with an end near contact."""
    row, column = np.nonzero(near | np.roll(near, -1, axis=1))
    return (row, column), (row, (column + 1) % near.shape[1])


def _turned(points: Array, angles: Array) -> Array:
    """Points (n, 2) turned by angles (k,): (k, n, 2)."""
    c, s = np.cos(angles)[:, None], np.sin(angles)[:, None]
    x, y = points.T
    return np.stack((c * x - s * y, s * x + c * y), axis=-1)


def _overlap(gear2: Array, gear4: Array, theta2: Array, theta4: Array, distance: float) -> float:
    """Largest common area, mm², over some positions."""
    import shapely

    areas = []
    shift = np.array([distance, 0.0])
    for one, other in zip(_turned(gear2, theta2), _turned(gear4, theta4) + shift, strict=True):
        low, high = np.maximum(one.min(0), other.min(0)), np.minimum(one.max(0), other.max(0))
        if (low < high).all():
            shapes = (shapely.clip_by_rect(shapely.Polygon(gear), *low, *high) for gear in (one, other))
            areas.append(float(shapely.intersection(*shapes).area))
    return max(areas, default=0.0)
