"""How the driver turns over a turn: its speed, acceleration and jerk over its angle, forwards or backwards.

With τ the angle that it has turned since the first entry, and w₀ the parameter ``speed``:

* constant: w = w₀;
* accelerating, by α: w² = w₀² + 2 α τ, w₀ the speed at the first entry;
* from rest, by α: w² = 2 α τ up to w₀, then w₀;
* harmonic, by the share v: w = w₀ (1 + v cos(θd - θd0)), the fastest in the middle of the first stroke.

The wheel follows, with θw' over θd (equations (7) to (9) of the seed in general, signs and all):

    ωw = θw' w,  αw = θw'' w² + θw' α,  jw = θw''' w³ + 3 θw'' w α + θw' j.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright import Array
from mechwright.contracts.design_table import Rowwise, number
from mechwright.mechanics.planar import Turning
from mechwright_geneva.parameters import GenevaParams


@dataclass(frozen=True, slots=True)
class Driver(Rowwise):
    """The driver of a design, or of a table of them; angles θd are 0 where a roller enters forwards.

    Numbers of a table are columns (m, 1), and what is said at angles (k,) is (m, k).

    Parameters
    ----------
    law
        As the parameter ``driver_law``.
    speed
        w₀, rad/s, above 0.
    acceleration
        α, rad/s², above 0 where it speeds up; used by two laws.
    variation
        v, used by one.
    sense
        +1 forwards, -1 backwards.
    start
        θd of the first entry, rad: 0 forwards, 2 θd0 backwards.
    middle
        θd0, rad.
    """

    law: str
    speed: float
    acceleration: float
    variation: float
    sense: int
    start: float
    middle: float

    def turned(self, theta: Array) -> Array:
        """τ (...), rad, of angles θd (...)."""
        return self.sense * (theta - self.start)

    def at(self, theta: Array) -> Turning:
        """The driver at angles θd (...), rates signed, over time."""
        way, s = np.maximum(self.turned(theta), 0.0), self.sense
        zero = np.zeros_like(way)
        if self.law == "harmonic":
            cos, sin = np.cos(theta - self.middle), np.sin(theta - self.middle)
            omega = s * self.speed * (1 + self.variation * cos)
            slope = -s * self.speed * self.variation * sin
            bend = -s * self.speed * self.variation * cos
            # dw/dt = w dw/dθ, and once more.
            return Turning(theta, omega, omega * slope, omega * (slope**2 + omega * bend))
        if self.law == "accelerating":
            size = np.sqrt(np.maximum(self.speed**2 + 2 * self.acceleration * way, 0.0))
            return Turning(theta, s * size, zero + s * self.acceleration, zero)
        if self.law == "from-rest":
            speeds_up = 2 * self.acceleration * way < self.speed**2
            size = np.where(speeds_up, np.sqrt(2 * self.acceleration * way), self.speed)
            return Turning(theta, s * size, np.where(speeds_up, s * self.acceleration, 0.0), zero)
        return Turning(theta, zero + s * self.speed, zero, zero)

    def time(self, theta: Array) -> Array:
        """Seconds (...) from the first entry to angles θd (...)."""
        way = np.maximum(self.turned(theta), 0.0)
        if self.law == "harmonic":
            return (self._swept(theta) - self._swept(np.asarray(self.start))) * self.sense / self.speed
        if self.law == "accelerating":
            # (w - w₀)/α in the form that stands where α is 0
            return 2 * way / (np.abs(self.at(theta).omega) + self.speed)
        if self.law == "from-rest":
            ramp = self.speed**2 / (2 * self.acceleration)
            return (
                np.sqrt(2 * np.minimum(way, ramp) / self.acceleration)
                + np.maximum(way - ramp, 0) / self.speed
            )
        return way / self.speed

    def _swept(self, theta: Array) -> Array:
        """The integral of 1/(1 + v cos x) from 0 to x = θd - θd0, going on over ±π."""
        x, v = theta - self.middle, self.variation
        whole = np.round(x / math.tau)
        half = (x - math.tau * whole) / 2
        # At ±π the tangent is as good as infinite, of either sign: both give half of a turn.
        swept = 2 * np.arctan(np.sqrt((1 - v) / (1 + v)) * np.tan(half))
        value: Array = (swept + math.tau * whole) / np.sqrt(1 - v * v)
        return value

    @property
    def varies(self) -> bool:
        """Whether strokes of one turn differ."""
        return self.law != "constant"

    @property
    def stops_at(self) -> float:
        """τ, rad, at which a driver that slows down stands still; infinite of one that does not."""
        if self.law != "accelerating":
            return math.inf
        with np.errstate(divide="ignore"):
            return number(self.speed**2 / (-2 * np.minimum(self.acceleration, 0.0)))


def driver_of(params: GenevaParams, crank_half: float) -> Driver:
    """The driver of a design whose stroke takes 2 ``crank_half``, rad."""
    sense = 1 if params.driver_direction == "forwards" else -1
    return Driver(
        params.driver_law,
        params.speed * math.tau / 60,
        0.0 if params.driver_acceleration is None else params.driver_acceleration,
        0.0 if params.driver_variation is None else params.driver_variation,
        sense,
        0.0 if sense > 0 else 2 * crank_half,
        crank_half,
    )
