"""The plate of the locking disc: as thick as one that is sold, and where it stands."""

from typing import Any

import numpy as np

from mechwright.contracts.design_table import number
from mechwright.standards.stock import AS_THICK, plate_stock


def disc_thickness(thickness: Any, axial_gap: Any, material: str) -> Any:
    """Thickness of the locking disc, mm, under the crank plate.

    It locks the wheel along its whole thickness, and ends at the crank plate, the gap above the wheel. The
    disc is of the thinnest plate that is sold and does so; what this is thicker stands below the wheel. Above
    the thickest plate the disc is as thick as it has to be.

    >>> disc_thickness(10.0, 1.5, "aluminium"), disc_thickness(13.5, 0.5, "aluminium")
    (12.0, 15.0)
    """
    sizes = np.array(plate_stock(material).thicknesses, dtype=float)
    room = np.asarray(thickness, dtype=float) + axial_gap
    at = np.searchsorted(sizes, room - AS_THICK)
    return number(np.where(at < sizes.size, sizes[np.minimum(at, sizes.size - 1)], room))
