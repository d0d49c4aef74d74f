"""Limits of a slider-crank in closed form: full turn, ends of the stroke, time ratio, transmission angle.

With the crank able to turn, c > a + |e|, the slider stands at its limits where crank and rod are in line:
φ' = asin(e / (a + c)) stretched and π + asin(e / (c - a)) folded, ahead of the crank pin; the assembly behind
it is the mirror image about the line through A0 across the slide. The stroke is √((a + c)² - e²) -
√((c - a)² - e²), and the crank turns 180° + θ the long way between the limits.

All are of numbers, or of columns (n, 1) over a table of designs.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from mechwright import Array, KinematicsError
from mechwright.contracts.design_table import Rowwise
from mechwright_slider_crank.kinematics.limit_motion import at_limit
from mechwright_slider_crank.kinematics.slider_crank import SliderCrank


def crank_turns(crank: Any, rod: Any, offset: Any) -> Any:
    """Whether the crank goes all the way round."""
    return rod > crank + abs(offset)


@dataclass(frozen=True)
class Limits(Rowwise):
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

    far: Any
    near: Any
    far_position: Any
    near_position: Any
    time_ratio: Any
    slow_outward: Any

    @property
    def stroke(self) -> Any:
        """H, mm."""
        return abs(self.far_position - self.near_position)

    @property
    def way(self) -> tuple[Any, Any]:
        """Slide positions at both ends, the lower one first, mm."""
        ends = self.near_position, self.far_position
        return np.minimum(*ends), np.maximum(*ends)


def limits(linkage: SliderCrank) -> Limits:
    """The limit positions of one linkage.

    Raises
    ------
    KinematicsError
        The crank cannot turn fully.

    Examples
    --------
    >>> found = limits(SliderCrank(50.0, 150.0, 20.0))
    >>> round(float(found.stroke), 6), round(float(found.time_ratio), 6)
    (101.017898, 1.066564)
    """
    a, c, e = linkage.crank, linkage.rod, linkage.offset
    if not crank_turns(a, c, e) and not at_limit(a, c, e):
        raise KinematicsError(f"the crank cannot turn: the rod of {c:g} mm must be above {a + abs(e):g} mm")
    found = limits_of_turns(linkage)
    return Limits(*(np.asarray(value).item() for value in vars(found).values()))


def limits_of_turns(linkage: SliderCrank) -> Limits:
    """The same of columns; of cranks that cannot turn they are no limits."""
    a, c, e = linkage.crank, linkage.rod, linkage.offset
    with np.errstate(invalid="ignore", divide="ignore"):
        stretched = np.arcsin(e / (a + c))
        # Without an offset crank and rod may be alike.
        folded = math.pi + np.where(e != 0, np.arcsin(np.clip(e / (c - np.asarray(a)), -1.0, 1.0)), 0.0)
    far, near = (np.sqrt(np.maximum((c + pin) ** 2 - e * e, 0.0)) for pin in (a, -a))
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
        np.maximum(inward, outward) / np.minimum(inward, outward),
        outward > inward,
    )


def transmission_angle(linkage: SliderCrank, phi: ArrayLike) -> Array:
    """Angle (...), rad, of the rod to the normal of the slide, at most π/2: cos μ = |e - a sin φ'| / c."""
    angle = np.asarray(phi, dtype=float) - linkage.direction
    cosine = np.abs(linkage.offset - linkage.crank * np.sin(angle)) / linkage.rod
    found: Array = np.arccos(np.minimum(1.0, cosine))
    return found


def least_transmission_angle(crank: Any, rod: Any, offset: Any) -> Any:
    """The least of a turn, rad: acos((a + |e|) / c); 0 where the crank cannot turn.

    >>> round(math.degrees(least_transmission_angle(50, 150, 20)), 6)
    62.181861
    """
    return np.arccos(np.minimum(1.0, (crank + abs(offset)) / rod))


def reach(crank: Any, rod: Any, offset: Any, least: Any = 0.0) -> tuple[Any, Any]:
    """Crank angles from the slide, rad, between which the rod keeps ``least``, rad, from its normal.

    A whole turn is from 0 to 2π; NaN where crank and rod do not meet. Of two such ways it is the one with
    the crank along the slide. With φ' the angle and c cos μ ≥ |e - a sin φ'|.

    Examples
    --------
    >>> [round(math.degrees(x), 6) for x in reach(30, 35, 10)]
    [-56.44269, 236.44269]
    """
    most = rod * np.cos(least)
    low, high = (offset - most) / crank, (offset + most) / crank
    first, last = np.arcsin(np.clip(low, -1.0, 1.0)), np.arcsin(np.clip(high, -1.0, 1.0))
    apart = (low >= 1) | (high <= -1)
    begin = np.where(low > -1, first, np.where(high >= 1, 0.0, -math.pi - last))
    end = np.where(high < 1, last, np.where(low > -1, math.pi - first, math.tau))
    return np.where(apart, math.nan, begin), np.where(apart, math.nan, end)
