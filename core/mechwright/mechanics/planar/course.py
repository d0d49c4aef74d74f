"""How the input of a mechanism goes over one period.

Glossary
--------
crank
    An input that turns fully; its period is a turn, or as many as bring the mechanism back.
lever
    An input that cannot turn fully, or is not meant to; its period is its way there and back.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.motion import travelled
from mechwright.mechanics.planar.rigid import Turning


@dataclass(frozen=True, slots=True)
class Course:
    """Where an input begins, how far it goes, and whether it comes back.

    Parameters
    ----------
    start, travel
        rad; a travel below 0 is clockwise.
    rocks
        A lever swings there and back as a far-away crank would move it: harmonically, so that it rests where
        it turns back and all accelerations stay finite. Else the speed is constant.
    """

    start: float
    travel: float
    rocks: bool = False

    def way(self, samples: int) -> Array:
        """Input angles (samples,), rad, once along, both ends included; raises as :func:`travelled` does."""
        return travelled(self.travel, samples, self.start)

    def period(self, samples: int, speed: float) -> tuple[Array, Turning]:
        """Times (samples,), s, and the input over one period, both ends included.

        ``speed`` is above 0, rad/s: of a crank, or of the crank that makes a lever swing once a turn.
        Raises DesignError for fewer than two samples.

        Examples
        --------
        >>> time, turning = Course(0.0, math.pi / 2, rocks=True).period(5, math.tau)
        >>> np.degrees(turning.theta).round(9).tolist(), time.tolist()
        ([0.0, 45.0, 90.0, 45.0, 0.0], [0.0, 0.25, 0.5, 0.75, 1.0])
        """
        if not self.rocks:
            omega = math.copysign(speed, self.travel)
            angles = self.way(samples)
            return np.abs((angles - self.start) / omega), Turning.of(angles, omega)
        phase = travelled(math.tau, samples)
        cos, sin, half = np.cos(phase), np.sin(phase), self.travel / 2
        turning = Turning(
            self.start + half * (1 - cos), half * speed * sin, half * speed**2 * cos, -half * speed**3 * sin
        )
        return phase / speed, turning
