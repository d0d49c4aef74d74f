"""The clamp of a train whose phase is set by friction: sizes, screws, torque, and where its scale stands.

A flange between gears 3 and 4 and a ring on gear 4 hold gear 4 between them. Screws go through ring, register
and flange into threads of gear 3; gear 4 turns on the register, which is a little lower than the gear is
thick. Its scale, on top, turns under a mark of the ring, which is fixed to gear 3.
"""

import math
from dataclasses import dataclass

from mechwright import kept
from mechwright_elliptic_gears.kinematics import phase_offset
from mechwright_elliptic_gears.params import EllipticGearParams
from mechwright_elliptic_gears.screws import SCREWS

YIELD = 640.0
"""MPa, of screws of class 8.8 (ISO 898-1)."""

TIGHTENED = 0.7
"""Share of the yield that a screw is tightened to."""

FRICTION = 0.12
"""Of clean, dry metal, the low end; one face counts, as the ring may give by the play of its screws."""

UNDER_HEAD = {"aluminium": 200.0, "brass": 250.0, "steel": 355.0, "pom": 40.0}
"""MPa that the ring bears under the heads; screws are tightened no farther."""

MARK = math.pi / 2
"""Direction of the ring's mark from the far vertex of gear 3, rad. The scale of phases up to half a turn then
lies in the far half of gear 4."""

WALL = 0.5
"""Least wall, in diameters of a screw's hole."""

HEAD_GAP = 0.5
"""Between heads, between them and the coupler, and between marks and edges, mm."""

FACE = 4.0
"""Width of the friction face, mm."""

LETTER = 2.5
"""Height of the scale's numbers, mm."""

SETTING = 0.1
"""Mm at the scale by which a person sets a mark wrong."""

REGISTER_LOW = 0.1
"""By how much the register is lower than gear 4 is thick, mm."""


@dataclass(frozen=True)
class Clamp:
    """Sizes, mm.

    Parameters
    ----------
    screw, screws
        Thread, and how many.
    circle
        Radius on which the screws stand.
    register
        Radius of gear 4's bore.
    outside
        Radius of ring and flange.
    ring
        Height of the ring.
    """

    screw: float
    screws: int
    circle: float
    register: float
    outside: float
    ring: float

    @property
    def pitch(self) -> float:
        """Of the thread."""
        return SCREWS[self.screw][0]

    @property
    def head(self) -> tuple[float, float]:
        """Diameter and height."""
        return SCREWS[self.screw][1:3]

    @property
    def hole(self) -> float:
        """Diameter of the clearance holes."""
        return SCREWS[self.screw][3]

    @property
    def crown(self) -> float:
        """From gear 4 to the coupler: ring, heads, and a gap."""
        return self.ring + self.head[1] + HEAD_GAP

    @property
    def scale(self) -> float:
        """Radius at which the marks of the scale begin."""
        return self.outside + HEAD_GAP

    @property
    def directions(self) -> list[float]:
        """Of the screws on gear 3, rad; none stands under the mark."""
        return [MARK + (i + 0.5) * math.tau / self.screws for i in range(self.screws)]

    def preload(self, material: str) -> float:
        """Force of a screw, N: what it bears, or the ring under its head."""
        stress_area = math.pi / 4 * (self.screw - 0.9382 * self.pitch) ** 2
        seat = math.pi / 4 * (self.head[0] ** 2 - self.hole**2)
        return min(TIGHTENED * YIELD * stress_area, UNDER_HEAD[material] * seat)

    def torque(self, material: str) -> float:
        """What the clamp holds by friction, N m: n F μ 2/3 (ro³ - ri³)/(ro² - ri²)."""
        ro, ri = self.outside, self.register
        mean = 2 / 3 * (ro**3 - ri**3) / (ro**2 - ri**2)
        return self.screws * self.preload(material) * FRICTION * mean / 1000


@kept
def clamp_of(params: EllipticGearParams) -> Clamp:
    """As small as screws of that size allow; left out, four that are a third of the bore."""
    screw = params.clamp_screw or max((size for size in SCREWS if 3 * size <= params.bore), default=2.0)
    screws = params.clamp_screws or 4
    head, hole = SCREWS[screw][1], SCREWS[screw][3]
    beside = (head + HEAD_GAP) / (2 * math.sin(math.pi / screws))
    circle = _up(max(params.bore / 2 + (WALL + 0.5) * hole, beside))
    register = _up(circle + (WALL + 0.5) * hole)
    outside = max(register + FACE, _up(circle + head / 2))
    return Clamp(screw, screws, circle, register, outside, max(3.0, screw))


def _up(radius: float) -> float:
    """To the next half millimetre."""
    return math.ceil(2 * radius - 1e-9) / 2


def mark_of(phase: float, eccentricity: float) -> float:
    """Direction of a phase's mark, degrees to rad, from the far vertex of gear 4."""
    return MARK - phase_offset(math.radians(phase), eccentricity)
