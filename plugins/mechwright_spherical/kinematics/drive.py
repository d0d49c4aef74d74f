"""The bevel drive between crank and arm: pitch cones with their tips in the centre of the sphere.

Cones with half angles γ1 (on a0) and γ2 (on b0) turn by ω2 sin γ2 = ω1 sin γ1. Touching from outside, they
turn against each other; both links shall turn the same way where the ratio is positive, so an idler stands
between two cones that leave a gap, or the wheel is an internal one.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright import Array
from mechwright_spherical.kinematics.chain import third_position
from mechwright_spherical.kinematics.linkage import Linkage
from mechwright_spherical.kinematics.vectors import arc
from mechwright_spherical.parts.hardware import DriveTable


@dataclass(frozen=True, slots=True)
class Train:
    """Pitch cones, half angles in rad.

    Parameters
    ----------
    pinion, wheel
        On the crank's and on the arm's axis.
    idler
        0 where the two touch each other.
    idler_axis
        (3,), None without an idler.
    """

    pinion: float
    wheel: float
    idler: float = 0.0
    idler_axis: Array | None = None

    @property
    def idler_ratio(self) -> float:
        """Turns of the idler per turn of the pinion; it turns the other way."""
        return -math.sin(self.pinion) / math.sin(self.idler)


def external(shaft_angle: float, ratio: float) -> tuple[float, float]:
    """Half angles of two cones that touch from outside; ``ratio`` is the size of ω2/ω1.

    >>> [round(math.degrees(x), 4) for x in external(math.radians(90), 0.5)]
    [26.5651, 63.4349]
    """
    pinion = math.atan2(math.sin(shaft_angle), 1 / ratio + math.cos(shaft_angle))
    return pinion, shaft_angle - pinion


def internal(shaft_angle: float, ratio: float) -> tuple[float, float]:
    """Half angles of a pinion inside a wheel: both turn the same way; ``ratio`` is ω2/ω1, below 1.

    >>> [round(math.degrees(x), 4) for x in internal(math.radians(14.036244201312433), 0.5)]
    [13.2519, 27.2882]
    """
    pinion = math.atan2(math.sin(shaft_angle), 1 / ratio - math.cos(shaft_angle))
    return pinion, shaft_angle + pinion


def train_of(linkage: Linkage, table: DriveTable) -> Train | None:
    """The drive of a five-bar; None for a four-bar, without gears, or where the idler does not reach both."""
    mechanism = linkage.five_bar
    if mechanism is None or not table.gears:
        return None
    shafts = float(arc(mechanism.a0, mechanism.b0))
    if mechanism.ratio < 0:
        return Train(*external(shafts, -mechanism.ratio))
    # Both cones smaller than those that touch, by the same share of the gap between the shafts.
    pinion, wheel = external(table.share * shafts, mechanism.ratio)
    idler = math.radians(table.idler)
    axis = third_position(
        mechanism.a0,
        mechanism.b0,
        np.asarray(math.cos(pinion + idler)),
        np.asarray(math.cos(wheel + idler)),
        np.asarray(1.0),
    )
    return None if not np.isfinite(axis).all() else Train(pinion, wheel, idler, axis)
