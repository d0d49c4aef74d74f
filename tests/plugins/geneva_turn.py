"""A proof over a whole turn, on the finished outlines.

Rollers and slots, disc and arcs never overlap, and the wheel is locked while it rests.
Everything is seen from the wheel: the rollers' centres and the locking disc move past it. A point is in
material if it lies inside its polygon; how deep is its distance from the nearest edge.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from mechwright.arrays import Array
from mechwright.contracts.part import Part, Pocket
from mechwright.tolerances import TOLERANCES
from mechwright_geneva.kinematics.geometry import Points
from mechwright_geneva.kinematics.mechanism import Mechanism

POSITIONS = 721
"""Positions of the crank over a turn: every half degree."""

PLAY_PLACES = 24
"""Dwell positions at which the play of the locked wheel is measured."""

_BISECTIONS = 20
"""Halvings of a slot's angle: 1e-6 of it, far below the play of any clearance."""


@dataclass(frozen=True, slots=True)
class TurnProof:
    """What the proof found.

    Parameters
    ----------
    roller_depth
        Deepest stand of a roller in the wheel's material, mm; below 0 the least gap.
    roller_at
        Crank angle of it, rad.
    lock_depth
        Deepest stand of the locking disc in the wheel, mm; 0 if they never overlap.
    lock_at
        Crank angle of it, rad.
    dwell, play
        Crank angles after the stroke's end, and the angle by which the resting wheel can turn there until it
        touches the disc or a roller, the larger of both ways, (k,) rad each.
    allowance
        Depth that the fits of the outlines and their polygons can cause, mm.
    """

    roller_depth: float
    roller_at: float
    lock_depth: float
    lock_at: float
    dwell: Array
    play: Array
    allowance: float

    @property
    def clean(self) -> bool:
        """Whether nothing overlaps."""
        return self.roller_depth <= self.allowance and self.lock_depth <= self.allowance


class _Body:
    """A polygon that points are asked about."""

    def __init__(self, shape: shapely.Geometry) -> None:
        self.shape = shape
        shapely.prepare(shape)
        edges = []
        for ring in shapely.get_parts(shapely.boundary(shape)):
            corners = shapely.get_coordinates(ring)
            edges.append(shapely.linestrings(np.stack((corners[:-1], corners[1:]), axis=1)))
        self._edges = shapely.STRtree(np.concatenate(edges))
        self.corners: Points = shapely.get_coordinates(shape) @ np.array([1, 1j])

    def inside(self, z: Points) -> NDArray[np.bool_]:
        """Whether points lie inside."""
        found: NDArray[np.bool_] = shapely.contains_xy(self.shape, z.real, z.imag)
        return found

    def distance(self, z: Points) -> Array:
        """Distance of points from the boundary, mm."""
        _, distance = self._edges.query_nearest(
            shapely.points(z.real, z.imag), return_distance=True, all_matches=False
        )
        found: Array = np.asarray(distance, dtype=float)
        return found


def prove(m: Mechanism, parts: Sequence[Part]) -> TurnProof:
    """Run the parts of a mechanism through a whole turn."""
    by_name = {part.name: part for part in parts}
    material, outline = _Body(_slotted(by_name, m)), _Body(_polygon(by_name["wheel"]))
    disc = _Body(_polygon(by_name["locking-disc"]))
    crank = np.linspace(0, math.tau, POSITIONS)
    theta = _wheel_angle(m, crank)
    depth, at = -math.inf, 0.0
    arm = m.axes - m.crank * np.exp(1j * (m.crank_half - crank))
    for k in range(m.params.rollers):
        centre = (m.axes + (arm - m.axes) * np.exp(1j * k * m.pitch)) * np.exp(-1j * theta)
        gap = material.distance(centre)
        gap = np.where(material.inside(centre), -gap, gap)
        worst = int(np.argmin(gap))
        if m.roller - gap[worst] > depth:
            depth, at = m.roller - float(gap[worst]), float(crank[worst])
    lock, lock_at = _lock_depth(m, disc, outline, crank, theta)
    deviation = max(part.outline.deviation for part in parts if part.outline is not None)
    allowance = 2 * (deviation + TOLERANCES.flatten)
    return TurnProof(depth, at, lock, lock_at, *_play(m, disc, outline, material), allowance)


def _polygon(part: Part) -> shapely.Polygon:
    assert part.outline is not None
    return part.outline.polygon()


def _slotted(parts: dict[str, Part], m: Mechanism) -> shapely.Geometry:
    """The wheel's material at the height of the rollers."""
    wheel = parts["wheel"]
    shape: shapely.Geometry = _polygon(wheel)
    grooves = [
        shapely.Polygon(feature.boundary.flatten())
        for feature in wheel.features
        if isinstance(feature, Pocket)
    ]
    if grooves:
        shape = shapely.difference(shape, shapely.union_all(grooves))
    if "island" in parts:
        island = _polygon(parts["island"])
        turns = [2 * m.wheel_half * k for k in range(m.slots)]
        islands = [shapely.transform(island, lambda xy, t=t: _turned(xy, t)) for t in turns]
        shape = shapely.union_all([shape, *islands])
    return shape


def _turned(xy: Array, angle: float) -> Array:
    c, s = math.cos(angle), math.sin(angle)
    turned: Array = xy @ np.array([[c, s], [-s, c]])
    return turned


def _wheel_angle(m: Mechanism, crank: Array) -> Array:
    turn = np.floor(crank / m.pitch)
    u = np.clip((crank - turn * m.pitch) / (2 * m.crank_half), 0, 1)
    angle: Array = 2 * m.wheel_half * turn + m.stroke(u).theta
    return angle


def _lock_depth(m: Mechanism, disc: _Body, outline: _Body, crank: Array, theta: Array) -> tuple[float, float]:
    """Deepest overlap of disc and wheel, and the crank angle of it."""
    # Corners of the disc seen from the wheel, and of the wheel seen from the disc.
    line = math.pi + m.crank_half - crank
    worst, at = 0.0, 0.0
    seen = (disc.corners[None, :] * np.exp(1j * line)[:, None] + m.axes) * np.exp(-1j * theta)[:, None]
    back = (outline.corners[None, :] * np.exp(1j * theta)[:, None] - m.axes) * np.exp(-1j * line)[:, None]
    for points, body, reach in ((seen, outline, m.rim), (back, disc, m.lock)):
        row, column = np.nonzero(np.abs(points) < reach)
        near = points[row, column]
        within = body.inside(near)
        if within.any():
            depth = body.distance(near[within])
            deepest = int(np.argmax(depth))
            if depth[deepest] > worst:
                worst, at = float(depth[deepest]), float(crank[row[within][deepest]])
    return worst, at


def _play(m: Mechanism, disc: _Body, outline: _Body, material: _Body) -> tuple[Array, Array]:
    """How far the resting wheel turns either way, over the dwell."""
    rest = m.pitch - 2 * m.crank_half
    dwell = rest * (np.arange(PLAY_PLACES) + 0.5) / PLAY_PLACES
    near = outline.corners[np.abs(outline.corners - m.axes) < 2 * m.arc]
    rollers = m.crank * np.exp(1j * m.pitch * np.arange(m.params.rollers))
    play = np.zeros(PLAY_PLACES)
    for place, angle in enumerate(dwell.tolist()):
        line = np.exp(1j * (math.pi - m.crank_half - angle))
        for way in (1, -1):
            low, high = 0.0, math.pi / m.slots
            for _ in range(_BISECTIONS):
                middle = (low + high) / 2
                turn = np.exp(1j * way * middle)
                touches = (
                    disc.inside((near * turn - m.axes) / line).any()
                    or outline.inside((disc.corners * line + m.axes) / turn).any()
                    or _touches(material, (rollers * line + m.axes) / turn, m.roller)
                )
                low, high = (low, middle) if touches else (middle, high)
            play[place] = max(play[place], high)
    return dwell, play


def _touches(material: _Body, centres: Points, radius: float) -> bool:
    return bool(material.inside(centres).any() or (material.distance(centres) < radius).any())
