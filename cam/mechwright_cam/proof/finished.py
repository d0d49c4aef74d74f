"""The finished part as what hangs together: one body, or several if recesses of both sides part it.

The plan view of a plate turned over tells nothing of that: a recess from above and one from below, side by
side and both deeper than half of the plate, leave two bodies whose plan views touch.
"""

import shapely

from mechwright_cam.proof.bands import bands
from mechwright_cam.proof.plane import Shape, grow
from mechwright_cam.setup.job import LEVEL, Job

NECK = 0.1
"""What is thinner than this seen from above holds nothing together, mm: what a setup hands on is rounded by a
tenth of it."""
CHIP = 2.0
"""A loose piece narrower than this is a chip, mm: the cutter breaks it and throws it out."""

Layer = tuple[int, Shape]
"""Number of a layer from above, and the plan view of one of its pieces."""


def finished_bodies(job: Job) -> list[Shape]:
    """Plan views of the bodies that the finished part consists of: one, or the setups cut it apart.

    Chips are none. Of a plate that has not been turned over, or of a nest, they are the parts.
    """
    if job.frame is None:
        return list(shapely.get_parts(job.target))
    found: list[list[Layer]] = []
    gone = sorted(job.gone, key=lambda air: air.top)
    for number, band in enumerate(bands(job, tuple(air.top for air in gone))):
        stands = shapely.intersection(band.keep, job.frame.part)
        below = next((air.shape for air in gone if air.top >= band.top - LEVEL), None)  # it holds all others
        stands = stands if below is None else shapely.difference(stands, below)
        stands = grow(stands, -NECK / 2, NECK / 10)
        for piece in shapely.get_parts(stands):
            touches = [
                any(above == number - 1 and shapely.intersects(piece, shape) for above, shape in body)
                for body in found
            ]
            joined = [layer for body, one in zip(found, touches, strict=True) if one for layer in body]
            rest = [body for body, one in zip(found, touches, strict=True) if not one]
            found = [*rest, [(number, piece), *joined]]
    views = [grow(shapely.union_all([shape for _, shape in body]), NECK / 2, NECK / 10) for body in found]
    return [view for view in views if not grow(view, -CHIP / 2, NECK).is_empty]
