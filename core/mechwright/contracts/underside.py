"""Features of a plate as they are seen when it has been turned over."""

from dataclasses import replace
from typing import Literal

from mechwright.contracts.part import Bore, Feature, OpenProfile, Pocket, Profile
from mechwright.errors import GeometryError
from mechwright.geometry.mirror import turned_over, turned_point, turned_segment

LEVEL = 1e-6
"""Heights that differ by less are one, mm."""

_MIRRORED: dict[str, Literal["left", "right", "on"]] = {"left": "right", "right": "left", "on": "on"}
"""Side of a path to its side when the plate has been turned over."""


def from_below(feature: Feature, thickness: float, about: Literal["x", "y"]) -> Feature:
    """A feature as it is seen when a plate of a thickness, mm, has been turned over about an axis.

    Raises GeometryError for a recess with a fillet on its floor, which would then stand at its top.

    >>> from_below(Bore("seat", (3.0, 4.0), 8.0, 5.0, 5.0), 10.0, "x")
    Bore(name='seat', centre=(3.0, -4.0), diameter=8.0, top=0.0, depth=5.0, fit=None, depth_limits=None)
    """
    top = thickness - feature.top - feature.depth
    top = 0.0 if abs(top) < LEVEL else top
    match feature:
        case Bore():
            return replace(feature, centre=turned_point(feature.centre, about), top=top)
        case Profile():
            sites = tuple((turned_point(site, about), width) for site, width in feature.tab_sites)
            return replace(feature, loop=turned_over(feature.loop, about), top=top, tab_sites=sites)
        case OpenProfile():
            path = tuple(turned_segment(segment, about) for segment in feature.path)
            return replace(feature, path=path, side=_MIRRORED[feature.side], top=top)
        case Pocket():
            if feature.floor_radius > 0:
                raise GeometryError(f"{feature.name} has a fillet on its floor, which cannot be turned over")
            islands = tuple(turned_over(loop, about) for loop in feature.islands)
            return replace(feature, boundary=turned_over(feature.boundary, about), islands=islands, top=top)
