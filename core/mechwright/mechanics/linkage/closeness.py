"""How near plates and spindles come to each other in plan over a turn.

Distances are taken at samples of the motion, from outlines without their openings; between two samples a
plate moves by no more than its step, so half a step is added to the clearance: what is called clear is clear
at every instant.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.motion import Poses
from mechwright.errors import GeometryError
from mechwright.geometry import Loop, Outline
from mechwright.tolerances import TOLERANCES

if TYPE_CHECKING:
    import shapely
    from numpy.typing import NDArray

PLAN_CHORD = 0.05
"""Chord error, mm, of the outlines that are compared; it is added to the clearance."""

_SOME = 16
"""Every so many samples are asked first whether plates meet."""

_KEPT = 64
"""Plates whose corners are kept: designs that are tried one after the other share most."""

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


@lru_cache(_KEPT)
def _in_plan(loop: Loop) -> Array:
    """A loop as it is compared, (k, 2), mm; read-only."""
    points = loop.flatten(PLAN_CHORD)
    points.flags.writeable = False
    return points


@dataclass
class _Course:
    """Where a plate is over a turn; each is worked out when it is first asked for."""

    plate: Plate
    poses: Poses

    @cached_property
    def points(self) -> Array:
        """Its flattened outline (k, 2) in its body, mm."""
        return _in_plan(self.plate.outline.outer)

    @cached_property
    def placed(self) -> Array:
        """The same in every pose, (n, k, 2)."""
        return _placed(self.points, self.poses)

    def placed_at(self, some: "NDArray[np.intp]") -> Array:
        """The same in some poses, (m, k, 2)."""
        return self.placed[some] if "placed" in self.__dict__ else _placed(self.points, self.poses, some)

    @cached_property
    def steps(self) -> Array:
        """The farthest that any of them moves to a neighbouring sample, (n,), mm."""
        return _step(self.placed)

    @cached_property
    def most_steps(self) -> Array:
        """No less than these, (n,), mm: the way of the circle's middle, and that of its edge about it."""
        if len(self.middle) < 2:
            return np.zeros(len(self.middle))
        along, turned = np.diff(self.middle, axis=0), np.diff(self.poses.rotation[:, :2, 0], axis=0)
        ways = np.hypot(*along.T) + self.size * np.hypot(*turned.T)
        return _to_both_sides(_BEND * ways)

    @cached_property
    def shape(self) -> "shapely.Polygon":
        """The outline in the body, prepared."""
        import shapely

        shape = shapely.Polygon(self.points)
        shapely.prepare(shape)
        return shape

    @cached_property
    def middle(self) -> Array:
        """Middle (n, 2) of a circle around it in every pose."""
        return _placed(self._centre[None], self.poses)[:, 0]

    @cached_property
    def size(self) -> float:
        """That circle's radius, mm."""
        return float(np.hypot(*(self.points - self._centre).T).max()) + TOLERANCES.closure

    @property
    def _centre(self) -> Array:
        return np.asarray((self.points.min(axis=0) + self.points.max(axis=0)) / 2)


class Closeness:
    """Distances of plates and spindles over a turn; each plate is flattened and placed once, or never."""

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
        self.poses = poses
        self.courses = {plate.name: _Course(plate, poses[plate.body]) for plate in plates}
        self.areas: dict[str, NDArray[np.object_]] = {}
        self.axes: dict[str, tuple[Array, Array]] = {}
        self.found: dict[tuple[str, str, float], bool] = {}

    def plates(self, one: Plate, two: Plate) -> bool:
        """Whether two plates come too close in plan."""
        asked = one.name, two.name, 0.0
        if asked not in self.found:
            self.found[asked] = self._meet(one, two)
        return self.found[asked]

    def spindle(self, spindle: Spindle, plate: Plate, radius: float) -> bool:
        """Whether a plate comes too close to a spindle of this radius."""
        asked = spindle.name, plate.name, radius
        if asked not in self.found:
            self.found[asked] = self._pass(spindle, plate, radius)
        return self.found[asked]

    def _meet(self, one: Plate, two: Plate) -> bool:
        import shapely

        if one.body == two.body:
            start = np.zeros(1, dtype=np.intp)
            distance = shapely.distance(self._area(one.name, start), self._area(two.name, start))
            return bool(distance.min() < self.limit)
        here, there = self.courses[one.name], self.courses[two.name]
        apart = np.hypot(*(here.middle - there.middle).T) - here.size - there.size
        if not (apart <= self.limit + (here.most_steps + there.most_steps) / 2).any():
            return False

        def meet(near: Array, some: "NDArray[np.intp]") -> bool:
            # Whether they are so near is known long before the distance is; below it, not at it.
            below = np.nextafter(near[some], 0.0)
            return bool(shapely.dwithin(self._area(one.name, some), self._area(two.name, some), below).any())

        # What meets mostly does so for long: some samples tell it, whatever the steps between them.
        at_least = np.full(len(apart), self.limit)
        if meet(at_least, np.flatnonzero(apart <= self.limit)[::_SOME]):
            return True
        near = self.limit + (here.steps + there.steps) / 2
        asked = np.flatnonzero(apart <= near)
        return meet(near, asked[::_SOME]) or meet(near, asked)

    def _pass(self, spindle: Spindle, plate: Plate, radius: float) -> bool:
        import shapely

        course, here = self.courses[plate.name], self.poses[plate.body]
        axis, step = self._axis(spindle)
        fixed = spindle.body == plate.body
        if fixed:
            axis = axis[:1]
        apart = np.hypot(*(axis - course.middle[: len(axis)]).T) - course.size
        least = self.limit + radius
        if not (apart <= least + (0.0 if fixed else (course.most_steps + step) / 2)).any():
            return False

        def passes(near: Array, some: "NDArray[np.intp]") -> bool:
            # Seen from the plate, which then is one shape.
            points = shapely.points(_seen(axis[some], here, some))
            return bool(shapely.dwithin(course.shape, points, np.nextafter(near[some], 0.0)).any())

        at_least = np.full(len(axis), least)
        if passes(at_least, np.flatnonzero(apart <= least)[::_SOME]):
            return True
        near = at_least if fixed else least + (course.steps + step) / 2
        asked = np.flatnonzero(apart <= near)
        return passes(near, asked[::_SOME]) or passes(near, asked)

    def _axis(self, spindle: Spindle) -> tuple[Array, Array]:
        """Places (n, 2) of a spindle, and its steps (n,), mm."""
        if spindle.name not in self.axes:
            centre = np.array([[spindle.centre.real, spindle.centre.imag]])
            axis = _placed(centre, self.poses[spindle.body])
            self.axes[spindle.name] = axis[:, 0], _step(axis)
        return self.axes[spindle.name]

    def swept(self, names: Sequence[str]) -> tuple[float, float, float, float]:
        """Bounds x0, y0, x1, y1, mm, of what these plates pass over; nothing outside comes too close."""
        found = []
        for name in names:
            room = self.limit + self.courses[name].steps[:, None] / 2
            points = self.courses[name].placed
            found.append((points - room[..., None]).min(axis=(0, 1)))
            found.append((points + room[..., None]).max(axis=(0, 1)))
        (x0, y0), (x1, y1) = np.min(found, axis=0).tolist(), np.max(found, axis=0).tolist()
        return x0, y0, x1, y1

    def _area(self, name: str, samples: "NDArray[np.intp]") -> "NDArray[np.object_]":
        """A plate at these samples; each is made when it is first asked for."""
        import shapely

        course = self.courses[name]
        areas = self.areas.setdefault(name, np.full(len(course.middle), None, dtype=np.object_))
        missing = samples[~shapely.is_geometry(areas[samples])]
        areas[missing] = shapely.polygons(course.placed_at(missing))
        shapely.prepare(areas[missing])
        return areas[samples]


def _placed(points: Array, poses: Poses, some: "NDArray[np.intp] | slice" = slice(None)) -> Array:
    """Points (k, 2) of a body in every pose, or in some, (n, k, 2)."""
    turned = points @ poses.rotation[some, :2, :2].transpose(0, 2, 1)
    return np.asarray(turned + poses.position[some, None, :2], dtype=np.float64)


def _seen(points: Array, poses: Poses, some: "NDArray[np.intp]") -> Array:
    """A point at each of some poses, (m, 2), in the coordinates of the body, (m, 2)."""
    turned = np.einsum("nba,nb->na", poses.rotation[some, :2, :2], points - poses.position[some, :2])
    return np.asarray(turned, dtype=np.float64)


def _step(placed: Array) -> Array:
    """The farthest that any of the points (n, k, 2) moves to a neighbouring sample, (n,), mm."""
    if len(placed) < 2:
        return np.zeros(len(placed))
    ways = np.diff(placed, axis=0)
    return _to_both_sides(_BEND * np.sqrt(np.einsum("nki,nki->nk", ways, ways).max(axis=1)))


def _to_both_sides(moved: Array) -> Array:
    """The larger of the ways (n - 1,) before and after each of n samples."""
    step: Array = np.maximum(np.append(moved, 0.0), np.append(0.0, moved))
    return step
