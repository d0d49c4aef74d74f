"""How near plates and spindles come to each other in plan over a turn.

Distances are taken at samples of the motion, from outlines without their openings; between two samples a
plate moves by no more than its step, so half a step is added to the clearance: what is called clear is clear
at every instant.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.motion import Poses
from mechwright.errors import GeometryError
from mechwright.geometry import Outline

if TYPE_CHECKING:
    from numpy.typing import NDArray

PLAN_CHORD = 0.05
"""Chord error, mm, of the outlines that are compared; it is added to the clearance."""

_SOME = 16
"""Every so many samples are asked first whether plates meet."""

_BEND = 1.1
"""A path between two samples is at most so much longer than its chord; an arc of 80 degrees still is."""


@dataclass(frozen=True)
class Plate:
    """A plate to be dealt to a layer: in a body of the motion and its coordinates, so many mm thick.

    ``layers`` are those that it may stand in; empty for any but 0, which is the ground plate's.
    """

    name: str
    body: str
    outline: Outline
    thickness: float
    layers: tuple[int, ...] = ()


@dataclass(frozen=True)
class Spindle:
    """A pin or shaft through plates.

    Parameters
    ----------
    body
        The body that it is fixed in.
    centre
        Its axis in the body's coordinates, x + i y, mm.
    radius
        The largest along its length, mm, heads left out.
    plates
        Names of the plates that it joins.
    head
        Radius, mm, of a head on top of the highest plate, or 0; no plate above may come close to it.
    """

    name: str
    body: str
    centre: complex
    radius: float
    plates: tuple[str, ...]
    head: float = 0.0


class Closeness:
    """Distances of plates and spindles over a turn; each plate is flattened once."""

    def __init__(
        self,
        plates: Sequence[Plate],
        spindles: Sequence[Spindle],
        poses: Mapping[str, Poses],
        clearance: float,
    ) -> None:
        missing = ({plate.body for plate in plates} | {spindle.body for spindle in spindles}) - set(poses)
        if missing:
            raise GeometryError(f"the motion has no poses of {', '.join(sorted(missing))}")
        self.limit = clearance + 2 * PLAN_CHORD
        self.placed = {
            plate.name: _placed(plate.outline.outer.flatten(PLAN_CHORD), poses[plate.body])
            for plate in plates
        }
        self.poses = poses
        self.steps = {name: _step(points) for name, points in self.placed.items()}
        self.areas: dict[str, NDArray[np.object_]] = {}
        self.axes: dict[str, tuple[NDArray[np.object_], Array]] = {}
        self.room: dict[tuple[str, str], float] = {}

    def plates(self, one: Plate, two: Plate) -> bool:
        """Whether two plates come too close in plan."""
        import shapely

        if one.body == two.body:
            distance = shapely.distance(self._area(one.name)[:1], self._area(two.name)[:1])
            return bool(distance.min() < self.limit)
        moved = self.steps[one.name] + self.steps[two.name]
        # Whether they are so near is known long before the distance is; below it, not at it.
        near = np.nextafter(self.limit + moved / 2, 0.0)
        first, second = self._area(one.name), self._area(two.name)
        # What meets mostly does so for long: some samples tell it.
        return any(
            shapely.dwithin(first[some], second[some], near[some]).any()
            for some in (slice(None, None, _SOME), slice(None))
        )

    def spindle(self, spindle: Spindle, plate: Plate, radius: float) -> bool:
        """Whether a plate comes too close to a spindle of this radius."""
        import shapely

        if spindle.name not in self.axes:
            centre = np.array([[spindle.centre.real, spindle.centre.imag]])
            axis = _placed(centre, self.poses[spindle.body])
            self.axes[spindle.name] = shapely.points(axis[:, 0]), _step(axis)
        points, step = self.axes[spindle.name]
        if (spindle.name, plate.name) not in self.room:
            area = self._area(plate.name)
            if spindle.body == plate.body:
                least = float(shapely.distance(area[0], points[0]))
            else:
                least = _least(area, points, self.steps[plate.name] + step)
            self.room[spindle.name, plate.name] = least
        return self.room[spindle.name, plate.name] - radius < self.limit

    def swept(self, names: Sequence[str]) -> tuple[float, float, float, float]:
        """Bounds x0, y0, x1, y1, mm, of what these plates pass over; nothing outside comes too close."""
        found = []
        for name in names:
            room = self.limit + self.steps[name][:, None] / 2
            points = self.placed[name]
            found.append((points - room[..., None]).min(axis=(0, 1)))
            found.append((points + room[..., None]).max(axis=(0, 1)))
        (x0, y0), (x1, y1) = np.min(found, axis=0).tolist(), np.max(found, axis=0).tolist()
        return x0, y0, x1, y1

    def _area(self, name: str) -> "NDArray[np.object_]":
        import shapely

        if name not in self.areas:
            areas = shapely.polygons(self.placed[name])
            shapely.prepare(areas)
            self.areas[name] = areas
        return self.areas[name]


def _least(areas: "NDArray[np.object_]", points: "NDArray[np.object_]", moved: Array) -> float:
    """Least distance, mm, of areas and points (n,) over all samples, less half of what they have ``moved``.

    Between samples that are looked at, a distance falls by no more than what is moved, so few others are.
    """
    import shapely

    last = len(points) - 1
    some = np.unique([*range(0, last, _SOME), last])
    known = shapely.distance(areas[some], points[some])
    least = float((known - moved[some] / 2).min())
    way, every = np.cumsum(moved), np.arange(last + 1)
    after = np.searchsorted(some, every)
    before = np.maximum(after - 1, 0)
    bound = np.maximum(known[before] - (way - way[some[before]]), known[after] - (way[some[after]] - way))
    rest = np.flatnonzero(bound - moved / 2 < least)
    if rest.size:
        least = min(least, float((shapely.distance(areas[rest], points[rest]) - moved[rest] / 2).min()))
    return least


def _placed(points: Array, poses: Poses) -> Array:
    """Points (k, 2) of a body in every pose, (n, k, 2)."""
    turned = points @ poses.rotation[:, :2, :2].transpose(0, 2, 1)
    return np.asarray(turned + poses.position[:, None, :2], dtype=np.float64)


def _step(placed: Array) -> Array:
    """The farthest that any of the points (n, k, 2) moves to a neighbouring sample, (n,), mm."""
    if len(placed) < 2:
        return np.zeros(len(placed))
    moved = _BEND * np.hypot(*np.moveaxis(np.diff(placed, axis=0), 2, 0)).max(axis=1)
    step: Array = np.maximum(np.append(moved, 0.0), np.append(0.0, moved))
    return step
