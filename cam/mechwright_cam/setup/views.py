"""Plan views of features, as planning and proof both see them: they say what is asked, not how it is cut."""

import math
from typing import TypeAlias

import shapely

from mechwright.contracts.part import Bore, Feature
from mechwright.contracts.sections import plan_view
from mechwright.tolerances import TOLERANCES

Shape: TypeAlias = shapely.Polygon | shapely.MultiPolygon

ROUND = 1e-4
"""How far the chords of a circle may lie inside the true arc, mm: a hundredth of the leftover limit."""
SKIN = 2 * TOLERANCES.flatten
"""Two boundaries within this are one, mm: what the chords of both may be off together."""


def quarter(radius: float, error: float = ROUND) -> int:
    """Chords per quarter circle that stay within ``error`` of it.

    >>> quarter(3.0), quarter(3.0, 0.01)
    (97, 10)
    """
    half = math.acos(max(1 - error / max(abs(radius), error), 0.0))
    return max(2, math.ceil(math.pi / 4 / half))


def inside_of(feature: Feature) -> Shape:
    """The plan view of an opening, or of what an outside profile surrounds."""
    if isinstance(feature, Bore):
        radius = feature.diameter / 2
        return shapely.Point(feature.centre).buffer(radius, quad_segs=quarter(radius))
    return plan_view(feature)
