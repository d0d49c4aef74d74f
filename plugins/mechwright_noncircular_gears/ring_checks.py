"""Whether the driver has room in a ring, and what is wrong with a ring by itself: its rim, and its holes."""

import math
from collections.abc import Iterator

import numpy as np

from mechwright import Finding
from mechwright.contracts.finding import Severity
from mechwright.mechanics.gearing.checks import FULL_RIM, LEAST_RIM
from mechwright.mechanics.gearing.zone import Envelope, turned
from mechwright.tolerances import falls_short
from mechwright_noncircular_gears.gear import pair_of, pitch_points, rack_of, rim_of, teeth_of
from mechwright_noncircular_gears.params import NoncircularParams

_TURNED = 180
"""Positions of a turn of the ring in which the driver is looked at."""

_CORNERS = 8
"""Of the points of its pitch curve, every so many is looked at: one a degree."""

CROSSING = 0.1
"""Modules by which pitch curves may stand in each other: teeth that cross so deep collide whatever their
phase, and chords between corners of the curves are off by less."""


def room_findings(params: NoncircularParams) -> Iterator[Finding]:
    """An error where the driver's pitch curve leaves the ring's, away from where they touch."""
    if not params.internal:
        return
    beyond, angle = _beyond(params)
    most = CROSSING * rack_of(params).module
    if beyond <= most:
        return
    yield Finding.error(
        "gear.ring-room",
        "law",
        f"gear 1 has no room in the ring: at {math.degrees(angle):.1f} degrees its pitch curve stands "
        f"{beyond:.3f} mm outside of the ring's, away from where they touch",
        beyond,
        most,
        "mm",
        "let the ratio change less, or make mate_lobes larger",
    )


def _beyond(params: NoncircularParams) -> tuple[float, float]:
    """How far, mm, the driver's pitch curve leaves the ring's, and the driver's angle there, rad."""
    pair = pair_of(params)
    arc = pair.driver.perimeter * pair.turns(params.teeth) * np.arange(_TURNED) / _TURNED
    theta1, theta2 = pair.angles(arc)
    ring = Envelope.of(pitch_points(params)[1], pair.driven, 0.0)
    own = turned(pitch_points(params)[0][::_CORNERS], theta1[:, None]) - np.array([pair.axis, 0.0])
    height = ring.height(turned(own, -theta2[:, None])).max(axis=1)
    worst = int(height.argmax())
    return float(height[worst]), float(theta1[worst] % math.tau)


def rim_findings(params: NoncircularParams) -> Iterator[Finding]:
    """Whether enough stays around the teeth, beside the holes and between them."""
    if not params.internal:
        return
    rim, rack = rim_of(params), teeth_of(params)[1].rack
    full = FULL_RIM * (rack.addendum + rack.dedendum)
    least = LEAST_RIM * rack.module * (2 if rim.holes else 1)
    if falls_short(rim.wall, full):
        thin = falls_short(rim.wall, least)
        wanted = math.ceil(2 * (rim.root + rim.hole + max(full, least)))
        beside = f" beside its holes of {rim.hole:g} mm" if rim.holes else ""
        yield Finding(
            "ring.rim",
            Severity.ERROR if thin else Severity.WARNING,
            "ring_outside",
            f"{rim.wall:.2f} mm of the ring stay outside of its roots{beside}",
            rim.wall,
            least if thin else full,
            "mm",
            f"make ring_outside at least {wanted:g}" + (", or ring_hole smaller" if rim.holes else ""),
            proposed=({"parameters.ring_outside": wanted},),
        )
        if thin:
            return
    if falls_short(rim.bridge, rack.module):
        most = math.floor(math.pi / math.asin(min(1.0, (rim.hole + rack.module) / (2 * rim.circle))))
        yield Finding.error(
            "ring.holes",
            "ring_holes",
            f"{rim.bridge:.2f} mm stay between two of {rim.holes} holes",
            rim.bridge,
            rack.module,
            "mm",
            f"make ring_holes at most {most}",
            proposed=({"parameters.ring_holes": most},),
        )
