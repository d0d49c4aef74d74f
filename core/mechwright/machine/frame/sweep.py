"""The space that a mechanism takes over its motion: a region of the plane for each range of heights.

Bodies are taken by their convex hulls, so the region is never too small. One that turns fully about its
origin takes a disc, and one that stands still is looked at once; others are looked at so often that the chord
between two looks is far below any clearance.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
import shapely

from mechwright.arrays import Array
from mechwright.contracts.motion import Motion, Poses
from mechwright.contracts.part import Instance, Part
from mechwright.contracts.shape import Prism, Revolve, Shape
from mechwright.errors import DesignError

LOOKS = 121
"""Samples of the motion: every 3 degrees of a turn, whose chords are 0.03 % of the radius off."""

_STILL = 1e-9
"""A body whose origin moves less than this, mm, and whose axis stays upright, turns about it."""

_NEARLY = 20.0
"""What may lack of a turn, degrees, to count as full."""

_STEP = math.tau / (LOOKS - 1)
"""Between two looks at a body that rocks about its origin, rad."""

_BACK = 1e-6
"""By how much a body that rocks may miss where it began, rad."""

_KEPT = 256
"""Bodies whose room is kept: most changes of a design leave the plan of most of them as it is."""

_ROUND = 32
"""Chords of a quarter circle."""


Layer = tuple[Array, float, float]
"""Points (n, 2) that span a slice of a part in plan, and its heights, mm."""


@dataclass(frozen=True)
class Swept:
    """What one part of one body takes: between two heights, mm, a region of the plane."""

    body: str
    part: str
    low: float
    high: float
    region: shapely.Geometry


@dataclass(frozen=True)
class Space:
    """All that a mechanism takes."""

    pieces: tuple[Swept, ...]

    @property
    def low(self) -> float:
        """Lowest height, mm."""
        return min(piece.low for piece in self.pieces)

    @property
    def high(self) -> float:
        """Greatest height, mm."""
        return max(piece.high for piece in self.pieces)

    @cached_property
    def region(self) -> shapely.Geometry:
        """At any height."""
        return shapely.union_all([piece.region for piece in self.pieces])

    def between(self, low: float, high: float, *, without: str = "") -> Iterator[Swept]:
        """What stands at heights between two, but not of one body."""
        for piece in self.pieces:
            if piece.body != without and piece.low < high and piece.high > low:
                yield piece


def space_of(parts: Sequence[Part], motion: Motion) -> Space:
    """The space of all instances; raises DesignError for a part whose form nobody can say without a solid."""
    return Space(
        tuple(
            _swept(part, layer, instance, motion.poses[instance.body])
            for part in parts
            for layer in layers_of(part)
            for instance in part.instances
        )
    )


def _swept(part: Part, layer: Layer, instance: Instance, poses: Poses) -> Swept:
    points, low, high = layer
    corners = shapely.get_coordinates(shapely.convex_hull(shapely.multipoints(points)))
    spread = np.ptp(poses.position, axis=0)
    tilt = np.abs(poses.rotation[:, 2, 2] - 1).max()
    if tilt > _STILL:
        raise DesignError(
            f"body {instance.body!r} of part {part.name} tilts: a frame of plates is for mechanisms that "
            "move in one plane"
        )
    z = float(poses.position[0, 2]) + instance.z
    region = _turned(corners, poses) if float(spread.max()) < _STILL else _at_all(corners, poses)
    return Swept(instance.body, part.name, z + low, z + high, region)


def _turned(corners: Array, poses: Poses) -> shapely.Geometry:
    """What a body takes whose origin stays: a disc, or the body at even steps between its two extremes."""
    x, y, _ = poses.position[0]
    angles = np.unwrap(np.arctan2(poses.rotation[:, 1, 0], poses.rotation[:, 0, 0]))
    if _turns(angles):
        return shapely.Point(x, y).buffer(float(np.hypot(*corners.T).max()), quad_segs=_ROUND)
    steps = math.ceil(float(np.ptp(angles)) / _STEP - _BACK)
    return _at_all(corners, Poses.planar(x, y, np.linspace(angles.min(), angles.max(), steps + 1)))


def _at_all(corners: Array, poses: Poses) -> shapely.Geometry:
    """The body as it stands at each pose, together."""
    arrays = (np.asarray(one, dtype=float).tobytes() for one in (corners, poses.position, poses.rotation))
    return _together(*arrays)


@lru_cache(_KEPT)
def _together(corners: bytes, position: bytes, rotation: bytes) -> shapely.Geometry:
    """The same of the bytes of float arrays (k, 2), (n, 3) and (n, 3, 3)."""
    plan = np.frombuffer(corners).reshape(-1, 2)
    poses = Poses(np.frombuffer(position).reshape(-1, 3), np.frombuffer(rotation).reshape(-1, 3, 3))
    flat = np.column_stack((plan, np.zeros(len(plan))))
    return shapely.union_all(shapely.polygons(poses.transform(flat)[..., :2]))


def _turns(angles: Array) -> bool:
    """Whether an upright body turns on and on, or nearly as far, and does not just rock."""
    on = abs(angles[-1] - angles[0]) > _BACK
    return bool(on or np.ptp(angles) > math.tau - math.radians(_NEARLY))


def layers_of(part: Part) -> list[Layer]:
    """A part in slices of one plan, a turned one by its steps."""
    if part.outline is not None:
        return [(np.asarray(part.outline.outer.flatten()), 0.0, part.thickness)]
    if part.turned is not None:
        steps = zip(part.turned.starts, part.turned.steps, strict=True)
        return [
            (_ring((0.0, 0.0), max(step.foot, step.diameter) / 2), low, low + step.length)
            for low, step in steps
        ]
    # A part that is made as a shape, such as a key of a length that nobody sells, is built by its method.
    shape = part.build if part.bought is None else part.bought.shape
    if not isinstance(shape, Shape):
        raise DesignError(
            f"part {part.name} is a solid of its own: nothing says what it sweeps; leave frame out, or set "
            'frame = "none"'
        )
    return [_shape(shape)]


def _ring(centre: tuple[float, float], radius: float) -> Array:
    return np.asarray(shapely.get_coordinates(shapely.Point(*centre).buffer(radius, quad_segs=_ROUND)))


def _shape(shape: Shape) -> Layer:
    points: list[tuple[float, float]] = []
    heights: list[float] = []
    for piece in shape.pieces:
        match piece:
            case Prism():
                points += piece.corners
                heights += [piece.low, piece.high]
            case Revolve():
                ring = _ring(piece.axis, max(r for r, _ in piece.profile))
                points += [(float(a), float(b)) for a, b in ring]
                heights += [z for _, z in piece.profile]
    return np.array(points), min(heights), max(heights)
