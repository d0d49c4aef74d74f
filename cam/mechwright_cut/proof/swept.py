"""What a beam takes: its width laid along its way, as polygons."""

import math
from collections.abc import Iterable, Sequence

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright_cut.proof.reading import Motion

CHORD = 0.0004
"""Chord error of arcs and of the ends of the kerf, mm: a twelfth of what the proof lets pass."""


def points_of(motion: Motion) -> Array:
    """Points (n, 2) along a move, chords within CHORD."""
    if motion.centre is None:
        return np.array([motion.start, motion.end])
    (x, y), (cx, cy) = motion.start, motion.centre
    radius = math.dist(motion.start, motion.centre)
    begin = math.atan2(y - cy, x - cx)
    sweep = (motion.turn * (math.atan2(motion.end[1] - cy, motion.end[0] - cx) - begin)) % math.tau
    sweep = (sweep or math.tau) * motion.turn
    step = 2 * math.acos(max(1 - CHORD / radius, 0.0)) if radius > CHORD else math.pi / 2
    angle = begin + np.linspace(0.0, sweep, max(2, math.ceil(abs(sweep) / step)) + 1)
    points = np.column_stack((cx + radius * np.cos(angle), cy + radius * np.sin(angle)))
    points[0], points[-1] = motion.start, motion.end
    return points


def runs(motions: Sequence[Motion]) -> list[list[Motion]]:
    """Moves with the beam on that follow each other without a break."""
    found: list[list[Motion]] = []
    before: Motion | None = None
    for motion in motions:
        if motion.power > 0:
            if before is not None and before.power == motion.power and before.end == motion.start:
                found[-1].append(motion)
            else:
                found.append([motion])
        before = motion
    return found


def way(run: Iterable[Motion]) -> shapely.LineString:
    """The middle of the beam along some moves."""
    parts = [points_of(motion) for motion in run]
    points = np.concatenate([parts[0], *(part[1:] for part in parts[1:])])
    return shapely.LineString(points)


def disc(line: shapely.Geometry, kerf: float) -> shapely.Geometry:
    """What a beam of this width takes along a line."""
    half = kerf / 2
    corners = max(8, math.ceil(math.pi / 4 / math.acos(max(1 - CHORD / half, 0.0))))
    return shapely.buffer(line, half, quad_segs=corners)
