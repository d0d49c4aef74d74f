"""A ring with teeth inside as a plate: its round outside, and the holes by which it is screwed on."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright.contracts.design_table import Rowwise
from mechwright.contracts.part import Bore, Feature, Profile
from mechwright.geometry import Loop, Outline, circle
from mechwright.geometry.segments import Point
from mechwright.mechanics.gearing.rim_rules import rim_for, rim_rules

HOLES = 6
"""Holes of a ring where the design names none."""


@dataclass(frozen=True)
class RingPlate(Rowwise):
    """What lies around the teeth of a ring, mm; numbers, or columns (n, 1).

    Parameters
    ----------
    root
        Radius of the roots.
    outside
        Diameter.
    holes, hole
        Number and diameter of the holes on a circle in the middle of the rim.
    module
        Of the teeth.
    depth
        Of the teeth, from tip to root.
    """

    root: Any
    outside: Any
    holes: Any
    hole: Any
    module: Any
    depth: Any

    @property
    def wall(self) -> Any:
        """What stays of the rim on both sides of a hole together; all of it where there are none."""
        return self.outside / 2 - self.root - np.where(np.asarray(self.holes) > 0, self.hole, 0.0)

    def size_for(self, rim: float) -> int:
        """Diameter, in whole mm, of one ring with a rim so wide."""
        return math.ceil(2 * (float(self.root) + rim))

    @property
    def most_holes(self) -> int:
        """Holes of one ring between which a module stays."""
        chord = float((self.hole + self.module) / (2 * self.circle))
        return math.floor(math.pi / math.asin(min(1.0, chord)))

    @property
    def circle(self) -> Any:
        """Radius of the circle on which the holes stand."""
        return (self.outside / 2 + self.root) / 2

    @property
    def bridge(self) -> Any:
        """What stays between two holes; infinite where there are not two."""
        count = np.maximum(np.asarray(self.holes, dtype=float), 2)
        apart = 2 * self.circle * np.sin(math.pi / count) - self.hole
        return np.where(np.asarray(self.holes) > 1, apart, np.inf)

    @property
    def centres(self) -> tuple[Point, ...]:
        """Of the holes of one ring, the first on +x."""
        turns = (math.tau * k / int(self.holes) for k in range(int(self.holes)))
        radius = float(self.circle)
        return tuple((radius * math.cos(turn), radius * math.sin(turn)) for turn in turns)

    @property
    def moment(self) -> Any:
        """Polar moment about the axis, mm⁴, of all within the outside but the holes, teeth filled."""
        full, hole = self.outside / 2, self.hole / 2
        away = self.holes * math.pi * hole**2 * (hole**2 / 2 + self.circle**2)
        return math.pi / 2 * full**4 - away

    def outline(self, inside: Loop, deviation: float) -> Outline:
        """Of a ring with teeth along a counter-clockwise loop; the teeth are its first opening."""
        holes = (Loop((circle(centre, float(self.hole) / 2),)).reversed() for centre in self.centres)
        outer = Loop((circle((0.0, 0.0), float(self.outside) / 2),))
        return Outline(outer, (inside.reversed(), *holes), deviation)

    def features(self, outline: Outline, thickness: float) -> list[Feature]:
        """Holes, teeth and outside of such an outline."""
        size = float(self.hole)
        return [
            *(
                Bore(f"hole-{k}", centre, size, 0, thickness)
                for k, centre in enumerate(self.centres, start=1)
            ),
            Profile("teeth", outline.inner[0], "inside", 0, thickness),
            Profile("outside", outline.outer, "outside", 0, thickness),
        ]


def outside_for(root: Any, hole: Any, depth: Any) -> Any:
    """Diameter, mm, of a ring that names none: whole millimetres, with a full rim outside of its roots."""
    return np.ceil(2 * (root + rim_for(hole, depth)))


RING_RULES = rim_rules("ring", "ring_outside", "outside of", lambda m: m.ring_plate)
"""Of tables with a ``ring_plate``: enough stays around the teeth, at the holes and between them."""
