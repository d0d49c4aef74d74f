"""What is wrong with a ring by itself: a rim that is too thin, holes that are too near to each other."""

import math
from collections.abc import Iterator

from mechwright import Finding
from mechwright.contracts.finding import Severity
from mechwright.mechanics.gearing.checks import FULL_RIM, LEAST_RIM
from mechwright.tolerances import falls_short
from mechwright_noncircular_gears.gear import rim_of, teeth_of
from mechwright_noncircular_gears.params import NoncircularParams


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
