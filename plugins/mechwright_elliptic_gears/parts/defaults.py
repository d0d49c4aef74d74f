"""What a design leaves out and follows from the rest: heights and number of teeth, face width, bore."""

import math
from collections.abc import Callable, Container
from typing import Any

import numpy as np

from mechwright.mechanics.gearing.usual import (
    DEDENDUM,
    FACE,
    MOST_TEETH,
    RIM,
    SHAFTS,
    TIP_RADIUS,
    dedendum_beside,
    face_width,
    shaft_bore,
    straight_depth,
    teeth_without_undercut,
    tip_radius_beside,
)
from mechwright_elliptic_gears.kinematics.ellipse import perimeter_of
from mechwright_elliptic_gears.parts.tooth_offset import offset_miss

TEETH = 25
"""The default of the table."""

USUAL = {"dedendum": DEDENDUM, "tip_radius": TIP_RADIUS, "teeth": TEETH, "thickness": FACE, "bore": SHAFTS[0]}
"""Parameters that follow where they are left out, in the order in which they do, and what is usual."""

TRAIN = 3.0
"""Of a train, semi-major axis over bore: beside its shafts it has dowels and the joints of its coupler."""

Table = Callable[[str], Any]
"""Parameters by their names: numbers, or columns (n, 1) over designs."""


def following(table: Table, given: Container[str]) -> dict[str, Any]:
    """What is left out, as it follows from what is ``given`` and from each other.

    A value is a column where it follows from one.
    """
    found: dict[str, Any] = {}

    def value(name: str) -> Any:
        return found[name] if name in found else table(name)

    rules: dict[str, Callable[[Table], Any]] = {
        "dedendum": lambda of: dedendum_beside(of("addendum")),
        "tip_radius": lambda of: tip_radius_beside(of("dedendum"), of("pressure_angle")),
        "teeth": _teeth,
        "thickness": lambda of: face_width(_sizes(of)[1]),
        "bore": _bore,
    }
    for name in USUAL:
        if name not in given:
            found[name] = rules[name](value)
    return found


def _teeth(table: Table) -> Any:
    """The usual number of teeth, or the least greater one without undercut, which meshes at a given offset.

    Where none up to :data:`MOST_TEETH` is without, it is the usual one.
    """
    e, angle, dedendum = np.asarray(table("eccentricity")), table("pressure_angle"), table("dedendum")
    # An ellipse of semi-major axis 1 is bent most at the ends of that axis, with a radius of 1 - e².
    bend = perimeter_of(e) / (1 - e * e)
    depth = straight_depth(dedendum, table("tip_radius"), angle)
    teeth = np.maximum(teeth_without_undercut(bend, depth, dedendum, angle), TEETH)
    teeth = np.where(teeth > MOST_TEETH, TEETH, teeth).astype(int)
    offset = table("tooth_offset")
    if offset is None:
        return teeth
    missed = (offset_miss(offset, teeth) > 0) & (offset_miss(offset, teeth + 1) == 0)
    return np.where(missed, teeth + 1, teeth)


def _sizes(table: Table) -> tuple[Any, Any]:
    """Semi-major axis and module, mm."""
    perimeter, teeth = perimeter_of(np.asarray(table("eccentricity"))), table("teeth")
    a, module = table("semi_major"), table("module")
    if a is None:
        return math.pi * module * teeth / perimeter, module
    return a, a * perimeter / (math.pi * teeth)


def _bore(table: Table) -> Any:
    """The usual bore, or the largest smaller one that leaves the rim, mm.

    A keyway belongs to its bore, which then is the usual one; where none leaves the rim it is so too.
    """
    a, module = _sizes(table)
    wall = (RIM * (table("addendum") + table("dedendum")) + table("dedendum")) * module
    most = np.where(np.asarray(table("stages")) == 1, math.inf, a / TRAIN)
    found = shaft_bore(a * (1 - np.asarray(table("eccentricity"))), wall, most)
    return np.where(np.asarray(table("keyway_width")) > 0, SHAFTS[0], found)
