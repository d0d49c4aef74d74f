"""Where a linkage with one loop moves: the plane, or (in the family of spherical linkages) a sphere.

Everything that differs between the two stands in a space: how a point is turned about another, how far two
are apart, where the third joint of a triangle lies. What an adjustable linkage is, is written once on top of
it. Points of the plane are complex arrays (...); a sphere has vectors (3, ...).
"""

from typing import Protocol

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.planar import Plane

Points = np.ndarray
"""Points of a space: complex (...) in the plane, float (3, ...) on a sphere."""

CLOSED = 1e-300
"""Least squared height of a joint over its base, so that a toggle divides by no zero."""


class Space(Protocol):
    """The plane or a sphere, with the pose point ``p`` in which the linkage is set."""

    def at(self, x: Array, y: Array) -> Points:
        """Points from two coordinates, smooth about the pose point."""

    def coordinates(self, point: Points) -> tuple[Array, Array]:
        """The coordinates of points: the inverse of ``at``."""

    def pose_point(self) -> Points:
        """The path point in the pose of setting."""

    def around(self, centre: Points, radius: Array, angle: Array) -> Points:
        """Points at a distance from a centre, in a direction, rad."""

    def polar(self, centre: Points, point: Points) -> tuple[Array, Array]:
        """Distance and direction of points from a centre: the inverse of ``around``."""

    def turn(self, centre: Points, angle: Array, point: Points) -> Points:
        """Points turned about a centre, rad, counter-clockwise."""

    def apart(self, one: Points, two: Points) -> Array:
        """Distances; arcs on a sphere, rad."""

    def side(self, a: Points, b: Points, c: Points) -> Array:
        """+1 where c lies to the left of a to b, else -1."""

    def third(self, a: Points, b: Points, ra: Array, rb: Array, side: Array) -> tuple[Points, Array]:
        """The joint at distances from a and b, and the cosine of the angle there.

        Where the cosine is beyond ±1 there is no such joint; the nearest place on the line is given.
        """

    def carried(self, a: Points, c: Points, p: Points, a_now: Points, c_now: Points) -> Points:
        """A point of the body with the joints a, c, when these have moved."""

    def misses(self, found: Points, wanted: Points) -> Array:
        """Differences (..., 2 or 3); their norm is the chord."""


class PlaneSpace:
    """The plane, as complex numbers, with the pose point ``p``."""

    def __init__(self, p: complex) -> None:
        self.p = p

    def at(self, x: Array, y: Array) -> Plane:
        """See :class:`Space`."""
        return np.asarray(self.p + x + 1j * y)

    def coordinates(self, point: Plane) -> tuple[Array, Array]:
        """See :class:`Space`."""
        return np.real(point - self.p), np.imag(point - self.p)

    def pose_point(self) -> Plane:
        """See :class:`Space`."""
        return np.asarray(self.p, dtype=np.complex128)

    def around(self, centre: Plane, radius: Array, angle: Array) -> Plane:
        """See :class:`Space`."""
        return np.asarray(centre + radius * np.exp(1j * angle))

    def polar(self, centre: Plane, point: Plane) -> tuple[Array, Array]:
        """See :class:`Space`."""
        return np.abs(point - centre), np.angle(point - centre)

    def turn(self, centre: Plane, angle: Array, point: Plane) -> Plane:
        """See :class:`Space`."""
        return np.asarray(centre + np.exp(1j * angle) * (point - centre))

    def apart(self, one: Plane, two: Plane) -> Array:
        """See :class:`Space`."""
        return np.abs(one - two)

    def side(self, a: Plane, b: Plane, c: Plane) -> Array:
        """See :class:`Space`."""
        return np.where((np.conj(b - a) * (c - a)).imag >= 0, 1.0, -1.0)

    def third(self, a: Plane, b: Plane, ra: Array, rb: Array, side: Array) -> tuple[Plane, Array]:
        """See :class:`Space`."""
        base = b - a
        square = np.maximum(base.real**2 + base.imag**2, CLOSED)
        along = ((ra - rb) * (ra + rb) + square) / (2 * square)
        height = np.sqrt(np.maximum(ra**2 / square - along**2, CLOSED))
        cosine = (ra**2 + rb**2 - square) / (2 * ra * rb)
        return np.asarray(a + base * (along + 1j * side * height)), np.asarray(cosine)

    def carried(self, a: Plane, c: Plane, p: Plane, a_now: Plane, c_now: Plane) -> Plane:
        """See :class:`Space`."""
        return np.asarray(a_now + (c_now - a_now) * ((p - a) / (c - a)))

    def misses(self, found: Plane, wanted: Plane) -> Array:
        """See :class:`Space`."""
        gap = found - wanted
        return np.stack([gap.real, gap.imag], axis=-1)
