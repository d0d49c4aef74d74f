"""Overlapping moves: the next one begins while the one before still slows down.

Speed at which that begins, and how far it takes the tool off the path. In lines of equal acceleration P
bounds it. On arcs the way to the corner bends, so that even where both meet without a kink their sum is off
the path by the bend; and the climb of a helix counts for no turn.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright_cam.controls.lookahead.segments import Segments
from mechwright_cam.controls.reading.run import Ints

LEAST_SINE = np.sin(1e-3)
"""Half a turn below this is none: P bounds nothing then."""
INSTANTS = 9
"""An overlap is looked at so many times, and as often again around the greatest of them."""


@dataclass(frozen=True)
class Overlaps:
    """Overlaps of one segment and the next, q of them.

    Parameters
    ----------
    row
        The segments.
    before, after
        (q,) the kinds of segment.
    rate, speed
        (2, q) acceleration of both along their paths while they overlap, mm/s², and how fast they are, mm/s.
    sine
        (q,) :func:`half_sine`.
    share
        So much of its length either may overlap.
    """

    row: Segments
    before: Ints
    after: Ints
    rate: Array
    speed: Array
    sine: Array
    share: float = 1.0

    @cached_property
    def fastest(self) -> Array:
        """(2, q) speed of both when they begin to overlap, and when that ends, mm/s."""
        row, rate = self.row, self.rate
        length = row.length[np.stack((self.before, self.after))]
        summit = np.minimum(np.sqrt(rate * (self.share * length)), self.speed)
        longest = (length / np.maximum(summit, 1e-12)).min(axis=0)
        lasts = np.minimum(longest, (summit / rate).max(axis=0))
        blend = row.blend[self.before]
        bound = (blend > 0) & (self.sine > LEAST_SINE)
        most = np.where(bound, 2 * np.sqrt(rate[0] * blend / np.maximum(self.sine, LEAST_SINE)), np.inf)
        return np.asarray(np.minimum(np.minimum(summit, lasts * rate), most))

    @property
    def seconds(self) -> Array:
        """(q,) that they save."""
        return np.asarray(self.fastest[0] / self.rate[0])

    @property
    def performance(self) -> Array:
        """(q,) as the planner rates it, mm/s."""
        return np.asarray(np.sqrt(1 - self.sine**2) * self.fastest.sum(axis=0) / 2)

    def off(self, late: float) -> Array:
        """Greatest distance (q,) from the path, mm.

        An overlap may take longer than it should, by ``late``, s, since it begins with a servo period.
        """
        row, rows = self.row, np.arange(self.before.size)
        lasts = (self.seconds + late)[:, None]
        ends = _Way(row, self.before, row.last[self.before], -1.0)
        begins = _Way(row, self.after, row.first[self.after], 1.0)
        slows, speeds = self.rate[0, :, None] / 2, self.rate[1, :, None] / 2
        share = np.broadcast_to(np.linspace(0, 1, INSTANTS), (rows.size, INSTANTS))
        most = np.zeros(rows.size)
        for step in (1 / (INSTANTS - 1), None):  # roughly, and around the greatest once more
            t = share * lasts
            left = np.minimum(slows * (lasts - t) ** 2, ends.length)
            done = np.minimum(speeds * t**2, begins.length)
            one, other = ends.after(-left), begins.after(done)
            place, height = one[0] + other[0], one[1] + other[1]
            apart = np.minimum(ends.distance(place, height), begins.distance(place, height))
            worst = np.argmax(apart, axis=1)
            most = np.maximum(most, apart[rows, worst])
            if step is not None:
                share = share[rows, worst][:, None] + np.linspace(-step, step, INSTANTS)
                share = np.clip(share, 0.0, 1.0)
        return most


def half_sine(row: Segments) -> Array:
    """Sine (p,) of half the turn in each kind of junction, as the planner sees it.

    It sees directions of acceleration: an arc that begins is bent inwards, by half the speed that it is asked
    for, which the control keeps to what its radius allows; and helices do not climb.
    """
    one, two = row.before, row.after
    before, after = row.last[one], row.first[two]
    begins = row.arc[two]
    before[row.arc[one], 2] = 0.0
    after[begins, 2] = 0.0
    pull = (row.speed / 2) ** 2 / row.radius / (row.acceleration / 2) * np.sign(row.signed)
    bent = after[begins]
    after[begins, :2] += np.column_stack((-bent[:, 1], bent[:, 0])) * pull[two][begins, None]
    for vectors in (before, after):
        vectors /= np.maximum(np.sqrt((vectors**2).sum(axis=1)), 1e-12)[:, None]
    return np.asarray(np.sqrt(np.maximum((1 - (before * after).sum(axis=1)) / 2, 0.0)))


class _Way:
    """Segments (q,) as they begin or end in a junction, which is 0; plan view in complex numbers, mm."""

    def __init__(self, row: Segments, index: Ints, tangent: Array, side: float) -> None:
        self.length, self.side = row.length[index, None], side
        self.flat = (tangent[:, 0] + 1j * tangent[:, 1])[:, None]
        """Tangent at the junction; shorter than 1 where it climbs."""
        self.climb = tangent[:, 2:]
        bend = np.sign(row.signed[index]) / row.radius[index]
        self.half = np.abs(self.flat) * bend[:, None] / 2
        """Half of the turn of the tangent, rad per mm."""

    def after(self, way: Array) -> tuple[NDArray[np.complex128], Array, NDArray[np.complex128]]:
        """Places and heights (q, i) so far along from the junction, mm, and the tangents there."""
        angle = self.half * way
        turn = np.exp(1j * angle)
        shrunk = np.divide(turn.imag, angle, out=np.ones_like(angle), where=angle != 0)
        ahead = self.flat * turn
        return ahead * (way * shrunk), way * self.climb, ahead * turn

    def distance(self, place: NDArray[np.complex128], height: Array) -> Array:
        """Distance (q, i) of places from the segments, mm; the foot of the perpendicular by Newton."""
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
