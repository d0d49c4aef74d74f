"""Proof that two finished gears run together: overlap, play, transmission error, from outlines alone.

Nothing here knows how the teeth were made: the input is two polygons, from the outline, from a STEP file read
back, or as the cutters leave the parts.

Glossary
--------
position
    An angle θ1 of the driver with the driven gear at the exact angle of the law.
play
    How far the driven gear may turn from there, rad, until a flank meets: ``ahead`` counter-clockwise,
    ``behind`` clockwise. Negative where the outlines overlap.
transmission error
    Peak to peak of the play of one flank over the turn, rad: how far the driven gear strays from the exact
    motion while that flank drives.
depth
    How deep one outline stands in the other in position, mm: the greatest distance of a corner of one from
    the other's nearest edge; 0 where none stands in it.
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.gearing.candidates import count_up
from mechwright.mechanics.gearing.contact import contact
from mechwright.mechanics.gearing.pair import Pair
from mechwright.mechanics.gearing.zone import Envelope, Near, Rim, turned

EDGES_PER_PITCH = 16
"""Longer edges are cut, so that an edge is a short piece of one flank."""

_CHUNK = 32
"""Positions at a time, at most: bounds the memory, a few ten MB."""

_REACH = 0.1
"""Pitches by which a gear's envelope is widened: what lies within it is looked at."""

_AREAS = 64
"""Most positions whose overlap area is measured: those with the greatest depths."""


@dataclass(frozen=True)
class Mesh:
    """What the proof found.

    Parameters
    ----------
    arc
        Positions (n,): arc of the driver's pitch point, mm.
    angles
        θ1 and θ2 (n,), rad.
    ahead, behind
        Play (n,), rad.
    depth
        Depth (n,), mm.
    gap
        Normal distance (n,), mm, where the least turn brings the outlines together; 0 where they overlap.
        Beside a fillet that a cutter left they may be nearer, which takes more of a turn.
    overlap
        Largest overlap area over the positions, mm²; 0 where no depth is above the allowance.
    """

    arc: Array
    angles: tuple[Array, Array]
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
        """Turn (n,), rad, of the driven gear from flank to flank."""
        play: Array = self.ahead + self.behind
        return play


def swing(values: Array) -> float:
    """Peak to peak of values (n,); inf if one of them is not finite."""
    return float(np.ptp(values)) if np.isfinite(values).all() else math.inf


def mesh(
    driver: Array,
    driven: Array,
    pair: Pair,
    teeth: int,
    *,
    positions: int | None = None,
    allowance: float,
    stop: bool = False,
) -> Mesh:
    """Run two outlines against each other until the same teeth meet again.

    Parameters
    ----------
    driver, driven
        Corners (n, 2), mm, each in its body frame, material on the left: counter-clockwise, and of the teeth
        of a ring clockwise; not repeated at the end.
    pair
        How they turn.
    teeth
        Number of teeth of the driver.
    positions
        Number of positions, as in :meth:`Pair.run`.
    allowance
        Depth that counts as contact, mm: what fitting and flattening may put on both outlines.
    stop
        Whether to look no further once outlines meet more deeply: what is found then is of some positions.
    """
    arc = pair.run(teeth, positions)
    theta1, theta2 = pair.angles(arc)
    chunks = list(_spread(0, arc.size))
    parts = []
    for part in _contacts(
        driver, driven, pair, teeth, allowance, ((theta1[at], theta2[at]) for at in chunks)
    ):
        parts.append(part)
        if stop and part[2].max() > allowance:
            break
    seen = np.concatenate([np.arange(arc.size)[at] for at in chunks[: len(parts)]])
    order = np.argsort(seen)
    arc, theta1, theta2 = (values[seen[order]] for values in (arc, theta1, theta2))
    ahead, behind, depth, gap = (np.concatenate(column)[order] for column in zip(*parts, strict=True))
    deepest = np.argsort(-depth, kind="stable")[:_AREAS]
    some = deepest[depth[deepest] > allowance]
    overlap = _overlap(driver, driven, theta1[some], theta2[some], pair) if some.size else 0.0
    return Mesh(arc, (theta1, theta2), ahead, behind, depth, gap, overlap)


def first_depth(
    driver: Array, driven: Array, pair: Pair, teeth: int, *, span: tuple[float, float], allowance: float
) -> float:
    """How deep one outline stands in the other where that is first seen, mm; 0 where it is nowhere.

    Says whether :func:`mesh` would find a collision in less time, but not how deep the deepest is: positions
    far from each other are looked at first, and no further ones once outlines meet more deeply than
    ``allowance``. Parameters are those of :func:`mesh`, and ``span`` says which part of the arcs of
    :meth:`Pair.run` to look at, both ends as shares: of a pair whose other positions are their mirror images.
    """
    arc = pair.run(teeth)
    theta1, theta2 = pair.angles(arc)
    places = ((theta1[at], theta2[at]) for at in _spread(*(round(share * arc.size) for share in span)))
    depths = (found[2].max() for found in _contacts(driver, driven, pair, teeth, allowance, places))
    return next((float(depth) for depth in depths if depth > allowance), 0.0)


def _spread(low: int, high: int) -> Iterator[slice]:
    """Positions in portions, each spread over all of them: a collision shows in the first ones."""
    step = max(1, math.ceil((high - low) / _CHUNK))
    yield from (slice(low + number, high, step) for number in range(step))


def _contacts(
    driver: Array,
    driven: Array,
    pair: Pair,
    teeth: int,
    allowance: float,
    places: Iterable[tuple[Array, Array]],
) -> Iterator[tuple[Array, Array, Array, Array]]:
    """Ahead, behind, depth and gap (n,) of :class:`Mesh`, for each of some sets of angles θ1 and θ2 (n,)."""
    pitch = pair.pitch(teeth)
    one, two = (cut_edges(points, pitch / EDGES_PER_PITCH) for points in (driver, driven))
    rims = Rim.of(one), Rim.of(two)
    envelopes = (
        Envelope.of(one, pair.driver, _REACH * pitch),
        Envelope.of(two, pair.driven, _REACH * pitch, pair.side),
    )
    for theta1, theta2 in places:
        near = _near(rims, envelopes, pair.axis, theta1, theta2)
        yield contact(*near, theta1.size, pitch, allowance)


def cut_edges(points: Array, longest: float) -> Array:
    """Corners (n, 2) with every edge at most so long, and none of no length."""
    points = points[(points != np.roll(points, 1, axis=0)).any(axis=1)]
    edge = np.roll(points, -1, axis=0) - points
    counts = np.maximum(1, np.ceil(np.hypot(*edge.T) / longest)).astype(np.int64)
    at = np.repeat(np.arange(len(points)), counts)
    cut: Array = points[at] + (count_up(counts) / counts[at])[:, None] * edge[at]
    return cut


def _near(
    rims: tuple[Rim, Rim], envelopes: tuple[Envelope, Envelope], axis: float, theta1: Array, theta2: Array
) -> tuple[Near, Near]:
    """What of both gears is near contact in some positions, seen from the driven gear."""
    axis1 = -axis * np.column_stack((np.cos(theta2), -np.sin(theta2)))
    axis2 = axis * np.column_stack((np.cos(theta1), -np.sin(theta1)))
    return (
        rims[0].near(envelopes[1], theta1 - theta2, axis1, placed=True),
        rims[1].near(envelopes[0], theta2 - theta1, axis2, placed=False),
    )


def _overlap(driver: Array, driven: Array, theta1: Array, theta2: Array, pair: Pair) -> float:
    """Largest common area, mm², over some positions."""
    import shapely

    areas = []
    for angle1, angle2 in zip(theta1, theta2, strict=True):
        one = turned(driver, angle1)
        other = turned(driven, angle2) + np.array([pair.axis, 0.0])
        if pair.side < 0:  # what is not in the ring's opening stands in its teeth
            areas.append(float(shapely.difference(_valid(one), _valid(other)).area))
            continue
        low, high = np.maximum(one.min(0), other.min(0)), np.minimum(one.max(0), other.max(0))
        if (low < high).all():
            shapes = (shapely.clip_by_rect(_valid(gear), *low, *high) for gear in (one, other))
            areas.append(float(shapely.intersection(*shapes).area))
    return max(areas, default=0.0)


def _valid(corners: Array) -> Any:
    """The polygon of corners (n, 2); where teeth cut themselves, its parts."""
    import shapely

    found = shapely.Polygon(corners)
    return found if found.is_valid else shapely.make_valid(found)
