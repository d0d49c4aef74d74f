"""Exact tooth curves: the envelope of a rack that rolls on the pitch ellipse, in closed form.

With the moving frame r, t, n (outward), ρ at arc s, α the pressure angle, σ the side (±1), s_f the arc where
the flank crosses the pitch curve, and c, d the depth and half distance of the tip arcs' centres:

* flank: P = r - u cos²α t + η n, u = s - s_f, η = σ u sin α cos α;
* its derivative: dP/ds = (sin²α + η/ρ) (t + σ cot α n). The bracket is the regularity factor; where it is
  not above 0 the flank turns back on itself, which is undercut;
* fillet: P = r + (1 + r_f/|w|) w, w = (x - s) t - c n, x = s_c + σ d, from s = x (root) to s = x - σ c cot α,
  where it meets the flank exactly;
* root r - h_f n and tip r + h_a n: offset curves.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mechwright import Array, GeometryError
from mechwright_elliptic_gears.ellipse import Ellipse, Frame
from mechwright_elliptic_gears.rack import Rack

SIDES = np.array([-1.0, 1.0])

_TRIM = 1e-13
"""Residual of the tip trim in units of the semi-major axis: rounding, ten times."""

_TRIM_STEPS = 25
"""Newton's method needs four to six; this is only reached by curves that do not meet."""

_FACTOR_SAMPLES = 33
"""Points per flank for its least regularity factor; the curvature of the ellipse hardly changes on one."""


@dataclass(frozen=True)
class Teeth:
    """All teeth of one gear.

    Parameters
    ----------
    ellipse, rack
        Pitch curve and generating rack; ``count`` pitches are the perimeter.
    count
        Number of teeth z.
    offset
        Arc from the far vertex to the middle of tooth 0, in pitches.

    Arrays over flanks have shape (z, 2): the space, then its side -1 and +1.
    """

    ellipse: Ellipse
    rack: Rack
    count: int
    offset: float

    @cached_property
    def tooth_arcs(self) -> Array:
        """Arc (z,), mm, to the middle of each tooth."""
        arcs: Array = (np.arange(self.count, dtype=np.float64) + self.offset) * self.rack.pitch
        return arcs

    @cached_property
    def space_arcs(self) -> Array:
        """Arc (z,), mm, to the middle of each space; space j follows tooth j."""
        return self.tooth_arcs + self.rack.pitch / 2

    @cached_property
    def flank_arcs(self) -> Array:
        """Arc s_f (z, 2), mm, where each flank crosses the pitch curve."""
        arcs: Array = self.space_arcs[:, None] + SIDES * self.rack.half_space
        return arcs

    @cached_property
    def arc_centres(self) -> Array:
        """Arc x (z, 2), mm, at which the centres of the rack's tip arcs touch the root."""
        arcs: Array = self.space_arcs[:, None] + SIDES * self.rack.half_land
        return arcs

    @cached_property
    def join_arcs(self) -> Array:
        """Arc (z, 2), mm, at which the rack cuts the point where flank and fillet meet."""
        reach = self.rack.straight_depth / math.sin(2 * self.rack.pressure_angle) * 2
        arcs: Array = self.flank_arcs - SIDES * reach
        return arcs

    def flank(self, frame: Frame, start: Array, side: Array) -> Array:
        """Points (..., 2), mm, of flanks that cross the pitch curve at arc ``start`` (...)."""
        sin, cos = math.sin(self.rack.pressure_angle), math.cos(self.rack.pressure_angle)
        u = frame.arc - start
        points: Array = (
            frame.point
            - (u * cos * cos)[..., None] * frame.tangent
            + (side * u * sin * cos)[..., None] * frame.normal
        )
        return points

    def regularity(self, frame: Frame, start: Array, side: Array) -> Array:
        """Factor sin²α + η/ρ (...) of the flank's derivative; undercut where it is not above 0."""
        sin, cos = math.sin(self.rack.pressure_angle), math.cos(self.rack.pressure_angle)
        factor: Array = sin * sin + side * (frame.arc - start) * sin * cos / frame.radius
        return factor

    def fillet(self, frame: Frame, centre: Array) -> Array:
        """Points (..., 2), mm, of fillets of tip arcs with centres at arc ``centre`` (...)."""
        along, across = centre - frame.arc, -self.rack.arc_depth
        scale = 1 + self.rack.tip_radius / np.hypot(along, across)
        points: Array = (
            frame.point
            + (scale * along)[..., None] * frame.tangent
            + (scale * across)[..., None] * frame.normal
        )
        return points

    def offset_curve(self, frame: Frame, height: float) -> Array:
        """Points (..., 2), mm, at a height over the pitch curve."""
        points: Array = frame.point + height * frame.normal
        return points

    @cached_property
    def least_regularity(self) -> Array:
        """Least regularity factor (z, 2) of each flank over sin²α: 1 at the pitch curve, 0 is undercut."""
        t = np.linspace(0, 1, _FACTOR_SAMPLES)
        start = self.flank_arcs[..., None]
        frame = self.ellipse.frame_at(start + t * (self.join_arcs[..., None] - start))
        factor = self.regularity(frame, start, SIDES[:, None]).min(axis=-1)
        least: Array = factor / math.sin(self.rack.pressure_angle) ** 2
        return least

    @cached_property
    def tip_trim(self) -> tuple[Array, Array]:
        """Where flank and tip meet: two arrays (z, 2) of eccentric angles, rad.

        The first belongs to the frame that makes the flank's point, the second to the one below the tip's
        point. Newton's method in both at once.

        Raises
        ------
        GeometryError
            They do not meet.
        """
        ellipse, rack = self.ellipse, self.rack
        sin, cos = math.sin(rack.pressure_angle), math.cos(rack.pressure_angle)
        radius = ellipse.frame_at(self.flank_arcs).radius
        # On a circle of this radius the height is |u| sin α cos α + u² cos⁴α / (2 ρ) to second order.
        half, square = sin * cos, cos**4 / (2 * radius)
        u = SIDES * 2 * rack.addendum / (half + np.sqrt(half**2 + 4 * square * rack.addendum))
        v = ellipse.angle(self.flank_arcs + u)
        w = ellipse.angle(self.flank_arcs + u * (1 - cos * cos * radius / (radius + rack.addendum)))
        for _ in range(_TRIM_STEPS):
            on_flank, on_tip = ellipse.frame(v), ellipse.frame(w)
            gap = self.flank(on_flank, self.flank_arcs, SIDES) - self.offset_curve(on_tip, rack.addendum)
            if np.abs(gap).max() < _TRIM * ellipse.semi_major:
                return v, w
            direction = on_flank.tangent + (SIDES * cos / sin)[:, None] * on_flank.normal
            rate_v = (self.regularity(on_flank, self.flank_arcs, SIDES) * ellipse.arc_rate(v))[
                ..., None
            ] * direction
            rate_w = ((1 + rack.addendum / on_tip.radius) * ellipse.arc_rate(w))[..., None] * on_tip.tangent
            determinant = rate_v[..., 1] * rate_w[..., 0] - rate_v[..., 0] * rate_w[..., 1]
            v = v - (rate_w[..., 0] * gap[..., 1] - rate_w[..., 1] * gap[..., 0]) / determinant
            w = w - (rate_v[..., 0] * gap[..., 1] - rate_v[..., 1] * gap[..., 0]) / determinant
        raise GeometryError(f"addendum: a flank does not reach {rack.addendum:g} mm over the pitch curve")

    @cached_property
    def tip_lands(self) -> tuple[Array, Array]:
        """Eccentric angles (z,), rad, below the two ends of each tooth's tip, in counter-clockwise order."""
        below = self.tip_trim[1]
        first = np.roll(below[:, 1], 1)
        first[0] -= math.tau
        return first, below[:, 0]

    @cached_property
    def tip_widths(self) -> Array:
        """Length (z,), mm, of each tip along the offset curve; negative where the tooth is pointed."""
        first, last = self.tip_lands
        # The length of a parallel curve is that of the curve and the height times its turn.
        one, two = self.ellipse.frame(first), self.ellipse.frame(last)
        turn = np.arctan2(
            one.normal[:, 0] * two.normal[:, 1] - one.normal[:, 1] * two.normal[:, 0],
            (one.normal * two.normal).sum(axis=1),
        )
        widths: Array = two.arc - one.arc + self.rack.addendum * turn
        return widths
