"""Trochoidal slotting: a groove wider than the mill is opened in loops of bounded engagement.

Glossary
--------
loop
    An arc of the mill's centre from one wall of the groove to the other, bulging ahead, and the way back
    through what is cleared.
pitch
    How far one loop is ahead of the one before.
"""

import math
from dataclasses import replace

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.contracts.details import Detail
from mechwright.contracts.part import Feature, OpenProfile
from mechwright.geometry.segments import Arc, Point
from mechwright.tolerances import TOLERANCES
from mechwright_cam.operations.cavity import Cavity, Pass, write_cavities
from mechwright_cam.operations.choice import ROOMY
from mechwright_cam.operations.clear import Clear
from mechwright_cam.operations.clearing import COARSE_FROM
from mechwright_cam.operations.contract import Task
from mechwright_cam.operations.engagement import clear
from mechwright_cam.operations.layer import Layer
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import Tool
from mechwright_plane.offsets import grow
from mechwright_plane.path import Path, arc, rounded

SURE = 0.9
"""The pitch is planned for this share of the engagement asked for: loops are entered at a wall, where the
cusp between the loops before stands in the way as well."""


def pitch(radius: float, cutter: float, engagement: float) -> float:
    """The pitch, mm, at which loops of a ``radius`` engage a mill of radius ``cutter`` by an angle, rad.

    At its foremost the centre is radius + pitch from the middle of the loop before, which has cleared
    R = radius + cutter. The edge meets that circle at the angle a from straight ahead where, by the cosine
    rule, R² = (radius + pitch)² + cutter² + 2 (radius + pitch) cutter cos(a).

    >>> round(pitch(1.8, 3.0, math.pi / 3), 3)
    0.736
    """
    sine, cosine = math.sin(engagement), math.cos(engagement)
    return math.sqrt((radius + cutter) ** 2 - (cutter * sine) ** 2) - cutter * cosine - radius


class Trochoidal(Clear):
    """Opens grooves in loops, and finishes them as any recess."""

    name = "trochoidal"

    def claim(self, feature: Feature | Detail, job: Job) -> Task | None:
        """Grooves along a line with room for a mill to turn, that run out over no edge of the part."""
        if not isinstance(feature, OpenProfile) or feature.side != "on" or feature.floor_radius > 0:
            return None
        if not any(mill.diameter <= ROOMY * feature.width for mill in job.mills):
            return None
        task = super().claim(feature, job)
        return None if task is None or task.data.must is not None else task

    def open_up(
        self,
        layer: Layer,
        feature: Feature | Detail,
        *,
        floored: bool,  # noqa: ARG002 - flat or round, the mill leaves the floor to the passes that follow
    ) -> None:
        """A helix and a spiral at one end, then loop by loop to the other."""
        assert isinstance(feature, OpenProfile)  # noqa: S101 - nothing else is claimed
        settings, zone = layer.settings, layer.zone
        mill = next(mill for mill in zone.mills if mill.diameter <= ROOMY * feature.width)
        leave, limit = max(settings.stock_to_leave, COARSE_FROM), math.radians(settings.engagement)
        cavity = groove_cavity(feature, mill, leave, limit, climb=settings.climb)
        if cavity is None:
            return
        depth = min(settings.adaptive_depth * mill.diameter, mill.flute_length)
        bottom = zone.bottom_for(mill)
        layer.add(
            "loops",
            mill,
            lambda pen: write_cavities([cavity], pen, zone.top, bottom, depth, settings.climb),
            limit if settings.chip_thinning else math.pi / 2,
            layer.pass_depth(mill, depth),
        )
        layer.stock = replace(layer.stock.without(cavity.cleared), begun=True)


def groove_cavity(
    feature: OpenProfile, mill: Tool, leave: float, engagement: float, *, climb: bool
) -> Cavity | None:
    """All loops of a groove that leave so much on its walls, mm; None if the mill has no room to turn.

    The engagement, rad, is that of the mill's leading half.
    """
    loop = feature.width / 2 - mill.radius - leave
    line = _centre_line(feature)
    points = shapely.get_coordinates(line)
    start = shapely.Point(points[0])
    opened = clear(grow(start, feature.width / 2 - leave), mill, SURE * engagement, climb)
    if loop <= 0 or not opened:
        return None
    # On the outer side of a bend loops are further apart than on the middle.
    bends = [segment.radius for segment in feature.path if isinstance(segment, Arc)]
    outer = 1 + (loop + mill.radius) / min(bends) if bends else 1.0
    step = min(pitch(loop, mill.radius, SURE * engagement), 0.9 * loop) / outer
    count = math.ceil(line.length / step)
    at = np.linspace(0, line.length, count + 1)[1:]
    middles = shapely.get_coordinates(shapely.line_interpolate_point(line, at))
    before = shapely.get_coordinates(shapely.line_interpolate_point(line, np.maximum(at - step, 0)))
    heading = np.arctan2(*(middles - before).T[::-1])
    early = math.asin(
        min(step * outer / loop, 0.9)
    )  # loops begin and end beside the middle of the one before
    passes = [
        Pass(_bulge((float(x), float(y)), loop, float(ahead), early, climb=climb), linked=True)
        for (x, y), ahead in zip(middles.tolist(), heading.tolist(), strict=True)
    ]
    entry = opened[0]
    whole = replace(entry, passes=(*entry.passes, *passes))
    cleared = shapely.union(entry.cleared, whole.swept(mill.radius))
    return replace(whole, cleared=cleared)


def _centre_line(feature: OpenProfile) -> shapely.LineString:
    rows: list[Array] = [segment.flatten(TOLERANCES.flatten) for segment in feature.path]
    return shapely.LineString(np.concatenate([rows[0], *(row[1:] for row in rows[1:])]))


def _bulge(middle: Point, radius: float, ahead: float, early: float, *, climb: bool) -> Path:
    """The cutting part of a loop: an arc around its front; to climb, counter-clockwise."""
    side = 1 if climb else -1
    half = math.pi / 2 + early

    def place(turn: float) -> Point:
        angle = ahead + side * turn
        x, y = middle[0] + radius * math.cos(angle), middle[1] + radius * math.sin(angle)
        return rounded(x), rounded(y)

    begin, front, end = (place(turn) for turn in (-half, 0.0, half))
    return Path(begin, (arc(begin, front, middle, side), arc(front, end, middle, side)))
