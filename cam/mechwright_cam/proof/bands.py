"""Heights between which the finished part has one cross-section."""

from dataclasses import dataclass
from itertools import pairwise
from typing import TypeVar

import shapely

from mechwright.arrays import Array
from mechwright.contracts.part import Feature, Pocket, Profile
from mechwright.geometry.prepared import prepared
from mechwright.tolerances import TOLERANCES
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.plane import Shape, grow
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.turned import Frame
from mechwright_cam.setup.views import SKIN, inside_of
from mechwright_cam.shop.tool import MILLS
from mechwright_plane.offsets import filled

LONGEST_RUN_OUT = 3.0
"""The edge of a cutter runs out by so many diameters at most: by its own and, with cutter compensation, by a
lead that is as long again with the largest D."""

SPARE = 3.0
"""And by so much more, mm: wear, the allowance, and what leads and groove ends go on for."""

Length = TypeVar("Length", float, Array)


def run_out(diameter: Length) -> Length:
    """How far beyond a rim the edge of a cutter may go that runs out there, mm."""
    return LONGEST_RUN_OUT * diameter + SPARE


@dataclass(frozen=True)
class Band:
    """A layer of the part."""

    top: float
    bottom: float
    """Both z in work coordinates, mm."""
    keep: Shape
    """The finished part's cross-section, tabs not counted."""
    section: int = 0
    """Number of the cross-section: bands of one number have the same."""


def floor_of(feature: Feature, job: Job) -> Shape:
    """The part of :func:`inside_of` that lies on the plate: a recess may be drawn beyond its edge."""
    view = inside_of(feature)
    if isinstance(feature, Pocket):
        view = shapely.intersection(view, filled(job.body))
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
    known: dict[tuple[Feature, ...], tuple[Shape, int]] = {}
    for top, bottom in pairwise(ordered):
        if top - bottom < NEAR:
            continue
        depth = -(top + bottom) / 2
        here = tuple(feature for feature in partial if feature.top < depth < feature.top + feature.depth)
        if here not in known:
            known[here] = _section(job, here), len(known)
        layers.append(Band(top, bottom, *known[here]))
    return layers


def _section(job: Job, features: tuple[Feature, ...]) -> Shape:
    keep = job.target
    for feature in features:
        shape = inside_of(feature)
        if isinstance(feature, Profile) and feature.side == "outside":
            keep = shapely.intersection(keep, shape)
        else:
            keep = shapely.difference(keep, shape)
    if job.frame is not None and features:
        keep = shapely.difference(keep, _run_outs(job, job.frame, features))
        keep = shapely.union(keep, job.frame.holds)
    return keep


def _run_outs(job: Job, frame: Frame, features: tuple[Feature, ...]) -> Shape:
    """What of the frame may go besides: beyond the rim of the part, near the recesses that are open there."""
    widest = max((tool.diameter for tool in job.tools if tool.kind in MILLS), default=0.0)
    within = prepared(grow(frame.body, -SKIN))
    drawn = [shape for shape in map(inside_of, features) if not shapely.contains_properly(within, shape)]
    floors = shapely.intersection(shapely.union_all(drawn), frame.body)
    return shapely.difference(grow(floors, run_out(widest)), frame.body)


def wall_region(job: Job) -> Shape | None:
    """Where walls have to be cut, if that is not everywhere: on what is drawn in a part in its frame.

    It ends just before the rim: what stands in the frame beyond may end there, as the foot of a wall does.
    """
    if job.frame is None:
        return None
    limit, drawn = TOLERANCES.leftover, shapely.union_all(list(map(inside_of, job.features)))
    return shapely.intersection(grow(drawn, limit), grow(job.frame.body, -limit))


def stock_shape(job: Job) -> shapely.Polygon:
    """The plate seen from above."""
    return shapely.box(*job.stock)
