"""Whether the driver has room in a ring."""

import math

import numpy as np

from mechwright.contracts.design_rule import DesignRule
from mechwright.mechanics.gearing.zone import Envelope, turned
from mechwright_noncircular_gears.table import GearTable

_TURNED = 180
"""Positions of a turn of the ring in which the driver is looked at."""

_CORNERS = 8
"""Of the points of its pitch curve, every so many is looked at: one a degree."""

CROSSING = 0.1
"""Modules by which pitch curves may stand in each other: teeth that cross so deep collide whatever their
phase, and chords between corners of the curves are off by less."""


def _beyond(m: GearTable) -> tuple[float, float]:
    """How far, mm, the driver's pitch curve leaves the ring's, and the driver's angle there, rad."""
    pair = m.pair
    arc = pair.driver.perimeter * pair.turns(m.given.teeth) * np.arange(_TURNED) / _TURNED
    theta1, theta2 = pair.angles(arc)
    ring = Envelope.of(m.pitch_points[1], pair.driven, 0.0)
    own = turned(m.pitch_points[0][::_CORNERS], theta1[:, None]) - np.array([pair.axis, 0.0])
    height = ring.height(turned(own, -theta2[:, None])).max(axis=1)
    worst = int(height.argmax())
    return float(height[worst]), float(theta1[worst] % math.tau)


ROOM = DesignRule[GearTable](
    "gear.ring-room",
    "law",
    lambda f: (
        f"gear 1 has no room in the ring: at {math.degrees(_beyond(f.m)[1]):.1f} degrees its pitch "
        f"curve stands {f.value:.3f} mm outside of the ring's, away from where they touch"
    ),
    value=lambda m: _beyond(m)[0],
    limit=lambda m: CROSSING * m.rack.module,
    unit="mm",
    remedy="let the ratio change less, or make mate_lobes larger",
    must_be="at most",
    when=lambda m: m.given.internal,
)
