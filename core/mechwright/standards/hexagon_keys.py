"""Hexagon socket keys (ISO 2936, DIN 911), bits, and pliers for circlips: the room that they need.

Lengths are from memory of the standard's table and not checked against its text.
"""

from dataclasses import dataclass

from mechwright.errors import DesignError

SWING = 60.0
"""Least angle through which a key has to swing before its next grip, degrees: a sixth of a turn."""

TILT = 25.0
"""Greatest angle between a ball-ended key and the axis of its screw, degrees."""

BIT_LENGTH = 100.0
"""Length of a bit with its holder along the axis of the screw, mm."""

BIT_DIAMETERS = ((5.0, 8.0), (8.0, 12.0), (12.0, 16.0))
"""Thread of a screw, mm, up to which a bit with its holder has a diameter, mm."""

PLIERS = (12.0, 50.0)
"""Diameter and length of the arms of straight circlip pliers behind their tips, mm."""


@dataclass(frozen=True)
class HexagonKey:
    """A key by its width across flats; lengths of its arms, from the outside of the bend, mm."""

    width: float
    long: float
    short: float


_KEYS = (
    HexagonKey(1.5, 45.0, 14.0),
    HexagonKey(2.0, 50.0, 16.0),
    HexagonKey(2.5, 56.0, 18.0),
    HexagonKey(3.0, 63.0, 20.0),
    HexagonKey(4.0, 70.0, 25.0),
    HexagonKey(5.0, 80.0, 28.0),
    HexagonKey(6.0, 90.0, 32.0),
)


def hexagon_key(width: float) -> HexagonKey:
    """The key of a width across flats, mm.

    Raises DesignError for a width without one.

    >>> hexagon_key(4.0).short
    25.0
    """
    for key in _KEYS:
        if key.width == width:
            return key
    widths = ", ".join(f"{key.width:g}" for key in _KEYS)
    raise DesignError(f"no hexagon key of {width:g} mm; widths: {widths}")


def bit_diameter(thread: float) -> float:
    """Diameter of a bit with its holder for a screw of a thread, mm; that of the largest above all.

    >>> bit_diameter(5.0), bit_diameter(6.0)
    (8.0, 12.0)
    """
    return next((wide for most, wide in BIT_DIAMETERS if thread <= most), BIT_DIAMETERS[-1][1])
