"""The clamp of a train whose phase is set by friction: sizes, screws, torque, and where its scale stands.

A flange between gears 3 and 4 and a ring on gear 4 hold gear 4 between them. Screws go through ring, register
and flange into threads of gear 3; gear 4 turns on the register, which is a little lower than the gear is
thick. Its scale, on top, turns under a mark of the ring, which is fixed to gear 3.
"""

import math
from dataclasses import dataclass

from mechwright import kept
from mechwright.contracts.fits import Fit, hole_fit, shaft_fit
from mechwright.mechanics.strength.allowed import allowed
from mechwright.mechanics.strength.bolts import (
    face_torque,
    head_pressure,
    preload,
    stress_area,
    tightening_torque,
)
from mechwright.standards.screws import ScrewSize, least_engaged, lengths, screw_size
from mechwright_elliptic_gears.kinematics.equations import phase_offset
from mechwright_elliptic_gears.parameters import EllipticGearParams, cap_screws

MARK = math.pi / 2
"""Direction of the ring's mark from the far vertex of gear 3, rad. The scale of phases up to half a turn then
lies in the far half of gear 4."""

WALL = 0.5
"""Least wall, in diameters of a screw's hole."""

HEAD_GAP = 0.5
"""Between heads, between them and the coupler, and between marks and edges, mm."""

FACE = 4.0
"""Width of the friction face, mm."""

LEAST_RING = 3.0
"""Height of a ring, mm, below which it bends between its screws."""

MILLED = 2.0
"""Depth, in diameters, to which thread mills reach; the screw ends a pitch before the thread does."""

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
    length
        Of the screws as they are sold; None if none goes through the clamp and finds enough thread.
    """

    screw: float
    screws: int
    circle: float
    register: float
    outside: float
    ring: float
    length: float | None = None

    @property
    def of(self) -> ScrewSize:
        """What belongs to the thread."""
        return screw_size(self.screw)

    @property
    def hole(self) -> float:
        """Diameter of the clearance holes."""
        return self.of.clearance()

    @property
    def crown(self) -> float:
        """From gear 4 to the coupler: ring, heads, and a gap."""
        return self.ring + self.of.head_height + HEAD_GAP

    @property
    def scale(self) -> float:
        """Radius at which the marks of the scale begin."""
        return self.outside + HEAD_GAP

    @property
    def directions(self) -> list[float]:
        """Of the screws on gear 3, rad; none stands under the mark."""
        return [MARK + (i + 0.5) * math.tau / self.screws for i in range(self.screws)]

    @property
    def seat(self) -> Fit:
        """Limits of gear 4's bore, which turns on the register while the clamp is open."""
        return hole_fit(2 * self.register, "H7")

    @property
    def spigot(self) -> Fit:
        """Limits of the register's outside."""
        return shaft_fit(2 * self.register, "g6")

    def preload(self, material: str) -> float:
        """Force of a screw, N: what it bears, or the ring under its head."""
        force = preload(stress_area(self.screw, self.of.pitch))
        return force * min(1.0, allowed(material).head / head_pressure(force, self.of.head, self.hole))

    def tightening(self, material: str) -> float:
        """Torque, N m, that gives a screw that force."""
        return tightening_torque(self.preload(material), self.screw, self.of.pitch, self.of.head, self.hole)

    def torque(self, material: str) -> float:
        """What the clamp holds by friction, N m.

        One face counts, as the ring may give by the play of its screws.
        """
        return face_torque(self.preload(material), self.screws, self.outside, self.register)


@kept
def clamp_of(params: EllipticGearParams) -> Clamp:
    """As small as screws of that size allow. Default: four that are a third of the bore."""
    sizes = cap_screws()
    screw = params.clamp_screw or max((size for size in sizes if 3 * size <= params.bore), default=sizes[0])
    screws, of = params.clamp_screws or 4, screw_size(screw)
    hole = of.clearance()
    beside = (of.head + HEAD_GAP) / (2 * math.sin(math.pi / screws))
    circle = _up(max(params.bore / 2 + (WALL + 0.5) * hole, beside))
    register = _up(circle + (WALL + 0.5) * hole)
    outside = max(register + FACE, _up(circle + of.head / 2))
    return Clamp(screw, screws, circle, register, outside, *ring_and_length(params, screw))


def ring_and_length(params: EllipticGearParams, screw: float) -> tuple[float, float | None]:
    """Height of the ring and length of the screws, mm, for a thread.

    The shortest screw that is sold and finds enough thread in gear 3. Where it would go deeper than a thread
    is milled, or come out below, the ring is made higher.
    """
    ring = max(LEAST_RING, screw)
    grip = ring + params.thickness + params.spacing
    bites = least_thread(params, screw)
    sold = [length for length in lengths(screw) if length >= grip + bites]
    if bites > params.thickness or not sold:
        return ring, None
    deepest = min(params.thickness, max(bites, MILLED * screw - screw_size(screw).pitch))
    return round(ring + max(0.0, sold[0] - grip - deepest), 6), float(sold[0])


def least_thread(params: EllipticGearParams, screw: float) -> float:
    """Length of thread, mm, that screws need in gear 3."""
    return least_engaged(params.material) * screw


def _up(radius: float) -> float:
    """To the next half millimetre."""
    return math.ceil(2 * radius - 1e-9) / 2


def mark_of(phase: float, eccentricity: float) -> float:
    """Direction of a phase's mark, degrees to rad, from the far vertex of gear 4."""
    return MARK - phase_offset(math.radians(phase), eccentricity)
