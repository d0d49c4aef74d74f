"""Torque that the joint of gears 3 and 4 carries at constant speed of gear 2, by inertia and load.

The power that goes through it is what the bodies behind it take up: T ω4 = J4 α4 ω4 + J5 α5 ω5 for the gears,
m v·a + J ω6 α6 for the coupler, with v, a of its centre of mass, and the load |ω5|. Inertia grows with the
square of the speed. Pins,
shafts and friction are left out; the safety of a joint is for them and for what hangs on Q.
"""

import math
from dataclasses import dataclass

import numpy as np

from mechwright import Array, kept
from mechwright.mechanics.gearing import TO_NM, body
from mechwright.mechanics.peak import Peak
from mechwright_elliptic_gears.kinematics.equations import Turning, coupler, train
from mechwright_elliptic_gears.kinematics.peak import grid_of, peak
from mechwright_elliptic_gears.kinematics.point import point_of_coupler
from mechwright_elliptic_gears.parameters import EllipticGearParams
from mechwright_elliptic_gears.parts.gear import ellipse_of, outline_of
from mechwright_elliptic_gears.parts.layout import layout_of
from mechwright_elliptic_gears.parts.plates import coupler_part


@dataclass(frozen=True)
class Masses:
    """Bodies behind the joint: kg, kg mm², mm.

    Parameters
    ----------
    gear
        Moment of inertia of gear 4, and of gear 5, about its axis.
    coupler
        Mass of the coupler.
    turning
        Its moment of inertia about its centre of mass.
    centre
        Where that stands: x + i y from J, K on x, in lengths of the coupler.
    """

    gear: float
    coupler: float
    turning: float
    centre: complex


@kept
def masses_of(params: EllipticGearParams) -> Masses:
    """Of full plates: bores are part of them, holes of gears are not looked at."""
    layout = layout_of(params)
    link = coupler_part(params, layout)
    assert link.outline is not None  # noqa: S101 - it is a plate
    own, _ = body(link.outline, layout.coupler, params.material)
    return Masses(gear_inertia(params), own.mass, own.inertia, own.centre / (2 * layout.semi_major))


def gear_inertia(params: EllipticGearParams) -> float:
    """Moment of inertia of a full gear about its axis, kg mm²."""
    return body(outline_of(params), params.thickness, params.material)[1]


def joint_torque(
    theta2: Array, params: EllipticGearParams, phase: float, masses: Masses, *, driver: bool = True
) -> Array:
    """Torque (n,), N m, that gear 3 gives gear 4 at the phase angle ``phase``, rad.

    Without ``driver`` it is that of the bodies behind gear 4 alone.
    """
    _, four, five = train(Turning.of(theta2, params.speed * math.tau / 60), params.eccentricity, phase)
    return torque_behind(four, five, params, masses, driver=driver)


def torque_behind(
    four: Turning, five: Turning, params: EllipticGearParams, masses: Masses, *, driver: bool = True
) -> Array:
    """The same torque (n,), N m, from the motion of gears 4 and 5."""
    a, e = ellipse_of(params).semi_major, params.eccentricity
    link = coupler(four, five)
    centre = point_of_coupler(four, five, a, e, masses.centre)
    power = masses.gear * five.alpha * five.omega + masses.turning * link.omega * link.alpha
    power += masses.coupler * np.real(np.conj(centre.velocity) * centre.acceleration)
    power += params.load_torque / TO_NM * np.abs(five.omega)
    torque: Array = power / four.omega + (masses.gear * four.alpha if driver else 0.0)
    return torque * TO_NM


@kept
def greatest_torque(params: EllipticGearParams, phase: float) -> Peak:
    """The greatest torque, N m, either way, at a phase angle in degrees, and where it is."""
    masses = masses_of(params)
    gamma, grid = math.radians(phase), grid_of(params.eccentricity)
    return peak(lambda theta2: np.abs(joint_torque(theta2, params, gamma, masses)), grid)
