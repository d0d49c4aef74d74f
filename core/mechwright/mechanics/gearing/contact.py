"""Where two gears meet in given positions: play, depth and gap, from the edges near contact."""

import math

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.gearing.crossings import turns_to_edges
from mechwright.mechanics.gearing.penetration import depths
from mechwright.mechanics.gearing.zone import Near

_SIGHT = 0.5
"""Pitches: half the least arc on both sides of a point in which it looks for edges."""


def contact(
    driver: Near, driven: Near, count: int, pitch: float, allowance: float
) -> tuple[Array, Array, Array, Array]:
    """Play ahead and behind, depth and gap (count,) of some positions."""
    edge = np.hypot(*(driven.ends - driven.starts).T)
    ring = float(edge.mean()) if edge.size else math.inf
    ahead, behind = np.full(count, np.inf), np.full(count, np.inf)
    depth, gap = np.zeros(count), np.full(count, np.inf)
    groups, turns, distances, blind = [], [], [], []
    for own, other, moving in ((driver, driven, False), (driven, driver, True)):
        group = own.position
        free = turns_to_edges(
            own.points, group, other.starts, other.ends, other.edge_position, ring, _SIGHT * pitch
        )
        # The driven gear turning ahead brings its leaving edges to points of the driver that lie ahead of
        # them, and its own points to entering edges of the driver.
        forward = free.entering_ahead if moving else free.leaving_behind
        backward = free.leaving_behind if moving else free.entering_ahead
        # A point stands in material if the edges on both sides say so; one side may have none in sight.
        # It is freed over the nearer edge, the driven gear turning one way for its own points and the other
        # way for points of the driver.
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
    for own, other, unseen in ((driver, driven, blind[0]), (driven, driver, blind[1])):
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
