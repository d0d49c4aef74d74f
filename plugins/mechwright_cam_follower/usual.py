"""Sizes of a lever that a design leaves out: they follow from its cam.

With a roller, axis and arm grow with the prime circle, and where one of them is given the other makes the
same triangle: the arm stands next to square to the line from the cam to its roller. With a flat face the
axis stands so near that the usual swing does not undercut the cam, and so far that it passes the lever's hub.
"""

from typing import Any, Protocol

import numpy as np

from mechwright_cam_follower.sized import Sized

AXIS, ARM = 90 / 48, 75 / 48
"""Of the prime circle's radius: from the cam's axis to the lever's, and from there to the roller."""

SQUARE = ARM**2 + 1
"""What the square of the axis would be, by that of the prime circle, if the arm stood square."""

FLAT, BESIDE = 1.7, 1.36
"""Least distance of the axis of a lever with a flat face: of the base circle, and of that and the face."""

STEPS = 2
"""Of a millimetre: what follows is rounded to halves."""

FOLLOWS = frozenset({"centre_distance", "arm_length"})
"""Fields that follow from others where they are left out."""


class Lever(Sized[Any], Protocol):
    """A design, or many with columns (n, 1), and what they say of the lever."""

    @property
    def centre_distance(self) -> Any:
        """As it is given, mm; None where it is left out."""

    @property
    def arm_length(self) -> Any:
        """The same of the arm."""


def followed(lever: Lever, name: str) -> Any:
    """One of the fields that follow, mm: a number, or (n, 1) of many designs.

    Where no lever reaches from a given axis or arm, the field is as if neither were given.
    """
    if lever.contact == "flat":
        found = np.maximum(FLAT * lever.base_radius, BESIDE * (lever.base_radius + lever.face))
        return np.round(found * STEPS) / STEPS
    prime = lever.base_radius + lever.value("roller_radius")
    other = lever.arm_length if name == "centre_distance" else lever.centre_distance
    usual = prime * (AXIS if name == "centre_distance" else ARM)
    if other is None:
        found = usual
    elif name == "centre_distance":
        found = np.sqrt((other**2 + prime**2) * AXIS**2 / SQUARE)
    else:
        square = other**2 * SQUARE / AXIS**2 - prime**2
        found = np.where(square > 0, np.sqrt(np.maximum(square, 0.0)), usual)
    return np.round(found * STEPS) / STEPS
