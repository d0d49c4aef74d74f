"""The generating rack, and the curves that it cuts as it rolls on a pitch curve, in closed form.

With the moving frame r, t, n (outward), ρ at arc s, α the pressure angle, σ the side (±1), s_f the arc where
the flank crosses the pitch curve, s_c the middle of its space, and c, d the depth and half distance of the
tip arcs' centres:

* flank: P = r - u cos²α t + η n, u = s - s_f, η = σ u sin α cos α;
* its derivative: dP/ds = (sin²α + η/ρ) (t + σ cot α n). The bracket is the regularity factor; where it is
  not above 0 the flank turns back on itself, which is undercut;
* fillet: P = r + (1 + r_f/|w|) w, w = (x - s) t - c n, x = s_c + σ d, from s = x (root) to s = x - σ c cot α,
  where it meets the flank exactly;
* root r - h_f n and tip r + h_a n: offset curves.

The flank is that of any cutter (Camus). Fillets are the rack's where the pitch curve is convex: a concave arc
needs the round cutter of :mod:`mechwright.mechanics.gearing.shaper`.

Glossary
--------
space
    A tooth space of the gear: what one tooth of the rack sweeps. Space j follows tooth j.
side
    +1 for the flank of a space that lies at greater arc length, -1 for the other.
η (height)
    Height over the rack's pitch line, mm: positive towards the gear's tip.
land
    The flat end of a rack tooth between its two tip arcs; it makes the root of the gear.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.gearing.pitch_curve import Frame

SIDES = np.array([-1.0, 1.0])


@dataclass(frozen=True)
class Rack:
    """A rack, all lengths in mm.

    Parameters
    ----------
    module
        Pitch over π.
    pressure_angle
        rad.
    addendum
        From the pitch line to the gear's tip.
    dedendum
        From the pitch line to the gear's root.
    tip_radius
        Radius of the arcs at the rack's tip, below the dedendum.
    backlash
        Circumferential play of the finished pair at the pitch curve. Each gear gives half of it, each of its
        flanks a quarter.
    """

    module: float
    pressure_angle: float
    addendum: float
    dedendum: float
    tip_radius: float
    backlash: float

    @property
    def pitch(self) -> float:
        """Distance of the teeth, mm."""
        return math.pi * self.module

    @property
    def curvature(self) -> float:
        """Of the curve that rolls on the gear's pitch curve, 1/mm: a line has none."""
        return 0.0

    @property
    def half_space(self) -> float:
        """Half the width of a tooth space on the pitch curve, mm."""
        return (self.pitch + self.backlash) / 4

    @property
    def straight_depth(self) -> float:
        """Depth below the pitch line where the straight flank ends and the tip arc begins, mm."""
        return self.dedendum - self.tip_radius * (1 - math.sin(self.pressure_angle))

    @property
    def arc_depth(self) -> float:
        """Depth below the pitch line of the tip arc's centre, mm."""
        return self.dedendum - self.tip_radius

    @property
    def half_land(self) -> float:
        """From the middle of the rack tooth to the centre of a tip arc, mm; negative if the arcs overlap."""
        alpha = self.pressure_angle
        return self.half_space - self.straight_depth * math.tan(alpha) - self.tip_radius * math.cos(alpha)

    @property
    def fillet_course(self) -> tuple[float, float]:
        """A length c, mm, and τ_1: fillets go from s = x to x - σ c sinh τ_1.

        With s = x - σ c sinh τ the direction of w is (tanh τ, -sech τ): its poles move away from the curve,
        and three degrees less are enough than with s itself.
        """
        return self.arc_depth, math.asinh(1 / math.tan(self.pressure_angle))

    def flank(self, frame: Frame, start: Array, side: Array) -> Array:
        """Points (..., 2), mm, of flanks that cross the pitch curve at arc ``start`` (...)."""
        sin, cos = math.sin(self.pressure_angle), math.cos(self.pressure_angle)
        u = frame.arc - start
        points: Array = (
            frame.point
            - (u * cos * cos)[..., None] * frame.tangent
            + (side * u * sin * cos)[..., None] * frame.normal
        )
        return points

    def regularity(self, frame: Frame, start: Array, side: Array) -> Array:
        """Factor sin²α + η/ρ (...) of the flank's derivative; undercut where it is not above 0."""
        sin, cos = math.sin(self.pressure_angle), math.cos(self.pressure_angle)
        factor: Array = sin * sin + side * (frame.arc - start) * sin * cos / frame.radius
        return factor

    def fillet(self, frame: Frame, centre: Array) -> Array:
        """Points (..., 2), mm, of fillets of tip arcs with centres at arc ``centre`` (...)."""
        along, across = centre - frame.arc, -self.arc_depth
        scale = 1 + self.tip_radius / np.hypot(along, across)
        points: Array = (
            frame.point
            + (scale * along)[..., None] * frame.tangent
            + (scale * across)[..., None] * frame.normal
        )
        return points
