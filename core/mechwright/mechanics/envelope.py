"""What a roller leaves or needs: both envelopes of a circle whose centre moves over a turning body.

The wall of a Geneva slot and the outline of a disc cam are the same curve. All vectors are complex numbers,
x + i y, in fixed axes at the instant that they are of, and rates are per radian of whatever drives:

    V, A                        velocity and acceleration of the roller's centre over the turning body
    n = i V/|V|                 unit normal to the left of its way
    C ± r n                     the points where a roller of radius r touches
    κ = Im(conj(V) A)/|V|³      curvature of its way, above 0 where it bends to the left
    1 ∓ κ r                     how far the envelope goes on for each step of the way

Where the last is below 0 the envelope turns back and the roller would cut off what it has to touch: undercut.
Source: the envelope of a family of circles in any text on differential geometry; for cams R. L. Norton,
Design of Machinery, chapter 8.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from mechwright.arrays import Array

Points = NDArray[np.complex128]
"""Points or vectors of the plane, mm."""

LEFT, RIGHT = 1, -1
"""The envelopes, as signs of the roller's normal."""


def left_normal(velocity: Points, speed: Array) -> Points:
    """The unit normal n to the left of the way; 0 where the roller turns back, with V and |V| (...)."""
    normal: Points = 1j * velocity / np.where(speed > 0, speed, np.inf)
    return normal


def touched(centre: Points, normal: Points, radius: ArrayLike, side: int) -> Points:
    """Where the roller touches on one side, in the axes of the centre and the normal."""
    points: Points = centre + side * np.asarray(radius) * normal
    return points


def way_curvature(velocity: Points, acceleration: Points, speed: Array) -> Array:
    """κ of the roller's way, 1/mm, above 0 where it bends to the left; no number where the roller rests."""
    cross = velocity.real * acceleration.imag - velocity.imag * acceleration.real
    with np.errstate(divide="ignore", invalid="ignore"):
        value: Array = cross / (speed * speed * speed)
    return value


def regularity(curvature: Array, radius: ArrayLike, side: int) -> Array:
    """1 - κ r on the left, 1 + κ r on the right: below 0 the envelope turns back.

    >>> regularity(np.array([0.1, 0.2]), 8.0, LEFT).round(2).tolist()
    [0.2, -0.6]
    """
    value: Array = 1 - side * curvature * np.asarray(radius)
    return value
