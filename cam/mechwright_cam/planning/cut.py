"""What the chosen cutters leave of the parts."""

import shapely

from mechwright.contracts.part import Bore
from mechwright_cam.plane.offsets import grow, polygons
from mechwright_cam.plane.reach import PRECISION, closing
from mechwright_cam.setup.job import Job


def cut_outlines(job: Job) -> tuple[shapely.Polygon, ...]:
    """The target as the chosen cutters leave it: corners that none of them reaches stay filled.

    There is one for the part, or one for each part of a nest, work coordinates. Each wall is judged with the
    cutter that finishes it, the one :func:`plan` takes.
    """
    from mechwright_cam.operations.centre_lines import grooves
    from mechwright_cam.operations.recess import plan_view
    from mechwright_cam.planning.zones import inner_zones, outer_zones
    from mechwright_cam.setup.depths import through

    plates = polygons(job.target)
    walls = [closing(zone.wall, job.reach(zone.finisher)) for zone in outer_zones(job) if not zone.at_tabs]
    holes = [
        shapely.Point(bore.centre).buffer(bore.diameter / 2, quad_segs=256)
        for bore in job.features
        if isinstance(bore, Bore) and bore.top + bore.depth >= job.thickness
    ]
    in_one = grooves(job)
    holes += [plan_view(f) for f in job.features if f.name in in_one and through(job, f.top + f.depth)]
    for zone in inner_zones(job, skip=in_one):
        if zone.bottom == job.floor:
            radius = job.reach(zone.finisher)
            holes.append(grow(grow(zone.clear, -radius, PRECISION), radius, PRECISION))
    opened = shapely.union_all(holes)
    cut = []
    for plate in plates:
        own = [wall for wall in walls if shapely.intersects(wall, plate)]
        outside = own[0] if own else shapely.Polygon(plate.exterior)
        left = polygons(outside.difference(opened) if holes else outside)
        cut.append(max(left, key=lambda part: float(part.area)))
    return tuple(cut)
