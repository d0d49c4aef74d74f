"""Which contour lies in which: the outline of the plate, and what goes through it."""

from collections.abc import Sequence

import shapely

from mechwright.drawings.contours import Contour
from mechwright.drawings.fault import Told, at

TOUCH = 1e-3
"""Contours whose insides share less than a strip of this width, mm, only touch: a tenth of a gap."""


def lies_in(inner: shapely.Polygon, outer: shapely.Polygon) -> bool:
    """Whether one shape lies in another, or touches its edge from inside."""
    return bool(shapely.covers(shapely.buffer(outer, TOUCH), inner))


def share(one: shapely.Polygon, two: shapely.Polygon) -> bool:
    """Whether the insides of two shapes meet."""
    return bool(shapely.intersects(shapely.buffer(one, -TOUCH), two))


def place_of(one: shapely.Polygon, two: shapely.Polygon) -> str:
    """Where two contours cross, or where one of them stands."""
    met = shapely.intersection(shapely.boundary(one), shapely.boundary(two))
    point = shapely.get_coordinates(met) if not met.is_empty else shapely.get_coordinates(one)
    return at((float(point[0, 0]), float(point[0, 1])))


def outline_of(outline: Sequence[Contour], through: Sequence[Contour], told: Told) -> Contour | None:
    """The outside of the plate: the outermost contour of those that mean the outline, or else of all."""
    pool = list(outline) or list(through)
    if not pool:
        told.fault(
            "contour",
            "the drawing shows no closed outline",
            'draw one, or say its layer: layers = { "NAME" = "outline" }',
            "layers",
        )
        return None
    outer = max(pool, key=lambda one: one.loop.area)
    shape = outer.shape
    for one in (*outline, *through):
        other = one.shape
        if one is outer or lies_in(other, shape):
            continue
        crossing = share(other, shape)
        what = f"crosses the outline at {place_of(other, shape)}" if crossing else "lies beside the outline"
        told.fault(
            "contour",
            f"the contour of {one.name} {what}",
            "draw one plate, with its openings inside",
        )
    return outer


def openings_of(candidates: Sequence[Contour], told: Told) -> list[Contour]:
    """The openings among contours that go through: none of them meets another."""
    shapes = [one.shape for one in candidates]
    if not shapes:
        return []
    tree = shapely.STRtree(shapes)
    first, second = tree.query(shapes, predicate="intersects")
    for i, j in zip(first.tolist(), second.tolist(), strict=True):
        if i >= j or not share(shapes[i], shapes[j]):
            continue
        small, large = sorted((i, j), key=lambda k: shapes[k].area)
        if lies_in(shapes[small], shapes[large]):
            told.fault(
                "contour",
                f"the contour of {candidates[small].name} lies in the opening of {candidates[large].name}: "
                "it would fall out",
                "delete one of them, or give it a layer of its own",
            )
        else:
            told.fault(
                "contour",
                f"the openings of {candidates[small].name} and {candidates[large].name} cross each other at "
                f"{place_of(shapes[small], shapes[large])}",
                "draw them as one opening",
            )
    return list(candidates)
