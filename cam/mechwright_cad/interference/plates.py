"""Plates that stay parallel: an exact comparison in the plane, over the whole motion.

One plate is at rest and the other one moves. The fixed one has lost a skin of ``TOUCH``, so that a fit
without clearance and the errors of chords are no collision. Two circles are compared in closed form, a pin
moves as one ball, and everything else edge by edge (see :mod:`mechwright_cad.interference.sweep`).
"""

from collections.abc import Iterator, Sequence
from itertools import product

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright_cad.interference.instants import SAG
from mechwright_cad.interference.path import Path
from mechwright_cad.interference.slabs import TOUCH, Circle, Ring, Slab
from mechwright_cad.interference.sweep import FLOOR, Found, sweep
from mechwright_cad.interference.tree import Tree, ring_edges

_HALVINGS = 24
"""Most halvings of an interval for two circles: from any speed down to the floor."""

_LOOKS = 61
"""Instants at which two slabs are looked at that collide from the start."""

_NEVER = Found(np.empty(0), None, np.inf)
"""Two slabs that never come near each other."""


def meetings(fixed: Slab, moving: Slab, path: Path) -> Found:
    """Find when two slabs overlap in plan view.

    Heights are not looked at. ``path`` is that of the moving slab's body.
    """
    if _far(fixed, moving, path):
        return _NEVER
    if fixed.disc is not None and moving.disc is None:
        return meetings(moving, fixed, _inverse(path))
    if shapely.intersects(fixed.core_shape, placed(moving.polygon, path, 0.0)):
        return _from_the_start(fixed, moving, path)
    if path.still:
        return Found(np.empty(0), 0.0, 0.0)
    results = [*_between_circles(fixed, moving, path), *_between_edges(fixed, moving, path)]
    if not results:  # nothing is left of the fixed slab without its skin
        return _NEVER
    best = min(results, key=lambda found: found.gap)
    return Found(np.unique(np.concatenate([found.hits for found in results])), best.closest, best.gap)


def _from_the_start(fixed: Slab, moving: Slab, path: Path) -> Found:
    """Two slabs that collide at once: whatever follows, some instants are enough to look for the deepest."""
    times = np.zeros(1) if path.still else np.linspace(0.0, path.samples - 1.0, _LOOKS)
    there = [placed(moving.polygon, path, float(time)) for time in times]
    return Found(times[shapely.intersects(fixed.core_shape, there)], None, 0.0)


def _between_circles(fixed: Slab, moving: Slab, path: Path) -> list[Found]:
    """Every round loop of one slab against every one of the other."""
    here, there = ([ring.circle for ring in rings if ring.circle] for rings in (fixed.core, moving.rings))
    return [_circles(one, two, path) for one, two in product(here, there)]


def _between_edges(fixed: Slab, moving: Slab, path: Path) -> Iterator[Found]:
    """What is not round against all of the other slab; a pin is one ball."""
    edgy_fixed, _ = _by_shape(fixed.core)
    edgy_moving, round_moving = _by_shape(moving.rings)
    if moving.disc is not None and edgy_fixed:
        ball = Tree.of(moving.disc.centre[None, None], moving.disc.radius)
        yield sweep(_edges(edgy_fixed), ball, path)
    elif edgy_fixed and round_moving:
        yield sweep(_edges(edgy_fixed), _edges(round_moving), path)
    if edgy_moving:
        yield sweep(_edges(fixed.core), _edges(edgy_moving), path)
    if fixed.points.size and moving.core:
        # A point loses more than TOUCH with the skin, so it is taken as it is against the other one's core.
        yield sweep(_edges(moving.core), Tree.of(fixed.points), _inverse(path))


def _by_shape(rings: Sequence[Ring]) -> tuple[list[Ring], list[Ring]]:
    """Loops that are no circles, and those that are."""
    return [ring for ring in rings if ring.circle is None], [ring for ring in rings if ring.circle]


def placed(polygon: shapely.Polygon, path: Path, time: float) -> shapely.Polygon:
    """A polygon of the moving body, where it is at a time, mm."""
    rotation, position = path.at(np.array([time]))
    return shapely.transform(polygon, lambda points: points @ rotation[0].T + position[0])


def _far(fixed: Slab, moving: Slab, path: Path) -> bool:
    """Whether circles about the two never come together; samples, and what may lie between two of them."""
    one, two = fixed.around, moving.around
    centre = _centre(two, path, np.arange(path.samples, dtype=float))
    steps = np.hypot(*np.diff(centre, axis=0).T) if len(centre) > 1 else np.zeros(1)
    gap = float(np.hypot(*(centre - one.centre).T).min()) - one.radius - two.radius
    return gap > float(steps.max())


def _edges(rings: Sequence[Ring]) -> Tree:
    return Tree.of(np.concatenate([ring_edges(ring.points) for ring in rings]))


def _inverse(path: Path) -> Path:
    rotation, position = path.at(np.arange(path.samples, dtype=float))
    back = -np.einsum("nji,nj->ni", rotation, position)
    return Path(back, -path.attitude)


def _circles(one: Circle, two: Circle, path: Path) -> Found:
    """When two circles meet: the distance of their centres is between difference and sum of the radii."""
    low, high = abs(one.radius - two.radius), one.radius + two.radius
    start, step = np.arange(path.samples - 1, dtype=float), 1.0
    hits: list[Array] = []
    gap, closest = np.inf, None
    for _ in range(_HALVINGS):
        centres = np.stack([_centre(two, path, start + part * step) for part in (0.0, 0.5, 1.0)])
        distance = np.hypot(*np.moveaxis(centres - one.centre, -1, 0))
        slack = SAG * np.hypot(*(centres[0] - 2 * centres[1] + centres[2]).T)
        travel = np.hypot(*(centres[1:] - centres[:-1]).transpose(2, 0, 1)).max(axis=0)
        apart = np.maximum(distance[1] - high, low - distance[1])
        if apart.size and apart.min() < gap:
            gap, closest = float(apart.min()), float(start[apart.argmin()] + step / 2)
        meet = apart <= 0
        hits.append(start[meet] + step / 2)
        open_ = ~meet & (apart <= travel + slack) & (travel > FLOOR)
        start = np.concatenate((start[open_], start[open_] + step / 2))
        step /= 2
        if not start.size:
            break
    return Found(np.unique(np.concatenate(hits)), closest, gap)


def _centre(circle: Circle, path: Path, times: Array) -> Array:
    rotation, position = path.at(times)
    centre: Array = rotation @ circle.centre + position
    return centre


def depth(fixed: Slab, moving: Slab, path: Path, time: float) -> tuple[float, Array]:
    """How deep two slabs stand in each other in plan view, mm, and where (2,), in the fixed body's frame.

    That is the greatest distance of a point of either boundary, inside the other slab, from its boundary; or
    the diameter of the largest circle in both, where that is more (of two copies in one place the boundaries
    are not inside each other).
    """
    here, there = fixed.polygon, placed(moving.polygon, path, time)
    best, at = 0.0, np.zeros(2)
    for one, two in ((here, there), (there, here)):
        inside = shapely.intersection(one.boundary, two)
        if inside.is_empty:
            continue
        fine = shapely.segmentize(inside, max(inside.length / 400, TOUCH))
        points = shapely.get_coordinates(fine)
        far = _from_the_boundary(points, two)
        if far.max() > best:
            best, at = float(far.max()), points[far.argmax()]
    common = shapely.intersection(here, there)
    if common.area > best * common.length / 2:
        largest = shapely.maximum_inscribed_circle(common, tolerance=TOUCH)
        if 2 * largest.length > best:
            best, at = 2 * largest.length, shapely.get_coordinates(largest)[0]
    return best, at


def _from_the_boundary(points: Array, polygon: shapely.Polygon) -> Array:
    """Distance (n,) of points (n, 2) from a polygon's boundary, mm, found among its edges by a tree."""
    loops = [shapely.get_coordinates(loop) for loop in (polygon.exterior, *polygon.interiors)]
    edges = np.concatenate([np.stack((loop[:-1], loop[1:]), axis=1) for loop in loops])
    tree = shapely.STRtree(shapely.linestrings(edges))
    _, far = tree.query_nearest(shapely.points(points), return_distance=True, all_matches=False)
    return np.asarray(far, dtype=np.float64)


def gap(fixed: Slab, moving: Slab, path: Path, time: float) -> float:
    """Distance of two slabs in plan view at a time, mm."""
    return float(shapely.distance(fixed.polygon, placed(moving.polygon, path, time)))
