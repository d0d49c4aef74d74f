"""Places that two layers of one wall have in common are cut down through both at once.

A wall with tabs has two layers, above and below their tops. What an earlier cutter has left away from the
tabs is the same in both, as the bottoms of tooth gaps are: the cutter comes there once, not once for each.
"""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import shapely

from mechwright_cam.operations.clearing import Roughing
from mechwright_cam.operations.runs import Cavity
from mechwright_plane.offsets import ROUGH

ALIKE = ROUGH
"""Places are the same if what only one of them has is no wider than this in the mean, mm."""


def join(cuts: list[Roughing]) -> None:
    """Let each cut of a layer take along the places of the one below it, as far as they are the same.

    The layers go from the top down and lie on each other. The cutter moves as it has to in the lower one,
    where more is in its way.
    """
    for upper, lower in reversed(list(pairwise(cuts))):
        shared = _shared(upper.cavities, lower.cavities)
        bottom = lower.zone.bottom_for(lower.tool)
        upper.cavities = [
            replace(lower.cavities[shared[n]], bottom=bottom) if n in shared else cavity
            for n, cavity in enumerate(upper.cavities)
        ]
        taken = set(shared.values())
        lower.cavities = [cavity for n, cavity in enumerate(lower.cavities) if n not in taken]


def _shared(upper: list[Cavity], lower: list[Cavity]) -> dict[int, int]:
    """Index of each cavity of an upper layer that a lower one has as well, and its index there."""
    if not upper or not lower:
        return {}
    ours, theirs = (np.array([cavity.core for cavity in some]) for some in (upper, lower))
    one, two = shapely.STRtree(theirs).query(ours, predicate="intersects")
    apart = shapely.area(shapely.symmetric_difference(ours[one], theirs[two]))
    same = apart <= ALIKE * shapely.length(ours[one]) / 2
    return dict(zip(one[same].tolist(), two[same].tolist(), strict=True))
