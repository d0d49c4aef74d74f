"""Recesses that are just as wide as the cutter that makes them, in one, along their middle."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import shapely

from mechwright.contracts.part import OpenProfile, Pocket
from mechwright.tolerances import TOLERANCES
from mechwright_cam.proof.bands import Band, floor_of
from mechwright_cam.proof.plane import ROUND, Shape, grow
from mechwright_cam.setup.job import Job
from mechwright_cam.setup.views import inside_of
from mechwright_cam.shop.cutter import cutter, makes_floor
from mechwright_cam.shop.tool import Tool
from mechwright_plane.offsets import areas, polygons

ENTERED = 2 * (TOLERANCES.flatten + ROUND)
"""A groove so much wider than a cutter on either side lets it in, mm: what chords of walls and of closings
may be off."""

GROOVE = 2.5
"""The middle of a groove is at most twice the slack wide on either side; this many times, for rounding."""
CORNERS = 1.5
"""The corners of a square end are the half width times √2 off the end of the middle."""


@dataclass(frozen=True)
class Groove:
    """A recess, or a part of one, that a cutter just fills."""

    middle: Shape
    """Where the cutter's centre may be, and what was allowed for: a thin strip."""
    half: float
    """Half of its width, mm."""
    spare: float
    """Half of the width of ``middle``, mm."""


def entered(keep: Shape, reach: float, play: float, job: Job, band: Band) -> Shape:
    """What stays in a band, with the grooves wider that are made for a cutter that reaches so far, mm.

    A cutter with the play of others would find no way into a groove of its own width. The stock on the
    groove's walls is measured from walls that lie as much further out, and all the more is asked of it.
    """
    for feature in _recesses(job, band):
        for groove in _grooves(inside_of(feature), reach - play, play + ENTERED):
            more = reach - groove.half + ENTERED
            if more <= play + 2 * ENTERED:
                wider = grow(groove.middle, groove.half - groove.spare + more)
                clip = grow(floor_of(feature, job), more)
                keep = shapely.difference(keep, shapely.intersection(wider, clip))
    return keep


def along(rest: Shape, play: float, job: Job, band: Band, mills: Sequence[Tool], level: float) -> Shape:
    """What stays at a height z, mm, with what a round cutter leaves that runs along the middle of a groove.

    At a mouth it could turn a little aside, and a finer one could sharpen the corners. Neither counts.
    """
    for feature in _recesses(job, band):
        shape, tip = inside_of(feature), -(feature.top + feature.depth)
        for tool in _makers(feature, mills):
            radius = float(cutter(tool).radius_at(feature.depth))
            grooves = _grooves(shape, radius, play + ENTERED)
            at = float(cutter(tool).radius_at(level - tip))
            for groove in grooves:
                cut = grow(groove.middle, groove.half - groove.spare - radius + at + play)
                floor = shapely.intersection(
                    floor_of(feature, job), grow(groove.middle, CORNERS * groove.half)
                )
                floor = grow(floor, play + 2 * ENTERED)  # as far as :func:`entered`, or a crack stays
                rest = areas(shapely.union(rest, shapely.difference(floor, cut)))
            if grooves:
                break
    return rest


def _makers(feature: Pocket, mills: Sequence[Tool]) -> list[Tool]:
    """The mills that may make a groove in one: none if a narrower one could make it better."""
    if feature.floor_radius > 0:
        able = [tool for tool in mills if makes_floor(tool, feature.floor_radius)]
        return sorted(able, key=lambda tool: tool.radius)[:1]
    wide = [(float(cutter(tool).radius_at(feature.depth)), tool) for tool in mills]
    best = [
        tool
        for radius, tool in wide
        if not any(other.nose < tool.nose and narrow < radius for narrow, other in wide)
    ]
    return sorted(best, key=lambda tool: tool.nose)


def _recesses(job: Job, band: Band) -> list[Pocket]:
    """The recesses that a band crosses and that a mill of their width may make: grooves, or with a fillet."""
    depth = -(band.top + band.bottom) / 2
    return [
        feature
        for feature in job.features
        if isinstance(feature, Pocket)
        and feature.top < depth < feature.top + feature.depth
        and (feature.floor_radius > 0 or (isinstance(feature, OpenProfile) and feature.side == "on"))
    ]


@lru_cache(maxsize=256)
def _grooves(shape: Shape, radius: float, slack: float) -> tuple[Groove, ...]:
    """Where a shape is as wide as a cutter of this radius, or differs by less than ``slack`` mm each side."""
    found = []
    for middle in polygons(grow(shape, slack - radius)):
        if shapely.is_empty(grow(middle, -GROOVE * slack)):
            spare = middle.area / middle.length
            found.append(Groove(middle, radius - slack + spare, spare))
    return tuple(found)
