"""Teeth at equal arcs of a pitch curve: where each flank, fillet, root and tip begins and ends."""

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from mechwright.arrays import Array
from mechwright.errors import GeometryError
from mechwright.mechanics.gearing.pitch_curve import PitchCurve
from mechwright.mechanics.gearing.rack import SIDES, Rack

FIT = 0.0001
"""Greatest deviation of an outline from the exact curves, mm: a tenth of what an outline may have, for one
degree more. Flanks of smaller gears come nearer, as the angle asks that they turn their mates by."""

_TRIM = 1e-13
"""Residual of the tip trim in units of the mean radius: rounding, ten times."""

_TRIM_STEPS = 25
"""Newton's method needs four to six; this is only reached by curves that do not meet."""

_STRAIGHT = 1e12
"""mm. A curve with a greater radius is straight."""

FACTOR_SAMPLES = 33
"""Points per flank for its least regularity factor; between breaks the curvature hardly changes on one."""

_BESIDE = 1e-9
"""Of the perimeter: how far beside a break of the curvature it is looked at."""


@dataclass(frozen=True)
class Teeth:
    """All teeth of one gear.

    Parameters
    ----------
    curve, rack
        Pitch curve and generating cutter; ``count`` pitches are the perimeter. A rack asks for a convex one,
        a shaper for one that is hollow nowhere more than it is round.
    count
        Number of teeth z.
    offset
        Arc at the middle of tooth 0, in pitches.
    fit
        Deviation of the flanks of an outline from the exact ones, mm.
    thickness
        Of a tooth along the pitch curve, mm; None for that of the rack on its pitch line. Profile shift makes
        it another: the cutter stands farther out by x modules, and teeth are thicker by 2 x m tan α.

    Arrays over flanks have shape (z, 2): the space, then its side -1 and +1.
    """

    curve: PitchCurve
    rack: Rack
    count: int
    offset: float
    fit: float = field(default=FIT, kw_only=True)
    thickness: float | None = field(default=None, kw_only=True)

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
        arcs: Array = self.space_arcs[:, None] + SIDES * self.half_space
        return arcs

    @property
    def half_space(self) -> float:
        """Half the width of a tooth space on the pitch curve, mm."""
        return self.rack.half_space if self.thickness is None else (self.rack.pitch - self.thickness) / 2

    @property
    def half_land(self) -> float:
        """From the middle of a space to the centres of the rack's tip arcs, mm."""
        return self.rack.half_land + self.half_space - self.rack.half_space

    @property
    def wheel(self) -> int:
        """Pitches of the whole run: those of the perimeter."""
        return self.count

    @property
    def meeting_arcs(self) -> Array:
        """Arc (z, 2), mm, where each flank crosses that a flank of the mate meets; NaN of others."""
        return self.flank_arcs

    @cached_property
    def arc_centres(self) -> Array:
        """Arc x (z, 2), mm, at which the centres of the rack's tip arcs touch the root."""
        arcs: Array = self.space_arcs[:, None] + SIDES * self.half_land
        return arcs

    @cached_property
    def join_arcs(self) -> Array:
        """Arc (z, 2), mm, at which the rack cuts the point where flank and fillet meet."""
        reach = self.rack.straight_depth / math.sin(2 * self.rack.pressure_angle) * 2
        arcs: Array = self.flank_arcs - SIDES * reach
        return arcs

    @cached_property
    def least_regularity(self) -> Array:
        """Least regularity factor (z, 2) of each flank over sin²α: 1 at the pitch curve, 0 is undercut."""
        return self._least(self.join_arcs)

    @cached_property
    def least_tip_regularity(self) -> Array:
        """The same (z, 2) from the pitch curve to the tip: below 1 where the curve is hollow."""
        return self._least(self.curve.arc(self.tip_trim[0]))

    def _least(self, ends: Array) -> Array:
        """Over each flank from the pitch curve to the arcs ``ends`` (z, 2); both sides of breaks count."""
        start, way = self.flank_arcs[..., None], (ends - self.flank_arcs)[..., None]
        breaks, perimeter = self.curve.arc(self.curve.breaks), self.curve.perimeter
        beside = np.concatenate([breaks - _BESIDE * perimeter, breaks + _BESIDE * perimeter])
        nearest = beside + perimeter * np.round((start + way / 2 - beside) / perimeter)
        even = np.broadcast_to(np.linspace(0, 1, FACTOR_SAMPLES), (*ends.shape, FACTOR_SAMPLES))
        t = np.concatenate([even, np.clip((nearest - start) / way, 0.0, 1.0)], axis=-1)
        factor = self.rack.regularity(self.curve.frame_at(start + t * way), start, SIDES[:, None])
        least: Array = factor.min(axis=-1) / math.sin(self.rack.pressure_angle) ** 2
        return least

    @cached_property
    def tip_trim(self) -> tuple[Array, Array]:
        """Where flank and tip meet: two arrays (z, 2) of parameters, rad; GeometryError where they do not.

        The first belongs to the frame that makes the flank's point, the second to the one below the tip's
        point. Newton's method in both at once.
        """
        curve, rack, crossing = self.curve, self.rack, self.flank_arcs
        sin, cos = math.sin(rack.pressure_angle), math.cos(rack.pressure_angle)
        radius = np.clip(curve.frame_at(crossing).radius, -_STRAIGHT, _STRAIGHT)
        # On a circle of this radius the height is |u| sin α cos α + u² cos⁴α / (2 ρ) to second order.
        half, square = sin * cos, cos**4 / (2 * radius)
        u = (
            SIDES
            * 2
            * rack.addendum
            / (half + np.sqrt(np.maximum(half**2 + 4 * square * rack.addendum, 0.0)))
        )
        v = curve.parameter(crossing + u)
        w = curve.parameter(crossing + u * (1 - cos * cos * radius / (radius + rack.addendum)))
        for _ in range(_TRIM_STEPS):
            on_flank, on_tip = curve.frame(v), curve.frame(w)
            gap = rack.flank(on_flank, crossing, SIDES) - on_tip.offset(rack.addendum)
            if np.abs(gap).max() < _TRIM * curve.perimeter / math.tau:
                return v, w
            direction = on_flank.tangent + (SIDES * cos / sin)[:, None] * on_flank.normal
            rate_v = (rack.regularity(on_flank, crossing, SIDES) * curve.arc_rate(v))[..., None] * direction
            rate_w = ((1 + rack.addendum / on_tip.radius) * curve.arc_rate(w))[..., None] * on_tip.tangent
            determinant = rate_v[..., 1] * rate_w[..., 0] - rate_v[..., 0] * rate_w[..., 1]
            v = v - (rate_w[..., 0] * gap[..., 1] - rate_w[..., 1] * gap[..., 0]) / determinant
            w = w - (rate_v[..., 0] * gap[..., 1] - rate_v[..., 1] * gap[..., 0]) / determinant
        raise GeometryError(f"addendum: a flank does not reach {rack.addendum:g} mm over the pitch curve")

    @cached_property
    def tip_reach(self) -> float:
        """Longest arc, mm, between where a flank crosses the pitch curve and the frame of its tip."""
        return float(np.abs(self.curve.arc(self.tip_trim[0]) - self.flank_arcs).max())

    @property
    def tip_height(self) -> float:
        """Greatest height η, mm, over the rack's pitch line that makes the end of a flank."""
        return self.tip_reach * math.sin(2 * self.rack.pressure_angle) / 2

    @cached_property
    def tip_lands(self) -> tuple[Array, Array]:
        """Parameters (z,), rad, below the two ends of each tooth's tip, in counter-clockwise order."""
        below = self.tip_trim[1]
        first = np.roll(below[:, 1], 1)
        first[0] -= math.tau
        return first, below[:, 0]

    @cached_property
    def tip_widths(self) -> Array:
        """Length (z,), mm, of each tip along the offset curve; negative where the tooth is pointed."""
        first, last = self.tip_lands
        # The length of a parallel curve is that of the curve and the height times its turn.
        one, two = self.curve.frame(first), self.curve.frame(last)
        turn = np.arctan2((two.normal * one.tangent).sum(axis=1), (one.normal * two.normal).sum(axis=1))
        widths: Array = two.arc - one.arc + self.rack.addendum * turn
        return widths
