"""The outline of a turning cutter: how wide it is at a height above its tip, and the other way round.

Glossary
--------
nose
    Radius of the rounded corner between the end and the side of a mill: 0 for a flat end mill, the corner
    radius of a bull nose, half the diameter of a ball.
tip
    Radius of the flat in the middle of a pointed cutter's end.
cusp
    What stands between two parallel cuts of a round cutter.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.tolerances import TOLERANCES
from mechwright_cam.shop.tool import REAMER_LEAD, TAP_POINT, Tool, ToolKind

POINTED = frozenset({ToolKind.DRILL, ToolKind.SPOT_DRILL, ToolKind.CHAMFER})
"""Tools with a cone at the end."""
BLUNT = 179.9
"""A cone of this full angle, degrees, is as good as flat; of half of 180 there is no tangent."""

SAME_RADIUS = TOLERANCES.leftover / 2
"""A fillet may miss the radius that is asked for by so much, mm: at its middle that is less than half."""
LEAST_SHARE = 0.02
"""A mill that reaches less of a recess than this does not enter it: it only scratches at its mouth."""
CORNER_SHARE = 0.5
"""What a mill leaves in a corner of 40 degrees or more is nowhere wider than this share of its diameter:
there (1 - sin 20°) / (1 + sin 20°) is as much."""

TINY = 1e-9
"""A corner of a smaller radius is none, mm."""


@dataclass(frozen=True)
class Cutter:
    """The outline of one cutter, or with arrays (n,) of many; lengths in mm.

    Examples
    --------
    A bull nose of 10 mm with a corner of 2 mm, a ball of 6 mm, a drill of 118 degrees:

    >>> bull, ball = Cutter(5.0, nose=2.0), Cutter(3.0, nose=3.0)
    >>> [round(float(bull.radius_at(h)), 3) for h in (0.0, 1.0, 2.0, 9.0)]
    [3.0, 4.732, 5.0, 5.0]
    >>> round(float(ball.height_at(1.0)), 4), float(ball.height_at(3.5))
    (0.1716, inf)
    >>> drill = Cutter(4.0, slope=math.tan(math.radians(59)))
    >>> round(float(drill.height_at(4.0)), 4)
    2.4034
    """

    radius: Any
    """The largest."""
    nose: Any = 0.0
    tip: Any = 0.0
    slope: Any = math.inf
    """Growth of the radius with height on a cone; inf for a mill."""

    def radius_at(self, height: Any) -> Array:
        """Radius at a height above the tip, mm; that of the tip below it.

        A corner of radius c is c - √(c² - (c - h)²) narrower than the cutter, a cone grows evenly.
        """
        above = np.maximum(height, 0.0)
        short = np.maximum(self.nose - above, 0.0)
        rounded = self.radius - self.nose + np.sqrt(np.maximum(self.nose**2 - short**2, 0.0))
        cone = np.isfinite(self.slope)
        pointed = self.tip + np.where(cone, self.slope, 0.0) * above
        return np.asarray(np.where(cone, np.minimum(self.radius, pointed), rounded))

    def height_at(self, away: Any) -> Array:
        """Height of the cutter's end above its tip at a distance from the axis, mm; inf beyond its radius."""
        out_of_flat = np.minimum(np.maximum(away - (self.radius - self.nose), 0.0), self.nose)
        rounded = self.nose - np.sqrt(self.nose**2 - out_of_flat**2)
        cone = np.isfinite(self.slope)
        pointed = np.maximum(away - self.tip, 0.0) / np.where(cone, self.slope, 1.0)
        return np.asarray(np.where(away <= self.radius, np.where(cone, pointed, rounded), np.inf))


def cutter(tool: Tool) -> Cutter:
    """The outline of a tool; thread mills count as cylinders, taps and reamers have their lead as a cone."""
    if tool.pitch is not None:
        rise = TAP_POINT * tool.pitch
        return Cutter(tool.radius, tip=tool.radius - rise, slope=rise / tool.point_length)
    if tool.kind in POINTED:
        slope = math.tan(math.radians(min(tool.point_angle, BLUNT) / 2))
        return Cutter(tool.radius, tip=tool.tip_diameter / 2, slope=slope)
    if tool.kind is ToolKind.REAMER:
        return Cutter(tool.radius, tip=max(tool.radius - REAMER_LEAD, 0.0), slope=1.0)
    return Cutter(tool.radius, nose=tool.nose)


def makes_floor(tool: Tool, floor_radius: float) -> bool:
    """Whether a mill leaves the fillet that a floor is to have, mm."""
    return floor_radius > 0 and abs(tool.nose - floor_radius) <= SAME_RADIUS


def cusp(tool: Tool, step: float) -> float:
    """Height of what stands between two parallel cuts of a mill, ``step`` mm apart; inf if they do not meet.

    For a ball it is r - √(r² - s²/4).
    """
    return float(cutter(tool).height_at(step / 2))


def approach(tool: Tool, depth: Any) -> Array:
    """Sine of the greatest angle at which a mill's edge meets the work in a cut of this depth, mm.

    Chips are so much thinner than the feed per tooth: √(1 - (1 - a/c)²) for a corner of radius c that is
    deeper than the cut a, and 1 otherwise (round inserts are reckoned this way).
    """
    share = np.clip(np.asarray(depth, dtype=np.float64) / max(tool.nose, TINY), 0.0, 1.0)
    return np.asarray(np.sqrt(1 - (1 - share) ** 2))
