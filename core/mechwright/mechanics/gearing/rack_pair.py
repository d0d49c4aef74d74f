"""Closed forms of a pinion and its straight rack; numbers, or columns (n, 1) over n designs.

A rack is a gear of infinitely many teeth. The operating pitch circle of its pinion is the reference circle at
any profile shift x, and the operating pressure angle is that of the rack. Radii of the rack are infinite, so
its tip and root are heights over its pitch line, the tangent of the reference circle. The pitch line lies x m
above the reference line of the rack, on which its teeth and spaces are equally wide: the rack has the shift
-x.

With module m, pressure angle α, teeth z, radius r = m z/2 and heights h_a1 and h_a2 of the teeth:

* mounting distance of the pinion's axis from the reference line: a = r + x m;
* speed of the rack: v = ω r;
* contact ratio: ε = (√(r_a² - r_b²) - r sin α + m (h_a2 - x)/sin α)/(π m cos α);
* interference: tips of the rack touch the pinion's flank at the radius of curvature
  r sin α - m (h_a2 - x)/sin α, above its fillet; tips of the pinion touch the rack above its own fillet;
* specific sliding at the feet: 1 - r sin α/ρ of the pinion, ρ being that radius of curvature, and
  1 - √(r_a² - r_b²)/(r sin α) of the rack.

Behind its path a tip corner of the pinion runs on over the fillet of the rack. With the tip radius r_a, half
the angle δ of a tooth there, and the tooth turned by u from straight down, it stands at r (δ - u) + r_a sin u
from the middle of the tooth's space and r_a cos u - r below the pitch line; the fillet is an arc.

Source: DIN 3960, ISO 21771, with z2 → ∞.

Glossary
--------
path
    Part of the line of action on which flanks touch, on one side of the pitch point: up to the pinion's tips,
    or to those of the rack.
travel
    Way of the rack, symmetrical about the middle of its teeth; no flank is missing over it that would touch.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.gearing.involute import InvolutePair, straight_depth
from mechwright.tolerances import TOLERANCES

FILLET_SAMPLES = 33
"""Positions of a tip corner over a fillet: the room is hardly less between two of them."""


@dataclass(frozen=True)
class RackPair(InvolutePair):
    """A pinion, gear 0, and a rack, gear 1; ``teeth`` are z and infinity, ``shifts`` x and -x.

    Examples
    --------
    >>> pair = RackPair.of(2.0, math.radians(20), 20, 0.5)
    >>> float(pair.distance), float(pair.operating(0))
    (21.0, 20.0)
    """

    @classmethod
    def of(cls, module: Any, angle: Any, teeth: Any, shift: Any, **more: Any) -> "RackPair":
        """A pinion with a number of teeth and a shift; ``more`` are the other fields."""
        return cls(module, angle, (teeth, math.inf), (shift, -shift), **more)

    @property
    def total(self) -> Any:
        """Infinite."""
        return math.inf

    @property
    def reference_distance(self) -> Any:
        """Of the axis from the reference line without a shift, mm."""
        return self.module * self.teeth[0] / 2

    @cached_property
    def operating_angle(self) -> Array:
        """That of the rack, rad."""
        return np.asarray(self.angle, dtype=float)

    @property
    def distance(self) -> Any:
        """Of the axis from the reference line of the rack, mm."""
        return self.reference_distance + self.module * self.shifts[0]

    @property
    def shortening(self) -> Any:
        """None: the clearance is that of the rack at any distance."""
        return 0.0 * self.module

    def operating(self, gear: int) -> Any:
        """The reference circle."""
        return self.reference(gear)

    def tip(self, gear: int) -> Any:
        """Radius of the pinion, height of the rack over its pitch line, mm."""
        return self.module * (self.addendum[1] + self.shifts[1]) if gear else super().tip(0)

    def root(self, gear: int) -> Any:
        """As :meth:`tip`; that of the rack is below 0."""
        return -self.module * (self.dedendum - self.shifts[1]) if gear else super().root(0)

    def thickness_at(self, gear: int, radius: Any) -> Any:
        """Of teeth on a circle of the pinion, or at a height of the rack over its pitch line, mm."""
        if gear:
            return self.thickness(1) - 2 * radius * np.tan(self.angle)
        return super().thickness_at(0, radius)

    @property
    def paths(self) -> tuple[Any, Any]:
        """Contact on the line of action, mm: from the pitch point to the tips of pinion and of rack."""
        sine = np.sin(self.angle)
        return self._tip_curvature(0) - self.reference(0) * sine, self.tip(1) / sine

    @property
    def contact_ratio(self) -> Any:
        """ε."""
        recess, approach = self.paths
        return (recess + approach) / (math.pi * self.module * np.cos(self.angle))

    def foot_curvature(self, gear: int) -> Any:
        """Where the tip of the mate touches a flank, mm; on the rack from the pitch point on, below 0."""
        recess, approach = self.paths
        return -recess if gear else self.reference(0) * np.sin(self.angle) - approach

    def form_curvature(self, gear: int) -> Any:
        """Where the fillet of a flank begins, mm, measured as :meth:`foot_curvature`."""
        if not gear:
            return super().form_curvature(0)
        deep = straight_depth(self.angle, self.dedendum, self.tip_radius) - self.shifts[1]
        return -self.module * deep / np.sin(self.angle)

    def sliding(self, gear: int) -> Any:
        """Specific sliding at the foot of a flank, below 0."""
        rolled = self.reference(0) * np.sin(self.angle)
        with np.errstate(divide="ignore", invalid="ignore"):
            return 1 - (self._tip_curvature(0) / rolled if gear else rolled / self.foot_curvature(0))

    @property
    def fillet_room(self) -> Any:
        """Between the tip corners of the pinion and the fillets of the rack, with flanks that touch, mm."""
        arc, alpha, r, tip = self.module * self.tip_radius, self.angle, self.operating(0), self.tip(0)
        deep = -self.root(1) - arc
        straight = deep + arc * np.sin(alpha)
        centre = self.thickness_at(0, r) / 2 - straight * np.tan(alpha) - arc * np.cos(alpha)
        half = self.thickness_at(0, tip) / (2 * tip)
        with np.errstate(invalid="ignore"):
            first = np.arccos(np.minimum((r + self.paths[0] * np.sin(alpha)) / tip, 1.0))
        u = np.asarray(first)[..., None] * np.linspace(1.0, 0.0, FILLET_SAMPLES)
        arc, straight, deep, centre, half, r, tip = (
            np.asarray(one)[..., None] for one in (arc, straight, deep, centre, half, r, tip)
        )
        across, depth = r * (half - u) + tip * np.sin(u) - centre, tip * np.cos(u) - r
        beside = (depth >= straight) & (across >= 0)
        return np.where(beside, arc - np.hypot(across, depth - deep), np.inf).min(axis=-1)

    @property
    def pitch(self) -> Any:
        """Distance of the rack's teeth, mm."""
        return math.pi * self.module

    @property
    def _margin(self) -> Any:
        """By how much the travel is shorter than a rack with one tooth more, mm.

        Flanks touch that cross the pitch line within path/cos α of the pitch point. The first two that are
        missing are those of the tooth that would stand next to the last one: that towards the rack's middle
        would touch along the path of the pinion's tips, the other one along that of the rack's tips.
        """
        recess, approach = (2 * path / np.cos(self.angle) for path in self.paths)
        thick = self.thickness(1)
        return np.maximum(recess + thick, approach - thick)

    def travel(self, count: Any) -> Any:
        """Greatest way, mm, of a rack with so many teeth; below 0 without any."""
        return (count + 1) * self.pitch - self._margin

    def rack_teeth(self, travel: Any) -> Any:
        """Least number of teeth of a rack for a way, mm."""
        pitches = (travel + self._margin) / self.pitch - 1
        return np.maximum(np.ceil(pitches - TOLERANCES.slack * np.abs(pitches)), 1.0)
