"""Teeth of elliptic gears as columns over designs, in units of their semi-major axes.

Glossary
--------
v, w
    Eccentric angles: of the frame that makes the end of a flank, and of the one below that end at the tip.
half
    The teeth that are looked at. With an odd number of teeth the gear is its own mirror image in the major
    axis, with an even one the pitch ellipse and its teeth are the same turned by half a perimeter: half of
    all teeth tell of the others.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechwright import Array
from mechwright.contracts.design_table import Rowwise
from mechwright.mechanics.gearing.teeth import FACTOR_SAMPLES

_ROUGH, _EXACT = 1, 9
"""Steps of Newton's method on the arc: for a place to start from, and to rounding."""

_SETTLED = 1e-9
"""Last step, rad, after which the next would be rounding."""

_TRIMS = 9
"""Steps of Newton's method to the end of a flank: four to six are the rule."""

_TRIMMED = 1e-13
"""Residual of that end, as for one gear: rounding, ten times."""

_TERMS = 128
"""Samples of the arc's rate, of period π: at e = 0.9 the 64 terms they give end below rounding."""

Bools = NDArray[np.bool_]


@dataclass(frozen=True)
class Gears(Rowwise):
    """Gears of designs; lengths in semi-major axes, columns (m, 1), angles in rad.

    Parameters
    ----------
    eccentricity, teeth, offset
        E, z, and the arc at the middle of tooth 0 in pitches.
    module, backlash
        As of the rack.
    angle, addendum, dedendum, tip_radius
        Of the rack; the last three in modules.
    """

    eccentricity: Array
    teeth: Array
    offset: Array
    module: Array
    backlash: Array
    angle: Array
    addendum: Array
    dedendum: Array
    tip_radius: Array

    @property
    def pitch(self) -> Array:
        """Arc from tooth to tooth."""
        return math.pi * self.module

    @property
    def half_space(self) -> Array:
        """Half the width of a space on the pitch curve."""
        return (self.pitch + self.backlash) / 4

    @property
    def straight_depth(self) -> Array:
        """Where the rack's flank ends and its tip arc begins, modules."""
        depth: Array = self.dedendum - self.tip_radius * (1 - np.sin(self.angle))
        return depth

    @property
    def half_land(self) -> Array:
        """From the middle of the rack's tooth to the centre of a tip arc."""
        flank = self.straight_depth * np.tan(self.angle) + self.tip_radius * np.cos(self.angle)
        land: Array = self.half_space - self.module * flank
        return land

    @property
    def least_radius(self) -> Array:
        """Least radius of curvature."""
        return 1 - self.eccentricity**2

    @property
    def half(self) -> tuple[Array, Bools]:
        """Arc (m, k) to the middles of half of the teeth, and which of them there are."""
        count = (self.teeth + 1) // 2
        number = np.arange(int(count.max()))
        return (np.minimum(number, count - 1) + self.offset) * self.pitch, number < count


class Arcs:
    """Arcs of ellipses of semi-major axis 1, of eccentricities (m, 1), as of one :class:`Ellipse`."""

    def __init__(self, eccentricity: Array) -> None:
        self.eccentricity = eccentricity
        self.semi_minor = np.sqrt(1 - eccentricity**2)
        u = np.pi * np.arange(_TERMS) / _TERMS
        terms = np.fft.rfft(np.sqrt(1 - (eccentricity * np.cos(u)) ** 2)).real / _TERMS
        terms[:, 1:] *= 2
        size = np.abs(terms).max(axis=0)
        count = int(np.flatnonzero(size > 1e-17 * size[0]).max()) + 1
        self.mean = terms[:, :1]
        self.weights = terms[:, 1:count] / (2 * np.arange(1, count))

    def arc(self, sin: Array, cos: Array, u: Array) -> Array:
        """Arc (m, k) from the far vertex to eccentric angles u (m, k)."""
        twice = 2 * (cos * cos - sin * sin)
        one, two = np.zeros_like(u), np.zeros_like(u)
        for weight in self.weights.T[::-1]:
            one, two = weight[:, None] + twice * one - two, one
        arc: Array = self.mean * u + one * (2 * sin * cos)
        return arc

    def parameter(self, arc: Array, steps: int) -> Array:
        """Eccentric angle (m, k) at arcs, after some steps of Newton's method."""
        u = arc / self.mean
        if self.weights.shape[1]:
            u = u - self.weights[:, :1] / self.mean * np.sin(2 * u)
        for _ in range(steps):
            sin, cos = np.sin(u), np.cos(u)
            change = (self.arc(sin, cos, u) - arc) / np.sqrt(1 - (self.eccentricity * cos) ** 2)
            u = u - change
            if np.abs(change).max() < _SETTLED:
                break
        return u


SHARES = np.linspace(0, 1, FACTOR_SAMPLES)[1:]
"""Of the flanks, at which their regularity is asked for; at 0 it is 1."""

ENDS = SHARES[-1:]
"""Their ends."""


BLOCK = 256
"""Gears whose teeth are followed at once: arrays of a tenth of a megabyte."""

_TOGETHER = 4
"""Numbers of teeth that are followed together; gears of fewer have idle places."""

_AT_ONCE = 8192
"""Places of flanks that are looked at together: their arrays stay in the cache."""


def in_blocks(gears: Gears, function: Callable[[Gears], tuple[Array, ...]]) -> list[Array]:
    """Columns (m, 1) of a function of gears, in blocks of about as many teeth and terms of their arcs."""
    order = np.lexsort((gears.eccentricity[:, 0], gears.teeth[:, 0] // _TOGETHER))
    blocks = np.array_split(order, max(1, math.ceil(order.size / BLOCK)))
    parts = [function(gears.rows(some, order.size)) for some in blocks]
    back = np.argsort(order)
    return [np.concatenate(columns)[back] for columns in zip(*parts, strict=True)]


def least_regularity(gears: Gears, shares: Array = SHARES) -> Array:
    """The least share (m, 1) of its regularity at the pitch curve that a flank keeps, looked at at shares."""
    return in_blocks(gears, lambda some: (_least_regularity(some, shares),))[0]


def _least_regularity(gears: Gears, shares: Array) -> Array:
    arcs, (middles, there) = Arcs(gears.eccentricity), gears.half
    reach = gears.straight_depth * gears.module / (np.sin(gears.angle) * np.cos(gears.angle))
    least = np.full(gears.module.shape, np.inf)
    batches = np.array_split(shares, min(shares.size, math.ceil(shares.size * there.size / _AT_ONCE)))
    for side in (-1.0, 1.0):
        crossing = middles + side * (gears.pitch / 2 - gears.half_space)
        for some in batches:
            t, shape = np.repeat(some, middles.shape[1]), (1, some.size)
            # a tooth's flank runs down towards its space
            u = arcs.parameter(np.tile(crossing, shape) + side * t * reach, _EXACT)
            radius = np.sqrt(1 - (gears.eccentricity * np.cos(u)) ** 2) ** 3 / arcs.semi_minor
            factor = 1 - t * gears.straight_depth * gears.module / (radius * np.sin(gears.angle) ** 2)
            kept = np.where(np.tile(there, shape), factor, np.inf)
            least = np.minimum(least, kept.min(axis=1, keepdims=True))
    regularity: Array = np.minimum(least, 1.0)
    return regularity


@dataclass(frozen=True)
class Tips(Rowwise):
    """Ends of the flanks of gears, (m, 1) each, in modules.

    Parameters
    ----------
    width
        Least width of a tip.
    depth
        Below the mate's pitch line at which the deepest tip ends its contact.
    found
        Whether all flanks reach their tips to rounding.
    """

    width: Array
    depth: Array
    found: Bools


def tips_of(gears: Gears) -> Tips:
    """Follow the flanks to their tips."""
    width, depth, found = in_blocks(gears, _tips_of)
    return Tips(width, depth, found > 0)


def _tips_of(gears: Gears) -> tuple[Array, Array, Array]:
    arcs, (middles, there) = Arcs(gears.eccentricity), gears.half
    one, two = (flank_end(gears, arcs, middles, side) for side in (-1.0, 1.0))
    turn = np.angle(np.conj(one.tangent) * two.tangent)
    width = (two.foot - one.foot + gears.addendum * gears.module * turn) / gears.module
    deep = np.maximum(one.way, two.way) * np.sin(gears.angle) * np.cos(gears.angle) / gears.module
    ends: Bools = np.logical_and(one.off < _TRIMMED, two.off < _TRIMMED)
    return (
        np.where(there, width, np.inf).min(axis=1, keepdims=True),
        np.where(there, deep, 0.0).max(axis=1, keepdims=True),
        np.where((ends | ~there).all(axis=1, keepdims=True), 1.0, 0.0),
    )


@dataclass(frozen=True)
class End:
    """Ends of flanks (m, k): arc below the tip, tangent there, arc to the pitch point, and residual.

    ``top`` and ``below`` are the eccentric angles v and w.
    """

    foot: Array
    tangent: NDArray[np.complex128]
    way: Array
    off: Array
    top: Array
    below: Array


def flank_end(gears: Gears, arcs: Arcs, middles: Array, side: float) -> End:
    """The flanks at the lesser or greater arc of each tooth; as ``tip_trim`` of one gear."""
    e, high = gears.eccentricity, gears.addendum * gears.module
    sin, cos = np.sin(gears.angle), np.cos(gears.angle)
    crossing = middles + side * (gears.pitch / 2 - gears.half_space)
    own = -side  # of the space beside it
    near = arcs.parameter(crossing, 0)
    radius = np.sqrt(1 - (e * np.cos(near)) ** 2) ** 3 / arcs.semi_minor
    half, square = sin * cos, cos**4 / (2 * radius)
    u = own * 2 * high / (half + np.sqrt(half**2 + 4 * square * high))
    v = arcs.parameter(crossing + u, _ROUGH)
    w = arcs.parameter(crossing + u * (1 - cos * cos * radius / (radius + high)), _ROUGH)
    limit = _TRIMMED * arcs.mean
    for step in range(_TRIMS + 1):
        sine, cosine = np.sin(v), np.cos(v)
        speed = np.sqrt(1 - (e * cosine) ** 2)
        tangent = (-sine + 1j * arcs.semi_minor * cosine) / speed
        way = arcs.arc(sine, cosine, v) - crossing
        flank = cosine + 1j * arcs.semi_minor * sine - (cos * cos + 1j * own * sin * cos) * way * tangent
        below, beside = np.cos(w), np.sin(w)
        rate = np.sqrt(1 - (e * below) ** 2)
        under = (-beside + 1j * arcs.semi_minor * below) / rate
        gap = flank - (below + 1j * arcs.semi_minor * beside - 1j * high * under)
        off = np.abs(gap)
        if step == _TRIMS or (off < limit).all():
            break
        regular = sin * sin + own * way * sin * cos * arcs.semi_minor / speed**3
        forth = regular * speed * (1 - 1j * own * cos / sin) * tangent
        back = (1 + high * arcs.semi_minor / rate**3) * rate * under
        cross = (np.conj(forth) * back).imag
        v = v - (np.conj(gap) * back).imag / cross
        w = w - (np.conj(gap) * forth).imag / cross
    return End(arcs.arc(beside, below, w), under, np.abs(way), off / arcs.mean, v, w)
