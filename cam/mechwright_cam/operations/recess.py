"""Recesses and openings as the cutter sees them: what must go, what stays, and where it may run out.

Glossary
--------
must
    The plan view of the feature on the part.
open
    No wall stands along a stretch of the boundary: the feature reaches over the part's edge, out of the plate
    or into the frame that is scrap, or into another feature that is at least as deep.
around
    Where the cutter's edge may be: ``must``, and beyond its open stretches a strip to run out into.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import TypeGuard

import numpy as np
import shapely

from mechwright.contracts import sections
from mechwright.contracts.details import Detail
from mechwright.contracts.part import Bore, Feature, Pocket, Profile
from mechwright.errors import DesignError
from mechwright.geometry.prepared import prepared
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.choice import roomy_mills, run_out
from mechwright_cam.setup.depths import bottom_of
from mechwright_cam.setup.job import LEVEL, Job
from mechwright_cam.shop.tool import Tool
from mechwright_plane.offsets import (
    ROUGH,
    areas,
    corners,
    filled,
    grow,
    opened,
    polygons,
    swept,
    valid_shape,
)
from mechwright_plane.reach import opening_keep

SKIN = 2 * TOLERANCES.flatten
"""A boundary within this of the part's edge is on it, mm: what the chords of both may be off together."""
FILM = 1e-6
"""Area over circumference of what only rounding of numbers can leave, mm."""
SAME = 1e-6
"""Layers that differ by less are one, mm²."""
LONG = 2.0
"""Circumference from which on something as thin is a skin, mm."""


Layer = tuple[float, shapely.Geometry]
"""What stands above a recess: its height over the recess's floor, mm, and its plan view."""


@dataclass(frozen=True)
class Recess:
    """The shapes of one feature, work coordinates, mm."""

    must: shapely.Geometry
    keep: shapely.Geometry
    around: shapely.Geometry
    open: bool


def is_recess(feature: Feature | Detail) -> TypeGuard[Profile | Pocket]:
    """Whether it is a pocket, or an opening that is not round."""
    return isinstance(feature, Pocket) or (isinstance(feature, Profile) and feature.side == "inside")


def plan_view(feature: Feature) -> shapely.Geometry:
    """What an inside feature takes, seen from above, as it is drawn."""
    if isinstance(feature, Bore):
        radius = feature.diameter / 2
        return shapely.Point(feature.centre).buffer(radius, quad_segs=corners(radius, ROUGH / 20))
    return sections.plan_view(feature)


def recess(
    job: Job, feature: Profile | Pocket, mills: Sequence[Tool], far: float = 0.0, *, roomy: bool = False
) -> Recess:
    """Look at a feature that ``mills`` may cut, largest first.

    Beyond an open stretch the cutter's edge goes ``far`` mm; by default as far as the widest mill goes, or of
    ``roomy`` ones the widest that has room: others come in at its mouths, if at all.
    """
    shape, inside = plan_view(feature), filled(job.body)
    edge = prepared(grow(inside, -SKIN, ROUGH))
    near = [other for other in _at_least_as_deep(job, feature) if shapely.dwithin(shape, other, SKIN)]
    if isinstance(feature, Pocket) and feature.floor_radius > 0:
        _check_alone(job, feature, shape)
    if shapely.contains_properly(edge, shape) and not near:
        return Recess(shape, opening_keep(shape, 2 * mills[0].diameter), shape, False)
    must = shapely.union_all(polygons(shapely.intersection(shape, inside)))
    if shapely.is_empty(shapely.buffer(must, -TOLERANCES.leftover / 2, quad_segs=2)):
        must = shapely.Polygon()  # so thin everywhere that it may stay as well
    if shapely.is_empty(must):
        return Recess(must, must, must, True)
    first = not far
    if first:
        far = run_out(roomy_mills(mills, must, job.settings.stock_to_leave)[:1], job.settings)
        far = far if roomy else max(far, mills[0].diameter)
    (x0, y0, x1, y1), wide = shape.bounds, 4 * far
    window = shapely.box(x0 - wide, y0 - wide, x1 + wide, y1 + wide)
    bottom = bottom_of(job, feature.top, feature.depth)
    gone = shapely.union_all([shapely.difference(window, inside), *near])
    keep = shapely.difference(shapely.intersection(job.body, window), shapely.union_all([must, gone]))
    keep = without_skin(keep, looked_at=first)
    tabs = [tab.shape for tab in job.tabs if tab.top > bottom + LEVEL]
    if job.frame is not None:
        tabs.append(shapely.intersection(job.frame.holds, window))
    keep = shapely.union_all([*polygons(keep), *tabs])
    free = polygons(shapely.difference(grow(must, far, ROUGH), keep))
    around = shapely.union_all([part for part in free if shapely.intersects(part, must)])
    return Recess(must, keep, around, True)


def walls_of(job: Job, feature: Profile | Pocket, near: float) -> tuple[Layer, ...]:
    """What stands around a recess up to the top of the plate, in layers from its floor up.

    Only what is at most ``near`` mm from it counts.
    """
    floor, around = feature.top + feature.depth, grow(plan_view(feature), near, ROUGH)
    beside = [other for other in job.inner if shapely.intersects(plan_view(other), around)]
    plate = areas(shapely.intersection(job.body, around))
    layers: list[Layer] = []
    for section in reversed(sections.cut_layers(plate, beside, floor)):
        wall = without_skin(areas(section.shape))
        if layers and shapely.symmetric_difference(wall, layers[-1][1]).area < SAME:
            wall = layers.pop()[1]
        layers.append((floor - section.top, wall))
    return tuple(layers)


def _check_alone(job: Job, feature: Pocket, shape: shapely.Geometry) -> None:
    """Refuse a fillet on a floor that is none, or that does not end at walls of its own."""
    floor = feature.top + feature.depth
    if floor >= job.thickness - LEVEL:
        raise DesignError(
            f"part {job.part.name}: {feature.name} has a floor_radius of {feature.floor_radius:g} mm, but "
            "goes through to the underside; a fillet needs a floor"
        )
    for other in job.inner:
        apart = other.top >= floor - LEVEL or other.top + other.depth <= feature.top + LEVEL
        if other is feature or apart or not shapely.dwithin(shape, plan_view(other), SKIN):
            continue
        if not _within(other, feature, shape):
            raise DesignError(
                f"part {job.part.name}: {feature.name} has a floor_radius and opens into {other.name}; the "
                "fillet would end there. Draw them apart, or as one, or without the fillet"
            )


def _within(other: Feature, feature: Pocket, shape: shapely.Geometry) -> bool:
    """Whether another feature goes on below the floor, away from the fillet: a bore through it, say."""
    floor = grow(shape, -feature.floor_radius, ROUGH)
    deeper = other.top + other.depth > feature.top + feature.depth + LEVEL
    return deeper and bool(shapely.contains(floor, plan_view(other)))


def reached_share(shapes: Recess, radius: float) -> float:
    """The part of a feature's area that a cutter of ``radius`` can reach."""
    return float(shapely.intersection(swept(shapes.around, radius), shapes.must).area / shapes.must.area)


@lru_cache(maxsize=64)
def without_skin(keep: shapely.Geometry, *, looked_at: bool = False) -> shapely.Geometry:
    """Without what rounding leaves standing where a feature ends at the edge: long and thin, no drawn wall.

    The tip of a sharp wedge is as thin, but short. Paths follow the edge of what is thick; a shape that is
    only looked at, to choose mills, keeps what lies on that edge within the rounding of numbers.
    """
    thick = opened(keep, SKIN / 2)
    thin = shapely.get_parts(shapely.difference(keep, thick))
    length, area = shapely.length(thin), shapely.area(thin)
    found = (length > LONG) | (area < FILM * length)
    if looked_at:
        corners, owner = shapely.get_coordinates(thin, return_index=True)
        away = ~shapely.dwithin(prepared(thick), shapely.points(corners), FILM)
        found &= np.bincount(owner[away], minlength=len(thin)) > 0
    if not found.any():
        return keep
    # What is thinner than numbers can tell has come out as lines.
    lines = shapely.buffer(thin[found & (area == 0)], FILM, quad_segs=1)
    skin = shapely.multipolygons([*thin[found & (area > 0)], *lines])
    return shapely.union_all(polygons(shapely.difference(keep, valid_shape(skin))))


def _at_least_as_deep(job: Job, feature: Profile | Pocket) -> list[shapely.Geometry]:
    """The other features that take everything from this one's top to its bottom."""
    top, bottom = feature.top, feature.top + feature.depth
    return [
        plan_view(other)
        for other in job.inner
        if other is not feature and other.top <= top + LEVEL and other.top + other.depth >= bottom - LEVEL
    ]
