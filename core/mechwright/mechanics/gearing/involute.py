"""Closed forms of a pair of involute gears with profile shift; numbers, or columns (n, 1) over n designs.

A ring, which has teeth inside, has a number of teeth below 0. Its radii, the centre distance and radii of
curvature are then below 0 as well, all formulas stay, and a shift above 0 makes its teeth thicker (DIN 3960).

With module m, pressure angle α of the rack, teeth z1 and z2, shifts x1 and x2 in modules:

* operating pressure angle: inv α_w = inv α + 2 tan α (x1 + x2)/(z1 + z2), inv α = tan α - α;
* centre distance: a = m (z1 + z2)/2 · cos α/cos α_w; operating pitch circles r_w = a z/(z1 + z2);
* tip shortening: k = x1 + x2 - (a - a_0)/m keeps the clearance of the rack, and is none in a ring;
* tip r_a = m (z/2 + h_a + x - k), root r_f = m (z/2 - h_f + x), base r_b = m z cos α/2;
* tooth thickness on the reference circle: s = m (π/2 + 2 x tan α), less what the backlash takes;
* contact ratio: ε = (√(r_a1² - r_b1²) + √(r_a2² - r_b2²) - a sin α_w)/(π m cos α);
* undercut: none where x ≥ h_s - z sin²α/2, h_s being the depth to which the rack's flank is straight;
* interference: none where the mate's tip touches the flank, at the radius of curvature
  ρ = a sin α_w - √(r_a² - r_b²), above the fillet, which begins at r sin α - m (h_s - x)/sin α;
* specific sliding at the foot of a flank: ξ = 1 - (z1/z2)(ρ2/ρ1) where the mate's tip touches it.

Source: DIN 3960, ISO 21771.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.design_table import Rowwise

STEPS = 60
"""Of Newton's method or of bisections."""

MOST_SHIFT = 1.0
"""Greatest size of a profile shift that is chosen, in modules."""


def involute(angle: Any) -> Any:
    """Inv α = tan α - α (...).

    >>> round(float(involute(math.radians(20))), 7)
    0.0149044
    """
    return np.tan(angle) - angle


def angle_of_involute(value: Any) -> Array:
    """The angle (...), rad, whose involute is the value; NaN where it is below 0.

    >>> round(math.degrees(float(angle_of_involute(involute(math.radians(25))))), 9)
    25.0
    """
    value = np.asarray(value, dtype=float)
    with np.errstate(invalid="ignore"):
        angle = np.minimum(np.cbrt(3 * value), 1.4)
        for _ in range(STEPS):
            tan = np.tan(angle)
            angle = np.clip(angle - (tan - angle - value) / np.maximum(tan * tan, 1e-18), 1e-9, 1.55)
    return np.where(value > 0, angle, np.where(value == 0, 0.0, np.nan))


@dataclass(frozen=True)
class InvolutePair(Rowwise):
    """Two spur gears.

    Parameters
    ----------
    module
        mm.
    angle
        Pressure angle of the rack, rad.
    teeth, shifts
        z1, z2 and x1, x2.
    addendum
        Of both gears, in modules.
    dedendum, tip_radius
        Of the rack, in modules.
    backlash
        Circumferential play on the operating pitch circles, mm; each tooth is thinner by half of it.
    cutter_radius
        At the tips of a ring's cutter, which has as many teeth as its pinion, in modules.
    """

    module: Any
    angle: Any
    teeth: tuple[Any, Any]
    shifts: tuple[Any, Any]
    addendum: tuple[Any, Any] = (1.0, 1.0)
    dedendum: Any = 1.25
    tip_radius: Any = 0.38
    backlash: Any = 0.0
    cutter_radius: Any = 0.0

    @property
    def total(self) -> Any:
        """z1 + z2; NaN of a ring with as many teeth as its pinion, which has no centre distance."""
        total = self.teeth[0] + self.teeth[1]
        return np.where(np.asarray(total) == 0, np.nan, total)

    @property
    def reference_distance(self) -> Any:
        """a_0, mm: the centre distance without shifts."""
        return self.module * self.total / 2

    @cached_property
    def operating_angle(self) -> Array:
        """α_w, rad; NaN where the shifts put the gears too near to each other."""
        more = 2 * np.tan(self.angle) * (self.shifts[0] + self.shifts[1]) / self.total
        return angle_of_involute(involute(self.angle) + more)

    @property
    def distance(self) -> Any:
        """a, mm."""
        return self.reference_distance * np.cos(self.angle) / np.cos(self.operating_angle)

    @property
    def shortening(self) -> Any:
        """k, in modules, 0 or more."""
        sum_of_shifts = self.shifts[0] + self.shifts[1]
        return np.maximum(sum_of_shifts - (self.distance - self.reference_distance) / self.module, 0.0)

    def reference(self, gear: int) -> Any:
        """Radius of the reference circle of gear 0 or 1, mm."""
        return self.module * self.teeth[gear] / 2

    def operating(self, gear: int) -> Any:
        """Radius of its operating pitch circle, mm."""
        return self.distance * self.teeth[gear] / self.total

    def base(self, gear: int) -> Any:
        """Radius of its base circle, mm."""
        return self.reference(gear) * np.cos(self.angle)

    def tip(self, gear: int) -> Any:
        """Radius of its tip circle, mm."""
        height = self.addendum[gear] + self.shifts[gear] - self.shortening
        return self.reference(gear) + self.module * height

    def root(self, gear: int) -> Any:
        """Radius of its root circle, mm."""
        return self.reference(gear) - self.module * (self.dedendum - self.shifts[gear])

    def thickness(self, gear: int) -> Any:
        """Of its teeth on the reference circle, mm."""
        thick = self.module * (math.pi / 2 + 2 * self.shifts[gear] * np.tan(self.angle))
        return thick - self.backlash / 2 * np.cos(self.operating_angle) / np.cos(self.angle)

    def thickness_at(self, gear: int, radius: Any) -> Any:
        """Of its teeth on a circle, mm."""
        there = np.arccos(np.minimum(self.base(gear) / radius, 1.0))
        share = self.thickness(gear) / (2 * self.reference(gear))
        return 2 * radius * (share + involute(self.angle) - involute(there))

    @property
    def contact_ratio(self) -> Any:
        """ε."""
        way = self._tip_curvature(0) + self._tip_curvature(1) - self.line
        return way / (math.pi * self.module * np.cos(self.angle))

    @property
    def line(self) -> Any:
        """Between both points where the line of action touches the base circles, mm."""
        return self.distance * np.sin(self.operating_angle)

    def _tip_curvature(self, gear: int) -> Any:
        """Radius of curvature of a flank at its tip, mm."""
        with np.errstate(invalid="ignore"):
            return np.sqrt(self.tip(gear) ** 2 - self.base(gear) ** 2) * np.sign(self.teeth[gear])

    def foot_curvature(self, gear: int) -> Any:
        """Radius of curvature of a flank where the tip of the mate touches it, mm."""
        return self.line - self._tip_curvature(1 - gear)

    def form_curvature(self, gear: int) -> Any:
        """Radius of curvature of a flank where its fillet begins, mm; of a gear below 0 it is undercut."""
        if np.all(np.asarray(self.teeth[gear]) < 0):
            return self.line - self._cutter_curvature
        deep = straight_depth(self.angle, self.dedendum, self.tip_radius) - self.shifts[gear]
        return self.reference(gear) * np.sin(self.angle) - self.module * deep / np.sin(self.angle)

    @property
    def _cutter_curvature(self) -> Any:
        """Radius of curvature, mm, of the flanks of a ring's cutter where its tip arcs begin."""
        arc = self.module * self.cutter_radius
        centre = self.distance - self.root(1) - arc
        with np.errstate(invalid="ignore"):
            return np.sqrt(np.maximum(centre**2 - self.base(0) ** 2, 0.0)) + arc

    def cutter_land(self, radius: Any) -> Any:
        """Half the flat end of a tooth of a ring's cutter, rad about its axis; below 0 its tip arcs overlap.

        ``radius`` is that of these arcs, in modules.
        """
        arc, rolled = self.module * radius, self.operating(0)
        centre = self.distance - self.root(1) - arc
        space = (math.tau * rolled / self.teeth[0] - self.thickness_at(1, self.operating(1))) / 2
        angle = space / rolled + involute(self.operating_angle) - arc / self.base(0)
        with np.errstate(divide="ignore", invalid="ignore"):
            return angle - involute(np.arccos(np.minimum(self.base(0) / centre, 1.0)))

    @property
    def tip_passing(self) -> Any:
        """How far, mm, tips of a pinion pass those of its ring where both tip circles cross; inf elsewhere.

        z1 (θ1 + inv α_a1 - inv α_w) - |z2| (θ2 + inv α_a2 - inv α_w) over z1, times r_a1; θ are the angles
        of the crossing about both axes (Dudley, Niemann).
        """
        one, two, apart = self.tip(0), -self.tip(1), -self.distance
        with np.errstate(invalid="ignore"):
            first = np.arccos((two**2 - one**2 - apart**2) / (2 * apart * one))
            second = np.arccos((apart**2 + two**2 - one**2) / (2 * apart * two))
        ahead = first + self._tip_involute(0)
        behind = second + self._tip_involute(1)
        passing = one * (ahead + self.teeth[1] / self.teeth[0] * behind)
        return np.where(np.isnan(first), np.inf, passing)

    @property
    def goes_in(self) -> Any:
        """Whether a pinion goes into its ring along the line of centres: angle, rad, 0 or more if it does.

        θ1 + inv α_a1 - inv α_w - |z2|/z1 (θ2 + inv α_a2 - inv α_w), sin²θ1 = (1 - (cos α_a1/cos α_a2)²)/
        (1 - (z1/z2)²), sin²θ2 = ((cos α_a2/cos α_a1)² - 1)/((z2/z1)² - 1) (Henriot).
        """
        cosines = self.base(0) / self.tip(0) / (self.base(1) / self.tip(1))
        teeth = self.teeth[0] / self.teeth[1]
        with np.errstate(invalid="ignore"):
            first = np.arcsin(np.sqrt((1 - cosines**2) / (1 - teeth**2)))
            second = np.arcsin(np.sqrt((cosines**-2 - 1) / (teeth**-2 - 1)))
        return first + self._tip_involute(0) + (second + self._tip_involute(1)) / teeth

    def _tip_involute(self, gear: int) -> Any:
        """Inv α_a - inv α_w at its tip."""
        angle = np.arccos(np.minimum(self.base(gear) / self.tip(gear), 1.0))
        return involute(angle) - involute(self.operating_angle)

    def sliding(self, gear: int) -> Any:
        """Specific sliding at the foot of a flank: sliding over rolling speed, below 0."""
        own = self.foot_curvature(gear)
        with np.errstate(divide="ignore", invalid="ignore"):
            return 1 - self.teeth[gear] / self.teeth[1 - gear] * (self.line - own) / own

    def with_shifts(self, one: Any, two: Any) -> "InvolutePair":
        """The same rack and numbers of teeth with other shifts."""
        return replace(self, shifts=(one, two))


def straight_depth(angle: Any, dedendum: Any, tip_radius: Any) -> Any:
    """h_s: how deep the flank of a rack is straight, in modules."""
    return dedendum - tip_radius * (1 - np.sin(angle))


def least_shift(teeth: Any, angle: Any, dedendum: Any, tip_radius: Any) -> Any:
    """The least shift, in modules, without undercut; a ring, whose teeth are below 0, has none.

    >>> round(float(least_shift(17.1, math.radians(20), 1.0, 0.0)), 3)
    -0.0
    """
    least = straight_depth(angle, dedendum, tip_radius) - teeth * np.sin(angle) ** 2 / 2
    return np.where(np.asarray(teeth) < 0, -np.inf, least)


def sum_of_shifts(teeth: tuple[Any, Any], module: Any, angle: Any, distance: Any) -> Any:
    """x1 + x2 with which gears stand at a centre distance, mm; NaN where the base circles part."""
    total = teeth[0] + teeth[1]
    cosine = module * total / 2 * np.cos(angle) / distance
    with np.errstate(invalid="ignore"):
        operating = np.arccos(np.where(cosine <= 1, cosine, np.nan))
    return (involute(operating) - involute(angle)) * total / (2 * np.tan(angle))


def share_by_size(teeth: tuple[Any, Any], total: Any) -> Any:
    """x1 of a sum of shifts: more for the smaller gear (DIN 3992, ISO/TR 4467).

    x1 = Σ/2 + (1/2 - Σ/2) ln(z2/z1)/ln(z1 z2/100).

    >>> round(float(share_by_size((20, 40), 0.0)), 3)
    0.167
    """
    one, two = (np.asarray(number, dtype=float) for number in teeth)
    size = np.log(np.maximum(one * two / 100, 1.5))
    return total / 2 + (0.5 - total / 2) * np.log(two / one) / size


def share_by_sliding(pair: InvolutePair, total: Any, least: Any, most: Any) -> Array:
    """x1 of a sum of shifts with which both feet slide alike, between two limits; by bisection."""

    def difference(one: Array) -> Array:
        shifted = pair.with_shifts(one, total - one)
        found = np.asarray(shifted.sliding(0) - shifted.sliding(1))
        return np.where(np.isnan(found), -1.0, found)

    return _root(difference, np.asarray(least, dtype=float), np.asarray(most, dtype=float))


def _root(function: Callable[[Array], Array], low: Array, high: Array) -> Array:
    """Where a rising function is 0 between two limits; a limit where it keeps its sign."""
    low, high = np.broadcast_arrays(low, high)
    for _ in range(STEPS):
        middle = (low + high) / 2
        below = function(middle) < 0
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return np.asarray((low + high) / 2)
