"""A mechanism whose bodies stay in parallel planes: their layers as paths, seen from above."""

from collections.abc import Collection, Mapping, Sequence
from functools import lru_cache
from typing import Any

import numpy as np
import shapely

from mechwright.contracts.part import Part
from mechwright_cad.animation.figures import DRAWN, hexadecimal
from mechwright_cad.bodies import Body, label_of
from mechwright_cad.interference.slabs import Slab, slabs_of
from mechwright_cad.viewer.forms import form_of, is_light

LINE_CHORD = 0.02
"""Chord error of what is drawn, mm: a tenth of a line's width on the screen."""

KEPT = 64
"""Paths that are kept: two bodies may be of one part."""

MARGIN = 0.04
"""Free border around the motion, as a share of its greater side."""


def layers_of(body: Body, *, solids: bool) -> list[dict[str, Any]]:
    """What is seen of a body, each layer with the height of its top; nothing of a solid that is not made."""
    turn, place = body.poses.rotation[0], float(body.poses.position[0, 2])
    return [
        {
            "body": body.instance.body,
            "name": label_of(body),
            "colour": hexadecimal(body.part.colour_of(body.instance)),
            "top": round(place + max(slab.bottom * turn[2, 2], slab.top * turn[2, 2]), DRAWN),
            "path": path_of(slab.polygon),
        }
        for slab in _slabs(body, solids)
    ]


def see_through(
    layers: Sequence[dict[str, Any]], poses: Mapping[str, Any], plates: Collection[str]
) -> list[dict[str, Any]]:
    """The layers, where plates that stand still over what moves are ``clear``, so that one sees it.

    Parameters
    ----------
    layers, poses
        As a page has them.
    plates
        Names of the layers that are plates.

    >>> layers = [{"body": "a", "name": "a", "top": 6.0}, {"body": "ground", "name": "lid", "top": 9.0}]
    >>> poses = {"a": {"columns": [[0, 1], [0], [0]]}, "ground": {"columns": [[0], [0], [0]]}}
    >>> [one.get("clear", False) for one in see_through(layers, poses, {"a", "lid"})]
    [False, True]
    """
    moving = {name for name, pose in poses.items() if any(len(column) > 1 for column in pose["columns"])}
    tops = [one["top"] for one in layers if one["body"] in moving and one["name"] in plates]
    return [
        {**one, "clear": True}
        if tops and one["body"] not in moving and one["name"] in plates and one["top"] > min(tops)
        else one
        for one in layers
    ]


def _slabs(body: Body, solids: bool) -> Sequence[Slab]:
    if body.is_plate:
        return slabs_of(body.part, body.instance)
    if solids:
        from mechwright_cad.interference.prisms import prisms_of

        return prisms_of(body.part, body.instance.z) or _shadow(body.part, body.instance.z)
    return _shadow(body.part, body.instance.z) if is_light(body.part) else ()


@lru_cache(maxsize=KEPT)
def _shadow(part: Part, height: float) -> list[Slab]:
    """The outline of a solid that is no prism, as high as it is."""
    points, triangles = form_of(part)
    points = points + np.array((0.0, 0.0, height))
    corners = points[triangles][:, :, :2]
    flat = shapely.polygons(corners)
    shape = shapely.union_all(flat[shapely.area(flat) > 0], grid_size=10.0**-DRAWN / 2)
    bottom, top = float(points[:, 2].min()), float(points[:, 2].max())
    return [Slab(piece, bottom, top) for piece in shapely.get_parts(shape)]


@lru_cache(KEPT)
def path_of(polygon: shapely.Polygon) -> str:
    """The ``d`` of an SVG path: every loop of the polygon, mm, y upwards.

    >>> path_of(shapely.box(0, 0, 2, 1.5))
    'M2 0L2 1.5L0 1.5L0 0Z'
    """
    slim = shapely.simplify(polygon, LINE_CHORD)
    loops = []
    for ring in (slim.exterior, *slim.interiors):
        points = np.round(shapely.get_coordinates(ring)[:-1], DRAWN) + 0.0
        loops.append("M" + "L".join(f"{x:g} {y:g}" for x, y in points.tolist()) + "Z")
    return "".join(loops)


def window(bodies: Sequence[Body], *, solids: bool, paths: Sequence[Any] = ()) -> list[float]:
    """What the picture shows, mm: left, bottom, width and height of all that the bodies come to."""
    found = [np.asarray(path)[:, :2] for path in paths]
    for body in bodies:
        for slab in _slabs(body, solids):
            hull = shapely.get_coordinates(shapely.convex_hull(slab.polygon).simplify(LINE_CHORD))
            moved = body.poses.transform(np.column_stack((hull, np.zeros(len(hull)))))
            found.append(moved[..., :2].reshape(-1, 2))
    if not found:
        return [-1.0, -1.0, 2.0, 2.0]
    every = np.concatenate(found)
    low, high = every.min(axis=0), every.max(axis=0)
    border = MARGIN * float((high - low).max())
    return [round(value, DRAWN) for value in (*(low - border), *(high - low + 2 * border))]
