"""The unit sphere as the space of an adjustable linkage: distances are arcs, rad."""

import numpy as np

from mechwright import Array
from mechwright.mechanics.adjustable.space import CLOSED
from mechwright_spherical.kinematics.chain import body_point, coordinates
from mechwright_spherical.kinematics.vectors import arc, column, cross, dot, norm, perpendicular, rotate


class SphereSpace:
    """The unit sphere with the pose point ``p`` (3,); see ``mechwright.mechanics.adjustable.Space``.

    Coordinates of a point are its arc from p along the directions of two tangents; directions about another
    centre are counted from the tangent that the shortest rotation brings there. Both fail at -p alone.
    """

    def __init__(self, p: Array) -> None:
        self.p = p
        self._one = perpendicular(p)
        self._two = cross(p, self._one)

    def at(self, x: Array, y: Array) -> Array:
        """See ``Space``."""
        r = np.hypot(x, y)
        share = np.sinc(r / np.pi)
        p, one, two = (column(v, r[None]) for v in (self.p, self._one, self._two))
        return np.asarray(np.cos(r) * p + share * (x * one + y * two))

    def coordinates(self, point: Array) -> tuple[Array, Array]:
        """See ``Space``."""
        p, one, two = (column(v, point) for v in (self.p, self._one, self._two))
        x, y = dot(point, one), dot(point, two)
        sine = np.hypot(x, y)
        angle = np.arctan2(sine, dot(point, p))
        scale = np.where(sine > 0, angle / np.where(sine > 0, sine, 1.0), 1.0)
        return x * scale, y * scale

    def pose_point(self) -> Array:
        """See ``Space``."""
        return self.p

    def _tangents(self, centre: Array) -> tuple[Array, Array]:
        """The two tangents at a centre (3, ...) that the shortest rotation brings there from p."""
        p, one = column(self.p, centre), column(self._one, centre)
        first = one - dot(one, centre) / (1 + dot(p, centre)) * (p + centre)
        return first, cross(centre, first)

    def around(self, centre: Array, radius: Array, angle: Array) -> Array:
        """See ``Space``."""
        one, two = self._tangents(centre)
        return np.asarray(
            np.cos(radius) * centre + np.sin(radius) * (np.cos(angle) * one + np.sin(angle) * two)
        )

    def polar(self, centre: Array, point: Array) -> tuple[Array, Array]:
        """See ``Space``."""
        one, two = self._tangents(centre)
        return arc(centre, point), np.arctan2(dot(point, two), dot(point, one))

    def turn(self, centre: Array, angle: Array, point: Array) -> Array:
        """See ``Space``."""
        return rotate(centre, angle, point)

    def apart(self, one: Array, two: Array) -> Array:
        """See ``Space``."""
        return arc(one, two)

    def side(self, a: Array, b: Array, c: Array) -> Array:
        """See ``Space``."""
        return np.where(dot(c, cross(a, b)) >= 0, 1.0, -1.0)

    def third(self, a: Array, b: Array, ra: Array, rb: Array, side: Array) -> tuple[Array, Array]:
        """See ``Space``."""
        ca, cb = np.cos(ra), np.cos(rb)
        total, gap = a + b, a - b
        p, q = norm(total), norm(gap)
        with np.errstate(divide="ignore", invalid="ignore"):
            along, across = (ca + cb) / p, (ca - cb) / q
            u, v = total / p, gap / q
            height = -side * np.sqrt(np.maximum(1 - along**2 - across**2, CLOSED))
            cosine = (dot(a, b) - ca * cb) / (np.sin(ra) * np.sin(rb))
        return np.asarray(along * u + across * v + height * cross(u, v)), np.asarray(cosine)

    def carried(self, a: Array, c: Array, p: Array, a_now: Array, c_now: Array) -> Array:
        """See ``Space``."""
        with np.errstate(divide="ignore", invalid="ignore"):
            return body_point((a_now,), (c_now,), coordinates(a, c, p))[0]

    def misses(self, found: Array, wanted: Array) -> Array:
        """See ``Space``."""
        middle = (1,) * (found.ndim - wanted.ndim)
        gap = found - wanted.reshape(wanted.shape[0], *middle, *wanted.shape[1:])
        return np.moveaxis(gap, 0, -1)
