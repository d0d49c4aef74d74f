"""Where holding tabs may stand: never on a wall that guides a roller, nor on an arc that locks.

What stays of a tab would lift the mechanism's parts off one another there. The rim and the reliefs of the
locking disc only pass other parts, at the locking clearance.
"""

import math

import numpy as np
import shapely

from mechwright import TOLERANCES, Array, Loop, Point

HARMLESS = frozenset({"rim", "relief", "crank", "hub"})
"""Tags of the stretches of an outline that touch nothing."""

_PITCH = 10.0
"""About the distance of tab sites, mm: nearer to one another two tabs hold no better than one."""

_LEAST = 6
"""Sites that the harmless stretches are divided into at least: four tabs, and two more to choose."""

_SHARE = 0.7
"""Share of the distance between sites that a tab may take."""

_BEYOND = 30.0
"""How far outwards the way of a tab to the frame must not meet the part again, mm: a cutter and a frame."""


def tab_sites(outer: Loop, within: float = math.inf) -> tuple[tuple[Point, float], ...]:
    """Places for tabs on an outline, each with the widest tab, mm; none if any place will do.

    Places farther than ``within`` from the axis, mm, are left out.
    """
    if all(segment.tag in HARMLESS for segment in outer.segments):
        return ()
    plate = shapely.Polygon(outer.flatten())
    shapely.prepare(plate)
    sites: list[tuple[Point, float]] = []
    runs = _runs(outer)
    for run in runs:
        line = shapely.LineString(run)
        count = max(math.ceil(_LEAST / len(runs)), round(line.length / _PITCH))
        pitch = line.length / count
        for number in range(count):
            middle = (number + 0.5) * pitch
            ends = [line.interpolate(middle + side * _SHARE * pitch / 2) for side in (-1, 1)]
            if _is_free(plate, [(end.x, end.y) for end in ends]):
                place = line.interpolate(middle)
                if math.hypot(place.x, place.y) <= within:
                    sites.append(((place.x, place.y), _SHARE * pitch))
    return tuple(sites)


def _runs(outer: Loop) -> list[Array]:
    """Points along each connected stretch of harmless segments."""
    segments = list(outer.segments)
    first = next(i for i, segment in enumerate(segments) if segment.tag not in HARMLESS)
    runs: list[list[Array]] = [[]]
    for segment in segments[first:] + segments[:first]:
        if segment.tag not in HARMLESS:
            runs.append([])
        else:
            runs[-1].append(segment.flatten(TOLERANCES.flatten))
    return [np.concatenate(run) for run in runs if run]


def _is_free(plate: shapely.Polygon, chord: list[Point]) -> bool:
    """Whether the way outwards from a tab's foot, counter-clockwise on the outline, meets no more of it."""
    (ax, ay), (bx, by) = chord
    length = math.hypot(bx - ax, by - ay)
    # On a curve the part bulges over the chord: start clear of that.
    out = np.array([by - ay, ax - bx]) / length
    near, far = length * out, _BEYOND * out
    feet = np.array(chord)
    way = shapely.Polygon([feet[0] + near, feet[0] + far, feet[1] + far, feet[1] + near])
    return not shapely.intersects(plate, way)
