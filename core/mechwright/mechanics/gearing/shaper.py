"""The round cutter of a gear shaper: an involute pinion whose pitch circle rolls on the pitch curve.

Its flanks make the gear's flanks, which no cutter changes, and its tips fillets that stay clear of hollow
arcs. With R_c its pitch radius, R_k = R_c + h_f - r_f that of its tip arcs' centres, R_b = R_c cos α, the
side σ and

    x = s_c + σ R_c [w/R_c + inv α - r_f/R_b - inv acos(R_b/R_k)],  q = (x - s)/R_c,

w half the space: fillet P = r + (1 + r_f/|w|) w, w = R_k sin q t + (R_c - R_k cos q) n, from s = x (root) to
where it meets the flank, at the depth g sin α with g = √(R_k² - R_b²) + r_f - R_c sin α.

It cuts a curve whose curvature stays above -1/R_c, hollow arcs included.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.mechanics.gearing.pitch_curve import Frame
from mechwright.mechanics.gearing.rack import Rack


def involute(angle: float) -> float:
    """Inv α = tan α - α, rad."""
    return math.tan(angle) - angle


@dataclass(frozen=True)
class Shaper(Rack):
    """A round cutter; ``radius`` is that of its pitch circle, mm, the rest as of the rack that it unrolls to.

    Examples
    --------
    >>> cutter = Shaper(2.0, math.radians(20), 2.0, 2.5, 0.4, 0.0, 18.0)
    >>> cutter.half_land > 0
    True
    """

    radius: float

    @property
    def curvature(self) -> float:
        """Of its pitch circle, 1/mm."""
        return 1 / self.radius

    @property
    def _centre(self) -> float:
        """R_k, mm."""
        return self.radius + self.dedendum - self.tip_radius

    @property
    def _base(self) -> float:
        """R_b, mm."""
        return self.radius * math.cos(self.pressure_angle)

    @property
    def straight_depth(self) -> float:
        """Depth below the pitch line where flank and fillet meet, mm."""
        alpha = self.pressure_angle
        along = math.sqrt(self._centre**2 - self._base**2) + self.tip_radius - self.radius * math.sin(alpha)
        return along * math.sin(alpha)

    @property
    def half_land(self) -> float:
        """From the middle of the cutter's tooth to the centre of a tip arc on its pitch circle, mm."""
        angle = self.half_space / self.radius + involute(self.pressure_angle) - self.tip_radius / self._base
        return self.radius * (angle - involute(math.acos(self._base / self._centre)))

    @property
    def fillet_course(self) -> tuple[float, float]:
        """As that of the rack: from the root to where the flank begins."""
        sin, cos = math.sin(self.pressure_angle), math.cos(self.pressure_angle)
        way = self.straight_depth / (sin * cos) + self.half_land - self.half_space
        return self.arc_depth, math.asinh(way / self.arc_depth)

    def fillet(self, frame: Frame, centre: Array) -> Array:
        """Points (..., 2), mm, of fillets of tip arcs with centres at arc ``centre`` (...)."""
        turned = (centre - frame.arc) / self.radius
        along, across = self._centre * np.sin(turned), self.radius - self._centre * np.cos(turned)
        scale = 1 + self.tip_radius / np.hypot(along, across)
        points: Array = (
            frame.point
            + (scale * along)[..., None] * frame.tangent
            + (scale * across)[..., None] * frame.normal
        )
        return points
