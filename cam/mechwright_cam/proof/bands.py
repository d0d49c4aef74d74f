"""Heights between which the finished part has one cross-section."""

from dataclasses import dataclass
from itertools import pairwise

import shapely

from mechwright.part import Bore, Feature, Pocket, Profile
from mechwright.sections import plan_view
from mechwright_cam.job import Job
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.plane import Shape, grow, quarter
from mechwright_cam.toolpath.offsets import filled


@dataclass(frozen=True)
class Band:
    """A layer of the part.

    Parameters
    ----------
    top, bottom
        z in work coordinates, mm.
    keep
        The finished part's cross-section, tabs not counted.
    """

    top: float
    bottom: float
    keep: Shape


def inside_of(feature: Feature) -> Shape:
    """The plan view of an opening, or of what an outside profile surrounds."""
    if isinstance(feature, Bore):
        radius = feature.diameter / 2
        round_hole: Shape = shapely.Point(feature.centre).buffer(radius, quad_segs=quarter(radius))
        return round_hole
    return plan_view(feature)


def floor_of(feature: Feature, job: Job) -> Shape:
    """The part of :func:`inside_of` that lies on the plate: a recess may be drawn beyond its edge."""
    view = inside_of(feature)
    if isinstance(feature, Pocket):
        view = shapely.intersection(view, filled(job.target))
    return view


def bands(job: Job, extra: tuple[float, ...] = ()) -> list[Band]:
    """The layers from the top of the part to its underside.

    The outline has every opening that goes through; features that do not are taken from the layers they
    reach. ``extra`` are more heights to divide at.
    """
    through = job.thickness - NEAR
    partial = [f for f in job.features if f.top > NEAR or f.top + f.depth < through]
    heights = {0.0, -job.thickness, *extra}
    for feature in partial:
        heights |= {-feature.top, -min(feature.top + feature.depth, job.thickness)}
    ordered = sorted((h for h in heights if -job.thickness - NEAR <= h <= NEAR), reverse=True)
    layers = []
    known: dict[tuple[Feature, ...], Shape] = {}
    for top, bottom in pairwise(ordered):
        if top - bottom < NEAR:
            continue
        depth = -(top + bottom) / 2
        here = tuple(feature for feature in partial if feature.top < depth < feature.top + feature.depth)
        if here not in known:
            known[here] = _section(job.target, here)
        layers.append(Band(top, bottom, known[here]))
    return layers


def _section(whole: Shape, features: tuple[Feature, ...]) -> Shape:
    keep = whole
    for feature in features:
        shape = inside_of(feature)
        if isinstance(feature, Profile) and feature.side == "outside":
            keep = shapely.intersection(keep, shape)
        else:
            keep = shapely.difference(keep, shape)
    return keep


def stock_shape(job: Job) -> shapely.Polygon:
    """The plate seen from above."""
    return shapely.box(*job.stock)


__all__ = ["Band", "bands", "floor_of", "grow", "inside_of", "stock_shape"]
