"""Figures of a slider-crank in closed form: full turn, limits, stroke, time ratio, transmission angle.

With the crank able to turn, c > a + |e|, the slider stands at its limits where crank and rod are in line:
φ' = asin(e / (a + c)) stretched and π + asin(e / (c - a)) folded, ahead of the crank pin; the assembly behind
it is the mirror image about the line through A0 across the slide. The stroke is √((a + c)² - e²) -
√((c - a)² - e²), and the crank turns 180° + θ the long way between the limits.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from mechwright import Array, KinematicsError
from mechwright_slider_crank.kinematics import SliderCrank
from mechwright_slider_crank.limit_motion import at_limit


def crank_turns(crank: float, rod: float, offset: float) -> bool:
    """Whether the crank goes all the way round."""
    return rod > crank + abs(offset)


@dataclass(frozen=True, slots=True)
class Limits:
    """The ends of the stroke.

    Parameters
    ----------
    far, near
        Crank angles φ, rad, in [0, 2π), with the slider farthest from A0 and nearest to it.
    far_position, near_position
        Slide positions s there, mm.
    time_ratio
        K of the slower stroke's time over the faster one's, at constant speed, at least 1.
    slow_outward
        Whether the slower stroke is the one away from A0 for a crank that turns counter-clockwise.
    """

    far: float
    near: float
    far_position: float
    near_position: float
    time_ratio: float
    slow_outward: bool

    @property
    def stroke(self) -> float:
        """H, mm."""
        return abs(self.far_position - self.near_position)


def limits(linkage: SliderCrank) -> Limits:
    """The limit positions.

    Raises
    ------
    KinematicsError
        The crank cannot turn fully.

    Examples
    --------
    >>> found = limits(SliderCrank(50.0, 150.0, 20.0))
    >>> round(found.stroke, 6), round(found.time_ratio, 6)
    (101.017898, 1.066564)
    """
    a, c, e = linkage.crank, linkage.rod, linkage.offset
    if not crank_turns(a, c, e) and not at_limit(a, c, e):
        raise KinematicsError(f"the crank cannot turn: the rod of {c:g} mm must be above {a + abs(e):g} mm")
    stretched, folded = math.asin(e / (a + c)), math.pi
    if e != 0:  # without an offset crank and rod may be alike
        folded += math.asin(max(-1.0, min(1.0, e / (c - a))))
    far, near = (math.sqrt(max((c + pin) ** 2 - e * e, 0.0)) for pin in (a, -a))
    inward = (folded - stretched) % math.tau
    if linkage.branch < 0:  # mirror image: x and the sense of turning change sign
        stretched, folded, far, near = math.pi - stretched, math.pi - folded, -far, -near
        inward = math.tau - inward
    outward = math.tau - inward
    return Limits(
        (stretched + linkage.direction) % math.tau,
        (folded + linkage.direction) % math.tau,
        far,
        near,
        max(inward, outward) / min(inward, outward),
        outward > inward,
    )


def transmission_angle(linkage: SliderCrank, phi: ArrayLike) -> Array:
    """Angle (...), rad, of the rod to the normal of the slide, at most π/2: cos μ = |e - a sin φ'| / c."""
    angle = np.asarray(phi, dtype=float) - linkage.direction
    cosine = np.abs(linkage.offset - linkage.crank * np.sin(angle)) / linkage.rod
    found: Array = np.arccos(np.minimum(1.0, cosine))
    return found


def least_transmission_angle(crank: float, rod: float, offset: float) -> float:
    """The least of a turn, rad: acos((a + |e|) / c); 0 where the crank cannot turn.

    >>> round(math.degrees(least_transmission_angle(50, 150, 20)), 6)
    62.181861
    """
    return math.acos(min(1.0, (crank + abs(offset)) / rod))
