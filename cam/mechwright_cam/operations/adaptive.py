"""Adaptive clearing: what bounded engagement can rough, deep and fast, before the contour passes."""

import math
from dataclasses import replace

import shapely

from mechwright.contracts.details import Detail
from mechwright.contracts.part import Feature
from mechwright_cam.operations.cavity import write_cavities
from mechwright_cam.operations.choice import entry_place
from mechwright_cam.operations.clear import Clear
from mechwright_cam.operations.clearing import COARSE_FROM
from mechwright_cam.operations.contract import Task
from mechwright_cam.operations.engagement import HELIX
from mechwright_cam.operations.layer import WORTH_A_TOOL, Layer
from mechwright_cam.operations.recess import is_recess
from mechwright_cam.operations.zone import CUSP, Zone
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.cutter import cutter
from mechwright_cam.shop.tool import Tool
from mechwright_plane.offsets import ROUGH, grow, polygons


class Adaptive(Clear):
    """Clears a recess with bounded engagement where the design asks for it, and the rest along its walls."""

    name = "adaptive"

    def claim(self, feature: Feature | Detail, job: Job) -> Task | None:
        """The recesses of a job with ``clearing = "adaptive"``."""
        return super().claim(feature, job) if job.settings.clearing == "adaptive" else None

    def open_up(self, layer: Layer, feature: Feature | Detail, *, floored: bool) -> None:
        """Clear what there is room for; if the zone is ``floored`` a pass over its floor comes afterwards."""
        assert is_recess(feature)  # noqa: S101 - nothing else is claimed
        zone, settings, steps = layer.zone, layer.settings, layer.steps
        mill = _clearing_mill(zone)
        allowance = zone.allowance_for(mill, max(settings.stock_to_leave, COARSE_FROM))
        area = shapely.difference(zone.clear, zone.rough_keep(allowance))
        limit = math.radians(settings.engagement)
        before = layer.stock.left
        wanted = [part for part in polygons(area) if shapely.intersects(part, before)]
        area = shapely.union_all(wanted)
        cavities = steps.copies.clear(feature, area, mill, limit, settings.climb)
        reached = shapely.union_all([cavity.cleared for cavity in cavities])
        after = layer.stock.without(reached)
        if before.area - after.left.area < WORTH_A_TOOL * before.area:
            return
        depth = min(settings.adaptive_depth * mill.diameter, mill.flute_length)
        layer.add(
            "clear",
            mill,
            lambda pen: write_cavities(cavities, pen, zone.top, zone.bottom_for(mill), depth, settings.climb),
            limit if settings.chip_thinning else math.pi / 2,
            layer.pass_depth(mill, depth),
        )
        if mill.nose > 0 and not zone.through:
            foot = float(cutter(mill).radius_at(CUSP))
            closely = grow(reached, foot - mill.radius, ROUGH)
            if not floored:
                closely = shapely.intersection(closely, shapely.union_all([c.swept(foot) for c in cavities]))
            ridges = shapely.union(after.ridges, shapely.difference(reached, closely))
            after = after.with_ridges(ridges, min(mill.nose, zone.height))
        layer.stock = replace(after, begun=True)


def _clearing_mill(zone: Zone) -> Tool:
    """The largest mill that has room to turn, else the one that finishes."""
    widest = max(entry_place(part)[1] for part in polygons(zone.clear))
    known = zone.finisher in zone.mills
    large = [mill for mill in zone.mills if mill.radius >= zone.finisher.radius or not known]
    fit = [mill for mill in large if HELIX * mill.diameter <= 2 * widest]
    return fit[0] if fit else zone.finisher
