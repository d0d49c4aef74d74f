"""The dividing circle of a train whose phase a pin sets: where gear 3 has its holes.

Only the angle φ between gears 3 and 4 changes with the phase angle γ, so gear 3 has one hole for each γ, φ(γ)
ahead of that of gear 4, tan(φ/2) = (1 + e)/(1 - e) tan(γ/2). Holes that stand too near to each other on one
circle go to a second one outside of it, on which gear 4 has a hole as well.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright.contracts.fits import Fit, hole_fit, shaft_fit
from mechwright.mechanics.gearing.checks import LEAST_RIM
from mechwright_elliptic_gears.kinematics.equations import phase_offset
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import rack_of, room

START = -math.pi / 2
"""Direction of gear 4's hole from its far vertex, rad: clear of its joint. The holes of phases up to half a
turn then lie in the far half of gear 3, where most room is."""

PITCH = 1.5
"""Least distance of two holes in their diameters: half a diameter of wall, the usual edge distance."""

RINGS = 2
"""Circles of holes at the most."""

NEAREST_STEP = 0.5
"""Step, degrees, in which a phase that works is sought: as fine as holes are worth telling apart."""


@dataclass(frozen=True)
class Hole:
    """A hole of gear 3: its phase, degrees, its direction from the far vertex, rad, and its circle."""

    phase: float
    angle: float
    ring: int

    def centre(self, radius: float, step: float) -> complex:
        """Its middle x + i y, mm; ``radius`` is that of the inner circle, the next is ``step`` larger."""
        r = radius + step * self.ring
        return complex(r * math.cos(self.angle), r * math.sin(self.angle))


@dataclass(frozen=True)
class Dividing:
    """Holes of one diameter on one or two circles, mm.

    Parameters
    ----------
    diameter
        Basic size of pin and holes.
    radius
        Of the inner circle.
    holes
        In the order of their directions.
    crowded
        Two phases, degrees, whose holes find no place beside each other: the second has none.
    """

    diameter: float
    radius: float
    holes: tuple[Hole, ...]
    crowded: tuple[float, float] | None = None

    @property
    def rings(self) -> tuple[float, ...]:
        """Radii of the circles, mm."""
        used = max((hole.ring for hole in self.holes), default=0) + 1
        return tuple(self.radius + ring * PITCH * self.diameter for ring in range(used))

    def centre(self, hole: Hole) -> complex:
        """Middle of a hole in gear 3, mm."""
        return hole.centre(self.radius, PITCH * self.diameter)

    def hole_at(self, phase: float) -> Hole | None:
        """The hole of a phase angle, degrees; None if there is none."""
        return next((hole for hole in self.holes if (hole.phase - phase) % 360 == 0), None)

    def radius_at(self, phase: float) -> float:
        """Radius, mm, at which the pin stands; that of the inner circle where the phase has no hole."""
        hole = self.hole_at(phase)
        return self.rings[0 if hole is None else hole.ring]

    @property
    def hole_size(self) -> Fit:
        """Limits of the holes: H7."""
        return hole_fit(self.diameter, "H7")

    @property
    def pin_size(self) -> Fit:
        """Limits of the pin: g6, which goes in by hand."""
        return shaft_fit(self.diameter, "g6")


def direction(phase: float, eccentricity: float) -> float:
    """Direction, rad, of the hole of a phase angle, degrees, from gear 3's far vertex.

    >>> round(math.degrees(direction(90, 0.4) - START), 6)
    133.602819
    """
    return START + phase_offset(math.radians(phase % 360), eccentricity)


def placed(phases: tuple[float, ...], eccentricity: float, diameter: float, radius: float) -> Dividing:
    """Holes on the first circle that has room for each, in the order of the phases."""
    holes: list[Hole] = []
    crowded = None
    step = PITCH * diameter
    for phase in sorted(phases):
        angle = direction(phase, eccentricity)
        for ring in range(RINGS):
            hole = Hole(phase, angle, ring)
            at = hole.centre(radius, step)
            near = [one for one in holes if abs(one.centre(radius, step) - at) < step - 1e-9]
            if not near:
                holes.append(hole)
                break
        else:
            crowded = crowded or (near[0].phase, phase)
    return Dividing(diameter, radius, tuple(sorted(holes, key=lambda hole: hole.angle)), crowded)


def circle_for(params: EllipticGearParams, diameter: float, least: float) -> float:
    """Diameter, mm, of the inner circle: the least on which all holes have a place, else ``least``."""
    angles = sorted(direction(phase, params.eccentricity) for phase in params.set_phases)
    gaps = [after - before for before, after in zip(angles, [*angles[1:], angles[0] + math.tau], strict=True)]
    gap = min(*gaps, math.pi)
    wanted = max(least, math.ceil(PITCH * diameter / math.sin(gap / 2))) if gap > 0 else least
    points = wanted / 2 * np.array([(math.cos(angle), math.sin(angle)) for angle in (START, *angles)])
    rim = diameter / 2 + LEAST_RIM * rack_of(params).module
    return wanted if room(params, points) >= rim else least


def phases_that_work(
    dividing: Dividing, phases: tuple[float, ...], eccentricity: float
) -> list[float] | None:
    """The phases, degrees, with each that has no place moved to the nearest one that has; None without."""
    found = list(phases)
    while dividing.crowded is not None:
        bad = dividing.crowded[1]
        found.remove(bad)
        for step in range(1, int(360 / NEAREST_STEP)):
            near = [bad + sign * step * NEAREST_STEP for sign in (1, -1)]
            tried = [
                (phase, placed((*found, phase), eccentricity, dividing.diameter, dividing.radius))
                for phase in near
                if 0 <= phase <= 360
            ]
            better = [one for one in tried if len(one[1].holes) > len(dividing.holes)]
            if better:
                phase, dividing = better[0]
                found.append(phase)
                break
        else:
            return None
    return sorted(found)
