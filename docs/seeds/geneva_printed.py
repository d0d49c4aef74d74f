"""The source's formulas as they are printed, kept only to document what is wrong with them.

``docs/seeds/geneva.md`` and the tests compare with them.

* Figure 6 gives a loop point that comes from the 3-4-5 law, though the text names the cycloid, and from a
  wall in which θw' is taken as dθw/du: the factor 1/(2 θd0) of the chain rule is missing in equation (3).
* Equations (28) to (30) leave the terms with θw'' out of ∂f/∂θd and exchange sin φ and cos φ.
"""

import math

import numpy as np
from geneva_undercut import alpha
from numpy.typing import ArrayLike

from mechwright.arrays import Array
from mechwright.mechanics.laws import Law
from mechwright_geneva.kinematics.geometry import LEFT, Frame, Points, Stroke, stroke


def wall(frame: Frame, law: Law, u: ArrayLike, radius: float, side: int) -> Points:
    """The wall of Figure 6: equation (3) with dθw/du in place of θw'."""
    run = stroke(frame, law, u)
    rate = 2 * frame.wheel_half * law.at(u).v  # should be divided by 2 θd0
    a, b = frame.axes, frame.crank
    turn = np.arctan2(a * rate * np.sin(run.phi), (1 + rate) * b - a * rate * np.cos(run.phi))
    turn = turn + (0.0 if side == LEFT else np.pi)
    points: Points = (run.centre - radius * np.exp(1j * (run.phi + turn))) * run.to_wheel
    return points


def loop(frame: Frame, law: Law, radius: float, *, printed: bool) -> tuple[float, complex]:
    """Where the right wall meets the slot's axis on its way in: crank angle, rad, and the point, mm."""

    def off_axis(u: float) -> float:
        return float((point(u) * np.exp(1j * frame.wheel_half)).imag)

    def point(u: float) -> complex:
        if printed:
            return complex(wall(frame, law, np.array(u), radius, -LEFT))
        return complex(stroke(frame, law, np.array(u)).wall(radius, -LEFT))

    low, high = 0.0, 0.4
    start = off_axis(low)
    for _ in range(60):
        middle = (low + high) / 2
        if (off_axis(middle) > 0) == (start > 0):
            low = middle
        else:
            high = middle
    return 2 * float(frame.crank_half) * low, point(low)


def singularity(run: Stroke, radius: float, side: int) -> Array:
    """F of equation (30) as printed."""
    n, m = run.frame.axes / run.frame.crank, radius / run.frame.crank
    turn = alpha(run) + (0.0 if side == LEFT else math.pi)
    p, phi = run.first, run.phi
    f_alpha = (1 + p) * np.cos(turn) - n * p * np.cos(phi + turn)
    f_theta = n * p * np.cos(phi + turn)
    one = m * np.sin(turn) * f_theta + ((1 + p) * m * np.sin(turn) + n * p * np.cos(phi)) * f_alpha
    two = -m * np.cos(turn) * f_theta - ((1 + p) * (1 + m * np.cos(turn)) - n * p * np.sin(phi)) * f_alpha
    value: Array = one**2 + two**2
    return value
