"""Motion of points and bodies in the plane, from pose to jerk, and the pole of accelerations."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from mechwright.arrays import Array
from mechwright.contracts.motion import Poses, Rates
from mechwright.contracts.turning import Plane as Plane
from mechwright.contracts.turning import Turning as Turning

FARTHEST = 1e12
"""A pole further away than this, mm, is at infinity: its coordinates would round by 0.1 µm and more, and
nothing that is computed from them could be believed."""


@dataclass(frozen=True, slots=True)
class PointMotion:
    """Position (...) of a point in mm, and its first three rates in mm/s, mm/s², mm/s³."""

    position: Plane
    velocity: Plane
    acceleration: Plane
    jerk: Plane

    @classmethod
    def of(
        cls,
        position: ArrayLike,
        velocity: ArrayLike = 0.0,
        acceleration: ArrayLike = 0.0,
        jerk: ArrayLike = 0.0,
    ) -> "PointMotion":
        """Broadcast the four to one shape; a position alone is a point at rest."""
        arrays = (np.asarray(values, dtype=complex) for values in (position, velocity, acceleration, jerk))
        return cls(*(np.array(values) for values in np.broadcast_arrays(*arrays)))

    @property
    def speed(self) -> Array:
        """Magnitude of the velocity (...), mm/s."""
        return np.abs(self.velocity)


@dataclass(frozen=True, slots=True)
class BodyMotion:
    """Motion of a body: of the origin of its coordinates, and of its angle.

    Examples
    --------
    A crank of 2 mm that turns about (1, 0) with 3 rad/s:

    >>> crank = BodyMotion.about(1 + 0j, Turning.of([0.0, np.pi / 2], 3.0))
    >>> crank.point(2.0).velocity.round(12).tolist()
    [6j, (-6+0j)]
    """

    origin: PointMotion
    turning: Turning

    @classmethod
    def about(cls, centre: complex, turning: Turning) -> "BodyMotion":
        """A body that turns about a point of the ground, which is its origin."""
        return cls(PointMotion.of(np.full(turning.theta.shape, centre, dtype=complex)), turning)

    @classmethod
    def sliding(cls, origin: PointMotion, theta: ArrayLike = 0.0) -> "BodyMotion":
        """A body that only shifts, its angle ``theta`` in rad for good."""
        return cls(origin, Turning.of(np.broadcast_to(np.asarray(theta, float), origin.position.shape)))

    def point(self, place: ArrayLike, rates: int = 3) -> PointMotion:
        """Motion of body points: ``place`` (...) is x + i y in the body's coordinates, mm.

        ``rates`` is the highest rate that is needed, 0 to 3; those above are NaN.
        """
        return carried(self.origin, self.turning, np.asarray(place, complex) * self.turning.direction, rates)

    def samples(self, some: slice) -> "BodyMotion":
        """The motion at some of the samples, which are the last axis."""
        origin, turning = self.origin, self.turning
        places = (origin.position, origin.velocity, origin.acceleration, origin.jerk)
        angles = (turning.theta, turning.omega, turning.alpha, turning.jerk)
        return BodyMotion(
            PointMotion(*(one[..., some] for one in places)), Turning(*(one[..., some] for one in angles))
        )

    def poses(self, z: float = 0.0, *, rates: bool = False) -> Poses:
        """Give the poses for a :class:`mechwright.contracts.motion.Motion`, all at the height ``z``, mm.

        With ``rates`` they have those of this motion; leave that out where it is one of angles alone.
        """
        position, turning = self.origin.position, self.turning
        still = Poses.planar(position.real, position.imag, turning.theta, z)
        if not rates:
            return still
        turned = turning.direction
        first = _frame_rates(turning.velocity_factor * turned, self.origin.velocity)
        second = _frame_rates(turning.acceleration_factor * turned, self.origin.acceleration)
        return Poses(still.position, still.rotation, Rates(first, second))


def _frame_rates(turning: Plane, moving: Plane) -> Array:
    """A rate (n, 3, 4) of frames, from that of their x axis and that of their origin."""
    found = np.zeros((turning.size, 3, 4))
    found[:, 0, 0] = found[:, 1, 1] = turning.real
    found[:, 1, 0], found[:, 0, 1] = turning.imag, -turning.imag
    found[:, 0, 3], found[:, 1, 3] = moving.real, moving.imag
    return found


_UNKNOWN = np.complex128(complex(np.nan, np.nan)).tobytes()
"""The number of all rates that are not needed; arrays of any shape share it, and cannot be written to."""


def carried(origin: PointMotion, turning: Turning, lever: Plane, rates: int = 3) -> PointMotion:
    """Motion of the point at a lever (...) from the origin of a body, x + i y on the ground, mm.

    ``rates`` is the highest rate that is needed, 0 to 3; those above are NaN.
    """
    position = origin.position + lever
    none: Plane = np.ndarray(position.shape, np.complex128, _UNKNOWN, 0, (0,) * position.ndim)
    return PointMotion(
        position,
        origin.velocity + turning.velocity_factor * lever if rates > 0 else none,
        origin.acceleration + turning.acceleration_factor * lever if rates > 1 else none,
        origin.jerk + turning.jerk_factor * lever if rates > 2 else none,
    )


@dataclass(frozen=True, slots=True)
class Pole:
    """Places (...) of a pole on the ground and in the body, mm; NaN where it is no one point."""

    fixed: Plane
    moving: Plane
