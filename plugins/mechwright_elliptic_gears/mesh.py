"""Proof that two finished gears run together: overlap, play and transmission error, from their outlines alone.

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

from dataclasses import dataclass

import numpy as np

from mechwright.motion import Array
from mechwright_elliptic_gears.crossings import Free, Ints, turns_to_edges
from mechwright_elliptic_gears.ellipse import Ellipse
from mechwright_elliptic_gears.kinematics import Turning, driven

POSITIONS_PER_TOOTH = 4
"""Positions per tooth. One more over the whole turn makes the step unrelated to the pitch, so that every part
of the mesh cycle is met."""

EDGES_PER_PITCH = 64
"""Longer edges are cut, so that corners stand close enough to feel every contact."""

_CHUNK = 32
"""Positions at a time: bounds the memory, a few ten MB."""

_SECTORS = 720
"""Sectors of the envelope that finds the teeth near contact."""

_REACH = 0.25
"""Pitches that the envelope is widened by, so that both flanks beside a point are seen."""

_AREAS = 8
"""Positions, the deepest first, whose overlap area is measured."""


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
    reaches = [_Envelope.of(points, _REACH * pitch) for points in (two, four)]
    parts = [
        _positions(two, four, reaches[0], reaches[1], theta2[i : i + _CHUNK], theta4[i : i + _CHUNK], ellipse)
        for i in range(0, positions, _CHUNK)
    ]
    ahead, behind, depth, gap = (np.concatenate(column) for column in zip(*parts, strict=True))
    overlap = 0.0
    deepest = np.argsort(-depth, kind="stable")[:_AREAS]
    worst = deepest[depth[deepest] > allowance]
    if worst.size:
        overlap = _overlap(gear2, gear4, theta2[worst], theta4[worst], 2 * ellipse.semi_major)
    return Mesh(theta2, ahead, behind, depth, gap, overlap)


def _cut_edges(points: Array, longest: float) -> Array:
    """Corners (n, 2) with every edge at most so long."""
    edge = np.roll(points, -1, axis=0) - points
    counts = np.maximum(1, np.ceil(np.hypot(*edge.T) / longest)).astype(np.int64)
    at = np.repeat(np.arange(len(points)), counts)
    step = np.arange(at.size) - np.repeat(np.cumsum(counts) - counts, counts)
    cut: Array = points[at] + (step / counts[at])[:, None] * edge[at]
    return cut


@dataclass(frozen=True)
class _Envelope:
    """How far a gear reaches in each direction from its axis, squared, mm²."""

    squared: Array

    @classmethod
    def of(cls, points: Array, margin: float) -> "_Envelope":
        sector = _sector(np.arctan2(points[:, 1], points[:, 0]))
        reach = np.zeros(_SECTORS)
        np.maximum.at(reach, sector, np.hypot(*points.T))
        # A tooth must cover the spaces beside it: half a pitch is never wider than this many sectors.
        wide = reach
        for shift in range(1, _SECTORS // 36):
            wide = np.maximum(wide, np.maximum(np.roll(reach, shift), np.roll(reach, -shift)))
        return cls((wide + margin) ** 2)

    def holds(self, points: Array, turned: Array) -> np.ndarray[tuple[int, ...], np.dtype[np.bool_]]:
        """Whether points (k, n, 2), from the axis, lie within, the gear being turned by (k,)."""
        squared = points[..., 0] ** 2 + points[..., 1] ** 2
        inside = squared < self.squared.max()
        row, column = np.nonzero(inside)
        near = points[row, column]
        sector = _sector(np.arctan2(near[:, 1], near[:, 0]) - turned[row])
        inside[row, column] = squared[row, column] < self.squared[sector]
        return inside


def _sector(angle: Array) -> Ints:
    sector: Ints = np.floor(angle * (_SECTORS / (2 * np.pi))).astype(np.int64) % _SECTORS
    return sector


def _positions(
    two: Array,
    four: Array,
    reach2: _Envelope,
    reach4: _Envelope,
    theta2: Array,
    theta4: Array,
    ellipse: Ellipse,
) -> tuple[Array, Array, Array, Array]:
    """Play ahead and behind, depth and gap (k,) of some positions."""
    k = theta2.size
    axis = np.array([2 * ellipse.semi_major, 0.0])
    # All points from O4, where gear 4 turns.
    placed2, placed4 = _turned(two, theta2) - axis, _turned(four, theta4)
    near2 = reach4.holds(placed2, theta4)
    near4 = reach2.holds(placed4 + axis, theta2)
    points2, group2 = placed2[near2], np.nonzero(near2)[0]
    points4, group4 = placed4[near4], np.nonzero(near4)[0]
    edges2, edges4 = _edges(placed2, near2), _edges(placed4, near4)
    ring = ellipse.perimeter / (EDGES_PER_PITCH * len(two)) * EDGES_PER_PITCH
    ahead, behind = np.full(k, np.inf), np.full(k, np.inf)
    depth, gap = np.zeros(k), np.full(k, np.inf)
    # Gear 4 turning ahead brings its leaving edges to points of gear 2 that lie ahead of them, and its own
    # points to entering edges of gear 2.
    for points, group, edges, moving in ((points2, group2, edges4, False), (points4, group4, edges2, True)):
        free = turns_to_edges(points, group, *edges, ring)
        forward = free.entering_ahead if moving else free.leaving_behind
        backward = free.leaving_behind if moving else free.entering_ahead
        inside, out_ahead, out_behind = _inside(free)
        # A point inside is freed over the nearer side; gear 4 moves one way, its own points the other.
        over, back = (out_behind, out_ahead) if moving else (out_ahead, out_behind)
        first = inside & (over <= back)
        second = inside & ~first
        forward = np.where(inside, np.where(first, -over, np.inf), forward)
        backward = np.where(inside, np.where(second, -back, np.inf), backward)
        np.minimum.at(ahead, group, forward)
        np.minimum.at(behind, group, backward)
        nearest = np.minimum(free.distance_ahead, free.distance_behind)
        np.minimum.at(gap, group, np.where(inside, 0.0, nearest))
        np.maximum.at(depth, group[inside], nearest[inside])
    return ahead, behind, depth, gap


def _inside(free: Free) -> tuple[np.ndarray[tuple[int, ...], np.dtype[np.bool_]], Array, Array]:
    """Which queries stand in material, and the turns that free them ahead and behind."""
    behind = free.entering_behind < free.leaving_behind
    ahead = free.leaving_ahead < free.entering_ahead
    return behind & ahead, free.leaving_ahead, free.entering_behind


def _turned(points: Array, angles: Array) -> Array:
    """Points (n, 2) turned by angles (k,): (k, n, 2)."""
    c, s = np.cos(angles)[:, None], np.sin(angles)[:, None]
    x, y = points.T
    return np.stack((c * x - s * y, s * x + c * y), axis=-1)


def _edges(placed: Array, near: np.ndarray[tuple[int, ...], np.dtype[np.bool_]]) -> tuple[Array, Array, Ints]:
    """Edges with an end near contact: starts and ends (m, 2), and their positions (m,)."""
    row, column = np.nonzero(near | np.roll(near, -1, axis=1))
    return placed[row, column], placed[row, (column + 1) % placed.shape[1]], row


def _overlap(gear2: Array, gear4: Array, theta2: Array, theta4: Array, distance: float) -> float:
    """Largest common area, mm², over some positions."""
    import shapely

    areas = []
    for one, other in zip(_turned(gear2, theta2), _turned(gear4, theta4) + (distance, 0.0), strict=True):
        first, second = shapely.Polygon(one), shapely.Polygon(other)
        x0, y0, x1, y1 = np.array(
            [np.maximum(first.bounds, second.bounds)[:2], np.minimum(first.bounds, second.bounds)[2:]]
        ).ravel()
        if x0 >= x1 or y0 >= y1:
            continue
        clipped = (shapely.clip_by_rect(shape, x0, y0, x1, y1) for shape in (first, second))
        areas.append(shapely.intersection(*clipped).area)
    return max(areas, default=0.0)
