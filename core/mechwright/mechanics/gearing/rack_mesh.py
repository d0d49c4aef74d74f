"""Proof that a pinion and its rack run together, from outlines alone, as that of two gears.

The pinion turns about the origin; the rack lies below it with its teeth up and slides along x. The pinion is
looked at as what is driven: its play is how far it may turn, with the rack in its place, until a flank meets.
The rack moves by the play times the pitch radius.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.gearing.contact import contact
from mechwright.mechanics.gearing.made import Contacts
from mechwright.mechanics.gearing.mesh import EDGES_PER_PITCH, Mesh, cut_edges, swing
from mechwright.mechanics.gearing.proof import MeshProof
from mechwright.mechanics.gearing.rack import SIDES
from mechwright.mechanics.gearing.round import Round
from mechwright.mechanics.gearing.zone import Envelope, Rim, turned

_REACH = 0.1
"""Pitches by which tips of the mate may stand above the tips of a body and are still looked at."""

_CHUNK = 32
"""Positions at a time."""


@dataclass(frozen=True)
class Straight(Envelope):
    """An envelope that is a line: all below a height, mm, in the body frame of a rack."""

    @classmethod
    def below(cls, height: float) -> "Straight":
        """At a height."""
        return cls(np.empty(0), np.array([height]), 1.0)

    def height(self, points: Array) -> Array:
        """Distance (...), mm, of points (..., 2) above it."""
        height: Array = points[..., 1] - self.radius[0]
        return height


@dataclass(frozen=True)
class RackRun:
    """How a rack goes past its pinion.

    Parameters
    ----------
    radius
        Of the pinion's pitch circle, mm.
    distance
        Of its axis from the origin of the rack's body frame, mm.
    angle
        Pressure angle, rad.
    pitch
        Of the teeth, mm.
    start
        Angle of the pinion, rad, with the rack in the middle of its travel.
    """

    radius: float
    distance: float
    angle: float
    pitch: float
    start: float

    @property
    def lever(self) -> float:
        """Of the lines of action about the pinion's axis, mm."""
        return self.radius * math.cos(self.angle)

    def turn(self, way: Array) -> Array:
        """Angles (n,), rad, of the pinion with the rack at places (n,), mm, from the middle of its travel."""
        turn: Array = self.start + way / self.radius
        return turn

    def mesh(self, rack: Array, pinion: Array, way: Array, allowance: float) -> Mesh:
        """Run outlines (n, 2) and (m, 2), mm, counter-clockwise, at places ``way`` (k,), mm."""
        one, two = (cut_edges(points, self.pitch / EDGES_PER_PITCH) for points in (rack, pinion))
        margin = _REACH * self.pitch
        rims = Rim.of(one), Rim.of(two)
        line = Straight.below(float(one[:, 1].max()) + margin)
        round_ = Envelope.of(two, Round(self.radius), margin)
        turn = self.turn(way)
        places = np.column_stack((way, np.full(way.size, -self.distance)))
        parts = []
        for first in range(0, way.size, _CHUNK):
            at = slice(first, first + _CHUNK)
            racks = rims[0].near(round_, -turn[at], turned(places[at], -turn[at]), placed=True)
            pinions = rims[1].near(line, turn[at], -places[at], placed=False)
            parts.append(contact(racks, pinions, turn[at].size, self.pitch, allowance))
        ahead, behind, depth, gap = (np.concatenate(column) for column in zip(*parts, strict=True))
        deep = [(way[k], turn[k]) for k in np.flatnonzero(depth > allowance)]
        overlap = max((self._overlap(rack, pinion, *one) for one in deep), default=0.0)
        return Mesh(way, (way / self.radius, turn), ahead, behind, depth, gap, overlap)

    def _overlap(self, rack: Array, pinion: Array, way: float, turn: float) -> float:
        """Common area, mm², at a place."""
        import shapely

        placed = shapely.Polygon(rack + np.array([way, -self.distance]))
        return float(shapely.intersection(placed, shapely.Polygon(turned(pinion, np.asarray(turn)))).area)

    def prove(self, rack: Array, pinion: Array, way: Array, backlash: float, allowance: float) -> MeshProof:
        """The mesh proof of both outlines; ``backlash`` is that of the design, mm."""
        result = self.mesh(rack, pinion, way, allowance)
        room = backlash / 2 * math.cos(self.angle) / self.lever
        both = result.ahead, result.behind
        return MeshProof(
            result,
            allowance,
            max(swing(play) for play in both) * self.lever,
            max(swing(play - room) for play in both),
        )

    def contacts(self, crossings: Array, way: Array, paths: tuple[float, float], backlash: float) -> Contacts:
        """Where exact flanks touch, from the rack to the pinion.

        Parameters
        ----------
        crossings
            Where flanks of the rack cross the pitch line (z, 2), mm along the rack: left and right of teeth.
        way
            Places (n,), mm, of the rack.
        paths
            From the pitch point to the tips of pinion and of rack along the line of action, mm.
        backlash
            Of the design, mm.
        """
        sin, cos = math.sin(self.angle), math.cos(self.angle)
        away = way[:, None, None] + crossings
        # Along the line of action, towards the pinion.
        along = away * SIDES * cos
        position, tooth, side = np.nonzero((along >= -paths[0]) & (along <= paths[1]))
        u, sign = away[position, tooth, side], SIDES[side]
        point = np.column_stack((u * cos * cos, sign * u * sin * cos - self.radius))
        normal = np.column_stack((sign * cos, np.full(u.size, sin)))
        room = backlash / 2 * cos
        turn = self.turn(way)
        places = np.column_stack((way, np.full(way.size, -self.distance)))
        return Contacts(
            way,
            position,
            point - places[position],
            turned(point + room * normal, -turn[position]),
            self.radius * cos * sign,
            normal,
            room,
        )
