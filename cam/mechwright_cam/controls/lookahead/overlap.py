"""Overlapping moves: the next one begins while the one before still slows down.

Speed at which that begins, and how far it takes the tool off the path. In lines of equal acceleration P
bounds it. On arcs the way to the corner bends, so that even where both meet without a kink their sum is off
the path by the bend; and the climb of a helix counts for no turn.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cam.controls.lookahead.segments import Segments

LEAST_SINE = np.sin(1e-3)
"""Half a turn below this is none: P bounds nothing then."""
INSTANTS = 33
"""An overlap is looked at so many times."""


@dataclass(frozen=True)
class Overlaps:
    """Between each two of m segments.

    ``seconds`` (m - 1,) that are saved, ``off`` (m - 1,) the path, mm, and ``performance`` (m - 1,) as the
    planner rates it, mm/s.
    """

    seconds: Array
    off: Array
    performance: Array


def overlaps(
    row: Segments,
    rate: Array,
    which: NDArray[np.bool_],
    speed: Array,
    planned: bool = False,
    late: float | None = None,
) -> Overlaps:
    """The overlaps at some of the junctions.

    Parameters
    ----------
    row
        The segments.
    rate
        (m,) acceleration of each along its path while it overlaps, mm/s².
    which
        (m - 1,) bool, where they are.
    speed
        (m,) mm/s.
    planned
        Whether to ask only how the planner rates them: each may use half of its segment.
    late
        So much longer an overlap may take than it should, s, since it begins with a servo period; None if
        nobody asks how far it is off, which is then 0.
    """
    length = row.length / 2 if planned else row.length
    summit = np.minimum(np.sqrt(rate * length), speed)
    longest = np.minimum(*_sides(row.length / np.maximum(summit, 1e-12)))
    lasts = np.minimum(longest, np.maximum(*_sides(summit / rate)))
    into, out_of = (np.minimum(top, lasts * a) for top, a in zip(_sides(summit), _sides(rate), strict=True))
    sine = _half_sine(row)
    bound = row.blend[:-1] > 0
    bound &= sine > LEAST_SINE
    most = np.where(bound, 2 * np.sqrt(rate[:-1] * row.blend[:-1] / np.maximum(sine, LEAST_SINE)), np.inf)
    into, out_of = np.minimum(into, most), np.minimum(out_of, most)
    performance = np.where(which, np.sqrt(1 - sine**2) * (into + out_of) / 2, 0.0)
    seconds = np.where(which, into / rate[:-1], 0.0)
    off = np.zeros(which.size)
    if late is not None and which.any():
        at = np.flatnonzero(which)
        off[at] = _off(row, at, rate, seconds[at] + late)
    return Overlaps(seconds, off, performance)


def _sides(values: Array) -> tuple[Array, Array]:
    return values[:-1], values[1:]


def _half_sine(row: Segments) -> Array:
    """Sine (m - 1,) of half the turn as the planner sees it.

    It sees directions of acceleration: an arc that begins is bent inwards, and helices do not climb.
    """
    before, after = row.last[:-1].copy(), row.first[1:].copy()
    ends, begins = row.arc[:-1], row.arc[1:]
    before[ends, 2] = 0.0
    inward = np.sign(row.signed[1:])[:, None] * np.column_stack((-after[:, 1], after[:, 0], 0 * after[:, 0]))
    pull = (row.asked[1:] / 2) ** 2 / row.radius[1:] / (row.acceleration[1:] / 2)
    after[begins, 2] = 0.0
    after = np.where(begins[:, None], after + inward * pull[:, None], after)
    for vectors in (before, after):
        vectors /= np.maximum(np.sqrt((vectors**2).sum(axis=1)), 1e-12)[:, None]
    return np.asarray(np.sqrt(np.maximum((1 - (before * after).sum(axis=1)) / 2, 0.0)))


def _off(row: Segments, at: NDArray[np.int64], rate: Array, lasts: Array) -> Array:
    """Greatest distance (k,) from the path while the segments at the junctions ``at`` overlap, mm."""
    t = np.linspace(0, 1, INSTANTS)[None, :] * lasts[:, None]
    left = rate[at, None] * (lasts[:, None] - t) ** 2 / 2
    done = rate[at + 1, None] * t**2 / 2
    left = np.minimum(left, row.length[at, None])
    done = np.minimum(done, row.length[at + 1, None])
    place = _along(row, at, -left, row.last) + _along(row, at + 1, done, row.first)
    apart = np.minimum(_from(row, at, place, row.last), _from(row, at + 1, place, row.first))
    return np.asarray(apart.max(axis=1))


def _along(row: Segments, at: NDArray[np.int64], way: Array, tangents: Array) -> Array:
    """Places (k, i, 3) so far along the segments from the junction, which is 0, mm."""
    tangent = tangents[at]
    flat = np.hypot(tangent[:, 0], tangent[:, 1])[:, None]
    bend = np.sign(row.signed[at])[:, None] / row.radius[at, None]
    angle = way * flat * bend
    ahead = way * flat * np.sinc(angle / np.pi)
    aside = way * flat * np.sinc(angle / 2 / np.pi) * np.sin(angle / 2)
    unit = tangent[:, :2] / np.maximum(flat, 1e-12)
    x = ahead * unit[:, :1] - aside * unit[:, 1:]
    y = ahead * unit[:, 1:] + aside * unit[:, :1]
    return np.stack((x, y, way * tangent[:, 2:]), axis=2)


def _from(row: Segments, at: NDArray[np.int64], place: Array, tangents: Array) -> Array:
    """Distance (k, i) of places from the segments, mm, to the first order in the bend."""
    tangent = tangents[at][:, None, :]
    way = (place * tangent).sum(axis=2)
    back = np.where(tangents is row.last, -1.0, 1.0)
    way = np.clip(back * way, 0.0, row.length[at, None]) * back
    for _ in range(2):  # the foot of the perpendicular, by Newton
        foot = _along(row, at, way, tangents)
        way = (
            np.clip(
                back * (way + ((place - foot) * _tangent(row, at, way, tangents)).sum(axis=2)),
                0.0,
                row.length[at, None],
            )
            * back
        )
    gap = place - _along(row, at, way, tangents)
    return np.asarray(np.sqrt((gap**2).sum(axis=2)))


def _tangent(row: Segments, at: NDArray[np.int64], way: Array, tangents: Array) -> Array:
    """Unit vectors (k, i, 3) of the segments so far from the junction."""
    tangent = tangents[at]
    flat = np.hypot(tangent[:, 0], tangent[:, 1])[:, None]
    angle = way * flat * np.sign(row.signed[at])[:, None] / row.radius[at, None]
    cos, sin = np.cos(angle), np.sin(angle)
    x = tangent[:, :1] * cos - tangent[:, 1:2] * sin
    y = tangent[:, 1:2] * cos + tangent[:, :1] * sin
    return np.stack((x, y, np.broadcast_to(tangent[:, 2:], x.shape)), axis=2)
