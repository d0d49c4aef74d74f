"""Which features are cut from above, and which from the underside."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Literal

import shapely

from mechwright.contracts.part import Feature, Part, Pocket, is_outside
from mechwright.contracts.underside import from_below
from mechwright.errors import DesignError
from mechwright_cam.setup.job import LEVEL
from mechwright_cam.setup.views import inside_of

SPECK = 1e-3
"""A feature is open to a side if all but this of its area is, mm²: the chords of two outlines differ."""


SIGNS = {"x": (1.0, -1.0), "y": (-1.0, 1.0)}
"""Factors of X and Y when the plate is turned over about an axis."""


def sides(part: Part) -> tuple[tuple[Feature, ...], tuple[Feature, ...]]:
    """The features that are cut from above, and those that only the underside shows.

    Raises DesignError for a feature that is closed on both sides.
    """
    above = _open_from_above(part.features)
    rest = [feature for feature in part.features if feature not in above]
    if not rest:
        return part.features, ()
    flat = [replace(f, floor_radius=0.0) if isinstance(f, Pocket) else f for f in part.features]
    below = {over.name for over in _open_from_above([_over(f, part.thickness, "x") for f in flat])}
    for feature in rest:
        if feature.name not in below:
            raise DesignError(
                f"part {part.name}: {feature.name} starts {feature.top:g} mm below the top, is "
                f"{feature.depth:g} mm deep, and closed on both sides; open it to one"
            )
    return tuple(feature for feature in part.features if feature in above), tuple(rest)


def _open_from_above(features: Sequence[Feature]) -> list[Feature]:
    """The features that begin at the top face, or in what others have opened down to there."""
    found: list[Feature] = []
    for feature in sorted(features, key=lambda feature: feature.top):
        if feature.top > LEVEL:
            deep = [f for f in found if f.top + f.depth >= feature.top - LEVEL and not is_outside(f)]
            closed = shapely.difference(inside_of(feature), shapely.union_all([inside_of(f) for f in deep]))
            if closed.area > SPECK:
                continue
        found.append(feature)
    return found


def _over(feature: Feature, thickness: float, about: Literal["x", "y"]) -> Feature:
    """A feature as it is seen when the plate has been turned over; a fillet cannot be cut from there."""
    if isinstance(feature, Pocket) and feature.floor_radius > 0:
        raise DesignError(
            f"cam.second_side: {feature.name} has a floor_radius and is milled from the underside; "
            "fillets are for floors that are cut from above"
        )
    return from_below(feature, thickness, about)
