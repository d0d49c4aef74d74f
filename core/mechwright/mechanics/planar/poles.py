"""Poles of a moving body: the points without velocity, acceleration or jerk.

The velocity of a body point z is v(z) = v_A + i ω (z - A) for any body point A whose motion is known, its
acceleration a(z) = a_A + (i α - ω²)(z - A), and its jerk j(z) = j_A + (i (j - ω³) - 3 ω α)(z - A). Each is
zero in one point, A minus the value over the factor, unless the factor is zero: then all points share one
value, and the pole is at infinity, or everywhere if that value is zero too.
"""

from dataclasses import dataclass
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.mechanics.planar.rigid import BodyMotion, Plane

FARTHEST = 1e12
"""A pole further away than this, mm, is at infinity: its coordinates would round by 0.1 µm and more, and
nothing that is computed from them could be believed."""


class PoleKind(IntEnum):
    """Where a pole is."""

    FINITE = 0
    """In one point."""
    AT_INFINITY = 1
    """All points of the body have the same value, and it is not zero."""
    EVERYWHERE = 2
    """No point of the body has any."""


@dataclass(frozen=True, slots=True)
class Pole:
    """A pole at each sample.

    Parameters
    ----------
    fixed
        Its place (...) on the ground, mm; NaN where it is not finite.
    moving
        Its place in the body's coordinates; NaN as well.
    kind
        :class:`PoleKind` (...) as int8.
    direction
        Unit vector (...) from the body's origin to the pole, for one at infinity too; NaN where the pole is
        everywhere or in the origin.
    """

    fixed: Plane
    moving: Plane
    kind: NDArray[np.int8]
    direction: Plane

    @property
    def finite(self) -> NDArray[np.bool_]:
        """Where (...) the pole is one point."""
        found: NDArray[np.bool_] = self.kind == PoleKind.FINITE
        return found


def velocity_pole(body: BodyMotion) -> Pole:
    """The instant centre P = A + i v_A / ω; its paths are the centrodes.

    Examples
    --------
    A wheel of radius 2 that rolls on the x axis touches the ground in its pole:

    >>> from mechwright.mechanics.planar import PointMotion, Turning
    >>> hub = PointMotion.of([0 + 2j], 2.0)
    >>> velocity_pole(BodyMotion(hub, Turning.of([0.0], -1.0))).fixed.tolist()
    [0j]
    """
    return _zero(body, body.origin.velocity, body.turning.velocity_factor)


def acceleration_pole(body: BodyMotion) -> Pole:
    """The point without acceleration, G = A - a_A / (i α - ω²)."""
    return _zero(body, body.origin.acceleration, body.turning.acceleration_factor)


def jerk_pole(body: BodyMotion) -> Pole:
    """The point without jerk."""
    return _zero(body, body.origin.jerk, body.turning.jerk_factor)


def _zero(body: BodyMotion, value: Plane, factor: Plane) -> Pole:
    """Where ``value + factor (z - origin)`` is zero."""
    value, factor = np.broadcast_arrays(value, factor)
    size, slope = np.abs(value), np.abs(factor)
    far = size >= FARTHEST * slope
    finite = ~far
    safe = np.where(finite, factor, 1.0)
    lever = np.where(finite, -value / safe, np.nan + 0j)
    kind = np.where(finite, PoleKind.FINITE, np.where(size > 0, PoleKind.AT_INFINITY, PoleKind.EVERYWHERE))
    return Pole(
        body.origin.position + lever,
        lever / body.turning.direction,
        kind.astype(np.int8),
        _towards(value, size, factor, slope),
    )


def _towards(value: Plane, size: Array, factor: Plane, slope: Array) -> Plane:
    """Unit vector of ``-value / factor``; of a factor of zero the direction that ω > 0 would give."""
    turn = np.where(slope > 0, factor, 1j) / np.where(slope > 0, slope, 1.0)
    unit: Plane = np.where(size > 0, -value / np.where(size > 0, size, 1.0) / turn, np.nan + 0j)
    return unit
