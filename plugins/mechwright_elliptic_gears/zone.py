"""The part of two outlines that lies near contact.

Glossary
--------
envelope
    The pitch ellipse blown up about its centre until it holds a gear; two gears touch only where both
    envelopes overlap.
span
    Consecutive corners of an outline around its pitch point that surely hold all of the overlap.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright import Array
from mechwright_elliptic_gears.crossings import Flags, Ints, count_up
from mechwright_elliptic_gears.ellipse import Ellipse


def level(points: Array, ellipse: Ellipse) -> Array:
    """Scale (n,) at which the pitch ellipse, blown up about its centre, reaches points (n, 2), part frame."""
    x, y = points.T
    scale: Array = np.hypot((x - ellipse.focal_distance) / ellipse.semi_major, y / ellipse.semi_minor)
    return scale


def half_span(ellipse: Ellipse, scale: float) -> float:
    """Eccentric angle, rad, on either side of the pitch point that holds all points common to two envelopes.

    An ellipse lies inside each circle that touches it with its own greatest radius of curvature, so two
    envelopes overlap less than two such circles do.
    """
    radius, height = scale * ellipse.greatest_radius, max(0.0, scale - 1) * ellipse.semi_major
    reach = math.hypot(math.sqrt(2 * radius * height), height)
    # An arc is at most π/2 times its chord, and b rad of it belong to one of eccentric angle at least.
    return min(math.pi, math.pi / 2 * reach / ellipse.semi_minor)


@dataclass(frozen=True)
class Rim:
    """An outline (n, 2), mm, part frame, counter-clockwise, and the directions of its corners.

    ``low`` and ``high`` (3 n,) are monotone bounds, rad, of the corners' eccentric angles over three turns.
    """

    points: Array
    low: Array
    high: Array

    @classmethod
    def of(cls, points: Array, ellipse: Ellipse) -> "Rim":
        """Prepare an outline."""
        x, y = points.T
        u = np.unwrap(np.arctan2(y / ellipse.semi_minor, (x - ellipse.focal_distance) / ellipse.semi_major))
        turns = np.concatenate((u - math.tau, u, u + math.tau))
        return cls(points, np.minimum.accumulate(turns[::-1])[::-1], np.maximum.accumulate(turns))

    def span(self, u: Array, half: float) -> tuple[Ints, Ints]:
        """Corners within ``half``, rad, of directions u (k,): the position each belongs to, and its index."""
        n = len(self.points)
        middle = (u - self.low[n]) % math.tau + self.low[n]
        first = np.searchsorted(self.high, middle - half, "left")
        counts = np.minimum(np.searchsorted(self.low, middle + half, "right") - first, n)
        position = np.repeat(np.arange(u.size), counts)
        return position, (first[position] + count_up(counts)) % n


@dataclass(frozen=True)
class Near:
    """The points and edges of one gear near contact, seen from gear 4.

    Parameters
    ----------
    points, position
        (n, 2), mm, and the position (n,) each belongs to.
    starts, ends, edge_position
        The edges with an end among the points: (m, 2) mm, and (m,).
    """

    points: Array
    position: Ints
    starts: Array
    ends: Array
    edge_position: Ints

    @classmethod
    def of(cls, placed: Array, position: Ints, near: Flags) -> "Near":
        """Choose from spans: corners (n, 2) in order, their positions, and whether they are near."""
        joined = position[:-1] == position[1:]
        edge = np.flatnonzero(joined & (near[:-1] | near[1:]))
        return cls(placed[near], position[near], placed[edge], placed[edge + 1], position[edge])


def turned(points: Array, cos: Array, sin: Array) -> Array:
    """Points (n, 2) turned by angles given by their cosines and sines (n,)."""
    x, y = points.T
    return np.column_stack((cos * x - sin * y, sin * x + cos * y))
