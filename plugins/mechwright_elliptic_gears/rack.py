"""The generating rack, and where its teeth stand along the pitch ellipse.

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
