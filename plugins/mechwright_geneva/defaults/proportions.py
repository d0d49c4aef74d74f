"""Proportions of a Geneva mechanism whose design leaves them open; lengths in mm."""

from typing import Any

import numpy as np

from mechwright.contracts.design_table import number
from mechwright.standards.stock import AS_THICK, plate_stock

ANGLES = {
    3: (35.0, 5.0),
    4: (50.0, 5.0),
    5: (54.0, 11.0),
    6: (60.0, 10.0),
    7: (60.0, 12.0),
    8: (60.0, 12.0),
    9: (62.5, -6.0),
    10: (62.5, -5.0),
    11: (62.5, -4.0),
    12: (60.0, -3.0),
}
"""Half angle of the crank and offset angle, degrees, of curved slots by their number. Three and four are the
worked reference, five degrees more than a straight slot turns the crank. The others are in the middle of the
angles with which the slots of every law take a large roller and the driver keeps 0.08 l about its shaft: the
islands of up to eight slots stand on the right of the roller's way, those of more on the left."""

WHEEL = 100.0
"""Radius l of the wheel."""

STEP = 5.0
"""A radius that has to be larger than that is a multiple of this."""

ROLLER = 0.1
"""Diameter of the roller over l."""

SMALL_ROLLER, MOST_ROLLER = 3.0, 0.2
"""Of small wheels the roller may be as large as this, mm, and over l: thinner pins bend, and hardly a tool
makes their holes."""

WORTH_ROLLER, WORTH_SHARE = 2.0, 0.15
"""Diameter of a roller, mm, and over l, down to which other angles are looked for on small wheels: its pin is
of 1.2 mm."""

LEAST_ROLLER = 0.036
"""The same where the slots are narrow: below it, other angles are looked for."""

PIN = 1.2
"""Diameter of the pin over the radius of its roller: two fifths of the roller stay about it."""

SHAFT, FAIR_SHAFT, LEAST_SHAFT = 0.12, 0.08, 0.04
"""Diameter of the shafts over l; what a wheel that is left out is sized for, and dowels give way to; and the
least that is taken where a given wheel leaves no more."""

LOAD = 0.01
"""Moment of inertia that turns with the wheel, kg m²: about that of a usual wheel of steel."""

CRANK = 8.0
"""Thickness of the crank plate."""

FLOOR, FLOOR_SHARE = 3.0, 0.3
"""Thickness of the floor under the grooves, and the most of it over that of the wheel."""

_WALL, _WALL_SHARE = 2.0, 1 / 35
_DOWELS, _DOWEL_SHARE = (2.0, 4.0), 0.06
_FINE, _DEEP = 2.0, 3.5
"""Diameter of pins below which drills are hard to get; how deep end mills cut their holes, in diameters."""


def wall_of(entry_radius: Any) -> Any:
    """Thinnest walls: 2 mm, on wheels below 70 mm radius a 35th of it, in tenths; not below 0.2 mm."""
    share = np.floor(10 * np.minimum(_WALL, _WALL_SHARE * entry_radius) + 1e-9) / 10
    return number(np.maximum(0.2, share))


def roller_of(entry_radius: float) -> float:
    """Largest roller that is tried on a wheel: its diameter."""
    return max(ROLLER * entry_radius, min(SMALL_ROLLER, MOST_ROLLER * entry_radius))


def least_rollers_of(entry_radius: float) -> tuple[float, ...]:
    """Smallest roller for which other angles are looked for, then the smallest at all: diameters."""
    least = LEAST_ROLLER * entry_radius
    worth = max(least, min(WORTH_ROLLER, WORTH_SHARE * entry_radius))
    return (worth, least) if worth > least else (least,)


def dowel_of(entry_radius: Any) -> Any:
    """Largest dowels: 0.06 l, 2 to 4 mm."""
    return number(np.clip(_DOWEL_SHARE * entry_radius, *_DOWELS))


def crank_of(pin: Any, material: str) -> Any:
    """Thicknesses of crank plates for pins, which are mostly drilled: of fine ones the plate that is sold.

    >>> crank_of(np.array([3.0, 1.2, 0.25]), "steel").tolist()
    [8.0, 4.0, 0.875]
    """
    sizes = np.array(plate_stock(material).thicknesses, dtype=float)
    deep = np.where(pin < _FINE, np.minimum(CRANK, _DEEP * pin), CRANK)
    below = np.searchsorted(sizes, deep + AS_THICK)
    return number(np.where(below > 0, sizes[np.maximum(below - 1, 0)], deep))


def floor_of(thickness: Any) -> Any:
    """Floors: 3 mm, of thinner wheels three tenths, in tenths of a millimetre; not below 0.2 mm."""
    share = np.floor(10 * np.minimum(FLOOR, FLOOR_SHARE * thickness) + 1e-9) / 10
    return number(np.maximum(0.2, share))


def load_of(entry_radius: Any) -> Any:
    """Moments of inertia, kg m²: of smaller wheels as that of a disc, with l to the fourth."""
    return number(LOAD * np.minimum(1.0, entry_radius / WHEEL) ** 4)


def least_room(entry_radius: float, shaft: float = LEAST_SHAFT) -> float:
    """Radius about the driver's axis that a shaft of this share of l and a wall take."""
    room: float = shaft * entry_radius / 2 + wall_of(entry_radius)
    return room


def sold_disc(thickness: Any, axial_gap: Any, material: str) -> Any:
    """Thickness of the locking disc, mm, under the crank plate.

    It locks the wheel along its whole thickness, and ends at the crank plate, the gap above the wheel. The
    disc is of the thinnest plate that is sold and does so; what this is thicker stands below the wheel. Above
    the thickest plate the disc is as thick as it has to be.

    >>> sold_disc(10.0, 1.5, "aluminium"), sold_disc(13.5, 0.5, "aluminium")
    (12.0, 15.0)
    """
    sizes = np.array(plate_stock(material).thicknesses, dtype=float)
    room = np.asarray(thickness, dtype=float) + axial_gap
    at = np.searchsorted(sizes, room - AS_THICK)
    return number(np.where(at < sizes.size, sizes[np.minimum(at, sizes.size - 1)], room))
