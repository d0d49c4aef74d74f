"""The masses of the gears of designs, from areas in closed form."""

import math

import numpy as np

from mechwright import material
from mechwright.contracts.figure import PartMass
from mechwright.contracts.mass import KILOGRAMS
from mechwright_elliptic_gears.parts.areas import areas_of
from mechwright_elliptic_gears.table import GearTable


def masses_of(m: GearTable) -> dict[str, PartMass] | None:
    """The mass of a gear, of which a pair has two; None of trains and keyed gears, whose parts are drawn."""
    given = m.given
    if given.stages == 2 or np.any(np.asarray(given.keyway_width) > 0):
        return None
    area = areas_of(m.gears)[:, None] * m.semi_major**2 - math.pi / 4 * given.bore**2
    return {"gear": PartMass(KILOGRAMS * material(given.material).density * area * given.thickness, 2)}
