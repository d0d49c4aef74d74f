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
INSTANTS = 9
"""An overlap is looked at so many times, and as often again around the greatest of them."""


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
    sine: Array | None = None,
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
    sine
        (m - 1,) :func:`half_sine`, if it is known.
    """
    length = row.length / 2 if planned else row.length
    summit = np.minimum(np.sqrt(rate * length), speed)
    longest = np.minimum(*_sides(row.length / np.maximum(summit, 1e-12)))
    lasts = np.minimum(longest, np.maximum(*_sides(summit / rate)))
    into, out_of = (np.minimum(top, lasts * a) for top, a in zip(_sides(summit), _sides(rate), strict=True))
    sine = half_sine(row) if sine is None else sine
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


def half_sine(row: Segments) -> Array:
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
    ends, begins = _Way(row, at, row.last[at], -1.0), _Way(row, at + 1, row.first[at + 1], 1.0)
    share = np.broadcast_to(np.linspace(0, 1, INSTANTS), (at.size, INSTANTS))
    most, rows = np.zeros(at.size), np.arange(at.size)
    for step in (1 / (INSTANTS - 1), None):  # roughly, and around the greatest once more
        t = share * lasts[:, None]
        left = np.minimum(rate[at, None] * (lasts[:, None] - t) ** 2 / 2, ends.length)
        done = np.minimum(rate[at + 1, None] * t**2 / 2, begins.length)
        one, other = ends.after(-left), begins.after(done)
        place, height = one[0] + other[0], one[1] + other[1]
        apart = np.minimum(ends.distance(place, height), begins.distance(place, height))
        worst = np.argmax(apart, axis=1)
        most = np.maximum(most, apart[rows, worst])
        if step is not None:
            share = share[rows, worst][:, None] + np.linspace(-step, step, INSTANTS)
            share = np.clip(share, 0.0, 1.0)
    return np.asarray(most)


class _Way:
    """Segments (k,) as they begin or end in a junction, which is 0; plan view in complex numbers, mm."""

    def __init__(self, row: Segments, index: NDArray[np.int64], tangent: Array, side: float) -> None:
        self.length, self.side = row.length[index, None], side
        self.flat = (tangent[:, 0] + 1j * tangent[:, 1])[:, None]
        """Tangent at the junction; shorter than 1 where it climbs."""
        self.climb = tangent[:, 2:]
        bend = np.sign(row.signed[index]) / row.radius[index]
        self.half = np.abs(self.flat) * bend[:, None] / 2
        """Half of the turn of the tangent, rad per mm."""

    def after(self, way: Array) -> tuple[NDArray[np.complex128], Array, NDArray[np.complex128]]:
        """Places and heights (k, i) so far along from the junction, mm, and the tangents there."""
        angle = self.half * way
        turn = np.exp(1j * angle)
        shrunk = np.divide(turn.imag, angle, out=np.ones_like(angle), where=angle != 0)
        ahead = self.flat * turn
        return ahead * (way * shrunk), way * self.climb, ahead * turn

    def distance(self, place: NDArray[np.complex128], height: Array) -> Array:
        """Distance (k, i) of places from the segments, mm; the foot of the perpendicular by Newton."""
        foot, foot_height, tangent = np.zeros_like(place), np.zeros_like(height), self.flat
        way = np.zeros_like(height)
        for _ in range(2):
            gap = place - foot
            way = (
                way + gap.real * tangent.real + gap.imag * tangent.imag + (height - foot_height) * self.climb
            )
            way = self.side * np.clip(self.side * way, 0.0, self.length)
            foot, foot_height, tangent = self.after(way)
        gap = place - foot
        return np.asarray(np.sqrt(gap.real**2 + gap.imag**2 + (height - foot_height) ** 2))
