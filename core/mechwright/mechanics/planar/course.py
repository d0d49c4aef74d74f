"""How the input of a mechanism goes over one period.

Glossary
--------
crank
    An input that turns fully; its period is a turn, or as many as bring the mechanism back.
lever
    An input that cannot turn fully, or is not meant to; its period is its way there and back.
acceleration ratio
    k = α/ω² of a crank, per radian, counter-clockwise positive. While it is constant the speed grows with the
    angle, ω = ω₀ exp(k (φ - φ₀)), for dω/dφ = α/ω = k ω: the one motion whose poles of acceleration depend on
    the angle alone.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechwright.arrays import Array
from mechwright.contracts.stretch import Samples, travelled
from mechwright.mechanics.planar.rigid import Turning

MOST_RATIO = 2.0
"""Largest acceleration ratio of a design, either way, per radian: in a turn the speed grows 290,000 times."""


@dataclass(frozen=True, slots=True)
class Course:
    """Where an input begins, how far it goes, and whether it comes back.

    Parameters
    ----------
    start, travel
        rad; a travel below 0 is clockwise.
    rocks
        A lever swings there and back as a far-away crank would move it: harmonically, so that it rests where
        it turns back and all accelerations stay finite.
    acceleration_ratio
        Of a crank that turns; at 0 its speed is constant. A lever has its own law, and none.
    """

    start: float
    travel: float
    rocks: bool = False
    acceleration_ratio: float = 0.0

    @classmethod
    def between(cls, one: float, two: float) -> "Course":
        """Of a lever that swings from ``one`` to ``two`` and back, rad."""
        return cls(one, two - one, rocks=True)

    def counted(self, angle: Array | float) -> Array:
        """The angles (...), rad, of a crank as its course counts them; see :func:`counted_from`."""
        return counted_from(self.start, self.travel, angle)

    def way(self, samples: Samples) -> Array:
        """Input angles (samples,), rad, once along, both ends included; raises as :func:`travelled` does."""
        return travelled(self.travel, samples, self.start)

    def period(self, samples: Samples, speed: float) -> tuple[Array, Turning]:
        """Times (samples,), s, and the input over one period, both ends included.

        ``speed`` is above 0, rad/s: of a crank at its start, or of the crank that makes a lever swing once a
        turn. Raises DesignError for fewer than two samples.

        Examples
        --------
        >>> time, turning = Course(0.0, math.pi / 2, rocks=True).period(5, math.tau)
        >>> np.degrees(turning.theta).round(9).tolist(), time.tolist()
        ([0.0, 45.0, 90.0, 45.0, 0.0], [0.0, 0.25, 0.5, 0.75, 1.0])
        """
        if not self.rocks:
            turning = self.turning(self.way(samples), speed)
            k, turned = self.acceleration_ratio, turning.theta - self.start
            spent = turned if k == 0 else -np.expm1(-k * turned) / k
            return np.abs(spent / speed), turning
        phase = travelled(math.tau, samples)
        cos, sin, half = np.cos(phase), np.sin(phase), self.travel / 2
        turning = Turning(
            self.start + half * (1 - cos), half * speed * sin, half * speed**2 * cos, -half * speed**3 * sin
        )
        return phase / speed, turning

    def turning(self, angles: Array, speed: float) -> Turning:
        """A crank at angles (...), rad, that has the speed, rad/s and above 0, at its start.

        Examples
        --------
        >>> crank = Course(0.0, math.tau, acceleration_ratio=math.log(2) / math.pi)
        >>> crank.turning(np.array([0.0, math.pi, math.tau]), 3.0).omega.round(9).tolist()
        [3.0, 6.0, 12.0]
        """
        k = self.acceleration_ratio
        omega = math.copysign(speed, self.travel) * np.exp(k * (angles - self.start))
        return Turning.of(angles, omega, k * omega**2, 2 * k**2 * omega**3)


@dataclass(frozen=True)
class Ways:
    """Courses of the inputs of a table of designs, each field a number or a column (n, 1)."""

    start: Any
    travel: Any
    rocks: Any
    acceleration_ratio: Any = 0.0

    @property
    def course(self) -> Course:
        """That of one design."""
        start, travel, ratio = (
            float(np.ravel(one)[0]) for one in (self.start, self.travel, self.acceleration_ratio)
        )
        return Course(start, travel, bool(np.ravel(self.rocks)[0]), ratio)


def counted_from(start: Array | float, travel: Array | float, angle: Array | float) -> Array:
    """Angles (...), rad, less than a turn from a start on, in the sense of the travel.

    A crank that turns clockwise has its angles below its start, and so has each figure that is one of them.

    >>> np.degrees(counted_from(0.0, -math.tau, np.radians([200.0, -20.0]))).round(9).tolist()
    [-160.0, -20.0]
    """
    sense = np.sign(travel)
    return np.asarray(start + sense * (sense * (angle - start) % math.tau))
