"""The shaft's bore where a design leaves it out."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from mechwright.tolerances import falls_short

USUAL = 10.0
"""mm: the default of the table."""

SHAFTS = (USUAL, 8.0, 6.0, 5.0, 4.0, 3.0, 2.5, 2.0, 1.5, 1.0)
"""mm: the usual one, and smaller shafts that are sold."""

RIM = 1.2
"""Material between bore and roots over the height of a tooth, as the checks of a rim want it."""

TRAIN = 3.0
"""Of a train, semi-major axis over bore: beside its shafts it has dowels and the joints of its coupler."""

DECIDES = frozenset(
    {"eccentricity", "teeth", "module", "semi_major", "addendum", "dedendum", "stages", "keyway_width"}
)
"""Parameters that the bore follows from."""


def bores(table: Callable[[str], Any]) -> Any:
    """The usual bore, or the largest smaller one that leaves the rim, mm; of parameters by their names.

    A keyway belongs to its bore, which then is the usual one; where none leaves the rim it is so too.
    Parameters may be arrays (n,) over designs, and so is the answer then.
    """
    e, teeth = np.asarray(table("eccentricity")), table("teeth")
    # Ramanujan's second formula, off by less than 1e-5 up to e = 0.9.
    b = np.sqrt(1 - e * e)
    h = ((1 - b) / (1 + b)) ** 2
    perimeter = math.pi * (1 + b) * (1 + 3 * h / (10 + np.sqrt(4 - 3 * h)))
    a, module = table("semi_major"), table("module")
    if a is None:
        a = math.pi * module * teeth / perimeter
    else:
        module = a * perimeter / (math.pi * teeth)
    least = RIM * (table("addendum") + table("dedendum")) + table("dedendum")
    pair, keyed = np.asarray(table("stages")) == 1, np.asarray(table("keyway_width")) > 0
    fits = [
        ~np.asarray(falls_short(a * (1 - e) - one / 2, least * module)) & (pair | (one <= a / TRAIN))
        for one in SHAFTS
    ]
    return np.select([keyed, *fits], [USUAL, *SHAFTS], USUAL)
