"""Where dowels join stacked plates: locking disc and crank, wheel and hub, islands and backing plate.

Every place is a point on a line of symmetry, as far from all walls as that line allows.
"""

import cmath
import math

import numpy as np

from mechwright import Array, Point
from mechwright_geneva.kinematics.mechanism import Mechanism

_PLACES = 400
"""Places tried along a line of symmetry: a quarter of a millimetre on a wheel of a hand's size."""

_WAY = 257
"""Points of the roller's way that the places are compared with."""


def driver_dowels(m: Mechanism) -> list[Point]:
    """Two places on the ring that disc and crank both cover, between the rollers; none without dowels."""
    if m.params.fixing == 0:
        return []
    radius, k = (m.driver_opening + m.driver_radius) / 2, m.params.rollers
    first = math.pi / 2 if k == 1 else math.pi / k
    second = first + (math.pi if k % 2 == 0 or k == 1 else math.tau / k)
    return [_polar(radius, first), _polar(radius, second)]


def hub_dowels(m: Mechanism) -> list[Point]:
    """Two places in the ring of the hub plate, under the webs between slots."""
    params = m.params
    if params.fixing == 0 or params.hub_diameter == 0:
        return []
    radius = (m.opening + params.hub_diameter / 2) / 2
    half = m.wheel_half if m.slots % 2 else 0.0
    # Across the keyway, so that they are as far from it as can be.
    return [_polar(radius, math.pi / 2 + half), _polar(radius, -math.pi / 2 + half)]


def web_place(m: Mechanism) -> tuple[Point, float]:
    """The place on +x, between two slots, with most room, and the radius of that room, mm."""
    x = np.linspace(0, m.axes - m.arc, _PLACES)
    room = np.minimum(_from_way(m, x, 0.0), np.minimum(m.axes - m.arc - x, x - m.opening))
    best = int(np.argmax(room))
    return (float(x[best]), 0.0), float(room[best])


def island_places(m: Mechanism, diameter: float) -> list[Point]:
    """Two places on the axis of island 0 for dowels of this diameter, as far apart as walls allow.

    Fewer than two if there is no room.
    """
    x = np.linspace(m.bottom + m.groove, m.rim, _PLACES)
    room = np.minimum(_from_way(m, x, -m.wheel_half), m.rim - x)
    able = x[room >= diameter / 2 + m.params.least_wall]
    if not able.size:
        return []
    ends = [float(able[0]), float(able[-1])]
    if ends[1] - ends[0] < diameter + m.params.least_wall:
        ends = ends[:1]
    return [_polar(radius, -m.wheel_half) for radius in ends]


def greatest_island_dowel(m: Mechanism) -> float:
    """The greatest dowel, in tenths of a millimetre, of which an island takes two; 0 if none."""
    for tenths in range(int(m.params.fixing * 10), 0, -1):
        if len(island_places(m, tenths / 10)) == 2:
            return tenths / 10
    return 0.0


def _from_way(m: Mechanism, distances: Array, angle: float) -> Array:
    """Distance (k,) of places on a ray from the walls of slot 0 and of its neighbours."""
    places = distances * cmath.exp(1j * angle)
    way = m.stroke(np.linspace(0, 1, _WAY)).track
    turn = cmath.exp(2j * m.wheel_half)
    ways = np.concatenate((way, way * turn, way / turn))
    least: Array = np.abs(places[:, None] - ways).min(axis=1) - m.groove
    return least


def _polar(radius: float, angle: float) -> Point:
    return radius * math.cos(angle), radius * math.sin(angle)
