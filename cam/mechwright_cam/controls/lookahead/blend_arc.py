"""The arcs by which LinuxCNC's planner rounds corners."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cam.controls.lookahead.segments import NORMAL, Segments
from mechwright_cam.controls.reading.run import Ints

FLAT = 1e-3
"""Segments of which a direction leaves the plane of an arc by more are not in that plane, rad."""
FAR = 1e4
"""A line is taken as an arc of this radius, mm: 0.01 µm off it at the end of half a millimetre."""
SHORTEST = 1e-6
"""Shortest arc that is made, mm."""


@dataclass(frozen=True)
class BlendArcs:
    """Arcs of p kinds of junction: (p,) speed, mm/s, 0 for none, length and trim, mm."""

    speed: Array
    length: Array
    trim: Array


def blend_arcs(row: Segments, cycle: float) -> BlendArcs:
    """The arc that each corner would get: as wide as P and half of either segment allow.

    No faster than along all of it in one servo period, ``cycle``, s. Where an arc of the program bends the
    way that the corner turns, the planner takes its secant, and less of it.
    """
    one, two = row.before, row.after
    before, after = row.last[one], row.first[two]
    turn = np.arccos(np.clip((before * after).sum(axis=1), -1.0, 1.0))
    half = (np.pi - turn) / 2  # between either segment and the middle of the corner
    side = np.sign(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0])
    theta, reach, within = half.copy(), [], []
    for mine, most in ((one, 2 / 3), (two, 1 / 3)):
        arc = row.arc[mine]
        inward = arc & (np.sign(row.signed[mine]) == side)
        angle = np.minimum(row.sweep[mine] * most, np.where(inward, half, np.pi / 2))
        theta = np.where(inward, np.minimum(theta, half - angle / 4), theta)
        radius = np.where(arc, row.radius[mine], 0.0)
        arced = np.where(inward, np.sin(angle / 4), angle) * radius
        reach.append(np.where(arc, arced, row.length[mine] / 2))
        within.append(np.where(arc, np.where(inward, -1.0, 1.0), 0.0))
    tolerance = np.where(row.blend[one] > 0, row.blend[one], np.inf)
    tolerance = np.minimum(tolerance, np.minimum(row.length[one], row.length[two]) / 4)
    theta = np.clip(theta, 1e-6, np.pi / 2 - 1e-6)
    along = np.minimum(np.minimum(*reach), np.cos(theta) * tolerance / (1 - np.sin(theta)))
    widest = np.tan(theta) * along
    across = NORMAL * row.highest[one]
    speed = np.minimum(np.sqrt(across * widest), np.maximum(row.speed[one], row.speed[two]))
    slow = row.highest[one] / 2
    lasts = np.minimum(np.sqrt(2 * slow * along), speed) / slow
    bend = np.pi - 2 * theta
    radius = np.maximum(speed**2 / across, np.minimum(lasts * speed / bend, widest))
    curved = row.arc[one] | row.arc[two]
    level = (np.abs(before[:, 2]) < FLAT) & (np.abs(after[:, 2]) < FLAT)
    able = (radius * bend > SHORTEST) & (turn > 2e-6) & (~curved | level)
    trim = radius / np.tan(theta)
    at = np.flatnonzero(able & curved)
    able[at], trim[at], bend[at] = _fitted(
        row, at, radius[at], side[at], [bends[at] for bends in within], tolerance[at]
    )
    length = radius * bend
    return BlendArcs(np.where(able, np.minimum(speed, length / cycle), 0.0), length, trim)


def _fitted(
    row: Segments, at: Ints, radius: Array, side: Array, within: list[Array], tolerance: Array
) -> tuple[NDArray[np.bool_], Array, Array]:
    """Whether a circle (k,) touches both segments within the tolerance; what it takes of them; its angle.

    ``at``: kinds of junction. ``within``: of either segment 1 for an arc that the circle touches from
    outside, -1 from inside, 0 for a line.
    """
    before, after = row.before[at], row.after[at]
    # What the circle's middle keeps from: so far from a centre, or from a line as if its centre were far
    # away.
    centres, keeps, owns = [], [], []
    for tangents, index, bends in ((row.last, before, within[0]), (row.first, after, within[1])):
        tangent = tangents[index, :2]
        left = np.column_stack((-tangent[:, 1], tangent[:, 0]))
        line = bends == 0
        own = np.where(line, FAR, row.radius[index])
        way = np.where(line, side, np.sign(row.signed[index]))
        centres.append(left * (way * own)[:, None])
        owns.append(own)
        keeps.append(own + np.where(line, -1.0, bends) * radius)
    apart = centres[1] - centres[0]
    distance = np.maximum(np.sqrt((apart**2).sum(axis=1)), 1e-12)
    unit = apart / distance[:, None]
    ahead = (keeps[0] ** 2 - keeps[1] ** 2 + distance**2) / (2 * distance)
    rest = keeps[0] ** 2 - ahead**2
    aside = np.sqrt(np.maximum(rest, 0.0))[:, None] * np.column_stack((-unit[:, 1], unit[:, 0]))
    base = centres[0] + ahead[:, None] * unit
    either = np.stack((base + aside, base - aside))
    middle = np.take_along_axis(either, np.argmin((either**2).sum(axis=2), axis=0)[None, :, None], axis=0)[0]
    high = np.sqrt((middle**2).sum(axis=1))
    fits = (rest >= 0) & (high - radius <= tolerance)
    touching = [
        np.sign(keep - own)[:, None] * (centre - middle) / np.maximum(np.abs(keep), 1e-12)[:, None]
        for centre, keep, own in zip(centres, keeps, owns, strict=True)
    ]
    angle = np.arccos(np.clip((touching[0] * touching[1]).sum(axis=1), -1.0, 1.0))
    return fits, np.sqrt(np.maximum(high**2 - radius**2, 0.0)), angle
