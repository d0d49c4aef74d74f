"""The rim of a ring: how far its teeth reach out, its outside, and the holes by which it is screwed on."""

import math
from dataclasses import dataclass

import numpy as np

from mechwright import Outline, Point
from mechwright.geometry import Loop, circle
from mechwright.mechanics.gearing import Teeth
from mechwright.mechanics.gearing.checks import FULL_RIM
from mechwright_noncircular_gears.params import NoncircularParams

_SAMPLES = 2880
"""Points of the root curve: an eighth of a degree."""

_LEAST_WALL = 2.0
"""Millimetres beside a hole where the design names no outside: a mill and a screw's head have room."""


@dataclass(frozen=True)
class Rim:
    """What lies around the teeth of a ring, mm.

    Parameters
    ----------
    root
        Greatest distance of a root from the axis.
    outside
        Diameter.
    holes, hole
        Number and diameter of the holes on a circle in the middle of the rim.
    """

    root: float
    outside: float
    holes: int
    hole: float

    @classmethod
    def of(cls, params: NoncircularParams, teeth: Teeth) -> "Rim":
        """That of a design with these teeth on its ring."""
        rack = teeth.rack
        t = np.linspace(0.0, math.tau, _SAMPLES, endpoint=False)
        root = float(np.hypot(*teeth.curve.frame(t).offset(-rack.dedendum).T).max())
        holes = params.value("ring_holes")
        hole = params.value("ring_hole") if holes else 0.0
        outside = params.ring_outside
        if outside is None:
            material = FULL_RIM * (rack.addendum + rack.dedendum)
            outside = math.ceil(2 * (root + hole + max(material, 2 * _LEAST_WALL)))
        return cls(root, outside, holes, hole)

    @property
    def wall(self) -> float:
        """What stays of the rim beside the holes, half of it on each side; all of it where there are none."""
        return self.outside / 2 - self.root - self.hole

    @property
    def circle(self) -> float:
        """Radius of the circle on which the holes stand."""
        return (self.outside / 2 + self.root) / 2

    @property
    def centres(self) -> tuple[Point, ...]:
        """Of the holes, the first on +x."""
        turns = (math.tau * k / self.holes for k in range(self.holes))
        return tuple((self.circle * math.cos(turn), self.circle * math.sin(turn)) for turn in turns)

    @property
    def moment(self) -> float:
        """Polar moment about the axis, mm⁴, of all within the outside but the holes, teeth filled."""
        full, hole = self.outside / 2, self.hole / 2
        away = self.holes * math.pi * hole**2 * (hole**2 / 2 + self.circle**2)
        return math.pi / 2 * full**4 - away

    @property
    def bridge(self) -> float:
        """What stays between two holes; infinite where there are not two."""
        return 2 * self.circle * math.sin(math.pi / self.holes) - self.hole if self.holes > 1 else math.inf


def ring_outline(rim: Rim, inside: Loop, deviation: float) -> Outline:
    """Outline of a ring with teeth along a counter-clockwise loop; the teeth are its first opening."""
    holes = (Loop((circle(centre, rim.hole / 2),)).reversed() for centre in rim.centres)
    return Outline(Loop((circle((0.0, 0.0), rim.outside / 2),)), (inside.reversed(), *holes), deviation)
