"""Sizes of pins, bosses and links where a design leaves them out: the usual ones, or smaller ones.

On a small sphere, and where pins are few degrees apart, bosses of the usual size do not fit side by side.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from mechwright_spherical.parts.hardware import HardwareTable

WALL = 1.0
"""Least material around a bore or between two, mm: less bulges when a pin goes in."""


@dataclass(frozen=True)
class Sizes:
    """Of pins, bosses and links, mm: numbers, or arrays (n,) over designs."""

    pin_diameter: Any
    boss_diameter: Any
    link_width: Any


USUAL = Sizes(6.0, 12.0, 8.0)
"""The defaults of the table."""

_SMALLER = (
    Sizes(5.0, 10.0, 7.0),
    Sizes(4.0, 8.0, 6.0),
    Sizes(3.0, 6.0, 5.0),
    Sizes(2.5, 5.0, 4.0),
    Sizes(2.0, 4.5, 3.5),
    Sizes(1.5, 4.0, 3.0),
)
"""Dowel pins as they are sold; bosses are twice as wide, or leave the least material about them."""

NAMES = tuple(field.name for field in fields(Sizes))
"""Their keys in the table ``hardware``."""

CURED = frozenset(f"spherical.{name}" for name in ("boss", "gap", "shafts", "clearance", "slot", "drive"))
"""Errors that smaller sizes may cure; where others stand as well, the sizes are the usual ones."""


def least_boss(pin: Any, fit: Any) -> Any:
    """Diameter of a boss that leaves material about its bore, mm."""
    return pin + fit + 2 * WALL


def left_out(hardware: HardwareTable) -> frozenset[str]:
    """Which of the sizes a table leaves out."""
    return frozenset(NAMES) - hardware.model_fields_set


def candidates(given: Mapping[str, Any], fit: Any) -> Iterator[Sizes]:
    """Sizes to try, largest first; what is given stays, and a boss that is left out suits its pin.

    >>> [float(one.boss_diameter) for one in candidates({"pin_diameter": 9.0}, 0.05)][:3]
    [12.0, 12.0, 11.5]
    """
    yield Sizes(**{name: given.get(name, getattr(USUAL, name)) for name in NAMES})
    for row in (USUAL, *_SMALLER):
        sizes = {name: given.get(name, getattr(row, name)) for name in NAMES}
        if "boss_diameter" not in given:
            wide = np.ceil(2 * least_boss(sizes["pin_diameter"], fit) - 1e-9) / 2
            sizes["boss_diameter"] = np.maximum(row.boss_diameter, wide)
        yield Sizes(**sizes)
