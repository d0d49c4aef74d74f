"""What the chosen cutters leave of the parts."""

import shapely

from mechwright_cam.plane.offsets import polygons
from mechwright_cam.planning.assign import Assignments
from mechwright_cam.setup.job import Job


def cut_outlines(job: Job, assignments: Assignments | None = None) -> tuple[shapely.Polygon, ...]:
    """The target as the chosen cutters leave it: corners that none of them reaches stay filled.

    There is one for the part, or one for each part of a nest, work coordinates. Each wall is judged with the
    cutter that finishes it, as its task says.
    """
    tasks = (assignments or Assignments()).of(job).every()
    edges = [(task, task.operation.edge(task, job)) for task in tasks]
    walls = [edge for task, edge in edges if task.is_outside and edge is not None]
    holes = [edge for task, edge in edges if not task.is_outside and edge is not None]
    opened, cut = shapely.union_all(holes), []
    for plate in polygons(job.target):
        own = [wall for wall in walls if shapely.intersects(wall, plate)]
        outside = own[0] if own else shapely.Polygon(plate.exterior)
        left = polygons(outside.difference(opened) if holes else outside)
        cut.append(max(left, key=lambda part: float(part.area)))
    return tuple(cut)
