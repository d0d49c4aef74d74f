"""Dimensions that a design leaves open: they follow from its cam.

The bore of a small cam and the stud of a small roller are the largest usual ones that leave walls.
With a roller, axis and arm grow with the prime circle, and where one of them is given the other makes the
same triangle: the arm stands next to square to the line from the cam to its roller; for a long swing it is
shorter, and the axis farther away. With a flat face the axis stands so near that the usual swing does not
undercut the cam, and so far that it passes the lever's hub.
"""

from collections.abc import Container, Iterator
from typing import Any

import numpy as np

from mechwright.contracts.design_table import number

AXIS, ARM = 90 / 48, 75 / 48
"""Of the prime circle's radius: from the cam's axis to the lever's, and from there to the roller."""

WIDE, WIDE_AXIS, WIDE_ARM = 26.0, 1.8, 1.2
"""Degrees of swing above which the arm is shorter and the axis farther away, and both ratios then: the lever
keeps off the cam and its pressure angle below 35 degrees up to 40 degrees over 120 of the cam."""

FLAT, BESIDE = 1.7, 1.36
"""Least distance of the axis of a lever with a flat face: of the base circle, and of that and the face."""

SHAFTS = (15.0, 12.0, 10.0, 8.0, 6.0, 5.0, 4.0, 3.0, 2.5, 2.0, 1.5, 1.0)
"""Bores, mm: the usual one, and those of smaller shafts that are sold."""

STUDS = SHAFTS[3:]
"""The same of studs of rollers."""

FITTED_FIELDS = ("bore", "pin_diameter")
"""Fields that follow from the cam and its roller where the default leaves no wall."""

STEPS = 2
"""Of a millimetre: what follows is rounded to halves."""

FOLLOWS = frozenset({"centre_distance", "arm_length"})
"""Fields that follow from others where they are left out."""


def followed(lever: Any, name: str) -> Any:
    """Give one of the fields that follow, mm.

    Where no lever reaches from a given axis or arm, the field is as if neither were given.

    Parameters
    ----------
    lever
        The design table, :class:`~mechwright_cam_follower.parameters.CamParams`; its numbers may be columns.
    name
        One of :data:`FOLLOWS`.
    """
    if lever.contact == "flat":
        found = np.maximum(FLAT * lever.base_radius, BESIDE * (lever.base_radius + lever.face))
        return number(np.round(found * STEPS) / STEPS)
    prime = lever.base_radius + lever.value("roller_radius")
    axis, arm = (AXIS, ARM) if lever.stroke <= WIDE else (WIDE_AXIS, WIDE_ARM)
    square = arm**2 + 1  # that of the axis, by that of the prime circle, if the arm stood square
    other = lever.arm_length if name == "centre_distance" else lever.centre_distance
    default = prime * (axis if name == "centre_distance" else arm)
    if other is None:
        found = default
    elif name == "centre_distance":
        found = np.sqrt((other**2 + prime**2) * axis**2 / square)
    else:
        left = other**2 * square / axis**2 - prime**2
        found = np.where(left > 0, np.sqrt(np.maximum(left, 0.0)), default)
    return number(np.round(found * STEPS) / STEPS)


def fitted(lever: Any, name: str) -> Any:
    """Give the bore or the diameter of the studs, mm; the default one where none fits."""
    sizes: tuple[float, ...] = SHAFTS if name == "bore" else STUDS
    least = lever.base_radius - lever.least_wall
    if name != "bore":
        least = lever.value("roller_radius") - lever.least_wall / 2
    return number(np.select([np.asarray(one <= 2 * least) for one in sizes], sizes, sizes[0]))


def left_out(given: Container[str], keyed: bool, contact: str) -> Iterator[str]:
    """The fields that are fitted where ``given`` has them not; a keyway belongs to its bore."""
    if "bore" not in given and not keyed:
        yield "bore"
    if "pin_diameter" not in given and contact == "roller":
        yield "pin_diameter"
