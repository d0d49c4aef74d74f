"""Recesses that are turned copies of each other: with the same around them one decision holds for all."""

import math
from collections.abc import Iterable

import numpy as np
import shapely

from mechwright.contracts.details import Detail
from mechwright.contracts.part import Feature, Pocket, Profile
from mechwright.geometry.prepared import prepared
from mechwright_cam.operations.congruent import Turn, corners_of, turn_between
from mechwright_cam.operations.recess import is_recess, plan_view
from mechwright_cam.setup.job import Job
from mechwright_cam.shop.tool import widest_mill
from mechwright_plane.offsets import ROUGH, areas, simplified

SAME = 3 * ROUGH
"""What stands around two copies is the same to this, mm, once it is thinned: it decides on cutters, and no
path follows it."""
ROUND = 64
"""Chords of a quarter of the circle within which is compared: up to 100 mm they are within SAME."""


class Twins:
    """The recesses of a job that have been asked about so far."""

    def __init__(self, job: Job) -> None:
        self.job = job
        self.far = widest_mill(job.tools)
        self._known: list[Pocket | Profile] = []
        self._around: dict[str, dict[tuple[float, ...], shapely.Geometry]] = {}

    def first(self, feature: Feature | Detail) -> Pocket | Profile | None:
        """The first one asked about that a recess is a copy of; None for that one, and if it is no recess."""
        if not is_recess(feature):
            return None
        for known in self._known:
            turn = turn_between(known, feature)
            if turn is not None and self._alike(known, feature, turn):
                return known
        self._known.append(feature)
        return None

    def _alike(self, one: Pocket | Profile, other: Pocket | Profile, turn: Turn) -> bool:
        first, second = self._surroundings(one), self._surroundings(other)
        return first.keys() == second.keys() and all(
            _same(turn.shape(first[key]), second[key]) for key in first
        )

    def _surroundings(self, feature: Pocket | Profile) -> dict[tuple[float, ...], shapely.Geometry]:
        """What is near a feature, by its heights: the part, the other features, and what holds it."""
        if feature.name not in self._around:
            job, corners = self.job, corners_of(feature)
            middle = corners.mean()
            reach = float(np.abs(corners - middle).max()) + self.far
            disc = shapely.Point(middle.real, middle.imag).buffer(reach, quad_segs=ROUND)
            shapes: dict[tuple[float, ...], list[shapely.Geometry]] = {(): [job.body]}
            for other in job.inner:
                if other is not feature:
                    shapes.setdefault((other.top, other.depth), []).append(plan_view(other))
            for tab in job.tabs:
                shapes.setdefault((tab.top,), []).append(tab.shape)
            if job.frame is not None:
                shapes[(math.inf,)] = [job.frame.holds]
            shapes[(-math.inf,)] = [shapely.box(*job.stock)]
            near = {key: _clipped(some, disc) for key, some in shapes.items()}
            self._around[feature.name] = {key: shape for key, shape in near.items() if not shape.is_empty}
        return self._around[feature.name]


def _clipped(shapes: Iterable[shapely.Geometry], disc: shapely.Polygon) -> shapely.Geometry:
    near = [shapely.intersection(shape, disc) for shape in shapes if shapely.intersects(shape, disc)]
    return simplified(areas(shapely.union_all(near)), ROUGH)


def _same(one: shapely.Geometry, other: shapely.Geometry) -> bool:
    """Whether the corners of each of two shapes lie on the edge of the other."""
    pairs = ((one, other), (other, one))
    return len(shapely.get_parts(one)) == len(shapely.get_parts(other)) and all(
        shapely.dwithin(prepared(shapely.boundary(a)), shapely.points(shapely.get_coordinates(b)), SAME).all()
        for a, b in pairs
    )
