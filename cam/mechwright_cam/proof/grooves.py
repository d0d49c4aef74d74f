"""Grooves that are just as wide as the cutter that makes them, in one, along their centre line."""

from collections.abc import Sequence
from itertools import chain

import shapely

from mechwright.cutter import cutter
from mechwright.part import OpenProfile
from mechwright.tolerances import TOLERANCES
from mechwright.tooling import Tool
from mechwright_cam.job import Job
from mechwright_cam.proof.bands import Band, floor_of
from mechwright_cam.proof.paths import NEAR
from mechwright_cam.proof.plane import ROUND, Shape, grow

ENTERED = 2 * (TOLERANCES.flatten + ROUND)
"""A groove so much wider than a cutter on either side lets it in, mm: what chords of walls and of closings
may be off."""


def entered(keep: Shape, reach: float, play: float, job: Job, band: Band) -> Shape:
    """What stays in a band, with the grooves wider that are made for a cutter that reaches so far, mm.

    A cutter with the play of others would find no way into a groove of its own width. The stock on the
    groove's walls is measured from walls that lie as much further out, and all the more is asked of it.
    """
    for feature in _grooves(job, band):
        lack = reach - feature.width / 2
        if -ENTERED < lack <= play + NEAR:
            keep = shapely.difference(keep, grow(floor_of(feature, job), lack + ENTERED))
    return keep


def along(rest: Shape, play: float, job: Job, band: Band, mills: Sequence[Tool], level: float) -> Shape:
    """What stays at a height z, mm, with what a round cutter leaves that runs along the middle of a groove.

    At a mouth it could turn a little aside. Where a cutter with a sharper nose gets in, it does not count.
    """
    for feature in _grooves(job, band):
        floor, half = -(feature.top + feature.depth), feature.width / 2
        wide = [(float(cutter(tool).radius_at(feature.depth)), tool) for tool in mills]
        fits = [tool for radius, tool in wide if abs(radius - half) <= play + ENTERED]
        best = min(fits, key=lambda tool: tool.nose, default=None)
        if best is None or any(tool.nose < best.nose and radius < half for radius, tool in wide):
            continue
        line = list(chain.from_iterable(piece.flatten(TOLERANCES.flatten).tolist() for piece in feature.path))
        cut = grow(shapely.LineString(line), float(cutter(best).radius_at(level - floor)) + play)
        rest = shapely.union(rest, shapely.difference(floor_of(feature, job), cut))
    return rest


def _grooves(job: Job, band: Band) -> list[OpenProfile]:
    """The grooves that a band crosses."""
    depth = -(band.top + band.bottom) / 2
    return [
        feature
        for feature in job.features
        if isinstance(feature, OpenProfile)
        and feature.side == "on"
        and feature.top < depth < feature.top + feature.depth
    ]
